//! Blades whose pads lift off, compared with closed forms and with the linear pad as a limit.

use faer::Col;
use faer::linalg::solvers::Solve;

use super::*;
use crate::model::plate::Resolution;
use crate::model::scene::{
    ContactLaw, GuideFile, GuideSide, InPlane, Mount, Polar, Scene, rad_per_s,
};

const RESOLUTION: Resolution = Resolution {
    max_diameters: 8,
    radial_functions: 5,
};
const MODES: usize = 20;

fn plate(held: bool, change: impl FnOnce(&mut GuideFile)) -> Plate {
    let scene = Scene::paper().edited(|saw| {
        if held {
            saw.mount = Mount::Collar {
                diameter_m: 0.24,
                in_plane: InPlane::Fixed,
                clamp_stiffness_n_m_per_rad_per_m: None,
            };
        }
        change(&mut saw.guides[0]);
    });
    Plate::new(&scene.unwrap(), RESOLUTION)
}

fn lifting(pad: &mut GuideFile, gap_m: f64) {
    (pad.contact, pad.gap_m) = (ContactLaw::OneSided, Some(gap_m));
}

/// The deflection at the point at which a force acts.
fn deflection(plate: &Plate, force_n: f64, rpm: f64, place: Polar) -> f64 {
    let speed = rad_per_s(rpm);
    let blade = StretchedBlade::up_to(plate, speed, place, MODES)
        .unwrap()
        .pressed(force_n, place)
        .unwrap();
    let found = blade.settled(speed, &blade.flat()).unwrap();
    assert_eq!(found.negative_eigenvalues, 0);
    blade.deflection_m(&found, place.radius_m, place.angle_rad)
}

/// A blade in a collar under a force at a point pad behind a gap. With the compliance c of the blade alone,
/// from all its functions: w = Fc, and beyond the gap w = (F + kg)c/(1 + kc), on the side of the pad.
#[test]
fn a_force_presses_the_blade_on_its_pad_as_two_springs_say() {
    let place = Polar::new(0.3, 0.7);
    let (stiffness, gap_m) = (3e5, 2e-5);
    let bare = plate(true, |pad| pad.stiffness_n_per_m = 0.0);
    let functions = bare.functions_at(place.radius_m, place.angle_rad);
    let there = Col::from_fn(functions.len(), |i| functions[i]);
    let system = GyroscopicSystem::of_plate(&bare);
    let compliance = there.transpose() * system.stiffness.partial_piv_lu().solve(&there);
    let alone = 1e-6;
    assert!((deflection(&bare, alone, 0.0, place) / (alone * compliance) - 1.0).abs() < 1e-6);
    for side in [GuideSide::Both, GuideSide::Left, GuideSide::Right] {
        let plate = plate(true, |pad| {
            lifting(pad, gap_m);
            (pad.radius_m, pad.angle_deg) = (place.radius_m, place.angle_rad.to_degrees());
            (pad.radial_length_m, pad.tangential_length_m) = (0.0, 0.0);
            (pad.stiffness_n_per_m, pad.side) = (stiffness, side);
        });
        for share in [-4.0, -2.0, -0.5, 0.5, 2.0, 4.0_f64] {
            let force = share * gap_m / compliance;
            let is_there = match side {
                GuideSide::Both => true,
                GuideSide::Left => force > 0.0,
                GuideSide::Right => force < 0.0,
            };
            let expected = if is_there && share.abs() > 1.0 {
                let pressed = force.abs() + stiffness * gap_m;
                force.signum() * pressed * compliance / (1.0 + stiffness * compliance)
            } else {
                force * compliance
            };
            let found = deflection(&plate, force, 0.0, place);
            // A deflection of up to 80 µm causes little stretching.
            let error = found / expected - 1.0;
            assert!(
                error.abs() < 2e-3,
                "{side:?} {share}: {found:e} {expected:e}"
            );
        }
    }
}

/// With a gap of zero on both sides the pad is the linear one, and so it is with a film as stiff as the pad;
/// a gap that the blade does not cross has no effect.
#[test]
fn limits_of_the_gap_are_the_linear_pad_and_none() {
    let place = Polar::new(0.355, 0.0);
    let linear = deflection(&plate(false, |_| ()), 5.0, 1000.0, place);
    let no_gap = plate(false, |pad| lifting(pad, 1e-10));
    let found = deflection(&no_gap, 5.0, 1000.0, place);
    assert!((found / linear - 1.0).abs() < 2e-3, "{found:e} {linear:e}");
    let filled = plate(false, |pad| {
        lifting(pad, 4e-5);
        pad.film_stiffness_n_per_m = pad.stiffness_n_per_m;
    });
    // This blade has more shapes.
    let full = deflection(&filled, 5.0, 1000.0, place);
    assert!((full / linear - 1.0).abs() < 2e-3, "{full:e} {linear:e}");
    let bare = deflection(
        &plate(true, |pad| pad.stiffness_n_per_m = 0.0),
        5.0,
        500.0,
        place,
    );
    let far = deflection(&plate(true, |pad| lifting(pad, 0.5)), 5.0, 500.0, place);
    assert!((far / bare - 1.0).abs() < 1e-4, "{far:e} {bare:e}");
}

/// With a wider gap the deflection is larger, and the force of the pad equals the side force.
#[test]
fn one_pad_carries_the_whole_side_force() {
    let place = Polar::new(0.355, 0.0);
    let mut last = 0.0;
    for gap_m in [1e-5, 4e-5, 1.6e-4] {
        let plate = plate(false, |pad| lifting(pad, gap_m));
        let blade = StretchedBlade::up_to(&plate, 0.0, place, MODES)
            .unwrap()
            .pressed(-5.0, place)
            .unwrap();
        let found = blade.settled(0.0, &blade.flat()).unwrap();
        let force = blade.pad_forces_n(&found);
        assert!((force[0] - 5.0).abs() < 1e-6, "{force:?}");
        let size = blade
            .deflection_m(&found, place.radius_m, place.angle_rad)
            .abs();
        assert!(size > last + 0.5e-5, "{gap_m}: {size:e} {last:e}");
        last = size;
    }
}

#[test]
fn a_blade_that_nothing_holds_within_its_gaps_is_refused() {
    let place = Polar::new(0.355, 0.0);
    let free = plate(false, |pad| lifting(pad, 4e-5));
    let blade = StretchedBlade::up_to(&free, 0.0, place, MODES).unwrap();
    let loose = blade.settled(0.0, &blade.flat());
    assert!(matches!(loose, Err(StretchedError::Loose)), "{loose:?}");
    let film = plate(false, |pad| {
        lifting(pad, 4e-5);
        pad.film_stiffness_n_per_m = 1e4;
    });
    let filmed = StretchedBlade::up_to(&film, 0.0, place, MODES).unwrap();
    assert!(filmed.settled(0.0, &filmed.flat()).is_ok());
    let right = plate(false, |pad| {
        lifting(pad, 4e-5);
        pad.side = GuideSide::Right;
    });
    let held = StretchedBlade::up_to(&right, 0.0, place, MODES).unwrap();
    let pushed = held.pressed(5.0, place).unwrap();
    let away = pushed.settled(0.0, &pushed.flat());
    assert!(
        matches!(away, Err(StretchedError::Escapes { .. })),
        "{away:?}"
    );
}
