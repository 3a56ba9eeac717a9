//! Amplitude of flutter in a band, from its two waves.
//!
//! The normal form of [`Saturation`] needs only the growing and the decaying wave. Both are computed on the
//! full model by Newton's method on L(λ)x = 0, L(λ) = λ² + λ 2ΩG + K(Ω), starting from an approximate
//! eigenvalue: u = L(λ)⁻¹L′(λ)x, λ⁺ = λ − xᴴx/xᴴu (A. Ruhe, *Algorithms for the nonlinear eigenvalue
//! problem*, SIAM J. Numer. Anal. 10 (1973), 674–689). The real and imaginary parts of both waves are the shapes.

use faer::linalg::solvers::Solve;
use faer::{Col, c64};

use crate::model::plate::{Plate, Stretching};
use crate::model::scene::rpm;
use crate::model::system::{GyroscopicSystem, dynamic_stiffness};
use crate::modes::{Cancellation, SpectrumError, derivative, orthonormal, split};

use super::basis::INDEPENDENT;
use super::{Saturation, StretchedBlade, StretchedError, finite};

/// Flutter of a blade without damping.
#[derive(Debug)]
pub struct FlutterRise {
    plate: Plate,
    system: GyroscopicSystem,
    stretching: Stretching,
}

/// Number of inverse iterations, from an arbitrary vector, with the given eigenvalue.
const FIXED: usize = 2;
/// Largest number of corrections of the eigenvalue; three suffice from five digits.
const CORRECTIONS: usize = 12;
/// Relative size of the last correction.
const LAST: f64 = 1e-11;
/// An eigenvalue at a larger relative distance belongs to another wave.
const NEAR: f64 = 0.05;

impl FlutterRise {
    /// Computes the potential of stretching of a plate.
    ///
    /// # Errors
    /// [`StretchedError::Stretching`].
    pub fn new(plate: &Plate) -> Result<Self, StretchedError> {
        let plate = plate.conservative();
        Ok(FlutterRise {
            system: GyroscopicSystem::of_plate(&plate),
            stretching: Stretching::new(&plate)?,
            plate,
        })
    }

    /// Amplitude of the flutter whose eigenvalue at a speed is near to a given one; `None` if the blade
    /// without damping has no growing eigenvalue there.
    ///
    /// # Errors
    /// [`StretchedError::Value`], [`StretchedError::Spectrum`].
    pub fn near(
        &self,
        speed_rad_per_s: f64,
        eigenvalue_per_s: c64,
    ) -> Result<Option<Saturation>, StretchedError> {
        finite("the speed in rad/s", speed_rad_per_s)?;
        finite("the frequency in rad/s", eigenvalue_per_s.im)?;
        let Some((growing, u)) = self.wave(speed_rad_per_s, eigenvalue_per_s)? else {
            return Ok(None);
        };
        let Some((_, v)) = self.wave(speed_rad_per_s, -growing.conj())? else {
            return Ok(None);
        };
        let [u, v] = [u, v].map(|wave| <[Col<f64>; 2]>::from(split(&wave)));
        let parts = [u, v].concat();
        let basis = orthonormal(self.system.order(), &parts, INDEPENDENT);
        let plate = self.plate.clone();
        let blade = StretchedBlade::with(plate, &self.stretching, &self.system, basis)?;
        blade.rise(speed_rad_per_s, Some(growing))
    }

    /// The eigenvalue near to a given one, and its wave; `None` if there is none.
    fn wave(&self, speed: f64, near: c64) -> Result<Option<(c64, Col<c64>)>, StretchedError> {
        let order = self.system.order();
        let (stiffness, velocity) = (
            self.system.stiffness_at(speed),
            self.system.velocity_at(speed),
        );
        let real = |x: f64| c64::new(x, 0.0);
        let mut lambda = near;
        let mut x = Col::from_fn(order, |i| real((1.7 * i as f64 + 0.3).sin()));
        for iteration in 0..FIXED + CORRECTIONS {
            Cancellation::current().check()?;
            let dynamic = dynamic_stiffness(&stiffness, &velocity, lambda);
            let slope = derivative::with_lambda(&velocity, lambda, &x);
            let u = dynamic.partial_piv_lu().solve(&slope);
            let norm = u.norm_l2();
            if !norm.is_finite() {
                // A solution that is not finite shows that λ is an eigenvalue to machine precision.
                return Ok(Some((lambda, x)));
            }
            let correction = real(x.squared_norm_l2()) / (x.adjoint() * &u);
            x = Col::from_fn(order, |i| u[i] / norm);
            if iteration < FIXED {
                continue;
            }
            lambda -= correction;
            if (lambda - near).norm() > NEAR * near.norm() {
                return Ok(None);
            }
            if correction.norm() <= LAST * lambda.norm() {
                return Ok(Some((lambda, x)));
            }
        }
        Err(SpectrumError::NoConvergence {
            order,
            rpm: rpm(speed),
        }
        .into())
    }
}
