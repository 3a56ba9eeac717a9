//! Goal: every command gives the same answer on a saw, for the same reason, with the same highest speed.
//!
//! Source: the verdict of `analyze`; each other command computes its own critical speeds and bands.

use sawflutter::analyses::campbell::Report;
use sawflutter::analyses::check::{Limits, check};
use sawflutter::analyses::compare::{NamedSaw, Saw, compare};
use sawflutter::analyses::door::CommandOptions;
use sawflutter::analyses::map::{Options, Range, map};
use sawflutter::analyses::report;
use sawflutter::analyses::size;
use sawflutter::analyses::study::{Study, StudyFile};
use sawflutter::analyses::verdict::{Answer, Verdict};
use sawflutter::model::scene::{
    Accuracy, InPlane, LimitsFile, Mount, Scene, SceneFile, SideForceFile, SweepFile,
};
use sawflutter::stability::Analysis;

/// Twenty saws: with and without guides, below and above critical speeds, within bands, at their edges, beyond the sweep, too fast at the
/// rim, with weak flutter, damped, and with limits of their own.
fn saws() -> Vec<Scene> {
    let base = || {
        Scene::paper().edited(|saw| {
            (saw.accuracy, saw.measured, saw.cut) = (Accuracy::Draft, None, None);
            saw.sweep = Some(SweepFile {
                from_rpm: 0.0,
                to_rpm: 2500.0,
            });
        })
    };
    let at = |rpm: f64, change: &dyn Fn(&mut SceneFile)| {
        let saw = base().unwrap().edited(|saw| {
            saw.operating_rpm = Some(rpm);
            change(saw);
        });
        saw.unwrap()
    };
    let limited = |limits: LimitsFile| move |saw: &mut SceneFile| saw.limits = Some(limits);
    let none = LimitsFile::default();
    let plain = |_: &mut SceneFile| ();
    let bare = |saw: &mut SceneFile| saw.guides.clear();
    let clamped = |saw: &mut SceneFile| {
        saw.guides.clear();
        saw.mount = Mount::Collar {
            diameter_m: 0.25,
            in_plane: InPlane::Fixed,
            clamp_stiffness_n_m_per_rad_per_m: None,
        };
    };
    let damped = |saw: &mut SceneFile| saw.guides[0].damping_n_s_per_m = 50.0;
    vec![
        at(0.001, &plain),
        at(900.0, &plain),
        at(1301.0, &plain),
        at(1302.0, &plain),
        at(1460.0, &plain),
        at(1535.0, &plain),
        at(1800.0, &plain),
        at(2255.8, &plain),
        at(2400.0, &plain),
        at(2600.0, &plain),
        at(900.0, &bare),
        at(900.0, &clamped),
        at(2450.0, &clamped),
        at(1800.0, &damped),
        at(
            1400.0,
            &limited(LimitsFile {
                margin: Some(0.95),
                ..none
            }),
        ),
        at(
            1400.0,
            &limited(LimitsFile {
                margin: Some(0.85),
                ..none
            }),
        ),
        at(
            900.0,
            &limited(LimitsFile {
                min_critical_rpm: Some(1600.0),
                ..none
            }),
        ),
        at(
            900.0,
            &limited(LimitsFile {
                min_flutter_rpm: Some(2300.0),
                ..none
            }),
        ),
        at(
            900.0,
            &limited(LimitsFile {
                max_rim_m_per_s: Some(30.0),
                ..none
            }),
        ),
        at(
            900.0,
            &limited(LimitsFile {
                max_deviation_m: Some(1e-5),
                ..none
            }),
        ),
    ]
}

/// Both verdicts, of which speeds have the errors of a draft.
fn assert_same(face: &str, saw: &Scene, found: &Verdict, expected: &Verdict) {
    let told = format!(
        "{face} at {:?}: {found:?}\n{expected:?}",
        saw.file().operating_rpm
    );
    assert_eq!(found.answer, expected.answer, "{told}");
    assert_eq!(found.cause, expected.cause, "{told}");
    let words = |verdict: &Verdict| {
        let letters = verdict.reason.chars().filter(|c| !c.is_ascii_digit());
        letters.collect::<String>()
    };
    assert_eq!(words(found), words(expected), "{told}");
    match (found.allowed_to_rpm, expected.allowed_to_rpm) {
        (Some(own), Some(other)) => assert!((own / other - 1.0).abs() < 2e-3, "{told}"),
        (own, other) => assert_eq!(own, other, "{told}"),
    }
}

#[test]
#[cfg_attr(debug_assertions, ignore = "many eigenproblems: run it in release")]
fn twenty_saws_have_one_verdict_each() {
    let mut answers = Vec::new();
    for (number, saw) in saws().into_iter().enumerate() {
        let report: Report = Analysis::new(&saw).unwrap().report();
        let expected = &report.verdict;
        let rpm = expected.rpm.unwrap();
        answers.push(expected.answer.unwrap());
        // The text.
        let words = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(words(&report.summary()).contains(&words(&expected.headline())));

        let checked = check(&saw, &Limits::of(&saw, rpm).unwrap()).unwrap();
        // A check sweeps as far as its limits require.
        if checked.to_rpm == report.campbell.to_rpm {
            assert_same("check", &saw, &checked.verdict, expected);
            // Numbers that no saw has fail a check.
            let is_usual = checked.unusual_numbers.is_empty();
            assert_eq!(
                checked.passed,
                is_usual && expected.answer == Some(Answer::Yes)
            );
        }

        let named = NamedSaw {
            name: "saw".to_owned(),
            saw: Saw::Scene(Box::new(saw.clone())),
        };
        let compared = compare(vec![named], &|_, _| ()).unwrap();
        assert_same("compare", &saw, &compared.saws[0].verdict, expected);

        let density = saw.file().blade.material.density_kg_per_m3;
        let x = Range {
            path: "blade.material.density_kg_per_m3".into(),
            from: density,
            to: 1.01 * density,
        };
        let options = Options {
            points: Some(2),
            ..Options::over(x)
        };
        let mapped = map(saw.clone(), &options, &|_, _| ()).unwrap();
        let own = mapped.saws[0].verdict.as_ref().unwrap();
        if mapped.to_rpm == report.campbell.to_rpm {
            assert_same("map", &saw, own, expected);
        }

        let sizing = size::Options {
            vary: vec![(
                "blade.material.density_kg_per_m3".to_owned(),
                Some((density, 1.01 * density)),
            )],
            points: 3,
            ..size::Options::default()
        };
        let sized = sizing.compute(&saw, &|_| ()).unwrap();
        // It goes on to the operating speed.
        if expected.cause.as_deref() != Some("outside_sweep") {
            assert_eq!(sized.answers[0], expected.answer, "size {number}");
        }
        if expected.answer == Some(Answer::Yes) {
            // The value of the scene is the answer.
            assert_same("size", &saw, &sized.answer.unwrap().verdict, expected);
        }

        let text = format!(
            r#"{{ "name": "one", "to_rpm": 2500, "parameters": [{{ "path": "blade.material.density_kg_per_m3",
                "distribution": {{ "kind": "grid", "values": [{density}] }} }}] }}"#
        );
        let study = Study::new(saw.clone(), StudyFile::from_json(&text).unwrap()).unwrap();
        let passed = study.saw(0).found().unwrap().passed().unwrap();
        assert_eq!(
            passed,
            expected.answer == Some(Answer::Yes),
            "study {number}"
        );

        if number % 5 == 1 {
            let design = report::report(&saw, &report::Options::default(), &|_| ()).unwrap();
            assert_same("report", &saw, &design.verdict, expected);
        }
    }
    let count = |answer: Answer| answers.iter().filter(|own| **own == answer).count();
    assert!(
        Answer::ALL.into_iter().all(|answer| count(answer) >= 4),
        "{answers:?}"
    );
}

/// The deflection is proportional to the force. A clamped blade may deflect by half its thickness of 2.8 mm; beyond five thicknesses the
/// deflection itself is unknown.
#[test]
#[cfg_attr(debug_assertions, ignore = "many eigenproblems: run it in release")]
fn a_deflection_beyond_the_model_puts_a_clamped_saw_at_risk() {
    let judged = |force_n: f64| {
        let saw = Scene::paper().edited(|saw| {
            (saw.accuracy, saw.measured, saw.cut) = (Accuracy::Draft, None, None);
            saw.guides.clear();
            saw.operating_rpm = Some(900.0);
            saw.side_force = Some(SideForceFile::of(force_n));
            saw.mount = Mount::Collar {
                diameter_m: 0.25,
                in_plane: InPlane::Fixed,
                clamp_stiffness_n_m_per_rad_per_m: None,
            };
        });
        Analysis::new(&saw.unwrap()).unwrap().report()
    };
    let deflection_m = |report: &Report| {
        let operating = report.operating.as_ref().unwrap();
        operating.deviation.as_ref().unwrap().deflection_m
    };
    let by_one_newton = deflection_m(&judged(1.0)).unwrap();
    for (thicknesses, cause) in [
        (0.49, None),
        (0.51, Some("validity")),
        (4.9, Some("validity")),
        (5.1, Some("validity")),
    ] {
        let report = judged(thicknesses * 2.8e-3 / by_one_newton);
        assert_eq!(report.verdict.cause.as_deref(), cause, "{thicknesses}");
        assert_eq!(deflection_m(&report).is_some(), thicknesses < 5.0);
        assert_eq!(report.verdict.allowed_to_rpm.is_none(), cause.is_some());
    }
}
