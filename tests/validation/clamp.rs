//! Goal: a clamp that yields to a slope gives the frequencies of an independent computation, between a hinge and a rigid clamp.
//!
//! Source: Hermite cubics over the radius, 60 equal elements, with the moment k a R′(a) of the clamp at the edge; solid elements of
//! CalculiX agree with them to 3e-4.

use std::f64::consts::TAU;

use crate::common::{assert_close, scene};
use faer::Side;
use sawflutter::analyses::fit::{Measurement, Options, fit};
use sawflutter::model::plate::{Plate, Resolution};
use sawflutter::model::scene::{Accuracy, Freed, InPlane, Mount, Scene};

/// A blade of 400 mm in a collar of 100 mm.
fn saw(clamp_n_m_per_rad_per_m: Option<f64>) -> Scene {
    let saw = scene("collar-400mm").edited(|saw| {
        saw.blade.inner_diameter_m = 0.03;
        saw.mount = Mount::Collar {
            diameter_m: 0.1,
            in_plane: InPlane::Fixed,
            clamp_stiffness_n_m_per_rad_per_m: clamp_n_m_per_rad_per_m,
        };
    });
    saw.unwrap()
}

/// Lowest frequency at rest on n nodal diameters.
fn lowest_hz(saw: &Scene, n: usize) -> f64 {
    let plate = Plate::new(saw, Resolution::of(Accuracy::Reference));
    let stiffness = plate.harmonics[n].body_frame_stiffness(0.0);
    stiffness.self_adjoint_eigenvalues(Side::Lower).unwrap()[0].sqrt() / TAU
}

const AT_1E4: [f64; 5] = [67.3206, 62.9124, 87.8246, 173.0773, 299.6038];
const HINGED: [f64; 5] = [46.0307, 42.7302, 79.9598, 171.5123, 299.3365];
const RIGID: [f64; 5] = [79.9915, 76.8635, 97.3124, 176.1234, 300.3349];

#[test]
fn frequencies_at_rest_are_those_of_an_independent_computation() {
    for (clamp, expected) in [
        (Some(1e4), AT_1E4),
        (Some(0.0), HINGED),
        (None, RIGID),
        // The frequencies of a stiff clamp differ from those of a rigid one as D/(k (b − a)), a few 1e-6.
        (Some(1e9), RIGID),
    ] {
        for (n, hz) in expected.into_iter().enumerate() {
            assert_close(
                &format!("{clamp:?}, n = {n}"),
                lowest_hz(&saw(clamp), n),
                hz,
                1e-5,
            );
        }
    }
}

/// Between the limits every frequency rises with the stiffness.
#[test]
fn a_stiffer_clamp_raises_every_frequency() {
    let clamps = [0.0, 1.0, 1e2, 1e3, 1e4, 1e5, 1e6, 1e9];
    for n in 0..6 {
        let rising: Vec<f64> = clamps.map(|clamp| lowest_hz(&saw(Some(clamp)), n)).into();
        assert!(
            rising.is_sorted_by(|few, more| few < more),
            "{n}: {rising:?}"
        );
        assert!(rising[6] < lowest_hz(&saw(None), n), "{n}: {rising:?}");
    }
}

/// How loose is the collar? Taps of the first waves of the clamp of 1e4 N·m/(rad·m), from a scene that begins at 1e5.
#[test]
fn taps_tell_how_loose_a_collar_is() {
    let saw = saw(Some(1e5));
    let taps: Vec<String> = AT_1E4.iter().map(f64::to_string).collect();
    let table = format!("rpm,n0,n1,n2,n3,n4\n0,{}\n", taps.join(","));
    let measurement = Measurement::from_csv("taps", &table).unwrap();
    let path = "mount.clamp_stiffness_n_m_per_rad_per_m";
    let free = [Freed::new(saw.file(), path, 1e2, 1e7).unwrap()];
    let options = Options {
        starts: 3,
        ..Options::default()
    };
    let found = fit(&saw, &measurement, &free, &options, &|_, _| ()).unwrap();
    assert_close("clamp", found.parameters[0].value, 1e4, 2e-3);
}

#[test]
fn a_negative_clamp_is_refused() {
    let error = Scene::try_from({
        let mut file = saw(None).file().clone();
        let Mount::Collar {
            clamp_stiffness_n_m_per_rad_per_m: clamp,
            ..
        } = &mut file.mount
        else {
            unreachable!("the mount is a collar")
        };
        *clamp = Some(-1.0);
        file
    });
    let words = error.unwrap_err().to_string();
    assert!(
        words.contains("mount.clamp_stiffness_n_m_per_rad_per_m"),
        "{words}"
    );
    assert!(words.contains("N·m/(rad·m)"), "{words}");
}
