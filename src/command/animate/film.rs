//! Where an animation's pictures go, on a thread of its own, so that the device need not wait for files.

use std::fs;
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::thread::{self, JoinHandle};

use anyhow::{Context, Result, anyhow};

use crate::frame::{AnimatedPng, Frame};
use crate::tracer::TracerError;
use crate::whole_file::WholeFile;

/// Pictures that wait to be written, at most.
const WAITING: usize = 2;

/// A picture of an animation.
pub struct Numbered {
    pub number: u64,
    pub frame: Frame,
}

/// What `-o` names.
#[derive(Debug, Clone, PartialEq)]
pub enum Target {
    /// A file for each picture; its number stands between the two, with so many digits at least.
    Many {
        before: String,
        digits: usize,
        after: String,
    },
    Apng(PathBuf),
    /// What FFmpeg calls it.
    Video(PathBuf, &'static str),
}

impl Target {
    /// # Errors
    /// It is none that animations are written to.
    pub fn of(path: &Path) -> Result<Self> {
        let extension = path.extension().unwrap_or_default().to_ascii_lowercase();
        let rule = "an animation is written to frames/%04d.png or .exr, or to one .apng, .mp4 or .webm";
        let refused = || TracerError::Refused(format!("-o {path:?}: {rule}"));
        match extension.to_str() {
            Some("apng") => Ok(Self::Apng(path.to_owned())),
            Some("mp4") => Ok(Self::Video(path.to_owned(), "mp4")),
            Some("webm") => Ok(Self::Video(path.to_owned(), "webm")),
            Some("png" | "exr") => Ok(path.to_str().and_then(numbered).ok_or_else(refused)?),
            _ => Err(refused().into()),
        }
    }

    pub fn is_many(&self) -> bool {
        matches!(self, Self::Many { .. })
    }

    /// Of a picture, where each has a file.
    fn path_of(&self, number: u64) -> Option<PathBuf> {
        match self {
            Self::Many { before, digits, after } => Some(format!("{before}{number:0digits$}{after}").into()),
            Self::Apng(_) | Self::Video(..) => None,
        }
    }

    /// Whether a picture's file is there, all of it, and of this size, pixels.
    pub fn has_whole(&self, number: u64, size: [u32; 2]) -> bool {
        let frame = self.path_of(number).filter(|path| path.exists()).and_then(|path| Frame::load(&path).ok());
        frame.is_some_and(|frame| [frame.width(), frame.height()] == size)
    }
}

/// A name with one `%d` or `%0Nd` in it.
fn numbered(name: &str) -> Option<Target> {
    let (before, rest) = name.split_once('%')?;
    let (digits, after) = rest.split_once('d')?;
    let digits = match digits {
        "" => 1,
        digits => digits.strip_prefix('0')?.parse().ok().filter(|digits| (1..=18).contains(digits))?,
    };
    let target = Target::Many { before: before.to_owned(), digits, after: after.to_owned() };
    (!after.contains('%')).then_some(target)
}

/// What is being written.
pub struct Film {
    pictures: SyncSender<Numbered>,
    writer: JoinHandle<Result<Reel>>,
}

/// What the pictures are written to.
enum Reel {
    Many(Target),
    Apng(Box<AnimatedPng>),
    Video { file: WholeFile, ffmpeg: Child, name: String },
}

impl Film {
    /// Of so many pictures.
    ///
    /// # Errors
    /// Nothing can be written there.
    pub fn begin(target: Target, size: [u32; 2], fps: f64, count: usize, ffmpeg: &Path) -> Result<Self> {
        let reel = match target {
            Target::Many { .. } => {
                if let Some(path) = target.path_of(0) {
                    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
                    if let Some(folder) = folder {
                        fs::create_dir_all(folder).with_context(|| format!("could not create folder {folder:?}"))?;
                    }
                    // Of any number: a folder that cannot be written to is told before anything is drawn.
                    Frame::check_output_path(&path)?;
                }
                Reel::Many(target)
            }
            Target::Apng(path) => Reel::Apng(Box::new(AnimatedPng::create(&path, size, count, fps)?)),
            Target::Video(path, container) => Reel::video(&path, container, size, fps, ffmpeg)?,
        };
        let (pictures, waiting) = sync_channel(WAITING);
        let writer = thread::Builder::new().name("film".to_owned()).spawn(move || reel.expose(&waiting));
        Ok(Self { pictures, writer: writer.context("no thread to write pictures with")? })
    }

    /// Takes the next picture; false where the ones before could not be written, which [`Film::end`] says.
    pub fn take(&self, picture: Numbered) -> bool {
        self.pictures.send(picture).is_ok()
    }

    /// When all that were taken are written. One file of all pictures is kept only if they are all.
    ///
    /// # Errors
    /// Something could not be written.
    pub fn end(self, has_all: bool) -> Result<()> {
        let Self { pictures, writer } = self;
        drop(pictures);
        let reel = writer.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))?;
        if has_all { reel.finish() } else { reel.discard() }
    }
}

impl Reel {
    fn video(path: &Path, container: &str, size: [u32; 2], fps: f64, ffmpeg: &Path) -> Result<Self> {
        let file = WholeFile::create(path).with_context(|| format!("could not write {path:?}"))?;
        let [width, height] = size;
        let mut command = Command::new(ffmpeg);
        command.args(["-loglevel", "error", "-y", "-f", "rawvideo", "-pix_fmt", "rgb24"]);
        command.args(["-video_size", &format!("{width}x{height}"), "-framerate", &fps.to_string(), "-i", "-"]);
        // Players want colours of 2x2 pixels, and so sides that are even.
        command.args(["-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p", "-f", container]);
        command.arg(file.temporary_path());
        // Ctrl-C is for this program, which ends FFmpeg itself.
        #[cfg(unix)]
        std::os::unix::process::CommandExt::process_group(&mut command, 0);
        let child = command.stdin(Stdio::piped()).stdout(Stdio::null()).stderr(Stdio::piped()).spawn();
        let ffmpeg = child.map_err(|error| match error.kind() {
            io::ErrorKind::NotFound => anyhow!(
                "{} is not installed; Debian's package is ffmpeg, --ffmpeg names another program, and .apng or \
                 frames/%04d.png need none",
                ffmpeg.display()
            ),
            _ => anyhow!("{} could not be run: {error}", ffmpeg.display()),
        })?;
        Ok(Self::Video { file, ffmpeg, name: format!("{path:?}") })
    }

    /// Writes pictures until there come no more.
    fn expose(mut self, waiting: &Receiver<Numbered>) -> Result<Self> {
        while let Ok(Numbered { number, frame }) = waiting.recv() {
            match &mut self {
                Self::Many(target) => {
                    if let Some(path) = target.path_of(number) {
                        frame.save(&path)?;
                    }
                }
                Self::Apng(apng) => apng.add(&frame)?,
                Self::Video { ffmpeg, name, .. } => {
                    let input = ffmpeg.stdin.as_mut().ok_or_else(|| anyhow!("FFmpeg takes no pictures"))?;
                    if let Err(error) = input.write_all(&frame.display_bytes()) {
                        return Err(anyhow!("could not write {name}: {}", last_words(ffmpeg, &error.to_string())));
                    }
                }
            }
        }
        Ok(self)
    }

    fn finish(self) -> Result<()> {
        match self {
            Self::Many(_) => Ok(()),
            Self::Apng(apng) => Ok(apng.finish()?),
            Self::Video { file, mut ffmpeg, name } => {
                drop(ffmpeg.stdin.take());
                let status = ffmpeg.wait().context("FFmpeg")?;
                if !status.success() {
                    return Err(anyhow!("could not write {name}: {}", last_words(&mut ffmpeg, &status.to_string())));
                }
                file.finish().with_context(|| format!("could not write {name}"))
            }
        }
    }

    /// Keeps nothing of one file of all pictures.
    fn discard(self) -> Result<()> {
        if let Self::Video { mut ffmpeg, .. } = self {
            // It may have ended by itself.
            let _ = ffmpeg.kill();
            ffmpeg.wait().context("FFmpeg")?;
        }
        Ok(())
    }
}

/// What FFmpeg says of its end, in one line, else `otherwise`.
fn last_words(ffmpeg: &mut Child, otherwise: &str) -> String {
    drop(ffmpeg.stdin.take());
    let mut words = String::new();
    let read = ffmpeg.stderr.take().map(|mut stderr| stderr.read_to_string(&mut words));
    // Nothing more can be known of it.
    let _ = ffmpeg.wait();
    let line = words.lines().rev().find(|line| !line.trim().is_empty());
    match (read, line) {
        (Some(Ok(_)), Some(line)) => format!("FFmpeg: {}", line.trim().escape_debug()),
        _ => format!("FFmpeg: {otherwise}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_the_digits_that_the_name_asks_for() {
        let path = |name: &str| Target::of(Path::new(name)).unwrap().path_of(7).unwrap();
        assert_eq!(path("a/%04d.png"), Path::new("a/0007.png"));
        assert_eq!(path("x%d.EXR"), Path::new("x7.EXR"));
        assert_eq!(path("%02d-left.png"), Path::new("07-left.png"));
        for bad in ["a.png", "%s.png", "%4d.png", "%0d.png", "%d%d.png", "%d.jpg", "a%d", "", "%099d.png", "film.gif"] {
            assert!(Target::of(Path::new(bad)).is_err(), "{bad}");
        }
        assert_eq!(Target::of(Path::new("a.WEBM")).unwrap(), Target::Video("a.WEBM".into(), "webm"));
    }
}
