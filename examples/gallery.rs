//! Draws the files of `figures/` again: `cargo run --release --example gallery`.

use std::path::Path;

use anyhow::Context;
use sawflutter::analyses::check::{self, CheckReport, Limits};
use sawflutter::analyses::commands::CommandReport;
use sawflutter::analyses::compare::{NamedSaw, Saw, compare};
use sawflutter::analyses::cut::{self, CutReport};
use sawflutter::analyses::deflect::{Options, deflect};
use sawflutter::analyses::fit::{self, FitReport, Measurement};
use sawflutter::analyses::gap::{self, gap};
use sawflutter::analyses::map::{self, Range};
use sawflutter::analyses::place::{self, Demands, PlaceReport};
use sawflutter::analyses::response::{self, response};
use sawflutter::analyses::runup::runup;
use sawflutter::analyses::study::StudyReport;
use sawflutter::model::scene::{
    Accuracy, ContactLaw, Freed, LimitsFile, Scene, SceneError, SceneFile, SideForceFile, rad_per_s,
};
use sawflutter::stability::Analysis;

fn main() -> anyhow::Result<()> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut scenes: Vec<_> = std::fs::read_dir(root.join("scenes"))?
        .map(|entry| entry.map(|entry| entry.path()))
        .collect::<Result<_, _>>()?;
    scenes.retain(|path| path.is_file());
    scenes.sort();
    for path in scenes {
        let name = path.file_stem().context("a scene has a name")?;
        let folder = root.join("figures");
        let to = |suffix: &str| folder.join(format!("{}-{suffix}", name.to_string_lossy()));
        let scene = Scene::from_path(&path)?;
        for (suffix, content) in figures(&scene)? {
            std::fs::write(to(suffix), content)?;
        }
        println!("{}", name.display());
    }
    let figures = root.join("figures");
    for (name, content) in further(root)? {
        std::fs::write(figures.join(format!("paper-{name}")), content)?;
    }
    println!("paper, further commands");
    // A study of a thousand saws takes minutes. Its report is read; docs/tutorials/thousand-saws.md describes how it is
    // computed.
    let content = std::fs::read_to_string(figures.join("paper-study.json"))?;
    let report: StudyReport = serde_json::from_str(&content)?;
    for (name, png) in pngs(&report)? {
        std::fs::write(figures.join(format!("paper-{name}")), png)?;
    }
    println!("paper-study");
    Ok(())
}

/// End of the name of a file, and its content.
type Figure = (&'static str, Vec<u8>);

/// Draws the figures for which a scene has data.
fn figures(scene: &Scene) -> anyhow::Result<Vec<Figure>> {
    if scene.file().spline.is_some() {
        // The scene differs from another one by the spline alone, so that only the orbit is a new figure.
        let figures = pngs(&cut(scene)?)?.into_iter();
        let orbit = figures.filter(|(name, _)| *name == "spline-orbit.png");
        return Ok(orbit.map(|(_, png)| ("orbit.png", png)).collect());
    }
    let report = Analysis::new(scene)?.report();
    let mut figures = vec![("campbell.svg", report.campbell_svg()?.into_bytes())];
    figures.extend(pngs(&report)?);
    if scene.cut().is_some() {
        figures.extend(pngs(&cut(scene)?)?);
    }
    if scene.file().runup.is_some() {
        figures.extend(pngs(&runup(scene, &|_, _| ())?)?);
        figures.extend(stretched(scene)?);
    }
    if scene.operating_rad_per_s().is_some() && scene.file().guides.len() == 1 {
        figures.extend(pngs(&check(scene)?)?);
    }
    if scene.file().measured.is_some() {
        figures.extend(pngs(&fit(scene)?)?);
    }
    if scene.file().guides.len() > 1 {
        figures.extend(pngs(&place(scene)?)?);
    }
    Ok(figures)
}

/// Draws the figures of `sawflutter cut --stretching` and `runup --stretching` with accuracy `draft`, and of `deflect`.
fn stretched(scene: &Scene) -> anyhow::Result<Vec<Figure>> {
    let draft = scene.edited(|saw| {
        saw.accuracy = Accuracy::Draft;
        saw.cut.iter_mut().for_each(|cut| cut.stretching = true);
        saw.runup.iter_mut().for_each(|up| up.stretching = true);
    })?;
    let named = |name: &'static str| match name {
        "cut.png" => Some("cut-stretching.png"),
        "runup.png" => Some("runup-stretching.png"),
        "runup-map.png" | "deflect.png" => Some(name),
        _ => None,
    };
    let all = [
        pngs(&cut(&draft)?)?,
        pngs(&runup(&draft, &|_, _| ())?)?,
        pngs(&deflect(scene, &Options::default())?)?,
    ]
    .into_iter()
    .flatten();
    Ok(all
        .filter_map(|(name, png)| Some((named(name)?, png)))
        .collect())
}

/// Draws the figures of `sawflutter analyze --shapes --set sweep.to_rpm=2000`, `compare` with two pads, `response`, `gap`
/// and `map` of the saw of the paper, with accuracy `draft`. The figure of shapes has so many areas that its PNG is
/// smaller than its SVG.
fn further(root: &Path) -> anyhow::Result<Vec<Figure>> {
    let draft = |name: &str, change: &dyn Fn(&mut SceneFile)| {
        let scene = Scene::from_path(root.join(format!("scenes/{name}.json")))?;
        scene.edited(|saw| {
            saw.accuracy = Accuracy::Draft;
            change(saw);
        })
    };
    let short = draft("paper", &|saw| {
        saw.sweep.iter_mut().for_each(|sweep| sweep.to_rpm = 2000.0);
    })?;
    let analysis = Analysis::new(&short)?;
    let mut report = analysis.report();
    report.add_shapes(&analysis, &[])?;
    let mut figures = pngs(&report)?;
    figures.retain(|(name, _)| *name == "modes.png");

    let saws = ["paper", "two-pads"]
        .map(|name| {
            let saw = Saw::Scene(Box::new(draft(name, &|_| ())?));
            let name = name.to_owned();
            Ok::<_, SceneError>(NamedSaw { name, saw })
        })
        .into_iter()
        .collect::<Result<_, _>>()?;
    figures.extend(svgs(&compare(saws, &|_, _| ())?)?);

    let excited = draft("paper", &|saw| {
        saw.side_force = Some(SideForceFile::of(5.0));
        saw.response.get_or_insert_default().flatness_m = 5e-5;
    })?;
    let report = response(&excited, &response::Options::default())?;
    figures.extend(svgs(&report)?.into_iter().take(1));

    let gapped = draft("paper", &|saw| {
        saw.guides[0].contact = ContactLaw::OneSided;
        saw.guides[0].gap_m = Some(5e-5);
    })?;
    let gap_options = gap::Options {
        rpm: Some(1200.0),
        ..Default::default()
    };
    figures.extend(svgs(&gap(&gapped, &gap_options)?)?.into_iter().take(1));

    let thickness = Range {
        path: "blade.thickness_m".to_owned(),
        from: 2.4e-3,
        to: 3.2e-3,
    };
    let options = map::Options::over(thickness);
    let map = map::map(draft("paper", &|_| ())?, &options, &|_, _| ())?;
    figures.extend(svgs(&map)?);
    Ok(figures)
}

/// Computes the report of `sawflutter cut`.
fn cut(scene: &Scene) -> anyhow::Result<CutReport> {
    let runs = &scene.cut().context("it has a cut")?.runs;
    Ok(cut::cut(scene, runs, &|_, _| ())?)
}

fn pngs(report: &impl CommandReport) -> anyhow::Result<Vec<Figure>> {
    let figures = report.figures().into_iter();
    figures
        .map(|figure| Ok((figure.names()[0], figure.png()?)))
        .collect()
}

fn svgs(report: &impl CommandReport) -> anyhow::Result<Vec<Figure>> {
    let figures = report.figures().into_iter();
    figures
        .map(|figure| Ok((figure.names()[1], figure.svg()?.into_bytes())))
        .collect()
}

/// Computes the report of `sawflutter check --rpm 1250 --min-critical 1500 --min-flutter 2500`.
fn check(scene: &Scene) -> anyhow::Result<CheckReport> {
    let limits = Limits {
        limits: LimitsFile {
            min_critical_rpm: Some(1500.0),
            min_flutter_rpm: Some(2500.0),
            ..LimitsFile::default()
        },
        ..Limits::at(rad_per_s(1250.0))
    };
    Ok(check::check(scene, &limits)?)
}

/// Computes the report of `sawflutter fit --to 1250` with radius and stiffness of the guide free.
fn fit(scene: &Scene) -> anyhow::Result<FitReport> {
    let own = scene.file().measured.as_ref().context("it is measured")?;
    let measurement = Measurement::of_scene(own);
    let freed = ["radius_m", "stiffness_n_per_m"]
        .map(|name| Freed::with_usual_bounds(scene, &format!("guides[0].{name}")))
        .into_iter()
        .collect::<Result<Vec<_>, _>>()?;
    let options = fit::Options {
        to_rpm: 1250.0,
        ..Default::default()
    };
    Ok(fit::fit(scene, &measurement, &freed, &options, &|_, _| ())?)
}

/// Computes the report of `sawflutter place` with radius and angle of the first guide free.
fn place(scene: &Scene) -> anyhow::Result<PlaceReport> {
    let radius = Freed::new(scene.file(), "guides[0].radius_m", 0.2, 0.3)?;
    let angle = Freed::new(scene.file(), "guides[0].angle_deg", -120.0, 0.0)?;
    let options = place::Options {
        map: 21,
        ..Default::default()
    };
    let demands = Demands::default();
    Ok(place::place(
        scene,
        &[radius, angle],
        &demands,
        &options,
        &|_| (),
    )?)
}
