//! One line of the table of extremes, and its comparison with the page.

use crate::common::{self, relative_error};

/// One line of the table.
pub struct Row {
    pub what: &'static str,
    pub range: &'static str,
    pub answer: &'static str,
    pub asked: f64,
    pub reached: f64,
    pub place: String,
}

impl Row {
    pub fn new(what: &'static str, range: &'static str, answer: &'static str, asked: f64) -> Self {
        Row {
            what,
            range,
            answer,
            asked,
            reached: 0.0,
            place: "nothing was compared".into(),
        }
    }

    pub fn add(&mut self, error: f64, place: impl FnOnce() -> String) {
        if error >= self.reached || error.is_nan() {
            self.reached = error;
            self.place = place();
        }
    }

    /// Compares pairs of numbers by their relative difference.
    pub fn compare(&mut self, actual: &[f64], expected: &[f64], place: &str) {
        assert!(
            !expected.is_empty() && actual.len() >= expected.len(),
            "{place}"
        );
        for (k, (a, e)) in actual.iter().zip(expected).enumerate() {
            self.add(relative_error(*a, *e), || {
                format!("{place}, no. {k}: {a} for {e}")
            });
        }
    }
}

pub const FILE: &str = "docs/extremes.md";

pub const HEAD: &str = "\
# Extremes

This table lists extreme values of the input, and the largest relative error of the results there, by
comparison with an independent answer. `WRITE_EXTREMES=1 cargo test --release --test extremes` writes
it; without the variable the test fails if an error exceeds the allowed one (\"asked\"), or three times
the error on this page (\"reached\").

| what | range | independent answer | asked | reached |
|---|---|---|---|---|
";

/// The line of the table without its last column, the error reached.
pub fn line_start(row: &Row) -> String {
    let Row {
        what,
        range,
        answer,
        asked,
        ..
    } = row;
    format!("| {what} | {range} | {answer} | {asked:.0e} | ")
}

/// Compares the errors with those of the page, by the start of each line. Rounding differs between processors, so that
/// a page is current while no error is three times its value there.
pub fn assert_current(rows: &[Row]) {
    let page = std::fs::read_to_string(common::path(FILE)).unwrap();
    let lines = page.lines().filter(|line| line.starts_with("| ")).count();
    assert_eq!(
        lines,
        rows.len() + 1,
        "{FILE} has other lines than the test"
    );
    for row in rows {
        let start = line_start(row);
        let line = page.lines().find_map(|line| line.strip_prefix(&start));
        let stated: f64 = line
            .and_then(|rest| rest.trim_end_matches([' ', '|']).parse().ok())
            .unwrap_or_else(|| panic!("{FILE} does not have {start}"));
        let rounding = 1e-14;
        assert!(
            row.reached <= 3.0 * stated + rounding,
            "{FILE} is not current: {start}{:.1e}",
            row.reached
        );
    }
}
