//! The deflection at the cut over gap and side force, and over gap and speed, with the line of the largest deflection
//! allowed.

use super::report::GapReport;
use crate::page::figure::axis::{Spread, ends_of_cells, extremes};
use crate::page::figure::chart_data::{AxisData, ChartData, PanelData};
use crate::page::figure::heading;
use crate::page::figure::items::{Area, Heat, Item, Line};
use crate::page::figure::palette::Hue;
use crate::page::figure::style::STRONG_CURVE;
use crate::page::text::shown_to;

/// Colours from small to large deflections: pale to dark, so that grey prints are legible too.
const SMALL_TO_LARGE: [[u8; 3]; 5] = [
    [236, 244, 236],
    [160, 208, 190],
    [72, 150, 170],
    [46, 88, 140],
    [40, 24, 74],
];
const BLANK: &str = "the blade leans by more than its thickness, or slopes exceed 0.1";
const LIMIT: &str = "largest deflection allowed";
/// Width of the line of this limit, and of the paper along it.
const LIMIT_WIDTH: f64 = STRONG_CURVE - 1.0;
const PAPER_WIDTH: f64 = STRONG_CURVE + 2.0;

/// The two maps, as numbers; `None` if no deflection is known.
pub fn chart(report: &GapReport) -> Option<ChartData> {
    let map = &report.deviation;
    let all = map
        .deflection_m
        .iter()
        .skip(1)
        .flatten()
        .chain(map.deflection_over_gap_and_speed_m.iter().skip(1).flatten())
        .flatten()
        .map(|m| 1e3 * m.abs())
        .filter(|mm| *mm > 0.0);
    let range = extremes(all);
    if !range[0].is_finite() {
        return None;
    }
    let gaps_mm = map
        .gap_factors
        .iter()
        .map(|factor| 1e3 * factor * report.smallest_gap_m);
    let forces: Vec<f64> = map.forces_n.iter().map(|force| force.abs()).collect();
    let over_force = Map {
        title: format!("at {:.0} rpm", map.rpm),
        axis: AxisData::new("side force", "N").spread(Spread::Logarithmic),
        values: &forces,
        deflection_m: &map.deflection_m,
        within: &map.force_within_n,
    };
    let over_speed = Map {
        title: format!("under {} N", shown_to(3, map.force_n)),
        axis: AxisData::speed(),
        values: &map.speeds_rpm,
        deflection_m: &map.deflection_over_gap_and_speed_m,
        within: &map.speed_within_rpm,
    };
    let gaps_mm: Vec<f64> = gaps_mm.collect();
    let panels = [over_force, over_speed].map(|map| map.panel(&gaps_mm, range));
    let limit = map
        .max_deflection_m
        .map(|_| Item::line_sample(LIMIT_WIDTH, false, Hue::Ink, LIMIT));
    let blank = Item::area_sample(Hue::Blank, BLANK);
    let title = "Deflection at the cut over the gap of the guides";
    Some(ChartData {
        columns: 2,
        key: [blank].into_iter().chain(limit).collect(),
        ..ChartData::new(title, facts(report), panels.into())
    })
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

/// The deflection over the gap and another quantity.
struct Map<'a> {
    title: String,
    /// Axis of the other quantity.
    axis: AxisData,
    /// Values of the other quantity, ascending.
    values: &'a [f64],
    /// Deflections in a row for each gap.
    deflection_m: &'a [Vec<Option<f64>>],
    /// Largest value, for each gap, at which the deflection is within the limit.
    within: &'a [Option<f64>],
}

impl Map<'_> {
    /// The map for some gaps, with colours for a range of deflections in mm.
    fn panel(&self, gaps_mm: &[f64], range: [f64; 2]) -> PanelData {
        // Linear guides have a gap of zero, which a logarithmic axis cannot show.
        let rows: Vec<usize> = (0..gaps_mm.len())
            .filter(|row| gaps_mm[*row] > 0.0)
            .collect();
        let gaps: Vec<f64> = rows.iter().map(|row| gaps_mm[*row]).collect();
        let y_ends = ends_of_cells(&gaps, Spread::Logarithmic);
        let x_ends = ends_of_cells(self.values, self.axis.spread);
        let row = |row: &usize| {
            let known = self.deflection_m[*row].iter();
            known
                .map(|m| m.map_or(f64::NAN, |m| 1e3 * m.abs()))
                .collect()
        };
        let heat = Heat {
            x: self.values.to_vec(),
            y: gaps.clone(),
            z: rows.iter().map(row).collect(),
            range,
            spread: Spread::Logarithmic,
            colours: SMALL_TO_LARGE.to_vec(),
            name: "deflection".to_owned(),
            unit: "mm".to_owned(),
        };
        let last = self.values.last().copied().unwrap_or_default();
        let limit = rows.iter().zip(&gaps).map(|(row, gap)| {
            let within = self
                .within
                .get(*row)
                .copied()
                .flatten()
                .filter(|value| *value < last);
            [within.unwrap_or(f64::NAN), *gap]
        });
        let line = |width, hue| {
            Item::Line(Line {
                width,
                ..Line::new(limit.clone(), hue, LIMIT)
            })
        };
        let blank = x_ends.map(|x| [x, y_ends[0], y_ends[1]]);
        let gap = AxisData::new("smallest gap", "mm").within(y_ends);
        PanelData {
            title: self.title.clone(),
            share: 0.85,
            ..PanelData::new(
                self.axis.clone().within(x_ends),
                gap.spread(Spread::Logarithmic),
                vec![
                    Item::Area(Area::new(blank, Hue::Blank, BLANK)),
                    Item::Heat(heat),
                    line(PAPER_WIDTH, Hue::Paper),
                    line(LIMIT_WIDTH, Hue::Ink),
                ],
            )
        }
    }
}
