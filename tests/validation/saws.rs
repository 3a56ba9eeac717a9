//! Saws of these tests, and analyses of them that all tests share.

use std::f64::consts::TAU;

use faer::Mat;
use sawflutter::model::plate::{Plate, Resolution, RimForce};
use sawflutter::model::scene::{MembraneFile, Scene, SpeedRange, rad_per_s};
use sawflutter::model::system::GyroscopicSystem;
use sawflutter::modes::{SpectralModel, Strategy, companion_eigenpairs};
use sawflutter::stability::{Analysis, chart};

pub fn scene_with(base: &Scene, membrane: serde_json::Value) -> Scene {
    let membrane: MembraneFile = serde_json::from_value(membrane).unwrap();
    let stressed = base.edited(|saw| saw.membrane = Some(membrane));
    stressed.unwrap_or_else(|error| panic!("{error}"))
}

pub fn collar() -> Scene {
    crate::common::scene("collar-400mm")
}

pub fn heated(base: &Scene, rise_k: f64) -> Scene {
    let temperature = serde_json::json!({ "expansion_per_k": 1.2e-5, "rim_rise_k": rise_k });
    scene_with(base, serde_json::json!({ "temperature": temperature }))
}

pub fn rolled(base: &Scene, eigenstrain: f64) -> Scene {
    let band = serde_json::json!({ "radius_m": 0.10, "width_m": 0.02, "eigenstrain": eigenstrain });
    scene_with(base, serde_json::json!({ "roll_tension": [band] }))
}

/// Four equal loads, one pitch of 42 teeth apart, around θ = 0: [tangential, radial] newtons on each tooth, against the
/// rotation and inwards.
pub fn paper_cut([tangential_n, radial_n]: [f64; 2]) -> [RimForce; 4] {
    [-1.5, -0.5, 0.5, 1.5].map(|pitches| RimForce {
        angle_rad: pitches * TAU / 42.0,
        radial_n: -radial_n,
        tangential_n: -tangential_n,
    })
}

/// The fastest growing eigenvalue: (1/s, Hz).
pub fn fastest(plate: &Plate, edge: &Mat<f64>, rpm: f64) -> (f64, f64) {
    let mut system = GyroscopicSystem::of_plate(plate);
    system.stiffness += edge;
    let lambda = companion_eigenpairs(&system, rad_per_s(rpm))
        .unwrap()
        .into_iter()
        .map(|(lambda, _)| lambda)
        .max_by(|x, y| x.re.total_cmp(&y.re))
        .unwrap();
    (lambda.re, lambda.im.abs() / TAU)
}

/// An analysis on the full model, so that reduced models of two scenes do not differ.
pub fn dense_analysis(
    scene: &Scene,
    resolution: Resolution,
    range_rpm: [f64; 2],
    speeds: usize,
) -> Analysis {
    let range = SpeedRange::between_rpm(range_rpm[0], range_rpm[1]);
    let plate = Plate::new(scene, resolution);
    let model = SpectralModel::new(plate, range, Strategy::Dense).unwrap();
    let chart = chart(&model, range, speeds, &|_, _| ()).unwrap();
    Analysis {
        shortened: None,
        floquet: None,
        split_pairs: None,
        model,
        range_rad_per_s: range,
        complete_to_rad_per_s: range.to_rad_per_s,
        chart,
        flutter_speed_rad_per_s: None,
        first_merge_rad_per_s: None,
        scene: scene.clone(),
        root_loci: None,
        estimated_relative_error: None,
        estimates: None,
        out_of_reach: None,
        modes_at_rest: Vec::new(),
        overdamped_at_rest: 0,
        fastest_operating: None,
        listed_backward_error: None,
        straight_edge: None,
        heat: None,
        crossings: Vec::new(),
        idling: None,
    }
}
