//! Excitations of the blade, as loads that turn with it or are fixed in space.
//!
//! A blade whose shape at rest without guides is q₀ bends elastically by q − q₀, and this shape turns with it, so that
//! ∂t + Ω∂θ of q₀ is zero. In L(iω; Ω)(q − q₀) + … inertia, material damping and bending of q₀ therefore drop out, and the
//! total deflection follows from L(iω; Ω) q = (K_b + K_m) q₀ with ω = nΩ: guides, pad damping, centrifugal tension and air act
//! on the total deflection.
//!
//! A mass m at the radius r, h beside the middle plane, pulls with mrΩ², which does work on the rotation of the rim: the
//! moment is mrhΩ², the load −mrhΩ² ∂φ/∂r.

use faer::{Col, c64};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::model::linalg::SymmetricEigen;
use crate::model::plate::Plate;
use crate::model::scene::{Polar, RefusedValue, Scene};

/// Cause of an excitation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[schemars(rename = "CauseEntry")]
pub enum Cause {
    /// Constant lateral force, fixed in space.
    SideForce,
    /// One wave around the rim.
    RunOut,
    /// Two waves around the rim.
    Flatness,
    /// Imbalance beside the middle plane.
    Imbalance,
    /// Side force that oscillates with a multiple of the rotation frequency.
    OscillatingForce,
}

/// A load f e^{ikΩt}.
#[derive(Debug, Clone)]
pub struct Load {
    /// Cause of the load.
    pub cause: Cause,
    /// Ratio k of the frequency to the rotation speed.
    pub order: u32,
    /// Complex amplitude f on the basis functions; f/Ω² for an imbalance.
    pub vector: Col<c64>,
}

impl Load {
    /// A lateral force at a radius and an angle that oscillates with a multiple of the rotation frequency.
    pub fn at(cause: Cause, order: u32, plate: &Plate, place: Polar, amplitude_n: f64) -> Self {
        let values = plate.functions_at(place.radius_m, place.angle_rad);
        Load {
            cause,
            order,
            vector: Col::from_fn(values.len(), |i| c64::new(amplitude_n * values[i], 0.0)),
        }
    }

    /// Factor of `vector` at a speed: Ω² for an imbalance, otherwise one.
    pub fn factor(&self, speed_rad_per_s: f64) -> f64 {
        match self.cause {
            Cause::Imbalance => speed_rad_per_s.powi(2),
            _ => 1.0,
        }
    }
}

/// Orders of the excitation by an imbalance that are computed.
const IMBALANCE_ORDERS: [usize; 2] = [1, 2];
/// Share of the largest stiffness below which a stiffness is that of a rigid motion.
const RIGID: f64 = 1e-9;

/// The loads on the blade of a scene: a constant lateral force in N, shape and imbalance, and the oscillating side force.
///
/// # Errors
/// [`RefusedValue`] if the excitation has a shape that is a rigid motion of the blade.
pub fn loads(plate: &Plate, scene: &Scene, force_n: f64) -> Result<Vec<Load>, RefusedValue> {
    let mut loads = Vec::new();
    let (rim, place) = (plate.blade.outer_radius_m, scene.side_force().at.polar());
    let typed = scene.file().response.unwrap_or_default();
    if force_n != 0.0 {
        let per_newton = plate.load_at(&scene.constant_force().places);
        loads.push(Load {
            cause: Cause::SideForce,
            order: 0,
            vector: Col::from_fn(per_newton.nrows(), |i| {
                c64::new(force_n * per_newton[i], 0.0)
            }),
        });
    }
    let shapes = [
        (Cause::RunOut, 1, typed.runout_m),
        (Cause::Flatness, 2, typed.flatness_m),
    ];
    for (cause, n, amplitude_m) in shapes {
        if amplitude_m != 0.0 {
            loads.push(Load {
                cause,
                order: n as u32,
                vector: shape_load(plate, n, amplitude_m).ok_or_else(|| rigid(n, scene))?,
            });
        }
    }
    if typed.imbalance_kg_m2 != 0.0 {
        loads.extend(IMBALANCE_ORDERS.map(|n| {
            let slope = plate.basis.evaluate(n, rim).slope;
            let norm = plate.angular_norm(n);
            let radial = slope
                .iter()
                .map(|slope| -typed.imbalance_kg_m2 * slope / norm);
            Load {
                cause: Cause::Imbalance,
                order: n as u32,
                vector: turning(plate, n, &radial.collect::<Vec<_>>()),
            }
        }));
    }
    if let Some(force) = scene.oscillating_force() {
        let (order, amplitude_n) = (force.order, force.amplitude_n);
        loads.push(Load::at(
            Cause::OscillatingForce,
            order,
            plate,
            place,
            amplitude_n,
        ));
    }
    Ok(loads)
}

/// The vector of a wave with n nodal diameters that turns with the blade: Re (cos nθ − i sin nθ) e^{inΩt} = cos n(θ − Ωt).
fn turning(plate: &Plate, n: usize, radial: &[f64]) -> Col<c64> {
    let mut vector = Col::zeros(plate.degrees_of_freedom());
    let (cosine, size) = (plate.offset(n), radial.len());
    for (j, value) in radial.iter().enumerate() {
        vector[cosine + j] = c64::new(*value, 0.0);
        if n > 0 {
            vector[cosine + size + j] = c64::new(0.0, -value);
        }
    }
    vector
}

/// (K_b + K_m) q₀ of the softest shape with n nodal diameters, with an amplitude at the rim; `None` if this shape is a rigid
/// motion.
fn shape_load(plate: &Plate, n: usize, amplitude_m: f64) -> Option<Col<c64>> {
    let stiffness = plate.harmonics.get(n)?.body_frame_stiffness(0.0);
    let size = plate.basis.count();
    let of_blade = stiffness.get(..size, ..size);
    let SymmetricEigen { values, vectors } = SymmetricEigen::new(of_blade).ok()?;
    let (softest, stiffest) = (*values.first()?, *values.last()?);
    if softest <= RIGID * stiffest {
        return None;
    }
    let rim = plate.basis.evaluate(n, plate.blade.outer_radius_m).value;
    let shape = vectors.col(0);
    let at_rim: f64 = rim.iter().zip(0..).map(|(r, j)| r * shape[j]).sum();
    let scale = softest * amplitude_m * plate.angular_norm(n) / at_rim;
    let radial: Vec<f64> = (0..shape.nrows()).map(|j| scale * shape[j]).collect();
    Some(turning(plate, n, &radial))
}

/// The refusal of a run-out or of a lack of flatness that is a rigid motion of the blade.
fn rigid(waves: usize, scene: &Scene) -> RefusedValue {
    let excitation = scene.file().response.unwrap_or_default();
    let (key, value) = match waves {
        1 => ("response.runout_m", excitation.runout_m),
        _ => ("response.flatness_m", excitation.flatness_m),
    };
    let allowed = "0 for a blade that tilts freely on its arbor";
    let remedy =
        "such a blade has no run-out of its own; give flatness_m, or a mount with a collar";
    RefusedValue::new(key, value, allowed, remedy)
}
