//! The effect of damping depends on the frame of its source.
//!
//! Air resists motion in space, and feeds reflected waves, whose energy in space is negative. Material damping resists
//! strain of the blade, and never feeds a wave of a free blade. With both, their ratio decides. (Huang and Crandall, J.
//! Appl. Mech. 41, 1974, for rotating shafts and disks.)

use std::sync::LazyLock;

use faer::c64;
use nalgebra::DMatrix;
use sawflutter::analyses::verdict::Criterion;
use sawflutter::model::analytical::free_wave::{FreeWave, LightDamping};
use sawflutter::model::plate::{HarmonicBlock, Plate, Resolution};
use sawflutter::model::scene::{
    Accuracy, DampingFile, Scene, SceneFile, SpeedRange, SweepFile, rad_per_s, rpm,
};
use sawflutter::modes::{SpectralModel, Strategy};
use sawflutter::stability::{Analysis, InstabilityKind, StabilityState};

const AIR: f64 = 6.3;
const MATERIAL: f64 = 1e-6;

fn free_blade(damping: DampingFile) -> Scene {
    let mut file: SceneFile = Scene::paper().file().clone();
    file.guides.clear();
    file.accuracy = Accuracy::Draft;
    file.damping = Some(damping);
    file.sweep = Some(SweepFile {
        from_rpm: 0.0,
        to_rpm: 2700.0,
    });
    Scene::try_from(file).unwrap()
}

fn analysis_of(air: f64, material: f64) -> Analysis {
    let damping = DampingFile {
        air_n_s_per_m3: air,
        material_retardation_time_s: material,
        ..DampingFile::default()
    };
    Analysis::new(&free_blade(damping)).unwrap()
}

#[test]
fn material_damping_alone_leaves_the_free_blade_stable_at_every_speed() {
    let analysis = analysis_of(0.0, MATERIAL);
    assert!(
        analysis.chart.instabilities.is_empty(),
        "{:?}",
        analysis.chart.instabilities
    );
    let samples = &analysis.chart.campbell.samples;
    let damped = samples
        .iter()
        .flat_map(|s| &s.modes)
        .filter(|m| m.mode.lambda.re < 0.0)
        .count();
    assert!(damped > 500, "damping acts on the modes: {damped}");
}

/// A wave of the free blade is critical at nΩ = ω_b; from this speed on it is reflected, and air feeds it.
#[test]
fn air_destabilises_exactly_the_reflected_waves() {
    let analysis = analysis_of(AIR, 0.0);
    let bands = &analysis.chart.instabilities;
    let mut critical: Vec<f64> = analysis
        .model
        .critical
        .iter()
        .map(|c| c.speed_rad_per_s)
        .collect();
    critical.dedup_by(|x, y| (*x / *y - 1.0).abs() < 1e-9);
    critical.retain(|c| *c < analysis.range_rad_per_s.to_rad_per_s);
    assert_eq!(bands.len(), critical.len());
    for (band, critical) in bands.iter().zip(critical) {
        assert!(
            (band.from_rad_per_s / critical - 1.0).abs() < 1e-7,
            "{} {}",
            rpm(band.from_rad_per_s),
            rpm(critical)
        );
        assert!(!band.closed, "a reflected wave stays unstable");
    }
}

/// Onset of a wave whose shape x changes with the speed: the closed form for the shape at the speed itself.
fn onset_in_closed_form(block: &HarmonicBlock, eta: f64, air_per_mass: f64, share: f64) -> f64 {
    let size = block.spin.nrows();
    let tension = &block.spin + DMatrix::identity(size, size) * block.diameters.pow(2) as f64;
    let from_shape_at = |speed: f64| {
        let eigen = (&block.bending + &tension * speed.powi(2)).symmetric_eigen();
        let x = eigen.eigenvectors.column(eigen.eigenvalues.imin());
        let quotient = |matrix: &DMatrix<f64>| (x.transpose() * matrix * x)[(0, 0)];
        let bending = quotient(&block.bending);
        let damping = LightDamping {
            material_to_air: eta * bending / air_per_mass,
            air_rotation_share: share,
        };
        let wave = FreeWave {
            nodal_diameters: block.diameters,
            rest_frequency_rad_per_s: bending.sqrt(),
            spin_stiffening: quotient(&tension),
        };
        wave.damped_onset_rad_per_s(damping).unwrap()
    };
    let mut speed = rad_per_s(1500.0);
    for _ in 0..20 {
        speed = from_shape_at(speed);
    }
    assert!((from_shape_at(speed) / speed - 1.0).abs() < 1e-12);
    speed
}

#[test]
fn with_both_the_onset_agrees_with_its_closed_form() {
    let analysis = analysis_of(AIR, MATERIAL);
    let plate = &analysis.model.plate;
    let air_per_mass = AIR / plate.blade.mass_per_area_kg_per_m2();
    let expected = onset_in_closed_form(&plate.harmonics[2], MATERIAL, air_per_mass, 0.0);
    let first = &analysis.chart.instabilities[0];
    // The closed form is of first order in damping ratios of 1e-4.
    assert!(
        (first.from_rad_per_s / expected - 1.0).abs() < 1e-6,
        "{} {}",
        rpm(first.from_rad_per_s),
        rpm(expected)
    );
    let critical = analysis.model.critical[0].speed_rad_per_s;
    assert!(
        first.from_rad_per_s > 1.02 * critical,
        "material damping holds on past the critical speed"
    );
}

/// Air that rotates with a share of the speed feeds a wave from a higher speed on, with and without damping of the
/// material. The wave of two diameters grows first.
#[test]
fn turning_air_delays_the_onset_as_its_closed_form_says() {
    for (material, share) in [(0.0, 0.05), (0.0, 0.1), (MATERIAL, 0.02)] {
        let analysis = Analysis::new(&free_blade(DampingFile {
            air_n_s_per_m3: AIR,
            material_retardation_time_s: material,
            air_rotation_share: share,
            ..DampingFile::default()
        }))
        .unwrap();
        let plate = &analysis.model.plate;
        let air_per_mass = AIR / plate.blade.mass_per_area_kg_per_m2();
        let first = &analysis.chart.instabilities[0];
        let expected = onset_in_closed_form(&plate.harmonics[2], material, air_per_mass, share);
        assert!(
            (first.from_rad_per_s / expected - 1.0).abs() < 1e-6,
            "{} {}",
            rpm(first.from_rad_per_s),
            rpm(expected)
        );
        assert!(first.from_rad_per_s > 1.05 * analysis.model.critical[0].speed_rad_per_s);
    }
    let with_blade = DampingFile {
        air_n_s_per_m3: AIR,
        air_rotation_share: 1.0,
        ..DampingFile::default()
    };
    let analysis = Analysis::new(&free_blade(with_blade)).unwrap();
    assert!(
        analysis.chart.instabilities.is_empty(),
        "air that goes with the blade only damps"
    );
}

/// λ of the guided saw tends to the undamped one linearly in the damping.
#[test]
fn the_undamped_limit_is_continuous() {
    let eigenvalues = |share: f64| {
        let scene = Scene::paper().edited(|saw| {
            saw.damping = Some(DampingFile {
                material_retardation_time_s: 1e-6 * share,
                air_n_s_per_m3: 5.0 * share,
                air_rotation_share: 0.4,
                ..DampingFile::default()
            });
        });
        let plate = Plate::new(&scene.unwrap(), Resolution::of(Accuracy::Draft));
        let model =
            SpectralModel::new(plate, SpeedRange::between_rpm(0.0, 2000.0), Strategy::Dense)
                .unwrap();
        let modes = model.all_modes(rad_per_s(1800.0)).unwrap();
        modes.iter().take(8).map(|m| m.lambda).collect::<Vec<_>>()
    };
    let (none, half, whole) = (eigenvalues(0.0), eigenvalues(0.01), eigenvalues(0.02));
    for k in 0..8 {
        let (near, far) = ((half[k] - none[k]).norm(), (whole[k] - none[k]).norm());
        assert!(far < 0.05 && far > 1e-6, "mode {k}: {far}");
        assert!((far / near - 2.0).abs() < 0.01, "mode {k}: {near} {far}");
    }
}

/// The paper's saw with a pad that damps with 50 N s/m, at draft accuracy.
static DAMPED_PAD: LazyLock<Analysis> = LazyLock::new(|| {
    let scene = Scene::paper().edited(|saw| {
        saw.guides[0].damping_n_s_per_m = 50.0;
        saw.accuracy = Accuracy::Draft;
    });
    Analysis::new(&scene.unwrap()).unwrap()
});

/// A damped pad feeds reflected waves from their critical speeds on, with 1e-5 1/s over hundreds of rpm, and hardly
/// changes the flutter of coalescing modes. Growth is compared with every eigenvalue of the full model, and the flutter
/// speed with the saw without damping.
#[test]
fn a_damped_pad_flutters_where_modes_meet_and_not_where_damping_feeds_a_wave() {
    let analysis = &*DAMPED_PAD;
    let scene = &analysis.scene;
    let plain = scene
        .edited(|file| file.guides[0].damping_n_s_per_m = 0.0)
        .unwrap();
    let undamped = Analysis::new(&plain).unwrap();
    let (found, expected) = (
        analysis.flutter_speed_rad_per_s.unwrap(),
        undamped.flutter_speed_rad_per_s.unwrap(),
    );
    // Growth reaches 0.25 1/s within the band in which the two modes coalesce without damping.
    let band = undamped
        .chart
        .instabilities
        .iter()
        .find(|b| b.from_rad_per_s == expected);
    assert!(
        (expected..band.unwrap().peak_rad_per_s).contains(&found),
        "{} {}",
        rpm(found),
        rpm(expected)
    );

    let speed = rad_per_s(1800.0);
    let verdict = analysis.verdict(speed);
    assert_eq!(verdict.state, StabilityState::Stable, "{verdict:?}");
    let modes = analysis.model.full_modes(speed).unwrap();
    let growth = modes.iter().map(|m| m.lambda.re).fold(f64::MIN, f64::max);
    assert!(growth > 1e-5 && growth < 3e-5, "{growth}");
    let bands = &analysis.chart.instabilities;
    let covering: Vec<f64> = bands.iter().filter_map(|b| b.growth_at(speed)).collect();
    assert!(
        covering.len() == 1 && (covering[0] / growth - 1.0).abs() < 1e-2,
        "{covering:?}"
    );

    // `check` gives the same answer.
    let limits = sawflutter::analyses::check::Limits::at(speed);
    let checked = sawflutter::check(scene, &limits).unwrap().verdict.limits;
    let mut of_motion = checked.iter().filter(|limit| limit.key == "operating");
    assert!(of_motion.all(Criterion::is_kept), "{checked:?}");

    for band in bands {
        assert!(
            band.to_rad_per_s > band.from_rad_per_s * (1.0 + 1e-9),
            "no band of zero width: {band:?}"
        );
        assert!(
            band.closed || band.to_rad_per_s == analysis.range_rad_per_s.to_rad_per_s,
            "{} {}",
            rpm(band.from_rad_per_s),
            rpm(band.to_rad_per_s)
        );
        let real = band.curve.iter().filter(|p| p.number.im == 0.0).count();
        let is_divergence = band.kind == InstabilityKind::Divergence;
        let expected = if is_divergence { band.curve.len() } else { 0 };
        // A band ends where its pair becomes real or complex.
        assert!(real.abs_diff(expected) <= 2, "one mechanism: {band:?}");
    }
}

/// A chart has enough points of each band that straight lines between them show its growth. Reference: dense eigenvalues of the whole
/// matrices in the middle of the longest step of each band.
#[test]
fn growth_of_a_damped_band_is_drawn_as_it_is() {
    let analysis = &*DAMPED_PAD;
    let samples = &analysis.chart.campbell.samples;
    let nearest = |lambdas: &mut dyn Iterator<Item = c64>, expected: c64| {
        let off = |lambda: &c64| (lambda - expected).norm();
        lambdas.min_by(|x, y| off(x).total_cmp(&off(y))).unwrap()
    };
    for band in &analysis.chart.instabilities {
        let frequency = |speed: f64| {
            let away = |point: usize| (band.curve[point].speed_rad_per_s - speed).abs();
            let points = 0..band.curve.len();
            let nearest = points.min_by(|x, y| away(*x).total_cmp(&away(*y)));
            band.curve[nearest.unwrap()].number.im
        };
        let drawn: Vec<(f64, f64)> = samples
            .iter()
            .filter(|sample| band.range().contains(sample.speed_rad_per_s))
            .map(|sample| {
                let speed = sample.speed_rad_per_s;
                let expected = c64::new(band.growth_at(speed).unwrap(), frequency(speed));
                let mut modes = sample.modes.iter().map(|named| named.mode.lambda);
                (speed, nearest(&mut modes, expected).re)
            })
            .collect();
        assert!(
            drawn.iter().any(|(speed, _)| *speed == band.peak_rad_per_s),
            "the dot of a peak lies on its curve"
        );
        // Dense solves of every step would take minutes: the longest is looked at.
        let step = |pair: &&[(f64, f64)]| pair[1].0 - pair[0].0;
        let longest = drawn.windows(2).max_by(|x, y| step(x).total_cmp(&step(y)));
        if let Some(pair) = longest {
            let speed = 0.5 * (pair[0].0 + pair[1].0);
            let line = 0.5 * (pair[0].1 + pair[1].1);
            let modes = analysis.model.full_modes(speed).unwrap();
            let mut modes = modes.iter().map(|mode| mode.lambda);
            let exact = nearest(&mut modes, c64::new(line, frequency(speed))).re;
            let off = (exact - line).abs();
            assert!(
                off <= 0.06 * band.peak_growth_per_s,
                "{off} at {} rpm: {band:?}",
                rpm(speed)
            );
        }
    }
}

/// In the range of a band one branch of the chart has its growth at every speed: continuation does not confuse the
/// growing mode of a coalesced pair with the decaying one.
#[test]
fn one_branch_of_a_chart_has_the_growth_of_a_damped_band() {
    let analysis = &*DAMPED_PAD;
    let campbell = &analysis.chart.campbell;
    let mut followed = 0;
    for band in &analysis.chart.instabilities {
        for [from, to] in band.counted(0.25).iter().map(SpeedRange::ends) {
            let follows = |branch: &sawflutter::modes::branches::Branch| {
                let mut inside = branch.points.iter().filter_map(|&point| {
                    let speed = campbell.samples[point.0].speed_rad_per_s;
                    let growth = campbell.mode(point).mode.lambda.re;
                    let is_inside = from * (1.0 + 1e-6) < speed && speed < to * (1.0 - 1e-6);
                    is_inside.then(|| (growth, band.growth_at(speed).unwrap()))
                });
                let first = inside.next();
                let close = |(found, expected): (f64, f64)| {
                    (found - expected).abs() <= 0.02 * expected.abs() + 1e-3
                };
                first.is_some_and(close) && inside.all(close)
            };
            let found = campbell.branches.iter().any(follows);
            assert!(found, "{} to {} rpm", rpm(from), rpm(to));
            followed += 1;
        }
    }
    assert!(followed >= 6, "{followed}");
}

/// A wave that becomes stationary turns into two real λ. Light damping changes no branch of the chart: the branch that
/// grows is the one that diverges without damping, and not another.
#[test]
fn damping_does_not_change_the_branch_of_a_divergence() {
    let branches = |damping: Option<DampingFile>| -> Vec<Vec<usize>> {
        let scene = Scene::paper().edited(|saw| {
            saw.damping = damping;
            saw.accuracy = Accuracy::Draft;
            saw.sweep = Some(SweepFile {
                from_rpm: 1400.0,
                to_rpm: 2650.0,
            });
        });
        let report = Analysis::new(&scene.unwrap()).unwrap().report();
        let bands = report.instabilities.into_iter();
        let divergences = bands.filter(|band| band.kind == InstabilityKind::Divergence);
        divergences.map(|band| band.branches).collect()
    };
    let damping = DampingFile {
        material_retardation_time_s: 1e-6,
        air_n_s_per_m3: 0.5,
        air_rotation_share: 0.5,
        ..DampingFile::default()
    };
    let undamped = branches(None);
    assert!(undamped.len() >= 3, "{undamped:?}");
    assert_eq!(branches(Some(damping)), undamped);
}

/// λ² + τω²λ + ω² = 0 for a wave of the free blade at rest, where ω is its frequency without damping: above 2/τ, 1592
/// Hz here, no wave oscillates, and below it the modes are listed in the order of the formula, slowest first.
#[test]
fn a_heavily_damped_blade_lists_the_modes_that_oscillate() {
    const RETARDATION_S: f64 = 2e-4;
    let damped = analysis_of(0.0, RETARDATION_S);
    let plain = damped.scene.edited(|saw| saw.damping = None).unwrap();
    let undamped = Analysis::new(&plain).unwrap();
    assert_eq!(damped.overdamped_at_rest, 0);
    assert!(damped.modes_at_rest.len() >= 10);
    let pairs = damped.modes_at_rest.iter().zip(&undamped.modes_at_rest);
    for (found, undamped) in pairs.take(10) {
        let omega = undamped.mode.lambda.im;
        let decay = 0.5 * RETARDATION_S * omega * omega;
        let expected = c64::new(-decay, (omega * omega - decay * decay).sqrt());
        let off = (found.mode.lambda - expected).norm() / omega;
        assert!(off < 1e-6, "{} {expected}", found.mode.lambda);
    }
    // A thin free blade wobbles at twice its speed without bending: its material does not resist this motion.
    let speed = rad_per_s(1200.0);
    let modes = damped.model.modes(speed).unwrap();
    let wobbles = |m: &&sawflutter::modes::Mode| (m.lambda.im / speed - 2.0).abs() < 1e-6;
    let wobble = modes.iter().find(wobbles).unwrap();
    assert_eq!(wobble.growth_per_s(), 0.0, "{}", wobble.lambda);
    assert!(modes.iter().all(|m| m.growth_per_s() <= 0.0));
    let report = damped.report();
    assert!(report.campbell.complete_to_hz > 100.0);
    assert!(report.critical_speeds_without_damping);
    assert!(
        report
            .summary()
            .contains("Critical speeds of the saw without its damping")
    );
}

/// Heave and tilt of a free blade in stationary air: λ = −c/(ρh), 0.29 1/s, without a frequency. They are counted, the
/// tilts about two diameters as the single pair that any rotation makes of them; the listed decrement is that of a wave
/// that oscillates.
#[test]
fn rigid_motions_in_air_are_counted_and_not_listed() {
    let report = analysis_of(AIR, 0.0).report();
    assert_eq!(report.overdamped_modes_at_rest, 2);
    for mode in &report.modes_at_rest {
        assert!(mode.frequency_hz > 20.0, "{}", mode.frequency_hz);
        assert!(mode.logarithmic_decrement.unwrap() < 0.1);
    }
    // Stationary air does not resist a stationary wave.
    assert!(!report.critical_speeds_without_damping);
}

/// The tilts of a free blade in air that turns with the share s of its speed: in space (λ + iΩ)² + c(λ + isΩ) + Ω² = 0 with
/// the damping c per mass. At a hundredth of the speed of the sweep one
/// of them is so slow that it might be taken for a rigid motion.
#[test]
fn slow_tilts_in_air_that_turns_obey_their_equation() {
    let damping = DampingFile {
        air_n_s_per_m3: AIR,
        air_rotation_share: 0.1,
        ..DampingFile::default()
    };
    let scene = free_blade(damping);
    let plate = Plate::new(&scene, Resolution::of(Accuracy::Draft));
    let per_mass = AIR / plate.blade.mass_per_area_kg_per_m2();
    let range = SpeedRange::between_rpm(0.0, 2700.0);
    let model = SpectralModel::new(plate, range, Strategy::Reduced).unwrap();
    for speed in [27.0, 600.0, 2000.0].map(rad_per_s) {
        let half = 0.5 * c64::new(per_mass, 2.0 * speed);
        let root = (half * half - c64::new(0.0, 0.1 * per_mass * speed)).sqrt();
        let modes = model.modes(speed).unwrap();
        for expected in [-half + root, -half - root] {
            let upper = c64::new(expected.re, expected.im.abs());
            let off = modes
                .iter()
                .map(|mode| (mode.lambda - upper).norm())
                .fold(f64::INFINITY, f64::min);
            assert!(off < 1e-6, "{} rpm: {upper} is off by {off:e}", rpm(speed));
        }
    }
}
