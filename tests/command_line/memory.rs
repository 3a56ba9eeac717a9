//! Goal: a fine chart fits into the memory of a small machine.

use std::process::{Command, Stdio};
use std::time::Duration;

use crate::common::scene;
use crate::program::{out, program, write_scene};

/// Three dense matrices of 4230 functions take 430 MB; the basis that the error is measured by has 6930.
const MOST_MEGABYTES: f64 = 2000.0;
const LOOK_EVERY: Duration = Duration::from_millis(5);

/// Linux tells the largest memory of a process while it runs.
#[test]
fn a_chart_of_four_thousand_functions_takes_less_than_two_gigabytes() {
    let folder = tempfile::tempdir().unwrap();
    let mut file = scene("paper").file().clone();
    file.tolerance = Some(2e-6);
    let mut running = Command::new(program())
        .arg("analyze")
        .arg(write_scene(&folder, &file))
        .arg("--out")
        .arg(out(&folder))
        .env("RAYON_NUM_THREADS", "2")
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let status = format!("/proc/{}/status", running.id());
    let mut most = 0.0_f64;
    let ended = loop {
        if let Some(ended) = running.try_wait().unwrap() {
            break ended;
        }
        most = most.max(peak_megabytes(&status).unwrap_or(0.0));
        std::thread::sleep(LOOK_EVERY);
    };
    assert!(ended.success());
    let report = std::fs::read(out(&folder).join("report.json")).unwrap();
    let report: serde_json::Value = serde_json::from_slice(&report).unwrap();
    assert_eq!(report["accuracy"]["degrees_of_freedom"], 4230);
    assert_eq!(report["accuracy"]["reached"], true);
    println!("{most:.0} MB");
    assert!(most > 100.0 && most < MOST_MEGABYTES, "{most} MB");
}

fn peak_megabytes(status: &str) -> Option<f64> {
    let status = std::fs::read_to_string(status).ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    let kilobytes: f64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(kilobytes / 1024.0)
}
