//! The paths in the complex plane, with arrows for rising speed.

use super::super::canvas::{Sheet, Stroke};
use super::super::clip::clip;
use super::super::style::{CURVE, FLUTTER, HAIRLINE, INK, QUIET};
use super::tracks::{Loci, Look, Sample, Track};
use super::{Chart, colour};

/// On the imaginary axis one path is drawn this far left of it, the other right.
const ASIDE: f64 = 3.5;
const ARROW: f64 = 5.5;

/// Where the tracks of a look lie beside the axis: −1 left, +1 right.
pub fn side(look: Look) -> f64 {
    match look {
        Look::Plus | Look::Damped(0) => -1.0,
        Look::Minus | Look::Damped(_) => 1.0,
        Look::Growing | Look::Decaying => 0.0,
    }
}

pub fn width(look: Look) -> f64 {
    match look {
        Look::Growing => 1.6 * CURVE,
        Look::Decaying => CURVE,
        _ => 1.3 * CURVE,
    }
}

/// The track on the sheet. Paths that would lie on each other are parted a little.
pub fn places(chart: &Chart, track: &Track) -> Vec<[f64; 2]> {
    let Loci {
        onset, peak, end, ..
    } = chart.loci;
    let [way_out, way_back] = [onset, end].map(|s| chart.frequency.at(s.hz));
    let apart = (3.0 - (way_out - way_back).abs() / 4.0).max(0.0);
    let apart = if way_out <= way_back { -apart } else { apart };
    let place = |sample: &Sample| {
        let [x, y] = at(chart, sample);
        match track.look {
            _ if !chart.loci.merge => [x, y],
            Look::Growing | Look::Decaying if sample.rpm <= peak.rpm => [x, y + apart],
            Look::Growing | Look::Decaying => [x, y - apart],
            look => [x + ASIDE * side(look), y],
        }
    };
    track.samples.iter().map(place).collect()
}

/// The exact place of an eigenvalue.
pub fn at(chart: &Chart, sample: &Sample) -> [f64; 2] {
    [
        chart.growth.at(sample.growth),
        chart.frequency.at(sample.hz),
    ]
}

pub fn draw(sheet: &mut Sheet, chart: &Chart) {
    let zero = chart.growth.at(0.0);
    let axis = [[zero, chart.plane.top], [zero, chart.plane.bottom]];
    sheet.line(axis, Stroke::solid(QUIET, HAIRLINE));
    for track in &chart.loci.tracks {
        let stroke = Stroke::solid(colour(track.look), width(track.look));
        let line = places(chart, track);
        for part in clip(&line, &chart.plane) {
            sheet.line(part, stroke);
        }
        let arrows: &[f64] = match track.look {
            // On the way out and on the way back.
            Look::Growing | Look::Decaying if chart.loci.merge => &[0.3, 0.82],
            // Not halfway, where that of the path beside it may be.
            _ => &[0.42],
        };
        for &share in arrows {
            draw_arrow(sheet, &line, share, stroke);
        }
        if matches!(track.look, Look::Growing | Look::Decaying) {
            continue;
        }
        let outer = |sample: &&Sample| {
            let rpm = chart.speed.values();
            sample.rpm <= rpm[0] || rpm[1] <= sample.rpm
        };
        for (sample, &place) in track.samples.iter().zip(&line) {
            if outer(&sample) {
                sheet.disc(place, 4.0, stroke.colour);
            }
        }
    }
    for sample in [&chart.loci.onset, &chart.loci.end] {
        sheet.disc(at(chart, sample), 5.0, INK);
    }
    let peak = at(chart, &chart.loci.peak);
    sheet.disc(peak, 4.5, FLUTTER);
    if chart.loci.merge {
        let mirrored = [2.0 * zero - peak[0], peak[1]];
        sheet.disc(mirrored, 3.5, colour(Look::Decaying));
    }
}

/// An arrowhead at a share of the length of a line.
fn draw_arrow(sheet: &mut Sheet, line: &[[f64; 2]], share: f64, stroke: Stroke) {
    let length = |pair: &[[f64; 2]]| (pair[1][0] - pair[0][0]).hypot(pair[1][1] - pair[0][1]);
    let whole: f64 = line.windows(2).map(length).sum();
    let mut left = share * whole;
    for pair in line.windows(2) {
        let step = length(pair);
        if step == 0.0 || left > step {
            left -= step;
            continue;
        }
        let [dx, dy] = [0, 1].map(|k| (pair[1][k] - pair[0][k]) / step);
        let tip = [
            pair[0][0] + (left + ARROW / 2.0) * dx,
            pair[0][1] + (left + ARROW / 2.0) * dy,
        ];
        let barb = |across: f64| {
            [
                tip[0] - ARROW * (1.3 * dx - across * dy),
                tip[1] - ARROW * (1.3 * dy + across * dx),
            ]
        };
        let head = Stroke {
            width: 1.25 * CURVE,
            ..stroke
        };
        sheet.line([barb(0.8), tip, barb(-0.8)], head);
        return;
    }
}
