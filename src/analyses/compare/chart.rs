//! Campbell diagrams of several saws, one over the other, and their critical speeds and bands below.

use super::{CompareReport, ComparedSaw};
use crate::analyses::campbell::BranchCurve;
use crate::analyses::campbell::diagram::NEGLIGIBLE_PER_S;
use crate::page::figure::axis::{extremes, proper_range};
use crate::page::figure::chart_data::{AxisData, ChartData, PanelData};
use crate::page::figure::items::{Item, Line, Points, Shape, lines_by_look};
use crate::page::figure::palette::Hue;
use crate::page::figure::style::{CURVE, STRONG_CURVE};

/// Heights of the diagram and of the row of a saw, relative to a panel of usual height.
const DIAGRAM: f64 = 1.2;
const ROW: f64 = 0.115;
/// Colours of the saws, and their largest number: more colours could not be distinguished.
const HUES: [Hue; 6] = [
    Hue::Ink,
    Hue::Forward,
    Hue::Backward,
    Hue::Flutter,
    Hue::Divergence,
    Hue::Standing,
];
/// Number of frequencies at the first speed that the diagram includes, besides those of the bands.
const SHOWN: usize = 6;
const CRITICAL_SIZE: f64 = 7.0;
/// Width of a band in the lower panel.
const BAND: f64 = 9.0;

/// The saws that are drawn.
fn drawn(report: &CompareReport) -> &[ComparedSaw] {
    &report.saws[..report.saws.len().min(HUES.len())]
}

/// Frequencies over speed, and critical speeds and bands of each saw, as numbers.
pub fn chart(report: &CompareReport) -> ChartData {
    let saws = drawn(report).iter();
    let ends = saws
        .clone()
        .flat_map(|saw| [saw.campbell.from_rpm, saw.campbell.to_rpm]);
    let speed = AxisData::speed().within(proper_range(extremes(ends)));
    let tops = saws.clone().map(shown_hz);
    let [_, hz] = proper_range([0.0, tops.fold(0.0, f64::max)]);
    // The first saw is drawn last, on top.
    let coloured = saws.clone().zip(HUES);
    let frequencies = coloured
        .clone()
        .rev()
        .flat_map(|(saw, hue)| curves(saw, hue));
    let speeds = coloured
        .enumerate()
        .flat_map(|(row, (saw, hue))| events(row, saw, hue));
    let labels: Vec<String> = saws.map(|saw| saw.name.clone()).collect();
    let names = labels
        .iter()
        .enumerate()
        .map(|(row, label)| (1.0 + row as f64, label.clone()));
    let saw_axis = AxisData::new("", "").named(names);
    let count = labels.len() as f64;
    let shown = format!(
        "critical speeds, bands and frequencies of {}",
        labels.join(", ")
    );
    let mut facts = vec![report.condition(), shown];
    if labels.len() < report.saws.len() {
        facts.push(format!(
            "the first {} of {} saws",
            labels.len(),
            report.saws.len()
        ));
    }
    ChartData {
        title: report.scene.name.clone(),
        facts,
        panels: vec![
            PanelData {
                share: DIAGRAM,
                harmonics: true,
                ..PanelData::new(
                    speed.clone(),
                    AxisData::new("Im λ / 2π", "Hz").within([0.0, hz]),
                    frequencies.collect(),
                )
            },
            PanelData {
                share: ROW * count,
                ..PanelData::new(speed, saw_axis.within([0.4, count + 0.6]), speeds.collect())
            },
        ],
        columns: 1,
        key: key(),
    }
}

/// Upper end of the frequencies of a saw in Hz.
fn shown_hz(saw: &ComparedSaw) -> f64 {
    let branches = saw.campbell.branches.iter();
    let mut first: Vec<f64> = branches
        .filter_map(|branch| branch.frequency_hz.first())
        .copied()
        .collect();
    first.sort_by(f64::total_cmp);
    let top = first.get(SHOWN - 1).or(first.last()).copied();
    let bands = saw.instabilities.iter().map(|band| band.frequency_hz);
    1.1 * bands.fold(top.unwrap_or(1.0), f64::max)
}

/// The branches of a saw in its colour: thick where they grow, dashed where they are reflected.
fn curves(saw: &ComparedSaw, hue: Hue) -> Vec<Item> {
    let mut items = Vec::new();
    for branch in &saw.campbell.branches {
        let samples = branch.rpm.len().min(branch.frequency_hz.len());
        for (look, samples) in lines_by_look(samples, |i| Some(look(branch, i))) {
            let at = |i: usize| [branch.rpm[i], branch.frequency_hz[i]];
            let points = samples.into_iter().map(|i| i.map_or([f64::NAN; 2], at));
            let name = format!("{}: {}", saw.name, branch.name);
            items.push(Item::Line(Line {
                width: match look {
                    Look::Growing => STRONG_CURVE,
                    _ => CURVE,
                },
                dashed: look == Look::Reflected,
                branch: Some(branch.branch),
                ..Line::new(points, hue, &name)
            }));
        }
    }
    items
}

#[derive(PartialEq)]
enum Look {
    Growing,
    Reflected,
    Other,
}

/// Look of a branch between one of its samples and the next.
fn look(branch: &BranchCurve, i: usize) -> Look {
    let ends = [i, i + 1];
    let grows = |k: usize| {
        branch
            .growth_per_s
            .get(k)
            .is_some_and(|g| *g > NEGLIGIBLE_PER_S)
    };
    if ends.into_iter().any(grows) {
        Look::Growing
    } else if ends.map(|k| branch.krein_sign.get(k)).contains(&Some(&-1)) {
        Look::Reflected
    } else {
        Look::Other
    }
}

/// Bands of a saw as strips in the colour of their kind, its critical speeds as dots, and its operating speed as a ring.
fn events(row: usize, saw: &ComparedSaw, hue: Hue) -> Vec<Item> {
    let y = 1.0 + row as f64;
    let strips = saw.instabilities.iter().map(|band| {
        let [_, _, streak] = Hue::of_kind(band.kind);
        let named = band.name.as_deref().unwrap_or_default();
        let name = format!(
            "{}: {:.0} to {:.0} rpm, up to {:.3} 1/s {named}",
            saw.name, band.from_rpm, band.to_rpm, band.peak_growth_per_s
        );
        Item::Line(Line {
            width: BAND,
            ..Line::new([[band.from_rpm, y], [band.to_rpm, y]], streak, &name)
        })
    });
    let places = saw.critical_speeds.iter().map(|entry| [entry.rpm, y]);
    let critical = Item::Points(Points {
        said: (saw.critical_speeds.iter())
            .map(|entry| format!("critical speed {:.1} rpm\n{}", entry.rpm, entry.name))
            .collect(),
        ..Points::new(
            places,
            hue,
            CRITICAL_SIZE,
            &format!("{}: critical speeds", saw.name),
        )
    });
    let operating = saw.operating.iter().map(|operating| {
        let name = format!("{}: runs at {:.0} rpm", saw.name, operating.rpm);
        Item::Points(Points {
            shape: Shape::Ring,
            ..Points::new([[operating.rpm, y]], hue, 1.5 * CRITICAL_SIZE, &name)
        })
    });
    strips.chain([critical]).chain(operating).collect()
}

fn key() -> Vec<Item> {
    vec![
        Item::line_sample(STRONG_CURVE, false, Hue::Quiet, "grows"),
        Item::line_sample(CURVE, true, Hue::Quiet, "reflected wave"),
        Item::points_sample(CRITICAL_SIZE, Shape::Disc, Hue::Ink, "critical speed"),
        Item::points_sample(
            1.5 * CRITICAL_SIZE,
            Shape::Ring,
            Hue::Ink,
            "operating speed",
        ),
        Item::area_sample(Hue::DivergenceStreak, "divergence"),
        Item::area_sample(Hue::FlutterStreak, "flutter"),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analyses::campbell::sample;
    use crate::analyses::compare::{NamedSaw, Saw, compare};
    use crate::page::figure::layout;
    use crate::page::figure::tidiness::texts;

    #[test]
    fn every_saw_has_its_row_and_nothing_is_cut_off() {
        let report = sample::empty_report("A saw");
        for count in [1, 2, 6, 9] {
            let saw = |k: usize| NamedSaw {
                name: format!("saw {k}"),
                saw: Saw::Report(Box::new(report.clone())),
            };
            let compared = compare((1..=count).map(saw).collect(), &|_, _| ()).unwrap();
            let sheet = layout::sheet(&chart(&compared));
            let all = texts(&sheet);
            assert!(all.contains(&"saw 1"), "{all:?}");
            let mut texts = all.iter();
            let is_noted = texts.any(|text| text.contains("the first 6 of 9 saws"));
            assert_eq!(is_noted, count == 9);
        }
    }
}
