//! Goal: a run that is stopped leaves no incomplete file, and no file of another saw under the right name.
//!
//! `report.json` is written last: while it exists, every other file belongs to it.
#![cfg(target_os = "linux")]

use std::fs::File;
use std::os::unix::fs::PermissionsExt;
use std::os::unix::process::{CommandExt, ExitStatusExt};
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

use sawflutter::analyses::campbell::Report;
use sawflutter::model::scene::SceneFile;
use tempfile::TempDir;

use super::program::{self, program, text};

const STAGED: &str = ".sawflutter-";

/// A scene of this name that is computed in a fraction of a second.
fn quick_scene(name: &str) -> SceneFile {
    SceneFile {
        name: name.to_owned(),
        ..program::quick_scene()
    }
}

fn write_scene(folder: &Path, file: &SceneFile) -> PathBuf {
    let path = folder.join(format!("{}.json", file.name));
    std::fs::write(&path, serde_json::to_string_pretty(file).unwrap()).unwrap();
    path
}

fn analyze(scene: &Path, out: &Path) -> Command {
    // If the tests run in the background, SIGINT is ignored, and their child processes inherit this.
    let mut command = Command::new("env");
    command.arg("--default-signal=INT").arg(program());
    command.arg("analyze").arg(scene).arg("--out").arg(out);
    command.stdout(Stdio::null()).stderr(Stdio::piped());
    command
}

/// Names in a folder, without the temporary files of a run that was killed.
fn names_in(folder: &Path) -> Vec<String> {
    let mut names = program::names_in(folder);
    names.retain(|name| !name.starts_with(STAGED));
    names
}

/// Checks that every file is complete and, if there is a report, that all files exist and belong to it. Returns the
/// name of the report's scene.
fn assert_sound(out: &Path) -> Option<String> {
    let read = |name: &str| std::fs::read(out.join(name)).ok();
    if let Some(png) = read("campbell.png") {
        assert!(png.ends_with(b"IEND\xaeB`\x82"), "a half PNG");
    }
    let svg = read("campbell.svg");
    if let Some(svg) = &svg {
        assert!(svg.trim_ascii_end().ends_with(b"</svg>"), "a half SVG");
    }
    let csv = read("campbell.csv");
    let report: Report = serde_json::from_slice(&read("report.json")?).expect("a whole report");
    assert!(report.campbell_svg().unwrap().into_bytes() == svg.unwrap());
    assert!(report.campbell_csv().unwrap() == csv.unwrap());
    let files = [
        "campbell.csv",
        "campbell.png",
        "campbell.svg",
        "report.json",
    ];
    assert_eq!(names_in(out), files);
    Some(report.scene.name)
}

/// Stops runs with a signal at many moments, in a folder that has the files of another saw.
fn stopped_at_any_time(signal: &str, number: i32) {
    let folder = TempDir::new().unwrap();
    let out = folder.path().join("out");
    let [old, new] = ["old", "new"].map(|name| write_scene(folder.path(), &quick_scene(name)));
    let begun = Instant::now();
    assert!(analyze(&old, &out).status().unwrap().success());
    let whole = begun.elapsed();
    assert_eq!(assert_sound(&out).as_deref(), Some("old"));
    let mut stopped = 0;
    for step in 0..24_u32 {
        let mut child = analyze(&new, &out).spawn().unwrap();
        std::thread::sleep(whole.mul_f64(f64::from(step) / 20.0));
        let killed = Command::new("kill")
            .args([signal, &child.id().to_string()])
            .stderr(Stdio::null())
            .status();
        killed.expect("kill is a program of every Unix");
        let status = child.wait().unwrap();
        stopped += usize::from(status.signal() == Some(number));
        assert_sound(&out);
    }
    assert!(stopped > 3, "{stopped} of 24 were stopped");
    // The next run removes the incomplete files and completes.
    assert!(analyze(&new, &out).status().unwrap().success());
    assert_eq!(assert_sound(&out).as_deref(), Some("new"));
    let all = std::fs::read_dir(&out).unwrap().count();
    assert_eq!(all, 4, "a killed run's half files are still there");
}

#[test]
fn killed_at_any_time() {
    stopped_at_any_time("-KILL", 9);
}

#[test]
fn interrupted_at_any_time() {
    stopped_at_any_time("-INT", 2);
}

/// Runs a shell command line in which `"$0" "$@"` is the program.
fn in_shell(line: &str, scene: &Path, out: &Path) -> Output {
    let mut shell = Command::new("sh");
    shell.args(["-c", line]).arg(program()).arg("analyze");
    shell.arg(scene).arg("--out").arg(out);
    shell.output().unwrap()
}

/// Limits files to 20 kB, so that a write fails as on a full disk.
#[test]
fn a_disk_that_fills_up_leaves_the_old_files() {
    let folder = TempDir::new().unwrap();
    let out = folder.path().join("out");
    let [old, new] = ["old", "new"].map(|name| write_scene(folder.path(), &quick_scene(name)));
    assert!(analyze(&old, &out).status().unwrap().success());
    let output = in_shell("trap '' XFSZ; ulimit -f 40; exec \"$0\" \"$@\"", &new, &out);
    assert_eq!(output.status.code(), Some(2), "{}", text(&output.stderr));
    assert!(
        text(&output.stderr).contains("cannot write"),
        "{}",
        text(&output.stderr)
    );
    assert_eq!(assert_sound(&out).as_deref(), Some("old"));
    assert_eq!(std::fs::read_dir(&out).unwrap().count(), 4);
}

/// The message for a full disk names the file. The test needs a system that lets it mount a small disk.
#[test]
fn a_full_disk_is_an_error_that_names_the_file() {
    let folder = TempDir::new().unwrap();
    let out = folder.path().join("disk");
    std::fs::create_dir(&out).unwrap();
    let scene = write_scene(folder.path(), &quick_scene("new"));
    let line = format!(
        "exec unshare --mount sh -c 'mount -t tmpfs -o size=64k none {disk} || exit 77; \
         \"$0\" \"$@\"; code=$?; ls -A {disk} >&2; exit $code' \"$0\" \"$@\"",
        disk = out.display()
    );
    let output = in_shell(&line, &scene, &out);
    let message = text(&output.stderr);
    if output.status.code() == Some(77) || message.contains("unshare") {
        println!("not allowed to mount a small disk here: {message}");
        return;
    }
    assert_eq!(output.status.code(), Some(2), "{message}");
    assert!(
        message.contains("cannot write") && message.contains("No space"),
        "{message}"
    );
    // Only the message is printed, and the disk is empty.
    assert_eq!(message.lines().count(), 1, "{message}");
}

#[test]
fn a_full_standard_output_is_an_error() {
    for arguments in [&["schema"][..], &["analyze", "--help"]] {
        let full = File::options().write(true).open("/dev/full").unwrap();
        let mut command = Command::new(program());
        let output = command.args(arguments).stdout(full).output().unwrap();
        // clap prints its help itself and ignores the failure.
        if arguments[0] == "schema" {
            assert_eq!(output.status.code(), Some(2));
            assert!(
                text(&output.stderr).contains("No space"),
                "{}",
                text(&output.stderr)
            );
        }
        assert!(
            !text(&output.stderr).contains("panicked"),
            "{}",
            text(&output.stderr)
        );
    }
}

/// Root can write anywhere, so the program is run as the user nobody, in a folder of root.
#[test]
fn a_read_only_folder_is_refused_before_the_computation() {
    let folder = TempDir::new().unwrap();
    let mode = |path: &Path, bits| {
        std::fs::set_permissions(path, std::fs::Permissions::from_mode(bits)).unwrap();
    };
    mode(folder.path(), 0o755);
    let copy = folder.path().join("sawflutter");
    std::fs::copy(program(), &copy).unwrap();
    let scene = write_scene(folder.path(), &quick_scene("new"));
    let out = folder.path().join("locked");
    std::fs::create_dir(&out).unwrap();
    mode(&out, 0o555);
    let mut command = Command::new(&copy);
    command.arg("analyze").arg(&scene).arg("--out").arg(&out);
    let nobody = 65_534;
    let output = match command.uid(nobody).gid(nobody).output() {
        Ok(output) => output,
        // A user other than root cannot become nobody, and has no write access either.
        Err(_) => Command::new(&copy)
            .arg("analyze")
            .args([&scene, Path::new("--out"), &out])
            .output()
            .unwrap(),
    };
    let message = text(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{message}");
    assert!(
        message.contains("cannot write to the output folder"),
        "{message}"
    );
    assert!(message.contains("--out"), "{message}");
    assert_eq!(std::fs::read_dir(&out).unwrap().count(), 0);
}

/// Two saws are charted into one folder at the same time: all files belong to one of them.
#[test]
fn two_runs_to_one_folder_do_not_mix() {
    let folder = TempDir::new().unwrap();
    let out = folder.path().join("out");
    let mut thick = quick_scene("thick");
    thick.blade.thickness_m *= 1.5;
    let scenes = [quick_scene("thin"), thick].map(|file| write_scene(folder.path(), &file));
    let mut last = Vec::new();
    for round in 0..6_u64 {
        let runs: Vec<_> = (0..4)
            .map(|k| {
                std::thread::sleep(Duration::from_millis(7 * round));
                analyze(&scenes[k % 2], &out).spawn().unwrap()
            })
            .collect();
        for run in runs {
            let output = run.wait_with_output().unwrap();
            assert!(output.status.success(), "{}", text(&output.stderr));
        }
        last.push(assert_sound(&out).expect("a report"));
    }
    println!("{last:?}");
}
