//! Checks of the list of bands, and disagreements that they found.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::model::scene::{SpeedRange, rpm};
use crate::stability::{
    Certificate, ContradictedBands, MiscountedModes, StabilityChart, has_failed,
};

/// Checks of the list of bands against the spectrum, by the Krein index, by counts of eigenvalues on the full
/// model and by the growth found at single speeds, and the share of the sweep that is proven to have no other
/// band. See [`crate::stability`].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "CertificateEntry")]
pub struct BandCertificate {
    /// The result in a sentence.
    pub statement: String,
    /// Number of speeds at which the Krein index was compared; for damped scenes, which have none, of speeds
    /// at which the number of growing modes was compared with that of the bands.
    pub speeds_checked: usize,
    /// Number of speeds at which the comparison failed; 0 is expected.
    pub krein_violations: usize,
    /// Speeds at which the comparison failed.
    pub violating_rpm: Vec<f64>,
    /// Number of counts of eigenvalues on the full model, independent of the reduced model, with which the
    /// modes were compared.
    pub full_basis_counts: usize,
    /// Number of further counts that were uncertain, because an eigenvalue lies on their path.
    pub uncertain_counts: usize,
    /// Modes that, according to these counts, are missing or superfluous; none are expected.
    pub miscounted_modes: Vec<MiscountedModes>,
    /// Whether modes were missing at first, so that the bands were searched again with more waves.
    pub searched_again: bool,
    /// Speeds at which the list of bands contradicts the eigenvalues of the search or of the diagram; none
    /// are expected.
    pub mismatches: Vec<ContradictedBands>,
    /// Whether the search for bands ended at its limit of work, so that bands may be missing.
    pub gave_up: bool,
    /// Number of ends of bands, and of speeds within them, that are interpolated, because no eigenvalue was found there; 0 is expected.
    #[serde(default)]
    pub interpolated: usize,
    /// Share of the sweep that is proven to have no unlisted instability, rounded down to four digits; absent
    /// if no proof was tried.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub proven_share: Option<f64>,
    /// The remaining intervals, which were searched but not proven: from and to.
    pub unproven_rpm: Vec<[f64; 2]>,
    /// Estimate, not proof, of the largest growth of an undetected band in the remaining intervals; absent if
    /// no proof was tried.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub unproven_growth_per_s: Option<f64>,
    /// Parts of the remaining intervals in which, by this estimate, the growth of an undetected band could
    /// reach the threshold: from and to.
    pub unproven_counting_rpm: Vec<[f64; 2]>,
    /// Largest backward error, on the full model, of the modes at rest, at three speeds of the diagram and at the peaks of the bands.
    pub max_backward_error: f64,
    /// Largest backward error, on the full model, of the listed eigenvalues: those of the modes at rest, at
    /// the peaks of the bands and at the operating speed. At reference accuracy these are refined on the full
    /// model. Absent otherwise, and if one of them could not be refined, as with loads at the rim.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max_listed_backward_error: Option<f64>,
}

impl BandCertificate {
    /// The certificate of a sweep over `range`.
    pub(super) fn new(
        chart: &StabilityChart,
        is_undamped: bool,
        range: SpeedRange,
        threshold_per_s: f64,
        max_backward_error: f64,
        max_listed_backward_error: Option<f64>,
    ) -> Self {
        let certificate = &chart.certificate;
        let violations = certificate.violations_rad_per_s.iter();
        let unproven = certificate.unproven_rad_per_s.iter().flatten();
        let proven_share = proven_share(certificate, range);
        let counting = chart.unproven_counting_rad_per_s(threshold_per_s);
        BandCertificate {
            statement: statement(certificate, is_undamped, proven_share),
            speeds_checked: certificate.speeds_checked,
            krein_violations: certificate.violations_rad_per_s.len(),
            violating_rpm: violations.map(|s| rpm(*s)).collect(),
            full_basis_counts: certificate.full_basis_counts,
            uncertain_counts: certificate.uncertain_counts,
            miscounted_modes: certificate.miscounts.clone(),
            searched_again: certificate.searched_again,
            mismatches: certificate.mismatches.clone(),
            gave_up: certificate.gave_up,
            interpolated: certificate.interpolated,
            proven_share,
            unproven_rpm: unproven.map(|range| range.ends().map(rpm)).collect(),
            unproven_growth_per_s: chart.unproven_growth_per_s(),
            unproven_counting_rpm: counting.iter().map(|range| range.ends().map(rpm)).collect(),
            max_backward_error,
            max_listed_backward_error,
        }
    }

    /// Whether the bands contradict the eigenvalues at so many speeds that they decide nothing.
    pub fn has_failed(&self) -> bool {
        let contradicted = self.krein_violations + self.mismatches.len();
        has_failed(contradicted, self.speeds_checked)
    }

    /// Whether no check disagrees.
    pub fn is_clean(&self) -> bool {
        self.krein_violations == 0
            && self.miscounted_modes.is_empty()
            && self.mismatches.is_empty()
            && !self.gave_up
    }
}

/// Share of the sweep outside the unproven intervals, rounded down.
fn proven_share(certificate: &Certificate, range: SpeedRange) -> Option<f64> {
    let unproven = certificate.unproven_rad_per_s.as_ref()?;
    let open: f64 = unproven.iter().map(SpeedRange::width).sum();
    let share = 1.0 - open / range.width();
    (range.width() > 0.0).then(|| (1e4 * share.clamp(0.0, 1.0)).floor() / 1e4)
}

/// The statement shown in every output.
pub(crate) fn statement(
    certificate: &Certificate,
    is_undamped: bool,
    proven_share: Option<f64>,
) -> String {
    let wrong = contradictions(certificate, is_undamped);
    if !wrong.is_empty() {
        return wrong.join("; ");
    }
    let checked = certificate.speeds_checked;
    let mut agree = Vec::new();
    if checked > 0 {
        agree.push(if is_undamped {
            format!("Krein index matches at {checked} of {checked} speeds")
        } else {
            format!("growing modes match the bands at {checked} of {checked} speeds")
        });
    }
    let (certain, uncertain) = (certificate.full_basis_counts, certificate.uncertain_counts);
    let tried = certain + uncertain;
    match (certain, uncertain) {
        (0, 0) => (),
        (0, _) => agree.push(format!(
            "none of {tried} counts on the full model was certain"
        )),
        (_, 0) => agree.push(format!("{certain} counts on the full model agree")),
        _ => agree.push(format!(
            "{certain} of {tried} counts on the full model were certain and agree"
        )),
    }
    match proven_share {
        None if agree.is_empty() => (),
        None => agree.push("searched, not proven".to_owned()),
        Some(1.0) => agree.push("the whole sweep is proven free of unlisted bands".to_owned()),
        Some(share) => agree.push(format!(
            "{} % of the sweep proven free of unlisted bands",
            (1e3 * share).floor() / 10.0
        )),
    }
    if certificate.searched_again {
        agree.push("after a second search with more waves".to_owned());
    }
    agree.extend(interpolated(certificate.interpolated));
    if agree.is_empty() {
        "no speed was checked".to_owned()
    } else {
        agree.join(", ")
    }
}

/// States how many ends and values of bands are interpolated; `None` if none is.
pub(super) fn interpolated(count: usize) -> Option<String> {
    let are = match count {
        0 => return None,
        1 => "1 end or value of a band is",
        _ => return Some(format!("{count} ends or values of bands are interpolated")),
    };
    Some(format!("{are} interpolated"))
}

/// Descriptions of all disagreements.
fn contradictions(certificate: &Certificate, is_undamped: bool) -> Vec<String> {
    let checked = certificate.speeds_checked;
    let differs = if is_undamped {
        "Krein index does not match"
    } else {
        "growing modes do not match the bands"
    };
    let violations = certificate.violations_rad_per_s.iter().copied().map(rpm);
    let contradicted = certificate.mismatches.iter().map(|m| m.rpm);
    let mut wrong = Vec::new();
    for (what, speeds) in [
        (differs, violations.collect::<Vec<f64>>()),
        (
            "the list of bands contradicts the eigenvalues",
            contradicted.collect(),
        ),
    ] {
        if !speeds.is_empty() {
            let count = speeds.len();
            wrong.push(format!(
                "{what} at {count} of {checked} speeds, {}",
                span(&speeds)
            ));
        }
    }
    if let Some(first) = certificate.miscounts.first() {
        let speeds: Vec<f64> = certificate.miscounts.iter().map(|m| m.rpm).collect();
        wrong.push(format!(
            "modes are miscounted on the full model at {}: {} at {:.1} rpm",
            span(&speeds),
            first.in_words(),
            first.rpm
        ));
    }
    if certificate.gave_up {
        wrong.push(format!(
            "the search for bands ended at its limit of work, {checked} speeds"
        ));
    }
    wrong
}

/// Text such as "1200.0 rpm" or "1200.0 to 1300.0 rpm".
fn span(speeds_rpm: &[f64]) -> String {
    let least = speeds_rpm.iter().copied().fold(f64::INFINITY, f64::min);
    let most = speeds_rpm.iter().copied().fold(0.0, f64::max);
    if least < most {
        format!("{least:.1} to {most:.1} rpm")
    } else {
        format!("{least:.1} rpm")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::scene::rad_per_s;
    use crate::stability::InstabilityKind;

    /// A certificate in which every check disagrees.
    fn contradicted(clean: Certificate) -> Certificate {
        Certificate {
            violations_rad_per_s: [1200.0, 1300.0].map(rad_per_s).to_vec(),
            mismatches: vec![ContradictedBands {
                rpm: 1400.0,
                kind: InstabilityKind::Flutter,
                unstable_modes: 1,
                bands: 0,
                growth_per_s: 2.0,
                peak_per_s: 0.0,
            }],
            gave_up: true,
            miscounts: vec![MiscountedModes {
                rpm: 1500.0,
                from_hz: 10.0,
                to_hz: 12.0,
                missing: 1,
            }],
            ..clean
        }
    }

    #[test]
    fn everything_that_does_not_agree_is_in_the_sentence() {
        let clean = Certificate {
            speeds_checked: 567,
            ..Certificate::default()
        };
        let says = |certificate: &Certificate| statement(certificate, true, None);
        assert_eq!(
            says(&clean),
            "Krein index matches at 567 of 567 speeds, searched, not proven"
        );
        assert_eq!(
            statement(&clean, false, None),
            "growing modes match the bands at 567 of 567 speeds, searched, not proven"
        );
        let counted = Certificate {
            full_basis_counts: 143,
            unproven_rad_per_s: Some(vec![SpeedRange::new(2.0, 3.0), SpeedRange::new(5.0, 5.5)]),
            ..clean.clone()
        };
        let share = proven_share(&counted, SpeedRange::new(0.0, 400.0));
        assert_eq!(share, Some(0.9962));
        assert_eq!(
            statement(&counted, true, share),
            "Krein index matches at 567 of 567 speeds, 143 counts on the full model agree, \
             99.6 % of the sweep proven free of unlisted bands"
        );
        let whole = proven_share(
            &Certificate {
                unproven_rad_per_s: Some(Vec::new()),
                ..clean.clone()
            },
            SpeedRange::new(0.0, 400.0),
        );
        assert!(
            statement(&clean, true, whole)
                .ends_with("the whole sweep is proven free of unlisted bands")
        );
        let with_counts = |full_basis_counts, uncertain_counts| {
            let counted = Certificate {
                full_basis_counts,
                uncertain_counts,
                ..Certificate::default()
            };
            statement(&counted, false, None)
        };
        assert_eq!(
            with_counts(0, 4),
            "none of 4 counts on the full model was certain, searched, not proven"
        );
        assert_eq!(
            with_counts(3, 1),
            "3 of 4 counts on the full model were certain and agree, searched, not proven"
        );
        let wrong = contradicted(clean);
        assert_eq!(
            says(&wrong),
            "Krein index does not match at 2 of 567 speeds, 1200.0 to 1300.0 rpm; \
             the list of bands contradicts the eigenvalues at 1 of 567 speeds, 1400.0 rpm; \
             modes are miscounted on the full model at 1500.0 rpm: 1 missing between 10.0 and 12.0 Hz at 1500.0 rpm; \
             the search for bands ended at its limit of work, 567 speeds"
        );
        assert_eq!(says(&Certificate::default()), "no speed was checked");
    }
}
