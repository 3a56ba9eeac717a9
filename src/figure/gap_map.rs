//! The deflection at the cut over gap and side force, and over gap and speed, with the line of the largest deflection
//! allowed.

use super::axis::{Axis, Spread, draw_named, draw_vertical, extremes, name_upright, tick_label};
use super::canvas::{Frame, Lettering, Sheet, Stroke};
use super::heading;
use super::heat::{draw_grid, draw_scale, ramp};
use super::key::Key;
use super::style::{BETWEEN_FACTS, BLANK, Colour, INK, PAPER, STRONG_CURVE, SUBTITLE_SIZE};
use crate::analyses::gap::{DeviationMap, GapReport};
use crate::text::shown_to;

const WIDTH: u32 = 1200;
const HEIGHT: u32 = 560;
const PANELS: [Frame; 2] = [
    Frame {
        left: 92.0,
        top: 116.0,
        right: 540.0,
        bottom: 440.0,
    },
    Frame {
        left: 610.0,
        top: 116.0,
        right: 1058.0,
        bottom: 440.0,
    },
];
const SCALE: [f64; 2] = [1096.0, 1116.0];
/// Colours from small to large deflections: pale to dark, so that grey prints are legible too.
const SMALL_TO_LARGE: [Colour; 5] = [
    plotters::style::RGBColor(236, 244, 236),
    plotters::style::RGBColor(160, 208, 190),
    plotters::style::RGBColor(72, 150, 170),
    plotters::style::RGBColor(46, 88, 140),
    plotters::style::RGBColor(40, 24, 74),
];

/// Draws the two maps; `None` if no deflection is known.
pub fn sheet(report: &GapReport) -> Option<Sheet> {
    let map = &report.deviation;
    let all = map.deflection_m.iter().skip(1).flatten();
    let all = all.chain(map.deflection_over_gap_and_speed_m.iter().skip(1).flatten());
    let all = all.flatten().map(|m| 1e3 * m.abs()).filter(|mm| *mm > 0.0);
    let ends = extremes(all);
    if !ends[0].is_finite() {
        return None;
    }
    let mut sheet = Sheet::new(WIDTH, HEIGHT);
    heading::draw(
        &mut sheet,
        "Deflection at the cut over the gap of the guides",
        &facts(report).join(BETWEEN_FACTS),
    );
    let shade = Shade { ends };
    let forces: Vec<f64> = map.forces_n.iter().map(|force| force.abs()).collect();
    let panels = [
        Panel {
            title: format!("at {:.0} rpm", map.rpm),
            name: "side force\u{2003}[N]",
            values: &forces,
            spread: Spread::Logarithmic,
            deflection_m: &map.deflection_m,
            within: &map.force_within_n,
        },
        Panel {
            title: format!("under {} N", shown_to(3, map.force_n)),
            name: "rotation speed\u{2003}[rpm]",
            values: &map.speeds_rpm,
            spread: Spread::Linear,
            deflection_m: &map.deflection_over_gap_and_speed_m,
            within: &map.speed_within_rpm,
        },
    ];
    for (frame, panel) in PANELS.iter().zip(&panels) {
        panel.draw(&mut sheet, frame, report, &shade);
    }
    name_upright(&mut sheet, 28.0, &PANELS[0], "smallest gap\u{2003}[mm]");
    let place = (&PANELS[1], 20.0, SCALE);
    let label = |mm: f64| Some(tick_label(mm));
    let colour = |mm: f64| shade.colour(mm);
    let scale = (ends, Spread::Logarithmic);
    draw_scale(&mut sheet, place, scale, "mm", (colour, label));
    draw_key(&mut sheet, map);
    Some(sheet)
}

fn facts(report: &GapReport) -> Vec<String> {
    let map = &report.deviation;
    let own = format!(
        "the scene's smallest gap is {} mm, all gaps in proportion",
        shown_to(3, 1e3 * report.smallest_gap_m)
    );
    let limit = map
        .max_deflection_m
        .map(|m| format!("at most {} mm allowed", shown_to(3, 1e3 * m)));
    let place = format!("rim at {}°", shown_to(3, map.angle_deg));
    [
        Some(heading::of_saw(&report.scene.name, &report.condition)),
        Some(place),
        Some(own),
        limit,
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// Colours of deflections, by their logarithm.
struct Shade {
    /// Smallest and largest deflection in mm.
    ends: [f64; 2],
}

impl Shade {
    fn colour(&self, mm: f64) -> Colour {
        let [low, high] = self.ends.map(f64::log10);
        ramp(&SMALL_TO_LARGE, (mm.log10() - low) / (high - low))
    }
}

/// A map of the deflection over the gap and another quantity.
struct Panel<'a> {
    title: String,
    /// Name of the other quantity, with its unit.
    name: &'static str,
    /// Values of the other quantity, ascending.
    values: &'a [f64],
    spread: Spread,
    /// Deflections in a row for each gap.
    deflection_m: &'a [Vec<Option<f64>>],
    /// Largest value, for each gap, at which the deflection is within the limit.
    within: &'a [Option<f64>],
}

impl Panel<'_> {
    fn draw(&self, sheet: &mut Sheet, frame: &Frame, report: &GapReport, shade: &Shade) {
        let gaps_mm = report.deviation.gap_factors.iter();
        let gaps_mm: Vec<f64> = gaps_mm
            .map(|factor| 1e3 * factor * report.smallest_gap_m)
            .collect();
        // Linear guides have a gap of zero, which a logarithmic axis cannot show.
        let rows: Vec<usize> = (0..gaps_mm.len())
            .filter(|row| gaps_mm[*row] > 0.0)
            .collect();
        let gaps: Vec<f64> = rows.iter().map(|row| gaps_mm[*row]).collect();
        let y = Axis::of_cells(&gaps, frame.upwards(), Spread::Logarithmic);
        let x = Axis::of_cells(self.values, frame.across(), self.spread);
        draw_vertical(sheet, &y, frame, "");
        draw_grid(sheet, (&x, self.values), (&y, &gaps), |column, row| {
            let found = self.deflection_m[rows[row]][column];
            found.map_or(BLANK, |m| shade.colour(1e3 * m.abs()))
        });
        draw_named(sheet, &x, frame.bottom, self.name);
        let title = Lettering::title(SUBTITLE_SIZE, INK);
        sheet.text([frame.left, frame.top - 14.0], title, &self.title);
        let last = self.values.last().copied().unwrap_or_default();
        let crossings = rows.iter().zip(&gaps).filter_map(|(row, gap)| {
            let within = (*self.within.get(*row)?)?;
            (within < last).then(|| [x.at(within), y.at(*gap)])
        });
        let crossings: Vec<[f64; 2]> = crossings.collect();
        for (width, colour) in [(STRONG_CURVE + 2.0, PAPER), (STRONG_CURVE - 1.0, INK)] {
            sheet.line(crossings.clone(), Stroke::solid(colour, width));
        }
    }
}

fn draw_key(sheet: &mut Sheet, map: &DeviationMap) {
    let y = f64::from(HEIGHT) - 36.0;
    let mut key = Key::new(sheet, PANELS[0].left, y);
    key.shade(BLANK)
        .word("the blade leans by more than its thickness, or slopes exceed 0.1");
    if map.max_deflection_m.is_some() {
        key.line(24.0, Stroke::solid(INK, STRONG_CURVE - 1.0))
            .word("largest deflection allowed");
    }
}
