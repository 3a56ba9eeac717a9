//! Integrals of guides, compared with sums over their areas.

use faer::Mat;

use super::*;
use crate::model::scene::{GuideFile, GuideShape, Scene};

fn plate_with(guides: &[GuideFile]) -> Plate {
    let scene = Scene::paper().edited(|saw| saw.guides = guides.to_vec());
    Plate::new(
        &scene.unwrap(),
        Resolution {
            max_diameters: 5,
            radial_functions: 4,
        },
    )
}

fn relative_distance(left: &Mat<f64>, right: &Mat<f64>) -> f64 {
    (left - right).norm_l2() / right.norm_l2()
}

/// The integral over a pad, by the midpoint rule over the rectangle.
#[test]
fn a_clipped_pad_equals_its_midpoint_sum() {
    let pad = GuideFile {
        radius_m: 0.32,
        angle_deg: -52.0,
        radial_length_m: 0.15,
        tangential_length_m: 0.30,
        stiffness_n_per_m: 2.0e7,
        ..GuideFile::default()
    };
    let plate = plate_with(std::slice::from_ref(&pad));
    let cells = 400;
    let mut sum: Mat<f64> = Mat::zeros(plate.degrees_of_freedom(), plate.degrees_of_freedom());
    let (dx, dy) = (0.15 / f64::from(cells), 0.30 / f64::from(cells));
    for i in 0..cells {
        for k in 0..cells {
            let x = 0.245 + (f64::from(i) + 0.5) * dx;
            let y = -0.15 + (f64::from(k) + 0.5) * dy;
            let (r, psi) = (x.hypot(y), y.atan2(x));
            if (plate.blade.inner_radius_m..=plate.blade.outer_radius_m).contains(&r) {
                let values = plate.functions_at(r, psi + pad.angle_deg.to_radians());
                let f = faer::Col::from_fn(values.len(), |i| values[i]);
                sum += faer::Scale(2.0e7 * dx * dy / (0.15 * 0.30)) * &f * f.transpose();
            }
        }
    }
    let distance = relative_distance(plate.contact.stiffness().unwrap(), &sum);
    // The rim crosses cells, so that the midpoint sum has an error of about one cell in 400².
    assert!(distance < 2e-4, "{distance}");
}

/// The integral over an ellipse on the blade, by the midpoint rule over ellipses of the same centre.
#[test]
fn a_round_pad_equals_its_midpoint_sum() {
    // The farthest points of the last pad from the axis lie beside its centre line.
    let pads = [(0.2, 0.10, 0.10), (0.2, 0.20, 0.08), (0.25, 0.06, 0.30)];
    for (radius_m, along, across) in pads {
        let pad = GuideFile {
            radius_m,
            angle_deg: -52.0,
            radial_length_m: along,
            tangential_length_m: across,
            shape: GuideShape::Round,
            stiffness_n_per_m: 2.0e7,
            ..GuideFile::default()
        };
        let plate = plate_with(std::slice::from_ref(&pad));
        let size = plate.degrees_of_freedom();
        let mut sum: Mat<f64> = Mat::zeros(size, size);
        let (rings, turns) = (400, 100);
        for ring in 0..rings {
            let share = (f64::from(ring) + 0.5) / f64::from(rings);
            let weight = 2.0 * share / f64::from(rings * turns);
            for turn in 0..turns {
                let (sin, cos) =
                    (std::f64::consts::TAU * f64::from(turn) / f64::from(turns)).sin_cos();
                let (x, y) = (
                    radius_m + 0.5 * along * share * cos,
                    0.5 * across * share * sin,
                );
                let values =
                    plate.functions_at(x.hypot(y), y.atan2(x) + pad.angle_deg.to_radians());
                let f = faer::Col::from_fn(values.len(), |i| values[i]);
                sum += faer::Scale(2.0e7 * weight) * &f * f.transpose();
            }
        }
        let distance = relative_distance(plate.contact.stiffness().unwrap(), &sum);
        assert!(distance < 2e-5, "{along} m by {across} m: {distance}");
    }
}

#[test]
fn a_pad_larger_than_the_blade_is_a_uniform_bed() {
    let pad = GuideFile {
        radius_m: 0.0,
        angle_deg: 20.0,
        radial_length_m: 2.0,
        tangential_length_m: 2.0,
        stiffness_n_per_m: 4.0e6,
        ..GuideFile::default()
    };
    let plate = plate_with(&[pad]);
    let per_mass = 1.0e6 / plate.blade.mass_per_area_kg_per_m2();
    let bed = faer::Scale(per_mass)
        * Mat::<f64>::identity(plate.degrees_of_freedom(), plate.degrees_of_freedom());
    let distance = relative_distance(plate.contact.stiffness().unwrap(), &bed);
    assert!(distance < 1e-12, "{distance}");
}

#[test]
fn a_small_pad_tends_to_a_point_spring() {
    let pad = |size: f64| GuideFile {
        radius_m: 0.2,
        angle_deg: 63.0,
        radial_length_m: size,
        tangential_length_m: size,
        stiffness_n_per_m: 1.0e6,
        ..GuideFile::default()
    };
    let point = plate_with(&[pad(0.0)]).contact.stiffness().unwrap().clone();
    let distance = |size| {
        relative_distance(
            plate_with(&[pad(size)]).contact.stiffness().unwrap(),
            &point,
        )
    };
    let (coarse, fine) = (distance(0.02), distance(0.01));
    let order = (coarse / fine).log2();
    assert!(
        (order - 2.0).abs() < 0.1,
        "second order in the size, not {order}"
    );
}

#[test]
fn a_plate_without_guides_is_axisymmetric_and_conservative() {
    let plate = plate_with(&[]);
    assert!(plate.is_axisymmetric() && plate.is_conservative());
}
