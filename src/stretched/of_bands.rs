//! How far flutter of a band rises, from the two waves that make it.
//!
//! The normal form of [`Saturation`] needs the growing wave and the decaying one alone. Both are found on the
//! full model, by Newton's method on L(λ)x = 0, L(λ) = λ² + λ 2ΩG + K(Ω), from an eigenvalue that is known nearly:
//! u = L(λ)⁻¹L′(λ)x, λ⁺ = λ − xᴴx/xᴴu (A. Ruhe, *Algorithms for the nonlinear eigenvalue problem*, SIAM J. Numer. Anal. 10
//! (1973), 674–689). Their real and imaginary parts are the shapes.

use faer::linalg::solvers::Solve;
use faer::{Col, c64};

use crate::plate::{Plate, Stretching};
use crate::scene::rpm;
use crate::spectrum::{Cancellation, SpectrumError, derivative, orthonormal, split};
use crate::system::{GyroscopicSystem, dynamic_stiffness};

use super::{INDEPENDENT, Saturation, StretchedBlade, StretchedError, finite};

/// Flutter of one blade without damping.
#[derive(Debug)]
pub struct FlutterRise {
    plate: Plate,
    system: GyroscopicSystem,
    stretching: Stretching,
}

/// Solutions before the eigenvalue is corrected, from a vector that is anything.
const FIXED: usize = 2;
/// Most corrections; from five digits it takes three.
const CORRECTIONS: usize = 12;
/// A correction of this share of the eigenvalue is the last one.
const LAST: f64 = 1e-11;
/// An eigenvalue further off than this share of its size is that of another wave.
const NEAR: f64 = 0.05;

impl FlutterRise {
    /// Prepares the potential of stretching.
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

    /// How far the flutter rises whose eigenvalue at a speed is near to another one; `None` where the blade
    /// without damping has none that grows there.
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
        let parts: Vec<Col<f64>> = [u, v]
            .iter()
            .flat_map(|wave| {
                let (re, im) = split(wave);
                [re, im]
            })
            .collect();
        let basis = orthonormal(self.system.order(), &parts, INDEPENDENT);
        let plate = self.plate.clone();
        let blade = StretchedBlade::with(plate, &self.stretching, &self.system, basis)?;
        blade.saturation_near(speed_rad_per_s, growing)
    }

    /// The eigenvalue next to another one and its wave; `None` where there is none near.
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
                // λ is an eigenvalue to the last digit.
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
