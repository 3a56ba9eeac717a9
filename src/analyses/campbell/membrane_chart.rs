//! Membrane stress over the radius, and its effect on the critical speeds.

use super::{BladeStress, Report, ToleratedHeat};
use crate::page::figure::axis::{extremes, proper_range, round_up, tick_label};
use crate::page::figure::chart_data::{AxisData, ChartData, PanelData};
use crate::page::figure::heading;
use crate::page::figure::items::{Item, Line, Points, Role, Upright};
use crate::page::figure::palette::Hue;
use crate::page::figure::style::HAIRLINE;

const LIMIT_SIZE: f64 = 9.0;

/// The stress, and the critical speeds over the temperature if the scene contains heat, as numbers; `None` without
/// stress and heat.
pub fn chart(report: &Report) -> Option<ChartData> {
    let membrane = report.membrane.as_ref()?;
    let heat = membrane
        .heat
        .as_ref()
        .filter(|heat| !heat.critical_speeds.is_empty());
    // The report of a blade without stress has the entry `membrane` if the scene contains a straight edge.
    if heat.is_none() && membrane.hoop_pa.iter().all(|stress_pa| *stress_pa == 0.0) {
        return None;
    }
    let title = match heat {
        Some(_) => "Membrane stress, and what heat does to the critical speeds",
        None => "Membrane stress",
    };
    let operating_rpm = report.operating.as_ref().map(|o| o.rpm);
    let speeds = heat.map(|heat| speeds(heat, operating_rpm));
    let panels = [stress(membrane)].into_iter().chain(speeds);
    let facts = vec![heading::of_saw(&report.scene.name, &report.condition)];
    Some(ChartData {
        columns: 2,
        ..ChartData::new(title, facts, panels.collect())
    })
}

fn stress(membrane: &BladeStress) -> PanelData {
    let mm: Vec<f64> = membrane.radius_m.iter().map(|r| 1e3 * r).collect();
    let ends = [mm.first(), mm.last()].map(|end| end.copied().unwrap_or(0.0));
    let all = membrane.radial_pa.iter().chain(&membrane.hoop_pa);
    let [low, high] = extremes(all.map(|pa| 1e-6 * pa).chain([0.0]));
    let step = round_up(((high - low) / 8.0).max(1e-3));
    let values = [(low / step).floor() * step, (high / step).ceil() * step];
    let zero = Line {
        width: HAIRLINE,
        ..Line::new(ends.map(|mm| [mm, 0.0]), Hue::Ink, "")
    };
    let curve = |values: &[f64], hue, name: &str| {
        let points = mm.iter().zip(values).map(|(mm, pa)| [*mm, 1e-6 * pa]);
        Item::Line(Line {
            end: name.to_owned(),
            ..Line::new(points, hue, name)
        })
    };
    PanelData::new(
        AxisData::new("radius", "mm").within(proper_range(ends)),
        AxisData::new("stress, tension upwards", "MPa").within(values),
        vec![
            Item::Line(zero),
            curve(&membrane.hoop_pa, Hue::Forward, "hoop"),
            curve(&membrane.radial_pa, Hue::Backward, "radial"),
        ],
    )
}

fn speeds(heat: &ToleratedHeat, operating_rpm: Option<f64>) -> PanelData {
    let curves = || heat.critical_speeds.iter();
    let rises = curves().flat_map(|curve| curve.rise_k.iter().copied());
    let rise_range = proper_range(extremes(rises.chain([0.0])));
    let top = curves()
        .flat_map(|curve| &curve.rpm)
        .fold(operating_rpm.unwrap_or(0.0), |top, rpm| top.max(*rpm));
    let lines = curves().map(|curve| {
        let points = curve
            .rise_k
            .iter()
            .zip(&curve.rpm)
            .map(|(k, rpm)| [*k, *rpm]);
        Item::Line(Line {
            end: curve.name.clone(),
            ..Line::new(points, Hue::Forward, &curve.name)
        })
    });
    PanelData::new(
        AxisData::new("peak of the temperature profile", "K").within(rise_range),
        AxisData::new("critical speeds", "rpm").within([0.0, 1.08 * top]),
        lines
            .chain(limits(heat, rise_range, operating_rpm))
            .collect(),
    )
}

/// A rise of the temperature with its sign.
fn kelvin(rise_k: f64) -> String {
    let sign = if rise_k > 0.0 { "+" } else { "" };
    format!("{sign}{} K", tick_label((10.0 * rise_k).round() / 10.0))
}

/// The temperature of the scene, the operating speed, and the temperatures at which it is critical and at which the blade
/// buckles.
fn limits(heat: &ToleratedHeat, rises: [f64; 2], operating_rpm: Option<f64>) -> Vec<Item> {
    let mut items = Vec::new();
    let is_shown = |k: f64| rises[0] <= k && k <= rises[1];
    if heat.rise_k != 0.0 {
        let label = format!("the scene, {}", kelvin(heat.rise_k));
        items.push(Item::Upright(Upright {
            x: heat.rise_k,
            role: Role::Guide,
            colour: Hue::Quiet,
            dashed: true,
            name: label.clone(),
            label,
        }));
    }
    if let Some(rpm) = operating_rpm {
        let label = format!("operating speed, {rpm:.0} rpm");
        items.push(Item::Line(Line {
            label: label.clone(),
            ..Line::guide(rises.map(|k| [k, rpm]), Hue::Ink, &label)
        }));
    }
    let mut mark = |at: [f64; 2], hue, said: String| {
        items.push(Item::Points(Points::new([at], hue, LIMIT_SIZE, &said)));
        items.push(Item::label(at, hue, said));
    };
    if let (Some(found), Some(rpm)) = (&heat.operating_limit, operating_rpm)
        && is_shown(found.rise_k)
    {
        let said = format!("critical from {} on", kelvin(found.rise_k));
        mark([found.rise_k, rpm], Hue::Flutter, said);
    }
    if let Some(found) = &heat.buckling {
        let said = format!("buckles at rest from {} on", kelvin(found.rise_k));
        match is_shown(found.rise_k) {
            true => mark([found.rise_k, 0.0], Hue::Alarm, said),
            // The temperature of buckling is beyond one end of the axis; the text is there and has an arrow.
            false if found.rise_k > 0.0 => {
                items.push(Item::label(
                    [rises[1], 0.0],
                    Hue::Alarm,
                    format!("{said} →"),
                ));
            }
            false => items.push(Item::label(
                [rises[0], 0.0],
                Hue::Alarm,
                format!("← {said}"),
            )),
        }
    }
    items
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analyses::campbell::sample::empty_report;
    use crate::analyses::campbell::{CriticalCurve, OperatingPoint, ToleratedRise};
    use crate::page::figure::layout::sheet;
    use crate::page::figure::tidiness::texts;

    /// The critical speeds of this blade fall linearly up to 40 K, and it buckles at 52 K.
    fn report(rise_k: f64) -> Report {
        let radius_m: Vec<f64> = (0..=30).map(|k| 0.08 + 0.01 * f64::from(k)).collect();
        let peaks: Vec<f64> = (0..=20).map(|k| 2.6 * f64::from(k) - 1e-3).collect();
        let curve = |diameters: usize| CriticalCurve {
            name: format!("{diameters} diameters"),
            nodal_diameters: diameters,
            nodal_circles: 0,
            rise_k: peaks.clone(),
            rpm: peaks
                .iter()
                .map(|k| 4000.0 * (1.0 - k / 52.0).sqrt() + 80.0 * diameters as f64)
                .collect(),
        };
        let limit = |rise_k| {
            Some(ToleratedRise {
                rise_k,
                name: "3 diameters".to_owned(),
                nodal_diameters: 3,
                nodal_circles: 0,
            })
        };
        let mut report = empty_report("A hot saw");
        report.operating = Some(OperatingPoint {
            rpm: 3000.0,
            of_first_critical: Some(0.7),
            stability: crate::analyses::campbell::StabilityState::Stable,
            inside_instability: None,
            at_critical_rpm: None,
            side_force_factor: None,
            deviation: None,
            undecided_edge_rpm: None,
            safe_window_rpm: None,
            growth_per_s: None,
            frequency_hz: None,
        });
        report.membrane = Some(BladeStress {
            roll_bands: Vec::new(),
            straight_edge: None,
            radial_pa: radius_m.iter().map(|r| -3e8 * (0.38 - r).abs()).collect(),
            hoop_pa: radius_m.iter().map(|r| 3e8 * (0.2 - r)).collect(),
            heat: Some(ToleratedHeat {
                rise_k,
                profile_k: radius_m.clone(),
                operating_limit: limit(25.0),
                past_critical_when_cold: false,
                buckling: limit(51.9),
                flat_from: None,
                buckles_first: false,
                critical_speeds: (2..7).map(curve).collect(),
            }),
            radius_m,
        });
        report
    }

    #[test]
    fn no_label_lies_on_another() {
        for rise_k in [0.0, 10.0, 24.0, 51.0] {
            let drawn = sheet(&chart(&report(rise_k)).unwrap());
            let written = texts(&drawn);
            let has = |text: &str| written.contains(&text);
            assert!(has("critical from +25 K on") && has("buckles at rest from +51.9 K on"));
            assert_eq!(has(&format!("the scene, +{rise_k} K")), rise_k > 0.0);
        }
    }

    #[test]
    fn buckling_beyond_the_curves_is_named() {
        for (rise_k, said) in [
            (120.0, "buckles at rest from +120 K on →"),
            (-80.0, "← buckles at rest from \u{2212}80 K on"),
        ] {
            let mut report = report(10.0);
            let heat = report.membrane.as_mut().unwrap().heat.as_mut().unwrap();
            heat.buckling.as_mut().unwrap().rise_k = rise_k;
            let drawn = sheet(&chart(&report).unwrap());
            assert!(texts(&drawn).contains(&said), "{said}");
        }
    }

    #[test]
    fn without_temperature_there_is_the_stress_alone_and_without_stress_nothing() {
        let mut rolled = report(0.0);
        rolled.membrane.as_mut().unwrap().heat = None;
        let _drawn = sheet(&chart(&rolled).unwrap());
        rolled.membrane = None;
        assert!(chart(&rolled).is_none());
    }
}
