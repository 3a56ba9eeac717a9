//! Areas of saws with the same answer over two numbers, with contours of speeds.

use crate::analyses::map::{Contour, Contoured, MapAxis, MapReport, MappedSaw};
use crate::analyses::scene_axis::Along;
use crate::analyses::verdict::{Answer, OPEN_CAUSES};
use crate::page::figure::chart_data::PanelData;
use crate::page::figure::items::{Heat, Item, Line, Points, Shape};
use crate::page::figure::palette::Hue;
use crate::page::figure::style::{BLANK, Colour, DIVERGENCE_STREAK, FLUTTER_STREAK, tint};

/// Colours of the answers, lighter than those of instability in grey prints too.
const YES: Colour = plotters::style::RGBColor(228, 240, 228);
const AT_RISK: Colour = plotters::style::RGBColor(226, 222, 160);
/// Colour of saws that break a limit of the user.
const LIMIT: Colour = plotters::style::RGBColor(222, 196, 196);
/// Colour of saws of which it is open whether a motion grows.
const OPEN: Colour = plotters::style::RGBColor(150, 150, 150);
const SCENE_SIZE: f64 = 10.0;

/// Answer for a saw at the speed of the map, and what decides it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum State {
    Yes,
    AtRisk,
    Divergence,
    Flutter,
    Limit,
    Open,
    NotAnalysed,
}

impl State {
    const ALL: [State; 7] = [
        State::Yes,
        State::AtRisk,
        State::Divergence,
        State::Flutter,
        State::Limit,
        State::Open,
        State::NotAnalysed,
    ];

    /// `None` if the saw was not judged.
    fn of(saw: &MappedSaw) -> Option<Self> {
        if saw.not_analysed.is_some() {
            return Some(State::NotAnalysed);
        }
        let verdict = saw.verdict.as_ref()?;
        Some(match (verdict.answer?, verdict.cause.as_deref()) {
            (Answer::Yes, _) => State::Yes,
            (Answer::No, Some("divergence")) => State::Divergence,
            (Answer::No, Some("flutter")) => State::Flutter,
            (Answer::No, _) => State::Limit,
            (Answer::AtRisk, Some(cause)) if OPEN_CAUSES.contains(&cause) => State::Open,
            (Answer::AtRisk, _) => State::AtRisk,
        })
    }

    fn colour(self) -> Colour {
        match self {
            State::Yes => YES,
            State::AtRisk => AT_RISK,
            State::Divergence => tint(DIVERGENCE_STREAK, 0.6),
            State::Flutter => tint(FLUTTER_STREAK, 0.6),
            State::Limit => LIMIT,
            State::Open => OPEN,
            State::NotAnalysed => BLANK,
        }
    }

    fn name(self) -> &'static str {
        match self {
            State::Yes => "yes",
            State::AtRisk => "at risk",
            State::Divergence => "no, divergence",
            State::Flutter => "no, flutter",
            State::Limit => "no, another limit",
            State::Open => "at risk: open whether a motion grows",
            State::NotAnalysed => "not analysed",
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
        Item::Heat(Heat::class(grid, is_in, state.colour(), state.name()))
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
        Contoured::FirstCriticalSpeed => (Hue::Forward, true, "first critical speed [rpm]"),
        Contoured::Limits => (Hue::Ink, false, "limits of speeds just kept"),
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
    let label = match contour.quantity {
        Contoured::Limits => String::new(),
        Contoured::FlutterSpeed | Contoured::FirstCriticalSpeed => contour.rpm.to_string(),
    };
    Line {
        label,
        ..line_of(contour.quantity, places)
    }
}

/// Samples of the areas, the contours and the mark of the scene.
pub fn key(report: &MapReport) -> Vec<Item> {
    let states = State::ALL
        .iter()
        .filter(|state| match state {
            State::Yes | State::AtRisk => report.rpm.is_some(),
            state => report
                .saws
                .iter()
                .any(|saw| State::of(saw) == Some(**state)),
        })
        .map(|state| {
            let class = Heat::class([&[], &[]], |_, _| false, state.colour(), state.name());
            Item::Heat(class)
        });
    let contours = [
        Contoured::FlutterSpeed,
        Contoured::FirstCriticalSpeed,
        Contoured::Limits,
    ]
    .into_iter()
    .filter(|quantity| report.contours.iter().any(|of| of.quantity == *quantity))
    .map(|quantity| Item::Line(line_of(quantity, [])));
    let scene = Item::points_sample(SCENE_SIZE, Shape::Ring, Hue::Ink, "the scene");
    states.chain(contours).chain([scene]).collect()
}
