//! Charts of a saw whose blade oscillates at its guides with a given amplitude.

use std::f64::consts::PI;

use crate::analyses::campbell::InstabilityBand;
use crate::model::plate::{Plate, Resolution};
use crate::model::scene::{ContactLaw, Guide, GuideFile, GuideSide, Scene, rpm};
use crate::modes::Work;
use crate::motion::stretched_blade::{StretchedBlade, StretchedError};
use crate::stability::{Analysis, Instability, Onsets};

use super::critical_speed::first_critical_of_linear;
use super::error::GapError;
use super::report::AtAmplitude;

/// The part of the report over the amplitude at the guides.
pub(super) struct AmplitudeChart {
    pub smallest_gap_m: f64,
    pub free: AtAmplitude,
    pub amplitudes: Vec<AtAmplitude>,
    pub linear: AtAmplitude,
    pub half_way_m: Option<f64>,
}

/// Shares of the stiffness of the guide with the smallest gap at which the chart is computed: the critical speeds of
/// usual saws change most between a thousandth and a tenth.
const SHARES: [f64; 11] = [
    3e-4, 1e-3, 3e-3, 6e-3, 0.012, 0.025, 0.05, 0.1, 0.2, 0.45, 0.9,
];
/// Largest amplitude of the searches, relative to the smallest gap.
const FARTHEST: f64 = 1e3;
/// Number of times that the search for the amplitude half way halves its interval of logarithms.
const HALVINGS: usize = 24;
/// Relative difference below which two critical speeds are taken to be equal.
pub(super) const SAME: f64 = 1e-3;

/// Equivalent stiffness of a spring that acts beyond a gap on both sides, relative to its stiffness, for a sinusoidal
/// oscillation of the given amplitude over the gap (describing function):
/// 1 − (2/π)(asin(1/x) + √(1 − 1/x²)/x) for x > 1, otherwise 0. On one side only it is half as large.
///
/// Reference: A. Gelb & W. E. Vander Velde, *Multiple-Input Describing Functions and Nonlinear System Design*, 1968.
pub fn equivalent_share(amplitude_over_gap: f64) -> f64 {
    if amplitude_over_gap <= 1.0 {
        return 0.0;
    }
    share_beyond(1.0 / amplitude_over_gap)
}

/// As [`equivalent_share`], from the gap relative to the amplitude. It is negative for pads that press on the flat blade:
/// the share then exceeds one, and is two for contact on both sides that is never lost.
fn share_beyond(gap_over_amplitude: f64) -> f64 {
    let gap = gap_over_amplitude.clamp(-1.0, 1.0);
    1.0 - 2.0 / PI * (gap.asin() + gap * (1.0 - gap * gap).sqrt())
}

/// Mean stiffness of a one-sided guide over an oscillation, in N/m; at zero amplitude that of contact with the flat blade.
pub(super) fn equivalent_stiffness(guide: &GuideFile, amplitude_m: f64) -> f64 {
    let gap_m = guide.gap_m.unwrap_or_default();
    let share = |side: f64| 0.5 * share_beyond((gap_m + side * guide.offset_m) / amplitude_m);
    let [left, right] = [1.0, -1.0].map(|side| {
        if amplitude_m > 0.0 {
            share(side)
        } else {
            f64::from(gap_m + side * guide.offset_m < 0.0)
        }
    });
    let shares = match guide.side {
        GuideSide::Both => left + right,
        GuideSide::Left => left,
        GuideSide::Right => right,
    };
    let (stiffness, film) = (guide.stiffness_n_per_m, guide.film_stiffness_n_per_m);
    film + shares * (stiffness - film)
}

/// A saw whose blade oscillates at its guides about the position to which they push it on average.
pub(super) struct OscillatingSaw<'a> {
    scene: &'a Scene,
    /// The blade at rest, if an offset or a missing side pushes it.
    pushed: Option<StretchedBlade>,
}

/// Number of modes at rest of a blade that is pushed.
const MODES: usize = 24;

impl<'a> OscillatingSaw<'a> {
    /// The saw of a scene, on a basis.
    ///
    /// # Errors
    /// [`GapError::Stretched`].
    pub fn new(scene: &'a Scene, resolution: Resolution) -> Result<Self, GapError> {
        let pushed = scene.guides().iter().any(pushes).then(|| {
            let plate = Plate::new(scene, resolution);
            StretchedBlade::new(&plate, MODES.min(plate.degrees_of_freedom()))
        });
        let pushed = pushed.transpose()?;
        Ok(OscillatingSaw { scene, pushed })
    }

    /// Mean deflection of the blade at each one-sided guide over an oscillation: mean and first harmonic of the forces belong together.
    ///
    /// # Errors
    /// [`GapError::Stretched`].
    pub fn means_m(&self, amplitude_m: f64) -> Result<Vec<f64>, GapError> {
        let guides = self.scene.guides().iter();
        let flat = vec![0.0; guides.filter(|guide| guide.lifting.is_some()).count()];
        let Some(blade) = &self.pushed else {
            return Ok(flat);
        };
        let blade = blade.clone().over_oscillation(amplitude_m);
        match blade.settled(0.0, &blade.flat()) {
            Ok(found) => Ok(blade
                .gaps()
                .map_or(flat, |gaps| gaps.mean_deflections_m(&found.coordinates))),
            // A blade that reaches no guide stays where it is.
            Err(StretchedError::Loose) => Ok(flat),
            Err(other) => Err(other.into()),
        }
    }

    /// The scene with one-sided guides replaced by linear ones of their mean stiffness, and the ratio of each to the full stiffness.
    ///
    /// # Errors
    /// [`GapError`].
    pub fn at(&self, amplitude_m: f64) -> Result<(Scene, Vec<f64>), GapError> {
        let mut means_m = self.means_m(amplitude_m)?.into_iter();
        let mut shares = Vec::new();
        let linear = with_linear_guides(self.scene, |guide| {
            let guide = GuideFile {
                offset_m: guide.offset_m - means_m.next().unwrap_or_default(),
                ..guide.clone()
            };
            let mean = equivalent_stiffness(&guide, amplitude_m);
            shares.push(mean / guide.stiffness_n_per_m);
            mean
        })?;
        Ok((linear, shares))
    }
}

/// Whether the force of a guide has a mean over an oscillation about the flat blade.
pub(super) fn pushes(guide: &Guide) -> bool {
    let law = guide.lifting;
    law.is_some_and(|law| law.offset_m != 0.0 || law.side != GuideSide::Both)
}

/// The scene with one-sided guides replaced by linear ones of the given stiffness, in N/m.
///
/// # Errors
/// [`GapError::Scene`].
pub(super) fn with_linear_guides(
    scene: &Scene,
    mut stiffness_n_per_m: impl FnMut(&GuideFile) -> f64,
) -> Result<Scene, GapError> {
    Ok(scene.edited(|file| {
        let guides = file.guides.iter_mut();
        for guide in guides.filter(|guide| guide.contact == ContactLaw::OneSided) {
            *guide = GuideFile {
                stiffness_n_per_m: stiffness_n_per_m(guide),
                contact: ContactLaw::Linear,
                side: GuideSide::Both,
                film_stiffness_n_per_m: 0.0,
                offset_m: 0.0,
                ..guide.clone()
            };
        }
    })?)
}

/// The amplitude, relative to the gap, at which a guide has a share of its stiffness.
fn amplitude_over_gap(share: f64) -> f64 {
    let (mut low, mut high) = (1.0_f64, FARTHEST);
    for _ in 0..60 {
        let middle = (low * high).sqrt();
        if equivalent_share(middle) < share {
            low = middle
        } else {
            high = middle
        }
    }
    high
}

impl AmplitudeChart {
    /// Finds critical speeds and bands of the saw of a linear analysis at several amplitudes, on bases at least as large as its own.
    ///
    /// # Errors
    /// [`GapError`].
    pub(super) fn new(linear: &Analysis) -> Result<Self, GapError> {
        let swept = linear.scene.swept(linear.range_rad_per_s)?;
        let guides = swept.file().guides.iter();
        let gaps = guides.filter(|guide| guide.contact == ContactLaw::OneSided);
        let smallest_gap_m = gaps
            .filter_map(|guide| guide.gap_m)
            .fold(f64::INFINITY, f64::min);
        let oscillating = OscillatingSaw::new(&swept, linear.model.plate.resolution)?;
        let work = Work::of("amplitudes", SHARES.len() + 1);
        let at = |amplitude_m: Option<f64>| -> Result<AtAmplitude, GapError> {
            let (scene, stiffness_shares) = oscillating.at(amplitude_m.unwrap_or_default())?;
            let found = Onsets::beside(&scene, linear.model.plate.resolution)?;
            work.advance();
            Ok(AtAmplitude {
                amplitude_m,
                stiffness_shares,
                critical_rpm: within(linear, found.critical_rad_per_s),
                instabilities: bands(linear, &found.instabilities),
                flutter_rpm: found.flutter_speed_rad_per_s.map(rpm),
            })
        };
        let free = at(None)?;
        let amplitudes = SHARES
            .iter()
            .map(|share| at(Some(smallest_gap_m * amplitude_over_gap(*share))))
            .collect::<Result<Vec<_>, _>>()?;
        Ok(AmplitudeChart {
            smallest_gap_m,
            amplitudes,
            linear: AtAmplitude {
                amplitude_m: None,
                stiffness_shares: vec![1.0; free.stiffness_shares.len()],
                critical_rpm: within(linear, linear.critical_rad_per_s()),
                instabilities: bands(linear, &linear.chart.instabilities),
                flutter_rpm: linear.flutter_speed_rad_per_s.map(rpm),
            },
            half_way_m: half_way(linear, &oscillating, smallest_gap_m)?,
            free,
        })
    }
}

/// The speeds within the sweep of an analysis, in rpm.
fn within(analysis: &Analysis, speeds_rad_per_s: Vec<f64>) -> Vec<f64> {
    let speeds = speeds_rad_per_s.into_iter();
    let within = speeds.filter(|speed| analysis.range_rad_per_s.contains(*speed));
    within.map(rpm).collect()
}

/// Bands with the threshold of an analysis.
fn bands(analysis: &Analysis, found: &[Instability]) -> Vec<InstabilityBand> {
    let threshold_per_s = analysis.scene.flutter_threshold_per_s();
    let bands = found.iter();
    bands
        .map(|band| InstabilityBand::new(band, threshold_per_s))
        .collect()
}

/// The amplitude at which the first critical speed is the mean of that of the free blade and that of the linear chart.
fn half_way(
    analysis: &Analysis,
    oscillating: &OscillatingSaw<'_>,
    smallest_gap_m: f64,
) -> Result<Option<f64>, GapError> {
    // All amplitudes use one basis, so that their critical speeds differ only by the stiffness of the guides.
    let resolution = analysis.model.plate.resolution;
    let at = |amplitude_m: f64| first_critical(oscillating, resolution, amplitude_m);
    let linear = analysis.model.critical.first();
    let [Some(free), Some(linear)] = [at(0.0)?, linear.map(|c| c.speed_rad_per_s)] else {
        return Ok(None);
    };
    if (free / linear - 1.0).abs() < SAME {
        return Ok(None);
    }
    let middle = 0.5 * (free + linear);
    let is_free = |speed: f64| (speed < middle) == (free < middle);
    if at(FARTHEST * smallest_gap_m)?.is_none_or(is_free) {
        return Ok(None);
    }
    let (mut low, mut high) = (0.0_f64, FARTHEST.ln());
    for _ in 0..HALVINGS {
        let between = 0.5 * (low + high);
        if at(smallest_gap_m * between.exp())?.is_some_and(is_free) {
            low = between
        } else {
            high = between
        }
    }
    Ok(Some(smallest_gap_m * high.exp()))
}

/// First critical speed, in rad/s, with the mean stiffness of the guides over an oscillation.
///
/// # Errors
/// [`GapError`].
pub(super) fn first_critical(
    saw: &OscillatingSaw<'_>,
    resolution: Resolution,
    amplitude_m: f64,
) -> Result<Option<f64>, GapError> {
    let (scene, _) = saw.at(amplitude_m)?;
    first_critical_of_linear(&scene, resolution)
}
