//! The few eigenvalues of smallest magnitude of a large quadratic problem.
//!
//! With z = (q, q̇/s) the companion problem is A z = λ z. The shifted inverse (A − σ)⁻¹ with a real σ needs one
//! factorization of L(σ) = σ² + σD + K, of half the order, see [`operator`]. Arnoldi's iteration on this
//! inverse finds the λ nearest to σ. A real shift keeps the arithmetic real, and σ > 0
//! is away from the spectrum of a stable saw, whereas A itself is singular at every critical speed. The
//! iteration is not restarted: a few dozen vectors need little memory, and the Schur forms that restarts need
//! cost more than the steps they save.
//!
//! For an undamped blade A is Hamiltonian in (q, p/s), p = q̇ + ΩGq, and (A² − σ²)⁻¹ is skew-Hamiltonian. Each
//! λ² is a double eigenvalue, but the symplectic form vanishes on the Krylov vectors, which therefore find each
//! λ² once. Half as many vectors find the same modes, and the eigenproblem among them takes an eighth of the
//! time (V. Mehrmann, D. Watkins, SIAM J. Sci. Comput. 22, 2001).

mod operator;

use faer::{Col, Mat, Scale};

use crate::model::linalg::{LinalgError, RealEigen};
use crate::model::system::GyroscopicSystem;

use self::operator::{Operator, ShiftedInverse, SquaredInverse};
use super::error::SpectrumError;
use super::full_model::FullModel;
use super::mode::rigid_noise;
use super::vectors::{Eigenpair, by_magnitude, unit};
use crate::model::tuning::Tuned;

/// A vector whose part outside the span of the others is below this share is rounding.
const BREAKDOWN: f64 = 1e-14;
/// Relative residual at which a Krylov vector is accurate enough to represent a mode.
const TOLERANCE: Tuned = Tuned::new("modes/arnoldi::TOLERANCE", 1e-10);
/// Smallest number of steps between two checks of convergence; later checks cost more and are further apart.
const MORE_STEPS: usize = 16;
/// Largest number of steps per eigenvalue. A soft blade on a stiff bed has a cluster of modes near its lowest
/// one, for which four are not enough.
const STEPS_EACH: usize = 12;

/// About `count` eigenpairs nearest to the shift σ = `shift_per_s`, Im λ ≥ 0, ‖q‖ = 1, ordered by |λ|; fewer
/// if the iteration stalls.
///
/// # Errors
/// [`SpectrumError::Decomposition`].
pub fn lowest_eigenpairs(
    system: &GyroscopicSystem,
    speed_rad_per_s: f64,
    count: usize,
    shift_per_s: f64,
) -> Result<Vec<Eigenpair>, SpectrumError> {
    let inverse = ShiftedInverse::new(system, speed_rad_per_s, shift_per_s);
    let found = if is_hamiltonian(system) {
        nearest(&SquaredInverse::new(inverse), count, shift_per_s)
    } else {
        nearest(&inverse, 2 * count, shift_per_s)
    };
    let failed = SpectrumError::at(speed_rad_per_s);
    let mut pairs = found.map_err(failed)?;
    // The pairs removed here approximate the free rigid motions, which are known exactly.
    pairs.retain(|(lambda, _)| lambda.norm() >= rigid_noise(system));
    Ok(pairs)
}

/// Eigenpairs as from [`lowest_eigenpairs`], by the structure of an undamped blade's matrices, in a time linear
/// in the number of basis functions. They neglect the part of the guides that the columns do not represent, so
/// the vectors suffice for a reduced basis. `None` without such a structure.
///
/// # Errors
/// [`SpectrumError::Decomposition`].
pub(super) fn nearly_lowest_eigenpairs(
    full: &FullModel,
    system: &GyroscopicSystem,
    speed_rad_per_s: f64,
    count: usize,
    shift_per_s: f64,
) -> Result<Option<Vec<Eigenpair>>, SpectrumError> {
    if !is_hamiltonian(system) {
        return Ok(None);
    }
    let Some(inverse) = ShiftedInverse::by_structure(full, speed_rad_per_s, shift_per_s) else {
        return Ok(None);
    };
    let found = nearest(&SquaredInverse::new(inverse), count, shift_per_s);
    let failed = SpectrumError::at(speed_rad_per_s);
    found.map(Some).map_err(failed)
}

/// Whether the iteration with A² is possible: free rigid motions are double zeros of A, for which A² is
/// defective.
fn is_hamiltonian(system: &GyroscopicSystem) -> bool {
    system.is_conservative() && system.free_rigid.is_empty()
}

/// Eigenpairs of A that belong to the `wanted` eigenvalues of largest magnitude of an operator; fewer if the
/// iteration stalls.
fn nearest<O: Operator>(
    operator: &O,
    wanted: usize,
    shift_per_s: f64,
) -> Result<Vec<Eigenpair>, LinalgError> {
    let order = O::most_vectors(operator.order());
    let wanted = wanted.min(order);
    let beyond = O::steps_beyond();
    let most = (STEPS_EACH * wanted + 2 * beyond).min(order);
    let mut krylov = Krylov::new(operator.order(), most);
    let mut steps = (wanted + beyond).min(most);
    loop {
        krylov.extend(operator, steps);
        let finished = krylov.exhausted || steps == most;
        if let Some(pairs) = krylov.eigenpairs(operator, wanted, shift_per_s, finished)? {
            return Ok(pairs);
        }
        steps = (steps + MORE_STEPS.max(steps / 8)).min(most);
    }
}

/// Orthonormal vectors V with WV = VH + h v eᵀ for an operator W, v the next vector and e the last unit vector.
struct Krylov {
    vectors: Mat<f64>,
    hessenberg: Mat<f64>,
    steps: usize,
    /// Whether the vectors span an invariant subspace, so that there is no next direction.
    exhausted: bool,
}

impl Krylov {
    fn new(order: usize, most: usize) -> Self {
        let start = Col::from_fn(order, |i| {
            (0.7 * i as f64 + 0.3).sin() / (1.0 + i as f64).sqrt()
        });
        let mut vectors = Mat::zeros(order, most + 1);
        vectors
            .col_mut(0)
            .copy_from(Scale(1.0 / start.norm_l2()) * start);
        Krylov {
            vectors,
            hessenberg: Mat::zeros(most + 1, most),
            steps: 0,
            exhausted: false,
        }
    }

    /// Extends the basis to a number of steps, or to fewer if the space is exhausted.
    fn extend(&mut self, operator: &impl Operator, steps: usize) {
        while self.steps < steps && !self.exhausted {
            let k = self.steps;
            let mut next = operator.apply(self.vectors.col(k));
            let size = next.norm_l2();
            let span = self.vectors.subcols(0, k + 1);
            // A single orthogonalization leaves rounding errors if most of the vector lies in the span.
            for _ in 0..2 {
                let shares = span.transpose() * &next;
                next -= span * &shares;
                for i in 0..=k {
                    self.hessenberg[(i, k)] += shares[i];
                }
                operator.clear(span, &mut next);
            }
            let rest = next.norm_l2();
            // If hardly anything of the new vector remains, it lies in the span: column k of the Hessenberg
            // matrix is complete, and the span is invariant.
            self.exhausted = rest.is_nan() || rest <= BREAKDOWN * size;
            if !self.exhausted {
                self.hessenberg[(k + 1, k)] = rest;
                self.vectors
                    .col_mut(k + 1)
                    .copy_from(Scale(1.0 / rest) * next);
            }
            self.steps += 1;
        }
    }

    /// The pairs of the `wanted` eigenvalues of largest magnitude. `None` if some of them have not converged;
    /// once the iteration is `finished`, those are left out instead.
    fn eigenpairs(
        &self,
        operator: &impl Operator,
        wanted: usize,
        shift: f64,
        finished: bool,
    ) -> Result<Option<Vec<Eigenpair>>, LinalgError> {
        let m = self.steps;
        let square = self.hessenberg.get(..m, ..m).to_owned();
        let eigen = match RealEigen::new(square.as_ref()) {
            Ok(eigen) => eigen,
            Err(_) if !finished => return Ok(None),
            Err(error) => return Err(error),
        };
        let mut order: Vec<usize> = (0..m).collect();
        order.sort_by(|&i, &k| eigen.values[k].norm().total_cmp(&eigen.values[i].norm()));
        order.truncate(wanted);
        let last = if m == 0 {
            0.0
        } else {
            self.hessenberg[(m, m - 1)]
        };
        let converged = |i: &usize| {
            let y = eigen.vector(*i);
            let residual = last * y[m - 1].norm() / y.norm_l2();
            residual <= TOLERANCE.get() * eigen.values[*i].norm()
        };
        let all = order.len();
        order.retain(converged);
        if order.len() < all && !finished {
            return Ok(None);
        }
        let span = self.vectors.subcols(0, m);
        let pairs = order
            .into_iter()
            .flat_map(|i| {
                let halves = span * eigen.halves_of(&[i]);
                let [re, im] = [0, 1].map(|k| halves.col(k).to_owned());
                operator.pairs(eigen.values[i], re, im)
            })
            .filter(|(lambda, _)| lambda.im >= 0.0 && lambda.is_finite())
            .map(|(lambda, q)| (lambda * shift, unit(q.as_ref())))
            .collect();
        Ok(Some(by_magnitude(pairs)))
    }
}

#[cfg(test)]
mod tests {
    use faer::c64;

    use super::*;
    use crate::model::plate::{Plate, Resolution};
    use crate::model::scene::{Scene, rad_per_s};
    use crate::modes::companion_eigenpairs;

    #[test]
    fn the_iteration_finds_what_the_dense_solver_finds() {
        let resolution = Resolution {
            max_diameters: 8,
            radial_functions: 5,
        };
        let system = GyroscopicSystem::of_plate(&Plate::new(&Scene::paper(), resolution));
        for speed in [0.0, 1000.0, 1540.0, 2300.0, 2872.0] {
            let dense = companion_eigenpairs(&system, rad_per_s(speed)).unwrap();
            let few = lowest_eigenpairs(&system, rad_per_s(speed), 10, 100.0).unwrap();
            assert!(few.len() >= 9);
            // The order of two real λ of equal magnitude is arbitrary.
            let is_near = |x: &Eigenpair, y: &Eigenpair| (x.0 - y.0).norm() < 1e-7 * y.0.norm();
            for pairs in [[&few, &dense], [&dense, &few]] {
                for pair in pairs[0].iter().take(8) {
                    let alike = pairs[1].iter().filter(|other| is_near(pair, other));
                    assert_eq!(alike.count(), 1, "{speed}: {}", pair.0);
                }
            }
        }
    }

    /// A ring of rubber on a stiff bed with a damper, whose modes form a cluster near the lowest one.
    #[test]
    fn a_cluster_of_modes_is_found() {
        let scene = Scene::paper()
            .edited(|saw| {
                saw.blade.material.youngs_modulus_pa = 2e7;
                let bed = &mut saw.guides[0];
                bed.damping_n_s_per_m = 5.0;
                (bed.radius_m, bed.radial_length_m, bed.tangential_length_m) = (0.0, 2.0, 2.0);
            })
            .unwrap();
        let resolution = Resolution {
            max_diameters: 16,
            radial_functions: 5,
        };
        let system = GyroscopicSystem::of_plate(&Plate::new(&scene, resolution));
        let dense = companion_eigenpairs(&system, 1.0).unwrap();
        let spread = dense[13].0.norm() / dense[0].0.norm();
        assert!(spread < 1.1, "no cluster: {spread}");
        let few = lowest_eigenpairs(&system, 1.0, 14, 1.0).unwrap();
        assert!(few.len() >= 14);
        for (found, exact) in few.iter().zip(&dense).take(14) {
            let distance = (found.0 - exact.0).norm() / exact.0.norm();
            assert!(distance < 1e-9, "{} {}", found.0, exact.0);
        }
    }

    /// Twelve uncoupled oscillators of three kinds: the iteration from one vector finds one of each kind and
    /// then has no next direction. If the last vector of the subspace were dropped, the frequencies of all
    /// kinds would be wrong.
    #[test]
    fn on_breakdown_the_last_direction_counts() {
        let order = 12;
        let kinds = [1.0, 2.0, 3.0];
        let zero = || Mat::<f64>::zeros(order, order);
        let stiffness = Mat::from_fn(order, order, |i, k| {
            if i == k {
                f64::powi(kinds[i % 3], 2)
            } else {
                0.0
            }
        });
        let system = GyroscopicSystem::undamped(stiffness, zero(), zero());
        let found = lowest_eigenpairs(&system, 0.0, 12, 1.0).unwrap();
        assert_eq!(found.len(), kinds.len());
        for ((lambda, _), exact) in found.iter().zip(kinds) {
            assert!((lambda - c64::new(0.0, exact)).norm() < 1e-10, "{lambda}");
        }
    }
}
