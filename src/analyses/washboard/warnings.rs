//! Remarks on the validity of the result.

use std::f64::consts::TAU;

use super::basis::Motions;
use super::report::WashboardReport;
use crate::model::scene::{SceneFile, unusual_number};
use crate::page::text::shown_to;

/// Unusual numbers of the scene, and of a speed of the cut that it does not list.
pub(super) fn unusual_numbers(scene: &SceneFile, rpm: f64) -> Vec<String> {
    let is_asked = scene.operating_rpm != Some(rpm);
    let asked =
        is_asked.then(|| unusual_number(scene, "the speed of the cut", "operating_rpm", rpm));
    let numbers = scene.unusual_numbers().into_iter();
    numbers.chain(asked.flatten()).collect()
}

/// All remarks on a report that has none yet.
pub(super) fn warnings(
    report: &WashboardReport,
    motions: &Motions,
    safe_beyond_n_per_m: f64,
) -> Vec<String> {
    let all = [
        without_delay(report),
        on_the_axis(report),
        unlisted(report),
        beyond(report, motions, safe_beyond_n_per_m),
        unconfirmed(report),
        without_pitch(report),
    ];
    all.into_iter().flatten().collect()
}

fn without_delay(report: &WashboardReport) -> Option<String> {
    (report.growing_eigenvalues_without > 0).then(|| {
        format!(
            "at {:.0} rpm the saw in the cut is unstable without the delayed force; an analysis of the cut shows why",
            report.rpm
        )
    })
}

fn on_the_axis(report: &WashboardReport) -> Option<String> {
    report.growing_eigenvalues.is_none().then(|| {
        "a vibration neither grows nor decays within rounding: the side of the boundary is undetermined, and the saw is called unstable".to_owned()
    })
}

fn unlisted(report: &WashboardReport) -> Option<String> {
    let growing = report.modes.iter().filter(|mode| mode.growth_per_s > 0.0);
    let listed: usize = growing
        .map(|m| if m.frequency_hz > 0.0 { 2 } else { 1 })
        .sum();
    let count = report.growing_eigenvalues?;
    (count != listed).then(|| {
        format!(
            "the argument principle counts {count} growing eigenvalues, but {listed} were found: the list of modes is incomplete"
        )
    })
}

fn beyond(report: &WashboardReport, motions: &Motions, safe_beyond_n_per_m: f64) -> Option<String> {
    let complete_hz = report.complete_to_hz;
    if motions.complete_to_rad_per_s < motions.needed_to_rad_per_s {
        return Some(format!(
            "only modes up to {complete_hz:.0} Hz are included, as many as possible, but teeth drive modes up to {:.0} Hz: their stability is not known",
            motions.needed_to_rad_per_s / TAU
        ));
    }
    (report.stiffness_n_per_m > safe_beyond_n_per_m).then(|| {
        format!(
            "modes above {complete_hz:.0} Hz are not included; their damping prevents growth up to {} N/m",
            shown_to(3, safe_beyond_n_per_m)
        )
    })
}

fn unconfirmed(report: &WashboardReport) -> Option<String> {
    let confirmed = &report.lobes.confirmed;
    let count = confirmed.iter().filter(|confirmed| !**confirmed).count();
    (count > 0).then(|| {
        format!(
            "at {count} of {} speeds of the diagram the argument principle does not confirm that nothing grows below the boundary",
            confirmed.len()
        )
    })
}

fn without_pitch(report: &WashboardReport) -> Option<String> {
    if report.delays_s.len() > 1 {
        return Some(
            "unevenly spaced teeth leave no pattern of a single pitch, so none is given".to_owned(),
        );
    }
    report.feed_m_per_s.is_none().then(|| {
        "without cut.feed_m_per_s the pitch of the pattern on the board is not known".to_owned()
    })
}
