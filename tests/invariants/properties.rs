//! Goal: what physics says of every guided saw holds for saws drawn at random.
//!
//! Source: symmetry, similarity and energy arguments, each stated at its test; nothing
//! here is compared with numbers from elsewhere. The draws are the same in every run.

use std::f64::consts::TAU;

use crate::common::relative_error;
use faer::{Mat, c64};
use proptest::prelude::*;
use proptest::test_runner::{Config, FileFailurePersistence, RngAlgorithm, TestRng, TestRunner};
use sawflutter::campbell::{Campbell, even_speeds, sample};
use sawflutter::plate::{Plate, Resolution};
use sawflutter::report::Report;
use sawflutter::scene::{Accuracy, GuideFile, InPlane, Mount, Scene, SceneFile, SweepFile};
use sawflutter::spectrum::{ModeKind, SpectralModel, Strategy as Solver, companion_eigenpairs};
use sawflutter::stability::{Analysis, InstabilityKind, chart, undamped_bands};
use sawflutter::system::GyroscopicSystem;

/// Small enough that every eigenvalue can be computed: 65 unknowns.
const SMALL: Resolution = Resolution {
    max_diameters: 6,
    radial_functions: 5,
};

/// Seeds of failures, kept in the repository.
const REGRESSIONS: &str = "tests/invariants/properties.proptest-regressions";

/// Checks a property of `cases` random values, the same ones in every run.
fn check<S: Strategy>(
    cases: u32,
    strategy: S,
    property: impl Fn(S::Value) -> Result<(), TestCaseError>,
) {
    let config = Config {
        cases,
        // A failure found once is tried first in every later run.
        failure_persistence: Some(Box::new(FileFailurePersistence::Direct(REGRESSIONS))),
        ..Config::default()
    };
    let rng = TestRng::deterministic_rng(RngAlgorithm::ChaCha);
    TestRunner::new_with_rng(config, rng)
        .run(&strategy, property)
        .unwrap_or_else(|error| panic!("{error}"));
}

prop_compose! {
    fn any_pad(outer_radius_m: f64)(
        place in 0.55..0.95_f64,
        angle_deg in -180.0..180.0_f64,
        sides in (0.05..0.4_f64, 0.05..0.4_f64),
        stiffness in 4.5..7.5_f64,
    ) -> GuideFile {
        GuideFile {
            radius_m: place * outer_radius_m,
            angle_deg,
            radial_length_m: sides.0 * outer_radius_m,
            tangential_length_m: sides.1 * outer_radius_m,
            stiffness_n_per_m: 10_f64.powf(stiffness),
            damping_n_s_per_m: 0.0,
        }
    }
}

prop_compose! {
    /// A steel saw of 200 to 800 mm with one to three pads.
    fn any_saw()(
        outer_radius_m in 0.1..0.4_f64,
    )(
        bore in 0.2..0.45_f64,
        thinness in 60.0..150.0_f64,
        mount in prop_oneof![
            Just(None), Just(Some(InPlane::Fixed)), Just(Some(InPlane::Free))
        ],
        guides in prop::collection::vec(any_pad(outer_radius_m), 1..=3),
        outer_radius_m in Just(outer_radius_m),
    ) -> SceneFile {
        let mut file = Scene::paper().file;
        file.sweep = None;
        file.measured = None;
        // What belongs to the paper's own blade.
        (file.spline, file.cut, file.runup, file.probe) = (None, None, None, None);
        file.blade.outer_diameter_m = 2.0 * outer_radius_m;
        file.blade.inner_diameter_m = 2.0 * bore * outer_radius_m;
        file.blade.thickness_m = outer_radius_m / thinness;
        if let Some(in_plane) = mount {
            let diameter_m = file.blade.inner_diameter_m;
            file.mount = Mount::Collar { diameter_m, in_plane };
        }
        file.guides = guides;
        file
    }
}

fn scene(file: &SceneFile) -> Scene {
    Scene::try_from(file.clone()).unwrap_or_else(|error| panic!("{error}"))
}

fn system(file: &SceneFile) -> GyroscopicSystem {
    GyroscopicSystem::of_plate(&Plate::new(&scene(file), SMALL))
}

fn critical_rad_per_s(file: &SceneFile) -> Vec<f64> {
    SpectralModel::critical_speeds(&Plate::new(&scene(file), SMALL))
        .unwrap()
        .iter()
        .map(|c| c.speed_rad_per_s)
        .collect()
}

fn lowest_critical(file: &SceneFile) -> f64 {
    critical_rad_per_s(file)[0]
}

/// Every eigenvalue with Im λ ≥ 0.
fn eigenvalues(file: &SceneFile, speed_rad_per_s: f64) -> Vec<c64> {
    let pairs = companion_eigenpairs(&system(file), speed_rad_per_s).unwrap();
    pairs.into_iter().map(|(lambda, _)| lambda).collect()
}

/// Largest distance between two sets of eigenvalues, each matched with the nearest that
/// is left, in units of the geometric mean of |λ| and the largest |λ|: rounding errs by
/// ε times the largest.
fn distance(left: &[c64], right: &[c64]) -> f64 {
    assert!(!left.is_empty());
    if left.len() != right.len() {
        return f64::INFINITY;
    }
    let largest = left.iter().fold(0.0_f64, |top, l| top.max(l.norm()));
    let mut rest = right.to_vec();
    let mut worst = 0.0;
    for l in left {
        let off = |r: &c64| (r - l).norm();
        let nearest = (0..rest.len())
            .min_by(|&i, &k| off(&rest[i]).total_cmp(&off(&rest[k])))
            .unwrap();
        let error = off(&rest.swap_remove(nearest)) / (l.norm() * largest).sqrt();
        if error > worst || error.is_nan() {
            worst = error;
        }
    }
    worst
}

/// G is skew, K(Ω) symmetric: nothing in the model creates or destroys energy.
#[test]
fn gyroscopic_forces_are_skew_and_stiffness_is_symmetric() {
    check(24, (any_saw(), 0.0..2.0_f64), |(file, share)| {
        let system = system(&file);
        prop_assert!(system.is_conservative());
        let stiffness = system.stiffness_at(share * lowest_critical(&file));
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

/// Time runs back as well as forth: with λ also −λ̄ is an eigenvalue. At a merging of
/// two modes eigenvalues are known to √ε only; the draws keep clear of that.
#[test]
fn eigenvalues_come_in_pairs_about_the_imaginary_axis() {
    check(24, (any_saw(), 0.0..2.0_f64), |(file, share)| {
        let lambdas = eigenvalues(&file, share * lowest_critical(&file));
        // Real eigenvalues stand in the list with both signs, and mirror each other.
        let mirrored: Vec<c64> = lambdas.iter().map(|l| c64::new(-l.re, l.im)).collect();
        let off = distance(&lambdas, &mirrored);
        prop_assert!(off <= 1e-9, "{}", off);
        Ok(())
    });
}

/// Seen in a mirror, pads stand at −θ and the blade turns the other way; run backwards,
/// it turns as before. Without damping both films show the same frequencies.
#[test]
fn mirrored_pads_give_the_same_spectrum() {
    check(24, (any_saw(), 0.0..2.0_f64), |(file, share)| {
        let speed = share * lowest_critical(&file);
        let mut mirrored = file.clone();
        for pad in &mut mirrored.guides {
            pad.angle_deg = -pad.angle_deg;
        }
        let original = eigenvalues(&file, speed);
        let off = distance(&original, &eigenvalues(&mirrored, speed));
        prop_assert!(off <= 1e-9, "mirrored: {}", off);
        // Each film by itself: the same saw turning the other way.
        let off = distance(&original, &eigenvalues(&file, -speed));
        prop_assert!(off <= 1e-9, "other way: {}", off);
        Ok(())
    });
}

/// Space has no preferred direction.
#[test]
fn turning_all_pads_together_changes_nothing() {
    let draw = (any_saw(), 0.0..2.0_f64, -180.0..180.0_f64);
    check(24, draw, |(file, share, turn_deg)| {
        let speed = share * lowest_critical(&file);
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

/// Three units are a matter of choice: with lengths × L, masses × M and times × T, pressure
/// is × M/LT², density × M/L³, stiffness × M/T², and every λ × 1/T.
#[test]
fn units_do_not_matter() {
    let factor = || (-1.0..1.0_f64).prop_map(|x| 10_f64.powf(x));
    let draw = (any_saw(), 0.0..2.0_f64, [factor(), factor(), factor()]);
    check(24, draw, |(file, share, [length, mass, time])| {
        let mut scaled = file.clone();
        let blade = &mut scaled.blade;
        blade.outer_diameter_m *= length;
        blade.inner_diameter_m *= length;
        blade.thickness_m *= length;
        blade.material.youngs_modulus_pa *= mass / (length * time * time);
        blade.material.density_kg_per_m3 *= mass / length.powi(3);
        if let Mount::Collar { diameter_m, .. } = &mut scaled.mount {
            *diameter_m = blade.inner_diameter_m;
        }
        for pad in &mut scaled.guides {
            pad.radius_m *= length;
            pad.radial_length_m *= length;
            pad.tangential_length_m *= length;
            pad.stiffness_n_per_m *= mass / (time * time);
        }
        let speed = share * lowest_critical(&file);
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

fn dense_model(file: &SceneFile, top_rad_per_s: f64) -> SpectralModel {
    let plate = Plate::new(&scene(file), SMALL);
    SpectralModel::new(plate, (0.0, top_rad_per_s), Solver::Dense).unwrap()
}

/// Below the first critical speed K(Ω) > 0, the energy of every motion is positive, and
/// without damping or follower forces nothing can grow.
#[test]
fn nothing_grows_below_the_first_critical_speed() {
    check(24, (any_saw(), 0.0..0.999_f64), |(file, share)| {
        let critical = lowest_critical(&file);
        let model = dense_model(&file, critical);
        for mode in model.all_modes(share * critical).unwrap() {
            // One pad can leave a rigid motion all but free: it is slow, not growing.
            prop_assert_eq!(mode.kind, ModeKind::Positive, "λ = {}", mode.lambda);
        }
        Ok(())
    });
}

/// Krein index: K(Ω) has as many negative eigenvalues as there are real λ > 0, and twice
/// as many as there are flutter pairs and reflected waves together. The left side comes
/// from the stiffness matrix alone, the right side from the spectrum.
#[test]
fn the_krein_index_counts_every_unstable_and_reflected_mode() {
    let counted = std::cell::Cell::new([0_usize; 3]);
    check(24, (any_saw(), 0.9..2.0_f64), |(file, share)| {
        let speed = share * lowest_critical(&file);
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
    // The draws must have met all three kinds.
    let met = counted.get();
    println!("divergent, flutter, reflected: {met:?}");
    assert!(met.iter().all(|count| *count > 0), "{met:?}");
}

/// The chart finds every band: its own certificate, the same identity, never fails.
#[test]
fn charts_of_random_saws_miss_nothing() {
    let bands = std::cell::Cell::new(0);
    check(5, any_saw(), |file| {
        let range = (0.0, 1.5 * lowest_critical(&file));
        let plate = Plate::new(&scene(&file), SMALL);
        let model = SpectralModel::new(plate, range, Solver::Reduced).unwrap();
        let chart = chart(&model, range, 21, &|_, _| ()).unwrap();
        // Those of the even speeds that are above the lowest critical one.
        prop_assert!(chart.certificate.speeds_checked >= 7);
        prop_assert_eq!(chart.certificate.violations, Vec::<f64>::new());
        let first = model.critical[0].speed_rad_per_s;
        for band in &chart.instabilities {
            prop_assert!(band.from >= first * (1.0 - 1e-9), "{:?}", band);
            prop_assert!(band.to > band.from && band.peak_growth_per_s > 0.0);
            prop_assert!((band.from..=band.to).contains(&band.peak), "{:?}", band);
        }
        bands.set(bands.get() + chart.instabilities.len());
        Ok(())
    });
    println!("bands: {}", bands.get());
    assert!(bands.get() > 0);
}

/// The modes of the projection are those of the whole basis, where it says they are.
#[test]
fn projected_modes_are_those_of_the_whole_basis() {
    check(8, (any_saw(), 0.0..1.6_f64), |(file, share)| {
        let top = 1.6 * lowest_critical(&file);
        let speed = share / 1.6 * top;
        let plate = Plate::new(&scene(&file), SMALL);
        let model = SpectralModel::new(plate, (0.0, top), Solver::Reduced).unwrap();
        let lambdas = |modes: Vec<sawflutter::spectrum::Mode>| -> Vec<c64> {
            modes.iter().map(|mode| mode.lambda).collect()
        };
        let reduced = lambdas(model.modes(speed).unwrap());
        let mut whole = lambdas(dense_model(&file, top).all_modes(speed).unwrap());
        prop_assert!(reduced.len() >= 6 && reduced.len() <= whole.len());
        whole.truncate(reduced.len());
        // Modes are found to 1e-6, the stated accuracy of the projection.
        let off = distance(&whole, &reduced);
        prop_assert!(off <= 1e-6, "{} of {} Hz", off, speed / TAU);
        Ok(())
    });
}

/// The functions are orthonormal in mass: ρh ∫ φᵢφⱼ dA = 1, so M is positive definite and
/// stands nowhere else. By Simpson's rule in θ and in r, which knows nothing of the basis.
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
                let f = plate.functions_at(r, TAU * f64::from(k) / f64::from(angles));
                let f = faer::Col::from_fn(size, |i| f[i]);
                let weight = ring * plate.blade.mass_per_area_kg_per_m2();
                mass += faer::Scale(weight) * &f * f.transpose();
            }
        }
        let off = (mass - Mat::<f64>::identity(size, size)).norm_max();
        // Simpson's rule on polynomials of degree 9, with a collar 13, on 500 panels.
        prop_assert!(off <= 1e-5, "{}", off);
        Ok(())
    });
}

/// The paper's blade with `count` equal pads, evenly spaced.
fn evenly_guided(count: usize, pad: GuideFile) -> SceneFile {
    let mut file = Scene::paper().file;
    file.sweep = None;
    file.guides = (0..count)
        .map(|k| GuideFile {
            angle_deg: pad.angle_deg + 360.0 * k as f64 / count as f64,
            ..pad
        })
        .collect();
    file
}

/// With S equal, evenly spaced pads only waves whose nodal diameters differ by, or add up to,
/// a multiple of S are coupled: others cross exactly, and each wave that flutters is made of
/// one class.
#[test]
fn evenly_spaced_pads_merge_only_waves_of_one_class() {
    let seen = std::cell::Cell::new([0_usize; 2]);
    check(8, (3_usize..=5, any_pad(0.355)), |(count, pad)| {
        let file = evenly_guided(count, pad);
        let plate = Plate::new(&scene(&file), SMALL);
        let range = (0.0, 1.7 * lowest_critical(&file));
        let model = SpectralModel::new(plate, range, Solver::Reduced).unwrap();
        let (bands, certificate) = undamped_bands(&model, range, 21).unwrap();
        prop_assert_eq!(certificate.violations, Vec::<f64>::new());
        let class = |n: usize| (n % count).min(count - n % count);
        for band in bands.iter().filter(|b| b.kind == InstabilityKind::Flutter) {
            let modes = model.modes(band.peak).unwrap();
            let growing = modes.into_iter().filter(|m| m.kind == ModeKind::Flutter);
            for mode in model.describe(band.peak, growing.collect()) {
                let harmonics = mode.name.harmonics.iter().filter(|h| h.share > 1e-9);
                let mut classes: Vec<usize> = harmonics.map(|h| class(h.diameters)).collect();
                classes.dedup();
                classes.sort_unstable();
                classes.dedup();
                prop_assert_eq!(classes.len(), 1, "{} pads: {:?}", count, mode.name);
                let [crossings, merged] = seen.get();
                seen.set([crossings, merged + 1]);
            }
        }
        // Pairs of signs + and − of different classes that stand in one order at the lowest
        // speed and in the other at the highest have crossed: count those, to be sure that
        // there was something not to merge.
        let stable = model.modes(range.1).unwrap();
        let reflected = stable
            .iter()
            .filter(|m| m.kind == ModeKind::Negative)
            .count();
        let [crossings, merged] = seen.get();
        seen.set([crossings + reflected, merged]);
        Ok(())
    });
    println!("reflected waves, fluttering waves: {:?}", seen.get());
    assert!(
        seen.get().iter().all(|count| *count > 0),
        "{:?}",
        seen.get()
    );
}

/// Following permutes the modes of a speed among the branches: each is in one branch, none in
/// two, a branch has no gap, and the order in which the speeds come does not matter.
#[test]
fn branches_are_permuted_and_never_lost() {
    check(6, (any_saw(), 8_usize..40), |(file, count)| {
        let range = (0.0, 1.6 * lowest_critical(&file));
        let plate = Plate::new(&scene(&file), SMALL);
        let model = SpectralModel::new(plate, range, Solver::Reduced).unwrap();
        let samples = sample(&model, &even_speeds(range, count), &|_, _| ()).unwrap();
        let campbell = Campbell::track(samples.clone());
        let mut met: Vec<Vec<usize>> = campbell
            .samples
            .iter()
            .map(|s| vec![0; s.modes.len()])
            .collect();
        for branch in &campbell.branches {
            for pair in branch.points.windows(2) {
                prop_assert_eq!(pair[1].0, pair[0].0 + 1);
            }
            for &(speed, mode) in &branch.points {
                met[speed][mode] += 1;
            }
        }
        prop_assert!(met.iter().flatten().all(|times| *times == 1));
        let backwards = Campbell::track(samples.into_iter().rev().collect());
        for (x, y) in campbell.branches.iter().zip(&backwards.branches) {
            prop_assert_eq!(&x.points, &y.points);
        }
        Ok(())
    });
}

/// The number of threads decides when, not what: reports agree to the last byte, and so do
/// two runs after each other.
#[test]
fn any_number_of_threads_writes_the_same_report() {
    let mut file = Scene::paper().file;
    // A critical pair, two narrow bands and what lies between them.
    file.sweep = Some(SweepFile {
        from_rpm: 1500.0,
        to_rpm: 2300.0,
    });
    let scene = Scene {
        accuracy: Accuracy::Draft,
        ..scene(&file)
    };
    let report = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| {
            assert_eq!(rayon::current_num_threads(), threads);
            let analysis = Analysis::new(&scene, &|_, _| ()).unwrap();
            serde_json::to_string(&Report::new(&scene, &analysis).unwrap()).unwrap()
        })
    };
    let one = report(1);
    assert!(one.contains("\"flutter\""));
    for threads in [1, 2, 8] {
        assert!(
            one == report(threads),
            "the report of {threads} threads differs"
        );
    }
}
