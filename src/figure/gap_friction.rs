//! Temperature of a blade that its pads heat, over the radius.

use super::axis::{Axis, draw_named, draw_vertical, tick_label, two_digits};
use super::canvas::{Anchor, Frame, Lettering, Sheet, Stroke};
use super::declutter::{Extent, push_apart};
use super::heading;
use super::style::{
    BACKWARD, BETWEEN_FACTS, CURVE, FORWARD, INK, LABEL_SIZE, QUIET, shorten_label, tint,
};
use crate::analyses::gap::{FrictionHeat, FrictionPad, GapReport};
use crate::text::shown_to;

const WIDTH: u32 = 820;
/// Height without the list of pads.
const HEIGHT: u32 = 500;
const PANEL: Frame = Frame {
    left: 92.0,
    top: 116.0,
    right: 780.0,
    bottom: 430.0,
};
/// Line height of the list of pads.
const LINE: f64 = 19.0;
/// Largest number of pads in this list; further pads are counted.
const PADS: usize = 8;
/// Space between the names of pads.
const BETWEEN: f64 = 12.0;
/// Smallest width of a pad on the sheet.
const POINT: f64 = 3.0;

/// Draws the temperature rise over the radius; `None` without friction.
pub fn sheet(report: &GapReport) -> Option<Sheet> {
    let heat = report.friction.as_ref()?;
    let lines = heat.pads.len().min(PADS + 1);
    let mut sheet = Sheet::new(WIDTH, HEIGHT + (LINE * lines as f64) as u32 + 12);
    heading::draw(
        &mut sheet,
        "Temperature rise by friction at the guides",
        &facts(report, heat).join(BETWEEN_FACTS),
    );
    let mm: Vec<f64> = heat.radii_m.iter().map(|r| 1e3 * r).collect();
    let ends = [mm.first(), mm.last()].map(|end| end.copied().unwrap_or_default());
    let radius = Axis::linear(ends, PANEL.across());
    let hottest = heat.rise_k.iter().copied().fold(0.0, f64::max);
    let top = if hottest > 0.0 { 1.15 * hottest } else { 1.0 };
    let rise = Axis::linear([0.0, top], PANEL.upwards());
    draw_pads(&mut sheet, heat, &radius);
    draw_vertical(&mut sheet, &rise, &PANEL, "temperature rise\u{2003}[K]");
    draw_named(&mut sheet, &radius, PANEL.bottom, "radius\u{2003}[mm]");
    let curve = mm.iter().zip(&heat.rise_k);
    let curve = curve.map(|(mm, k)| [radius.at(*mm), rise.at(*k)]);
    sheet.line(curve, Stroke::solid(BACKWARD, 1.4 * CURVE));
    let peak = mm.iter().zip(&heat.rise_k).find(|(_, k)| **k == hottest);
    if let (Some((mm, k)), true) = (peak, hottest > 0.0) {
        label_peak(&mut sheet, [radius.at(*mm), rise.at(*k)], *k);
    }
    list_pads(&mut sheet, heat);
    Some(sheet)
}

fn facts(report: &GapReport, heat: &FrictionHeat) -> Vec<String> {
    let map = &report.deviation;
    let settled = (!heat.settled).then(|| "not settled".to_owned());
    let all = [
        Some(heading::of_saw(&report.scene.name, &report.condition)),
        Some(format!("{:.0} rpm", map.rpm)),
        Some(format!(
            "{} N {}",
            shown_to(3, map.force_n),
            report.scene.side_force_place_in_words()
        )),
        Some(format!("coefficient {}", shown_to(3, heat.coefficient))),
        Some(format!("{} W", shown_to(3, heat.power_w))),
        settled,
    ];
    all.into_iter().flatten().collect()
}

/// Pads between the same radii.
struct Pads {
    ends_m: [f64; 2],
    guides: Vec<usize>,
}

fn by_radii(pads: &[FrictionPad]) -> Vec<Pads> {
    let mut all: Vec<Pads> = Vec::new();
    for pad in pads {
        let ends_m = [pad.from_radius_m, pad.to_radius_m];
        match all.iter_mut().find(|pads| pads.ends_m == ends_m) {
            Some(pads) => pads.guides.push(pad.guide),
            None => all.push(Pads {
                ends_m,
                guides: vec![pad.guide],
            }),
        }
    }
    all
}

/// Shades the radii of the pads, and writes the numbers of their guides above.
fn draw_pads(sheet: &mut Sheet, heat: &FrictionHeat, radius: &Axis) {
    let labels = by_radii(&heat.pads).into_iter().map(|pads| {
        let [left, right] = pads.ends_m.map(|m| radius.at(1e3 * m));
        let half = (0.5 * (right - left)).max(0.5 * POINT);
        let middle = 0.5 * (left + right);
        let frame = PANEL.between([middle - half, middle + half]);
        sheet.fill(frame, tint(FORWARD, 0.13));
        let numbers: Vec<String> = pads.guides.iter().map(usize::to_string).collect();
        let name = format!("guides[{}]", numbers.join(", "));
        (
            middle,
            shorten_label(&name, 0.6 * (PANEL.right - PANEL.left)),
        )
    });
    let labels: Vec<(f64, String)> = labels.collect();
    let extents = labels
        .iter()
        .map(|(middle, name)| Extent::of_label(*middle, name, BETWEEN));
    let letters = Lettering::regular(LABEL_SIZE, FORWARD, Anchor::Middle);
    let places = push_apart(extents, PANEL.across());
    for ((_, name), x) in labels.iter().zip(places) {
        if let Some(x) = x {
            sheet.text([x, PANEL.top - 10.0], letters, name);
        }
    }
}

fn label_peak(sheet: &mut Sheet, [x, y]: [f64; 2], rise_k: f64) {
    sheet.disc([x, y], 3.6, BACKWARD);
    // The label is on the side of the peak with more room.
    let is_right = x > 0.5 * (PANEL.left + PANEL.right);
    let anchor = if is_right { Anchor::End } else { Anchor::Start };
    let at = [x + if is_right { -10.0 } else { 10.0 }, y - 6.0];
    let letters = Lettering::regular(LABEL_SIZE, INK, anchor);
    sheet.text_on_paper(at, letters, &format!("{} K", two_digits(rise_k)));
}

/// Lists below the diagram, for each pad, its radii, the rest of its gap, and its force.
fn list_pads(sheet: &mut Sheet, heat: &FrictionHeat) {
    let mut y = f64::from(HEIGHT) + 4.0;
    let letters = Lettering::regular(LABEL_SIZE, QUIET, Anchor::Start);
    let columns = [0.0, 90.0, 230.0, 470.0].map(|x| PANEL.left + x);
    for (pad, force_n) in heat.pads.iter().zip(&heat.pad_forces_n).take(PADS) {
        let ends =
            [pad.from_radius_m, pad.to_radius_m].map(|m| tick_label((1e4 * m).round() / 10.0));
        let place = match ends[0] == ends[1] {
            true => format!("at {} mm", ends[0]),
            false => format!("{} to {} mm", ends[0], ends[1]),
        };
        let left = match pad.gap_left_m {
            None => "gap left unknown".to_owned(),
            Some(m) if m < 0.0 => {
                format!("no gap left, pressed in by {} mm", shown_to(3, -1e3 * m))
            }
            Some(m) => format!("gap left {} mm", shown_to(3, 1e3 * m)),
        };
        let force =
            format!("force on the blade {} N", shown_to(3, *force_n)).replace('-', "\u{2212}");
        let cells = [format!("guides[{}]", pad.guide), place, left, force];
        for (x, cell) in columns.iter().zip(&cells) {
            sheet.text([*x, y], letters, cell);
        }
        y += LINE;
    }
    let rest = heat.pads.len().saturating_sub(PADS);
    if rest > 0 {
        let said = format!("… and {rest} more in gap.json");
        sheet.text([columns[0], y], letters, &said);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analyses::gap::{Options, gap};
    use crate::figure::gap_oscillation;
    use crate::figure::tidy::{assert_tidy, texts};
    use crate::scene::{Accuracy, ContactLaw, FrictionFile, Scene, SideForceFile, SweepFile};

    #[test]
    #[cfg_attr(debug_assertions, ignore = "many eigenproblems: run it in release")]
    fn every_pad_is_named_and_no_label_lies_on_another() {
        let scene = Scene::paper().edited(|file| {
            (file.accuracy, file.operating_rpm) = (Accuracy::Draft, Some(1000.0));
            file.sweep = Some(SweepFile {
                from_rpm: 0.0,
                to_rpm: 1500.0,
            });
            file.friction = Some(FrictionFile::of(0.1));
            file.side_force = Some(SideForceFile {
                oscillating_n: 0.5,
                ..SideForceFile::of(4.0)
            });
            let pad = &mut file.guides[0];
            (pad.contact, pad.gap_m) = (ContactLaw::OneSided, Some(4e-5));
            let mut others = [*pad; 2];
            (others[0].angle_deg, others[1].angle_deg) = (60.0, 180.0);
            (others[1].radius_m, others[1].radial_length_m) = (0.3, 0.0);
            others[1].tangential_length_m = 0.0;
            file.guides.extend(others);
        });
        let options = Options {
            max_deviation_mm: Some(0.2),
            ..Options::default()
        };
        let mut report = gap(&scene.unwrap(), &options).unwrap();
        assert_tidy(&gap_oscillation::sheet(&report).unwrap());
        let drawn = sheet(&report).unwrap();
        assert_tidy(&drawn);
        let written = texts(&drawn);
        for said in ["guides[0, 1]", "guides[2]", "at 300 mm"] {
            assert!(written.iter().any(|(_, text)| *text == said), "{said}");
        }
        let heat = report.friction.as_mut().unwrap();
        let (pad, force_n) = (heat.pads[0], heat.pad_forces_n[0]);
        heat.pads.resize(12, pad);
        heat.pad_forces_n.resize(12, force_n);
        assert_tidy(&sheet(&report).unwrap());
        report.friction = None;
        assert!(sheet(&report).is_none());
    }
}
