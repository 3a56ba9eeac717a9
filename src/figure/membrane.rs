//! Membrane stress over the radius, and its effect on the critical speeds.

use super::axis::{Axis, draw_named, draw_vertical, extremes, name_upright, round_up, tick_label};
use super::canvas::{Anchor, Frame, Lettering, Sheet, Stroke};
use super::clip::draw_inside;
use super::declutter::{Extent, push_apart};
use super::heading;
use super::style::{
    ALARM, BACKWARD, CURVE, Colour, DASH, FINE_DASH, FLUTTER, FORWARD, HAIRLINE, INK, LABEL_SIZE,
    QUIET,
};
use crate::report::{BladeStress, Report, ToleratedHeat};

const HEIGHT: u32 = 560;
/// Width of the sheet with and without the panel of critical speeds.
const WIDTHS: [u32; 2] = [1200, 640];
const STRESS: Frame = Frame {
    left: 92.0,
    top: 100.0,
    right: 510.0,
    bottom: 470.0,
};
const SPEEDS: Frame = Frame {
    left: 690.0,
    top: 100.0,
    right: 1070.0,
    bottom: 470.0,
};
/// Line height of labels.
const LINE: f64 = 16.0;

/// Draws the stress, and the critical speeds over the temperature if the scene contains heat; `None` without stress
/// and heat.
pub fn sheet(report: &Report) -> Option<Sheet> {
    let membrane = report.membrane.as_ref()?;
    let heat = membrane.heat.as_ref();
    let heat = heat.filter(|heat| !heat.critical_speeds.is_empty());
    // The report of a blade without stress has the entry `membrane` if the scene contains a straight edge.
    if heat.is_none() && membrane.hoop_pa.iter().all(|stress_pa| *stress_pa == 0.0) {
        return None;
    }
    let mut sheet = Sheet::new(WIDTHS[usize::from(heat.is_none())], HEIGHT);
    let title = match heat {
        Some(_) => "Membrane stress, and what heat does to the critical speeds",
        None => "Membrane stress",
    };
    heading::draw(
        &mut sheet,
        title,
        &heading::of_saw(&report.scene.name, &report.condition),
    );
    draw_stress(&mut sheet, membrane);
    if let Some(heat) = heat {
        draw_speeds(&mut sheet, heat, report.operating.as_ref().map(|o| o.rpm));
    }
    Some(sheet)
}

fn draw_stress(sheet: &mut Sheet, membrane: &BladeStress) {
    let mm: Vec<f64> = membrane.radius_m.iter().map(|r| 1e3 * r).collect();
    let ends = [mm.first(), mm.last()].map(|end| end.copied().unwrap_or(0.0));
    let radius = Axis::linear(ends, STRESS.across());
    let all = membrane.radial_pa.iter().chain(&membrane.hoop_pa);
    let [low, high] = extremes(all.map(|pa| 1e-6 * pa).chain([0.0]));
    let step = round_up(((high - low) / 8.0).max(1e-3));
    let values = [(low / step).floor() * step, (high / step).ceil() * step];
    let stress = Axis::linear(values, STRESS.upwards());
    draw_vertical(
        sheet,
        &stress,
        &STRESS,
        "stress, tension upwards\u{2003}[MPa]",
    );
    draw_named(sheet, &radius, STRESS.bottom, "radius\u{2003}[mm]");
    sheet.horizontal(stress.at(0.0), &STRESS, Stroke::solid(INK, HAIRLINE));
    let curves: [(&[f64], Colour, &str); 2] = [
        (&membrane.hoop_pa, FORWARD, "hoop"),
        (&membrane.radial_pa, BACKWARD, "radial"),
    ];
    let labels = curves.map(|(values, ..)| Extent {
        centre: stress.at(1e-6 * values.last().copied().unwrap_or(0.0)),
        length: LINE,
    });
    let labels = push_apart(labels, [STRESS.top, STRESS.bottom]);
    for ((values, colour, name), label) in curves.into_iter().zip(labels) {
        let places = mm.iter().zip(values);
        let places: Vec<_> = places
            .map(|(r, s)| [radius.at(*r), stress.at(1e-6 * s)])
            .collect();
        draw_inside(sheet, &STRESS, &places, Stroke::solid(colour, CURVE));
        if let Some(y) = label {
            let letters = Lettering::regular(LABEL_SIZE, colour, Anchor::Start);
            sheet.text([STRESS.right + 8.0, y + 0.36 * LABEL_SIZE], letters, name);
        }
    }
}

fn draw_speeds(sheet: &mut Sheet, heat: &ToleratedHeat, operating_rpm: Option<f64>) {
    let curves = || heat.critical_speeds.iter();
    let rises = curves().flat_map(|curve| curve.rise_k.iter().copied());
    let rise = Axis::linear(extremes(rises.chain([0.0])), SPEEDS.across());
    let top = curves().flat_map(|curve| &curve.rpm);
    let top = top.fold(operating_rpm.unwrap_or(0.0), |top, rpm| top.max(*rpm));
    let speed = Axis::linear([0.0, 1.08 * top], SPEEDS.upwards());
    draw_vertical(sheet, &speed, &SPEEDS, "");
    let name = "critical speeds\u{2003}[rpm]";
    name_upright(sheet, SPEEDS.left - 62.0, &SPEEDS, name);
    let name = "peak of the temperature profile\u{2003}[K]";
    draw_named(sheet, &rise, SPEEDS.bottom, name);
    draw_curves(sheet, heat, (&rise, &speed));
    draw_limits(sheet, heat, (&rise, &speed), operating_rpm);
}

fn draw_curves(sheet: &mut Sheet, heat: &ToleratedHeat, (rise, speed): (&Axis, &Axis)) {
    let labels = heat.critical_speeds.iter().map(|curve| Extent {
        centre: speed.at(curve.rpm.last().copied().unwrap_or(0.0)),
        length: LINE,
    });
    let labels = push_apart(labels, [SPEEDS.top, SPEEDS.bottom]);
    // If the peak of the temperature profile is negative, the first point of a curve is the one at the right
    // end.
    let leftwards = heat
        .critical_speeds
        .iter()
        .any(|curve| curve.rise_k.last().is_some_and(|k| *k < 0.0));
    for (curve, label) in heat.critical_speeds.iter().zip(labels) {
        let places = curve.rise_k.iter().zip(&curve.rpm);
        let places: Vec<_> = places
            .map(|(k, rpm)| [rise.at(*k), speed.at(*rpm)])
            .collect();
        draw_inside(sheet, &SPEEDS, &places, Stroke::solid(FORWARD, CURVE));
        let end = match leftwards {
            true => places.first(),
            false => places.last(),
        };
        if let (Some(y), Some(end)) = (label, end) {
            let at = [SPEEDS.right + 14.0, y];
            sheet.line([*end, at], Stroke::solid(QUIET, 0.6 * HAIRLINE));
            let letters = Lettering::regular(LABEL_SIZE, FORWARD, Anchor::Start);
            sheet.text([at[0] + 4.0, y + 0.36 * LABEL_SIZE], letters, &curve.name);
        }
    }
}

fn draw_limits(
    sheet: &mut Sheet,
    heat: &ToleratedHeat,
    (rise, speed): (&Axis, &Axis),
    operating_rpm: Option<f64>,
) {
    let kelvin = |k: f64| {
        let sign = if k > 0.0 { "+" } else { "" };
        format!("{sign}{} K", tick_label((10.0 * k).round() / 10.0))
    };
    let dashed = |colour, dash| Stroke::dashed(colour, HAIRLINE, dash);
    if heat.rise_k != 0.0 && rise.shows(heat.rise_k) {
        let x = rise.at(heat.rise_k);
        sheet.vertical(x, &SPEEDS, dashed(QUIET, FINE_DASH));
        let letters = Lettering::regular(LABEL_SIZE, QUIET, Anchor::Middle);
        let text = format!("the scene, {}", kelvin(heat.rise_k));
        sheet.text([x, SPEEDS.top - 7.0], letters, &text);
    }
    if let Some(rpm) = operating_rpm {
        let y = speed.at(rpm);
        sheet.horizontal(y, &SPEEDS, dashed(INK, DASH));
        let letters = Lettering::regular(LABEL_SIZE, INK, Anchor::Start);
        let text = format!("operating speed, {rpm:.0} rpm");
        sheet.text_on_paper([SPEEDS.left + 8.0, y + LINE], letters, &text);
    }
    let mut limit = |k: f64, rpm: f64, colour: Colour, text: String| {
        if rise.shows(k) {
            let at = [rise.at(k), speed.at(rpm)];
            sheet.disc(at, 4.5, colour);
            let letters = Lettering::regular(LABEL_SIZE, colour, Anchor::End);
            // The label of a limit at the operating speed is below the label of that speed; the label of a
            // limit at rest is above the axis.
            let below = if rpm > 0.0 { 2.1 * LINE } else { -9.0 };
            sheet.text_on_paper([at[0] - 9.0, at[1] + below], letters, &text);
        }
    };
    if let (Some(found), Some(rpm)) = (&heat.operating_limit, operating_rpm) {
        let text = format!("critical from {} on", kelvin(found.rise_k));
        limit(found.rise_k, rpm, FLUTTER, text);
    }
    let Some(found) = &heat.buckling else {
        return;
    };
    let text = format!("buckles at rest from {} on", kelvin(found.rise_k));
    if rise.shows(found.rise_k) {
        limit(found.rise_k, 0.0, ALARM, text);
        return;
    }
    // The temperature of buckling is beyond one end of the axis; the text is at that end and has an arrow.
    let (anchor, x, text) = match found.rise_k > 0.0 {
        true => (Anchor::End, SPEEDS.right, format!("{text} →")),
        false => (Anchor::Start, SPEEDS.left + 8.0, format!("← {text}")),
    };
    let letters = Lettering::regular(LABEL_SIZE, ALARM, anchor);
    sheet.text_on_paper([x, SPEEDS.bottom - 9.0], letters, &text);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::sample::empty_report;
    use crate::figure::tidy::{assert_tidy, texts};
    use crate::report::{CriticalCurve, OperatingPoint, ToleratedRise};

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
            lowest_critical_rpm: Some(3000.0 / 0.7),
            of_lowest_critical: Some(0.7),
            limit: 0.85,
            within_limit: Some(true),
            verdict: crate::report::StabilityState::Stable,
            inside_instability: None,
            at_critical_rpm: None,
            side_force_factor: None,
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
            let drawn = sheet(&report(rise_k)).unwrap();
            assert_tidy(&drawn);
            let written = texts(&drawn);
            let has = |text: &str| written.iter().any(|(_, own)| *own == text);
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
            let drawn = sheet(&report).unwrap();
            assert_tidy(&drawn);
            assert!(texts(&drawn).iter().any(|(_, own)| *own == said), "{said}");
        }
    }

    #[test]
    fn without_temperature_there_is_the_stress_alone_and_without_stress_nothing() {
        let mut rolled = report(0.0);
        rolled.membrane.as_mut().unwrap().heat = None;
        let drawn = sheet(&rolled).unwrap();
        assert_tidy(&drawn);
        assert_eq!(drawn.size().0, WIDTHS[1]);
        rolled.membrane = None;
        assert!(sheet(&rolled).is_none());
    }
}
