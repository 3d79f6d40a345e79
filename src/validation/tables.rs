//! What came of validation as tables, for people and for programs.

use serde::Serialize;

use super::{Group, Outcome, Pass, Remarked, Switch};
use crate::gpu::Check;
use crate::measure::output::{Document, Entry, Table, Words};

impl Document for Outcome {
    fn data(&self) -> impl Serialize {
        self
    }

    /// A row an id and severity of messages.
    fn records(&self) -> Table {
        let columns = "severity,id,count,text,runs,quick,device,driver";
        Table::of_records(columns, self.messages.iter().map(|group| (group, self)))
    }

    fn blocks(&self) -> Vec<String> {
        let mut told = vec![
            format!("- device: {} ({})", self.device, self.driver),
            format!("- {}", self.layer),
            "- checks: each is tried by a mistake made on purpose; synchronization is the layer's, which passes over \
             dispatches; hazards are in this program's own book"
                .to_owned(),
            format!("- pictures of {}x{} pixels; not covered: the panel beside the window's", self.width, self.height),
        ];
        told.extend(self.no_window.iter().map(|reason| format!("- none in a window: {reason}")));
        let mut found = vec![format!("messages: {}", self.message_count)];
        found.extend(self.messages.iter().map(|group| {
            let Group { severity, id, count, text, .. } = group;
            format!("- {count} of {id} ({}), met by: {}\n  {}", severity.name(), group.met_by(), text.trim())
        }));
        let remarks = self.remarks.iter();
        found.extend(remarks.map(|Remarked { count, remark }| format!("- no fault: {count} of {remark}")));
        vec![
            "# What the validation layers have to say".to_owned(),
            told.join("\n"),
            checks(self).to_markdown(),
            passes(self).to_markdown(),
            switches(self).to_markdown(),
            found.join("\n"),
        ]
    }
}

impl Group {
    /// The first runs; of many a few are enough.
    pub fn met_by(&self) -> String {
        const TOLD: usize = 3;
        let more = self.runs.len().saturating_sub(TOLD);
        let more = (more > 0).then(|| format!("and {more} more"));
        self.runs.iter().take(TOLD).cloned().chain(more).collect::<Vec<_>>().join("; ")
    }
}

/// A row a check, a column a kind of validation.
pub fn checks(outcome: &Outcome) -> Table {
    let (mut kinds, mut rows): (Vec<&str>, Vec<Check>) = (Vec::new(), Vec::new());
    for tried in &outcome.checks {
        if !kinds.contains(&tried.validation) {
            kinds.push(tried.validation);
        }
        if !rows.contains(&tried.check) {
            rows.push(tried.check);
        }
    }
    let row = |&check: &Check| {
        let works = kinds.iter().map(|kind| {
            let tried = outcome.checks.iter().find(|tried| tried.check == check && tried.validation == *kind);
            tried.map_or(Entry::Absent, |tried| match tried.works {
                true => Entry::Text(Words::yes_no(true)),
                false => Entry::Lacking(Words::both("NO", "НЕТ")),
            })
        });
        [Entry::of(check.name())].into_iter().chain(works).collect()
    };
    let name = Words::both("check works", "проверка работает");
    let head = [name].into_iter().chain(kinds.iter().map(Words::from)).collect();
    Table { head, rows: rows.iter().map(row).collect() }
}

pub fn passes(outcome: &Outcome) -> Table {
    let row = |&Pass { validation, in_window, runs, begun }: &Pass| {
        let place = match in_window {
            true => Words::both("in a window, without waiting for the display", "в окне, не дожидаясь экрана"),
            false => Words::both("off screen", "без окна"),
        };
        let stopped = || Words::both(format!("{runs}; {begun} of them were begun"), format!("{runs}; начато {begun}"));
        let runs = if begun < runs { Entry::Lacking(stopped()) } else { Entry::of(runs) };
        vec![Entry::of(validation), Entry::Text(place), runs]
    };
    let head = vec![Words::both("validation", "проверки"), Words::both("where", "где"), Words::both("runs", "запуски")];
    Table { head, rows: outcome.passes.iter().map(row).collect() }
}

/// What plans turn on and off in the runs of a pass.
pub fn switches(outcome: &Outcome) -> Table {
    let row = |&Switch { name, on, off }: &Switch| vec![Entry::of(name), Entry::of(on), Entry::of(off)];
    let head = vec![
        Words::both("in the plans of all runs", "в планах всех запусков"),
        Words::both("on", "есть"),
        Words::both("off", "нет"),
    ];
    Table { head, rows: outcome.switches.iter().map(row).collect() }
}
