//! Paths of the two eigenvalues that meet at the flutter onset, in the complex plane and over speed.

use super::{Report, RootLoci, RootPath};
use crate::page::figure::axis::{extremes, proper_range, two_digits};
use crate::page::figure::chart_data::{AxisData, ChartData, PanelData};
use crate::page::figure::heading;
use crate::page::figure::items::{Area, Item, Line, Points, Role, Shape, Upright, lines_by_look};
use crate::page::figure::palette::Hue;
use crate::page::figure::style::shorten_label;
use crate::page::text::shown_to;

/// Larger speeds, growth rates and frequencies are not drawn: no saw has them, and labels would have no room.
const LARGEST: f64 = 1e9;
/// Diameter of the dot of a computed eigenvalue.
const DOT_SIZE: f64 = 4.4;
/// Distance of an eigenvalue on the imaginary axis from this axis, relative to the axis of growth rates: to the left for
/// Krein sign +1 and to the right for −1, so that both paths are visible.
const ASIDE: f64 = 0.011;
/// Largest width of the name at the end of a path, in figure units.
const LONGEST: f64 = 200.0;
/// Height of the panels, relative to one of usual height.
const SHARE: f64 = 1.45;

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

/// Two paths of finite eigenvalues, and the axes that show them.
struct Paths {
    paths: [Vec<Sample>; 2],
    /// End of the axis of growth rates on either side of zero.
    reach: f64,
    hz: [f64; 2],
    rpm: [f64; 2],
    /// Number of decimals that distinguishes the speeds.
    decimals: usize,
}

/// The eigenvalues in the complex plane and over speed, as numbers; `None` if the report does not contain two paths of
/// finite eigenvalues.
pub fn chart(report: &Report) -> Option<ChartData> {
    let entry = report.root_loci.as_ref()?;
    let found = Paths::new(entry)?;
    let hz = AxisData::new("Im λ / 2π", "Hz").within(found.hz);
    let [from, to] = [entry.onset_rpm, entry.end_rpm].map(|rpm| found.rpm(rpm));
    let plane = PanelData {
        title: "Complex plane".to_owned(),
        share: SHARE,
        ..PanelData::new(
            AxisData::new("Re λ, positive for growth", "1/s").within([-found.reach, found.reach]),
            hz.clone(),
            found.plane(entry),
        )
    };
    let over_speed = PanelData {
        title: format!("Flutter from {from} to {to} rpm"),
        share: SHARE,
        ..PanelData::new(
            AxisData::speed().within(found.rpm),
            hz,
            found.over_speed(entry),
        )
    };
    let facts = vec![
        heading::of_saw(&report.scene.name, &report.condition),
        "(+) and (−): Krein signs".to_owned(),
    ];
    let title = format!(
        "Root loci around the flutter onset at {:.0} rpm",
        entry.onset_rpm
    );
    Some(ChartData {
        columns: 2,
        key: key(),
        ..ChartData::new(&title, facts, vec![plane, over_speed])
    })
}

/// Lines between successive computed eigenvalues, and a dot at each. `place` returns the coordinates of a dot.
fn items(path: &[Sample], name: &str, place: impl Fn(&Sample) -> [f64; 2]) -> Vec<Item> {
    let say = |s: &Sample| {
        let growth = shown_to(3, s.growth);
        format!("{name}\n{:.1} rpm\n{:.3} Hz\n{growth} 1/s", s.rpm, s.hz)
    };
    let look = |i: usize| Some(shade(colour_giver(path, i)));
    let lines = lines_by_look(path.len(), look);
    let mut items: Vec<Item> = Vec::new();
    for (shade, samples) in lines {
        let at = |i: &Option<usize>| i.map_or([f64::NAN; 2], |i| place(&path[i]));
        let said = |i: &Option<usize>| i.map_or_else(String::new, |i| say(&path[i]));
        items.push(Item::Line(Line {
            tint: shade.tint,
            said: samples.iter().map(said).collect(),
            ..Line::new(samples.iter().map(at), shade.hue, name)
        }));
    }
    for of in [FORWARD, BACKWARD, GROWING, DECAYING] {
        let own = path.iter().filter(|s| shade(s) == of);
        items.push(Item::Points(Points {
            tint: of.tint,
            said: own.clone().map(say).collect(),
            ..Points::new(own.map(&place), of.hue, DOT_SIZE, name)
        }));
    }
    items
}

/// The eigenvalues of a path without values that are not finite or larger than [`LARGEST`].
fn samples(entry: &RootLoci, path: &RootPath) -> Vec<Sample> {
    let numbers = path.growth_per_s.iter().zip(&path.frequency_hz);
    let all =
        entry
            .rpm
            .iter()
            .zip(numbers)
            .zip(&path.krein_sign)
            .map(|((rpm, (growth, hz)), sign)| Sample {
                rpm: *rpm,
                growth: *growth,
                hz: *hz,
                sign: *sign,
            });
    all.filter(|s| [s.rpm, s.growth, s.hz].iter().all(|v| v.abs() < LARGEST))
        .collect()
}

impl Paths {
    fn new(entry: &RootLoci) -> Option<Self> {
        let [first, second] = entry.paths.first_chunk()?;
        let paths = [first, second].map(|path| samples(entry, path));
        let ends_are_sound = [entry.onset_rpm, entry.end_rpm].map(|rpm| rpm.abs() < LARGEST);
        if paths.iter().any(|path| path.len() < 2) || ends_are_sound != [true; 2] {
            return None;
        }
        let range = |of: fn(&Sample) -> f64| extremes(paths.iter().flatten().map(of));
        let fastest = range(|s| s.growth.abs())[1];
        // The factor leaves room for the labels at the outermost points.
        let reach = 1.62 * if fastest > 0.0 { fastest } else { 1.0 };
        let [bottom, top] = range(|s| s.hz);
        let air = (0.08 * (top - bottom)).max(1e-3 * top.abs());
        let rpm = proper_range(range(|s| s.rpm));
        Some(Self {
            reach,
            hz: proper_range([bottom - air, top + air]),
            decimals: (15.0 / (rpm[1] - rpm[0])).log10().ceil().clamp(0.0, 3.0) as usize,
            rpm,
            paths,
        })
    }

    fn rpm(&self, rpm: f64) -> String {
        format!("{rpm:.*}", self.decimals)
    }

    fn in_plane(&self, s: &Sample) -> [f64; 2] {
        [s.growth - ASIDE * self.reach * f64::from(s.sign), s.hz]
    }

    /// The first path is drawn last, so that it is visible over the speed, where both have the same frequency.
    fn drawn(&self, entry: &RootLoci, place: impl Fn(&Sample) -> [f64; 2]) -> Vec<Item> {
        let paths = self.paths.iter().zip(&entry.paths).rev();
        paths
            .flat_map(|(path, own)| items(path, &own.name, &place))
            .collect()
    }

    fn plane(&self, entry: &RootLoci) -> Vec<Item> {
        let axis = Item::Upright(Upright {
            x: 0.0,
            role: Role::Guide,
            colour: Hue::Quiet,
            dashed: false,
            label: String::new(),
            name: "neither grows nor decays".to_owned(),
        });
        let paths = self.drawn(entry, |s| self.in_plane(s));
        [axis]
            .into_iter()
            .chain(paths)
            .chain(self.labels(entry))
            .collect()
    }

    fn over_speed(&self, entry: &RootLoci) -> Vec<Item> {
        let [first, last] = self.rpm;
        let edges = [entry.onset_rpm, entry.end_rpm]
            .map(|rpm| rpm.clamp(first, last))
            .map(|rpm| [rpm, self.hz[0], self.hz[1]]);
        let band = Item::Area(Area::new(edges, Hue::FlutterShade, "flutter"));
        let paths = self.drawn(entry, |s| [s.rpm, s.hz]);
        [band].into_iter().chain(paths).collect()
    }

    /// Names at the beginnings of the paths, the largest growth, and a note on its mirror image.
    fn labels(&self, entry: &RootLoci) -> Vec<Item> {
        let begins = self
            .paths
            .iter()
            .zip(&entry.paths)
            .filter_map(|(path, own)| {
                let sample = path.first().filter(|s| s.sign != 0)?;
                let sign = if sample.sign > 0 { "+" } else { "\u{2212}" };
                let text = format!("({sign}) {}", shorten_label(&own.name, LONGEST));
                Some(Item::label(self.in_plane(sample), shade(sample).hue, text))
            });
        let all = self.paths.iter().flatten();
        let peak = all
            .max_by(|a, b| a.growth.total_cmp(&b.growth))
            .filter(|s| s.growth > 0.0)
            .map(|peak| {
                let [rpm, growth] = [self.rpm(peak.rpm), two_digits(peak.growth)];
                let text = format!("peak {rpm} rpm, {growth} 1/s");
                let mirrored = "decaying (mirror image)".to_owned();
                [
                    Item::label([peak.growth, peak.hz], Hue::Flutter, text),
                    Item::label([-peak.growth, peak.hz], Hue::Flutter, mirrored),
                ]
            });
        begins.chain(peak.into_iter().flatten()).collect()
    }
}

/// A colour, and its share in a mixture with the colour of the paper.
#[derive(Clone, Copy, PartialEq)]
struct Shade {
    hue: Hue,
    tint: f64,
}

const FORWARD: Shade = Shade::new(Hue::Forward, 1.0);
const BACKWARD: Shade = Shade::new(Hue::Backward, 1.0);
const GROWING: Shade = Shade::new(Hue::Flutter, 1.0);
const DECAYING: Shade = Shade::new(Hue::Flutter, 0.5);

impl Shade {
    const fn new(hue: Hue, tint: f64) -> Self {
        Shade { hue, tint }
    }
}

fn shade(s: &Sample) -> Shade {
    match s.sign {
        1 => FORWARD,
        -1 => BACKWARD,
        _ if s.growth > 0.0 => GROWING,
        _ => DECAYING,
    }
}

/// The eigenvalue that determines the colour of the line between an eigenvalue and the next: one inside the band if
/// there is one, otherwise the first.
fn colour_giver(path: &[Sample], i: usize) -> &Sample {
    let pair = &path[i..=i + 1];
    pair.iter().find(|s| s.sign == 0).unwrap_or(&pair[0])
}

fn key() -> Vec<Item> {
    let dot = |hue, name| Item::points_sample(DOT_SIZE, Shape::Disc, hue, name);
    vec![
        dot(Hue::Forward, "computed eigenvalue, Krein sign +1"),
        dot(
            Hue::Backward,
            "Krein sign −1; drawn beside the axis where Re λ = 0",
        ),
        dot(Hue::Flutter, "inside the band"),
    ]
}

#[cfg(test)]
mod tests;
