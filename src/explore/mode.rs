//! One mode of a chart, for the page to set in motion on the blade.

use std::f64::consts::TAU;

use faer::c64;
use serde::{Deserialize, Serialize};

use super::reply::{Charts, Refusal};
use crate::plate::Plate;
use crate::scene::rpm;
use crate::spectrum::{DescribedMode, Direction};
use crate::stability::Analysis;

/// Which mode.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Asked {
    /// Name of the chart.
    chart: usize,
    /// Speed of a point of a branch.
    rpm: f64,
    /// Frequency there, in space.
    frequency_hz: f64,
}

/// w(r, θ, t) = Re Σ_n (c_n(r) cos nθ + s_n(r) sin nθ) e^{iωt}.
#[derive(Serialize)]
pub struct ModeReply {
    /// In words, with the direction seen from space at this speed.
    name: String,
    direction: Direction,
    rpm: f64,
    /// In space.
    frequency_hz: f64,
    /// On the blade.
    body_frequency_hz: f64,
    growth_per_s: f64,
    krein_sign: i8,
    radius_m: Vec<f64>,
    harmonics: Vec<Harmonic>,
}

#[derive(Serialize)]
struct Harmonic {
    nodal_diameters: usize,
    share: f64,
    cosine: Complex,
    sine: Complex,
}

/// A list of complex numbers.
#[derive(Serialize)]
struct Complex {
    re: Vec<f64>,
    im: Vec<f64>,
}

/// Harmonics with a smaller share of the energy cannot be seen moving.
const LEAST_SHARE: f64 = 1e-3;

/// The mode that is asked for.
///
/// # Errors
/// [`Refusal`] of a request that cannot be read, or of a chart that is gone.
pub fn answer(charts: &Charts, asked: &str) -> Result<ModeReply, Refusal> {
    let asked: Asked = serde_json::from_str(asked).map_err(|error| Refusal::of(&error))?;
    let found = charts.named(asked.chart);
    let found = found
        .as_deref()
        .and_then(|analysis| Some((analysis, nearest(analysis, &asked)?)));
    let (analysis, (speed, mode)) = found.ok_or_else(|| Refusal {
        key: None,
        message: format!("chart {} is not kept any more", asked.chart),
    })?;
    Ok(reply(&analysis.model.plate, speed, mode))
}

/// The mode next to a frequency, of the speed next to one.
fn nearest<'a>(analysis: &'a Analysis, asked: &Asked) -> Option<(f64, &'a DescribedMode)> {
    let samples = analysis.chart.campbell.samples.iter();
    let off = |value: f64, wanted: f64| (value - wanted).abs();
    let sample = samples.min_by(|x, y| {
        let of = |speed| off(rpm(speed), asked.rpm);
        of(x.speed_rad_per_s).total_cmp(&of(y.speed_rad_per_s))
    })?;
    let of = |mode: &DescribedMode| off(mode.mode.frequency_rad_per_s() / TAU, asked.frequency_hz);
    let mode = sample.modes.iter().min_by(|x, y| of(x).total_cmp(&of(y)))?;
    Some((sample.speed_rad_per_s, mode))
}

fn reply(plate: &Plate, speed_rad_per_s: f64, described: &DescribedMode) -> ModeReply {
    let (mode, name) = (&described.mode, &described.name);
    let seen = name.harmonics.iter().filter(|h| h.share >= LEAST_SHARE);
    ModeReply {
        name: name.in_shares(),
        direction: name.direction,
        rpm: rpm(speed_rad_per_s),
        frequency_hz: mode.frequency_rad_per_s() / TAU,
        body_frequency_hz: name.body_frequency_rad_per_s / TAU,
        growth_per_s: mode.growth_per_s(),
        krein_sign: mode.krein_sign(),
        radius_m: plate.sampled_radii_m().collect(),
        harmonics: seen
            .map(|h| harmonic(plate, described, h.diameters, h.share))
            .collect(),
    }
}

fn harmonic(plate: &Plate, described: &DescribedMode, n: usize, share: f64) -> Harmonic {
    let (first, size) = (plate.offset(n), plate.basis.count());
    let profile = |offset: usize| {
        let at = |radial: &Vec<f64>| -> c64 {
            let terms = radial.iter().zip(offset..);
            let sum: c64 = terms.map(|(r, i)| described.shape[i] * *r).sum();
            sum / plate.angular_norm(n)
        };
        let values: Vec<c64> = plate.sampled_functions(n).iter().map(at).collect();
        Complex {
            re: values.iter().map(|c| c.re).collect(),
            im: values.iter().map(|c| c.im).collect(),
        }
    };
    let none = || Complex {
        re: vec![0.0; plate.sampled_functions(n).len()],
        im: vec![0.0; plate.sampled_functions(n).len()],
    };
    Harmonic {
        nodal_diameters: n,
        share,
        cosine: profile(first),
        sine: if n > 0 { profile(first + size) } else { none() },
    }
}
