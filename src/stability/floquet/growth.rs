//! The largest growth of a guided, slotted blade at a speed, and its error.

use super::super::listed_band::FELT;
use super::error::NotComputed;
use super::guided::GuidedBlade;
use super::pitch::Pitch;
use crate::model::linalg::real_eigenvalues;
use crate::model::plate::TurningModes;
use crate::model::scene::rpm;

/// Number of coordinates of the blade, and of those left when its error is estimated.
const COORDINATES: usize = 48;
const FEWER: usize = 32;
/// Error by all coordinates left out, relative to the change by a third of them: the compliance of the blade at a point that n coordinates
/// leave out falls as 1/n, which makes 2. Beside a point with a damper, whose growth converges slowest, errors of up to 2.5 were found
/// against eigenvalues of a blade without slots.
const TAIL: f64 = 3.0;
/// Largest angle ωh of the highest mode in a step, before steps are halved for the result and its error.
const STEP_RAD: f64 = 0.3;
/// Least and most numbers of steps in a pitch, before they are halved.
const STEPS: [f64; 2] = [64.0, 4000.0];

/// Largest growth at a speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FloquetGrowth {
    /// Speed.
    pub speed_rad_per_s: f64,
    /// ln|μ|/T of the largest multiplier μ over a pitch of the time T; negative if every motion decays.
    pub growth_per_s: f64,
    /// Its change when the steps are halved, plus three times that with a third of the coordinates left out.
    pub error_per_s: f64,
    /// Number of coordinates of the blade.
    pub coordinates: usize,
    /// Number of steps in a pitch.
    pub steps: usize,
}

impl FloquetGrowth {
    /// Whether the growth is felt, although it may be slower than a threshold.
    pub(crate) fn is_felt(&self, threshold_per_s: f64) -> bool {
        self.growth_per_s >= FELT * threshold_per_s
    }
}

impl GuidedBlade<'_> {
    /// The largest growth at a speed.
    ///
    /// # Errors
    /// [`NotComputed`].
    pub fn growth(&self, speed_rad_per_s: f64) -> Result<FloquetGrowth, NotComputed> {
        let modes = |most| {
            let found = self.modes(speed_rad_per_s, most);
            found.ok_or(NotComputed::NotFinite)
        };
        let all = modes(COORDINATES)?;
        let steps = self.steps(&all, speed_rad_per_s)?;
        let by = |modes: &TurningModes<'_>, steps| {
            let pitch = Pitch::new(self, modes, speed_rad_per_s, steps);
            let growth = largest(&pitch).filter(|growth| growth.is_finite());
            growth.ok_or(NotComputed::NotFinite)
        };
        let [coarse, fine] = [by(&all, steps)?, by(&all, 2 * steps)?];
        let few = by(&modes(FEWER)?, steps)?;
        Ok(FloquetGrowth {
            speed_rad_per_s,
            growth_per_s: fine,
            error_per_s: (fine - coarse).abs() + TAIL * (coarse - few).abs(),
            coordinates: all.coordinates(),
            steps: 2 * steps,
        })
    }

    fn steps(&self, modes: &TurningModes<'_>, speed: f64) -> Result<usize, NotComputed> {
        let highest = modes.modes.last().map_or(0.0, |mode| mode.square);
        let turns = highest.max(0.0).sqrt() * self.blade.pitch_rad();
        let needed = (turns / speed / STEP_RAD).ceil();
        let [least, most] = STEPS;
        if needed.is_nan() || needed > most {
            return Err(NotComputed::Slow {
                rpm: rpm(speed),
                least_rpm: rpm(turns / STEP_RAD / most),
            });
        }
        Ok(needed.max(least) as usize)
    }
}

fn largest(pitch: &Pitch<'_>) -> Option<f64> {
    let multipliers = real_eigenvalues(pitch.monodromy().as_ref()).ok()?;
    let sizes = multipliers.iter().map(|mu| mu.norm().ln() / pitch.time_s());
    sizes.reduce(f64::max)
}
