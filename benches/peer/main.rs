//! The Rust side of `benches/peer/run.sh`: times of charts and sweeps, as JSON.
//!
//! Minima over repeats: other work on the machine only ever adds.

use std::time::Instant;

use sawflutter::campbell::even_speeds;
use sawflutter::plate::{Plate, Resolution};
use sawflutter::scene::{Scene, rad_per_s};
use sawflutter::spectrum::{SpectralModel, Strategy};
use sawflutter::stability::{Analysis, AnalysisError, chart};
use serde_json::json;

const SWEEP: usize = 201;
const LOW_MODES: usize = 6;
/// (n_max, J) of 85, 264, 490 and 1001 functions.
const SIZES: [(usize, usize); 4] = [(8, 5), (16, 8), (24, 10), (38, 13)];

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

fn measured(repeats: usize) -> Result<serde_json::Value, AnalysisError> {
    let scene = Scene::paper();
    let full_chart = || Analysis::new(&scene).map(|_| ());
    let (swept, frequencies) = (|| sweep().map(|_| ()), sweep()?);
    let mut by_size = Vec::new();
    for (max_diameters, radial_functions) in SIZES {
        let resolution = Resolution {
            max_diameters,
            radial_functions,
        };
        let seconds = on_threads(1, || fastest(repeats.min(3), || charted(resolution)))?;
        by_size.push(json!({ "functions": resolution.degrees_of_freedom(), "seconds": seconds }));
    }
    Ok(json!({
        "repeats": repeats,
        "chart_s": {
            "one_thread": on_threads(1, || fastest(repeats, full_chart))?,
            "two_threads": on_threads(2, || fastest(repeats, full_chart))?,
        },
        "sweep_201_at_264_s": {
            "one_thread": on_threads(1, || fastest(repeats, swept))?,
            "two_threads": on_threads(2, || fastest(repeats, swept))?,
        },
        "chart_by_functions": by_size,
        "low_frequencies_rad_per_s": frequencies,
    }))
}

fn range() -> (f64, f64) {
    (0.0, rad_per_s(3000.0))
}

fn charted(resolution: Resolution) -> Result<(), AnalysisError> {
    let plate = Plate::new(&Scene::paper(), resolution);
    let model = SpectralModel::new(plate, range(), Strategy::Reduced)?;
    chart(&model, range(), 51, &|_, _| ()).map(|_| ())
}

/// The lowest |Im λ| at 201 speeds, from scene to numbers.
fn sweep() -> Result<Vec<Vec<f64>>, AnalysisError> {
    use rayon::prelude::*;
    let resolution = Resolution {
        max_diameters: 16,
        radial_functions: 8,
    };
    let plate = Plate::new(&Scene::paper(), resolution);
    let model = SpectralModel::new(plate, range(), Strategy::Reduced)?;
    let lowest = |&speed: &f64| {
        let modes = model.drawn_modes(speed)?;
        let frequencies = modes.iter().map(|m| m.frequency_rad_per_s());
        Ok(frequencies.take(LOW_MODES).collect())
    };
    even_speeds(range(), SWEEP).par_iter().map(lowest).collect()
}

fn fastest(
    repeats: usize,
    work: impl Fn() -> Result<(), AnalysisError>,
) -> Result<f64, AnalysisError> {
    let mut least = f64::INFINITY;
    for _ in 0..repeats {
        let start = Instant::now();
        work()?;
        least = least.min(start.elapsed().as_secs_f64());
    }
    Ok(least)
}

fn on_threads<T: Send>(count: usize, work: impl FnOnce() -> T + Send) -> T {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(count).build();
    pool.expect("a thread pool").install(work)
}
