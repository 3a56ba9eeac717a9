//! Stretching as a force in a time history: −∂U₄/∂q.

use faer::{Col, Mat};

use crate::plate::ReducedStretching;

use super::Force;

impl Force for ReducedStretching {
    fn add_to(&self, displacement: &Col<f64>, force: &mut Col<f64>) {
        match self.gradient(displacement) {
            Ok(gradient) => *force -= gradient,
            // A deflection of another basis gives NaN, which no step can balance.
            Err(_) => force.fill(f64::NAN),
        }
    }

    fn add_stiffness(&self, displacement: &Col<f64>, stiffness: &mut Mat<f64>) {
        if let Ok(hessian) = self.hessian(displacement) {
            *stiffness += hessian;
        }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use faer::Side;

    use super::*;
    use crate::plate::{Plate, Resolution, Stretching};
    use crate::scene::{Scene, rad_per_s};
    use crate::system::GyroscopicSystem;
    use crate::transient::{Integrator, Newmark, State};

    const SMALL: Resolution = Resolution {
        max_diameters: 4,
        radial_functions: 4,
    };

    /// A single travelling wave of a free blade is rigid in a frame that turns with it. For one mode of n
    /// diameters this frame turns at nΩ + ω in space, ω² = ω_n²(Ω) + gA², U₄ = gA⁴/4.
    #[test]
    fn a_large_wave_of_a_free_blade_travels_as_the_closed_form_says() {
        let scene = Scene::paper().edited(|saw| {
            saw.guides.clear();
            saw.cut = None;
        });
        let plate = Plate::new(&scene.unwrap(), SMALL);
        let (speed, n) = (rad_per_s(1800.0), 2);
        let modes = plate.harmonics[n].body_frame_stiffness(speed);
        let modes = modes.self_adjoint_eigen(Side::Lower).unwrap();
        let size = plate.basis.count();
        let mut shapes: Mat<f64> = Mat::zeros(plate.degrees_of_freedom(), 2);
        for j in 0..size {
            shapes[(plate.offset(n) + j, 0)] = modes.U()[(j, 0)];
            shapes[(plate.offset(n) + size + j, 1)] = modes.U()[(j, 0)];
        }
        let stretching = Stretching::new(&plate).unwrap();
        let stretching = ReducedStretching::new(&stretching, shapes.as_ref()).unwrap();
        let system = GyroscopicSystem::of_plate(&plate).project(shapes.as_ref());
        let unit = Col::from_fn(2, |k| if k == 0 { 1.0 } else { 0.0 });
        let cubic = 4.0 * stretching.energy_j(&unit).unwrap();
        // At this amplitude stretching contributes as much stiffness as bending and rotation.
        let amplitude = (modes.S()[0] / cubic).sqrt();
        let omega = n as f64 * speed + (2.0 * modes.S()[0]).sqrt();
        let forces: [&dyn Force; 1] = [&stretching];
        let distance = |steps: u32| {
            let step_s = TAU / omega / f64::from(steps);
            let newmark = Newmark::new(&system, (speed, 0.0), &[], step_s).with_forces(&forces);
            let begun = State {
                displacement: Col::from_fn(2, |k| if k == 0 { amplitude } else { 0.0 }),
                velocity: Col::from_fn(2, |k| if k == 0 { 0.0 } else { amplitude * omega }),
            };
            let mut state = begun.clone();
            for _ in 0..steps {
                state = newmark.step(&state, [&[], &[]]).unwrap();
            }
            (state.displacement - begun.displacement).norm_l2() / amplitude
        };
        let (coarse, fine) = (distance(250), distance(500));
        let order = (coarse / fine).log2();
        assert!((order - 2.0).abs() < 0.05, "{order}: {coarse:e} {fine:e}");
        assert!(
            (4.0 * fine - coarse).abs() < 1e-2 * coarse,
            "{coarse:e} {fine:e}"
        );
    }

    /// A guided blade without damping that deflects by several thicknesses.
    #[test]
    fn a_large_motion_keeps_its_energy() {
        let plate = Plate::new(&Scene::paper(), SMALL).conservative();
        let system = GyroscopicSystem::of_plate(&plate);
        let modes = system.stiffness.self_adjoint_eigen(Side::Lower).unwrap();
        let shapes = modes.U().subcols(0, 10);
        let stretching = Stretching::new(&plate).unwrap();
        let stretching = ReducedStretching::new(&stretching, shapes).unwrap();
        let system = system.project(shapes);
        let speed = rad_per_s(2300.0);
        let forces: [&dyn Force; 1] = [&stretching];
        let newmark = Newmark::new(&system, (speed, 0.0), &[], 1e-3).with_forces(&forces);
        let energy = |state: &State| {
            let (q, v) = (&state.displacement, &state.velocity);
            let linear = q.transpose() * system.stiffness_at(speed) * q;
            0.5 * (v.transpose() * v + linear) + stretching.energy_j(q).unwrap()
        };
        let mut state = State::still(Col::from_fn(10, |k| 0.02 / (1.0 + k as f64)));
        let stretched = stretching.energy_j(&state.displacement).unwrap();
        let before = energy(&state);
        assert!(stretched > 0.1 * before.abs(), "{stretched} {before}");
        for _ in 0..500 {
            state = newmark.step(&state, [&[], &[]]).unwrap();
        }
        let change = (energy(&state) - before) / stretched;
        assert!(change.abs() < 1e-10, "{change:e}");
    }
}
