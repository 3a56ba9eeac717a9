//! Measurement of run times.

use std::time::{Duration, Instant};

/// Runs `work` a number of times and prints the shortest time, which other work on the machine affects least, and the
/// median.
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
