//! One view of a parsed file, whichever of the two syntaxes it has.
//!
//! A [`Node`] looks one level into the parser's own tree and is never descended blindly: how deep reading goes is
//! decided by what a scene has, not by what a file holds.

use std::borrow::Cow;
use std::ops::Range;

use jsonc_parser::ast::{ObjectPropName, Value as JsonValue};
use jsonc_parser::common::Ranged;
use jsonc_parser::{CollectOptions, ParseOptions};
use toml::Spanned;
use toml::de::{DeArray, DeTable, DeValue};

use super::Fault;
use crate::scene::text;

/// Longest part of a parser's own words that a message repeats, in characters.
const LONGEST_PARSER_MESSAGE: usize = 120;

/// A parsed file.
pub(super) enum Document<'t> {
    Toml(&'t str, Spanned<DeValue<'t>>),
    Json(&'t str, JsonValue<'t>),
}

/// A value of the file and where it stands.
#[derive(Clone, Copy)]
pub(super) enum Node<'t> {
    Toml(&'t str, &'t Spanned<DeValue<'t>>),
    Json(&'t str, &'t JsonValue<'t>),
}

/// What a node is, one level deep.
pub(super) enum Shape<'t> {
    /// In the order of the file for JSON, of the keys for TOML; JSON may repeat a key.
    Table(Vec<Entry<'t>>),
    Array(Elements<'t>),
    String(&'t str),
    Integer {
        digits: &'t str,
        radix: u32,
    },
    /// In a form that `f64::from_str` takes.
    Float(&'t str),
    /// A date, a truth value or JSON's null: a scene has none.
    Other,
}

/// The elements of an array, made when asked for: a hostile file has millions.
#[derive(Clone, Copy)]
pub(super) enum Elements<'t> {
    Toml(&'t str, &'t DeArray<'t>),
    Json(&'t str, &'t [JsonValue<'t>]),
}

impl<'t> Elements<'t> {
    pub(super) fn len(self) -> usize {
        match self {
            Self::Toml(_, array) => array.len(),
            Self::Json(_, array) => array.len(),
        }
    }

    pub(super) fn iter(self) -> impl Iterator<Item = Node<'t>> {
        (0..self.len()).map(move |index| self.at(index))
    }

    /// All of them, if they are `N`.
    pub(super) fn exactly<const N: usize>(self) -> Option<[Node<'t>; N]> {
        (self.len() == N).then(|| std::array::from_fn(|index| self.at(index)))
    }

    fn at(self, index: usize) -> Node<'t> {
        match self {
            Self::Toml(source, array) => Node::Toml(source, &array[index]),
            Self::Json(source, array) => Node::Json(source, &array[index]),
        }
    }
}

pub(super) struct Entry<'t> {
    pub(super) key: &'t str,
    pub(super) key_offset: usize,
    pub(super) value: Node<'t>,
}

impl<'t> Document<'t> {
    pub(super) fn parse_toml(source: &'t str) -> Result<Self, Fault> {
        let table = DeTable::parse(source).map_err(|error| {
            let span = error.span().unwrap_or(source.len()..source.len());
            syntax_fault("TOML", source, error.message(), span)
        })?;
        let whole = table.span();
        Ok(Self::Toml(source, Spanned::new(whole, DeValue::Table(table.into_inner()))))
    }

    pub(super) fn parse_json(source: &'t str) -> Result<Self, Fault> {
        let strict = ParseOptions {
            allow_comments: false,
            allow_loose_object_property_names: false,
            allow_trailing_commas: false,
            allow_missing_commas: false,
            allow_single_quoted_strings: false,
            allow_hexadecimal_numbers: false,
            allow_unary_plus_numbers: false,
            allow_bare_decimal_point_numbers: false,
            allow_non_finite_numbers: false,
            allow_extended_string_escapes: false,
        };
        let parsed = jsonc_parser::parse_to_ast(source, &CollectOptions::default(), &strict).map_err(|error| {
            let span = error.range().start..error.range().end;
            syntax_fault("JSON", source, &error.kind().to_string(), span)
        })?;
        match parsed.value {
            Some(value) => Ok(Self::Json(source, value)),
            None => Err(Fault { offset: 0, what: "empty; the default scene is {} in JSON".to_owned() }),
        }
    }

    pub(super) fn root(&self) -> Node<'_> {
        match self {
            Self::Toml(source, value) => Node::Toml(source, value),
            Self::Json(source, value) => Node::Json(source, value),
        }
    }
}

fn syntax_fault(syntax: &str, source: &str, problem: &str, span: Range<usize>) -> Fault {
    let problem = text::one_line(problem, LONGEST_PARSER_MESSAGE);
    let near = text::one_line(source.get(span.clone()).unwrap_or_default(), text::LONGEST_QUOTE);
    let near = if near.is_empty() { "the end of the line or file".to_owned() } else { near };
    Fault { offset: span.start, what: format!("not valid {syntax}: {problem}, at {near}") }
}

impl<'t> Node<'t> {
    /// Bytes from the start of the file.
    pub(super) fn offset(self) -> usize {
        self.span().start
    }

    /// The value as the file spells it, cut to fit a message.
    pub(super) fn quote(self) -> String {
        let (Self::Toml(source, _) | Self::Json(source, _)) = self;
        let spelled = source.get(self.span()).unwrap_or_default();
        // A TOML table made by a header or a dotted key has no text of its own: its span is the header or the key.
        if self.is_table() && !spelled.starts_with('{') {
            return "a table".to_owned();
        }
        text::one_line(spelled, text::LONGEST_QUOTE)
    }

    pub(super) fn is_table(self) -> bool {
        match self {
            Self::Toml(_, value) => value.get_ref().is_table(),
            Self::Json(_, value) => value.as_object().is_some(),
        }
    }

    pub(super) fn shape(self) -> Shape<'t> {
        match self {
            Self::Toml(source, value) => match value.get_ref() {
                DeValue::String(string) => Shape::String(string),
                DeValue::Integer(integer) => Shape::Integer { digits: integer.as_str(), radix: integer.radix() },
                DeValue::Float(float) => Shape::Float(float.as_str()),
                DeValue::Boolean(_) | DeValue::Datetime(_) => Shape::Other,
                DeValue::Array(array) => Shape::Array(Elements::Toml(source, array)),
                DeValue::Table(table) => {
                    let entry = |(key, value): (&'t Spanned<Cow<'t, str>>, &'t Spanned<DeValue<'t>>)| Entry {
                        key: key.get_ref(),
                        key_offset: key.span().start,
                        value: Self::Toml(source, value),
                    };
                    Shape::Table(table.iter().map(entry).collect())
                }
            },
            Self::Json(source, value) => match value {
                JsonValue::StringLit(string) => Shape::String(&string.value),
                JsonValue::NumberLit(number) if number.value.contains(['.', 'e', 'E']) => Shape::Float(number.value),
                JsonValue::NumberLit(number) => Shape::Integer { digits: number.value, radix: 10 },
                JsonValue::BooleanLit(_) | JsonValue::NullKeyword(_) => Shape::Other,
                JsonValue::Array(array) => Shape::Array(Elements::Json(source, &array.elements)),
                JsonValue::Object(object) => {
                    let entry = |property: &'t jsonc_parser::ast::ObjectProp<'t>| Entry {
                        key: match &property.name {
                            ObjectPropName::String(name) => &name.value,
                            ObjectPropName::Word(name) => name.value,
                        },
                        key_offset: property.name.start(),
                        value: Self::Json(source, &property.value),
                    };
                    Shape::Table(object.properties.iter().map(entry).collect())
                }
            },
        }
    }

    /// The value under `key`, if this is a table that has it.
    pub(super) fn get(self, key: &str) -> Option<Self> {
        let Shape::Table(entries) = self.shape() else { return None };
        entries.into_iter().find(|entry| entry.key == key).map(|entry| entry.value)
    }

    /// The element at `index`, if this is an array that has it.
    pub(super) fn at(self, index: usize) -> Option<Self> {
        let Shape::Array(elements) = self.shape() else { return None };
        (index < elements.len()).then(|| elements.at(index))
    }

    fn span(self) -> Range<usize> {
        match self {
            Self::Toml(_, value) => value.span(),
            Self::Json(_, value) => value.start()..value.end(),
        }
    }
}
