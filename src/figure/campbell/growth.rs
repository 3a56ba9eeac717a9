//! The lower panel: growth rates.

use super::super::axis::{Axis, Spread};
use super::super::canvas::{Anchor, Lettering, Sheet, Stroke};
use super::super::clip::clip;
use super::super::style::{CURVE, Colour, FLUTTER, HAIRLINE, INK, LABEL_SIZE, QUIET, tint};
use super::speeds::line_colour;
use super::waves::direction_colour;
use super::{Chart, NEGLIGIBLE_PER_S};
use crate::report::{BranchEntry, InstabilityEntry, Report};

const STABLE: &str = "no growth: stable at every speed shown";

fn is_damped(report: &Report) -> bool {
    let blade = report.scene.damping.unwrap_or_default();
    let guides = &report.scene.guides;
    blade.material_retardation_time_s != 0.0
        || blade.air_n_s_per_m3 != 0.0
        || guides.iter().any(|guide| guide.damping_n_s_per_m != 0.0)
}

fn greatest_growth(report: &Report) -> f64 {
    let peaks = report
        .instabilities
        .iter()
        .map(|band| band.peak_growth_per_s);
    let branches = &report.campbell.branches;
    let values = branches
        .iter()
        .flat_map(|branch| branch.growth_per_s.iter().copied());
    let all = peaks.chain(values).filter(|g| g.is_finite());
    all.fold(0.0, f64::max)
}

fn grows(report: &Report) -> bool {
    !report.instabilities.is_empty() || greatest_growth(report) > NEGLIGIBLE_PER_S
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
    most.min(4.0 * greatest_growth(report).max(least))
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
    let (growth, decay) = (greatest_growth(report), greatest_decay(report));
    let least = NEGLIGIBLE_PER_S.max(0.02 * growth.max(decay));
    let (growth, decay) = (growth.max(least), decay.max(least));
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
        Spread::Linear => "Re λ\u{2003}[1/s]",
        Spread::SignedRoot => "Re λ\u{2003}[1/s], square root scale",
    }
}

pub fn draw(sheet: &mut Sheet, chart: &Chart, axis: &Axis) {
    let zero = axis.at(0.0);
    let zero_line = [[chart.lower.left, zero], [chart.lower.right, zero]];
    sheet.line(zero_line, Stroke::solid(INK, HAIRLINE));
    let branches = &chart.report.campbell.branches;
    for growing in [false, true] {
        for branch in branches.iter().rev() {
            draw_branch(sheet, chart, axis, branch, growing);
        }
    }
    for band in &chart.report.instabilities {
        draw_peak(sheet, chart, axis, band);
    }
    if !grows(chart.report) {
        write_stable(sheet, [chart.lower.left + 10.0, zero - 7.0]);
    }
}

pub fn say_stable(sheet: &mut Sheet, chart: &Chart) {
    let middle = (chart.lower.top + chart.lower.bottom) / 2.0;
    write_stable(sheet, [chart.lower.left + 10.0, middle + 0.36 * LABEL_SIZE]);
}

fn write_stable(sheet: &mut Sheet, at: [f64; 2]) {
    sheet.text(
        at,
        Lettering::regular(LABEL_SIZE, QUIET, Anchor::Start),
        STABLE,
    );
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
            false => tint(direction_colour(branch.direction), 0.55),
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

/// Colour of the band that a sample of a branch belongs to.
fn growth_colour(report: &Report, branch: &BranchEntry, sample: usize) -> Colour {
    let rpm = branch.rpm.get(sample).copied().unwrap_or(f64::NAN);
    let hz = branch.frequency_hz.get(sample).copied().unwrap_or(0.0);
    let around = report.instabilities.iter();
    let around = around.filter(|band| band.from_rpm <= rpm && rpm <= band.to_rpm);
    let off = |band: &InstabilityEntry| (band.frequency_hz - hz).abs();
    let nearest = around.min_by(|a, b| off(a).total_cmp(&off(b)));
    nearest.map_or(FLUTTER, |band| line_colour(band.kind))
}

/// Marks the peak of a band. Where no sample of a branch came near it, an arch
/// stands for the branch: close to the speeds where two modes meet, growth goes
/// with the root of the distance, hence half an ellipse.
fn draw_peak(sheet: &mut Sheet, chart: &Chart, axis: &Axis, band: &InstabilityEntry) {
    let (peak, colour) = (band.peak_growth_per_s, line_colour(band.kind));
    if !chart.speed.shows(band.peak_rpm) || !axis.shows(peak) {
        return;
    }
    if !is_sampled(chart.report, band) {
        let (middle, half) = (
            (band.from_rpm + band.to_rpm) / 2.0,
            (band.to_rpm - band.from_rpm) / 2.0,
        );
        let arch = (0..=32).map(|i| {
            let angle = std::f64::consts::PI * f64::from(i) / 32.0;
            let rpm = middle - half * angle.cos();
            [chart.speed.at(rpm), axis.at(peak * angle.sin())]
        });
        let arch: Vec<_> = arch.collect();
        for part in clip(&arch, &chart.lower) {
            sheet.line(part, Stroke::solid(colour, 1.25 * CURVE));
        }
    }
    sheet.disc([chart.speed.at(band.peak_rpm), axis.at(peak)], 2.75, colour);
}

fn is_sampled(report: &Report, band: &InstabilityEntry) -> bool {
    report.campbell.branches.iter().any(|branch| {
        let mut samples = branch.rpm.iter().zip(&branch.growth_per_s);
        samples.any(|(&rpm, &growth)| {
            band.from_rpm < rpm && rpm < band.to_rpm && growth > 0.5 * band.peak_growth_per_s
        })
    })
}
