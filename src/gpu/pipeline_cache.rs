//! Compiled pipelines kept between runs, in the user's cache folder.
//!
//! Nothing here can fail a run: a cache that is missing, cut short, damaged, or another device's is not used, and one
//! that cannot be written is not kept.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Mutex;

use ash::vk;
use directories::ProjectDirs;

use crate::whole_file::WholeFile;

/// In front of the driver's data: this magic, then the CRC-32 of the data. Drivers check their own header, but not
/// all of them check the rest.
const MAGIC: [u8; 8] = *b"zerkalo1";

/// A cache only grows; past this it is begun anew. A kernel's code takes some tens of kilobytes.
const LARGEST_BYTES: u64 = 64 << 20;

pub(super) struct PipelineCache {
    pub raw: vk::PipelineCache,
    path: Option<PathBuf>,
    /// CRC-32 of what the file holds.
    saved: Mutex<u32>,
}

impl PipelineCache {
    pub fn new(device: &ash::Device, identity: ([u32; 2], [u8; vk::UUID_SIZE])) -> Self {
        let path = cache_path(identity);
        let data = path.as_deref().and_then(|path| read(path, identity)).unwrap_or_default();
        let create = |data: &[u8]| {
            let info = vk::PipelineCacheCreateInfo::default().initial_data(data);
            // SAFETY: the device is alive and `data` lives through the call.
            unsafe { device.create_pipeline_cache(&info, None) }
        };
        // A null cache is legal in every use of it.
        let raw = create(&data).or_else(|_| create(&[])).unwrap_or(vk::PipelineCache::null());
        Self { raw, path, saved: Mutex::new(crc32fast::hash(&data)) }
    }

    /// Writes what was compiled since to the file.
    pub fn save(&self, device: &ash::Device) {
        let Some(path) = &self.path else { return };
        if self.raw == vk::PipelineCache::null() {
            return;
        }
        // SAFETY: the cache was made from this device.
        let Ok(data) = (unsafe { device.get_pipeline_cache_data(self.raw) }) else { return };
        let checksum = crc32fast::hash(&data);
        let mut saved = self.saved.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        if checksum != *saved && write(path, &data).is_ok() {
            *saved = checksum;
        }
    }

    /// # Safety
    /// No pipeline is being created with it, and it is not used afterwards.
    pub unsafe fn destroy(&self, device: &ash::Device) {
        // SAFETY: the caller's word; null is ignored.
        unsafe { device.destroy_pipeline_cache(self.raw, None) };
    }
}

fn cache_path(([vendor, device], uuid): ([u32; 2], [u8; vk::UUID_SIZE])) -> Option<PathBuf> {
    let uuid: String = uuid.iter().map(|byte| format!("{byte:02x}")).collect();
    let folders = ProjectDirs::from("", "", "zerkalo")?;
    Some(folders.cache_dir().join(format!("pipelines-{vendor:x}-{device:x}-{uuid}.bin")))
}

fn read(path: &Path, identity: ([u32; 2], [u8; vk::UUID_SIZE])) -> Option<Vec<u8>> {
    if fs::metadata(path).ok()?.len() > LARGEST_BYTES {
        return None;
    }
    let data = unwrap_checked(&fs::read(path).ok()?)?.to_vec();
    has_header_of(&data, identity).then_some(data)
}

fn write(path: &Path, data: &[u8]) -> std::io::Result<()> {
    fs::create_dir_all(path.parent().unwrap_or(Path::new(".")))?;
    let mut file = WholeFile::create(path)?;
    let output = file.as_file_mut();
    output.write_all(&MAGIC)?;
    output.write_all(&crc32fast::hash(data).to_le_bytes())?;
    output.write_all(data)?;
    file.finish()
}

fn unwrap_checked(file: &[u8]) -> Option<&[u8]> {
    let (checksum, data) = file.strip_prefix(&MAGIC)?.split_first_chunk::<4>()?;
    (u32::from_le_bytes(*checksum) == crc32fast::hash(data)).then_some(data)
}

/// The header every driver must write: length, version 1, vendor, device, UUID (VkPipelineCacheHeaderVersionOne).
fn has_header_of(data: &[u8], ([vendor, device], uuid): ([u32; 2], [u8; vk::UUID_SIZE])) -> bool {
    let word =
        |at: usize| data.get(at..at + 4).map(|bytes| u32::from_ne_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]));
    word(4) == Some(1) && word(8) == Some(vendor) && word(12) == Some(device) && data.get(16..32) == Some(&uuid[..])
}

#[cfg(test)]
mod tests {
    use super::*;

    const IDENTITY: ([u32; 2], [u8; vk::UUID_SIZE]) = ([0x1002, 7], [9; vk::UUID_SIZE]);

    fn driver_data() -> Vec<u8> {
        let mut data = Vec::new();
        for word in [32_u32, 1, 0x1002, 7] {
            data.extend(word.to_ne_bytes());
        }
        data.extend([9; vk::UUID_SIZE]);
        data.extend(b"compiled code");
        data
    }

    #[test]
    fn a_written_cache_is_read_again() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("deep/cache.bin");
        write(&path, &driver_data()).unwrap();
        assert_eq!(read(&path, IDENTITY), Some(driver_data()));
    }

    #[test]
    fn a_damaged_cut_or_foreign_cache_is_ignored() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("cache.bin");
        assert_eq!(read(&path, IDENTITY), None);
        write(&path, &driver_data()).unwrap();
        assert_eq!(read(&path, ([0x10de, 7], [9; vk::UUID_SIZE])), None, "another vendor's");

        let whole = fs::read(&path).unwrap();
        for at in 0..whole.len() {
            let mut damaged = whole.clone();
            damaged[at] ^= 0x40;
            fs::write(&path, &damaged).unwrap();
            assert_eq!(read(&path, IDENTITY), None, "byte {at} flipped");
            fs::write(&path, &whole[..at]).unwrap();
            assert_eq!(read(&path, IDENTITY), None, "cut after {at} bytes");
        }
    }
}
