use serde::Serialize;

use crate::gpu::{Message, Messages, Remark, Severity};

/// Messages of one id and severity.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Group {
    /// Severity of all of them.
    pub severity: Severity,
    /// The layer's, mostly of a rule of the specification (VUID).
    pub id: String,
    /// How often they came.
    pub count: usize,
    /// Text of the first message.
    pub text: String,
    /// What was done when they came, each once.
    pub runs: Vec<String>,
}

/// What validation had to say.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Findings {
    /// In the order of their first messages.
    pub groups: Vec<Group>,
    /// What layers said that is no fault, with how often.
    pub remarks: Vec<(Remark, usize)>,
}

impl Findings {
    /// Number of messages in all groups.
    pub fn count(&self) -> usize {
        self.groups.iter().map(|group| group.count).sum()
    }

    /// Takes in the messages that `run` brought: all but the first `before`.
    pub fn note(&mut self, run: &str, messages: &Messages, before: usize) {
        for message in messages.after(before) {
            let Message { severity, id, text } = message;
            self.add_group(Group { severity, id, count: 1, text, runs: vec![run.to_owned()] });
        }
    }

    /// Takes in, once for an instance, what is no fault.
    pub fn note_remarks(&mut self, messages: &Messages) {
        messages.remarks().into_iter().for_each(|remark| self.add_remark(remark));
    }

    /// Takes in what was found elsewhere.
    pub fn add(&mut self, other: Self) {
        let Self { groups, remarks } = other;
        groups.into_iter().for_each(|group| self.add_group(group));
        remarks.into_iter().for_each(|remark| self.add_remark(remark));
    }

    fn add_group(&mut self, group: Group) {
        match self.groups.iter_mut().find(|known| (&known.id, known.severity) == (&group.id, group.severity)) {
            Some(known) => {
                known.count += group.count;
                let is_new = |run: &String| !known.runs.contains(run);
                let new: Vec<_> = group.runs.into_iter().filter(is_new).collect();
                known.runs.extend(new);
            }
            None => self.groups.push(group),
        }
    }

    fn add_remark(&mut self, (remark, count): (Remark, usize)) {
        match self.remarks.iter_mut().find(|(known, _)| *known == remark) {
            Some((_, sum)) => *sum += count,
            None => self.remarks.push((remark, count)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_are_grouped_by_id_and_severity_with_what_brought_them() {
        let messages = Messages::default();
        let mut findings = Findings::default();
        let mut say = |run: &str, said: &[(Severity, &str, &str)]| {
            let before = messages.count();
            for &(severity, id, text) in said {
                messages.push(Message { severity, id: id.to_owned(), text: text.to_owned() });
            }
            findings.note(run, &messages, before);
        };
        use Severity::{Error, Warning};
        say("opening", &[]);
        say("first", &[(Error, "A", "first A"), (Error, "B", "first B"), (Error, "A", "second A")]);
        say("second", &[(Error, "A", "third A"), (Warning, "A", "a warning")]);
        assert_eq!(findings.count(), 5);
        let group = |severity, id: &str, count, text: &str, runs: &[&str]| Group {
            severity,
            id: id.to_owned(),
            count,
            text: text.to_owned(),
            runs: runs.iter().map(|&run| run.to_owned()).collect(),
        };
        assert_eq!(
            findings.groups,
            [
                group(Error, "A", 3, "first A", &["first", "second"]),
                group(Error, "B", 1, "first B", &["first"]),
                group(Warning, "A", 1, "a warning", &["second"]),
            ]
        );
    }
}
