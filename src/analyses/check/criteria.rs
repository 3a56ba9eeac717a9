//! Limits that need more than critical speeds and bands: amplitudes, deflections, and gaps of guides.

use faer::{Col, Scale};

use super::rim::point_load_plate;
use super::static_deflection::StaticDeflection;
use crate::analyses::board_deviation::BoardDeviation;
use crate::analyses::verdict::{Answer, Criterion, Judge, LimitSource, Verdict};
use crate::model::plate::Plate;
use crate::model::scene::{ForceCause, LimitsFile, Mount, Polar, Scene, rad_per_s, rpm};
use crate::motion::stretched_blade::Rise;
use crate::motion::transient::{at_point, lateral_load};
use crate::page::text::{shown, shown_to};
use crate::stability::{Analysis, Instability, InstabilityKind};

/// The verdict on an analysed saw at its operating speed, with the deflection at the cut there, and with the amplitudes of its bands if
/// they have a limit.
pub(crate) fn judged(
    analysis: &Analysis,
    limits: &LimitsFile,
    deviation: Option<&BoardDeviation>,
    operating: Option<f64>,
    amplitudes: &[Rise],
) -> Verdict {
    let critical = analysis.critical_rad_per_s();
    let scene = &analysis.scene;
    let judge = Judge {
        found: &analysis.evidence(&critical),
        limits,
        rim_radius_m: scene.blade().outer_radius_m,
        is_held: !analysis.model.has_free_motions(),
        accuracy: scene.accuracy(),
    };
    let mut further = Vec::new();
    if let Some(operating) = operating {
        further.extend(of_amplitude(limits, analysis, operating, amplitudes));
        further.extend(
            deviation
                .iter()
                .flat_map(|found| of_deflection(scene, &judge, found)),
        );
        further.extend(of_gaps(analysis, operating));
    }
    judge.verdict(operating, further)
}

/// Ratio between the amplitude near one edge of a band and the amplitude at the speed of largest growth.
const AT_AN_EDGE: f64 = std::f64::consts::SQRT_2;

/// Criterion of the amplitude of flutter, with the first band whose amplitude exceeds the limit; `None` without a
/// limit.
fn of_amplitude(
    limits: &LimitsFile,
    analysis: &Analysis,
    operating: f64,
    amplitudes: &[Rise],
) -> Option<Criterion> {
    let limit_m = limits.max_amplitude_m?;
    let limit_mm = shown(1e3 * limit_m);
    let bands = analysis.chart.instabilities.iter().enumerate();
    let bands = bands.map(|(index, band)| (band, amplitudes.get(index)));
    let flutter = bands.filter(|(band, _)| band.kind == InstabilityKind::Flutter);
    // A band of unknown amplitude counts as exceeding the limit.
    let beyond = |(_, found): &(&Instability, Option<&Rise>)| match found {
        Some(Ok(Some(found))) => AT_AN_EDGE * found.amplitude_m > limit_m,
        _ => true,
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
        Some((band, Some(Err(reason)))) => format!(
            "not computed for flutter from {:.0} rpm on: {reason}",
            rpm(band.from_rad_per_s)
        ),
        Some((band, None)) => format!(
            "not computed for flutter from {:.0} rpm on",
            rpm(band.from_rad_per_s)
        ),
        Some((band, Some(Ok(None)))) => format!(
            "not known for flutter from {:.0} rpm on, which only damping causes",
            rpm(band.from_rad_per_s)
        ),
        Some((band, Some(Ok(Some(found))))) => format!(
            "flutter from {:.0} rpm on rises to {} mm",
            rpm(band.from_rad_per_s),
            shown_to(3, 1e3 * AT_AN_EDGE * found.amplitude_m)
        ),
    };
    let found = first.map(|(band, _)| band.from_rad_per_s);
    let criterion = Criterion {
        key: "max_amplitude".to_owned(),
        name: format!("flutter of at most {limit_mm} mm up to the operating speed"),
        finding,
        found_rpm: found.map(rpm),
        asked_rpm: rpm(operating),
        source: LimitSource::User,
        answer: Answer::AtRisk,
    };
    let is_known = first.is_none_or(|(_, found)| matches!(found, Some(Ok(Some(_)))));
    let is_kept = found.is_none_or(|found| found > operating);
    Some(if is_kept || is_known {
        criterion.kept_if(is_kept)
    } else {
        criterion
    })
}

/// Criteria of the deflection of the rim at the cut.
pub(crate) fn of_deflection(
    scene: &Scene,
    judge: &Judge<'_>,
    found: &BoardDeviation,
) -> Vec<Criterion> {
    let limit = of_deviation(judge.limits, found.rpm, Some(found));
    let validity = of_validity(scene, judge, found);
    limit.into_iter().chain(validity).collect()
}

/// Criterion of the limit of this deflection at a speed in rpm; `None` without a limit.
pub(crate) fn of_deviation(
    limits: &LimitsFile,
    rpm: f64,
    found: Option<&BoardDeviation>,
) -> Option<Criterion> {
    let limit_m = limits.max_deviation_m?;
    let criterion = Criterion {
        key: "max_deviation".to_owned(),
        name: format!(
            "deflection of at most {} mm at the cut",
            shown(1e3 * limit_m)
        ),
        finding: found.map_or("not computed".to_owned(), BoardDeviation::in_words),
        found_rpm: None,
        asked_rpm: rpm,
        source: LimitSource::User,
        answer: Answer::AtRisk,
    };
    Some(match found.and_then(|found| found.deflection_m) {
        Some(found_m) => Criterion {
            found_rpm: (found_m > limit_m).then_some(rpm),
            ..criterion.kept_if(found_m <= limit_m)
        },
        None => criterion,
    })
}

/// Largest deflection of a blade without stretching that the linear model describes, in thicknesses.
const VALID_THICKNESSES: f64 = 0.5;

/// Criterion of a deflection at the cut beyond the linear model; `None` within it, for a force that is only assumed, for the stretched
/// blade between guides with gaps, and for a blade on a spline that tilts without stretching. A deflection that is unknown although the
/// blade has an equilibrium is far beyond this model.
fn of_validity(scene: &Scene, judge: &Judge<'_>, found: &BoardDeviation) -> Option<Criterion> {
    let limit_m = VALID_THICKNESSES * scene.blade().thickness_range_m()[0];
    let bends = matches!(scene.file().mount, Mount::Collar { .. });
    let is_linear = !found.by_contact && found.cause != ForceCause::Assumed;
    let is_beyond = match found.deflection_m {
        Some(found_m) => bends && found_m > limit_m,
        None => judge.has_equilibrium(rad_per_s(found.rpm)),
    };
    (is_linear && is_beyond).then(|| Criterion {
        key: "validity".to_owned(),
        name: "linear deflection of at most half a thickness".to_owned(),
        finding: found.in_words(),
        found_rpm: None,
        asked_rpm: found.rpm,
        source: LimitSource::Practice,
        answer: Answer::AtRisk,
    })
}

/// For every guide with a gap, the criterion that the lateral forces of the cut do not close it up to the operating
/// speed. The static deflection exists only below the first critical speed. Without lateral forces, or if nothing
/// restrains the blade, there is no criterion.
fn of_gaps(analysis: &Analysis, operating: f64) -> Vec<Criterion> {
    let scene = &analysis.scene;
    let guides = scene.file().guides.iter().enumerate();
    let with_gap: Vec<_> = guides
        .filter_map(|(index, guide)| Some((index, guide, guide.gap_m?)))
        .collect();
    let lowest = analysis.critical_rad_per_s().first().copied();
    let (false, Some(lowest)) = (with_gap.is_empty(), lowest) else {
        return Vec::new();
    };
    let plate = &point_load_plate(scene, analysis.model.plate.resolution);
    let bending = lateral(scene, plate, operating)
        .and_then(|load| StaticDeflection::new(plate, scene.cut_angle_rad(), Some(load), lowest));
    let Some(bending) = bending else {
        return Vec::new();
    };
    let entries = with_gap.into_iter().map(|(index, guide, gap_m)| {
        let place = at_point(
            plate,
            Polar::new(guide.radius_m, guide.angle_deg.to_radians()),
        );
        let found = bending.fills_gap_at(&place, gap_m);
        Criterion {
            key: "gap".to_owned(),
            name: format!("gap of guide {} ({:.0} µm)", index + 1, 1e6 * gap_m),
            finding: match found {
                Some(speed) => format!("closes in the cut from {:.0} rpm on", rpm(speed)),
                None => "remains open in the cut below the first critical speed".to_owned(),
            },
            found_rpm: found.map(rpm),
            asked_rpm: rpm(operating),
            source: LimitSource::Practice,
            answer: Answer::Yes,
        }
        .kept_if(found.is_none_or(|found| found > operating))
    });
    entries.collect()
}

/// The lateral forces of the cut at a speed; `None` without any.
pub(super) fn lateral(scene: &Scene, plate: &Plate, operating: f64) -> Option<Col<f64>> {
    let cut = scene.cut()?;
    let run = cut.at_rpm(rpm(operating)).ok()?;
    let load = lateral_load(plate, &cut.teeth.standing());
    (run.lateral_n != 0.0).then(|| Scale(run.lateral_n) * load)
}
