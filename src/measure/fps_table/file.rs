//! The table in files: each is written whole or not at all, and the JSON one can be gone on with.

use std::collections::HashSet;
use std::fs;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::chart::chart;
use super::figures::{Figures, figures};
use super::records::records;
use super::tables::blocks;
use super::{Agreement, Algorithm, Cell, Clock, FpsTable, Machine, Plan, published};
use crate::measure::output::chart::Chart;
use crate::measure::output::{Document, OutputError, ReportFormat, Table};

/// What a table's JSON says it is. The number is raised when an older program could not read it rightly.
const FORMAT: &str = "zerkalo-fps-2";

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
    /// Of the figures that are not said to be by the other.
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

    fn records(&self) -> Table {
        records(self)
    }

    fn blocks(&self) -> Vec<String> {
        blocks(self)
    }

    fn chart(&self) -> Chart {
        chart(self)
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
            let Cell { kind, count, algorithm, .. } = cell;
            return Err(format!(
                "its cell of {count} of the kind {}, {} kernel, {fault}",
                kind.name(),
                algorithm.name()
            ));
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
    fn json_tells_the_figures_and_what_agrees() {
        let document: serde_json::Value =
            serde_json::from_str(&example(&[10, 20, 100], &[Algorithm::Course]).to_json()).unwrap();
        assert_eq!((&document["format"], &document["complete"]), (&FORMAT.into(), &true.into()));
        assert_eq!(document["figures"].as_array().unwrap().len(), 12);
        assert_eq!(document["agreement"]["published"]["order_agrees"], true);
        assert_eq!(document["agreement"]["course"]["order_agrees"], false);
        assert!(document["agreement"]["whitted"].is_null());
    }
}
