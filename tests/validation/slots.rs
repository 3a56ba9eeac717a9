//! Goal: a slotted blade has the frequencies, critical speeds and mean stresses of independent computations.
//!
//! Sources: `slots_four_40mm.csv`, a thin plate with doubled unknowns on the faces of the slots, on the whole circle, in its own
//! stress of rotation, extrapolated (error below 1e-4), and solid elements of CalculiX; `slots_mean_stress.csv`, the mean stress of that
//! plate at Gauss radii; `slots_whole_circle.csv`, other layouts.

use std::f64::consts::TAU;

use crate::common::{Worst, assert_close, reference_model, relative_error, scene, table};
use faer::Side;
use sawflutter::analyses::check::{Limits, check};
use sawflutter::analyses::fit::{Measurement, Options, fit};
use sawflutter::analyses::verdict::Answer;
use sawflutter::model::plate::{Plate, Resolution};
use sawflutter::model::scene::{
    Accuracy, Freed, InPlane, Mount, Scene, SceneFile, SlotsFile, rad_per_s, rpm,
};
use sawflutter::stability::{Analysis, StabilityState};
use serde::Deserialize;

/// A wave of the blade with four slots.
#[derive(Deserialize)]
pub struct Row {
    pub n: usize,
    pub branch: String,
    pub rest_hz: f64,
    pub rpm1500_hz: f64,
    pub rpm3000_hz: f64,
    pub rpm4500_hz: f64,
    pub critical_rpm: Option<f64>,
    ccx_rest_hz: f64,
    ccx_critical_rpm: Option<f64>,
}

#[derive(Deserialize)]
struct Layout {
    count: u32,
    depth_m: f64,
    n: usize,
    branch: String,
    rest_hz: f64,
}

#[derive(Deserialize)]
struct Stress {
    r_m: f64,
    mean_sr: f64,
    mean_st: f64,
}

/// A blade of 400 mm in a rigid collar of 100 mm, with a number of slots of a depth in m.
pub fn saw(slots: Option<(u32, f64)>) -> Scene {
    let saw = scene("collar-400mm").edited(|saw| {
        saw.blade.inner_diameter_m = 0.03;
        saw.mount = Mount::Collar {
            diameter_m: 0.1,
            in_plane: InPlane::Fixed,
            clamp_stiffness_n_m_per_rad_per_m: None,
        };
        saw.blade.slots = slots.map(|(count, depth_m)| SlotsFile {
            count,
            depth_m,
            width_m: None,
            inclination_deg: None,
            hole_diameter_m: None,
        });
    });
    saw.unwrap()
}

fn plate(slots: Option<(u32, f64)>) -> Plate {
    Plate::new(&saw(slots), Resolution::of(Accuracy::Reference))
}

/// Lowest frequency on n nodal diameters in the frame of the blade.
fn lowest_hz(plate: &Plate, n: usize, rpm: f64) -> f64 {
    let stiffness = plate.harmonics[n].body_frame_stiffness(rad_per_s(rpm));
    stiffness.self_adjoint_eigenvalues(Side::Lower).unwrap()[0].sqrt() / TAU
}

/// c_n of a branch.
fn bending(plate: &Plate, n: usize, branch: &str) -> f64 {
    let waves = &plate.slotted().unwrap().waves[n];
    assert_eq!(waves.len(), if branch == "single" { 1 } else { 2 }, "{n}");
    waves[usize::from(branch == "high")].bending
}

#[test]
fn both_branches_at_rest_are_those_of_a_plate_with_cuts_and_of_solids() {
    let (plain, slotted) = (plate(None), plate(Some((4, 0.04))));
    let mut worst = [Worst::default(), Worst::default()];
    for row in table::<Row>("slots_four_40mm.csv") {
        let ratio = bending(&slotted, row.n, &row.branch).sqrt();
        let found = ratio * lowest_hz(&plain, row.n, 0.0);
        let place = || format!("{} {}: {found}", row.n, row.branch);
        worst[0].add(relative_error(found, row.rest_hz), place);
        worst[1].add(relative_error(found, row.ccx_rest_hz), place);
    }
    assert_eq!(worst[0].count, 8);
    worst[0].assert_at_most("slotted plate at rest", 5e-4);
    worst[1].assert_at_most("slotted solids at rest", 1.5e-2);
}

/// A sector against whole circles.
#[test]
fn sectors_of_other_layouts_have_the_frequencies_of_whole_circles() {
    let plain = plate(None);
    let mut worst = Worst::default();
    for row in table::<Layout>("slots_whole_circle.csv") {
        let slotted = plate(Some((row.count, row.depth_m)));
        let ratio = bending(&slotted, row.n, &row.branch).sqrt();
        let found = ratio * lowest_hz(&plain, row.n, 0.0);
        let error = relative_error(found, row.rest_hz);
        worst.add(error, || {
            format!("{} of {} m, n = {}: {found}", row.count, row.depth_m, row.n)
        });
    }
    assert_eq!(worst.count, 28);
    worst.assert_at_most("whole circles", 5e-4);
}

/// The wave of the lower branch, with c_n and the mean stress, against the plate with cuts in its own stress.
#[test]
fn frequencies_in_rotation_are_those_of_a_turning_plate_with_cuts() {
    let slotted = plate(Some((4, 0.04)));
    let mut worst = Worst::default();
    for row in table::<Row>("slots_four_40mm.csv") {
        if row.branch == "high" {
            continue;
        }
        for (rpm, hz) in [
            (0.0, row.rest_hz),
            (1500.0, row.rpm1500_hz),
            (3000.0, row.rpm3000_hz),
            (4500.0, row.rpm4500_hz),
        ] {
            let found = lowest_hz(&slotted, row.n, rpm);
            worst.add(relative_error(found, hz), || {
                format!("n = {} at {rpm}: {found}", row.n)
            });
        }
    }
    assert_eq!(worst.count, 24);
    worst.assert_at_most("slotted plate in rotation", 1e-2);
}

#[test]
fn critical_speeds_are_those_of_the_lower_branches() {
    let model = reference_model(&saw(Some((4, 0.04))), rad_per_s(6000.0));
    let mut worst = [Worst::default(), Worst::default()];
    for row in table::<Row>("slots_four_40mm.csv") {
        let (Some(plate_rpm), Some(solids_rpm)) = (row.critical_rpm, row.ccx_critical_rpm) else {
            continue;
        };
        if row.branch == "high" {
            continue;
        }
        let own = model
            .critical
            .iter()
            .find(|c| c.name.diameters() == row.n)
            .unwrap();
        let found = rpm(own.speed_rad_per_s);
        let place = || format!("n = {}: {found}", row.n);
        worst[0].add(relative_error(found, plate_rpm), place);
        worst[1].add(relative_error(found, solids_rpm), place);
    }
    assert_eq!(worst[0].count, 4);
    worst[0].assert_at_most("critical speeds of the slotted plate", 1e-2);
    worst[1].assert_at_most("critical speeds of slotted solids", 1.5e-2);
}

/// First critical speeds of the plate with cuts, and of the plain one.
#[test]
fn deeper_and_more_slots_lower_the_first_critical_speed() {
    for (slots, expected_rpm, n) in [
        (None, 4485.0, 2),
        (Some((4, 0.04)), 4117.0, 2),
        (Some((6, 0.04)), 3942.0, 3),
        (Some((4, 0.07)), 3392.0, 3),
    ] {
        let model = reference_model(&saw(slots), rad_per_s(5000.0));
        let first = &model.critical[0];
        assert_close(
            &format!("{slots:?}"),
            rpm(first.speed_rad_per_s),
            expected_rpm,
            1e-2,
        );
        assert_eq!(first.name.diameters(), n, "{slots:?}");
    }
}

/// In units of ρΩ²b², relative to the largest stress at the radius.
#[test]
fn the_mean_stress_is_that_of_a_plane_with_cuts() {
    let slotted = plate(Some((4, 0.04)));
    let stress = &slotted.slotted().unwrap().stress;
    let mut worst = Worst::default();
    for row in table::<Stress>("slots_mean_stress.csv") {
        let [radial, hoop] = stress.at_m2(row.r_m).map(|x| x / 0.04);
        for (found, expected) in [(radial, row.mean_sr), (hoop, row.mean_st)] {
            worst.add(relative_error(found, expected), || {
                format!("at {} m: {found}", row.r_m)
            });
        }
    }
    assert_eq!(worst.count, 70);
    worst.assert_at_most("mean stress", 1e-2);
}

/// Faces of slots carry no traction: (r σ_rr)′ = σ_θθ − ρΩ²r² holds for the means, here integrated from the bore to any radius.
#[test]
fn the_mean_stress_is_in_equilibrium() {
    for slots in [(4, 0.04), (24, 0.02), (1, 0.1)] {
        let slotted = plate(Some(slots));
        let stress = &slotted.slotted().unwrap().stress;
        let steps = 60_000;
        let step = 0.15 / f64::from(steps);
        let (mut hoop, mut worst) = (0.0, 0.0_f64);
        let at_bore = 0.05 * stress.at_m2(0.05 + 1e-9)[0];
        for k in 0..steps {
            let r = 0.05 + (f64::from(k) + 0.5) * step;
            hoop += step * (stress.at_m2(r)[1] - r * r);
            let end = r + 0.5 * step - 1e-9;
            worst = worst.max((end * stress.at_m2(end)[0] - at_bore - hoop).abs());
        }
        assert!(worst < 2e-2 * at_bore, "{slots:?}: {worst} of {at_bore}");
    }
}

/// c_n is below 1 and falls with the depth, to that of the plain blade at depth 0, without a jump.
#[test]
fn bending_falls_smoothly_with_the_depth() {
    for count in [3, 4, 6, 9] {
        let depths: Vec<f64> = (0..24).map(|k| 0.004 + 0.004 * f64::from(k)).collect();
        let plates: Vec<Plate> = depths
            .iter()
            .map(|depth| plate(Some((count, *depth))))
            .collect();
        for n in 2..=5 {
            let all = plates
                .iter()
                .map(|plate| plate.slotted().unwrap().bending(n));
            let all: Vec<f64> = std::iter::once(1.0).chain(all).collect();
            assert!(all[1] > 0.99, "{count} {n}: {all:?}");
            assert!(
                all.is_sorted_by(|few, more| few > more),
                "{count} {n}: {all:?}"
            );
            for three in all.windows(3) {
                let bend = (three[0] - 2.0 * three[1] + three[2]).abs();
                assert!(bend < 0.02, "{count} {n}: {three:?}");
            }
        }
    }
}

/// More slots of one depth take more of the mean of both branches.
#[test]
fn bending_falls_with_the_number_of_slots() {
    for n in 2..=5 {
        let mean = |count: u32| {
            let slotted = plate(Some((count, 0.03)));
            let own = &slotted.slotted().unwrap().waves[n];
            own.iter().map(|branch| branch.bending).sum::<f64>() / own.len() as f64
        };
        let all: Vec<f64> = [1, 2, 3, 4, 5, 6, 8, 10, 14, 20, 40].map(mean).into();
        assert!(all.is_sorted_by(|few, more| few > more), "{n}: {all:?}");
    }
}

/// The shallowest slots that are allowed leave a blade as it is.
#[test]
fn slots_without_depth_change_nothing() {
    let (plain, slotted) = (plate(None), plate(Some((4, 0.000_76))));
    for n in 0..8 {
        for rpm in [0.0, 3000.0] {
            let [found, expected] = [&slotted, &plain].map(|plate| lowest_hz(plate, n, rpm));
            assert_close(&format!("n = {n} at {rpm} rpm"), found, expected, 2e-4);
        }
    }
}

/// A blade with steps, heavy teeth, a clamp that yields, or on a spline is that without slots, too.
#[test]
fn slots_without_depth_change_no_blade() {
    let changes: [fn(&mut SceneFile); 4] = [
        |saw| {
            saw.blade.profile = serde_json::from_str(r#"[{ "radius_m": 0.12, "thickness_m": 0.0016 }, { "radius_m": 0.18, "thickness_m": 0.0016 }]"#).unwrap()
        },
        |saw| {
            saw.blade.rim =
                serde_json::from_str(r#"{ "mass_per_tooth_kg": 0.01, "radius_m": 0.19 }"#).unwrap()
        },
        |saw| {
            saw.mount = Mount::Collar {
                diameter_m: 0.1,
                in_plane: InPlane::Free,
                clamp_stiffness_n_m_per_rad_per_m: Some(1e4),
            };
        },
        |saw| saw.mount = Mount::Spline {},
    ];
    for (k, change) in changes.into_iter().enumerate() {
        let plates = [None, Some((4, 0.001))].map(|slots| {
            let saw = saw(slots).edited(change).unwrap();
            Plate::new(&saw, Resolution::of(Accuracy::Reference))
        });
        for n in 0..8 {
            for speed in [0.0, 3000.0] {
                let [expected, found] = plates.each_ref().map(|plate| {
                    let stiffness = plate.harmonics[n].body_frame_stiffness(rad_per_s(speed));
                    let squares = stiffness.self_adjoint_eigenvalues(Side::Lower).unwrap();
                    // Heave and tilt do not bend a blade on a spline.
                    let rigid = usize::from(k == 3 && n < 2);
                    squares[rigid].sqrt() / TAU
                });
                assert_close(
                    &format!("blade {k}, n = {n} at {speed} rpm"),
                    found,
                    expected,
                    1e-3,
                );
            }
        }
    }
}

/// c_n alone leaves critical speeds too high: slots also free the hoop stress of the rim.
#[test]
fn slots_free_the_hoop_stress_of_the_rim() {
    let (plain, slotted) = (plate(None), plate(Some((4, 0.04))));
    for n in 2..=5 {
        let speed = 3000.0;
        let with_both = lowest_hz(&slotted, n, speed).powi(2);
        let at_rest = lowest_hz(&slotted, n, 0.0).powi(2);
        let stiffened = lowest_hz(&plain, n, speed).powi(2) - lowest_hz(&plain, n, 0.0).powi(2);
        assert!(with_both < at_rest + stiffened, "{n}");
    }
}

/// Waves of more diameters than are computed keep the smallest share of all, so that the proof for higher waves holds for it.
#[test]
fn waves_beyond_those_computed_keep_the_smallest_share() {
    let plate = plate(Some((4, 0.07)));
    let slotted = plate.slotted().unwrap();
    let least = (0..slotted.even_from())
        .map(|n| slotted.bending(n))
        .fold(1.0, f64::min);
    assert!(least > 0.0 && slotted.even_from() == 13);
    assert_eq!(slotted.bending(13), least);
    assert_eq!(slotted.bending(300), least);
}

#[test]
fn a_blade_without_slots_computes_none() {
    assert!(plate(None).slotted().is_none());
}

/// A blade beside a pad of 20 mm.
fn guided(slots: Option<(u32, f64)>, radius_m: f64) -> Scene {
    let pad = format!(
        r#"{{ "radius_m": {radius_m}, "angle_deg": 0, "radial_length_m": 0.02, "tangential_length_m": 0.02,
            "stiffness_n_per_m": 2e5 }}"#
    );
    let saw = saw(slots).edited(|saw| {
        saw.guides = vec![serde_json::from_str(&pad).unwrap()];
        saw.accuracy = Accuracy::Draft;
        saw.operating_rpm = None;
    });
    saw.unwrap()
}

/// Without an operating speed, beside the slots no speed is called stable, and above the first critical speed none with any guide: Floquet
/// multipliers show growth there that the axisymmetric blade lacks.
#[test]
fn a_slotted_saw_beside_guides_is_not_called_stable_where_slots_pass_them() {
    let slots = Some((4, 0.04));
    for (slots, radius_m, below, above) in [
        (
            slots,
            0.185,
            StabilityState::NotCovered,
            StabilityState::NotCovered,
        ),
        (
            slots,
            0.125,
            StabilityState::NotCovered,
            StabilityState::NotCovered,
        ),
        (
            slots,
            0.1,
            StabilityState::Stable,
            StabilityState::NotCovered,
        ),
        (None, 0.1, StabilityState::Stable, StabilityState::Stable),
    ] {
        let saw = guided(slots, radius_m);
        let analysis = Analysis::new(&saw).unwrap();
        let first = analysis.model.critical[0].speed_rad_per_s;
        let speeds = (1..400).map(|k| first * (1.0 + 2e-3 * f64::from(k)));
        let mut states = speeds.map(|speed| analysis.verdict(speed).state);
        let is_open = |state: &StabilityState| {
            use StabilityState::{Divergence, Flutter, TooClose};
            !matches!(state, Divergence | Flutter | TooClose)
        };
        let states = [
            analysis.verdict(rad_per_s(2000.0)).state,
            states.find(is_open).unwrap(),
        ];
        assert_eq!(states, [below, above], "{slots:?} {radius_m}");
        let report = analysis.report();
        let warns = report
            .warnings
            .iter()
            .any(|words| words.contains("slots turn and guides do not"));
        assert_eq!(warns, slots.is_some());
        let window = analysis.window_without_instability(rad_per_s(2000.0));
        assert_eq!(window.is_some(), below == StabilityState::Stable);
        // At the speed of a check multipliers decide.
        let limits = Limits::at(rad_per_s(2000.0));
        let verdict = check(&saw, &limits).unwrap().verdict;
        assert_eq!(verdict.floquet.is_some(), slots.is_some());
        if let Some(found) = verdict.floquet {
            let largest = found.growth_per_s.into_iter().fold(0.0, f64::max);
            let is_certain = largest + found.error_per_s[1] < 0.0025;
            assert_eq!(verdict.answer == Some(Answer::Yes), is_certain, "{largest}");
        }
    }
}

/// Frequencies of the lower branches of the plate with cuts give the depth of its slots, from a scene with slots of 30 mm.
#[test]
fn taps_tell_the_depth_of_slots() {
    let rows = table::<Row>("slots_four_40mm.csv").into_iter();
    let rows: Vec<Row> = rows.filter(|row| row.branch != "high").collect();
    let names: Vec<String> = rows.iter().map(|row| format!("n{}", row.n)).collect();
    let hz: Vec<String> = rows.iter().map(|row| row.rest_hz.to_string()).collect();
    let taps = format!("rpm,{}\n0,{}\n", names.join(","), hz.join(","));
    let measurement = Measurement::from_csv("taps", &taps).unwrap();
    let saw = saw(Some((4, 0.03)));
    let free = [Freed::new(saw.file(), "blade.slots.depth_m", 0.01, 0.08).unwrap()];
    let options = Options {
        starts: 2,
        ..Options::default()
    };
    let found = fit(&saw, &measurement, &free, &options, &|_, _| ()).unwrap();
    assert_close("depth", found.parameters[0].value, 0.04, 5e-3);
}
