//! Cuts under forces a hundred thousand times those that a saw tolerates.

use crate::pressed::assert_unstable;
use crate::trial::{Trial, mine};

#[test]
#[ignore = "a trial"]
fn the_most_violent_cuts_are_unstable() {
    let mut trial = Trial::new("violent cuts");
    for tangential_n in mine([1e5, 1e7, 8e8]) {
        trial.saw(&format!("{tangential_n:e} N per tooth"), || {
            assert_unstable(tangential_n);
            Vec::new()
        });
    }
    trial.end();
}
