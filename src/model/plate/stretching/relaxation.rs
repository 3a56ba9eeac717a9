//! Energy of the strains of one harmonic after relaxation by the in-plane displacement.

use faer::{Col, Mat, Scale};

use crate::model::plate::in_plane::{Banded, DEGREE, Elements, UnitStrains, stress_of};
use crate::model::plate::quadrature;
use crate::model::scene::{Blade, Bore, InPlane, Material};

use super::StretchingError;
use super::nodes::{NodeShare, Nodes};

/// Matrix Z of harmonic m: |Z e|² is the energy, in J, of the strains e at the nodes, which vary as (cos mθ,
/// cos mθ, sin mθ), or as these rotated by a quarter wave.
#[derive(Debug, Clone)]
pub struct Relaxed {
    /// One row for each value of Z e, with three columns for each node.
    rows: Vec<Vec<f64>>,
}

/// Columns smaller than this share of the largest are rounding; their share of the energy is its square.
const RANK_TOLERANCE: f64 = 1e-10;

/// Number of half-waves of the roughest strains per element, if their degree exceeds that of its polynomials.
/// With elements of the usual width the strains of twelve radial functions are not relaxed; with these narrower
/// ones their energy is accurate to 1e-9 of the largest.
const HALF_WAVES: usize = 4;

impl Relaxed {
    /// Computes Z. The strains at the points of a Gauss rule are E = e + B u with u = −A⁻¹ Bᵀℂe. The matrix
    /// that gives √(weight ℂ) E of e is factored as Q R Pᵀ, so that Z = R Pᵀ.
    ///
    /// # Errors
    /// [`StretchingError::NotFinite`].
    pub fn new(blade: &Blade, nodes: &Nodes, order: usize) -> Result<Self, StretchingError> {
        let elements = Elements::new(blade, order, &nodes.divisions_m(DEGREE, HALF_WAVES));
        Self::on(&elements, blade, nodes, order)
    }

    fn on(
        elements: &Elements,
        blade: &Blade,
        nodes: &Nodes,
        order: usize,
    ) -> Result<Self, StretchingError> {
        let points = Points::new(blade, nodes, elements);
        let displacements = points.displacements(elements, 3 * nodes.len(), fixed(blade, order));
        let turns = if order == 0 { 1.0 } else { 2.0 };
        let left = Scale((std::f64::consts::PI * turns).sqrt())
            * points.left(elements, &displacements, 3 * nodes.len());
        if !left.norm_max().is_finite() {
            return Err(StretchingError::NotFinite { harmonic: order });
        }
        Ok(Relaxed {
            rows: triangular(left),
        })
    }

    /// Number of values of Z e.
    pub fn rank(&self) -> usize {
        self.rows.len()
    }

    /// Appends Z e to `relaxed`.
    pub fn apply(&self, strain: &[f64], relaxed: &mut Vec<f64>) {
        relaxed.extend(self.rows.iter().map(|row| dot(row, strain)));
    }

    /// Adds Zᵀ y to `stress`, where y is `relaxed`.
    pub fn apply_transposed(&self, relaxed: &[f64], stress: &mut [f64]) {
        for (row, y) in self.rows.iter().zip(relaxed) {
            for (stress, z) in stress.iter_mut().zip(row) {
                *stress += z * y;
            }
        }
    }
}

/// Number of sums beside each other in a [`dot`].
const LANES: usize = 8;

/// Product of two vectors. Several sums beside each other do not wait for one another; one sum took a
/// fifth of the time of a chart with friction.
fn dot(x: &[f64], y: &[f64]) -> f64 {
    let (x_parts, x_rest) = x.as_chunks::<LANES>();
    let (y_parts, y_rest) = y.as_chunks::<LANES>();
    let mut sums = [0.0; LANES];
    for (x, y) in x_parts.iter().zip(y_parts) {
        for k in 0..LANES {
            sums[k] += x[k] * y[k];
        }
    }
    let rest = x_rest.iter().zip(y_rest).map(|(x, y)| x * y);
    sums.into_iter().chain(rest).sum()
}

/// Rows of R Pᵀ by column pivoting: the largest remaining column gives the next direction of Q, which is
/// removed from all columns. There are few rows, because most columns are combinations of a few.
///
/// The triangular factor of an ordinary QR decomposition, which replaces the matrix, has the same products of columns and a tenth of its
/// rows.
fn triangular(whole: Mat<f64>) -> Vec<Vec<f64>> {
    let mut left = whole.qr().thin_R().to_owned();
    let mut rows = Vec::new();
    let mut directions: Vec<Col<f64>> = Vec::new();
    let mut negligible = 0.0;
    for _ in 0..left.nrows().min(left.ncols()) {
        let norms = (0..left.ncols()).map(|k| left.col(k).squared_norm_l2());
        let Some((pivot, norm)) = norms.enumerate().max_by(|x, y| x.1.total_cmp(&y.1)) else {
            break;
        };
        if rows.is_empty() {
            negligible = norm * RANK_TOLERANCE.powi(2);
        }
        if norm <= negligible {
            break;
        }
        let mut direction = left.col(pivot).to_owned();
        for known in &directions {
            let share = known.transpose() * &direction;
            direction -= Scale(share) * known;
        }
        direction *= Scale(direction.norm_l2().recip());
        let row = direction.transpose() * &left;
        left -= &direction * &row;
        rows.push(row.iter().copied().collect());
        directions.push(direction);
    }
    rows
}

/// Unknowns at the bore that are fixed at zero: both displacements of a fixed collar; otherwise one for each
/// motion without strain, the rotation of m = 0 and the translation of m = 1, whose reaction is zero.
fn fixed(blade: &Blade, order: usize) -> &'static [usize] {
    match (blade.bore, order) {
        (Bore::Clamped(InPlane::Fixed), _) => &[0, 1],
        (_, 0) => &[1],
        (_, 1) => &[0],
        _ => &[],
    }
}

/// Quadrature points over the blade.
struct Points(Vec<Point>);

struct Point {
    element: usize,
    unit: UnitStrains,
    strains: Vec<NodeShare>,
    /// Factors [(rr, rr), (rr, tt), (tt, tt), (rt, rt)] of √(weight ℂ), triangular.
    root: [f64; 4],
    /// Weight of the rule times r h, in m³.
    weight: f64,
    material: Material,
}

impl Points {
    fn new(blade: &Blade, nodes: &Nodes, elements: &Elements) -> Self {
        // The rule has enough points for products of two displacement polynomials, and, if a single element
        // has the width of the blade, also for products of two strain polynomials.
        let count = DEGREE + 4 + nodes.degree() / elements.count();
        let material = blade.material;
        let (e, nu) = (material.youngs_modulus_pa, material.poisson_ratio);
        let plane = (e / (1.0 - nu * nu)).sqrt();
        let across = (1.0 - nu * nu).sqrt();
        let of_element = |element: usize| {
            let [from, to] = elements.ends_m(element);
            let rule = quadrature::graded(from, to, count);
            let points: Vec<Point> = rule
                .iter()
                .map(|(r, w)| {
                    let weight = w * r * blade.thickness_at_m(r);
                    let root = weight.sqrt() * plane;
                    Point {
                        element,
                        unit: elements.unit_strains(element, r),
                        strains: nodes.interpolated(r),
                        root: [
                            root,
                            nu * root,
                            across * root,
                            root * (0.5 * (1.0 - nu)).sqrt(),
                        ],
                        weight,
                        material,
                    }
                })
                .collect();
            points
        };
        Points((0..elements.count()).flat_map(of_element).collect())
    }

    /// Displacements u and v at the nodes of the elements, for all unit strains.
    fn displacements(&self, elements: &Elements, strains: usize, fixed: &[usize]) -> Vec<f64> {
        let unknowns = 2 * elements.nodes();
        let mut stiffness = Banded::new(unknowns, 2 * (DEGREE + 1));
        let mut forces = vec![0.0; unknowns * strains];
        let nodes = strains / 3;
        for point in &self.0 {
            let first = 2 * elements.nodes_of(point.element).start;
            let unit: Vec<[f64; 3]> = point.unit_strains().collect();
            for (i, left) in unit.iter().enumerate() {
                let stress = stress_of(&point.material, *left).map(|s| point.weight * s);
                for (k, right) in unit[..=i].iter().enumerate() {
                    let energy: f64 = stress.iter().zip(right).map(|(s, e)| s * e).sum();
                    stiffness.add(first + i, first + k, energy);
                }
                let row = strains * (first + i);
                for (part, stress) in stress.iter().enumerate() {
                    for NodeShare { node, share } in &point.strains {
                        forces[row + part * nodes + node] -= stress * share;
                    }
                }
            }
        }
        for &unknown in fixed {
            stiffness.fix(unknown);
            forces[strains * unknown..strains * (unknown + 1)].fill(0.0);
        }
        stiffness.factored().solve(&mut forces, strains);
        forces
    }

    /// Matrix of √(weight ℂ) (e + B u), three rows for each point and one column for each unit strain.
    fn left(&self, elements: &Elements, displacements: &[f64], strains: usize) -> Mat<f64> {
        let nodes = strains / 3;
        let mut left = Mat::zeros(3 * self.0.len(), strains);
        let mut sums = [0, 1, 2].map(|_| vec![0.0; strains]);
        for (row, point) in self.0.iter().enumerate() {
            let first = 2 * elements.nodes_of(point.element).start;
            for (part, sum) in sums.iter_mut().enumerate() {
                sum.fill(0.0);
                for (i, unit) in point.unit_strains().enumerate() {
                    let own = &displacements[strains * (first + i)..strains * (first + i + 1)];
                    for (sum, u) in sum.iter_mut().zip(own) {
                        *sum += unit[part] * u;
                    }
                }
                for NodeShare { node, share } in &point.strains {
                    sum[part * nodes + node] += share;
                }
            }
            let [radial, coupled, hoop, shear] = point.root;
            for column in 0..strains {
                let [rr, tt, rt] = sums.each_ref().map(|sum| sum[column]);
                left[(3 * row, column)] = radial * rr + coupled * tt;
                left[(3 * row + 1, column)] = hoop * tt;
                left[(3 * row + 2, column)] = shear * rt;
            }
        }
        left
    }
}

impl Point {
    /// Strains for unit displacements u and v of each node in turn.
    fn unit_strains(&self) -> impl Iterator<Item = [f64; 3]> + '_ {
        let both = self.unit.radial.iter().zip(&self.unit.along);
        both.flat_map(|(radial, along)| [*radial, *along])
    }
}

#[cfg(test)]
mod tests {
    use super::super::test_blades::plate;
    use super::*;

    /// Unit strains at single nodes are the roughest strains. Elements of half the width change their energies by less
    /// than 1e-9 of the largest energy.
    #[test]
    fn the_elements_are_fine_enough() {
        for (functions, bore_m) in [(4, 0.2), (8, 0.2), (12, 0.2), (12, 0.02), (16, 0.5)] {
            let plate = plate([2, functions], |saw| saw.blade.inner_diameter_m = bore_m);
            let blade = &plate.blade;
            let nodes = Nodes::new(&plate);
            for order in [0, 1, 2, 9, 24] {
                let mut knots = nodes.divisions_m(DEGREE, HALF_WAVES);
                let coarse = Elements::new(blade, order, &knots);
                let ends = (0..coarse.count()).map(|element| coarse.ends_m(element));
                knots.extend(ends.flat_map(|[from, to]| [from, (from * to).sqrt()]));
                let fine = Elements::new(blade, order, &knots);
                assert_eq!(fine.count(), 2 * coarse.count());
                let [usual, halved] = [coarse, fine]
                    .map(|elements| Relaxed::on(&elements, blade, &nodes, order).unwrap());
                let energies = |z: &Relaxed| -> Vec<f64> {
                    let square = |unit: usize| z.rows.iter().map(move |row| row[unit].powi(2));
                    (0..3 * nodes.len())
                        .map(|unit| square(unit).sum())
                        .collect()
                };
                let (usual_energies, halved_energies) = (energies(&usual), energies(&halved));
                let largest = halved_energies.iter().copied().fold(0.0, f64::max);
                for (usual, halved) in usual_energies.iter().zip(&halved_energies) {
                    let error = (usual - halved).abs() / largest;
                    assert!(error < 1e-9, "{functions} {bore_m} {order}: {error:e}");
                }
            }
        }
    }
}
