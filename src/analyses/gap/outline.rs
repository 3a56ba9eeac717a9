//! The text of guides with a gap.

use super::amplitude::SAME;
use super::oscillation_outline::oscillation;
use super::report::{AtAmplitude, DeviationMap, FrictionHeat, GapReport};
use crate::model::scene::ContactLaw;
use crate::page::outline::{
    Column, FORCE, Fact, KELVIN, LENGTH, Outline, PERCENT, SPEED, Table, Value,
};
use crate::page::text::shown_to;

/// The tables list every third force and gap; the report contains all of them.
const EVERY: usize = 3;

pub fn outline(report: &GapReport) -> Outline {
    let mut text = Outline::of(
        &report.scene.name,
        &report.condition,
        &report.unusual_numbers,
    );
    text.extend(answer(report));
    text.table(over_amplitude(report));
    deviation(&mut text, report);
    if let Some(found) = &report.oscillation {
        oscillation(&mut text, report.deviation.rpm, found);
    }
    if let Some(friction) = &report.friction {
        heat(&mut text, &report.deviation, friction);
    }
    if let Some(error) = &report.deviation.basis_error {
        text.sentence(format!(
            "Estimated error of these deflections: {} % (checked with {} modes at rest instead of {})",
            shown_to(2, 1e2 * error.share),
            error.more_modes,
            error.modes
        ));
    }
    text.sentence(MEANING);
    text.remarks("Warning", &report.warnings);
    text
}

/// The amplitude from which the guides act, and what they do to the first critical speed.
pub fn answer(report: &GapReport) -> Outline {
    let mut text = Outline::default();
    let friction = report.friction.as_ref();
    if let Some(reason) = friction.and_then(FrictionHeat::unsettled) {
        let rpm = report.deviation.rpm;
        text.headline(format!(
            "NO STEADY STATE with friction at {rpm:.0} rpm: {reason}"
        ));
    }
    text.headline(half_way(report));
    let critical = |at: &AtAmplitude| SPEED.fixed(1, at.critical_rpm.first().copied()).or("none");
    let half = LENGTH.digits(4, report.half_way_amplitude_m).or("none");
    let facts = [
        Fact::new("guides act half from an amplitude of", half),
        Fact::new(
            "first critical speed inside the gaps",
            critical(&report.free),
        ),
        Fact::new(
            "first critical speed of linear guides",
            critical(&report.linear),
        ),
    ];
    text.facts("", facts);
    text
}

/// What wear of the guides takes: the first critical speed where they do not touch, and the deflection over the gap.
pub fn wear(report: &GapReport) -> Outline {
    let mut text = Outline::default();
    let map = &report.deviation;
    if let Some(free) = report.free.critical_rpm.first() {
        text.sentence(format!(
            "Wear of the guides: where the blade does not touch them, the first critical speed is {free:.0} rpm, of which {:.0} rpm is {:.0} %",
            map.rpm,
            1e2 * map.rpm / free
        ));
    }
    let nearest = |x: &(usize, &f64), y: &(usize, &f64)| {
        let away = |force: &f64| (force - map.force_n).abs();
        away(x.1).total_cmp(&away(y.1))
    };
    let Some((column, force_n)) = map.forces_n.iter().enumerate().min_by(nearest) else {
        return text;
    };
    let columns = [
        gap_column(report),
        Column::of("deflection at the cut", &LENGTH),
    ];
    let rows = map.gap_factors.iter().zip(&map.deflection_m);
    let rows = rows.step_by(EVERY).map(|(factor, row)| {
        let deflection_m = row.get(column).copied().flatten();
        [
            LENGTH.digits(3, factor * report.smallest_gap_m),
            LENGTH.digits(3, deflection_m.map(f64::abs)),
        ]
    });
    let title = format!(
        "Deflection under {} N at {:.0} rpm",
        shown_to(3, *force_n),
        map.rpm
    );
    text.table(Table::new(title, columns).with_rows(rows));
    text
}

const MEANING: &str = "The chart over the amplitude is the linear one with the mean stiffness of the guides over a sinusoidal oscillation \
     of the same amplitude at all of them; it is an approximation. Deflections are stationary ones, unless an oscillation is named.";

fn half_way(report: &GapReport) -> String {
    let gap = gaps(report);
    let first = |at: &AtAmplitude| at.critical_rpm.first().copied();
    let differs = match (first(&report.free), first(&report.linear)) {
        (Some(free), Some(linear)) => (free / linear - 1.0).abs() >= SAME,
        (free, linear) => free.is_some() != linear.is_some(),
    };
    match report.half_way_amplitude_m {
        None if differs => format!(
            "At no amplitude of vibration the guides ({gap}) hold the blade half as linear ones do: they push it out of their reach"
        ),
        None => {
            format!("The first critical speed inside the {gap} is that of linear guides to 0.1 %")
        }
        Some(amplitude) => format!(
            "Below {} mm of vibration at the guides ({gap}) the blade behaves rather as if unguided",
            shown_to(2, 1e3 * amplitude)
        ),
    }
}

/// The gap of all guides, or that of each if they differ: "gap 0.05 mm", "gaps 0.05 mm of guides[0], 0.1 mm of guides[1]".
fn gaps(report: &GapReport) -> String {
    let mm = |m: f64| format!("{} mm", shown_to(3, 1e3 * m));
    if have_one_gap(report) {
        format!("gap {}", mm(report.smallest_gap_m))
    } else {
        let each =
            lifting(report).map(|(place, gap_m)| format!("{} of guides[{place}]", mm(gap_m)));
        format!("gaps {}", each.collect::<Vec<_>>().join(", "))
    }
}

/// Index and gap of each one-sided guide.
fn lifting(report: &GapReport) -> impl Iterator<Item = (usize, f64)> {
    let guides = report.scene.guides.iter().enumerate();
    let lifting = guides.filter(|(_, guide)| guide.contact == ContactLaw::OneSided);
    lifting.filter_map(|(place, guide)| Some((place, guide.gap_m?)))
}

fn have_one_gap(report: &GapReport) -> bool {
    lifting(report).all(|(_, gap_m)| gap_m == report.smallest_gap_m)
}

/// The column of gaps, which all change in proportion.
fn gap_column(report: &GapReport) -> Column {
    let name = if have_one_gap(report) {
        "gap"
    } else {
        "smallest gap"
    };
    Column::of(name, &LENGTH)
}

fn over_amplitude(report: &GapReport) -> Table {
    let columns = [
        Column::of("amplitude", &LENGTH),
        Column::of("stiffness", &PERCENT),
        Column::of("first critical", &SPEED),
        Column::of("flutter", &SPEED),
        Column::words("bands"),
    ];
    let row = |name: Value, at: &AtAmplitude| {
        let shares = &at.stiffness_shares;
        let first = shares.first().copied().unwrap_or_default();
        let each: Vec<String> = shares
            .iter()
            .map(|share| shown_to(3, 1e2 * share))
            .collect();
        let stiffness = if shares.iter().all(|share| *share == first) {
            PERCENT.digits(3, first)
        } else {
            each.join("  ").into()
        };
        [
            name,
            stiffness,
            SPEED.fixed(1, at.critical_rpm.first().copied()).or("none"),
            SPEED.fixed(1, at.flutter_rpm).or("none"),
            at.instabilities.len().into(),
        ]
    };
    let amplitudes = report
        .amplitudes
        .iter()
        .map(|at| row(LENGTH.digits(4, at.amplitude_m), at));
    let rows = std::iter::once(row("inside gap".into(), &report.free))
        .chain(amplitudes)
        .chain([row("linear".into(), &report.linear)]);
    let title = "Over the amplitude at the guides (mean stiffness of an oscillation)";
    Table::new(title, columns)
        .showing(usize::MAX)
        .with_rows(rows)
}

/// Whether a row is in the tables: the first, which is that of linear guides, and every third gap.
fn is_shown(row: usize) -> bool {
    row == 0 || (row - 1).is_multiple_of(EVERY)
}

fn deviation(text: &mut Outline, report: &GapReport) {
    let map = &report.deviation;
    text.table(over_forces(report));
    if let Some(limit) = map.max_deflection_m {
        text.table(within(report, limit));
    }
    let columns = [
        Column::of("speed", &SPEED),
        Column::of("deflection", &LENGTH),
        Column::words("pad forces").in_unit(FORCE.unit),
    ];
    let series = map.speeds_rpm.iter().zip(&map.deflection_over_speed_m);
    let rows = series.enumerate().map(|(k, (rpm, deflection))| {
        let forces: Vec<String> = map
            .pad_forces_over_speed_n
            .iter()
            .filter_map(|pad| pad[k])
            .map(|force| shown_to(3, force))
            .collect();
        [
            SPEED.fixed(0, *rpm),
            LENGTH.fixed(4, *deflection).or("leans"),
            forces.join("  ").into(),
        ]
    });
    let title = format!(
        "Over the speed under {} N, with the gap of the scene",
        shown_to(3, map.force_n)
    );
    let table = Table::new(title, columns).showing(usize::MAX);
    text.table(table.with_rows(rows));
    if map.deflection_over_speed_m.iter().any(Option::is_none) {
        text.sentence("leans: the flat blade is unstable and leans on a guide");
    }
}

/// A gap of the map, in millimetres.
fn gap(report: &GapReport, factor: f64) -> Value {
    if factor == 0.0 {
        "linear".into()
    } else {
        LENGTH.digits(3, factor * report.smallest_gap_m)
    }
}

/// Deflections over gap and force.
fn over_forces(report: &GapReport) -> Table {
    let map = &report.deviation;
    let mut columns = vec![gap_column(report)];
    let forces = map.forces_n.iter().step_by(EVERY);
    columns.extend(forces.map(|force| Column::of(format!("{} N", shown_to(3, *force)), &LENGTH)));
    let title = format!(
        "Deflection of the rim at the cut at {:.0} rpm under a side force of",
        map.rpm
    );
    let mut table = Table::new(title, columns).showing(usize::MAX);
    let rows = map.gap_factors.iter().zip(&map.deflection_m).enumerate();
    for (_, (factor, deflections)) in rows.filter(|(row, _)| is_shown(*row)) {
        let deflections = deflections.iter().step_by(EVERY);
        let cells = deflections.map(|m| LENGTH.fixed(4, *m));
        table.row(std::iter::once(gap(report, *factor)).chain(cells));
    }
    table
}

/// Largest force and largest speed with a deflection of at most `limit`, in metres, over the gap.
fn within(report: &GapReport, limit: f64) -> Table {
    let map = &report.deviation;
    let columns = [
        gap_column(report),
        Column::words("largest side force"),
        Column::words(format!("speed under {} N", shown_to(3, map.force_n))),
    ];
    let [first, last] = [map.forces_n.first(), map.forces_n.last()]
        .map(|force| force.map_or(0.0, |force| force.abs()));
    let end = map.speeds_rpm.last().copied().unwrap_or_default();
    let critical = report.linear.critical_rpm.first();
    let found = map.force_within_n.iter().zip(&map.speed_within_rpm);
    let rows = map
        .gap_factors
        .iter()
        .zip(found)
        .enumerate()
        .filter(|(row, _)| is_shown(*row))
        .map(|(_, (factor, (force, speed)))| {
            let force = match force {
                None => format!("less than {} N", shown_to(3, first)),
                Some(force) if *force >= last => format!("{} N or more", shown_to(3, last)),
                Some(force) => format!("{} N", shown_to(3, *force)),
            };
            let speed = match speed {
                None => "at no speed".to_owned(),
                Some(speed) if *speed >= end => format!("{end:.0} rpm or more"),
                Some(speed) if critical == Some(speed) => {
                    format!("{speed:.0} rpm, the first critical speed")
                }
                Some(speed) => format!("{speed:.0} rpm"),
            };
            [gap(report, *factor), force.into(), speed.into()]
        });
    let title = format!(
        "Within {} mm at the cut at {:.0} rpm",
        shown_to(3, 1e3 * limit),
        map.rpm
    );
    Table::new(title, columns)
        .showing(usize::MAX)
        .with_rows(rows)
}

fn heat(text: &mut Outline, map: &DeviationMap, friction: &FrictionHeat) {
    // Without a steady state there are no numbers; the first headline says why.
    let Some(power_w) = friction.power_w else {
        return;
    };
    let rises = friction.radii_m.iter().zip(&friction.rise_k);
    let hottest = rises.fold((0.0, 0.0), |most: (f64, f64), (radius_m, rise_k)| {
        if *rise_k > most.1 {
            (*radius_m, *rise_k)
        } else {
            most
        }
    });
    let mm = |m: Option<f64>| LENGTH.fixed(4, m).or("unknown").with_unit();
    let speed = |rpm: Option<f64>| SPEED.fixed(1, rpm).or("none").with_unit();
    let forces = friction
        .pad_forces_n
        .iter()
        .map(|force| shown_to(3, *force));
    let mut facts = vec![
        Fact::new(
            "power",
            format!(
                "{} W, of which {} W heat the blade",
                shown_to(3, power_w),
                shown_to(3, friction.heat_share * power_w)
            ),
        ),
        Fact::new("largest rise", KELVIN.digits(3, hottest.1)).with(format!(
            "at a radius of {}",
            LENGTH.digits(3, hottest.0).with_unit()
        )),
        Fact::new(
            "deflection",
            format!(
                "{}, without friction {}",
                mm(friction.deflection_m),
                mm(friction.cold_deflection_m)
            ),
        ),
        Fact::new(
            "pad forces",
            format!(
                "{} N, both faces together",
                forces.collect::<Vec<_>>().join("  ")
            ),
        ),
        Fact::new(
            "first critical speed",
            format!(
                "{}, without friction {} (linear guides)",
                speed(friction.first_critical_rpm),
                speed(friction.cold_first_critical_rpm)
            ),
        ),
    ];
    facts.extend(friction.pads.iter().map(|pad| {
        let left = match pad.gap_left_m {
            None => "unknown".to_owned(),
            Some(m) if m < 0.0 => {
                format!("none, pressed in by {}", LENGTH.digits(4, -m).with_unit())
            }
            Some(m) => LENGTH.digits(4, m).with_unit(),
        };
        let ends = [pad.from_radius_m, pad.to_radius_m].map(|m| shown_to(3, 1e3 * m));
        let place = if ends[0] == ends[1] {
            format!("{} mm", ends[0])
        } else {
            format!("{} to {} mm", ends[0], ends[1])
        };
        let name = format!("guides[{}], gap left", pad.guide);
        Fact::new(name, format!("{left} (radius {place})"))
    }));
    facts.extend(friction.pads.iter().filter_map(|pad| {
        let [one, other] = pad.face_forces_n?.map(|force| shown_to(3, force));
        let name = format!("guides[{}], faces", pad.guide);
        Some(Fact::new(
            name,
            format!("{one} N and {other} N, which both rub"),
        ))
    }));
    let title = format!(
        "Heat of friction at {:.0} rpm under {} N, coefficient {}",
        map.rpm,
        shown_to(3, map.force_n),
        shown_to(3, friction.coefficient)
    );
    text.facts(title, facts);
}
