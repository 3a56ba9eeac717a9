//! The text of equilibria over speed.

use super::report::{Arc, DeflectReport, Jump, SlowSweep};
use crate::model::scene::ContactLaw;
use crate::motion::stretched_blade::{LARGEST_SLOPE, TurnKind};
use crate::page::outline::{Column, FREQUENCY, LENGTH, Outline, SPEED, Table, Value};
use crate::page::text::shown_to;

/// Number of evenly spaced speeds in the table.
const SPEEDS: usize = 12;
/// Number of frequencies in a row of the table.
const FREQUENCIES: usize = 4;

pub fn outline(report: &DeflectReport) -> Outline {
    let mut text = Outline::of(
        &report.scene.name,
        &report.condition,
        &report.unusual_numbers,
    );
    text.headline(verdict(report));
    text.sentence(critical(report));
    let thickness_m = report.scene.blade.thickness_m;
    for (sweep, word) in [(&report.up, "rises"), (&report.down, "falls")] {
        if !sweep.arcs.is_empty() {
            jumps(&mut text, sweep, word, thickness_m);
        }
        if let Some(rpm) = sweep.valid_until_rpm {
            text.sentence(format!(
                "While the speed {word} slopes of the blade exceed {LARGEST_SLOPE} from {rpm:.1} rpm: the model is not valid there, and no results are given."
            ));
        }
        if let Some(rpm) = sweep.stopped_at_rpm {
            text.sentence(format!(
                "While the speed {word} the search stopped at {rpm:.1} rpm at its largest number of equilibria: no results are given beyond. Give a shorter range of speeds."
            ));
        }
    }
    text.table(over_speed(report));
    if let Some(pads) = pads(report) {
        text.sentence(pads);
    }
    text.sentence(accuracy(report));
    text.sentence(MEANING);
    text.remarks("Warning", &report.warnings);
    text
}

const MEANING: &str = "With any damping fixed in space every motion ends in a stable equilibrium. Damping that turns with the blade may stabilize the flat blade, and a fast run-up may end before the blade leaves the flat state. Curves of equilibria may exist to which neither a sweep, nor its mirror image, nor a critical speed leads.";

/// Speed above which the deflection exceeds the thickness, and the largest deflection while the speed rises.
fn verdict(report: &DeflectReport) -> String {
    let place = report.scene.side_force_place_in_words();
    let force = format!("Under {} N {place}", report.force_n);
    let up = report.up.arcs.iter();
    let all = up.flat_map(|arc| arc.rpm.iter().zip(&arc.largest_deflection_m));
    let last = all.clone().last();
    let largest = all.max_by(|x, y| x.1.total_cmp(y.1));
    let (Some((rpm, largest_m)), Some((last_rpm, _))) = (largest, last) else {
        return format!(
            "{force} slopes of the blade exceed {LARGEST_SLOPE} at the first speed: the model is not valid, and no deflection is given"
        );
    };
    let within = match report.beyond_thickness_rpm {
        None => format!("the deflection does not exceed the thickness up to {last_rpm:.0} rpm"),
        Some(beyond) if beyond <= report.from_rpm => {
            format!("the deflection exceeds the thickness at {beyond:.0} rpm already")
        }
        Some(beyond) => format!("the deflection exceeds the thickness above {beyond:.0} rpm"),
    };
    format!(
        "{force} {within}; the largest deflection is {}, at {rpm:.0} rpm",
        LENGTH.fixed(3, *largest_m).with_unit()
    )
}

fn critical(report: &DeflectReport) -> String {
    match report.critical_speeds.first() {
        None => "The flat blade has no critical speed in this range".to_owned(),
        Some(first) => format!(
            "First critical speed of the flat blade: {:.1} rpm",
            first.rpm
        ),
    }
}

/// Adds the considerable jumps of a sweep; `word` states whether its speed rises or falls.
fn jumps(text: &mut Outline, sweep: &SlowSweep, word: &str, thickness_m: f64) {
    let all = sweep.jumps.iter();
    let listed = all.filter(|jump| jump.is_considerable(thickness_m));
    let rows = listed.map(|jump| {
        let kind = match jump.kind {
            TurnKind::Fold => "fold",
            TurnKind::Bifurcation => "bifurcation",
        };
        [
            SPEED.fixed(1, jump.rpm),
            LENGTH.fixed(3, jump.from_m),
            LENGTH.fixed(3, jump.to_m),
            kind.into(),
        ]
    });
    let columns = [
        Column::of("speed", &SPEED),
        Column::of("from", &LENGTH),
        Column::of("to", &LENGTH),
        Column::words("at a"),
    ];
    let title = format!("While the speed {word} slowly the blade jumps, at the probe:");
    let table = Table::new(title, columns)
        .in_file("deflect.json")
        .with_rows(rows);
    if table.rows.is_empty() {
        text.sentence(format!(
            "While the speed {word} slowly the blade does not jump"
        ))
    } else {
        text.table(table)
    }
}

impl Jump {
    /// Whether the deflection at the probe, or the largest deflection, changes by more than 2 % of the
    /// thickness. Smaller jumps would not be noticed.
    pub(crate) fn is_considerable(&self, thickness_m: f64) -> bool {
        let probe = (self.to_m - self.from_m).abs();
        probe.max((self.largest_to_m - self.largest_from_m).abs()) > 0.02 * thickness_m
    }
}

/// Deflections and the lowest frequencies at evenly spaced speeds.
fn over_speed(report: &DeflectReport) -> Table {
    let deflection = |name: &str, group| Column::of(name, &LENGTH).in_group(group);
    let columns = [
        Column::of("speed", &SPEED),
        deflection("probe", "speed rises"),
        deflection("largest", "speed rises"),
        deflection("probe", "speed falls"),
        deflection("largest", "speed falls"),
        Column::words("lowest frequencies, speed rises").in_unit(FREQUENCY.unit),
    ];
    let row = |k: usize| {
        let share = k as f64 / (SPEEDS - 1) as f64;
        let rpm = report.from_rpm + share * (report.to_rpm - report.from_rpm);
        let of = |sweep: &SlowSweep| {
            let at = sweep.at(rpm, |arc, k| {
                [arc.deflection_m[k], arc.largest_deflection_m[k]]
            });
            at.map_or([Value::Missing, Value::Missing], |at| {
                at.map(|m| LENGTH.fixed(3, m))
            })
        };
        let [up_probe, up_most] = of(&report.up);
        let [down_probe, down_most] = of(&report.down);
        let lowest = |arc: &Arc, k: usize| {
            std::array::from_fn(|i| arc.frequencies_hz[k].get(i).copied().unwrap_or(f64::NAN))
        };
        let frequencies: Option<[f64; FREQUENCIES]> = report.up.at(rpm, lowest);
        let known: Vec<String> = frequencies
            .iter()
            .flatten()
            .filter(|hz| hz.is_finite())
            .map(|hz| format!("{hz:>6.2}"))
            .collect();
        let speed = SPEED.fixed(0, rpm);
        [
            speed,
            up_probe,
            up_most,
            down_probe,
            down_most,
            known.join(" ").into(),
        ]
    };
    Table::new("Deflection", columns).with_rows((0..SPEEDS).map(row))
}

impl SlowSweep {
    /// Values at a speed, by linear interpolation between two equilibria of one arc; `None` if no arc contains
    /// the speed.
    fn at<const N: usize>(
        &self,
        rpm: f64,
        values: impl Fn(&Arc, usize) -> [f64; N],
    ) -> Option<[f64; N]> {
        let within = |arc: &&Arc, k: usize| {
            let share = (rpm - arc.rpm[k]) / (arc.rpm[k + 1] - arc.rpm[k]);
            (-1e-9..=1.0 + 1e-9).contains(&share).then_some(share)
        };
        self.arcs.iter().find_map(|arc| {
            (1..arc.rpm.len()).find_map(|k| {
                let share = within(&arc, k - 1)?;
                let [from, to] = [values(arc, k - 1), values(arc, k)];
                Some(std::array::from_fn(|i| from[i] + share * (to[i] - from[i])))
            })
        })
    }
}

/// Largest force on the blade, while the speed rises, of each pad that can lift off; `None` without such pads.
fn pads(report: &DeflectReport) -> Option<String> {
    let guides = report.scene.guides.iter().enumerate();
    let lifting = guides.filter(|(_, guide)| guide.contact == ContactLaw::OneSided);
    let each: Vec<String> = lifting
        .enumerate()
        .filter_map(|(row, (index, _))| {
            let arcs = report.up.arcs.iter();
            let of_arc = |arc: &Arc| {
                let forces = arc.pad_forces_n.get(row).cloned().unwrap_or_default();
                arc.rpm.clone().into_iter().zip(forces)
            };
            let all = arcs.flat_map(of_arc);
            let (rpm, force) = all.max_by(|x, y| x.1.abs().total_cmp(&y.1.abs()))?;
            Some(format!(
                "guides[{index}] {} N at {rpm:.0} rpm",
                shown_to(3, force)
            ))
        })
        .collect();
    (!each.is_empty()).then(|| {
        format!(
            "Largest force of a pad beyond its gap while the speed rises: {}",
            each.join(", ")
        )
    })
}

fn accuracy(report: &DeflectReport) -> String {
    let made = format!(
        "The deflection is made of {} shapes of a basis of {}",
        report.shapes, report.degrees_of_freedom
    );
    let with_more = report.estimated_relative_error.map(|error| {
        let change = at_most(error);
        format!("with more shapes it changes by {change}")
    });
    let of_basis = report.basis_error.map(|error| {
        let change = at_most(error);
        format!("with a larger basis, a small deflection at the force changes by about {change}")
    });
    let facts: Vec<String> = [Some(made), with_more, of_basis]
        .into_iter()
        .flatten()
        .collect();
    format!("{}.", facts.join("; "))
}

/// A share in percent with one decimal; "less than 0.1 %" below.
fn at_most(share: f64) -> String {
    if share < 1e-3 {
        "less than 0.1 %".to_owned()
    } else {
        format!("{:.1} %", 1e2 * share)
    }
}
