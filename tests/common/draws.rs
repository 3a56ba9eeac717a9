//! Random saws, the same in every run, and properties that hold for all of them.

use faer::c64;
use proptest::prelude::*;
use proptest::test_runner::{Config, FileFailurePersistence, RngAlgorithm, TestRng, TestRunner};
use sawflutter::model::plate::{Plate, Resolution};
use sawflutter::model::scene::{GuideFile, InPlane, Mount, Scene, SceneFile, SpeedRange};
use sawflutter::model::system::GyroscopicSystem;
use sawflutter::modes::{SpectralModel, Strategy as Solver, companion_eigenpairs};

/// A basis so small that every eigenvalue can be computed: 65 unknowns.
pub const SMALL: Resolution = Resolution {
    max_diameters: 6,
    radial_functions: 5,
};

/// Seeds of failures, kept in the repository.
const REGRESSIONS: &str = "tests/common/draws.proptest-regressions";

/// Checks a property of `cases` random values, which are the same in every run.
pub fn check<S: Strategy>(
    cases: u32,
    strategy: S,
    property: impl Fn(S::Value) -> Result<(), TestCaseError>,
) {
    let config = Config {
        cases,
        // A failure that was found once is tried first in every later run.
        failure_persistence: Some(Box::new(FileFailurePersistence::Direct(REGRESSIONS))),
        ..Config::default()
    };
    let rng = TestRng::deterministic_rng(RngAlgorithm::ChaCha);
    TestRunner::new_with_rng(config, rng)
        .run(&strategy, property)
        .unwrap_or_else(|error| panic!("{error}"));
}

prop_compose! {
    pub fn any_pad(outer_radius_m: f64)(
        place in 0.55..0.95_f64,
        angle_deg in -180.0..180.0_f64,
        sides in (0.05..0.4_f64, 0.05..0.4_f64),
        stiffness in 4.5..7.5_f64,
    ) -> GuideFile {
        GuideFile {
            radius_m: place * outer_radius_m,
            angle_deg,
            radial_length_m: sides.0 * outer_radius_m,
            tangential_length_m: sides.1 * outer_radius_m,
            stiffness_n_per_m: 10_f64.powf(stiffness),
            damping_n_s_per_m: 0.0,
            ..GuideFile::default()
        }
    }
}

prop_compose! {
    /// A steel saw of 200 to 800 mm with one to three pads.
    pub fn any_saw()(
        outer_radius_m in 0.1..0.4_f64,
    )(
        bore in 0.2..0.45_f64,
        thinness in 60.0..150.0_f64,
        mount in prop_oneof![
            Just(None), Just(Some(InPlane::Fixed)), Just(Some(InPlane::Free))
        ],
        guides in prop::collection::vec(any_pad(outer_radius_m), 1..=3),
        outer_radius_m in Just(outer_radius_m),
    ) -> SceneFile {
        let mut file = Scene::paper().file().clone();
        file.sweep = None;
        file.measured = None;
        // Removes the blocks of the paper's own blade.
        (file.spline, file.cut, file.runup, file.probe) = (None, None, None, None);
        file.blade.outer_diameter_m = 2.0 * outer_radius_m;
        file.blade.inner_diameter_m = 2.0 * bore * outer_radius_m;
        file.blade.thickness_m = outer_radius_m / thinness;
        if let Some(in_plane) = mount {
            let diameter_m = file.blade.inner_diameter_m;
            file.mount = Mount::Collar { diameter_m, in_plane, clamp_stiffness_n_m_per_rad_per_m: None };
        }
        file.guides = guides;
        file
    }
}

pub fn scene(file: &SceneFile) -> Scene {
    Scene::try_from(file.clone()).unwrap_or_else(|error| panic!("{error}"))
}

pub fn system(file: &SceneFile) -> GyroscopicSystem {
    GyroscopicSystem::of_plate(&Plate::new(&scene(file), SMALL))
}

pub fn critical_rad_per_s(file: &SceneFile) -> Vec<f64> {
    SpectralModel::critical_speeds(&Plate::new(&scene(file), SMALL))
        .unwrap()
        .iter()
        .map(|c| c.speed_rad_per_s)
        .collect()
}

pub fn first_critical(file: &SceneFile) -> f64 {
    critical_rad_per_s(file)[0]
}

/// Every eigenvalue with Im λ ≥ 0.
pub fn eigenvalues(file: &SceneFile, speed_rad_per_s: f64) -> Vec<c64> {
    let pairs = companion_eigenpairs(&system(file), speed_rad_per_s).unwrap();
    pairs.into_iter().map(|(lambda, _)| lambda).collect()
}

/// Largest distance between two sets of eigenvalues, each paired with the nearest one that is not yet paired, in units
/// of the geometric mean of
/// λ
/// and the largest
/// λ
/// : the rounding error is ε times the largest.
pub fn distance(left: &[c64], right: &[c64]) -> f64 {
    assert!(!left.is_empty());
    if left.len() != right.len() {
        return f64::INFINITY;
    }
    let largest = left.iter().fold(0.0_f64, |top, l| top.max(l.norm()));
    let mut rest = right.to_vec();
    let mut worst = 0.0;
    for l in left {
        let off = |r: &c64| (r - l).norm();
        let nearest = (0..rest.len())
            .min_by(|&i, &k| off(&rest[i]).total_cmp(&off(&rest[k])))
            .unwrap();
        let error = off(&rest.swap_remove(nearest)) / (l.norm() * largest).sqrt();
        if error > worst || error.is_nan() {
            worst = error;
        }
    }
    worst
}

pub fn dense_model(file: &SceneFile, top_rad_per_s: f64) -> SpectralModel {
    let plate = Plate::new(&scene(file), SMALL);
    SpectralModel::new(plate, SpeedRange::new(0.0, top_rad_per_s), Solver::Dense).unwrap()
}
