//! The text of a study.

use super::{
    GapStatistics, Group, NumberStatistics, Passing, Reliability, SpeedStatistics, StudyReport,
};
use crate::analyses::scene_number;
use crate::model::scene::Scene;
use crate::page::outline::{
    Column, Fact, LENGTH, Outline, PERCENT, PLAIN, SPEED, Table, Value, shortened,
};
use crate::page::text::{counted, shown, shown_to};

/// Number of rows of the table of a grid that a text shows.
const POINTS: usize = 24;
/// Largest number of quantiles in a row; the report contains all.
const QUANTILES: usize = 7;
/// Number of saws that were not analysed whose reasons are stated.
const REASONS: usize = 3;
/// Largest number of characters of such a reason.
const REASON: usize = 68;

pub fn outline(report: &StudyReport) -> Outline {
    let mut text = Outline::default();
    let saws = format!("{} saws of {}", report.all.saws, report.scene.name);
    text.sentence(shortened(&report.study.name, crate::page::outline::WIDTH));
    text.heading(&saws, &report.condition);
    for entry in &report.study.parameters {
        text.reason(entry.in_words());
    }
    text.remarks("Unusual number", &report.unusual_numbers);
    if let Some(passing) = &report.all.passing {
        text.headline(format!(
            "At {} rpm, {} of {} saws can run",
            shown_to(6, passing.operating_rpm),
            passing.passed,
            report.all.saws
        ));
    }
    quantiles(&mut text, report);
    if let (Some(gap), Some(asked)) = (&report.all.gap, &report.study.gap)
        && let (Some(within), Some(limit)) = (gap.saws_within, asked.limit_m(&report.scene))
    {
        text.sentence(format!(
            "{within} of {} saws deflect by at most {} at the cut under {} N",
            report.all.saws,
            LENGTH.digits(3, limit).with_unit(),
            shown_to(3, force_n(report))
        ));
    }
    if let Some(passing) = &report.all.passing {
        limits(&mut text, passing, report.all.saws);
    }
    if let Some(reliability) = &report.reliability {
        text.table(fastest(reliability));
        text.sentence(format!(
            "(at most {} of the first critical speed, and no flutter up to there)",
            shown_to(6, reliability.margin)
        ));
    }
    text.table(groups(report));
    worst(&mut text, report);
    remarks(&mut text, report);
    text
}

/// The constant lateral force on the saws.
fn force_n(report: &StudyReport) -> f64 {
    let typed = report.scene.side_force_n();
    Scene::try_from(report.scene.clone()).map_or(typed, |saw| saw.constant_force().force_n)
}

/// Adds the quantiles of the first critical speed and of the flutter speed, and of guides with a gap.
fn quantiles(text: &mut Outline, report: &StudyReport) {
    let all = &report.all;
    let heads = all
        .first_critical
        .quantiles
        .iter()
        .take(QUANTILES)
        .map(|quantile| Column::words(format!("{} %", shown(100.0 * quantile.share))));
    let columns = std::iter::once(Column::words("")).chain(heads);
    let mut table = Table::new("Share of saws below", columns).showing(usize::MAX);
    let mut speeds = |name: &str, speed: &SpeedStatistics| {
        let quantiles = speed.quantiles.iter().take(QUANTILES);
        let cells = quantiles.map(|quantile| SPEED.fixed(1, quantile.rpm).or("beyond"));
        table.row(std::iter::once(name.into()).chain(cells));
    };
    speeds("first critical [rpm]", &all.first_critical);
    speeds("flutter speed [rpm]", &all.flutter);
    for (name, statistics, measure) in all.gap.iter().flat_map(numbers) {
        let quantiles = statistics.quantiles.iter().take(QUANTILES);
        let cells = quantiles.map(|quantile| measure.digits(4, quantile.value).or("unknown"));
        table.row(std::iter::once(name.into()).chain(cells));
    }
    text.table(table);
    let left_out = report.study.quantiles.len() - all.first_critical.quantiles.len();
    if left_out > 0 {
        text.reason(format!(
            "{left_out} shares are finer than one of {} saws and are left out",
            all.saws
        ));
    }
    if all.flutter.beyond > 0 {
        text.sentence(format!(
            "{} not flutter up to {:.0} rpm",
            counted(all.flutter.beyond, ["saw does", "saws do"]),
            report.swept_to_rpm
        ));
    }
}

type NamedNumber<'a> = (
    &'static str,
    &'a NumberStatistics,
    &'static crate::page::outline::Measure,
);

/// Deflection, pad force and critical speed of guides with a gap.
fn numbers(gap: &GapStatistics) -> Vec<NamedNumber<'_>> {
    let mut all: Vec<NamedNumber> = vec![
        ("deflection [mm]", &gap.deflection_at_cut, &LENGTH),
        ("largest pad force [N]", &gap.largest_pad_force, &PLAIN),
    ];
    let critical = gap.critical_at_amplitude.as_ref();
    all.extend(critical.map(|critical| ("at amplitude [rpm]", critical, &PLAIN)));
    all
}

/// Adds the probability that a saw keeps all limits, and the share that keeps each.
fn limits(text: &mut Outline, passing: &Passing, saws: usize) {
    let percent = |share: f64| PERCENT.fixed(2, share).with_unit();
    let interval = passing.interval.map(|[low, high]| {
        format!(
            ", with {} % confidence between {} and {}",
            shown(100.0 * passing.confidence),
            percent(low),
            percent(high)
        )
    });
    let remark = format!("({} of {saws} saws)", passing.passed) + &interval.unwrap_or_default();
    let all = Fact::new(
        "Probability of passing",
        PERCENT.fixed(2, passing.probability),
    );
    let each = passing.criteria.iter().map(|criterion| {
        let share = criterion.passed as f64 / saws.max(1) as f64;
        Fact::new(format!("  {}", criterion.name), PERCENT.fixed(2, share))
    });
    text.facts("", std::iter::once(all.with(remark)).chain(each));
}

/// The highest operating speeds at which given shares of the saws run without instability.
fn fastest(reliability: &Reliability) -> Table {
    let columns = [
        Column::words("share of the saws"),
        Column::of("run up to", &SPEED),
    ];
    let rows = reliability.fastest.iter().map(|fastest| {
        [
            if fastest.share == 1.0 {
                "all".into()
            } else {
                format!("{} %", shown(100.0 * fastest.share)).into()
            },
            SPEED.fixed(1, fastest.rpm),
        ]
    });
    Table::new("", columns).with_rows(rows)
}

fn groups(report: &StudyReport) -> Table {
    let columns = [
        Column::of("critical", &SPEED),
        Column::of("flutter", &SPEED),
        Column::of("pass", &PERCENT),
        Column::words("point"),
    ];
    let median = |speed: &SpeedStatistics| SPEED.fixed(1, speed.median_rpm).or("beyond");
    let row = |group: &Group| {
        let place: Vec<String> = group
            .grid
            .iter()
            .map(|entry| format!("{} = {}", entry.parameter, entry.value))
            .collect();
        let passing = group.passing.as_ref();
        let pass: Value = PERCENT.fixed(1, passing.map(|p| p.probability));
        [
            median(&group.first_critical),
            median(&group.flutter),
            pass,
            place.join(", ").into(),
        ]
    };
    Table::new("In each point of the grid: medians", columns)
        .showing(POINTS)
        .in_file("study.json")
        .with_rows(report.groups.iter().map(row))
}

/// Adds the saws with the first critical speed and with the lowest flutter speed.
fn worst(text: &mut Outline, report: &StudyReport) {
    let speeds = [
        ("first critical", &report.worst_first_critical),
        ("flutter", &report.worst_flutter),
    ];
    for (name, saws) in speeds {
        let Some(first) = saws.first() else {
            continue;
        };
        let title = format!(
            "Lowest {name} speed: {:.1} rpm, saw {}",
            first.rpm, first.saw
        );
        let numbers =
            report
                .study
                .parameters
                .iter()
                .zip(&first.values)
                .map(|(parameter, value)| {
                    let path = &parameter.path;
                    Fact::new(path.clone(), scene_number::with_unit(path, *value))
                });
        text.facts(title, numbers);
    }
}

/// Adds the largest estimated error of the saws, and the number of saws whose Krein index does not match.
pub(crate) fn accuracy_of_saws(text: &mut Outline, largest_error: f64, wrong: usize, which: &str) {
    text.sentence(format!(
        "Estimated error of critical speeds: {} % at most",
        shown_to(2, 100.0 * largest_error)
    ));
    if wrong > 0 {
        let saws = if wrong == 1 { "saw" } else { "saws" };
        text.sentence(format!(
            "{wrong} {saws} could not be verified (Krein index){which}; repeat with --accuracy design or reference"
        ));
    }
}

fn remarks(text: &mut Outline, report: &StudyReport) {
    let all = &report.all;
    accuracy_of_saws(
        text,
        report.largest_estimated_relative_error,
        report.saws_with_krein_violations,
        ": column krein_violations of study.csv",
    );
    if !report.processors.is_empty() {
        text.sentence("Computed by processors of several kinds, whose last digits may differ:");
        for name in &report.processors {
            text.reason(name.clone());
        }
    }
    for (count, word) in [(all.refused, "refused"), (all.failed, "failed")] {
        if count > 0 {
            let saws = counted(count, ["saw was", "saws were"]);
            text.sentence(format!("{saws} {word}, which counts as not passing:"));
        }
    }
    for refusal in report.not_analysed.iter().take(REASONS) {
        let reason = shortened(&refusal.reason, REASON);
        text.reason(format!("saw {}: {reason}", refusal.saw));
    }
}
