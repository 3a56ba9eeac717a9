//! Figures of the cut and of the run-up, from synthetic reports.

use std::sync::LazyLock;

use super::canvas::{Mark, Sheet};
use super::style::BLANK;
use super::tidy::{assert_tidy, texts};
use super::{cut, cut_map, layout, response_map, runup, spline_orbit, washboard};
use crate::analyses::cut::{CutReport, cut as compute_cut};
use crate::analyses::runup::runup;
use crate::analyses::washboard::washboard;
use crate::scene::{Accuracy, CutRun, Scene, SceneFile};

/// A saw with a spline at three speeds, whose panels are in two rows.
static THREE_SPEEDS: LazyLock<CutReport> = LazyLock::new(|| {
    let scene = draft();
    let cut = scene.cut().unwrap();
    let runs = [1800.0, 2800.0, 2600.0].map(|rpm| cut.at_rpm(rpm).unwrap());
    compute_cut(&scene, &runs, &|_, _| ()).unwrap()
});

fn draft() -> Scene {
    let scene = Scene::from_json(include_str!("../../scenes/paper-spline.json")).unwrap();
    scene.edited(coarse).unwrap()
}

/// The figures do not depend on the accuracy of the computation.
fn coarse(saw: &mut SceneFile) {
    (saw.accuracy, saw.tolerance) = (Accuracy::Draft, Some(0.1));
}

#[test]
#[cfg_attr(debug_assertions, ignore = "many eigenproblems: run it in release")]
fn the_figures_of_a_cut_are_tidy_and_say_the_verdict() {
    let report = &*THREE_SPEEDS;
    let sheet = cut::sheet(report);
    assert_tidy(&sheet);
    for run in &report.runs {
        let title = format!("{} rpm: {}", run.rpm, run.verdict);
        let said = texts(&sheet)
            .iter()
            .any(|(_, text)| text.starts_with(&title));
        assert!(said, "{title}");
    }
    // The heading contains the result of each criterion, the last one included.
    let cut_off = texts(&sheet).iter().any(|(_, text)| text.contains('…'));
    assert!(!cut_off, "{:?}", texts(&sheet));
    assert_tidy(&cut_map::sheet(report));
    assert_tidy(&spline_orbit::sheet(report).unwrap());
}

/// The numbers at the axis of a panel fit into the space to its left.
#[test]
#[cfg_attr(debug_assertions, ignore = "many eigenproblems: run it in release")]
fn five_speeds_of_any_size_keep_their_labels_apart() {
    let scene = draft().edited(|saw| saw.spline = None).unwrap();
    let cut = scene.cut().unwrap();
    let run = |rpm: f64, lateral_n: f64| CutRun {
        lateral_n,
        ..cut.at_rpm(rpm).unwrap()
    };
    let runs = [
        run(1800.0, 1e-9),
        run(1801.0, 1e-5),
        run(2200.0, 4.5),
        run(2500.0, 4.5),
        run(2800.0, 1e4),
    ];
    let mut report = compute_cut(&scene, &runs, &|_, _| ()).unwrap();
    for run in &report.runs {
        let within = |w: &f64| w.abs() <= report.linear_limit_m;
        assert!(run.deflection_m.iter().all(within), "{} rpm", run.rpm);
    }
    assert_tidy(&cut::sheet(&report));
    assert_tidy(&cut_map::sheet(&report));
    // The map of a saw without guides has no angle.
    report.scene.guides.clear();
    let sheet = cut_map::sheet(&report);
    assert_tidy(&sheet);
    assert!(!texts(&sheet).iter().any(|(_, text)| text.contains("angle")));
}

#[test]
#[cfg_attr(debug_assertions, ignore = "many eigenproblems: run it in release")]
fn without_a_lateral_force_the_figure_is_a_flat_line() {
    let scene = draft();
    let cut = scene.cut().unwrap();
    let run = CutRun {
        lateral_n: 0.0,
        ..cut.at_rpm(2800.0).unwrap()
    };
    let mut report = compute_cut(&scene, &[run], &|_, _| ()).unwrap();
    assert_eq!(report.runs[0].transient_verdict, None);
    assert!(
        report
            .warnings
            .iter()
            .any(|w| w.contains("cut.lateral_n_per_tooth"))
    );
    let (width, _) = cut::sheet(&report).size();
    for drawn in [cut::sheet(&report), cut_map::sheet(&report)] {
        assert_tidy(&drawn);
        let right = texts(&drawn)
            .iter()
            .map(|(frame, _)| frame.right)
            .fold(0.0, f64::max);
        assert!(
            right > 0.9 * f64::from(width),
            "half of the sheet is empty: {right}"
        );
    }
    // A saw without guides, of which every motion decays.
    report.scene.guides.clear();
    let run = &mut report.runs[0];
    run.growth_per_s = -0.3;
    run.map
        .growth_per_s
        .iter_mut()
        .flatten()
        .for_each(|growth| *growth = -0.3);
    let drawn = cut_map::sheet(&report);
    assert_tidy(&drawn);
    let bottom = drawn.marks().iter().filter_map(|mark| match mark {
        Mark::Line(points, _) if points[0][0] == points[1][0] => Some(points[1][1]),
        _ => None,
    });
    let bottom = bottom.fold(0.0, f64::max);
    let marks = drawn.marks().iter().filter_map(|mark| match mark {
        Mark::Disc(centre, ..) => Some(centre[1]),
        _ => None,
    });
    let marks: Vec<f64> = marks.collect();
    assert!(
        !marks.is_empty() && marks.iter().all(|y| *y < bottom),
        "{marks:?}"
    );
}

/// A common scale makes panels comparable.
#[test]
#[cfg_attr(debug_assertions, ignore = "many eigenproblems: run it in release")]
fn deflections_have_one_common_scale() {
    let drawn = cut::sheet(&THREE_SPEEDS);
    let texts = texts(&drawn);
    // Numbers to the left of the two columns, from top to bottom.
    let ticks = |from: f64, to: f64| {
        let own = texts.iter().filter(|(frame, text)| {
            let number = text.replace('\u{2212}', "-").parse::<f64>().is_ok();
            number && from < frame.left && frame.right < to && frame.bottom < 480.0
        });
        own.map(|(frame, text)| (text.to_string(), frame.top as i32))
            .collect::<Vec<_>>()
    };
    let first = ticks(0.0, 92.0);
    assert!(first.len() > 2);
    assert_eq!(first, ticks(600.0, 680.0));
}

#[test]
#[cfg_attr(debug_assertions, ignore = "many eigenproblems: run it in release")]
fn the_figures_of_a_run_up_are_tidy() {
    let scene = Scene::paper().edited(coarse).unwrap();
    let scene = scene.edited(|saw| {
        let runup = saw.runup.as_mut().unwrap();
        (runup.from_rpm, runup.to_rpm, runup.duration_s) = (0.0, 2000.0, 10.0);
    });
    let report = runup(&scene.unwrap(), &|_, _| ()).unwrap();
    assert_tidy(&layout::sheet(&runup::chart(&report)));
    assert_tidy(&response_map::sheet(&report));
}

/// The search ends at a thousand times the stiffness of the cut. Above, the areas are grey, the key names them, and the
/// numbers for other programs say so: a boundary that a search up to a higher stiffness finds there is not in an area
/// that looks stable.
#[test]
#[cfg_attr(debug_assertions, ignore = "many eigenproblems: run it in release")]
fn stiffnesses_that_were_not_searched_look_unknown() {
    let scene = include_str!("../../scenes/gallery/washboarding.json");
    let scene = Scene::from_json(scene).unwrap();
    let report = |stiffness: f64| {
        let scene = scene.edited(|saw| {
            coarse(saw);
            let delayed = saw.cut.as_mut().unwrap().washboarding.as_mut().unwrap();
            delayed.stiffness_n_per_m = stiffness;
        });
        let scene = scene.unwrap();
        let run = scene.cut().unwrap().at_rpm(2400.0).unwrap();
        washboard(&scene, &run, &|_, _| ()).unwrap()
    };
    let (searched, report) = (report(3e4), report(10.0));
    let known = |k: usize| report.lobes.stable_to_n_per_m[k];
    assert_eq!(report.critical_stiffness_n_per_m, None);
    assert!(searched.critical_stiffness_n_per_m.unwrap() > report.ceiling_n_per_m);
    let critical = report.lobes.critical_stiffness_n_per_m.iter();
    let open = critical.enumerate().filter(|(_, k)| k.is_none());
    let open: Vec<usize> = open.map(|(k, _)| k).collect();
    assert!(open.len() > 50, "{open:?}");
    assert!(open.iter().all(|k| known(*k) == report.ceiling_n_per_m));
    let sheet = layout::sheet(&washboard::chart(&report));
    assert_tidy(&sheet);
    let key = |sheet: &Sheet| {
        let mut all = texts(sheet).into_iter();
        all.any(|(_, text)| text == "not searched, or not confirmed")
    };
    assert!(key(&sheet) && !key(&layout::sheet(&washboard::chart(&searched))));
    let corners = |mark: &Mark| match mark {
        Mark::Polygon(corners, colour) if *colour == BLANK => corners.len(),
        _ => 0,
    };
    let corners: usize = sheet.marks().iter().map(corners).sum();
    assert!(corners >= 4 * open.len());
    let chart = serde_json::to_value(washboard::chart(&report)).unwrap();
    let items = &chart["panels"][0]["items"];
    assert_eq!(items[2]["name"], "not searched or not confirmed above");
    assert_eq!(items[2]["y"][open[0]], report.ceiling_n_per_m);
    assert_eq!(items[3]["y"][open[0]], serde_json::Value::Null);
}

/// The diagrams are unstable, stable, unstable without the force, and without a boundary.
#[test]
#[cfg_attr(debug_assertions, ignore = "many eigenproblems: run it in release")]
fn the_lobe_diagram_is_tidy_and_says_the_verdict() {
    let scene = include_str!("../../scenes/gallery/washboarding.json");
    let scene = Scene::from_json(scene).unwrap();
    for (stiffness, overlap, power_w, said) in [
        (3e4, 1.0, 15e3, "2400 rpm: unstable at"),
        (10.0, 1.0, 15e3, "2400 rpm: stable"),
        (3e4, 0.0, 15e3, "2400 rpm: stable"),
        (3e4, 1.0, 15e6, "2400 rpm: unstable at"),
    ] {
        let scene = scene.edited(|saw| {
            coarse(saw);
            let cut = saw.cut.as_mut().unwrap();
            cut.power_w = Some(power_w);
            let delayed = cut.washboarding.as_mut().unwrap();
            (delayed.stiffness_n_per_m, delayed.overlap) = (stiffness, overlap);
        });
        let scene = scene.unwrap();
        let run = scene.cut().unwrap().at_rpm(2400.0).unwrap();
        let report = washboard(&scene, &run, &|_, _| ()).unwrap();
        let sheet = layout::sheet(&washboard::chart(&report));
        assert_tidy(&sheet);
        let mut all = texts(&sheet).into_iter();
        assert!(all.any(|(_, text)| text.contains(said)), "{said}");
    }
}
