//! Waves of a slotted ring at rest against those of the plain ring on the same circles.
//!
//! Modes of the slotted ring mix waves of n, N ± n … diameters and of one more circle. With the share p_k of the plain wave in the
//! mode k, the square of its product with the mode by the mass, the square of the frequency of the wave is the mean Σ p_k⁸ω_k²/Σ p_k⁸:
//! that of the mode if one has nearly all of the wave, and without a jump where two modes exchange it.

use faer::linalg::triangular_solve::{
    solve_lower_triangular_in_place, solve_upper_triangular_in_place,
};
use faer::{Mat, Par, Side};

use super::chain::{Chain, Place};
use super::elements::{Around, Bending, hermite, specific_rigidity};
use super::krylov::krylov;
use super::mesh::Mesh;
use super::symmetry::{Class, Held, OF_NODE, Part, Unknowns};
use crate::model::linalg::SymmetricEigen;
use crate::model::scene::Blade;

/// Waves of a number of diameters and circles that the modes are composed of at first, and of how many diameters more than wanted.
const CIRCLES: usize = 2;
const MORE: usize = 6;
/// Power of the shares in the mean. With four slots of 70 mm in a ring of 150 mm, where a mode has 0.77 of the wave of n = 5, the fourth
/// power leaves an error of 1.3e-3 of its frequency.
const SHARPNESS: i32 = 8;
/// A ring with its elements.
pub struct Slotted<'a> {
    mesh: &'a Mesh,
    pub held: Held,
    count: usize,
    rows: Vec<Bending>,
    around: Vec<Around<4>>,
    /// Shift σ of the stiffness, in 1/s²: a free ring has rigid motions.
    pub shift: f64,
}

/// A plain wave: its ω² and the deflection and slope over the radius at the edges of the elements.
pub struct PlainWave {
    pub diameters: usize,
    pub square: f64,
    shape: Vec<f64>,
}

/// ω² of a wave over that of the plain wave, and the largest share that a mode has of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Branch {
    /// c_n.
    pub bending: f64,
    /// Largest share p_k of the plain wave in a mode.
    pub share: f64,
}

impl<'a> Slotted<'a> {
    /// The elements of a ring with `count` slots.
    pub fn new(blade: &Blade, mesh: &'a Mesh, count: u32) -> Self {
        let held = Held::of(blade);
        let edges = mesh.radii_m.windows(2).enumerate();
        Slotted {
            mesh,
            held,
            count: count as usize,
            rows: edges
                .map(|(i, pair)| Bending::new(blade, [pair[0], pair[1]], i == 0))
                .collect(),
            around: (mesh.angles_rad.windows(2))
                .map(|pair| Around::new(pair[1] - pair[0], hermite))
                .collect(),
            // The lowest wave that bends a free ring has 25 times as much, or more.
            shift: specific_rigidity(blade) / mesh.radii_m[mesh.radii_m.len() - 1].powi(4),
        }
    }

    /// The lowest waves of the plain ring on n diameters that bend it, one for each number of circles.
    fn plain(&self, n: usize) -> Vec<PlainWave> {
        let is_rigid = self.held == Held::Nothing && n < 2;
        let rigid = usize::from(is_rigid);
        let all = self.lowest(n, rigid + CIRCLES).into_iter();
        all.skip(rigid).collect()
    }

    /// So many lowest waves of the plain ring on n diameters, with those of a free ring that do not bend it.
    pub fn lowest(&self, n: usize, count: usize) -> Vec<PlainWave> {
        let size = 2 * self.mesh.radii_m.len();
        let mut matrices: [Mat<f64>; 2] = [0, 1].map(|_| Mat::zeros(size, size));
        for (i, row) in self.rows.iter().enumerate() {
            for (matrix, own) in matrices.iter_mut().zip(row.of_wave(n)) {
                for (p, of_row) in own.iter().enumerate() {
                    (0..4).for_each(|s| matrix[(2 * i + p, 2 * i + s)] += of_row[s]);
                }
            }
        }
        let first = match self.held {
            Held::Nothing => 0,
            Held::Deflection => 1,
            Held::Slope => 2,
        };
        let free = size - first;
        let [stiffness, mass] =
            matrices.map(|m| m.subrows(first, free).subcols(first, free).to_owned());
        let Some(ritz) = pencil(&stiffness, &mass, self.shift) else {
            return Vec::new();
        };
        (0..count.min(free))
            .map(|k| {
                let mut shape = vec![0.0; first];
                shape.extend(ritz.vectors.col(k).iter());
                PlainWave {
                    diameters: n,
                    square: ritz.values[k],
                    shape,
                }
            })
            .collect()
    }

    /// The branches of the lowest waves of up to `most` diameters, by number of diameters: one of a pair that stays equal, two of
    /// one that the slots split. Without entries if the numbers of the ring differ too much in size.
    pub fn branches(&self, most: usize) -> Vec<(PlainWave, Vec<Branch>)> {
        let mut waves: Vec<Vec<PlainWave>> = (0..=most + MORE).map(|n| self.plain(n)).collect();
        let mut found: Vec<Vec<Branch>> = vec![Vec::new(); most + 1];
        for class in Class::all(self.count, most) {
            let own = self.of_class(&class, &waves).unwrap_or_default();
            for (n, branch) in own {
                if n <= most {
                    found[n].push(branch);
                }
            }
        }
        waves.truncate(most + 1);
        let lowest = waves.into_iter().filter_map(|of| of.into_iter().next());
        lowest
            .zip(found)
            .filter(|(_, branches)| !branches.is_empty())
            .collect()
    }

    fn of_class(&self, class: &Class, waves: &[Vec<PlainWave>]) -> Option<Vec<(usize, Branch)>> {
        let angles = self.around.len() + 1;
        let unknowns = Unknowns::new(
            class,
            [self.mesh.radii_m.len(), angles],
            self.mesh.end,
            self.held,
        );
        let [stiffness, mass] = self.matrices(class, &unknowns);
        let own: Vec<(&PlainWave, f64)> = (waves.iter().flatten())
            .filter_map(|wave| Some((wave, class.sign_of(wave.diameters)?)))
            .collect();
        let start = self.start(class, &unknowns, &stiffness, &own);
        let basis = krylov([&stiffness, &mass], self.shift, &start)?;
        let energy = basis.transpose() * stiffness.times(&basis);
        let ritz = SymmetricEigen::new(energy.as_ref()).ok()?;
        let inertia = mass.times(&start);
        let shares = ritz.vectors.transpose() * (basis.transpose() * &inertia);
        let lowest_of = |(column, (wave, _)): (usize, &(&PlainWave, f64))| {
            let is_lowest = column == 0 || own[column - 1].0.diameters != wave.diameters;
            is_lowest.then(|| {
                let length: f64 = (0..start.nrows())
                    .map(|i| start[(i, column)] * inertia[(i, column)])
                    .sum();
                let (mut weight, mut sum, mut largest) = (0.0, 0.0, 0.0_f64);
                for (k, square) in ritz.values.iter().enumerate() {
                    let share = shares[(k, column)].powi(2) / length;
                    weight += share.powi(SHARPNESS);
                    sum += share.powi(SHARPNESS) * square;
                    largest = largest.max(share);
                }
                // A cut releases forces, so that it stiffens no mode: what exceeds 1 is rounding, or a share of higher modes.
                let bending = (sum / weight / wave.square).min(1.0);
                (
                    wave.diameters,
                    Branch {
                        bending,
                        share: largest,
                    },
                )
            })
        };
        Some(own.iter().enumerate().filter_map(lowest_of).collect())
    }

    /// Plain waves, each with its sign in the class, in the unknowns of the class.
    pub fn start(
        &self,
        class: &Class,
        unknowns: &Unknowns,
        stiffness: &Chain,
        waves: &[(&PlainWave, f64)],
    ) -> Mat<f64> {
        let mut start = Mat::zeros(stiffness.order(), waves.len());
        for (column, (wave, sign)) in waves.iter().enumerate() {
            for (index, value) in self.deflection(class, unknowns, wave, *sign) {
                start[(stiffness.index(index), column)] += value;
            }
        }
        start
    }

    /// Stiffness and mass of a class.
    pub fn matrices(&self, class: &Class, unknowns: &Unknowns) -> [Chain; 2] {
        let mut matrices = [0, 1].map(|_| Chain::zeros(&unknowns.orders));
        let functions = || (0..16).map(|k| [k / 4, k % 4]);
        for part in 0..class.parts().len() {
            for (i, row) in self.rows.iter().enumerate() {
                for (j, around) in self.around.iter().enumerate() {
                    let place = |[p, q]: [usize; 2]| {
                        unknowns.of_node(part, [i + p / 2, j + q / 2], 2 * (p % 2) + q % 2)
                    };
                    for one in functions() {
                        let Some((at, factor)) = place(one) else {
                            continue;
                        };
                        for other in functions() {
                            let Some((column, by)) = place(other) else {
                                continue;
                            };
                            let both = factor * by;
                            let [stiffness, mass] = &mut matrices;
                            stiffness.add(at, column, both * row.stiffness(around, one, other));
                            mass.add(at, column, both * row.mass(around, one, other));
                        }
                    }
                }
            }
        }
        matrices
    }

    /// A plain wave in the unknowns of a class.
    fn deflection(
        &self,
        class: &Class,
        unknowns: &Unknowns,
        wave: &PlainWave,
        sign: f64,
    ) -> Vec<(Place, f64)> {
        let n = wave.diameters as f64;
        let mut values = Vec::new();
        for (part, own) in class.parts().iter().enumerate() {
            for circle in 0..self.mesh.radii_m.len() {
                for (angle, theta) in self.mesh.angles_rad.iter().enumerate() {
                    let (sin, cos) = (n * theta).sin_cos();
                    let around = match own {
                        Part::Even => [cos, -n * sin],
                        Part::Odd => [sign * sin, sign * n * cos],
                    };
                    for unknown in 0..OF_NODE {
                        if let Some((place, factor)) =
                            unknowns.of_node(part, [circle, angle], unknown)
                        {
                            let radial = wave.shape[2 * circle + unknown / 2];
                            values.push((place, factor * radial * around[unknown % 2]));
                        }
                    }
                }
            }
        }
        values
    }
}

/// The eigenvalues of Kx = μMx, ascending, and vectors with xᵀMx = 1, by those of M with K + σM: the highest waves of small elements are
/// 1e15 times as stiff as the lowest ones, which they would drown in rounding.
fn pencil(stiffness: &Mat<f64>, mass: &Mat<f64>, shift: f64) -> Option<SymmetricEigen> {
    let order = mass.nrows();
    let shifted = stiffness + faer::Scale(shift) * mass;
    let factors = shifted.llt(Side::Lower).ok()?;
    let lower = factors.L();
    let mut half = mass.clone();
    solve_lower_triangular_in_place(lower, half.as_mut(), Par::Seq);
    let mut whole = half.transpose().to_owned();
    solve_lower_triangular_in_place(lower, whole.as_mut(), Par::Seq);
    let symmetric = Mat::from_fn(order, order, |i, k| 0.5 * (whole[(i, k)] + whole[(k, i)]));
    let eigen = SymmetricEigen::new(symmetric.as_ref()).ok()?;
    let mut vectors = Mat::from_fn(order, order, |i, k| {
        let last = order - 1 - k;
        eigen.vectors[(i, last)] / eigen.values[last].sqrt()
    });
    solve_upper_triangular_in_place(lower.transpose(), vectors.as_mut(), Par::Seq);
    let values = (eigen.values.iter().rev()).map(|inverse| inverse.recip() - shift);
    Some(SymmetricEigen {
        values: values.collect(),
        vectors,
    })
}
