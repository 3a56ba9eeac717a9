//! Faults that tests introduce into the projections, for the certificate to detect.

use std::sync::Arc;

use faer::{Col, Mat};

use super::super::vectors::{orthonormal, split};
use super::*;

/// Vectors closer than this to the span of the others are omitted.
const SPAN_TOLERANCE: f64 = 1e-6;
/// Modes up to this multiple of the height are included, as in the correct projection.
const MARGIN: f64 = 1.5;
/// Number of standing waves that a projection on few speeds still contains.
const STANDING: usize = 12;

impl SpectralModel {
    /// Removes the oscillation at a `place` in the order of frequency, at a speed, from the projections.
    pub(crate) fn lose_wave(&mut self, speed_rad_per_s: f64, place: usize) {
        let modes = self.full_modes(speed_rad_per_s).unwrap();
        let mut waves = modes.iter().filter(|m| m.kind == ModeKind::Positive);
        let (re, im) = split(&waves.nth(place).unwrap().coordinates);
        self.project_again(|basis, _| {
            let parts = [&re, &im].map(|part| basis.transpose() * part);
            let lost = orthonormal(basis.ncols(), &parts, SPAN_TOLERANCE);
            let whole = lost.qr().compute_Q();
            let kept = whole.subcols(lost.ncols(), basis.ncols() - lost.ncols());
            basis * kept
        });
    }

    /// Replaces the projections by ones on the modes at few speeds.
    pub(crate) fn keep_modes_of(&mut self, speeds_rad_per_s: &[f64]) {
        let standing = self.critical.iter().take(STANDING);
        let vectors: Vec<Col<f64>> = standing.map(|c| c.shape.clone()).collect();
        let modes: Vec<Mode> = speeds_rad_per_s
            .iter()
            .flat_map(|speed| self.full_modes(*speed).unwrap())
            .collect();
        self.project_again(|basis, height_rad_per_s| {
            let mut vectors = vectors.clone();
            let low = modes
                .iter()
                .filter(|mode| mode.lambda.norm() <= MARGIN * height_rad_per_s);
            for mode in low {
                let (re, im) = split(&mode.coordinates);
                vectors.extend([re, im]);
            }
            orthonormal(basis.nrows(), &vectors, SPAN_TOLERANCE)
        });
    }

    /// Replaces each projection by one on another basis, which a function gives for the old basis and the height
    /// of the search.
    fn project_again(&mut self, mut basis: impl FnMut(&Mat<f64>, f64) -> Mat<f64>) {
        let height_rad_per_s = self.reflected_to_rad_per_s;
        let component = &mut self.components[0];
        let Solution::Projected(intervals) = &mut component.solution else {
            panic!("no projection");
        };
        for interval in intervals {
            let basis = basis(&interval.projection.basis, height_rad_per_s);
            interval.projection = Arc::new(Projection::new(&component.full, None, basis));
            (interval.drawn, interval.searched) = (None, None);
        }
    }
}
