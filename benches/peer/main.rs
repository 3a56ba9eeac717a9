//! Run times of charts, sketches, sweeps and saws of this crate as JSON, for `benches/peer/run.sh`.
//!
//! Each time, in s, is the minimum over repeats (`REPEATS`, 5 by default), because other work on the machine can only
//! lengthen it. `PLACE=1` adds a whole placement of the built-in saw, which takes a minute.

use std::collections::BTreeMap;
use std::time::Instant;

use sawflutter::analyses::place::{Demands, Options, place};
use sawflutter::analyses::study::{Study, StudyFile};
use sawflutter::model::evenly_spaced;
use sawflutter::model::plate::{Plate, Resolution};
use sawflutter::model::scene::{Accuracy, Freed, Scene, SceneFile, SpeedRange, SweepFile};
use sawflutter::modes::{Assembled, SpectralModel, Strategy};
use sawflutter::stability::{
    Analysis, AnalysisOptions, ChosenBasis, Detail, Onsets, chart, search_bands, undamped_bands,
};
use serde_json::json;

type Failure = Box<dyn std::error::Error + Send + Sync>;

/// Relative error allowed in the study of the saw of the paper.
const STUDY_TOLERANCE: f64 = 6e-3;
/// Relative error that the live page allows while a number is dragged.
const SKETCH_TOLERANCE: f64 = 2e-2;
/// Number of saws of the study that are timed.
const STUDY_SAWS: usize = 20;
/// Number of evenly spaced speeds with which the search for bands begins.
const EVEN_SPEEDS: usize = 25;
/// Smallest number of speeds of a chart.
const CHART_SPEEDS: usize = 51;
/// Number of speeds of the sweep that is compared with SciPy.
const SWEEP: usize = 201;
/// Number of frequencies of each speed that are compared with SciPy.
const LOW_MODES: usize = 6;
/// Scenes whose times have a budget, in the folder `scenes`.
const SCENES: [&str; 8] = [
    "free-blade",
    "collar-400mm",
    "paper",
    "two-pads",
    "gallery/six-pads",
    "gallery/damped-pad",
    "gallery/damped-material",
    "gallery/in-cut-wood",
];
/// Largest numbers of nodal diameters and numbers of radial functions of bases with 85 to 4230 functions.
const SIZES: [(usize, usize); 6] = [(8, 5), (16, 8), (24, 10), (38, 13), (56, 25), (70, 30)];

fn main() {
    let repeats = std::env::var("REPEATS").map_or(5, |text| text.parse().unwrap_or(5));
    match measured(repeats) {
        Ok(report) => println!("{report}"),
        Err(error) => {
            eprintln!("error: {error}");
            std::process::exit(2);
        }
    }
}

fn measured(repeats: usize) -> Result<serde_json::Value, Failure> {
    let few = repeats.min(3);
    let full = analysed(|_| (), Detail::Full)?;
    let swept = || sweep().map(|_| ());
    let mut by_size = Vec::new();
    for (max_diameters, radial_functions) in SIZES {
        let resolution = Resolution {
            max_diameters,
            radial_functions,
        };
        let seconds = on_threads(1, || fastest(few, || charted(resolution)))?;
        by_size.push(json!({ "functions": resolution.degrees_of_freedom(), "seconds": seconds }));
    }
    let alone = |repeats: usize, work: &(dyn Fn() -> Result<(), Failure> + Sync)| {
        on_threads(1, || fastest(repeats, work))
    };
    let sketch = analysed(|saw| saw.tolerance = Some(SKETCH_TOLERANCE), Detail::Sketch)?;
    let reference = analysed(|saw| saw.accuracy = Accuracy::Reference, Detail::Full)?;
    let finest = analysed(|saw| saw.tolerance = Some(1e-6), Detail::Full)?;
    let fast = to_6000_rpm()?;
    let to_6000 = || Ok(Analysis::new(&fast).map(|_| ())?);
    let study = study_of_the_paper()?;
    let saws = || {
        (0..STUDY_SAWS).for_each(|index| drop(study.saw(index)));
        Ok(())
    };
    let whole_place = match std::env::var_os("PLACE") {
        Some(_) => Some(on_threads(1, || fastest(1, placed))?),
        None => None,
    };
    Ok(json!({
        "repeats": repeats,
        "chart_s": {
            "one_thread": alone(repeats, &full)?,
            "two_threads": on_threads(2, || fastest(repeats, &full))?,
        },
        "sketch_s": alone(repeats, &sketch)?,
        "reference_s": alone(few, &reference)?,
        "finest_s": alone(1, &finest)?,
        "to_6000_rpm_s": alone(1, &to_6000)?,
        "study_saw_s": alone(repeats, &saws)? / STUDY_SAWS as f64,
        "place_saw_s": alone(repeats, &bands_of_a_place)?,
        "place_s": whole_place,
        "sweep_201_at_264_s": {
            "one_thread": alone(repeats, &swept)?,
            "two_threads": on_threads(2, || fastest(repeats, swept))?,
        },
        "chart_by_functions": by_size,
        "stages_s": on_threads(1, || -> Result<_, Failure> {
            Ok(json!({
                "chart at 1e-3": stages(few, &Scene::paper())?,
                "chart at 1e-4": stages(few, &Scene::paper().edited(|saw| saw.accuracy = Accuracy::Reference)?)?,
                "sweep to 6000 rpm": stages(1, &to_6000_rpm()?)?,
            }))
        })?,
        "scenes_s": on_threads(1, || {
            SCENES.iter().map(|name| Ok((*name, of_scene(name)?))).collect::<Result<BTreeMap<_, _>, Failure>>()
        })?,
        "peak_memory_mb": peak_memory_mb(),
        "low_frequencies_rad_per_s": sweep()?,
    }))
}

/// A function that analyses the built-in saw with a change of its scene.
fn analysed(
    change: impl FnOnce(&mut SceneFile),
    detail: Detail,
) -> Result<impl Fn() -> Result<(), Failure> + Sync, Failure> {
    let scene = Scene::paper().edited(change)?;
    Ok(move || {
        let options = AnalysisOptions {
            detail,
            ..AnalysisOptions::default()
        };
        Ok(Analysis::with_options(&scene, options).map(|_| ())?)
    })
}

/// The built-in saw with a sweep to 6000 rpm, which contains 22 critical speeds and 96 bands.
fn to_6000_rpm() -> Result<Scene, Failure> {
    Ok(Scene::paper().edited(|saw| {
        saw.sweep = Some(SweepFile {
            from_rpm: 0.0,
            to_rpm: 6000.0,
        });
    })?)
}

/// The sample study. Its first saw is computed in advance, because the basis of all saws is chosen with it.
fn study_of_the_paper() -> Result<Study, Failure> {
    let paper = Scene::paper().edited(|saw| saw.tolerance = Some(STUDY_TOLERANCE))?;
    let file = include_str!("../../scenes/studies/paper-tolerances.json");
    let study = Study::new(paper, StudyFile::from_json(file)?)?;
    study.saw(0);
    Ok(study)
}

/// Time of each stage of an analysis in s. The time of a chart contains that of the search for bands; the difference is
/// the time of drawing and of the proof between the speeds.
fn stages(repeats: usize, scene: &Scene) -> Result<serde_json::Value, Failure> {
    let chosen = || ChosenBasis::new(scene, scene.tolerance());
    let choice = fastest(repeats, || Ok(chosen().map(|_| ())?))?;
    let reduced = || -> Result<_, Failure> {
        let found = chosen()?;
        let range = found.range_rad_per_s;
        let model =
            SpectralModel::with_critical(found.saw, found.critical, range, Strategy::Reduced)?;
        Ok((model, range))
    };
    let reduction = fastest(repeats, || reduced().map(|_| ()))? - choice;
    let (model, range) = reduced()?;
    let bands = fastest(repeats, || {
        Ok(undamped_bands(&model, range, EVEN_SPEEDS).map(|_| ())?)
    })?;
    let charted = fastest(repeats, || {
        Ok(chart(&model, range, CHART_SPEEDS, &|_, _| ()).map(|_| ())?)
    })?;
    let whole = fastest(repeats, || Ok(Analysis::new(scene).map(|_| ())?))?;
    Ok(json!({
        "choice of the basis": choice,
        "reduced model": reduction,
        "search for bands": bands,
        "drawing and proof": charted - bands,
        "estimates, names, root loci": whole - choice - reduction - charted,
    }))
}

/// Time of each stage of the analysis of a scene in s, and of its critical speeds and bands alone.
fn of_scene(name: &str) -> Result<serde_json::Value, Failure> {
    let path = format!("{}/scenes/{name}.json", env!("CARGO_MANIFEST_DIR"));
    let scene = Scene::from_path(path)?;
    let timed = |work: &dyn Fn() -> Result<(), Failure>| fastest(2, work);
    let choice = timed(&|| Ok(ChosenBasis::new(&scene, scene.tolerance()).map(|_| ())?))?;
    let bands = timed(&|| Ok(Onsets::new(&scene).map(|_| ())?))?;
    let whole = timed(&|| Ok(Analysis::new(&scene).map(|_| ())?))?;
    Ok(json!({
        "choice of the basis": choice,
        "critical speeds and bands": bands - choice,
        "rest of the chart": whole - bands,
    }))
}

/// Searches for bands as `sawflutter place` does for each saw of its first search, on the basis of that search.
fn bands_of_a_place() -> Result<(), Failure> {
    let resolution = Resolution {
        max_diameters: 8,
        radial_functions: 5,
    };
    let saw = Assembled::from(Plate::new(&Scene::paper(), resolution));
    let critical = saw.critical_speeds(Some(&|_| 1.05 * range().to_rad_per_s))?;
    search_bands(saw, critical, range())?;
    Ok(())
}

/// Places the guide of the built-in saw as `sawflutter place` does by default.
fn placed() -> Result<(), Failure> {
    let scene = Scene::paper();
    let paths = ["radius_m", "angle_deg", "stiffness_n_per_m"];
    let freed: Vec<Freed> = paths
        .map(|key| Freed::with_usual_bounds(&scene, &format!("guides[0].{key}")))
        .into_iter()
        .collect::<Result<_, _>>()?;
    let (demands, options) = (Demands::default(), Options::default());
    place(&scene, &freed, &demands, &options, &|_| ())?;
    Ok(())
}

/// Largest memory that this process has used, in MiB, if the system reports it.
fn peak_memory_mb() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    let kilobytes: f64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(kilobytes / 1024.0)
}

fn range() -> SpeedRange {
    SpeedRange::between_rpm(0.0, 3000.0)
}

fn charted(resolution: Resolution) -> Result<(), Failure> {
    let plate = Plate::new(&Scene::paper(), resolution);
    let saw = Assembled::from(plate);
    let critical = saw.critical_speeds(Some(&|_| 1.05 * range().to_rad_per_s))?;
    let model = SpectralModel::with_critical(saw, critical, range(), Strategy::Reduced)?;
    chart(&model, range(), CHART_SPEEDS, &|_, _| ())?;
    Ok(())
}

/// Lowest values of |Im λ|, in rad/s, at each speed of a sweep of the built-in saw, computed from its scene.
fn sweep() -> Result<Vec<Vec<f64>>, Failure> {
    use rayon::prelude::*;
    let resolution = Resolution {
        max_diameters: 16,
        radial_functions: 8,
    };
    let plate = Plate::new(&Scene::paper(), resolution);
    let model = SpectralModel::new(plate, range(), Strategy::Reduced)?;
    let lowest = |&speed: &f64| {
        let modes = model.modes(speed)?;
        let frequencies = modes.iter().map(|m| m.frequency_rad_per_s());
        Ok(frequencies.take(LOW_MODES).collect())
    };
    evenly_spaced(range().ends(), SWEEP)
        .par_iter()
        .map(lowest)
        .collect()
}

/// Shortest time of the work in s.
fn fastest(repeats: usize, work: impl Fn() -> Result<(), Failure>) -> Result<f64, Failure> {
    let mut least = f64::INFINITY;
    for _ in 0..repeats {
        let start = Instant::now();
        work()?;
        least = least.min(start.elapsed().as_secs_f64());
    }
    Ok(least)
}

/// Does the work on a number of threads.
fn on_threads<T: Send>(count: usize, work: impl FnOnce() -> T + Send) -> T {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(count).build();
    pool.expect("a thread pool").install(work)
}
