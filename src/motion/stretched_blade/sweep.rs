//! Equilibria of the blade while its speed rises or falls slowly.

use faer::Col;

use crate::modes::Cancellation;

use super::{BranchEnd, Equilibrium, Extent, StretchedBlade, StretchedError, Turn};
use crate::model::scene::SpeedRange;

/// Stable equilibria in sequence, and the jumps between them.
#[derive(Debug, Clone, PartialEq)]
pub struct Sweep {
    /// Arcs without a jump; in each the speed rises, or in each it falls.
    pub arcs: Vec<Vec<Equilibrium>>,
    /// Ends of all arcs but the last. The blade then jumps to the first equilibrium of the next arc.
    pub ends: Vec<Turn>,
    /// Speed at which the largest number of equilibria or of arcs was reached, before the end of the range; `None` if
    /// the sweep is whole.
    pub stopped_rad_per_s: Option<f64>,
}

/// Distance past the end of an arc, as a share of the range of speeds, at which the next arc starts.
const PAST: f64 = 1e-5;
/// Largest number of arcs; a blade has a few in each band.
const MOST_ARCS: usize = 200;
/// Largest share of a move at the distance [`PAST`] that is left at a quarter of the distance if the blade does not
/// jump: past a pitchfork it moves with the square root of the distance, a half, and along a smooth curve less.
const NO_JUMP: f64 = 0.75;
/// Smallest jump, in thicknesses over the whole blade.
const LEAST_JUMP: f64 = 1e-4;

impl StretchedBlade {
    /// Follows the stable equilibrium from one end of a range of speeds to the other. Where the equilibrium becomes
    /// unstable the blade moves to the one found by [`StretchedBlade::settled`]; a vibrating blade may reach another
    /// one. At a pitchfork that it leaves without a jump, its arc goes on.
    ///
    /// # Errors
    /// [`StretchedError`] as for [`StretchedBlade::branch`] and [`StretchedBlade::settled`].
    pub fn sweep(
        &self,
        begun: &Col<f64>,
        upwards: bool,
        range: SpeedRange,
    ) -> Result<Sweep, StretchedError> {
        let [from, to] = range.ends();
        let (speed, end, sign) = if upwards {
            (from, to, 1.0)
        } else {
            (to, from, -1.0)
        };
        let mut start = self.settled(speed, begun)?;
        let mut sweep = Sweep {
            arcs: vec![Vec::new()],
            ends: Vec::new(),
            stopped_rad_per_s: None,
        };
        for _ in 0..MOST_ARCS {
            Cancellation::current().check()?;
            let curve = self.branch(&start, upwards, range, Extent::ToTurn)?;
            if let (BranchEnd::Lost, Some(last)) = (curve.end, curve.equilibria.last()) {
                return Err(self.not_found(&last.coordinates, last.speed_rad_per_s));
            }
            let turn = curve.turns.first();
            let is_before_turn = |e: &&Equilibrium| match turn {
                None => true,
                Some(turn) => {
                    sign * (turn.equilibrium.speed_rad_per_s - e.speed_rad_per_s) >= 0.0
                        && e.negative_eigenvalues == 0
                }
            };
            let mut stable: Vec<Equilibrium> = curve
                .equilibria
                .iter()
                .take_while(is_before_turn)
                .cloned()
                .collect();
            if turn.is_some() {
                stable.retain(monotone(sign));
            }
            stable.extend(turn.map(|turn| turn.equilibrium.clone()));
            let last = stable.last().map_or(speed, |e| e.speed_rad_per_s);
            if let Some(arc) = sweep.arcs.last_mut() {
                arc.append(&mut stable);
            }
            let Some(turn) = turn else {
                sweep.stopped_rad_per_s = (curve.end == BranchEnd::Most).then_some(last);
                return Ok(sweep);
            };
            let past = last + sign * PAST * range.width();
            if sign * (end - past) <= 0.0 {
                return Ok(sweep);
            }
            start = self.settled(past, &turn.equilibrium.coordinates)?;
            if self.jumps(turn, &start)? {
                sweep.ends.push(turn.clone());
                sweep.arcs.push(Vec::new());
            }
        }
        sweep.arcs.retain(|arc| !arc.is_empty());
        sweep.stopped_rad_per_s = Some(start.speed_rad_per_s);
        Ok(sweep)
    }

    /// Whether the blade jumps from the end of an arc to an equilibrium at a slightly different speed.
    fn jumps(&self, turn: &Turn, next: &Equilibrium) -> Result<bool, StretchedError> {
        let from = &turn.equilibrium;
        let quarter = from.speed_rad_per_s + 0.25 * (next.speed_rad_per_s - from.speed_rad_per_s);
        let closer = self.settled(quarter, &from.coordinates)?;
        let moved = |e: &Equilibrium| (&e.coordinates - &from.coordinates).norm_l2();
        let least = LEAST_JUMP * self.size();
        Ok(moved(&closer) > NO_JUMP * moved(next).max(least))
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
