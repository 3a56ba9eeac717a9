//! Mean deflection over an oscillation between guides with an offset, or on one side.

use std::f64::consts::TAU;

use super::amplitude::OscillatingSaw;
use crate::model::plate::Plate;
use crate::model::scene::{GuideSide, Scene, SideForceFile, rad_per_s};
use crate::motion::history::{History, SMALL, product, saws, with_pads};

/// Mean and amplitude at the pad of a clamped blade, in the steady state of a time history under an oscillating force.
fn history_of(scene: &Scene, rpm: f64) -> (f64, f64) {
    let speed = rad_per_s(rpm);
    let history = History::new(scene, speed, None, false);
    let pad = scene.file().guides[0].clone();
    let at_pad = Plate::new(scene, SMALL).functions_at(pad.radius_m, pad.angle_rad());
    let period_s = TAU / speed;
    let steps = (period_s / history.step_s).ceil() as usize;
    let mut state = history.still();
    let (mut mean, mut low, mut high) = (0.0, f64::INFINITY, f64::NEG_INFINITY);
    let periods = (1.0 / period_s).ceil() as usize;
    for period in 0..=periods {
        history.run(&mut state, (0.0, period_s / steps as f64, steps), |_, q| {
            if period == periods {
                let w = product(&at_pad, q);
                mean += w / steps as f64;
                (low, high) = (low.min(w), high.max(w));
            }
        });
    }
    (mean, 0.5 * (high - low))
}

/// Independent value: time histories of a clamped blade with a pad on one side or with an offset, at several speeds and amplitudes. The
/// higher harmonics that the mean neglects are small, because the pad is as soft as the blade.
#[test]
#[cfg_attr(debug_assertions, ignore = "many steps: run it in release")]
fn the_mean_over_an_oscillation_is_that_of_the_time_history() {
    let [.., (_, collar)] = saws(1e-5, 0.0, 0.0);
    for (side, offset_m) in [
        (GuideSide::Left, 0.0),
        (GuideSide::Right, 5e-6),
        (GuideSide::Both, 1.5e-5),
        (GuideSide::Both, 3e-5),
    ] {
        let scene = with_pads(&collar, |pad| {
            (pad.side, pad.offset_m, pad.stiffness_n_per_m) = (side, offset_m, 3e4);
            (pad.radial_length_m, pad.tangential_length_m) = (0.02, 0.02);
        });
        for (rpm, oscillating_n) in [(300.0, 1.0), (500.0, 2.0), (700.0, 0.5)] {
            let force = SideForceFile {
                oscillating_n,
                ..SideForceFile::of(0.0)
            };
            let scene = scene.edited(|file| file.side_force = Some(force)).unwrap();
            let (mean_m, amplitude_m) = history_of(&scene, rpm);
            let saw = OscillatingSaw::new(&scene, SMALL).unwrap();
            let found = saw.means_m(amplitude_m).unwrap()[0];
            assert!(
                (found - mean_m).abs() < 1e-3 * amplitude_m,
                "{side:?} {offset_m} {rpm}: {amplitude_m:e} {mean_m:e} {found:e}"
            );
        }
    }
}

/// At an amplitude far above gap and offset the pads are linear, as they are without a gap; the energy of the oscillation in them, a million
/// times that of the deflection, does not spoil it.
#[test]
fn the_mean_over_a_large_oscillation_is_the_deflection_between_linear_pads() {
    let [_, (_, two), _] = saws(4e-5, 0.0, 0.0);
    for offset_m in [2e-5, 1.5e-4] {
        let guides_out_of_line = two
            .edited(|file| file.guides[1].offset_m = offset_m)
            .unwrap();
        let closed = with_pads(&guides_out_of_line, |pad| pad.gap_m = Some(1e-12));
        let means_m = |scene: &Scene, amplitude_m: f64| {
            let saw = OscillatingSaw::new(scene, SMALL).unwrap();
            saw.means_m(amplitude_m).unwrap()
        };
        let linear = means_m(&closed, 0.0);
        for amplitude_m in [4e-3, 1e-2, 4e-2, 0.4] {
            let found = means_m(&guides_out_of_line, amplitude_m);
            for (found, linear) in found.iter().zip(&linear) {
                let off = (found - linear).abs();
                assert!(off < 1e-2 * offset_m, "{amplitude_m}: {found:e} {linear:e}");
            }
        }
    }
}

/// A pad whose film is as stiff as its contact is a linear spring at every amplitude: it holds the blade as one without a gap does.
#[test]
fn a_pad_with_a_film_as_stiff_as_its_contact_holds_the_blade_at_every_amplitude() {
    let [_, (_, two), _] = saws(4e-5, 0.0, 0.0);
    let out_of_line = two.edited(|file| file.guides[1].offset_m = 1e-4).unwrap();
    let filmed = with_pads(&out_of_line, |pad| {
        pad.film_stiffness_n_per_m = pad.stiffness_n_per_m
    });
    let closed = with_pads(&out_of_line, |pad| pad.gap_m = Some(1e-12));
    let linear = OscillatingSaw::new(&closed, SMALL)
        .unwrap()
        .means_m(0.0)
        .unwrap();
    let saw = OscillatingSaw::new(&filmed, SMALL).unwrap();
    for amplitude_m in [0.0, 1e-5, 1e-3] {
        for (found, linear) in saw.means_m(amplitude_m).unwrap().iter().zip(&linear) {
            assert!(
                (found - linear).abs() < 1e-6,
                "{amplitude_m}: {found:e} {linear:e}"
            );
        }
        let (_, shares) = saw.at(amplitude_m).unwrap();
        assert_eq!(shares, [1.0, 1.0]);
    }
}
