//! The light gap under a straight edge across a blade that lies on two points.
//!
//! The blade off its machine is free in bending. Two points carry its weight W in equal parts, so that the reactions are
//! known, and the weight itself does work only on the rigid heave: the basis is orthonormal with the mass, and a
//! constant acceleration is a multiple of the heave. With the coordinates q of cos nθ, n even by symmetry, and the values
//! φ(r) of its functions,
//!
//! (K_b + s K_m) q = W φ(r_s), gap = Σ (φ(r_e) − φ(r_m)) · q cos(nπ/2),
//!
//! where K_m is the geometric stiffness of the rolled bands, s the factor of their strain, and r_s, r_e and r_m the radii of
//! the supports, of the ends of the straight edge and of its middle, which is the bore. Tension of the rim stiffens the
//! saddle of two nodal diameters, by which the ends of the straight edge sag; compression between band and rim softens
//! the dish. Both raise the gap. The theory requires deflections that are small in comparison with the thickness.

use nalgebra::{DMatrix, DVector};

use super::Resolution;
use super::harmonic::HarmonicBlock;
use super::membrane::{MembraneStress, membrane_stiffness};
use super::radial::RadialBasis;
use super::stress::CentrifugalStress;
use crate::model::linalg::{LinalgError, symmetric_eigenvalues, view};
use crate::model::scene::{GRAVITY_M_PER_S2, Membrane, RefusedValue, RollBand, StraightEdge};
use crate::page::text::shown_to;

/// Largest number of nodal diameters and number of radial functions. The terms of the gap alternate and fall with the third
/// power of the number of diameters: 20 leave an error of 5e-4 of the gap, 60 an error of 2e-5. The stress has kinks at the
/// bands, so that 16 functions leave an error of 6e-4 at seven tenths of buckling, which falls with the fifth power of their
/// number.
const RESOLUTION: Resolution = Resolution {
    max_diameters: 60,
    radial_functions: 28,
};
/// Largest roll tension, relative to that at which the blade buckles, that may explain a measured gap. The deflection is
/// inversely proportional to the distance from buckling, and is no longer small beyond this limit.
const BEFORE_BUCKLING: f64 = 0.9;
/// Number of bisections, which reduces the interval to rounding.
const HALVINGS: usize = 60;

/// Light gap and sag of a blade that lies on two points.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct LightGap {
    /// Light gap in the middle of the straight edge; negative if the blade touches there.
    pub gap_m: f64,
    /// Depth of the middle below the points.
    pub sag_m: f64,
}

/// Reason for which the readings of the straight edge could not be computed.
#[derive(Debug, thiserror::Error)]
pub enum LightGapError {
    /// No factor of the roll tension gives the measured gap.
    #[error(transparent)]
    Measured(#[from] RefusedValue),
    /// The buckling of some number of nodal diameters could not be computed.
    #[error(transparent)]
    Buckling(#[from] LinalgError),
}

/// Computed readings of the straight edge of a scene.
#[derive(Debug, Clone, PartialEq)]
pub struct StraightEdgeReading {
    /// The gap of the rolled blade; `None` if it is buckled.
    pub rolled: Option<LightGap>,
    /// The gap of the blade without roll tension.
    pub plain: LightGap,
    /// Factor of the roll tension at which the blade buckles off its machine.
    pub buckling_factor: Option<f64>,
    /// Factor of the roll tension at which the gap is the measured one, and the computed gap there; `None` without a
    /// measurement.
    pub measured: Option<(f64, LightGap)>,
}

impl StraightEdgeReading {
    /// Computes the readings of a blade with rolled bands.
    ///
    /// # Errors
    /// [`LightGapError`].
    pub(crate) fn new(edge: &StraightEdge, bands: &[RollBand]) -> Result<Self, LightGapError> {
        let lying = LyingBlade::new(edge, bands, RESOLUTION);
        let buckling_factor = lying.buckling_factor()?;
        let flat = |factor| {
            lying
                .at(factor)
                .filter(|_| buckling_factor.is_none_or(|b| factor < b))
        };
        let measured = edge
            .measured_gap_m
            .map(|gap_m| {
                let last = buckling_factor.map_or(1.0, |factor| BEFORE_BUCKLING * factor);
                lying.factor_of(gap_m, last)
            })
            .transpose()?;
        Ok(StraightEdgeReading {
            rolled: flat(1.0),
            plain: lying.at(0.0).unwrap_or_default(),
            buckling_factor,
            measured: measured.and_then(|factor| Some((factor, lying.at(factor)?))),
        })
    }
}

/// Equations of a blade on two points, one entry for each number n of nodal diameters.
struct LyingBlade {
    waves: Vec<Wave>,
}

/// Equations of n nodal diameters, on the functions other than the rigid heave and tilt.
struct Wave {
    bending: DMatrix<f64>,
    /// Stiffness K_m of the bands at the factor one.
    rolled: DMatrix<f64>,
    /// Load W φ(r_s), zero for odd n.
    load: DVector<f64>,
    /// Vector whose product with q is the gap of these waves.
    gap: DVector<f64>,
    /// Vector whose product with q is the sag of these waves.
    sag: DVector<f64>,
}

impl LyingBlade {
    fn new(edge: &StraightEdge, bands: &[RollBand], resolution: Resolution) -> Self {
        let most = resolution.max_diameters;
        let blade = &edge.blade;
        let basis = RadialBasis::new(blade, resolution.radial_functions);
        let centrifugal = CentrifugalStress::new(blade);
        let stress = MembraneStress::new(blade, &Membrane::of_bands(bands));
        let stiffness = stress.map(|stress| membrane_stiffness(&basis, &stress, 0..=most));
        let weight_n = GRAVITY_M_PER_S2 * blade.mass_kg();
        let wave = |n: usize| {
            // The first function of n = 0 is the rigid heave, that of n = 1 the rigid tilt.
            let rigid = usize::from(n <= 1);
            let elastic = |matrix: &DMatrix<f64>| {
                let size = matrix.nrows() - rigid;
                matrix.view((rigid, rigid), (size, size)).into_owned()
            };
            let two = if n == 0 { 2.0 } else { 1.0 };
            let norm = (two * std::f64::consts::PI * blade.mass_per_area_kg_per_m2()).sqrt();
            let at = |r: f64| {
                let values = basis.evaluate(n, r).value;
                DVector::from_iterator(values.len() - rigid, values.into_iter().skip(rigid)) / norm
            };
            let across: f64 = match n % 4 {
                0 => 1.0,
                2 => -1.0,
                _ => 0.0,
            };
            let even = across.abs();
            let support = at(edge.support_radius_m);
            let middle = across * at(blade.inner_radius_m);
            let bending = elastic(&HarmonicBlock::new(blade, &centrifugal, &basis, n).bending);
            Wave {
                rolled: match &stiffness {
                    Some(blocks) => elastic(&blocks[n]),
                    None => DMatrix::zeros(bending.nrows(), bending.ncols()),
                },
                bending,
                gap: across * at(edge.end_radius_m) - &middle,
                sag: even * &support - middle,
                load: even * weight_n * support,
            }
        };
        LyingBlade {
            waves: (0..=most).map(wave).collect(),
        }
    }

    /// Gap and sag at a factor of the roll tension; `None` if the blade is buckled.
    fn at(&self, factor: f64) -> Option<LightGap> {
        let mut sum = LightGap::default();
        for wave in self.waves.iter().step_by(2) {
            let stiffness = &wave.bending + factor * &wave.rolled;
            let q = stiffness.cholesky()?.solve(&wave.load);
            sum.gap_m += wave.gap.dot(&q);
            sum.sag_m += wave.sag.dot(&q);
        }
        Some(sum)
    }

    /// Smallest positive factor at which K_b + s K_m is singular.
    fn buckling_factor(&self) -> Result<Option<f64>, LinalgError> {
        let mut largest: f64 = 0.0;
        for wave in &self.waves {
            let indefinite = || LinalgError::NoConvergence {
                values: "Cholesky factors of the bending stiffness",
                order: wave.bending.nrows(),
            };
            let relative_to = |lower: DMatrix<f64>| {
                let half = lower.solve_lower_triangular(&wave.rolled)?;
                lower.solve_lower_triangular(&half.transpose())
            };
            let factors = wave.bending.clone().cholesky();
            let relative = factors.and_then(|found| relative_to(found.unpack()));
            let squares = symmetric_eigenvalues(view(&relative.ok_or_else(indefinite)?))?;
            largest = squares.first().map_or(largest, |least| largest.max(-least));
        }
        Ok((largest > 0.0).then(|| 1.0 / largest))
    }

    /// The factor, from 0 to `last`, at which the blade has a given gap.
    fn factor_of(&self, gap_m: f64, last: f64) -> Result<f64, RefusedValue> {
        let gap_at = |factor: f64| self.at(factor).map_or(f64::NAN, |found| found.gap_m);
        let (none, most) = (gap_at(0.0), gap_at(last));
        if !((none.min(most)..=none.max(most)).contains(&gap_m)) {
            let [low, high] = [none.min(most), none.max(most)].map(|gap| shown_to(3, gap));
            let allowed = format!(
                "between {low} and {high}, from the blade without roll tension to nine tenths of its buckling"
            );
            let remedy = "check sign, supports and the radii of the bands; light under the middle is positive";
            let key = "membrane.straight_edge.measured_gap_m";
            return Err(RefusedValue::new(key, gap_m, allowed, remedy));
        }
        let (mut low, mut high) = (0.0, last);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if (gap_at(middle) < gap_m) == (none < most) {
                low = middle
            } else {
                high = middle
            }
        }
        Ok(0.5 * (low + high))
    }
}

#[cfg(test)]
mod tests;
