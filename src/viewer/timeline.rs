//! Which time of a scene that moves the window shows.

use std::time::Duration;

use crate::scene::picture_at;

/// Of one scene; playing goes on from its end at its beginning.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Timeline {
    /// From the animation's start; `None`: the scene is shown as its file has it.
    pub seconds: Option<f64>,
    /// Whether time goes on by itself.
    pub is_playing: bool,
    /// Pictures a second: those are shown that `zerkalo animate --fps` draws.
    pub rate: f64,
    /// Whether the camera moves as the animation says, and not as the user.
    pub follows_camera: bool,
}

impl Default for Timeline {
    fn default() -> Self {
        Self { seconds: None, is_playing: false, rate: 30.0, follows_camera: true }
    }
}

impl Timeline {
    /// Pictures a second that can be chosen.
    pub const RATES: [f64; 2] = [0.1, 1000.0];

    /// Numbers brought into their ranges, in a scene that moves for so long.
    pub(super) fn clamped(self, duration_seconds: f64) -> Self {
        let [slowest, fastest] = Self::RATES;
        Self {
            seconds: self.seconds.map(|seconds| seconds.clamp(0.0, duration_seconds)),
            rate: self.rate.clamp(slowest, fastest),
            is_playing: self.is_playing && self.seconds.is_some(),
            ..self
        }
    }

    /// The time of the last picture that is not after [`Timeline::seconds`].
    pub fn picture_seconds(&self) -> Option<f64> {
        self.seconds.map(|seconds| picture_at(seconds, self.rate) as f64 / self.rate)
    }

    /// Played where it stands still, from the beginning where it has no time yet, and the other way round.
    pub(super) fn toggled(self) -> Self {
        Self { seconds: self.seconds.or(Some(0.0)), is_playing: !self.is_playing, ..self }
    }

    /// So much later, where time goes on.
    pub(super) fn after(self, elapsed: Duration, duration_seconds: f64) -> Self {
        let Some(seconds) = self.seconds.filter(|_| self.is_playing) else { return self };
        let later = seconds + elapsed.as_secs_f64();
        let is_within = later <= duration_seconds || duration_seconds <= 0.0;
        Self { seconds: Some(if is_within { later } else { later % duration_seconds }), ..self }
    }

    /// Until another picture is to be shown, where time goes on.
    pub(super) fn until_next_picture(&self) -> Option<Duration> {
        let seconds = self.seconds.filter(|_| self.is_playing)?;
        let next = (picture_at(seconds, self.rate) + 1) as f64 / self.rate;
        Some(Duration::from_secs_f64((next - seconds).max(0.0)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLAYING: Timeline = Timeline { seconds: Some(3.5), is_playing: true, rate: 10.0, follows_camera: true };

    #[test]
    fn time_goes_on_while_it_plays_and_begins_again_at_its_end() {
        let after = |timeline: Timeline, ms| timeline.after(Duration::from_millis(ms), 4.0).seconds;
        assert_eq!([0, 250, 500, 750].map(|ms| after(PLAYING, ms)), [3.5, 3.75, 4.0, 0.25].map(Some));
        assert_eq!(after(Timeline { is_playing: false, ..PLAYING }, 250), Some(3.5));
        assert_eq!(after(Timeline::default(), 250), None);
        assert!(PLAYING.after(Duration::from_secs(1), 0.0).clamped(0.0).seconds == Some(0.0), "of one keyframe");
    }

    #[test]
    fn pictures_are_those_of_the_rate() {
        let at = |seconds| Timeline { seconds: Some(seconds), ..PLAYING };
        assert_eq!([0.0, 0.099, 0.1, 0.3, 3.99].map(|s| at(s).picture_seconds()), [0.0, 0.0, 0.1, 0.3, 3.9].map(Some));
        let wait = at(3.55).until_next_picture().unwrap().as_secs_f64();
        assert!((wait - 0.05).abs() < 1e-9, "{wait}");
        assert_eq!(Timeline { is_playing: false, ..at(1.0) }.until_next_picture(), None);
    }

    #[test]
    fn numbers_are_brought_into_their_ranges() {
        let wild = Timeline { seconds: Some(7.0), rate: 0.0, ..PLAYING };
        assert_eq!(wild.clamped(4.0), Timeline { seconds: Some(4.0), rate: 0.1, ..PLAYING });
        assert!(!Timeline { seconds: None, ..PLAYING }.clamped(4.0).is_playing);
    }
}
