//! Limits and results of a check, each in its own row over a common axis of speeds, and the stiffness of the rim.

use super::CheckReport;
use super::outline::in_one_word;
use crate::analyses::verdict::Criterion;
use crate::page::figure::chart_data::{AxisData, ChartData, PanelData};
use crate::page::figure::items::{Band, Item, Line, Points, Role, Shape, Upright};
use crate::page::figure::palette::Hue;
use crate::page::figure::style::STRONG_CURVE;

/// Height of a row and of the panel of the stiffness, relative to a panel of usual height.
const ROW: f64 = 0.135;
const STIFFNESS: f64 = 0.34;
/// Width of the bar from the limit to the result, and share of its colour.
const BAR: f64 = 14.0;
const BAR_TINT: f64 = 0.35;
/// Ends of the mark of a limit above and below the middle of its row.
const LIMIT: [f64; 2] = [-0.15, 0.3];
const RESULT_SIZE: f64 = 12.0;

/// Rows of the limits, and the stiffness of the rim, as numbers.
pub fn chart(report: &CheckReport) -> ChartData {
    let title = format!("{}: {}", report.scene.name, report.verdict.in_table());
    let speed = AxisData::speed().within([0.0, last_shown_rpm(report)]);
    let panels = vec![limits(report, &speed), stiffness(report, &speed)];
    ChartData {
        key: key(),
        ..ChartData::new(&title, facts(report), panels)
    }
}

/// End of the axis in rpm. The axis includes the sweep, every limit and every result; the first critical speed may
/// be beyond the sweep.
fn last_shown_rpm(report: &CheckReport) -> f64 {
    let of_criterion = |c: &Criterion| c.asked_rpm.max(c.found_rpm.unwrap_or(0.0));
    let criteria = report.verdict.limits.iter().map(of_criterion);
    let marks = criteria.chain([report.operating_rpm]).fold(0.0, f64::max);
    report.to_rpm.max(1.03 * marks)
}

fn facts(report: &CheckReport) -> Vec<String> {
    let unusual =
        (!report.unusual_numbers.is_empty()).then(|| "with numbers that no saw has".into());
    let facts = [
        report.condition.clone(),
        format!("operating speed {:.0} rpm", report.operating_rpm),
        format!("margin {:.0} %", 100.0 * report.limits.margin()),
        report.rim_stiffness_in_words(),
    ];
    unusual.into_iter().chain(facts).collect()
}

/// The operating speed, the end of the sweep if it is within the axis, and the critical speeds.
fn speeds(report: &CheckReport, last: f64) -> Vec<Item> {
    let operating = Upright {
        x: report.operating_rpm,
        role: Role::Operating,
        colour: Hue::Ink,
        dashed: false,
        label: format!("operating {:.0}", report.operating_rpm),
        name: format!("operating {:.0} rpm", report.operating_rpm),
    };
    let end = (report.to_rpm < last).then(|| Upright {
        x: report.to_rpm,
        role: Role::Guide,
        colour: Hue::Quiet,
        dashed: true,
        label: "end of the sweep".to_owned(),
        name: "end of the sweep".to_owned(),
    });
    let critical = report.critical_rpm.iter().map(|rpm| Upright {
        name: format!("critical speed {rpm:.0} rpm"),
        ..Upright::critical(*rpm, "")
    });
    let all = [operating].into_iter().chain(end).chain(critical);
    all.map(Item::Upright).collect()
}

fn limits(report: &CheckReport, speed: &AxisData) -> PanelData {
    let last = last_shown_rpm(report);
    let bands = report
        .instabilities
        .iter()
        .map(|band| Item::Band(Band::new(band, [0.0, last])));
    let rows = (1..).map(f64::from).zip(&report.verdict.limits);
    let names = rows.clone().map(|(row, criterion)| {
        let word = in_one_word(criterion);
        (
            row,
            format!("{word} {}: {}", criterion.name, criterion.finding),
        )
    });
    let count = report.verdict.limits.len() as f64;
    let criteria = rows.flat_map(|(row, criterion)| of_criterion(criterion, row, last));
    PanelData {
        share: ROW * (count + 0.2),
        ..PanelData::new(
            speed.clone(),
            AxisData::new("", "")
                .within([0.4, count + 0.6])
                .named(names),
            bands.chain(speeds(report, last)).chain(criteria).collect(),
        )
    }
}

/// Keys of the limits without a speed from which a distance could be drawn.
const WITHOUT_DISTANCE: [&str; 5] = ["operating", "critical", "held", "max_deviation", "validity"];

/// The result as a disc, the difference as a bar, and the limit as a short vertical line.
fn of_criterion(criterion: &Criterion, row: f64, last: f64) -> Vec<Item> {
    let hue = if criterion.is_kept() {
        Hue::Forward
    } else {
        Hue::Alarm
    };
    let asked = criterion.asked_rpm;
    let unreached = if WITHOUT_DISTANCE.contains(&criterion.key.as_str()) {
        asked
    } else {
        last
    };
    let found = criterion.found_rpm;
    let said = vec![
        format!("{}\nasked {asked:.1} rpm", criterion.name),
        format!("{}\n{}", criterion.name, criterion.finding),
    ];
    let bar = Line {
        width: BAR,
        tint: BAR_TINT,
        said: said.clone(),
        ..Line::new(
            [[asked, row], [found.unwrap_or(unreached), row]],
            hue,
            &criterion.name,
        )
    };
    let limit = Line {
        width: STRONG_CURVE,
        ..Line::new(LIMIT.map(|off| [asked, row + off]), Hue::Ink, "limit")
    };
    // A result that is not known gives the row its colour, too.
    let place = [found.unwrap_or(f64::NAN), row];
    let result = Points {
        said: said.into_iter().skip(1).collect(),
        ..Points::new([place], hue, RESULT_SIZE, &criterion.name)
    };
    vec![Item::Line(bar), Item::Line(limit), Item::Points(result)]
}

fn stiffness(report: &CheckReport, speed: &AxisData) -> PanelData {
    let stiffness = &report.rim_stiffness;
    let largest = stiffness.n_per_m.iter().fold(0.0_f64, |top, k| top.max(*k));
    let top = if largest > 0.0 {
        1.15e-3 * largest
    } else {
        1.0
    };
    let points = stiffness
        .rpm
        .iter()
        .zip(&stiffness.n_per_m)
        .map(|(rpm, k)| [*rpm, 1e-3 * k]);
    let name = "lateral stiffness of the rim";
    let note = if largest > 0.0 {
        ""
    } else {
        "no lateral stiffness: nothing holds the blade"
    };
    let operating = speeds(report, last_shown_rpm(report))
        .into_iter()
        .take(1)
        .map(|item| match item {
            Item::Upright(line) => Item::Upright(Upright {
                label: String::new(),
                ..line
            }),
            other => other,
        });
    let curve = Item::Line(Line::new(points, Hue::Ink, name));
    PanelData {
        share: STIFFNESS,
        note: note.to_owned(),
        ..PanelData::new(
            speed.clone(),
            AxisData::new("rim stiffness", "N/mm").within([0.0, top]),
            operating.chain([curve]).collect(),
        )
    }
}

fn key() -> Vec<Item> {
    let limit = Upright {
        x: 0.0,
        role: Role::Guide,
        colour: Hue::Ink,
        dashed: false,
        label: String::new(),
        name: "limit".to_owned(),
    };
    let result = |hue, name| Item::points_sample(RESULT_SIZE, Shape::Disc, hue, name);
    vec![
        Item::area_sample(Hue::DivergenceShade, "divergence"),
        Item::area_sample(Hue::FlutterShade, "flutter"),
        Item::Upright(Upright {
            name: "critical speed".to_owned(),
            ..Upright::critical(0.0, "")
        }),
        Item::Upright(limit),
        result(Hue::Forward, "result, with margin"),
        result(Hue::Alarm, "result, with shortfall"),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analyses::check::{Limits, check};
    use crate::model::scene::{Accuracy, LimitsFile, Scene, SweepFile, rad_per_s};
    use crate::page::figure::layout::sheet;
    use crate::page::figure::tidiness::texts;

    #[test]
    fn limits_that_are_kept_and_limits_that_are_broken_are_distinguished() {
        let paper = Scene::paper();
        let scene = paper.edited(|saw| saw.accuracy = Accuracy::Draft).unwrap();
        let limits = Limits {
            limits: LimitsFile {
                min_flutter_rpm: Some(2800.0),
                min_critical_rpm: Some(1500.0),
                ..LimitsFile::default()
            },
            ..Limits::at(rad_per_s(1250.0))
        };
        let sheet = sheet(&chart(&check(&scene, &limits).unwrap()));
        let said = texts(&sheet);
        let with = |start: &str| said.iter().filter(|text| text.starts_with(start)).count();
        assert_eq!((with("PASS "), with("FAIL ")), (6, 1), "{said:?}");
        assert_eq!(with("operating 1250"), 1, "{said:?}");
    }

    /// The first critical speed of this saw lies beyond its sweep.
    #[test]
    fn a_speed_found_beyond_the_sweep_is_on_the_axis() {
        let scene = Scene::paper()
            .edited(|file| {
                file.accuracy = Accuracy::Draft;
                file.sweep = Some(SweepFile {
                    from_rpm: 0.0,
                    to_rpm: 1400.0,
                });
            })
            .unwrap();
        let limits = Limits::at(rad_per_s(1250.0));
        let report = check(&scene, &limits).unwrap();
        let found = report.verdict.limits.iter().filter_map(|c| c.found_rpm);
        let highest = found.fold(0.0, f64::max);
        assert!(highest > report.to_rpm, "{highest}");
        let sheet = sheet(&chart(&report));
        let [_, end] = chart(&report).panels[0].x.range.unwrap();
        assert!(highest < end, "{highest} {end}");
        let said = texts(&sheet);
        assert!(said.contains(&"end of the sweep"));
    }
}
