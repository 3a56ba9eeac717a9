//! Thickness.

use sawflutter::model::plate::Resolution;
use sawflutter::model::scene::Accuracy;

use crate::row::Row;
use crate::saws::{critical, paper, scaled, signature, unguided};

pub fn thickness_of_a_free_blade() -> Row {
    let mut row = Row::new(
        "thickness, free blade",
        "1 µm to 50 mm",
        "critical speeds are proportional to it",
        1e-10,
    );
    let reference = critical(&unguided(), Resolution::of(Accuracy::Design));
    for thickness_m in [1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.05] {
        let mut file = unguided();
        file.blade.thickness_m = thickness_m;
        let expected = scaled(&reference[..10], thickness_m / 0.0028);
        let found = critical(&file, Resolution::of(Accuracy::Design));
        row.compare(&found, &expected, &format!("{thickness_m} m"));
    }
    row
}

pub fn thickness_of_a_guided_blade() -> Row {
    let mut row = Row::new(
        "thickness, pad stiffness with its cube",
        "1 µm to 20 mm",
        "bands, growth and critical speeds are proportional to it",
        1e-8,
    );
    let reference = signature(&paper());
    for thickness_m in [1e-6, 1e-4, 0.02] {
        let mut file = paper();
        let factor: f64 = thickness_m / file.blade.thickness_m;
        file.blade.thickness_m = thickness_m;
        file.guides[0].stiffness_n_per_m *= factor.powi(3);
        let expected = scaled(&reference, factor);
        row.compare(&signature(&file), &expected, &format!("{thickness_m} m"));
    }
    row
}
