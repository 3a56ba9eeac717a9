//! A band of instability as an item of a chart.

use super::{InstabilityBand, InstabilityKind};
use crate::page::figure::axis::two_digits;
use crate::page::figure::items::Band;
use crate::page::figure::palette::Hue;

/// A band below the threshold that is wider than this share of the axis is not shaded: damping causes such bands,
/// and their shade would cover the diagram.
const WIDEST_WEAK: f64 = 0.03;

/// Whether any part of a band is shaded on an axis between two speeds in rpm.
pub fn is_shaded([first, last]: [f64; 2], band: &InstabilityBand) -> bool {
    let is_wide = band.to_rpm - band.from_rpm > WIDEST_WEAK * (last - first);
    !(is_wide && band.counted_rpm.is_empty())
}

impl Band {
    /// A band on an axis between two speeds in rpm. The parts where the growth exceeds the threshold are shaded; a
    /// band without such parts is shaded as a whole, unless it is wide, see [`is_shaded`].
    pub(crate) fn new(band: &InstabilityBand, speeds: [f64; 2]) -> Self {
        let whole = [band.from_rpm, band.to_rpm];
        let shaded = match band.counted_rpm.is_empty() {
            _ if !is_shaded(speeds, band) => Vec::new(),
            true => vec![whole],
            false => band.counted_rpm.clone(),
        };
        let [colour, shade, streak] = Hue::of_kind(band.kind);
        let label = label(band, speeds);
        Self {
            from: band.from_rpm,
            to: band.to_rpm,
            shaded,
            shade,
            streak,
            colour,
            name: match &band.name {
                Some(waves) => format!("{label} rpm: {waves}"),
                None => format!("{label} rpm"),
            },
            label,
            peak_growth_per_s: band.peak_growth_per_s,
        }
    }

    /// A band of which only speeds whose growth exceeds the threshold are shaded.
    pub(crate) fn grown(band: &InstabilityBand, speeds: [f64; 2]) -> Self {
        Self {
            shaded: band.counted_rpm.clone(),
            ..Self::new(band, speeds)
        }
    }
}

/// Kind and range of a band in rpm, and the amplitude of its flutter if the report contains it. Flutter below the
/// threshold is weak.
fn label(band: &InstabilityBand, [first, last]: [f64; 2]) -> String {
    let kind = match (band.kind, band.counted_rpm.is_empty()) {
        (InstabilityKind::Flutter, true) => "weak flutter".to_owned(),
        (kind, _) => kind.to_string(),
    };
    let [from, to] = [band.from_rpm, band.to_rpm].map(|rpm| format!("{rpm:.0}"));
    let label = if !band.closed && band.to_rpm >= last && band.from_rpm > first {
        format!("{kind} from {from}")
    } else if !band.closed && band.from_rpm <= first && band.to_rpm < last {
        format!("{kind} to {to}")
    } else if from == to {
        format!("{kind} {from}")
    } else {
        format!("{kind} {from}–{to}")
    };
    match band.saturated_amplitude_m {
        None if band.amplitude_not_computed.is_some() => format!("{label}, amplitude not computed"),
        None => label,
        Some(metres) => format!("{label}, ±{} mm", two_digits(1e3 * metres)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analyses::campbell::sample::band;

    #[test]
    fn flutter_below_the_threshold_is_called_weak() {
        let labelled = |kind, counted_rpm| {
            let band = InstabilityBand {
                counted_rpm,
                ..band(kind, 1903.0, 1906.0, 0.09, 2.4)
            };
            label(&band, [0.0, 3000.0])
        };
        let counted = vec![[1904.0, 1905.0]];
        for (kind, counted_rpm, wanted) in [
            (InstabilityKind::Flutter, vec![], "weak flutter 1903–1906"),
            (InstabilityKind::Flutter, counted, "flutter 1903–1906"),
            (InstabilityKind::Divergence, vec![], "divergence 1903–1906"),
        ] {
            assert_eq!(labelled(kind, counted_rpm), wanted);
        }
    }
}
