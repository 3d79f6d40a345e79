//! What to take of what a window offers, and what of a picture it has room for. Pure.

use std::ops::Range;

use ash::vk;

/// Whether the window still goes with its swapchain.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fit {
    Good,
    /// A new swapchain is needed.
    Outdated,
    /// A new surface is needed.
    SurfaceLost,
}

/// What an answer says of that; `None` for a failure.
pub(super) fn unfit(result: vk::Result) -> Option<Fit> {
    match result {
        vk::Result::ERROR_OUT_OF_DATE_KHR => Some(Fit::Outdated),
        vk::Result::ERROR_SURFACE_LOST_KHR => Some(Fit::SurfaceLost),
        vk::Result::TIMEOUT | vk::Result::NOT_READY => Some(Fit::Good),
        _ => None,
    }
}

pub(super) fn choose_extent(capabilities: &vk::SurfaceCapabilitiesKHR, wanted: [u32; 2]) -> vk::Extent2D {
    // The specification's word for "as you like".
    if capabilities.current_extent.width != u32::MAX {
        return capabilities.current_extent;
    }
    let (least, most) = (capabilities.min_image_extent, capabilities.max_image_extent);
    vk::Extent2D {
        width: wanted[0].min(most.width).max(least.width),
        height: wanted[1].min(most.height).max(least.height),
    }
}

/// Values are shown as they are, without gamma, as the course's display did; so no `_SRGB` format.
pub(super) fn choose_format(formats: &[vk::SurfaceFormatKHR]) -> Option<vk::SurfaceFormatKHR> {
    let wanted = [vk::Format::B8G8R8A8_UNORM, vk::Format::R8G8B8A8_UNORM, vk::Format::A8B8G8R8_UNORM_PACK32];
    wanted.into_iter().find_map(|wanted| {
        let fits = |format: &&vk::SurfaceFormatKHR| {
            format.format == wanted && format.color_space == vk::ColorSpaceKHR::SRGB_NONLINEAR
        };
        formats.iter().find(fits).copied()
    })
}

/// FIFO is always there. Without waiting: what drops late images, then what tears.
pub(super) fn choose_present_mode(modes: &[vk::PresentModeKHR], waits_for_display: bool) -> vk::PresentModeKHR {
    let free = [vk::PresentModeKHR::MAILBOX, vk::PresentModeKHR::IMMEDIATE];
    let chosen = free.into_iter().find(|mode| !waits_for_display && modes.contains(mode));
    chosen.unwrap_or(vk::PresentModeKHR::FIFO)
}

/// Name of one of the modes that [`choose_present_mode`] chooses.
pub(super) fn present_mode_name(mode: vk::PresentModeKHR) -> &'static str {
    match mode {
        vk::PresentModeKHR::MAILBOX => "mailbox",
        vk::PresentModeKHR::IMMEDIATE => "immediate",
        _ => "fifo",
    }
}

/// One more than the least, so that none of them need be waited for while the window system holds the others.
pub(super) fn choose_image_count(capabilities: &vk::SurfaceCapabilitiesKHR) -> u32 {
    let wanted = capabilities.min_image_count + 1;
    // 0 means no limit.
    if capabilities.max_image_count == 0 { wanted } else { wanted.min(capabilities.max_image_count) }
}

pub(super) fn choose_alpha(supported: vk::CompositeAlphaFlagsKHR) -> vk::CompositeAlphaFlagsKHR {
    let wanted = [vk::CompositeAlphaFlagsKHR::OPAQUE, vk::CompositeAlphaFlagsKHR::INHERIT];
    wanted.into_iter().find(|alpha| supported.contains(*alpha)).unwrap_or(vk::CompositeAlphaFlagsKHR::OPAQUE)
}

/// The part of these columns of a picture that lies inside the window when the picture's corner is put at `corner`;
/// `None` where none does.
pub(super) fn copy_region(
    picture: vk::Extent2D,
    columns: &Range<u32>,
    window: vk::Extent2D,
    corner: [u32; 2],
) -> Option<vk::ImageBlit> {
    let end = columns.end.min(picture.width).min(window.width.saturating_sub(corner[0]));
    let width = end.saturating_sub(columns.start);
    let height = picture.height.min(window.height.saturating_sub(corner[1]));
    if width == 0 || height == 0 {
        return None;
    }
    let layers = vk::ImageSubresourceLayers {
        aspect_mask: vk::ImageAspectFlags::COLOR,
        mip_level: 0,
        base_array_layer: 0,
        layer_count: 1,
    };
    let rectangle = |x: u32, y: u32| {
        let at = |x: u32, y: u32, z| vk::Offset3D { x: x as i32, y: y as i32, z };
        [at(x, y, 0), at(x + width, y + height, 1)]
    };
    Some(
        vk::ImageBlit::default()
            .src_subresource(layers)
            .src_offsets(rectangle(columns.start, 0))
            .dst_subresource(layers)
            .dst_offsets(rectangle(corner[0] + columns.start, corner[1])),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn extent(width: u32, height: u32) -> vk::Extent2D {
        vk::Extent2D { width, height }
    }

    #[test]
    fn no_format_with_gamma_is_taken() {
        let format = |format| vk::SurfaceFormatKHR { format, color_space: vk::ColorSpaceKHR::SRGB_NONLINEAR };
        let offered = [format(vk::Format::B8G8R8A8_SRGB), format(vk::Format::R8G8B8A8_UNORM)];
        assert_eq!(choose_format(&offered).map(|chosen| chosen.format), Some(vk::Format::R8G8B8A8_UNORM));
        assert!(choose_format(&offered[..1]).is_none());
    }

    #[test]
    fn the_display_is_waited_for_unless_told_otherwise() {
        use vk::PresentModeKHR as Mode;
        let all = [Mode::IMMEDIATE, Mode::MAILBOX, Mode::FIFO];
        assert_eq!(choose_present_mode(&all, true), Mode::FIFO);
        assert_eq!(choose_present_mode(&all, false), Mode::MAILBOX);
        assert_eq!(choose_present_mode(&[Mode::IMMEDIATE, Mode::FIFO], false), Mode::IMMEDIATE);
        assert_eq!(choose_present_mode(&[Mode::FIFO], false), Mode::FIFO);
    }

    #[test]
    fn a_window_that_leaves_the_size_to_us_gets_what_is_wanted_within_its_limits() {
        let mut capabilities = vk::SurfaceCapabilitiesKHR {
            current_extent: extent(u32::MAX, u32::MAX),
            min_image_extent: extent(1, 1),
            max_image_extent: extent(100, 100),
            ..Default::default()
        };
        assert_eq!(choose_extent(&capabilities, [50, 500]), extent(50, 100));
        capabilities.current_extent = extent(0, 0);
        assert_eq!(choose_extent(&capabilities, [50, 500]), extent(0, 0), "minimised");
    }

    #[test]
    fn the_number_of_images_stays_within_the_windows_limit() {
        let count = |min_image_count, max_image_count| {
            choose_image_count(&vk::SurfaceCapabilitiesKHR { min_image_count, max_image_count, ..Default::default() })
        };
        assert_eq!((count(2, 0), count(2, 8), count(3, 3)), (3, 3, 3));
    }

    #[test]
    fn a_picture_is_cut_at_the_windows_edge() {
        let region = copy_region(extent(100, 50), &(0..u32::MAX), extent(80, 200), [10, 20]).unwrap();
        assert_eq!((region.src_offsets[1].x, region.src_offsets[1].y), (70, 50));
        assert_eq!((region.dst_offsets[0].x, region.dst_offsets[1].y), (10, 70));
        assert!(copy_region(extent(100, 50), &(0..u32::MAX), extent(80, 200), [80, 0]).is_none());
    }

    #[test]
    fn columns_of_a_picture_stay_in_their_place() {
        let region = copy_region(extent(100, 50), &(30..100), extent(80, 200), [10, 20]).unwrap();
        assert_eq!((region.src_offsets[0].x, region.src_offsets[1].x), (30, 70));
        assert_eq!((region.dst_offsets[0].x, region.dst_offsets[1].x), (40, 80));
        for none in [70..100, 40..40, 100..200] {
            assert!(copy_region(extent(100, 50), &none, extent(80, 200), [10, 20]).is_none(), "{none:?}");
        }
    }
}
