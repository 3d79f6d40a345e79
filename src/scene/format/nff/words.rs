//! The words of a file: what stands between spaces and line ends, and not behind a `#`.

use std::io::{BufRead, BufReader, Read};

use glam::DVec3;

use super::at;
use crate::scene::format::unreadable;
use crate::scene::{SceneError, text};

/// No number that a program writes is longer; a word that goes on is not kept.
const LONGEST: usize = 256;

pub(super) struct Words<'r> {
    file: BufReader<&'r mut dyn Read>,
    word: String,
    /// Of the word, from 1.
    line: usize,
    /// Of what is read next.
    next_line: usize,
    is_put_back: bool,
}

impl<'r> Words<'r> {
    pub(super) fn new(file: &'r mut dyn Read) -> Self {
        let file = BufReader::with_capacity(1 << 16, file);
        Self { file, word: String::new(), line: 1, next_line: 1, is_put_back: false }
    }

    /// Goes to the next word; `false` at the end.
    pub(super) fn advance(&mut self) -> Result<bool, SceneError> {
        if std::mem::take(&mut self.is_put_back) {
            return Ok(true);
        }
        let mut bytes = std::mem::take(&mut self.word).into_bytes();
        bytes.clear();
        let mut is_comment = false;
        loop {
            let buffer = self.file.fill_buf().map_err(unreadable)?;
            if buffer.is_empty() {
                break;
            }
            let mut used = 0;
            let mut is_whole = false;
            for &byte in buffer {
                let is_blank = byte.is_ascii_whitespace() || byte == b'#';
                // What ends a word is left for the next call, which counts the lines.
                if is_blank && !bytes.is_empty() {
                    is_whole = true;
                    break;
                }
                used += 1;
                match byte {
                    b'\n' => {
                        self.next_line += 1;
                        is_comment = false;
                    }
                    b'#' => is_comment = true,
                    _ if is_comment || is_blank => {}
                    _ => {
                        self.line = self.next_line;
                        if bytes.len() < LONGEST {
                            bytes.push(byte);
                        }
                    }
                }
            }
            self.file.consume(used);
            if is_whole {
                break;
            }
        }
        let is_here = !bytes.is_empty();
        self.word =
            String::from_utf8(bytes).unwrap_or_else(|error| String::from_utf8_lossy(error.as_bytes()).into_owned());
        Ok(is_here)
    }

    /// The next [`advance`](Words::advance) comes to the same word.
    pub(super) fn put_back(&mut self) {
        self.is_put_back = true;
    }

    pub(super) fn word(&self) -> &str {
        &self.word
    }

    /// For a message.
    pub(super) fn quote(&self) -> String {
        format!("\"{}\"", text::one_line(&self.word, text::LONGEST_QUOTE))
    }

    /// That the word stands in, from 1.
    pub(super) fn line(&self) -> usize {
        self.line
    }

    /// Whether the word is a number, or begins as one.
    pub(super) fn is_number(&self) -> bool {
        self.word.starts_with(|first: char| first.is_ascii_digit() || "+-.".contains(first))
    }

    fn value<T>(&mut self, entity: &str, rule: &str, parse: impl Fn(&str) -> Option<T>) -> Result<T, SceneError> {
        if !self.advance()? {
            return Err(at(self.line, format!("{entity}: the file ends where a number must be")));
        }
        parse(&self.word).ok_or_else(|| at(self.line, format!("{entity}: {}: {rule}", self.quote())))
    }

    pub(super) fn number(&mut self, entity: &str) -> Result<f64, SceneError> {
        let parse = |word: &str| word.parse::<f64>().ok().filter(|number| number.is_finite());
        self.value(entity, "must be a finite number", parse)
    }

    pub(super) fn whole(&mut self, entity: &str) -> Result<u64, SceneError> {
        self.value(entity, "must be a whole number", |word| word.parse().ok())
    }

    pub(super) fn numbers<const N: usize>(&mut self, entity: &str) -> Result<[f64; N], SceneError> {
        let mut numbers = [0.0; N];
        for number in &mut numbers {
            *number = self.number(entity)?;
        }
        Ok(numbers)
    }

    pub(super) fn vector(&mut self, entity: &str) -> Result<DVec3, SceneError> {
        self.numbers(entity).map(DVec3::from_array)
    }
}
