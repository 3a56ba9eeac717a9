//! `sawflutter margin`: how fast a measured saw may turn, through the Python package of this program.

use std::path::PathBuf;

use clap::Args;
use serde_json::json;

use crate::analyses::door::named_bounds;
use crate::model::scene::{Freed, NamedBounds, USUAL_MARGIN};

use super::common::{Folder, count, read_scene, say, share};
use super::python::Need;

pub const EXAMPLES: &str = "\
Examples:
  sawflutter margin my-saw.json sawflutter-out/peaks.csv
  sawflutter margin my-saw.json peaks.csv \\
    --free \"guides[0].radius_m=0.15..0.3\" \\
    --free \"membrane.roll_tension[0].eigenstrain=0..5e-4\"

peaks.csv: columns rpm and frequency_hz, as sawflutter records writes it. A peak
need not be that of a mode: it may be at a multiple of the speed, or of nothing.
The answer is the speed that the saw keeps with 95 % probability, from saws that
agree with the peaks; margin.csv has these saws, peak-modes.csv the most likely
mode of each peak.
Needs the Python package: pip install \"sawflutter[margin,plot]\".";

const NEED: Need = Need {
    of: "margin",
    beside: "emcee, SciPy and matplotlib",
    modules: "emcee, scipy, matplotlib",
    extras: "margin,plot",
    runs: "sawflutter._margin_command",
};

#[derive(Args)]
pub struct Arguments {
    /// Scene of the saw
    #[arg(value_name = "SCENE")]
    scene: PathBuf,
    /// Table of peaks
    #[arg(value_name = "PEAKS")]
    peaks: PathBuf,
    /// Number to fit, or several, by its path in the scene, with or without bounds; by default radius and stiffness of
    /// every guide, and the angles between several guides
    #[arg(long, value_name = "PATH[=FROM..TO]", value_parser = named_bounds)]
    free: Vec<NamedBounds>,
    /// Multiples of the rotation speed at which peaks may be
    #[arg(long, value_name = "ORDER", num_args = 1.., default_values_t = [1.0, 2.0], value_parser = share)]
    orders: Vec<f64>,
    /// Share of the deciding speed at which the saw may run
    #[arg(long, value_name = "SHARE", default_value_t = USUAL_MARGIN, value_parser = share)]
    margin: f64,
    /// Steps of the sampling, each with 48 saws
    #[arg(long, value_name = "COUNT", default_value_t = 200, value_parser = count::<usize>)]
    steps: usize,
    #[command(flatten)]
    folder: Folder,
}

/// Samples the saws, writes the files and prints the text.
pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let scene = read_scene(&arguments.scene)?;
    let freed = Freed::to_fit(&scene, &arguments.free)?;
    let free: Vec<_> = freed
        .iter()
        .map(|number| (number.parameter.path(), number.from, number.to))
        .collect();
    let folder = arguments.folder.open()?;
    let input = json!({
        "scene": scene.file(),
        "peaks": arguments.peaks,
        "free": free,
        "orders": arguments.orders,
        "margin": arguments.margin,
        "steps": arguments.steps,
        "out": folder.path(),
    });
    Ok(say(&NEED.answer(&[], &input.to_string())?)?)
}
