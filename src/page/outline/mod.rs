//! A text as an outline: the answer, sentences, facts and tables, of which every face makes its own text.
//!
//! An analysis writes an [`Outline`] once. [`Outline::in_columns`] prints it in 80 columns, [`Outline::in_html`] as a
//! part of a page; the live page gets its tables and facts as JSON. Numbers stay numbers with unit and digits until
//! they are shown.

mod columns;
mod html;
mod table;
mod value;

#[cfg(feature = "cli")]
pub use columns::wrapped;
pub use columns::{WIDTH, shortened};
pub use table::{Column, Row, Table};
pub use value::{
    FORCE, FREQUENCY, GROWTH, KELVIN, LENGTH, METRES, Measure, PERCENT, PLAIN, SPEED, STIFFNESS,
    TIME, Value,
};

/// Number of characters of a name that precedes a long condition of the saw.
const SHORT_NAME: usize = 40;

/// A text in its order.
#[derive(Debug, Clone, Default, PartialEq)]
#[cfg_attr(feature = "page", derive(serde::Serialize))]
#[cfg_attr(feature = "page", serde(transparent))]
pub struct Outline {
    parts: Vec<Part>,
}

/// A block, and whether it belongs to the details, which a designer does not need.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "page", derive(serde::Serialize))]
struct Part {
    block: Block,
    is_detail: bool,
}

/// A part of a text.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "page", derive(serde::Serialize))]
#[cfg_attr(feature = "page", serde(rename_all = "snake_case"))]
enum Block {
    /// Name of the saw and its condition.
    Heading(String),
    /// The answer.
    Headline(String),
    /// A reason of the answer.
    Reason(String),
    Sentence(String),
    /// A sentence after a word, as in "Warning: …".
    Remark {
        word: &'static str,
        text: String,
    },
    Facts {
        title: String,
        facts: Vec<Fact>,
    },
    Table(Table),
}

/// A named number.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "page", derive(serde::Serialize))]
pub struct Fact {
    pub name: String,
    pub value: Value,
    /// The value before a search.
    pub before: Option<Value>,
    /// Further words after the value.
    pub remark: String,
}

impl Fact {
    pub fn new(name: impl Into<String>, value: impl Into<Value>) -> Self {
        Fact {
            name: name.into(),
            value: value.into(),
            before: None,
            remark: String::new(),
        }
    }

    pub fn after(self, before: Value) -> Self {
        let before = Some(before);
        Fact { before, ..self }
    }

    pub fn with(self, remark: impl Into<String>) -> Self {
        let remark = remark.into();
        Fact { remark, ..self }
    }

    /// The value with its unit, after the value before a search if that differs, and before the remark.
    pub fn in_words(&self) -> String {
        let now = self.value.with_unit();
        let before = self.before.as_ref().map(Value::in_words);
        let changed = before.filter(|before| *before != self.value.in_words());
        let value = changed.map_or(now.clone(), |before| format!("{before} → {now}"));
        format!("{value} {}", self.remark).trim_end().to_owned()
    }
}

impl Outline {
    /// Begins with the name of a scene, its condition and its unusual numbers. They come before the answer, because
    /// another load or a mistyped number makes it the answer for another saw.
    pub fn of(name: &str, condition: &str, unusual_numbers: &[String]) -> Self {
        let mut outline = Outline::default();
        outline.heading(name, condition);
        outline.remarks("Unusual number", unusual_numbers);
        outline
    }

    /// Adds a name, and whether the saw idles or is in its cut.
    pub fn heading(&mut self, name: &str, condition: &str) {
        let room = WIDTH.saturating_sub(": ".len() + condition.chars().count());
        let name = shortened(name, room.max(SHORT_NAME));
        self.add(Block::Heading(format!("{name}: {condition}")));
    }

    pub fn headline(&mut self, text: impl Into<String>) {
        self.add(Block::Headline(text.into()));
    }

    pub fn reason(&mut self, text: impl Into<String>) {
        self.add(Block::Reason(text.into()));
    }

    pub fn sentence(&mut self, text: impl Into<String>) {
        self.add(Block::Sentence(text.into()));
    }

    /// Adds sentences, each after a word: "Warning: …".
    pub fn remarks(&mut self, word: &'static str, sentences: &[String]) {
        for text in sentences {
            let text = text.clone();
            self.add(Block::Remark { word, text });
        }
    }

    /// Adds facts; a title may be empty.
    pub fn facts(&mut self, title: impl Into<String>, facts: impl IntoIterator<Item = Fact>) {
        self.add(Block::Facts {
            title: title.into(),
            facts: facts.into_iter().collect(),
        });
    }

    /// Adds a table; one without rows is left out.
    pub fn table(&mut self, table: Table) {
        if !table.rows.is_empty() {
            self.add(Block::Table(table));
        }
    }

    /// Makes all that `write` adds a detail.
    pub fn details(&mut self, write: impl FnOnce(&mut Outline)) {
        let first = self.parts.len();
        write(self);
        for part in &mut self.parts[first..] {
            part.is_detail = true;
        }
    }

    /// The answer in one line: the headlines, reasons and sentences before the first table, or without a headline the first
    /// facts or the heading.
    pub fn answer(&self) -> String {
        let is_headline = |block: &&Block| matches!(block, Block::Headline(_));
        let is_table = |block: &&Block| matches!(block, Block::Table(_) | Block::Facts { .. });
        let below = self.blocks().skip_while(|block| !is_headline(block));
        let texts = below.take_while(|block| !is_table(block));
        let said = texts.filter_map(|block| match block {
            Block::Headline(text) | Block::Reason(text) | Block::Sentence(text) => {
                Some(text.as_str())
            }
            _ => None,
        });
        let said: Vec<&str> = said.collect();
        if !said.is_empty() {
            return said.join("; ");
        }
        let facts = self.blocks().find_map(|block| match block {
            Block::Facts { facts, .. } => {
                let words = facts
                    .iter()
                    .map(|fact| format!("{} {}", fact.name, fact.in_words()));
                Some(words.collect::<Vec<_>>().join("; "))
            }
            _ => None,
        });
        let heading = self.blocks().find_map(|block| match block {
            Block::Heading(text) => Some(text.clone()),
            _ => None,
        });
        facts.or(heading).unwrap_or_default()
    }

    fn blocks(&self) -> impl Iterator<Item = &Block> {
        self.parts.iter().map(|part| &part.block)
    }

    fn add(&mut self, block: Block) {
        let is_detail = false;
        self.parts.push(Part { block, is_detail });
    }

    /// Appends another outline.
    pub fn extend(&mut self, other: Outline) {
        self.parts.extend(other.parts);
    }

    /// The answer, its reasons and the sentences, a line each.
    #[cfg(feature = "page")]
    pub fn lines(&self) -> Vec<&str> {
        let lines = self.blocks().filter_map(|block| match block {
            Block::Headline(text) | Block::Reason(text) | Block::Sentence(text) => {
                Some(text.as_str())
            }
            _ => None,
        });
        lines.collect()
    }

    /// Names its facts by `name`, where that has another name for them.
    #[cfg(feature = "page")]
    pub fn rename_facts(&mut self, name: impl Fn(&str) -> Option<String>) {
        for part in &mut self.parts {
            if let Block::Facts { facts, .. } = &mut part.block {
                for fact in facts {
                    fact.name = name(&fact.name).unwrap_or_else(|| std::mem::take(&mut fact.name));
                }
            }
        }
    }
}
