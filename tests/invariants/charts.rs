//! Goal: the chart of a random saw has known properties: no band is missing, no branch is lost, and neither threads nor
//! the reduced model change it.

use std::f64::consts::TAU;

use faer::c64;
use proptest::prelude::*;
use sawflutter::model::evenly_spaced;
use sawflutter::model::plate::Plate;
use sawflutter::model::scene::{Accuracy, GuideFile, Scene, SceneFile, SpeedRange, SweepFile};
use sawflutter::modes::branches::{Campbell, sample};
use sawflutter::modes::{ModeKind, ModeName, SpectralModel, Strategy as Solver};
use sawflutter::stability::{Analysis, InstabilityKind, chart, undamped_bands};

use crate::draws::*;

/// The chart finds every band: its certificate, the Krein index, never fails.
#[test]
fn charts_of_random_saws_miss_nothing() {
    let bands = std::cell::Cell::new(0);
    check(5, any_saw(), |file| {
        let range = SpeedRange::new(0.0, 1.5 * first_critical(&file));
        let plate = Plate::new(&scene(&file), SMALL);
        let model = SpectralModel::new(plate, range, Solver::Reduced).unwrap();
        let chart = chart(&model, range, 21, &|_, _| ()).unwrap();
        // The certificate checks the even speeds above the first critical speed.
        prop_assert!(chart.certificate.speeds_checked >= 7);
        prop_assert_eq!(chart.certificate.violations_rad_per_s, Vec::<f64>::new());
        let first = model.critical[0].speed_rad_per_s;
        for band in &chart.instabilities {
            prop_assert!(band.from_rad_per_s >= first * (1.0 - 1e-9), "{:?}", band);
            prop_assert!(band.to_rad_per_s > band.from_rad_per_s && band.peak_growth_per_s > 0.0);
            prop_assert!(band.range().contains(band.peak_rad_per_s), "{:?}", band);
        }
        bands.set(bands.get() + chart.instabilities.len());
        Ok(())
    });
    println!("bands: {}", bands.get());
    assert!(bands.get() > 0);
}

/// The modes of the reduced model are those of the full model, within its range of validity.
#[test]
fn projected_modes_are_those_of_the_full_model() {
    check(8, (any_saw(), 0.0..1.6_f64), |(file, share)| {
        let top = 1.6 * first_critical(&file);
        let speed = share / 1.6 * top;
        let plate = Plate::new(&scene(&file), SMALL);
        let model = SpectralModel::new(plate, SpeedRange::new(0.0, top), Solver::Reduced).unwrap();
        let lambdas = |modes: Vec<sawflutter::modes::Mode>| -> Vec<c64> {
            modes.iter().map(|mode| mode.lambda).collect()
        };
        let reduced = lambdas(model.modes(speed).unwrap());
        let mut whole = lambdas(dense_model(&file, top).all_modes(speed).unwrap());
        prop_assert!(reduced.len() >= 6 && reduced.len() <= whole.len());
        whole.truncate(reduced.len());
        // The stated accuracy of the reduced model is 1e-6.
        let off = distance(&whole, &reduced);
        prop_assert!(off <= 1e-6, "{} of {} Hz", off, speed / TAU);
        Ok(())
    });
}

/// The paper's blade with `count` equal pads, evenly spaced.
fn evenly_guided(count: usize, pad: GuideFile) -> SceneFile {
    let mut file = Scene::paper().file().clone();
    file.sweep = None;
    file.guides = (0..count)
        .map(|k| GuideFile {
            angle_deg: pad.angle_deg + 360.0 * k as f64 / count as f64,
            ..pad.clone()
        })
        .collect();
    file
}

/// The class of waves that S even pads couple, which contains all harmonics of a mode: the distance of n from the
/// nearest multiple of S. `None` if a mode has several classes.
fn class_of(name: &ModeName, pads: usize) -> Option<usize> {
    let present = name.harmonics.iter().filter(|h| h.share > 1e-9);
    let mut classes = present.map(|h| (h.diameters % pads).min(pads - h.diameters % pads));
    let first = classes.next()?;
    classes.all(|class| class == first).then_some(first)
}

/// Frequencies of one class at a speed.
#[derive(Debug, Default, Clone)]
struct Class {
    positive: Vec<f64>,
    reflected: Vec<f64>,
    is_unstable: bool,
}

fn classes(model: &SpectralModel, speed: f64, pads: usize) -> Vec<Class> {
    let mut classes = vec![Class::default(); pads / 2 + 1];
    for described in model.describe(speed, model.modes(speed).unwrap()) {
        let Some(class) = class_of(&described.name, pads) else {
            continue;
        };
        let counted = &mut classes[class];
        match described.mode.kind {
            ModeKind::Positive => counted.positive.push(described.mode.frequency_rad_per_s()),
            ModeKind::Negative => counted.reflected.push(described.mode.frequency_rad_per_s()),
            _ => counted.is_unstable = true,
        }
    }
    classes
}

/// Crossings of a reflected wave with a wave of positive energy of another class between two speeds: the change of the
/// number of these waves that are slower than it, if no wave of either class becomes unstable or is reflected.
fn crossings(before: &[Class], after: &[Class]) -> usize {
    let steady = |k: usize| {
        let same = before[k].reflected.len() == after[k].reflected.len();
        same && !before[k].is_unstable && !after[k].is_unstable
    };
    let slower = |class: &Class, than: f64| class.positive.iter().filter(|f| **f < than).count();
    let mut count = 0;
    for own in (0..before.len()).filter(|k| steady(*k)) {
        for other in (0..before.len()).filter(|k| *k != own && steady(*k)) {
            let pairs = before[own].reflected.iter().zip(&after[own].reflected);
            for (was, is) in pairs {
                count += slower(&before[other], *was).abs_diff(slower(&after[other], *is));
            }
        }
    }
    count
}

/// With S equal, evenly spaced pads only waves whose nodal diameters differ by, or add up to, a multiple of S are
/// coupled: other waves cross exactly, and each wave that flutters belongs to one class.
#[test]
fn evenly_spaced_pads_merge_only_waves_of_one_class() {
    let seen = std::cell::Cell::new([0_usize; 2]);
    check(8, (3_usize..=5, any_pad(0.355)), |(count, pad)| {
        let file = evenly_guided(count, pad);
        let plate = Plate::new(&scene(&file), SMALL);
        let range = SpeedRange::new(0.0, 1.7 * first_critical(&file));
        let model = SpectralModel::new(plate, range, Solver::Reduced).unwrap();
        let found = undamped_bands(&model, range, 21).unwrap();
        let (bands, certificate) = (found.instabilities, found.certificate);
        prop_assert_eq!(certificate.violations_rad_per_s, Vec::<f64>::new());
        for band in bands.iter().filter(|b| b.kind == InstabilityKind::Flutter) {
            let modes = model.modes(band.peak_rad_per_s).unwrap();
            let growing = modes.into_iter().filter(|m| m.kind == ModeKind::Flutter);
            for mode in model.describe(band.peak_rad_per_s, growing.collect()) {
                let class = class_of(&mode.name, count);
                prop_assert!(class.is_some(), "{} pads: {:?}", count, mode.name);
                let [crossings, merged] = seen.get();
                seen.set([crossings, merged + 1]);
            }
        }
        // The test is meaningful only if waves of different classes and signs have crossed. This occurs above the
        // first critical speed, at which the first wave is reflected.
        let first = model.critical[0].speed_rad_per_s;
        let spectra: Vec<Vec<Class>> = evenly_spaced([first, range.to_rad_per_s], 101)
            .into_iter()
            .map(|speed| classes(&model, speed, count))
            .collect();
        let crossed: usize = spectra.windows(2).map(|w| crossings(&w[0], &w[1])).sum();
        let [crossings, merged] = seen.get();
        seen.set([crossings + crossed, merged]);
        Ok(())
    });
    println!("crossings, fluttering waves: {:?}", seen.get());
    assert!(
        seen.get().iter().all(|count| *count > 0),
        "{:?}",
        seen.get()
    );
}

/// Continuation permutes the modes of a speed among the branches: each mode is in exactly one branch, a branch has no
/// gap, and the order of the speeds does not matter.
#[test]
fn branches_are_permuted_and_never_lost() {
    check(6, (any_saw(), 8_usize..40), |(file, count)| {
        let range = SpeedRange::new(0.0, 1.6 * first_critical(&file));
        let plate = Plate::new(&scene(&file), SMALL);
        let model = SpectralModel::new(plate, range, Solver::Reduced).unwrap();
        let samples = sample(&model, &evenly_spaced(range.ends(), count), &|_, _| ()).unwrap();
        let campbell = Campbell::track(&model, samples.clone()).unwrap();
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
        let reversed = samples.into_iter().rev().collect();
        let backwards = Campbell::track(&model, reversed).unwrap();
        for (x, y) in campbell.branches.iter().zip(&backwards.branches) {
            prop_assert_eq!(&x.points, &y.points);
        }
        Ok(())
    });
}

/// The number of threads does not change a result: reports agree to the last byte, and so do two runs.
#[test]
fn any_number_of_threads_writes_the_same_report() {
    let scene = Scene::paper()
        .edited(|saw| {
            saw.accuracy = Accuracy::Draft;
            // The range contains a critical pair, two narrow bands and the interval between them.
            saw.sweep = Some(SweepFile {
                from_rpm: 1500.0,
                to_rpm: 2300.0,
            });
        })
        .unwrap();
    let report = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| {
            assert_eq!(rayon::current_num_threads(), threads);
            let analysis = Analysis::new(&scene).unwrap();
            serde_json::to_string(&analysis.report()).unwrap()
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
