//! Forces of stretching and of pads that lift off in a time history: −∂U₄/∂q and −∂V/∂q.

use faer::{Col, Mat, Scale};

use crate::model::plate::{GapPotential, Plate, ReducedStretching};
use crate::model::system::GyroscopicSystem;
use crate::motion::stretched_blade::StretchedBlade;

use super::Force;

/// The forces of a blade that depend on its deflection.
pub(crate) fn forces(blade: &StretchedBlade) -> Vec<&dyn Force> {
    let gaps = blade.gaps().map(|gaps| gaps as &dyn Force);
    std::iter::once(blade.stretching() as &dyn Force)
        .chain(gaps)
        .collect()
}

/// The linear terms of a plate on the shapes of the blade, including damping, without the stiffness of pads
/// beyond their gaps.
pub(crate) fn system(plate: &Plate, blade: &StretchedBlade) -> GyroscopicSystem {
    let released = GyroscopicSystem::of_released(plate);
    let system = released.unwrap_or_else(|| GyroscopicSystem::of_plate(plate));
    system.project(blade.shapes())
}

impl Force for ReducedStretching {
    fn add_to(&self, displacement: &Col<f64>, force: &mut Col<f64>) {
        match self.gradient(displacement) {
            Ok(gradient) => *force -= gradient,
            // A deflection in another basis makes the force NaN, so that the time step fails.
            Err(_) => force.fill(f64::NAN),
        }
    }

    fn add_stiffness(&self, displacement: &Col<f64>, stiffness: &mut Mat<f64>) {
        if let Ok(hessian) = self.hessian(displacement) {
            *stiffness += hessian;
        }
    }

    fn forces_at(&self, displacements: &Mat<f64>) -> Mat<f64> {
        match self.gradients(displacements) {
            Ok(gradients) => Scale(-1.0) * gradients,
            Err(_) => Mat::full(displacements.nrows(), displacements.ncols(), f64::NAN),
        }
    }

    fn stiffness_sums(&self, displacements: &Mat<f64>, weights: &Mat<f64>) -> Mat<f64> {
        let order = displacements.nrows();
        let sums = self.hessian_sums(displacements, weights);
        sums.unwrap_or_else(|_| Mat::zeros(order * order, weights.ncols()))
    }
}

impl Force for GapPotential {
    fn add_to(&self, displacement: &Col<f64>, force: &mut Col<f64>) {
        *force -= self.gradient(displacement);
    }

    fn add_stiffness(&self, displacement: &Col<f64>, stiffness: &mut Mat<f64>) {
        *stiffness += self.hessian(displacement);
    }

    fn forces_at(&self, displacements: &Mat<f64>) -> Mat<f64> {
        Scale(-1.0) * self.gradients(displacements)
    }

    fn stiffness_sums(&self, displacements: &Mat<f64>, weights: &Mat<f64>) -> Mat<f64> {
        self.hessian_sums(displacements, weights)
    }

    /// Gauss points of the line would not give the exact mean where a pad begins to touch.
    fn add_mean_to(&self, displacement: &Col<f64>, change: &Col<f64>, force: &mut Col<f64>) {
        *force -= self.mean_gradient(displacement, change);
    }

    fn add_mean_stiffness(
        &self,
        displacement: &Col<f64>,
        change: &Col<f64>,
        stiffness: &mut Mat<f64>,
    ) {
        *stiffness += self.mean_stiffness(displacement, change);
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use faer::Side;

    use super::*;
    use crate::model::plate::{Plate, Resolution, Stretching};
    use crate::model::scene::{ContactLaw, GuideFile, GuideSide, Scene, rad_per_s};
    use crate::model::system::GyroscopicSystem;
    use crate::motion::transient::{Integrator, Newmark, State};

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
        let modes = plate.harmonics[n]
            .body_frame_stiffness(speed)
            .self_adjoint_eigen(Side::Lower)
            .unwrap();
        let size = plate.basis.count();
        let mut shapes: Mat<f64> = Mat::zeros(plate.degrees_of_freedom(), 2);
        for j in 0..size {
            shapes[(plate.offset(n) + j, 0)] = modes.U()[(j, 0)];
            shapes[(plate.offset(n) + size + j, 1)] = modes.U()[(j, 0)];
        }
        let full = Stretching::new(&plate).unwrap();
        let stretching = ReducedStretching::new(&full, shapes.as_ref()).unwrap();
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

    /// A guided blade without damping deflects by several thicknesses.
    #[test]
    fn a_large_motion_keeps_its_energy() {
        let plate = Plate::new(&Scene::paper(), SMALL).conservative();
        let full = GyroscopicSystem::of_plate(&plate);
        let modes = full.stiffness.self_adjoint_eigen(Side::Lower).unwrap();
        let shapes = modes.U().subcols(0, 10);
        let full_stretching = Stretching::new(&plate).unwrap();
        let stretching = ReducedStretching::new(&full_stretching, shapes).unwrap();
        let system = full.project(shapes);
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

    /// The built-in saw with point pads in place of its own.
    fn on_points(change: impl FnOnce(&mut GuideFile)) -> Plate {
        let scene = Scene::paper().edited(|saw| {
            saw.cut = None;
            let pad = &mut saw.guides[0];
            (pad.radial_length_m, pad.tangential_length_m) = (0.0, 0.0);
            (pad.contact, pad.gap_m) = (ContactLaw::OneSided, Some(1e-3));
            change(pad);
        });
        Plate::new(&scene.unwrap(), SMALL).conservative()
    }

    /// Period of the blade as a rigid body that only heaves. It starts at zero deflection with 0.3 m/s, and the
    /// period ends when it passes zero again in the same direction. The energy is checked at every step.
    fn heaving_period_s(plate: &Plate, steps_in_s: f64) -> f64 {
        let order = plate.degrees_of_freedom();
        let heave = Mat::from_fn(order, 1, |i, _| if i == 0 { 1.0 } else { 0.0 });
        let released = GyroscopicSystem::of_released(plate).unwrap();
        let system = released.project(heave.as_ref());
        let gaps = GapPotential::new(plate, heave.as_ref()).unwrap();
        let forces: [&dyn Force; 1] = [&gaps];
        let newmark = Newmark::new(&system, (0.0, 0.0), &[], steps_in_s).with_forces(&forces);
        let speed = 0.3 * plate.blade.mass_kg().sqrt();
        let mut state = State {
            displacement: Col::zeros(1),
            velocity: Col::full(1, speed),
        };
        let film = system.stiffness[(0, 0)];
        let energy = |state: &State| {
            let (q, v) = (state.displacement[0], state.velocity[0]);
            0.5 * (v * v + film * q * q) + gaps.energy_j(&state.displacement)
        };
        let begun = energy(&state);
        for step in 1.. {
            let before = state.displacement[0];
            state = newmark.step(&state, [&[], &[]]).unwrap();
            let lost = energy(&state) / begun - 1.0;
            assert!(lost.abs() < 1e-10, "{step}: {lost:e}");
            let after = state.displacement[0];
            if step > 1 && before < 0.0 && after >= 0.0 {
                return steps_in_s * (f64::from(step) - after / (after - before));
            }
        }
        f64::NAN
    }

    /// Between two stops the blade crosses the gap four times at its speed v, and is in contact with each
    /// stop for half a period of the spring: T = 4g/v + 2π√(m/k).
    #[test]
    fn a_blade_between_stops_keeps_its_energy_and_its_period() {
        let plate = on_points(|_| ());
        let mass = plate.blade.mass_kg();
        let expected = 4.0 * 1e-3 / 0.3 + TAU * (mass / 2e7).sqrt();
        let error = |steps: f64| heaving_period_s(&plate, expected / steps) / expected - 1.0;
        let (coarse, fine) = (error(500.0), error(4000.0));
        assert!(fine.abs() < 1e-3, "{fine:e} {coarse:e}");
        assert!(coarse.abs() < 2e-2, "{fine:e} {coarse:e}");
    }

    /// A pad on one side with almost no gap, and a film on both sides, make a bilinear oscillator with the period
    /// π√(m/k) + π√(m/k_f) (S. W. Shaw & P. J. Holmes, *A periodically forced piecewise linear oscillator*, J. Sound
    /// Vib. 90 (1983), 129–155).
    #[test]
    fn a_pad_on_one_side_makes_a_bilinear_oscillator() {
        for side in [GuideSide::Left, GuideSide::Right] {
            let plate = on_points(|pad| {
                (pad.side, pad.gap_m) = (side, Some(1e-9));
                pad.film_stiffness_n_per_m = 5e6;
            });
            let mass = plate.blade.mass_kg();
            let expected = 0.5 * TAU * ((mass / 2e7).sqrt() + (mass / 5e6).sqrt());
            let error = |steps: f64| heaving_period_s(&plate, expected / steps) / expected - 1.0;
            let (coarse, fine) = (error(250.0), error(2000.0));
            assert!(fine.abs() < 1e-5, "{fine:e} {coarse:e}");
            assert!(coarse.abs() < 1e-3, "{fine:e} {coarse:e}");
        }
    }

    /// A rotating blade of many modes that touches its pad again and again conserves its energy.
    #[test]
    fn a_blade_that_rattles_keeps_its_energy() {
        let scene = Scene::paper().edited(|saw| {
            let pad = &mut saw.guides[0];
            (pad.contact, pad.gap_m) = (ContactLaw::OneSided, Some(5e-5));
        });
        let plate = Plate::new(&scene.unwrap(), SMALL).conservative();
        let blade = StretchedBlade::new(&plate, 10).unwrap();
        let system = system(&plate, &blade);
        let forces = forces(&blade);
        let speed = rad_per_s(1200.0);
        let newmark = Newmark::new(&system, (speed, 0.0), &[], 1e-4).with_forces(&forces);
        let energy = |state: &State| {
            let moving = 0.5 * state.velocity.squared_norm_l2();
            moving + blade.potential_j(&state.displacement, speed).unwrap()
        };
        let mut state = State::rest(blade.shapes().ncols());
        for (k, v) in state.velocity.iter_mut().enumerate() {
            *v = 0.1 / (1.0 + k as f64);
        }
        let begun = energy(&state);
        let mut touched = 0;
        for _ in 0..2000 {
            state = newmark.step(&state, [&[], &[]]).unwrap();
            let lost = energy(&state) / begun - 1.0;
            assert!(lost.abs() < 1e-8, "{lost:e}");
            touched += usize::from(blade.gaps().unwrap().energy_j(&state.displacement) > 0.0);
        }
        assert!((100..1900).contains(&touched), "{touched}");
    }
}
