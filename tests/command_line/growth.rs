//! Goal: `cut` and `runup` give one answer on growing motions, within the range of the model.
//!
//! Source: the equations of `cut` and `runup`; the limit of five thicknesses of the blade.

use sawflutter::analyses::campbell::{InstabilityKind, Verdict};
use sawflutter::analyses::cut::{CutReport, CutStability};
use sawflutter::analyses::runup::RunUpReport;
use sawflutter::analyses::verdict::Answer;
use sawflutter::model::scene::{Accuracy, CutSpeedFile, Scene, SceneFile};
use sawflutter::stability::Analysis;
use serde_json::Value;
use tempfile::TempDir;

use super::program::{assert_in_80_columns, assert_refused, run, text, write_scene};
use crate::pressed::{assert_unstable, done, pressed};

/// The saw with two pads in the paper's cut, where vibration may grow under moving tooth loads alone.
fn two_pads() -> SceneFile {
    let mut file = crate::common::scene("two-pads").file().clone();
    let mut cut = Scene::paper().file().cut.clone().unwrap();
    cut.speeds.clear();
    file.cut = Some(cut);
    file
}

#[test]
fn a_cut_is_as_bad_as_the_worst_of_its_rows() {
    for file in [two_pads(), Scene::paper().file().clone()] {
        let (summary, json) = done("cut", &file);
        assert_in_80_columns(&summary);
        let report: CutReport = serde_json::from_slice(&json).unwrap();
        for run in &report.runs {
            let threshold = report.flutter_threshold_per_s;
            let growths = [
                run.growth_per_s,
                run.transient_growth_per_s.unwrap(),
                run.tooth_passing.passing_growth_per_s,
                run.idle_growth_per_s,
            ];
            let grows = growths.iter().any(|growth| *growth >= threshold);
            assert_eq!(
                run.stability == CutStability::Unstable,
                grows,
                "{growths:?}"
            );
            let word = match run.stability {
                CutStability::Unstable => "NO: growth of",
                CutStability::AtCritical => "AT RISK: within 5 %",
                _ if run.verdict.answer == Some(Answer::AtRisk) => "AT RISK:",
                _ => "YES: no vibration grows",
            };
            let line = format!("Can it cut at {} rpm? {word}", run.rpm);
            assert!(summary.contains(&line), "{line} is not in {summary}");
            let rows: Vec<f64> = run.criteria.iter().map(|row| row.growth_per_s).collect();
            assert_eq!(rows, growths);
        }
    }
}

/// `tests/trials/violent_cuts.rs` continues to forces that are a hundred thousand times as large.
#[test]
fn a_violent_saw_is_unstable() {
    assert_unstable(1e4);
}

/// The paper's saw in a cut of four teeth at a speed, under a lateral force on each tooth.
fn pushed(rpm: f64, lateral_n: f64) -> SceneFile {
    let mut file = Scene::paper().file().clone();
    let cut = file.cut.as_mut().unwrap();
    cut.teeth_in_cut = Some(4);
    cut.lateral_n_per_tooth = Some(lateral_n);
    cut.speeds = vec![CutSpeedFile {
        rpm,
        ..CutSpeedFile::default()
    }];
    file
}

/// The model is linear: the deflection by a hundredth of the force shows whether the whole force leaves the range of
/// the model. A saw without growth is called stable only if it does not.
#[test]
fn a_cut_that_deflects_the_blade_beyond_the_model_is_not_called_stable() {
    for (rpm, leaves) in [(1200.0, true), (1800.0, false)] {
        let force_n = 4.0;
        let (_, little_json) = done("cut", &pushed(rpm, 0.01 * force_n));
        let little: CutReport = serde_json::from_slice(&little_json).unwrap();
        let run = &little.runs[0];
        assert_eq!(run.stability, CutStability::Stable);
        let largest = [
            run.largest_deflection_in_cut_m.unwrap(),
            run.largest_deflection_after_m.unwrap(),
            run.tooth_passing.passing_deflection_m.unwrap(),
        ];
        let largest_m = 100.0 * largest.into_iter().fold(0.0, f64::max);
        assert_eq!(largest_m > little.linear_limit_m, leaves, "{largest_m} m");

        let (summary, json) = done("cut", &pushed(rpm, force_n));
        assert_in_80_columns(&summary);
        let report: CutReport = serde_json::from_slice(&json).unwrap();
        let (verdict, headline) = if leaves {
            (
                CutStability::LeavesModel,
                "deflection within the model: more than 5 thicknesses",
            )
        } else {
            // 1800 rpm are 122 % of the first critical speed in the cut.
            (CutStability::Stable, "12")
        };
        assert_eq!(report.runs[0].stability, verdict);
        assert_eq!(report.runs[0].certificate.growing_modes, 0);
        let words = summary.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(
            words.contains(&format!("{rpm} rpm? AT RISK: {headline}")),
            "{summary}"
        );
    }
}

/// The bands and critical speeds of the idling saw come from an analysis, the verdicts on a cut with hardly any force
/// from eigenvalues at one speed. The threshold of flutter does not excuse divergence.
#[test]
fn a_cut_in_a_band_of_divergence_or_beside_a_critical_speed_is_not_called_stable() {
    let saw = Scene::paper().edited(|saw| saw.accuracy = Accuracy::Draft);
    let report = Analysis::new(&saw.unwrap()).unwrap().report();
    let mut bands = report.instabilities.iter();
    let found = bands.find(|band| band.kind == InstabilityKind::Divergence);
    let (band, critical) = (found.unwrap(), report.critical_speeds[0].rpm);
    for (rpm, verdict) in [
        (band.peak_rpm, CutStability::Unstable),
        (critical - 2.0, CutStability::AtCritical),
        (0.9 * critical, CutStability::Stable),
    ] {
        let mut file = pushed(rpm, 0.0);
        file.flutter_threshold_per_s = 10.0 * band.peak_growth_per_s;
        let cut = file.cut.as_mut().unwrap();
        (cut.tangential_n_per_tooth, cut.radial_n_per_tooth) = (Some(0.1), Some(0.0));
        let (summary, json) = done("cut", &file);
        let report: CutReport = serde_json::from_slice(&json).unwrap();
        let run = &report.runs[0];
        assert_eq!(run.stability, verdict, "{summary}");
        let near = run.at_critical_rpm.map(|found| found / critical - 1.0);
        match verdict {
            CutStability::AtCritical => assert!(near.unwrap().abs() < 1e-3, "{near:?}"),
            CutStability::Stable => assert_eq!(near, None),
            _ => assert!((run.growth_per_s / band.peak_growth_per_s - 1.0).abs() < 0.02),
        }
        let own = run
            .map
            .guide_angle_deg
            .iter()
            .map(|deg| deg - file.guides[0].angle_deg);
        let column = own.into_iter().position(|turn| turn.abs() < 1e-9).unwrap();
        let grows = run.map.verdict[0][column] == Verdict::Unstable;
        assert_eq!(
            grows,
            verdict == CutStability::Unstable,
            "{:?}",
            run.map.verdict
        );
    }
}

/// Numbers in a text.
fn numbers(text: &str) -> impl Iterator<Item = f64> + '_ {
    let words = text.split(|c: char| !(c.is_ascii_digit() || c == '.'));
    words.filter_map(|word| word.trim_matches('.').parse().ok())
}

#[test]
fn no_deflection_of_a_cut_is_beyond_the_linear_model() {
    for file in [Scene::paper().file().clone(), pressed(1e5)] {
        let (summary, json) = done("cut", &file);
        let report: CutReport = serde_json::from_slice(&json).unwrap();
        assert_eq!(report.linear_limit_m, 5.0 * 0.0028);
        for run in &report.runs {
            let largest = [
                run.largest_deflection_in_cut_m,
                run.largest_deflection_after_m,
                run.tooth_passing.standing_deflection_m,
                run.tooth_passing.passing_deflection_m,
            ];
            let all = run.deflection_m.iter().chain(largest.iter().flatten());
            for w in all {
                assert!(w.abs() <= report.linear_limit_m, "{w} at {}", run.rpm);
            }
            if let Some(until_s) = run.linear_until_s {
                assert!(run.time_s.last().is_some_and(|last| *last < until_s));
                assert!(summary.contains("the linear model ends there"), "{summary}");
            }
        }
        assert!(report.runs.iter().any(|run| run.linear_until_s.is_some()));
        for line in summary.lines().filter(|line| line.ends_with(" mm")) {
            let mm: f64 = line
                .trim_end_matches(" mm")
                .rsplit(' ')
                .next()
                .unwrap()
                .parse()
                .unwrap();
            assert!(mm <= 14.0, "{line}");
        }
    }
}

#[test]
fn a_run_up_says_where_its_linear_model_ends() {
    let (summary, json) = done("runup", Scene::paper().file());
    assert_in_80_columns(&summary);
    assert!(numbers(&summary).all(|number| number < 1e4), "{summary}");
    let report: RunUpReport = serde_json::from_slice(&json).unwrap();
    let until_rpm = report.linear_until_rpm.unwrap();
    let about = format!(
        "valid up to about {:.0} rpm",
        10.0 * (until_rpm / 10.0).round()
    );
    assert!(summary.contains(&about), "{summary}");
    assert!(report.rpm.iter().all(|rpm| *rpm <= until_rpm));
    assert!(
        report
            .deflection_m
            .iter()
            .all(|w| w.abs() <= report.linear_limit_m)
    );
    for band in report.bands.iter().filter(|b| b.band.to_rpm > until_rpm) {
        assert_eq!(band.seen_amplification, None, "{band:?}");
    }
}

/// A run-up is refused if the force alone deflects the blade beyond the model.
#[test]
fn a_run_up_under_too_large_a_force_is_refused() {
    let folder = TempDir::new().unwrap();
    let mut file = Scene::paper().file().clone();
    file.side_force.as_mut().unwrap().force_n = Some(1e6);
    let scene = write_scene(&folder, &file);
    let arguments = ["runup", scene.to_str().unwrap(), "--accuracy", "draft"];
    assert_refused(&arguments, "side_force.force_n is 1000000", &folder);
}

/// The block that a refusal prints, between its first and its last brace.
fn block(error: &str, key: &str) -> Value {
    let from = error.find(&format!("\"{key}\"")).expect(error);
    let to = error[from..]
        .find("\n\n")
        .map_or(error.len(), |at| from + at);
    let pair = error[from..to].trim().trim_end_matches(',');
    let parsed: Value = serde_json::from_str(&format!("{{{pair}}}")).expect(pair);
    parsed[key].clone()
}

#[test]
fn the_block_that_a_refusal_prints_makes_the_scene_run() {
    for name in ["free-blade", "two-pads", "collar-400mm"] {
        for command in ["cut", "runup"] {
            let mut file = crate::common::scene(name).file().clone();
            file.operating_rpm = file.operating_rpm.filter(|_| name == "two-pads");
            file.blade.teeth = None;
            let folder = TempDir::new().unwrap();
            let path = write_scene(&folder, &file);
            let arguments = [command, path.to_str().unwrap(), "--accuracy", "draft"];
            let refused = run(&arguments, &folder);
            assert_eq!(refused.status.code(), Some(2));
            let error = text(&refused.stderr);
            let mut scene = serde_json::to_value(&file).unwrap();
            scene[command] = block(error, command);
            if command == "cut" {
                assert!(error.contains("\"teeth\": 40"), "{error}");
                scene["blade"]["teeth"] = 40.into();
            }
            std::fs::write(&path, scene.to_string()).unwrap();
            let output = run(&arguments, &folder);
            assert!(output.status.success(), "{}", text(&output.stderr));
        }
    }
}
