//! Stability analysis of a scene: the main call of the library.

use faer::c64;

use super::at_rest::ModesAtRest;
use super::band::Instability;
use super::basis::{ChosenBasis, FALL};
use super::basis_limit::OutOfReach;
use super::between::Between;
use super::chart::{CHART_SPEEDS, drawn};
use super::detail::Detail;
use super::error::AnalysisError;
use super::estimate::Estimates;
use super::excitation::{Crossing, crossings};
use super::expected_work::ExpectedWork;
use super::floquet::{NearbyGrowth, NotComputed};
use super::heat::HeatLimits;
use super::ladder::next_smaller;
use super::listed_band::ListedBand;
use super::listed_pair::Listed;
use super::onsets::Onsets;
use super::options::AnalysisOptions;
use super::room::check_room;
use super::search_result::StabilityChart;
use super::shortened::Shortened;
use super::split_pairs::SplitPairs;
use super::undamped::Depth;
use super::undamped::RootLoci;
use super::verdict::{Evidence, StabilityState, Verdict, flutter_onsets};
use crate::model::plate::{LightGapError, Resolution, StraightEdgeReading};
use crate::model::scene::{Accuracy, Scene, SceneError, SlotPassing, SpeedRange, rpm};
use crate::modes::{DescribedMode, SpectralModel, SpectrumError, Strategy};

/// Number of even speeds in the chart of a free blade, whose modes take little time.
const FREE_CHART_SPEEDS: usize = 101;

/// Number of even speeds in the sketch of a guided blade.
const SKETCH_SPEEDS: usize = 25;

fn charted<'a>(
    model: &'a SpectralModel,
    range: SpeedRange,
    depth: Depth,
    options: AnalysisOptions<'_>,
) -> Result<(StabilityChart, Between<'a>), AnalysisError> {
    let full = AnalysisOptions {
        detail: Detail::Full,
        ..options
    };
    match (model.plate.is_axisymmetric(), options.detail) {
        (true, _) => drawn(model, range, FREE_CHART_SPEEDS, depth, full),
        (false, Detail::Full) => drawn(model, range, CHART_SPEEDS, depth, full),
        (false, Detail::Sketch) => drawn(model, range, SKETCH_SPEEDS, Depth::Counts, options),
    }
}

/// Stability of one saw: critical speeds, bands, estimated errors and certificate.
#[derive(Debug)]
pub struct Analysis {
    /// Scene that was analysed.
    pub scene: Scene,
    /// Model that gives the modes at any speed of the range.
    pub model: SpectralModel,
    /// Range of speeds, in rad/s.
    pub range_rad_per_s: SpeedRange,
    /// Speed up to which no wave with more nodal diameters than the basis can stand still, in rad/s: at least the
    /// end of the range and the first critical speed.
    pub complete_to_rad_per_s: f64,
    /// Branches, bands and certificate.
    pub chart: StabilityChart,
    /// Flutter speed: lowest speed of flutter that counts, in rad/s, see [`Instability::counted`].
    pub flutter_speed_rad_per_s: Option<f64>,
    /// Onset of the first flutter band, including bands that do not count, in rad/s.
    pub first_merge_rad_per_s: Option<f64>,
    /// Eigenvalues of the band at the flutter speed, or of the first flutter band.
    pub root_loci: Option<RootLoci>,
    /// Estimated relative error of the critical speeds within the range, from the changes by a larger basis.
    pub estimated_relative_error: Option<f64>,
    /// Estimated error of each result.
    pub estimates: Option<Estimates>,
    /// Reason why the estimated errors exceed the tolerance of the scene, if they do and the chart is drawn
    /// in full.
    pub out_of_reach: Option<OutOfReach>,
    /// Oscillating modes at rest, ascending.
    pub modes_at_rest: Vec<DescribedMode>,
    /// Number of overdamped modes at rest, which are not among `modes_at_rest`.
    pub overdamped_at_rest: usize,
    /// λ of the fastest growing or slowest decaying mode at the operating speed, if that speed is within the
    /// sweep.
    pub fastest_operating: Option<c64>,
    /// Largest backward error of the listed eigenvalues: at rest, at the peaks of bands and at the operating
    /// speed.
    pub listed_backward_error: Option<f64>,
    /// Temperature limits of the blade, for a scene with temperature.
    pub heat: Option<HeatLimits>,
    /// Light gap under the straight edge, for a scene with one.
    pub straight_edge: Option<StraightEdgeReading>,
    /// Results for the same saw without cutting forces, if the chart includes them.
    pub idling: Option<Onsets>,
    /// Crossings of the excitation lines with branches, by line and speed.
    pub crossings: Vec<Crossing>,
    /// Why the sweep that the program chose ends earlier than usual, if the chart of the usual one was refused.
    pub shortened: Option<Shortened>,
    /// Growth of a slotted saw beside guides at and beside the operating speed, by Floquet multipliers, or why it was not computed; `None`
    /// for other saws, and without an operating speed.
    pub floquet: Option<Result<NearbyGrowth, NotComputed>>,
    /// Results of a slotted blade with other branches of its split pairs; `None` for other blades and for a sketch.
    pub split_pairs: Option<SplitPairs>,
}

/// The light gap of a scene with a straight edge.
fn straight_edge(scene: &Scene) -> Result<Option<StraightEdgeReading>, AnalysisError> {
    let membrane = scene.membrane();
    let reading = membrane.and_then(|membrane| {
        let edge = membrane.straight_edge.as_ref()?;
        Some(StraightEdgeReading::new(edge, &membrane.roll_tension))
    });
    reading.transpose().map_err(|error| match error {
        LightGapError::Measured(refused) => SceneError::Value(refused).into(),
        LightGapError::Buckling(error) => SpectrumError::at(0.0)(error).into(),
    })
}

impl Analysis {
    /// Analyses a saw over the speeds of its scene.
    ///
    /// # Errors
    /// [`AnalysisError`]; [`SpectrumError::Cancelled`](crate::modes::SpectrumError::Cancelled)
    /// once the computation that this thread works for is cancelled, see
    /// [`Cancellation::watched`](crate::modes::Cancellation::watched).
    pub fn new(scene: &Scene) -> Result<Self, AnalysisError> {
        Self::with_options(scene, AnalysisOptions::default())
    }

    /// Analyses a saw over the speeds of its scene, with options.
    ///
    /// # Errors
    /// The errors of [`Analysis::new`].
    pub fn with_options(
        scene: &Scene,
        options: AnalysisOptions<'_>,
    ) -> Result<Self, AnalysisError> {
        let chosen = ChosenBasis::at_least(scene, scene.tolerance(), options.least_size)?;
        let least = chosen.saw.plate.resolution;
        let refused = match Self::on_basis(scene, chosen, options) {
            Err(error) => error,
            analysed => return analysed,
        };
        let Some((shortened, end_rpm)) = Shortened::after(&refused, scene) else {
            return Err(refused);
        };
        let shorter = scene.swept(SpeedRange::between_rpm(0.0, end_rpm))?;
        let chosen = ChosenBasis::at_least(&shorter, scene.tolerance(), least)?;
        let analysis = Self::on_basis(scene, chosen, options)?;
        Ok(Analysis {
            shortened: Some(shortened),
            ..analysis
        })
    }

    fn on_basis(
        scene: &Scene,
        chosen: ChosenBasis,
        options: AnalysisOptions<'_>,
    ) -> Result<Self, AnalysisError> {
        let detail = options.detail;
        if detail == Detail::Full {
            check_room(&chosen)?;
            let expected = ExpectedWork::allowed(scene, &chosen)?;
            if let Some(tell) = options.expected {
                tell(expected);
            }
        }
        let straight_edge = straight_edge(scene)?;
        let ChosenBasis {
            saw,
            critical,
            range_rad_per_s: range,
            estimated_relative_error,
            estimated_resting_error,
            basis_error,
            complete_to_rad_per_s,
        } = chosen;
        options.report(&critical, range, None, true);
        let mut model = SpectralModel::with_critical(saw, critical, range, Strategy::Reduced)?;
        let depth = Depth::of(scene.accuracy());
        let mut searched_again = false;
        let (mut chart, between) = loop {
            let (mut chart, between) = charted(&model, range, depth, options)?;
            if searched_again || !chart.certificate.lacks_waves() {
                chart.certificate.searched_again = searched_again;
                break (chart, between);
            }
            drop(between);
            model = model.with_more_waves()?;
            searched_again = true;
        };
        let at_rest = ModesAtRest::new(&model, range)?;
        let is_refined = scene.accuracy() == Accuracy::Reference && detail == Detail::Full;
        let mut listed = is_refined
            .then(|| Listed::new(at_rest.model(&model), &at_rest.oscillating))
            .transpose()?;
        if let Some(listed) = &mut listed {
            listed.refine_peaks(&model, &mut chart.instabilities)?;
        }
        let estimates =
            Estimates::new(&model, range, &chart, basis_error, estimated_resting_error)?;
        let threshold = scene.flutter_threshold_per_s();
        let [flutter_speed, first_merge] = if chart.certificate.has_failed() {
            [None; 2]
        } else {
            flutter_onsets(&chart.instabilities, threshold)
        };
        // With damping no pair coalesces.
        let has_loci = detail == Detail::Full && model.is_conservative();
        let root_loci = match flutter_speed.or(first_merge).filter(|_| has_loci) {
            Some(onset) => RootLoci::new(&between, &chart, onset.band, range)?,
            None => None,
        };
        let [flutter_speed, first_merge] =
            [flutter_speed, first_merge].map(|onset| onset.map(|onset| onset.speed_rad_per_s));
        drop(between);
        let heat = HeatLimits::new(scene, &model)?;
        let crossings = crossings(&model, &chart, scene.excitation())?;
        let idling = match scene.cut().and_then(|cut| cut.chart) {
            Some(_) if detail == Detail::Full => Some(Onsets::idling(scene, range)?),
            _ => None,
        };
        let analysis = Analysis {
            straight_edge,
            shortened: None,
            floquet: None,
            split_pairs: None,
            scene: scene.clone(),
            estimated_relative_error: Some(estimated_relative_error),
            estimates: Some(estimates),
            out_of_reach: None,
            model,
            range_rad_per_s: range,
            complete_to_rad_per_s,
            chart,
            flutter_speed_rad_per_s: flutter_speed,
            first_merge_rad_per_s: first_merge,
            root_loci,
            modes_at_rest: at_rest.oscillating,
            overdamped_at_rest: at_rest.overdamped,
            fastest_operating: None,
            listed_backward_error: None,
            heat,
            idling,
            crossings,
        };
        analysis.completed(detail, listed)
    }

    /// Adds the results that need the verdict or the estimated errors.
    fn completed(mut self, detail: Detail, listed: Option<Listed>) -> Result<Self, AnalysisError> {
        if detail == Detail::Full {
            let range = self.range_rad_per_s;
            self.split_pairs = SplitPairs::of(&self.scene, &self.model, &self.chart, range)?;
        }
        if let Some(speed) = self.scene.operating_rad_per_s() {
            self.look_at_operating(speed)?;
            self.look_at_slots(speed);
        }
        if let Some(listed) = listed {
            self.close_list(listed)?;
        }
        if detail == Detail::Full && !self.reaches_tolerance() {
            self.out_of_reach = self.explained()?;
        }
        Ok(self)
    }

    /// Largest estimated relative error of the critical speeds within the range and the frequencies at rest,
    /// for which the tolerance holds.
    pub fn promised_error(&self) -> Option<f64> {
        let at_rest = self.estimates.as_ref().map_or(0.0, |e| e.at_rest);
        Some(self.estimated_relative_error?.max(at_rest))
    }

    /// Whether the estimated errors are within the tolerance of the scene, which even the largest basis may
    /// miss.
    pub fn reaches_tolerance(&self) -> bool {
        let error = self.promised_error();
        error.is_some_and(|error| error <= self.scene.tolerance())
    }

    /// Size at which the search for the basis of a similar saw may begin: that of this saw, or the next smaller
    /// one if the errors of this saw leave room for it.
    pub fn size_for_similar(&self) -> Resolution {
        let size = self.model.plate.resolution;
        let error = self.promised_error().unwrap_or(f64::INFINITY);
        if FALL * error <= self.scene.tolerance() {
            next_smaller(size)
        } else {
            size
        }
    }

    fn explained(&self) -> Result<Option<OutOfReach>, AnalysisError> {
        match (&self.estimates, self.promised_error()) {
            (Some(estimates), Some(error)) => OutOfReach::of(
                &self.scene,
                &self.model.plate,
                self.range_rad_per_s.to_rad_per_s,
                estimates,
                error,
            ),
            _ => Ok(None),
        }
    }

    /// Refines the eigenvalue at the operating speed, and stores the largest backward error of the list.
    fn close_list(&mut self, mut listed: Listed) -> Result<(), SpectrumError> {
        let operating = self.scene.operating_rad_per_s();
        if let Some((speed, lambda)) = operating.zip(self.fastest_operating) {
            self.fastest_operating = Some(listed.refine(&self.model, speed, lambda)?);
        }
        self.listed_backward_error = listed.largest_error();
        Ok(())
    }

    /// Finds the fastest growing or slowest decaying mode at the operating speed, and compares the bands with
    /// the modes there, because the verdict follows from the bands alone. Does nothing outside the sweep.
    fn look_at_operating(&mut self, speed_rad_per_s: f64) -> Result<(), SpectrumError> {
        if self.verdict(speed_rad_per_s).state == StabilityState::OutsideSweep {
            return Ok(());
        }
        let modes = self.model.modes(speed_rad_per_s)?;
        self.chart
            .compare_with_modes(&self.model, speed_rad_per_s, &modes);
        let growing = modes
            .iter()
            .map(|m| c64::new(m.growth_per_s(), m.lambda.im));
        self.fastest_operating = growing.max_by(|x, y| x.re.total_cmp(&y.re));
        Ok(())
    }

    /// Computes the growth of a slotted saw beside guides at a speed.
    pub(crate) fn look_at_slots(&mut self, speed_rad_per_s: f64) {
        self.floquet = None;
        if self.scene.file().slot_passing().is_none() {
            return;
        }
        let state = self.verdict(speed_rad_per_s).state;
        let is_unknown =
            [StabilityState::OutsideSweep, StabilityState::NotDetermined].contains(&state);
        if !is_unknown {
            let plate = &self.model.plate;
            self.floquet = Some(NearbyGrowth::new(&self.scene, plate, speed_rad_per_s));
        }
    }

    /// Every band of instability within the range of speeds, by onset.
    pub fn bands(&self) -> &[Instability] {
        &self.chart.instabilities
    }

    /// First critical speed, at which a wave stands still in space; `None` if the blade has none below the
    /// speed at which it would yield.
    pub fn first_critical_rpm(&self) -> Option<f64> {
        let lowest = self.model.critical.first()?;
        Some(rpm(lowest.speed_rad_per_s))
    }

    /// Lowest speed at which flutter grows faster than the scene's `flutter_threshold_per_s`.
    pub fn flutter_rpm(&self) -> Option<f64> {
        self.flutter_speed_rad_per_s.map(rpm)
    }

    /// Verdict at a speed.
    pub fn verdict(&self, speed_rad_per_s: f64) -> Verdict {
        self.evidence(&self.critical_rad_per_s())
            .verdict(speed_rad_per_s)
    }

    /// Range of speeds around a speed without an instability that counts, in rad/s, at least 5 % away from
    /// critical speeds; `None` where the saw is unstable or at a critical speed.
    pub fn window_without_instability(&self, speed_rad_per_s: f64) -> Option<SpeedRange> {
        self.evidence(&self.critical_rad_per_s())
            .window_without_instability(speed_rad_per_s)
    }

    /// Critical speed within 5 % of a speed.
    pub fn critical_rpm_at(&self, speed_rad_per_s: f64) -> Option<f64> {
        let place = self.verdict(speed_rad_per_s).critical?;
        Some(rpm(self.model.critical[place].speed_rad_per_s))
    }

    pub(crate) fn critical_rad_per_s(&self) -> Vec<f64> {
        let critical = self.model.critical.iter();
        critical.map(|c| c.speed_rad_per_s).collect()
    }

    /// The hull of the bands of a guide well inside the slots, if it is known; else every speed at which slots matter. An undamped saw of
    /// which no multipliers can be computed may grow at any speed, by up to 0.6 1/s beside guides well inside the slots.
    fn not_covered(&self, first_critical_rad_per_s: Option<f64>) -> Vec<SpeedRange> {
        if self.is_open_everywhere() {
            return vec![SpeedRange::new(0.0, f64::INFINITY)];
        }
        match self.hull() {
            Some(hull) => hull.to_vec(),
            None => self.scene.file().not_covered(first_critical_rad_per_s),
        }
    }

    fn is_open_everywhere(&self) -> bool {
        self.model.is_conservative() && self.floquet.is_some_and(|found| found.is_err())
    }

    /// The hull of bands where it decides which speeds are not certain: for guides well inside the slots.
    pub(crate) fn hull(&self) -> Option<&[SpeedRange]> {
        let is_inside = self.scene.file().slot_passing() == Some(SlotPassing::Inside);
        let pairs = self.split_pairs.as_ref()?;
        let decides = is_inside && !self.is_open_everywhere();
        pairs.hull.as_deref().filter(|_| decides)
    }

    /// Speeds of the sweep at which slots pass guides and the saw is unstable or not certain; `None` if no slots pass guides.
    pub(crate) fn not_certain(&self) -> Option<Vec<SpeedRange>> {
        self.scene.file().slot_passing()?;
        let lowest = self.critical_rad_per_s().first().copied();
        let open = self.not_covered(lowest).into_iter();
        let open = open.map(|range| range.within(self.range_rad_per_s));
        Some(open.filter(|range| range.width() > 0.0).collect())
    }

    pub(crate) fn evidence<'a>(&'a self, critical_rad_per_s: &'a [f64]) -> Evidence<'a> {
        let threshold_per_s = self.scene.flutter_threshold_per_s();
        // Without estimates of the bands nothing is known of their edges' errors, and none is asked for.
        let estimates = self.estimates.as_ref().map(|found| &found.bands);
        let error = |index: usize| match estimates.and_then(|bands| bands.get(index)) {
            Some(estimate) => estimate.speed,
            None => Some(0.0),
        };
        let bands = self.chart.instabilities.iter().enumerate();
        Evidence {
            bands: bands
                .map(|(index, band)| ListedBand::new(band, threshold_per_s, error(index)))
                .collect(),
            has_failed: self.chart.certificate.has_failed(),
            critical_rad_per_s,
            threshold_per_s,
            range_rad_per_s: self.range_rad_per_s,
            not_covered: self.not_covered(critical_rad_per_s.first().copied()),
            floquet: self.floquet.and_then(Result::ok),
        }
    }
}
