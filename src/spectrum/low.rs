//! Reflected waves and what they can meet: the smallest system that has every
//! instability of an undamped guided blade.

use std::borrow::Cow;
use std::sync::atomic::Ordering;

use faer::{Col, Scale};

use crate::system::GyroscopicSystem;

use super::mode::{Mode, classify, split};
use super::model::WorkCounters;
use super::reduction::{KEPT_WHOLE, orthonormal};
use super::{SpectrumError, companion_eigenpairs};

/// A projected system with the frequency up to which its modes are complete.
#[derive(Debug, Clone)]
pub struct LowModel<'a> {
    system: Cow<'a, GyroscopicSystem>,
    height_rad_per_s: f64,
    counters: &'a WorkCounters,
}

/// Intervals wider than this share of their end are not narrowed: two ends do not
/// span what happens between them.
const NARROW: f64 = 0.04;
/// Modes up to this multiple of the height help to span those below it.
const SPAN_MARGIN: f64 = 1.2;

impl<'a> LowModel<'a> {
    pub(super) fn new(
        system: &'a GyroscopicSystem,
        height_rad_per_s: f64,
        counters: &'a WorkCounters,
    ) -> Self {
        LowModel {
            system: Cow::Borrowed(system),
            height_rad_per_s,
            counters,
        }
    }

    /// Its modes. Those above the height are there to tell what comes next, and not to
    /// be trusted to many digits.
    ///
    /// # Errors
    /// [`SpectrumError`] when the eigenproblem fails.
    pub fn modes(&self, speed_rad_per_s: f64) -> Result<Vec<Mode>, SpectrumError> {
        self.counters.reduced_solves.fetch_add(1, Ordering::Relaxed);
        let pairs = companion_eigenpairs(&self.system, speed_rad_per_s)?;
        Ok(classify(&self.system, speed_rad_per_s, 0, pairs))
    }

    /// The same for a narrow interval of speeds, on the modes at both ends: a few
    /// vectors, whose error falls with the fourth power of the width. Wide intervals
    /// come back as they are.
    ///
    /// # Errors
    /// [`SpectrumError`] when the eigenproblem fails.
    pub fn narrowed(&self, from: f64, to: f64) -> Result<Self, SpectrumError> {
        if to - from > NARROW * to {
            return Ok(self.clone());
        }
        let free = self.system.free_rigid.iter();
        let mut vectors: Vec<Col<f64>> = free.map(|z| Scale(KEPT_WHOLE) * z).collect();
        for speed in [from, to] {
            self.counters.reduced_solves.fetch_add(1, Ordering::Relaxed);
            for (lambda, q) in companion_eigenpairs(&self.system, speed)? {
                if lambda.im <= SPAN_MARGIN * self.height_rad_per_s {
                    let (re, im) = split(&q);
                    vectors.extend([re, im]);
                }
            }
        }
        let basis = orthonormal(self.system.order(), &vectors, 1e-9);
        let counters = self.counters;
        Ok(LowModel {
            system: Cow::Owned(self.system.project(basis.as_ref())),
            counters,
            height_rad_per_s: self.height_rad_per_s,
        })
    }
}
