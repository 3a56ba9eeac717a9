//! Rolled bands, light gap, limits of heat, and effects of the numbers of the scene on the speeds.

use crate::analyses::campbell::{Report, ToleratedRise};
use crate::page::outline::{Column, LENGTH, Outline, Table, Value};
use crate::page::text::shown_to;

/// Adds position and width of the rolled bands, their eigenstrain, and the equivalent depth of a groove.
pub fn rolled(text: &mut Outline, report: &Report) {
    for band in report.membrane.iter().flat_map(|m| &m.roll_bands) {
        text.sentence(format!(
            "Rolled band at {} mm, {} mm wide: eigenstrain {}, as a groove {} µm deep on each face",
            shown_to(4, 1e3 * band.radius_m),
            shown_to(3, 1e3 * band.width_m),
            shown_to(3, band.eigenstrain),
            shown_to(3, 1e6 * band.groove_depth_m)
        ));
    }
}

/// Adds the computed light gap under the straight edge, and the rolling that follows from a measured one.
pub fn straight_edge(text: &mut Outline, report: &Report) {
    let membrane = report.membrane.as_ref();
    let Some(edge) = membrane.and_then(|m| m.straight_edge.as_ref()) else {
        return;
    };
    text.sentence(format!(
        "Straight edge of {} mm, blade level on two points at {} mm:",
        shown_to(4, 1e3 * edge.length_m),
        shown_to(4, 1e3 * edge.support_radius_m)
    ));
    let mm = |length_m: f64| LENGTH.digits(3, length_m).with_unit();
    text.reason(match edge.gap_m {
        Some(gap_m) => format!("light gap {} at the bore", mm(gap_m)),
        None => "the blade buckles, so that it has no light gap".to_owned(),
    });
    if let Some(factor) = edge.buckling_factor {
        text.reason(format!(
            "without rolling {}; {} times the rolling buckles the blade",
            mm(edge.gap_without_rolling_m),
            shown_to(3, factor)
        ));
    }
    let Some(measured) = &edge.measured else {
        return;
    };
    text.reason(format!(
        "measured {}: {} times the rolling,",
        mm(measured.gap_m),
        shown_to(3, measured.factor)
    ));
    for band in &measured.roll_bands {
        text.reason(format!(
            "eigenstrain {} at {} mm, as a groove {} µm deep on each face",
            shown_to(3, band.eigenstrain),
            shown_to(4, 1e3 * band.radius_m),
            shown_to(3, 1e6 * band.groove_depth_m)
        ));
    }
}

/// Adds the peak temperature rises at which the operating speed becomes critical and the blade buckles, for
/// the temperature profile of the scene.
pub fn heat(text: &mut Outline, report: &Report) {
    let heat = report.membrane.as_ref().and_then(|m| m.heat.as_ref());
    let Some(heat) = heat else {
        return;
    };
    text.sentence(format!(
        "Heat, peak of the profile now {:+.1} K:",
        heat.rise_k
    ));
    if let Some(limit) = &heat.operating_limit {
        text.reason(format!(
            "{:+.1} K brings the first critical speed down to the operating speed ({})",
            limit.rise_k, limit.name
        ));
    } else if heat.past_critical_when_cold {
        text.reason("the operating speed is critical even for the cold blade");
    } else if report.operating.is_some() && !heat.buckles_first {
        text.reason("it never brings a critical speed down to the operating speed");
    }
    if let Some(ToleratedRise { rise_k, name, .. }) = &heat.flat_from {
        text.reason(format!(
            "below {rise_k:+.1} K it is buckled at rest ({name})"
        ));
    }
    text.reason(match &heat.buckling {
        Some(limit) => {
            let first = if heat.buckles_first {
                ", before a critical speed is that low"
            } else {
                ""
            };
            let (rise_k, name) = (limit.rise_k, &limit.name);
            format!("{rise_k:+.1} K buckles the blade at rest{first} ({name})")
        }
        None => "it never buckles the blade at rest".to_owned(),
    });
}

/// The relative changes of the first critical speed and of the flutter speed by a change of each number of the scene.
pub fn sensitivity(report: &Report) -> Table {
    let columns = [
        Column::words("change"),
        Column::words("number"),
        Column::words("critical").in_unit("%"),
        Column::words("flutter").in_unit("%"),
    ];
    let percent = |value: Option<f64>| value.map_or(Value::Missing, |v| format!("{v:+.3}").into());
    let rows = report.sensitivities.iter().map(|entry| {
        [
            format!("{} more", entry.change).into(),
            entry.parameter.clone().into(),
            percent(entry.of_first_critical()),
            percent(entry.flutter_speed_percent),
        ]
    });
    let title = "Influences on the first critical speed, and the flutter speed";
    Table::new(title, columns)
        .showing(usize::MAX)
        .with_rows(rows)
}
