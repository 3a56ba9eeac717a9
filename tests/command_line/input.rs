//! Goal: input in common spellings is read if it is unambiguous; other input is refused once, with the key and the
//! remedy.

use std::path::{Path, PathBuf};
use std::process::Output;

use sawflutter::analyses::campbell::Report;
use sawflutter::model::scene::{Accuracy, SceneFile};
use tempfile::TempDir;

use super::program::{
    assert_in_80_columns, names_in, out, quick_scene, run, sawflutter, text, write_scene, written,
};

fn json(file: &SceneFile) -> String {
    serde_json::to_string_pretty(file).unwrap()
}

fn utf_16(text: &str, of: fn(u16) -> [u8; 2]) -> Vec<u8> {
    text.encode_utf16().flat_map(of).collect()
}

/// The scene that a run has reported.
fn reported(folder: &Path) -> SceneFile {
    let written = std::fs::read(folder.join("report.json")).unwrap();
    serde_json::from_slice::<Report>(&written).unwrap().scene
}

#[test]
fn json_with_a_mark_in_utf_16_with_comments_or_quoted_numbers_is_the_same_scene() {
    let mut file = quick_scene();
    file.name = "Säge Ø 400".into();
    let plain = json(&file);
    let thickness = format!("\"thickness_m\": {}", file.blade.thickness_m);
    assert_eq!(plain.matches(&thickness).count(), 1);
    let quoted = format!("\"thickness_m\": \"{}\"", file.blade.thickness_m);
    let marked = format!("\u{feff}{plain}");
    let comments = format!(
        "// mine\n{}, /* the\nend */\n}}\n",
        &plain[..plain.len() - 1]
    );
    let cases = [
        marked.clone().into_bytes(),
        utf_16(&marked, u16::to_le_bytes),
        utf_16(&marked, u16::to_be_bytes),
        utf_16(&plain, u16::to_le_bytes),
        comments.into_bytes(),
        plain.replace(&thickness, &quoted).into_bytes(),
    ];
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("scene.json");
    for (index, bytes) in cases.iter().enumerate() {
        std::fs::write(&path, bytes).unwrap();
        let output = run(&["analyze", path.to_str().unwrap()], &folder);
        assert!(output.status.success(), "{index}: {}", text(&output.stderr));
        assert_eq!(reported(&out(&folder)), file, "{index}");
    }
}

/// The message of a command that must be refused.
fn refusal(output: &Output) -> String {
    let message = text(&output.stderr).to_owned();
    assert_eq!(output.status.code(), Some(2), "{message}");
    assert_eq!(text(&output.stdout), "");
    message
}

#[test]
fn json_that_is_none_is_refused_by_cause_and_remedy() {
    let file = quick_scene();
    let thickness = format!("\"thickness_m\": {}", file.blade.thickness_m);
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("scene.json");
    for (instead, parts) in [
        (
            "\"thickness_m\": 0,0028",
            ["blade.thickness_m: 0,0028", "write 0.0028"],
        ),
        (
            "\"thickness_m\": \"0,0028\"",
            ["blade.thickness_m: ", "decimal point"],
        ),
        (
            "\"thickness_m\": NaN",
            ["blade.thickness_m: NaN", "not a number"],
        ),
        (
            "\"thickness_m\": [0.0028]",
            ["blade.thickness_m: ", "must be a number"],
        ),
        ("\"thickness_m\": 2.8mm", ["blade: 2.8mm", "without unit"]),
        (
            "\"thickness_m\": .0028",
            ["blade.thickness_m: .0028", "both sides of the point"],
        ),
        (
            "\"thickness_mm\": 2.8",
            [
                "blade.thickness_mm: ",
                "did you mean thickness_m? One mm is 0.001 m",
            ],
        ),
        (
            "\"thicknes_m\": 0.0028",
            ["blade.thicknes_m: ", "did you mean thickness_m?"],
        ),
        (
            "'thickness_m': 0.0028",
            ["blade: 'thickness_m'", "double quotation marks"],
        ),
        (
            "thickness_m: 0.0028",
            ["blade: the key thickness_m", "double quotation marks"],
        ),
    ] {
        std::fs::write(&path, json(&file).replace(&thickness, instead)).unwrap();
        let message = refusal(&run(&["analyze", path.to_str().unwrap()], &folder));
        for part in parts {
            assert!(
                message.contains(part),
                "{instead}: no {part:?} in {message}"
            );
        }
        assert_eq!(message.lines().count(), 1, "{message}");
        assert_eq!(names_in(&out(&folder)), [""; 0]);
    }
}

/// An error names its cause once, and not `cannot read x: No such file: No such file`.
#[test]
fn a_cause_is_named_once() {
    let folder = TempDir::new().unwrap();
    let missing = folder.path().join("missing.json");
    let message = refusal(&run(&["analyze", missing.to_str().unwrap()], &folder));
    assert_eq!(message.matches("No such file").count(), 1, "{message}");
    assert_eq!(message.matches("missing.json").count(), 1, "{message}");
    let of_folder = refusal(&run(&["analyze", folder.path().to_str().unwrap()], &folder));
    assert!(of_folder.contains("is a directory"), "{of_folder}");
    assert!(!of_folder.contains("refused"), "{of_folder}");
}

#[test]
fn the_error_for_a_workbook_advises_to_save_it_as_csv() {
    let folder = TempDir::new().unwrap();
    let scene = write_scene(&folder, &quick_scene());
    let workbook = folder.path().join("measured.xlsx");
    std::fs::write(&workbook, b"PK\x03\x04\x14\0\x06\0").unwrap();
    let paths = [scene.to_str().unwrap(), workbook.to_str().unwrap()];
    let message = refusal(&run(&["fit", paths[0], paths[1]], &folder));
    assert!(message.contains("save it as CSV"), "{message}");
}

#[test]
fn a_file_without_a_command_is_analyzed() {
    let folder = TempDir::new().unwrap();
    let scene = write_scene(&folder, &quick_scene());
    let output = run(&[scene.to_str().unwrap(), "--accuracy", "draft"], &folder);
    assert!(output.status.success(), "{}", text(&output.stderr));
    assert_eq!(reported(&out(&folder)), quick_scene());
    let message = refusal(&run(&["no-such-scene.json"], &folder));
    assert!(
        message.contains("cannot read no-such-scene.json"),
        "{message}"
    );
}

#[test]
fn a_scene_may_come_from_standard_input() {
    let folder = TempDir::new().unwrap();
    for arguments in [&["analyze", "-"][..], &["-"]] {
        let output = sawflutter()
            .args(arguments)
            .arg("--out")
            .arg(out(&folder))
            .write_stdin(json(&quick_scene()))
            .output()
            .unwrap();
        assert!(output.status.success(), "{}", text(&output.stderr));
        assert_eq!(reported(&out(&folder)), quick_scene());
    }
    let output = sawflutter().arg("-").write_stdin("").output().unwrap();
    let message = refusal(&output);
    assert!(message.contains("standard input"), "{message}");
    assert!(message.contains("empty"), "{message}");
}

#[test]
fn a_typing_mistake_is_answered_with_the_name_that_was_meant() {
    for (typed, meant) in [
        (&["analyse"][..], "'analyze'"),
        (&["chek"], "'check'"),
        (&["analyze", "--acuracy", "draft"], "'--accuracy'"),
        (&["analyze", "--accuracy", "drft"], "'draft'"),
    ] {
        let message = refusal(&sawflutter().args(typed).output().unwrap());
        assert!(message.contains("similar"), "{message}");
        assert!(message.contains(meant), "{message}");
    }
}

/// Writes a scene into a folder of its own and gives its path.
fn scene_in(folder: &TempDir, name: &str, file: &SceneFile) -> PathBuf {
    let path = folder.path().join(name);
    std::fs::create_dir_all(path.parent().unwrap()).unwrap();
    std::fs::write(&path, json(file)).unwrap();
    path
}

#[test]
fn several_scenes_make_a_folder_each_and_a_table() {
    let folder = TempDir::new().unwrap();
    let mut thin = quick_scene();
    thin.operating_rpm = Some(1250.0);
    let mut thick = thin.clone();
    thick.blade.thickness_m *= 1.5;
    let scenes = [
        scene_in(&folder, "one/thin.json", &thin),
        scene_in(&folder, "two/thin.json", &thick),
    ];
    let paths = scenes.each_ref().map(|path| path.to_str().unwrap());
    let output = run(&[paths[0], paths[1], "--json"], &folder);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let out = out(&folder);
    assert_eq!(
        names_in(&out),
        ["scenes.csv", "scenes.json", "thin", "thin-2"]
    );
    assert_eq!(reported(&out.join("thin")), thin);
    assert_eq!(reported(&out.join("thin-2")), thick);
    // The table has the numbers of the reports.
    let rows: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    for (row, name) in rows.as_array().unwrap().iter().zip(["thin", "thin-2"]) {
        let written = std::fs::read(out.join(name).join("report.json")).unwrap();
        let report: Report = serde_json::from_slice(&written).unwrap();
        assert_eq!(row["folder"], name);
        assert_eq!(row["first_critical_rpm"], report.critical_speeds[0].rpm);
        assert_eq!(row["instabilities"], report.instabilities.len());
        assert_eq!(row["operating_rpm"], 1250.0);
        let operating = report.operating.unwrap();
        assert_eq!(
            row["of_first_critical"],
            operating.of_first_critical.unwrap()
        );
        let answer = serde_json::to_value(report.verdict.answer).unwrap();
        assert_eq!(row["answer"], answer);
    }
    let table = run(&[paths[0], paths[1]], &folder);
    assert_in_80_columns(text(&table.stdout));
    assert!(text(&table.stdout).contains("thin-2"));
}

/// Nothing is computed if one of the files is refused.
#[test]
fn several_scenes_are_read_before_the_first_is_computed() {
    let folder = TempDir::new().unwrap();
    let good = scene_in(&folder, "good.json", &quick_scene());
    let mut wrong = quick_scene();
    wrong.blade.thickness_m = -1.0;
    let bad = scene_in(&folder, "bad.json", &wrong);
    let paths = [good.to_str().unwrap(), bad.to_str().unwrap()];
    let message = refusal(&run(&paths, &folder));
    assert!(
        message.contains("bad.json was refused: blade.thickness_m"),
        "{message}"
    );
    assert!(!out(&folder).exists());
    // With --keep-going the error is a row of the table.
    let output = run(&[&paths[..], &["--keep-going"]].concat(), &folder);
    assert_eq!(output.status.code(), Some(2));
    assert!(text(&output.stderr).contains("1 of 2 scenes"));
    let table = text(&output.stdout);
    assert!(
        table.contains("failed: ") && table.contains("blade.thickness_m"),
        "{table}"
    );
    assert_eq!(
        names_in(&out(&folder)),
        ["good", "scenes.csv", "scenes.json"]
    );
}

/// A refused run leaves no folder that was not there before.
#[test]
fn a_refused_run_leaves_no_empty_folder() {
    let folder = TempDir::new().unwrap();
    let mut file = quick_scene();
    file.sweep.as_mut().unwrap().to_rpm = 4e5;
    let scene = write_scene(&folder, &file);
    let inside = folder.path().join("results/of/today");
    let mut command = sawflutter();
    let arguments = ["analyze", scene.to_str().unwrap(), "--out"];
    let output = command.args(arguments).arg(&inside).output().unwrap();
    assert_eq!(output.status.code(), Some(2), "{}", text(&output.stdout));
    assert!(!folder.path().join("results").exists());
}

#[test]
fn control_characters_are_not_sent_to_the_terminal() {
    let folder = TempDir::new().unwrap();
    let mut file = quick_scene();
    file.name = "evil \u{1b}]0;title\u{7} \u{9b}2J \u{202e}was".into();
    let scene_path = write_scene(&folder, &file);
    let steering = |c: char| (c.is_control() && c != '\n') || c == '\u{202e}';
    let scene = scene_path.to_str().unwrap();
    for arguments in [
        &["analyze", scene][..],
        &["analyze", scene, "--json"],
        &["export", "--matrices", scene],
        &["check", scene, "--rpm", "1000"],
        &["no\u{1b}[31msuch.json"],
        &["\u{1b}[31m"],
        &["fit", scene, "no\u{9b}such.csv"],
    ] {
        let output = run(arguments, &folder);
        let shown = [text(&output.stdout), text(&output.stderr)].concat();
        assert!(!shown.is_empty() && !shown.contains(steering), "{shown:?}");
        if arguments.contains(&"--json") {
            let report: Report = serde_json::from_slice(&output.stdout).unwrap();
            assert_eq!(report.scene, file);
        }
    }
}

/// Item 13: files of an earlier run of the command are removed, because they belong to another saw.
#[test]
fn files_of_another_saw_do_not_stay() {
    let folder = TempDir::new().unwrap();
    let out = out(&folder);
    std::fs::create_dir(&out).unwrap();
    let scene_path = write_scene(&folder, &quick_scene());
    let scene = scene_path.to_str().unwrap();
    for (arguments, optional) in [
        (
            &["analyze", scene][..],
            &[
                "root-loci.png",
                "root-loci.svg",
                "membrane.png",
                "membrane.svg",
                "in-cut.png",
                "in-cut.svg",
                "scenes.csv",
                "scenes.json",
            ][..],
        ),
        (
            &["export", "--matrices", scene],
            &["damping.npy", "circulatory.npy"],
        ),
    ] {
        for name in optional.iter().chain(&["notes.txt"]) {
            std::fs::write(out.join(name), "of another saw").unwrap();
        }
        let output = run(arguments, &folder);
        assert!(output.status.success(), "{}", text(&output.stderr));
        let left = names_in(&out);
        let stale = |name: &&&str| left.iter().any(|other| other == *name);
        assert_eq!(optional.iter().find(stale), None, "{left:?}");
        assert!(left.iter().any(|name| name == "notes.txt"), "{left:?}");
    }
}

/// Item 14: a density in g/cm³ gives a warning with the number that was meant.
#[test]
fn numbers_in_other_units_are_warned_of() {
    let folder = TempDir::new().unwrap();
    let mut file = quick_scene();
    let own = run(
        &["analyze", write_scene(&folder, &file).to_str().unwrap()],
        &folder,
    );
    assert!(
        !text(&own.stdout).contains("Unusual number"),
        "{}",
        text(&own.stdout)
    );
    file.blade.material.density_kg_per_m3 = 7.8;
    let scene_path = write_scene(&folder, &file);
    let scene = scene_path.to_str().unwrap();
    let output = run(&["analyze", scene], &folder);
    assert!(output.status.success(), "{}", text(&output.stderr));
    // The summary breaks its lines at blanks.
    let words = text(&output.stdout).replace("\n  ", " ");
    let report: Report = written(&folder, "report.json");
    let expected = "are these g/cm³? That would be 7800 kg/m³";
    let [warning] = &report.unusual_numbers[..] else {
        panic!("{:?}", report.unusual_numbers);
    };
    assert!(warning.contains(expected), "{warning}");
    // The warning comes before the verdict.
    let place = |part: &str| {
        words
            .find(part)
            .unwrap_or_else(|| panic!("{part} in {words}"))
    };
    assert!(
        place(warning) < place("No speed is safe: nothing holds"),
        "{words}"
    );
}

/// A check fails for a number that no saw has, in the scene or in the options, unless the number is accepted.
#[test]
fn a_check_with_a_number_of_another_unit_fails() {
    let folder = TempDir::new().unwrap();
    let mut file = crate::common::scene("collar-400mm").file().clone();
    file.accuracy = Accuracy::Draft;
    file.blade.material.density_kg_per_m3 = 7.85;
    let scene_path = write_scene(&folder, &file);
    let scene = scene_path.to_str().unwrap();
    let check = |rpm: &str, more: &[&str]| {
        let arguments = [&["check", scene, "--rpm", rpm], more].concat();
        let output = run(&arguments, &folder);
        (
            output.status.code(),
            text(&output.stdout).replace("\n  ", " "),
        )
    };
    let (code, words) = check("1250", &[]);
    assert_eq!(code, Some(1), "{words}");
    for part in [
        "density_kg_per_m3 is 7.85 kg/m³",
        "usual range 2000 to 20000",
        "7850 kg/m³",
        "--accept-unusual",
    ] {
        assert!(words.contains(part), "{part} in {words}");
    }
    let (code, words) = check("1250", &["--accept-unusual"]);
    assert_eq!(code, Some(0), "{words}");
    assert!(words.contains("density_kg_per_m3 is 7.85 kg/m³"), "{words}");
    file.blade.material.density_kg_per_m3 = 7850.0;
    write_scene(&folder, &file);
    let (code, words) = check("50", &[]);
    assert_eq!(code, Some(1), "{words}");
    assert!(words.contains("That would be 3000 rpm"), "{words}");
    // A point that may separate thousands is refused.
    assert_eq!(check("1.250", &[]).0, Some(2));
    let (code, words) = check("1250", &[]);
    assert_eq!(code, Some(0), "{words}");
}

/// Item 15: the program under test prints keys in the order of their declaration, as the library that the tests are
/// built with does. The test fails for a program whose dependencies have other features.
#[test]
fn the_shipped_program_orders_keys_as_the_tested_one() {
    let output = sawflutter().arg("schema").output().unwrap();
    let own = serde_json::to_string_pretty(&sawflutter::model::scene::json_schema()).unwrap();
    assert_eq!(text(&output.stdout).trim_end(), own);
    let declared = [
        "name",
        "notes",
        "blade",
        "mount",
        "guides",
        "operating_rpm",
        "cut",
    ];
    let schema = sawflutter::model::scene::json_schema();
    let keys: Vec<&String> = schema["properties"].as_object().unwrap().keys().collect();
    let place = |key: &&str| keys.iter().position(|own| own == key).unwrap();
    assert!(declared.iter().map(place).is_sorted(), "{keys:?}");
}
