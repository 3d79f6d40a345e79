use serde::Serialize;

use super::{Conditions, Point, Question, SceneTrade, front};
use crate::settings::RenderSettings;

/// A point in figures.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Figures {
    /// Name of the setting, in words.
    pub name: String,
    /// Time of a frame: the median ratio to the baseline's frame beside it, times the baseline's median. `None` without
    /// samples.
    pub time_ns: Option<f64>,
    pub frames_per_second: Option<f64>,
    /// First and third, of the ratios, times the baseline's median.
    pub quartiles_ns: Option<[f64; 2]>,
    /// In parts of the baseline's time.
    pub ratio: Option<f64>,
    /// See [`Point::counted_error`]; `None` where it is infinite or no number.
    pub counted_error: Option<f64>,
    /// See [`front`].
    pub is_on_front: bool,
}

/// Figures of every point of a scene, in the points' order.
pub fn figures(scene: &SceneTrade, conditions: &Conditions) -> Vec<Figures> {
    let baseline_ns = scene.baseline_ns().unwrap_or_default() as f64;
    let is_on_front = front(&scene.candidates(conditions.counted));
    let of_point = |(point, is_on_front): (&Point, bool)| {
        let ratios = point.ratios();
        let time_ns = ratios.map(|[_, ratio, _]| ratio * baseline_ns);
        let error = point.counted_error(conditions.counted);
        Figures {
            name: point.setting.to_string(),
            time_ns,
            frames_per_second: time_ns.map(|time_ns| 1e9 / time_ns.max(1.0)),
            quartiles_ns: ratios.map(|[first, _, third]| [first * baseline_ns, third * baseline_ns]),
            ratio: ratios.map(|[_, ratio, _]| ratio),
            counted_error: Some(error).filter(|error| error.is_finite()),
            is_on_front,
        }
    };
    scene.points.iter().zip(is_on_front).map(of_point).collect()
}

/// A question with its answer.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Answer {
    #[serde(flatten)]
    pub question: Question,
    /// Among the points; null where no setting will do.
    pub place: Option<usize>,
    pub setting: Option<RenderSettings>,
    pub name: Option<String>,
}

pub fn answers(scene: &SceneTrade, conditions: &Conditions) -> Vec<Answer> {
    let answer = |&question: &Question| {
        let place = scene.answer(question, conditions.counted);
        let setting = place.map(|place| scene.points[place].setting);
        Answer { question, place, setting, name: setting.map(|setting| setting.to_string()) }
    };
    conditions.questions.iter().map(answer).collect()
}
