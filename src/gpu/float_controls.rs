//! What a device promises of floats when a kernel asks for it: rounding to nearest, NaN and infinities kept.

use ash::vk;

/// Controls of one width of floats.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) struct FloatControls {
    /// Bits.
    pub width: u32,
    pub round_to_nearest: bool,
    pub keep_nan_and_infinity: bool,
}

impl FloatControls {
    /// Those of `f32` and `f64`.
    pub fn of(properties: &vk::PhysicalDeviceFloatControlsProperties) -> [Self; 2] {
        let independence = properties.rounding_mode_independence;
        // Else the rounding of one width is tied to that of others, which the device may not offer.
        let alone_32 = independence != vk::ShaderFloatControlsIndependence::NONE;
        let alone_64 = independence == vk::ShaderFloatControlsIndependence::ALL;
        let is = |flag| flag == vk::TRUE;
        [
            Self {
                width: 32,
                round_to_nearest: alone_32 && is(properties.shader_rounding_mode_rte_float32),
                keep_nan_and_infinity: is(properties.shader_signed_zero_inf_nan_preserve_float32),
            },
            Self {
                width: 64,
                round_to_nearest: alone_64 && is(properties.shader_rounding_mode_rte_float64),
                keep_nan_and_infinity: is(properties.shader_signed_zero_inf_nan_preserve_float64),
            },
        ]
    }
}

/// Opcodes and enumerants of the SPIR-V specification, unified1.
mod spirv {
    pub const HEADER_WORDS: usize = 5;
    pub const ENTRY_POINT: u32 = 15;
    pub const EXECUTION_MODE: u32 = 16;
    pub const CAPABILITY: u32 = 17;
    pub const TYPE_FLOAT: u32 = 22;
    /// Capability and execution mode.
    pub const SIGNED_ZERO_INF_NAN_PRESERVE: [u32; 2] = [4466, 4461];
    pub const ROUNDING_MODE_RTE: [u32; 2] = [4467, 4462];
}

/// A module with one entry point that asks for all of these controls, for the widths that it calculates in. Without
/// SPV_KHR_float_controls in its text, since SPIR-V 1.4 has them itself.
pub(super) fn declare(module: &[u32], controls: &[FloatControls]) -> Vec<u32> {
    let mut instructions = Vec::new();
    let mut rest = module.get(spirv::HEADER_WORDS..).unwrap_or_default();
    while let [first, ..] = rest {
        let length = ((first >> 16) as usize).clamp(1, rest.len());
        instructions.push((first & 0xFFFF, &rest[..length]));
        rest = &rest[length..];
    }
    let is_used =
        |width: u32| instructions.iter().any(|(opcode, words)| *opcode == spirv::TYPE_FLOAT && words[2] == width);

    let mut wanted = Vec::new();
    for control in controls.iter().filter(|control| is_used(control.width)) {
        let modes = [
            (control.round_to_nearest, spirv::ROUNDING_MODE_RTE),
            (control.keep_nan_and_infinity, spirv::SIGNED_ZERO_INF_NAN_PRESERVE),
        ];
        wanted.extend(modes.iter().filter(|(is_offered, _)| *is_offered).map(|(_, mode)| (control.width, *mode)));
    }

    let mut declared = module[..spirv::HEADER_WORDS.min(module.len())].to_vec();
    let mut capabilities: Vec<u32> = wanted.iter().map(|(_, [capability, _])| *capability).collect();
    capabilities.sort_unstable();
    capabilities.dedup();
    // Capabilities come first in a module, execution modes behind the entry points.
    declared.extend(capabilities.iter().flat_map(|&capability| [2 << 16 | spirv::CAPABILITY, capability]));
    for (opcode, words) in instructions {
        declared.extend(words);
        if opcode == spirv::ENTRY_POINT {
            let function = words[2];
            declared.extend(
                wanted.iter().flat_map(|&(width, [_, mode])| [4 << 16 | spirv::EXECUTION_MODE, function, mode, width]),
            );
        }
    }
    declared
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Capability Shader, an entry point, a 32-bit float type.
    fn module() -> Vec<u32> {
        let mut words = vec![0x0723_0203, 0x0001_0500, 0, 9, 0];
        words.extend([2 << 16 | 17, 1]);
        words.extend([4 << 16 | 15, 5, 4, 0]);
        words.extend([3 << 16 | 22, 6, 32]);
        words
    }

    fn controls(round_to_nearest: bool, keep_nan_and_infinity: bool) -> [FloatControls; 2] {
        [32, 64].map(|width| FloatControls { width, round_to_nearest, keep_nan_and_infinity })
    }

    #[test]
    fn a_module_asks_for_what_is_offered_of_the_widths_it_uses() {
        let mut expected = module()[..5].to_vec();
        expected.extend([2 << 16 | 17, 4466, 2 << 16 | 17, 4467]);
        expected.extend([2 << 16 | 17, 1]);
        expected.extend([4 << 16 | 15, 5, 4, 0]);
        expected.extend([4 << 16 | 16, 4, 4462, 32, 4 << 16 | 16, 4, 4461, 32]);
        expected.extend([3 << 16 | 22, 6, 32]);
        assert_eq!(declare(&module(), &controls(true, true)), expected);
    }

    #[test]
    fn a_module_stays_as_it_is_where_nothing_is_offered() {
        assert_eq!(declare(&module(), &controls(false, false)), module());
    }

    #[test]
    fn rounding_tied_to_other_widths_is_not_asked_for() {
        let offered = |rounding_mode_independence| {
            let properties = vk::PhysicalDeviceFloatControlsProperties {
                rounding_mode_independence,
                shader_rounding_mode_rte_float32: vk::TRUE,
                shader_rounding_mode_rte_float64: vk::TRUE,
                ..Default::default()
            };
            FloatControls::of(&properties).map(|control| control.round_to_nearest)
        };
        assert_eq!(offered(vk::ShaderFloatControlsIndependence::NONE), [false, false]);
        assert_eq!(offered(vk::ShaderFloatControlsIndependence::TYPE_32_ONLY), [true, false]);
        assert_eq!(offered(vk::ShaderFloatControlsIndependence::ALL), [true, true]);
    }
}
