//! Size and units.

use sawflutter::scene::SceneFile;

use crate::row::Row;
use crate::saws::{paper, scaled, signature};

/// The paper's saw with lengths × L, masses × M, times × T.
fn in_other_units(length: f64, mass: f64, time: f64) -> SceneFile {
    let mut file = paper();
    let blade = &mut file.blade;
    blade.outer_diameter_m *= length;
    blade.inner_diameter_m *= length;
    blade.thickness_m *= length;
    blade.material.youngs_modulus_pa *= mass / (length * time * time);
    blade.material.density_kg_per_m3 *= mass / length.powi(3);
    for pad in &mut file.guides {
        pad.radius_m *= length;
        pad.radial_length_m *= length;
        pad.tangential_length_m *= length;
        pad.stiffness_n_per_m *= mass / (time * time);
    }
    file
}

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
        let file = in_other_units(length, length.powi(3), length);
        let expected = scaled(&reference, 1.0 / length);
        row.compare(&signature(&file), &expected, &format!("{diameter_m} m"));
    }
    row
}

pub fn units() -> Row {
    let mut row = Row::new(
        "units of length and of time",
        "scaled by 1e±6",
        "everything goes with 1/T",
        1e-8,
    );
    let reference = signature(&paper());
    // The unit of mass goes along, to stay within what a scene may contain.
    for (length, mass, time) in [
        (1e6, 1e6, 1.0),
        (1e-6, 1e-9, 1.0),
        (1.0, 1e-10, 1e-6),
        (1.0, 1e9, 1e6),
        (1.0, 1e3, 1.0),
        (1.0, 1e-6, 1.0),
    ] {
        let file = in_other_units(length, mass, time);
        let expected = scaled(&reference, 1.0 / time);
        row.compare(
            &signature(&file),
            &expected,
            &format!("L {length:e}, M {mass:e}, T {time:e}"),
        );
    }
    row
}
