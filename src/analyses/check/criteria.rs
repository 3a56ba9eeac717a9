//! Compares each limit with the result, in numbers and in words.

use super::limits::Limits;
use super::report::Criterion;
use super::static_deflection::StaticDeflection;
use crate::analyses::board_deviation::BoardDeviation;
use crate::analyses::campbell::too_close;
use crate::model::plate::Plate;
use crate::model::scene::{Accuracy, Polar, Scene, SpeedRange, rpm};
use crate::motion::stretched_blade::Rise;
use crate::motion::transient::at_point;
use crate::page::text::{shown, shown_to};
use crate::stability::{
    Analysis, Evidence, Instability, InstabilityKind, StabilityState, flutter_onsets,
};

impl Limits {
    /// Evaluates every limit on critical speeds and bands that were found with this accuracy.
    pub fn criteria(&self, found: &Evidence<'_>, accuracy: Accuracy) -> Vec<Criterion> {
        let lowest_critical = found.critical_rad_per_s.first().copied();
        let [flutter, _] = flutter_onsets(found.bands, found.threshold_per_s);
        let flutter_speed = flutter.map(|onset| onset.speed_rad_per_s);
        let mut criteria = vec![
            self.of_margin(lowest_critical),
            self.of_operation(found, accuracy),
        ];
        criteria.extend(self.min_critical_rad_per_s.map(|asked| {
            let nowhere = "no critical speed was found".to_owned();
            at_least(
                "min_critical",
                "first critical speed",
                asked,
                lowest_critical,
                nowhere,
            )
        }));
        criteria.extend(self.min_flutter_rad_per_s.map(|asked| {
            let end = rpm(found.range_rad_per_s.to_rad_per_s);
            let nowhere = format!("none up to {end:.0} rpm, where the search ends");
            let criterion = at_least(
                "min_flutter",
                "flutter speed",
                asked,
                flutter_speed,
                nowhere,
            );
            if found.has_failed {
                return Criterion {
                    finding: "not determined: the search for bands failed".to_owned(),
                    found_rpm: None,
                    passed: false,
                    ..criterion
                };
            }
            if asked > found.covered_to_rad_per_s {
                return Criterion {
                    finding: "not certain: slots pass guides, which the model does not cover up to this speed".to_owned(),
                    passed: false,
                    ..criterion
                };
            }
            criterion
        }));
        criteria
    }

    /// Criterion of the ratio of the operating speed to the first critical speed.
    fn of_margin(&self, lowest_critical: Option<f64>) -> Criterion {
        let (operating, margin) = (self.operating_rad_per_s, self.margin);
        let asked = operating / margin;
        let finding = match lowest_critical {
            None => format!(
                "no critical speed was found to compare {} rpm with",
                typed_rpm(operating)
            ),
            Some(critical) => {
                let [share, _] = apart(1e2 * operating / critical, 1e2 * margin);
                format!(
                    "{} rpm is {share} % of the first critical speed ({:.0} rpm)",
                    typed_rpm(operating),
                    rpm(critical)
                )
            }
        };
        Criterion {
            key: "margin".to_owned(),
            name: format!("{} % rule", shown(1e2 * margin)),
            finding,
            found_rpm: lowest_critical.map(rpm),
            asked_rpm: rpm(asked),
            passed: lowest_critical.is_none_or(|found| found >= asked),
        }
    }

    /// Criterion of stability at the operating speed.
    fn of_operation(&self, found: &Evidence<'_>, accuracy: Accuracy) -> Criterion {
        let operating = self.operating_rad_per_s;
        let verdict = found.verdict(operating);
        let at = format!("{} rpm", typed_rpm(operating));
        let finding = match (verdict.state, verdict.stretch, verdict.undecided) {
            (StabilityState::TooClose, _, Some(edge)) => {
                let why = too_close(rpm(edge.speed), edge.error.map(rpm), accuracy);
                format!("too close to call at {at}: {why}")
            }
            (StabilityState::NotDetermined, ..) => format!("the search for bands failed at {at}"),
            (StabilityState::NotCovered, ..) => {
                format!(
                    "not certain at {at}: slots pass guides, which the model does not cover there"
                )
            }
            (StabilityState::OutsideSweep, ..) => format!("{at} is outside the sweep"),
            (StabilityState::Divergence, Some(range), _) => within(&at, "divergence", range),
            (StabilityState::Flutter, Some(range), _) => within(&at, "flutter", range),
            _ => format!("no instability at {at}"),
        };
        Criterion {
            key: "operating".to_owned(),
            name: "stability at the operating speed".to_owned(),
            finding,
            found_rpm: verdict.stretch.map(|range| rpm(range.from_rad_per_s)),
            asked_rpm: rpm(operating),
            passed: verdict.state == StabilityState::Stable,
        }
    }

    /// Criterion of the rim speed, with the rotation speed at which the rim reaches its limit.
    pub(super) fn of_rim(&self, rim_radius_m: f64) -> Criterion {
        let found = self.max_rim_m_per_s / rim_radius_m;
        let operating = self.operating_rad_per_s;
        let [now, most] = apart(operating * rim_radius_m, self.max_rim_m_per_s);
        Criterion {
            key: "rim_speed".to_owned(),
            name: format!("rim speed of at most {most} m/s"),
            finding: format!("{now} m/s at {} rpm", typed_rpm(operating)),
            found_rpm: Some(rpm(found)),
            asked_rpm: rpm(operating),
            passed: found >= operating,
        }
    }
}

/// Ratio between the amplitude near one edge of a band and the amplitude at the speed of largest growth.
const AT_AN_EDGE: f64 = std::f64::consts::SQRT_2;

impl Limits {
    /// Criterion of the amplitude of flutter, with the first band whose amplitude exceeds the limit; `None` without a
    /// limit.
    pub(crate) fn of_amplitude(
        &self,
        analysis: &Analysis,
        saturations: &[Rise],
    ) -> Option<Criterion> {
        let limit_m = self.max_amplitude_m?;
        let limit_mm = shown(1e3 * limit_m);
        let bands = analysis.chart.instabilities.iter().zip(saturations);
        let flutter = bands.filter(|(band, _)| band.kind == InstabilityKind::Flutter);
        // A band of unknown amplitude counts as exceeding the limit.
        let beyond = |(_, found): &(&Instability, &Rise)| match found {
            Ok(Some(found)) => AT_AN_EDGE * found.amplitude_m > limit_m,
            Ok(None) | Err(_) => true,
        };
        let first = flutter.filter(beyond).min_by(|x, y| {
            let onsets = [x, y].map(|(band, _)| band.from_rad_per_s);
            onsets[0].total_cmp(&onsets[1])
        });
        let finding = match first {
            None => format!(
                "no flutter rises above the limit up to {:.0} rpm, where the search ends",
                rpm(analysis.range_rad_per_s.to_rad_per_s)
            ),
            Some((band, Err(reason))) => format!(
                "not computed for flutter from {:.0} rpm on: {reason}",
                rpm(band.from_rad_per_s)
            ),
            Some((band, Ok(None))) => format!(
                "not known for flutter from {:.0} rpm on, which only damping causes",
                rpm(band.from_rad_per_s)
            ),
            Some((band, Ok(Some(found)))) => format!(
                "flutter from {:.0} rpm on rises to {} mm",
                rpm(band.from_rad_per_s),
                shown_to(3, 1e3 * AT_AN_EDGE * found.amplitude_m)
            ),
        };
        let found = first.map(|(band, _)| band.from_rad_per_s);
        let asked = self.operating_rad_per_s;
        Some(Criterion {
            key: "max_amplitude".to_owned(),
            name: format!("flutter of at most {limit_mm} mm up to the operating speed"),
            finding,
            found_rpm: found.map(rpm),
            asked_rpm: rpm(asked),
            passed: found.is_none_or(|found| found > asked),
        })
    }
}

impl Limits {
    /// Criterion of the deflection of the rim at the cut; `None` without a limit.
    pub(super) fn of_deviation(&self, found: &BoardDeviation) -> Option<Criterion> {
        let limit_m = self.max_deviation_m?;
        let is_kept = found.deflection_m.is_some_and(|found| found <= limit_m);
        let asked = self.operating_rad_per_s;
        Some(Criterion {
            key: "max_deviation".to_owned(),
            name: format!(
                "deflection of at most {} mm at the cut",
                shown(1e3 * limit_m)
            ),
            finding: found.in_words(),
            found_rpm: (!is_kept).then_some(rpm(asked)),
            asked_rpm: rpm(asked),
            passed: is_kept,
        })
    }
}

/// States that a speed is within a band.
fn within(speed: &str, kind: &str, range: SpeedRange) -> String {
    let [from, to] = range.ends().map(rpm);
    format!("{speed} lies within {kind} from {from:.0} to {to:.0} rpm")
}

/// A speed in rpm with six digits, so that the rounding error of conversion to rad/s and back is not visible.
fn typed_rpm(rad_per_s: f64) -> String {
    shown_to(6, rpm(rad_per_s))
}

/// Criterion of a lower limit of a speed. A speed that is not reached within the sweep exceeds every limit.
fn at_least(key: &str, name: &str, asked: f64, found: Option<f64>, nowhere: String) -> Criterion {
    let [found_rpm, asked_rpm] = apart(rpm(found.unwrap_or(asked)), rpm(asked));
    Criterion {
        key: key.to_owned(),
        name: format!("{name} of at least {asked_rpm} rpm"),
        finding: found.map_or(nowhere, |_| format!("{found_rpm} rpm")),
        found_rpm: found.map(rpm),
        asked_rpm: rpm(asked),
        passed: found.is_none_or(|found| found >= asked),
    }
}

/// Two numbers without decimals, or with as many as are needed to distinguish them.
fn apart(first: f64, second: f64) -> [String; 2] {
    let with = |decimals: usize| [first, second].map(|value| format!("{value:.decimals$}"));
    let mut different = (0..=MOST_DECIMALS)
        .map(with)
        .filter(|[one, other]| one != other);
    different.next().unwrap_or_else(|| with(0))
}

/// Largest number of decimals; smaller differences are rounding errors.
const MOST_DECIMALS: usize = 3;

/// A criterion that is not kept at any speed, because nothing restrains a rigid motion of the blade.
pub(super) fn without_stiffness(operating: f64) -> Criterion {
    Criterion {
        key: "held".to_owned(),
        name: "static stiffness".to_owned(),
        finding: "nothing holds the blade's rigid motions".to_owned(),
        found_rpm: None,
        asked_rpm: rpm(operating),
        passed: false,
    }
}

/// For every guide with a gap, the criterion that the lateral forces of the cut do not close it up to the operating
/// speed. The static deflection exists only below the first critical speed. Without lateral forces, or if nothing
/// restrains the blade, there is no criterion.
pub(super) fn of_gaps(
    scene: &Scene,
    plate: &Plate,
    bending: Option<&StaticDeflection>,
    operating: f64,
) -> Vec<Criterion> {
    let guides = scene.file().guides.iter().enumerate();
    let with_gap = guides.filter_map(|(index, guide)| Some((index, guide, guide.gap_m?)));
    with_gap
        .filter_map(|(index, guide, gap_m)| {
            let bending = bending?;
            let place = at_point(
                plate,
                Polar::new(guide.radius_m, guide.angle_deg.to_radians()),
            );
            bending.in_cut_m(&place, 0.0)?;
            let found = bending.fills_gap_at(&place, gap_m);
            Some(Criterion {
                key: "gap".to_owned(),
                name: format!("gap of guide {} ({:.0} µm)", index + 1, 1e6 * gap_m),
                finding: match found {
                    Some(speed) => format!("closes in the cut from {:.0} rpm on", rpm(speed)),
                    None => "remains open in the cut below the first critical speed".to_owned(),
                },
                found_rpm: found.map(rpm),
                asked_rpm: rpm(operating),
                passed: found.is_none_or(|found| found > operating),
            })
        })
        .collect()
}
