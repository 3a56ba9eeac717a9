//! Saws whose chosen basis is compared with a larger one.
//!
//! Pads of 1e4 to 1e9 N/m on blades with bores of 0.1 to 0.8, one to three of them, of many
//! sizes and places.
#![allow(dead_code)]

use crate::common::Worst;
use sawflutter::model::plate::{Plate, Resolution};
use sawflutter::model::scene::{GuideFile, Scene};
use sawflutter::modes::Assembled;
use sawflutter::stability::ChosenBasis;

pub struct Saw {
    pub what: String,
    pub scene: Scene,
}

pub fn saws() -> Vec<Saw> {
    let mut saws = Vec::new();
    for (i, stiffness_n_per_m) in [1e4, 1e5, 1e6, 1e7, 1e8, 1e9].into_iter().enumerate() {
        for (k, bore) in [0.1, 0.28, 0.45, 0.6, 0.8].into_iter().enumerate() {
            let mut file = Scene::paper().file().clone();
            let rim_m = 0.5 * file.blade.outer_diameter_m;
            let width_m = rim_m * (1.0 - bore);
            // Multiples of irrational numbers spread places and sizes.
            let spread = |step: f64| (step * (5 * i + k) as f64).fract();
            let pad = |angle_deg: f64, place: f64| GuideFile {
                radius_m: rim_m - width_m * place,
                angle_deg,
                radial_length_m: width_m * (0.2 + 0.5 * spread(0.37)),
                tangential_length_m: rim_m * (0.1 + 0.4 * spread(0.61)),
                stiffness_n_per_m,
                damping_n_s_per_m: 0.0,
                ..GuideFile::default()
            };
            file.blade.inner_diameter_m = bore * file.blade.outer_diameter_m;
            file.sweep = None;
            file.operating_rpm = None;
            file.guides = vec![pad(-55.0, 0.25 + 0.5 * spread(0.23))];
            if (i + k) % 3 == 0 {
                file.guides.push(pad(70.0 + 3.0 * (5 * i + k) as f64, 0.6));
            }
            saws.push(Saw {
                what: format!("{stiffness_n_per_m:e} N/m, bore {bore}"),
                scene: Scene::try_from(file).unwrap(),
            });
        }
    }
    saws
}

/// Saws with every quantity spread evenly over its range, by the fractions of multiples of irrational numbers. The
/// margin of the estimate was chosen with the first ninety of them; the others are independent of it.
pub fn drawn_saws(numbers: std::ops::Range<usize>) -> Vec<Saw> {
    let saw = |k: usize| {
        let spread = |prime: f64, low: f64, high: f64| {
            low + (high - low) * ((k + 1) as f64 * prime.sqrt()).fract()
        };
        let mut file = Scene::paper().file().clone();
        let rim_m = spread(2.0, 0.1, 0.6);
        let bore = spread(3.0, 0.1, 0.8);
        let width_m = rim_m * (1.0 - bore);
        let stiffness_n_per_m = 10_f64.powf(spread(5.0, 4.0, 9.0));
        file.blade.outer_diameter_m = 2.0 * rim_m;
        file.blade.inner_diameter_m = 2.0 * rim_m * bore;
        file.blade.thickness_m = rim_m * spread(7.0, 0.004, 0.012);
        file.sweep = None;
        file.operating_rpm = None;
        (file.cut, file.runup, file.probe, file.measured) = (None, None, None, None);
        let pad = |turn: f64| GuideFile {
            radius_m: rim_m - width_m * spread(11.0, 0.1, 0.9),
            angle_deg: turn * spread(13.0, 60.0, 180.0),
            radial_length_m: width_m * spread(17.0, 0.1, 0.8),
            tangential_length_m: rim_m * spread(19.0, 0.05, 0.6),
            stiffness_n_per_m,
            damping_n_s_per_m: 0.0,
            ..GuideFile::default()
        };
        file.guides = (0..=k % 3).map(|turn| pad(turn as f64)).collect();
        Saw {
            what: format!("{stiffness_n_per_m:.1e} N/m, bore {bore:.2}, other saw {k}"),
            scene: Scene::try_from(file).unwrap(),
        }
    };
    numbers.map(saw).collect()
}

/// True and estimated errors of the critical speeds on a basis that is chosen for a tolerance.
pub struct Promise {
    pub tolerance: f64,
    pub true_error: f64,
    pub estimate: f64,
}

impl Promise {
    pub fn is_in_reach(&self) -> bool {
        self.estimate <= self.tolerance
    }
}

/// The errors of a saw for several tolerances, by comparison with its critical speeds on the reference basis.
pub fn promises(saw: &Saw, tolerances: &[f64], truth: Resolution) -> Vec<Promise> {
    let chosen = |tolerance: &f64| ChosenBasis::new(&saw.scene, *tolerance).unwrap();
    let all: Vec<ChosenBasis> = tolerances.iter().map(chosen).collect();
    let to = all
        .iter()
        .map(|chosen| chosen.range_rad_per_s.to_rad_per_s)
        .fold(0.0, f64::max);
    let truth = Assembled::from(Plate::new(&saw.scene, truth))
        .critical_speeds(Some(&|_| to))
        .unwrap();
    let promise = |(chosen, tolerance): (&ChosenBasis, &f64)| {
        let top = chosen.range_rad_per_s.to_rad_per_s;
        let within = chosen.critical.iter().filter(|c| c.speed_rad_per_s <= top);
        let errors = within
            .zip(&truth)
            .map(|(c, t)| (c.speed_rad_per_s / t.speed_rad_per_s - 1.0).abs());
        Promise {
            tolerance: *tolerance,
            true_error: errors.reduce(f64::max).expect("a critical speed"),
            estimate: chosen.estimated_relative_error,
        }
    };
    all.iter().zip(tolerances).map(promise).collect()
}

/// The errors of many saws: true errors over their estimates, and over the tolerances that the basis can reach.
#[derive(Default)]
pub struct Kept {
    ratios: Worst,
    promises: Worst,
}

impl Kept {
    pub fn add(&mut self, what: &str, promises: &[Promise]) {
        for p in promises {
            let place = || format!("{what}, {:e}", p.tolerance);
            self.ratios.add(p.true_error / p.estimate, place);
            if p.is_in_reach() {
                self.promises.add(p.true_error / p.tolerance, place);
            }
        }
    }

    /// Checks the errors, of which at least `reached` must be within the tolerances that a basis can reach.
    pub fn assert(&self, reached: usize) {
        let found = self.promises.count;
        println!("{found} of {} tolerances are in reach", self.ratios.count);
        self.ratios
            .assert_at_most("true error over its estimate", 1.0);
        self.promises
            .assert_at_most("true error over its tolerance", 1.0);
        assert!(found >= reached, "too much is out of reach: {found}");
    }
}
