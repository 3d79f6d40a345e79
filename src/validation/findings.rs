use serde::Serialize;

use crate::gpu::{Allowance, Message, Messages};

/// Messages of one id.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Group {
    /// The layer's, mostly of a rule of the specification (VUID).
    pub id: String,
    pub count: usize,
    /// Of the first message.
    pub text: String,
    /// What was done when they came, each once.
    pub runs: Vec<String>,
}

/// What validation had to say.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Findings {
    /// In the order of their first messages.
    pub groups: Vec<Group>,
    /// What was said and is no fault, with how often.
    pub allowed: Vec<(Allowance, usize)>,
}

impl Findings {
    /// Of all groups.
    pub fn count(&self) -> usize {
        self.groups.iter().map(|group| group.count).sum()
    }

    /// Takes in the messages that `run` brought: all but the first `before`.
    pub fn note(&mut self, run: &str, messages: &Messages, before: usize) {
        for message in messages.after(before) {
            let Message { id, text } = message;
            self.add_group(Group { id, count: 1, text, runs: vec![run.to_owned()] });
        }
    }

    /// Takes in, once for an instance, what is allowed.
    pub fn note_allowed(&mut self, messages: &Messages) {
        messages.allowed().into_iter().filter(|(_, count)| *count > 0).for_each(|allowed| self.add_allowed(allowed));
    }

    /// Takes in what was found elsewhere.
    pub fn add(&mut self, other: Self) {
        let Self { groups, allowed } = other;
        groups.into_iter().for_each(|group| self.add_group(group));
        allowed.into_iter().for_each(|allowed| self.add_allowed(allowed));
    }

    fn add_group(&mut self, group: Group) {
        match self.groups.iter_mut().find(|known| known.id == group.id) {
            Some(known) => {
                known.count += group.count;
                let is_new = |run: &String| !known.runs.contains(run);
                let new: Vec<_> = group.runs.into_iter().filter(is_new).collect();
                known.runs.extend(new);
            }
            None => self.groups.push(group),
        }
    }

    fn add_allowed(&mut self, (allowance, count): (Allowance, usize)) {
        match self.allowed.iter_mut().find(|(known, _)| *known == allowance) {
            Some((_, sum)) => *sum += count,
            None => self.allowed.push((allowance, count)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_are_grouped_by_their_ids_with_what_brought_them() {
        let messages = Messages::default();
        let mut findings = Findings::default();
        let mut say = |run: &str, said: &[(&str, &str)]| {
            let before = messages.count();
            for (id, text) in said {
                messages.push(Message { id: (*id).to_owned(), text: (*text).to_owned() });
            }
            findings.note(run, &messages, before);
        };
        say("opening", &[]);
        say("first", &[("A", "first A"), ("B", "first B"), ("A", "second A")]);
        say("second", &[("A", "third A"), ("x-specialuse-extension-debugging", "")]);
        findings.note_allowed(&messages);
        findings.note_allowed(&messages);
        assert_eq!(findings.count(), 4);
        let group = |id: &str, count, text: &str, runs: &[&str]| Group {
            id: id.to_owned(),
            count,
            text: text.to_owned(),
            runs: runs.iter().map(|&run| run.to_owned()).collect(),
        };
        assert_eq!(
            findings.groups,
            [group("A", 3, "first A", &["first", "second"]), group("B", 1, "first B", &["first"])]
        );
        let [(allowance, 2)] = findings.allowed[..] else { panic!("{:?}", findings.allowed) };
        assert_eq!(allowance.id_part, "specialuse-extension-debugging");
    }
}
