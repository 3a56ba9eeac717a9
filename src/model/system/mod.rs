//! The equation of motion at a rotation speed.
//!
//! A [`Plate`] gives a [`GyroscopicSystem`], its assembled matrices, and from that K(Ω) and the factor of q̇
//! at any speed:
//!
//! q̈ + (2ΩG + C) q̇ + [K₀ + Ω²(K_σ − N) + Ω K_circ + K_n] q = 0 with the identity as mass matrix and K₀ =
//! K_b + K_m + K_g + K_e. Terms that the scene does not contain are absent.
//!
//! This is the equation ρh D²w/Dt² + … = 0 of the plate with the convective derivative D/Dt = ∂t + Ω∂θ: D²
//! gives ∂t², the gyroscopic 2Ω ∂t∂θ and Ω² ∂θ², which is −N. Material damping resists the strain rate of the
//! turning blade by C_i Dq/Dt, with C_i in proportion to K_b or to its square root; hence the part C_i of C, and
//! K_circ = C_i G. Air that turns with the share s of the speed resists w_t + sΩw_θ.
//!
//! References: W. D. Iwan & T. L. Moeller, J. Appl. Mech. 43 (1976), 485–490; P. Lancaster, *Strongly stable
//! gyroscopic systems*, Electron. J. Linear Algebra 5 (1999), 53–66, for Krein signs as a consequence of
//! symmetry and skewness.

mod projection;

use faer::{Col, Mat, Scale, c64};
use nalgebra::DMatrix;

use crate::model::linalg::SymmetricEigen;
use crate::model::plate::{HarmonicBlock, Plate};

/// L(λ) = λ² + λD + K from K(Ω) and D = 2ΩG + C, in 1/s².
pub(crate) fn dynamic_stiffness(
    stiffness: &Mat<f64>,
    velocity: &Mat<f64>,
    lambda: c64,
) -> Mat<c64> {
    let order = stiffness.nrows();
    let mut dynamic = Mat::from_fn(order, order, |i, k| {
        lambda * velocity[(i, k)] + stiffness[(i, k)]
    });
    (0..order).for_each(|i| dynamic[(i, i)] += lambda * lambda);
    dynamic
}

/// Matrices of the equation of motion, N × N; their projection on fewer vectors is a system of the same kind.
#[derive(Debug, Clone)]
pub struct GyroscopicSystem {
    /// K₀ = K_b + K_m + K_g + K_e, in 1/s², symmetric: bending, membrane stress, guides, edge loads.
    pub stiffness: Mat<f64>,
    /// K_σ − N, dimensionless, symmetric: centrifugal tension minus the convective term, N = n² for the waves
    /// of n nodal diameters.
    pub spin: Mat<f64>,
    /// G = ∂θ in the basis, dimensionless, skew: ±n between the cosines and the sines of n nodal diameters.
    pub gyroscopic: Mat<f64>,
    /// C, in 1/s, symmetric: pads, air and material.
    pub damping: Option<Mat<f64>>,
    /// K_circ = C_i G + s C_a G, in 1/s: material damping C_i turns with the blade, and air, with the part C_a
    /// of C, with the share s of its speed.
    pub circulatory: Option<Mat<f64>>,
    /// K_n, in 1/s², without symmetry: contact forces that have no potential, and internal states of pads.
    pub nonconservative: Option<Mat<f64>>,
    /// Rigid motions z without stiffness, orthonormal: K(Ω) z = 0 at every speed.
    pub free_rigid: Vec<Col<f64>>,
    /// Contribution of free rigid motions to K_σ − N for a wave that stands still, see
    /// [`GyroscopicSystem::standing_spin`]; dimensionless.
    pub drift: Option<Mat<f64>>,
}

impl GyroscopicSystem {
    /// The system of the whole plate, N × N.
    pub fn of_plate(plate: &Plate) -> Self {
        let mut system = Self::of_harmonics(plate, 0..=plate.max_diameters());
        let fixed_in_space = [plate.contact.stiffness(), plate.edge_stiffness.as_ref()];
        for term in fixed_in_space.into_iter().flatten() {
            system.stiffness += term;
        }
        if let Some(contact) = plate.contact.damping() {
            system.damping = Some(match system.damping.take() {
                Some(damping) => damping + contact,
                None => contact.clone(),
            });
        }
        system.nonconservative = plate.contact.nonconservative_stiffness().cloned();
        system.find_free_rigid_motions(plate, 0);
        system
    }

    /// Whether nothing holds some rigid motion of a plate.
    pub(crate) fn has_free_motions(plate: &Plate) -> bool {
        plate.basis.has_rigid_motions() && !Self::of_plate(plate).free_rigid.is_empty()
    }

    /// The system of the whole plate inside the gaps of its pads. Its rigid motions without stiffness do not
    /// count as free, because the pads hold them beyond the gaps. `None` if no pad lifts off.
    pub(crate) fn of_released(plate: &Plate) -> Option<Self> {
        let mut system = Self::of_plate(&plate.released()?);
        system.free_rigid.clear();
        system.drift = None;
        Some(system)
    }

    /// The block of n nodal diameters, which is decoupled from others if the plate is axisymmetric.
    pub fn of_harmonic(plate: &Plate, n: usize) -> Self {
        let mut system = Self::of_harmonics(plate, n..=n);
        system.find_free_rigid_motions(plate, plate.offset(n));
        system
    }

    fn of_harmonics(plate: &Plate, range: std::ops::RangeInclusive<usize>) -> Self {
        let (first, radial) = (plate.offset(*range.start()), plate.basis.count());
        let size = plate.offset(range.end() + 1) - first;
        let blocks = |of: fn(&HarmonicBlock) -> &DMatrix<f64>| -> Mat<f64> {
            let blocks: Vec<_> = plate.harmonics.iter().map(of).collect();
            spread(plate, range.clone(), &blocks)
        };
        let mut gyroscopic = Mat::zeros(size, size);
        for n in range.clone().filter(|n| *n > 0) {
            let cosine = plate.offset(n) - first;
            for j in 0..radial {
                // The elements follow from ∂ sin nθ/∂θ = n cos nθ and ∂ cos nθ/∂θ = −n sin nθ.
                gyroscopic[(cosine + j, cosine + radial + j)] = n as f64;
                gyroscopic[(cosine + radial + j, cosine + j)] = -(n as f64);
            }
        }
        let mut system = Self::undamped(blocks(|h| &h.bending), blocks(|h| &h.spin), gyroscopic);
        system.add_blade_damping(plate, range.clone());
        if plate.membrane.is_some() {
            let blocks = plate.harmonics.iter().filter_map(|h| h.membrane.as_ref());
            system.stiffness += spread(plate, range, &blocks.collect::<Vec<_>>());
        }
        system
    }

    fn add_blade_damping(&mut self, plate: &Plate, range: std::ops::RangeInclusive<usize>) {
        let Some(damping) = &plate.damping else {
            return;
        };
        let size = self.order();
        let mut total: Mat<f64> = Mat::zeros(size, size);
        // `turning` is the damping by material and air that rotate: the material with the blade, the air with
        // a share of its speed.
        let mut turning: Option<Mat<f64>> = None;
        let material = plate.harmonics.iter().map(|h| h.material_damping.as_ref());
        if let Some(blocks) = material.collect::<Option<Vec<_>>>() {
            let material = spread(plate, range.clone(), &blocks);
            total += &material;
            turning = Some(material);
        }
        let air = damping.air_n_s_per_m3 / plate.blade.mass_per_area_kg_per_m2();
        let area = air_area(plate, range);
        match &area {
            Some(area) => total += Scale(air) * area,
            None => (0..size).for_each(|i| total[(i, i)] += air),
        }
        let turning_air = air * damping.air_rotation_share;
        if turning_air > 0.0 {
            let area = area.unwrap_or_else(|| Mat::identity(size, size));
            let air = Scale(turning_air) * area;
            turning = Some(turning.map_or_else(|| air.clone(), |material| material + &air));
        }
        self.circulatory = turning.map(|turning| turning * &self.gyroscopic);
        self.damping = Some(total);
    }

    /// Finds free heave and tilt, and their drift. `first` is the index of the first unknown in the basis of the
    /// plate.
    fn find_free_rigid_motions(&mut self, plate: &Plate, first: usize) {
        if !plate.basis.has_rigid_motions() {
            return;
        }
        let tilt = plate.offset(1);
        let rigid: Vec<usize> = [0, tilt, tilt + plate.basis.count()]
            .into_iter()
            .filter_map(|index| index.checked_sub(first))
            .filter(|index| *index < self.order())
            .collect();
        if rigid.is_empty() {
            return;
        }
        let resting = self.stiffness_at_rest();
        // The internal states of pads follow a motion as at rest; a block without contacts does not hold them.
        let states: Vec<usize> = plate
            .states()
            .filter_map(|state| state.checked_sub(first))
            .filter(|state| resting[(*state, *state)] != 0.0)
            .collect();
        let followed =
            |state: usize, motion: usize| -resting[(state, motion)] / resting[(state, state)];
        let mut stiffest = 0.0_f64;
        let held = Mat::from_fn(rigid.len(), rigid.len(), |i, j| {
            let own = resting[(rigid[i], rigid[j])];
            stiffest = stiffest.max(own.abs());
            let by_states = states
                .iter()
                .map(|state| resting[(rigid[i], *state)] * followed(*state, rigid[j]));
            own + by_states.sum::<f64>()
        });
        // A stiffness that is not finite holds every motion here, and is refused by every eigenproblem.
        let eigen = SymmetricEigen::or_nan(held.as_ref());
        let all = eigen.values.iter();
        let stiffest = all.fold(stiffest, |most, x| most.max(x.abs()));
        let largest = resting.norm_max();
        for k in (0..rigid.len()).filter(|&k| eigen.values[k] <= ROUNDING * stiffest) {
            let mut z = Col::zeros(self.order());
            for (i, &index) in rigid.iter().enumerate() {
                z[index] = eigen.vectors[(i, k)];
                for state in &states {
                    z[*state] += eigen.vectors[(i, k)] * followed(*state, index);
                }
            }
            // A force without a potential may do work on a motion that it does not resist; the momentum of the motion then changes.
            let forces = [&resting * &z, resting.transpose() * &z];
            if forces
                .iter()
                .all(|force| force.norm_max() <= ROUNDING * largest)
            {
                self.free_rigid.push(z);
            }
        }
        if !self.free_rigid.is_empty() {
            self.drift = self.drift_of_free_motions();
        }
    }

    /// K₀ + K_n, in 1/s².
    fn stiffness_at_rest(&self) -> Mat<f64> {
        match &self.nonconservative {
            Some(nonconservative) => &self.stiffness + nonconservative,
            None => self.stiffness.clone(),
        }
    }

    /// 4 GᵀZ₀Z₀ᵀG with the free rigid motions Z₀ that G does not couple with each other.
    fn drift_of_free_motions(&self) -> Option<Mat<f64>> {
        let turned: Vec<Col<f64>> = self
            .free_rigid
            .iter()
            .map(|z| &self.gyroscopic * z)
            .collect();
        let count = turned.len();
        // The matrix `coupled` is Ĝ = ZᵀGZ with the free rigid motions as columns of Z. The null vectors of
        // ĜᵀĜ are those of Ĝ.
        let coupled = Mat::from_fn(count, count, |i, j| {
            self.free_rigid[i].transpose() * &turned[j]
        });
        let eigen = SymmetricEigen::or_nan((coupled.transpose() * &coupled).as_ref());
        let mut drift: Option<Mat<f64>> = None;
        for k in (0..count).filter(|&k| eigen.values[k] <= ROUNDING) {
            let mut g = Col::<f64>::zeros(self.order());
            for (i, column) in turned.iter().enumerate() {
                g += Scale(eigen.vectors[(i, k)]) * column;
            }
            if g.norm_max() > ROUNDING {
                let order = self.order();
                *drift.get_or_insert_with(|| Mat::zeros(order, order)) +=
                    Scale(4.0) * &g * g.transpose();
            }
        }
        drift
    }

    /// Matrix S for which K₀ + Ω²S is singular at the speeds at which a wave stands still: K_σ − N, plus 4GᵀzzᵀG
    /// for every free rigid motion z. The momentum zᵀ(q̇ + 2ΩGq) is constant, and zero in every motion that
    /// oscillates or grows: displaced by q the blade drifts at −2ΩzᵀGq, and 2ΩG times that drift is a force
    /// proportional to q, as that of a spring.
    ///
    /// Two free motions that G couples (zᵀGz′ ≠ 0) have no such term: each is displaced until the momentum of
    /// the other vanishes.
    pub fn standing_spin(&self) -> Mat<f64> {
        match &self.drift {
            Some(drift) => &self.spin + drift,
            None => self.spin.clone(),
        }
    }

    /// Number N of unknowns.
    pub fn order(&self) -> usize {
        self.stiffness.nrows()
    }

    /// Whether eigenvalues come in quadruples and modes have Krein signs.
    pub fn is_conservative(&self) -> bool {
        self.damping.is_none() && self.circulatory.is_none() && self.nonconservative.is_none()
    }

    /// The system without damping and without forces that have no potential.
    pub fn conservative(&self) -> Self {
        GyroscopicSystem {
            damping: None,
            circulatory: None,
            nonconservative: None,
            ..self.clone()
        }
    }

    /// K(Ω) = K₀ + Ω²(K_σ − N) + Ω K_circ, in 1/s²; symmetric without K_circ.
    pub fn stiffness_at(&self, speed_rad_per_s: f64) -> Mat<f64> {
        let mut stiffness = self.stiffness_at_rest() + Scale(speed_rad_per_s.powi(2)) * &self.spin;
        if let Some(circulatory) = &self.circulatory {
            stiffness += Scale(speed_rad_per_s) * circulatory;
        }
        stiffness
    }

    /// 2ΩG + C, in 1/s.
    pub fn velocity_at(&self, speed_rad_per_s: f64) -> Mat<f64> {
        let mut velocity = Scale(2.0 * speed_rad_per_s) * &self.gyroscopic;
        if let Some(damping) = &self.damping {
            velocity += damping;
        }
        velocity
    }

    /// K₀, K_σ − N and G without other terms, or their products with vectors.
    pub(crate) fn undamped(stiffness: Mat<f64>, spin: Mat<f64>, gyroscopic: Mat<f64>) -> Self {
        GyroscopicSystem {
            stiffness,
            spin,
            gyroscopic,
            damping: None,
            circulatory: None,
            nonconservative: None,
            free_rigid: Vec::new(),
            drift: None,
        }
    }
}

/// ∫ φᵢφⱼ dA, area relative to mass, for the resistance of air; `None` if it is the identity.
fn air_area(plate: &Plate, range: std::ops::RangeInclusive<usize>) -> Option<Mat<f64>> {
    let blocks: Option<Vec<_>> = plate.harmonics.iter().map(|h| h.area.as_ref()).collect();
    Some(spread(plate, range, &blocks?))
}

/// Numbers below this share of the largest are rounding.
const ROUNDING: f64 = 1e-12;

/// A matrix that couples no harmonics, in the unknowns of the harmonics of `range`, from its blocks of n = 0 …
/// n_max. Cosines and sines have the same block.
pub(crate) fn spread(
    plate: &Plate,
    range: std::ops::RangeInclusive<usize>,
    blocks: &[&DMatrix<f64>],
) -> Mat<f64> {
    let first = plate.offset(*range.start());
    let size = plate.offset(range.end() + 1) - first;
    let mut matrix = Mat::zeros(size, size);
    for n in range {
        let cosine = plate.offset(n) - first;
        put(&mut matrix, cosine, blocks[n]);
        if n > 0 {
            put(&mut matrix, cosine + plate.basis.count(), blocks[n]);
        }
    }
    matrix
}

fn put(matrix: &mut Mat<f64>, offset: usize, block: &DMatrix<f64>) {
    for j in 0..block.nrows() {
        for k in 0..block.ncols() {
            matrix[(offset + j, offset + k)] = block[(j, k)];
        }
    }
}

/// Removes the rounding of a product that is symmetric in exact arithmetic.
pub(crate) fn symmetric(matrix: Mat<f64>) -> Mat<f64> {
    Scale(0.5) * (&matrix + matrix.transpose())
}

/// Removes the rounding of a product that is skew in exact arithmetic.
fn skew(matrix: Mat<f64>) -> Mat<f64> {
    Scale(0.5) * (&matrix - matrix.transpose())
}

#[cfg(test)]
mod tests;
