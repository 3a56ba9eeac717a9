//! Goal: the answer comes first, in lines that fit a terminal, and text and JSON agree.

use std::sync::LazyLock;

use sawflutter::analyses::campbell::{Report, StabilityState};
use sawflutter::analyses::check::CheckReport;
use sawflutter::analyses::commands::COMMANDS;
use sawflutter::model::scene::{Accuracy, Scene};
use tempfile::TempDir;

use super::program::{
    assert_in_80_columns, assert_refused, run, sawflutter, text, write_scene, written,
};

/// The paper's saw with a damped pad, and its modes at 1800 rpm: (text, report).
static DAMPED_PAD: LazyLock<(String, Report)> = LazyLock::new(|| {
    let folder = TempDir::new().unwrap();
    let mut file = Scene::paper().file().clone();
    file.guides[0].damping_n_s_per_m = 50.0;
    file.accuracy = Accuracy::Draft;
    let scene = write_scene(&folder, &file);
    let arguments = ["analyze", scene.to_str().unwrap(), "--rpm", "1800"];
    let output = run(&arguments, &folder);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let report = written(&folder, "report.json");
    (text(&output.stdout).to_owned(), report)
});

fn fits(text: &str) {
    assert_in_80_columns(text);
    assert!(!text.contains('\u{1b}'), "no colour in a pipe: {text}");
}

/// A damped pad feeds a wave by 1.5e-5 1/s at 1800 rpm: text, JSON and `check` call the saw stable, because flutter
/// begins where its growth reaches the threshold.
#[test]
fn a_damped_pad_is_stable_where_its_growth_is_below_the_threshold() {
    let (text, report) = &*DAMPED_PAD;
    fits(text);
    let operating = report.operating.as_ref().unwrap();
    assert_eq!(operating.stability, StabilityState::Stable);
    assert_eq!(operating.inside_instability, None);
    let growth = operating.growth_per_s.unwrap();
    assert!(growth > 1e-5 && growth < 3e-5, "{growth}");
    let [from, to] = operating.safe_window_rpm.unwrap();
    assert!(from < 1800.0 && 1800.0 < to);
    assert!(
        text.contains("Can it run at 1800 rpm? AT RISK: 118 %"),
        "{text}"
    );
    assert!(
        text.contains(&format!("{from:.1} to {to:.1} rpm")),
        "{text}"
    );
    assert!(!text.contains("UNSTABLE"), "{text}");
    let flutter = report.flutter_rpm.unwrap();
    assert!((2200.0..2300.0).contains(&flutter), "{flutter}");
    let counted = report.instabilities.iter().flat_map(|b| &b.counted_rpm);
    assert!(
        counted
            .clone()
            .all(|[from, to]| *to < 1800.0 || *from > 1800.0)
    );
    for band in &report.instabilities {
        assert!(
            band.closed || band.to_rpm == report.campbell.to_rpm,
            "{band:?}"
        );
    }
    let ratio = report.modes_at_rest[0].damping_ratio.unwrap();
    let decrement = report.modes_at_rest[0].logarithmic_decrement.unwrap();
    let expected = std::f64::consts::TAU * ratio / (1.0 - ratio * ratio).sqrt();
    assert!(ratio > 0.0 && (decrement / expected - 1.0).abs() < 1e-12);
}

/// The table of one speed has the modes of the chart, with the damping ratio of a damped scene.
#[test]
fn the_modes_of_one_speed_are_listed_when_asked_for() {
    let (text, report) = &*DAMPED_PAD;
    fits(text);
    let whirl = report.whirl.as_ref().unwrap();
    assert_eq!(whirl.rpm, 1800.0);
    assert!(text.contains("Modes at 1800 rpm: stable"), "{text}");
    for mode in &whirl.modes {
        let line = format!("{:.3}", mode.frequency_hz);
        assert!(
            text.lines()
                .any(|l| l.contains(&line) && l.contains(&mode.name)),
            "{text}"
        );
        let size = (mode.growth_per_s.powi(2)
            + (std::f64::consts::TAU * mode.frequency_hz).powi(2))
        .sqrt();
        assert!((mode.damping_ratio.unwrap() + mode.growth_per_s / size).abs() < 1e-12);
    }
    let folder = TempDir::new().unwrap();
    let beyond = ["analyze", "--accuracy", "draft", "--rpm", "9000"];
    let words = "--rpm must be from 0 to 3000 … (you gave 9000)";
    assert_refused(&beyond, words, &folder);
}

fn text_of(bytes: &[u8]) -> String {
    text(bytes).to_owned()
}

/// Above the first critical speed the stiffness against a stationary force has no meaning, and is not printed. It would
/// be 22.8 N/mm at 1800 rpm, and −37.8 and 189 N/mm at other speeds.
#[test]
fn rim_stiffness_past_the_first_critical_speed_is_left_out() {
    let check = |rpm: &str, json: bool| {
        let mut command = sawflutter();
        command.args(["check", "--accuracy", "draft", "--rpm", rpm]);
        if json {
            command.arg("--json");
        }
        text_of(&command.output().unwrap().stdout)
    };
    let past: CheckReport = serde_json::from_str(&check("1800", true)).unwrap();
    assert_eq!(past.rim_stiffness_n_per_m, None);
    let words = check("1800", false);
    let words = words.replace("\n  ", " ");
    assert!(
        words.contains("none above the first critical speed"),
        "{words}"
    );
    let before: CheckReport = serde_json::from_str(&check("1250", true)).unwrap();
    let softer = before.rim_stiffness_n_per_m.unwrap();
    assert!(0.0 < softer && softer < before.rim_stiffness_at_rest_n_per_m);
    let at_1250 = check("1250", false).replace("\n  ", " ");
    assert!(at_1250.contains("N/mm at the operating speed"), "{at_1250}");
}

/// A terminal or pager that wraps longer lines would break the columns of the examples.
#[test]
fn examples_of_every_help_fit_80_columns() {
    let others = ["", "tradeoff", "export", "keys", "schema"];
    let commands = COMMANDS.iter().map(|command| command.name);
    for command in commands.chain(others) {
        let arguments: Vec<&str> = [command, "--help"]
            .into_iter()
            .filter(|a| !a.is_empty())
            .collect();
        let help = text_of(&sawflutter().args(&arguments).output().unwrap().stdout);
        let examples = help
            .lines()
            .skip_while(|line| !line.starts_with("Examples"));
        for line in examples {
            assert!(line.chars().count() <= 80, "{command}: {line}");
        }
    }
}

/// The error beside the flutter speed is that of its band and not that of the critical speeds, which is smaller.
#[test]
fn the_flutter_speed_has_the_error_of_its_band() {
    let folder = TempDir::new().unwrap();
    let scene = write_scene(&folder, Scene::paper().file());
    let output = run(&["analyze", scene.to_str().unwrap()], &folder);
    let report: Report = written(&folder, "report.json");
    let rpm = report.flutter_rpm.unwrap();
    let band = report.instabilities.iter().find(|b| b.from_rpm == rpm);
    let share = band.unwrap().estimated_relative_error.unwrap();
    assert!(share > report.accuracy.estimated_relative_error.unwrap());
    let line = format!("Flutter speed: {rpm:.0} rpm ± {:.1} ", share * rpm);
    let said = text(&output.stdout);
    assert!(said.contains(&line), "{line} in {said}");
}

/// No band begins at the critical speed of a blade without guides: nothing grows there, although the deflection by a
/// constant side force is unbounded.
#[test]
fn a_saw_at_a_critical_speed_is_reported() {
    let at = |operating_rpm: f64| {
        let saw = Scene::paper().edited(|saw| {
            saw.guides.clear();
            saw.accuracy = Accuracy::Draft;
            saw.operating_rpm = Some(operating_rpm);
        });
        let report = sawflutter::stability::Analysis::new(&saw.unwrap()).unwrap();
        let report = report.report();
        fits(&report.summary());
        report
    };
    let critical = at(1000.0).critical_speeds[0].rpm;
    let [from, to] = at(1000.0).operating.unwrap().safe_window_rpm.unwrap();
    assert!(from == 0.0 && (to / critical - 0.95).abs() < 1e-9, "{to}");
    for speed in [0.96 * critical, critical, 1.04 * critical] {
        let report = at(speed);
        let (text, operating) = (report.summary(), report.operating.unwrap());
        assert_eq!(operating.stability, StabilityState::Stable);
        let reported = operating.at_critical_rpm.unwrap();
        assert!((reported / critical - 1.0).abs() < 1e-9, "{reported}");
        assert_eq!(operating.safe_window_rpm, None);
        assert!(
            text.contains("AT RISK: within 5 % of the critical speed"),
            "{text}"
        );
        assert!(
            text.contains(&format!("critical speed {critical:.1} rpm (2 diameters")),
            "{text}"
        );
    }
}

/// Nothing restrains a blade on a spline without guides: it fails every limit.
#[test]
fn an_unrestrained_blade_does_not_pass() {
    let folder = TempDir::new().unwrap();
    let mut file = Scene::paper().file().clone();
    file.guides.clear();
    file.accuracy = Accuracy::Draft;
    let scene_path = write_scene(&folder, &file);
    let scene = scene_path.to_str().unwrap();
    let output = run(&["check", scene, "--rpm", "600"], &folder);
    let shown = text(&output.stdout);
    assert_eq!(output.status.code(), Some(1), "{shown}");
    assert!(
        shown.contains("RISK static stiffness: nothing holds"),
        "{shown}"
    );
    assert!(
        shown.contains("nothing holds the blade's rigid motions"),
        "{shown}"
    );
    let guided = run(&["check", "--rpm", "600", "--accuracy", "draft"], &folder);
    assert_eq!(guided.status.code(), Some(0), "{}", text(&guided.stdout));
}

/// The summary of the paper's saw at an operating speed in rpm.
fn at_operating(operating_rpm: f64) -> sawflutter::analyses::campbell::Report {
    let saw = Scene::paper().edited(|saw| {
        saw.accuracy = Accuracy::Draft;
        saw.operating_rpm = Some(operating_rpm);
    });
    let analysis = sawflutter::stability::Analysis::new(&saw.unwrap()).unwrap();
    analysis.report()
}

#[test]
fn a_saw_that_hardly_turns_has_a_limit_of_its_speed() {
    let report = at_operating(1e-3);
    let (summary, critical) = (report.summary(), report.critical_speeds[0].rpm);
    fits(&summary);
    assert!(!summary.contains("NaN"), "{summary}");
    let limit = format!("run up to {:.0} rpm (85 %", (0.85 * critical).floor());
    let joined = summary.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(joined.contains(&limit), "{summary}");
}

#[test]
fn the_edge_of_a_band_is_not_contradicted() {
    let band = at_operating(1250.0).instabilities[0].clone();
    for rpm in [band.from_rpm, band.to_rpm] {
        let report = at_operating(rpm);
        let summary = report.summary();
        assert!(summary.contains("AT RISK: too close to call"), "{summary}");
        assert!(!summary.contains("UNSTABLE"), "{summary}");
        // Inside the band or not: the words are those of one side.
        let is_inside = summary.contains("an edge of this band");
        let is_outside = summary.contains("no vibration grows");
        assert!(!(is_inside && is_outside), "{summary}");
    }
}
