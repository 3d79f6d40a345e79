//! Which of the measured settings is meant. Pure: of numbers only.

use serde::Serialize;

/// What a choice looks at.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Candidate {
    /// Largest error of a linear channel, measured; infinite where it is not known.
    pub error: f64,
    /// Time of a frame.
    pub time_ns: f64,
    /// Proven bound on what is left out.
    pub bound: Option<f64>,
}

/// What users ask.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Question {
    /// The fastest setting whose error is at most that.
    Error(f64),
    /// The most accurate setting that draws so many frames a second.
    Fps(f64),
}

/// Times that differ by less are as good as the same: a median of a few frames has no more precision.
const TIE: f64 = 0.03;

/// Errors that differ by less are the same.
const SAME_ERROR: f64 = 1e-3;

/// A setting within that of the fastest, or of the allowed time, may be the true answer: it is measured once more.
const RIVALRY: f64 = 0.15;

/// So many at most are measured once more.
const MOST_CONTENDERS: usize = 6;

impl Question {
    /// The longest allowed time of a frame, where one is asked for.
    fn longest_ns(self) -> Option<f64> {
        match self {
            Self::Error(_) => None,
            Self::Fps(fps) => Some(1e9 / fps),
        }
    }

    /// Index of the answer; `None` where no candidate will do.
    ///
    /// Among the fastest, which tie, a bound that proves the error goes first, then the smaller error. Among the most
    /// accurate, whose errors are the same, the faster one.
    pub fn answer(self, candidates: &[Candidate]) -> Option<usize> {
        match self {
            Self::Error(error) => {
                let keeping = || places(candidates, |candidate| candidate.error <= error);
                let fastest_ns = least(keeping().map(|place| candidates[place].time_ns))?;
                let tied = keeping().filter(|&place| candidates[place].time_ns <= fastest_ns * (1.0 + TIE));
                let rank = |place: usize| {
                    let Candidate { error: own, time_ns, bound } = candidates[place];
                    (bound.is_none_or(|bound| bound > error), own, time_ns)
                };
                tied.min_by(|&a, &b| {
                    let (a, b) = (rank(a), rank(b));
                    a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)).then(a.2.total_cmp(&b.2))
                })
            }
            Self::Fps(fps) => {
                let reaching = || places(candidates, |candidate| candidate.time_ns <= 1e9 / fps);
                let least_error = least(reaching().map(|place| candidates[place].error))?;
                let same = reaching().filter(|&place| candidates[place].error <= least_error * (1.0 + SAME_ERROR));
                same.min_by(|&a, &b| candidates[a].time_ns.total_cmp(&candidates[b].time_ns))
            }
        }
    }
}

/// Indices of the candidates that could be the answer if their times were measured better, the likeliest first.
pub fn contenders(question: Question, candidates: &[Candidate]) -> Vec<usize> {
    let by = |key: fn(&Candidate) -> f64, mut places: Vec<usize>| {
        places.sort_by(|&a, &b| key(&candidates[a]).total_cmp(&key(&candidates[b])));
        places.truncate(MOST_CONTENDERS);
        places
    };
    match (question, question.longest_ns()) {
        (Question::Error(error), _) => {
            let keeping = || places(candidates, |candidate| candidate.error <= error);
            let Some(fastest_ns) = least(keeping().map(|place| candidates[place].time_ns)) else { return Vec::new() };
            let near = keeping().filter(|&place| candidates[place].time_ns <= fastest_ns * (1.0 + RIVALRY));
            by(|candidate| candidate.time_ns, near.collect())
        }
        (Question::Fps(_), longest_ns) => {
            let longest_ns = longest_ns.unwrap_or(f64::INFINITY);
            // Surely fast enough, however the times turn out; only better ones are of interest.
            let sure = places(candidates, |candidate| candidate.time_ns <= longest_ns * (1.0 - RIVALRY));
            let least_error = least(sure.map(|place| candidates[place].error)).unwrap_or(f64::INFINITY);
            let near = places(candidates, |candidate| {
                (candidate.time_ns / longest_ns - 1.0).abs() <= RIVALRY && candidate.error < least_error
            });
            by(|candidate| candidate.error, near.collect())
        }
    }
}

fn places<'a>(
    candidates: &'a [Candidate],
    is_wanted: impl Fn(&Candidate) -> bool + 'a,
) -> impl Iterator<Item = usize> + 'a {
    let is_measured = |candidate: &Candidate| candidate.error.is_finite() && candidate.time_ns.is_finite();
    (0..candidates.len()).filter(move |&place| is_measured(&candidates[place]) && is_wanted(&candidates[place]))
}

fn least(values: impl Iterator<Item = f64>) -> Option<f64> {
    values.min_by(f64::total_cmp)
}

/// The Pareto front: nothing else is both as accurate and as fast, and better in one of the two.
pub fn front(candidates: &[Candidate]) -> Vec<bool> {
    let beats = |a: &Candidate, b: &Candidate| {
        a.error <= b.error && a.time_ns <= b.time_ns && (a.error < b.error || a.time_ns < b.time_ns)
    };
    let is_of_front =
        |candidate: &Candidate| candidate.error.is_finite() && !candidates.iter().any(|other| beats(other, candidate));
    candidates.iter().map(is_of_front).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn candidate(error: f64, time_ms: f64, bound: Option<f64>) -> Candidate {
        Candidate { error, time_ns: time_ms * 1e6, bound }
    }

    /// Errors and times, nothing proven.
    fn measured<const N: usize>(points: [(f64, f64); N]) -> [Candidate; N] {
        points.map(|(error, time_ms)| candidate(error, time_ms, None))
    }

    #[test]
    fn the_front_is_what_nothing_beats() {
        let points =
            measured([(0.1, 5.0), (0.01, 10.0), (0.02, 12.0), (0.1, 6.0), (0.001, 30.0), (f64::INFINITY, 1.0)]);
        assert_eq!(front(&points), [true, true, false, false, true, false]);
        assert_eq!(front(&measured([(0.1, 5.0), (0.1, 5.0)])), [true, true], "twins");
        assert!(front(&[]).is_empty());
    }

    #[test]
    fn the_fastest_that_keeps_the_error_is_chosen() {
        let points = measured([(0.1, 5.0), (0.01, 10.0), (0.001, 30.0), (f64::INFINITY, 1.0)]);
        for (error, place) in [(1.0, 0), (0.1, 0), (0.0999, 1), (0.001, 2)] {
            assert_eq!(Question::Error(error).answer(&points), Some(place), "{error}");
        }
        assert_eq!(Question::Error(0.0).answer(&points), None);
        assert_eq!(Question::Error(1.0).answer(&[]), None);
    }

    #[test]
    fn of_times_that_tie_a_proof_goes_first_and_then_the_smaller_error() {
        let mut points = measured([(0.010, 10.0), (0.002, 10.2), (0.009, 10.1), (0.0001, 10.4)]);
        assert_eq!(Question::Error(0.01).answer(&points), Some(1), "the last is 4 % slower");
        points[2].bound = Some(0.0095);
        assert_eq!(Question::Error(0.01).answer(&points), Some(2));
        points[2].bound = Some(0.011);
        assert_eq!(Question::Error(0.01).answer(&points), Some(1), "a bound above what is asked for proves nothing");
    }

    #[test]
    fn the_most_accurate_that_is_fast_enough_is_chosen() {
        let points = measured([(0.1, 5.0), (0.01, 10.0), (0.01, 8.0), (0.001, 30.0)]);
        for (fps, place) in [(10.0, 3), (33.3, 3), (34.0, 2), (125.0, 2), (126.0, 0)] {
            assert_eq!(Question::Fps(fps).answer(&points), Some(place), "{fps}");
        }
        assert_eq!(Question::Fps(201.0).answer(&points), None);
    }

    #[test]
    fn what_noise_may_have_put_behind_is_measured_once_more() {
        let points = measured([(0.1, 5.0), (0.01, 10.0), (0.009, 11.0), (0.01, 11.6), (0.001, 30.0)]);
        assert_eq!(contenders(Question::Error(0.01), &points), [1, 2]);
        assert!(contenders(Question::Error(1e-9), &points).is_empty());
        // 100 frames a second: 10 ms.
        assert_eq!(contenders(Question::Fps(100.0), &points), [2, 1], "11.6 ms is out of reach, 5 ms certain");
        assert_eq!(contenders(Question::Fps(30.0), &points), [4]);
        let many = measured([(0.1, 1.0); 20]);
        assert_eq!(contenders(Question::Error(0.1), &many).len(), MOST_CONTENDERS);
    }
}
