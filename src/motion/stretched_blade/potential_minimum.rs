//! The minimum of V that the blade without inertia reaches from a deflection.

use faer::{Col, Scale};

use crate::model::linalg::SymmetricEigen;
use crate::model::scene::rpm;
use crate::modes::SpectrumError;

use super::{Equilibrium, StretchedBlade, StretchedError, finite};

/// Largest number of steps; a distant minimum takes some fifty.
const STEPS: usize = 2000;
/// Longest step, in thicknesses over the whole blade.
const LONGEST: f64 = 0.1;
/// Displacement from a saddle point, in thicknesses over the whole blade.
const PUSH: f64 = 1e-4;
/// Relative size of the last correction, compared with the deflection or a thickness.
const LAST: f64 = 1e-9;
/// Rounding of V, relative to V and to the energy of the deflection in the stiffest mode.
const ROUNDING: f64 = 1e-15;
/// Smaller stiffnesses, relative to the largest, are replaced by this value, so that steps are bounded.
const SOFTEST: f64 = super::ROUNDING;
/// A blade that has moved by this number of thicknesses is not restrained by its pads.
const FAR: f64 = 100.0;

impl StretchedBlade {
    /// The stable equilibrium that the blade reaches from a deflection by steps along which V decreases:
    /// Newton's method with the curvatures of V made positive, limited to a tenth of a thickness. The blade leaves a
    /// saddle point along the direction of lowest stiffness, on the side to which the side force acts; without a
    /// side force, on that on which the first coordinate that changes is positive.
    ///
    /// # Errors
    /// [`StretchedError::NotFound`], [`StretchedError::Value`], [`StretchedError::Axisymmetric`],
    /// [`StretchedError::Loose`], [`StretchedError::Escapes`].
    pub fn settled(
        &self,
        speed_rad_per_s: f64,
        from: &Col<f64>,
    ) -> Result<Equilibrium, StretchedError> {
        finite("the speed in rad/s", speed_rad_per_s)?;
        self.not_loose()?;
        let size = self.size();
        let mut p = from.clone();
        let mut tension = self.stretching.tension(&p)?;
        let mut energy = self.potential_with(&p, &tension, speed_rad_per_s);
        for _ in 0..STEPS {
            let order = p.nrows();
            let hessian = self.hessian_with(&p, &tension, speed_rad_per_s);
            let modes = SymmetricEigen::new(hessian.as_ref())
                .map_err(SpectrumError::at(speed_rad_per_s))?;
            let rest = self.residual_with(&p, &tension, speed_rad_per_s);
            let along = modes.vectors.transpose() * &rest;
            let softest = SOFTEST * modes.values[order - 1].abs();
            let shares = Col::from_fn(order, |k| along[k] / modes.values[k].abs().max(softest));
            let mut step = Scale(-1.0) * (&modes.vectors * shares);
            let is_minimum = modes.values[0] >= -SOFTEST * modes.values[order - 1].abs();
            if step.norm_l2() <= LAST * p.norm_l2().max(size) {
                if is_minimum {
                    self.directed(&p)?;
                    return Ok(Equilibrium::of(p, speed_rad_per_s, &modes.values));
                }
                let lowest = modes.vectors.col(0);
                let forced = lowest.transpose() * &self.force;
                let first = (0..order).map(|i| lowest[i]).find(|x| x.abs() > PUSH);
                let side = if forced == 0.0 {
                    first.unwrap_or(1.0)
                } else {
                    forced
                };
                step = Scale(side.signum() * PUSH * size) * lowest;
            }
            let length = step.norm_l2();
            if length > LONGEST * size {
                step = Scale(LONGEST * size / length) * step;
            }
            if self.gaps.is_some() && p.norm_l2() > FAR * size {
                return Err(StretchedError::Escapes {
                    rpm: rpm(speed_rad_per_s),
                });
            }
            let slope = rest.transpose() * &step;
            let mut share = 1.0;
            loop {
                let next = &p + Scale(share) * &step;
                let tensed = self.stretching.tension(&next)?;
                let lower = self.potential_with(&next, &tensed, speed_rad_per_s);
                // Where the potential is nearly constant, such as just above a pitchfork, its last digits are
                // rounding errors of the stiffest mode, or of V itself, which pads over a large oscillation make large.
                let stiffest = modes.values[order - 1].abs() * next.squared_norm_l2();
                let rounding = ROUNDING * (stiffest + energy.abs());
                if lower <= energy + 1e-4 * share * slope.min(0.0) + rounding {
                    (p, tension, energy) = (next, tensed, lower);
                    break;
                }
                share *= 0.5;
                if share < 1e-12 {
                    return Err(self.not_found(&p, speed_rad_per_s));
                }
            }
        }
        Err(self.not_found(&p, speed_rad_per_s))
    }

    /// Potential V, in J.
    pub fn potential_j(&self, p: &Col<f64>, speed_rad_per_s: f64) -> Result<f64, StretchedError> {
        Ok(self.potential_with(p, &self.stretching.tension(p)?, speed_rad_per_s))
    }

    /// As [`StretchedBlade::potential_j`], with the tension of p.
    fn potential_with(&self, p: &Col<f64>, tension: &Col<f64>, speed_rad_per_s: f64) -> f64 {
        let elastic = p.transpose() * (self.system.stiffness_at(speed_rad_per_s) * p);
        let of_gaps = self.gaps.as_ref().map_or(0.0, |gaps| gaps.energy_j(p));
        let stretching = self.stretching.energy_with(p, tension);
        0.5 * elastic + stretching + of_gaps - self.force.transpose() * p
    }
}
