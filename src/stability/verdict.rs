//! Verdict whether a saw can run at a speed, the same for check, summary, report, page and study.
//!
//! Divergence always counts. Flutter counts if it grows as fast as the threshold:
//! - in an undamped blade a band counts as a whole, by its largest growth: growth rises with the square root
//!   of the distance from the onset, within a fraction of the band's width;
//! - in a damped blade a band may grow imperceptibly over hundreds of rpm, so it counts only where its growth
//!   reaches the threshold.
//!
//! A critical speed without a band is no instability, because nothing grows. But K(Ω) is singular at this
//! speed, and a constant side force deflects the wave without bound. A window without instability therefore
//! ends before a critical speed.

use faer::c64;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::band::{CurvePoint, Instability};
use super::floquet::{FloquetGrowth, NearbyGrowth};
use super::instability_kind::InstabilityKind;
use super::interpolation::Cubic;
use super::listed_band::ListedBand;
use super::root::share_of_zero;
use super::undecided::{Edge, undecided};
use crate::model::scene::SpeedRange;
use crate::modes::smallest;

/// Relative distance from a critical speed within which a saw is considered to run at it. Because of K(Ω) =
/// K₀ − Ω²B, a side force fixed in space deflects the wave of the critical speed Ω_c alone by 1/|1 − (Ω/Ω_c)²|
/// times its deflection at rest: ten times at this margin. The whole deflection of a saw has its own factor,
/// [`side_force_factor`](crate::analyses::campbell::OperatingPoint::side_force_factor).
pub const CRITICAL_MARGIN: f64 = 0.05;

/// The answer to whether a saw is stable at one speed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum StabilityState {
    /// No instability that counts.
    Stable,
    /// A deflection grows exponentially without oscillating: λ is real and positive.
    Divergence,
    /// A vibration grows exponentially: Re λ > 0 with a frequency.
    Flutter,
    /// The estimated error of the edge of a band exceeds its distance from the speed, so it is open on which side the speed is.
    TooClose,
    /// The search for bands failed: its bands contradict the eigenvalues.
    NotDetermined,
    /// No band that counts, but slots of the blade pass guides, which the model does not cover at this speed, or whose growth there is too
    /// close to the threshold to call.
    NotCovered,
    /// The speed was not analysed.
    OutsideSweep,
}

impl StabilityState {
    /// The state at a speed of the sweep at which bands of these kinds count; divergence takes precedence
    /// over flutter.
    pub(crate) fn within(kinds: impl IntoIterator<Item = InstabilityKind>) -> Self {
        let states = kinds.into_iter().map(|kind| match kind {
            InstabilityKind::Divergence => StabilityState::Divergence,
            InstabilityKind::Flutter => StabilityState::Flutter,
        });
        let diverges = |state: &StabilityState| *state == StabilityState::Divergence;
        states
            .max_by_key(diverges)
            .unwrap_or(StabilityState::Stable)
    }

    /// The state of a slotted saw beside guides by its Floquet multipliers.
    fn of_growth(growth: &FloquetGrowth, threshold_per_s: f64) -> Self {
        if growth.growth_per_s - growth.error_per_s >= threshold_per_s {
            StabilityState::Flutter
        } else if growth.growth_per_s + growth.error_per_s >= threshold_per_s {
            StabilityState::NotCovered
        } else {
            StabilityState::Stable
        }
    }
}

/// Whether a saw is stable at one speed, and which band decides it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Verdict {
    /// State of the saw at the speed.
    pub state: StabilityState,
    /// Index of the band that makes the saw unstable: divergence first, then the fastest growing.
    pub band: Option<usize>,
    /// Interval around the speed in which that band counts, in rad/s.
    pub stretch: Option<SpeedRange>,
    /// The edge whose error leaves the state open, in rad/s.
    pub undecided: Option<Edge>,
    /// Index of the critical speed within 5 % of the speed; of several, the nearest.
    pub critical: Option<usize>,
    /// The growth by Floquet multipliers, if it decides.
    pub floquet: Option<FloquetGrowth>,
}

/// Results from which a verdict follows.
#[derive(Debug, Clone)]
pub struct Evidence<'a> {
    /// Every band within the range.
    pub bands: Vec<ListedBand>,
    /// Whether the search for the bands failed, see [`Certificate::has_failed`](super::Certificate::has_failed).
    pub has_failed: bool,
    /// Critical speeds, ascending, in rad/s, including those next to the range.
    pub critical_rad_per_s: &'a [f64],
    /// Smallest growth rate of flutter that counts, in 1/s; divergence always counts.
    pub threshold_per_s: f64,
    /// Range of the search, in rad/s.
    pub range_rad_per_s: SpeedRange,
    /// Speeds at which a saw without a band that counts may be unstable all the same, because slots pass guides.
    pub not_covered: Vec<SpeedRange>,
    /// Growth by Floquet multipliers at and beside a speed, if it was computed: there it decides in place of the bands, unless it is too
    /// close to the threshold to call.
    pub floquet: Option<NearbyGrowth>,
}

/// Index of the critical speed within 5 % of a speed; of several, the nearest. All speeds have the same unit.
pub(crate) fn critical_at(critical: &[f64], speed: f64) -> Option<usize> {
    let off = |place: usize| (speed / critical[place] - 1.0).abs();
    let near = (0..critical.len()).filter(|place| off(*place) <= CRITICAL_MARGIN);
    smallest(near, |place| off(*place))
}

impl Evidence<'_> {
    /// Verdict at a speed.
    pub fn verdict(&self, speed_rad_per_s: f64) -> Verdict {
        let around = |range: &SpeedRange| range.contains(speed_rad_per_s);
        let counted = self.bands.iter().enumerate().filter_map(|(index, band)| {
            let stretch = band.counted.iter().find(|stretch| around(stretch))?;
            Some((index, band, *stretch))
        });
        let rank = |band: &ListedBand| {
            let diverges = band.kind == InstabilityKind::Divergence;
            (diverges, band.peak_growth_per_s)
        };
        let worst = counted.max_by(|(_, x, _), (_, y, _)| {
            let (x, y) = (rank(x), rank(y));
            x.0.cmp(&y.0).then(x.1.total_cmp(&y.1))
        });
        let is_determined = !self.has_failed;
        let worst = worst.filter(|_| is_determined);
        let undecided = undecided(self.edges(), speed_rad_per_s).filter(|_| is_determined);
        let is_analysed = around(&self.range_rad_per_s);
        let nearby = self
            .floquet
            .filter(|nearby| is_determined && is_analysed && nearby.contains(speed_rad_per_s));
        let by_floquet = nearby.map(|nearby| {
            let growth = nearby.deciding(self.threshold_per_s);
            (
                growth,
                StabilityState::of_growth(&growth, self.threshold_per_s),
            )
        });
        let by_bands = worst.map(|(_, band, _)| StabilityState::within([band.kind]));
        let is_open = undecided.is_none() && worst.is_none();
        let by_floquet =
            by_floquet.filter(|(_, state)| is_open || *state != StabilityState::NotCovered);
        let (worst, undecided) = match by_floquet {
            Some((_, StabilityState::Stable)) => (None, None),
            Some(_) => (worst, None),
            None => (worst, undecided),
        };
        let state = match (by_floquet, by_bands) {
            _ if !is_determined && is_analysed => StabilityState::NotDetermined,
            (Some((_, StabilityState::Flutter)), Some(state)) => state,
            (Some((_, state)), _) => state,
            _ if undecided.is_some() => StabilityState::TooClose,
            (None, Some(state)) => state,
            _ if !is_analysed => StabilityState::OutsideSweep,
            _ if self.not_covered.iter().any(around) => StabilityState::NotCovered,
            _ => StabilityState::Stable,
        };
        Verdict {
            state,
            band: worst.map(|(index, _, _)| index),
            stretch: worst.map(|(_, _, stretch)| stretch),
            undecided,
            critical: critical_at(self.critical_rad_per_s, speed_rad_per_s),
            floquet: by_floquet.map(|(growth, _)| growth),
        }
    }

    /// Ranges of speed, in rad/s, in which slots pass guides and it is not known that no motion grows, or known that one does.
    pub(crate) fn not_passed(&self) -> Vec<[f64; 2]> {
        let open = self
            .not_covered
            .iter()
            .flat_map(|range| self.beside_quiet(range.ends()));
        let grows = self.floquet.filter(|_| self.quiet().is_none());
        open.chain(grows.map(|nearby| nearby.ends())).collect()
    }

    /// The parts of a range, in rad/s, in which Floquet multipliers do not show that nothing grows.
    pub(crate) fn beside_quiet(&self, [from, to]: [f64; 2]) -> impl Iterator<Item = [f64; 2]> {
        let [before, after] = self.quiet().unwrap_or([to, to]);
        let parts = [[from, to.min(before)], [from.max(after), to]];
        parts.into_iter().filter(|[from, to]| from < to)
    }

    /// Speeds at which Floquet multipliers show that nothing grows, in rad/s.
    fn quiet(&self) -> Option<[f64; 2]> {
        let nearby = self.floquet.filter(|_| !self.has_failed)?;
        let growth = nearby.deciding(self.threshold_per_s);
        let state = StabilityState::of_growth(&growth, self.threshold_per_s);
        let is_quiet = state == StabilityState::Stable && !growth.is_felt(self.threshold_per_s);
        is_quiet.then(|| nearby.ends())
    }

    /// The edges of the bands that count, in rad/s.
    fn edges(&self) -> impl Iterator<Item = Edge> {
        let sweep = self.range_rad_per_s.ends();
        let bands = self.bands.iter();
        bands.flat_map(move |band| band.counted_edges(sweep))
    }

    /// Range of speeds around a speed without an instability that counts, in rad/s, within the sweep and at
    /// least 5 % away from critical speeds; `None` if the saw is unstable, too close to an edge or at a critical
    /// speed, or if the speed is outside the sweep.
    pub fn window_without_instability(&self, speed_rad_per_s: f64) -> Option<SpeedRange> {
        let verdict = self.verdict(speed_rad_per_s);
        if verdict.state != StabilityState::Stable || verdict.critical.is_some() {
            return None;
        }
        let counted = self
            .bands
            .iter()
            .flat_map(|band| band.counted.iter().copied());
        // Where multipliers decide, the window has no more than their speeds, and bands do not matter.
        let [counted, open]: [Vec<SpeedRange>; 2] = [counted.collect(), self.not_covered.clone()];
        let is_among =
            |ranges: &[SpeedRange]| ranges.iter().any(|range| range.contains(speed_rad_per_s));
        let passed = verdict.floquet.and(self.floquet);
        let passed = passed.filter(|_| is_among(&counted) || is_among(&open));
        let counted = counted.into_iter().filter(|_| passed.is_none());
        let open = open.into_iter().filter(|_| passed.is_none());
        let beside = |speed: &f64| {
            let margin = CRITICAL_MARGIN * speed;
            SpeedRange::new(speed - margin, speed + margin)
        };
        let excluded = counted
            .chain(open)
            .chain(self.critical_rad_per_s.iter().map(beside));
        let window = excluded.fold(self.range_rad_per_s, |window, out| {
            let beside = if out.to_rad_per_s < speed_rad_per_s {
                SpeedRange::new(out.to_rad_per_s, f64::INFINITY)
            } else {
                SpeedRange::new(0.0, out.from_rad_per_s)
            };
            window.within(beside)
        });
        Some(passed.map_or(window, |nearby| {
            let [from, to] = nearby.ends();
            window.within(SpeedRange::new(from, to))
        }))
    }
}

/// The speed at which flutter begins.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FlutterOnset {
    /// Index of its band.
    pub band: usize,
    /// The speed.
    pub speed_rad_per_s: f64,
}

/// Lowest speed of flutter that counts, and lowest speed of any flutter.
pub fn flutter_onsets(bands: &[Instability], threshold_per_s: f64) -> [Option<FlutterOnset>; 2] {
    let first = |begin: &dyn Fn(&Instability) -> Option<f64>| {
        let flutter = bands.iter().enumerate();
        let flutter = flutter.filter(|(_, band)| band.kind == InstabilityKind::Flutter);
        let onsets = flutter.filter_map(|(band, own)| {
            begin(own).map(|speed_rad_per_s| FlutterOnset {
                band,
                speed_rad_per_s,
            })
        });
        smallest(onsets, |onset| onset.speed_rad_per_s)
    };
    let counted = |band: &Instability| {
        let stretches = band.counted(threshold_per_s);
        stretches.first().map(|range| range.from_rad_per_s)
    };
    [
        first(&counted),
        first(&|band: &Instability| Some(band.from_rad_per_s)),
    ]
}

impl Instability {
    /// Intervals of speed in which the band counts, ascending, in rad/s.
    pub fn counted(&self, threshold_per_s: f64) -> Vec<SpeedRange> {
        if !self.counts(threshold_per_s) {
            return Vec::new();
        }
        if self.kind == InstabilityKind::Divergence || self.curve.is_empty() {
            return vec![self.range()];
        }
        let strong = |p: &CurvePoint| p.number.re >= threshold_per_s;
        let mut stretches = Vec::new();
        let mut begun = self
            .curve
            .first()
            .filter(|p| strong(p))
            .map(|_| self.from_rad_per_s);
        for pair in self.curve.windows(2) {
            match (strong(&pair[0]), strong(&pair[1])) {
                (false, true) => begun = Some(crossing(pair, threshold_per_s)),
                (true, false) => {
                    let to = crossing(pair, threshold_per_s);
                    stretches.extend(begun.take().map(|from| SpeedRange::new(from, to)));
                }
                _ => {}
            }
        }
        stretches.extend(begun.map(|from| SpeedRange::new(from, self.to_rad_per_s)));
        stretches
    }

    /// Re λ of a damped blade at a speed, in 1/s; `None` outside the band and for an undamped blade.
    pub fn growth_at(&self, speed_rad_per_s: f64) -> Option<f64> {
        self.lambda_at(speed_rad_per_s).map(|lambda| lambda.re)
    }

    /// λ of a damped blade at a speed; `None` outside the band and for an undamped blade.
    pub(super) fn lambda_at(&self, speed_rad_per_s: f64) -> Option<c64> {
        let after = |p: &CurvePoint| p.speed_rad_per_s < speed_rad_per_s;
        let place = self.curve.partition_point(after).max(1);
        let pair = self.curve.get(place - 1..=place)?;
        let inside = pair[0].speed_rad_per_s..=pair[1].speed_rad_per_s;
        let width = pair[1].speed_rad_per_s - pair[0].speed_rad_per_s;
        let share = (speed_rad_per_s - pair[0].speed_rad_per_s) / width;
        let [from, to] = [pair[0], pair[1]].map(|point| point.number.im);
        let lambda = || c64::new(growth_between(pair, share), from + share * (to - from));
        inside.contains(&speed_rad_per_s).then(lambda)
    }
}

/// Re λ at a share of the way between two points of a curve.
pub(super) fn growth_between(pair: &[CurvePoint], share: f64) -> f64 {
    let width = pair[1].speed_rad_per_s - pair[0].speed_rad_per_s;
    let [before, after] = [pair[0], pair[1]].map(|p| (p.number.re, p.slope.re * width));
    let straight = before.0 + share * (after.0 - before.0);
    // Slopes that are large against the values occur next to a coalescence, where the points are so close
    // that a straight line is accurate.
    let size = before.0.abs() + after.0.abs();
    let steepness = before.1.abs() + after.1.abs();
    if steepness.is_nan() || steepness > 8.0 * size {
        return straight;
    }
    let cubic = Cubic {
        values: [before.0, after.0],
        slopes: [before.1, after.1],
    };
    cubic.at(share)
}

/// Speed between two points of a curve at which Re λ has a value.
fn crossing(pair: &[CurvePoint], value: f64) -> f64 {
    let share = share_of_zero(|share| growth_between(pair, share) - value);
    let width = pair[1].speed_rad_per_s - pair[0].speed_rad_per_s;
    pair[0].speed_rad_per_s + share * width
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stability::band::BandEnd;

    fn band(kind: InstabilityKind, from: f64, to: f64, growth: f64) -> Instability {
        Instability {
            kind,
            from_rad_per_s: from,
            to_rad_per_s: to,
            ends: [BandEnd::Range; 2],
            closed: true,
            peak_rad_per_s: 0.5 * (from + to),
            peak_growth_per_s: growth,
            frequency_rad_per_s: 10.0,
            curve: Vec::new(),
        }
    }

    /// Growth (Ω − 100)(180 − Ω)/1600, 1 at 140 rad/s.
    fn damped_hump() -> Instability {
        let point = |speed: f64| CurvePoint {
            speed_rad_per_s: speed,
            number: c64::new((speed - 100.0) * (180.0 - speed) / 1600.0, 10.0),
            slope: c64::new((280.0 - 2.0 * speed) / 1600.0, 0.0),
        };
        let speeds = [100.0, 110.0, 140.0, 171.0, 180.0];
        Instability {
            curve: speeds.map(point).to_vec(),
            ..band(InstabilityKind::Flutter, 100.0, 180.0, 1.0)
        }
    }

    fn evidence<'a>(bands: &[Instability], critical: &'a [f64]) -> Evidence<'a> {
        let listed = |band| ListedBand::new(band, 0.25, Some(0.0));
        Evidence {
            bands: bands.iter().map(listed).collect(),
            has_failed: false,
            critical_rad_per_s: critical,
            threshold_per_s: 0.25,
            range_rad_per_s: SpeedRange::new(0.0, 300.0),
            not_covered: Vec::new(),
            floquet: None,
        }
    }

    fn onsets(bands: &[Instability], threshold_per_s: f64) -> [Option<(usize, f64)>; 2] {
        let found = flutter_onsets(bands, threshold_per_s);
        found.map(|onset| onset.map(|onset| (onset.band, onset.speed_rad_per_s)))
    }

    #[test]
    fn a_damped_band_counts_where_its_growth_reaches_the_threshold() {
        let bands = [damped_hump()];
        // (Ω − 100)(180 − Ω) = 400 at 140 ± √1200.
        let half = 1200.0_f64.sqrt();
        let counted = bands[0].counted(0.25);
        assert_eq!(counted.len(), 1, "{counted:?}");
        let [from, to] = counted[0].ends();
        assert!((from - (140.0 - half)).abs() < 1e-9 && (to - (140.0 + half)).abs() < 1e-9);
        assert_eq!(onsets(&bands, 0.25), [Some((0, from)), Some((0, 100.0))]);
        let found = evidence(&bands, &[]);
        let state = |speed| found.verdict(speed).state;
        assert_eq!(state(104.0), StabilityState::Stable);
        assert_eq!(state(140.0), StabilityState::Flutter);
        assert_eq!(state(301.0), StabilityState::OutsideSweep);
        let window = |speed| found.window_without_instability(speed);
        assert_eq!(window(104.0), Some(SpeedRange::new(0.0, from)));
        assert_eq!(window(179.0), Some(SpeedRange::new(to, 300.0)));
        assert_eq!(window(140.0), None);
        assert_eq!(onsets(&bands, 1.5), [None, Some((0, 100.0))]);
    }

    #[test]
    fn undamped_bands_count_as_a_whole_and_divergence_always() {
        let bands = [
            band(InstabilityKind::Divergence, 90.0, 95.0, 0.01),
            band(InstabilityKind::Flutter, 94.0, 120.0, 0.3),
            band(InstabilityKind::Flutter, 150.0, 160.0, 0.2),
        ];
        let found = evidence(&bands, &[]);
        let at = |speed| found.verdict(speed);
        assert_eq!(at(94.5).state, StabilityState::Divergence);
        assert_eq!((at(94.0).band, at(119.0).band), (Some(0), Some(1)));
        assert_eq!(at(155.0).state, StabilityState::Stable);
        assert_eq!(
            found.window_without_instability(155.0),
            Some(SpeedRange::new(120.0, 300.0))
        );
        assert_eq!(onsets(&bands, 0.25), [Some((1, 94.0)), Some((1, 94.0))]);
    }

    /// There is no band at the critical speeds of a blade without guides, but windows end before them.
    #[test]
    fn windows_end_short_of_critical_speeds() {
        let bands = [band(InstabilityKind::Divergence, 240.0, 250.0, 1.0)];
        let found = evidence(&bands, &[100.0, 200.0, 240.0, 250.0, 310.0]);
        let window = |speed| found.window_without_instability(speed);
        assert_eq!(window(90.0), Some(SpeedRange::new(0.0, 95.0)));
        assert_eq!(window(150.0), Some(SpeedRange::new(105.0, 190.0)));
        assert_eq!(window(220.0), Some(SpeedRange::new(210.0, 228.0)));
        assert_eq!(window(280.0), Some(SpeedRange::new(262.5, 294.5)));
        let at = |speed| found.verdict(speed);
        for (speed, critical) in [
            (96.0, Some(0)),
            (104.9, Some(0)),
            (105.1, None),
            (243.0, Some(2)),
        ] {
            assert_eq!(at(speed).critical, critical, "{speed}");
        }
        assert_eq!(at(100.0).state, StabilityState::Stable);
        assert_eq!(window(100.0), None);
        // At the margin, on either side, the wave alone is deflected ten times as far as at rest.
        for ratio in [1.0 - CRITICAL_MARGIN, 1.0 + CRITICAL_MARGIN] {
            let times = 1.0 / (1.0 - ratio * ratio).abs();
            assert!((times - 10.0).abs() < 0.3, "{times}");
        }
    }
}
