//! The text of a placement.

use super::{FragileOptimum, Goal, Neighbour, Outcome, PlaceReport, PlacedParameter};
use crate::analyses::changed::changed;
use crate::analyses::verdict::Verdict;
use crate::page::outline::{Column, Fact, LENGTH, Outline, SPEED, Table};
use crate::page::text::{counted, shown_to};

pub fn outline(report: &PlaceReport) -> Outline {
    let mut text = Outline::of(
        &report.scene.name,
        &report.condition,
        &report.unusual_numbers,
    );
    if let Some(missed) = report.limits_missed() {
        text.headline(missed);
    }
    let named = |verdict: &Option<Verdict>| verdict.as_ref().map(Verdict::in_table);
    if let (Some(verdict), Some(before)) = (&report.verdict, named(&report.verdict_before)) {
        text.headline(verdict.headline());
        if verdict.rpm.is_some() && named(&report.verdict).as_ref() != Some(&before) {
            text.reason(format!("before: {before}"));
        }
    }
    let goal = match report.goal {
        Goal::FlutterSpeed => "flutter speed",
        Goal::StableWindow => "stable window",
    };
    if let Some(amplitude) = report.amplitude_m {
        text.sentence(format!(
            "Speeds with the mean stiffness of the guides over an oscillation of {} mm at them",
            shown_to(3, 1e3 * amplitude)
        ));
    }
    let placed = report.parameters.iter().map(|p| {
        let [from, to] = [p.bound_from, p.bound_to].map(short);
        let bound = if p.at_bound { ", at bound" } else { "" };
        changed(&p.path, p.start, p.value, 4).with(format!("({from} to {to}{bound})"))
    });
    text.facts("", outcomes(report, goal).into_iter().chain(placed));
    neighbours(&mut text, report, goal);
    if let Some(fragile) = &report.fragile_optimum {
        text.sentence(fragile_optimum(report, fragile, goal));
    }
    front(&mut text, report, goal);
    for band in &report.almost {
        text.sentence(format!(
            "A band from {:.0} rpm grows by {:.2} 1/s, the threshold is {} 1/s: if the growth reached it, this would be the flutter speed",
            band.from_rpm, band.peak_growth_per_s, report.flutter_threshold_per_s
        ));
    }
    let certificate = &report.certificate;
    if certificate.is_clean {
        text.sentence(format!(
            "Best saw: all {} independent checks agree",
            certificate.speeds_checked + certificate.full_basis_counts
        ))
    } else {
        text.sentence(format!("Checks of the best saw: {}", certificate.statement))
    }
    text.details(|text| {
        let statement = &certificate.statement;
        text.sentence(format!("Certificate of the best saw: {statement}"));
    });
    text.remarks("Note", &report.warnings);
    text.sentence(format!(
        "{} analysed, {:.0} to {:.0} rpm",
        counted(report.saws, ["saw", "saws"]),
        report.from_rpm,
        report.to_rpm
    ));
    text
}

/// Speeds and deflection of the best saw after those of the original one.
fn outcomes(report: &PlaceReport, goal: &str) -> Vec<Fact> {
    let speed = |name: &str, before: Option<f64>, best: Option<f64>| {
        let [before, best] = [before, best].map(|rpm| SPEED.fixed(0, rpm).or("none"));
        Fact::new(name, best).after(before)
    };
    let both = |name: &str, of: fn(&Outcome) -> Option<f64>| {
        speed(name, of(&report.before), of(&report.best))
    };
    let mut facts = vec![
        both("flutter speed", |o| o.flutter_rpm),
        both("first critical speed", |o| o.first_critical_rpm),
    ];
    if report.goal == Goal::StableWindow {
        facts.push(both("stable from", |o| o.window_rpm.map(|w| w[0])));
        facts.push(both("stable to", |o| o.window_rpm.map(|w| w[1])));
    }
    let worst = |saw: Option<&Neighbour>| {
        let outcome = saw?.outcome?;
        match report.goal {
            Goal::FlutterSpeed => outcome.flutter_rpm,
            Goal::StableWindow => Some(outcome.goal_rpm),
        }
    };
    facts.push(speed(
        &format!("worst {goal} within the tolerances"),
        worst(Some(&report.worst_before)),
        worst(report.worst_neighbour.as_ref()),
    ));
    if report.max_deflection_m.is_some() {
        let mm = |saw: &Outcome| LENGTH.digits(4, saw.deflection_m).or("unknown");
        let best = Fact::new("deflection at the cut", mm(&report.best));
        facts.push(best.after(mm(&report.before)));
    }
    facts
}

/// Adds the goal with each number changed by its tolerance, and the worst case of the tolerances.
fn neighbours(text: &mut Outline, report: &PlaceReport, goal: &str) {
    let columns = [
        Column::words("number"),
        Column::words("tolerance"),
        Column::of("less", &SPEED),
        Column::of("more", &SPEED),
    ];
    let rows = report.parameters.iter().map(|p| {
        let PlacedParameter {
            less_rpm, more_rpm, ..
        } = p;
        let rpm = |speed: &Option<f64>| SPEED.fixed(0, *speed).or("no saw");
        [
            p.path.clone().into(),
            format!("± {}", short(p.offset)).into(),
            rpm(less_rpm),
            rpm(more_rpm),
        ]
    });
    for parameter in &report.parameters {
        if let Some([low, high]) = parameter.without_influence() {
            text.sentence(format!(
                "{} does not matter here: {:.0} ± {:.1} rpm from {} to {}",
                parameter.path,
                0.5 * (low + high),
                0.5 * (high - low),
                short(parameter.bound_from),
                short(parameter.bound_to)
            ));
        }
    }
    let sentence = format!("{goal} with one dimension off by its tolerance");
    let title = sentence[..1].to_uppercase() + &sentence[1..];
    let table = Table::new(title, columns).showing(usize::MAX);
    text.table(table.with_rows(rows));
    let verdict = if report.fragile { "FRAGILE" } else { "robust" };
    let worst = report.worst_neighbour_share * report.best.goal_rpm;
    text.sentence(format!(
        "Worst case of the tolerances, one by one and all together: {worst:.0} of {:.0} rpm: {verdict}",
        report.best.goal_rpm
    ));
}

/// Adds the saws that trade the goal against the deflection at the cut.
fn front(text: &mut Outline, report: &PlaceReport, goal: &str) {
    let [first, .., last] = report.traded() else {
        return;
    };
    let force = report.force_n.map(short).unwrap_or_default();
    let rpm = report.scene.operating_rpm.map(short).unwrap_or_default();
    text.sentence(format!(
        "A blade that deflects by {} mm instead of {} mm at the cut, under {force} N at {rpm} rpm, has a worst {goal} of {:.0} instead of {:.0} rpm",
        shown_to(3, 1e3 * first.deflection_m),
        shown_to(3, 1e3 * last.deflection_m),
        first.worst_goal_rpm,
        last.worst_goal_rpm,
    ));
    let columns = [
        Column::of("deflection", &LENGTH),
        Column::of("worst", &SPEED),
        Column::of("flutter", &SPEED),
        Column::of("critical", &SPEED),
        Column::words("numbers, in their order"),
    ];
    let rows = report.front.iter().map(|saw| {
        let speed = |rpm: Option<f64>| SPEED.fixed(0, rpm).or("none");
        let values: Vec<String> = saw.values.iter().map(|value| short(*value)).collect();
        [
            LENGTH.digits(3, saw.deflection_m),
            SPEED.fixed(0, saw.worst_goal_rpm),
            speed(saw.flutter_rpm),
            speed(saw.first_critical_rpm),
            values.join(", ").into(),
        ]
    });
    let title = format!("Worst {goal} against deflection at the cut");
    text.table(Table::new(title, columns).with_rows(rows));
}

/// Describes the saw that is better than the best at its nominal numbers and worse in the worst case of the
/// tolerances.
fn fragile_optimum(report: &PlaceReport, fragile: &FragileOptimum, goal: &str) -> String {
    let rpm = |saw: &Neighbour| {
        let goal = saw.outcome.map(|outcome| outcome.goal_rpm);
        goal.map_or("unknown".to_owned(), |rpm| format!("{rpm:.0} rpm"))
    };
    let numbers = report
        .parameters
        .iter()
        .zip(&fragile.saw.values)
        .map(|(p, value)| format!("{} = {}", p.path, short(*value)));
    let place = numbers.collect::<Vec<_>>().join(", ");
    let (itself, worst) = (rpm(&fragile.saw), rpm(&fragile.worst));
    format!(
        "Not the answer: {place} has a {goal} of {itself}, which falls to {worst} within the tolerances"
    )
}

/// A placed number with four significant digits.
fn short(value: f64) -> String {
    shown_to(4, value)
}
