//! Remakes `figures/`: `cargo run --release --example gallery`.

use std::path::Path;

use anyhow::Context;
use sawflutter::figure;
use sawflutter::report::{CutReport, Report, RunUpReport};
use sawflutter::scene::Scene;
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
