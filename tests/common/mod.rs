//! Functions of several test programs. Each program uses some of them.
#![allow(dead_code)]

pub mod limit;

use std::path::{Path, PathBuf};

use sawflutter::model::plate::{Plate, Resolution};
use sawflutter::model::scene::{Accuracy, Mount, Scene, SceneFile, SpeedRange};
use sawflutter::modes::{Mode, SpectralModel, Strategy};

/// Whether a message contains words, whose pieces between ellipses stand in this order.
pub fn says(message: &str, words: &str) -> bool {
    let mut pieces = words.split('…').map(str::trim);
    let rest = pieces.try_fold(message, |rest, piece| Some(rest.split_once(piece)?.1));
    rest.is_some()
}

/// A file that comes with the crate.
pub fn path(inside: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(inside)
}

/// A scene from `scenes/`.
pub fn scene(name: &str) -> Scene {
    Scene::from_path(path(&format!("scenes/{name}.json"))).unwrap_or_else(|e| panic!("{e}"))
}

/// The modes of a saw from rest to a speed, at reference accuracy.
pub fn reference_model(scene: &Scene, top_rad_per_s: f64) -> SpectralModel {
    let plate = Plate::new(scene, Resolution::of(Accuracy::Reference));
    SpectralModel::new(
        plate,
        SpeedRange::new(0.0, top_rad_per_s),
        Strategy::Reduced,
    )
    .expect("a spectrum")
}

/// |actual/expected − 1|.
pub fn relative_error(actual: f64, expected: f64) -> f64 {
    (actual / expected - 1.0).abs()
}

/// Fails unless the relative error is at most the tolerance; a NaN fails.
#[track_caller]
pub fn assert_close(what: &str, actual: f64, expected: f64, tolerance: f64) {
    let error = relative_error(actual, expected);
    assert!(
        error <= tolerance,
        "{what}: {actual} instead of {expected}, off by {error:.2e}, allowed {tolerance:.0e}"
    );
}

/// The largest of many errors, and where it occurred; a NaN counts as larger than any.
#[derive(Debug, Default)]
pub struct Worst {
    pub error: f64,
    pub place: String,
    pub count: usize,
}

impl Worst {
    pub fn add(&mut self, error: f64, place: impl FnOnce() -> String) {
        self.count += 1;
        // A NaN remains the largest error.
        if error > self.error || error.is_nan() {
            self.error = error;
            self.place = place();
        }
    }

    /// Prints the largest error (`cargo test -- --nocapture`) and compares it with the tolerance.
    #[track_caller]
    pub fn assert_at_most(&self, what: &str, tolerance: f64) {
        println!(
            "{what}: {} values, largest error {:.2e} at {}",
            self.count, self.error, self.place
        );
        assert!(
            self.count > 0 && self.error <= tolerance,
            "{what}: {:.2e} at {}, allowed {tolerance:.0e}",
            self.error,
            self.place
        );
    }
}

/// Modes of one harmonic of an unguided blade, by frequency. Every n is a component of such a blade.
pub fn of_diameters(modes: &[Mode], n: usize) -> impl Iterator<Item = &Mode> {
    modes.iter().filter(move |mode| mode.component == n)
}

/// A saw with lengths × L, masses × M and times × T: pressure is × M/LT², density × M/L³,
/// stiffness × M/T².
pub fn in_units(file: &SceneFile, [length, mass, time]: [f64; 3]) -> SceneFile {
    let mut file = file.clone();
    let blade = &mut file.blade;
    blade.outer_diameter_m *= length;
    blade.inner_diameter_m *= length;
    blade.thickness_m *= length;
    for row in &mut blade.profile {
        row.radius_m *= length;
        row.thickness_m *= length;
    }
    if let Some(rim) = &mut blade.rim {
        rim.mass_per_tooth_kg *= mass;
        rim.radius_m = rim.radius_m.map(|radius_m| radius_m * length);
    }
    blade.material.youngs_modulus_pa *= mass / (length * time * time);
    blade.material.density_kg_per_m3 *= mass / length.powi(3);
    if let Mount::Collar { diameter_m, .. } = &mut file.mount {
        *diameter_m *= length;
    }
    for pad in &mut file.guides {
        pad.radius_m *= length;
        pad.radial_length_m *= length;
        pad.tangential_length_m *= length;
        pad.stiffness_n_per_m *= mass / (time * time);
    }
    file
}

/// A root of the Bessel determinant of the annulus: λ² = ωb²√(ρh/D) of the s-th mode of n
/// diameters. FF: both edges free, CF: bore clamped.
#[derive(Debug, serde::Deserialize)]
pub struct AnnulusRoot {
    pub bc: String,
    pub nu: f64,
    pub ratio: f64,
    pub n: usize,
    pub s: usize,
    pub lambda2: f64,
}

/// The records of a reference table, without its comments.
pub fn table<T: serde::de::DeserializeOwned>(name: &str) -> Vec<T> {
    let mut reader = csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .from_path(path(&format!("tests/reference/{name}")))
        .expect("a reference table");
    reader.deserialize().map(|row| row.expect(name)).collect()
}
