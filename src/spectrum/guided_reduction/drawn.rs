//! The few states that the curves of a piece are drawn from.

use std::sync::atomic::Ordering;

use super::{Builder, Snapshot};
use crate::spectrum::hamiltonian::{HamiltonianReduction, State};
use crate::spectrum::mode_pair::standing_states;
use crate::spectrum::projection::Projection;
use crate::spectrum::vectors::Eigenpair;
use crate::tuned::Tuned;

/// Largest estimated error of a frequency that is drawn from them, relative to the chart's height.
const LOCAL_TOLERANCE: Tuned = Tuned::new("spectrum/guided_reduction/drawn::LOCAL_TOLERANCE", 1e-5);
/// Modes up to this multiple of the window are among these states.
const DRAWN_MARGIN: Tuned = Tuned::new("spectrum/guided_reduction/drawn::DRAWN_MARGIN", 1.05);

impl Builder<'_> {
    /// Both halves of a piece on the states at its ends, in its middle, and where a wave
    /// stands; nothing for a half that is not good enough to draw.
    pub(super) fn drawn(
        &self,
        piece: &Projection,
        ends: &[Snapshot],
        (middle, pairs): (f64, Vec<Eigenpair>),
    ) -> Vec<(f64, Option<HamiltonianReduction>)> {
        let low = |pairs: Vec<Eigenpair>| -> Vec<Eigenpair> {
            let height = DRAWN_MARGIN.get() * self.window;
            let low = |pair: &Eigenpair| pair.0.im <= height && pair.0.norm() <= 2.0 * height;
            pairs.into_iter().filter(low).collect()
        };
        let end = |snapshot: &Snapshot| {
            let inward = snapshot.pairs.iter().map(|pair| piece.inward(pair));
            piece.states(snapshot.speed, low(inward.collect()))
        };
        let inner = piece.states(middle, low(pairs));
        let (left, right) = (end(&ends[0]), end(&ends[1]));
        let mut drawn = Vec::new();
        for (from, to, outer) in [
            (ends[0].speed, middle, left),
            (middle, ends[1].speed, right),
        ] {
            let mut states: Vec<State> = Vec::new();
            for critical in self.critical {
                if (from..=to).contains(&critical.speed_rad_per_s) {
                    let shape = piece.basis.transpose() * &critical.shape;
                    let speed = critical.speed_rad_per_s;
                    states.extend(standing_states(&piece.reduced, speed, &shape, self.window));
                }
            }
            states.extend(inner.iter().cloned().chain(outer));
            let model = HamiltonianReduction::new(&piece.reduced, self.window, &states);
            let good = model.filter(|model| self.draws_well(piece, model, 0.5 * (from + to)));
            drawn.push((to, good));
        }
        drawn
    }

    fn draws_well(&self, piece: &Projection, model: &HamiltonianReduction, speed: f64) -> bool {
        self.counters.local_solves.fetch_add(1, Ordering::Relaxed);
        // What these states cannot draw, the piece itself does.
        model.eigenpairs(speed).is_ok_and(|pairs| {
            let error = self.frequency_error(piece, speed, self.window, &pairs);
            error <= LOCAL_TOLERANCE.get() * self.window
        })
    }
}
