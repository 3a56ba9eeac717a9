//! What the blade does while its speed rises or falls so slowly that it stands still at each.

use faer::Col;

use crate::spectrum::Cancellation;

use super::{Equilibrium, Extent, StretchedBlade, StretchedError, Turn};

/// Stable equilibria one after the other, and where the blade leaves one for another.
#[derive(Debug, Clone, PartialEq)]
pub struct Sweep {
    /// Stretches without a jump, the speed rising, or else falling, in each.
    pub arcs: Vec<Vec<Equilibrium>>,
    /// What ends each arc but the last, and where the blade comes to rest after it: the first equilibrium of
    /// the next arc.
    pub ends: Vec<Turn>,
}

/// Past the end of an arc the blade is looked at this share of the range of speeds further on.
const PAST: f64 = 1e-5;
/// Most arcs: a blade has a few in each band.
const MOST_ARCS: usize = 200;

impl StretchedBlade {
    /// Follows the stable equilibrium from one end of a range of speeds to the other. Where it ceases to be
    /// stable the blade goes to the next one that [`StretchedBlade::settled`] finds; a blade that swings may go
    /// to another.
    ///
    /// # Errors
    /// As [`StretchedBlade::branch`] and [`StretchedBlade::settled`].
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
            let stands = |e: &&Equilibrium| match curve.turns.first() {
                None => true,
                Some(turn) => {
                    sign * (turn.equilibrium.speed_rad_per_s - e.speed_rad_per_s) >= 0.0
                        && e.negative_eigenvalues == 0
                }
            };
            let mut arc: Vec<Equilibrium> = curve
                .equilibria
                .iter()
                .take_while(stands)
                .cloned()
                .collect();
            let turn = curve.turns.first().cloned();
            let Some(turn) = turn else {
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

/// Keeps what goes on in one direction of speed.
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
