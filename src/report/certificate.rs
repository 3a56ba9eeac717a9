//! What was checked of the list of bands, and what did not agree.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::scene::rpm;
use crate::stability::{Certificate, InstabilityKind, Mismatch};

/// The Krein index and the list of bands held against the spectrum, see [`crate::stability`].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CertificateEntry {
    /// What was found, in a sentence.
    pub statement: String,
    /// Speeds at which the index was compared; for damped scenes, which have none, speeds at
    /// which the number of growing modes was held against that of the bands.
    pub speeds_checked: usize,
    /// Speeds at which it did not match, not even on the whole basis; expected 0.
    pub krein_violations: usize,
    /// These speeds.
    pub violating_rpm: Vec<f64>,
    /// Where the list of bands contradicts the eigenvalues that the search or the chart found;
    /// expected none.
    pub mismatches: Vec<MismatchEntry>,
    /// Whether the search for bands ended at its limit of work, so that bands may be missing.
    pub gave_up: bool,
    /// Largest backward error of any mode shown.
    pub max_backward_error: f64,
}

/// A speed at which the list of bands contradicts the eigenvalues found there.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MismatchEntry {
    /// The speed.
    pub rpm: f64,
    /// Kind of the modes and bands compared.
    pub kind: InstabilityKind,
    /// Unstable modes of that kind found there; for divergence 1 or 0.
    pub unstable_modes: usize,
    /// Bands of that kind that cover the speed.
    pub bands: usize,
    /// Growth of the fastest of these modes.
    pub growth_per_s: f64,
    /// Largest growth that the bands list.
    pub peak_per_s: f64,
}

impl CertificateEntry {
    pub(super) fn new(
        certificate: &Certificate,
        is_undamped: bool,
        max_backward_error: f64,
    ) -> Self {
        CertificateEntry {
            statement: statement(certificate, is_undamped),
            speeds_checked: certificate.speeds_checked,
            krein_violations: certificate.violations_rad_per_s.len(),
            violating_rpm: certificate
                .violations_rad_per_s
                .iter()
                .map(|s| rpm(*s))
                .collect(),
            mismatches: certificate.mismatches.iter().map(Into::into).collect(),
            gave_up: certificate.gave_up,
            max_backward_error,
        }
    }

    /// Whether every check agrees.
    pub fn is_clean(&self) -> bool {
        self.krein_violations == 0 && self.mismatches.is_empty() && !self.gave_up
    }
}

impl From<&Mismatch> for MismatchEntry {
    fn from(mismatch: &Mismatch) -> Self {
        MismatchEntry {
            rpm: rpm(mismatch.speed_rad_per_s),
            kind: mismatch.kind,
            unstable_modes: mismatch.unstable_modes,
            bands: mismatch.bands,
            growth_per_s: mismatch.growth_per_s,
            peak_per_s: mismatch.peak_per_s,
        }
    }
}

/// The sentence that every face shows.
fn statement(certificate: &Certificate, is_undamped: bool) -> String {
    let checked = certificate.speeds_checked;
    let (matches, differs) = match is_undamped {
        true => ("Krein index matches", "Krein index does not match"),
        false => (
            "growing modes match the bands",
            "growing modes do not match the bands",
        ),
    };
    let contradicted = certificate.mismatches.iter().map(|m| m.speed_rad_per_s);
    let mut wrong = Vec::new();
    for (what, speeds) in [
        (differs, certificate.violations_rad_per_s.clone()),
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
    if certificate.gave_up {
        wrong.push(format!(
            "the search for bands ended at its limit of work, {checked} speeds"
        ));
    }
    match (wrong.is_empty(), checked) {
        (false, _) => wrong.join("; "),
        (true, 0) => "no speed was checked".to_owned(),
        (true, _) => format!("{matches} at {checked} of {checked} speeds"),
    }
}

/// "1200.0 rpm" or "1200.0 to 1300.0 rpm".
fn span(speeds_rad_per_s: &[f64]) -> String {
    let least = speeds_rad_per_s
        .iter()
        .copied()
        .fold(f64::INFINITY, f64::min);
    let most = speeds_rad_per_s.iter().copied().fold(0.0, f64::max);
    match least < most {
        true => format!("{:.1} to {:.1} rpm", rpm(least), rpm(most)),
        false => format!("{:.1} rpm", rpm(least)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::rad_per_s;

    #[test]
    fn everything_that_does_not_agree_is_in_the_sentence() {
        let clean = Certificate {
            speeds_checked: 567,
            ..Certificate::default()
        };
        let says = |certificate: &Certificate| statement(certificate, true);
        assert_eq!(says(&clean), "Krein index matches at 567 of 567 speeds");
        assert_eq!(
            statement(&clean, false),
            "growing modes match the bands at 567 of 567 speeds"
        );
        let wrong = Certificate {
            violations_rad_per_s: [1200.0, 1300.0].map(rad_per_s).to_vec(),
            mismatches: vec![Mismatch {
                speed_rad_per_s: rad_per_s(1400.0),
                kind: InstabilityKind::Flutter,
                unstable_modes: 1,
                bands: 0,
                growth_per_s: 2.0,
                peak_per_s: 0.0,
            }],
            gave_up: true,
            ..clean
        };
        assert_eq!(
            says(&wrong),
            "Krein index does not match at 2 of 567 speeds, 1200.0 to 1300.0 rpm; \
             the list of bands contradicts the eigenvalues at 1 of 567 speeds, 1400.0 rpm; \
             the search for bands ended at its limit of work, 567 speeds"
        );
        assert_eq!(says(&Certificate::default()), "no speed was checked");
    }
}
