//! How long work takes.

use std::time::{Duration, Instant};

/// Prints the shortest and the middle one of the times: other work on the machine only ever adds.
pub fn time(what: &str, samples: usize, work: impl Fn()) {
    let mut times: Vec<Duration> = (0..samples)
        .map(|_| {
            let begun = Instant::now();
            work();
            begun.elapsed()
        })
        .collect();
    times.sort();
    let (shortest, middle) = (times[0], times[samples / 2]);
    println!("{what}: {shortest:.1?} at least, median {middle:.1?} of {samples}");
}
