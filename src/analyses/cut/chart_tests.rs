//! Figures of the cut and of the run-up, from synthetic reports.

use crate::analyses::cut::CutReport;
use crate::analyses::cut::{chart, map_chart};
use crate::analyses::washboard::{self, washboard};
use crate::model::scene::{Accuracy, Scene, SceneFile};
use crate::page::figure::canvas::{Mark, Sheet};
use crate::page::figure::layout;
use crate::page::figure::style::BLANK;
use crate::page::figure::tidiness::texts;

/// The committed report of a saw with a spline, as many times as there are factors of its deflections.
fn cut_report(factors: &[f64]) -> CutReport {
    let json = include_str!("../../../tests/golden/reports/cut-spline.json");
    let mut report: CutReport = serde_json::from_str(json).unwrap();
    let run = report.runs.pop().unwrap();
    report.runs = factors
        .iter()
        .map(|factor| {
            let mut run = run.clone();
            run.deflection_m.iter_mut().for_each(|w| *w *= factor);
            run
        })
        .collect();
    report
}

/// The figures do not depend on the accuracy of the computation.
fn coarse(saw: &mut SceneFile) {
    (saw.accuracy, saw.tolerance) = (Accuracy::Draft, Some(0.1));
}

/// The numbers at the axis of a panel fit into the space to its left, and a common scale makes panels comparable.
#[test]
fn speeds_of_any_size_keep_their_labels_apart() {
    for factors in [&[1.0, 1e-9, 1e-5, 1e4, 2.0][..], &[1e-7, 1e-9], &[0.0]] {
        let mut report = cut_report(factors);
        let [cut, map] = [chart::chart(&report), map_chart::chart(&report)];
        let _drawn = [&cut, &map].map(layout::sheet);
        assert_eq!(cut.panels.len(), factors.len());
        assert!(cut.panels.windows(2).all(|pair| pair[0].y == pair[1].y));
        // A saw without guides, of which every motion decays: its map has no angle, and its mark is in the panel.
        report.scene.guides.clear();
        for run in &mut report.runs {
            let maps = run.map.growth_per_s.iter_mut().flatten();
            maps.for_each(|growth| *growth = -0.3);
            run.growth_per_s = -0.3;
        }
        let sheet = layout::sheet(&map_chart::chart(&report));
        assert!(!texts(&sheet).iter().any(|text| text.contains("angle")));
        let marks = sheet
            .marks()
            .iter()
            .filter(|mark| matches!(mark, Mark::Disc(..)))
            .count();
        assert_eq!(marks, 2 * factors.len());
    }
}

/// The search ends at a thousand times the stiffness of the cut. Above, the areas are grey, the key names them, and the
/// numbers for other programs say so: a boundary that a search up to a higher stiffness finds there is not in an area
/// that looks stable.
#[test]
#[cfg_attr(debug_assertions, ignore = "many eigenproblems: run it in release")]
fn stiffnesses_that_were_not_searched_look_unknown() {
    let json = include_str!("../../../scenes/gallery/washboarding.json");
    let scene = Scene::from_json(json).unwrap();
    let with_stiffness = |stiffness: f64| {
        let scene = scene
            .edited(|saw| {
                coarse(saw);
                let delayed = saw.cut.as_mut().unwrap().washboarding.as_mut().unwrap();
                delayed.stiffness_n_per_m = stiffness;
            })
            .unwrap();
        let run = scene.cut().unwrap().at_rpm(2400.0).unwrap();
        washboard(&scene, &run, &|_, _| ()).unwrap()
    };
    let (searched, report) = (with_stiffness(3e4), with_stiffness(10.0));
    let known = |k: usize| report.lobes.stable_to_n_per_m[k];
    assert_eq!(report.critical_stiffness_n_per_m, None);
    assert!(searched.critical_stiffness_n_per_m.unwrap() > report.ceiling_n_per_m);
    let critical = report.lobes.critical_stiffness_n_per_m.iter();
    let open: Vec<usize> = critical
        .enumerate()
        .filter(|(_, k)| k.is_none())
        .map(|(k, _)| k)
        .collect();
    assert!(open.len() > 50, "{open:?}");
    assert!(open.iter().all(|k| known(*k) == report.ceiling_n_per_m));
    let sheet = layout::sheet(&washboard::chart::chart(&report));
    let key = |sheet: &Sheet| texts(sheet).contains(&"not searched, or not confirmed");
    assert!(key(&sheet) && !key(&layout::sheet(&washboard::chart::chart(&searched))));
    let corners_of = |mark: &Mark| match mark {
        Mark::Polygon(corners, colour) if *colour == BLANK => corners.len(),
        _ => 0,
    };
    let corners: usize = sheet.marks().iter().map(corners_of).sum();
    assert!(corners >= 4 * open.len());
    let chart = serde_json::to_value(washboard::chart::chart(&report)).unwrap();
    let items = &chart["panels"][0]["items"];
    assert_eq!(items[2]["name"], "not searched or not confirmed above");
    assert_eq!(items[2]["y"][open[0]], report.ceiling_n_per_m);
    assert_eq!(items[3]["y"][open[0]], serde_json::Value::Null);
}

/// The diagrams are unstable, stable, unstable without the force, and without a boundary.
#[test]
#[cfg_attr(debug_assertions, ignore = "many eigenproblems: run it in release")]
fn the_lobe_diagram_is_tidy_and_says_the_verdict() {
    let json = include_str!("../../../scenes/gallery/washboarding.json");
    let scene = Scene::from_json(json).unwrap();
    for (stiffness, overlap, power_w, said) in [
        (3e4, 1.0, 15e3, "2400 rpm: unstable at"),
        (10.0, 1.0, 15e3, "2400 rpm: stable"),
        (3e4, 0.0, 15e3, "2400 rpm: stable"),
        (3e4, 1.0, 15e6, "2400 rpm: unstable at"),
    ] {
        let scene = scene
            .edited(|saw| {
                coarse(saw);
                let cut = saw.cut.as_mut().unwrap();
                cut.power_w = Some(power_w);
                let delayed = cut.washboarding.as_mut().unwrap();
                (delayed.stiffness_n_per_m, delayed.overlap) = (stiffness, overlap);
            })
            .unwrap();
        let run = scene.cut().unwrap().at_rpm(2400.0).unwrap();
        let report = washboard(&scene, &run, &|_, _| ()).unwrap();
        let sheet = layout::sheet(&washboard::chart::chart(&report));
        let all = texts(&sheet);
        assert!(all.iter().any(|text| text.contains(said)), "{said}");
    }
}
