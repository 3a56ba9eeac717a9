//! The equation of motion on a basis of solutions, with the residual of the full model.

use faer::linalg::solvers::{Llt, Solve};
use faer::linalg::triangular_solve::solve_lower_triangular_in_place;
use faer::{Col, Mat, Par, Scale, c64};

use crate::model::system::GyroscopicSystem;

/// A speed and a frequency, in rad/s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct State {
    /// Rotation speed Ω.
    pub speed_rad_per_s: f64,
    /// Angular frequency ω.
    pub frequency_rad_per_s: f64,
}

/// Relative distance from a pole at which its share of the deflection is found.
const BESIDE: f64 = 1e-7;

/// The system on a basis V, and its products with V for the residual.
///
/// V is complex, so that it may contain a wave that turns with the load without the wave that turns against it. The load does
/// not excite the latter, but its resonance would amplify rounding.
pub(super) struct Reduced {
    /// Factors of the terms of L.
    factors: Vec<Factor>,
    /// VᴴT V of every term T of L.
    small: Vec<Mat<c64>>,
    /// Vᴴf.
    pub small_load: Col<c64>,
    /// Vᵀc.
    probes: Vec<Col<c64>>,
    /// C⁻¹T V of the terms side by side, with CCᵀ = K₀.
    tall: Mat<c64>,
    /// C⁻¹f.
    load: Col<c64>,
}

impl Reduced {
    pub fn new(
        system: &GyroscopicSystem,
        load: &Col<c64>,
        probes: &[Col<f64>],
        basis: &Mat<c64>,
        factor: &Llt<f64>,
    ) -> Self {
        let divided = |mut halves: Mat<f64>| {
            solve_lower_triangular_in_place(factor.L(), halves.as_mut(), Par::Seq);
            joined(&halves)
        };
        let own = halves(basis);
        let (matrices, factors): (Vec<_>, Vec<Factor>) = terms(system).into_iter().unzip();
        let products: Vec<Mat<f64>> = matrices
            .into_iter()
            .map(|term| term.map_or_else(|| own.clone(), |term| term * &own))
            .collect();
        let width = basis.ncols();
        let mut tall = Mat::zeros(system.order(), products.len() * width);
        for (k, product) in products.iter().enumerate() {
            let mut place = tall.subcols_mut(k * width, width);
            place.copy_from(divided(product.clone()));
        }
        let load_alone = Mat::from_fn(load.nrows(), 1, |i, _| load[i]);
        Reduced {
            factors,
            small: products
                .iter()
                .map(|product| basis.adjoint() * joined(product))
                .collect(),
            small_load: basis.adjoint() * load,
            probes: probes
                .iter()
                .map(|c| {
                    Col::from_fn(width, |k| {
                        (0..c.nrows()).map(|i| basis[(i, k)] * c[i]).sum()
                    })
                })
                .collect(),
            tall,
            load: divided(halves(&load_alone)).col(0).to_owned(),
        }
    }

    /// L(s; Ω) on the basis.
    pub fn dynamic(&self, speed: c64, s: c64) -> Mat<c64> {
        let width = self.small_load.nrows();
        let factors: Vec<c64> = self.factors.iter().map(|of| of(speed, s)).collect();
        Mat::from_fn(width, width, |i, k| {
            let parts = self
                .small
                .iter()
                .zip(&factors)
                .map(|(term, factor)| term[(i, k)] * factor);
            parts.sum::<c64>()
        })
    }

    /// The relative distance from a pole at which its motion deflects as far as the blade under the load at rest, both by their elastic
    /// energy at rest; `at` is L on the path.
    pub fn excitation(&self, pole: c64, at: impl Fn(c64) -> Mat<c64>) -> f64 {
        let [above, below] = [BESIDE, -BESIDE].map(|off| -> Col<c64> {
            let dynamic = at(pole * (1.0 + off));
            dynamic.partial_piv_lu().solve(&self.small_load)
        });
        let motion = Scale(c64::new(0.5 * BESIDE, 0.0)) * (above - below);
        let energy = (motion.adjoint() * &self.small[0] * &motion).re;
        (energy.max(0.0).sqrt() / self.load.norm_l2()).abs()
    }

    /// Residual relative to the load, and readings, at each state.
    pub fn at(&self, states: &[State]) -> Vec<(f64, Vec<c64>)> {
        let width = self.small_load.nrows();
        let mut shares = Mat::zeros(self.tall.ncols(), states.len());
        let mut read = Vec::with_capacity(states.len());
        for (place, state) in states.iter().enumerate() {
            let speed = c64::new(state.speed_rad_per_s, 0.0);
            let s = c64::new(0.0, state.frequency_rad_per_s);
            let factors: Vec<c64> = self.factors.iter().map(|of| of(speed, s)).collect();
            let dynamic = self.dynamic(speed, s);
            let y: Col<c64> = dynamic.partial_piv_lu().solve(&self.small_load);
            for (part, factor) in factors.iter().enumerate() {
                for i in 0..width {
                    shares[(part * width + i, place)] = factor * y[i];
                }
            }
            let reading = |c: &Col<c64>| -> c64 { (0..width).map(|i| c[i] * y[i]).sum() };
            read.push(self.probes.iter().map(reading).collect());
        }
        let carried = &self.tall * shares;
        let size = self.load.norm_l2();
        let residual = |place: usize| {
            let left =
                (0..carried.nrows()).map(|i| (self.load[i] - carried[(i, place)]).norm_sqr());
            let share = left.sum::<f64>().sqrt() / size;
            if share.is_finite() {
                share
            } else {
                f64::INFINITY
            }
        };
        let read = read.into_iter().enumerate();
        read.map(|(place, read)| (residual(place), read)).collect()
    }
}

/// Real and imaginary parts of columns, first all real parts.
fn halves(columns: &Mat<c64>) -> Mat<f64> {
    let count = columns.ncols();
    Mat::from_fn(columns.nrows(), 2 * count, |i, k| {
        match k.checked_sub(count) {
            None => columns[(i, k)].re,
            Some(k) => columns[(i, k)].im,
        }
    })
}

/// Columns from their real and imaginary parts, as [`halves`] returns them.
fn joined(halves: &Mat<f64>) -> Mat<c64> {
    let count = halves.ncols() / 2;
    Mat::from_fn(halves.nrows(), count, |i, k| {
        c64::new(halves[(i, k)], halves[(i, count + k)])
    })
}

/// Factor of a matrix of L, from Ω and s = iω.
type Factor = fn(c64, c64) -> c64;

/// The matrices of L(iω; Ω) that a system has, each with its factor, that of the stiffness first; `None` is the unit matrix of the
/// inertia.
fn terms(system: &GyroscopicSystem) -> Vec<(Option<&Mat<f64>>, Factor)> {
    const ONE: c64 = c64::new(1.0, 0.0);
    let always: [(_, Factor); 3] = [
        (Some(&system.stiffness), |_, _| ONE),
        (Some(&system.spin), |speed, _| speed * speed),
        (Some(&system.gyroscopic), |speed, s| s * speed * 2.0),
    ];
    let optional: [(_, Factor); 3] = [
        (system.circulatory.as_ref(), |speed, _| speed),
        (system.nonconservative.as_ref(), |_, _| ONE),
        (system.damping.as_ref(), |_, s| s),
    ];
    let present = optional.into_iter().filter(|(term, _)| term.is_some());
    let inertia: (_, Factor) = (None, |_, s| s * s);
    always.into_iter().chain(present).chain([inertia]).collect()
}
