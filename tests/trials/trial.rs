//! The output of a trial while it runs: a line for each saw with its seconds, and the time of the whole; and the
//! division of the saws between machines.

use std::io::Write;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::Instant;

/// Part k of n by the variable SAWFLUTTER_SHARD, "k/n"; part 1 of 1 by default.
fn shard() -> (usize, usize) {
    let Ok(text) = std::env::var("SAWFLUTTER_SHARD") else {
        return (1, 1);
    };
    let parts = text.split_once('/');
    let numbers = parts.and_then(|(k, n)| Some((k.parse().ok()?, n.parse().ok()?)));
    numbers
        .filter(|(k, n)| (1..=*n).contains(k))
        .unwrap_or_else(|| {
            panic!("SAWFLUTTER_SHARD is {text}; it takes \"2/5\", the second of five parts")
        })
}

/// Every n-th item, from the k-th on.
pub fn mine<T>(all: impl IntoIterator<Item = T>) -> impl Iterator<Item = T> {
    let (part, of) = shard();
    all.into_iter().skip(part - 1).step_by(of)
}

/// Whether this part is everything.
pub fn is_whole() -> bool {
    shard() == (1, 1)
}

/// Prints to standard error directly, because the test runner withholds the output of macros.
fn tell(line: &str) {
    let _ = writeln!(std::io::stderr().lock(), "{line}");
}

pub struct Trial {
    name: &'static str,
    begun: Instant,
    saws: usize,
    wrong: Vec<String>,
}

impl Trial {
    pub fn new(name: &'static str) -> Self {
        Trial {
            name,
            begun: Instant::now(),
            saws: 0,
            wrong: Vec::new(),
        }
    }

    /// Tries a saw, and continues with the next one after any result.
    pub fn saw(&mut self, what: &str, wrong: impl FnOnce() -> Vec<String>) {
        let begun = Instant::now();
        // The line is begun before the computation, so that a stopped trial shows its last saw.
        tell(&format!("{}: {what} …", self.name));
        let found = catch_unwind(AssertUnwindSafe(wrong));
        let wrong = found.unwrap_or_else(|_| vec!["it panicked".to_owned()]);
        let verdict = if wrong.is_empty() { "right" } else { "WRONG" };
        let seconds = begun.elapsed().as_secs_f64();
        tell(&format!("{}: {what} {verdict}, {seconds:.1} s", self.name));
        self.saws += 1;
        self.wrong
            .extend(wrong.into_iter().map(|wrong| format!("{what}: {wrong}")));
    }

    pub fn end(self) {
        let seconds = self.begun.elapsed().as_secs_f64();
        tell(&format!(
            "{}: {} saws in {seconds:.0} s",
            self.name, self.saws
        ));
        assert!(self.wrong.is_empty(), "{}: {:#?}", self.name, self.wrong);
    }
}
