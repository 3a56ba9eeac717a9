//! Number of growing motions, by the argument principle, and the smallest stiffness at which one grows.

use faer::c64;
use std::f64::consts::PI;

use crate::modes::turn_along;

use super::delayed_saw::{Boundary, DelayedSaw};

/// Eigenvalues of the loop gain along the imaginary axis.
#[derive(Debug)]
pub struct LoopGains<'a> {
    saw: &'a DelayedSaw,
    ceiling: f64,
    places: Vec<Place>,
}

#[derive(Debug, Clone)]
struct Place {
    omega: f64,
    gains: Vec<c64>,
}

/// Number of frequencies per period of the delay term.
const A_TURN: f64 = 16.0;
/// Largest number of periods of the delay that are sampled evenly. Beyond, a large loop gain occurs only near
/// a mode, where further frequencies are sampled.
const MOST_EVEN: f64 = 20_000.0;
/// Distances of the frequencies sampled about each mode from its frequency, in units of its decay rate.
const ABOUT_A_MODE: [f64; 7] = [0.0, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0];
/// Largest relative change of a loop gain between neighbouring frequencies.
const LARGEST_CHANGE: f64 = 0.35;
/// Largest number of times that an interval between two frequencies is halved.
const MOST_HALVINGS: usize = 26;
/// Relative distance below the boundary at which the count confirms it.
const BELOW: f64 = 1e-3;

impl<'a> LoopGains<'a> {
    /// Samples the loop gains up to the frequency beyond which nothing grows for stiffnesses up to `ceiling`.
    /// `None` if an eigenvalue of the saw lies on the imaginary axis.
    pub fn new(saw: &'a DelayedSaw, ceiling: f64) -> Option<Self> {
        let omegas = places(saw, ceiling);
        let mut followed = LoopGains {
            saw,
            ceiling,
            places: Vec::with_capacity(2 * omegas.len()),
        };
        for omega in omegas {
            let next = Place::at(saw, omega)?;
            match followed.places.last().cloned() {
                Some(before) => followed.follow(&before, next, 0)?,
                None => followed.places.push(next),
            }
        }
        Some(followed)
    }

    /// Adds a place, and before it others until the eigenvalues at neighbouring places can be matched. `None` if
    /// an eigenvalue of the saw is on the imaginary axis.
    fn follow(&mut self, before: &Place, next: Place, halvings: usize) -> Option<()> {
        let least = 1.0 / self.ceiling;
        let clear = matched(before, &next).into_iter().all(|[x, y]| {
            let size = x.norm().max(y.norm());
            size < least || (x - y).norm() <= LARGEST_CHANGE * size
        });
        if !clear && halvings < MOST_HALVINGS {
            let middle = Place::at(self.saw, 0.5 * (before.omega + next.omega))?;
            self.follow(before, middle.clone(), halvings + 1)?;
            return self.follow(&middle, next, halvings + 1);
        }
        self.places.push(next);
        Some(())
    }

    /// Number of eigenvalues in the right half plane; `None` if one lies on the imaginary axis.
    ///
    /// Relative to the saw without delay, each additional eigenvalue turns the argument of det(1 + kX) by −π
    /// between zero and the last frequency; its argument at the last frequency is subtracted.
    pub fn growing(&self, stiffness: f64) -> Option<usize> {
        let angle = |gains: &[c64]| -> f64 {
            let factors = gains.iter().map(|gain| (1.0 + gain * stiffness).arg());
            factors.sum()
        };
        let omegas: Vec<f64> = self.places.iter().map(|place| place.omega).collect();
        let at = |omega: f64| {
            let known = self.places.binary_search_by(|p| p.omega.total_cmp(&omega));
            match known {
                Ok(index) => Some(angle(&self.places[index].gains)),
                Err(_) => Some(angle(&self.saw.gains(omega)?)),
            }
        };
        let turn = turn_along(&omegas, at)?;
        let end = angle(&self.places.last()?.gains);
        let more = ((end - turn) / PI).round() as isize;
        usize::try_from(self.saw.unstable_poles() as isize + more).ok()
    }

    /// The smallest stiffness up to the ceiling at which an eigenvalue lies on the imaginary axis: −1/x_i for
    /// a loop gain x_i that is real and negative. `None` if there is none. The saw must be stable without the
    /// delayed force.
    pub fn boundary(&self) -> Option<Boundary> {
        let mut best: Option<Boundary> = self.standing();
        let mut crossings: Vec<Crossing> = self.crossings().collect();
        crossings.sort_by(|x, y| x.most_negative().total_cmp(&y.most_negative()));
        for crossing in crossings {
            // A loop gain changes by at most `LARGEST_CHANGE` between two neighbouring frequencies, so that
            // in this interval it is taken to be at most 1.5 times the larger of its two values there.
            let least = -1.0 / (1.5 * crossing.most_negative());
            if best.is_some_and(|best| best.stiffness_n_per_m <= least) {
                break;
            }
            let found = crossing.found(self.saw);
            let better = found.filter(|found| {
                best.is_none_or(|best| found.stiffness_n_per_m < best.stiffness_n_per_m)
            });
            best = better.or(best);
        }
        best.filter(|best| best.stiffness_n_per_m <= self.ceiling)
    }

    /// Whether the count finds nothing growing just below a boundary, or just below the ceiling if there is
    /// no boundary.
    pub fn confirms(&self, boundary: Option<Boundary>) -> bool {
        match boundary.map(|boundary| boundary.stiffness_n_per_m) {
            Some(stiffness) => self.growing(stiffness * (1.0 - BELOW)) == Some(0),
            None => self.growing(self.ceiling) == Some(0),
        }
    }

    /// Smallest stiffness at which a motion without oscillation grows, from the real loop gains at zero
    /// frequency.
    fn standing(&self) -> Option<Boundary> {
        let first = self.places.first().filter(|place| place.omega == 0.0)?;
        let real = first
            .gains
            .iter()
            .filter(|gain| gain.re < 0.0 && gain.im.abs() <= 1e-9 * gain.re.abs());
        let least = real.map(|gain| -1.0 / gain.re).reduce(f64::min)?;
        Some(Boundary {
            stiffness_n_per_m: least,
            frequency_rad_per_s: 0.0,
        })
    }

    /// The loop gains that become real and negative between neighbouring frequencies, up to the ceiling.
    fn crossings(&self) -> impl Iterator<Item = Crossing> + '_ {
        let least = 1.0 / self.ceiling;
        self.places.windows(2).flat_map(move |pair| {
            let ends = [pair[0].omega, pair[1].omega];
            let pairs = matched(&pair[0], &pair[1]).into_iter();
            let crossings = pairs.map(move |gains| Crossing { ends, gains });
            crossings.filter(move |crossing| {
                let [x, y] = crossing.gains;
                x.im * y.im <= 0.0 && x.im != y.im && 1.5 * crossing.most_negative() <= -least
            })
        })
    }
}

/// A loop gain whose imaginary part changes its sign between two frequencies.
#[derive(Debug, Clone, Copy)]
struct Crossing {
    ends: [f64; 2],
    gains: [c64; 2],
}

impl Crossing {
    fn most_negative(&self) -> f64 {
        self.gains[0].re.min(self.gains[1].re)
    }

    /// The boundary, by bisection of the interval to machine precision; `None` if the gain is not negative there.
    fn found(mut self, saw: &DelayedSaw) -> Option<Boundary> {
        loop {
            let omega = 0.5 * (self.ends[0] + self.ends[1]);
            let expected = (self.gains[0] + self.gains[1]) * 0.5;
            let distance = |gain: &c64| (gain - expected).norm();
            let gains = saw.gains(omega)?;
            let gain = gains
                .into_iter()
                .min_by(|x, y| distance(x).total_cmp(&distance(y)))?;
            let ended = omega <= self.ends[0] || omega >= self.ends[1];
            if ended || gain.im == 0.0 {
                return (gain.re < 0.0).then(|| Boundary {
                    stiffness_n_per_m: -1.0 / gain.re,
                    frequency_rad_per_s: omega,
                });
            }
            let side = usize::from(gain.im * self.gains[0].im < 0.0);
            self.ends[side] = omega;
            self.gains[side] = gain;
        }
    }
}

impl Place {
    fn at(saw: &DelayedSaw, omega: f64) -> Option<Self> {
        let gains = saw.gains(omega)?;
        Some(Place { omega, gains })
    }
}

/// Pairs the gains of two frequencies by their distance, beginning with the largest gain.
fn matched(first: &Place, second: &Place) -> Vec<[c64; 2]> {
    let mut own = first.gains.clone();
    own.sort_by(|x, y| y.norm().total_cmp(&x.norm()));
    let mut others = second.gains.clone();
    let mut pairs = Vec::with_capacity(own.len());
    for gain in own {
        let nearest = (0..others.len()).min_by(|&i, &k| {
            let distance = |other: c64| (gain - other).norm();
            distance(others[i]).total_cmp(&distance(others[k]))
        });
        if let Some(index) = nearest {
            pairs.push([gain, others.swap_remove(index)]);
        }
    }
    pairs
}

/// Initial frequencies in rad/s: about each mode, and evenly over the periods of the delay.
fn places(saw: &DelayedSaw, ceiling: f64) -> Vec<f64> {
    let to = saw.reach(ceiling);
    let step = (std::f64::consts::TAU / saw.delay.longest_s() / A_TURN).max(to / MOST_EVEN);
    let even = (0..(to / step).ceil() as usize).map(|k| k as f64 * step);
    let mut places: Vec<f64> = even.chain([to]).collect();
    for pole in saw.transfer.poles.iter().filter(|pole| pole.im >= 0.0) {
        for share in ABOUT_A_MODE {
            places.extend([-1.0, 1.0].map(|side| pole.im + side * share * pole.re));
        }
    }
    places.retain(|omega| (0.0..=to).contains(omega));
    places.sort_by(f64::total_cmp);
    places.dedup();
    // Where `matters` is false, every factor of the determinant has a positive real part, so that frequencies
    // between two such neighbours are not needed.
    let last = places.len() - 1;
    let matter: Vec<bool> = places
        .iter()
        .map(|omega| saw.matters(*omega, ceiling))
        .collect();
    let near = |k: usize| matter[k.saturating_sub(1)..=(k + 1).min(last)].contains(&true);
    let kept = (0..=last).filter(|&k| k == 0 || k == last || near(k));
    kept.map(|k| places[k]).collect()
}
