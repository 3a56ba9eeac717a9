//! Effects of the forces of the cut on the important speeds.

use crate::analyses::campbell::{InstabilityBand, Report};
use crate::page::outline::{Column, GROWTH, Outline, SPEED, Table};
use crate::page::text::shown_to;

/// Adds the forces of the diagram, and critical speed, flutter speed and growth with and without them.
pub fn in_cut(text: &mut Outline, report: &Report) {
    let Some(in_cut) = &report.in_cut else {
        return;
    };
    text.sentence(format!(
        "In the cut: the diagram includes the forces of {:.0} rpm, {:.0} N against the rotation and {:.0} N inwards on each of {} teeth",
        in_cut.rpm,
        in_cut.tangential_n_per_tooth,
        in_cut.radial_n_per_tooth,
        shown_to(3, in_cut.teeth)
    ));
    let Some(idling) = &in_cut.idling else {
        return;
    };
    let columns = ["", "idling", "in the cut"].map(Column::words);
    let mut table = Table::new("", columns);
    let mut speeds = |name: &str, idling: Option<f64>, in_cut: Option<f64>| {
        let [idling, in_cut] = [idling, in_cut].map(|rpm| SPEED.fixed(1, rpm).or("none"));
        table.row([name.into(), idling, in_cut]);
    };
    speeds(
        "first critical speed [rpm]",
        idling.critical_rpm.first().copied(),
        report.critical_speeds.first().map(|critical| critical.rpm),
    );
    speeds(
        "first flutter, also weak [rpm]",
        idling.first_merge_rpm,
        report.first_merge_rpm,
    );
    speeds(
        "flutter speed [rpm]",
        idling.flutter_rpm,
        report.flutter_rpm,
    );
    let growth = |bands: &[InstabilityBand]| {
        let all = bands.iter().map(|band| band.peak_growth_per_s);
        GROWTH.fixed(2, all.fold(0.0, f64::max))
    };
    table.row([
        "largest growth [1/s]".into(),
        growth(&idling.instabilities),
        growth(&report.instabilities),
    ]);
    text.table(table);
}
