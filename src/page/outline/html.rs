//! An outline as HTML.

use super::table::{Row, Table};
use super::{Block, Fact, Outline};
use crate::page::text::escaped;

impl Outline {
    /// The text as elements of a page, with its details; remarks come first.
    pub fn in_html(&self) -> String {
        let mut html = String::new();
        let remarks: String = self
            .blocks()
            .filter_map(|block| match block {
                Block::Remark { word, text } => Some(paragraph("", &format!("{word}: {text}"))),
                _ => None,
            })
            .collect();
        if !remarks.is_empty() {
            html.push_str(&format!("<div class=\"remarks\">\n{remarks}</div>\n"));
        }
        for block in self.blocks() {
            html.push_str(&match block {
                Block::Remark { .. } => String::new(),
                Block::Heading(text) => paragraph("facts", text),
                Block::Headline(text) => paragraph("answer", text),
                Block::Reason(text) | Block::Sentence(text) => paragraph("", text),
                Block::Facts { title, facts } => of_facts(title, facts),
                Block::Table(table) => table.in_html(),
            });
        }
        html
    }
}

fn paragraph(class: &str, text: &str) -> String {
    let class = match class {
        "" => String::new(),
        name => format!(" class=\"{name}\""),
    };
    format!("<p{class}>{}</p>\n", escaped(text))
}

fn title(text: &str) -> String {
    match text {
        "" => String::new(),
        text => format!("<h3>{}</h3>\n", escaped(text)),
    }
}

fn of_facts(name: &str, facts: &[Fact]) -> String {
    let rows = facts.iter().map(|fact| {
        format!(
            "<tr><th scope=\"row\">{}</th><td>{}</td></tr>\n",
            escaped(&fact.name),
            escaped(&fact.in_words())
        )
    });
    format!(
        "{}<table>\n{}</table>\n",
        title(name),
        rows.collect::<String>()
    )
}

impl Table {
    /// The table with its title.
    pub fn in_html(&self) -> String {
        let heads = self.columns.iter().map(|column| {
            let unit = match column.unit {
                "" => String::new(),
                unit => format!(" [{unit}]"),
            };
            let name = format!("{} {}{unit}", column.group, column.name);
            format!("<th scope=\"col\">{}</th>", escaped(name.trim_start()))
        });
        let columns = self.columns.len();
        let row = |row: &Row| {
            let cells = row.cells.iter().map(|value| {
                let class = if value.is_number() {
                    " class=\"number\""
                } else {
                    ""
                };
                format!("<td{class}>{}</td>", escaped(&value.in_words()))
            });
            let remark = row.remark.iter().map(|remark| {
                format!(
                    "<tr><td colspan=\"{columns}\">{}</td></tr>\n",
                    escaped(remark)
                )
            });
            format!(
                "<tr>{}</tr>\n{}",
                cells.collect::<String>(),
                remark.collect::<String>()
            )
        };
        format!(
            "{}<table>\n<thead><tr>{}</tr></thead>\n<tbody>\n{}</tbody>\n</table>\n",
            title(&self.title),
            heads.collect::<String>(),
            self.rows.iter().map(row).collect::<String>()
        )
    }
}
