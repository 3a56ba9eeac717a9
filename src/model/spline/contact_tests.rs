//! Statics and invariants of the contacts.

use std::f64::consts::TAU;

use nalgebra::Vector3;
use proptest::prelude::*;

use super::tests::scene_with;
use super::*;
use crate::model::analytical::oscillator::approach_m;

/// A flank under a normal force moves by the gap and (F/K)^{2/3}.
#[test]
fn one_tooth_is_pressed_in_by_the_closed_form() {
    let scene = scene_with(|spline| {
        spline.teeth = 1;
        spline.pressure_angle_deg = 0.0;
    });
    let contact = Contact::new(scene.spline().unwrap(), scene.blade());
    for force in [1e-3, 78.0, 4000.0] {
        // The force at θ = 0 points along −y, with a torque that moves its line of action to the tooth.
        let seat = contact.seat(Vector3::new(0.0, -force, -force)).unwrap();
        let pressed_in = -(seat.y + seat.z) - 0.25e-3;
        let exact = approach_m(force, 6.96e9);
        assert!(
            (pressed_in / exact - 1.0).abs() < 1e-8,
            "{pressed_in} {exact}"
        );
    }
    assert_eq!(
        contact.seat(Vector3::new(1.0, 0.0, 0.0)),
        None,
        "no flank there"
    );
}

/// By symmetry a push towards a tooth moves the blade in this direction only: the single unknown is found by
/// bisection.
#[test]
fn many_teeth_share_a_push_as_the_static_balance_says() {
    for (teeth, degrees) in [(4, 45.0), (20, 0.0), (20, 30.0), (30, 14.5)] {
        for clearance_m in [0.0, 0.25e-3] {
            let scene = scene_with(|spline| {
                spline.teeth = teeth;
                spline.pressure_angle_deg = degrees;
                spline.clearance_m = clearance_m;
            });
            let contact = Contact::new(scene.spline().unwrap(), scene.blade());
            let (sin, cos) = f64::to_radians(degrees).sin_cos();
            let resistance = |x: f64| {
                let mut sum = 0.0;
                for k in 0..teeth {
                    let angle = TAU * k as f64 / teeth as f64;
                    for side in [1.0, -1.0] {
                        let along_x = sin * angle.cos() - side * cos * angle.sin();
                        let approach = -along_x * x - clearance_m;
                        sum -= 6.96e9 * approach.max(0.0).powf(1.5) * along_x;
                    }
                }
                sum
            };
            let force = 4300.0;
            let (mut low, mut high) = (0.0, 0.1);
            for _ in 0..200 {
                let middle = 0.5 * (low + high);
                if resistance(middle) < force {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            let seat = contact.seat(Vector3::new(force, 0.0, 0.0)).unwrap();
            assert!((seat.x / low - 1.0).abs() < 1e-10, "{seat} {low}");
            assert!(seat.y.abs() + seat.z.abs() < 1e-9 * low, "{seat}");
        }
    }
}

proptest! {
    #[test]
    fn a_contact_never_pulls(
        approach in -1e-3..1e-3_f64,
        speed in -10.0..10.0_f64,
        stiffness in 1e3..1e12_f64,
        damping in 0.0..1e8_f64,
    ) {
        let scene = scene_with(|spline| {
            spline.contact_stiffness_n_per_m_3_2 = stiffness;
            spline.contact_damping_n_s_3_2_per_m_3_2 = damping;
        });
        let contact = Contact::new(scene.spline().unwrap(), scene.blade());
        let [force, elastic] = contact.force(approach, speed);
        prop_assert!(force >= 0.0 && elastic >= 0.0);
        prop_assert!(approach > 0.0 || force == 0.0);
        prop_assert!((force - elastic) * speed >= 0.0, "damping never drives");
    }

    #[test]
    fn no_displacement_makes_a_flank_pull(
        q in prop::array::uniform3(-2e-3..2e-3_f64),
        speed in prop::array::uniform3(-5.0..5.0_f64),
    ) {
        let scene = scene_with(|_| ());
        let contact = Contact::new(scene.spline().unwrap(), scene.blade());
        for touch in contact.touches(q.into(), speed.into()) {
            let [radial, _] = touch.radial_and_tangential_n();
            prop_assert!(touch.force_n >= 0.0 && radial >= 0.0);
            prop_assert!(touch.approach_m > 0.0);
        }
    }

    /// The elastic forces are the derivative of the energy.
    #[test]
    fn forces_follow_from_the_energy(q in prop::array::uniform3(-2e-3..2e-3_f64)) {
        let scene = scene_with(|_| ());
        let contact = Contact::new(scene.spline().unwrap(), scene.blade());
        let q = Vector3::from(q);
        let force: Vector3<f64> = contact
            .touches(q, Vector3::zeros())
            .map(|touch| touch.normal * touch.elastic_n)
            .sum();
        let step = 1e-8;
        for axis in 0..3 {
            let mut d = Vector3::zeros();
            d[axis] = step;
            let slope = (contact.energy_j(q + d) - contact.energy_j(q - d)) / (2.0 * step);
            prop_assert!((slope + force[axis]).abs() < 1e-4 * (force.norm() + 1.0));
        }
    }
}
