//! Statements below the title.

use crate::analyses::campbell::{InstabilityKind, Report};
use crate::model::scene::SlotPassing;

/// Size of the saw, numbers of its events, and verdict on flutter.
pub fn facts(report: &Report) -> Vec<String> {
    let blade = &report.scene.blade;
    let diameter = millimetres(blade.outer_diameter_m);
    let [least, largest] = blade.thickness_range_m().map(millimetres);
    let size = if least == largest {
        format!("{diameter} mm diameter, {largest} mm thick")
    } else {
        format!("{diameter} mm diameter, {least} to {largest} mm thick")
    };
    let guides = count(report.scene.guides.len(), "guide", "guides");
    let critical = match report.critical_speeds.first() {
        Some(lowest) if report.critical_speeds_without_damping => {
            format!("first critical speed without damping {:.0} rpm", lowest.rpm)
        }
        Some(lowest) => format!("first critical speed {:.0} rpm", lowest.rpm),
        None => "no critical speed".to_owned(),
    };
    let bands = count(
        report.instabilities.len(),
        "band of instability",
        "bands of instability",
    );
    let saw = report.condition.clone();
    let slots = blade.slots.map(|slots| {
        let depth = millimetres(slots.depth_m);
        format!(
            "{} of {depth} mm",
            count(slots.count as usize, "slot", "slots")
        )
    });
    // The title has room for some facts: the first are those without which the others mislead.
    let first = std::iter::once(saw).chain(not_covered(report));
    let facts = first.chain([size]).chain(slots);
    facts
        .chain([guides, critical, bands, verdict(report)])
        .collect()
}

/// Speeds at which the bands of a slotted saw are not certain.
fn not_covered(report: &Report) -> Option<String> {
    let passing = report.scene.slot_passing()?;
    if let (Some(_), Some(rpm)) = (&report.verdict.floquet, report.verdict.rpm) {
        return Some(format!("slots pass guides: certain at {rpm:.0} rpm alone"));
    }
    let pairs = report.split_pairs.as_ref();
    let open = pairs.and_then(|pairs| pairs.not_certain_rpm.as_deref());
    let speeds = match (open, passing) {
        (Some([]), _) => return None,
        (Some([[from, _], ..]), _) if *from > report.campbell.from_rpm => {
            format!("from {from:.0} rpm")
        }
        (None, SlotPassing::Inside) => "above the first critical speed".to_owned(),
        _ => "at any speed".to_owned(),
    };
    Some(format!("slots pass guides: not certain {speeds}"))
}

fn verdict(report: &Report) -> String {
    let mut bands = report.instabilities.iter();
    let flutters = bands.any(|band| band.kind == InstabilityKind::Flutter);
    let last = report.campbell.to_rpm;
    match report.flutter_rpm {
        Some(rpm) => format!("flutter from {rpm:.0} rpm"),
        // The figure also shows flutter with growth rates below the threshold, so that the verdict must name
        // the threshold.
        None if flutters => {
            let threshold = report.flutter_threshold_per_s;
            format!("no flutter above {threshold} 1/s up to {last:.0} rpm")
        }
        None => format!("no flutter up to {last:.0} rpm"),
    }
}

/// Millimetres, rounded to two decimals.
fn millimetres(metres: f64) -> f64 {
    (metres * 1e5).round() / 100.0
}

fn count(number: usize, one: &str, many: &str) -> String {
    match number {
        0 => format!("no {many}"),
        1 => format!("1 {one}"),
        _ => format!("{number} {many}"),
    }
}
