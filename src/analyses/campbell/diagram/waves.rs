//! The branches of the upper panel with their labels, and measured points.

use super::plan::{Chart, NEGLIGIBLE_PER_S};
use crate::analyses::campbell::{BranchCurve, Direction, Report};
use crate::model::scene::MeasuredRow;
use crate::page::figure::canvas::{Anchor, Frame, Lettering, Sheet, Stroke};
use crate::page::figure::clipping::clip;
use crate::page::figure::label_placement::{Extent, push_apart};
use crate::page::figure::palette::Hue;
use crate::page::figure::style::{Colour, HAIRLINE, LABEL_SIZE, label_width, shorten_label, tint};

/// Distance of a label from the end of its branch.
const LABEL_GAP: f64 = 16.0;
const LONGEST_LABEL: f64 = 150.0;
const LINE_HEIGHT: f64 = 15.0;
/// Largest distance of a label from the end of its branch: further away it would seem to belong to another branch,
/// even with a leader.
const FARTHEST_LABEL: f64 = 72.0;
/// Largest distance of a label above the panel, which has no leader, from the end of its branch.
const FARTHEST_EXIT_LABEL: f64 = 36.0;

/// Direction of a branch at one of its samples; standing if the report does not contain it.
pub fn direction_at(branch: &BranchCurve, sample: usize) -> Direction {
    let direction = branch.direction.get(sample);
    direction.copied().unwrap_or(Direction::Standing)
}

/// Colour of a branch at the last of its speeds shown.
fn last_colour(branch: &BranchCurve, chart: &Chart) -> Colour {
    let shown = branch.rpm.iter().rposition(|rpm| chart.speed.shows(*rpm));
    Hue::of_direction(direction_at(branch, shown.unwrap_or(0))).colour()
}

fn short_label(branch: &BranchCurve) -> String {
    shorten_label(&branch.label, LONGEST_LABEL)
}

/// Width of the labels to the right of the panel, with the gap before them.
pub fn end_label_room(report: &Report) -> f64 {
    let branches = report.campbell.branches.iter();
    let widths = branches.map(|branch| label_width(&short_label(branch)));
    LABEL_GAP + widths.fold(40.0, f64::max)
}

/// Upper end of the frequency axis, in Hz, over a range of speeds in rpm. The axis includes the six lowest branches at
/// the first speed, reflected waves, bands and measured points, and no more, because the important events have low
/// frequencies.
pub fn highest_shown_hz(report: &Report, [from, to]: [f64; 2]) -> f64 {
    const HEADROOM: f64 = 1.1;
    const LOWEST_BRANCHES: usize = 6;
    let shown = |rpm: f64| from <= rpm && rpm <= to;
    let branches = &report.campbell.branches;
    let mut first: Vec<f64> = branches
        .iter()
        .filter_map(|branch| {
            let at = branch.rpm.iter().rposition(|rpm| *rpm <= from)?;
            // A branch that ends below the speed `from` is not counted.
            let goes_on = branch.rpm[at] == from || at + 1 < branch.rpm.len();
            branch.frequency_hz.get(at).copied().filter(|_| goes_on)
        })
        .collect();
    first.sort_by(f64::total_cmp);
    let lowest = first.into_iter().take(LOWEST_BRANCHES);
    let reflected = branches.iter().flat_map(|branch| {
        let samples = branch
            .rpm
            .iter()
            .zip(&branch.frequency_hz)
            .zip(&branch.krein_sign);
        samples
            .filter(|((rpm, _), sign)| **sign < 0 && shown(**rpm))
            .map(|((_, hz), _)| *hz)
    });
    let bands = report
        .instabilities
        .iter()
        .filter(|band| shown(band.peak_rpm))
        .map(|band| band.frequency_hz);
    let measured = report
        .scene
        .measured
        .iter()
        .flat_map(|m| &m.rows)
        .filter(|row| shown(row.rpm))
        .flat_map(MeasuredRow::seen_hz);
    let wanted = HEADROOM * greatest(lowest.chain(reflected).chain(bands).chain(measured));

    let complete = report.campbell.complete_to_hz;
    // Branches may end slightly below the frequency up to which the diagram is complete.
    let bound = if complete > 0.0 {
        0.985 * complete
    } else {
        f64::INFINITY
    };
    let top = wanted.min(bound);
    if top > 0.0 { top } else { 1.0 }
}

fn greatest(values: impl Iterator<Item = f64>) -> f64 {
    values.filter(|v| v.is_finite()).fold(0.0, f64::max)
}

/// Kind of a segment of a branch, which determines its style.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stretch {
    /// The wave neither grows nor is reflected.
    Plain,
    /// The wave is reflected and does not grow.
    Reflected,
    /// The motion grows.
    Unstable,
}

/// Kind of the segment between the sample `i` of a branch and the next.
pub fn look_of_segment(report: &Report, branch: &BranchCurve, i: usize) -> Stretch {
    let at_an_end = |holds: &dyn Fn(usize) -> bool| holds(i) || holds(i + 1);
    let grows = |i: usize| {
        branch
            .growth_per_s
            .get(i)
            .is_some_and(|&g| g > NEGLIGIBLE_PER_S)
    };
    let reflected = |i: usize| branch.krein_sign.get(i) == Some(&-1);
    // The branch may grow at an end of a segment that is at the edge of a band, although the middle of the
    // segment is outside the band.
    let middle = (branch.rpm[i] + branch.rpm[i + 1]) / 2.0;
    let mut bands = report.instabilities.iter();
    let in_band = bands.any(|band| band.from_rpm <= middle && middle <= band.to_rpm);
    if in_band && at_an_end(&grows) {
        Stretch::Unstable
    } else if at_an_end(&reflected) {
        Stretch::Reflected
    } else {
        Stretch::Plain
    }
}

/// Whether a branch or a measured point crosses the frame.
pub fn is_crossed(chart: &Chart, frame: &Frame) -> bool {
    let around = Frame {
        top: frame.top - 2.0,
        bottom: frame.bottom + 2.0,
        ..frame.widened(2.0)
    };
    let mut branches = chart.report.campbell.branches.iter();
    let mut measured = measured_places(chart).into_iter();
    branches.any(|branch| !clip(&places(branch, chart), &around).is_empty())
        || measured.any(|at| Frame::around(at, 4.0).overlaps(&around))
}

fn places(branch: &BranchCurve, chart: &Chart) -> Vec<[f64; 2]> {
    let points = branch.rpm.iter().zip(&branch.frequency_hz);
    points
        .map(|(&rpm, &hz)| [chart.speed.at(rpm), chart.frequency.at(hz)])
        .collect()
}

/// A branch that leaves the panel, and where on its edge.
struct Exit<'a> {
    branch: &'a BranchCurve,
    at: f64,
}

pub fn label_branches(sheet: &mut Sheet, chart: &Chart) {
    let branches = &chart.report.campbell.branches;
    let mut on_the_right = Vec::new();
    let mut above = Vec::new();
    for branch in branches.iter().filter(|branch| branch.oscillates()) {
        let parts = clip(&places(branch, chart), &chart.upper);
        let Some(&[x, y]) = parts.last().and_then(|part| part.last()) else {
            continue;
        };
        if x > chart.upper.right - 2.0 {
            on_the_right.push(Exit { branch, at: y });
        } else if y < chart.upper.top + 0.5 {
            above.push(Exit { branch, at: x });
        }
    }
    label_ends(sheet, chart, &on_the_right);
    label_exits(sheet, chart, &above);
}

/// Labels, to the right of the panel, of branches that end there.
fn label_ends(sheet: &mut Sheet, chart: &Chart, ends: &[Exit]) {
    let labels = ends.iter().map(|end| Extent {
        centre: end.at,
        length: LINE_HEIGHT,
    });
    let room = [chart.upper.top, chart.upper.bottom + LINE_HEIGHT];
    let centres = push_apart(labels, room);
    for (Exit { branch, at: end }, centre) in ends.iter().zip(centres) {
        let Some(centre) = centre.filter(|c| (c - end).abs() < FARTHEST_LABEL) else {
            continue;
        };
        let colour = last_colour(branch, chart);
        let (right, label_left) = (chart.upper.right, chart.upper.right + LABEL_GAP);
        if (centre - end).abs() > 3.0 {
            let leader = [[right + 1.0, *end], [label_left - 2.0, centre]];
            sheet.line(leader, Stroke::solid(tint(colour, 0.5), HAIRLINE));
        }
        let letters = Lettering::regular(LABEL_SIZE, colour, Anchor::Start);
        let at = [label_left, centre + 0.36 * LABEL_SIZE];
        sheet.text(at, letters, &short_label(branch));
    }
}

/// Labels, above the panel, of branches that leave it through its upper edge.
fn label_exits(sheet: &mut Sheet, chart: &Chart, exits: &[Exit]) {
    let extent = |exit: &Exit| Extent::of_label(exit.at, &short_label(exit.branch), 8.0);
    let centres = push_apart(exits.iter().map(extent), chart.upper.across());
    for (Exit { branch, at: exit }, centre) in exits.iter().zip(centres) {
        let Some(centre) = centre.filter(|c| (c - exit).abs() < FARTHEST_EXIT_LABEL) else {
            continue;
        };
        let colour = last_colour(branch, chart);
        let letters = Lettering::regular(LABEL_SIZE, colour, Anchor::Middle);
        let at = [centre, chart.upper.top - 6.0];
        // The label has a background, which covers dashed lines of critical speeds.
        sheet.text_on_paper(at, letters, &short_label(branch));
    }
}

/// Positions on the sheet of the measured frequencies on both axes.
fn measured_places(chart: &Chart) -> Vec<[f64; 2]> {
    let rows = chart.report.scene.measured.iter().flat_map(|m| &m.rows);
    let points = rows.flat_map(|row| row.seen_hz().map(|hz| (row.rpm, hz)));
    points
        .filter(|&(rpm, hz)| chart.speed.shows(rpm) && chart.frequency.shows(hz))
        .map(|(rpm, hz)| [chart.speed.at(rpm), chart.frequency.at(hz)])
        .collect()
}

/// Source of the measured points, if the figure shows any.
pub fn measured_source<'a>(chart: &Chart<'a>) -> Option<&'a str> {
    let measured = chart.report.scene.measured.as_ref();
    let source = measured.map(|m| m.source.as_str());
    source.filter(|_| !measured_places(chart).is_empty())
}
