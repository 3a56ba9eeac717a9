//! The run-up of a blade that stretches.

use std::f64::consts::TAU;

use rayon::prelude::*;

use crate::model::plate::Plate;
use crate::model::scene::{Point, RunUpFile, SideForce};
use crate::modes::branches::Progress;
use crate::motion::stretched_blade::StretchedBlade;

use super::deflections::Largest;
use super::runup::{MAX_SAMPLES, Moving, RunUpHistory, Step, Steps};
use super::stretched_probe::StretchedProbe;
use super::stretching::{forces, system};
use super::{State, TransientError};

/// Results of a run-up with stretching.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct StretchedRunUp {
    /// Deflection at the probe while the model is valid.
    pub history: RunUpHistory,
    /// Number of shapes of the reduced basis.
    pub shapes: usize,
    /// Largest slope of the blade in the run-up.
    pub largest_slope: f64,
    /// Speed at which slopes exceed 0.1 and the record ends; `None` if they do not.
    pub valid_until_rad_per_s: Option<f64>,
    /// Spectrum of the deflection over the speed.
    pub spectrum: Spectrum,
}

/// Amplitudes of the deflection at the probe over speed and frequency.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Spectrum {
    /// Speed in the middle of each window.
    pub speed_rad_per_s: Vec<f64>,
    /// Frequencies of the response.
    pub frequency_rad_per_s: Vec<f64>,
    /// Amplitudes, one row for each speed.
    pub amplitude_m: Vec<Vec<f64>>,
}

/// Number of modes at rest in the basis, beside the shapes that diverge and the static deflection.
pub(super) const MODES: usize = 14;
/// Number of steps per sample of the spectrum, which gives three samples per period of the highest frequency.
const STRIDE: usize = 8;
/// Number of samples from one evaluation of the slopes to the next.
const LOOKED: usize = 16;
/// Number of speeds and of frequencies of the spectrum.
const SPECTRUM: (usize, usize) = (240, 180);
/// Smallest and largest duration of a window.
const WINDOW_S: (f64, f64) = (1.5, 6.0);

/// Integrates the run-up with the potential of stretching, with steps that resolve the frequency
/// `highest_rad_per_s` and conserve the energy of an undamped blade.
///
/// # Errors
/// [`TransientError::Stretched`] if nothing holds the blade, [`TransientError::SteepByForce`] if the static
/// deflection is too steep, [`TransientError::NotBalanced`] if a step has no solution.
pub fn stretched_run_up(
    plate: &Plate,
    (runup, force): (&RunUpFile, &SideForce),
    probe: Point,
    highest_rad_per_s: f64,
    progress: Progress<'_>,
) -> Result<StretchedRunUp, TransientError> {
    let place = force.at.polar();
    let (from, to) = (runup.speeds().from_rad_per_s, runup.speeds().to_rad_per_s);
    let blade = StretchedBlade::up_to(plate, to, place, MODES)?.pressed(force.force_n, place)?;
    // The system includes the damping of the saw, which is not part of the potential.
    let system = system(plate, &blade);
    let forces = forces(&blade);
    let moving = Moving {
        system: &system,
        load: blade.force().clone(),
        forces: &forces,
    };
    let steps = Steps::new(runup, highest_rad_per_s);
    let begun = State::still(blade.settled(from, &blade.flat())?.coordinates);
    let mut samples = Samples {
        probe: StretchedProbe::new(&blade, &plate.blade, probe),
        speed_rad_per_s: Vec::new(),
        deflection_m: Vec::new(),
        largest: Largest::from(from),
        valid_until_rad_per_s: None,
    };
    steps.integrate(&moving, begun, (STRIDE, progress), |step| {
        Ok(samples.take(step))
    })?;
    if samples.deflection_m.is_empty() {
        return Err(TransientError::SteepByForce {
            force_n: force.force_n,
        });
    }
    let spectrum = samples.spectrum(STRIDE as f64 * steps.step_s, highest_rad_per_s);
    let every = samples.deflection_m.len().div_ceil(MAX_SAMPLES).max(1);
    let thinned = |values: &[f64]| values.iter().step_by(every).copied().collect();
    Ok(StretchedRunUp {
        history: RunUpHistory {
            speed_rad_per_s: thinned(&samples.speed_rad_per_s),
            deflection_m: thinned(&samples.deflection_m),
            largest: samples.largest,
            linear_until_rad_per_s: None,
            step_s: steps.step_s,
        },
        shapes: blade.shapes().ncols(),
        largest_slope: samples.probe.largest_slope,
        valid_until_rad_per_s: samples.valid_until_rad_per_s,
        spectrum,
    })
}

/// The record of the probe.
struct Samples {
    probe: StretchedProbe,
    speed_rad_per_s: Vec<f64>,
    deflection_m: Vec<f64>,
    /// Largest deflection of the rim.
    largest: Largest,
    valid_until_rad_per_s: Option<f64>,
}

impl Samples {
    /// Adds a step; returns false if slopes are too large.
    fn take(&mut self, step: Step<'_>) -> bool {
        let (speed, [_, state]) = (step.speed_rad_per_s, step.states);
        let is_looked_at = step.is_sample && self.deflection_m.len().is_multiple_of(LOOKED);
        if is_looked_at && !self.probe.holds(state) {
            self.valid_until_rad_per_s = Some(speed);
            return false;
        }
        let read = self.probe.read(step.states, step.step_s);
        if step.is_sample {
            self.speed_rad_per_s.push(speed);
            self.deflection_m.push(read.at_probe_m);
        }
        self.largest.include(read, speed);
        true
    }

    /// Short-time Fourier transforms with Hann's window, up to a frequency. A straight line is subtracted first,
    /// because the slowly changing mean deflection would conceal all oscillations.
    fn spectrum(&self, sample_s: f64, highest_rad_per_s: f64) -> Spectrum {
        let count = self.deflection_m.len();
        let duration_s = sample_s * count as f64;
        let window_s = (3.0 * duration_s / SPECTRUM.0 as f64).clamp(WINDOW_S.0, WINDOW_S.1);
        let window = ((window_s / sample_s) as usize).clamp(1, count.max(1));
        let share = |k: usize, of: usize| k as f64 / (of - 1) as f64;
        let frequencies: Vec<f64> = (0..SPECTRUM.1)
            .map(|k| highest_rad_per_s * share(k, SPECTRUM.1))
            .collect();
        let starts: Vec<usize> = (0..SPECTRUM.0)
            .map(|k| (share(k, SPECTRUM.0) * (count - window) as f64) as usize)
            .collect();
        let weights: Vec<f64> = (0..window)
            .map(|i| 1.0 - (TAU * (i as f64 + 0.5) / window as f64).cos())
            .collect();
        let total: f64 = weights.iter().sum();
        let row = |start: &usize| {
            let part = straightened(&self.deflection_m[*start..*start + window]);
            let amplitude = |frequency: &f64| {
                let (mut re, mut im) = (0.0, 0.0);
                for (i, (w, x)) in weights.iter().zip(&part).enumerate() {
                    let (sin, cos) = (frequency * sample_s * i as f64).sin_cos();
                    re += w * x * cos;
                    im += w * x * sin;
                }
                2.0 * re.hypot(im) / total
            };
            frequencies.iter().map(amplitude).collect()
        };
        Spectrum {
            amplitude_m: starts.par_iter().map(row).collect(),
            speed_rad_per_s: starts
                .iter()
                .map(|start| self.speed_rad_per_s[start + window / 2])
                .collect(),
            frequency_rad_per_s: frequencies,
        }
    }
}

/// Values minus their least-squares straight line.
fn straightened(values: &[f64]) -> Vec<f64> {
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    let from_middle = |i: usize| i as f64 - 0.5 * (count - 1.0);
    let (mut along, mut across) = (0.0, 0.0);
    for (i, value) in values.iter().enumerate() {
        along += from_middle(i) * value;
        across += from_middle(i).powi(2);
    }
    let slope = if across > 0.0 { along / across } else { 0.0 };
    let left = values.iter().enumerate();
    left.map(|(i, value)| value - mean - slope * from_middle(i))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::plate::Resolution;
    use crate::model::scene::Scene;
    use crate::motion::stretched_blade::LARGEST_SLOPE;
    use crate::motion::transient::runup::run_up;

    fn plate() -> Plate {
        let resolution = Resolution {
            max_diameters: 8,
            radial_functions: 5,
        };
        Plate::new(&Scene::paper(), resolution)
    }

    fn run(
        force_n: f64,
        speeds_rpm: (f64, f64),
        duration_s: f64,
    ) -> (StretchedRunUp, RunUpHistory) {
        let scene = Scene::paper()
            .edited(|saw| {
                if let Some(runup) = &mut saw.runup {
                    (runup.from_rpm, runup.to_rpm) = speeds_rpm;
                    runup.duration_s = duration_s;
                }
                saw.side_force.get_or_insert_default().force_n = Some(force_n);
            })
            .unwrap();
        let (plate, probe, highest) = (plate(), scene.probe(), TAU * 45.0);
        let runup = (scene.runup().unwrap(), &scene.side_force());
        let stretched = stretched_run_up(&plate, runup, probe, highest, &|_, _| ());
        let linear = run_up(&plate, runup, probe, highest, &|_, _| ());
        (stretched.unwrap(), linear.unwrap())
    }

    #[test]
    fn a_line_is_nothing_and_an_oscillation_stays() {
        let line: Vec<f64> = (0..50).map(|i| 3.0 - 0.2 * f64::from(i)).collect();
        assert!(straightened(&line).iter().all(|left| left.abs() < 1e-12));
        let wave = |i: u32| (TAU * 10.0 * f64::from(i) / 400.0).cos();
        let both: Vec<f64> = (0..400).map(|i| 2.0 + wave(i)).collect();
        let left = straightened(&both);
        assert!((0..400).all(|i| (left[i as usize] - wave(i)).abs() < 0.01));
    }

    /// Small deflections equal those of the linear model, computed on another basis.
    #[test]
    #[cfg_attr(debug_assertions, ignore = "many steps: run it in release")]
    fn a_small_force_moves_the_blade_as_the_linear_model_says() {
        let (stretched, linear) = run(1e-3, (0.0, 1200.0), 4.0);
        let largest = |history: &RunUpHistory| {
            let sizes = history.deflection_m.iter().map(|w| w.abs());
            sizes.fold(0.0, f64::max)
        };
        let (found, expected) = (largest(&stretched.history), largest(&linear));
        assert!(
            (found / expected - 1.0).abs() < 0.03,
            "{found:e} {expected:e}"
        );
        assert_eq!(stretched.valid_until_rad_per_s, None);
    }

    /// A force of 20 kN deflects the blade beyond the model at rest.
    #[test]
    fn a_force_that_leaves_no_record_is_refused_by_its_name() {
        let scene = Scene::paper()
            .edited(|saw| {
                saw.side_force.get_or_insert_default().force_n = Some(2e4);
            })
            .unwrap();
        let (runup, probe) = ((scene.runup().unwrap(), &scene.side_force()), scene.probe());
        let error = stretched_run_up(&plate(), runup, probe, TAU * 45.0, &|_, _| ()).unwrap_err();
        assert!(
            matches!(error, TransientError::SteepByForce { force_n } if force_n == 2e4),
            "{error}"
        );
    }

    /// In the first band, where the linear model ends, the deflection remains bounded and does not return to
    /// zero.
    #[test]
    #[cfg_attr(debug_assertions, ignore = "many steps: run it in release")]
    fn the_record_does_not_end_at_five_thicknesses() {
        let (stretched, linear) = run(50.0, (1300.0, 1800.0), 6.0);
        assert!(linear.linear_until_rad_per_s.is_some());
        let last = *stretched.history.speed_rad_per_s.last().unwrap();
        assert!(crate::model::scene::rpm(last) > 1790.0, "{last}");
        assert!(stretched.largest_slope < LARGEST_SLOPE);
    }
}
