//! Goal: random saws obey the physical laws of every guided saw.
//!
//! Source: symmetry, similarity and energy arguments, each stated at its test; there is no comparison with other
//! computations. The random saws are the same in every run.

use std::f64::consts::TAU;

use crate::common::{in_units, relative_error};
use faer::{Mat, c64};
use proptest::prelude::*;
use sawflutter::model::plate::Plate;
use sawflutter::modes::ModeKind;

use crate::draws::*;

/// Random places and stiffnesses of pads that do not seem to be in another unit.
#[test]
fn no_number_of_a_drawn_saw_is_unusual() {
    check(2000, any_saw(), |file| {
        let told = file.unusual_numbers();
        prop_assert!(told.is_empty(), "{:?}", told);
        Ok(())
    });
}

/// G is skew, K(Ω) symmetric: nothing in the model creates or destroys energy.
#[test]
fn gyroscopic_forces_are_skew_and_stiffness_is_symmetric() {
    check(24, (any_saw(), 0.0..2.0_f64), |(file, share)| {
        let system = system(&file);
        prop_assert!(system.is_conservative());
        let stiffness = system.stiffness_at(share * first_critical(&file));
        let asymmetry = |m: &Mat<f64>, sign: f64| {
            (m - faer::Scale(sign) * m.transpose()).norm_max() / m.norm_max()
        };
        prop_assert!(system.gyroscopic.norm_max() > 0.0);
        prop_assert_eq!(asymmetry(&system.gyroscopic, -1.0), 0.0);
        let rounding = asymmetry(&stiffness, 1.0);
        prop_assert!(rounding <= 1e-14, "{}", rounding);
        Ok(())
    });
}

/// Time can be reversed: with λ also −λ̄ is an eigenvalue. Where two modes coalesce, eigenvalues are accurate to √ε
/// only; the random saws avoid this.
#[test]
fn eigenvalues_come_in_pairs_about_the_imaginary_axis() {
    check(24, (any_saw(), 0.0..2.0_f64), |(file, share)| {
        let lambdas = eigenvalues(&file, share * first_critical(&file));
        // The list has real eigenvalues of both signs, which mirror each other.
        let mirrored: Vec<c64> = lambdas.iter().map(|l| c64::new(-l.re, l.im)).collect();
        let off = distance(&lambdas, &mirrored);
        prop_assert!(off <= 1e-9, "{}", off);
        Ok(())
    });
}

/// A mirrored saw has its pads at −θ and rotates in the opposite direction; if time is reversed too, it rotates as
/// before. Without damping the mirrored and the reversed saw have the frequencies of the original.
#[test]
fn mirrored_pads_give_the_same_spectrum() {
    check(24, (any_saw(), 0.0..2.0_f64), |(file, share)| {
        let speed = share * first_critical(&file);
        let mut mirrored = file.clone();
        for pad in &mut mirrored.guides {
            pad.angle_deg = -pad.angle_deg;
        }
        let original = eigenvalues(&file, speed);
        let off = distance(&original, &eigenvalues(&mirrored, speed));
        prop_assert!(off <= 1e-9, "mirrored: {}", off);
        // The mirrored saw alone: the saw rotates in the opposite direction.
        let off_backwards = distance(&original, &eigenvalues(&file, -speed));
        prop_assert!(off_backwards <= 1e-9, "other way: {}", off_backwards);
        Ok(())
    });
}

/// Space has no preferred direction.
#[test]
fn turning_all_pads_together_changes_nothing() {
    let draw = (any_saw(), 0.0..2.0_f64, -180.0..180.0_f64);
    check(24, draw, |(file, share, turn_deg)| {
        let speed = share * first_critical(&file);
        let mut turned = file.clone();
        for pad in &mut turned.guides {
            pad.angle_deg += turn_deg;
        }
        let off = distance(&eigenvalues(&file, speed), &eigenvalues(&turned, speed));
        prop_assert!(off <= 1e-9, "{}", off);
        let critical = critical_rad_per_s(&file);
        for (before, after) in critical.iter().zip(critical_rad_per_s(&turned)).take(6) {
            prop_assert!(relative_error(after, *before) <= 1e-9);
        }
        Ok(())
    });
}

/// Three units are arbitrary: with lengths × L, masses × M and times × T, pressure is × M/LT², density × M/L³,
/// stiffness × M/T², and every λ × 1/T.
#[test]
fn units_do_not_matter() {
    // Larger factors exceed the allowed ranges of modulus and density.
    let factor = || (-0.3..0.3_f64).prop_map(|x| 10_f64.powf(x));
    let draw = (any_saw(), 0.0..2.0_f64, [factor(), factor(), factor()]);
    check(24, draw, |(file, share, [length, mass, time])| {
        let scaled = in_units(&file, [length, mass, time]);
        let speed = share * first_critical(&file);
        let back: Vec<c64> = eigenvalues(&scaled, speed / time)
            .into_iter()
            .map(|lambda| lambda * time)
            .collect();
        let off = distance(&eigenvalues(&file, speed), &back);
        prop_assert!(off <= 1e-9, "{}", off);
        let critical = critical_rad_per_s(&file);
        for (before, after) in critical.iter().zip(critical_rad_per_s(&scaled)).take(6) {
            prop_assert!(relative_error(after * time, *before) <= 1e-9);
        }
        Ok(())
    });
}

/// Below the first critical speed K(Ω) > 0, the energy of every motion is positive, and
/// without damping or follower forces nothing can grow.
#[test]
fn nothing_grows_below_the_first_critical_speed() {
    check(24, (any_saw(), 0.0..0.999_f64), |(file, share)| {
        let critical = first_critical(&file);
        let model = dense_model(&file, critical);
        for mode in model.all_modes(share * critical).unwrap() {
            // One pad can leave a rigid motion almost free: it is slow, but does not grow.
            prop_assert_eq!(mode.kind, ModeKind::Positive, "λ = {}", mode.lambda);
        }
        Ok(())
    });
}

/// Krein index: K(Ω) has as many negative eigenvalues as there are real λ > 0, plus twice the number of flutter pairs
/// and reflected waves. The left side comes from the stiffness matrix alone, the right side from the spectrum.
#[test]
fn the_krein_index_counts_every_unstable_and_reflected_mode() {
    let counted = std::cell::Cell::new([0_usize; 3]);
    check(24, (any_saw(), 0.9..2.0_f64), |(file, share)| {
        let speed = share * first_critical(&file);
        let stiffness = system(&file).stiffness_at(speed);
        let negative = stiffness
            .self_adjoint_eigenvalues(faer::Side::Lower)
            .unwrap()
            .iter()
            .filter(|value| **value < 0.0)
            .count();
        let modes = dense_model(&file, speed).all_modes(speed).unwrap();
        let count = |kind: ModeKind| modes.iter().filter(|mode| mode.kind == kind).count();
        let [real, flutter, reflected] = [
            count(ModeKind::Divergent),
            count(ModeKind::Flutter),
            count(ModeKind::Negative),
        ];
        prop_assert_eq!(flutter, count(ModeKind::Decaying));
        prop_assert_eq!(negative, real + 2 * flutter + 2 * reflected);
        let [r, f, n] = counted.get();
        counted.set([r + real, f + flutter, n + reflected]);
        Ok(())
    });
    // The random saws must include all three kinds.
    let met = counted.get();
    println!("divergent, flutter, reflected: {met:?}");
    assert!(met.iter().all(|count| *count > 0), "{met:?}");
}

/// The functions are orthonormal in mass, ρh ∫ φᵢφⱼ dA = 1, so that M is the identity and is not stored. The integral
/// uses Simpson's rule in θ and in r, which is independent of the basis.
#[test]
fn the_mass_matrix_is_one() {
    check(6, any_saw(), |file| {
        let plate = Plate::new(&scene(&file), SMALL);
        let (a, b) = (plate.blade.inner_radius_m, plate.blade.outer_radius_m);
        let (radii, angles) = (1000, 16);
        let size = plate.degrees_of_freedom();
        let mut mass: Mat<f64> = Mat::zeros(size, size);
        for i in 0..=radii {
            let r = a + (b - a) * f64::from(i) / f64::from(radii);
            let simpson = match i {
                0 => 1.0,
                i if i == radii => 1.0,
                i => 2.0 + 2.0 * f64::from(i % 2),
            };
            let ring = simpson * (b - a) / f64::from(3 * radii) * r * TAU / f64::from(angles);
            for k in 0..angles {
                let functions = plate.functions_at(r, TAU * f64::from(k) / f64::from(angles));
                let f = faer::Col::from_fn(size, |i| functions[i]);
                let weight = ring * plate.blade.mass_per_area_kg_per_m2();
                mass += faer::Scale(weight) * &f * f.transpose();
            }
        }
        let off = (mass - Mat::<f64>::identity(size, size)).norm_max();
        // Simpson's rule integrates polynomials of degree 9, or 13 with a collar, on 500 panels.
        prop_assert!(off <= 1e-5, "{}", off);
        Ok(())
    });
}
