//! The accurate picture, traced on the CPU while the window goes on.

use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::sync::mpsc::{self, Receiver, TryRecvError};

use crate::frame::Frame;
use crate::reference;
use crate::scene::Scene;

/// One picture being traced; dropped, it stops.
pub struct ReferenceWorker {
    pub scene: Scene,
    pub size: [u32; 2],
    rows_done: Arc<AtomicU32>,
    is_cancelled: Arc<AtomicBool>,
    result: Receiver<Result<Frame, String>>,
}

impl ReferenceWorker {
    /// `wake` is called at every row and at the end, from another thread.
    pub fn start(scene: Scene, size: [u32; 2], wake: impl Fn() + Send + Sync + 'static) -> Self {
        let (sender, result) = mpsc::channel();
        let (rows_done, is_cancelled) = (Arc::new(AtomicU32::new(0)), Arc::new(AtomicBool::new(false)));
        let worker = Self {
            scene: scene.clone(),
            size,
            rows_done: rows_done.clone(),
            is_cancelled: is_cancelled.clone(),
            result,
        };
        std::thread::spawn(move || {
            let rendered = trace(&scene, size, &|done| {
                rows_done.store(done, Ordering::Relaxed);
                wake();
                if is_cancelled.load(Ordering::Relaxed) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            });
            // Nobody listens to a worker that was dropped.
            let _ = sender.send(rendered);
            wake();
        });
        worker
    }

    /// Share of the rows that are traced.
    pub fn progress(&self) -> f32 {
        self.rows_done.load(Ordering::Relaxed) as f32 / self.size[1] as f32
    }

    /// The picture, once it is there, or why there is none.
    pub fn take(&self) -> Option<Result<Frame, String>> {
        match self.result.try_recv() {
            Ok(result) => Some(result),
            Err(TryRecvError::Empty) => None,
            Err(TryRecvError::Disconnected) => Some(Err("the tracing thread ended without a picture".to_owned())),
        }
    }
}

impl Drop for ReferenceWorker {
    fn drop(&mut self) {
        self.is_cancelled.store(true, Ordering::Relaxed);
    }
}

fn trace(
    scene: &Scene,
    [width, height]: [u32; 2],
    progress: &(dyn Fn(u32) -> ControlFlow<()> + Sync),
) -> Result<Frame, String> {
    let mut frame = Frame::new(width, height).map_err(|error| error.to_string())?;
    let image = reference::render(scene, width, height, progress).map_err(|error| error.to_string())?;
    frame.pixels_mut().copy_from_slice(&image.to_f32());
    Ok(frame)
}

#[cfg(test)]
mod tests {
    use std::time::{Duration, Instant};

    use super::*;
    use crate::scene::gallery;

    fn wait_for(worker: &ReferenceWorker) -> Result<Frame, String> {
        let start = Instant::now();
        loop {
            if let Some(result) = worker.take() {
                return result;
            }
            assert!(start.elapsed() < Duration::from_secs(120), "the worker answers");
            std::thread::sleep(Duration::from_millis(5));
        }
    }

    #[test]
    fn the_workers_picture_is_the_references() {
        let scene = gallery::scene("four").unwrap();
        let worker = ReferenceWorker::start(scene.clone(), [32, 16], || {});
        let frame = wait_for(&worker).unwrap();
        let direct = reference::render(&scene, 32, 16, &|_| ControlFlow::Continue(())).unwrap();
        assert_eq!(frame.pixels(), direct.to_f32());
        assert_eq!(worker.progress(), 1.0);
    }

    #[test]
    fn a_dropped_worker_stops() {
        let (sender, ended) = mpsc::channel();
        let ended_sender = std::sync::Mutex::new(sender);
        let worker = ReferenceWorker::start(gallery::scene("showcase").unwrap(), [4000, 4000], move || {
            let _ = ended_sender.lock().unwrap().send(());
        });
        ended.recv().unwrap();
        drop(worker);
        // The channel closes when the thread lets go of its end.
        let start = Instant::now();
        while ended.recv_timeout(Duration::from_secs(60)).is_ok() {
            assert!(start.elapsed() < Duration::from_secs(60), "it goes on for no one");
        }
    }
}
