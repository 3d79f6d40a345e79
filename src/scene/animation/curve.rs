//! What a value is between two keyframes.

use glam::{DMat3, DQuat, DVec3};

use super::slot::Kind;
use super::{Keyframe, Value};
use crate::scene::edit::{rotation_of, world_from_box};
use crate::scene::validate::unit;

/// How a value goes from keyframe to keyframe.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Interpolation {
    /// Evenly.
    #[default]
    Linear,
    /// By the cubic through all keyframes of Catmull and Rom, with the times as its knots: without a jerk. Where the
    /// last of more than two values is the first, it is without one from the end to the start, too.
    CatmullRom,
}

impl Interpolation {
    /// The default first.
    pub const ALL: [Self; 2] = [Self::Linear, Self::CatmullRom];

    /// The word of the scene file.
    pub fn name(self) -> &'static str {
        match self {
            Self::Linear => "linear",
            Self::CatmullRom => "catmull-rom",
        }
    }
}

/// The value at a time; at a keyframe's, that keyframe's to the bit. There is at least one.
pub(super) fn at(keyframes: &[Keyframe], interpolation: Interpolation, kind: Kind, seconds: f64) -> Value {
    let after = keyframes.partition_point(|keyframe| keyframe.seconds <= seconds);
    let from = after.saturating_sub(1);
    let last = keyframes[from];
    if after == 0 || after == keyframes.len() || last.seconds == seconds {
        return last.value;
    }
    // What stays is not to be rounded.
    if interpolation == Interpolation::Linear && last.value == keyframes[after].value {
        return last.value;
    }
    let span = Span { keyframes, from, interpolation, seconds };
    match kind {
        Kind::Free => pair_as(last.value, span.value(pair, mix)),
        Kind::Limited => {
            // Of the four that a cubic goes by at most: the limits of fields are of intervals.
            let near = &keyframes[from.saturating_sub(1)..keyframes.len().min(from + 3)];
            let values = || near.iter().map(|keyframe| pair(keyframe.value));
            let least = values().reduce(|a, b| [0, 1].map(|i| a[i].min(b[i]))).unwrap_or_default();
            let greatest = values().reduce(|a, b| [0, 1].map(|i| a[i].max(b[i]))).unwrap_or_default();
            let value = span.value(pair, mix);
            pair_as(last.value, [0, 1].map(|i| value[i].clamp(least[i], greatest[i])))
        }
        Kind::Direction => {
            Value::Vector(span.value(|value| unit(pair(value)[0]), |a, b, share| unit(a.slerp(b, share))))
        }
        Kind::Rotation => {
            let turn = |value| DQuat::from_mat3(&world_from_box(pair(value)[0])).normalize();
            let turned = span.value(turn, |a, b, share| a.slerp(b, share).normalize());
            Value::Vector(rotation_of(&DMat3::from_quat(turned)))
        }
    }
}

/// A time between two keyframes.
struct Span<'k> {
    keyframes: &'k [Keyframe],
    /// Index of the one before.
    from: usize,
    interpolation: Interpolation,
    seconds: f64,
}

impl Span<'_> {
    /// By how two values are mixed: all of the second by a share of 1, and beyond it by more.
    fn value<T: Copy + PartialEq>(&self, of: impl Fn(Value) -> T, mix: impl Fn(T, T, f64) -> T) -> T {
        let &Self { keyframes, from, interpolation, seconds } = self;
        let knot = |keyframe: &Keyframe| (keyframe.seconds, of(keyframe.value));
        let between = |a: (f64, T), b: (f64, T)| mix(a.1, b.1, (seconds - a.0) / (b.0 - a.0));
        let (start, end) = (knot(&keyframes[from]), knot(&keyframes[from + 1]));
        if interpolation == Interpolation::Linear {
            return between(start, end);
        }
        let (first, last) = (knot(&keyframes[0]), knot(&keyframes[keyframes.len() - 1]));
        let is_closed = keyframes.len() > 2 && first.1 == last.1;
        let period = last.0 - first.0;
        // Beyond the ends of a curve that is open, the value goes on as it came.
        let before = match from.checked_sub(1) {
            Some(before) => knot(&keyframes[before]),
            None if is_closed => {
                let (seconds, value) = knot(&keyframes[keyframes.len() - 2]);
                (seconds - period, value)
            }
            None => (2.0 * start.0 - end.0, mix(start.1, end.1, -1.0)),
        };
        let after = match keyframes.get(from + 2) {
            Some(after) => knot(after),
            None if is_closed => {
                let (seconds, value) = knot(&keyframes[1]);
                (seconds + period, value)
            }
            None => (2.0 * end.0 - start.0, mix(start.1, end.1, 2.0)),
        };
        // The pyramid of Barry and Goldman, "A Recursive Evaluation Algorithm for a Class of Catmull-Rom Splines"
        // (1988), which needs nothing of values but that two can be mixed.
        let [a, b, c] = [(before, start), (start, end), (end, after)].map(|(one, other)| between(one, other));
        let early = between((before.0, a), (end.0, b));
        let late = between((start.0, b), (after.0, c));
        between((start.0, early), (end.0, late))
    }
}

/// Any value as two vectors.
fn pair(value: Value) -> [DVec3; 2] {
    match value {
        Value::Number(number) => [DVec3::splat(number), DVec3::ZERO],
        Value::Vector(vector) => [vector, DVec3::ZERO],
        Value::Points(points) => points,
    }
}

/// The value of the same type as another that two vectors are.
fn pair_as(like: Value, [first, second]: [DVec3; 2]) -> Value {
    match like {
        Value::Number(_) => Value::Number(first.x),
        Value::Vector(_) => Value::Vector(first),
        Value::Points(_) => Value::Points([first, second]),
    }
}

fn mix(a: [DVec3; 2], b: [DVec3; 2], share: f64) -> [DVec3; 2] {
    [0, 1].map(|i| a[i] + (b[i] - a[i]) * share)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn numbers(values: &[(f64, f64)]) -> Vec<Keyframe> {
        values.iter().map(|&(seconds, value)| Keyframe { seconds, value: Value::Number(value) }).collect()
    }

    fn number(value: Value) -> f64 {
        match value {
            Value::Number(number) => number,
            other => panic!("{other:?}"),
        }
    }

    fn vector(value: Value) -> DVec3 {
        match value {
            Value::Vector(vector) => vector,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn values_stay_before_the_first_keyframe_and_after_the_last() {
        for interpolation in Interpolation::ALL {
            let keyframes = numbers(&[(1.0, 3.0), (2.0, 5.0)]);
            let at = |seconds| number(at(&keyframes, interpolation, Kind::Free, seconds));
            assert_eq!((at(0.0), at(1.0), at(2.0), at(9.0)), (3.0, 3.0, 5.0, 5.0));
            assert_eq!(at(1.5), 4.0, "a straight line is one by either");
        }
    }

    /// With even knots, the classic matrix of Catmull-Rom: (−p₀ + 9·p₁ + 9·p₂ − p₃)/16 in the middle.
    #[test]
    fn catmull_rom_of_even_times_is_the_classic_one() {
        let keyframes = numbers(&[(0.0, 1.0), (1.0, 2.0), (2.0, 4.0), (3.0, 3.0)]);
        let middle = number(at(&keyframes, Interpolation::CatmullRom, Kind::Free, 1.5));
        assert!((middle - (-1.0 + 18.0 + 36.0 - 3.0) / 16.0).abs() < 1e-15, "{middle}");
    }

    /// Left and right difference quotients agree at every keyframe, at the seam of a closed curve too, however the
    /// times lie.
    #[test]
    fn catmull_rom_has_no_jerk() {
        let keyframes = numbers(&[(0.0, 1.0), (0.5, 2.0), (2.0, -4.0), (3.0, 1.0)]);
        let at = |seconds| number(at(&keyframes, Interpolation::CatmullRom, Kind::Free, seconds));
        let step = 1e-6;
        let slopes = |seconds: f64, wrapped: f64| {
            ((at(wrapped) - at(wrapped - step)) / step, (at(seconds + step) - at(seconds)) / step)
        };
        for (seconds, wrapped) in [(0.5, 0.5), (2.0, 2.0), (0.0, 3.0)] {
            let (left, right) = slopes(seconds, wrapped);
            // A second derivative below 100 makes quotients over 1e-6 s differ by less than 1e-4.
            assert!((left - right).abs() < 1e-4, "{seconds}: {left} {right}");
        }
    }

    #[test]
    fn what_has_limits_does_not_go_beyond_its_keyframes() {
        let keyframes = numbers(&[(0.0, 0.0), (1.0, 1.0), (2.0, 1.0), (3.0, 0.0)]);
        let at = |kind| number(at(&keyframes, Interpolation::CatmullRom, kind, 1.5));
        assert!(at(Kind::Free) > 1.0);
        assert_eq!(at(Kind::Limited), 1.0);
    }

    #[test]
    fn boxes_turn_by_the_shortest_arc() {
        let turn = |seconds, degrees| Keyframe { seconds, value: Value::Vector(DVec3::new(0.0, degrees, 0.0)) };
        let keyframes = [turn(0.0, 350.0), turn(1.0, 10.0)];
        for interpolation in Interpolation::ALL {
            let middle = vector(at(&keyframes, interpolation, Kind::Rotation, 0.25));
            assert!((middle - DVec3::new(0.0, -5.0, 0.0)).length() < 1e-9, "{middle}");
        }
    }

    #[test]
    fn directions_go_along_the_great_circle_whatever_their_lengths() {
        let keyframes = [(0.0, DVec3::X * 5.0), (1.0, DVec3::Y * 0.1)]
            .map(|(seconds, direction)| Keyframe { seconds, value: Value::Vector(direction) });
        let third = vector(at(&keyframes, Interpolation::Linear, Kind::Direction, 1.0 / 3.0));
        let expected = DVec3::new(30.0_f64.to_radians().cos(), 30.0_f64.to_radians().sin(), 0.0);
        assert!((third - expected).length() < 1e-12, "{third}");
    }
}
