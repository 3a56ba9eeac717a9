//! Goal: a study describes its saws correctly: quantiles and probabilities that are known exactly, the numbers of
//! `analyze` and `check`, and the same bytes for every way of computation.
//!
//! Source: the waves of a free blade depend on bending and rotation only, K_b ~ h³ and M ~ h, so that every critical
//! speed is proportional to the thickness h.

use crate::common::{assert_close, says, scene};
use sawflutter::analyses::check::{Limits, check};
use sawflutter::analyses::gap::{Options, gap};
use sawflutter::analyses::study::{Outcome, Saw, Study, StudyError, StudyFile};
use sawflutter::model::scene::{
    Accuracy, ContactLaw, InPlane, LimitsFile, Mount, Scene, SideForceFile, rad_per_s, rpm,
};
use sawflutter::stability::{Analysis, Onsets};

fn free_blade() -> Scene {
    let free = scene("free-blade");
    free.edited(|saw| saw.accuracy = Accuracy::Draft).unwrap()
}

fn study(scene: Scene, json: &str) -> Result<Study, StudyError> {
    Study::new(scene, StudyFile::from_json(json)?)
}

fn all(study: &Study) -> Vec<Saw> {
    study.saws(&|_| ())
}

/// The blade in a collar: no saw of a study passes if nothing holds its rigid motions. Its critical speeds are proportional to the root of
/// the modulus, too.
fn held_blade() -> Scene {
    let held = free_blade().edited(|saw| {
        saw.mount = Mount::Collar {
            diameter_m: 0.25,
            in_plane: InPlane::Free,
            clamp_stiffness_n_m_per_rad_per_m: None,
        };
    });
    held.unwrap()
}

const THICKNESS: f64 = 0.0028;

fn first_critical_rpm(saw: &Scene) -> f64 {
    let nominal = saw.edited(|saw| saw.sweep.as_mut().unwrap().to_rpm = 1000.0);
    rpm(Onsets::new(&nominal.unwrap())
        .unwrap()
        .first_critical_rad_per_s
        .unwrap())
}

#[test]
fn quantiles_of_critical_speed_are_those_of_thickness() {
    let study = study(
        free_blade(),
        r#"{ "name": "thickness", "saws": 512, "to_rpm": 1000, "quantiles": [0, 0.1, 0.5, 0.9, 1],
             "parameters": [{ "path": "blade.thickness_m",
                              "distribution": { "kind": "tolerance", "plus_minus": 1e-4 } }] }"#,
    )
    .unwrap();
    let report = study.report(&all(&study)).unwrap();
    let per_metre = first_critical_rpm(&free_blade()) / THICKNESS;
    for quantile in &report.all.first_critical.quantiles {
        let exact = THICKNESS + 1e-4 * (2.0 * quantile.share - 1.0);
        // Each 512th of the range contains one of the 512 points, and each quantile lies between two neighbours.
        let allowed = 2.0 * 2e-4 / 512.0 / THICKNESS;
        let found = quantile.rpm.unwrap();
        assert_close(
            &format!("{} of the saws", quantile.share),
            found,
            per_metre * exact,
            allowed,
        );
    }
    assert_eq!(
        (report.all.flutter.saws, report.all.flutter.beyond),
        (0, 512)
    );
    assert!(report.all.flutter.quantiles.iter().all(|q| q.rpm.is_none()));
    let histogram = report.all.first_critical.histogram.unwrap();
    assert_eq!(histogram.counts.iter().sum::<usize>(), 512);
}

/// The search for the basis of each saw begins with that of the saw without deviations: each result is as accurate as
/// promised, by comparison with an analysis of its own, and does not depend on the saws computed before.
#[test]
fn a_saw_of_a_study_is_as_accurate_as_an_analysis_of_its_own() {
    let tolerance = 6e-3;
    let paper = Scene::paper()
        .edited(|saw| saw.tolerance = Some(tolerance))
        .unwrap();
    let json = r#"{ "name": "pads", "saws": 6, "to_rpm": 2500, "seed": 11, "parameters": [
        { "path": "guides[0].radius_m", "distribution": { "kind": "uniform", "from": 0.17, "to": 0.28 } },
        { "path": "guides[0].stiffness_n_per_m",
          "distribution": { "kind": "uniform", "from": 1e5, "to": 6e7 } }] }"#;
    let study = || study(paper.clone(), json).unwrap();
    let (forwards, backwards) = (study(), study());
    let mut last_first: Vec<Saw> = (0..6).rev().map(|index| backwards.saw(index)).collect();
    last_first.reverse();
    let saws = all(&forwards);
    assert_eq!(saws, last_first);
    let nominal = Onsets::new(&paper).unwrap().functions;
    for saw in &saws {
        let scene = Scene::paper().edited(|file| {
            (file.tolerance, file.guides[0].radius_m) = (Some(tolerance), saw.values[0]);
            file.guides[0].stiffness_n_per_m = saw.values[1];
            file.sweep.as_mut().unwrap().to_rpm = 2500.0;
        });
        let own = Onsets::new(&scene.unwrap()).unwrap();
        let found = saw.found().unwrap();
        assert!(found.functions >= nominal, "{saw:?}");
        assert!(found.estimated_relative_error <= tolerance, "{saw:?}");
        let lowest = rpm(own.first_critical_rad_per_s.unwrap());
        let what = format!("saw {}", saw.index);
        assert_close(
            &what,
            found.first_critical_rpm.unwrap(),
            lowest,
            2.0 * tolerance,
        );
    }
}

/// Critical speed is proportional to the root of the modulus: for a normal modulus a table of the normal distribution
/// gives the probability.
#[test]
fn the_probability_of_passing_is_that_of_the_distribution() {
    let critical = first_critical_rpm(&held_blade());
    // The limit is one standard deviation below the mean: the share Φ(1) of all saws passes, and Φ(3) − Φ(−1) of those
    // within three deviations.
    let asked = critical * (1.0_f64 - 0.02).sqrt();
    let text = format!(
        r#"{{ "name": "modulus", "saws": 1024, "seed": 7, "to_rpm": 1000,
             "parameters": [{{ "path": "blade.material.youngs_modulus_pa",
                 "distribution": {{ "kind": "normal", "standard_deviation": 4.06e9 }} }}],
             "limits": {{ "operating_rpm": 100, "min_critical_rpm": {asked} }} }}"#
    );
    let study = study(held_blade(), &text).unwrap();
    let passing = study.report(&all(&study)).unwrap().all.passing.unwrap();
    let (three, one) = (0.998_650_101_968_369_9, 0.158_655_253_931_457_05);
    let exact = (three - one) / (2.0 * three - 1.0);
    assert!(
        (passing.probability - exact).abs() <= 1.0 / 1024.0,
        "{}",
        passing.probability
    );
    let [low, high] = passing.interval.unwrap();
    assert!(low < exact && exact < high);
    let kept: Vec<usize> = passing.criteria.iter().map(|c| c.passed).collect();
    let keys: Vec<&str> = passing.criteria.iter().map(|c| c.key.as_str()).collect();
    let place = keys.iter().position(|key| *key == "min_critical").unwrap();
    for (k, kept) in kept.into_iter().enumerate() {
        let expected = if k == place { passing.passed } else { 1024 };
        assert_eq!(kept, expected, "{keys:?}");
    }
}

/// Studies of the paper's saw, at the value of its scene and at another one.
#[test]
fn a_saw_of_a_study_is_the_one_that_analyze_and_check_see() {
    let paper = Scene::paper()
        .edited(|saw| saw.accuracy = Accuracy::Draft)
        .unwrap();
    let text = r#"{ "name": "pads", "to_rpm": 2400,
        "parameters": [{ "path": "guides[0].angle_deg",
                         "distribution": { "kind": "grid", "values": [-55, -80] } }],
        "limits": { "operating_rpm": 1800, "min_flutter_rpm": 2300 } }"#;
    let study = study(paper.clone(), text).unwrap();
    for saw in all(&study) {
        let limits = Limits {
            limits: LimitsFile {
                min_flutter_rpm: Some(2300.0),
                ..LimitsFile::default()
            },
            ..Limits::at(rad_per_s(1800.0))
        };
        let own = paper
            .edited(|own| own.guides[0].angle_deg = saw.values[0])
            .unwrap();
        let found = saw.found().unwrap();
        let criteria = check(&own, &limits).unwrap().verdict.limits;
        let of_speeds = criteria.iter().take(found.kept.len());
        let passed: Vec<bool> = of_speeds.map(|c| c.is_kept()).collect();
        assert_eq!(found.kept, passed);
        let wider = own.edited(|own| own.sweep.as_mut().unwrap().to_rpm = 2400.0);
        let analysis = Analysis::new(&wider.unwrap()).unwrap();
        assert!(analysis.flutter_speed_rad_per_s.is_some());
        // The search for bands uses fewer modes than the chart, each accurate to 1e-8.
        for (one, other) in [
            (found.flutter_rpm, analysis.flutter_speed_rad_per_s),
            (found.first_merge_rpm, analysis.first_merge_rad_per_s),
        ] {
            assert_close("onset", one.unwrap(), rpm(other.unwrap()), 1e-7);
        }
        let lowest = analysis.model.critical[0].speed_rad_per_s;
        assert_eq!(found.first_critical_rpm, Some(rpm(lowest)));
        assert_eq!(
            Some(found.estimated_relative_error),
            analysis.estimated_relative_error
        );
    }
}

#[test]
fn a_grid_has_every_combination_and_shares_its_deviations() {
    let study = study(
        free_blade(),
        r#"{ "name": "grid", "saws": 4, "to_rpm": 1000, "parameters": [
            { "path": "blade.thickness_m", "distribution": { "kind": "grid", "values": [0.002, 0.003] } },
            { "path": "blade.material.density_kg_per_m3",
              "distribution": { "kind": "uniform", "from": 7700, "to": 7900 } },
            { "path": "blade.material.poisson_ratio",
              "distribution": { "kind": "grid", "values": [0.28, 0.29, 0.3] } } ] }"#,
    )
    .unwrap();
    assert_eq!((study.count(), study.drawn()), (24, 4));
    let values: Vec<Vec<f64>> = (0..24).map(|index| study.values(index)).collect();
    for (index, saw) in values.iter().enumerate() {
        let point = index / 4;
        assert_eq!(saw[0], [0.002, 0.003][point / 3]);
        assert_eq!(saw[2], [0.28, 0.29, 0.3][point % 3]);
        assert_eq!(saw[1], values[index % 4][1]);
        assert!((7700.0..7900.0).contains(&saw[1]));
    }
    let report = study.report(&all(&study)).unwrap();
    assert_eq!(report.groups.len(), 6);
    assert_eq!(report.groups[4].grid[0].value, 0.003);
    assert_eq!(report.groups[4].grid[1].value, 0.29);
    let thicker = report.groups[4].first_critical.median_rpm.unwrap();
    let thinner = report.groups[1].first_critical.median_rpm.unwrap();
    assert_close("half as thick again", thicker, 1.5 * thinner, 1e-9);
}

#[test]
fn impossible_saws_are_rows_with_a_reason() {
    let study = study(
        held_blade(),
        r#"{ "name": "refused", "limits": { "operating_rpm": 100 }, "parameters": [
            { "path": "blade.thickness_m",
              "distribution": { "kind": "grid", "values": [-0.001, 0.0028, 0.9] } } ] }"#,
    )
    .unwrap();
    let saws = all(&study);
    for (index, key) in [
        (0, "blade.thickness_m must be … (you gave -0.001)"),
        (2, "blade.thickness_m must be … (you gave 0.9)"),
    ] {
        let Outcome::Refused(reason) = &saws[index].outcome else {
            panic!("{:?}", saws[index]);
        };
        assert!(says(reason, key), "{reason}");
    }
    let report = study.report(&saws).unwrap();
    assert_eq!(
        (report.all.saws, report.all.refused, report.all.failed),
        (3, 2, 0)
    );
    assert_eq!(report.all.first_critical.saws, 1);
    let passing = report.all.passing.unwrap();
    assert_eq!((passing.passed, passing.interval), (1, None));
    assert_eq!(report.not_analysed.len(), 2);
}

#[test]
fn an_invalid_study_is_refused_by_key() {
    let thickness = r#""path": "blade.thickness_m""#;
    let even = r#""distribution": { "kind": "tolerance", "plus_minus": 1e-5 }"#;
    let grid = r#""distribution": { "kind": "grid", "values": [1, 2] }"#;
    let one = format!("{{ {thickness}, {even} }}");
    let cases = [
        (String::new(), r#""saws": 4"#, "parameters must be a list of the numbers that vary (you gave an empty list)"),
        (one.clone(), r#""seed": 4"#, "saws is missing"),
        (one.clone(), r#""saws": 0"#, "saws must be … (you gave 0)"),
        (
            format!("{one}, {{ \"path\": \"blade.material.poisson_ratio\", {grid} }}"),
            r#""saws": 4294967295"#,
            "the study must be of at most … (you gave one of 8589934590 saws)",
        ),
        (
            format!("{{ {thickness}, {grid} }}"),
            r#""saws": 4"#,
            "saws must be … (you gave 4)",
        ),
        (
            format!("{one}, {one}"),
            r#""saws": 4"#,
            "parameters[1].path",
        ),
        (
            format!(r#"{{ "path": "blade.teeth", {even} }}"#),
            r#""saws": 4"#,
            "parameters[0].path: ",
        ),
        (
            format!(r#"{{ "path": "guides[0].radius_m", {even} }}"#),
            r#""saws": 4"#,
            "parameters[0].path: the parameter must be … (you gave \"guides[0].radius_m\")",
        ),
        (one.clone(), r#""saws": 4, "to_rpm": 0"#, "to_rpm must be … (you gave 0)"),
        (
            one.clone(),
            r#""saws": 4, "limits": {}"#,
            "limits.operating_rpm is missing",
        ),
        (
            one.clone(),
            r#""saws": 4, "limits": { "operating_rpm": 9, "margin": 2 }"#,
            "limits.margin must be … (you gave 2)",
        ),
        (
            one.clone(),
            r#""saws": 4, "limits": { "operating_rpm": 9, "min_flutter_rpm": -1 }"#,
            "limits.min_flutter_rpm must be … (you gave -1)",
        ),
        (
            one.clone(),
            r#""saws": 4, "quantiles": [0.5, 5]"#,
            "quantiles[1] must be … (you gave 5)",
        ),
        (
            one.clone(),
            r#""saws": 4, "confidence": 95"#,
            "confidence must be … (you gave 95)",
        ),
        (
            one.clone(),
            r#""saws": 4, "limit": {}"#,
            "limit: there is no such key; did you mean limits?",
        ),
        (
            r#"{ "path": "operating_rpm", "distribution": { "kind": "tolerance", "plus_minus": 9 } }"#.to_owned(),
            r#""saws": 4"#,
            "parameters[0].path must be a number that changes critical speeds … (you gave operating_rpm)",
        ),
        (
            one.clone(),
            r#""saws": 4, "gap": { "force_n": 2 }"#,
            "gap.force_n: there is no such key; give it as side_force.force_n in the scene",
        ),
    ];
    for (parameters, rest, expected) in cases {
        let json = format!(r#"{{ "name": "x", "parameters": [{parameters}], {rest} }}"#);
        let error = study(free_blade(), &json).unwrap_err().to_string();
        let first = expected.split(" …").next().unwrap();
        assert!(error.starts_with(first), "{json}: {error}");
        assert!(says(&error, expected), "{json}: {error}");
    }
}

/// Guides with a gap. Below the gap the critical speed is that of the blade without guides, far beyond it that of the
/// linear chart; the pads carry the side force; deflections are those of the map of gaps.
#[test]
fn a_study_says_what_the_gap_does() {
    let saw = scene("paper")
        .edited(|saw| {
            (saw.accuracy, saw.operating_rpm) = (Accuracy::Draft, Some(1000.0));
            saw.sweep.as_mut().unwrap().to_rpm = 1700.0;
            let pad = &mut saw.guides[0];
            (pad.contact, pad.gap_m) = (ContactLaw::OneSided, Some(4e-5));
            saw.side_force = Some(SideForceFile::of(2.0));
        })
        .unwrap();
    let asked = |amplitude_m: f64| {
        let json = format!(
            r#"{{ "name": "gap", "to_rpm": 1700,
                  "gap": {{ "max_deviation_m": 2.5e-4, "amplitude_m": {amplitude_m} }},
                  "parameters": [{{ "path": "guides[0].gap_m",
                                    "distribution": {{ "kind": "grid", "values": [2e-5, 4e-5, 8e-5] }} }}] }}"#
        );
        let study = study(saw.clone(), &json).unwrap();
        let saws = all(&study);
        let report = study.report(&saws).unwrap();
        let rows = saws.iter().map(|saw| saw.found().unwrap().gap.clone());
        (rows.collect::<Vec<_>>(), report)
    };
    let (inside, report) = asked(2e-5);
    let gaps = gap(&saw, &Options::default());
    let map = gaps.unwrap().deviation;
    let of = |factor: f64| {
        let row = map
            .gap_factors
            .iter()
            .position(|own| (own - factor).abs() < 1e-9);
        let column = map.forces_n.iter().position(|own| (own - 2.0).abs() < 1e-9);
        map.deflection_m[row.unwrap()][column.unwrap()].unwrap()
    };
    for (numbers, factor) in inside.iter().zip([0.5, 1.0, 2.0]) {
        assert_close("deflection", numbers[0].unwrap(), of(factor), 2e-3);
        assert_close("pad force", numbers[1].unwrap(), 2.0, 1e-5);
    }
    let free = saw.edited(|saw| saw.guides.clear()).unwrap();
    let free_rpm = rpm(Onsets::new(&free)
        .unwrap()
        .first_critical_rad_per_s
        .unwrap());
    assert_close("inside the gap", inside[2][2].unwrap(), free_rpm, 2e-3);
    let (beyond, _) = asked(2e-2);
    let linear = rpm(Onsets::new(&saw).unwrap().first_critical_rad_per_s.unwrap());
    assert_close("beyond the gap", beyond[0][2].unwrap(), linear, 2e-3);
    let gap = report.all.gap.unwrap();
    let within = inside
        .iter()
        .filter(|numbers| numbers[0].unwrap() <= 2.5e-4);
    assert_eq!(gap.saws_within, Some(within.count()));
    assert_eq!(gap.deflection_at_cut.median, inside[1][0]);
}

/// The numbers of the scene are all usual; a limit of the study is not, and is named as before the scene had limits of its own.
#[test]
fn an_unusual_limit_of_a_study_is_said() {
    let asked = r#"{ "name": "slow", "saws": 1, "to_rpm": 1000,
        "parameters": [{ "path": "blade.thickness_m",
                         "distribution": { "kind": "tolerance", "plus_minus": 1e-5 } }],
        "limits": { "operating_rpm": 500, "min_critical_rpm": 3 } }"#;
    let study = study(free_blade(), asked).unwrap();
    let report = study.report(&all(&study)).unwrap();
    let said = "the lower limit of the first critical speed is 3 rpm";
    let [number] = report.unusual_numbers.as_slice() else {
        panic!("{:?}", report.unusual_numbers);
    };
    assert!(number.starts_with(said), "{number}");
}
