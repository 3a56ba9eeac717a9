//! Goal: the program keeps its word to the person or script that runs it: whole files or
//! none, one clear message for a bad scene, exit code 0 or 2, lines that fit a terminal.
//!
//! Source: the scene and report keys and exit codes of the README and `--help`.

use std::fs::File;
use std::path::{Path, PathBuf};
use std::process::{Output, Stdio};
use std::sync::OnceLock;
use std::time::{Duration, Instant};

use assert_cmd::Command;
use sawflutter::figure;
use sawflutter::report::Report;
use sawflutter::scene::{Scene, SceneFile};
use tempfile::TempDir;

const FILES: [&str; 6] = [
    "campbell.csv",
    "campbell.png",
    "campbell.svg",
    "report.json",
    "root-loci.png",
    "root-loci.svg",
];
/// Of a saw that nothing makes flutter there are no loci.
const FILES_WITHOUT_FLUTTER: [&str; 4] = [FILES[0], FILES[1], FILES[2], FILES[3]];

fn sawflutter() -> Command {
    Command::new(env!("CARGO_BIN_EXE_sawflutter"))
}

fn names_in(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

fn read(path: PathBuf) -> Vec<u8> {
    std::fs::read(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

fn stdout(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

/// The built-in saw, run once for all tests that look at what it leaves behind.
struct DefaultRun {
    folder: PathBuf,
    output: Output,
    report: Report,
}

fn default_run() -> &'static DefaultRun {
    static RUN: OnceLock<DefaultRun> = OnceLock::new();
    RUN.get_or_init(|| {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("default-run");
        // What an earlier run of the tests has left.
        let _ = std::fs::remove_dir_all(&folder);
        let output = sawflutter()
            .args(["analyze", "--accuracy", "draft", "--out"])
            .arg(&folder)
            .output()
            .unwrap();
        assert!(output.status.success(), "{}", stderr(&output));
        let report = serde_json::from_slice(&read(folder.join("report.json"))).unwrap();
        DefaultRun {
            folder,
            output,
            report,
        }
    })
}

/// A scene that takes no time: the blade without guides, at draft accuracy.
fn quick_scene() -> SceneFile {
    let mut file = crate::common::scene("free-blade").file;
    file.accuracy = sawflutter::scene::Accuracy::Draft;
    file
}

fn write_scene(folder: &TempDir, file: &SceneFile) -> PathBuf {
    let path = folder.path().join("scene.json");
    std::fs::write(&path, serde_json::to_string_pretty(file).unwrap()).unwrap();
    path
}

// A run that goes well.

#[test]
fn the_default_run_writes_its_files_and_no_other() {
    let run = default_run();
    assert_eq!(run.output.status.code(), Some(0));
    assert_eq!(stderr(&run.output), "");
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
    let mut scene = Scene::paper().file;
    scene.accuracy = sawflutter::scene::Accuracy::Draft;
    assert_eq!(report.scene, scene);
    assert_eq!(report.sawflutter, env!("CARGO_PKG_VERSION"));
    assert!(!report.critical_speeds.is_empty() && !report.instabilities.is_empty());
    assert_eq!(report.certificate.krein_violations, 0);
}

#[test]
fn the_summary_fits_a_terminal_and_says_what_matters() {
    let run = default_run();
    let text = stdout(&run.output);
    for line in text.lines() {
        // The last line names the folder, which may be as long as it likes.
        let columns = line.chars().count();
        assert!(columns <= 80 || line.starts_with("Written to"), "{line}");
    }
    let critical = run.report.critical_speeds[0].rpm;
    let flutter = run.report.flutter_speed_rpm.expect("the saw flutters");
    for expected in [
        format!("{:.2}", run.report.modes_at_rest[0].frequency_hz),
        format!("{critical:.1}"),
        format!("Flutter speed: {flutter:.0} rpm"),
        "85 % rule".to_owned(),
        "1800 rpm".to_owned(),
    ] {
        assert!(text.contains(&expected), "no {expected:?} in:\n{text}");
    }
    assert!(
        1800.0 > 0.85 * critical && text.contains("breaks"),
        "{text}"
    );
}

#[test]
fn the_summary_of_a_scene_with_long_words_fits_too() {
    let folder = TempDir::new().unwrap();
    let mut file = quick_scene();
    file.name = "Säge ".repeat(60);
    // So thick that the report warns.
    file.blade.thickness_m = 0.03;
    let scene = write_scene(&folder, &file);
    let output = sawflutter()
        .current_dir(&folder)
        .arg("analyze")
        .arg(scene)
        .args(["--out", "out"])
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert!(stdout(&output).contains("Warning:"));
    for line in stdout(&output).lines() {
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
    for (index, branch) in run.report.campbell.branches.iter().enumerate() {
        for k in 0..branch.rpm.len() {
            let row = rows.next().expect("a row");
            let number = |place: usize| row[columns[place]].parse::<f64>().unwrap();
            let same = |value: f64, reported: f64| {
                (value - reported).abs() <= 1e-12 * reported.abs().max(1e-3)
            };
            assert_eq!(number(0), index as f64);
            assert!(same(number(1), branch.rpm[k]), "{row:?}");
            assert!(same(number(2), branch.frequency_hz[k]), "{row:?}");
            assert!(same(number(3), branch.growth_per_s[k]), "{row:?}");
            points += 1;
        }
    }
    assert!(rows.next().is_none() && points > 1000, "{points} points");
}

/// Complete means that nobody needs the program's inside to draw the figure again.
#[test]
fn the_figure_can_be_redrawn_from_the_report_alone() {
    let run = default_run();
    let redrawn = figure::campbell_svg(&run.report).unwrap();
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
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    // `Report` refuses unknown keys: every key written is one that it knows.
    let report: Report = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(report.scene, quick_scene());
    let written = read(out.join("report.json"));
    let file: Report = serde_json::from_slice(&written).unwrap();
    assert_eq!(file, report);
    // What was read is what is written again: no digit is lost on the way.
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
    sawflutter()
        .arg("analyze")
        .arg(&scene)
        .arg("--out")
        .arg(&out)
        .assert()
        .success();
    // The old loci are gone too: they were another saw's.
    let mut expected: Vec<&str> = FILES_WITHOUT_FLUTTER.to_vec();
    expected.insert(3, "notes.txt");
    assert_eq!(names_in(&out), expected);
    assert_eq!(read(out.join("notes.txt")), b"mine");
    for name in FILES_WITHOUT_FLUTTER {
        assert!(!read(out.join(name)).starts_with(b"old"), "{name}");
    }
    serde_json::from_slice::<Report>(&read(out.join("report.json"))).unwrap();
}

#[test]
fn schema_prints_the_schema_of_a_scene() {
    let output = sawflutter().arg("schema").output().unwrap();
    assert_eq!(output.status.code(), Some(0));
    let schema: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(schema, sawflutter::scene::json_schema());
}

/// `sawflutter | head -0`: a reader that has seen enough is no failure.
#[test]
fn a_closed_pipe_is_no_failure() {
    let folder = TempDir::new().unwrap();
    let scene = write_scene(&folder, &quick_scene());
    let scene = scene.to_str().unwrap();
    let runs: [&[&str]; 3] = [
        &["schema"],
        &["analyze", scene],
        &["analyze", scene, "--json"],
    ];
    for arguments in runs {
        let mut child = std::process::Command::new(env!("CARGO_BIN_EXE_sawflutter"))
            .current_dir(&folder)
            .args(arguments)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        drop(child.stdout.take());
        let output = child.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(0), "{arguments:?}");
        assert_eq!(stderr(&output), "", "{arguments:?}");
    }
    let out = folder.path().join("sawflutter-out");
    assert_eq!(names_in(&out), FILES_WITHOUT_FLUTTER);
}

// Runs that are refused.

/// Runs a scene that must be refused: exit code 2, one message, nothing written.
fn refused(scene: &Path) -> String {
    let folder = TempDir::new().unwrap();
    let out = folder.path().join("out");
    let output = sawflutter()
        .timeout(Duration::from_secs(20))
        .arg("analyze")
        .arg(scene)
        .arg("--out")
        .arg(&out)
        .output()
        .unwrap();
    let message = stderr(&output);
    assert_eq!(output.status.code(), Some(2), "{message}");
    assert_eq!(stdout(&output), "");
    assert!(message.starts_with("error: "), "{message}");
    assert_eq!(message.lines().count(), 1, "{message}");
    assert!(!out.exists(), "{:?}", names_in(&out));
    message
}

/// The same for the text of a scene.
fn refused_text(text: &[u8]) -> String {
    let folder = TempDir::new().unwrap();
    let scene = folder.path().join("scene.json");
    std::fs::write(&scene, text).unwrap();
    refused(&scene)
}

/// The paper's scene with one line exchanged for another.
fn paper_with(line: &str, instead: &str) -> String {
    let text = std::fs::read_to_string(crate::common::path("scenes/paper.json")).unwrap();
    assert_eq!(text.matches(line).count(), 1, "{line}");
    text.replace(line, instead)
}

const THICKNESS: &str = "\"thickness_m\": 0.0028";

/// Each message begins, after the name of the file, with the JSON path of the key.
#[test]
fn bad_values_are_refused_by_the_path_of_their_key() {
    let cases = [
        ("blade.thickness_m", THICKNESS, "\"thickness_m\": \"thin\""),
        ("blade.thickness_m", THICKNESS, "\"thickness_m\": null"),
        ("blade.thickness_m", THICKNESS, "\"thickness_m\": [0.0028]"),
        ("blade.thickness_m", THICKNESS, "\"thickness_m\": -0.0028"),
        ("blade.thickness_m", THICKNESS, "\"thickness_m\": 0"),
        ("blade.thickness_m", THICKNESS, "\"thickness_m\": NaN"),
        ("blade.thickness_m", THICKNESS, "\"thickness_m\": 1e999"),
        ("blade.thickness_m", THICKNESS, "\"thickness_m\": Infinity"),
        ("blade.thicknes_m", THICKNESS, "\"thicknes_m\": 0.0028"),
        (
            "blade.inner_diameter_m",
            "\"inner_diameter_m\": 0.200",
            "\"inner_diameter_m\": 0.710",
        ),
        (
            "blade.inner_diameter_m",
            "\"inner_diameter_m\": 0.200",
            "\"inner_diameter_m\": 0.9",
        ),
        (
            "blade.material.poisson_ratio",
            "\"poisson_ratio\": 0.29",
            "\"poisson_ratio\": 0.5",
        ),
        (
            "blade.material.poisson_ratio",
            "\"poisson_ratio\": 0.29",
            "\"poisson_ratio\": -1",
        ),
        (
            "blade.material.density_kg_per_m3",
            "\"density_kg_per_m3\": 7800",
            "\"density_kg_per_m3\": \"steel\"",
        ),
        ("mount.kind", "\"kind\": \"spline\"", "\"kind\": \"glue\""),
        (
            "guides[0].radius_m",
            "\"radius_m\": 0.200",
            "\"radius_m\": 0.6",
        ),
        (
            "guides[0].radius_m",
            "\"radius_m\": 0.200",
            "\"radius_m\": 0.0, \"unused\": 1",
        ),
        (
            "guides[0].stiffness_n_per_m",
            "\"stiffness_n_per_m\": 2.0e7",
            "\"stiffness_n_per_m\": -2.0e7",
        ),
        ("sweep.to_rpm", "\"to_rpm\": 3000", "\"to_rpm\": 0"),
        ("measured.rows[0].rpm", "\"rpm\": 0,", "\"rpm\": -1,"),
        (
            "accuracy",
            "\"operating_rpm\": 1800,",
            "\"accuracy\": \"perfect\",",
        ),
    ];
    for (key, line, instead) in cases {
        // A key that is also unknown is named instead of the one that would follow.
        let key = if instead.contains("unused") {
            "guides[0].unused"
        } else {
            key
        };
        let message = refused_text(paper_with(line, instead).as_bytes());
        assert!(
            message.contains(&format!("{key}: ")) || message.contains(&format!("{key} is ")),
            "{instead} should be refused as {key}, not as: {message}"
        );
    }
}

/// A pad beside the blade, not touching it: inside the bore.
#[test]
fn a_pad_off_the_blade_is_refused_and_told_where_the_blade_is() {
    let mut file = Scene::paper().file;
    file.guides[0].radius_m = 0.01;
    file.guides[0].radial_length_m = 0.02;
    file.guides[0].tangential_length_m = 0.02;
    let message = refused_text(serde_json::to_string(&file).unwrap().as_bytes());
    for part in [
        "guides[0].radius_m is 0.01",
        "off the blade",
        "0.1",
        "0.355",
    ] {
        assert!(message.contains(part), "no {part:?} in {message}");
    }
}

#[test]
fn what_is_no_scene_at_all_is_refused() {
    for (text, expected) in [
        ("", "empty"),
        ("  \n\t ", "empty"),
        ("{", "EOF"),
        ("[]", "the scene"),
        ("{} {}", "name"),
        ("radius,thickness\n1,2\n", "the scene"),
    ] {
        let message = refused_text(text.as_bytes());
        assert!(message.contains(expected), "{text:?}: {message}");
    }
    let twice = format!("{0}{0}", paper_with(THICKNESS, THICKNESS));
    let message = refused_text(twice.as_bytes());
    assert!(message.contains("trailing"), "{message}");
    let message = refused_text(b"{\"name\": \"\xff\xfe\"}");
    assert!(message.contains("UTF-8"), "{message}");
}

#[test]
fn a_directory_and_a_missing_file_are_refused_by_name() {
    let folder = TempDir::new().unwrap();
    let message = refused(folder.path());
    assert!(message.contains("is a directory"), "{message}");
    let missing = folder.path().join("no-such-scene.json");
    let message = refused(&missing);
    assert!(message.contains("no-such-scene.json"), "{message}");
}

/// A sparse file of 1 GB of zeros, read in a process that may not hold half of it.
#[test]
fn a_huge_file_is_refused_fast_and_in_little_memory() {
    let folder = TempDir::new().unwrap();
    let huge = folder.path().join("huge.json");
    File::create(&huge).unwrap().set_len(1_000_000_000).unwrap();
    let begun = Instant::now();
    let message = refused(&huge);
    assert!(message.contains("larger than"), "{message}");
    let took = begun.elapsed();
    assert!(took < Duration::from_secs(5), "{took:?}");

    #[cfg(target_os = "linux")]
    {
        let output = Command::new("sh")
            .arg("-c")
            .arg("ulimit -v 500000 && exec \"$0\" analyze \"$1\" --out \"$2\"")
            .arg(env!("CARGO_BIN_EXE_sawflutter"))
            .args([&huge, &folder.path().join("out")])
            .output()
            .unwrap();
        assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
        assert_eq!(stderr(&output), message);
    }
}

/// Refused before the computation, not after it.
#[test]
fn an_output_folder_that_cannot_be_written_is_refused_at_once() {
    let folder = TempDir::new().unwrap();
    let file = folder.path().join("file");
    std::fs::write(&file, "mine").unwrap();
    let mut places = vec![file.clone(), file.join("below")];
    if cfg!(target_os = "linux") {
        // Not even root can make a folder there.
        places.push("/proc/sawflutter-out".into());
    }
    let locked = folder.path().join("locked");
    std::fs::create_dir(&locked).unwrap();
    let mut permissions = std::fs::metadata(&locked).unwrap().permissions();
    permissions.set_readonly(true);
    std::fs::set_permissions(&locked, permissions).unwrap();
    // Root writes where it likes.
    if File::create(locked.join("probe")).is_err() {
        places.push(locked.clone());
        places.push(locked.join("below"));
    }
    for place in places {
        let begun = Instant::now();
        let output = sawflutter()
            .args(["analyze", "--accuracy", "reference", "--out"])
            .arg(&place)
            .output()
            .unwrap();
        let message = stderr(&output);
        assert_eq!(output.status.code(), Some(2), "{message}");
        assert_eq!(message.lines().count(), 1, "{message}");
        assert!(message.contains(place.to_str().unwrap()), "{message}");
        assert_eq!(stdout(&output), "");
        let took = begun.elapsed();
        assert!(took < Duration::from_secs(2), "{place:?}: {took:?}");
    }
    assert_eq!(std::fs::read(&file).unwrap(), b"mine");
}

#[test]
fn unknown_commands_and_options_are_refused_with_exit_code_2() {
    for arguments in [
        vec!["analyse"],
        vec!["analyze", "--accuracy", "perfect"],
        vec!["analyze", "--no-such-option"],
    ] {
        let folder = TempDir::new().unwrap();
        let output = sawflutter()
            .current_dir(&folder)
            .args(&arguments)
            .output()
            .unwrap();
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert_eq!(stdout(&output), "");
        assert!(names_in(folder.path()).is_empty());
    }
}
