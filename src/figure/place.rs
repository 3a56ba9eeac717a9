//! The goal over two numbers of a guide, with marks for the best saw and for the saw that is best at its
//! nominal numbers.

use super::along::Along;
use super::canvas::{Sheet, Stroke};
use super::heading;
use super::key::Key;
use super::place_map::{HEIGHT, PANEL, Shades, WIDTH, draw_panel, goals, title};
use super::style::{ALARM, BETWEEN_FACTS, BLANK, INK, PAPER, STRONG_CURVE};
use super::written::in_words;
use crate::analyses::place::{Goal, GoalMap, PlaceReport};

/// Draws the map; `None` if the report contains none.
pub fn sheet(report: &PlaceReport) -> Option<Sheet> {
    let map = report.map.as_ref()?;
    let mut sheet = Sheet::new(WIDTH, HEIGHT);
    heading::draw(&mut sheet, title(report.goal), &facts(report));
    let shades = Shades::of(goals(map));
    let (x, y) = draw_panel(&mut sheet, map, &shades);
    draw_marks(&mut sheet, report, map, &x, &y);
    draw_key(&mut sheet, report, map);
    Some(sheet)
}

fn facts(report: &PlaceReport) -> String {
    let goal = match report.goal {
        Goal::FlutterSpeed => "flutter",
        Goal::StableWindow => "window of",
    };
    let beyond = match (report.goal, report.best.flutter_rpm) {
        (Goal::FlutterSpeed, None) => "beyond ",
        _ => "",
    };
    let best = format!(
        "best: {goal} {beyond}{:.0} rpm (before {:.0} rpm)",
        report.best.goal_rpm, report.before.goal_rpm
    );
    let values = report.parameters.iter();
    let values = values.map(|p| in_words(&p.path, p.value));
    let worst = format!(
        "{}worst within tolerances: {:.0} %",
        if report.fragile { "fragile, " } else { "" },
        100.0 * report.worst_neighbour_share
    );
    [report.condition.clone(), best]
        .into_iter()
        .chain(values)
        .chain([worst])
        .collect::<Vec<_>>()
        .join(BETWEEN_FACTS)
}

/// Marks the scene, the fragile optimum and the best saw.
fn draw_marks(sheet: &mut Sheet, report: &PlaceReport, map: &GoalMap, x: &Along, y: &Along) {
    let place = |value_of: &dyn Fn(usize) -> Option<f64>| {
        let number = |path: &str| {
            let index = report.parameters.iter().position(|p| p.path == path)?;
            value_of(index)
        };
        let across = x.at(number(&map.x_path)?);
        let up = match &map.y_path {
            Some(path) => y.at(number(path)?),
            None => (PANEL.top + PANEL.bottom) / 2.0,
        };
        Some([across, up])
    };
    if let Some(at) = place(&|k| Some(report.parameters[k].start)) {
        sheet.ring(at, 5.0, Stroke::solid(INK, 2.0));
    }
    let fragile = report.fragile_optimum.as_ref();
    if let Some(at) = place(&|k| fragile?.saw.values.get(k).copied()) {
        draw_fragile(sheet, at);
    }
    if let Some(at) = place(&|k| Some(report.parameters[k].value)) {
        draw_best(sheet, at);
    }
}

/// Draws a red ring on a white disc.
fn draw_fragile(sheet: &mut Sheet, at: [f64; 2]) {
    sheet.disc(at, 8.0, PAPER);
    sheet.ring(at, 6.0, Stroke::solid(ALARM, 2.0));
}

/// Draws a red cross in a ring on a white disc.
fn draw_best(sheet: &mut Sheet, [x, y]: [f64; 2]) {
    sheet.disc([x, y], 11.0, PAPER);
    sheet.ring([x, y], 9.0, Stroke::solid(ALARM, 2.0));
    let arm = 6.0;
    for line in [[[x - arm, y], [x + arm, y]], [[x, y - arm], [x, y + arm]]] {
        sheet.line(line, Stroke::solid(ALARM, STRONG_CURVE / 1.7));
    }
}

fn draw_key(sheet: &mut Sheet, report: &PlaceReport, map: &GoalMap) {
    let mut key = Key::new(sheet, PANEL.left, f64::from(HEIGHT) - 26.0);
    key.mark(22.0, |sheet, [x, y]| draw_best(sheet, [x + 11.0, y]))
        .word("best in the worst case of its tolerances")
        .ring(10.0, 5.0, Stroke::solid(INK, 2.0))
        .word("the scene")
        .word("colours: coarse model");
    if report.fragile_optimum.is_some() {
        key.mark(12.0, |sheet, [x, y]| draw_fragile(sheet, [x + 6.0, y]))
            .word("better nominally, fragile");
    }
    if map.kept.iter().flatten().any(|kept| !kept) {
        let limit = report.min_critical_rpm.map_or("no saw".into(), |rpm| {
            format!("lowest critical speed below {rpm:.0} rpm")
        });
        key.shade(BLANK).word(&limit);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analyses::place::{
        FragileOptimum, Neighbour, Outcome, PlaceCertificate, PlacedParameter,
    };
    use crate::figure::tidy::{assert_tidy, texts};
    use crate::scene::Scene;

    fn report(y_path: Option<&str>) -> PlaceReport {
        let outcome = Outcome {
            goal_rpm: 2300.0,
            flutter_rpm: Some(2300.0),
            critical_rpm: Some(1600.0),
            window_rpm: None,
            deflection_m: None,
            kept: true,
        };
        let neighbour = |goal_rpm: f64, values: [f64; 2]| Neighbour {
            values: values.into(),
            outcome: Some(Outcome {
                goal_rpm,
                ..outcome
            }),
        };
        let placed = |path: &str, value: f64, bound_to: f64| PlacedParameter {
            path: path.into(),
            start: 0.9 * value,
            value,
            bound_from: 0.5 * value,
            bound_to,
            at_bound: false,
            offset: 0.002,
            less_rpm: Some(2250.0),
            more_rpm: None,
        };
        let (x, y) = (vec![0.2, 0.25, 0.3], vec![1e6, 1e7, 1e8]);
        let rows = if y_path.is_some() { 3 } else { 1 };
        PlaceReport {
            sawflutter: "0".into(),
            scene: Scene::paper().file().clone(),
            condition: "idling".into(),
            unusual_numbers: Vec::new(),
            goal: Goal::FlutterSpeed,
            min_critical_rpm: Some(1500.0),
            amplitude_m: None,
            max_deflection_m: None,
            force_n: None,
            kept: true,
            improved: true,
            from_rpm: 0.0,
            to_rpm: 3000.0,
            flutter_threshold_per_s: 0.25,
            parameters: vec![
                placed("guides[0].radius_m", 0.25, 0.3),
                placed("guides[0].stiffness_n_per_m", 2e7, 1e8),
            ],
            without_effect: Vec::new(),
            before: outcome,
            worst_before: neighbour(2000.0, [0.22, 1.8e7]),
            best: outcome,
            bands: Vec::new(),
            certificate: PlaceCertificate {
                statement: "Krein index matches at 9 of 9 speeds".into(),
                is_clean: true,
                speeds_checked: 9,
                full_basis_counts: 0,
            },
            fragile: true,
            worst_neighbour: Some(neighbour(2093.0, [0.248, 2e7])),
            worst_neighbour_share: 0.91,
            fragile_optimum: Some(FragileOptimum {
                saw: neighbour(2400.0, [0.21, 5e6]),
                worst: neighbour(1900.0, [0.212, 5e6]),
            }),
            almost: Vec::new(),
            map: Some(GoalMap {
                x_path: "guides[0].radius_m".into(),
                x,
                y_path: y_path.map(str::to_owned),
                y: if y_path.is_some() { y } else { vec![0.0] },
                goal_rpm: vec![vec![Some(2000.0), Some(2300.0), None]; rows],
                kept: vec![vec![true, true, false]; rows],
            }),
            saws: 100,
            failed_saws: 0,
            max_diameters: 8,
            radial_functions: 5,
            warnings: Vec::new(),
        }
    }

    #[test]
    fn a_fragile_optimum_is_described_with_its_numbers_and_is_not_the_answer() {
        let summary = report(None).summary().replace("\n  ", " ");
        let expected = "Not the answer: guides[0].radius_m = 0.21, guides[0].stiffness_n_per_m = 5e6 has a flutter speed of 2400 rpm, which falls to 1900 rpm within the tolerances";
        assert!(summary.contains(expected), "{summary}");
        assert!(summary.contains("0.125 to 0.3"), "bounds: {summary}");
    }

    #[test]
    fn nothing_is_cut_off_or_hidden() {
        for y_path in [None, Some("guides[0].stiffness_n_per_m")] {
            let sheet = sheet(&report(y_path)).unwrap();
            assert_tidy(&sheet);
            let all: Vec<&str> = texts(&sheet).iter().map(|(_, text)| *text).collect();
            assert!(
                all.iter().any(|text| text.contains("below 1500 rpm")),
                "{all:?}"
            );
            assert!(all.iter().any(|text| text.contains("[mm]")), "{all:?}");
            assert!(all.iter().any(|text| text.contains("fragile")), "{all:?}");
        }
        let without = PlaceReport {
            map: None,
            ..report(None)
        };
        assert!(super::sheet(&without).is_none());
    }
}
