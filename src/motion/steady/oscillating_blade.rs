//! A blade between guides with a gap in a basis for its oscillations, and its periodic motion at a speed.

use faer::{Col, Mat, c64};

use crate::model::plate::Plate;
use crate::model::scene::{Polar, Scene};
use crate::model::system::GyroscopicSystem;
use crate::modes::Cancellation;
use crate::motion::stretched_blade::{Sites, StretchedBlade, StretchedError};
use crate::motion::transient::reduced_system;

use super::along::{Along, Growth};
use super::balance::Balance;
use super::family::solution;
use super::load::Load;
use super::oscillators::Oscillators;
use super::periodic::Periodic;
use super::reduced_model::State;
use super::term::Term;

/// Number of harmonics with which the search for a motion begins, and of those that the report contains.
pub const HARMONICS: usize = 6;
/// Largest number of harmonics.
const MOST_HARMONICS: usize = 24;
/// Factor by which the number of harmonics grows.
const MORE_HARMONICS: f64 = 1.6;
/// Largest amplitude of the neglected harmonics at the cut, relative to that of the motion.
const NEGLECTED: f64 = 1e-2;

/// A blade in a basis for its oscillations at some speed.
pub struct OscillatingBlade {
    /// The blade under its steady side force.
    pub blade: StretchedBlade,
    /// Its linear terms on the shapes.
    pub system: GyroscopicSystem,
    /// The alternating loads, each with its projection on the shapes.
    loads: Vec<(Load, Col<c64>)>,
    /// The shapes at the probe.
    pub probe: Col<f64>,
    /// The shapes at the rim at the cut.
    pub cut: Col<f64>,
    /// Places over the blade.
    pub sites: Sites,
    /// Indices of the guides that lift off.
    pub guides: Vec<usize>,
    size: f64,
    /// Ratio of the frequency of the motion to that of rotation.
    pub base_order: u32,
    /// Growth rate above which a motion is unstable.
    pub threshold_per_s: f64,
}

impl OscillatingBlade {
    /// The blade of a scene under its steady side force. The basis has the modes of
    /// [`StretchedBlade::up_to`], and the linear responses to the alternating loads at `speed_rad_per_s`, with and without
    /// contact.
    ///
    /// # Errors
    /// [`StretchedError`].
    pub fn new(
        plate: &Plate,
        scene: &Scene,
        (oscillators, loads): (&Oscillators, Vec<Load>),
        (speed_rad_per_s, to_rad_per_s): (f64, f64),
        modes: usize,
    ) -> Result<Self, StretchedError> {
        let force = scene.constant_force();
        let cut = Polar::new(plate.blade.outer_radius_m, scene.cut_angle_rad());
        let systems: Vec<GyroscopicSystem> = [
            Some(GyroscopicSystem::of_plate(plate)),
            GyroscopicSystem::of_released(plate),
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
            StretchedBlade::up_to_with(plate, to_rad_per_s, &force.places, modes, &further)?;
        let blade = blade.loaded(force.force_n, &force.places)?;
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
            system: reduced_system(plate, &blade),
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

    /// The forces that depend on the deflection.
    pub fn terms(&self) -> Vec<Term<'_>> {
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
    pub fn load(&self, zero: Mat<f64>, speed_rad_per_s: f64) -> Mat<f64> {
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
    /// [`StretchedError`] if the computation was cancelled or no equilibrium is found.
    pub fn at(&self, speed_rad_per_s: f64) -> Result<(Option<Found>, f64), StretchedError> {
        Cancellation::current().check()?;
        let rest = self.blade.settled(speed_rad_per_s, &self.blade.flat())?;
        let still_m = self.cut.transpose() * &rest.coordinates;
        let found = self.converged(speed_rad_per_s, |balance, load| {
            balance.motion(&rest.coordinates, load)
        });
        Ok((found, still_m))
    }

    /// Searches the motions that were not found, starting from those at neighbouring speeds, upwards and then downwards.
    pub fn follow(&self, motions: &mut [Option<Found>], speeds: &[f64]) {
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

    /// A motion with its growth if it has the harmonics that it needs, and the order of the largest one that it neglects.
    fn found(&self, balance: &Balance<'_>, motion: Periodic) -> Option<(Found, usize)> {
        let along = Along::new(balance, &motion)?;
        let sizes: Vec<(usize, f64)> = along
            .neglected()
            .iter()
            .map(|(k, q)| {
                let at_cut: c64 = (0..q.nrows()).map(|i| q[i] * self.cut[i]).sum();
                (*k, at_cut.norm())
            })
            .collect();
        let all = sizes.iter().map(|(_, size)| size).sum::<f64>();
        let neglected_share = all / motion.amplitude(&self.cut);
        let largest = sizes.iter().max_by(|a, b| a.1.total_cmp(&b.1));
        let largest_order = largest.map_or(0, |(k, _)| *k);
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
        Some((found, largest_order))
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
}

/// A motion and its stability.
pub struct Found {
    /// The motion.
    pub motion: Periodic,
    /// The fastest growth of small motions about it; `None` if it is not known.
    pub growth: Option<Growth>,
    /// Estimated amplitude at the cut of all harmonics that the motion lacks, relative to its own.
    pub neglected_share: f64,
}
