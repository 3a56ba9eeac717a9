//! Labels of the paths and of the speeds on them.

use super::super::axis::two_digits;
use super::super::canvas::{Anchor, Lettering, Sheet};
use super::super::declutter::{Wish, push_apart};
use super::super::style::{Colour, FLUTTER, INK, LABEL_SIZE, QUIET, Weight, shorten, tint};
use super::tracks::{Look, Sample, Track};
use super::{Chart, colour, plane};

const LINE_HEIGHT: f64 = 15.0;
/// From the imaginary axis to the labels beside it.
const GAP: f64 = 16.0;
const LONGEST: f64 = 210.0;

/// Lines of text on one side of the imaginary axis, and where they want to be.
struct Block {
    lines: Vec<String>,
    colour: Colour,
    centre: f64,
}

/// The Krein sign as it is written.
pub fn sign(look: Look) -> Option<&'static str> {
    match look {
        Look::Plus => Some("+"),
        Look::Minus => Some("\u{2212}"),
        _ => None,
    }
}

pub fn draw(sheet: &mut Sheet, chart: &Chart) {
    draw_corners(sheet, chart);
    let [mut left, mut right] = [Vec::new(), Vec::new()];
    for track in &chart.loci.tracks {
        let blocks = if plane::side(track.look) < 0.0 {
            &mut left
        } else {
            &mut right
        };
        if !matches!(track.look, Look::Growing | Look::Decaying) {
            blocks.extend(ends_of_track(chart, track));
        }
    }
    right.extend(ends_of_band(chart));
    let zero = chart.growth.at(0.0);
    write_beside(sheet, chart, &left, zero - GAP, Anchor::End);
    write_beside(sheet, chart, &right, zero + GAP, Anchor::Start);
    label_peak(sheet, chart);
}

/// Which way is which.
fn draw_corners(sheet: &mut Sheet, chart: &Chart) {
    let y = chart.plane.top + 14.0;
    let corners = [
        (chart.plane.left + 12.0, Anchor::Start, "← decaying"),
        (chart.plane.right - 4.0, Anchor::End, "growing →"),
    ];
    for (x, anchor, text) in corners {
        sheet.text([x, y], Lettering::regular(LABEL_SIZE, QUIET, anchor), text);
    }
}

/// The speed at the outer end of a track, with the name of the mode at its start.
fn ends_of_track(chart: &Chart, track: &Track) -> Option<Block> {
    let [first, last] = chart.speed.values();
    let mut samples = track.samples.iter();
    let outer = samples.find(|s| s.rpm <= first || last <= s.rpm)?;
    let name = track.name.as_ref().filter(|_| outer.rpm <= first);
    let name = name.map(|name| match sign(track.look) {
        Some(sign) => format!("{sign} : {name}"),
        None => name.clone(),
    });
    let name = name.map(|name| shorten(&name, LABEL_SIZE, Weight::Regular, LONGEST));
    let rpm = format!("{} rpm", chart.rpm(outer.rpm));
    Some(Block {
        lines: name.into_iter().chain([rpm]).collect(),
        colour: colour(track.look),
        centre: chart.frequency.at(outer.hz),
    })
}

/// Onset and end, one above the paths within the band, the other below them.
fn ends_of_band(chart: &Chart) -> [Block; 2] {
    const AWAY: f64 = 15.0;
    let (onset, end) = (&chart.loci.onset, &chart.loci.end);
    let up = if onset.hz >= end.hz { -AWAY } else { AWAY };
    let block = |what: &str, sample: &Sample, away: f64| Block {
        lines: vec![format!("{what} {} rpm", chart.rpm(sample.rpm))],
        colour: INK,
        centre: chart.frequency.at(sample.hz) + away,
    };
    [block("onset", onset, up), block("end", end, -up)]
}

fn write_beside(sheet: &mut Sheet, chart: &Chart, blocks: &[Block], x: f64, anchor: Anchor) {
    let wish = |block: &Block| Wish {
        centre: block.centre,
        length: block.lines.len() as f64 * LINE_HEIGHT,
    };
    let wishes: Vec<_> = blocks.iter().map(wish).collect();
    // Below the words in the corners.
    let room = [chart.plane.top + 2.0, chart.plane.bottom - 2.0];
    let centres = push_apart(&wishes, room[0], room[1]);
    for (block, centre) in blocks.iter().zip(centres) {
        let Some(centre) = centre else {
            continue;
        };
        write_block(sheet, block, [x, centre], anchor);
    }
}

fn write_block(sheet: &mut Sheet, block: &Block, [x, centre]: [f64; 2], anchor: Anchor) {
    let letters = Lettering::regular(LABEL_SIZE, block.colour, anchor);
    let half = (block.lines.len() as f64 - 1.0) / 2.0;
    for (i, line) in block.lines.iter().enumerate() {
        let y = centre + (i as f64 - half) * LINE_HEIGHT + 0.36 * LABEL_SIZE;
        sheet.text([x, y], letters, line);
    }
}

/// The outermost points of the merged modes.
fn label_peak(sheet: &mut Sheet, chart: &Chart) {
    let peak = chart.loci.peak;
    let [x, y] = plane::at(chart, &peak);
    let growth = format!("{} 1/s", two_digits(peak.growth));
    let merged = if chart.loci.merge {
        "merged, growing"
    } else {
        "growing"
    };
    let block = Block {
        lines: vec![
            merged.to_owned(),
            format!("peak {} rpm", chart.rpm(peak.rpm)),
            growth,
        ],
        colour: FLUTTER,
        centre: y,
    };
    write_block(sheet, &block, [x + 12.0, y], Anchor::Start);
    if chart.loci.merge {
        let block = Block {
            lines: vec!["merged, decaying".to_owned(), "(mirror image)".to_owned()],
            colour: tint(FLUTTER, 0.75),
            centre: y,
        };
        let mirrored = 2.0 * chart.growth.at(0.0) - x;
        write_block(sheet, &block, [mirrored - 10.0, y], Anchor::End);
    }
}
