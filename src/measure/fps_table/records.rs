use super::FpsTable;
use super::figures::{Figures, figures};
use crate::measure::Summary;
use crate::measure::output::{Entry, Table};

const COLUMNS: &str = "kind,count,kernel,\
    gpu_fps,gpu_frames,gpu_median_ns,gpu_first_quartile_ns,gpu_third_quartile_ns,gpu_min_ns,gpu_max_ns,gpu_stddev_ns,gpu_outliers,\
    wall_fps,wall_frames,wall_median_ns,wall_first_quartile_ns,wall_third_quartile_ns,wall_min_ns,wall_max_ns,wall_stddev_ns,wall_outliers,\
    published_fps,of_fewest,published_of_fewest,of_spheres,published_of_spheres,\
    width,height,generations,device,driver,program,validation,present_mode";

/// A row a cell; the machine stands in every row, so that none is read without it.
pub fn records(table: &FpsTable) -> Table {
    let rows = figures(table).iter().map(|figures| record(table, figures)).collect();
    Table { head: COLUMNS.split(',').map(Into::into).collect(), rows }
}

fn record(FpsTable { plan, machine, .. }: &FpsTable, figures: &Figures) -> Vec<Entry> {
    let ratios = [
        figures.published_fps,
        figures.of_fewest,
        figures.published_of_fewest,
        figures.of_spheres,
        figures.published_of_spheres,
    ];
    [
        vec![Entry::of(figures.kind.name()), Entry::of(figures.count), Entry::of(figures.algorithm.name())],
        times(figures.gpu_fps, figures.gpu.as_ref()),
        times(Some(figures.wall_fps), Some(&figures.wall)),
        ratios.map(Entry::maybe).to_vec(),
        [plan.width, plan.height, plan.generations].map(Entry::of).to_vec(),
        [&machine.device, &machine.driver, &machine.program].map(Entry::of).to_vec(),
        vec![Entry::of(plan.validation), Entry::maybe(machine.present_mode.as_ref())],
    ]
    .concat()
}

fn times(fps: Option<f64>, summary: Option<&Summary>) -> Vec<Entry> {
    let Some(summary) = summary else { return vec![Entry::Absent; 9] };
    vec![
        Entry::maybe(fps),
        Entry::of(summary.count),
        Entry::of(summary.median_ns),
        Entry::of(summary.quartiles_ns[0]),
        Entry::of(summary.quartiles_ns[1]),
        Entry::of(summary.min_ns),
        Entry::of(summary.max_ns),
        Entry::maybe(summary.stddev_ns),
        Entry::of(summary.outliers.len()),
    ]
}

#[cfg(test)]
mod tests {
    use super::super::tests::{BOTH, example};
    use super::*;

    #[test]
    fn every_cell_is_a_line_of_all_that_is_known_of_it() {
        let mut table = example(&[10, 100], &BOTH);
        table.cells[0].gpu_samples_ns = None;
        let text = records(&table).to_csv();
        let lines: Vec<_> = text.lines().collect();
        assert_eq!((lines.len(), lines[0]), (17, COLUMNS));
        assert!(lines[1].starts_with("sphere,10,course,,,,,,,,,,") && lines[3].starts_with("box,10,course,"), "{text}");
        assert!(lines[1].ends_with(",160,70,20,\"a device, of \"\"two\"\" cores\",driver 1,z 1,false,"), "{text}");
    }
}
