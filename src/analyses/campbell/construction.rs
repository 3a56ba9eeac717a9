//! Makes the report of an analysis.

use std::f64::consts::TAU;
use std::sync::atomic::{AtomicUsize, Ordering};

use faer::c64;

use super::analysis::{BasisAccuracy, Report, SolveCounts};
use super::branches::Numbered;
use super::certificate::BandCertificate;
use super::chart::{CampbellDiagram, RootLoci, RootPath};
use super::excitation::ExcitationLines;
use super::in_cut::InCut;
use super::membrane::BladeStress;
use super::modes::{HarmonicShape, HarmonicShare, RestMode};
use super::remarks::{terms, warnings};
use super::speeds::{CriticalSpeed, InstabilityBand, OperatingPoint};
use super::split_pairs::SplitPairs;
use crate::analyses::board_deviation::BoardDeviation;
use crate::analyses::check::{judged, side_force_factor};
use crate::model::plate::Plate;
use crate::model::scene::{SpeedRange, rad_per_s, rpm};
use crate::modes::{DescribedMode, EventName, EventWaves, WorkCounters};
use crate::motion::stretched_blade::{Rise, saturations};
use crate::stability::{Analysis, Evidence, Instability, InstabilityKind, ListedBand};

/// Harmonics with a smaller share of the kinetic energy are omitted from a mode at rest.
const LEAST_SHARE: f64 = 1e-4;
/// Two critical speeds with the same name and a smaller relative distance are a double one.
const DOUBLE: f64 = 1e-9;

impl Analysis {
    /// The results of the analysis, in the units and with the names of `report.json`.
    pub fn report(&self) -> Report {
        let (analysis, scene) = (self, &self.scene);
        let model = &analysis.model;
        let at_rest = analysis
            .modes_at_rest
            .iter()
            .map(|mode| mode.backward_error);
        let of_others = analysis.estimates.as_ref().map(|e| e.backward_error);
        let certificate = BandCertificate::new(
            &analysis.chart,
            model.is_conservative(),
            analysis.range_rad_per_s,
            scene.flutter_threshold_per_s(),
            at_rest.chain(of_others).fold(0.0, f64::max),
            self.listed_backward_error,
        );
        let branches = Numbered::new(analysis);
        let critical = critical_speeds(analysis, &branches);
        let at_rest = &analysis.modes_at_rest;
        let warnings = warnings(scene, analysis, &certificate, at_rest, critical.len());
        let resolution = model.plate.resolution;
        let operating = scene.operating_rad_per_s();
        let operating = operating.map(|speed| at_operating_speed(analysis, speed));
        let amplitudes = limited_amplitudes(analysis);
        Report {
            sawflutter: env!("CARGO_PKG_VERSION").to_owned(),
            scene: scene.file().clone(),
            condition: scene.condition(),
            unusual_numbers: scene.file().unusual_numbers(),
            terms: terms(scene, &model.plate),
            modes_at_rest: rest_modes(analysis, &branches),
            overdamped_modes_at_rest: analysis.overdamped_at_rest,
            critical_speeds: critical,
            critical_speeds_without_damping: model.has_turning_damping(),
            instabilities: instabilities(analysis, &branches, scene.flutter_threshold_per_s()),
            split_pairs: SplitPairs::of(analysis),
            first_critical_rpm: analysis.first_critical_rpm(),
            flutter_rpm: analysis.flutter_speed_rad_per_s.map(rpm),
            first_merge_rpm: analysis.first_merge_rad_per_s.map(rpm),
            flutter_threshold_per_s: scene.flutter_threshold_per_s(),
            verdict: judged(
                analysis,
                &scene.limits(),
                operating.as_ref().and_then(|at| at.deviation.as_ref()),
                scene.operating_rad_per_s(),
                &amplitudes,
            ),
            operating,
            in_cut: InCut::new(analysis),
            excitation: ExcitationLines::new(scene, &self.crossings, &branches),
            whirl: None,
            shapes: Vec::new(),
            accuracy: BasisAccuracy {
                name: scene.accuracy(),
                max_diameters: resolution.max_diameters,
                complete_to_rpm: rpm(analysis.complete_to_rad_per_s),
                radial_functions: model.plate.radial_functions(),
                degrees_of_freedom: model.plate.degrees_of_freedom(),
                tolerance: scene.tolerance(),
                reached: analysis.reaches_tolerance(),
                estimated_relative_error: analysis.estimated_relative_error,
                estimated_resting_error: analysis.estimates.as_ref().map(|e| e.at_rest),
                estimated_drawn_error: analysis.estimates.as_ref().map(|e| e.drawn),
            },
            work: work(&model.counters),
            warnings,
            certificate,
            campbell: CampbellDiagram {
                from_rpm: rpm(analysis.range_rad_per_s.from_rad_per_s),
                to_rpm: rpm(analysis.range_rad_per_s.to_rad_per_s),
                complete_to_hz: model.complete_to_rad_per_s / TAU,
                branches: branches.entries(),
            },
            root_loci: root_loci(analysis, &branches),
            membrane: BladeStress::new(scene, analysis),
            sensitivities: Vec::new(),
        }
    }
}

fn root_loci(analysis: &Analysis, branches: &Numbered<'_>) -> Option<RootLoci> {
    let loci = analysis.root_loci.as_ref()?;
    let band = &analysis.chart.instabilities[loci.band];
    // The names are reversed, because an event lists reflected waves first, while the path of the reflected
    // mode is the second one.
    let waves = branches
        .event(band)
        .into_iter()
        .flat_map(|event| event.waves);
    let mut names: Vec<String> = waves.map(|waves| waves.in_words()).collect();
    names.reverse();
    let padded = names.into_iter().chain(std::iter::repeat(String::new()));
    let paths = padded.zip(&loci.paths).map(|(name, path)| RootPath {
        name,
        growth_per_s: path.iter().map(|(lambda, _)| lambda.re).collect(),
        frequency_hz: path.iter().map(|(lambda, _)| lambda.im / TAU).collect(),
        krein_sign: path.iter().map(|(_, sign)| *sign).collect(),
    });
    Some(RootLoci {
        onset_rpm: rpm(band.from_rad_per_s),
        end_rpm: rpm(band.to_rad_per_s),
        rpm: loci.speeds.iter().map(|s| rpm(*s)).collect(),
        paths: paths.collect(),
    })
}

/// The modes at rest, with branch and estimated error.
fn rest_modes(analysis: &Analysis, branches: &Numbered<'_>) -> Vec<RestMode> {
    let (at_rest, plate) = (&analysis.modes_at_rest, &analysis.model.plate);
    let errors = match &analysis.estimates {
        Some(estimates) => estimates.frequencies(&analysis.model, 0.0, at_rest),
        None => vec![None; at_rest.len()],
    };
    let modes = at_rest.iter().zip(errors).enumerate();
    modes
        .map(|(i, (described, truncation))| {
            let DescribedMode { mode, name, .. } = described;
            let branch = branches.of_mode_at_rest(i);
            let of_branch = branch.map(|number| branches.name(number));
            let rounding = analysis.model.relative_rounding(mode);
            let harmonics = name.harmonics.iter().filter(|h| h.share >= LEAST_SHARE);
            RestMode {
                frequency_hz: mode.frequency_rad_per_s() / TAU,
                nodal_diameters: name.diameters,
                nodal_circles: name.circles,
                name: of_branch.unwrap_or_else(|| name.in_shares()),
                branch,
                damping_ratio: mode.damping_ratio(),
                logarithmic_decrement: mode.logarithmic_decrement(),
                estimated_relative_error: truncation.map(|error| error + rounding),
                backward_error: described.backward_error,
                harmonics: harmonics
                    .map(|h| HarmonicShare {
                        nodal_diameters: h.diameters,
                        share: h.share,
                    })
                    .collect(),
                shape: shape(plate, described),
            }
        })
        .collect()
}

/// The bands, with branches and estimated errors.
fn instabilities(
    analysis: &Analysis,
    branches: &Numbered<'_>,
    threshold_per_s: f64,
) -> Vec<InstabilityBand> {
    let bands = analysis.chart.instabilities.iter().enumerate();
    let estimates = analysis.estimates.as_ref();
    bands
        .map(|(k, band)| {
            let own = estimates.and_then(|estimates| estimates.bands.get(k));
            let error = own.copied().unwrap_or_default();
            InstabilityBand {
                estimated_relative_error: error.speed,
                estimated_relative_growth_error: error.growth,
                ..InstabilityBand::in_chart(band, branches, threshold_per_s)
            }
        })
        .collect()
}

/// The harmonics of a mode at the moment of its largest deflection, scaled to a largest value of one.
fn shape(plate: &Plate, described: &DescribedMode) -> Vec<HarmonicShape> {
    let q = &described.shape;
    let turn: c64 = q.iter().map(|c| c * c).sum::<c64>().sqrt();
    let phase = if turn.norm() > 0.0 {
        turn.conj() / turn.norm()
    } else {
        c64::new(1.0, 0.0)
    };
    let size = plate.basis.count();
    let radius_m: Vec<f64> = plate.sampled_radii_m().step_by(4).collect();
    let profile = |n: usize, offset: usize| -> Vec<f64> {
        let values = plate.sampled_functions(n).iter().step_by(4);
        values
            .map(|radial| {
                let terms = radial.iter().zip(offset..offset + size);
                terms.map(|(r, i)| r * (q[i] * phase).re).sum::<f64>() / plate.angular_norm(n)
            })
            .collect()
    };
    let mut shape: Vec<HarmonicShape> = described
        .name
        .harmonics
        .iter()
        .filter(|h| h.share >= LEAST_SHARE)
        .map(|h| {
            let n = h.diameters;
            let offset = plate.offset(n);
            let sine = if n > 0 {
                profile(n, offset + size)
            } else {
                vec![0.0; radius_m.len()]
            };
            HarmonicShape {
                nodal_diameters: n,
                radius_m: radius_m.clone(),
                cosine: profile(n, offset),
                sine,
            }
        })
        .collect();
    let all = shape.iter().flat_map(|s| s.cosine.iter().chain(&s.sine));
    let largest = all.fold(f64::MIN_POSITIVE, |top, w| top.max(w.abs()));
    for entry in &mut shape {
        let values = entry.cosine.iter_mut().chain(&mut entry.sine);
        values.for_each(|w| *w /= largest);
    }
    shape
}

/// Critical speeds up to the end of the sweep; a double one of a free blade is listed once.
fn critical_speeds(analysis: &Analysis, branches: &Numbered<'_>) -> Vec<CriticalSpeed> {
    let estimates = analysis.estimates.as_ref();
    let mut entries: Vec<CriticalSpeed> = Vec::new();
    for (index, critical) in analysis.model.critical.iter().enumerate() {
        if critical.speed_rad_per_s > analysis.range_rad_per_s.to_rad_per_s {
            break;
        }
        let speed = rpm(critical.speed_rad_per_s);
        let (diameters, circles) = (critical.name.diameters(), critical.name.circles());
        let double = |e: &CriticalSpeed| {
            analysis.model.plate.is_axisymmetric()
                && (e.nodal_diameters, e.nodal_circles) == (diameters, circles)
                && (speed / e.rpm - 1.0).abs() < DOUBLE
        };
        if !entries.iter().any(double) {
            entries.push(CriticalSpeed {
                rpm: speed,
                branch: branches.of_critical(critical),
                name: critical.name.in_words(),
                nodal_diameters: diameters,
                nodal_circles: circles,
                estimated_relative_error: estimates.and_then(|e| e.critical.get(index).copied()),
            });
        }
    }
    entries
}

impl InstabilityBand {
    /// A band between two speeds in rpm, without growth, waves and errors.
    pub(crate) fn between(kind: InstabilityKind, [from_rpm, to_rpm]: [f64; 2]) -> Self {
        InstabilityBand {
            kind,
            from_rpm,
            to_rpm,
            closed: true,
            peak_rpm: from_rpm,
            peak_growth_per_s: 0.0,
            frequency_hz: 0.0,
            name: None,
            branches: Vec::new(),
            modes: Vec::new(),
            counted_rpm: Vec::new(),
            felt_rpm: Vec::new(),
            saturated_amplitude_m: None,
            amplitude_not_computed: None,
            estimated_relative_error: None,
            estimated_relative_growth_error: None,
        }
    }

    /// A band, with the range in which its growth exceeds the threshold.
    pub(crate) fn new(band: &Instability, threshold_per_s: f64) -> Self {
        let counted = band.counted(threshold_per_s).into_iter();
        let felt = band.felt(threshold_per_s).into_iter();
        InstabilityBand {
            closed: band.closed,
            peak_rpm: rpm(band.peak_rad_per_s),
            peak_growth_per_s: band.peak_growth_per_s,
            frequency_hz: band.frequency_rad_per_s / TAU,
            counted_rpm: counted.map(|range| range.ends().map(rpm)).collect(),
            felt_rpm: felt.map(|range| range.ends().map(rpm)).collect(),
            ..Self::between(band.kind, [band.from_rad_per_s, band.to_rad_per_s].map(rpm))
        }
    }

    /// The band as a verdict sees it.
    pub(crate) fn listed(&self) -> ListedBand {
        let range = |[from, to]: [f64; 2]| SpeedRange::new(rad_per_s(from), rad_per_s(to));
        ListedBand {
            kind: self.kind,
            range: range([self.from_rpm, self.to_rpm]),
            counted: self.counted_rpm.iter().copied().map(range).collect(),
            felt: self.felt_rpm.iter().copied().map(range).collect(),
            peak_growth_per_s: self.peak_growth_per_s,
            edge_error: self.estimated_relative_error,
        }
    }

    /// A band with its waves and the numbers of its branches.
    pub(crate) fn in_chart(
        band: &Instability,
        branches: &Numbered<'_>,
        threshold_per_s: f64,
    ) -> Self {
        let event = branches.event(band);
        let waves = event.iter().flat_map(|event| &event.waves);
        InstabilityBand {
            modes: waves.map(EventWaves::in_words).collect(),
            name: event.as_ref().map(EventName::in_words),
            branches: branches.of_band(band),
            ..Self::new(band, threshold_per_s)
        }
    }
}

impl OperatingPoint {
    /// Results at a speed, without the modes there.
    pub(crate) fn from_evidence(evidence: &Evidence<'_>, speed_rad_per_s: f64) -> Self {
        let critical = evidence.critical_rad_per_s;
        let of_first_critical = critical.first().map(|lowest| speed_rad_per_s / lowest);
        let verdict = evidence.verdict(speed_rad_per_s);
        let window = evidence.window_without_instability(speed_rad_per_s);
        OperatingPoint {
            rpm: rpm(speed_rad_per_s),
            of_first_critical,
            stability: verdict.state,
            inside_instability: verdict.band,
            at_critical_rpm: verdict.critical.map(|place| rpm(critical[place])),
            side_force_factor: None,
            deviation: None,
            undecided_edge_rpm: verdict.undecided.map(|edge| rpm(edge.speed)),
            safe_window_rpm: window.map(|range| range.ends().map(rpm)),
            growth_per_s: None,
            frequency_hz: None,
        }
    }
}

/// Amplitudes of the bands of flutter, if the scene limits them; empty where they cannot be computed.
fn limited_amplitudes(analysis: &Analysis) -> Vec<Rise> {
    if analysis.scene.limits().max_amplitude_m.is_none() {
        return Vec::new();
    }
    saturations(analysis).unwrap_or_default()
}

fn at_operating_speed(analysis: &Analysis, speed_rad_per_s: f64) -> OperatingPoint {
    let critical = analysis.critical_rad_per_s();
    let fastest = analysis.fastest_operating;
    OperatingPoint {
        growth_per_s: fastest.map(|lambda| lambda.re),
        frequency_hz: fastest.map(|lambda| lambda.im.abs() / TAU),
        side_force_factor: side_force_factor(analysis, speed_rad_per_s),
        deviation: Some(BoardDeviation::of(analysis, speed_rad_per_s)),
        ..OperatingPoint::from_evidence(&analysis.evidence(&critical), speed_rad_per_s)
    }
}

fn work(counters: &WorkCounters) -> SolveCounts {
    let count = |counter: &AtomicUsize| counter.load(Ordering::Relaxed);
    SolveCounts {
        full_solves: count(&counters.full_solves),
        structured_solves: count(&counters.structured_solves),
        reduced_solves: count(&counters.reduced_solves),
        local_solves: count(&counters.local_solves),
        refined_pairs: count(&counters.refined_pairs),
        heat_solves: count(&counters.heat_solves),
    }
}
