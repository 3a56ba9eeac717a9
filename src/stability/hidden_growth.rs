//! How fast a motion could grow in a band that a stretch without proof may hide.

use super::chart::StabilityChart;
use crate::campbell::{Campbell, SpeedSample};
use crate::spectrum::DescribedMode;

impl StabilityChart {
    /// Estimate of the largest growth rate, in 1/s, that a band which is not listed could have in
    /// the stretches that are not proven to be free of one; `None` where no proof was tried, 0 where
    /// all is proven.
    ///
    /// Two waves of opposite Krein sign whose frequencies approach by s for each unit of speed, and
    /// that are coupled by κ, have λ − iω = ±√(κ² − (sΔΩ/2)²): a band of width w = 4κ/s, in which the
    /// growth reaches κ = sw/4. Waves of n and m nodal diameters approach by n + m at most, but for
    /// what the tension by rotation adds. At the speeds that are drawn the modes are known, so a band
    /// would lie between two of them. Not proven: the two waves are taken for the only ones.
    pub fn unproven_growth_per_s(&self) -> Option<f64> {
        let stretches = self.certificate.unproven_rad_per_s.as_ref()?;
        let drawn: Vec<f64> = self
            .campbell
            .samples
            .iter()
            .map(|s| s.speed_rad_per_s)
            .collect();
        let growth = stretches.iter().flat_map(|&(from, to)| {
            let within = drawn.iter().copied().filter(move |s| from < *s && *s < to);
            let ends: Vec<f64> = [from].into_iter().chain(within).chain([to]).collect();
            let parts: Vec<f64> = ends
                .windows(2)
                .map(|ends| 0.25 * approach(&self.campbell, ends[0], ends[1]) * (ends[1] - ends[0]))
                .collect();
            parts
        });
        Some(growth.fold(0.0, f64::max))
    }
}

/// Waves that are to meet within a stretch have frequencies closer than this about it.
const MEETING: f64 = 2.0;

/// n + m of the waves of opposite signs with most nodal diameters that may meet in a stretch.
fn approach(campbell: &Campbell, from: f64, to: f64) -> f64 {
    let samples = &campbell.samples;
    let speed = |sample: &SpeedSample| sample.speed_rad_per_s;
    let below = samples.partition_point(|s| speed(s) <= from);
    let first = below.saturating_sub(1);
    let last = samples.partition_point(|s| speed(s) < to).max(first);
    let about = samples.iter().take(last + 1).skip(first);
    let modes: Vec<&DescribedMode> = about.flat_map(|sample| &sample.modes).collect();
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
    let pair = largest(-1, f64::INFINITY).zip(largest(1, MEETING * highest));
    pair.map_or(0.0, |(n, m)| (n + m) as f64)
}

#[cfg(test)]
mod tests {
    use crate::scene::{Scene, rad_per_s};
    use crate::stability::{Analysis, InstabilityKind};

    /// The bands that were found keep to what is said of those that were not.
    #[test]
    #[cfg_attr(debug_assertions, ignore = "a chart: run it in release")]
    fn listed_bands_grow_no_faster_than_the_estimate_for_their_width() {
        let analysis = Analysis::new(&Scene::paper()).unwrap();
        let chart = &analysis.chart;
        let mut looked_at = 0;
        for band in &chart.instabilities {
            if band.kind != InstabilityKind::Flutter || !band.closed {
                continue;
            }
            let (from, to) = (band.from_rad_per_s, band.to_rad_per_s);
            let largest = 0.25 * super::approach(&chart.campbell, from, to) * (to - from);
            assert!(band.peak_growth_per_s <= largest, "{band}: {largest}");
            looked_at += 1;
        }
        assert!(looked_at >= 7);
        let hidden = chart.unproven_growth_per_s().unwrap();
        assert!(hidden > 0.0 && hidden < 4.0 * rad_per_s(1.0), "{hidden}");
    }
}
