//! Root loci: the two eigenvalues that coalesce at the flutter onset, in the complex plane, and their
//! frequencies over the rotation speed. Dots are computed eigenvalues; straight lines connect them in the order of
//! the speeds.

use super::axis::{Axis, SPEED as SPEED_NAME, draw_named, draw_vertical, extremes, two_digits};
use super::canvas::{Anchor, Frame, Lettering, Sheet, Stroke};
use super::chart_data::{AxisData, ChartData, PanelData};
use super::declutter::{Extent, push_apart};
use super::heading;
use super::items::{Item, Line, Points, Role, Upright, lines_by_look};
use super::palette::Hue;
use super::style::{
    BETWEEN_FACTS, CURVE, Colour, FLUTTER, FLUTTER_SHADE, GRID, HAIRLINE, LABEL_SIZE, MARGIN,
    QUIET, label_width, shorten_label, tint,
};
use crate::report::{Report, RootLoci, RootPath};
use crate::text::shown_to;

const WIDTH: u32 = 1200;
const HEIGHT: u32 = 800;
const PLANE: Frame = Frame {
    left: 92.0,
    top: 110.0,
    right: 772.0,
    bottom: 706.0,
};
const SPEED: Frame = Frame {
    left: 812.0,
    right: 1152.0,
    ..PLANE
};
/// Distance from the imaginary axis at which purely imaginary eigenvalues are drawn: to the left those of Krein sign
/// +1, to the right those of Krein sign −1.
const ASIDE: f64 = 3.5;
/// Radius of the dot of a computed eigenvalue.
const DOT: f64 = 2.2;
/// Line height of a label.
const LINE: f64 = 15.0;
/// Distance of a label from the imaginary axis, and from a growing eigenvalue.
const GAP: f64 = 14.0;
/// Largest width of the name of an eigenvalue.
const LONGEST: f64 = 210.0;
/// Larger speeds, growth rates and frequencies are not drawn: no saw has them, and labels would have no room.
const LARGEST: f64 = 1e9;

/// A computed eigenvalue.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Sample {
    rpm: f64,
    /// Growth rate in 1/s.
    growth: f64,
    hz: f64,
    /// Krein sign; 0 where the two eigenvalues have coalesced.
    sign: i8,
}

/// Eigenvalues and axes of the figure.
struct Chart {
    paths: [Vec<Sample>; 2],
    growth: Axis,
    frequency: Axis,
    speed: Axis,
    /// Number of decimals that distinguishes the speeds.
    decimals: usize,
}

/// Draws both panels; `None` if the report does not contain two paths of finite eigenvalues.
pub fn sheet(report: &Report) -> Option<Sheet> {
    let entry = report.root_loci.as_ref()?;
    let chart = Chart::new(entry)?;
    let mut sheet = Sheet::new(WIDTH, HEIGHT);
    let title = format!(
        "Root loci around the flutter onset at {:.0} rpm",
        entry.onset_rpm
    );
    heading::draw(
        &mut sheet,
        &title,
        &heading::of_saw(&report.scene.name, &report.condition),
    );
    draw_axes(&mut sheet, &chart);
    draw_band(&mut sheet, &chart, entry);
    // The first path is drawn last, so that it is visible in the panel over speed, where both have the same frequency.
    for path in chart.paths.iter().rev() {
        draw_path(&mut sheet, path, |s| chart.in_plane(s));
        draw_path(&mut sheet, path, |s| chart.over_speed(s));
    }
    draw_labels(&mut sheet, &chart, entry);
    let notes = [
        "dots: computed eigenvalues",
        "(+) and (−): Krein signs",
        "where Re λ = 0 dots are drawn beside the axis to keep them apart",
    ];
    let letters = Lettering::regular(LABEL_SIZE, QUIET, Anchor::Start);
    let at = [PLANE.left, f64::from(HEIGHT) - 16.0];
    sheet.text(at, letters, &notes.join(BETWEEN_FACTS));
    Some(sheet)
}

/// The eigenvalues in the complex plane and over speed, as numbers; `None` as for [`sheet`].
pub fn chart(report: &Report) -> Option<ChartData> {
    let entry = report.root_loci.as_ref()?;
    let chart = Chart::new(entry)?;
    let hz = AxisData::new("Im λ / 2π", "Hz").within(chart.frequency.values());
    let mut plane = vec![Item::Upright(Upright {
        x: 0.0,
        role: Role::Guide,
        colour: Hue::Quiet,
        dashed: true,
        label: String::new(),
        name: "neither grows nor decays".to_owned(),
    })];
    let mut over_speed = Vec::new();
    for (path, own) in chart.paths.iter().zip(&entry.paths).rev() {
        plane.extend(items(path, &own.name, |s| [s.growth, s.hz]));
        over_speed.extend(items(path, &own.name, |s| [s.rpm, s.hz]));
    }
    let growth = AxisData::new("Re λ", "1/s").within(chart.growth.values());
    let speed = AxisData::speed().within(chart.speed.values());
    let [from, to] = [entry.onset_rpm, entry.end_rpm].map(|rpm| chart.rpm(rpm));
    Some(ChartData {
        columns: 1,
        key: Vec::new(),
        title: report.scene.name.clone(),
        facts: vec![
            report.condition.clone(),
            format!("flutter from {from} to {to} rpm"),
        ],
        panels: vec![
            PanelData::new(growth, hz.clone(), plane),
            PanelData::new(speed, hz, over_speed),
        ],
    })
}

/// Lines between successive computed eigenvalues, and a dot at each. `place` returns the coordinates of a dot.
fn items(path: &[Sample], name: &str, place: impl Fn(&Sample) -> [f64; 2]) -> Vec<Item> {
    let say = |s: &Sample| {
        let growth = shown_to(3, s.growth);
        format!("{name}\n{:.1} rpm\n{:.3} Hz\n{growth} 1/s", s.rpm, s.hz)
    };
    let look = |i: usize| Some(hue(colour_giver(path, i)));
    let lines = lines_by_look(path.len(), look);
    let mut items: Vec<Item> = Vec::new();
    for ((colour, tint), samples) in lines {
        let at = |i: &Option<usize>| i.map_or([f64::NAN; 2], |i| place(&path[i]));
        let said = |i: &Option<usize>| i.map_or_else(String::new, |i| say(&path[i]));
        items.push(Item::Line(Line {
            tint,
            said: samples.iter().map(said).collect(),
            ..Line::new(samples.iter().map(at), colour, name)
        }));
    }
    for of in [
        (Hue::Forward, 1.0),
        (Hue::Backward, 1.0),
        (Hue::Flutter, 1.0),
        (Hue::Flutter, 0.5),
    ] {
        let own = path.iter().filter(|s| hue(s) == of);
        items.push(Item::Points(Points {
            tint: of.1,
            said: own.clone().map(say).collect(),
            ..Points::new(own.map(&place), of.0, 2.0 * DOT, name)
        }));
    }
    items
}

/// The eigenvalues of a path without values that are not finite or larger than [`LARGEST`].
fn samples(entry: &RootLoci, path: &RootPath) -> Vec<Sample> {
    let numbers = path.growth_per_s.iter().zip(&path.frequency_hz);
    let all = entry.rpm.iter().zip(numbers).zip(&path.krein_sign);
    let all = all.map(|((rpm, (growth, hz)), sign)| Sample {
        rpm: *rpm,
        growth: *growth,
        hz: *hz,
        sign: *sign,
    });
    all.filter(|s| [s.rpm, s.growth, s.hz].iter().all(|v| v.abs() < LARGEST))
        .collect()
}

impl Chart {
    fn new(entry: &RootLoci) -> Option<Self> {
        let [first, second] = entry.paths.first_chunk()?;
        let paths = [first, second].map(|path| samples(entry, path));
        let ends_are_sound = [entry.onset_rpm, entry.end_rpm].map(|rpm| rpm.abs() < LARGEST);
        if paths.iter().any(|path| path.len() < 2) || ends_are_sound != [true; 2] {
            return None;
        }
        let range = |of: fn(&Sample) -> f64| extremes(paths.iter().flatten().map(of));
        let reach = range(|s| s.growth.abs())[1];
        // The factor leaves room for the labels at the outermost points.
        let reach = 1.62 * if reach > 0.0 { reach } else { 1.0 };
        let [bottom, top] = range(|s| s.hz);
        let air = (0.08 * (top - bottom)).max(1e-3 * top.abs());
        let ends = range(|s| s.rpm);
        Some(Self {
            growth: Axis::linear([-reach, reach], PLANE.across()),
            frequency: Axis::linear([bottom - air, top + air], PLANE.upwards()),
            speed: Axis::linear(ends, SPEED.across()),
            decimals: (15.0 / (ends[1] - ends[0])).log10().ceil().clamp(0.0, 3.0) as usize,
            paths,
        })
    }

    fn in_plane(&self, s: &Sample) -> [f64; 2] {
        let aside = -ASIDE * f64::from(s.sign);
        [self.growth.at(s.growth) + aside, self.frequency.at(s.hz)]
    }

    fn over_speed(&self, s: &Sample) -> [f64; 2] {
        [self.speed.at(s.rpm), self.frequency.at(s.hz)]
    }

    fn rpm(&self, rpm: f64) -> String {
        format!("{rpm:.*}", self.decimals)
    }
}

/// Colour of an eigenvalue, and its share in a mixture with the colour of the paper.
fn hue(s: &Sample) -> (Hue, f64) {
    match s.sign {
        1 => (Hue::Forward, 1.0),
        -1 => (Hue::Backward, 1.0),
        _ if s.growth > 0.0 => (Hue::Flutter, 1.0),
        _ => (Hue::Flutter, 0.5),
    }
}

fn colour(s: &Sample) -> Colour {
    let (hue, share) = hue(s);
    tint(hue.colour(), share)
}

/// The eigenvalue that determines the colour of the line between an eigenvalue and the next: one inside the band if
/// there is one, otherwise the first.
fn colour_giver(path: &[Sample], i: usize) -> &Sample {
    let pair = &path[i..=i + 1];
    pair.iter().find(|s| s.sign == 0).unwrap_or(&pair[0])
}

fn draw_axes(sheet: &mut Sheet, chart: &Chart) {
    let name = "Im λ / 2π\u{2003}[Hz]";
    draw_vertical(sheet, &chart.frequency, &PLANE, name);
    for hz in chart.frequency.ticks(40.0) {
        let y = chart.frequency.at(hz);
        sheet.horizontal(y, &SPEED, Stroke::solid(GRID, HAIRLINE));
    }
    for x in [PLANE.left, chart.growth.at(0.0), SPEED.left] {
        sheet.vertical(x, &PLANE, Stroke::solid(QUIET, HAIRLINE));
    }
    draw_named(sheet, &chart.growth, PLANE.bottom, "Re λ\u{2003}[1/s]");
    draw_named(sheet, &chart.speed, SPEED.bottom, SPEED_NAME);
}

/// Shades the band over the speeds, and writes its ends in rpm above.
fn draw_band(sheet: &mut Sheet, chart: &Chart, entry: &RootLoci) {
    let [first, last] = chart.speed.values();
    let ends = [entry.onset_rpm, entry.end_rpm].map(|rpm| rpm.clamp(first, last));
    let [left, right] = ends.map(|rpm| chart.speed.at(rpm));
    sheet.fill(SPEED.between([left, right]), FLUTTER_SHADE);
    let [from, to] = [entry.onset_rpm, entry.end_rpm].map(|rpm| chart.rpm(rpm));
    let name = format!("flutter {from}–{to}");
    let letters = Lettering::regular(LABEL_SIZE, FLUTTER, Anchor::Middle);
    let half = label_width(&name) / 2.0;
    let room = [SPEED.left + half, f64::from(WIDTH) - MARGIN - half];
    let middle = (0.5 * (left + right)).min(room[1]).max(room[0]);
    sheet.text([middle, SPEED.top - 8.0], letters, &name);
}

/// Draws straight lines between successive computed eigenvalues, and a dot at each.
fn draw_path(sheet: &mut Sheet, path: &[Sample], place: impl Fn(&Sample) -> [f64; 2]) {
    for (i, pair) in path.windows(2).enumerate() {
        let line = [place(&pair[0]), place(&pair[1])];
        sheet.line(line, Stroke::solid(colour(colour_giver(path, i)), CURVE));
    }
    for sample in path {
        sheet.disc(place(sample), DOT, colour(sample));
    }
}

/// Lines of text beside an eigenvalue.
struct Label {
    lines: Vec<String>,
    colour: Colour,
    /// Abscissa of the start or the end of the text.
    x: f64,
    /// Preferred ordinate of its middle.
    y: f64,
}

/// Writes names and speeds at the ends of the paths, to the left of the imaginary axis for Krein sign +1 and to the right
/// for −1, the largest growth to the right, and a note on its mirror image to the left.
fn draw_labels(sheet: &mut Sheet, chart: &Chart, entry: &RootLoci) {
    for (text, x, anchor) in [
        ("← decaying", PLANE.left, Anchor::Start),
        ("growing →", PLANE.right, Anchor::End),
    ] {
        let letters = Lettering::regular(LABEL_SIZE, QUIET, anchor);
        sheet.text([x, PLANE.top - 8.0], letters, text);
    }
    let [mut left, mut right] = [Vec::new(), Vec::new()];
    for (path, own) in chart.paths.iter().zip(&entry.paths) {
        for (at, sample) in [path.first(), path.last()].into_iter().enumerate() {
            let Some(sample) = sample.filter(|s| s.sign != 0) else {
                continue;
            };
            let name = (at == 0).then_some(own.name.as_str());
            match sample.sign > 0 {
                true => left.push(label_of_end(chart, sample, name, -1.0)),
                false => right.push(label_of_end(chart, sample, name, 1.0)),
            }
        }
    }
    let all = chart.paths.iter().flatten();
    if let Some(peak) = all
        .max_by(|a, b| a.growth.total_cmp(&b.growth))
        .filter(|s| s.growth > 0.0)
    {
        let mirrored = Sample {
            growth: -peak.growth,
            ..*peak
        };
        right.push(label_of_peak(chart, peak));
        left.push(Label {
            lines: vec!["decaying".to_owned(), "(mirror image)".to_owned()],
            colour: tint(FLUTTER, 0.75),
            x: chart.in_plane(&mirrored)[0] - GAP,
            y: chart.frequency.at(peak.hz),
        });
    }
    write(sheet, &left, Anchor::End);
    write(sheet, &right, Anchor::Start);
}

fn label_of_end(chart: &Chart, sample: &Sample, name: Option<&str>, way: f64) -> Label {
    let sign = if sample.sign > 0 { "+" } else { "\u{2212}" };
    let name = name.map_or(String::new(), |name| format!(" {name}"));
    let name = shorten_label(&format!("({sign}){name}"), LONGEST);
    Label {
        lines: vec![name, format!("{} rpm", chart.rpm(sample.rpm))],
        colour: colour(sample),
        x: chart.growth.at(0.0) + way * GAP,
        y: chart.frequency.at(sample.hz),
    }
}

fn label_of_peak(chart: &Chart, peak: &Sample) -> Label {
    let [x, y] = chart.in_plane(peak);
    Label {
        lines: vec![
            "growing".to_owned(),
            format!("peak {} rpm", chart.rpm(peak.rpm)),
            format!("{} 1/s", two_digits(peak.growth)),
        ],
        colour: FLUTTER,
        x: x + GAP,
        y,
    }
}

/// Writes the labels of one side without overlap.
fn write(sheet: &mut Sheet, labels: &[Label], anchor: Anchor) {
    let extents = labels.iter().map(|label| Extent {
        centre: label.y,
        length: LINE * label.lines.len() as f64 + 2.0,
    });
    let centres = push_apart(extents, [PLANE.top, PLANE.bottom]);
    for (label, centre) in labels.iter().zip(centres) {
        let Some(centre) = centre else { continue };
        let letters = Lettering::regular(LABEL_SIZE, label.colour, anchor);
        for (k, line) in label.lines.iter().enumerate() {
            let above = k as f64 - 0.5 * (label.lines.len() as f64 - 1.0);
            let at = [label.x, centre + above * LINE + 0.36 * LABEL_SIZE];
            sheet.text_on_paper(at, letters, line);
        }
    }
}

#[cfg(test)]
mod tests;
