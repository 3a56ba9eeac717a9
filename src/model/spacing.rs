//! Evenly spaced numbers.

/// `count` evenly spaced numbers over a range, including its ends.
pub fn evenly_spaced([from, to]: [f64; 2], count: usize) -> Vec<f64> {
    let last = count.max(2) - 1;
    (0..=last)
        .map(|k| from + (to - from) * k as f64 / last as f64)
        .collect()
}
