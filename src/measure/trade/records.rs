use super::figures::{Figures, figures};
use super::{Point, SceneTrade, Trade};
use crate::algorithm::Precision;
use crate::measure::output::{Entry, Table};

const COLUMNS: &str = "scene,setting,kernel,precision,error,max_depth,boxes,samples,scale,\
    time_ns,first_quartile_ns,third_quartile_ns,of_baseline,pairs,frames_per_second,\
    largest_error,max_abs,max_abs_off_discontinuities,rmse,psnr_db,flip_mean,non_finite_pixels,\
    discontinuity_pixels,differing_discontinuity_pixels,pixels,bound,on_front,\
    width,height,target,device,driver,program,validation";

/// A row a setting on a scene; the machine stands in every row.
pub fn records(trade: &Trade) -> Table {
    let of_scene = |scene| {
        let figures = figures(scene, &trade.conditions);
        scene
            .points
            .iter()
            .zip(figures)
            .map(|(point, figures)| record(trade, scene, point, &figures))
            .collect::<Vec<_>>()
    };
    Table { head: COLUMNS.split(',').map(Into::into).collect(), rows: trade.scenes.iter().flat_map(of_scene).collect() }
}

fn record(
    Trade { machine, conditions, .. }: &Trade,
    scene: &SceneTrade,
    point: &Point,
    figures: &Figures,
) -> Vec<Entry> {
    let (setting, error) = (&point.setting, &point.error);
    vec![
        Entry::of(&scene.scene),
        Entry::of(&figures.name),
        Entry::of(setting.algorithm.name()),
        Entry::maybe(setting.precision.map(Precision::name)),
        Entry::of(setting.error),
        Entry::maybe(setting.max_depth),
        Entry::of(setting.boxes),
        Entry::of(setting.samples),
        Entry::of(setting.scale),
        Entry::maybe(figures.time_ns),
        Entry::maybe(figures.quartiles_ns.map(|[first, _]| first)),
        Entry::maybe(figures.quartiles_ns.map(|[_, third]| third)),
        Entry::maybe(figures.ratio),
        Entry::of(point.samples_ns.len()),
        Entry::maybe(figures.frames_per_second),
        Entry::maybe(figures.largest_error),
        Entry::maybe(error.image.max_abs),
        Entry::maybe(error.max_abs_off_discontinuities),
        Entry::maybe(error.image.rmse),
        Entry::maybe(error.image.psnr_db),
        Entry::of(error.image.flip_mean),
        Entry::of(error.image.non_finite_pixels),
        Entry::of(error.discontinuity_pixels),
        Entry::of(error.differing_discontinuity_pixels),
        Entry::of(error.image.pixels),
        Entry::maybe(point.bound),
        Entry::of(figures.is_on_front),
        Entry::of(conditions.width),
        Entry::of(conditions.height),
        Entry::of(conditions.target.name()),
        Entry::of(&machine.device),
        Entry::of(&machine.driver),
        Entry::of(&machine.program),
        Entry::of(conditions.validation),
    ]
}

#[cfg(test)]
mod tests {
    use super::super::example::example;
    use super::*;

    #[test]
    fn every_setting_is_a_line_of_all_that_is_known_of_it() {
        let text = records(&example()).to_csv();
        let lines: Vec<_> = text.lines().collect();
        assert_eq!((lines.len(), lines[0]), (1 + 5, COLUMNS));
        assert!(lines[2].starts_with("room,whitted f64,whitted,f64,0,,true,1,1,20000000,"), "{text}");
    }
}
