//! Where the blade stands over speed, and the frequencies of small motions about that beside the linear
//! Campbell diagram.

use super::axis::{Axis, Spread, draw_horizontal, draw_named, draw_vertical};
use super::canvas::{Frame, Sheet, Stroke};
use super::clip::clip;
use super::key::Key;
use super::style::{
    ALARM, BACKWARD, BETWEEN_FACTS, Colour, DASH, DIVERGENCE_SHADE, FLUTTER_SHADE, FORWARD,
    HAIRLINE, INK, PAPER, STANDING, STRONG_CURVE, tint,
};
use super::{bands, heading};
use crate::report::{DeflectReport, EquilibriumCurveEntry, JumpEntry, SlowSweepEntry};

const WIDTH: u32 = 1200;
const HEIGHT: u32 = 1000;
const LEAN: Frame = Frame {
    left: 92.0,
    top: 92.0,
    right: 1160.0,
    bottom: 460.0,
};
const FREQUENCIES: Frame = Frame {
    top: 500.0,
    bottom: 880.0,
    ..LEAN
};
const UP: Colour = FORWARD;
const DOWN: Colour = BACKWARD;
/// The curve while the speed rises is drawn as much wider, so that both are seen where they are the same.
const WIDER: f64 = STRONG_CURVE;
const NARROWER: f64 = 1.4;
/// Above the highest of so many frequencies of the blade at rest the diagram ends.
const SHOWN: usize = 6;

pub fn sheet(report: &DeflectReport) -> Sheet {
    let mut sheet = Sheet::new(WIDTH, HEIGHT);
    heading::draw(&mut sheet, &report.scene.name, &facts(report));
    let speeds = [report.from_rpm, report.to_rpm];
    let speed = Axis::new(speeds, [LEAN.left, LEAN.right], Spread::Linear);
    bands::shade(
        &mut sheet,
        &speed,
        report.instabilities.iter(),
        &[LEAN, FREQUENCIES],
    );
    draw_lean(&mut sheet, report, &speed);
    draw_horizontal(&mut sheet, &speed, LEAN.bottom, false);
    draw_frequencies(&mut sheet, report, &speed);
    draw_named(
        &mut sheet,
        &speed,
        FREQUENCIES.bottom,
        "rotation speed Ω\u{2003}[rpm]",
    );
    draw_key(&mut sheet);
    sheet
}

fn facts(report: &DeflectReport) -> String {
    let force = format!(
        "{} N across the rim at {}°",
        report.force_n, report.force_angle_deg
    );
    let probe = format!("deflection at the probe at {}°", report.probe_angle_deg);
    let thickness_m = report.scene.blade.thickness_m;
    let jumps = |sweep: &SlowSweepEntry| {
        let seen = sweep.jumps.iter().filter(|jump| jump.is_seen(thickness_m));
        seen.count()
    };
    let jumps = format!(
        "jumps: {} while the speed rises, {} while it falls",
        jumps(&report.up),
        jumps(&report.down)
    );
    [force, probe, jumps].join(BETWEEN_FACTS)
}

fn draw_lean(sheet: &mut Sheet, report: &DeflectReport, speed: &Axis) {
    let of_curves = report.curves.iter().flat_map(|curve| &curve.deflection_m);
    let sweeps = [&report.up, &report.down];
    let of_sweeps = sweeps.iter().flat_map(|sweep| &sweep.arcs);
    let of_sweeps = of_sweeps.flat_map(|arc| &arc.deflection_m);
    let most = of_curves
        .chain(of_sweeps)
        .fold(0.0_f64, |most, m| most.max(m.abs()));
    let reach = 1.1e3 * most.max(1e-9);
    let lean = Axis::new([-reach, reach], [LEAN.bottom, LEAN.top], Spread::Linear);
    draw_vertical(sheet, &lean, &LEAN, "deflection\u{2003}[mm]");
    for curve in &report.curves {
        draw_curve(sheet, curve, speed, &lean);
    }
    for (sweep, colour, width) in [(&report.up, UP, WIDER), (&report.down, DOWN, NARROWER)] {
        for arc in &sweep.arcs {
            let places = arc.rpm.iter().zip(&arc.deflection_m);
            let places: Vec<[f64; 2]> = places
                .map(|(rpm, m)| [speed.at(*rpm), lean.at(1e3 * m)])
                .collect();
            for part in clip(&places, &LEAN) {
                sheet.line(part, Stroke::solid(colour, width));
            }
        }
        for jump in sweep
            .jumps
            .iter()
            .filter(|jump| jump.is_seen(report.scene.blade.thickness_m))
        {
            draw_jump(sheet, jump, (speed, &lean), colour);
        }
        if let Some(rpm) = sweep.valid_until_rpm {
            let line = [LEAN.top, LEAN.bottom].map(|y| [speed.at(rpm), y]);
            sheet.line(line, Stroke::solid(ALARM, 1.5 * HAIRLINE));
        }
    }
    for turn in report.curves.iter().flat_map(|curve| &curve.turns) {
        let at = [speed.at(turn.rpm), lean.at(1e3 * turn.deflection_m)];
        sheet.ring(at, 3.0, Stroke::solid(INK, HAIRLINE), PAPER);
    }
}

/// Stable parts as thin lines, unstable ones dashed.
fn draw_curve(sheet: &mut Sheet, curve: &EquilibriumCurveEntry, speed: &Axis, lean: &Axis) {
    let place = |k: usize| [speed.at(curve.rpm[k]), lean.at(1e3 * curve.deflection_m[k])];
    let mut first = 0;
    for k in 1..=curve.rpm.len() {
        let is_stable = |k: usize| curve.negative_eigenvalues[k] == 0;
        let goes_on = k < curve.rpm.len() && is_stable(k) == is_stable(first);
        if goes_on {
            continue;
        }
        let stroke = match is_stable(first) {
            true => Stroke::solid(STANDING, NARROWER),
            false => Stroke {
                dash: Some(DASH),
                ..Stroke::solid(STANDING, HAIRLINE)
            },
        };
        let places: Vec<[f64; 2]> = (first..(k + 1).min(curve.rpm.len())).map(place).collect();
        for part in clip(&places, &LEAN) {
            sheet.line(part, stroke);
        }
        first = k;
    }
}

fn draw_jump(sheet: &mut Sheet, jump: &JumpEntry, (speed, lean): (&Axis, &Axis), colour: Colour) {
    let x = speed.at(jump.rpm);
    let [from, to] = [jump.from_m, jump.to_m].map(|m| lean.at(1e3 * m));
    sheet.line([[x, from], [x, to]], Stroke::solid(colour, HAIRLINE));
    let back = 7.0_f64.copysign(from - to);
    if (from - to).abs() > 9.0 {
        for aside in [-4.0, 4.0] {
            sheet.line(
                [[x + aside, to + back], [x, to]],
                Stroke::solid(colour, NARROWER),
            );
        }
    }
}

fn draw_frequencies(sheet: &mut Sheet, report: &DeflectReport, speed: &Axis) {
    let at_rest = report
        .campbell
        .branches
        .iter()
        .filter_map(|branch| branch.frequency_hz.first());
    let mut at_rest: Vec<f64> = at_rest.copied().collect();
    at_rest.sort_by(f64::total_cmp);
    let top = at_rest
        .get(SHOWN - 1)
        .or(at_rest.last())
        .copied()
        .unwrap_or(1.0);
    let places = [FREQUENCIES.bottom, FREQUENCIES.top];
    let frequency = Axis::new([0.0, 1.1 * top], places, Spread::Linear);
    draw_vertical(
        sheet,
        &frequency,
        &FREQUENCIES,
        "frequency in space\u{2003}[Hz]",
    );
    for branch in &report.campbell.branches {
        let samples = branch.rpm.iter().zip(&branch.frequency_hz);
        let places: Vec<[f64; 2]> = samples
            .map(|(rpm, hz)| [speed.at(*rpm), frequency.at(*hz)])
            .collect();
        for part in clip(&places, &FREQUENCIES) {
            sheet.line(part, Stroke::solid(tint(STANDING, 0.6), NARROWER));
        }
    }
    for (sweep, colour, radius) in [(&report.up, UP, 2.2), (&report.down, DOWN, 1.1)] {
        for arc in &sweep.arcs {
            for (rpm, frequencies) in arc.rpm.iter().zip(&arc.frequencies_hz) {
                for hz in frequencies.iter().filter(|hz| frequency.shows(**hz)) {
                    sheet.disc([speed.at(*rpm), frequency.at(*hz)], radius, colour);
                }
            }
        }
    }
}

fn draw_key(sheet: &mut Sheet) {
    let line = |stroke: Stroke| {
        move |sheet: &mut Sheet, [x, y]: [f64; 2]| sheet.line([[x, y], [x + 24.0, y]], stroke)
    };
    let dashed = Stroke {
        dash: Some(DASH),
        ..Stroke::solid(STANDING, HAIRLINE)
    };
    let y = f64::from(HEIGHT);
    Key::new(sheet, LEAN.left, y - 52.0)
        .mark(24.0, line(Stroke::solid(UP, WIDER)))
        .word("stable, while the speed rises")
        .mark(24.0, line(Stroke::solid(DOWN, NARROWER)))
        .word("while it falls")
        .mark(24.0, line(Stroke::solid(STANDING, NARROWER)))
        .word("stable, not reached")
        .mark(24.0, line(dashed))
        .word("unstable")
        .mark(6.0, |sheet, [x, y]| {
            sheet.ring([x + 3.0, y], 3.0, Stroke::solid(INK, HAIRLINE), PAPER);
        })
        .word("fold or bifurcation");
    Key::new(sheet, LEAN.left, y - 26.0)
        .mark(24.0, line(Stroke::solid(tint(STANDING, 0.6), NARROWER)))
        .word("frequencies of the flat blade")
        .shade(DIVERGENCE_SHADE)
        .word("the flat blade diverges")
        .shade(FLUTTER_SHADE)
        .word("the flat blade flutters");
}
