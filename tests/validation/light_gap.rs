//! Goal: the light gap under a straight edge shows the roll tension that the stability of the blade at rest knows.
//!
//! The factor of the roll tension at which the blade on two points buckles is that at which the analysis of the same blade, free in
//! space, refuses it as buckled at rest: the two use different bases and eigenproblems.

use sawflutter::model::scene::Scene;
use sawflutter::modes::SpectrumError;
use sawflutter::stability::{Analysis, AnalysisError};

use super::saws::scene_with;

fn rolled(eigenstrain: f64) -> Scene {
    let free = Scene::paper().edited(|file| {
        file.guides.clear();
        file.cut = None;
        file.accuracy = sawflutter::model::scene::Accuracy::Draft;
    });
    let membrane = serde_json::json!({
        "roll_tension": [{ "radius_m": 0.22, "width_m": 0.02, "eigenstrain": eigenstrain }],
        "straight_edge": {}
    });
    scene_with(&free.unwrap(), membrane)
}

#[test]
fn the_blade_on_two_points_buckles_where_the_free_blade_does() {
    let gap_of = |eigenstrain| {
        let report = Analysis::new(&rolled(eigenstrain)).map(|found| found.report());
        report.map(|report| report.membrane.unwrap().straight_edge.unwrap())
    };
    let edge = gap_of(1e-4).unwrap();
    let buckling = 1e-4 * edge.buckling_factor.unwrap();
    println!("{edge:?}");
    assert!(gap_of(0.998 * buckling).unwrap().gap_m.unwrap() > 0.0);
    match gap_of(1.002 * buckling) {
        Err(AnalysisError::Spectrum(SpectrumError::UnstableAtRest { .. })) => (),
        other => panic!("{other:?}"),
    }
}
