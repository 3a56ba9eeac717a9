//! From a scene to its stability chart: the library's main call.

use super::bands::{InstabilityKind, StabilityChart, chart};
use super::loci::RootLoci;
use crate::campbell::Progress;
use crate::plate::{Plate, Resolution};
use crate::scene::{Scene, rad_per_s, rpm};
use crate::spectrum::{SpectralModel, SpectrumError, Strategy};

/// A saw is run at no more than this share of its lowest critical speed: the
/// usual rule of thumb of saw makers.
pub const OPERATING_LIMIT: f64 = 0.85;
/// Speeds of a chart, before those that its events add.
const CHART_SPEEDS: usize = 51;
/// Critical speeds that the error estimate looks at.
const ESTIMATED_SPEEDS: usize = 6;

/// Everything about the stability of one saw.
#[derive(Debug)]
pub struct Analysis {
    /// Modes at any speed of the range.
    pub model: SpectralModel,
    /// Range of speeds, in rad/s.
    pub range: (f64, f64),
    /// Branches, bands and certificate.
    pub chart: StabilityChart,
    /// Flutter speed: onset of the first flutter band whose peak growth reaches the
    /// scene's threshold, in rad/s.
    pub flutter_speed: Option<f64>,
    /// Onset of the first flutter band of all, in rad/s.
    pub first_merge: Option<f64>,
    /// The eigenvalues of the band at the flutter speed, or of the first of all.
    pub root_loci: Option<RootLoci>,
    /// Largest relative difference of the lowest critical speeds to those of a
    /// coarser basis: three quarters of the diameters, two radial functions less.
    pub estimated_relative_error: Option<f64>,
}

impl Analysis {
    /// Analyses a saw over the speeds of its scene.
    ///
    /// # Errors
    /// [`SpectrumError`] when an eigenproblem fails.
    pub fn new(scene: &Scene, progress: Progress<'_>) -> Result<Self, SpectrumError> {
        let resolution = Resolution::of(scene.accuracy);
        let coarse = critical_rad_per_s(scene, coarser(resolution))?;
        let range = match scene.sweep {
            Some(sweep) => (sweep.from_rad_per_s, sweep.to_rad_per_s),
            None => (0.0, default_top(&coarse)),
        };
        let plate = Plate::new(scene, resolution);
        refuse_unresolved(&plate, range.1)?;
        let model = SpectralModel::new(plate, range, Strategy::Reduced)?;
        let chart = chart(&model, range, CHART_SPEEDS, progress)?;
        let mut flutter = chart
            .instabilities
            .iter()
            .filter(|b| b.kind == InstabilityKind::Flutter);
        let first = flutter.clone().next();
        let strong = flutter.find(|b| b.peak_growth_per_s >= scene.flutter_threshold_per_s);
        let (flutter_speed, first_merge) = (strong.map(|b| b.from), first.map(|b| b.from));
        let followed = strong.or(first).filter(|_| model.is_conservative());
        let root_loci = match followed {
            Some(band) => RootLoci::new(&model, band, range)?,
            None => None,
        };
        let fine = model.critical.iter().map(|c| c.speed_rad_per_s);
        let differences = fine
            .zip(&coarse)
            .take(ESTIMATED_SPEEDS)
            .map(|(x, y)| (y / x - 1.0).abs());
        Ok(Analysis {
            estimated_relative_error: differences.reduce(f64::max),
            model,
            range,
            chart,
            flutter_speed,
            first_merge,
            root_loci,
        })
    }

    /// Index of the band that a speed lies in.
    pub fn band_at(&self, speed_rad_per_s: f64) -> Option<usize> {
        let bands = &self.chart.instabilities;
        bands
            .iter()
            .position(|b| (b.from..=b.to).contains(&speed_rad_per_s))
    }
}

/// Past the critical speed of the waves of most diameters those of more, which the basis
/// lacks, would be reflected too: the chart would be wrong without a sign of it.
fn refuse_unresolved(plate: &Plate, to_rad_per_s: f64) -> Result<(), SpectrumError> {
    let critical = SpectralModel::critical_speeds(plate)?;
    let last = plate.max_diameters();
    // Stiff guides mix the waves beyond recognition; but there are two of each n ≥ 2.
    let all_pairs = critical.get(2 * (last - 1));
    let most_diameters = critical.iter().find(|c| c.diameters == last);
    let highest = [all_pairs, most_diameters].into_iter().flatten();
    let highest = highest.min_by(|x, y| x.speed_rad_per_s.total_cmp(&y.speed_rad_per_s));
    match highest {
        Some(c) if c.speed_rad_per_s < to_rad_per_s => Err(SpectrumError::Unresolved {
            to_rpm: rpm(to_rad_per_s),
            limit_rpm: rpm(c.speed_rad_per_s),
            diameters: plate.max_diameters(),
        }),
        _ => Ok(()),
    }
}

fn coarser(resolution: Resolution) -> Resolution {
    Resolution {
        max_diameters: resolution.max_diameters * 3 / 4,
        radial_functions: resolution.radial_functions - 2,
    }
}

fn critical_rad_per_s(scene: &Scene, resolution: Resolution) -> Result<Vec<f64>, SpectrumError> {
    let critical = SpectralModel::critical_speeds(&Plate::new(scene, resolution))?;
    Ok(critical.iter().map(|c| c.speed_rad_per_s).collect())
}

/// Twice the lowest critical speed, rounded up to two digits.
fn default_top(critical: &[f64]) -> f64 {
    let lowest = critical.first().map_or(1000.0, |speed| rpm(*speed));
    let digit = 10_f64.powf((2.0 * lowest).log10().floor() - 1.0);
    rad_per_s((2.0 * lowest / digit).ceil() * digit)
}
