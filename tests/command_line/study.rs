//! Goal: a study gives the same bytes whether it is computed at once, in parts, or in several runs, on one thread or on
//! two, and no saw is computed twice or lost.

use std::collections::BTreeSet;
use std::path::PathBuf;
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

use sawflutter::analyses::study::StudyReport;
use sawflutter::model::scene::Accuracy;
use tempfile::TempDir;

use super::program::{PATIENCE, program, text};
use crate::common::limit::Limit;

/// Files of a result, without the log.
const RESULT: [&str; 5] = [
    "study.csv",
    "study.json",
    "study.parquet",
    "study.png",
    "study.svg",
];
const SAWS: usize = 90;
/// Enough saws to kill the run in the middle.
const LONG: usize = 1500;

struct Bench {
    _limit: Limit,
    folder: TempDir,
    scene: PathBuf,
    study: PathBuf,
}

impl Bench {
    /// Free blades of random thickness and Poisson's ratio, some of which are refused.
    fn new() -> Self {
        let folder = TempDir::new().unwrap();
        let mut file = crate::common::scene("free-blade").file().clone();
        file.accuracy = Accuracy::Draft;
        let scene = folder.path().join("scene.json");
        std::fs::write(&scene, serde_json::to_string(&file).unwrap()).unwrap();
        let study = folder.path().join("tolerances.json");
        let bench = Bench {
            _limit: Limit::of(PATIENCE.as_secs(), "runs of a study"),
            folder,
            scene,
            study,
        };
        bench.write_study(SAWS);
        bench
    }

    fn write_study(&self, saws: usize) {
        let text = format!(
            r#"{{ "name": "Plates", "saws": {saws}, "to_rpm": 1000, "parameters": [
                {{ "path": "blade.thickness_m",
                   "distribution": {{ "kind": "normal", "standard_deviation": 1e-4 }} }},
                {{ "path": "blade.material.poisson_ratio",
                   "distribution": {{ "kind": "uniform", "from": 0.25, "to": 0.55 }} }} ],
                "limits": {{ "operating_rpm": 800 }} }}"#
        );
        std::fs::write(&self.study, text).unwrap();
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn command(&self, out: &str, more: &[&str]) -> Command {
        let mut command = Command::new(program());
        command.arg("study").arg(&self.scene).arg(&self.study);
        command.arg("--out").arg(self.path(out)).args(more);
        command
    }

    fn run(&self, out: &str, more: &[&str]) -> Output {
        self.command(out, more).output().unwrap()
    }

    fn merge(&self, folders: &[&str], out: &str) -> Output {
        let mut command = Command::new(program());
        command.args(["study", "merge"]);
        command.args(folders.iter().map(|f| self.path(f)));
        command.arg("--out").arg(self.path(out)).output().unwrap()
    }

    fn rows(&self, log: &str) -> Vec<String> {
        let text = std::fs::read_to_string(self.path(log)).unwrap_or_default();
        let rows = text.lines().skip(2).filter(|line| !line.starts_with('#'));
        rows.map(str::to_owned).collect()
    }

    #[track_caller]
    fn assert_same_result(&self, one: &str, other: &str) {
        let written = |name: &&str| cfg!(feature = "parquet") || !name.ends_with("parquet");
        for name in RESULT.into_iter().filter(written) {
            let read = |folder: &str| std::fs::read(self.path(folder).join(name)).unwrap();
            assert!(
                read(one) == read(other),
                "{name} of {one} and {other} differ"
            );
        }
    }
}

#[track_caller]
fn assert_done(output: &Output) {
    assert!(output.status.success(), "{}", text(&output.stderr));
}

/// The numbers of the saws in the rows, each once.
#[track_caller]
fn indices(rows: &[String]) -> BTreeSet<usize> {
    let number = |row: &String| row.split(',').next().unwrap().parse().unwrap();
    let all: BTreeSet<usize> = rows.iter().map(number).collect();
    assert_eq!(all.len(), rows.len(), "a saw was computed twice");
    all
}

#[test]
fn parts_merge_to_the_bytes_of_one_run_on_any_number_of_threads() {
    let bench = Bench::new();
    let whole = bench
        .command("whole", &[])
        .env("RAYON_NUM_THREADS", "1")
        .output()
        .unwrap();
    assert_done(&whole);
    for part in ["1/3", "2/3", "3/3"] {
        let out = if part == "2/3" { "elsewhere" } else { "parts" };
        let mut command = bench.command(out, &["--shard", part]);
        assert_done(&command.env("RAYON_NUM_THREADS", "2").output().unwrap());
    }
    let incomplete = bench.merge(&["parts"], "merged");
    assert_eq!(incomplete.status.code(), Some(2));
    assert!(text(&incomplete.stderr).contains("30 of 90 saws are missing, saw 1 the first"));
    let merged = bench.merge(&["elsewhere", "parts"], "merged");
    assert_done(&merged);
    bench.assert_same_result("whole", "merged");
    let words = |output: &Output| {
        let text = String::from_utf8(output.stdout.clone()).unwrap();
        text.rsplit_once("\nWritten to").unwrap().0.to_owned()
    };
    assert_eq!(words(&whole), words(&merged));
    assert!(words(&whole).lines().all(|line| line.chars().count() <= 80));
    // The texts on the worst saw and on reliability agree with the report.
    let content = std::fs::read_to_string(bench.path("whole/study.json")).unwrap();
    let report: StudyReport = serde_json::from_str(&content).unwrap();
    let worst = &report.worst_first_critical[0];
    let line = format!(
        "Lowest first critical speed: {:.1} rpm, saw {}",
        worst.rpm, worst.saw
    );
    assert!(words(&whole).contains(&line), "{}", words(&whole));
    let reliability = report.reliability.unwrap();
    let half = reliability.fastest.last().unwrap().rpm.unwrap();
    assert!(words(&whole).contains(&format!("{half:.1}")));
    // A run of the whole study uses the rows of the parts and computes the rest.
    assert_done(&bench.run("parts", &[]));
    assert_eq!(bench.rows("parts/study.log").len(), SAWS / 3);
    bench.assert_same_result("whole", "parts");
}

#[test]
fn a_killed_run_is_continued_and_computes_nothing_twice() {
    let bench = Bench::new();
    bench.write_study(LONG);
    let mut child = bench
        .command("killed", &[])
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let begun = Instant::now();
    while bench.rows("killed/study.log").len() < 40 {
        assert!(
            begun.elapsed() < Duration::from_secs(60),
            "no saw in a minute"
        );
        std::thread::sleep(Duration::from_millis(2));
    }
    // After SIGKILL the program cannot remove its temporary files.
    child.kill().unwrap();
    child.wait().unwrap();
    let text = std::fs::read_to_string(bench.path("killed/study.log")).unwrap();
    let whole_lines = &text[..=text.rfind('\n').unwrap()];
    let before = whole_lines.lines().count() - 3;
    assert!((40..LONG).contains(&before), "{before}");
    assert!(!bench.path("killed/study.json").exists());
    assert_done(&bench.run("killed", &[]));
    let log = std::fs::read_to_string(bench.path("killed/study.log")).unwrap();
    assert!(log.starts_with(whole_lines), "finished saws were lost");
    assert_eq!(indices(&bench.rows("killed/study.log")).len(), LONG);
    assert_done(&bench.run("whole", &[]));
    bench.assert_same_result("whole", "killed");
}

/// After Ctrl-C a closing line gives the number of finished saws, and the exit code shows the stop.
#[cfg(unix)]
#[test]
fn an_interrupted_run_says_how_to_continue() {
    let bench = Bench::new();
    bench.write_study(LONG);
    let child = bench
        .command("stopped", &[])
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let begun = Instant::now();
    while bench.rows("stopped/study.log").len() < 3 {
        assert!(
            begun.elapsed() < Duration::from_secs(60),
            "no saw in a minute"
        );
        std::thread::sleep(Duration::from_millis(2));
    }
    let id = child.id().to_string();
    let sent = std::process::Command::new("kill")
        .args(["-INT", &id])
        .status();
    assert!(sent.unwrap().success());
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(130));
    let done = bench.rows("stopped/study.log").len();
    let said = text(&output.stderr);
    assert!(
        said.contains(&format!("Stopped: {done} of {LONG} saws")),
        "{said}"
    );
}

#[test]
fn a_torn_last_line_loses_one_saw_and_a_finished_study_none() {
    let bench = Bench::new();
    assert_done(&bench.run("whole", &[]));
    assert_done(&bench.run("torn", &[]));
    let log = bench.path("torn/study.log");
    let complete = std::fs::read(&log).unwrap();
    for cut in [1, 10] {
        std::fs::write(&log, &complete[..complete.len() - cut]).unwrap();
        assert_done(&bench.run("torn", &[]));
        assert_eq!(std::fs::read(&log).unwrap(), complete);
        bench.assert_same_result("whole", "torn");
    }
    // Three cases: an incomplete first line, a line that a disk has damaged, and a complete log.
    let header = complete.iter().position(|byte| *byte == b'\n').unwrap();
    std::fs::write(&log, &complete[..header / 2]).unwrap();
    assert_done(&bench.run("torn", &[]));
    bench.assert_same_result("whole", "torn");
    let mut spoilt = complete.clone();
    let place = complete.len() * 2 / 3;
    spoilt[place..place + 4].copy_from_slice(b"\"\0,9");
    std::fs::write(&log, &spoilt).unwrap();
    assert_done(&bench.run("torn", &[]));
    bench.assert_same_result("whole", "torn");
    let before = std::fs::read(&log).unwrap();
    assert_done(&bench.run("torn", &[]));
    assert_eq!(std::fs::read(&log).unwrap(), before);
}

#[test]
fn a_log_of_another_study_is_refused_and_left_alone() {
    let bench = Bench::new();
    bench.write_study(20);
    assert_done(&bench.run("out", &[]));
    let log = std::fs::read(bench.path("out/study.log")).unwrap();
    bench.write_study(21);
    let refused = bench.run("out", &[]);
    assert_eq!(refused.status.code(), Some(2));
    let message = text(&refused.stderr);
    assert!(
        message.contains("study.saws is 20 there and 21 here"),
        "{message}"
    );
    assert!(
        message.contains("name another folder, or remove"),
        "{message}"
    );
    bench.write_study(20);
    let other_accuracy = bench.run("out", &["--accuracy", "design"]);
    assert!(
        text(&other_accuracy.stderr)
            .contains(r#"scene.accuracy is "draft" there and "design" here"#)
    );
    assert_eq!(std::fs::read(bench.path("out/study.log")).unwrap(), log);
    std::fs::write(bench.path("out/study-1-of-2.log"), "my notes\n").unwrap();
    let other_log = bench.run("out", &["--shard", "1/2"]);
    assert!(text(&other_log.stderr).contains("study-1-of-2.log is no log of a study"));
    assert_eq!(
        std::fs::read(bench.path("out/study-1-of-2.log")).unwrap(),
        b"my notes\n"
    );
}

#[test]
fn the_report_reads_back_and_bad_arguments_are_refused() {
    let bench = Bench::new();
    bench.write_study(60);
    let output = bench.run("out", &["--json"]);
    assert_done(&output);
    let report: StudyReport = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(report.all.saws, 60);
    assert!(report.all.refused > 0 && report.not_analysed.len() == report.all.refused);
    let written = std::fs::read(bench.path("out/study.json")).unwrap();
    assert_eq!(
        serde_json::from_slice::<StudyReport>(&written).unwrap(),
        report
    );
    for part in ["0/3", "4/3", "1", "1/0", "a/b"] {
        let refused = bench.run("out", &["--shard", part]);
        assert_eq!(refused.status.code(), Some(2));
        assert!(text(&refused.stderr).contains("must be k/n with k from 1 to n"));
    }
    let nothing = bench.merge(&["out/.."], "merged");
    assert_eq!(nothing.status.code(), Some(2));
    assert!(text(&nothing.stderr).contains("there is no log of a study in"));
    std::fs::write(&bench.study, "{").unwrap();
    let refused = bench.run("other", &[]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(text(&refused.stderr).contains("sawflutter schema --study"));
    assert!(!bench.path("other").exists());
}

/// Three cases: no Python, a Python without the package, and a Python that fails.
#[cfg(unix)]
#[test]
fn a_scheduler_needs_the_python_package() {
    use std::os::unix::fs::PermissionsExt;
    let bench = Bench::new();
    let python = bench.path("python");
    let scheduler = ["--scheduler", "tcp://127.0.0.1:1"];
    let said = |script: Option<&str>| {
        if let Some(script) = script {
            std::fs::write(&python, format!("#!/bin/sh\n{script}\n")).unwrap();
            std::fs::set_permissions(&python, PermissionsExt::from_mode(0o755)).unwrap();
        }
        let mut command = bench.command("out", &scheduler);
        let output = command.env("SAWFLUTTER_PYTHON", &python).output().unwrap();
        assert_eq!(output.status.code(), Some(2));
        assert!(!bench.path("out/study.json").exists());
        text(&output.stderr).to_owned()
    };
    let remedy = "pip install 'sawflutter[dask]==";
    let none = said(None);
    assert!(
        none.contains("there is no") && none.contains(remedy),
        "{none}"
    );
    let without = said(Some("echo 'No module named distributed' >&2; exit 1"));
    assert!(without.contains("No module named distributed") && without.contains(remedy));
    let other = said(Some("echo 0.0.9"));
    assert!(other.contains("has version 0.0.9 of sawflutter"), "{other}");
    let version = env!("CARGO_PKG_VERSION");
    let script = format!("[ $1 = -c ] && echo {version} || {{ echo no scheduler; exit 1; }}");
    assert!(said(Some(&script)).contains("no scheduler"));
    let both = bench.run(
        "out",
        &["--scheduler", "tcp://127.0.0.1:1", "--shard", "1/2"],
    );
    assert_eq!(both.status.code(), Some(2));
    assert!(text(&both.stderr).contains("cannot be used with"));
}

/// The table is read by another library and compared with the rows of the CSV.
#[cfg(feature = "parquet")]
#[test]
fn the_parquet_table_holds_what_the_csv_does() {
    use parquet::file::reader::{FileReader, SerializedFileReader};
    use parquet::record::Field;

    let bench = Bench::new();
    bench.write_study(50);
    assert_done(&bench.run("out", &[]));
    let file = std::fs::File::open(bench.path("out/study.parquet")).unwrap();
    let reader = SerializedFileReader::new(file).unwrap();
    let metadata = reader.metadata().file_metadata();
    let inputs = metadata.key_value_metadata().unwrap();
    assert!(inputs.iter().any(|pair| pair.key == "sawflutter"));
    let mut csv = csv::Reader::from_path(bench.path("out/study.csv")).unwrap();
    let names = csv.headers().unwrap().clone();
    let rows: Vec<_> = reader
        .get_row_iter(None)
        .unwrap()
        .map(Result::unwrap)
        .collect();
    let records: Vec<_> = csv.records().map(Result::unwrap).collect();
    assert_eq!((rows.len(), records.len()), (50, 50));
    for (row, record) in rows.iter().zip(&records) {
        let columns: Vec<_> = row.get_column_iter().collect();
        assert_eq!(columns.len(), names.len());
        for (((name, field), cell), expected) in columns.into_iter().zip(record).zip(&names) {
            assert_eq!(name, expected);
            let text = match field {
                Field::Null => String::new(),
                Field::Long(n) => n.to_string(),
                Field::Double(x) => x.to_string(),
                Field::Bool(b) => b.to_string(),
                Field::Str(s) => s.clone(),
                other => panic!("{name}: {other:?}"),
            };
            assert_eq!(text, cell, "{name}");
        }
    }
    let statuses: BTreeSet<&str> = records.iter().map(|r| &r[3]).collect();
    assert_eq!(statuses, BTreeSet::from(["analysed", "refused"]));
}
