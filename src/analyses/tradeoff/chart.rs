//! Run time over true error, both on logarithmic scales.

use super::{Method, Setting};
use crate::page::figure::axis::{Spread, extremes};
use crate::page::figure::chart_data::{AxisData, ChartData, PanelData};
use crate::page::figure::items::{Item, Line, Points, Role, Shape, Upright};
use crate::page::figure::palette::Hue;
use crate::page::figure::style::{CURVE, STRONG_CURVE};
use crate::page::figure::{Figure, layout};

/// Smallest relative error and smallest time in s on the axes; smaller values are rounding errors.
const LEAST: f64 = 1e-12;
/// Largest errors in percent that the named accuracies allow.
const ALLOWED: [(f64, &str); 3] = [(1.0, "draft"), (0.1, "design"), (0.01, "reference")];
/// Number of speeds of the charts that a line connects.
const SPEEDS: usize = 51;
const METHODS: [Method; 4] = [
    Method::Reduced,
    Method::Searched,
    Method::Dense,
    Method::CriticalSpeeds,
];
const DOT_SIZE: f64 = 8.0;
/// Width of the line along the best settings, and share of its colour.
const FRONT: (f64, f64) = (2.0 * STRONG_CURVE, 0.25);
const FRONT_NAME: &str = "no other chart is both faster and more accurate";

/// Draws the run time of settings over their true error, both on logarithmic scales, as measured by
/// [`tradeoff`](super::tradeoff()); `scene` is the name of the scene.
pub fn figure(scene: &str, settings: &[Setting]) -> Figure {
    let names = ["tradeoff.png", "tradeoff.svg"];
    Figure::new(names, layout::sheet(&chart(scene, settings)))
}

/// Returns the run time of settings over their true error as numbers, see [`figure`].
pub fn chart(scene: &str, settings: &[Setting]) -> ChartData {
    let errors = decades(settings.iter().map(|s| s.error)).map(|share| 100.0 * share);
    // The factor leaves room for a number above the slowest setting.
    let [least, most] = decades(settings.iter().map(|s| s.seconds));
    let error = AxisData::new("true error of critical speeds and onsets", "%").within(errors);
    let time = AxisData::new("time", "s").within([least, 2.0 * most]);
    let allowed = ALLOWED.map(|(percent, word)| {
        Item::Upright(Upright {
            x: percent,
            role: Role::Guide,
            colour: Hue::Quiet,
            dashed: true,
            label: word.to_owned(),
            name: format!("{word}: an error of {percent} %"),
        })
    });
    let methods = METHODS
        .iter()
        .flat_map(|method| of_method(*method, settings));
    let items = allowed.into_iter().chain([front(settings)]).chain(methods);
    let samples = METHODS.map(|method| Item::Points(dots(method, [])));
    let facts = vec![scene.to_owned(), "numbers: basis functions".to_owned()];
    let panel = PanelData {
        share: 1.2,
        ..PanelData::new(
            error.spread(Spread::Logarithmic),
            time.spread(Spread::Logarithmic),
            items.collect(),
        )
    };
    ChartData {
        key: samples
            .into_iter()
            .chain([front(settings).sample()])
            .collect(),
        ..ChartData::new("Computing time over true error", facts, vec![panel])
    }
}

/// Powers of ten around some values.
fn decades(values: impl Iterator<Item = f64>) -> [f64; 2] {
    let [lowest, high] = extremes(values.map(|value| value.max(LEAST).log10()));
    let low = lowest.floor();
    [low, high.max(low + 1.0).ceil()].map(|log| 10f64.powf(log))
}

/// Error in percent and time in s of a setting.
fn place(setting: &Setting) -> [f64; 2] {
    let percent = 100.0 * setting.error.max(LEAST);
    [percent, setting.seconds.max(LEAST)]
}

fn dots(method: Method, places: impl IntoIterator<Item = [f64; 2]>) -> Points {
    let (hue, shape, name) = match method {
        Method::Reduced => (Hue::Forward, Shape::Disc, "chart, projected"),
        Method::Searched => (Hue::Flutter, Shape::Ring, "chart, not proven"),
        Method::Dense => (Hue::Backward, Shape::Square, "chart, full model"),
        Method::CriticalSpeeds => (Hue::Divergence, Shape::Cross, "critical speeds"),
    };
    Points {
        shape,
        ..Points::new(places, hue, DOT_SIZE, name)
    }
}

/// Connects the settings than which no other is both faster and more accurate.
fn front(settings: &[Setting]) -> Item {
    let mut front: Vec<[f64; 2]> = settings.iter().filter(|s| s.on_front).map(place).collect();
    front.sort_by(|x, y| x[0].total_cmp(&y[0]));
    let (width, tint) = FRONT;
    Item::Line(Line {
        width,
        tint,
        ..Line::new(front, Hue::Forward, FRONT_NAME)
    })
}

/// The dots of a method, connected for one number of speeds, with the numbers of functions of its charts. Charts without
/// proof and critical speeds have the same numbers in the same order, which are not written.
fn of_method(method: Method, settings: &[Setting]) -> Vec<Item> {
    let own = || settings.iter().filter(|s| s.method == method);
    let is_connected = |s: &&Setting| s.speeds == SPEEDS || !s.is_chart();
    let dots = dots(method, own().map(place));
    let (hue, name) = (dots.colour, &dots.name);
    let line = Line {
        tint: 0.6,
        width: CURVE,
        ..Line::new(own().filter(is_connected).map(place), hue, name)
    };
    let say = |s: &Setting| {
        let (milliseconds, percent) = (1e3 * s.seconds, 100.0 * s.error);
        format!(
            "{name}\n{} functions, {} speeds\n{milliseconds:.1} ms\nerror {percent:.2e} %",
            s.functions, s.speeds
        )
    };
    let said = own().map(say).collect();
    let is_numbered = matches!(method, Method::Reduced | Method::Dense);
    let numbered = own().filter(|s| is_numbered && s.speeds == SPEEDS);
    let numbers = numbered.map(|s| Item::label(place(s), hue, s.functions.to_string()));
    [Item::Line(line), Item::Points(Points { said, ..dots })]
        .into_iter()
        .chain(numbers)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::page::figure::layout::sheet;
    use crate::page::figure::tidiness::texts;

    /// Eight sizes of the basis, for a diagram and for critical speeds, and two diagrams on the full model.
    #[test]
    fn no_label_lies_on_another() {
        let setting = |method, k: u32, seconds: f64| Setting {
            method,
            max_diameters: 6,
            radial_functions: 4,
            functions: 52 * (k as usize + 1),
            speeds: 51,
            seconds,
            error: 1e-2 * 0.4_f64.powi(k as i32),
            on_front: method == Method::Reduced,
        };
        let settings: Vec<Setting> = (0..8)
            .flat_map(|k| {
                let time = 1.6_f64.powi(k as i32);
                let dense = (k < 2).then(|| setting(Method::Dense, k, 4.0 * time));
                [
                    setting(Method::Reduced, k, 0.1 * time),
                    setting(Method::Searched, k, 0.08 * time),
                    setting(Method::CriticalSpeeds, k, 1e-3 * time),
                ]
                .into_iter()
                .chain(dense)
            })
            .collect();
        let drawn = sheet(&chart("A saw", &settings));
        let written = texts(&drawn);
        for setting in settings.iter().filter(|s| s.is_chart()) {
            let number = setting.functions.to_string();
            assert!(written.contains(&number.as_str()), "{number}");
        }
    }

    /// The errors extend from rounding to a percent.
    #[test]
    fn ticks_over_many_decades_keep_apart() {
        let settings = [1e-12, 1e-9, 1e-2].map(|error| Setting {
            method: Method::Reduced,
            max_diameters: 6,
            radial_functions: 4,
            functions: 52,
            speeds: 51,
            seconds: 9.9,
            error,
            on_front: true,
        });
        let _drawn = sheet(&chart("A saw", &settings));
    }
}
