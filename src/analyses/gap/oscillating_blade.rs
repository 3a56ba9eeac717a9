//! A blade between guides with a gap in a basis for its oscillations, and its periodic motion at a speed.

use std::f64::consts::TAU;

use faer::{Col, Mat, c64};

use crate::analyses::response::{Load, State, loads, rigid, solution};
use crate::model::plate::{Plate, Resolution};
use crate::model::scene::{Scene, rpm};
use crate::model::system::GyroscopicSystem;
use crate::modes::Cancellation;
use crate::motion::stretched_blade::{Sites, StretchedBlade};
use crate::motion::transient::reduced_system;

use super::balance::{Balance, Growth, Periodic, Term};
use super::error::GapError;
use super::oscillation_report::{OscillationAt, OscillationPad, OscillationPlace};
use super::oscillators::Oscillators;

/// Number of harmonics with which the search for a motion begins, and of those that the report contains.
pub(super) const HARMONICS: usize = 6;
/// Largest number of harmonics.
const MOST_HARMONICS: usize = 24;
/// Factor by which the number of harmonics grows.
const MORE_HARMONICS: f64 = 1.6;
/// Largest amplitude of the neglected harmonics at the cut, relative to that of the motion.
const NEGLECTED: f64 = 1e-2;
/// Number of phases at which a motion is evaluated at the probe, at the cut and at the pads.
const PHASES: usize = 96;
/// Number of these phases from one evaluation of the whole blade to the next.
const EVERY: usize = 6;

/// A blade in a basis for its oscillations at some speed.
pub(super) struct OscillatingBlade {
    pub(super) blade: StretchedBlade,
    pub(super) system: GyroscopicSystem,
    /// The alternating loads, each with its projection on the shapes.
    loads: Vec<(Load, Col<c64>)>,
    probe: Col<f64>,
    pub(super) cut: Col<f64>,
    sites: Sites,
    /// Indices of the guides that lift off.
    guides: Vec<usize>,
    size: f64,
    /// Ratio of the frequency of the motion to that of rotation.
    base_order: u32,
    /// Growth rate above which a motion is unstable.
    threshold_per_s: f64,
}

impl OscillatingBlade {
    /// The blade of a scene under its steady side force. The basis has the modes of
    /// [`StretchedBlade::up_to`], and the linear responses to the alternating loads at `speed_rad_per_s`, with and without
    /// contact.
    ///
    /// # Errors
    /// [`GapError`].
    pub(super) fn new(
        scene: &Scene,
        resolution: Resolution,
        oscillators: &Oscillators,
        (speed_rad_per_s, to_rad_per_s): (f64, f64),
        modes: usize,
    ) -> Result<Self, GapError> {
        let plate = Plate::new(scene, resolution);
        let (force, cut) = (
            scene.side_force(),
            (plate.blade.outer_radius_m, scene.cut_angle_rad()),
        );
        let loads = loads(&plate, scene, 0.0).map_err(|waves| rigid(waves, scene))?;
        let systems: Vec<GyroscopicSystem> = [
            Some(GyroscopicSystem::of_plate(&plate)),
            GyroscopicSystem::of_released(&plate),
        ]
        .into_iter()
        .flatten()
        .collect();
        let mut further = Vec::new();
        for (load, system) in loads
            .iter()
            .flat_map(|l| systems.iter().map(move |s| (l, s)))
        {
            let state = State {
                speed_rad_per_s,
                frequency_rad_per_s: f64::from(load.order) * speed_rad_per_s,
            };
            let found = solution(system, &load.vector, state);
            let parts: [fn(c64) -> f64; 2] = [|z| z.re, |z| z.im];
            for part in parts {
                let shape = Col::from_fn(found.nrows(), |i| part(found[i]));
                let norm = shape.norm_l2();
                // The imaginary part of an undamped response consists of rounding errors and is omitted.
                if norm.is_finite() && norm > 1e-9 * found.norm_l2() {
                    further.push(faer::Scale(1.0 / norm) * shape);
                }
            }
        }
        let modes = modes.min(plate.degrees_of_freedom());
        let blade =
            StretchedBlade::up_to_with(&plate, to_rad_per_s, force.at.polar(), (modes, &further))?;
        let blade = blade.pressed(force.force_n, force.at.polar())?;
        let probe = scene.probe();
        let reduced = loads.into_iter().map(|load| {
            let vector = &load.vector;
            let [re, im] = [|z: c64| z.re, |z: c64| z.im].map(|part| {
                blade.shapes().transpose() * Col::from_fn(vector.nrows(), |i| part(vector[i]))
            });
            let on_shapes = Col::from_fn(re.nrows(), |i| c64::new(re[i], im[i]));
            (load, on_shapes)
        });
        Ok(OscillatingBlade {
            loads: reduced.collect(),
            system: reduced_system(&plate, &blade),
            probe: blade.shapes_at(probe.polar()),
            cut: blade.shapes_at(cut),
            sites: blade.sites(),
            guides: scene
                .guides()
                .iter()
                .filter(|guide| guide.lifting.is_some())
                .map(|guide| guide.index)
                .collect(),
            size: 1e-3 * plate.blade.thickness_m * plate.blade.mass_kg().sqrt(),
            blade,
            base_order: oscillators.base_order(),
            threshold_per_s: scene.flutter_threshold_per_s(),
        })
    }

    pub(super) fn terms(&self) -> Vec<Term<'_>> {
        let stretching = Term {
            force: self.blade.stretching(),
            is_cubic: true,
        };
        let gaps = self.blade.gaps().map(|gaps| Term {
            force: gaps,
            is_cubic: false,
        });
        std::iter::once(stretching).chain(gaps).collect()
    }

    /// Coefficients of the steady and the alternating loads at a speed, added to zero coefficients.
    pub(super) fn load(&self, zero: Mat<f64>, speed_rad_per_s: f64) -> Mat<f64> {
        let mut load = zero;
        load.col_mut(0).copy_from(self.blade.force());
        for (own, vector) in &self.loads {
            let factor = own.factor(speed_rad_per_s);
            let k = (own.order / self.base_order) as usize;
            for i in 0..vector.nrows() {
                load[(i, 2 * k - 1)] += factor * vector[i].re;
                load[(i, 2 * k)] -= factor * vector[i].im;
            }
        }
        load
    }

    /// The motion at a speed with its stability, `None` if it is not found, and the deflection at the cut in m without
    /// oscillation.
    ///
    /// # Errors
    /// [`GapError`] if the computation was cancelled or no equilibrium is found.
    pub(super) fn at(&self, speed_rad_per_s: f64) -> Result<(Option<Found>, f64), GapError> {
        Cancellation::current().check()?;
        let rest = self.blade.settled(speed_rad_per_s, &self.blade.flat())?;
        let still_m = self.cut.transpose() * &rest.coordinates;
        let found = self.converged(speed_rad_per_s, |balance, load| {
            balance.motion(&rest.coordinates, load)
        });
        Ok((found, still_m))
    }

    /// Searches the motions that were not found, starting from those at neighbouring speeds, upwards and then downwards.
    pub(super) fn follow(&self, motions: &mut [Option<Found>], speeds: &[f64]) {
        let last = motions.len().saturating_sub(1);
        let upwards = (1..=last).map(|k| (k - 1, k));
        let downwards = (1..=last).rev().map(|k| (k, k - 1));
        for (from, to) in upwards.chain(downwards) {
            if let (Some(near), None) = (&motions[from], &motions[to]) {
                motions[to] = self.converged(speeds[to], |balance, load| {
                    balance.refined(&near.motion, load)
                });
            }
        }
    }

    /// The motion at a speed with as many harmonics as it needs; `None` if it is not found, or if it needs too many.
    fn converged(
        &self,
        speed_rad_per_s: f64,
        begin: impl Fn(&Balance<'_>, &Mat<f64>) -> Option<Periodic>,
    ) -> Option<Found> {
        let mut last: Option<Periodic> = None;
        let mut harmonics = HARMONICS;
        loop {
            let (found, largest) = self.balanced(speed_rad_per_s, harmonics, |balance, load| {
                let motion = match &last {
                    None => begin(balance, load)?,
                    Some(near) => balance.refined(near, load)?,
                };
                self.found(balance, motion)
            })?;
            if found.neglected_share <= NEGLECTED {
                return Some(found);
            }
            if harmonics == MOST_HARMONICS {
                return None;
            }
            let more = (MORE_HARMONICS * harmonics as f64).ceil() as usize;
            harmonics = more.max(largest).min(MOST_HARMONICS);
            last = Some(found.motion);
        }
    }

    /// A motion with its growth if it has the harmonics that it needs, and the order of the largest harmonic that it neglects.
    fn found(&self, balance: &Balance<'_>, motion: Periodic) -> Option<(Found, usize)> {
        let along = balance.along(&motion)?;
        let sizes: Vec<(usize, f64)> = along
            .neglected()
            .iter()
            .map(|(k, q)| {
                let at_cut: c64 = (0..q.nrows()).map(|i| q[i] * self.cut[i]).sum();
                (*k, at_cut.norm())
            })
            .collect();
        let neglected_share =
            sizes.iter().map(|(_, size)| size).sum::<f64>() / amplitude_m(&motion, &self.cut);
        let largest = sizes.iter().max_by(|a, b| a.1.total_cmp(&b.1));
        let largest = largest.map_or(0, |(k, _)| *k);
        let growth = if neglected_share <= NEGLECTED {
            along.growth()
        } else {
            None
        };
        let found = Found {
            growth,
            neglected_share,
            motion,
        };
        Some((found, largest))
    }

    /// Solves the balance of a number of harmonics at a speed, under all loads.
    fn balanced<T>(
        &self,
        speed_rad_per_s: f64,
        harmonics: usize,
        solve: impl FnOnce(&Balance<'_>, &Mat<f64>) -> Option<T>,
    ) -> Option<T> {
        let terms = self.terms();
        let frequency = f64::from(self.base_order) * speed_rad_per_s;
        let asked = (frequency, harmonics);
        let balance = Balance::new(&self.system, speed_rad_per_s, asked, &terms, self.size);
        let load = self.load(balance.no_load(), speed_rad_per_s);
        solve(&balance, &load)
    }

    /// A motion at a speed, which is stable if small motions about it grow by at most a threshold.
    pub(super) fn read(&self, speed_rad_per_s: f64, found: &Found) -> OscillationAt {
        let states = states(&found.motion);
        let seen = states.iter().step_by(EVERY);
        OscillationAt {
            rpm: rpm(speed_rad_per_s),
            frequency_hz: f64::from(self.base_order) * speed_rad_per_s / TAU,
            probe: at_place(&found.motion, &states, &self.probe),
            cut: at_place(&found.motion, &states, &self.cut),
            pads: self.pads(&states),
            largest_deflection_m: seen.map(|q| self.sites.largest_m(q)).fold(0.0, f64::max),
            growth_per_s: found.growth.map(|growth| growth.per_s),
            growth_frequency_hz: found.growth.map(|growth| growth.frequency_rad_per_s / TAU),
            stable: found
                .growth
                .is_some_and(|growth| growth.per_s <= self.threshold_per_s),
        }
    }

    fn pads(&self, states: &[Col<f64>]) -> Vec<OscillationPad> {
        let Some(gaps) = self.blade.gaps() else {
            return Vec::new();
        };
        let forces: Vec<Vec<f64>> = states.iter().map(|q| gaps.forces_n(q)).collect();
        let left: Vec<Vec<f64>> = states.iter().map(|q| gaps.distances_left_m(q)).collect();
        let count = states.len() as f64;
        let pads = forces.first().map_or(0, Vec::len);
        let pad = |pad: usize| {
            let own = || forces.iter().map(|all| all[pad]);
            OscillationPad {
                guide: self.guides.get(pad).copied().unwrap_or(pad),
                mean_force_n: own().sum::<f64>() / count,
                largest_force_n: own().map(f64::abs).fold(0.0, f64::max),
                contact_share: left.iter().filter(|all| all[pad] <= 0.0).count() as f64 / count,
            }
        };
        (0..pads).map(pad).collect()
    }
}

/// A motion and its stability.
pub(super) struct Found {
    pub motion: Periodic,
    pub growth: Option<Growth>,
    /// Estimated amplitude at the cut of all harmonics that the motion lacks, relative to its own.
    pub neglected_share: f64,
}

/// The deflection at a place, with its harmonics.
fn at_place(motion: &Periodic, states: &[Col<f64>], place: &Col<f64>) -> OscillationPlace {
    let values = || states.iter().map(|q| place.transpose() * q);
    let low = values().fold(f64::INFINITY, f64::min);
    let high = values().fold(f64::NEG_INFINITY, f64::max);
    let harmonics = || (1..=HARMONICS).map(|k| motion.harmonic(k, place));
    OscillationPlace {
        mean_m: motion.mean(place),
        amplitude_m: 0.5 * (high - low),
        largest_m: low.abs().max(high.abs()),
        lines_m: harmonics().map(|w| w.norm()).collect(),
        phase_deg: harmonics().map(|w| w.arg().to_degrees()).collect(),
    }
}

/// The deflections at many phases of a period.
fn states(motion: &Periodic) -> Vec<Col<f64>> {
    let phases = (0..PHASES).map(|k| TAU * k as f64 / PHASES as f64);
    phases.map(|phase| motion.at(phase)).collect()
}

/// Amplitude in m of a motion at a place, for comparisons.
pub(super) fn amplitude_m(motion: &Periodic, place: &Col<f64>) -> f64 {
    at_place(motion, &states(motion), place).amplitude_m
}
