//! Size and units.

use crate::common::in_units;
use crate::row::Row;
use crate::saws::{paper, scaled, signature};

pub fn blade_sizes() -> Row {
    let mut row = Row::new(
        "size of the same saw",
        "10 mm dental disk to 3 m stone saw",
        "at equal E and ρ everything goes with 1/L",
        1e-8,
    );
    let reference = signature(&paper());
    for diameter_m in [0.01, 0.05, 3.0] {
        let length: f64 = diameter_m / 0.71;
        // Equal E and ρ: M = L³, T = L.
        let file = in_units(&paper(), [length, length.powi(3), length]);
        let expected = scaled(&reference, 1.0 / length);
        row.compare(&signature(&file), &expected, &format!("{diameter_m} m"));
    }
    row
}

pub fn units() -> Row {
    let mut row = Row::new(
        "units of length and of time",
        "scaled by 10 (length), 100 (mass), 10 (time)",
        "everything goes with 1/T",
        1e-8,
    );
    let reference = signature(&paper());
    // The unit of mass changes too, so that the numbers remain within the limits of a scene.
    for (length, mass, time) in [
        (10.0, 100.0, 1.0),
        (0.1, 1e-4, 1.0),
        (1.0, 0.01, 0.1),
        (1.0, 100.0, 10.0),
        (1.0, 10.0, 1.0),
        (1.0, 0.01, 1.0),
    ] {
        let file = in_units(&paper(), [length, mass, time]);
        let expected = scaled(&reference, 1.0 / time);
        row.compare(
            &signature(&file),
            &expected,
            &format!("L {length:e}, M {mass:e}, T {time:e}"),
        );
    }
    row
}
