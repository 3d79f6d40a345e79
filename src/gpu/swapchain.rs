//! The images that the window shows, and the commands that fill them.

use std::ops::Range;
use std::sync::Arc;

use ash::{khr, vk};

use super::swapchain_choices::{
    Fit, choose_alpha, choose_extent, choose_format, choose_image_count, choose_present_mode, copy_region,
    present_mode_name, unfit,
};
use super::{Device, GpuError, InFlight, Recorder, Resource, Semaphores, Surface, Use, with_device_list};

/// A window's images with what is needed to fill them: first the picture is copied in, then the widgets are drawn.
pub struct Swapchain {
    raw: vk::SwapchainKHR,
    functions: khr::swapchain::Device,
    extent: vk::Extent2D,
    present_mode: vk::PresentModeKHR,
    render_pass: vk::RenderPass,
    images: Vec<Image>,
    /// Signalled when an image may be written; by turns, as the submissions that wait for them.
    acquired: [vk::Semaphore; InFlight::COUNT],
    next_acquired: usize,
    device: Arc<Device>,
    // Destroyed after the swapchain.
    _surface: Arc<Surface>,
}

struct Image {
    raw: vk::Image,
    view: vk::ImageView,
    framebuffer: vk::Framebuffer,
    /// Signalled when the image may be shown.
    filled: vk::Semaphore,
}

/// An image that may be written, once.
#[derive(Debug)]
pub struct Acquired {
    index: u32,
    semaphore: vk::Semaphore,
}

/// An image of the window while the submission that fills it is recorded.
pub struct WindowImage<'a> {
    swapchain: &'a Swapchain,
    image: &'a Image,
}

/// That an image has all that is to be shown.
pub struct Filled(());

impl Swapchain {
    /// Images of the window's size, `wanted` where the window leaves that to us, pixels; `None` while it has none, as
    /// when minimised.
    pub fn new(
        device: &Arc<Device>,
        surface: &Arc<Surface>,
        wanted: [u32; 2],
        waits_for_display: bool,
    ) -> Result<Option<Self>, GpuError> {
        let capabilities = device.surface_capabilities(surface)?;
        let extent = choose_extent(&capabilities, wanted);
        if extent.width == 0 || extent.height == 0 {
            return Ok(None);
        }
        if !capabilities.supported_usage_flags.contains(IMAGE_USE) {
            return Err(GpuError::NoWindow("its images cannot be copied to".to_owned()));
        }
        let format = choose_format(&device.surface_formats(surface)?)
            .ok_or_else(|| GpuError::NoWindow("it offers no linear 8-bit format".to_owned()))?;
        let present_mode = choose_present_mode(&device.present_modes(surface)?, waits_for_display);
        let info = vk::SwapchainCreateInfoKHR::default()
            .surface(surface.raw)
            .min_image_count(choose_image_count(&capabilities))
            .image_format(format.format)
            .image_color_space(format.color_space)
            .image_extent(extent)
            .image_array_layers(1)
            .image_usage(IMAGE_USE)
            .pre_transform(capabilities.current_transform)
            .composite_alpha(choose_alpha(capabilities.supported_composite_alpha))
            .present_mode(present_mode)
            .clipped(true);
        let functions = device.swapchain_functions();
        // Null handles until made; `Drop` ignores them, so a failure on the way leaks nothing.
        let mut swapchain = Self {
            // SAFETY: surface and device are alive; the window's last swapchain is destroyed.
            raw: with_device_list(|| unsafe { functions.create_swapchain(&info, None) })
                .map_err(GpuError::call(|| "create the swapchain"))?,
            functions,
            extent,
            present_mode,
            render_pass: vk::RenderPass::null(),
            images: Vec::new(),
            acquired: [vk::Semaphore::null(); InFlight::COUNT],
            next_acquired: 0,
            device: device.clone(),
            _surface: surface.clone(),
        };
        device.set_name(swapchain.raw, "window");
        swapchain.render_pass = create_render_pass(device, format.format)?;
        for index in 0..swapchain.acquired.len() {
            swapchain.acquired[index] = create_semaphore(device, "image acquired")?;
        }
        // SAFETY: the swapchain is alive.
        let images = unsafe { swapchain.functions.get_swapchain_images(swapchain.raw) }
            .map_err(GpuError::call(|| "list the swapchain's images"))?;
        for raw in images {
            swapchain.add_image(raw, format.format)?;
        }
        Ok(Some(swapchain))
    }

    fn add_image(&mut self, raw: vk::Image, format: vk::Format) -> Result<(), GpuError> {
        self.device.set_name(raw, "window image");
        self.images.push(Image {
            raw,
            view: vk::ImageView::null(),
            framebuffer: vk::Framebuffer::null(),
            filled: create_semaphore(&self.device, "image filled")?,
        });
        let vk::Extent2D { width, height } = self.extent;
        let Some(image) = self.images.last_mut() else { return Ok(()) };
        let info = vk::ImageViewCreateInfo::default()
            .image(raw)
            .view_type(vk::ImageViewType::TYPE_2D)
            .format(format)
            .subresource_range(COLOR);
        // SAFETY: the image is the swapchain's, which is alive.
        image.view = unsafe { self.device.raw.create_image_view(&info, None) }
            .map_err(GpuError::call(|| "create the view of a window image"))?;
        let views = [image.view];
        let info = vk::FramebufferCreateInfo::default()
            .render_pass(self.render_pass)
            .attachments(&views)
            .width(width)
            .height(height)
            .layers(1);
        // SAFETY: render pass and view are alive.
        image.framebuffer = unsafe { self.device.raw.create_framebuffer(&info, None) }
            .map_err(GpuError::call(|| "create the framebuffer of a window image"))?;
        Ok(())
    }

    /// Pixels.
    pub fn extent(&self) -> vk::Extent2D {
        self.extent
    }

    /// How images are shown.
    pub fn present_mode(&self) -> &'static str {
        present_mode_name(self.present_mode)
    }

    /// For the widgets' renderer.
    pub fn render_pass(&self) -> vk::RenderPass {
        self.render_pass
    }

    /// Asks for the next image; `Err(Fit)` inside when there is none to be had from this swapchain, or none yet.
    ///
    /// It is to be [shown](Swapchain::show) with the same submissions.
    pub fn acquire(&mut self, in_flight: &mut InFlight) -> Result<Result<Acquired, Fit>, GpuError> {
        // As many semaphores as slots: the submission that waited for this one has ended.
        in_flight.wait_for_place()?;
        let semaphore = self.acquired[self.next_acquired];
        // SAFETY: the semaphore is unsignalled, as its last wait has ended.
        let acquired =
            unsafe { self.functions.acquire_next_image(self.raw, PATIENCE_NS, semaphore, vk::Fence::null()) };
        match acquired {
            // A suboptimal image is shown all the same; showing it says so again.
            Ok((index, _)) => {
                self.next_acquired = (self.next_acquired + 1) % self.acquired.len();
                Ok(Ok(Acquired { index, semaphore }))
            }
            Err(result) => unfit(result).map(Err).ok_or(GpuError::Call { operation: ACQUIRE.into(), result }),
        }
    }

    /// Submits what fills the image, and shows it; `Err(Fit)` inside when the window did not take it.
    pub fn show(
        &self,
        in_flight: &mut InFlight,
        image: Acquired,
        record: impl FnOnce(&mut Recorder, WindowImage) -> Result<Filled, GpuError>,
    ) -> Result<Result<Fit, Fit>, GpuError> {
        let target = &self.images[image.index as usize];
        let semaphores =
            Semaphores { wait: Some((image.semaphore, vk::PipelineStageFlags::TRANSFER)), signal: Some(target.filled) };
        in_flight.submit(semaphores, |recorder| {
            let Filled(()) = record(recorder, WindowImage { swapchain: self, image: target })?;
            Ok(())
        })?;
        self.present(image)
    }

    fn record(
        &self,
        recorder: &mut Recorder,
        image: &Image,
        background: [f32; 4],
        pictures: &[(&Resource, Range<u32>)],
        corner: [u32; 2],
        draw_widgets: impl FnOnce(vk::CommandBuffer),
    ) -> Result<(), GpuError> {
        recorder.labelled("copy picture", |recorder| {
            for (picture, _) in pictures {
                recorder.make_ready(picture, Use::CopySource);
                recorder.note_use(picture, "show", Use::CopySource);
            }
            self.copy_pictures(recorder, image.raw, background, pictures, corner);
            Ok(())
        })?;
        recorder.labelled("widgets", |recorder| {
            let info = vk::RenderPassBeginInfo::default()
                .render_pass(self.render_pass)
                .framebuffer(image.framebuffer)
                .render_area(vk::Rect2D { offset: vk::Offset2D::default(), extent: self.extent });
            // SAFETY: the command buffer is being recorded; pass and framebuffer are alive and go together.
            unsafe { self.device.raw.cmd_begin_render_pass(recorder.buffer, &info, vk::SubpassContents::INLINE) };
            draw_widgets(recorder.buffer);
            // SAFETY: begun above.
            unsafe { self.device.raw.cmd_end_render_pass(recorder.buffer) };
            Ok(())
        })
    }

    fn copy_pictures(
        &self,
        recorder: &Recorder,
        target: vk::Image,
        background: [f32; 4],
        pictures: &[(&Resource, Range<u32>)],
        corner: [u32; 2],
    ) {
        const LAYOUT: vk::ImageLayout = vk::ImageLayout::TRANSFER_DST_OPTIMAL;
        let raw = &self.device.raw;
        let transfer = vk::PipelineStageFlags::TRANSFER;
        let barrier = |old_layout, source_access| {
            [vk::ImageMemoryBarrier::default()
                .src_access_mask(source_access)
                .dst_access_mask(vk::AccessFlags::TRANSFER_WRITE)
                .old_layout(old_layout)
                .new_layout(LAYOUT)
                .src_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
                .dst_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
                .image(target)
                .subresource_range(COLOR)]
        };
        // What the image held is not needed. The first barrier waits in the stage in which the semaphore is waited for.
        let before_clear = barrier(vk::ImageLayout::UNDEFINED, vk::AccessFlags::empty());
        let before_copy = barrier(LAYOUT, vk::AccessFlags::TRANSFER_WRITE);
        let color = vk::ClearColorValue { float32: background };
        let copied = pictures.iter().filter_map(|(picture, columns)| {
            let image = picture.image()?;
            Some((image, copy_region(image.extent(), columns, self.extent, corner)?))
        });
        let none = vk::DependencyFlags::empty();
        // SAFETY: the command buffer is being recorded; all images are alive, in these layouts, and each region lies
        // within both of its images. Regions may overlap: a barrier stands before each.
        unsafe {
            raw.cmd_pipeline_barrier(recorder.buffer, transfer, transfer, none, &[], &[], &before_clear);
            raw.cmd_clear_color_image(recorder.buffer, target, LAYOUT, &color, &[COLOR]);
            for (image, region) in copied {
                raw.cmd_pipeline_barrier(recorder.buffer, transfer, transfer, none, &[], &[], &before_copy);
                raw.cmd_blit_image(
                    recorder.buffer,
                    image.raw(),
                    vk::ImageLayout::TRANSFER_SRC_OPTIMAL,
                    target,
                    LAYOUT,
                    &[region],
                    vk::Filter::NEAREST,
                );
            }
        }
    }

    fn present(&self, image: Acquired) -> Result<Result<Fit, Fit>, GpuError> {
        let filled = [self.images[image.index as usize].filled];
        let (swapchains, indices) = ([self.raw], [image.index]);
        let info =
            vk::PresentInfoKHR::default().wait_semaphores(&filled).swapchains(&swapchains).image_indices(&indices);
        // SAFETY: the image was acquired, a submission signals the semaphore, and no other thread uses the queue.
        match self.device.with_queue(|queue| unsafe { self.functions.queue_present(queue, &info) }) {
            Ok(false) => Ok(Ok(Fit::Good)),
            Ok(true) => Ok(Ok(Fit::Outdated)),
            Err(result) => {
                unfit(result).map(Err).ok_or(GpuError::Call { operation: "show a window image".into(), result })
            }
        }
    }
}

impl WindowImage<'_> {
    /// Records the filling of the image: `background`, upon it these columns of each picture, each pixel on one of the
    /// window's, the pictures' first at `corner`, upon that what `draw_widgets` draws.
    pub fn fill(
        self,
        recorder: &mut Recorder,
        background: [f32; 4],
        pictures: &[(&Resource, Range<u32>)],
        corner: [u32; 2],
        draw_widgets: impl FnOnce(vk::CommandBuffer),
    ) -> Result<Filled, GpuError> {
        self.swapchain.record(recorder, self.image, background, pictures, corner, draw_widgets)?;
        Ok(Filled(()))
    }
}

impl Drop for Swapchain {
    fn drop(&mut self) {
        let raw = &self.device.raw;
        // On a lost device nothing runs, and there is nobody to report it to.
        // SAFETY: the device is alive; no other thread uses the queue.
        let _ = self.device.with_queue(|queue| unsafe { raw.queue_wait_idle(queue) });
        // SAFETY: all that was submitted and shown has ended; null handles are ignored.
        unsafe {
            for image in &self.images {
                raw.destroy_framebuffer(image.framebuffer, None);
                raw.destroy_image_view(image.view, None);
                raw.destroy_semaphore(image.filled, None);
            }
            for semaphore in self.acquired {
                raw.destroy_semaphore(semaphore, None);
            }
            raw.destroy_render_pass(self.render_pass, None);
            self.functions.destroy_swapchain(self.raw, None);
        }
    }
}

/// A window that is not seen may get no image for as long as it is not; its events must still be answered.
const PATIENCE_NS: u64 = 50_000_000;

const ACQUIRE: &str = "get a window image";

const IMAGE_USE: vk::ImageUsageFlags = vk::ImageUsageFlags::from_raw(
    vk::ImageUsageFlags::COLOR_ATTACHMENT.as_raw() | vk::ImageUsageFlags::TRANSFER_DST.as_raw(),
);

const COLOR: vk::ImageSubresourceRange = vk::ImageSubresourceRange {
    aspect_mask: vk::ImageAspectFlags::COLOR,
    base_mip_level: 0,
    level_count: 1,
    base_array_layer: 0,
    layer_count: 1,
};

fn create_semaphore(device: &Device, name: &str) -> Result<vk::Semaphore, GpuError> {
    // SAFETY: the device is alive.
    let semaphore = unsafe { device.raw.create_semaphore(&vk::SemaphoreCreateInfo::default(), None) }
        .map_err(GpuError::call(|| format!("create the semaphore '{name}'")))?;
    device.set_name(semaphore, name);
    Ok(semaphore)
}

/// One pass over an image that holds the picture, for the widgets; it leaves the image ready to be shown.
fn create_render_pass(device: &Device, format: vk::Format) -> Result<vk::RenderPass, GpuError> {
    let attachments = [vk::AttachmentDescription::default()
        .format(format)
        .samples(vk::SampleCountFlags::TYPE_1)
        .load_op(vk::AttachmentLoadOp::LOAD)
        .store_op(vk::AttachmentStoreOp::STORE)
        .stencil_load_op(vk::AttachmentLoadOp::DONT_CARE)
        .stencil_store_op(vk::AttachmentStoreOp::DONT_CARE)
        .initial_layout(vk::ImageLayout::TRANSFER_DST_OPTIMAL)
        .final_layout(vk::ImageLayout::PRESENT_SRC_KHR)];
    let colors = [vk::AttachmentReference::default().attachment(0).layout(vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL)];
    let subpasses = [vk::SubpassDescription::default()
        .pipeline_bind_point(vk::PipelineBindPoint::GRAPHICS)
        .color_attachments(&colors)];
    let dependencies = [vk::SubpassDependency::default()
        .src_subpass(vk::SUBPASS_EXTERNAL)
        .dst_subpass(0)
        .src_stage_mask(vk::PipelineStageFlags::TRANSFER)
        .src_access_mask(vk::AccessFlags::TRANSFER_WRITE)
        .dst_stage_mask(vk::PipelineStageFlags::COLOR_ATTACHMENT_OUTPUT)
        .dst_access_mask(vk::AccessFlags::COLOR_ATTACHMENT_READ | vk::AccessFlags::COLOR_ATTACHMENT_WRITE)];
    let info =
        vk::RenderPassCreateInfo::default().attachments(&attachments).subpasses(&subpasses).dependencies(&dependencies);
    // SAFETY: the device is alive; `info` lives through the call.
    let render_pass = unsafe { device.raw.create_render_pass(&info, None) }
        .map_err(GpuError::call(|| "create the widgets' render pass"))?;
    device.set_name(render_pass, "widgets");
    Ok(render_pass)
}
