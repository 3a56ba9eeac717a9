//! The checks of a diagram, and its accuracy.

use crate::analyses::campbell::certificate::interpolated;
use crate::analyses::campbell::slot_remarks::of_model;
use crate::analyses::campbell::{BandCertificate, Report};
use crate::page::outline::{Outline, PERCENT};
use crate::page::text::shown_to;

/// Remark on a scene without slots: nearly every production blade has some, and its critical speeds are lower.
const PLAIN_BLADE: &str = "Plain blade without slots: if the saw has some, give blade.slots, which lowers its critical speeds";

/// Adds the checks in one line and the estimated error; the certificate and the backward errors are details.
pub fn checks(text: &mut Outline, report: &Report) {
    let certificate = &report.certificate;
    text.sentence(format!("Checks: {}", in_one_line(certificate)));
    let hidden = certificate.unproven_growth_per_s;
    if hidden.is_some_and(|growth| growth > 0.0) {
        let operating = report.operating.as_ref();
        text.sentence(unproven(
            &certificate.unproven_counting_rpm,
            report.flutter_threshold_per_s,
            report.flutter_rpm,
            operating.map(|operating| operating.rpm),
        ));
    }
    let accuracy = &report.accuracy;
    if let Some(error) = accuracy.estimated_relative_error {
        text.sentence(format!(
            "Estimated error of the critical speeds{}: {}",
            of_model(&report.scene),
            PERCENT.digits(2, error).with_unit()
        ));
    }
    let blade = &report.scene.blade;
    let is_plain = blade.slots.is_none() && blade.wave_factors.is_empty();
    if blade.teeth.is_some_and(|teeth| teeth > 0) && is_plain {
        text.sentence(PLAIN_BLADE);
    }
    text.details(|text| {
        text.sentence(format!("Certificate: {}", certificate.statement));
        let listed = certificate.max_listed_backward_error.map_or(String::new(), |error| {
            format!("; of an eigenvalue listed: {error:.0e}")
        });
        text.sentence(format!(
            "Largest backward error of a mode: {:.0e}{listed}",
            certificate.max_backward_error
        ));
        text.sentence(format!(
            "{} functions, waves of up to {} nodal diameters; no wave with more stands still up to {:.0} rpm",
            accuracy.degrees_of_freedom, accuracy.max_diameters, accuracy.complete_to_rpm
        ));
    });
}

/// The checks and the proven share in one line; what disagrees, if anything does.
fn in_one_line(certificate: &BandCertificate) -> String {
    let agree = certificate.speeds_checked + certificate.full_basis_counts;
    if !certificate.is_clean() || agree == 0 {
        return certificate.statement.clone();
    }
    let proven = match certificate.proven_share {
        None => "; searched, not proven".to_owned(),
        Some(1.0) => "; proven for the whole sweep".to_owned(),
        Some(share) => format!(
            "; proven for {} % of the sweep",
            shown_to(4, (1e3 * share).floor() / 10.0)
        ),
    };
    let interpolated = interpolated(certificate.interpolated);
    let interpolated = interpolated.map_or(String::new(), |words| format!("; {words}"));
    format!("all {agree} independent checks agree{proven}{interpolated}")
}

/// States whether growth above the threshold is possible in unproven intervals of speed that matter for the
/// answer: below the flutter speed, or at the operating speed.
fn unproven(
    stretches_rpm: &[[f64; 2]],
    threshold_per_s: f64,
    flutter_rpm: Option<f64>,
    operating_rpm: Option<f64>,
) -> String {
    let matters = |[from, to]: &&[f64; 2]| {
        flutter_rpm.is_none_or(|flutter| *from < flutter)
            || operating_rpm.is_some_and(|rpm| (*from..=*to).contains(&rpm))
    };
    let mut stretches = stretches_rpm.iter().filter(matters);
    let Some([from, to]) = stretches.next() else {
        let place = match (flutter_rpm, operating_rpm) {
            (Some(_), Some(_)) => " below the flutter speed or at the operating speed",
            (Some(_), None) => " below the flutter speed",
            (None, _) => "",
        };
        return format!(
            "No other flutter of {threshold_per_s} 1/s is expected{place} in the rest of the sweep (an estimate, no proof)"
        );
    };
    let more = match stretches.count() {
        0 => String::new(),
        1 => " and in one more interval".to_owned(),
        count => format!(" and in {count} more intervals"),
    };
    format!(
        "Flutter of {threshold_per_s} 1/s or more may be hidden at {from:.1} to {to:.1} rpm{more} (an estimate)"
    )
}

#[cfg(test)]
mod tests {
    use super::unproven;

    #[test]
    fn unproven_growth_is_stated_where_it_would_change_an_answer() {
        let says = |stretches: &[[f64; 2]], flutter, operating| {
            let sentence = unproven(stretches, 0.25, flutter, operating);
            sentence.split(" (an estimate").next().unwrap().to_owned()
        };
        let stretches = [[1530.0, 1531.0], [2560.0, 2561.0]];
        assert_eq!(
            says(&stretches[1..], Some(2256.0), Some(1250.0)),
            "No other flutter of 0.25 1/s is expected below the flutter speed or at the operating speed in the rest of the sweep"
        );
        assert_eq!(
            says(&stretches, Some(2256.0), None),
            "Flutter of 0.25 1/s or more may be hidden at 1530.0 to 1531.0 rpm"
        );
        assert_eq!(
            says(&stretches[1..], Some(2256.0), Some(2560.5)),
            "Flutter of 0.25 1/s or more may be hidden at 2560.0 to 2561.0 rpm"
        );
        assert_eq!(
            says(&stretches, None, None),
            "Flutter of 0.25 1/s or more may be hidden at 1530.0 to 1531.0 rpm and in one more interval"
        );
        assert_eq!(
            says(&[], None, None),
            "No other flutter of 0.25 1/s is expected in the rest of the sweep"
        );
    }
}
