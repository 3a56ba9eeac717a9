//! Guides: soft, rigid, tiny, larger than the blade, at one place, evenly spaced.

use nalgebra::{DMatrix, DVector, SymmetricEigen};
use sawflutter::model::analytical::free_wave::{on_a_bed_rad_per_s, space_frequencies_rad_per_s};
use sawflutter::model::analytical::point_springs::{StandingWave, critical_speeds_rad_per_s};
use sawflutter::model::plate::{Plate, Resolution};
use sawflutter::model::scene::{
    Accuracy, GuideFile, InPlane, Mount, SceneFile, SpeedRange, rad_per_s,
};
use sawflutter::modes::{ModeKind, SpectralModel, Strategy};

use crate::row::Row;
use crate::saws::{SMALL, critical, paper, scene, signature, unguided};

fn point(angle_deg: f64, stiffness_n_per_m: f64) -> GuideFile {
    GuideFile {
        radius_m: 0.3,
        angle_deg,
        radial_length_m: 0.0,
        tangential_length_m: 0.0,
        stiffness_n_per_m,
        damping_n_s_per_m: 0.0,
        ..GuideFile::default()
    }
}

fn collared() -> SceneFile {
    let mut file = unguided();
    file.mount = Mount::Collar {
        diameter_m: file.blade.inner_diameter_m,
        in_plane: InPlane::Fixed,
        clamp_stiffness_n_m_per_rad_per_m: None,
    };
    file
}

/// Critical speeds of a clamped blade on one point spring at θ = 0, without its matrices: the sine waves have a node at
/// the spring, and the stationary cosine waves of the free blade form the secular equation. For k → ∞ the blade is
/// pinned.
fn secular(file: &SceneFile, resolution: Resolution, stiffness: f64) -> Vec<f64> {
    let plate = Plate::new(&scene(file), resolution);
    let at_spring = plate.functions_at(0.3, 0.0);
    let mut waves: Vec<StandingWave> = Vec::new();
    for block in &plate.harmonics {
        let lower = block.bending.clone().cholesky().unwrap().l();
        let inverse = lower.try_inverse().unwrap();
        let whitened = &inverse * -&block.spin * inverse.transpose();
        let eigen = SymmetricEigen::new((&whitened + whitened.transpose()) * 0.5);
        let offset = plate.offset(block.diameters);
        let values = DVector::from_row_slice(&at_spring[offset..offset + plate.radial_functions()]);
        for (k, mu) in eigen.eigenvalues.iter().enumerate() {
            let shape = inverse.transpose() * eigen.eigenvectors.column(k);
            waves.push(StandingWave {
                inverse_critical_speed_squared_s2: *mu,
                deflection_m: shape.dot(&values),
            });
        }
    }
    let sines = waves
        .iter()
        .map(|w| w.inverse_critical_speed_squared_s2)
        .filter(|mu| *mu > 0.0)
        .map(|mu| mu.recip().sqrt());
    let mut critical = critical_speeds_rad_per_s(stiffness, &waves);
    critical.extend(sines);
    critical.sort_by(f64::total_cmp);
    critical
}

fn springs(range: &'static str, stiffnesses: &[f64], asked: f64) -> Row {
    let mut row = Row::new(
        "point spring on a collar blade",
        range,
        "secular equation of the unguided waves",
        asked,
    );
    let resolution = Resolution::of(Accuracy::Design);
    for stiffness in stiffnesses {
        let mut file = collared();
        let expected = secular(&file, resolution, *stiffness);
        file.guides.push(point(0.0, *stiffness));
        let found = critical(&file, resolution);
        row.compare(&found, &expected[..10], &format!("{stiffness:e} N/m"));
    }
    row
}

pub fn soft_to_stiff_spring() -> Row {
    springs("1e-3 to 1e9 N/m", &[1e-3, 1.0, 1e3, 1e6, 1e9], 1e-9)
}

pub fn rigid_spring() -> Row {
    springs("1e10 N/m (pinned)", &[1e10], 1e-5)
}

/// A pad under the whole blade, with its total stiffness in N/m.
pub fn bed(stiffness_n_per_m: f64) -> GuideFile {
    GuideFile {
        radius_m: 0.0,
        angle_deg: 20.0,
        radial_length_m: 2.0,
        tangential_length_m: 2.0,
        stiffness_n_per_m,
        damping_n_s_per_m: 0.0,
        ..GuideFile::default()
    }
}

pub fn pad_under_the_whole_blade() -> Row {
    let mut row = Row::new(
        "pad larger than the blade",
        "1e-3 to 1e10 N/m",
        "on the blade ω² = ω²(free) + k″/ρh",
        1e-7,
    );
    let speed = rad_per_s(1200.0);
    for stiffness in [1e-3, 1.0, 1e3, 1e6, 1e9, 1e10] {
        let mut file = unguided();
        let free = Plate::new(&scene(&file), SMALL);
        let stiffness_per_area = stiffness / 4.0;
        let mass_per_area = free.blade.mass_per_area_kg_per_m2();
        let mut expected: Vec<f64> = Vec::new();
        let mut unit = f64::INFINITY;
        for block in &free.harmonics {
            let n = block.diameters;
            let count = block.bending.nrows();
            let inertia = DMatrix::identity(count, count) * (n * n) as f64;
            let stiffness = &block.bending + (&block.spin + inertia) * (speed * speed);
            for square in &SymmetricEigen::new(stiffness).eigenvalues {
                // Heave and tilt are zero to rounding, with either sign.
                let free = square.max(0.0).sqrt();
                let omega = on_a_bed_rad_per_s(free, stiffness_per_area, mass_per_area);
                let [forward, backward] = space_frequencies_rad_per_s(n, omega, speed);
                expected.push(forward);
                if n > 0 {
                    expected.push(backward.abs());
                }
                if n >= 2 {
                    unit = unit.min(omega);
                }
            }
        }
        file.guides.push(bed(stiffness));
        let plate = Plate::new(&scene(&file), SMALL);
        let model =
            SpectralModel::new(plate, SpeedRange::new(0.0, speed), Strategy::Dense).unwrap();
        let modes = model.all_modes(speed).unwrap();
        // Motions slower than 1e-6 of an elastic one are almost rigid: a part √ε of them is rounding.
        let rigid = |omega: f64| omega < 1e-6 * unit;
        let off = |x: f64, y: f64| (x - y).abs() / unit;
        let found: Vec<f64> = modes.iter().map(|m| m.frequency_rad_per_s()).collect();
        for omega in expected.iter().filter(|omega| !rigid(**omega)) {
            let nearest = found.iter().map(|f| off(*f, *omega));
            let error = nearest.fold(f64::INFINITY, f64::min) * unit / unit.max(*omega);
            row.add(error, || format!("{stiffness:e} N/m: {omega}"));
        }
        for mode in &modes {
            assert_eq!(mode.kind, ModeKind::Positive, "{}", mode.lambda);
        }
    }
    row
}

pub fn tiny_pad() -> Row {
    let mut row = Row::new(
        "pad of 1 mm",
        "2e5 N/m",
        "point spring, off by the square of its size",
        1e-4,
    );
    let mut file = collared();
    file.guides.push(point(-55.0, 2e5));
    let expected = critical(&file, SMALL);
    file.guides[0].radial_length_m = 1e-3;
    file.guides[0].tangential_length_m = 1e-3;
    row.compare(&critical(&file, SMALL), &expected[..8], "1 mm");
    row
}

pub fn pads_on_the_same_spot() -> Row {
    let mut row = Row::new(
        "two identical pads on the same spot",
        "paper's pad",
        "one of twice the stiffness",
        1e-9,
    );
    let mut one = paper();
    one.guides[0].stiffness_n_per_m *= 2.0;
    let mut two = paper();
    two.guides.push(two.guides[0].clone());
    row.compare(&signature(&two), &signature(&one), "bands");
    row
}

pub fn evenly_spaced_pads() -> Row {
    let mut row = Row::new(
        "equal, evenly spaced pads",
        "2, 3, 4, 6 pads",
        "waves couple only where n ± m is a multiple of their number: largest coupling of others, relative to the largest",
        1e-13,
    );
    for count in [2_usize, 3, 4, 6] {
        let mut file = unguided();
        for k in 0..count {
            let mut pad = paper().guides[0].clone();
            pad.angle_deg += 360.0 * k as f64 / count as f64;
            file.guides.push(pad);
        }
        let plate = Plate::new(&scene(&file), Resolution::of(Accuracy::Design));
        let coupling = plate.contact.stiffness().unwrap();
        let radial = plate.radial_functions();
        // Blocks of cosines and sines: 0, 1, 1, 2, 2, …
        let diameters = |i: usize| (i / radial).div_ceil(2);
        let largest = coupling.norm_max();
        for i in 0..coupling.nrows() {
            for k in 0..i {
                let (n, m) = (diameters(i), diameters(k));
                if (n + m) % count != 0 && n.abs_diff(m) % count != 0 {
                    let error = coupling[(i, k)].abs() / largest;
                    row.add(error, || format!("{count} pads, n = {n} and {m}"));
                }
            }
        }
    }
    row
}
