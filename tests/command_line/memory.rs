//! Goal: a chart fits into the memory of a small machine.

use crate::memory_of_a_chart::functions_and_megabytes;

/// `tests/trials/fine_chart.rs` has a chart of 4230 functions in less than 2000 MB.
#[test]
fn a_chart_of_many_functions_takes_little_memory() {
    let (functions, megabytes) = functions_and_megabytes(1e-4, 300);
    assert!(functions > 1000, "{functions}");
    assert!(megabytes > 20.0 && megabytes < 400.0, "{megabytes} MB");
}
