//! Errors of eigenproblems.

use crate::model::linalg::LinalgError;
use crate::model::scene::{SpeedRange, rpm};
use crate::page::text::shown;

/// Reason for which a spectrum could not be computed.
#[derive(Debug, thiserror::Error)]
pub enum SpectrumError {
    /// A decomposition failed.
    #[error("{error} at {rpm} rpm")]
    Decomposition {
        /// Rotation speed.
        rpm: f64,
        /// Decomposition, order and error.
        #[source]
        error: LinalgError,
    },
    /// An iteration did not converge.
    #[error("the eigenvalues of order {order} did not converge at {rpm} rpm")]
    NoConvergence {
        /// Order of the matrix.
        order: usize,
        /// Rotation speed.
        rpm: f64,
    },
    /// The stiffness at rest is not positive definite: critical speeds of a blade that is unstable at rest are
    /// not defined.
    #[error(
        "the blade is not stable at rest: its stiffness of order {order} is not positive definite; use stiffer guides, or smaller cutting forces if the chart includes them (cut.chart_rpm)"
    )]
    UnstableAtRest {
        /// Order of the stiffness matrix.
        order: usize,
    },
    /// The blade buckles under heat, roll tension or residual stress.
    #[error(
        "the blade buckles at rest, in {diameters} nodal diameters: it buckles at {share:.3} of the stress of `membrane`; lower the temperature or the residual stress there, change the roll tension (a hot rim and roll tension counteract each other), or use stiffer guides"
    )]
    Buckled {
        /// Nodal diameters of the buckling shape.
        diameters: usize,
        /// Share of the scene's membrane stress at which it buckles.
        share: f64,
    },
    /// The numbers of the scene differ so much in size that their products overflow.
    #[error(
        "the matrices of order {order} are not finite at {rpm} rpm; the numbers of the scene differ by too many orders of magnitude"
    )]
    NotFinite {
        /// Order of the matrix.
        order: usize,
        /// Rotation speed.
        rpm: f64,
    },
    /// The reduced model ends before the speed.
    #[error(
        "the reduced model of the saw has no modes at {} rpm: it reaches from {} to {} rpm; let `sweep` include the speed",
        shown(*rpm), shown(range_rpm[0]), shown(range_rpm[1])
    )]
    BesideModel {
        /// Rotation speed.
        rpm: f64,
        /// First and last speed of the model.
        range_rpm: [f64; 2],
    },
    /// The computation was cancelled, see [`Cancellation`](super::Cancellation).
    #[error("the computation was cancelled")]
    Cancelled,
}

impl SpectrumError {
    /// The error of a decomposition at a speed.
    pub(crate) fn at(speed_rad_per_s: f64) -> impl Fn(LinalgError) -> Self {
        let rpm = rpm(speed_rad_per_s);
        move |error| match error {
            LinalgError::NotFinite { order } => SpectrumError::NotFinite { order, rpm },
            error => SpectrumError::Decomposition { rpm, error },
        }
    }

    pub(super) fn beside_model(speed_rad_per_s: f64, range: SpeedRange) -> Self {
        SpectrumError::BesideModel {
            rpm: rpm(speed_rad_per_s),
            range_rpm: range.ends().map(rpm),
        }
    }

    pub(super) fn no_convergence(order: usize, speed_rad_per_s: f64) -> Self {
        SpectrumError::NoConvergence {
            order,
            rpm: rpm(speed_rad_per_s),
        }
    }

    pub(super) fn not_finite(order: usize, speed_rad_per_s: f64) -> Self {
        SpectrumError::NotFinite {
            order,
            rpm: rpm(speed_rad_per_s),
        }
    }
}
