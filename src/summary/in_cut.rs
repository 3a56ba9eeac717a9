//! Effects of the forces of the cut on the important speeds.

use std::fmt::{Result, Write};

use super::{decimals_or, sentence};
use crate::report::Report;
use crate::text::shown_to;

/// Writes the forces of the diagram, and critical speed, flutter speed and growth with and without them.
pub fn in_cut(text: &mut String, report: &Report) -> Result {
    let Some(in_cut) = &report.in_cut else {
        return Ok(());
    };
    let forces = format!(
        "In the cut: the diagram includes the forces of {:.0} rpm, {:.0} N against the rotation and {:.0} N \
         inwards on each of {} teeth",
        in_cut.rpm,
        in_cut.tangential_n_per_tooth,
        in_cut.radial_n_per_tooth,
        shown_to(3, in_cut.teeth)
    );
    writeln!(text)?;
    sentence(text, &forces)?;
    let Some(idling) = &in_cut.idling else {
        return Ok(());
    };
    writeln!(text, "  {:<32} {:>9} {:>9}", "[rpm]", "idling", "in cut")?;
    let rows = [
        (
            "lowest critical speed",
            idling.critical_speeds_rpm.first().copied(),
            report.critical_speeds.first().map(|critical| critical.rpm),
        ),
        (
            "first flutter band, even weak",
            idling.first_merge_rpm,
            report.first_merge_rpm,
        ),
        (
            "flutter speed",
            idling.flutter_speed_rpm,
            report.flutter_speed_rpm,
        ),
    ];
    for (name, idling, in_cut) in rows {
        writeln!(
            text,
            "  {name:<32} {:>9} {:>9}",
            decimals_or("none", 1, idling),
            decimals_or("none", 1, in_cut)
        )?;
    }
    let growth = |bands: &[crate::report::InstabilityBand]| {
        let all = bands.iter().map(|band| band.peak_growth_per_s);
        all.fold(0.0, f64::max)
    };
    writeln!(
        text,
        "  {:<32} {:>9.2} {:>9.2}",
        "largest growth [1/s]",
        growth(&idling.instabilities),
        growth(&report.instabilities)
    )
}
