//! Temperature of a blade that its pads heat, over the radius.

use super::report::{FrictionHeat, FrictionPad, GapReport};
use crate::page::figure::axis::{proper_range, tick_label, two_digits};
use crate::page::figure::chart_data::{AxisData, ChartData, PanelData};
use crate::page::figure::heading;
use crate::page::figure::items::{Area, Item, Line, Points};
use crate::page::figure::palette::Hue;
use crate::page::figure::style::{CURVE, shorten_label};
use crate::page::text::shown_to;

/// Largest number of pads in the key; further pads are counted.
const PADS: usize = 8;
/// Share of the colour of the radii of a pad.
const PAD_TINT: f64 = 0.13;
const PEAK_SIZE: f64 = 7.2;
/// Largest width of the name of pads, in figure units.
const LONGEST_NAME: f64 = 500.0;
/// Smallest width of a pad relative to the axis.
const POINT: f64 = 0.004;

/// The temperature rise over the radius, as numbers; `None` without friction, and unless the temperature settles.
pub fn chart(report: &GapReport) -> Option<ChartData> {
    let heat = report.friction.as_ref()?;
    let power_w = heat.power_w?;
    let mm: Vec<f64> = heat.radii_m.iter().map(|r| 1e3 * r).collect();
    let ends = [mm.first(), mm.last()].map(|end| end.copied().unwrap_or_default());
    let hottest = heat.rise_k.iter().copied().fold(0.0, f64::max);
    let top = if hottest > 0.0 { 1.15 * hottest } else { 1.0 };
    let points = mm.iter().zip(&heat.rise_k).map(|(mm, k)| [*mm, *k]);
    let curve = Line {
        width: 1.4 * CURVE,
        ..Line::new(points.clone(), Hue::Backward, "temperature rise")
    };
    let least = POINT * (ends[1] - ends[0]);
    let pads = by_radii(&heat.pads);
    let areas = pads.iter().map(|pads| Item::Area(pads.area(top, least)));
    let names = pads.iter().map(|pads| pads.label(top));
    let curve = [Item::Line(curve)];
    let mut items: Vec<Item> = areas.chain(curve).chain(names).collect();
    let peak = points.clone().find(|[_, k]| *k == hottest && hottest > 0.0);
    if let Some(at) = peak {
        items.push(Item::Points(Points::new(
            [at],
            Hue::Backward,
            PEAK_SIZE,
            "hottest radius",
        )));
        items.push(Item::label(
            at,
            Hue::Ink,
            format!("{} K", two_digits(hottest)),
        ));
    }
    let mut chart = ChartData::new(
        "Temperature rise by friction at the guides",
        facts(report, heat, power_w),
        vec![PanelData::new(
            AxisData::new("radius", "mm").within(proper_range(ends)),
            AxisData::new("temperature rise", "K").within([0.0, top]),
            items,
        )],
    );
    chart.key = key(heat);
    Some(chart)
}

fn facts(report: &GapReport, heat: &FrictionHeat, power_w: f64) -> Vec<String> {
    let map = &report.deviation;
    vec![
        heading::of_saw(&report.scene.name, &report.condition),
        format!("{:.0} rpm", map.rpm),
        format!(
            "{} N {}",
            shown_to(3, map.force_n),
            report.scene.side_force_place_in_words()
        ),
        format!("coefficient {}", shown_to(3, heat.coefficient)),
        format!("{} W", shown_to(3, power_w)),
    ]
}

/// Pads between the same radii.
struct Pads {
    ends_m: [f64; 2],
    guides: Vec<String>,
}

impl Pads {
    /// The radii of the pads, in a panel up to a temperature.
    fn area(&self, top: f64, least: f64) -> Area {
        let [from, to] = self.ends_m.map(|m| 1e3 * m);
        let missing = 0.5 * (least - (to - from)).max(0.0);
        let columns = [from - missing, to + missing].map(|mm| [mm, 0.0, top]);
        Area {
            tint: PAD_TINT,
            ..Area::new(columns, Hue::Forward, &self.name())
        }
    }

    /// The name of the pads, at the upper end of the panel.
    fn label(&self, top: f64) -> Item {
        let middle = 0.5e3 * (self.ends_m[0] + self.ends_m[1]);
        Item::label([middle, top], Hue::Forward, self.name())
    }

    fn name(&self) -> String {
        let name = format!("guides[{}]", self.guides.join(", "));
        shorten_label(&name, LONGEST_NAME)
    }
}

fn by_radii(pads: &[FrictionPad]) -> Vec<Pads> {
    let mut all: Vec<Pads> = Vec::new();
    for pad in pads {
        let ends_m = [pad.from_radius_m, pad.to_radius_m];
        match all.iter_mut().find(|pads| pads.ends_m == ends_m) {
            Some(pads) => pads.guides.push(pad.guide.to_string()),
            None => all.push(Pads {
                ends_m,
                guides: vec![pad.guide.to_string()],
            }),
        }
    }
    all
}

/// Radii, rest of the gap and force of each pad.
fn key(heat: &FrictionHeat) -> Vec<Item> {
    let pads = heat
        .pads
        .iter()
        .zip(&heat.pad_forces_n)
        .take(PADS)
        .map(|(pad, force_n)| {
            let name = describe(pad, *force_n);
            Item::tinted_sample(Hue::Forward, PAD_TINT, &name)
        });
    let rest = heat.pads.len().saturating_sub(PADS);
    let rest = (rest > 0).then(|| {
        let name = format!("… and {rest} more in gap.json");
        Item::tinted_sample(Hue::Forward, PAD_TINT, &name)
    });
    pads.chain(rest).collect()
}

fn describe(pad: &FrictionPad, force_n: f64) -> String {
    let ends = [pad.from_radius_m, pad.to_radius_m].map(|m| tick_label((1e4 * m).round() / 10.0));
    let place = if ends[0] == ends[1] {
        format!("at {} mm", ends[0])
    } else {
        format!("{} to {} mm", ends[0], ends[1])
    };
    let left = match pad.gap_left_m {
        None => "gap left unknown".to_owned(),
        Some(m) if m < 0.0 => format!("no gap left, pressed in by {} mm", shown_to(3, -1e3 * m)),
        Some(m) => format!("gap left {} mm", shown_to(3, 1e3 * m)),
    };
    let force = format!("force on the blade {} N", shown_to(3, force_n)).replace('-', "\u{2212}");
    format!("guides[{}] {place}, {left}, {force}", pad.guide)
}
#[cfg(test)]
mod tests {
    use super::*;
    use crate::page::figure::layout::sheet;
    use crate::page::figure::tidiness::texts;

    #[test]
    fn every_pad_is_named_and_no_label_lies_on_another() {
        let report = include_str!("../../../tests/golden/reports/gap-all.json");
        let mut report: GapReport = serde_json::from_str(report).unwrap();
        let heat = report.friction.as_mut().unwrap();
        let (pad, force_n) = (heat.pads[0], heat.pad_forces_n[0]);
        let point = FrictionPad {
            guide: 2,
            from_radius_m: 0.3,
            to_radius_m: 0.3,
            ..pad
        };
        heat.pads = vec![pad, FrictionPad { guide: 1, ..pad }, point];
        heat.pads.resize(12, pad);
        heat.pad_forces_n.resize(12, force_n);
        let drawn = sheet(&chart(&report).unwrap());
        let written = texts(&drawn);
        for said in [
            "guides[0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0]",
            "guides[2]",
            "… and 4 more in gap.json",
        ] {
            assert!(written.contains(&said), "{said}");
        }
        assert!(written.iter().any(|text| text.contains("at 300 mm")));
    }
}
