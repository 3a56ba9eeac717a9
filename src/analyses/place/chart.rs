//! The goal over one or two numbers of a guide, with marks for the best saw and for the saw that is best at its
//! nominal numbers.

use super::{FrontSaw, Goal, GoalMap, PlaceReport, PlacedParameter};
use crate::analyses::scene_axis::Along;
use crate::analyses::scene_number::in_words;
use crate::page::figure::axis::{Spread, extremes};
use crate::page::figure::chart_data::{AxisData, ChartData, PanelData};
use crate::page::figure::items::{Area, Heat, Item, Line, Points, Shape};
use crate::page::figure::palette::{Hue, LOW_TO_HIGH};
use crate::page::figure::style::CURVE;

/// Heights of the panel for two numbers and for one, relative to one of usual height.
const SHARES: [f64; 2] = [1.45, 1.0];
/// Height of the panel of the front.
const FRONT_SHARE: f64 = 0.7;
/// Smallest range of an axis of speeds, as a share of them: numerical noise is no dependence.
const NARROWEST: f64 = 0.02;
const FRONT_SIZE: f64 = 6.0;
/// Room around the points of the front, as a share of their range.
const FRONT_ROOM: f64 = 0.1;
const BEST_SIZE: f64 = 18.0;
const CROSS_SIZE: f64 = 10.0;
const SCENE_SIZE: f64 = 10.0;
const FRAGILE_SIZE: f64 = 12.0;

/// The map, as numbers, and the front below it; `None` if the report contains neither.
pub fn chart(report: &PlaceReport) -> Option<ChartData> {
    let (title, goal) = match report.goal {
        Goal::FlutterSpeed => (
            "Flutter speed over the position of the guide",
            "flutter speed",
        ),
        Goal::StableWindow => ("Stable window around the operating speed", "stable window"),
    };
    let map = report.map.as_ref().map(|map| {
        let x = Along::of_cells(&map.x_path, &map.x);
        match &map.y_path {
            Some(path) => over_two(report, map, x, Along::of_cells(path, &map.y)),
            None => over_one(report, map, x, goal),
        }
    });
    let panels: Vec<PanelData> = map.into_iter().chain(front(report, goal)).collect();
    if panels.is_empty() {
        return None;
    }
    let (title, key) = match &report.map {
        Some(map) => (title.to_owned(), key(report, map)),
        None => {
            let title = format!("Worst {goal} against the deflection at the cut");
            (title, Vec::new())
        }
    };
    Some(ChartData {
        key,
        ..ChartData::new(&title, facts(report), panels)
    })
}

/// The worst case of the goal over the deflection at the cut; `None` where nothing is traded.
fn front(report: &PlaceReport, goal: &str) -> Option<PanelData> {
    let [_, .., last] = report.traded() else {
        return None;
    };
    let at = |saw: &FrontSaw| [1e3 * saw.deflection_m, saw.worst_goal_rpm];
    let name = format!("worst {goal} within the tolerances");
    let all = report.front.iter().map(at);
    let line = Line {
        width: 0.75 * CURVE,
        ..Line::new(all.clone(), Hue::Forward, &name)
    };
    let said = report.front.iter().map(|saw| {
        let numbers = report.parameters.iter().zip(&saw.values);
        let words = numbers.map(|(p, value)| in_words(&p.path, *value));
        words.collect::<Vec<_>>().join(", ")
    });
    let points = Points {
        said: said.collect(),
        ..Points::new(all, Hue::Forward, FRONT_SIZE, &name)
    };
    let answer = Points {
        shape: Shape::Ring,
        ..Points::new([at(last)], Hue::Alarm, BEST_SIZE, "best in the worst case")
    };
    let items = vec![Item::Line(line), Item::Points(points), Item::Points(answer)];
    let worst = report.front.iter().map(|saw| saw.worst_goal_rpm);
    let [low, high] = range(&[worst.collect()]);
    let room = FRONT_ROOM * (high - low);
    let [largest_mm, _] = at(last);
    Some(PanelData {
        share: FRONT_SHARE,
        ..PanelData::new(
            AxisData::new("deflection at the cut at the operating speed", "mm")
                .within([0.0, (1.0 + FRONT_ROOM) * largest_mm]),
            AxisData::new(&format!("worst {goal}"), "rpm").within([low - room, high + room]),
            items,
        )
    })
}

fn facts(report: &PlaceReport) -> Vec<String> {
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
    let values = report.parameters.iter().map(|p| in_words(&p.path, p.value));
    let worst = format!(
        "{}worst within tolerances: {:.0} %",
        if report.fragile { "fragile, " } else { "" },
        100.0 * report.worst_neighbour_share
    );
    [report.condition.clone(), best]
        .into_iter()
        .chain(values)
        .chain([worst])
        .collect()
}

/// Goals in rpm of a row of the map; NaN where the limit of the critical speed is not kept.
fn goals(map: &GoalMap, row: usize) -> Vec<f64> {
    let cells = map.goal_rpm[row].iter().zip(&map.kept[row]);
    let goals = cells.map(|(goal, kept)| goal.filter(|_| *kept));
    goals.map(|goal| goal.unwrap_or(f64::NAN)).collect()
}

/// Smallest and largest goal in rpm, with a range around them if they hardly differ.
fn range(rows: &[Vec<f64>]) -> [f64; 2] {
    match extremes(rows.iter().flatten().copied().filter(|rpm| rpm.is_finite())) {
        [low, high] if low.is_finite() => {
            let middle = 0.5 * (low + high);
            let half = (0.5 * (high - low)).max(0.5 * NARROWEST * middle).max(1.0);
            [middle - half, middle + half]
        }
        _ => [0.0, 1.0],
    }
}

fn over_two(report: &PlaceReport, map: &GoalMap, x: Along, y: Along) -> PanelData {
    let z: Vec<Vec<f64>> = (0..map.y.len()).map(|row| goals(map, row)).collect();
    let [low, high] = y.axis.range.unwrap_or([0.0, 1.0]);
    let edges = x.axis.range.unwrap_or([0.0, 1.0]).map(|x| [x, low, high]);
    let heat = Heat {
        x: x.values.clone(),
        y: y.values.clone(),
        range: range(&z),
        z,
        spread: Spread::Linear,
        colours: LOW_TO_HIGH.to_vec(),
        name: "speed".to_owned(),
        unit: "rpm".to_owned(),
    };
    let place = |saw: &Saw| {
        Some([
            x.at(saw.number(&map.x_path)?),
            y.at(saw.number(map.y_path.as_deref()?)?),
        ])
    };
    let marks = marks(report, place);
    let ground = Area::new(edges, Hue::Blank, &limit(report));
    let items = [Item::Area(ground), Item::Heat(heat)];
    PanelData {
        share: SHARES[0],
        ..PanelData::new(x.axis, y.axis, items.into_iter().chain(marks).collect())
    }
}

fn over_one(report: &PlaceReport, map: &GoalMap, x: Along, goal: &str) -> PanelData {
    let z = goals(map, 0);
    let place = |saw: &Saw| Some([x.at(saw.number(&map.x_path)?), saw.goal_rpm?]);
    let marks = marks(report, place);
    let best = saws(report).into_iter().filter_map(|saw| saw.goal_rpm);
    let [low, high] = range(&[z.clone(), best.collect()]);
    let room = 0.06 * (high - low);
    let points = x.values.iter().zip(&z).map(|(x, rpm)| [*x, *rpm]);
    let [bottom, top] = [low - room, high + room];
    let lost = x.values.iter().zip(&z).map(|(x, rpm)| {
        if rpm.is_nan() {
            [*x, bottom, top]
        } else {
            [*x, f64::NAN, f64::NAN]
        }
    });
    let items = [
        Item::Area(Area::new(lost, Hue::Blank, &limit(report))),
        Item::Line(Line::new(points, Hue::Forward, goal)),
    ];
    PanelData {
        share: SHARES[1],
        ..PanelData::new(
            x.axis.clone(),
            AxisData::new(goal, "rpm").within([bottom, top]),
            items.into_iter().chain(marks).collect(),
        )
    }
}

/// Numbers of a saw, with their paths, and its goal.
struct Saw<'a> {
    report: &'a PlaceReport,
    values: Vec<f64>,
    goal_rpm: Option<f64>,
}

impl Saw<'_> {
    fn number(&self, path: &str) -> Option<f64> {
        let parameters = &self.report.parameters;
        let index = parameters.iter().position(|p| p.path == path)?;
        self.values.get(index).copied()
    }
}

/// The saw of the scene, the fragile one if there is one, and the best one.
fn saws(report: &PlaceReport) -> Vec<Saw<'_>> {
    let saw = |values: Vec<f64>, goal_rpm| Saw {
        report,
        values,
        goal_rpm,
    };
    let of = |value: fn(&PlacedParameter) -> f64| report.parameters.iter().map(value).collect();
    let fragile = report.fragile_optimum.as_ref().map(|fragile| {
        let goal = fragile.saw.outcome.map(|outcome| outcome.goal_rpm);
        saw(fragile.saw.values.clone(), goal)
    });
    [saw(of(|p| p.start), Some(report.before.goal_rpm))]
        .into_iter()
        .chain(fragile)
        .chain([saw(of(|p| p.value), Some(report.best.goal_rpm))])
        .collect()
}

/// A ring around a saw.
struct Ring {
    hue: Hue,
    size: f64,
    name: &'static str,
}

/// Rings of the scene, the fragile saw and the best one.
fn rings(is_fragile: bool) -> Vec<Ring> {
    let ring = |hue, size, name| Ring { hue, size, name };
    let fragile = ring(Hue::Alarm, FRAGILE_SIZE, "better nominally, fragile");
    let best = "best in the worst case of its tolerances";
    [ring(Hue::Ink, SCENE_SIZE, "the scene")]
        .into_iter()
        .chain(is_fragile.then_some(fragile))
        .chain([ring(Hue::Alarm, BEST_SIZE, best)])
        .collect()
}

/// Marks of the scene, the fragile optimum and the best saw.
fn marks(report: &PlaceReport, place: impl Fn(&Saw) -> Option<[f64; 2]>) -> Vec<Item> {
    let rings = rings(report.fragile_optimum.is_some());
    let saws = saws(report);
    let drawn = saws.iter().zip(rings).filter_map(|(saw, ring)| {
        let name = ring.name;
        let goal = saw.goal_rpm.map(|rpm| format!("{name}: {rpm:.0} rpm"));
        Some(Item::Points(Points {
            shape: Shape::Ring,
            said: goal.into_iter().collect(),
            ..Points::new([place(saw)?], ring.hue, ring.size, name)
        }))
    });
    let cross = saws.last().and_then(&place).map(|at| {
        Item::Points(Points {
            shape: Shape::Cross,
            ..Points::new([at], Hue::Alarm, CROSS_SIZE, "best saw")
        })
    });
    drawn.chain(cross).collect()
}

/// Meaning of cells without a goal.
fn limit(report: &PlaceReport) -> String {
    report.min_critical_rpm.map_or("no saw".into(), |rpm| {
        format!("first critical speed below {rpm:.0} rpm")
    })
}

fn key(report: &PlaceReport, map: &GoalMap) -> Vec<Item> {
    let rings = rings(report.fragile_optimum.is_some()).into_iter().rev();
    let marks = rings.map(|ring| Item::points_sample(ring.size, Shape::Ring, ring.hue, ring.name));
    let is_lost = map.kept.iter().flatten().any(|kept| !kept);
    let lost = is_lost.then(|| Item::area_sample(Hue::Blank, &limit(report)));
    marks.chain(lost).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analyses::place::{FragileOptimum, FrontSaw, Neighbour, Outcome, PlaceCertificate};
    use crate::model::scene::Scene;
    use crate::page::figure::layout::sheet;
    use crate::page::figure::tidiness::texts;

    fn report(y_path: Option<&str>) -> PlaceReport {
        let outcome = Outcome {
            goal_rpm: 2300.0,
            flutter_rpm: Some(2300.0),
            first_critical_rpm: Some(1600.0),
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
            across_rpm: None,
        };
        let (x, y) = (vec![0.2, 0.25, 0.3], vec![1e6, 1e7, 1e8]);
        let rows = if y_path.is_some() { 3 } else { 1 };
        PlaceReport {
            verdict: None,
            verdict_before: None,
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
            front: vec![
                FrontSaw {
                    values: vec![0.3, 2e7],
                    flutter_rpm: Some(2100.0),
                    first_critical_rpm: Some(1700.0),
                    worst_goal_rpm: 2040.0,
                    deflection_m: 2e-5,
                },
                FrontSaw {
                    values: vec![0.25, 2e7],
                    flutter_rpm: Some(2300.0),
                    first_critical_rpm: Some(1600.0),
                    worst_goal_rpm: 2093.0,
                    deflection_m: 3e-5,
                },
            ],
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
            let sheet = sheet(&chart(&report(y_path)).unwrap());
            let all = texts(&sheet);
            assert!(
                all.iter().any(|text| text.contains("below 1500 rpm")),
                "{all:?}"
            );
            assert!(all.iter().any(|text| text.contains("[mm]")), "{all:?}");
            assert!(all.iter().any(|text| text.contains("fragile")), "{all:?}");
            let goal = all.iter().any(|text| text.contains("worst flutter speed"));
            assert!(goal, "{all:?}");
        }
        // Without a map the front is drawn alone; without a front, nothing is.
        let without = PlaceReport {
            map: None,
            ..report(None)
        };
        let _drawn = sheet(&chart(&without).unwrap());
        let neither = PlaceReport {
            front: Vec::new(),
            ..without
        };
        assert!(chart(&neither).is_none());
    }
}
