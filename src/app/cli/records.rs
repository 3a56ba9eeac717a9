//! `sawflutter records`: frequencies from records of measured saws, through the Python package of this program.

use std::path::PathBuf;

use clap::Args;
use serde_json::{Value, json};

use super::common::{Folder, count, hertz, read_scene, rpm, say, seconds};
use super::python::Need;

pub const EXAMPLES: &str = "\
Examples:
  sawflutter records tap.wav frf.uff --rpm 0     # taps at rest
  sawflutter records run-up.csv --saw my-saw.json
  sawflutter records run-up.wav --rpm 0..1400 --saw my-saw.json
  sawflutter records probe.csv --tacho trigger --rate 2kHz
  sawflutter records up-and-down.csv --between 5..65

Files: WAV, CSV (also .txt, .tsv, .dat), LabVIEW .lvm and .tdms, MATLAB .mat,
.xlsx, universal files with data sets 58; records over time, or frequency
responses. Columns and units are found by their names; what is not understood is
refused.
peaks.csv has all frequencies that stand out, measured.csv the rows for
sawflutter fit: the frequencies of a tap at rest, and with --saw those that are
near a computed one. A figure for each file shows its spectra, with --saw under
the computed branches.
Records are read by the Python package: pip install \"sawflutter[records,plot]\";
those of .tdms and .xlsx need [instruments], too.";

const NEED: Need = Need {
    of: "records",
    beside: "SciPy and matplotlib",
    modules: "scipy, matplotlib",
    extras: "records,plot",
    runs: "sawflutter._records_command",
};

#[derive(Args)]
pub struct Arguments {
    /// Records of a probe or microphone, or frequency responses
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    /// Scene of the saw, whose computed frequencies are assigned to the peaks
    #[arg(long, value_name = "SCENE")]
    saw: Option<PathBuf>,
    /// Constant speed, 0 for a tap at rest; or first and last speed of an even run-up
    #[arg(long, value_name = "RPM[..RPM]", value_parser = speeds)]
    rpm: Option<Value>,
    /// Column of the speed, if its name and unit do not say so
    #[arg(long, value_name = "NAME")]
    speed: Option<String>,
    /// Column of the pulses of a tachometer
    #[arg(long, value_name = "NAME")]
    tacho: Option<String>,
    /// Pulses in one rotation; of a wheel with missing teeth with or without these
    #[arg(long, value_name = "COUNT", default_value_t = 1, value_parser = count::<usize>)]
    pulses_per_turn: usize,
    /// Column of the probe or microphone [default: the first that is none of the others]
    #[arg(long, value_name = "NAME")]
    signal: Option<String>,
    /// Part of a record over time: its run-up, or the time after one of several taps
    #[arg(long, value_name = "S..S", value_parser = times)]
    between: Option<Value>,
    /// Samples per second of a table without a column of time
    #[arg(long, value_name = "HZ", allow_hyphen_values = true, value_parser = hertz)]
    rate: Option<f64>,
    /// Highest frequency of records over time [default: 500, at most 40 % of the sample rate]
    #[arg(long, value_name = "HZ", allow_hyphen_values = true, value_parser = hertz)]
    to_frequency: Option<f64>,
    #[command(flatten)]
    folder: Folder,
}

/// Parses one speed, or two like `0..1400`.
fn speeds(text: &str) -> Result<Value, String> {
    Ok(match text.split_once("..") {
        Some((from, to)) => json!([rpm(from)?, rpm(to)?]),
        None => json!(rpm(text)?),
    })
}

/// Parses two times like `5..65`.
fn times(text: &str) -> Result<Value, String> {
    let (from, to) = text.split_once("..").ok_or("give two times, like 5..65")?;
    Ok(json!([seconds(from)?, seconds(to)?]))
}

/// Reads the records, writes the files and prints the text.
pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let saw = arguments.saw.as_deref().map(read_scene).transpose()?;
    let folder = arguments.folder.open()?;
    let input = json!({
        "files": arguments.files,
        "saw": saw.as_ref().map(|saw| saw.file()),
        "saw_file": arguments.saw,
        "rpm": arguments.rpm,
        "speed": arguments.speed,
        "tacho": arguments.tacho,
        "pulses_per_turn": arguments.pulses_per_turn,
        "signal": arguments.signal,
        "between": arguments.between,
        "rate_hz": arguments.rate,
        "to_hz": arguments.to_frequency,
        "out": folder.path(),
    });
    Ok(say(&NEED.answer(&[], &input.to_string())?)?)
}
