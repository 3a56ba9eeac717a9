//! Goal: a map has the results that each of its saws has alone; a run that was stopped continues.
//!
//! Independent values: `analyze` of the scene with the numbers typed in; the critical speed of a blade without guides is
//! proportional to its thickness.

use sawflutter::analyses::campbell::Report;
use sawflutter::analyses::map::{MapReport, Options, Range, map};
use sawflutter::model::scene::{Accuracy, Scene, SweepFile, rad_per_s};
use sawflutter::stability::Analysis;
use tempfile::TempDir;

use super::program::{
    assert_in_80_columns, assert_refused, names_in, out, run, text, write_scene, written,
};

fn saw(folder: &TempDir) -> String {
    let mut file = Scene::paper().file().clone();
    (file.accuracy, file.measured) = (Accuracy::Draft, None);
    file.operating_rpm = Some(2260.0);
    let path = write_scene(folder, &file);
    path.to_str().unwrap().to_owned()
}

#[test]
fn a_map_over_the_speed_holds_what_each_saw_is_alone() {
    let folder = TempDir::new().unwrap();
    let path = saw(&folder);
    let line = [
        "map",
        &path,
        "--x",
        "blade.thickness_m=2.6mm..3mm",
        "--points",
        "3",
    ];
    let output = run(&line, &folder);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let names = names_in(&out(&folder));
    assert_eq!(names, ["map.json", "map.png", "map.svg", "study.log"]);
    let summary = text(&output.stdout).to_owned();
    assert_in_80_columns(&summary);
    let map: MapReport = written(&folder, "map.json");
    assert_eq!(map.x.values, [0.0026, 0.0028, 0.003]);
    let alone = TempDir::new().unwrap();
    for (thickness, saw) in ["2.6mm", "2.8mm", "3mm"].iter().zip(&map.saws) {
        let set = format!("blade.thickness_m={thickness}");
        assert!(
            run(&["analyze", &path, "--set", &set], &alone)
                .status
                .success()
        );
        let report: Report = written(&alone, "report.json");
        let near = |a: f64, b: f64| (a / b - 1.0).abs() < 2e-3;
        let critical = saw.first_critical_rpm.unwrap();
        assert!(near(critical, report.critical_speeds[0].rpm));
        assert!(near(saw.flutter_rpm.unwrap(), report.flutter_rpm.unwrap()));
        assert_eq!(saw.instabilities.len(), report.instabilities.len());
        for (own, band) in saw.instabilities.iter().zip(&report.instabilities) {
            assert_eq!(own.kind, band.kind);
            assert!(near(own.from_rpm, band.from_rpm) && near(own.to_rpm, band.to_rpm));
            assert_eq!(own.counted_rpm.len(), band.counted_rpm.len());
        }
        assert_eq!(saw.critical_rpm.len(), report.critical_speeds.len());
        let operating = report.operating.unwrap();
        let own = saw.verdict.as_ref().unwrap();
        assert_eq!(own.answer, report.verdict.answer);
        assert_eq!(own.cause, report.verdict.cause);
        match (own.allowed_to_rpm, report.verdict.allowed_to_rpm) {
            (Some(own), Some(other)) => assert!(near(own, other), "{own} {other}"),
            (own, other) => assert_eq!(own, other),
        }
        match (saw.side_force_factor, operating.side_force_factor) {
            (Some(own), Some(other)) => assert!((own / other - 1.0).abs() < 1e-6, "{own} {other}"),
            (own, other) => assert_eq!(own, other),
        }
    }
    assert!(map.saws.iter().any(|saw| saw.side_force_factor.is_some()));
    assert!(summary.contains("times as far as at rest"), "{summary}");
    let causes: Vec<&str> = map
        .saws
        .iter()
        .filter_map(|saw| saw.verdict.as_ref()?.cause.as_deref())
        .collect();
    assert_eq!(causes[1], "flutter");
    let flutters = causes.iter().filter(|cause| **cause == "flutter").count();
    let words = summary.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(
        words.contains(&format!("cannot run (flutter {flutters}")),
        "{summary}"
    );

    // A second run of this line completes a log that was cut off, and writes the same bytes.
    let first = std::fs::read(out(&folder).join("map.json")).unwrap();
    let log = out(&folder).join("study.log");
    let whole = std::fs::read_to_string(&log).unwrap();
    let rows: Vec<&str> = whole.lines().collect();
    std::fs::write(&log, format!("{}\n", rows[..rows.len() - 1].join("\n"))).unwrap();
    assert!(run(&line, &folder).status.success());
    assert_eq!(std::fs::read(out(&folder).join("map.json")).unwrap(), first);
    let lines = std::fs::read_to_string(&log).unwrap().lines().count();
    assert_eq!(lines, rows.len());
}

#[test]
fn parts_of_a_map_are_put_together_over_two_numbers() {
    let folder = TempDir::new().unwrap();
    fn line<'a>(more: &[&'a str]) -> Vec<&'a str> {
        let numbers = [
            "blade.thickness_m=2.5mm..3mm",
            "blade.outer_diameter_m=0.6..0.72",
        ];
        let of = [
            "map",
            "--accuracy",
            "draft",
            "--points",
            "3",
            "--x",
            numbers[0],
        ];
        [&of[..], &["--y", numbers[1]], more].concat()
    }
    let page_path = folder.path().join("page.html");
    for part in ["1/2", "2/2"] {
        let output = run(&line(&["--shard", part]), &folder);
        assert!(output.status.success(), "{}", text(&output.stderr));
        assert!(text(&output.stdout).contains("without --shard"));
    }
    let output = run(&line(&["--report", page_path.to_str().unwrap()]), &folder);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let map: MapReport = written(&folder, "map.json");
    assert_eq!(map.saws.len(), 9);
    let rows: Vec<f64> = map.rows().map(|row| row[0].y.unwrap()).collect();
    assert_eq!(rows, [0.6, 0.66, 0.72]);
    assert!(!map.contours.is_empty());
    let page = std::fs::read_to_string(page_path).unwrap();
    assert!(page.contains("Flutter speed") && page.contains("<svg"));
}

#[test]
fn numbers_that_are_none_and_ranges_without_ends_are_refused() {
    let folder = TempDir::new().unwrap();
    for (words, said) in [
        (
            &["--x", "blade.thickness_m"][..],
            "--x blade.thickness_m has no range",
        ),
        (&["--x", "blade.thickness_m=3mm..2mm"], "--x was refused"),
        (
            &["--x", "blade.width_m=2..3"],
            "'blade.width_m=2..3' for '--x <PATH=FROM..TO>'",
        ),
        (
            &[
                "--x",
                "blade.thickness_m=2mm..3mm",
                "--y",
                "blade.thickness_m=2mm..3mm",
            ],
            "--y must be … (you gave blade.thickness_m again)",
        ),
        (
            &[
                "--x",
                "blade.thickness_m=2mm..3mm",
                "--y",
                "operating_rpm=1000..2000",
            ],
            "--y must be … (you gave operating_rpm)",
        ),
        (
            &["--x", "operating_rpm=1000..2000"],
            "a map over one number has the speed as its vertical axis",
        ),
        (
            &["--x", "blade.thickness_m=2mm..3mm", "--points", "1"],
            "--points must be … (you gave 1)",
        ),
        (
            &["--x", "blade.thickness_m=2mm..3mm", "--rpm", "-1"],
            "--rpm must be … (you gave -1)",
        ),
    ] {
        assert_refused(&[&["map"][..], words].concat(), said, &folder);
        assert!(!out(&folder).exists());
    }
}

/// The verdict of an analysis counts a critical speed beyond the sweep too, if the saw runs within 5 % of it.
#[test]
fn a_saw_runs_at_a_critical_speed_that_lies_just_beyond_the_sweep() {
    let scene = Scene::paper()
        .edited(|file| {
            (file.accuracy, file.measured) = (Accuracy::Draft, None);
            file.guides.clear();
            file.operating_rpm = Some(1450.0);
            file.sweep = Some(SweepFile {
                from_rpm: 0.0,
                to_rpm: 1450.0,
            });
        })
        .unwrap();
    let alone = Analysis::new(&scene).unwrap();
    let alone_rpm = alone.critical_rpm_at(rad_per_s(1450.0)).unwrap();
    let x = Range {
        path: "blade.thickness_m".into(),
        from: 0.0028,
        to: 0.0032,
    };
    let options = Options {
        points: Some(2),
        ..Options::over(x)
    };
    let report = map(scene, &options, &|_, _| ()).unwrap();
    let near = |saw: usize| {
        let limits = &report.saws[saw].verdict.as_ref().unwrap().limits;
        let mut of_critical = limits.iter().filter(|limit| limit.key == "critical");
        of_critical.find_map(|limit| limit.found_rpm)
    };
    let critical = [0, 1].map(near);
    assert!((critical[0].unwrap() / alone_rpm - 1.0).abs() < 1e-3);
    // The thicker blade has its critical speeds beyond 1.05 times the operating speed.
    assert_eq!(critical[1], None);
    assert!(report.saws.iter().all(|saw| saw.critical_rpm.is_empty()));
}
