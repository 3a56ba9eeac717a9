//! Rotation speed: very slow, and so fast that the plate is a membrane.

use nalgebra::{DMatrix, SymmetricEigen};
use sawflutter::model::analytical::free_wave::space_frequencies_rad_per_s;
use sawflutter::model::analytical::spinning_membrane::{
    annulus_umbrella_ratio_squared, disk_frequency_ratio_squared,
};
use sawflutter::model::plate::{Plate, Resolution};
use sawflutter::model::scene::{Accuracy, SceneFile, SpeedRange, rad_per_s};
use sawflutter::modes::{ModeKind, SpectralModel, Strategy};

use crate::row::Row;
use crate::saws::{scene, unguided};

/// Frequencies on the blade of one harmonic of an unguided saw, ascending, each once.
fn body_frequencies(file: &SceneFile, n: usize, speed: f64) -> Vec<f64> {
    let plate = Plate::new(&scene(file), Resolution::of(Accuracy::Reference));
    let model = SpectralModel::new(plate, SpeedRange::new(0.0, speed), Strategy::Reduced).unwrap();
    let modes = model.all_modes(speed).unwrap();
    let carried = n as f64 * speed;
    let forward = modes.iter().filter(|m| {
        m.component == n
            && m.kind != ModeKind::Rigid
            && (n == 0 || m.frequency_rad_per_s() > carried)
    });
    // In the fixed frame the frequency of a forward wave is nΩ higher.
    let mut found: Vec<f64> = forward
        .map(|m| m.frequency_rad_per_s() - carried)
        .filter(|f| *f > 0.0)
        .collect();
    found.sort_by(f64::total_cmp);
    found
}

/// A blade with very small bending stiffness.
fn membrane(ratio: f64) -> SceneFile {
    let mut file = unguided();
    file.blade.inner_diameter_m = ratio * file.blade.outer_diameter_m;
    file.blade.thickness_m = 1e-9;
    file
}

pub fn membrane_ring() -> Row {
    let mut row = Row::new(
        "speed so high that the blade is a membrane, n = 0",
        "a/b = 0.05, 0.28, 0.7",
        "ω²/Ω² = (3+ν) l(l+1)/2",
        1e-8,
    );
    let speed = rad_per_s(10_000.0);
    for ratio in [0.05, 0.28, 0.7] {
        let nu = 0.29;
        let expected: Vec<f64> = (1..=3)
            .map(|circles| speed * annulus_umbrella_ratio_squared(nu, circles).sqrt())
            .collect();
        let found = body_frequencies(&membrane(ratio), 0, speed);
        row.compare(&found, &expected, &format!("a/b = {ratio}"));
    }
    row
}

pub fn membrane_disk() -> Row {
    let mut row = Row::new(
        "the same, n = 2 to 4, bore ratio 0.001",
        "s = 0",
        "solid disk: 8ω²/Ω² = (3+ν)(n+2s)(n+2s+2) − n²(1+3ν), off by (a/b)²",
        1e-5,
    );
    let speed = rad_per_s(10_000.0);
    for n in 2..=4 {
        let m = n as f64;
        let square = disk_frequency_ratio_squared(0.29, n, 0);
        // The wave is found in both directions; below nΩ it is the reflected one.
        let plate = Plate::new(
            &scene(&membrane(0.001)),
            Resolution::of(Accuracy::Reference),
        );
        let block = &plate.harmonics[n];
        let stiffness = &block.spin + DMatrix::identity(12, 12) * (m * m);
        let mut squares: Vec<f64> = SymmetricEigen::new(stiffness)
            .eigenvalues
            .as_slice()
            .to_vec();
        squares.sort_by(f64::total_cmp);
        row.compare(
            &[squares[0].sqrt()],
            &[square.sqrt()],
            &format!("n = {n}, matrix"),
        );
        let model =
            SpectralModel::new(plate, SpeedRange::new(0.0, speed), Strategy::Reduced).unwrap();
        let modes = model.all_modes(speed).unwrap();
        let [expected, _] = space_frequencies_rad_per_s(n, speed * square.sqrt(), speed);
        let nearest = modes
            .iter()
            .filter(|mode| mode.component == n)
            .map(|mode| mode.frequency_rad_per_s())
            .min_by(|x, y| (x - expected).abs().total_cmp(&(y - expected).abs()));
        row.compare(
            &[nearest.unwrap()],
            &[expected],
            &format!("n = {n}, forward"),
        );
    }
    row
}

pub fn hardly_turning() -> Row {
    let mut row = Row::new("speed", "0 and 1e-6 rpm", "frequencies at rest, ± nΩ", 1e-8);
    let plate = Plate::new(&scene(&unguided()), Resolution::of(Accuracy::Design));
    let harmonics = plate.harmonics.clone();
    let model = SpectralModel::new(
        plate,
        SpeedRange::between_rpm(0.0, 3000.0),
        Strategy::Reduced,
    )
    .unwrap();
    for rpm in [0.0, 1e-6] {
        let speed = rad_per_s(rpm);
        let modes = model.all_modes(speed).unwrap();
        for block in &harmonics[..6] {
            let n = block.diameters;
            let mut squares: Vec<f64> = SymmetricEigen::new(block.bending.clone())
                .eigenvalues
                .as_slice()
                .to_vec();
            squares.sort_by(f64::total_cmp);
            let lowest = squares[usize::from(n <= 1)].sqrt();
            let found: Vec<f64> = modes
                .iter()
                .filter(|m| m.component == n && m.frequency_rad_per_s() > 0.5 * lowest)
                .map(|m| m.frequency_rad_per_s())
                .collect();
            let [forward, backward] = space_frequencies_rad_per_s(n, lowest, speed);
            let expected = if n == 0 {
                vec![lowest]
            } else {
                vec![backward, forward]
            };
            row.compare(&found, &expected, &format!("{rpm} rpm, n = {n}"));
        }
    }
    row
}
