//! Text, page, charts and figures of the committed reports `tests/golden/reports/COMMAND-CASE.json` are the committed ones.
//!
//! With the variable SAWFLUTTER_BLESS the texts are written anew; CONTRIBUTING.md says when.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use rayon::prelude::*;

use super::{COMMANDS, Command, CommandReport};
use crate::figure::assert_tidy;
use crate::scene::Scene;

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/golden");
const BLESS: &str = "SAWFLUTTER_BLESS=1 cargo test --profile quick --lib golden";

/// The names of the cases, ascending.
fn cases() -> Vec<String> {
    let entries = std::fs::read_dir(Path::new(FOLDER).join("reports")).unwrap();
    let name = |path: PathBuf| path.file_stem().unwrap().to_str().unwrap().to_owned();
    let mut names: Vec<String> = entries.map(|entry| name(entry.unwrap().path())).collect();
    names.sort();
    names
}

/// The report of a case, whose name begins with its command.
fn read(name: &str) -> Box<dyn CommandReport> {
    let (command, _) = name.split_once('-').unwrap();
    let path = Path::new(FOLDER).join(format!("reports/{name}.json"));
    let report = Command::named(command)
        .unwrap()
        .read(&std::fs::read_to_string(path).unwrap());
    report.unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// All faces of a report: the summary, the page without its drawings, the charts, and a checksum of each drawing.
fn faces(report: &dyn CommandReport) -> Result<String, std::fmt::Error> {
    let mut text = format!("== summary\n{}", report.summary());
    writeln!(text, "== page\n{}", undrawn(&report.page().unwrap()))?;
    for [png, _] in report.command().figures {
        let name = png.trim_end_matches(".png");
        if let Some(chart) = report.chart(name) {
            let json = serde_json::to_string(&chart).unwrap();
            // An item a line, for a difference that can be read.
            let lines = json.replace("{\"item\"", "\n{\"item\"");
            writeln!(text, "== chart {name}\n{lines}")?;
        }
    }
    text += "== figures\n";
    for figure in report.figures() {
        let [_, svg] = figure.names();
        writeln!(text, "{svg} {:016x}", checksum(&figure.svg().unwrap()))?;
    }
    Ok(text)
}

/// A page without its drawings.
fn undrawn(page: &str) -> String {
    let mut parts = page.split("<svg");
    let first = parts.next().unwrap_or_default().to_owned();
    parts.fold(first, |text, part| {
        text + part.split_once("</svg>").unwrap().1
    })
}

/// Checksum FNV-1a of a text, which is the same with every compiler.
fn checksum(text: &str) -> u64 {
    text.bytes().fold(0xcbf2_9ce4_8422_2325, |sum, byte| {
        (sum ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3)
    })
}

/// The first lines in which two texts differ.
fn difference(expected: &str, found: &str) -> String {
    let pairs = expected.lines().zip(found.lines());
    let differing = pairs.filter(|(one, other)| one != other);
    let shown = |text: &str| text.chars().take(200).collect::<String>();
    let lines = differing.map(|(one, other)| format!("  - {}\n  + {}\n", shown(one), shown(other)));
    lines.take(5).collect()
}

#[test]
fn faces_of_committed_reports_are_the_committed_ones() {
    let is_blessed = std::env::var_os("SAWFLUTTER_BLESS").is_some();
    let differing = cases().into_par_iter().filter_map(|name| {
        let found = faces(&*read(&name)).unwrap();
        let path = Path::new(FOLDER).join(format!("expected/{name}.txt"));
        if is_blessed {
            std::fs::write(path, found).unwrap();
            return None;
        }
        let expected = std::fs::read_to_string(path).unwrap_or_default();
        (expected != found).then(|| format!("{name}:\n{}", difference(&expected, &found)))
    });
    let differing: String = differing.collect();
    assert!(differing.is_empty(), "{differing}If this is meant: {BLESS}");
}

/// A page refers to no other file, and has the scene for programs.
#[test]
fn pages_of_committed_reports_are_complete() {
    for name in cases() {
        let report = read(&name);
        let page = report.page().unwrap();
        assert_eq!(
            page.matches("<svg").count(),
            report.figures().len(),
            "{name}"
        );
        assert_eq!(
            page.matches("<tr>").count(),
            page.matches("</tr>").count(),
            "{name}"
        );
        for outside in ["src=", "href=", "@import", "url("] {
            assert!(!page.contains(outside), "{name}: {outside}");
        }
        let scene = page.split("id=\"scene\">").nth(1).unwrap();
        let scene = Scene::from_json(scene.split("</script>").next().unwrap()).unwrap();
        assert_eq!(scene.file(), report.scene(), "{name}");
    }
}

#[test]
fn the_reference_lists_the_files_of_every_command() {
    let read = |page: &str| {
        let path = format!("{}/docs/reference/{page}.md", env!("CARGO_MANIFEST_DIR"));
        std::fs::read_to_string(path).unwrap()
    };
    let (files, reports) = (read("files"), read("reports"));
    for command in COMMANDS {
        let row = format!("| `{}", command.name);
        let row = files.lines().find(|line| line.starts_with(&row)).unwrap();
        assert!(row.contains(&format!("`{}`", command.file)), "{row}");
        for [_, svg] in command.figures {
            let name = svg.trim_end_matches(".svg");
            assert!(row.contains(&format!("`{name}.png/.svg`")), "{name}: {row}");
        }
        assert!(
            reports.contains(&format!("| `{}` |", command.file)),
            "{}",
            command.file
        );
    }
}

#[test]
fn figures_of_committed_reports_are_tidy_and_every_command_has_some() {
    let cases = cases();
    for command in COMMANDS {
        let own = cases
            .iter()
            .filter(|name| name.starts_with(&format!("{}-", command.name)));
        assert!(own.count() >= 1, "{}", command.name);
    }
    cases.par_iter().for_each(|name| {
        for figure in read(name).figures() {
            println!("{name}: {}", figure.names()[0]);
            assert_tidy(figure.sheet());
        }
    });
}

/// The keys that say which program computed which saw, as readers of any report find them; only `compare` has several saws.
#[test]
fn every_report_of_one_saw_begins_with_the_same_keys() {
    const FIRST: [&str; 4] = ["sawflutter", "scene", "condition", "unusual_numbers"];
    for command in COMMANDS.iter().filter(|command| command.name != "compare") {
        let schema = command.schema();
        let keys: Vec<&str> = schema["required"].as_array().unwrap()[..4]
            .iter()
            .filter_map(serde_json::Value::as_str)
            .collect();
        assert_eq!(keys, FIRST, "{}", command.name);
    }
}
