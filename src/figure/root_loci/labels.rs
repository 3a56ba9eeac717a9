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
/// From the ends of the band to the middle of their labels.
const BAND_LABEL_AWAY: f64 = 15.0;

/// Lines of text, and where they want to be.
struct Block {
    lines: Vec<String>,
    colour: Colour,
    x: f64,
    centre: f64,
}

impl Block {
    fn height(&self) -> f64 {
        self.lines.len() as f64 * LINE_HEIGHT
    }
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
        let on_the_left = plane::side(track.look) < 0.0 || !chart.loci.merge;
        let blocks = if on_the_left { &mut left } else { &mut right };
        if !matches!(track.look, Look::Growing | Look::Decaying) {
            blocks.extend(ends_of_track(chart, track));
        }
    }
    let [top, bottom] = rows_within_band(chart);
    keep_clear(&mut left, [top - 4.0, bottom + 4.0]);
    let with_labels = BAND_LABEL_AWAY + LINE_HEIGHT / 2.0;
    keep_clear(&mut right, [top - with_labels, bottom + with_labels]);
    right.extend(ends_of_band(chart));
    write_beside(sheet, chart, &left, Anchor::End);
    write_beside(sheet, chart, &right, Anchor::Start);
    label_peak(sheet, chart);
}

/// Which way is which.
fn draw_corners(sheet: &mut Sheet, chart: &Chart) {
    let y = chart.plane.top - 8.0;
    let corners = [
        (chart.plane.left, Anchor::Start, "← decaying"),
        (chart.plane.right, Anchor::End, "growing →"),
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
        Some(sign) => format!("({sign}) {name}"),
        None => name.clone(),
    });
    let way = match chart.loci.merge {
        true => plane::side(track.look),
        false => -1.0,
    };
    let x = chart.growth.at(outer.growth) + way * GAP;
    let edge = if way < 0.0 {
        chart.plane.left
    } else {
        chart.plane.right
    };
    let room = ((edge - x).abs() - 8.0).min(LONGEST);
    let name = name.map(|name| shorten(&name, LABEL_SIZE, Weight::Regular, room));
    let rpm = format!("{} rpm", chart.rpm(outer.rpm));
    Some(Block {
        lines: name.into_iter().chain([rpm]).collect(),
        colour: colour(track.look),
        x,
        centre: chart.frequency.at(outer.hz),
    })
}

/// First and last row of the sheet that the paths take within the band.
fn rows_within_band(chart: &Chart) -> [f64; 2] {
    let tracks = chart.loci.tracks.iter();
    let moving = tracks.filter(|t| matches!(t.look, Look::Growing | Look::Decaying));
    let rows = moving.flat_map(|track| plane::places(chart, track));
    rows.fold(
        [f64::INFINITY, f64::NEG_INFINITY],
        |[top, bottom], [_, y]| [top.min(y), bottom.max(y)],
    )
}

/// Moves blocks above or below the rows, whichever is nearer.
fn keep_clear(blocks: &mut [Block], [top, bottom]: [f64; 2]) {
    for block in blocks {
        let half = block.height() / 2.0;
        let (above, below) = (top - half, bottom + half);
        if above < block.centre && block.centre < below {
            let up = block.centre - above < below - block.centre;
            block.centre = if up { above } else { below };
        }
    }
}

/// Onset and end, one above the paths within the band, the other below them.
fn ends_of_band(chart: &Chart) -> [Block; 2] {
    let (onset, end) = (&chart.loci.onset, &chart.loci.end);
    let up = if onset.hz >= end.hz {
        -BAND_LABEL_AWAY
    } else {
        BAND_LABEL_AWAY
    };
    let block = |what: &str, sample: &Sample, away: f64| Block {
        lines: vec![format!("{what} {} rpm", chart.rpm(sample.rpm))],
        colour: INK,
        x: chart.growth.at(0.0) + GAP,
        centre: chart.frequency.at(sample.hz) + away,
    };
    [block("onset", onset, up), block("end", end, -up)]
}

fn write_beside(sheet: &mut Sheet, chart: &Chart, blocks: &[Block], anchor: Anchor) {
    let wish = |block: &Block| Wish {
        centre: block.centre,
        length: block.height(),
    };
    let wishes: Vec<_> = blocks.iter().map(wish).collect();
    let room = [chart.plane.top + 2.0, chart.plane.bottom - 2.0];
    let centres = push_apart(&wishes, room[0], room[1]);
    for (block, centre) in blocks.iter().zip(centres) {
        let Some(centre) = centre else {
            continue;
        };
        write_block(sheet, block, [block.x, centre], anchor);
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

/// The outermost points of the coalesced modes.
fn label_peak(sheet: &mut Sheet, chart: &Chart) {
    let peak = chart.loci.peak;
    let [x, y] = plane::at(chart, &peak);
    let growth = format!("{} 1/s", two_digits(peak.growth));
    let block = Block {
        lines: vec![
            "growing".to_owned(),
            format!("peak {} rpm", chart.rpm(peak.rpm)),
            growth,
        ],
        colour: FLUTTER,
        x: x + 12.0,
        centre: y,
    };
    write_block(sheet, &block, [block.x, y], Anchor::Start);
    if chart.loci.merge {
        let block = Block {
            lines: vec!["decaying".to_owned(), "(mirror image)".to_owned()],
            colour: tint(FLUTTER, 0.75),
            x: 2.0 * chart.growth.at(0.0) - x - 12.0,
            centre: y,
        };
        write_block(sheet, &block, [block.x, y], Anchor::End);
    }
}
