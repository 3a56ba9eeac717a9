//! How many modes of a damped saw grow, on the full model: the argument principle.
//!
//! det L(λ) is a polynomial, and its argument turns once about every eigenvalue that a closed path goes
//! around. In the frame of the blade L is block diagonal, A_±n = B_n + μ² + ηK_b μ + c(λ ± ins Ω) with μ = λ ± inΩ,
//! plus the guides PWPᵀ, W(λ) being 1 for their springs and λ for their dampers:
//!
//! det L = det A · det(1 + W PᴴA⁻¹P).
//!
//! Divided by the eigenvalues that are listed, the determinant hardly turns at all along the path, so that few
//! places suffice; at the frequency of every listed eigenvalue there is one, for there its growth of the
//! wrong sign would show.

use faer::{Mat, c64};
use nalgebra::{DMatrix, Dyn, LU};

use super::super::argument::turn_along;
use super::coupling::{Columns, Kept};
use super::{Harmonic, UndampedFullModel};
use crate::plate::Plate;

/// The determinant of L(λ) of a damped saw.
#[derive(Debug)]
pub struct DampedFullModel {
    harmonics: Vec<Harmonic>,
    /// K_b, and what air acts on, of every harmonic.
    bending: Vec<DMatrix<f64>>,
    area: Vec<DMatrix<f64>>,
    retardation_s: f64,
    air_per_s: f64,
    air_rotation_share: f64,
    springs: Option<Columns>,
    /// τ of dampers that go with the springs, as those of one guide do: K_g + λC = (1 + τλ) K_g.
    guide_retardation_s: f64,
    /// Dampers that do not.
    dampers: Option<Columns>,
}

/// Places along each side of the path, besides those of the listed eigenvalues.
const PLACES: usize = 16;
/// Share of the window's frequency at which the path ends: at zero the block of a rigid motion is singular.
const NEXT_TO_ZERO: f64 = 1e-5;

impl DampedFullModel {
    /// Of a guided plate. `None` where forces couple all waves, or have no potential.
    pub fn new(plate: &Plate) -> Option<Self> {
        if plate.edge_stiffness.is_some() || plate.contact.nonconservative_stiffness().is_some() {
            return None;
        }
        let harmonics = UndampedFullModel::harmonics(plate);
        let columns = |matrix: Option<&Mat<f64>>| match matrix {
            Some(matrix) => Columns::new(matrix, &harmonics, Kept::All).map(Some),
            None => Some(None),
        };
        let springs = columns(plate.contact.stiffness())?;
        let retardation = proportion(plate.contact.stiffness(), plate.contact.damping());
        let dampers = match retardation {
            Some(_) => None,
            None => columns(plate.contact.damping())?,
        };
        let blocks = &plate.harmonics;
        let unit =
            |k: usize| DMatrix::identity(blocks[k].bending.nrows(), blocks[k].bending.nrows());
        let damping = plate.damping;
        Some(DampedFullModel {
            bending: blocks.iter().map(|b| b.bending.clone()).collect(),
            area: (0..blocks.len())
                .map(|k| blocks[k].area.clone().unwrap_or_else(|| unit(k)))
                .collect(),
            retardation_s: damping.map_or(0.0, |d| d.material_retardation_time_s),
            air_per_s: damping.map_or(0.0, |d| {
                d.air_n_s_per_m3 / plate.blade.mass_per_area_kg_per_m2()
            }),
            air_rotation_share: damping.map_or(0.0, |d| d.air_rotation_share),
            springs,
            guide_retardation_s: retardation.unwrap_or(0.0),
            dampers,
            harmonics,
        })
    }

    /// Eigenvalues with 0 < Re λ < `growth` and |Im λ| < `frequency`, less those among the listed
    /// ones, of which the conjugates are not listed. `None` where the path meets an eigenvalue.
    pub fn unlisted(
        &self,
        speed_rad_per_s: f64,
        listed: &[c64],
        [growth, frequency]: [f64; 2],
    ) -> Option<isize> {
        let place = |t: f64| -> c64 {
            match t {
                t if t < 1.0 => c64::new(growth, t * frequency),
                t if t < 2.0 => c64::new((2.0 - t) * growth, frequency),
                t => c64::new(0.0, (3.0 - t).max(NEXT_TO_ZERO) * frequency),
            }
        };
        let mut places: Vec<f64> = (0..=3 * PLACES).map(|k| k as f64 / PLACES as f64).collect();
        let beside = listed.iter().filter(|value| value.im < frequency);
        places.extend(beside.map(|value| 3.0 - value.im / frequency));
        places.sort_by(f64::total_cmp);
        places.dedup();
        let total = turn_along(&places, |t| self.angle(speed_rad_per_s, place(t), listed))?;
        Some((total / std::f64::consts::PI).round() as isize)
    }

    /// Argument of det L(λ) over the product of all λ − λ_k.
    fn angle(&self, speed: f64, lambda: c64, listed: &[c64]) -> Option<f64> {
        let factors = listed.iter().flat_map(|value| {
            let conjugate = (value.im != 0.0).then(|| value.conj());
            [Some(*value), conjugate].into_iter().flatten()
        });
        let known: f64 = factors.map(|value| (lambda - value).arg()).sum();
        Some(self.determinant_angle(speed, lambda)? - known)
    }

    fn determinant_angle(&self, speed: f64, lambda: c64) -> Option<f64> {
        let eliminated = self.eliminated(speed, lambda)?;
        let blocks = eliminated.blocks.iter();
        let mut angle: f64 = blocks.map(|block| block.determinant().arg()).sum();
        let factors = eliminated.core.partial_piv_lu();
        let swaps = factors.P().arrays().0;
        angle += if is_odd(swaps) {
            std::f64::consts::PI
        } else {
            0.0
        };
        let upper = factors.U();
        angle += (0..upper.nrows()).map(|i| upper[(i, i)].arg()).sum::<f64>();
        angle.is_finite().then_some(angle)
    }

    /// L(λ) with its blocks factored. `None` where one is singular.
    pub(super) fn eliminated(&self, speed: f64, lambda: c64) -> Option<Eliminated> {
        let parts = self.parts(lambda);
        let count: usize = parts
            .iter()
            .map(|(columns, _)| columns.cosine.ncols())
            .sum();
        let rows: usize = self
            .harmonics
            .iter()
            .map(|h| h.radial() * h.signs().count())
            .sum();
        let mut adjoint = Mat::<c64>::zeros(count, rows);
        let mut solved_columns = Mat::<c64>::zeros(rows, count);
        let mut blocks = Vec::new();
        let (mut own, mut wave) = (0, 0);
        for (k, harmonic) in self.harmonics.iter().enumerate() {
            let radial = harmonic.radial();
            for sign in harmonic.signs() {
                let turned = [1.0, -1.0][sign];
                let n = turned * harmonic.diameters as f64;
                let factors = self.block(k, speed, lambda, n).lu();
                let p = DMatrix::from_fn(radial, count, |j, column| {
                    let (cosine, sine) = entry(&parts, own + j, column);
                    c64::new(cosine, -turned * sine)
                });
                let solved = factors.solve(&p)?;
                for column in 0..count {
                    for j in 0..radial {
                        adjoint[(column, wave + j)] = p[(j, column)].conj();
                        solved_columns[(wave + j, column)] = solved[(j, column)];
                    }
                }
                blocks.push(factors);
                wave += radial;
            }
            own += radial;
        }
        let mut core = &adjoint * &solved_columns;
        weigh(&parts, &mut core);
        (0..count).for_each(|i| core[(i, i)] += 1.0);
        Some(Eliminated {
            blocks,
            adjoint,
            solved_columns,
            core,
        })
    }

    /// The columns of springs and of dampers, each with its W(λ).
    pub(super) fn parts(&self, lambda: c64) -> Vec<(&Columns, c64)> {
        let spring = self
            .springs
            .iter()
            .map(|columns| (columns, lambda * self.guide_retardation_s + 1.0));
        let damper = self.dampers.iter().map(|columns| (columns, lambda));
        spring.chain(damper).collect()
    }

    /// The harmonics.
    pub(super) fn harmonics(&self) -> impl Iterator<Item = &Harmonic> {
        self.harmonics.iter()
    }

    /// B_n + μ² + ηK_b μ + c(λ + insΩ), μ = λ + inΩ.
    fn block(&self, k: usize, speed: f64, lambda: c64, n: f64) -> DMatrix<c64> {
        let harmonic = &self.harmonics[k];
        let turned = lambda + c64::new(0.0, n * speed);
        let material = turned * self.retardation_s;
        let air_turns = c64::new(0.0, n * speed * self.air_rotation_share);
        let air = (lambda + air_turns) * self.air_per_s;
        DMatrix::from_fn(harmonic.radial(), harmonic.radial(), |i, j| {
            let stiffness = harmonic.rest[(i, j)] + speed * speed * harmonic.tension[(i, j)];
            let unit = if i == j {
                turned * turned
            } else {
                c64::new(0.0, 0.0)
            };
            unit + stiffness + material * self.bending[k][(i, j)] + air * self.area[k][(i, j)]
        })
    }
}

/// L(λ) = A + PWPᴴ in waves, with A factored.
pub(super) struct Eliminated {
    /// The blocks of A.
    pub blocks: Vec<LU<c64, Dyn, Dyn>>,
    /// Pᴴ.
    pub adjoint: Mat<c64>,
    /// A⁻¹P.
    pub solved_columns: Mat<c64>,
    /// 1 + W PᴴA⁻¹P.
    pub core: Mat<c64>,
}

/// W times the rows of a matrix.
pub(super) fn weigh(parts: &[(&Columns, c64)], matrix: &mut Mat<c64>) {
    let mut row = 0;
    for (columns, weight) in parts {
        for i in row..row + columns.cosine.ncols() {
            for k in 0..matrix.ncols() {
                matrix[(i, k)] *= weight;
            }
        }
        row += columns.cosine.ncols();
    }
}

/// τ where C = τK.
fn proportion(stiffness: Option<&Mat<f64>>, damping: Option<&Mat<f64>>) -> Option<f64> {
    const ROUNDING: f64 = 1e-12;
    let (stiffness, damping) = stiffness.zip(damping)?;
    let share = damping.norm_l2() / stiffness.norm_l2();
    let differs = (damping - faer::Scale(share) * stiffness).norm_l2();
    (differs <= ROUNDING * damping.norm_l2()).then_some(share)
}

/// Rows of cosines and sines of a column of several parts.
fn entry(parts: &[(&Columns, c64)], row: usize, column: usize) -> (f64, f64) {
    let mut column = column;
    for (columns, _) in parts {
        let count = columns.cosine.ncols();
        if column < count {
            return (columns.cosine[(row, column)], columns.sine[(row, column)]);
        }
        column -= count;
    }
    (0.0, 0.0)
}

/// Whether a permutation takes an odd number of swaps.
fn is_odd(permutation: &[usize]) -> bool {
    let mut seen = vec![false; permutation.len()];
    let mut odd = false;
    for start in 0..permutation.len() {
        let mut at = start;
        let mut length = 0;
        while !seen[at] {
            seen[at] = true;
            at = permutation[at];
            length += 1;
        }
        odd ^= length > 0 && length % 2 == 0;
    }
    odd
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plate::Resolution;
    use crate::scene::{DampingFile, Scene, rad_per_s};
    use crate::spectrum::companion_eigenpairs;
    use crate::system::GyroscopicSystem;

    /// On guides with the same ratio of damping to stiffness, or with two.
    fn damped(guides: usize) -> Plate {
        let scene = Scene::paper().edited(|saw| {
            saw.guides = vec![saw.guides[0]; guides];
            saw.guides[0].damping_n_s_per_m = 3.0;
            saw.guides[0].angle_deg += 70.0;
            // Two pads take more columns than the share of a small basis that is allowed.
            for guide in saw.guides.iter_mut().filter(|_| guides > 1) {
                (guide.radial_length_m, guide.tangential_length_m) = (0.0, 0.0);
            }
            saw.damping = Some(DampingFile {
                material_retardation_time_s: 1e-6,
                air_n_s_per_m3: 0.5,
                air_rotation_share: 0.3,
            });
        });
        let resolution = Resolution {
            max_diameters: 8,
            radial_functions: 5,
        };
        Plate::new(&scene.unwrap(), resolution)
    }

    /// Of dense eigenvalues, none are unlisted; what is taken off the list, added to it or given
    /// growth of the wrong sign, is.
    #[test]
    fn eigenvalues_that_a_list_lacks_or_invents_are_counted() {
        let plate = damped(1);
        let (basis, system) = (
            DampedFullModel::new(&plate).unwrap(),
            GyroscopicSystem::of_plate(&plate),
        );
        let mut growing = 0;
        for rpm in [800.0, 1540.0, 1700.0, 2110.0, 2262.0, 2600.0, 2900.0] {
            let speed = rad_per_s(rpm);
            let all = companion_eigenpairs(&system, speed).unwrap();
            let mut values: Vec<c64> = all.iter().map(|(lambda, _)| *lambda).collect();
            values.retain(|value| value.im < 700.0);
            let window = [300.0, 500.0];
            let unlisted = |listed: &[c64]| basis.unlisted(speed, listed, window).unwrap();
            assert_eq!(unlisted(&values), 0, "{rpm}");
            for k in 0..values.len().min(8) {
                let value = values[k];
                if value.im > window[1] {
                    continue;
                }
                let weight = if value.im == 0.0 { 1 } else { 2 };
                let grows = isize::from(value.re > 0.0) * weight;
                growing += grows;
                let mut fewer = values.clone();
                fewer.remove(k);
                assert_eq!(unlisted(&fewer), grows, "{rpm} without {value}");
                let mut wrong = values.clone();
                wrong[k] = c64::new(-value.re, value.im);
                assert_eq!(unlisted(&wrong), 2 * grows - weight, "{rpm} wrong {value}");
            }
        }
        assert!(growing > 4, "{growing}");
    }

    /// Against one factorization of the whole matrix.
    #[test]
    fn the_angle_is_that_of_the_whole_determinant() {
        for guides in [1, 2] {
            let plate = damped(guides);
            assert_eq!(
                DampedFullModel::new(&plate).unwrap().dampers.is_some(),
                guides == 2
            );
            angle_is_right(&plate);
        }
    }

    fn angle_is_right(plate: &Plate) {
        let (basis, system) = (
            DampedFullModel::new(plate).unwrap(),
            GyroscopicSystem::of_plate(plate),
        );
        let speed = rad_per_s(2000.0);
        let (stiffness, velocity) = (system.stiffness_at(speed), system.velocity_at(speed));
        for lambda in [
            c64::new(3.0, 70.0),
            c64::new(0.0, 200.0),
            c64::new(50.0, 0.0),
            c64::new(-1.0, 900.0),
        ] {
            let order = system.order();
            let matrix = DMatrix::from_fn(order, order, |i, k| {
                let unit = if i == k {
                    lambda * lambda
                } else {
                    c64::new(0.0, 0.0)
                };
                unit + lambda * velocity[(i, k)] + stiffness[(i, k)]
            });
            // Scaled so that the product of the pivots stays finite.
            let factors = (matrix * c64::new(1e-8, 0.0)).lu();
            let exact = (factors.u().diagonal().iter().map(|u| u.arg()).sum::<f64>()
                + factors.p().determinant::<f64>().acos())
                - basis.determinant_angle(speed, lambda).unwrap();
            let turns = exact / std::f64::consts::TAU;
            assert!((turns - turns.round()).abs() < 1e-5, "{lambda}: {turns}");
        }
    }

    #[test]
    fn the_parity_of_a_permutation() {
        assert!(!is_odd(&[0, 1, 2]) && is_odd(&[1, 0, 2]) && !is_odd(&[1, 2, 0]));
    }
}
