//! Goal: every number that is listed or drawn has an estimated error, the true one is below it,
//! and where the estimate is within the tolerance the promise is kept.
//!
//! The truth is Bessel roots for blades that nothing touches, else a basis of 2520 functions.

use crate::common::{AnnulusRoot, Worst, table};
use crate::tolerance::{Saw, other_saws};
use rayon::prelude::*;
use sawflutter::plate::{Plate, Resolution};
use sawflutter::scene::{Accuracy, DampingFile, InPlane, Mount, Scene, SweepFile};
use sawflutter::spectrum::{Assembled, LowestModes, Mode};
use sawflutter::stability::{Analysis, ChosenBasis, Instability, InstabilityKind, search_bands};

const TRUTH: Resolution = Resolution {
    max_diameters: 52,
    radial_functions: 24,
};

/// A blade that no guide touches, at an accuracy.
fn annulus(bc: &str, nu: f64, ratio: f64, accuracy: Accuracy) -> Scene {
    let mut file = Scene::paper().file().clone();
    file.guides.clear();
    file.sweep = Some(SweepFile {
        from_rpm: 0.0,
        to_rpm: 1000.0,
    });
    (file.cut, file.runup, file.probe, file.measured) = (None, None, None, None);
    (file.operating_rpm, file.tolerance) = (None, None);
    file.accuracy = accuracy;
    file.blade.inner_diameter_m = ratio * file.blade.outer_diameter_m;
    file.blade.material.poisson_ratio = nu;
    file.mount = match bc {
        "FF" => Mount::Spline {},
        _ => Mount::Collar {
            diameter_m: file.blade.inner_diameter_m,
            in_plane: InPlane::Free,
        },
    };
    Scene::try_from(file).unwrap()
}

/// The roots were computed for ν = 0.3; a free blade of bore ratio 0.1 listed its mode of one
/// diameter and one circle 1.1 % too high at `reference`, where 1e-4 is promised.
#[test]
fn every_mode_at_rest_that_is_listed_keeps_the_tolerance() {
    let roots: Vec<AnnulusRoot> = table("annulus_exact.csv");
    let mut errors = Worst::default();
    for accuracy in [Accuracy::Draft, Accuracy::Design, Accuracy::Reference] {
        let mut promises = Worst::default();
        for bc in ["FF", "CF"] {
            for ratio in [0.1, 0.3, 0.5, 0.7, 0.9] {
                let scene = annulus(bc, 0.3, ratio, accuracy);
                let analysis = Analysis::new(&scene).unwrap();
                let report = analysis.report();
                let what = format!("{bc}, a/b = {ratio}, {accuracy:?}");
                assert!(report.accuracy.reached, "{what}");
                let blade = scene.blade();
                let unit = (blade.flexural_rigidity_n_m() / blade.mass_per_area_kg_per_m2()).sqrt()
                    / blade.outer_radius_m.powi(2);
                for mode in &report.modes_at_rest {
                    let (n, s) = (mode.nodal_diameters, mode.nodal_circles);
                    // Rigid heave and tilt have no frequency: the first of n = 0 and 1 has a circle.
                    let s = s - usize::from(bc == "FF" && n <= 1);
                    let same =
                        |r: &&AnnulusRoot| (r.bc.as_str(), r.ratio, r.n, r.s) == (bc, ratio, n, s);
                    let Some(root) = roots.iter().find(same) else {
                        continue;
                    };
                    let found = mode.frequency_hz * std::f64::consts::TAU / unit;
                    let error = (found / root.lambda2 - 1.0).abs();
                    let estimate = mode.estimated_relative_error.unwrap();
                    errors.add(error / (estimate + ROUNDING), || {
                        format!("{what}, {}", mode.name)
                    });
                    promises.add(error, || format!("{what}, {}", mode.name));
                }
            }
        }
        promises.assert_at_most(
            &format!("modes at rest, {accuracy:?}"),
            accuracy.tolerance(),
        );
        assert!(promises.count > 80);
    }
    errors.assert_at_most("true error over its estimate", 1.0);
}

/// What a saw's numbers are off by, over what is estimated.
#[derive(Default)]
struct Ratios {
    at_rest: Worst,
    drawn: Worst,
    critical: Worst,
    growth: Worst,
    onsets: Worst,
    promise: Worst,
}

/// The same saw on the basis of the truth.
struct Truth {
    lowest: LowestModes,
    at_rest: Vec<Mode>,
    critical: Vec<f64>,
    bands: Vec<Instability>,
}

impl Truth {
    fn new(scene: &Scene) -> Self {
        let saw = Assembled::from(Plate::new(scene, TRUTH));
        let lowest = LowestModes::new(&saw.plate);
        let range = ChosenBasis::new(scene, 1e-3).unwrap().range_rad_per_s;
        let named = saw.critical_speeds(Some(&|_| 1.1 * range.1)).unwrap();
        let critical = named.iter().map(|c| c.speed_rad_per_s).collect();
        Truth {
            at_rest: lowest.at(0.0, 30).unwrap(),
            critical,
            bands: search_bands(saw, named, range).unwrap().0,
            lowest,
        }
    }

    /// Bands that were found, each with the same one of the truth: of one kind they follow each
    /// other in the same order, where neither list has one that the other lacks.
    fn pairs<'a>(&'a self, found: &'a [Instability]) -> Vec<(usize, &'a Instability)> {
        let mut pairs = Vec::new();
        for kind in [InstabilityKind::Divergence, InstabilityKind::Flutter] {
            let truth: Vec<&Instability> = self.bands.iter().filter(|b| b.kind == kind).collect();
            let places: Vec<usize> = (0..found.len())
                .filter(|&k| found[k].kind == kind)
                .collect();
            if truth.len() == places.len() {
                pairs.extend(places.into_iter().zip(truth));
            }
        }
        pairs
    }
}

fn compare(saw: &Saw, truth: &Truth, tolerance: f64, ratios: &mut Ratios) {
    let scene = saw.scene.edited(|saw| saw.tolerance = Some(tolerance));
    let scene = scene.unwrap();
    let analysis = Analysis::new(&scene).unwrap();
    let report = analysis.report();
    let estimates = analysis.estimates.as_ref().unwrap();
    let what = |kind: String| format!("{}, {tolerance:e}, {kind}", saw.what);
    for (found, truth) in report.modes_at_rest.iter().zip(&truth.at_rest) {
        let exact = truth.frequency_rad_per_s() / std::f64::consts::TAU;
        let error = (found.frequency_hz / exact - 1.0).abs();
        let estimate = found.estimated_relative_error.unwrap();
        let place = || what(format!("{exact:.2} Hz at rest"));
        ratios.at_rest.add(error / (estimate + ROUNDING), place);
        if report.accuracy.reached {
            ratios.promise.add(error / tolerance, place);
        }
    }
    let found = analysis.model.critical.iter().map(|c| c.speed_rad_per_s);
    for ((found, truth), estimate) in found.zip(&truth.critical).zip(&estimates.critical) {
        let place = || what(format!("critical at {truth:.1} rad/s"));
        let error = (found / truth - 1.0).abs();
        ratios.critical.add(error / (estimate + ROUNDING), place);
    }
    drawn_at_the_top(&analysis, &truth.lowest, &what, ratios);
    let bands = &analysis.chart.instabilities;
    for (k, truth) in truth.pairs(bands) {
        let (found, error) = (&bands[k], &estimates.bands[k]);
        let Some((growth, speed)) = error.growth.zip(error.speed) else {
            continue;
        };
        let off = (found.peak_growth_per_s / truth.peak_growth_per_s - 1.0).abs();
        let place = || {
            what(format!(
                "{:?} at {:.2} rad/s, {:.3} 1/s, off by {off:.1e}, estimated {growth:.1e}",
                found.kind, found.from_rad_per_s, found.peak_growth_per_s
            ))
        };
        println!("{}", place());
        // What the search for the peak misses no larger basis tells: other tests hold it.
        let share = |b: &Instability| {
            (b.peak_rad_per_s - b.from_rad_per_s) / (b.to_rad_per_s - b.from_rad_per_s)
        };
        if (share(found) - share(truth)).abs() > 0.1 {
            println!("another peak: {}", place());
            continue;
        }
        ratios.growth.add(off / (growth + ROUNDING), place);
        let error = (found.from_rad_per_s / truth.from_rad_per_s - 1.0).abs();
        ratios.onsets.add(error / (speed + ROUNDING), place);
    }
}

/// Solvers, of the truth too, are good to this.
const ROUNDING: f64 = 1e-7;

/// The frequencies at the end of the sweep, where most waves are reflected.
fn drawn_at_the_top(
    analysis: &Analysis,
    lowest: &LowestModes,
    what: &dyn Fn(String) -> String,
    ratios: &mut Ratios,
) {
    let sample = analysis.chart.campbell.samples.last().unwrap();
    let speed = sample.speed_rad_per_s;
    let truth = lowest.at(speed, sample.modes.len() + 4).unwrap();
    let estimates = analysis.estimates.as_ref().unwrap();
    let errors = estimates.frequencies(&analysis.model, speed, &sample.modes);
    let drawn = sample.modes.iter().zip(errors);
    for (mode, estimate) in drawn.filter_map(|(mode, estimate)| Some((mode, estimate?))) {
        let frequency = mode.mode.frequency_rad_per_s();
        let same = |m: &&Mode| m.kind == mode.mode.kind;
        let distances = truth.iter().filter(same);
        let distance = distances.map(|m| (m.frequency_rad_per_s() - frequency).abs());
        let error = distance.fold(f64::INFINITY, f64::min) / mode.name.body_frequency_rad_per_s;
        let place = || what(format!("{frequency:.2} rad/s at the top"));
        if error.is_finite() {
            ratios.drawn.add(error / (estimate + 1e-5), place);
        }
    }
}

/// Draft and design, where the error is largest, on saws of which four had no part in choosing
/// any margin.
#[test]
fn true_errors_are_below_their_estimates() {
    let mut ratios = Ratios::default();
    for saw in other_saws().iter().step_by(5) {
        let truth = Truth::new(&saw.scene);
        for tolerance in [1e-2, 1e-3] {
            compare(saw, &truth, tolerance, &mut ratios);
        }
    }
    for (what, worst) in [
        ("at rest", &ratios.at_rest),
        ("drawn", &ratios.drawn),
        ("critical speeds", &ratios.critical),
        ("growth", &ratios.growth),
        ("onsets", &ratios.onsets),
    ] {
        assert!(worst.count > 50, "{what}: {} values", worst.count);
        worst.assert_at_most(&format!("{what}: true error over its estimate"), 1.0);
    }
    ratios
        .promise
        .assert_at_most("true error over the tolerance", 1.0);
}

/// Blades with a lossy material, air and pads that damp or do not, of soft and of stiff pads.
fn damped_saws() -> Vec<Scene> {
    let damped = |k: usize| {
        // Irrational multiples spread the numbers over their ranges.
        let spread = |step: f64| (step * (k + 1) as f64).fract();
        let scene = Scene::paper().edited(|saw| {
            (saw.cut, saw.runup, saw.probe, saw.measured) = (None, None, None, None);
            saw.damping = Some(DampingFile {
                material_retardation_time_s: 10_f64.powf(-7.0 + 1.7 * spread(0.754_877)),
                air_n_s_per_m3: spread(0.569_840),
                air_rotation_share: 0.5,
            });
            let pad = &mut saw.guides[0];
            pad.radius_m = 0.17 + 0.11 * spread(0.618_034);
            pad.stiffness_n_per_m = 10_f64.powf(5.0 + 2.7 * spread(0.414_214));
            pad.damping_n_s_per_m = if k.is_multiple_of(2) {
                0.0
            } else {
                10_f64.powf(1.0 + 2.0 * spread(0.267_949))
            };
        });
        scene.unwrap()
    };
    (0..6).map(damped).collect()
}

/// Against 732 functions, the largest basis of a damped blade, for what 1e-4 leaves of a growth rate is far below what
/// drafts leave: net growth is the small difference of what the guides feed and what damping takes.
#[test]
fn true_errors_of_damped_bands_are_below_their_estimates() {
    let (mut growth, mut onsets) = (Worst::default(), Worst::default());
    let tolerances = [1e-4, 2e-2, 6e-3];
    let analysed = damped_saws().into_par_iter().map(|scene| {
        tolerances.map(|tolerance| {
            let scene = scene.edited(|saw| saw.tolerance = Some(tolerance)).unwrap();
            Analysis::new(&scene).unwrap()
        })
    });
    let analysed: Vec<[Analysis; 3]> = analysed.collect();
    for (k, [truth, coarse @ ..]) in analysed.iter().enumerate() {
        for (analysis, tolerance) in coarse.iter().zip(&tolerances[1..]) {
            let estimates = analysis.estimates.as_ref().unwrap();
            for (found, error) in analysis.bands().iter().zip(&estimates.bands) {
                let away = |b: &Instability| (b.peak_rad_per_s / found.peak_rad_per_s - 1.0).abs();
                let same = truth.bands().iter().filter(|b| b.kind == found.kind);
                let same = same.min_by(|x, y| away(x).total_cmp(&away(y)));
                // A band that the largest basis does not have, or ends otherwise at the end of the range.
                let Some(truth) = same.filter(|b| away(b) < 1e-2 && b.closed == found.closed)
                else {
                    continue;
                };
                let Some((estimate, speed)) = error.growth.zip(error.speed) else {
                    continue;
                };
                let off = (found.peak_growth_per_s / truth.peak_growth_per_s - 1.0).abs();
                let place = || {
                    format!(
                        "saw {k}, {tolerance:e}, {found}: off by {off:.1e}, estimated {estimate:.1e}"
                    )
                };
                growth.add(off / (estimate + ROUNDING), place);
                let off = (found.from_rad_per_s / truth.from_rad_per_s - 1.0).abs();
                onsets.add(off / (speed + ROUNDING), place);
            }
        }
    }
    assert!(growth.count > 60, "{} bands", growth.count);
    growth.assert_at_most("growth: true error over its estimate", 1.0);
    onsets.assert_at_most("onsets: true error over its estimate", 1.0);
}
