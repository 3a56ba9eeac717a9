//! Goal: the program's output is reliable for the person or script that runs it: all files or none, one clear message
//! for a bad scene, exit code 0 or 2, lines that fit a terminal.
//!
//! Source: the scene and report keys and exit codes of docs/reference and `--help`.

use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Output, Stdio};
use std::sync::OnceLock;

use sawflutter::analyses::campbell::Report;
use sawflutter::model::scene::{Accuracy, Scene};
use serde_json::Value;
use tempfile::TempDir;

use super::program::{
    assert_in_80_columns, names_in, program, quick_scene, sawflutter, text, write_scene,
};

const FILES: [&str; 4] = [
    "campbell.csv",
    "campbell.png",
    "campbell.svg",
    "report.json",
];

fn read(path: PathBuf) -> Vec<u8> {
    std::fs::read(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// The built-in saw, computed once for all tests that read its output.
struct DefaultRun {
    folder: PathBuf,
    output: Output,
    report: Report,
}

fn default_run() -> &'static DefaultRun {
    static RUN: OnceLock<DefaultRun> = OnceLock::new();
    RUN.get_or_init(|| {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("default-run");
        // Removes the files of an earlier run of the tests.
        let _ = std::fs::remove_dir_all(&folder);
        let output = sawflutter()
            .args(["analyze", "--accuracy", "draft", "--out"])
            .arg(&folder)
            .output()
            .unwrap();
        assert!(output.status.success(), "{}", text(&output.stderr));
        let report = serde_json::from_slice(&read(folder.join("report.json"))).unwrap();
        DefaultRun {
            folder,
            output,
            report,
        }
    })
}

#[test]
fn the_default_run_writes_its_files_and_no_other() {
    let run = default_run();
    assert_eq!(run.output.status.code(), Some(0));
    assert_eq!(text(&run.output.stderr), "");
    assert_eq!(names_in(&run.folder), FILES);
    let png = read(run.folder.join("campbell.png"));
    assert_eq!(&png[..8], b"\x89PNG\r\n\x1a\n");
    let svg = String::from_utf8(read(run.folder.join("campbell.svg"))).unwrap();
    assert!(svg.starts_with("<svg") || svg.starts_with("<?xml"));
    assert!(svg.trim_end().ends_with("</svg>"));
}

#[test]
fn the_default_run_is_the_papers_saw() {
    let report = &default_run().report;
    let mut scene = Scene::paper().file().clone();
    scene.accuracy = Accuracy::Draft;
    assert_eq!(report.scene, scene);
    assert_eq!(report.sawflutter, env!("CARGO_PKG_VERSION"));
    assert!(!report.critical_speeds.is_empty() && !report.instabilities.is_empty());
    assert_eq!(report.certificate.krein_violations, 0);
}

#[test]
fn the_summary_fits_a_terminal_and_says_what_matters() {
    let run = default_run();
    let text = text(&run.output.stdout);
    assert_in_80_columns(text);
    let critical = run.report.critical_speeds[0].rpm;
    let flutter = run.report.flutter_rpm.expect("the saw flutters");
    for expected in [
        format!("{:.2}", run.report.modes_at_rest[0].frequency_hz),
        format!("{critical:.1}"),
        format!("Flutter speed: {flutter:.0} rpm"),
        format!("run it up to {:.0} rpm (85 %", (0.85 * critical).floor()),
        "AT RISK: 118 % of the first critical speed".to_owned(),
        "1800 rpm".to_owned(),
    ] {
        assert!(text.contains(&expected), "no {expected:?} in:\n{text}");
    }
    assert!(1800.0 > 0.85 * critical, "{critical}");
}

#[test]
fn the_summary_of_a_scene_with_long_words_fits_too() {
    let folder = TempDir::new().unwrap();
    let mut file = quick_scene();
    file.name = "Säge ".repeat(60);
    // A blade so thick that the report warns.
    file.blade.thickness_m = 0.03;
    let scene = write_scene(&folder, &file);
    let output = sawflutter()
        .current_dir(&folder)
        .arg("analyze")
        .arg(scene)
        .args(["--out", "out"])
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    assert!(text(&output.stdout).contains("Warning:"));
    for line in text(&output.stdout).lines() {
        assert!(line.chars().count() <= 80, "{line}");
    }
}

#[test]
fn campbell_csv_holds_every_point_of_every_branch() {
    let run = default_run();
    let csv_file = read(run.folder.join("campbell.csv"));
    let mut reader = csv::Reader::from_reader(csv_file.as_slice());
    let header = reader.headers().unwrap().clone();
    let column = |name: &str| {
        let place = header.iter().position(|h| h == name);
        place.unwrap_or_else(|| panic!("no column {name}"))
    };
    let columns = [
        column("branch"),
        column("rpm"),
        column("frequency_hz"),
        column("growth_per_s"),
    ];
    let mut rows = reader.records().map(Result::unwrap);
    let mut points = 0;
    for branch in &run.report.campbell.branches {
        for k in 0..branch.rpm.len() {
            let row = rows.next().expect("a row");
            let number = |place: usize| row[columns[place]].parse::<f64>().unwrap();
            let same = |value: f64, reported: f64| {
                (value - reported).abs() <= 1e-12 * reported.abs().max(1e-3)
            };
            assert_eq!(number(0), branch.branch as f64);
            assert!(same(number(1), branch.rpm[k]), "{row:?}");
            assert!(same(number(2), branch.frequency_hz[k]), "{row:?}");
            assert!(same(number(3), branch.growth_per_s[k]), "{row:?}");
            points += 1;
        }
    }
    assert!(rows.next().is_none() && points > 1000, "{points} points");
}

/// The report contains everything that the figure shows.
#[test]
fn the_figure_can_be_redrawn_from_the_report_alone() {
    let run = default_run();
    let redrawn = run.report.campbell_svg().unwrap();
    let written = read(run.folder.join("campbell.svg"));
    assert!(redrawn.as_bytes() == written, "the figures differ");
}

#[test]
fn json_on_standard_output_is_the_report() {
    let folder = TempDir::new().unwrap();
    let scene = write_scene(&folder, &quick_scene());
    let out = folder.path().join("out");
    let output = sawflutter()
        .arg("analyze")
        .arg(&scene)
        .args(["--json", "--out"])
        .arg(&out)
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    // `Report` refuses unknown keys, so that this also checks every key that is written.
    let report: Report = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(report.scene, quick_scene());
    let written = read(out.join("report.json"));
    let file: Report = serde_json::from_slice(&written).unwrap();
    assert_eq!(file, report);
    // The values that are read are written again, without the loss of a digit.
    let again = serde_json::to_string_pretty(&file).unwrap();
    assert!(again.as_bytes() == written.trim_ascii_end(), "digits lost");
}

#[test]
fn a_second_run_replaces_the_files_of_the_first() {
    let folder = TempDir::new().unwrap();
    let scene = write_scene(&folder, &quick_scene());
    let out = folder.path().join("out");
    std::fs::create_dir(&out).unwrap();
    for name in FILES {
        std::fs::write(out.join(name), "old".repeat(1_000_000)).unwrap();
    }
    std::fs::write(out.join("notes.txt"), "mine").unwrap();
    std::fs::write(out.join("root-loci.svg"), "old").unwrap();
    sawflutter()
        .arg("analyze")
        .arg(&scene)
        .arg("--out")
        .arg(&out)
        .assert()
        .success();
    // The old loci are removed too, because they belong to another saw.
    let mut expected: Vec<&str> = FILES.to_vec();
    expected.insert(3, "notes.txt");
    assert_eq!(names_in(&out), expected);
    assert_eq!(read(out.join("notes.txt")), b"mine");
    for name in FILES {
        assert!(!read(out.join(name)).starts_with(b"old"), "{name}");
    }
    serde_json::from_slice::<Report>(&read(out.join("report.json"))).unwrap();
}

/// The options of the drawn part change only the picture. A part outside the sweep is refused.
#[test]
fn a_part_of_the_sweep_can_be_drawn() {
    let folder = TempDir::new().unwrap();
    let scene = write_scene(&folder, &quick_scene());
    let drawn = |arguments: &[&str]| {
        let mut command = sawflutter();
        let command = command.arg("analyze").arg(&scene).args(arguments);
        let output = command.current_dir(&folder).output().unwrap();
        let out = folder.path().join("sawflutter-out");
        let files = ["report.json", "campbell.svg"].map(|name| read(out.join(name)));
        (output, files)
    };
    let (_, [report, whole]) = drawn(&[]);
    let (output, [same, part]) = drawn(&["--draw-from", "100", "--draw-to-frequency", "77"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    assert!(same == report && part != whole);
    assert!(text(&part).contains("shown: 100 to "));
    let (refused, _) = drawn(&["--draw-from", "1e7"]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(text(&refused.stderr).contains("do not name a part of the sweep"));
}

/// Whether a value is valid by a schema, by the rules of JSON Schema that schemas of scenes use.
fn is_valid(root: &Value, schema: &Value, value: &Value) -> bool {
    let is_valid_by = |schema: &Value| is_valid(root, schema, value);
    let list = |key: &str| schema[key].as_array().into_iter().flatten();
    let is_of = |name: &Value| match name.as_str().unwrap_or_default() {
        "object" => value.is_object(),
        "array" => value.is_array(),
        "string" => value.is_string(),
        "boolean" => value.is_boolean(),
        "integer" => value.as_f64().is_some_and(|number| number.fract() == 0.0),
        "number" => value.is_number(),
        "null" => value.is_null(),
        other => panic!("type {other}"),
    };
    let is_typed = match &schema["type"] {
        Value::Null => true,
        Value::Array(names) => names.iter().any(is_of),
        name => is_of(name),
    };
    let refers = schema["$ref"].as_str().is_none_or(|path| {
        let target = root.pointer(path.trim_start_matches('#'));
        is_valid_by(target.expect(path))
    });
    let is_some = |key: &str| schema[key].is_null() || list(key).any(is_valid_by);
    let is_listed = schema["enum"].is_null() || list("enum").any(|one| one == value);
    let is_constant = schema["const"].is_null() || schema["const"] == *value;
    let has_keys = value.as_object().is_none_or(|object| {
        let required = list("required").all(|key| object.contains_key(key.as_str().unwrap()));
        let mut pairs = object.iter();
        required
            && pairs.all(|(key, value)| match &schema["properties"][key] {
                Value::Null => schema["additionalProperties"] != false,
                of_key => is_valid(root, of_key, value),
            })
    });
    let has_items = value.as_array().is_none_or(|items| {
        let mut items = items.iter();
        schema["items"].is_null() || items.all(|item| is_valid(root, &schema["items"], item))
    });
    let is_allowed = is_some("anyOf") && is_some("oneOf") && list("allOf").all(is_valid_by);
    is_typed && refers && is_allowed && is_listed && is_constant && has_keys && has_items
}

/// Every scene of the gallery is valid by the printed schema; a scene with a misspelt key, without its blade, or with a word for a number
/// is not.
#[test]
fn schema_prints_the_schema_of_a_scene() {
    let output = sawflutter().arg("schema").output().unwrap();
    assert_eq!(output.status.code(), Some(0));
    let schema: Value = serde_json::from_slice(&output.stdout).unwrap();
    let gallery = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/gallery");
    let scenes: Vec<Value> = std::fs::read_dir(gallery)
        .unwrap()
        .map(|entry| serde_json::from_slice(&read(entry.unwrap().path())).unwrap())
        .collect();
    assert!(scenes.len() > 20);
    for scene in &scenes {
        assert!(is_valid(&schema, &schema, scene), "{}", scene["name"]);
    }
    let is_refused = |change: &dyn Fn(&mut Value)| {
        let mut scene = scenes[0].clone();
        change(&mut scene);
        !is_valid(&schema, &schema, &scene)
    };
    assert!(is_refused(
        &|scene| scene["blade"]["thickness_mm"] = 2.into()
    ));
    assert!(is_refused(
        &|scene| scene["blade"]["thickness_m"] = "thin".into()
    ));
    assert!(is_refused(&|scene| {
        scene.as_object_mut().unwrap().remove("blade");
    }));
}

/// A reader that closes the pipe, like `head -0`, is no failure.
#[test]
fn a_closed_pipe_is_no_failure() {
    let folder = TempDir::new().unwrap();
    let scene_path = write_scene(&folder, &quick_scene());
    let scene = scene_path.to_str().unwrap();
    let runs: [&[&str]; 3] = [
        &["schema"],
        &["analyze", scene],
        &["analyze", scene, "--json"],
    ];
    for arguments in runs {
        let mut child = std::process::Command::new(program())
            .current_dir(&folder)
            .args(arguments)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        drop(child.stdout.take());
        let output = child.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(0), "{arguments:?}");
        assert_eq!(text(&output.stderr), "", "{arguments:?}");
    }
    let out = folder.path().join("sawflutter-out");
    assert_eq!(names_in(&out), FILES);
}

/// The built-in saw has 40 critical speeds up to 10 000 rpm on the basis of a draft (42 on larger ones, 9991 rpm the last), and
/// the search takes minutes. Before it the program prints their number and the key that shortens the search. Before a search of seconds it prints nothing.
#[test]
fn a_long_sweep_is_estimated_before_its_search() {
    let folder = TempDir::new().unwrap();
    let mut file = Scene::paper().file().clone();
    file.accuracy = Accuracy::Draft;
    file.sweep.as_mut().unwrap().to_rpm = 10_000.0;
    let mut child = std::process::Command::new(program())
        .current_dir(&folder)
        .arg("analyze")
        .arg(write_scene(&folder, &file))
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut said = String::new();
    let mut errors = BufReader::new(child.stderr.take().unwrap());
    errors.read_line(&mut said).unwrap();
    child.kill().unwrap();
    child.wait().unwrap();
    for part in [
        "40 critical speeds",
        "minutes",
        "estimate",
        "lower sweep.to_rpm",
    ] {
        assert!(said.contains(part), "{said}");
    }
    assert_eq!(text(&default_run().output.stderr), "");
}

/// The chart under the forces of the cut is beside that of the idling saw in text, JSON and figure.
#[test]
fn the_chart_in_the_cut_is_beside_that_of_the_idling_saw() {
    let folder = TempDir::new().unwrap();
    let run = |arguments: &[&str]| {
        let mut command = sawflutter();
        command
            .args(["analyze", "--accuracy", "draft"])
            .args(arguments);
        command.arg("--out").arg(folder.path()).output().unwrap()
    };
    let output = run(&["--in-cut", "2800"]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let names = names_in(folder.path());
    assert!(names.contains(&"in-cut.png".to_owned()), "{names:?}");
    let report: Report = serde_json::from_slice(&read(folder.path().join("report.json"))).unwrap();
    let in_cut = report.in_cut.expect("forces");
    let idling = in_cut.idling.expect("a full chart");
    assert_eq!(in_cut.rpm, 2800.0);
    // 200 mm over a pitch of 53.1 mm.
    assert!((in_cut.teeth - 3.7659).abs() < 1e-4, "{}", in_cut.teeth);
    let own = &default_run().report;
    // A search for bands alone reaches the onset from other speeds than a chart does.
    let (idle_rpm, charted_rpm) = (idling.flutter_rpm, own.flutter_rpm);
    let (idle, charted) = (idle_rpm.unwrap(), charted_rpm.unwrap());
    assert!((idle / charted - 1.0).abs() < 1e-9, "{idle} {charted}");
    let said = text(&output.stdout);
    for expected in [
        "1240 N against".to_owned(),
        format!("{:.1}", idling.critical_rpm[0]),
        format!("{:.1}", report.critical_speeds[0].rpm),
    ] {
        assert!(said.contains(&expected), "no {expected:?} in:\n{said}");
    }
    assert_in_80_columns(said);
    // The default speed is the operating speed; a saw of another scene has no cut.
    let by_default = run(&["--in-cut", "--json"]);
    let report_by_default: Report = serde_json::from_slice(&by_default.stdout).unwrap();
    assert_eq!(
        report_by_default.in_cut.map(|in_cut| in_cut.rpm),
        Some(1800.0)
    );
    let quick = TempDir::new().unwrap();
    let mut scene = quick_scene();
    scene.cut = None;
    let path = write_scene(&quick, &scene);
    let refused = run(&[path.to_str().unwrap(), "--in-cut"]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(text(&refused.stderr).contains("the scene has no cut"));
}
