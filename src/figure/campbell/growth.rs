//! The lower panel: growth rates.

use super::super::axis::{Axis, Spread};
use super::super::canvas::{Anchor, Lettering, Sheet, Stroke, text_frame};
use super::super::clip::clip;
use super::super::is_damped;
use super::super::meeting::Meeting;
use super::super::style::{CURVE, Colour, FLUTTER, HAIRLINE, INK, LABEL_SIZE, PAPER, QUIET, tint};
use super::speeds::line_colour;
use super::waves::{direction_at, direction_colour};
use super::{Chart, NEGLIGIBLE_PER_S};
use crate::report::{BranchEntry, InstabilityEntry, Report};

/// Said where nothing grows: at a critical speed the blade is not stable all the same.
fn no_growth(chart: &Chart) -> &'static str {
    let mut critical = chart.report.critical_speeds.iter();
    match critical.any(|entry| chart.speed.shows(entry.rpm)) {
        true => {
            "no motion grows by itself; at a critical speed (dashed) a constant force bends the blade ever further"
        }
        false => "no growth: stable at every speed shown",
    }
}

fn greatest_growth(report: &Report, [from, to]: [f64; 2]) -> f64 {
    let shown = |rpm: f64| from <= rpm && rpm <= to;
    let bands = report.instabilities.iter();
    let bands = bands.filter(|band| band.from_rpm <= to && from <= band.to_rpm);
    let peaks = bands.map(|band| band.peak_growth_per_s);
    let branches = report.campbell.branches.iter();
    let values = branches.flat_map(|branch| {
        let samples = branch.rpm.iter().zip(&branch.growth_per_s);
        samples
            .filter(|(rpm, _)| shown(**rpm))
            .map(|(_, growth)| *growth)
    });
    let all = peaks.chain(values).filter(|g| g.is_finite());
    all.fold(0.0, f64::max)
}

fn sweep(report: &Report) -> [f64; 2] {
    [report.campbell.from_rpm, report.campbell.to_rpm]
}

fn grows(report: &Report) -> bool {
    !report.instabilities.is_empty() || greatest_growth(report, sweep(report)) > NEGLIGIBLE_PER_S
}

/// How far down the axis goes. Without damping the decaying eigenvalues mirror
/// the growing ones, and half of the panel would say nothing. With damping the
/// least damped branches count; strongly damped ones may leave the panel.
fn greatest_decay(report: &Report) -> f64 {
    if !is_damped(report) {
        return 0.0;
    }
    let decay = |branch: &BranchEntry| {
        let values = branch.growth_per_s.iter().filter(|g| g.is_finite());
        values.fold(0.0f64, |most, g| most.max(-g))
    };
    let decays: Vec<f64> = report.campbell.branches.iter().map(decay).collect();
    let most = decays.iter().copied().fold(0.0, f64::max);
    let least = decays.iter().copied().filter(|d| *d > NEGLIGIBLE_PER_S);
    let least = least.fold(f64::INFINITY, f64::min);
    most.min(4.0 * greatest_growth(report, sweep(report)).max(least))
}

pub fn is_worth_showing(report: &Report) -> bool {
    grows(report) || greatest_decay(report) > NEGLIGIBLE_PER_S
}

/// Whether the decaying halves of unstable pairs are left out.
pub fn hides_decay(report: &Report) -> bool {
    grows(report) && !is_damped(report)
}

/// The growth axis, below the labels of the bands, if it has anything to show.
pub fn axis(chart: &Chart, labels_height: f64) -> Option<Axis> {
    let report = chart.report;
    if !is_worth_showing(report) {
        return None;
    }
    let growth = greatest_growth(report, chart.speed.values());
    let decay = greatest_decay(report);
    let least = NEGLIGIBLE_PER_S.max(0.02 * growth.max(decay));
    let growth = growth.max(least);
    let decay = match is_damped(report) {
        true => decay.max(least),
        false => 0.0,
    };
    let places = [chart.lower.bottom, chart.lower.top + labels_height];
    let spread = spread(report, growth.max(decay));
    Some(Axis::new([-decay, growth], places, spread))
}

/// Divergence often grows thirty times as fast as flutter beside it, which would
/// vanish on an even axis.
fn spread(report: &Report, greatest: f64) -> Spread {
    const SEEN: f64 = 0.12;
    let unseen = |band: &InstabilityEntry| band.peak_growth_per_s < SEEN * greatest;
    match report.instabilities.iter().any(unseen) {
        true => Spread::SignedRoot,
        false => Spread::Linear,
    }
}

pub fn axis_name(axis: &Axis) -> &'static str {
    match axis.spread() {
        Spread::Linear | Spread::Logarithmic => "Re λ\u{2003}[1/s]",
        Spread::SignedRoot => "Re λ\u{2003}[1/s], square root scale",
    }
}

pub fn draw(sheet: &mut Sheet, chart: &Chart, axis: &Axis) {
    let zero = axis.at(0.0);
    let zero_line = [[chart.lower.left, zero], [chart.lower.right, zero]];
    sheet.line(zero_line, Stroke::solid(INK, HAIRLINE));
    match is_damped(chart.report) {
        true => draw_damped(sheet, chart, axis),
        false => draw_undamped(sheet, chart, axis),
    }
    for band in &chart.report.instabilities {
        draw_peak(sheet, chart, axis, band);
    }
    if !grows(chart.report) {
        write_stable(sheet, chart, [chart.lower.left + 10.0, zero - 7.0]);
    }
}

pub fn say_stable(sheet: &mut Sheet, chart: &Chart) {
    let middle = (chart.lower.top + chart.lower.bottom) / 2.0;
    write_stable(
        sheet,
        chart,
        [chart.lower.left + 10.0, middle + 0.36 * LABEL_SIZE],
    );
}

fn write_stable(sheet: &mut Sheet, chart: &Chart, at: [f64; 2]) {
    let letters = Lettering::regular(LABEL_SIZE, QUIET, Anchor::Start);
    let text = no_growth(chart);
    // The line of the operating speed may pass behind it.
    sheet.fill(text_frame(at, &letters, text), PAPER);
    sheet.text(at, letters, text);
}

/// Draws either the growing or the decaying stretches of a branch; where it
/// neither grows nor decays it would only thicken the zero line.
fn draw_branch(sheet: &mut Sheet, chart: &Chart, axis: &Axis, branch: &BranchEntry, growing: bool) {
    let points: Vec<_> = branch.rpm.iter().zip(&branch.growth_per_s).collect();
    let mut run: Vec<[f64; 2]> = Vec::new();
    let mut run_colour = FLUTTER;
    let width = if growing { 1.25 * CURVE } else { CURVE };
    let mut finish = |run: &mut Vec<[f64; 2]>, colour: Colour| {
        for part in clip(run, &chart.lower) {
            sheet.line(part, Stroke::solid(colour, width));
        }
        run.clear();
    };
    for (i, pair) in points.windows(2).enumerate() {
        let ends = [0, 1].map(|k| [chart.speed.at(*pair[k].0), axis.at(*pair[k].1)]);
        let highest = if pair[0].1 > pair[1].1 { i } else { i + 1 };
        let grows = points[highest].1 > &NEGLIGIBLE_PER_S;
        let decays = pair[0].1.min(*pair[1].1) < -NEGLIGIBLE_PER_S;
        let colour = match growing {
            true => growth_colour(chart.report, branch, highest),
            false => tint(direction_colour(direction_at(branch, highest)), 0.55),
        };
        let wanted = if growing { grows } else { decays && !grows };
        if !wanted || colour != run_colour {
            finish(&mut run, run_colour);
        }
        if wanted {
            if run.is_empty() {
                run.push(ends[0]);
            }
            run.push(ends[1]);
            run_colour = colour;
        }
    }
    finish(&mut run, run_colour);
}

fn growth_colour(report: &Report, branch: &BranchEntry, sample: usize) -> Colour {
    let rpm = branch.rpm.get(sample).copied().unwrap_or(f64::NAN);
    let mut bands = report.instabilities.iter();
    let own = bands.find(|band| {
        let around = band.from_rpm <= rpm && rpm <= band.to_rpm;
        around && band.branches.contains(&branch.branch)
    });
    own.map_or(FLUTTER, |band| line_colour(band.kind))
}

/// Growth within the bands alone: without damping there is none outside, and the
/// decaying eigenvalues mirror the growing ones.
fn draw_undamped(sheet: &mut Sheet, chart: &Chart, axis: &Axis) {
    for band in &chart.report.instabilities {
        draw_band(sheet, chart, axis, band);
    }
}

/// All branches; bands that no sample came near get the curve that is expected.
fn draw_damped(sheet: &mut Sheet, chart: &Chart, axis: &Axis) {
    let branches = &chart.report.campbell.branches;
    for growing in [false, true] {
        for branch in branches.iter().rev() {
            draw_branch(sheet, chart, axis, branch, growing);
        }
    }
    let bands = chart.report.instabilities.iter();
    for band in bands.filter(|band| !is_sampled(chart.report, band)) {
        draw_band(sheet, chart, axis, band);
    }
}

fn draw_band(sheet: &mut Sheet, chart: &Chart, axis: &Axis, band: &InstabilityEntry) {
    let curve = curve(chart.report, band);
    let curve: Vec<_> = curve
        .iter()
        .map(|&[rpm, growth]| [chart.speed.at(rpm), axis.at(growth)])
        .collect();
    for part in clip(&curve, &chart.lower) {
        sheet.line(part, Stroke::solid(line_colour(band.kind), 1.25 * CURVE));
    }
}

/// Speeds and growth rates of a band from one end to the other, those of its own branch.
pub fn curve(report: &Report, band: &InstabilityEntry) -> Vec<[f64; 2]> {
    let [first, last] = [report.campbell.from_rpm, report.campbell.to_rpm];
    let ends = [band.from_rpm.max(first), band.to_rpm.min(last)];
    let own = band.branches.first().and_then(|number| {
        let mut branches = report.campbell.branches.iter();
        branches.find(|branch| branch.branch == *number)
    });
    let samples: Vec<[f64; 2]> = own.map_or(Vec::new(), |branch| {
        let samples = branch.rpm.iter().zip(&branch.growth_per_s);
        samples.map(|(rpm, growth)| [*rpm, *growth]).collect()
    });
    let inside = |s: &&[f64; 2]| ends[0] < s[0] && s[0] < ends[1];
    let growing = samples.iter().filter(inside).filter(|s| s[1] > 0.0);
    let peak = [band.peak_rpm, band.peak_growth_per_s];
    let squares = growing.chain([&peak]).map(|[rpm, g]| [*rpm, g * g]);
    // Growth begins at zero where two waves merge or a wave stands still; where two real λ
    // meet, it goes on beyond the band.
    let next = [
        samples.iter().rfind(|s| s[0] <= ends[0]),
        samples.iter().find(|s| s[0] >= ends[1]),
    ];
    let at_zero = |k: usize| {
        let cut_short = !band.closed && [ends[0] <= first, ends[1] >= last][k];
        !cut_short && next[k].is_none_or(|s| s[1] <= NEGLIGIBLE_PER_S)
    };
    let meeting = Meeting::new(ends, [at_zero(0), at_zero(1)], squares);
    meeting.map_or(Vec::new(), |meeting| meeting.growth())
}

fn draw_peak(sheet: &mut Sheet, chart: &Chart, axis: &Axis, band: &InstabilityEntry) {
    let peak = band.peak_growth_per_s;
    if chart.speed.shows(band.peak_rpm) && axis.shows(peak) {
        let at = [chart.speed.at(band.peak_rpm), axis.at(peak)];
        sheet.disc(at, 2.75, line_colour(band.kind));
    }
}

fn is_sampled(report: &Report, band: &InstabilityEntry) -> bool {
    report.campbell.branches.iter().any(|branch| {
        let mut samples = branch.rpm.iter().zip(&branch.growth_per_s);
        samples.any(|(&rpm, &growth)| {
            band.from_rpm < rpm && rpm < band.to_rpm && growth > 0.5 * band.peak_growth_per_s
        })
    })
}
