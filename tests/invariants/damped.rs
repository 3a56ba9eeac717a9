//! Bands of damped saws, compared with every eigenvalue of the full model; `tests/trials/drawn_bands.rs` takes forty.

use proptest::prelude::*;

use crate::damped_bands::{any_damped_saw, peak_growth_of_bands};
use crate::draws::check;

#[test]
fn bands_of_damped_saws_are_those_of_every_eigenvalue() {
    let strongest = std::cell::Cell::new(0.0_f64);
    check(2, any_damped_saw(), |file| {
        let found = peak_growth_of_bands(&file);
        let growth = found.map_err(|wrong| {
            let file = serde_json::to_string(&file).unwrap();
            TestCaseError::fail(format!("{wrong}\n{file}"))
        })?;
        strongest.set(strongest.get().max(growth));
        Ok(())
    });
    let strongest_coupling = strongest.get();
    assert!(
        strongest_coupling > 0.25,
        "the draw tests nothing: {strongest_coupling} 1/s"
    );
}
