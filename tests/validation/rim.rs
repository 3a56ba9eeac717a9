//! The largest deflection of the rim, of a run-up and a cut, compared with the records of probes all around it.
//!
//! A probe does not move the blade, so that runs that differ in their probes show one motion at many places. Between these the
//! rim is the sum of waves that agrees with all of them.

use std::f64::consts::TAU;

use rayon::prelude::*;
use sawflutter::analyses::cut::cut;
use sawflutter::analyses::runup::runup;
use sawflutter::model::scene::{
    Accuracy, CutSpeedFile, ProbeFile, RunUpFile, Scene, SideForceFile, SweepFile,
};

/// Number of probes: their sum of waves has up to seven nodal diameters.
const PROBES: usize = 16;
/// Angles at which the sum of waves is evaluated.
const DENSE: usize = 1440;

/// The largest deflection that a run reports, and the record of its probe.
struct Seen {
    largest_m: f64,
    time: Vec<f64>,
    record_m: Vec<f64>,
}

fn turn(place: usize, of: usize) -> f64 {
    TAU * place as f64 / of as f64
}

/// The largest magnitude at any of the dense angles and times of the records, and its place among the times.
fn largest_of_waves(records: &[Vec<f64>]) -> (f64, usize) {
    let weights: Vec<Vec<f64>> = (0..DENSE)
        .map(|k| {
            let weight = |probe: usize| {
                let x = turn(k, DENSE) - turn(probe, PROBES);
                let waves = (1..PROBES / 2).map(|n| 2.0 * (n as f64 * x).cos());
                (1.0 + waves.sum::<f64>()) / PROBES as f64
            };
            (0..PROBES).map(weight).collect()
        })
        .collect();
    let at = |time: usize| {
        let rim = weights.iter().map(|weights| {
            let pairs = weights.iter().zip(records);
            pairs
                .map(|(weight, record)| weight * record[time])
                .sum::<f64>()
        });
        (rim.fold(0.0, |largest: f64, w| largest.max(w.abs())), time)
    };
    let times = (0..records[0].len()).into_par_iter();
    times
        .map(at)
        .reduce(|| (0.0, 0), |x, y| if y.0 > x.0 { y } else { x })
}

/// Runs a saw with each of the probes, and compares what every run reports with the largest deflection of the waves that all
/// have recorded. Returns the smallest share of it that a probe alone sees, and the time of the largest.
fn assert_rim(run: impl Fn(ProbeFile) -> Seen + Sync) -> (f64, f64) {
    let seen: Vec<Seen> = (0..PROBES)
        .into_par_iter()
        .map(|k| {
            run(ProbeFile {
                radius_m: None,
                angle_deg: turn(k, PROBES).to_degrees(),
            })
        })
        .collect();
    let records: Vec<Vec<f64>> = seen.iter().map(|one| one.record_m.clone()).collect();
    assert!(
        records
            .iter()
            .all(|record| record.len() == records[0].len())
    );
    let (exact, place) = largest_of_waves(&records);
    for one in &seen {
        let error = one.largest_m / exact - 1.0;
        assert!(error.abs() < 5e-3, "{} {exact}: {error:e}", one.largest_m);
    }
    let of_probe = |record: &Vec<f64>| record.iter().fold(0.0, |m: f64, w| m.max(w.abs()));
    let least = records.iter().map(of_probe).fold(f64::INFINITY, f64::min);
    println!(
        "{exact} m at {}, a probe sees {}",
        seen[0].time[place],
        least / exact
    );
    (least / exact, seen[0].time[place])
}

fn with_probe(scene: &Scene, probe: ProbeFile) -> Scene {
    scene.edited(|saw| saw.probe = Some(probe)).unwrap()
}

#[test]
fn the_largest_deflection_of_a_run_up_is_that_of_the_rim() {
    for (stretching, duration_s) in [(false, 1.5), (true, 0.3)] {
        let saw = Scene::paper()
            .edited(|saw| {
                saw.accuracy = Accuracy::Draft;
                saw.sweep = Some(SweepFile {
                    from_rpm: 0.0,
                    to_rpm: 1700.0,
                });
                saw.runup = Some(RunUpFile {
                    from_rpm: 1400.0,
                    to_rpm: 1600.0,
                    duration_s,
                    stretching,
                });
                saw.side_force = Some(SideForceFile::of(0.3));
            })
            .unwrap();
        let (least, rpm) = assert_rim(|probe| {
            let report = runup(&with_probe(&saw, probe), &|_, _| ()).unwrap();
            Seen {
                largest_m: report.largest_deflection_m,
                time: report.rpm,
                record_m: report.deflection_m,
            }
        });
        let at_rpm = runup(&saw, &|_, _| ()).unwrap().largest_deflection_rpm;
        assert!((at_rpm - rpm).abs() < 2.0, "{at_rpm} {rpm}");
        // A probe where the rim moves little misses a good part.
        assert!(least < 0.8, "{least}");
    }
}

#[test]
fn the_largest_deflection_in_a_cut_is_that_of_the_rim() {
    let saw = Scene::paper()
        .edited(|saw| {
            saw.accuracy = Accuracy::Draft;
            let cut = saw.cut.as_mut().expect("the paper's cut");
            cut.lateral_n_per_tooth = Some(0.1);
            cut.speeds = vec![CutSpeedFile {
                rpm: 1200.0,
                ..CutSpeedFile::default()
            }];
        })
        .unwrap();
    let (least, _) = assert_rim(|probe| {
        let scene = with_probe(&saw, probe);
        let report = cut(&scene, &scene.cut().unwrap().runs, &|_, _| ()).unwrap();
        let run = &report.runs[0];
        let until = run
            .time_s
            .iter()
            .filter(|time| **time <= run.forces_to_s)
            .count();
        Seen {
            largest_m: run.largest_deflection_in_cut_m.unwrap(),
            time: run.time_s[..until].to_vec(),
            record_m: run.deflection_m[..until].to_vec(),
        }
    });
    assert!(least < 0.8, "{least}");
}
