use super::ray::{Face, Hit, Side};

/// Folds every discrete event on a pixel's way into one number: where it differs between neighbouring pixels, or
/// between two renderers, there is a discontinuity, be it an edge, a shadow's, or one seen in a mirror.
#[derive(Debug, Clone, Copy)]
pub(super) struct Path(u64);

impl Default for Path {
    fn default() -> Self {
        Self(FNV_OFFSET_BASIS)
    }
}

const FNV_OFFSET_BASIS: u64 = 0xcbf2_9ce4_8422_2325;
const FNV_PRIME: u64 = 0x0100_0000_01b3;

impl Path {
    pub fn add_hit(&mut self, hit: &Hit) {
        let face = match hit.face {
            Face::Curved => 0,
            Face::Slab { axis, positive } => 1 + 2 * u32::from(axis) + u32::from(positive),
            Face::End(end) => 7 + u32::from(end),
            Face::Base => 9,
        };
        self.add(0, hit.primitive);
        self.add(1, face);
        self.add(2, u32::from(hit.side == Side::Inside));
    }

    pub fn add_miss(&mut self) {
        self.add(3, 0);
    }

    pub fn add_light_sphere(&mut self, light: u32) {
        self.add(4, light);
    }

    /// Whether a light reaches the hit added last.
    pub fn add_light(&mut self, lit: bool) {
        self.add(5, u32::from(lit));
    }

    /// Whether a ray is refracted at the hit added last, or all of it is reflected.
    pub fn add_refraction(&mut self, refracted: bool) {
        self.add(6, u32::from(refracted));
    }

    /// Surfaces of a primitive that a light shines through on its way to the hit added last.
    pub fn add_crossing(&mut self, primitive: u32, surfaces: u32) {
        self.add(7, primitive);
        self.add(8, surfaces);
    }

    pub fn signature(self) -> u64 {
        self.0
    }

    /// FNV-1a over the event's tag and value.
    fn add(&mut self, tag: u8, value: u32) {
        for byte in std::iter::once(tag).chain(value.to_le_bytes()) {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(FNV_PRIME);
        }
    }
}
