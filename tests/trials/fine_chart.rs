//! A fine chart fits into the memory of a small machine.

use crate::memory::functions_and_megabytes;
use crate::trial::{Trial, mine};

/// Three dense matrices of 4230 functions take 430 MB; the basis for the estimate of the error has 6930.
#[test]
#[ignore = "a trial"]
fn a_chart_of_four_thousand_functions_takes_less_than_two_gigabytes() {
    let mut trial = Trial::new("memory of a fine chart");
    for tolerance in mine([2e-6]) {
        trial.saw("the paper's saw", || {
            let (functions, megabytes) = functions_and_megabytes(tolerance, 3600);
            let holds = functions == 4230 && megabytes > 100.0 && megabytes < 2000.0;
            let wrong = (!holds).then(|| format!("{functions} functions, {megabytes} MB"));
            wrong.into_iter().collect()
        });
    }
    trial.end();
}
