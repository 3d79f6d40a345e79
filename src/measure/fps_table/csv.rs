use super::FpsTable;
use super::figures::{Figures, figures};
use crate::measure::Summary;
use crate::measure::output::csv::{number, quoted};

/// Names with units; what is not known is empty.
const COLUMNS: &str = "kind,count,kernel,\
    gpu_fps,gpu_frames,gpu_median_ns,gpu_first_quartile_ns,gpu_third_quartile_ns,gpu_min_ns,gpu_max_ns,gpu_stddev_ns,gpu_outliers,\
    wall_fps,wall_frames,wall_median_ns,wall_first_quartile_ns,wall_third_quartile_ns,wall_min_ns,wall_max_ns,wall_stddev_ns,wall_outliers,\
    published_fps,of_fewest,published_of_fewest,of_spheres,published_of_spheres,\
    width,height,generations,device,driver,program,validation,present_mode";

/// A line a cell below the columns' names (RFC 4180); the machine stands in every line, so that none is read without
/// it.
pub fn of(table: &FpsTable) -> String {
    let lines = figures(table).iter().map(|figures| line(table, figures)).collect::<Vec<_>>();
    [&[COLUMNS.to_owned()], &lines[..]].concat().join("\n") + "\n"
}

fn line(table: &FpsTable, figures: &Figures) -> String {
    let Figures { kind, count, algorithm, .. } = figures;
    let (plan, machine) = (&table.plan, &table.machine);
    let fields = [
        vec![kind.name().to_owned(), count.to_string(), algorithm.name().to_owned()],
        times(figures.gpu_fps, figures.gpu.as_ref()),
        times(Some(figures.wall_fps), Some(&figures.wall)),
        [
            figures.published_fps,
            figures.of_fewest,
            figures.published_of_fewest,
            figures.of_spheres,
            figures.published_of_spheres,
        ]
        .map(number)
        .to_vec(),
        [plan.width, plan.height, plan.generations].map(|number| number.to_string()).to_vec(),
        [&machine.device, &machine.driver, &machine.program].map(|text| quoted(text)).to_vec(),
        vec![plan.validation.to_string(), machine.present_mode.clone().unwrap_or_default()],
    ];
    fields.concat().join(",")
}

fn times(fps: Option<f64>, summary: Option<&Summary>) -> Vec<String> {
    let Some(summary) = summary else { return vec![String::new(); 9] };
    vec![
        number(fps),
        summary.count.to_string(),
        summary.median_ns.to_string(),
        number(Some(summary.quartiles_ns[0])),
        number(Some(summary.quartiles_ns[1])),
        summary.min_ns.to_string(),
        summary.max_ns.to_string(),
        number(summary.stddev_ns),
        summary.outliers.len().to_string(),
    ]
}

#[cfg(test)]
mod tests {
    use super::super::tests::{BOTH, example};
    use super::*;

    #[test]
    fn every_cell_is_a_line_of_as_many_fields_as_there_are_columns() {
        let mut table = example(&[10, 100], &BOTH);
        table.cells[0].gpu_samples_ns = None;
        let text = of(&table);
        assert_eq!(text.lines().count(), 17);
        let columns = COLUMNS.split(',').count();
        for line in text.lines().skip(1) {
            // The device's name has the one comma in quotes.
            assert!(line.contains("\"a device, of \"\"two\"\" cores\""), "{line}");
            assert_eq!(line.split(',').count(), columns + 1, "{line}");
        }
        let first = text.lines().nth(1).unwrap();
        assert!(first.starts_with("sphere,10,course,,,,,,,,,,"), "{first}");
        assert!(text.lines().nth(3).unwrap().starts_with("box,10,course,"), "{text}");
    }
}
