//! Equilibria of the blade while its speed rises or falls slowly.

use faer::Col;

use crate::spectrum::Cancellation;

use super::{Equilibrium, Extent, StretchedBlade, StretchedError, Turn};

/// Stable equilibria in sequence, and the jumps between them.
#[derive(Debug, Clone, PartialEq)]
pub struct Sweep {
    /// Arcs without a jump; in each the speed rises, or in each it falls.
    pub arcs: Vec<Vec<Equilibrium>>,
    /// Ends of all arcs but the last. The blade then reaches the first equilibrium of the next arc.
    pub ends: Vec<Turn>,
}

/// Distance past the end of an arc, as a share of the range of speeds, at which the next arc starts.
const PAST: f64 = 1e-5;
/// Largest number of arcs; a blade has a few in each band.
const MOST_ARCS: usize = 200;

impl StretchedBlade {
    /// Follows the stable equilibrium from one end of a range of speeds to the other. Where the equilibrium becomes
    /// unstable the blade jumps to the one found by [`StretchedBlade::settled`]; a vibrating blade may reach another
    /// one.
    ///
    /// # Errors
    /// [`StretchedError`] as for [`StretchedBlade::branch`] and [`StretchedBlade::settled`].
    pub fn sweep(
        &self,
        begun: &Col<f64>,
        upwards: bool,
        range: (f64, f64),
    ) -> Result<Sweep, StretchedError> {
        let (from, to) = range;
        let (mut speed, end, sign) = match upwards {
            true => (from, to, 1.0),
            false => (to, from, -1.0),
        };
        let mut p = begun.clone();
        let mut sweep = Sweep {
            arcs: Vec::new(),
            ends: Vec::new(),
        };
        while sweep.arcs.len() < MOST_ARCS {
            Cancellation::current().check()?;
            let start = self.settled(speed, &p)?;
            let curve = self.branch(&start, upwards, range, Extent::ToTurn)?;
            let is_before_turn = |e: &&Equilibrium| match curve.turns.first() {
                None => true,
                Some(turn) => {
                    sign * (turn.equilibrium.speed_rad_per_s - e.speed_rad_per_s) >= 0.0
                        && e.negative_eigenvalues == 0
                }
            };
            let mut arc: Vec<Equilibrium> = curve
                .equilibria
                .iter()
                .take_while(is_before_turn)
                .cloned()
                .collect();
            let Some(turn) = curve.turns.first().cloned() else {
                sweep.arcs.push(arc);
                break;
            };
            arc.retain(monotone(sign));
            arc.push(turn.equilibrium.clone());
            sweep.arcs.push(arc);
            speed = turn.equilibrium.speed_rad_per_s + sign * PAST * (to - from);
            if sign * (end - speed) <= 0.0 {
                break;
            }
            p = turn.equilibrium.coordinates.clone();
            sweep.ends.push(turn);
        }
        Ok(sweep)
    }
}

/// Keeps equilibria while the speed changes in one direction.
fn monotone(sign: f64) -> impl FnMut(&Equilibrium) -> bool {
    let mut last = f64::NEG_INFINITY;
    move |e| {
        let further = sign * e.speed_rad_per_s > last;
        if further {
            last = sign * e.speed_rad_per_s;
        }
        further
    }
}
