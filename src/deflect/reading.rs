//! Evaluation of an equilibrium: deflections, slope, and small motions about it.

use faer::c64;
use rayon::prelude::*;

use crate::scene::Probe;
use crate::stretched::{
    Branch, Equilibrium, LARGEST_SLOPE, Sites, StretchedBlade, StretchedError, Sweep, TurnKind,
};

/// Results for an equilibrium.
#[derive(Debug, Clone, PartialEq)]
pub struct Reading {
    /// Rotation speed Ω.
    pub speed_rad_per_s: f64,
    /// Deflection at the scene's probe.
    pub deflection_m: f64,
    /// Largest magnitude of the deflection over the blade.
    pub largest_m: f64,
    /// Largest slope of the blade.
    pub largest_slope: f64,
    /// Force of each pad that lifts off on the blade beyond its gap, without that of its film, in the order of the
    /// scene's guides.
    pub pad_forces_n: Vec<f64>,
    /// Number of negative eigenvalues of ∂²V/∂q²; zero if the equilibrium is stable.
    pub negative_eigenvalues: usize,
    /// Eigenvalues of small motions about the equilibrium, with Im λ ≥ 0, by magnitude; empty for curves.
    pub eigenvalues_per_s: Vec<c64>,
}

/// A speed at which the blade leaves a stable equilibrium for another.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Jump {
    /// Whether the equilibrium ends or another one crosses it.
    pub kind: TurnKind,
    /// Rotation speed Ω.
    pub speed_rad_per_s: f64,
    /// Deflection at the probe before and after the jump.
    pub deflection_m: [f64; 2],
    /// Largest deflection over the blade before and after the jump.
    pub largest_m: [f64; 2],
}

/// Stable equilibria for rising or falling speed.
#[derive(Debug, Clone, PartialEq)]
pub struct SlowSweep {
    /// Arcs between jumps.
    pub arcs: Vec<Vec<Reading>>,
    /// Jumps at the ends of all arcs but the last.
    pub jumps: Vec<Jump>,
    /// Speed Ω from which on slopes exceed 0.1, where von Kármán's strains are not valid; equilibria beyond it are
    /// omitted. `None` if no slope exceeds 0.1.
    pub valid_until_rad_per_s: Option<f64>,
    /// Speed Ω at which the sweep stopped at its largest number of equilibria, before an end of the range; `None` if it
    /// did not, or if the model ends earlier.
    pub stopped_rad_per_s: Option<f64>,
}

impl SlowSweep {
    /// All equilibria in the order of the sweep.
    pub fn readings(&self) -> impl Iterator<Item = &Reading> + Clone {
        self.arcs.iter().flatten()
    }
}

/// A curve of equilibria.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// Equilibria in the order of the curve.
    pub readings: Vec<Reading>,
    /// Folds and bifurcations: kind, Ω, and deflection at the probe.
    pub turns: Vec<(TurnKind, f64, f64)>,
    /// Whether the curve ends at an end of the range, and not at the largest number of equilibria of a figure.
    pub is_whole: bool,
}

/// Evaluates equilibria of a blade.
pub(super) struct Reader<'a> {
    blade: &'a StretchedBlade,
    sites: Sites,
    probe: (f64, f64),
}

impl<'a> Reader<'a> {
    pub(super) fn new(blade: &'a StretchedBlade, probe: &Probe) -> Self {
        Reader {
            blade,
            sites: blade.sites(),
            probe: (probe.radius_m, probe.angle_rad),
        }
    }

    fn at_probe(&self, e: &Equilibrium) -> f64 {
        self.blade.deflection_m(e, self.probe.0, self.probe.1)
    }

    fn reading(&self, e: &Equilibrium) -> Reading {
        Reading {
            speed_rad_per_s: e.speed_rad_per_s,
            deflection_m: self.at_probe(e),
            largest_m: self.sites.largest_m(&e.coordinates),
            largest_slope: self.blade.largest_slope(e),
            pad_forces_n: self.blade.pad_forces_n(e),
            negative_eigenvalues: e.negative_eigenvalues,
            eigenvalues_per_s: Vec::new(),
        }
    }

    fn with_motions(&self, e: &Equilibrium) -> Result<Reading, StretchedError> {
        Ok(Reading {
            eigenvalues_per_s: self.blade.small_motions(e)?,
            ..self.reading(e)
        })
    }

    /// The part of a sweep with small slopes.
    pub(super) fn sweep(&self, sweep: &Sweep) -> Result<SlowSweep, StretchedError> {
        let arcs = sweep.arcs.iter().map(|arc| {
            let arc = arc.par_iter().map(|e| self.with_motions(e));
            arc.collect::<Result<Vec<_>, _>>()
        });
        let mut arcs = arcs.collect::<Result<Vec<_>, _>>()?;
        let mut jumps: Vec<Jump> = sweep
            .ends
            .iter()
            .zip(sweep.arcs.windows(2))
            .map(|(turn, arcs)| {
                let before = &turn.equilibrium;
                let after = arcs[1].first().unwrap_or(before);
                Jump {
                    kind: turn.kind,
                    speed_rad_per_s: before.speed_rad_per_s,
                    deflection_m: [before, after].map(|e| self.at_probe(e)),
                    largest_m: [before, after].map(|e| self.sites.largest_m(&e.coordinates)),
                }
            })
            .collect();
        let steep = |at: &Reading| at.largest_slope > LARGEST_SLOPE;
        let first_steep = (arcs.iter().enumerate())
            .find_map(|(arc, readings)| Some((arc, readings.iter().position(steep)?)));
        let valid_until_rad_per_s = first_steep.map(|(arc, k)| arcs[arc][k].speed_rad_per_s);
        if let Some((last, place)) = first_steep {
            arcs.truncate(last + 1);
            jumps.truncate(last);
            arcs[last].truncate(place);
            arcs.retain(|arc| !arc.is_empty());
        }
        Ok(SlowSweep {
            arcs,
            jumps,
            valid_until_rad_per_s,
            stopped_rad_per_s: match valid_until_rad_per_s {
                None => sweep.stopped_rad_per_s,
                Some(_) => None,
            },
        })
    }

    /// The part of a curve with small slopes.
    pub(super) fn curve(&self, curve: &Branch) -> Curve {
        let readings = curve.equilibria.par_iter().map(|e| self.reading(e));
        let mut readings: Vec<Reading> = readings.collect();
        readings.retain(|at| at.largest_slope <= LARGEST_SLOPE);
        let turns = curve.turns.iter();
        let turns =
            turns.filter(|turn| self.blade.largest_slope(&turn.equilibrium) <= LARGEST_SLOPE);
        Curve {
            turns: turns
                .map(|turn| {
                    let e = &turn.equilibrium;
                    (turn.kind, e.speed_rad_per_s, self.at_probe(e))
                })
                .collect(),
            readings,
            is_whole: curve.is_whole,
        }
    }
}
