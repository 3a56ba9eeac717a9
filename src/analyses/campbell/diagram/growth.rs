//! The lower panel: growth rates.

use super::branch_line::line_through;
use super::meeting::Coalescence;
use super::plan::{Chart, NEGLIGIBLE_PER_S};
use super::waves::direction_at;
use crate::analyses::campbell::{BranchCurve, InstabilityBand, Report};
use crate::page::figure::axis::{Axis, Spread};
use crate::page::figure::canvas::{Anchor, Lettering, Sheet, Stroke};
use crate::page::figure::chart_data::{AxisData, PanelData};
use crate::page::figure::items::{Item, Line, Points, lines_by_look};
use crate::page::figure::painting::Ground;
use crate::page::figure::palette::Hue;
use crate::page::figure::style::{CURVE, HAIRLINE, INK, LABEL_SIZE, QUIET};
use crate::page::text::shown_to;

/// Width of curves of growing motions.
const WIDE: f64 = 1.25 * CURVE;
const PEAK_SIZE: f64 = 5.5;
/// Factor by which the axis exceeds the largest growth rate, so that its dot is complete.
const HEADROOM: f64 = 1.15;

/// Whether any term of the equation of motion dissipates energy.
fn is_damped(report: &Report) -> bool {
    report.terms.iter().any(|term| term.contains("damping"))
}

/// Note for a saw without growth. It mentions critical speeds among the speeds shown, because a constant force
/// deflects the blade without bound there.
fn no_growth(report: &Report, [from, to]: [f64; 2]) -> &'static str {
    let mut critical = report.critical_speeds.iter();
    if critical.any(|entry| from <= entry.rpm && entry.rpm <= to) {
        "no vibration grows; at a critical speed (dashed) a constant force deflects the blade without bound"
    } else {
        "no growth: stable at every speed shown"
    }
}

/// Largest growth rate at the speeds shown, in 1/s, at least zero.
fn greatest_growth(report: &Report, [from, to]: [f64; 2]) -> f64 {
    let bands = report
        .instabilities
        .iter()
        .filter(|band| band.from_rpm <= to && from <= band.to_rpm);
    let peaks = bands.map(|band| band.peak_growth_per_s);
    let branches = report.campbell.branches.iter();
    let values = branches.flat_map(|branch| {
        let samples = branch.rpm.iter().zip(&branch.growth_per_s);
        samples
            .filter(|(rpm, _)| from <= **rpm && **rpm <= to)
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

/// Largest decay rate on the axis, in 1/s. It is zero without damping, because the decaying eigenvalues are then
/// mirror images of the growing ones and give no information. With damping the weakly damped branches determine
/// it; strongly damped ones may leave the panel.
fn greatest_decay(report: &Report) -> f64 {
    if !is_damped(report) {
        return 0.0;
    }
    let decay = |branch: &BranchCurve| {
        let values = branch.growth_per_s.iter().filter(|g| g.is_finite());
        values.fold(0.0f64, |most, g| most.max(-g))
    };
    let decays: Vec<f64> = report.campbell.branches.iter().map(decay).collect();
    let most = decays.iter().copied().fold(0.0, f64::max);
    let least = decays
        .iter()
        .copied()
        .filter(|d| *d > NEGLIGIBLE_PER_S)
        .fold(f64::INFINITY, f64::min);
    most.min(4.0 * greatest_growth(report, sweep(report)).max(least))
}

/// Whether the panel shows a curve: a vibration grows, or damping makes one decay.
pub fn is_worth_showing(report: &Report) -> bool {
    grows(report) || greatest_decay(report) > NEGLIGIBLE_PER_S
}

/// Whether the decaying halves of unstable pairs are omitted.
pub fn hides_decay(report: &Report) -> bool {
    grows(report) && !is_damped(report)
}

/// Range of the axis, in 1/s; `None` if the panel shows no curve.
fn range(report: &Report, shown: [f64; 2]) -> Option<[f64; 2]> {
    if !is_worth_showing(report) {
        return None;
    }
    let fastest_growth = greatest_growth(report, shown);
    let fastest_decay = greatest_decay(report);
    let least = NEGLIGIBLE_PER_S.max(0.02 * fastest_growth.max(fastest_decay));
    let growth = fastest_growth.max(least);
    let decay = if is_damped(report) {
        fastest_decay.max(least)
    } else {
        0.0
    };
    Some([-decay, growth])
}

/// The axis of growth rates below the labels of the bands; `None` if the panel shows no curve.
pub fn axis(chart: &Chart, labels_height: f64) -> Option<Axis> {
    let range = range(chart.report, chart.speed.values())?;
    let places = [chart.lower.bottom, chart.lower.top + labels_height];
    Some(Axis::new(range, places, spread(chart.report, range)))
}

/// Scale of the axis: by square roots if the largest growth of a band would be invisible on a linear axis.
/// Divergence often grows thirty times as fast as flutter.
fn spread(report: &Report, [low, high]: [f64; 2]) -> Spread {
    const VISIBLE: f64 = 0.12;
    let greatest = high.max(-low);
    let invisible = |band: &InstabilityBand| band.peak_growth_per_s < VISIBLE * greatest;
    if report.instabilities.iter().any(invisible) {
        Spread::SignedRoot
    } else {
        Spread::Linear
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
    sheet.horizontal(zero, &chart.lower, Stroke::solid(INK, HAIRLINE));
    let ground = Ground {
        x: &chart.speed,
        y: axis,
        frame: &chart.lower,
    };
    ground.draw(sheet, &chart.panels()[1].items);
    write_note(sheet, chart, zero - 7.0);
}

/// Writes the note of a panel without curves.
pub fn say_stable(sheet: &mut Sheet, chart: &Chart) {
    write_note(sheet, chart, chart.lower.centre()[1] + 0.36 * LABEL_SIZE);
}

fn write_note(sheet: &mut Sheet, chart: &Chart, baseline: f64) {
    let note = &chart.panels()[1].note;
    if !note.is_empty() {
        let letters = Lettering::regular(LABEL_SIZE, QUIET, Anchor::Start);
        sheet.text_on_paper([chart.lower.left + 10.0, baseline], letters, note);
    }
}

/// The panel with its curves; the caller adds the bands and the lines at critical speeds. The curves of an undamped
/// saw are the growth rates within the bands, because no vibration grows outside of them and decaying eigenvalues are
/// mirror images of growing ones. A damped saw has curves for all branches, and an estimated curve for each band
/// without a sample near its largest growth.
pub fn describe(report: &Report, shown: [f64; 2], speed: AxisData, said: bool) -> PanelData {
    let mut items = Vec::new();
    let mut bands: Vec<&InstabilityBand> = report.instabilities.iter().collect();
    if is_damped(report) {
        for growing in [false, true] {
            let branches = report.campbell.branches.iter().rev();
            items.extend(branches.flat_map(|branch| lines(report, branch, growing, said)));
        }
        bands.retain(|band| !is_sampled(report, band));
    }
    items.extend(bands.into_iter().map(|band| band_line(report, band, said)));
    let peaks = report.instabilities.iter();
    items.extend(peaks.map(|band| Item::Points(peak(band, said))));
    let range = range(report, shown);
    let spread = range.map_or(Spread::Linear, |range| spread(report, range));
    let [low, high] = range.unwrap_or([0.0, 1.0]);
    let y = AxisData::new("Re λ", "1/s").within([HEADROOM * low, HEADROOM * high]);
    PanelData {
        note: if grows(report) {
            String::new()
        } else {
            no_growth(report, shown).to_owned()
        },
        ..PanelData::new(speed, y.spread(spread), items)
    }
}

/// Curves of the growing or of the decaying parts of a branch. Parts that neither grow nor decay lie on the zero
/// line and are omitted.
fn lines(report: &Report, branch: &BranchCurve, growing: bool, said: bool) -> Vec<Item> {
    let growth = &branch.growth_per_s;
    let look = |i: usize| {
        let highest = if growth[i] > growth[i + 1] { i } else { i + 1 };
        let grows = growth[highest] > NEGLIGIBLE_PER_S;
        let decays = growth[i].min(growth[i + 1]) < -NEGLIGIBLE_PER_S;
        if growing {
            grows.then(|| growth_hue(report, branch, highest))
        } else {
            (decays && !grows).then(|| Hue::of_direction(direction_at(branch, highest)))
        }
    };
    let (width, tint) = if growing { (WIDE, 1.0) } else { (CURVE, 0.55) };
    let found = lines_by_look(branch.rpm.len().min(growth.len()), look);
    let lines = found.into_iter().map(|(hue, samples)| {
        Item::Line(Line {
            width,
            tint,
            ..line_through(branch, growth, &samples, hue, said)
        })
    });
    lines.collect()
}

/// Colour of the band that contains a sample of its branch; that of flutter if there is none.
fn growth_hue(report: &Report, branch: &BranchCurve, sample: usize) -> Hue {
    let rpm = branch.rpm.get(sample).copied().unwrap_or(f64::NAN);
    let mut bands = report.instabilities.iter();
    let own = bands.find(|band| {
        let around = band.from_rpm <= rpm && rpm <= band.to_rpm;
        around && band.branches.contains(&branch.branch)
    });
    own.map_or(Hue::Flutter, |band| Hue::of_kind(band.kind)[0])
}

fn band_line(report: &Report, band: &InstabilityBand, said: bool) -> Item {
    let curve = curve(report, band);
    let name = band.kind.to_string();
    let words =
        |[rpm, growth]: &[f64; 2]| format!("{name}\n{rpm:.1} rpm\n{} 1/s", shown_to(3, *growth));
    Item::Line(Line {
        width: WIDE,
        said: curve.iter().filter(|_| said).map(words).collect(),
        ..Line::new(curve, Hue::of_kind(band.kind)[0], &name)
    })
}

/// A dot at the largest growth of a band.
fn peak(band: &InstabilityBand, said: bool) -> Points {
    let name = band.kind.to_string();
    let waves = band
        .name
        .as_ref()
        .map_or(String::new(), |waves| format!(" of {waves}"));
    let growth = shown_to(3, band.peak_growth_per_s);
    let words = format!(
        "{name}{waves}\nlargest growth {growth} 1/s\n{:.1} rpm\n{:.2} Hz",
        band.peak_rpm, band.frequency_hz
    );
    Points {
        said: if said { vec![words] } else { Vec::new() },
        ..Points::new(
            [[band.peak_rpm, band.peak_growth_per_s]],
            Hue::of_kind(band.kind)[0],
            PEAK_SIZE,
            &name,
        )
    }
}

/// Speeds in rpm and growth rates in 1/s of a band from its onset to its end, along its first branch.
pub fn curve(report: &Report, band: &InstabilityBand) -> Vec<[f64; 2]> {
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
    // The growth rate is zero at an edge where two waves coalesce or a wave stands still. At an edge where
    // two real eigenvalues coalesce it is positive, also in the next sample outside the band.
    let next = [
        samples.iter().rfind(|s| s[0] <= ends[0]),
        samples.iter().find(|s| s[0] >= ends[1]),
    ];
    let at_zero = |k: usize| {
        let cut_short = !band.closed && [ends[0] <= first, ends[1] >= last][k];
        !cut_short && next[k].is_none_or(|s| s[1] <= NEGLIGIBLE_PER_S)
    };
    let found = Coalescence::new(ends, [at_zero(0), at_zero(1)], squares);
    let mut curve = found.map_or(Vec::new(), |found| found.growth());
    // Beside the peak the interpolation may exceed it by 1e-5.
    curve
        .iter_mut()
        .for_each(|[_, growth]| *growth = growth.min(band.peak_growth_per_s));
    curve
}

/// Whether a branch has a sample within a band with more than half of its largest growth.
fn is_sampled(report: &Report, band: &InstabilityBand) -> bool {
    report.campbell.branches.iter().any(|branch| {
        let mut samples = branch.rpm.iter().zip(&branch.growth_per_s);
        samples.any(|(&rpm, &growth)| {
            band.from_rpm < rpm && rpm < band.to_rpm && growth > 0.5 * band.peak_growth_per_s
        })
    })
}
