//! The text of the oscillation of guides with a gap.

use super::oscillation_report::{Oscillation, OscillationAt};
use crate::page::outline::{Column, FORCE, FREQUENCY, Fact, LENGTH, Outline, PERCENT, Table};
use crate::page::text::shown_to;

/// Adds the oscillation at a speed in rpm.
pub fn oscillation(text: &mut Outline, rpm: f64, found: &Oscillation) {
    let title = format!(
        "Oscillation at {rpm:.0} rpm under {} N, with the gap of the scene",
        shown_to(3, found.force_n)
    );
    let Some(at) = &found.at else {
        return text.sentence(format!("{title}: no periodic motion was found"));
    };
    let mm = |m: f64| LENGTH.fixed(4, m).with_unit();
    let moved = format!(
        ", amplitude {}, at most {}",
        mm(at.cut.amplitude_m),
        mm(at.cut.largest_m)
    );
    let at_probe = format!(", amplitude {}", mm(at.probe.amplitude_m));
    let still = LENGTH.fixed(4, found.still_deflection_m);
    let mut facts = vec![
        Fact::new("rim at the cut, mean", mm(at.cut.mean_m) + &moved),
        Fact::new("without oscillation", still),
        Fact::new("probe, mean", mm(at.probe.mean_m) + &at_probe),
        Fact::new("small motions", decay(at)),
    ];
    facts.extend(at.pads.iter().map(|pad| {
        let name = format!("guides[{}], mean force", pad.guide);
        let remark = format!(
            "{}, at most {}, touches {:.0} % of the time",
            FORCE.digits(3, pad.mean_force_n).with_unit(),
            FORCE.digits(3, pad.largest_force_n).with_unit(),
            1e2 * pad.contact_share
        );
        Fact::new(name, remark)
    }));
    text.facts(title, facts);
    text.table(lines(found, at));
    let error = |share: Option<f64>| PERCENT.digits(2, share).or("unknown").with_unit();
    text.sentence(format!(
        "Estimated error of this amplitude at the cut: {} of neglected harmonics, {} with more modes at rest",
        error(found.harmonics_error_share),
        error(found.basis_error_share)
    ));
}

fn lines(found: &Oscillation, at: &OscillationAt) -> Table {
    let columns = [
        Column::words("order"),
        Column::of("frequency", &FREQUENCY),
        Column::of("at the cut", &LENGTH),
        Column::of("at the probe", &LENGTH),
        Column::words("cause"),
    ];
    let sizes = at.cut.lines_m.iter().zip(&at.probe.lines_m);
    let rows = found.lines.iter().zip(sizes).map(|(line, (cut, probe))| {
        [
            format!("{}×", line.order).into(),
            FREQUENCY.digits(4, f64::from(line.order) * at.rpm / 60.0),
            LENGTH.digits(3, *cut),
            LENGTH.digits(3, *probe),
            line.name.clone().into(),
        ]
    });
    Table::new("", columns).showing(usize::MAX).with_rows(rows)
}

/// Stability of the oscillation: largest growth rate of small motions about it.
fn decay(at: &OscillationAt) -> String {
    match at.growth_per_s {
        None => "unknown".to_owned(),
        Some(growth) if at.stable => format!("stable, growth {} 1/s at most", shown_to(2, growth)),
        Some(growth) => format!("unstable, growth {} 1/s", shown_to(2, growth)),
    }
}
