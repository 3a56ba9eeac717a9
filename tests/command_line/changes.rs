//! Goal: numbers of a scene are changed on the command line as in its file, with their units.
//!
//! Independent value: the report of the same scene with the numbers typed into its file in SI.

use sawflutter::analyses::campbell::Report;
use sawflutter::model::scene::SceneFile;
use tempfile::TempDir;

use super::program::{
    assert_refused, names_in, out, quick_scene, run, sawflutter, text, write_scene, written,
};

fn report(arguments: &[&str], folder: &TempDir) -> Report {
    let output = run(arguments, folder);
    assert!(output.status.success(), "{}", text(&output.stderr));
    written(folder, "report.json")
}

#[test]
fn a_number_that_is_set_is_that_of_a_scene_with_it() {
    let folder = TempDir::new().unwrap();
    let mut file = quick_scene();
    let scene = write_scene(&folder, &file);
    let plain = ["analyze", scene.to_str().unwrap()];
    let set = [
        "--set",
        "blade.thickness_m=2.6mm",
        "--set",
        "operating_rpm=12.5rev/s",
    ];
    let found = report(&[&plain[..], &set].concat(), &folder);
    file.blade.thickness_m = 0.0026;
    file.operating_rpm = Some(750.0);
    let typed_scene = write_scene(&folder, &file);
    let typed = report(&["analyze", typed_scene.to_str().unwrap()], &folder);
    assert_eq!(found.scene, file);
    assert_eq!(
        serde_json::to_string(&found).unwrap(),
        serde_json::to_string(&typed).unwrap()
    );
}

/// Every command that reads a scene has the option, and refuses an unknown path before it computes or writes anything.
#[test]
fn every_command_that_reads_a_scene_takes_settings() {
    let folder = TempDir::new().unwrap();
    let file = |name: &str| crate::common::path(name).to_str().unwrap().to_owned();
    let scene = file("scenes/paper.json");
    let study = file("scenes/studies/paper-tolerances.json");
    let commands: [&[&str]; 10] = [
        &["analyze", &scene],
        &["cut", &scene],
        &["runup", &scene],
        &["deflect", &scene],
        &["washboard", &scene],
        &["fit", &scene],
        &["place", &scene],
        &["study", &scene, &study],
        &["tradeoff", &scene],
        &["export", "--matrices", &scene],
    ];
    for command in commands {
        let set = ["--set", "guides[0].radius_m=20kN"];
        let words = "guides[0].radius_m must be … (you gave \"20kN\")";
        assert_refused(&[command, &set].concat(), words, &folder);
        assert!(names_in(&out(&folder)).is_empty(), "{command:?}");
    }
    let mut check = sawflutter();
    let check = check.args(["check", &scene, "--set", "operating_rpm=20rps"]);
    assert_eq!(check.output().unwrap().status.code(), Some(0));
}

/// The scene in the report of a command, and its messages.
fn scene_of(arguments: &[&str], name: &str, folder: &TempDir) -> (SceneFile, String) {
    let output = run(arguments, folder);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let json: serde_json::Value = written(folder, name);
    let scene = serde_json::from_value(json["scene"].clone()).unwrap();
    (scene, text(&output.stderr).to_owned())
}

/// Shapes are computed and written only on request, and are removed by a run without them.
#[test]
fn shapes_are_written_where_they_are_asked_for() {
    let folder = TempDir::new().unwrap();
    let scene = write_scene(&folder, &quick_scene());
    let plain = ["analyze", scene.to_str().unwrap()];
    let of_modes = |folder: &TempDir| {
        let names = names_in(&out(folder)).into_iter();
        names
            .filter(|name| name.starts_with("modes"))
            .collect::<Vec<_>>()
    };
    let both = report(&[&plain[..], &["--vtk", "--rpm", "500"]].concat(), &folder);
    assert!(
        both.shapes
            .iter()
            .any(|shape| (shape.rpm - 500.0).abs() < 1e-9)
    );
    assert_eq!(of_modes(&folder).len(), 2 + 1 + 12);
    let drawn = report(&[&plain[..], &["--shapes"]].concat(), &folder);
    assert_eq!(of_modes(&folder), ["modes.png", "modes.svg"]);
    assert!(!drawn.shapes.is_empty());
    assert!(report(&plain, &folder).shapes.is_empty());
    assert!(of_modes(&folder).is_empty());
}

#[test]
fn a_scene_without_a_run_up_takes_one_from_options_and_says_what_is_assumed() {
    let folder = TempDir::new().unwrap();
    let mut file = quick_scene();
    file.runup = None;
    file.operating_rpm = Some(1000.0);
    let scene_path = write_scene(&folder, &file);
    let scene = scene_path.to_str().unwrap();
    let options = ["runup", scene, "--seconds", "500ms", "--force", "-5N"];
    let (found, said) = scene_of(&options, "runup.json", &folder);
    let runup = found.runup.unwrap();
    let force_n = found.side_force.unwrap().force_n;
    assert_eq!((runup.duration_s, force_n), (0.5, Some(-5.0)));
    assert_eq!((runup.from_rpm, runup.to_rpm), (0.0, 1500.0));
    assert!(said.contains("runup.to_rpm = 1500"), "{said}");
    assert!(!said.contains("force_n"), "{said}");
}

#[test]
fn a_scene_without_a_cut_takes_one_from_options_and_says_what_is_assumed() {
    let folder = TempDir::new().unwrap();
    let mut file = quick_scene();
    file.cut = None;
    file.operating_rpm = Some(1000.0);
    file.blade.teeth = Some(40);
    let scene_path = write_scene(&folder, &file);
    let scene = scene_path.to_str().unwrap();
    let options = ["cut", scene, "--power", "0.01kW"];
    let (found, said) = scene_of(&options, "cut.json", &folder);
    let cut = found.cut.unwrap();
    assert_eq!(
        (cut.tangential_n_per_tooth, cut.power_w),
        (None, Some(10.0))
    );
    assert!(cut.depth_m.is_some());
    assert_eq!(cut.lateral_n_per_tooth, Some(1.0));
    assert!(said.contains("cut.lateral_n_per_tooth = 1"), "{said}");
    assert!(!said.contains("cut.power_w"), "{said}");
    let length = ["cut", scene, "--power", "20mm"];
    let words = "'20mm' for '--power <W>': it must be a number in W … (you gave \"20mm\")";
    assert_refused(&length, words, &folder);
}

/// A page is written as a whole, and a page that cannot be written is refused before any computation.
#[test]
fn a_page_is_written_beside_the_files_or_refused() {
    let folder = TempDir::new().unwrap();
    let scene_path = write_scene(&folder, &quick_scene());
    let scene = scene_path.to_str().unwrap();
    let page = folder.path().join("page.html");
    let found = report(
        &["analyze", scene, "--report", page.to_str().unwrap()],
        &folder,
    );
    let text_of = |path: &std::path::Path| std::fs::read_to_string(path).unwrap();
    let critical = format!(
        "<td class=\"number\">{:.1}</td>",
        found.critical_speeds[0].rpm
    );
    assert!(text_of(&page).contains(&critical));
    assert!(text_of(&page).ends_with("</html>\n"));
    let check = folder.path().join("check.html");
    let mut command = sawflutter();
    let set = [
        "--set",
        "operating_rpm=600",
        "--report",
        check.to_str().unwrap(),
    ];
    let output = command.args(["check", scene]).args(set).output().unwrap();
    // Nothing restrains this blade against rigid motions, so that it fails the check.
    assert_eq!(output.status.code(), Some(1), "{}", text(&output.stderr));
    // The page has the sentences of the terminal.
    let first = text(&output.stdout).lines().nth(2).unwrap();
    assert!(text_of(&check).contains(first), "{first}");
    // The folder of a page is made.
    let inner = folder.path().join("none/inner/page.html");
    report(
        &["analyze", scene, "--report", inner.to_str().unwrap()],
        &folder,
    );
    assert!(text_of(&inner).ends_with("</html>\n"));
    for wrong in [page.join("page.html"), folder.path().to_owned()] {
        let other = TempDir::new().unwrap();
        let arguments = ["analyze", scene, "--report", wrong.to_str().unwrap()];
        assert_refused(&arguments, "--report", &other);
        assert!(names_in(&out(&other)).is_empty());
    }
    let two = ["analyze", scene, scene, "--report", page.to_str().unwrap()];
    assert_refused(&two, "a page is one saw's", &folder);
}
