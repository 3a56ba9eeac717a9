//! Estimated errors of the frequencies of a reduced model.

use faer::{Col, c64};

use super::Builder;
use crate::modes::projection::Projection;
use crate::modes::residual::Lifted;
use crate::modes::vectors::{Eigenpair, quadratic_form};

/// Smallest slope, relative to the height, that the estimate of a frequency's error uses.
const LEAST_SLOPE: f64 = 0.02;

impl Builder<'_> {
    /// Largest estimated error of a frequency among the modes below the window. With the residual r on the
    /// full model, rᴴP⁻¹r is the amount by which the omitted functions reduce qᴴL(ω)q; P, the diagonal of K₀,
    /// approximates L, because r consists of high functions, which stiffness dominates. [`frequency_shift`]
    /// gives the change of frequency. The error is in rad/s.
    pub(super) fn frequency_error(
        &self,
        projection: &Projection,
        speed: f64,
        height: f64,
        pairs: &[Eigenpair],
    ) -> f64 {
        let low: Vec<(c64, &Col<c64>)> = pairs
            .iter()
            .filter(|(lambda, _)| lambda.im <= height && lambda.re >= -1e-6 * height)
            .map(|(lambda, q)| (*lambda, q))
            .collect();
        let stiffness = &self.guided.system.stiffness;
        let lifted = projection.lifted(speed, &low);
        let errors = low.iter().zip(&lifted).map(|((lambda, q), lifted)| {
            let Lifted { residual, .. } = lifted;
            let shift: f64 = (0..residual.nrows())
                .map(|i| residual[i].norm_sqr() / (stiffness[(i, i)] + height.powi(2)))
                .sum();
            let gamma = quadratic_form(q, &projection.reduced.gyroscopic).im;
            let slope = 2.0 * (lambda.im + speed * gamma).abs();
            frequency_shift(shift, slope.max(2.0 * lambda.norm()), height)
        });
        errors.fold(0.0, f64::max)
    }
}

/// Change of a frequency ω for which qᴴL(ω)q changes by `shift`, in 1/s², and has the slope |qᴴ(2ω − 2iΩG)q|,
/// which is 2ω at rest. Where two modes are about to coalesce the slope vanishes, and where a wave stands
/// still ω does too: there the square of the frequency, not the frequency, depends smoothly on the shift, and
/// a slope of at least a share of the height is used. A slope above the height is replaced by the height,
/// because onsets of weak bands need more accuracy than their frequencies.
fn frequency_shift(shift: f64, slope_per_s: f64, height_rad_per_s: f64) -> f64 {
    shift / slope_per_s.clamp(LEAST_SLOPE * height_rad_per_s, height_rad_per_s)
}

#[cfg(test)]
mod tests {
    use super::super::Guided;
    use super::*;
    use crate::model::plate::{Plate, Resolution};
    use crate::model::scene::{Scene, SpeedRange, rad_per_s};
    use crate::model::system::GyroscopicSystem;
    use crate::modes::interval::KnownModes;
    use crate::modes::{WorkCounters, companion_eigenpairs, frequency_scale};

    /// The estimate on too small a basis is compared with the frequencies on the full basis, including that
    /// of the lowest mode of the paper's saw at rest, which is a tenth of the window.
    #[test]
    fn the_error_of_low_frequencies_is_not_estimated_too_small() {
        let resolution = Resolution {
            max_diameters: 8,
            radial_functions: 5,
        };
        let plate = Plate::new(&Scene::paper(), resolution);
        let system = GyroscopicSystem::of_plate(&plate);
        let counters = WorkCounters::default();
        let scale = frequency_scale(&plate);
        let range = SpeedRange::between_rpm(0.0, 1200.0);
        let guided = Guided {
            system: &system,
            structure: None,
            scale,
            critical: &[],
        };
        let mut builder = Builder::new(guided, range, &counters);
        let (height, _) = builder.chart_height(0.0).unwrap();
        builder.window = height;
        let snapshots = [400.0, 1200.0].map(|rpm| builder.snapshot(rad_per_s(rpm)).unwrap());
        builder.snapshots = snapshots.to_vec();
        let basis = builder.basis(snapshots.each_ref());
        let projection = Projection::new(&system, None, basis);
        let mut estimated = 0;
        for speed in [1e-6, 700.0].map(rad_per_s) {
            let exact = companion_eigenpairs(&system, speed).unwrap();
            let found = KnownModes::of(&projection, speed, &counters).unwrap().pairs;
            for ((found, q), (exact, _)) in found.into_iter().zip(exact).take(8) {
                let error = (found - exact).norm();
                let estimate = builder.frequency_error(&projection, speed, height, &[(found, q)]);
                // Smaller errors are rounding of the dense solver that gives the reference.
                if error > 1e-8 {
                    estimated += 1;
                    assert!(
                        error <= 2.0 * estimate && estimate <= 50.0 * error,
                        "{exact}"
                    );
                }
            }
        }
        assert!(estimated >= 8, "nothing to estimate");
    }
}
