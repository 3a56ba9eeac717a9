//! Modes of a slotted blade that turns, in the frame of the blade.
//!
//! With the elements of half a pitch and the stress of rotation of the same cuts (`plane`), not its mean, the blade has
//!
//! q̈ + C q̇ + (K_b + Ω²K_σ) q = 0, K_σ = ∫ h/h₀ [σ_rr w_r² + σ_θθ w_θ²/r² + 2σ_rθ w_r w_θ/r] r dr dθ / ρΩ²,
//!
//! for every class of waves (`symmetry`), in which K_b and K_σ are projected on vectors that contain its lowest modes at rest. A mode
//! (e, o) of a class of the phase kα is w = Re c e^{ikαj} (e + i o) on pitch j, with two coordinates, a = Re c and b = Im c, and one if its
//! part is alone. Renumbering the pitches, j + 1 in place of j, turns c by −kα: the one symmetry that a guide fixed in space leaves.
//!
//! Material damping turns with the blade: C = τ K_b + 2ζ √K_b, of which the diagonal in the modes at a speed is taken; what couples two
//! modes of different frequencies is of second order in it.

use std::f64::consts::TAU;
use std::sync::{Arc, Mutex, PoisonError};

use faer::{Mat, Scale};

use super::super::quadrature::smooth;
use super::chain::Chain;
use super::elements::hermite;
use super::krylov::krylov;
use super::mesh::Mesh;
use super::plane::PlaneStress;
use super::symmetry::{Class, Unknowns};
use super::waves::{PlainWave, Slotted};
use crate::model::linalg::SymmetricEigen;
use crate::model::scene::{Blade, DampingFile, Slots};

/// Number of coordinates of the plain waves of which modes are composed at first; circles and further diameters among which they are.
const STARTED: usize = 96;
const CIRCLES: usize = 6;
const MORE: usize = 6;
/// Points of the rule on an element, for products of slopes and of this stress.
const POINTS: usize = 5;
/// Blades kept, so that scenes that differ in other things share the work.
const KEPT: usize = 4;

/// Stiffness of all products of the 16 functions of an element.
type Form = [[f64; 16]; 16];

/// A slotted blade in its own frame.
pub struct TurningBlade {
    pub(super) classes: Vec<TurningClass>,
    pub(super) mesh: Mesh,
    pub(super) count: usize,
    mass_per_area_kg_per_m2: f64,
}

/// The waves of a class.
pub(super) struct TurningClass {
    pub class: Class,
    pub unknowns: Unknowns,
    /// Index of the first unknown of each block.
    pub first: Vec<usize>,
    /// The modes at rest in the unknowns, xᵀMx = 1 on half a pitch.
    pub basis: Mat<f64>,
    /// Their ω², ascending, in 1/s².
    resting: Vec<f64>,
    /// K_σ among them.
    spin: Mat<f64>,
}

/// A mode of the blade at a speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TurningMode {
    pub(super) class: usize,
    pub(super) column: usize,
    /// ω² in the frame of the blade, in 1/s²; zero or rounding for a motion that nothing holds.
    pub square: f64,
    /// Factor of the velocity, twice the rate of decay, in 1/s.
    pub damping_per_s: f64,
    /// Phase kα between neighbouring pitches.
    pub phase_rad: f64,
    /// Whether it has two coordinates.
    pub is_pair: bool,
    /// Norm of a mode of the unit half a pitch, in √(kg/m²).
    pub(super) norm: f64,
}

/// The lowest modes of a blade at a speed.
pub struct TurningModes<'a> {
    pub(super) blade: &'a TurningBlade,
    /// By class: modes at rest × modes at the speed.
    pub(super) vectors: Vec<Mat<f64>>,
    /// Ascending in ω².
    pub modes: Vec<TurningMode>,
}

impl TurningBlade {
    /// The slots of a blade; `None` if it has none, or if its numbers differ too much in size. The blades computed last are kept.
    pub fn of(blade: &Blade) -> Option<Arc<Self>> {
        static LAST: Mutex<Vec<(Blade, Arc<TurningBlade>)>> = Mutex::new(Vec::new());
        let slots = blade.slots?;
        let last = || LAST.lock().unwrap_or_else(PoisonError::into_inner);
        let is_own = |(own, _): &&(Blade, _)| own == blade;
        let known = last().iter().find(is_own).map(|(_, known)| known.clone());
        if known.is_some() {
            return known;
        }
        let found = Arc::new(Self::new(blade, &slots)?);
        let mut last = last();
        last.truncate(KEPT - 1);
        last.insert(0, (*blade, found.clone()));
        Some(found)
    }

    /// A blade with these slots, of any depth; with a depth of zero it is plain.
    pub fn new(blade: &Blade, slots: &Slots) -> Option<Self> {
        let (mesh, most) = Mesh::of(blade, slots);
        let slotted = Slotted::new(blade, &mesh, slots.count);
        let spin = spin_of_elements(blade, &PlaneStress::new(blade, &mesh));
        let waves = lowest_waves(&slotted, most + MORE);
        let mut classes = Vec::new();
        for class in Class::all(slots.count as usize, most) {
            let own: Vec<(&PlainWave, f64)> = (waves.iter())
                .filter_map(|wave| Some((wave, class.sign_of(wave.diameters)?)))
                .collect();
            if own.is_empty() {
                continue;
            }
            let size = [mesh.radii_m.len(), mesh.angles_rad.len()];
            let unknowns = Unknowns::new(&class, size, mesh.end, slotted.held);
            let [stiffness, mass] = slotted.matrices(&class, &unknowns);
            let start = slotted.start(&class, &unknowns, &stiffness, &own);
            let basis = krylov([&stiffness, &mass], slotted.shift, &start)?;
            let energy = basis.transpose() * stiffness.times(&basis);
            let ritz = SymmetricEigen::new(energy.as_ref()).ok()?;
            let basis = basis * &ritz.vectors;
            let spin = assembled(&spin, &mesh, &class, &unknowns);
            let projected = basis.transpose() * spin.times(&basis);
            classes.push(TurningClass {
                spin: Scale(0.5) * (&projected + projected.transpose()),
                first: (0..unknowns.orders.len())
                    .map(|block| stiffness.index((block, 0)))
                    .collect(),
                class,
                unknowns,
                basis,
                resting: ritz.values,
            });
        }
        Some(TurningBlade {
            classes,
            count: slots.count as usize,
            mass_per_area_kg_per_m2: blade.mass_per_area_kg_per_m2(),
            mesh,
        })
    }

    /// Angle α of a pitch.
    pub fn pitch_rad(&self) -> f64 {
        TAU / self.count as f64
    }

    /// The lowest modes at a speed, with at most so many coordinates; `None` if a number is not finite.
    pub fn modes(
        &self,
        speed_rad_per_s: f64,
        damping: Option<&DampingFile>,
        most: usize,
    ) -> Option<TurningModes<'_>> {
        let (mut vectors, mut modes) = (Vec::new(), Vec::new());
        let retardation_s = damping.map_or(0.0, |it| it.material_retardation_time_s);
        let ratio = damping.map_or(0.0, DampingFile::smallest_ratio);
        for (index, own) in self.classes.iter().enumerate() {
            let mut stiffness = Scale(speed_rad_per_s.powi(2)) * &own.spin;
            let rates = own.resting.iter().enumerate().map(|(i, square)| {
                stiffness[(i, i)] += square;
                let square = square.max(0.0);
                retardation_s * square + 2.0 * ratio * square.sqrt()
            });
            let rates: Vec<f64> = rates.collect();
            let eigen = SymmetricEigen::new(stiffness.as_ref()).ok()?;
            let is_pair = own.class.alone.is_none();
            let copies = if is_pair { 1.0 } else { 2.0 } * self.count as f64;
            modes.extend(eigen.values.iter().enumerate().map(|(column, square)| {
                let of_mode = rates.iter().enumerate();
                let of_mode = of_mode.map(|(i, rate)| rate * eigen.vectors[(i, column)].powi(2));
                TurningMode {
                    class: index,
                    column,
                    square: *square,
                    damping_per_s: of_mode.sum(),
                    phase_rad: own.class.phase as f64 * self.pitch_rad(),
                    is_pair,
                    norm: (self.mass_per_area_kg_per_m2 * copies).sqrt(),
                }
            }));
            vectors.push(eigen.vectors);
        }
        modes.sort_by(|x, y| x.square.total_cmp(&y.square));
        let mut coordinates = 0;
        let kept = modes.iter().take_while(|mode| {
            coordinates += mode.coordinates();
            coordinates <= most
        });
        let kept = kept.count();
        modes.truncate(kept);
        Some(TurningModes {
            blade: self,
            vectors,
            modes,
        })
    }
}

impl TurningMode {
    /// Number of its coordinates.
    pub fn coordinates(&self) -> usize {
        1 + usize::from(self.is_pair)
    }
}

/// The lowest waves of the plain ring.
fn lowest_waves(slotted: &Slotted<'_>, most: usize) -> Vec<PlainWave> {
    let mut waves: Vec<PlainWave> = (0..=most)
        .flat_map(|n| slotted.lowest(n, CIRCLES))
        .collect();
    waves.sort_by(|x, y| x.square.total_cmp(&y.square));
    let mut coordinates = 0;
    let kept = waves.iter().take_while(|wave| {
        coordinates += if wave.diameters == 0 { 1 } else { 2 };
        coordinates <= STARTED
    });
    let kept = kept.count();
    waves.truncate(kept);
    // Waves of one number of diameters are neighbours, the lowest first.
    waves.sort_by_key(|wave| wave.diameters);
    waves
}

/// K_σ of every element, without unit: over ρΩ² and with the mass ρh₀ r dr dθ.
fn spin_of_elements(blade: &Blade, plane: &PlaneStress<'_>) -> Vec<Form> {
    let (radii, angles) = (&plane.mesh.radii_m, &plane.mesh.angles_rad);
    let mut forms = Vec::with_capacity(radii.len() * angles.len());
    for (i, pair) in radii.windows(2).enumerate() {
        let along = smooth(pair[0], pair[1], POINTS);
        for (j, sides) in angles.windows(2).enumerate() {
            let across = smooth(sides[0], sides[1], POINTS);
            let mut form: Form = [[0.0; 16]; 16];
            for (r, radial_weight) in along.iter() {
                let [f, d, _] = hermite(r - pair[0], pair[1] - pair[0]);
                let weight = radial_weight * r * blade.thickness_ratio(r);
                for (angle, angular_weight) in across.iter() {
                    let [g, dg, _] = hermite(angle - sides[0], sides[1] - sides[0]);
                    let [radial, hoop, shear] = plane.at_m2([i, j], r, angle);
                    let slopes: [[f64; 2]; 16] = std::array::from_fn(|k| {
                        let (p, q) = (k / 4, k % 4);
                        [d[p] * g[q], f[p] * dg[q] / r]
                    });
                    let weight = weight * angular_weight;
                    for (k, [own_r, own_t]) in slopes.iter().enumerate() {
                        let by_r = weight * (radial * own_r + shear * own_t);
                        let by_t = weight * (hoop * own_t + shear * own_r);
                        for (entry, [r, t]) in form[k].iter_mut().zip(&slopes) {
                            *entry += by_r * r + by_t * t;
                        }
                    }
                }
            }
            forms.push(form);
        }
    }
    forms
}

/// The forms of all elements in the unknowns of a class. The stress is even about the middle of a pitch, and σ_rθ odd, so that the parts
/// of a deflection do not couple.
fn assembled(forms: &[Form], mesh: &Mesh, class: &Class, unknowns: &Unknowns) -> Chain {
    let across = mesh.angles_rad.len() - 1;
    let mut whole = Chain::zeros(&unknowns.orders);
    for part in 0..class.parts().len() {
        for (element, form) in forms.iter().enumerate() {
            let (i, j) = (element / across, element % across);
            let places: [_; 16] = std::array::from_fn(|k| {
                let (p, q) = (k / 4, k % 4);
                unknowns.of_node(part, [i + p / 2, j + q / 2], 2 * (p % 2) + q % 2)
            });
            for (row, at) in form.iter().zip(&places) {
                let Some((at, factor)) = at else { continue };
                for (value, column) in row.iter().zip(&places) {
                    if let Some((column, by)) = column {
                        whole.add(*at, *column, factor * by * value);
                    }
                }
            }
        }
    }
    whole
}
