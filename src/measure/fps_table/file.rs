//! The table in files: each is written whole or not at all, and the JSON one can be gone on with.

use std::collections::HashSet;
use std::fs;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::chart::chart;
use super::figures::{Figures, figures};
use super::tables::blocks;
use super::{Agreement, Algorithm, Clock, FpsTable, Machine, Plan, published};
use crate::measure::output::chart::Chart;
use crate::measure::output::{Document, OutputError, ReportFormat, Table};

/// What a table's JSON says it is. The number is raised when an older program could not read it rightly.
const FORMAT: &str = "zerkalo-fps-2";

/// Columns of CSV.
const COLUMNS: &str = "kind,count,kernel=algorithm,\
    gpu_fps,gpu_frames=gpu/count,gpu_median_ns=gpu/median_ns,gpu_first_quartile_ns=gpu/quartiles_ns/0,\
    gpu_third_quartile_ns=gpu/quartiles_ns/1,gpu_min_ns=gpu/min_ns,gpu_max_ns=gpu/max_ns,gpu_stddev_ns=gpu/stddev_ns,\
    gpu_outliers=gpu/outliers,\
    wall_fps,wall_frames=wall/count,wall_median_ns=wall/median_ns,wall_first_quartile_ns=wall/quartiles_ns/0,\
    wall_third_quartile_ns=wall/quartiles_ns/1,wall_min_ns=wall/min_ns,wall_max_ns=wall/max_ns,\
    wall_stddev_ns=wall/stddev_ns,wall_outliers=wall/outliers,\
    published_fps,of_fewest,published_of_fewest,of_spheres,published_of_spheres,\
    width,height,generations,device,driver,program,validation,present_mode";

/// Why a table could not be read, written or gone on with; each message is one line.
#[derive(Debug, Error)]
pub enum FpsTableError {
    #[error("could not read table {path:?}: {reason}")]
    Read { path: PathBuf, reason: String },
    #[error("table {path:?} cannot be gone on with: {differences}")]
    Differs { path: PathBuf, differences: String },
    #[error(transparent)]
    Output(#[from] OutputError),
}

impl FpsTableError {
    /// Whether what the caller named is at fault, not the machine.
    pub fn is_input_error(&self) -> bool {
        match self {
            Self::Read { .. } | Self::Differs { .. } => true,
            Self::Output(error) => error.is_input_error(),
        }
    }
}

/// What JSON has besides the table itself, calculated from it and not read back.
#[derive(Serialize)]
struct Data<'a> {
    format: &'static str,
    #[serde(flatten)]
    table: &'a FpsTable,
    /// False after Ctrl-C.
    complete: bool,
    /// Clock of the figures that are not said to be by the other.
    clock: Clock,
    figures: Vec<Figures>,
    agreement: Agreements,
}

#[derive(Serialize)]
struct Agreements {
    published: Agreement,
    /// Null where not measured.
    course: Option<Agreement>,
    whitted: Option<Agreement>,
}

#[derive(Deserialize)]
struct Head {
    format: String,
}

impl Document for FpsTable {
    fn data(&self) -> impl Serialize {
        let agreement = |algorithm| {
            self.plan.algorithms.contains(&algorithm).then(|| Agreement::of(&self.speeds(algorithm, self.clock())))
        };
        Data {
            format: FORMAT,
            table: self,
            complete: self.missing().is_empty(),
            clock: self.clock(),
            figures: figures(self),
            agreement: Agreements {
                published: Agreement::of(&published()),
                course: agreement(Algorithm::Course),
                whitted: agreement(Algorithm::Whitted),
            },
        }
    }

    /// A row a cell; the machine stands in every row, so that none is read without it.
    fn records(&self) -> Table {
        Table::of_records(COLUMNS, figures(self).iter().map(|figures| (figures, &self.plan, &self.machine)))
    }

    fn blocks(&self) -> Vec<String> {
        blocks(self)
    }

    fn chart(&self) -> Option<Chart> {
        Some(chart(self))
    }
}

impl FpsTable {
    /// Reads what [`FpsTable::save`] wrote as JSON.
    ///
    /// # Errors
    /// It cannot be read, is of another form or of something else, or is such as no measuring leaves.
    pub fn load(path: &Path) -> Result<Self, FpsTableError> {
        let unreadable = |reason: String| FpsTableError::Read { path: path.to_owned(), reason };
        if ReportFormat::of(path)? != ReportFormat::Json {
            return Err(unreadable("only a table in .json has what it takes to go on".to_owned()));
        }
        let text = fs::read_to_string(path).map_err(|error| unreadable(error.to_string()))?;
        let head: Head = serde_json::from_str(&text).map_err(|error| unreadable(error.to_string()))?;
        if head.format != FORMAT {
            return Err(unreadable(format!("its format is {:?}, and this program reads {FORMAT:?}", head.format)));
        }
        let table: Self = serde_json::from_str(&text).map_err(|error| unreadable(error.to_string()))?;
        table.check().map_err(unreadable)?;
        Ok(table)
    }

    fn check(&self) -> Result<(), String> {
        self.plan.check()?;
        let mut seen = HashSet::new();
        for cell in &self.cells {
            let is_planned = self.plan.counts.contains(&cell.count) && self.plan.algorithms.contains(&cell.algorithm);
            let is_new = seen.insert((cell.kind, cell.count, cell.algorithm.name()));
            let samples = [Some(&cell.wall_samples_ns), cell.gpu_samples_ns.as_ref()];
            let fault = match () {
                () if !is_planned => "is not of its plan",
                () if !is_new => "is there twice",
                () if samples.into_iter().flatten().any(Vec::is_empty) => "is empty",
                () => continue,
            };
            return Err(format!("its cell of {}, {fault}", cell.name()));
        }
        Ok(())
    }

    /// Refuses to add to a table, read from `path`, cells that another machine or another plan gives.
    pub fn check_goes_on(&self, path: &Path, machine: &Machine, plan: &Plan) -> Result<(), FpsTableError> {
        let differences = [differences(&self.machine, machine), differences(&self.plan, plan)].concat();
        if differences.is_empty() {
            return Ok(());
        }
        Err(FpsTableError::Differs { path: path.to_owned(), differences: differences.join(", ") })
    }

    /// Takes in the cells of a table, read from `path`, that a machine of the same kind measured by the same plan but for
    /// its numbers of solids. Cells that are the same in both are of a table that was taken in before.
    ///
    /// # Errors
    /// It was measured otherwise, or both measured a cell. Nothing was taken in.
    pub fn merge(&mut self, path: &Path, other: Self) -> Result<(), FpsTableError> {
        other.check_goes_on(path, &self.machine, &Plan { counts: other.plan.counts.clone(), ..self.plan.clone() })?;
        let mut new = Vec::new();
        for cell in other.cells {
            match self.cell(cell.kind, cell.count, cell.algorithm) {
                None => new.push(cell),
                Some(ours) if *ours == cell => {}
                Some(_) => {
                    let differences = format!("another table has measured its cell of {} as well", cell.name());
                    return Err(FpsTableError::Differs { path: path.to_owned(), differences });
                }
            }
        }
        self.cells.extend(new);
        self.plan.counts.extend(other.plan.counts);
        self.plan.counts.sort_unstable();
        self.plan.counts.dedup();
        Ok(())
    }
}

/// The fields that differ, each with what is in the file and what is here now.
fn differences<T: Serialize>(theirs: &T, ours: &T) -> Vec<String> {
    let fields = |value: &T| match serde_json::to_value(value) {
        Ok(serde_json::Value::Object(fields)) => fields,
        _ => serde_json::Map::new(),
    };
    let (theirs, ours) = (fields(theirs), fields(ours));
    let differing = ours.iter().filter(|(name, ours)| theirs.get(*name) != Some(ours));
    let told = differing.map(|(name, ours)| {
        let theirs = theirs.get(name).map_or("nothing".to_owned(), ToString::to_string);
        format!("its {name} is {theirs}, and here it is {ours}")
    });
    told.collect()
}

#[cfg(test)]
mod tests {
    use super::super::tests::{BOTH, example};
    use super::*;

    #[test]
    fn a_table_is_read_as_it_was_written_whole_or_not() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("fps.json");
        let mut table = example(&[10, 100], &BOTH);
        table.cells[2].gpu_samples_ns = None;
        for _ in 0..2 {
            table.save(&path).unwrap();
            assert_eq!(FpsTable::load(&path).unwrap(), table);
            table.cells.truncate(3);
        }
    }

    type Spoil = fn(&mut FpsTable);

    #[test]
    fn what_no_measuring_leaves_is_not_read() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("fps.json");
        let good = example(&[10], &[Algorithm::Course]);
        let spoil: [(&str, Spoil); 7] = [
            ("plan", |table| table.cells[0].count = 20),
            ("plan", |table| table.cells[0].algorithm = Algorithm::Whitted),
            ("twice", |table| table.cells.push(table.cells[0].clone())),
            ("empty", |table| table.cells[0].wall_samples_ns.clear()),
            ("empty", |table| table.cells[0].gpu_samples_ns = Some(Vec::new())),
            ("0x70", |table| table.plan.width = 0),
            ("number", |table| table.plan.counts = vec![10, 11]),
        ];
        for (word, spoil) in spoil {
            let mut table = good.clone();
            spoil(&mut table);
            table.save(&path).unwrap();
            let error = FpsTable::load(&path).unwrap_err();
            assert!(error.is_input_error() && error.to_string().contains(word), "{word}: {error}");
        }
        for (text, word) in [("", "EOF"), ("{}", "format"), ("{\"format\": \"zerkalo-fps-0\"}", "zerkalo-fps-2")] {
            fs::write(&path, text).unwrap();
            assert!(FpsTable::load(&path).unwrap_err().to_string().contains(word), "{text}");
        }
        good.save(&folder.path().join("fps.csv")).unwrap();
        assert!(
            FpsTable::load(&folder.path().join("fps.csv")).unwrap_err().to_string().contains("only a table in .json")
        );
    }

    #[test]
    fn another_machine_or_plan_is_told_field_by_field() {
        let table = example(&[10], &[Algorithm::Course]);
        let path = Path::new("fps.json");
        assert!(table.check_goes_on(path, &table.machine, &table.plan).is_ok());
        let machine = Machine { driver: "driver 2".into(), ..table.machine.clone() };
        let plan = Plan { width: 161, ..table.plan.clone() };
        let error = table.check_goes_on(path, &machine, &plan).unwrap_err();
        assert!(error.is_input_error());
        assert_eq!(
            error.to_string(),
            "table \"fps.json\" cannot be gone on with: its driver is \"driver 1\", and here it is \"driver 2\", its \
             width is 160, and here it is 161"
        );
    }

    #[test]
    fn tables_of_one_plan_are_merged_and_a_cell_that_two_have_measured_is_refused() {
        let path = Path::new("b.json");
        let whole = example(&[10, 20], &BOTH);
        let mut table = example(&[20], &BOTH);
        for _ in 0..2 {
            table.merge(path, example(&[10], &BOTH)).unwrap();
            assert_eq!((&table.plan, table.cells.len(), table.missing()), (&whole.plan, whole.cells.len(), vec![]));
        }
        // Of the same numbers, each in part.
        let mut half = whole.clone();
        let rest = half.cells.split_off(3);
        half.merge(path, FpsTable { cells: rest, ..whole.clone() }).unwrap();
        assert_eq!(half, whole);
        let mut again = example(&[20, 30], &BOTH);
        again.cells[1].wall_samples_ns[0] += 1;
        let error = half.merge(path, again).unwrap_err().to_string();
        assert!(error.contains("20 of the kind sphere, whitted kernel as well"), "{error}");
        assert_eq!(half, whole, "nothing was taken in");
        let other =
            FpsTable { machine: Machine { device: "2".into(), ..whole.machine.clone() }, ..example(&[30], &BOTH) };
        assert!(half.merge(path, other).unwrap_err().to_string().contains("its device is \"2\""));
    }

    #[test]
    fn json_tells_the_figures_and_what_agrees() {
        let document: serde_json::Value =
            serde_json::from_str(&example(&[10, 20, 100], &[Algorithm::Course]).to_json()).unwrap();
        assert_eq!((&document["format"], &document["complete"]), (&FORMAT.into(), &true.into()));
        assert_eq!(document["figures"].as_array().unwrap().len(), 12);
        assert_eq!(document["agreement"]["published"]["order_agrees"], true);
        assert_eq!(document["agreement"]["course"]["order_agrees"], false);
        assert!(document["agreement"]["whitted"].is_null());
    }
    #[test]
    fn csv_has_a_line_a_cell_with_all_that_is_known_of_it() {
        let mut table = example(&[10, 100], &BOTH);
        table.cells[0].gpu_samples_ns = None;
        table.cells[1].wall_samples_ns.push(900_000_000);
        table.machine.present_mode = Some("mailbox".to_owned());
        let text = table.records().to_csv();
        let lines: Vec<_> = text.lines().collect();
        assert_eq!(lines.len(), 17);
        let device = "160,70,20,\"a device, of \"\"two\"\" cores\",driver 1,z 1,false,mailbox";
        let wall = "99.50248756218906,5,10050000,10050000,10050000,10000000,10100000,35355.33905932738,0";
        assert_eq!(lines[1], format!("sphere,10,course,,,,,,,,,,{wall},57.1419,1,1,1,1,{device}"));
        let gpu = "200,5,5000000,5000000,5000000,5000000,5000000,0,0";
        assert!(lines[2].starts_with(&format!("sphere,10,whitted,{gpu},198.01980198019803,6,5050000,")), "{text}");
        assert!(lines[2].contains(",900000000,") && lines[2].contains(",1,57.1419,1,1,1,1,160,"), "{text}");
    }
}
