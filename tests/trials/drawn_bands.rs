//! Lists of bands of random saws, compared with every eigenvalue and with lists from other numbers of speeds.

use crate::trial::{Trial, mine};
use crate::{bands, certified, damped};

#[test]
#[ignore = "a trial"]
fn lists_of_bands_of_three_hundred_saws_are_those_of_all_eigenvalues() {
    let mut trial = Trial::new("bands of 300 saws");
    for saw in mine(0..300) {
        let file = bands::drawn_saw(saw);
        trial.saw(&format!("saw {saw}"), || bands::wrong_bands(&file));
    }
    trial.end();
}

#[test]
#[ignore = "a trial"]
fn lists_of_bands_of_twenty_saws_in_the_cut_are_those_of_all_eigenvalues() {
    let mut trial = Trial::new("bands of 20 saws in the cut");
    let saws = (0..).filter_map(|saw| Some((saw, bands::drawn_saw_in_cut(saw)?)));
    for (saw, file) in mine(saws.take(20)) {
        trial.saw(&format!("saw {saw}"), || bands::wrong_bands(&file));
    }
    trial.end();
}

#[test]
#[ignore = "a trial"]
fn bands_of_forty_damped_saws_are_those_of_every_eigenvalue() {
    let mut trial = Trial::new("bands of 40 damped saws");
    for (k, file) in mine((0..40).zip(damped::drawn_saws(40))) {
        trial.saw(&format!("saw {k}"), || {
            damped::peak_growth_of_bands(&file)
                .err()
                .into_iter()
                .collect()
        });
    }
    trial.end();
}

#[test]
#[ignore = "a trial"]
fn two_hundred_saws_have_the_same_bands_from_25_and_from_100_speeds() {
    let mut trial = Trial::new("bands of 200 saws from few speeds and from many");
    for (k, file) in mine((0..200).zip(certified::drawn_saws(200))) {
        trial.saw(&format!("saw {k}"), || {
            certified::assert_same_from_few_speeds(&file);
            Vec::new()
        });
    }
    trial.end();
}
