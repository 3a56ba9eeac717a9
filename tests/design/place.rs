//! Goal: `place` finds the best place of a guide and gives its benefit.
//!
//! Sources: symmetry (guides that turn together give the same saw), and brute force.

use std::sync::Mutex;

use crate::common::{assert_close, scene};
use faer::Col;
use faer::linalg::solvers::Solve;
use rayon::prelude::*;
use sawflutter::analyses::commands::CommandReport;
use sawflutter::analyses::door::Step;
use sawflutter::analyses::gap;
use sawflutter::analyses::place::{
    self, Demands, FrontSaw, GapDemands, Options, PlaceError, PlaceReport, Tolerances,
};
use sawflutter::analyses::response::{self, response};
use sawflutter::model::plate::{Plate, Resolution};
use sawflutter::model::scene::{
    Accuracy, ContactLaw, Freed, Parameter, Scene, SideForceFile, SpeedRange, rad_per_s, rpm,
};
use sawflutter::model::system::GyroscopicSystem;
use sawflutter::modes::{SpectralModel, Strategy};
use sawflutter::stability::{Instability, InstabilityKind, Onsets, undamped_bands};

use super::numbers::{freed, with};

const RADIUS: &str = "guides[0].radius_m";
const ANGLE: &str = "guides[0].angle_deg";
const SMALL: Resolution = Resolution {
    max_diameters: 6,
    radial_functions: 3,
};
const LARGE: Resolution = Resolution {
    max_diameters: 40,
    radial_functions: 14,
};
const TOP_RPM: f64 = 2400.0;

fn quick() -> Options {
    Options {
        samples: 8,
        places: 1,
        refine: 24,
        map: 0,
        resolution: Some(SMALL),
        tolerances: Tolerances::USUAL,
        folder: None,
    }
}

/// A scene of `scenes/`, with a sweep over which the small basis represents its waves.
fn swept(name: &str) -> Scene {
    with(&scene(name), &[("sweep.to_rpm", TOP_RPM)])
}

fn place(scene: &Scene, freed: &[Freed], demands: &Demands, options: &Options) -> PlaceReport {
    place::place(scene, freed, demands, options, &|_| ()).unwrap()
}

/// Bands of a saw by other functions of the library than those of `place`.
fn bands(scene: &Scene) -> Vec<Instability> {
    let range = scene.sweep().unwrap();
    let plate = Plate::new(scene, SMALL);
    let model = SpectralModel::new(plate, range, Strategy::Reduced).unwrap();
    undamped_bands(&model, range, 40).unwrap().instabilities
}

fn flutter_rpm(scene: &Scene) -> f64 {
    let strong = |b: &&Instability| {
        b.kind == InstabilityKind::Flutter && b.peak_growth_per_s >= scene.flutter_threshold_per_s()
    };
    bands(scene)
        .iter()
        .find(strong)
        .map_or(TOP_RPM, |b| rpm(b.from_rad_per_s))
}

/// The saw and its neighbours with a radius changed by 2 mm and an angle by 1°, each alone and all together: the
/// tolerances that `place` states.
fn within_tolerances(scene: &Scene, paths: &[&str]) -> Vec<Scene> {
    let step = |path: &str| if path == ANGLE { 1.0 } else { 0.002 };
    let own = |path: &str| Parameter::new(path).get(scene.file()).unwrap();
    let mut offs: Vec<Vec<f64>> = vec![Vec::new()];
    for _ in paths {
        let longer = |off: &Vec<f64>| [-1.0, 0.0, 1.0].map(|sign| [&off[..], &[sign]].concat());
        offs = offs.iter().flat_map(longer).collect();
    }
    // Corners, and steps along one axis.
    let moved = |off: &Vec<f64>| off.iter().filter(|sign| **sign != 0.0).count();
    offs.retain(|off| [0, 1, paths.len()].contains(&moved(off)));
    let at = |off: Vec<f64>| {
        let pairs = paths.iter().zip(&off);
        let numbers = pairs.map(|(path, sign)| (*path, own(path) + sign * step(path)));
        with(scene, &numbers.collect::<Vec<_>>())
    };
    offs.into_iter().map(at).collect()
}

/// The smallest flutter speed of the saws within the tolerances.
fn worst_flutter_rpm(scene: &Scene, paths: &[&str]) -> f64 {
    let saws = within_tolerances(scene, paths);
    let speeds = saws.par_iter().map(flutter_rpm);
    speeds.reduce(|| f64::INFINITY, f64::min)
}

/// `place` may keep one angle fixed only because nothing except the guides is fixed in space.
#[test]
fn guides_that_turn_together_are_the_same_saw() {
    for (name, turned) in [
        ("paper", vec![(ANGLE, 35.0)]),
        (
            "two-pads",
            vec![(ANGLE, 50.0), ("guides[1].angle_deg", 160.0)],
        ),
    ] {
        let saw = swept(name);
        let (here, there) = (bands(&saw), bands(&with(&saw, &turned)));
        let onsets = |bands: &[Instability]| -> Vec<f64> {
            bands.iter().map(|b| rpm(b.from_rad_per_s)).collect()
        };
        let (before, after) = (onsets(&here), onsets(&there));
        assert!(
            !before.is_empty() && before.len() == after.len(),
            "{name}: {before:?} {after:?}"
        );
        for (x, y) in here.iter().zip(&there) {
            assert_close("onset", y.from_rad_per_s, x.from_rad_per_s, 1e-9);
            assert_close("growth", y.peak_growth_per_s, x.peak_growth_per_s, 1e-5);
        }
    }
}

fn worst_rpm(found: &PlaceReport) -> f64 {
    let worst = found.worst_neighbour.as_ref().unwrap();
    worst.outcome.unwrap().goal_rpm
}

fn worst_before_rpm(found: &PlaceReport) -> f64 {
    found.worst_before.outcome.unwrap().goal_rpm
}

fn placed(found: &PlaceReport) -> Scene {
    Scene::try_from(found.scene.clone()).unwrap()
}

#[test]
fn an_angle_without_effect_is_fixed_and_named() {
    let one = swept("paper");
    let free = freed(&one, &[(RADIUS, 0.19, 0.21), (ANGLE, -90.0, 0.0)]);
    let found = place(&one, &free, &Demands::default(), &quick());
    assert_eq!(found.without_effect, [ANGLE]);
    assert_eq!(found.scene.guides[0].angle_deg, -55.0);
    let two = swept("two-pads");
    let both = freed(
        &two,
        &[(ANGLE, -90.0, 0.0), ("guides[1].angle_deg", 30.0, 90.0)],
    );
    let found_both = place(&two, &both, &Demands::default(), &quick());
    assert_eq!(found_both.without_effect, [ANGLE]);
}

/// If saw and bounds are turned by 40°, the best saw is turned by 40°.
#[test]
fn the_best_place_turns_with_the_saw() {
    let saw_here = swept("two-pads");
    let saw_there = with(&saw_here, &[(ANGLE, -10.0), ("guides[1].angle_deg", 100.0)]);
    let best = |saw: &Scene, from: f64| {
        let free = freed(saw, &[(ANGLE, from, from + 60.0)]);
        place(saw, &free, &Demands::default(), &quick())
    };
    let (here, there) = (best(&saw_here, -90.0), best(&saw_there, -50.0));
    assert_close(
        "flutter speed",
        there.best.goal_rpm,
        here.best.goal_rpm,
        1e-6,
    );
    let turn = there.parameters[0].value - here.parameters[0].value;
    assert!((turn - 40.0).abs() < 1e-6, "{turn}");
}

/// In a grid of 7 × 7 saws, each with its neighbours within the tolerances, no worst case is better by more than half a
/// per cent.
#[test]
fn brute_force_finds_no_better_worst_case_of_the_tolerances() {
    let saw = swept("two-pads");
    let (radii, angles) = ((0.22, 0.28), (-100.0, -20.0));
    let free = freed(
        &saw,
        &[(RADIUS, radii.0, radii.1), (ANGLE, angles.0, angles.1)],
    );
    let options = Options { map: 7, ..quick() };
    let found = place(&saw, &free, &Demands::default(), &options);
    let (best, worst) = (found.best.goal_rpm, worst_rpm(&found));
    let answered = placed(&found).swept(saw.sweep().unwrap()).unwrap();
    assert_close("its own saw", flutter_rpm(&answered), best, 1e-6);
    let own = worst_flutter_rpm(&answered, &[RADIUS, ANGLE]);
    assert_close("its worst neighbour", own, worst, 1e-6);
    let along = |(from, to): (f64, f64), k: usize| from + (to - from) * k as f64 / 6.0;
    let grid = (0..49).map(|i| {
        let place = [(RADIUS, along(radii, i % 7)), (ANGLE, along(angles, i / 7))];
        worst_flutter_rpm(&with(&saw, &place), &[RADIUS, ANGLE])
    });
    let brute = grid.fold(0.0, f64::max);
    println!(
        "worst {worst} of {best}, of {} saws, brute force {brute}, before {}",
        found.saws,
        worst_before_rpm(&found)
    );
    assert!(brute <= 1.005 * worst, "{brute} is better than {worst}");
    assert!(worst_rpm(&found) >= worst_before_rpm(&found));
    let summary = found.summary().replace("\n  ", " ");
    assert!(summary.contains("0.22 to 0.28"), "bounds: {summary}");
    let certificate = &found.certificate;
    assert!(certificate.is_clean && certificate.speeds_checked > 0);
    let checks = certificate.speeds_checked + certificate.full_basis_counts;
    let said = format!("all {checks} independent checks agree");
    assert!(summary.contains(&said), "{summary}");
    let map = found.map.unwrap();
    assert_eq!((map.x.len(), map.y.len(), map.goal_rpm.len()), (7, 7, 7));
}

/// Deflection of the rim at the cut under 1 N at the operating speed: a solution of K(Ω) q = φ.
fn deflection_m(scene: &Scene, resolution: Resolution) -> f64 {
    let plate = Plate::new(scene, resolution);
    let stiffness =
        GyroscopicSystem::of_plate(&plate).stiffness_at(scene.operating_rad_per_s().unwrap());
    let cut = plate.functions_at(plate.blade.outer_radius_m, 0.0);
    let cut = Col::from_fn(cut.len(), |i| cut[i]);
    f64::abs(cut.transpose() * stiffness.full_piv_lu().solve(&cut))
}

/// Each saw of the front has the speeds that other functions compute, and the deviation of `response`. No cell of the map deflects
/// less and has a higher flutter speed, both in the worst case of the tolerances.
#[test]
fn no_saw_of_the_map_is_better_than_the_front_in_both_respects() {
    let saw = swept("two-pads")
        .edited(|saw| (saw.accuracy, saw.operating_rpm) = (Accuracy::Draft, Some(1000.0)))
        .unwrap();
    let free = freed(&saw, &[(RADIUS, 0.22, 0.28), (ANGLE, -100.0, -20.0)]);
    let options = Options { map: 4, ..quick() };
    let shown = Mutex::new(Vec::new());
    let see = |step: Step| shown.lock().unwrap().push(step.best_rpm);
    let found = place::place(&saw, &free, &Demands::default(), &options, &see).unwrap();
    // The best saw so far is none before neighbours are computed, and at last the answer.
    let shown = shown.into_inner().unwrap();
    assert_eq!(shown[0], None);
    let best_rpm = shown[shown.len() - 1].unwrap();
    let answer_rpm = found
        .worst_neighbour
        .as_ref()
        .unwrap()
        .outcome
        .unwrap()
        .goal_rpm;
    assert_close("best so far", best_rpm, answer_rpm, 1e-9);
    let at = |values: &[f64]| with(&saw, &[(RADIUS, values[0]), (ANGLE, values[1])]);
    assert!(found.front.len() > 1, "{:?}", found.front);
    assert_eq!(found.force_n, Some(1.0));
    for row in &found.front {
        let scene = at(&row.values);
        assert_close(
            "flutter",
            flutter_rpm(&scene),
            row.flutter_rpm.unwrap(),
            1e-6,
        );
        let worst = worst_flutter_rpm(&scene, &[RADIUS, ANGLE]);
        assert_close("worst", worst, row.worst_goal_rpm, 1e-6);
        let steady = response(&scene, &response::Options::default()).unwrap();
        let deviation_m = steady.operating.unwrap().board_deviation_m.unwrap();
        // A point force deflects its place in waves of all lengths, which takes a large basis; that of `response` is small.
        assert_close("deviation", row.deflection_m, deviation_m, 0.02);
        let exact_m = deflection_m(&scene, LARGE);
        println!("{row:?} {deviation_m} {exact_m}");
        assert_close("deflection", row.deflection_m, exact_m, 3e-3);
        let summary = found.summary();
        assert!(
            summary.contains(&format!("{:.0}", row.worst_goal_rpm)),
            "{summary}"
        );
    }
    let map = found.map.unwrap();
    let cells = map.x.iter().flat_map(|x| map.y.iter().map(|y| [*x, *y]));
    for cell in cells.collect::<Vec<_>>() {
        let scene = at(&cell);
        let small_m = deflection_m(&scene, SMALL);
        let stiffer = |row: &&FrontSaw| small_m <= deflection_m(&at(&row.values), SMALL);
        let rows: Vec<&FrontSaw> = found.front.iter().filter(stiffer).collect();
        if rows.is_empty() {
            continue;
        }
        let worst = worst_flutter_rpm(&scene, &[RADIUS, ANGLE]);
        for row in rows {
            assert!(
                worst <= row.worst_goal_rpm * (1.0 + 1e-6),
                "{cell:?} {worst} {row:?}"
            );
        }
    }
}

/// No saw keeps the limit: the result misses it by less than any saw of a grid, all in the worst case of their
/// tolerances.
#[test]
fn where_no_saw_keeps_the_limit_the_nearest_is_answered() {
    let saw = swept("two-pads");
    let free = freed(&saw, &[(ANGLE, -115.0, -30.0)]);
    let lowest = |saw: &Scene| {
        let critical = SpectralModel::critical_speeds(&Plate::new(saw, SMALL)).unwrap();
        rpm(critical[0].speed_rad_per_s)
    };
    let worst = |saw: &Scene| {
        let saws = within_tolerances(saw, &[ANGLE]);
        saws.iter().map(lowest).fold(f64::INFINITY, f64::min)
    };
    let demands = Demands::new(None, Some(5000.0)).unwrap();
    let found = place(&saw, &free, &demands, &quick());
    let answered = worst(&placed(&found));
    let grid = (0..=17).map(|k| worst(&with(&saw, &[(ANGLE, -115.0 + 5.0 * f64::from(k))])));
    let nearest = grid.fold(0.0, f64::max);
    assert!(answered >= 0.999 * nearest, "{answered} {nearest}");
    assert!(!found.kept);
    let missed = format!(
        "misses it by the smallest amount, {:.0} rpm",
        5000.0 - answered
    );
    // The text begins with it.
    let answer = found.answer().replace('\n', " ");
    assert!(answer.contains(&missed), "{missed}: {answer}");
}

/// A rim that is hotter than the blade tolerates buckles it: the search tries such saws and counts them.
#[test]
fn saws_that_cannot_be_computed_are_counted() {
    let saw = scene("gallery/heated-rim")
        .swept(SpeedRange::between_rpm(0.0, 4000.0))
        .unwrap();
    let free = freed(&saw, &[("membrane.temperature.rim_rise_k", 0.0, 66.0)]);
    let found = place(&saw, &free, &Demands::default(), &quick());
    assert!(found.failed_saws > 0 && found.failed_saws < found.saws);
    let said = format!("{} of the {} saws tried", found.failed_saws, found.saws);
    assert!(
        found.warnings.iter().any(|w| w.starts_with(&said)),
        "{:?}",
        found.warnings
    );
}

/// The first critical speed increases with the distance between the two pads; the flutter speed is highest at a medium
/// distance. A limit above the critical speed of the best saw changes the result, which then keeps the limit.
#[test]
fn a_limit_on_the_critical_speed_is_active_and_kept() {
    let saw = swept("two-pads");
    let free = freed(&saw, &[(ANGLE, -115.0, -60.0)]);
    let unlimited = place(&saw, &free, &Demands::default(), &quick());
    let loose = unlimited.best.first_critical_rpm.unwrap();
    let limit = 1.02 * loose;
    let at_least = Demands::new(None, Some(limit)).unwrap();
    let limited = place(&saw, &free, &at_least, &quick());
    let kept = limited.best.first_critical_rpm.unwrap();
    println!(
        "flutter {} critical {}; limited to {}: flutter {} critical {}",
        unlimited.best.goal_rpm, loose, limit, limited.best.goal_rpm, kept
    );
    assert!(limited.kept && limited.best.kept && kept >= limit);
    assert!(limited.best.goal_rpm < unlimited.best.goal_rpm);
}

/// Guides with a gap that are too far from the blade come closer, until the deflection that `gap` finds keeps its limit.
/// Without such demands the gap has no effect.
#[test]
fn the_gap_is_as_narrow_as_the_deflection_demands() {
    let saw = swept("paper")
        .edited(|saw| {
            saw.operating_rpm = Some(1000.0);
            let pad = &mut saw.guides[0];
            (pad.contact, pad.gap_m) = (ContactLaw::OneSided, Some(8e-5));
            saw.side_force = Some(SideForceFile::of(2.0));
        })
        .unwrap();
    let free = freed(&saw, &[("guides[0].gap_m", 2e-5, 1e-4)]);
    let limited = saw
        .edited(|file| file.limits.get_or_insert_default().max_deviation_m = Some(3e-4))
        .unwrap();
    let demands = Demands {
        gap: GapDemands::new(&limited, Some(1.5e-4)).unwrap(),
        ..Demands::default()
    };
    let few = Options {
        samples: 4,
        refine: 4,
        ..quick()
    };
    let found = place(&saw, &free, &demands, &few);
    assert!(!found.before.kept && found.best.kept && found.improved);
    let map = gap::gap(&placed(&found), &gap::Options::default())
        .unwrap()
        .deviation;
    let of = |own: &[f64], value: f64| {
        let place = own.iter().position(|own| (own / value - 1.0).abs() < 1e-9);
        place.unwrap()
    };
    let row = &map.deflection_m[of(&map.gap_factors, 1.0)];
    let deflection_m = row[of(&map.forces_n, 2.0)].unwrap();
    // This test's basis is a small one.
    assert!(deflection_m < 1.02 * 3e-4, "{deflection_m}");
    let idle = place::place(&saw, &free, &Demands::default(), &quick(), &|_| ());
    assert!(matches!(idle, Err(PlaceError::NothingFree)));
}

#[test]
fn the_window_is_free_of_bands_and_wider_than_before() {
    let saw = swept("two-pads");
    // The limit is above the divergence of the first pair, which this basis places near 1800 rpm.
    let around_rpm = 1900.0;
    let demands = Demands::new(Some(around_rpm), None).unwrap();
    let free = freed(&saw, &[(RADIUS, 0.2, 0.3)]);
    let found = place(&saw, &free, &demands, &quick());
    let [from, to] = found.best.window_rpm.unwrap();
    assert!(from < around_rpm && around_rpm < to);
    assert!(worst_rpm(&found) >= worst_before_rpm(&found));
    let threshold = saw.flutter_threshold_per_s();
    for band in &found.bands {
        let counts =
            band.kind == InstabilityKind::Divergence || band.peak_growth_per_s >= threshold;
        assert!(
            !counts || band.to_rpm <= from || band.from_rpm >= to,
            "{band:?}"
        );
    }
}

#[test]
fn the_result_does_not_depend_on_the_number_of_threads() {
    let saw = swept("two-pads");
    let free = freed(&saw, &[(ANGLE, -80.0, -30.0)]);
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| {
            place(
                &saw,
                &free,
                &Demands::default(),
                &Options {
                    samples: 6,
                    map: 5,
                    ..quick()
                },
            )
        })
    };
    let (one, three) = (on(1), on(3));
    assert_eq!(one, three);
}

/// With zero tolerances the value of a saw is its own; otherwise its neighbours are those of the stated tolerances.
#[test]
fn the_tolerances_are_those_that_are_stated() {
    let saw = swept("paper");
    let free = freed(&saw, &[(RADIUS, 0.18, 0.28), (ANGLE, -70.0, -40.0)]);
    let found = |radius_m: f64, angle_deg: f64| {
        let tolerances = Tolerances {
            radius_m,
            angle_deg,
            ..Tolerances::USUAL
        };
        let options = Options {
            samples: 3,
            refine: 2,
            tolerances,
            ..quick()
        };
        place(&saw, &free, &Demands::default(), &options)
    };
    let exact = found(0.0, 0.0);
    assert_eq!(exact.worst_neighbour_share, 1.0);
    assert_eq!((exact.fragile, exact.fragile_optimum), (false, None));
    for parameter in &exact.parameters {
        let itself = exact.best.goal_rpm;
        assert_eq!(parameter.offset, 0.0);
        assert_eq!([parameter.less_rpm, parameter.more_rpm], [Some(itself); 2]);
    }
    let radius = found(0.005, 0.0).parameters.swap_remove(0);
    assert_eq!((radius.path.as_str(), radius.offset), (RADIUS, 0.005));
}

/// A saw of draft accuracy whose basis the program chooses.
fn draft(name: &str) -> Scene {
    let saw = scene(name).edited(|saw| saw.accuracy = Accuracy::Draft);
    saw.unwrap()
}

fn one_radius(saw: &Scene, demands: &Demands) -> PlaceReport {
    let options = Options {
        samples: 32,
        refine: 20,
        map: 0,
        ..Options::default()
    };
    place(saw, &freed(saw, &[(RADIUS, 0.15, 0.3)]), demands, &options)
}

/// On the coarse basis the best radius lies past a jump of the finer one, on which that saw flutters from 1907 rpm on
/// and the start from 2256. Both are analysed as `analyze` does, and so are their neighbours 2 mm away.
#[test]
fn the_answer_is_never_below_the_start() {
    let saw = draft("paper");
    let found = one_radius(&saw, &Demands::default());
    let flutter = |saw: &Scene| {
        let speed = Onsets::new(saw).unwrap().flutter_speed_rad_per_s;
        rpm(speed.unwrap())
    };
    let worst = |saw: &Scene| {
        let saws = within_tolerances(saw, &[RADIUS]);
        saws.iter().map(flutter).fold(f64::INFINITY, f64::min)
    };
    let placed = placed(&found);
    let (before, after) = (worst(&saw), worst(&placed));
    println!("{before} -> {after} rpm");
    assert!(after >= before);
    assert_close("before", found.before.goal_rpm, flutter(&saw), 1e-3);
    assert_close("worst before", worst_before_rpm(&found), before, 1e-3);
    assert_close("after", found.best.goal_rpm, flutter(&placed), 1e-3);
    assert_close("worst after", worst_rpm(&found), after, 1e-3);
    assert_eq!(found.improved, after > before);
}

/// The window between the bands next to 1800 rpm has this property too.
#[test]
fn the_window_is_never_narrower_than_before() {
    let saw = draft("paper");
    let around_rad_per_s = rad_per_s(1800.0);
    let demands = Demands::new(Some(1800.0), None).unwrap();
    let found = one_radius(&saw, &demands);
    let window = |saw: &Scene| {
        let threshold = saw.flutter_threshold_per_s();
        let onsets = Onsets::new(saw).unwrap();
        let counting = onsets.instabilities.iter().filter(|b| b.counts(threshold));
        let bands = counting.map(|band| (band.from_rad_per_s, band.to_rad_per_s));
        let critical = onsets.critical_rad_per_s.iter();
        let beside = critical.map(|speed| (0.95 * speed, 1.05 * speed));
        let excluded: Vec<(f64, f64)> = bands.chain(beside).collect();
        let below = excluded.iter().filter(|(_, to)| *to < around_rad_per_s);
        let above = excluded.iter().filter(|(from, _)| *from > around_rad_per_s);
        let from = below.map(|(_, to)| *to).fold(0.0, f64::max);
        let to = above.map(|(from, _)| *from);
        to.fold(f64::INFINITY, f64::min) - from
    };
    let worst = |saw: &Scene| {
        let saws = within_tolerances(saw, &[RADIUS]);
        saws.iter().map(window).fold(f64::INFINITY, f64::min)
    };
    let placed = placed(&found);
    let (before, after) = (worst(&saw), worst(&placed));
    assert!(after >= before, "{} {}", rpm(before), rpm(after));
    let own = rpm(window(&placed));
    assert_close("window", found.best.goal_rpm, own, 1e-2);
}

/// On the coarse basis the cells of highest flutter speed lie next to jumps and are worse in the worst case of their
/// tolerances than a cell elsewhere. A robust saw next to them, which this test knows, is better than both.
#[test]
fn a_robust_saw_next_to_fragile_cells_of_the_map_is_found() {
    let saw = draft("two-pads");
    let free = freed(&saw, &[(RADIUS, 0.2, 0.3), (ANGLE, -120.0, 0.0)]);
    let options = Options {
        samples: 16,
        places: 1,
        refine: 30,
        map: 11,
        ..Options::default()
    };
    let found = place(&saw, &free, &Demands::default(), &options);
    let known = with(&saw, &[(RADIUS, 0.2525), (ANGLE, -117.6)]);
    let flutter = |saw: &Scene| {
        let speed = Onsets::new(saw).unwrap().flutter_speed_rad_per_s;
        rpm(speed.unwrap())
    };
    let saws = within_tolerances(&known, &[RADIUS, ANGLE]);
    let known_rpm = saws.iter().map(flutter).fold(f64::INFINITY, f64::min);
    let worst = worst_rpm(&found);
    println!("{worst} of a known {known_rpm} rpm");
    assert!(worst > 0.995 * known_rpm, "{worst} {known_rpm}");
}

/// Below 1600 rpm no saw flutters, so that none is better than another: the result is the start, to the last digit and
/// without a note in its scene.
#[test]
fn a_start_that_nothing_beats_is_the_answer() {
    let saw = with(&scene("paper"), &[("sweep.to_rpm", 1600.0)]);
    let free = freed(&saw, &[(RADIUS, 0.19, 0.21)]);
    let found = place(&saw, &free, &Demands::default(), &quick());
    assert!(!found.improved);
    assert_eq!(found.scene, *saw.file());
    assert_eq!(found.parameters[0].value, found.parameters[0].start);
    assert_eq!(found.best, found.before);
}

/// The number of the scene may be outside the bounds; "before" still refers to it.
#[test]
fn a_start_outside_the_bounds_is_reported_unchanged() {
    let saw = swept("two-pads");
    let own = Parameter::new(RADIUS).get(saw.file()).unwrap();
    let free = freed(&saw, &[(RADIUS, own + 0.02, own + 0.04)]);
    let found = place(&saw, &free, &Demands::default(), &quick());
    assert_eq!(found.parameters[0].start, own);
    assert_close("before", found.before.goal_rpm, flutter_rpm(&saw), 1e-6);
    let value = found.parameters[0].value;
    assert!((own + 0.02..=own + 0.04).contains(&value), "{value}");
    let gained = worst_rpm(&found) > worst_before_rpm(&found);
    assert_eq!(found.improved, gained);
}

/// Source: flutter speeds of the cells by the library's own parts.
#[test]
fn cells_of_the_map_hold_the_flutter_speeds_of_their_saws() {
    const STIFFNESS: &str = "guides[0].stiffness_n_per_m";
    let saw = swept("paper");
    let free = freed(&saw, &[(RADIUS, 0.19, 0.25), (STIFFNESS, 1e7, 3e7)]);
    let options = Options { map: 3, ..quick() };
    let demands = Demands::default();
    let found = place(&saw, &free, &demands, &options);
    let map = found.map.unwrap();
    for (row, stiffness) in map.y.iter().enumerate() {
        for (column, radius) in map.x.iter().enumerate() {
            let cell = with(&saw, &[(RADIUS, *radius), (STIFFNESS, *stiffness)]);
            let found = map.goal_rpm[row][column].unwrap();
            assert_close("flutter", found, flutter_rpm(&cell), 1e-6);
        }
    }
}

/// A search that was stopped after some of its saws goes on with them: the answer is the same, and no saw is computed twice.
#[test]
#[cfg_attr(debug_assertions, ignore = "many eigenproblems: run it in release")]
fn a_stopped_search_goes_on_with_the_saws_that_it_has_computed() {
    let saw = swept("paper");
    let freed = [Freed::new(saw.file(), RADIUS, 0.18, 0.28).unwrap()];
    let folder = tempfile::tempdir().unwrap();
    let options = Options {
        samples: 4,
        refine: 6,
        folder: Some(folder.path().to_owned()),
        ..quick()
    };
    let placed = || place(&saw, &freed, &Demands::default(), &options);
    let whole = placed();
    let log = folder.path().join("place-log.jsonl");
    let lines = || {
        std::fs::read_to_string(&log)
            .unwrap()
            .lines()
            .map(str::to_owned)
            .collect()
    };
    let all: Vec<String> = lines();
    let scene = std::fs::read_to_string(folder.path().join("placed-scene.json")).unwrap();
    assert!(Scene::from_json(&scene).is_ok(), "{scene}");
    assert_eq!(placed(), whole);
    assert_eq!(lines(), all, "nothing is computed again");
    // As a stopped run leaves it: a part of the lines, the last one without its end.
    let half = all[..all.len() / 2].join("\n") + "\n{\"saw\":[[";
    std::fs::write(&log, half).unwrap();
    assert_eq!(placed(), whole);
    let again: Vec<String> = lines();
    assert_eq!(again.len(), all.len());
    // Another saw begins a log of its own.
    let heavier = with(&saw, &[("blade.material.density_kg_per_m3", 8000.0)]);
    let found = place(&heavier, &freed, &Demands::default(), &options);
    assert!(found.best.goal_rpm < whole.best.goal_rpm);
}
