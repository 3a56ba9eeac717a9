//! Goal: a scene that cannot be analysed is refused with one clear message that names the key and the remedy, exit code
//! 2, and nothing written.
//!
//! Source: the scene keys and exit codes of docs/reference and `--help`.

use crate::common::says;
use std::fs::File;
use std::path::Path;
use std::time::Duration;

use assert_cmd::Command;
use sawflutter::model::scene::Scene;
use tempfile::TempDir;

use super::program::{names_in, program, sawflutter, text};

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
    let message = text(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{message}");
    assert_eq!(text(&output.stdout), "");
    assert!(message.starts_with("error: "), "{message}");
    assert_eq!(message.lines().count(), 1, "{message}");
    assert!(!out.exists(), "{:?}", names_in(&out));
    message.to_owned()
}

/// Runs the text of a scene that must be refused.
fn refused_text(text: &[u8]) -> String {
    let folder = TempDir::new().unwrap();
    let scene = folder.path().join("scene.json");
    std::fs::write(&scene, text).unwrap();
    refused(&scene)
}

/// The paper's scene with one text replaced by another.
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
        // An unknown key is named, and not the error that its absence would cause.
        let key = if instead.contains("unused") {
            "guides[0].unused"
        } else {
            key
        };
        let message = refused_text(paper_with(line, instead).as_bytes());
        assert!(
            message.contains(&format!("{key}: ")) || message.contains(&format!("{key} must be ")),
            "{instead} should be refused as {key}, not as: {message}"
        );
    }
}

/// The message for a pad inside the bore, which does not touch the blade, names the radii of the blade.
#[test]
fn a_pad_off_the_blade_is_refused_with_the_radii_of_the_blade() {
    let mut file = Scene::paper().file().clone();
    file.guides[0].radius_m = 0.01;
    file.guides[0].radial_length_m = 0.02;
    file.guides[0].tangential_length_m = 0.02;
    let message = refused_text(serde_json::to_string(&file).unwrap().as_bytes());
    for part in [
        "guides[0].radius_m must be … (you gave 0.01)",
        "off the blade",
        "0.1",
        "0.355",
    ] {
        assert!(says(&message, part), "no {part:?} in {message}");
    }
}

#[test]
fn files_other_than_scenes_are_refused() {
    for (text, expected) in [
        ("", "empty"),
        ("  \n\t ", "empty"),
        ("{", "add the missing }"),
        (
            "[]",
            "the scene: it must be an object in braces { } (you gave a list",
        ),
        ("{} {}", "name"),
        ("radius,thickness\n1,2\n", "the scene"),
    ] {
        let message = refused_text(text.as_bytes());
        assert!(message.contains(expected), "{text:?}: {message}");
    }
    let twice = format!("{0}{0}", paper_with(THICKNESS, THICKNESS));
    let message = refused_text(twice.as_bytes());
    assert!(message.contains("trailing"), "{message}");
    let of_bytes = refused_text(b"{\"name\": \"\xff\xfe\"}");
    assert!(of_bytes.contains("UTF-8"), "{of_bytes}");
}

#[test]
fn a_directory_and_a_missing_file_are_refused_by_name() {
    let folder = TempDir::new().unwrap();
    let message = refused(folder.path());
    assert!(message.contains("is a directory"), "{message}");
    let missing = folder.path().join("no-such-scene.json");
    let of_missing = refused(&missing);
    assert!(of_missing.contains("no-such-scene.json"), "{of_missing}");
}

/// A sparse file of 1 TB of zeros, which must not be read to its end, in a process limited to half a gigabyte of
/// memory.
#[test]
fn a_huge_file_is_refused_unread_and_in_little_memory() {
    let folder = TempDir::new().unwrap();
    let huge = folder.path().join("huge.json");
    let file = File::create(&huge).unwrap();
    // If the file system does not allow a file of this size, a smaller one is used that is still too large.
    file.set_len(1 << 40)
        .or_else(|_| file.set_len(1_000_000_000))
        .unwrap();
    let message = refused(&huge);
    assert!(message.contains("larger than"), "{message}");

    #[cfg(target_os = "linux")]
    {
        let output = Command::new("sh")
            .arg("-c")
            .arg("ulimit -v 500000 && exec \"$0\" analyze \"$1\" --out \"$2\"")
            .arg(program())
            .args([&huge, &folder.path().join("out")])
            .output()
            .unwrap();
        assert_eq!(output.status.code(), Some(2), "{}", text(&output.stderr));
        assert_eq!(text(&output.stderr), message);
    }
}

/// The output folder is refused before the computation: the analysis of this saw, whose rim is so hot that the blade
/// buckles, would end with another message.
#[test]
fn an_output_folder_that_cannot_be_written_is_refused_before_the_computation() {
    let folder = TempDir::new().unwrap();
    let file = folder.path().join("file");
    std::fs::write(&file, "mine").unwrap();
    let mut places = vec![file.clone(), file.join("below")];
    if cfg!(target_os = "linux") {
        // Even root cannot make a folder there.
        places.push("/proc/sawflutter-out".into());
    }
    let locked = folder.path().join("locked");
    std::fs::create_dir(&locked).unwrap();
    let mut permissions = std::fs::metadata(&locked).unwrap().permissions();
    permissions.set_readonly(true);
    std::fs::set_permissions(&locked, permissions).unwrap();
    // Root can write here, so the case applies to other users only.
    if File::create(locked.join("probe")).is_err() {
        places.push(locked.clone());
        places.push(locked.join("below"));
    }
    let scene = folder.path().join("scene.json");
    let mut hot = crate::common::scene("collar-400mm-tensioned")
        .file()
        .clone();
    let membrane = hot.membrane.as_mut().unwrap();
    membrane.temperature.as_mut().unwrap().rim_rise_k = Some(400.0);
    std::fs::write(&scene, serde_json::to_string(&hot).unwrap()).unwrap();
    let analyze = |place: &Path| {
        let mut command = sawflutter();
        command.arg("analyze").arg(&scene).arg("--out").arg(place);
        command.output().unwrap()
    };
    let computed = analyze(&folder.path().join("writable"));
    assert!(text(&computed.stderr).contains("buckles"));
    for place in places {
        let output = analyze(&place);
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{message}");
        assert_eq!(message.lines().count(), 1, "{message}");
        assert!(message.contains(place.to_str().unwrap()), "{message}");
        assert!(!message.contains("buckles"), "{message}");
        assert_eq!(text(&output.stdout), "");
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
        assert_eq!(text(&output.stdout), "");
        assert!(names_in(folder.path()).is_empty());
    }
}
