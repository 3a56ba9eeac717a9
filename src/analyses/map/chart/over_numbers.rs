//! Areas of stable, diverging and fluttering saws over two numbers, with contours of speeds.

use crate::analyses::map::{Contour, Contoured, MapAxis, MapReport, MappedSaw};
use crate::analyses::scene_axis::Along;
use crate::page::figure::chart_data::PanelData;
use crate::page::figure::items::{Heat, Item, Line, Points, Shape};
use crate::page::figure::palette::Hue;
use crate::page::figure::style::{BLANK, Colour, DIVERGENCE_STREAK, FLUTTER_STREAK, tint};
use crate::stability::{CRITICAL_MARGIN, StabilityState};

/// Colour of stable saws within 5 % of a critical speed.
const AT_CRITICAL: Colour = plotters::style::RGBColor(196, 216, 232);
/// Colour of stable saws, lighter than those of instability in grey prints too.
const STABLE: Colour = plotters::style::RGBColor(228, 240, 228);
/// Colour of saws whose state the error of an edge leaves open.
const OPEN: Colour = plotters::style::RGBColor(150, 150, 150);
const SCENE_SIZE: f64 = 10.0;

/// State of a saw at the speed of the map.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum State {
    Stable,
    AtCritical,
    Divergence,
    Flutter,
    TooClose,
    NotAnalysed,
}

impl State {
    const ALL: [State; 6] = [
        State::Stable,
        State::AtCritical,
        State::Divergence,
        State::Flutter,
        State::TooClose,
        State::NotAnalysed,
    ];

    /// `None` if the saw was not judged, or its speed lies outside its sweep.
    fn of(saw: &MappedSaw) -> Option<Self> {
        match saw.state {
            _ if saw.not_analysed.is_some() => Some(State::NotAnalysed),
            None
            | Some(
                StabilityState::OutsideSweep
                | StabilityState::NotDetermined
                | StabilityState::NotCovered,
            ) => None,
            Some(StabilityState::Stable) if saw.at_critical_rpm.is_some() => {
                Some(State::AtCritical)
            }
            Some(StabilityState::Stable) => Some(State::Stable),
            Some(StabilityState::Divergence) => Some(State::Divergence),
            Some(StabilityState::Flutter) => Some(State::Flutter),
            Some(StabilityState::TooClose) => Some(State::TooClose),
        }
    }

    fn colour(self) -> Colour {
        match self {
            State::Stable => STABLE,
            State::AtCritical => AT_CRITICAL,
            State::Divergence => tint(DIVERGENCE_STREAK, 0.6),
            State::Flutter => tint(FLUTTER_STREAK, 0.6),
            State::TooClose => OPEN,
            State::NotAnalysed => BLANK,
        }
    }

    fn name(self) -> String {
        match self {
            State::Stable => "stable".to_owned(),
            State::AtCritical => {
                format!(
                    "within {:.0} % of a critical speed",
                    100.0 * CRITICAL_MARGIN
                )
            }
            State::Divergence => "divergence".to_owned(),
            State::Flutter => "flutter".to_owned(),
            State::TooClose => "too close to the edge of a band to call".to_owned(),
            State::NotAnalysed => "not analysed".to_owned(),
        }
    }
}

/// Areas and contours.
pub fn panel(report: &MapReport, y: &MapAxis) -> PanelData {
    let across = Along::of_cells(&report.x.path, &report.x.values);
    let up = Along::of_cells(&y.path, &y.values);
    let columns = report.x.values.len();
    let states: Vec<Option<State>> = report.saws.iter().map(State::of).collect();
    let areas = State::ALL.map(|state| {
        let is_in = |column, row| states.get(row * columns + column) == Some(&Some(state));
        let grid = [&across.values[..], &up.values];
        Item::Heat(Heat::class(grid, is_in, state.colour(), &state.name()))
    });
    let contours = report
        .contours
        .iter()
        .map(|contour| Item::Line(line(contour, &across, &up)));
    let scene = Points {
        shape: Shape::Ring,
        ..Points::new(
            [[across.at(report.x.of_scene), up.at(y.of_scene)]],
            Hue::Ink,
            SCENE_SIZE,
            "the scene",
        )
    };
    let items = areas
        .into_iter()
        .chain(contours)
        .chain([Item::Points(scene)])
        .collect();
    PanelData::new(across.axis, up.axis, items)
}

/// A contour of a quantity.
fn line_of(quantity: Contoured, points: impl IntoIterator<Item = [f64; 2]>) -> Line {
    let (hue, dashed, name) = match quantity {
        Contoured::FlutterSpeed => (Hue::Flutter, false, "flutter speed [rpm]"),
        Contoured::LowestCriticalSpeed => (Hue::Forward, true, "first critical speed [rpm]"),
    };
    Line {
        dashed,
        ..Line::new(points, hue, name)
    }
}

/// A contour with its speed in rpm.
fn line(contour: &Contour, x: &Along, y: &Along) -> Line {
    let points = contour.points.iter();
    let places = points.map(|[a, b]| [x.at(*a), y.at(*b)]);
    Line {
        label: contour.rpm.to_string(),
        ..line_of(contour.quantity, places)
    }
}

/// Samples of the areas, the contours and the mark of the scene.
pub fn key(report: &MapReport) -> Vec<Item> {
    let is_blank = report.saws.iter().any(|saw| saw.not_analysed.is_some());
    let states = State::ALL
        .iter()
        .filter(|state| match state {
            State::NotAnalysed => is_blank,
            _ => report.rpm.is_some(),
        })
        .map(|state| {
            let class = Heat::class([&[], &[]], |_, _| false, state.colour(), &state.name());
            Item::Heat(class)
        });
    let contours = [Contoured::FlutterSpeed, Contoured::LowestCriticalSpeed]
        .map(|quantity| Item::Line(line_of(quantity, [])));
    let scene = Item::points_sample(SCENE_SIZE, Shape::Ring, Hue::Ink, "the scene");
    states.chain(contours).chain([scene]).collect()
}
