use super::figures::{Figures, figures};
use super::{Point, SceneTrade, Trade};
use crate::measure::output::csv::{number, quoted};

/// Names with units; what is not known is empty.
const COLUMNS: &str = "scene,setting,kernel,precision,error,max_depth,boxes,samples,scale,\
    time_ns,first_quartile_ns,third_quartile_ns,of_baseline,pairs,frames_per_second,\
    largest_error,max_abs,max_abs_off_discontinuities,rmse,psnr_db,flip_mean,non_finite_pixels,\
    discontinuity_pixels,differing_discontinuity_pixels,pixels,bound,on_front,\
    width,height,target,device,driver,program,validation";

/// A line a setting below the columns' names (RFC 4180).
pub fn of(trade: &Trade) -> String {
    let mut lines = vec![COLUMNS.to_owned()];
    for scene in &trade.scenes {
        let figures = figures(scene, &trade.conditions);
        lines.extend(scene.points.iter().zip(&figures).map(|(point, figures)| line(trade, scene, point, figures)));
    }
    lines.join("\n") + "\n"
}

fn line(trade: &Trade, scene: &SceneTrade, point: &Point, figures: &Figures) -> String {
    let (setting, error) = (&point.setting, &point.error);
    let (conditions, machine) = (&trade.conditions, &trade.machine);
    let [first_quartile, third_quartile] = figures.quartiles_ns.map_or([None; 2], |quartiles| quartiles.map(Some));
    let fields = [
        quoted(&scene.scene),
        quoted(&figures.name),
        setting.algorithm.name().to_owned(),
        setting.precision.map_or(String::new(), |precision| precision.name().to_owned()),
        setting.error.to_string(),
        setting.max_depth.map_or(String::new(), |depth| depth.to_string()),
        setting.boxes.to_string(),
        setting.samples.to_string(),
        setting.scale.to_string(),
        number(figures.time_ns),
        number(first_quartile),
        number(third_quartile),
        number(figures.ratio),
        point.samples_ns.len().to_string(),
        number(figures.frames_per_second),
        number(figures.largest_error),
        number(error.image.max_abs),
        number(error.max_abs_off_discontinuities),
        number(error.image.rmse),
        number(error.image.psnr_db),
        error.image.flip_mean.to_string(),
        error.image.non_finite_pixels.to_string(),
        error.discontinuity_pixels.to_string(),
        error.differing_discontinuity_pixels.to_string(),
        error.image.pixels.to_string(),
        number(point.bound),
        figures.is_on_front.to_string(),
        conditions.width.to_string(),
        conditions.height.to_string(),
        conditions.target.name().to_owned(),
        quoted(&machine.device),
        quoted(&machine.driver),
        quoted(&machine.program),
        conditions.validation.to_string(),
    ];
    fields.join(",")
}

#[cfg(test)]
mod tests {
    use super::super::example::example;
    use super::*;

    #[test]
    fn every_setting_is_a_line_of_as_many_fields_as_there_are_columns() {
        let text = of(&example());
        let columns = COLUMNS.split(',').count();
        assert_eq!(text.lines().count(), 1 + 5);
        for line in text.lines() {
            // A comma in quotes is no separator.
            let outside = line.split('"').step_by(2).collect::<String>();
            assert_eq!(outside.split(',').count(), columns, "{line}");
        }
        assert!(
            text.lines().nth(2).unwrap().starts_with("\"room\",\"whitted f64\",whitted,f64,0,,true,1,1,20000000,"),
            "{text}"
        );
    }
}
