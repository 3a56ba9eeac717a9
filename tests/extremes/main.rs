//! Goal: the results are accurate at the limits of the input.
//!
//! Every extreme is compared with an independent answer: a closed form, a scaling law, an exact limit, or Bessel roots
//! of fifty digits. The table of the errors reached is `docs/extremes.md`; the test fails if it is out of date. It is
//! written again by `WRITE_EXTREMES=1 cargo test --release --test extremes`.

#![allow(
    clippy::disallowed_methods,
    reason = "tests compare with the solvers themselves"
)]

#[path = "../common/mod.rs"]
mod common;

mod bessel;
mod guides;
mod limits;
mod row;
mod saws;
mod speed;
mod thickness;
mod units;

use rayon::prelude::*;

use row::{FILE, HEAD, Row, assert_current, line_start};

/// The lines of the table.
const ALL: [fn() -> Row; 21] = [
    thickness::thickness_of_a_free_blade,
    thickness::thickness_of_a_guided_blade,
    bessel::needle_bore,
    bessel::narrow_ring,
    bessel::needle_collar,
    bessel::needle_collar_umbrella,
    bessel::narrow_clamped_ring,
    bessel::poisson_ratios,
    bessel::diameters_of_the_reference_basis,
    bessel::many_diameters,
    speed::membrane_ring,
    speed::membrane_disk,
    speed::hardly_turning,
    guides::soft_to_stiff_spring,
    guides::rigid_spring,
    guides::pad_under_the_whole_blade,
    guides::tiny_pad,
    guides::pads_on_the_same_spot,
    guides::evenly_spaced_pads,
    units::blade_sizes,
    units::units,
];

#[test]
fn every_extreme_keeps_its_promise() {
    let rows: Vec<Row> = ALL.par_iter().map(|row| row()).collect();
    let mut missed = Vec::new();
    for row in &rows {
        let line = format!("{}{:.1e} at {}", line_start(row), row.reached, row.place);
        println!("{line}");
        // A NaN is an error.
        let kept = row.reached <= row.asked;
        if !kept {
            missed.push(line);
        }
    }
    assert!(missed.is_empty(), "{missed:#?}");
    if std::env::var_os("WRITE_EXTREMES").is_some() {
        let lines = rows
            .iter()
            .map(|row| format!("{}{:.1e} |\n", line_start(row), row.reached));
        let page = HEAD.to_owned() + &lines.collect::<String>();
        std::fs::write(common::path(FILE), page).unwrap();
    }
    assert_current(&rows);
}
