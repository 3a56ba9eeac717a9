//! Remakes `figures/`: `cargo run --release --example gallery`.

use std::path::Path;

use anyhow::Context;
use sawflutter::check::{Check, Limits};
use sawflutter::figure;
use sawflutter::fit::{Fit, Measurement};
use sawflutter::place::{Demands, Placement};
use sawflutter::report::{CheckReport, CutReport, FitReport, PlaceReport, Report, RunUpReport};
use sawflutter::scene::{Freed, Scene, rad_per_s};
use sawflutter::stability::Analysis;
use sawflutter::transient::{Cutting, RunningUp};

fn main() -> anyhow::Result<()> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut scenes: Vec<_> = std::fs::read_dir(root.join("scenes"))?
        .map(|entry| entry.map(|entry| entry.path()))
        .collect::<Result<_, _>>()?;
    scenes.retain(|path| path.is_file());
    scenes.sort();
    for path in scenes {
        let name = path
            .file_stem()
            .context("a scene has a name")?
            .to_string_lossy()
            .into_owned();
        let scene = Scene::from_path(&path)?;
        let write = |suffix: &str, content: &[u8]| {
            std::fs::write(
                root.join("figures").join(format!("{name}-{suffix}")),
                content,
            )
        };
        if let (Some(_), Some(cut)) = (&scene.spline, &scene.cut) {
            // Another scene's saw on its spline: only that is new.
            let report = CutReport::new(&scene, &Cutting::new(&scene, cut, &cut.runs, &|_, _| ())?);
            let orbit = figure::spline_orbit_png(&report)?.context("it has a spline")?;
            write("orbit.png", &orbit)?;
            println!("{name}");
            continue;
        }
        let analysis = Analysis::new(&scene, &|_, _| ())?;
        let report = Report::new(&scene, &analysis)?;
        write("campbell.png", &figure::campbell_png(&report)?)?;
        write("campbell.svg", figure::campbell_svg(&report)?.as_bytes())?;
        if let Some(png) = figure::root_loci_png(&report)? {
            write("root-loci.png", &png)?;
        }
        if let Some(png) = figure::membrane_png(&report)? {
            write("membrane.png", &png)?;
        }
        if let Some(cut) = &scene.cut {
            let cutting = Cutting::new(&scene, cut, &cut.runs, &|_, _| ())?;
            let report = CutReport::new(&scene, &cutting);
            write("cut.png", &figure::cut_png(&report)?)?;
            write("cut-map.png", &figure::cut_map_png(&report)?)?;
        }
        if let Some(runup) = &scene.runup {
            let found = RunningUp::new(&scene, runup, &|_, _| ())?;
            let report = RunUpReport::new(&scene, runup, &found)?;
            write("runup.png", &figure::runup_png(&report)?)?;
            write("response-map.png", &figure::response_map_png(&report)?)?;
        }
        if scene.operating_rad_per_s.is_some() && scene.guides.len() == 1 {
            write("check.png", &figure::check_png(&check(&scene)?)?)?;
        }
        if scene.file.measured.is_some() {
            write("fit.png", &figure::fit_png(&fit(&scene)?)?)?;
        }
        if scene.guides.len() > 1 {
            let png = figure::place_png(&place(&scene)?)?.context("it has a map")?;
            write("place.png", &png)?;
        }
        println!("{name}");
    }
    // A thousand saws take minutes: README.md says how its report was made.
    let figures = root.join("figures");
    let report = std::fs::read_to_string(figures.join("paper-study.json"))?;
    let report = serde_json::from_str(&report)?;
    std::fs::write(figures.join("paper-study.png"), figure::study_png(&report)?)?;
    println!("paper-study");
    Ok(())
}

/// `sawflutter check --operating-rpm 1250 --min-critical-rpm 1500 --min-flutter-rpm 2500`.
fn check(scene: &Scene) -> anyhow::Result<CheckReport> {
    let limits = Limits {
        min_critical_rad_per_s: Some(rad_per_s(1500.0)),
        min_flutter_rad_per_s: Some(rad_per_s(2500.0)),
        ..Limits::at(rad_per_s(1250.0))
    };
    let check = Check::new(scene, &limits)?;
    Ok(CheckReport::new(scene, &limits, &check))
}

/// `sawflutter fit --to-rpm 1250`.
fn fit(scene: &Scene) -> anyhow::Result<FitReport> {
    let to_rpm = 1250.0;
    let own = scene.file.measured.as_ref().context("it is measured")?;
    let measurement = Measurement::of_scene(own);
    let freed = ["radius_m", "stiffness_n_per_m"]
        .map(|name| Freed::with_usual_bounds(scene, &format!("guides[0].{name}")));
    let freed = freed.into_iter().collect::<Result<Vec<_>, _>>()?;
    let options = sawflutter::fit::Options::default();
    let fit = Fit::new(
        scene,
        &measurement.up_to(to_rpm),
        &freed,
        &options,
        &|_, _| (),
    )?;
    Ok(FitReport::new(
        scene,
        &measurement,
        to_rpm,
        options.confidence,
        &fit,
    )?)
}

/// `sawflutter place` with the pad's radius and angle free.
fn place(scene: &Scene) -> anyhow::Result<PlaceReport> {
    let radius = Freed::new(&scene.file, "guides[0].radius_m", 0.2, 0.3)?;
    let angle = Freed::new(&scene.file, "guides[0].angle_deg", -120.0, 0.0)?;
    let options = sawflutter::place::Options {
        map: 21,
        ..Default::default()
    };
    let demands = Demands::default();
    let found = Placement::new(scene, &[radius, angle], &demands, &options, &|_, _, _| ())?;
    Ok(PlaceReport::new(&demands, &found))
}
