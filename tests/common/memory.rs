//! The largest memory of a chart.
#![cfg(target_os = "linux")]

use std::process::{Command, Stdio};
use std::time::Duration;

use crate::common::limit::Limit;
use crate::common::scene;
use crate::program::{out, program, write_scene};

const LOOK_EVERY: Duration = Duration::from_millis(5);

/// The number of functions that a tolerance needs for the paper's saw, and the largest memory of its chart in
/// megabytes, which Linux reports while the program runs.
pub fn functions_and_megabytes(tolerance: f64, seconds: u64) -> (u64, f64) {
    let _limit = Limit::of(seconds, &format!("the memory of a chart to {tolerance:e}"));
    let folder = tempfile::tempdir().unwrap();
    let mut file = scene("paper").file().clone();
    file.tolerance = Some(tolerance);
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
    let content = std::fs::read(out(&folder).join("report.json")).unwrap();
    let report: serde_json::Value = serde_json::from_slice(&content).unwrap();
    let accuracy = &report["accuracy"];
    assert_eq!(accuracy["reached"], true);
    let functions = accuracy["degrees_of_freedom"].as_u64().unwrap();
    println!("{functions} functions, {most:.0} MB");
    (functions, most)
}

fn peak_megabytes(status: &str) -> Option<f64> {
    let status = std::fs::read_to_string(status).ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    let kilobytes: f64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(kilobytes / 1024.0)
}
