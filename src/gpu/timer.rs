use std::sync::Arc;

use ash::vk;

use super::device::Device;
use super::error::GpuError;

/// Measures GPU time between two points of a command buffer.
pub struct Timer {
    pub(super) pool: vk::QueryPool,
    device: Arc<Device>,
}

impl Timer {
    /// `None` where the device's queue has no timestamps.
    pub fn new(device: &Arc<Device>, name: &str) -> Result<Option<Arc<Self>>, GpuError> {
        if device.timestamp_valid_bits == 0 {
            return Ok(None);
        }
        let info = vk::QueryPoolCreateInfo::default().query_type(vk::QueryType::TIMESTAMP).query_count(2);
        // SAFETY: the device is alive.
        let pool = unsafe { device.raw.create_query_pool(&info, None) }
            .map_err(GpuError::call(|| format!("create timer '{name}'")))?;
        device.set_name(pool, name);
        Ok(Some(Arc::new(Self { pool, device: device.clone() })))
    }

    /// GPU time between start and stop of the last submission that used the timer, which must have been waited for.
    pub fn elapsed_ns(&self) -> Result<u64, GpuError> {
        let mut ticks = [0_u64; 2];
        // SAFETY: both queries were written by a submission that has ended.
        unsafe { self.device.raw.get_query_pool_results(self.pool, 0, &mut ticks, vk::QueryResultFlags::TYPE_64) }
            .map_err(GpuError::call(|| "read the timestamps"))?;
        Ok(ticks_to_ns(ticks, self.device.timestamp_valid_bits, self.device.timestamp_period_ns))
    }
}

impl Drop for Timer {
    fn drop(&mut self) {
        // SAFETY: submissions are waited for before their resources can be dropped.
        unsafe { self.device.raw.destroy_query_pool(self.pool, None) };
    }
}

/// Subtracts as integers, since large counts lose their last digits as floats; a counter that wrapped once between
/// start and stop still gives the right difference.
fn ticks_to_ns([start, stop]: [u64; 2], valid_bits: u32, period_ns: f32) -> u64 {
    let mask = u64::MAX >> (64 - valid_bits);
    ((stop.wrapping_sub(start) & mask) as f64 * f64::from(period_ns)).round() as u64
}

#[cfg(test)]
mod tests {
    use super::ticks_to_ns;

    #[test]
    fn ticks_are_subtracted_before_they_are_scaled() {
        assert_eq!(ticks_to_ns([u64::MAX - 10, u64::MAX - 3], 64, 1.0), 7);
        assert_eq!(ticks_to_ns([1 << 60, (1 << 60) + 3], 64, 0.5), 2);
    }

    #[test]
    fn a_counter_may_wrap_between_start_and_stop() {
        assert_eq!(ticks_to_ns([(1 << 36) - 5, 5], 36, 1.0), 10);
        assert_eq!(ticks_to_ns([u64::MAX, 4], 64, 1.0), 5);
    }
}
