//! Estimated growth rate of an unlisted band in an unproven interval.

use super::search_result::StabilityChart;
use crate::model::scene::SpeedRange;
use crate::modes::NamedMode;
use crate::modes::branches::{Campbell, SpeedSample};

impl StabilityChart {
    /// Estimate of the largest growth rate, in 1/s, that an unlisted band could have in the unproven
    /// intervals; `None` if no proof was tried, 0 if the whole range is proven.
    ///
    /// Two waves of opposite Krein sign whose frequencies approach by s per unit of speed and that are
    /// coupled by κ have λ − iω = ±√(κ² − (sΔΩ/2)²): a band of width w = 4κ/s with growth up to κ = sw/4.
    /// Waves of n and m nodal diameters approach by at most n + m, apart from the stiffening by rotation. The
    /// modes at computed speeds are known, so a hidden band would be between two of them. This is an
    /// estimate and no proof, because it considers only the two waves.
    pub fn unproven_growth_per_s(&self) -> Option<f64> {
        let growth = self.hidden()?.into_iter().map(|(_, growth)| growth);
        Some(growth.fold(0.0, f64::max))
    }

    /// Parts of the unproven intervals in which, by the estimate of
    /// [`StabilityChart::unproven_growth_per_s`], an unlisted band could grow at least as fast as the
    /// threshold; adjacent parts are merged.
    pub fn unproven_counting_rad_per_s(&self, threshold_per_s: f64) -> Vec<SpeedRange> {
        let mut joined: Vec<SpeedRange> = Vec::new();
        let hidden = self.hidden().unwrap_or_default().into_iter();
        for (part, _) in hidden.filter(|(_, growth)| *growth >= threshold_per_s) {
            match joined.last_mut() {
                Some(last) if last.to_rad_per_s >= part.from_rad_per_s => {
                    last.to_rad_per_s = part.to_rad_per_s;
                }
                _ => joined.push(part),
            }
        }
        joined
    }

    /// Parts of the unproven intervals between computed speeds, with the estimated growth rate for each, in 1/s.
    fn hidden(&self) -> Option<Vec<(SpeedRange, f64)>> {
        let stretches = self.certificate.unproven_rad_per_s.as_ref()?;
        let drawn: Vec<f64> = computed(&self.campbell)
            .into_iter()
            .map(|s| s.speed_rad_per_s)
            .collect();
        let parts = stretches
            .iter()
            .map(SpeedRange::ends)
            .flat_map(|[from, to]| {
                let within = drawn.iter().copied().filter(move |s| from < *s && *s < to);
                let ends: Vec<f64> = [from].into_iter().chain(within).chain([to]).collect();
                let parts = ends
                    .windows(2)
                    .map(|ends| SpeedRange::new(ends[0], ends[1]));
                parts.collect::<Vec<_>>()
            });
        let growth = |part: SpeedRange| 0.25 * approach(&self.campbell, part) * part.width();
        Some(parts.map(|part| (part, growth(part))).collect())
    }
}

fn computed(campbell: &Campbell) -> Vec<&SpeedSample> {
    let samples = campbell.samples.iter();
    samples.filter(|sample| sample.is_solved()).collect()
}

/// Largest frequency of a wave that can coalesce with a reflected wave in an interval, relative to the
/// frequency of the highest reflected wave near the interval.
const COALESCING: f64 = 2.0;

/// Sum n + m for the waves of opposite sign with most nodal diameters that may coalesce in an interval.
fn approach(campbell: &Campbell, range: SpeedRange) -> f64 {
    let [from, to] = range.ends();
    let samples = computed(campbell);
    let below = samples.partition_point(|s| s.speed_rad_per_s <= from);
    let first = below.saturating_sub(1);
    let last = samples
        .partition_point(|s| s.speed_rad_per_s < to)
        .max(first);
    let about = samples.into_iter().take(last + 1).skip(first);
    let modes: Vec<&NamedMode> = about.flat_map(|sample| &sample.modes).collect();
    let largest = |sign: i8, to_rad_per_s: f64| {
        let waves = modes.iter().filter(|m| {
            m.mode.krein_sign() == sign && m.mode.frequency_rad_per_s() <= to_rad_per_s
        });
        waves.map(|m| m.name.diameters).max()
    };
    let reflected = modes.iter().filter(|m| m.mode.krein_sign() < 0);
    let highest = reflected
        .map(|m| m.mode.frequency_rad_per_s())
        .fold(0.0, f64::max);
    let pair = largest(-1, f64::INFINITY).zip(largest(1, COALESCING * highest));
    pair.map_or(0.0, |(n, m)| (n + m) as f64)
}

#[cfg(test)]
mod tests {
    use crate::model::scene::{Scene, rad_per_s};
    use crate::stability::{Analysis, InstabilityKind};

    /// Reference: the growth and width of the listed bands, for which the same estimate holds.
    #[test]
    #[cfg_attr(debug_assertions, ignore = "a chart: run it in release")]
    fn listed_bands_grow_no_faster_than_the_estimate_for_their_width() {
        let analysis = Analysis::new(&Scene::paper()).unwrap();
        let chart = &analysis.chart;
        let mut compared = 0;
        for band in &chart.instabilities {
            if band.kind != InstabilityKind::Flutter || !band.closed {
                continue;
            }
            let range = band.range();
            let largest = 0.25 * super::approach(&chart.campbell, range) * range.width();
            assert!(band.peak_growth_per_s <= largest, "{band}: {largest}");
            compared += 1;
        }
        assert!(compared >= 7);
        let hidden = chart.unproven_growth_per_s().unwrap();
        assert!(hidden > 0.0 && hidden < 4.0 * rad_per_s(1.0), "{hidden}");
        // A band that counts is possible only if the estimate reaches the threshold, which needs a certain
        // width.
        assert!(chart.unproven_counting_rad_per_s(1.01 * hidden).is_empty());
        let unproven = chart.certificate.unproven_rad_per_s.iter().flatten();
        let counting = chart.unproven_counting_rad_per_s(0.5 * hidden);
        assert!(!counting.is_empty());
        for part in counting {
            let mut intervals = unproven.clone();
            assert!(intervals.any(|range| part.within(*range) == part));
        }
    }
}
