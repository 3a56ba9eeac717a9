//! A contact that the library does not have: a follower load, added to a scene by the trait that every contact
//! implements.

use std::f64::consts::PI;

use faer::{Col, Mat, Scale};
use sawflutter::model::plate::{Contact, ContactTerms, Plate, Resolution};
use sawflutter::model::scene::{GuideFile, SpeedRange};
use sawflutter::model::system::GyroscopicSystem;
use sawflutter::modes::{ModeKind, SpectralModel, Strategy, fastest_growing};

/// A force P at a point of the blade, along the circumference of the deflected blade: its
/// transverse component is P ∂w/(r ∂θ), so that K_n = −P φ (∂φ/∂θ)ᵀ / r.
struct FollowerForce {
    radius_m: f64,
    angle_rad: f64,
    force_n: f64,
}

impl Contact for FollowerForce {
    fn add_to(&self, plate: &Plate, terms: &mut ContactTerms) {
        let values = plate.functions_at(self.radius_m, self.angle_rad);
        let radial = plate.radial_functions();
        let mut slopes = vec![0.0; values.len()];
        for n in 1..=plate.max_diameters() {
            for cosine in plate.offset(n)..plate.offset(n) + radial {
                let sine = cosine + radial;
                slopes[cosine] = -(n as f64) * values[sine];
                slopes[sine] = n as f64 * values[cosine];
            }
        }
        let column = |values: &[f64]| Col::from_fn(values.len(), |i| values[i]);
        let (values, slopes) = (column(&values), column(&slopes));
        let term = Scale(-self.force_n / self.radius_m) * &values * slopes.transpose();
        terms.add_nonconservative_stiffness(&term);
    }
}

const RADIUS_M: f64 = 0.16;
/// The angle at which two nodal diameters are excited most: sin 4β = 1.
const ANGLE_RAD: f64 = PI / 8.0;

/// The blade between collars, on a point spring at the angle 0, with waves of at most two
/// diameters.
fn sprung(stiffness_n_per_m: f64) -> Plate {
    let scene = crate::common::scene("collar-400mm").edited(|saw| {
        saw.guides = vec![GuideFile {
            radius_m: RADIUS_M,
            angle_deg: 0.0,
            radial_length_m: 0.0,
            tangential_length_m: 0.0,
            stiffness_n_per_m,
            damping_n_s_per_m: 0.0,
            ..GuideFile::default()
        }];
    });
    let resolution = Resolution {
        max_diameters: 2,
        radial_functions: 5,
    };
    Plate::new(&scene.unwrap(), resolution)
}

fn loaded(plate: &Plate, force_n: f64) -> Plate {
    plate.with_contact(&FollowerForce {
        radius_m: RADIUS_M,
        angle_rad: ANGLE_RAD,
        force_n,
    })
}

/// The smallest force against the rotation that makes the blade at rest flutter. The square of the growth is that of
/// the discriminant, linear in the force: two forces give its zero, where eigenvalues themselves are accurate to half
/// their digits.
fn onset_n(plate: &Plate, about_n: f64) -> f64 {
    let squared_growth = |force_n: f64| {
        let system = GyroscopicSystem::of_plate(&loaded(plate, -force_n));
        let fastest = fastest_growing(&system, 0.0).unwrap();
        fastest.map_or(0.0, |lambda| lambda.re.max(0.0).powi(2))
    };
    assert!(
        squared_growth(0.9 * about_n) < 1e-8,
        "grows below the onset"
    );
    let forces_n = [1.1, 1.2].map(|share| share * about_n);
    let [near, far] = forces_n.map(squared_growth);
    assert!(near > 0.0 && far > near);
    forces_n[0] - near * (forces_n[1] - forces_n[0]) / (far - near)
}

/// A spring k at the angle 0 splits the two waves of n diameters by κ; a follower force P at β, at the same radius r,
/// couples them by a matrix of rank one. The discriminant of the two is zero at P = −k r / (2n sin 2nβ), for any mode.
/// Other modes change this by a share proportional to k: with a tenth of k, the difference is a tenth.
#[test]
fn a_follower_load_flutters_where_two_waves_of_equal_diameters_coalesce() {
    let differences = [3000.0, 300.0].map(|stiffness_n_per_m| {
        let expected_n = stiffness_n_per_m * RADIUS_M / 4.0;
        onset_n(&sprung(stiffness_n_per_m), expected_n) / expected_n - 1.0
    });
    println!("relative differences {differences:?}");
    assert!(differences[0].abs() < 1e-2, "{differences:?}");
    let ratio = differences[0] / differences[1];
    assert!((ratio - 10.0).abs() < 0.5, "{ratio}");
}

#[test]
fn a_follower_load_is_neither_symmetrised_nor_called_conservative() {
    let unloaded = sprung(1e5);
    assert!(unloaded.is_conservative());
    let plate = loaded(&unloaded, -100.0);
    assert!(!plate.is_conservative());
    let system = GyroscopicSystem::of_plate(&plate);
    assert!(!system.is_conservative());
    let term = system.nonconservative.as_ref().unwrap();
    let asymmetry = |m: &Mat<f64>| (m - m.transpose()).norm_l2() / m.norm_l2();
    assert!(asymmetry(term) > 0.5);
    // The term is absent on fewer vectors and in K(Ω) too.
    let order = system.order();
    let basis = Mat::from_fn(order, order, |i, k| if i == k { 1.0 } else { 0.0 });
    let projected = system.project(basis.as_ref());
    assert_eq!(projected.nonconservative.as_ref().unwrap(), term);
    let change = system.stiffness_at(10.0) - system.conservative().stiffness_at(10.0);
    assert!((&change - term).norm_l2() < 1e-9 * system.stiffness.norm_l2());
    let model = SpectralModel::new(plate, SpeedRange::new(0.0, 10.0), Strategy::Reduced).unwrap();
    let modes = model.modes(5.0).unwrap();
    assert!(modes.iter().all(|mode| mode.kind == ModeKind::Damped));
    assert!(modes.iter().all(|mode| mode.krein_sign() == 0));
}

/// A matrix without symmetry that is added as a stiffness keeps its nonconservative part.
#[test]
fn a_stiffness_without_symmetry_is_not_symmetrised_by_accident() {
    struct Coupled;
    impl Contact for Coupled {
        fn add_to(&self, plate: &Plate, terms: &mut ContactTerms) {
            let order = plate.degrees_of_freedom();
            let entry = |i, k| if (i, k) == (0, 1) { 2e3 } else { 0.0 };
            terms.add_stiffness(&Mat::from_fn(order, order, entry));
        }
    }
    let plate = sprung(1e5);
    let before = GyroscopicSystem::of_plate(&plate).stiffness_at(0.0);
    let touched = plate.with_contact(&Coupled);
    assert!(!touched.is_conservative());
    let change = GyroscopicSystem::of_plate(&touched).stiffness_at(0.0) - before;
    let rounding = 1e-9 * change.norm_max();
    assert!((change[(0, 1)] - 2e3).abs() < rounding && change[(1, 0)].abs() < rounding);
}
