//! The motion of a guided, slotted blade over one pitch of its slots.
//!
//! In the frame of the blade, with the coordinates x of its modes (squares ω², damping C_b, M = 1) and points fixed in space at the blade
//! angles θ_z − Ωt,
//!
//! ẍ + C_b ẋ + ω²x + Σ_z p_z [k_z p_zᵀx + c_z (p_zᵀẋ + ṗ_zᵀx)] = 0, p_z = φ(r_z, θ_z − Ωt),
//!
//! which has the period of a turn; after one pitch, T = 2π/NΩ, with pitches renumbered, it is the same again. A step h is that of Strang's
//! splitting: the blade alone for h/2, exactly; the impulse of the points at the middle of the step, with the velocity in the dampers by
//! the midpoint rule; the blade for h/2. Without damping this is symplectic: the multipliers of a stable saw lie on the unit circle.
//!
//! Reference: G. Strang, *On the construction and comparison of difference schemes*, SIAM J. Numer. Anal. 5 (1968), 506–517.

use std::f64::consts::TAU;

use faer::linalg::matmul::matmul;
use faer::linalg::solvers::Solve;
use faer::{Accum, Mat, Par};

use super::guided::GuidedBlade;
use crate::model::plate::TurningModes;

/// Modes and points at every step of a pitch.
pub(super) struct Pitch<'a> {
    modes: &'a TurningModes<'a>,
    step_s: f64,
    /// Values p_z of the coordinates at the points, by step: coordinates × points, in 1/√kg.
    values: Vec<Mat<f64>>,
    /// k_z p_z + c_z ṗ_z by step, in N/(m √kg).
    forces: Vec<Mat<f64>>,
    /// c_z, in N·s/m; empty without dampers.
    damping: Vec<f64>,
}

/// The motion of one mode alone over a time.
struct Drift {
    from_deflection: [f64; 2],
    from_velocity: [f64; 2],
}

impl<'a> Pitch<'a> {
    /// The steps of a pitch at a speed.
    pub fn new(
        guided: &GuidedBlade<'_>,
        modes: &'a TurningModes<'a>,
        speed_rad_per_s: f64,
        steps: usize,
    ) -> Self {
        let pitch_rad = guided.blade.pitch_rad();
        let circles: Vec<_> = guided.radii_m.iter().map(|r| modes.circle(*r)).collect();
        let (size, is_damped) = (modes.coordinates(), guided.is_damped());
        // A slot passes the first point where steps begin.
        let first_rad = guided.sites.first().map_or(0.0, |site| site.angle_rad);
        let (mut values, mut forces) = (Vec::with_capacity(steps), Vec::with_capacity(steps));
        for step in 0..steps {
            let turned = pitch_rad * (0.5 - (step as f64 + 0.5) / steps as f64);
            let mut value = Mat::zeros(size, guided.sites.len());
            let mut force = Mat::zeros(size, guided.sites.len());
            for (column, site) in guided.sites.iter().enumerate() {
                let (k, c) = (site.stiffness_n_per_m, site.damping_n_s_per_m);
                let mut row = 0;
                circles[site.circle].at(site.angle_rad - first_rad + turned, |own, slope| {
                    value[(row, column)] = own;
                    force[(row, column)] = k * own - c * speed_rad_per_s * slope;
                    row += 1;
                });
            }
            values.push(value);
            forces.push(force);
        }
        let damping = guided.sites.iter().map(|site| site.damping_n_s_per_m);
        Pitch {
            modes,
            step_s: pitch_rad / speed_rad_per_s / steps as f64,
            values,
            forces,
            damping: damping.filter(|_| is_damped).collect(),
        }
    }

    /// Time T of the pitch, in s.
    pub fn time_s(&self) -> f64 {
        self.step_s * self.values.len() as f64
    }

    /// Transpose of the monodromy matrix over the pitch, with the deflections in units of 1/ω: row i is the state that follows from
    /// the unit state i.
    pub fn monodromy(&self) -> Mat<f64> {
        let size = self.modes.coordinates();
        let mut deflections = Mat::from_fn(2 * size, size, |i, k| f64::from(u8::from(i == k)));
        let mut velocities =
            Mat::from_fn(2 * size, size, |i, k| f64::from(u8::from(i == size + k)));
        let [half, whole] = [0.5, 1.0].map(|share| self.drifts(share * self.step_s));
        let last = self.values.len() - 1;
        drift(&half, &mut deflections, &mut velocities);
        for step in 0..=last {
            self.kick(step, &deflections, &mut velocities);
            let drifts = if step == last { &half } else { &whole };
            drift(drifts, &mut deflections, &mut velocities);
        }
        self.renumber(&mut deflections);
        self.renumber(&mut velocities);
        let units = self.units();
        let unit = |i: usize| units.get(i).copied().unwrap_or(1.0);
        Mat::from_fn(2 * size, 2 * size, |i, k| {
            let entry = if k < size {
                deflections[(i, k)]
            } else {
                velocities[(i, k - size)]
            };
            entry * unit(k) / unit(i)
        })
    }

    /// ω of every coordinate, and no less than a turn in the pitch, so that the state matrix is balanced.
    fn units(&self) -> Vec<f64> {
        let least = TAU / self.time_s();
        let modes = self.modes.modes.iter();
        let unit = |square: f64| square.max(0.0).sqrt().max(least);
        modes
            .flat_map(|mode| std::iter::repeat_n(unit(mode.square), mode.coordinates()))
            .collect()
    }

    fn drifts(&self, time_s: f64) -> Vec<Drift> {
        let modes = self.modes.modes.iter();
        modes
            .flat_map(|mode| {
                let of_mode = || Drift::new(mode.square, mode.damping_per_s, time_s);
                std::iter::repeat_with(of_mode).take(mode.coordinates())
            })
            .collect()
    }

    /// The impulse of the points in one step: v⁺ = v − h Σ p [(k p + c ṗ)ᵀx + c pᵀ(v + v⁺)/2].
    fn kick(&self, step: usize, deflections: &Mat<f64>, velocities: &mut Mat<f64>) {
        let (values, forces, h) = (&self.values[step], &self.forces[step], self.step_s);
        let (rows, points) = (deflections.nrows(), values.ncols());
        let product = |left: &Mat<f64>, right: &Mat<f64>, factor: f64| {
            let mut product = Mat::zeros(rows, points);
            let (left, right) = (left.as_ref(), right.as_ref());
            matmul(
                product.as_mut(),
                Accum::Replace,
                left,
                right,
                factor,
                Par::Seq,
            );
            product
        };
        let mut impulses = product(deflections, forces, h);
        if !self.damping.is_empty() {
            let gram = values.transpose() * values;
            // With the mean velocities y at the points: y (1 + ½ h c pᵀp) = pᵀv − ½ pᵀp s.
            let mut right = product(velocities, values, 1.0);
            right -= faer::Scale(0.5) * &impulses * &gram;
            let matrix = Mat::from_fn(points, points, |i, k| {
                f64::from(u8::from(i == k)) + 0.5 * h * self.damping[k] * gram[(k, i)]
            });
            let means = matrix.partial_piv_lu().solve(right.transpose());
            for k in 0..points {
                for i in 0..rows {
                    impulses[(i, k)] += h * self.damping[k] * means[(k, i)];
                }
            }
        }
        let (impulses, values) = (impulses.as_ref(), values.transpose());
        matmul(
            velocities.as_mut(),
            Accum::Add,
            impulses,
            values,
            -1.0,
            Par::Seq,
        );
    }

    /// Counts every pitch as the next one: c e^{−ikα} in place of c = a + ib.
    fn renumber(&self, states: &mut Mat<f64>) {
        let mut column = 0;
        for mode in &self.modes.modes {
            let (sin, cos) = mode.phase_rad.sin_cos();
            for row in 0..states.nrows() {
                let a = states[(row, column)];
                if mode.is_pair {
                    let b = states[(row, column + 1)];
                    states[(row, column)] = a * cos + b * sin;
                    states[(row, column + 1)] = b * cos - a * sin;
                } else {
                    states[(row, column)] = a * cos.round();
                }
            }
            column += mode.coordinates();
        }
    }
}

impl Drift {
    /// ẍ + 2δẋ + ω²x = 0 over a time, for ω² of any sign.
    fn new(square: f64, damping_per_s: f64, time_s: f64) -> Self {
        let rate = 0.5 * damping_per_s;
        let decay = (-rate * time_s).exp();
        let damped = square - rate * rate;
        let angle = damped.abs().sqrt() * time_s;
        let (cos, sinc) = if angle < 1e-6 {
            (1.0, time_s)
        } else if damped > 0.0 {
            (angle.cos(), angle.sin() / angle * time_s)
        } else {
            (angle.cosh(), angle.sinh() / angle * time_s)
        };
        Drift {
            from_deflection: [decay * (cos + rate * sinc), -decay * square * sinc],
            from_velocity: [decay * sinc, decay * (cos - rate * sinc)],
        }
    }
}

fn drift(drifts: &[Drift], deflections: &mut Mat<f64>, velocities: &mut Mat<f64>) {
    for (k, own) in drifts.iter().enumerate() {
        let [xx, xv] = own.from_deflection;
        let [vx, vv] = own.from_velocity;
        let states = deflections.col_as_slice_mut(k).iter_mut();
        for (x, v) in states.zip(velocities.col_as_slice_mut(k)) {
            let (deflection, velocity) = (*x, *v);
            *x = xx * deflection + vx * velocity;
            *v = xv * deflection + vv * velocity;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// ẍ + cẋ + sx = 0 by Taylor series of tiny steps, for modes that oscillate, do not, creep, and are held by nothing.
    #[test]
    fn a_mode_alone_moves_by_its_exponential() {
        for (square, damping) in [
            (400.0, 2.0),
            (400.0, 60.0),
            (400.0, 40.0),
            (0.0, 0.0),
            (-9.0, 1.0),
        ] {
            let time = 0.3;
            let steps = 20_000;
            let h = time / f64::from(steps);
            let mut state = [1.0, 0.5];
            for _ in 0..steps {
                let mut term = state;
                let mut sum = state;
                for order in 1..6 {
                    let [x, v] = term;
                    let share = h / f64::from(order);
                    term = [share * v, -share * (square * x + damping * v)];
                    sum = [sum[0] + term[0], sum[1] + term[1]];
                }
                state = sum;
            }
            let own = Drift::new(square, damping, time);
            let found = [0, 1].map(|k| own.from_deflection[k] + 0.5 * own.from_velocity[k]);
            for (found, expected) in found.iter().zip(state) {
                assert!(
                    (found - expected).abs() < 1e-9,
                    "{square} {damping}: {found} {expected}"
                );
            }
        }
    }
}
