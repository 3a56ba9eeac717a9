//! Evaluation of equilibria: deflections, slopes, and small motions about them.

use std::f64::consts::TAU;

use rayon::prelude::*;

use super::report::{Arc, EquilibriumCurve, Jump, SlowSweep, Turn};
use crate::model::scene::{Point, Polar, rpm};
use crate::motion::stretched_blade::{
    Branch, Equilibrium, LARGEST_SLOPE, Sites, Slopes, StretchedBlade, StretchedError, Sweep,
};

/// Evaluates equilibria of a blade.
pub(super) struct Reader<'a> {
    blade: &'a StretchedBlade,
    sites: Sites,
    slopes: Slopes,
    probe: Point,
    /// Frequency up to which small motions are listed.
    to_hz: f64,
}

impl<'a> Reader<'a> {
    pub fn new(blade: &'a StretchedBlade, probe: Point, to_hz: f64) -> Self {
        Reader {
            blade,
            sites: blade.sites(),
            slopes: blade.slopes(),
            probe,
            to_hz,
        }
    }

    fn at_probe_m(&self, e: &Equilibrium) -> f64 {
        let Polar {
            radius_m,
            angle_rad,
        } = self.probe.polar();
        self.blade.deflection_m(e, radius_m, angle_rad)
    }

    fn largest_m(&self, e: &Equilibrium) -> f64 {
        self.sites.largest_m(&e.coordinates)
    }

    /// Whether slopes exceed 0.1, where von Kármán's strains are not valid.
    fn is_steep(&self, e: &Equilibrium) -> bool {
        self.slopes.largest(&e.coordinates) > LARGEST_SLOPE
    }

    /// Speed at which the largest deflection of a sweep first exceeds a limit, by linear interpolation between two
    /// equilibria.
    pub fn beyond_rpm(&self, sweep: &Sweep, limit_m: f64) -> Option<f64> {
        let mut before: Option<(f64, f64)> = None;
        let equilibria = sweep.arcs.iter().flatten();
        for e in equilibria.take_while(|e| !self.is_steep(e)) {
            let (speed, largest_m) = (e.speed_rad_per_s, self.largest_m(e));
            if largest_m > limit_m {
                let crossed = before.map_or(speed, |(slower, smaller_m)| {
                    let share = (limit_m - smaller_m) / (largest_m - smaller_m);
                    slower + share * (speed - slower)
                });
                return Some(rpm(crossed));
            }
            before = Some((speed, largest_m));
        }
        None
    }

    /// The part of a sweep with small slopes.
    ///
    /// # Errors
    /// [`StretchedError`] if small motions cannot be computed.
    pub fn sweep(&self, sweep: &Sweep) -> Result<SlowSweep, StretchedError> {
        let (mut arcs, mut valid_until_rpm) = (Vec::new(), None);
        let mut jumps: Vec<Jump> = self.jumps(sweep).collect();
        for (k, arc) in sweep.arcs.iter().enumerate() {
            let steep = arc.iter().position(|e| self.is_steep(e));
            let gentle = &arc[..steep.unwrap_or(arc.len())];
            if !gentle.is_empty() {
                arcs.push(self.arc(gentle)?);
            }
            if let Some(place) = steep {
                valid_until_rpm = Some(rpm(arc[place].speed_rad_per_s));
                jumps.truncate(k);
                break;
            }
        }
        let stopped = sweep
            .stopped_rad_per_s
            .filter(|_| valid_until_rpm.is_none());
        Ok(SlowSweep {
            arcs,
            jumps,
            valid_until_rpm,
            stopped_at_rpm: stopped.map(rpm),
        })
    }

    fn jumps(&self, sweep: &Sweep) -> impl Iterator<Item = Jump> {
        let pairs = sweep.ends.iter().zip(sweep.arcs.iter().skip(1));
        pairs.map(|(turn, next)| {
            let before = &turn.equilibrium;
            let after = next.first().unwrap_or(before);
            Jump {
                kind: turn.kind,
                rpm: rpm(before.speed_rad_per_s),
                from_m: self.at_probe_m(before),
                to_m: self.at_probe_m(after),
                largest_from_m: self.largest_m(before),
                largest_to_m: self.largest_m(after),
            }
        })
    }

    fn arc(&self, arc: &[Equilibrium]) -> Result<Arc, StretchedError> {
        let of = |value: &(dyn Fn(&Equilibrium) -> f64 + Sync)| arc.par_iter().map(value).collect();
        let frequencies = arc.par_iter().map(|e| self.frequencies_hz(e));
        let forces: Vec<Vec<f64>> = arc.iter().map(|e| self.blade.pad_forces_n(e)).collect();
        let pads = forces.first().map_or(0, Vec::len);
        let of_pad = |pad: usize| forces.iter().map(|forces| forces[pad]).collect();
        Ok(Arc {
            rpm: of(&|e| rpm(e.speed_rad_per_s)),
            deflection_m: of(&|e| self.at_probe_m(e)),
            largest_deflection_m: of(&|e| self.largest_m(e)),
            largest_slope: of(&|e| self.slopes.largest(&e.coordinates)),
            pad_forces_n: (0..pads).map(of_pad).collect(),
            frequencies_hz: frequencies.collect::<Result<_, _>>()?,
        })
    }

    fn frequencies_hz(&self, e: &Equilibrium) -> Result<Vec<f64>, StretchedError> {
        let motions = self.blade.small_motions(e)?;
        let all = motions.iter().map(|lambda| lambda.im / TAU);
        let mut below: Vec<f64> = all.filter(|hz| *hz <= self.to_hz).collect();
        below.sort_by(f64::total_cmp);
        Ok(below)
    }

    /// The part of a curve with small slopes.
    pub fn curve(&self, curve: &Branch) -> EquilibriumCurve {
        let gentle: Vec<&Equilibrium> = curve
            .equilibria
            .par_iter()
            .filter(|e| !self.is_steep(e))
            .collect();
        let turns = curve
            .turns
            .iter()
            .filter(|turn| !self.is_steep(&turn.equilibrium));
        EquilibriumCurve {
            rpm: gentle.iter().map(|e| rpm(e.speed_rad_per_s)).collect(),
            deflection_m: gentle.iter().map(|e| self.at_probe_m(e)).collect(),
            largest_deflection_m: gentle.par_iter().map(|e| self.largest_m(e)).collect(),
            negative_eigenvalues: gentle.iter().map(|e| e.negative_eigenvalues).collect(),
            turns: turns
                .map(|turn| Turn {
                    kind: turn.kind,
                    rpm: rpm(turn.equilibrium.speed_rad_per_s),
                    deflection_m: self.at_probe_m(&turn.equilibrium),
                })
                .collect(),
        }
    }
}
