//! Deflections of a motion at the probe and around the rim.
//!
//! A probe beside a pad moves little while the rim swings; what the blade does to the wood and to its guides is the largest
//! deflection, which is at the free rim.
//!
//! Between two states of a motion the deflection of each place is the cubic polynomial that has their deflections and velocities
//! (Hermite). Its error is at most (ωΔ)⁴/384 of an oscillation with the frequency ω over a step Δ.

use std::f64::consts::TAU;

use faer::{Col, Mat};

use super::State;
use crate::model::scene::{Blade, Point, Polar};

/// Number of places around the rim at which its deflection is read. The vertex of a parabola through the largest reading and its
/// neighbours is within 0.1 % of the largest deflection in waves of up to four diameters, within 1 % in those of up to eight.
const AROUND: usize = 64;

/// Deflections at the end of a step, in m.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Deflections {
    /// Deflection at the probe.
    pub at_probe_m: f64,
    /// Largest magnitude at the rim and at the probe during the step.
    pub largest_m: f64,
}

/// The largest deflection of a motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Largest {
    /// Magnitude, in m.
    pub deflection_m: f64,
    /// Rotation speed at which the blade deflects that far.
    pub speed_rad_per_s: f64,
}

impl Largest {
    /// That of a motion that begins undeflected at a speed.
    pub fn from(speed_rad_per_s: f64) -> Self {
        Largest {
            deflection_m: 0.0,
            speed_rad_per_s,
        }
    }

    /// Takes the deflections in a step at a speed into account.
    pub fn include(&mut self, read: Deflections, speed_rad_per_s: f64) {
        if read.largest_m > self.deflection_m {
            *self = Largest {
                deflection_m: read.largest_m,
                speed_rad_per_s,
            };
        }
    }
}

/// What reads the deflections from the coordinates of a motion on a reduced basis.
#[derive(Debug)]
pub(crate) struct Reader {
    probe: Col<f64>,
    /// A row for each place around the rim.
    rim: Mat<f64>,
}

impl Reader {
    /// Of a blade with a probe; `shapes_at` gives the values of the functions of the basis at a place.
    pub fn new(blade: &Blade, probe: Point, shapes_at: impl Fn(Polar) -> Col<f64>) -> Self {
        let angle_rad = |k: usize| TAU * k as f64 / AROUND as f64;
        let rim: Vec<Col<f64>> = (0..AROUND)
            .map(|k| shapes_at(Polar::new(blade.outer_radius_m, angle_rad(k))))
            .collect();
        let probe = shapes_at(probe.polar());
        Reader {
            rim: Mat::from_fn(AROUND, probe.nrows(), |k, i| rim[k][i]),
            probe,
        }
    }

    /// Deflections in a step from one state to another.
    pub fn read(&self, [before, after]: [&State; 2], step_s: f64) -> Deflections {
        let states = Mat::from_fn(self.probe.nrows(), 4, |i, k| match k {
            0 => before.displacement[i],
            1 => step_s * before.velocity[i],
            2 => after.displacement[i],
            _ => step_s * after.velocity[i],
        });
        let (rim, probe) = (&self.rim * &states, self.probe.transpose() * &states);
        let at_probe = Cubic::new([0, 1, 2, 3].map(|k| probe[k]));
        let rim: Vec<Cubic> = (0..AROUND)
            .map(|place| Cubic::new([0, 1, 2, 3].map(|k| rim[(place, k)])))
            .collect();
        let (mut at_share, mut most) = (1.0, f64::NEG_INFINITY);
        for cubic in &rim {
            if cubic.bound() < most {
                continue;
            }
            let (share, size) = cubic.largest();
            if size.total_cmp(&most).is_ge() {
                (at_share, most) = (share, size);
            }
        }
        let around: Vec<f64> = rim.iter().map(|cubic| cubic.at(at_share)).collect();
        Deflections {
            at_probe_m: at_probe.at(1.0),
            largest_m: larger(largest_m(&around), at_probe.largest().1),
        }
    }

    /// Deflection at the probe.
    pub fn at_probe_m(&self, displacement: &Col<f64>) -> f64 {
        self.probe.transpose() * displacement
    }
}

/// The larger of two magnitudes; not finite if one of them is not.
fn larger(a: f64, b: f64) -> f64 {
    if a.total_cmp(&b).is_gt() { a } else { b }
}

/// A deflection over the share of a step, Σ cₖ sᵏ.
struct Cubic([f64; 4]);

impl Cubic {
    /// From the deflection and its change per step at the beginning, and at the end.
    fn new([begun, leaves, ended, arrives]: [f64; 4]) -> Self {
        let change = ended - begun;
        Cubic([
            begun,
            leaves,
            3.0 * change - 2.0 * leaves - arrives,
            leaves + arrives - 2.0 * change,
        ])
    }

    /// A magnitude that the deflection does not exceed in the step: Hermite's functions of both deflections are positive with the sum
    /// one, and those of both changes are at most 4/27.
    fn bound(&self) -> f64 {
        let Cubic([a, b, c, d]) = self;
        let arrives = b + 2.0 * c + 3.0 * d;
        a.abs().max(self.at(1.0).abs()) + 4.0 / 27.0 * (b.abs() + arrives.abs())
    }

    fn at(&self, share: f64) -> f64 {
        let Cubic([a, b, c, d]) = self;
        a + share * (b + share * (c + share * d))
    }

    /// The share of the step at which the magnitude is largest, and this magnitude; not finite if a coefficient is not.
    fn largest(&self) -> (f64, f64) {
        let Cubic([_, b, c, d]) = self;
        // Of b + 2cs + 3ds² the root that cancellation spoils is found from the other one.
        let half = -(c + c.signum() * (c * c - 3.0 * b * d).sqrt());
        let turns = [half / (3.0 * d), b / half].into_iter();
        let within = turns.filter(|share| (0.0..=1.0).contains(share));
        let places = within.chain([0.0, 1.0]);
        let sizes = places.map(|share| (share, self.at(share).abs()));
        sizes
            .max_by(|x, y| x.1.total_cmp(&y.1))
            .unwrap_or((1.0, self.at(1.0).abs()))
    }
}

/// Largest magnitude of a periodic function that is read at even places; not finite if a reading is not.
fn largest_m(readings: &[f64]) -> f64 {
    let count = readings.len();
    let places = 0..count;
    let largest = places.max_by(|i, k| readings[*i].abs().total_cmp(&readings[*k].abs()));
    let Some(largest) = largest else { return 0.0 };
    let sign = readings[largest].signum();
    let [before, here, after] =
        [count - 1, 0, 1].map(|step| sign * readings[(largest + step) % count]);
    let curvature = 2.0 * here - before - after;
    if curvature == 0.0 {
        return here;
    }
    here + (after - before).powi(2) / (8.0 * curvature)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn around(count: usize, w: impl Fn(f64) -> f64) -> Vec<f64> {
        let places = 0..count;
        places.map(|k| w(TAU * k as f64 / count as f64)).collect()
    }

    /// Waves at any angle between two places, and their sum, which is read at a thousand times as many places.
    #[test]
    fn the_largest_deflection_of_waves_is_found_between_the_places() {
        for (diameters, bound) in [(0, 1e-12), (1, 3e-6), (2, 5e-5), (4, 1e-3), (8, 1e-2)] {
            for turn in 0..10 {
                let angle = 0.1 * f64::from(turn) * TAU / AROUND as f64;
                let found = largest_m(&around(AROUND, |x| {
                    -2.0 * (f64::from(diameters) * (x - angle)).cos()
                }));
                assert!(
                    (found / 2.0 - 1.0).abs() < bound,
                    "{diameters} {angle}: {found}"
                );
            }
        }
        let sum =
            |x: f64| 1.3 * (2.0 * x + 0.3).cos() - (3.0 * x).sin() + 0.2 * (5.0 * x).cos() - 0.4;
        let dense = around(1000 * AROUND, |x| sum(x).abs());
        let exact = dense.into_iter().fold(0.0, f64::max);
        let found = largest_m(&around(AROUND, sum));
        assert!((found / exact - 1.0).abs() < 1e-3, "{found} {exact}");
    }

    /// Steps of at most a radian of a sine, whose largest values are 1.
    #[test]
    fn the_largest_value_of_a_sine_is_found_between_two_states() {
        for (begun, step) in [(1.2, 0.9), (1.0, 0.7), (4.3, 1.0), (1.56, 0.1)] {
            let [at, slope] = [f64::sin, f64::cos];
            let cubic = Cubic::new([
                at(begun),
                step * slope(begun),
                at(begun + step),
                step * slope(begun + step),
            ]);
            let (share, found) = cubic.largest();
            assert!((found - 1.0).abs() < 3e-3, "{begun}: {found}");
            assert!((cubic.at(share).abs() - found).abs() < 1e-15);
            assert_eq!(cubic.at(0.0), at(begun));
            assert!(cubic.bound() >= found);
        }
        assert_eq!(Cubic::new([2.0, 0.0, 2.0, 0.0]).largest().1, 2.0);
        assert!(
            !Cubic::new([1.0, f64::NAN, 2.0, 0.0])
                .largest()
                .1
                .is_finite()
        );
    }

    #[test]
    fn a_reading_that_has_overflowed_is_not_hidden() {
        for overflowed in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let mut readings = vec![1.0; AROUND];
            readings[5] = overflowed;
            assert!(!largest_m(&readings).is_finite());
        }
        assert_eq!(largest_m(&[0.0; AROUND]), 0.0);
    }
}
