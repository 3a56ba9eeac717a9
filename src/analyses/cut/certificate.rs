//! Compares the growing modes of a cut with counts on the full model.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::analyses::campbell::MiscountedModes;
use crate::stability::GrowingModes;

/// Number of growing modes in the cut and without its forces, compared with counts on the full model.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "CutCertificateEntry")]
pub struct CutCertificate {
    /// The result in a sentence.
    pub statement: String,
    /// Number of modes that grow in the cut; a pair of conjugate eigenvalues counts as one.
    pub growing_modes: usize,
    /// Number of modes that grow without the forces.
    pub idle_growing_modes: usize,
    /// Number of counts on the full model with which the modes were compared, in the cut and without the
    /// forces.
    pub full_basis_counts: usize,
    /// For how many of the two the Krein index of an undamped saw fails; 0 is expected.
    pub krein_violations: usize,
    /// Modes that, according to the counts, are missing or superfluous; none are expected.
    pub miscounted_modes: Vec<MiscountedModes>,
}

impl CutCertificate {
    /// The comparison without the forces and in the cut.
    pub(super) fn new([idle, in_cut]: &[GrowingModes; 2]) -> Self {
        let states = [
            State {
                name: "in the cut",
                found: in_cut,
            },
            State {
                name: "without the forces",
                found: idle,
            },
        ];
        let sentences: Vec<String> = states.iter().map(State::sentence).collect();
        let miscounts = states.iter().flat_map(|state| &state.found.miscounts);
        CutCertificate {
            statement: sentences.join("; "),
            growing_modes: in_cut.modes,
            idle_growing_modes: idle.modes,
            full_basis_counts: idle.full_basis_counts + in_cut.full_basis_counts,
            krein_violations: states.iter().filter(|s| !s.found.matches_krein()).count(),
            miscounted_modes: miscounts.cloned().collect(),
        }
    }

    /// Whether every check agrees.
    pub fn is_clean(&self) -> bool {
        self.krein_violations == 0 && self.miscounted_modes.is_empty()
    }
}

/// The saw with or without the forces of the cut.
struct State<'a> {
    name: &'a str,
    found: &'a GrowingModes,
}

impl State<'_> {
    fn sentence(&self) -> String {
        let grows = match self.found.modes {
            0 => "no mode grows".to_owned(),
            1 => "1 mode grows".to_owned(),
            many => format!("{many} modes grow"),
        };
        format!("{} {grows} ({})", self.name, self.checks().join(", "))
    }

    fn checks(&self) -> Vec<String> {
        let mut checks = Vec::new();
        if let Some([stiffness, modes]) = self.found.krein {
            checks.push(if stiffness == modes {
                "Krein index matches".to_owned()
            } else {
                format!("Krein index {modes} does not match {stiffness} of the stiffness")
            });
        }
        for miscount in &self.found.miscounts {
            checks.push(format!(
                "miscounted on the full model: {}",
                miscount.in_words()
            ));
        }
        match self.found.full_basis_counts {
            _ if !self.found.miscounts.is_empty() => (),
            0 if checks.is_empty() => checks.push("not counted on the full model".to_owned()),
            0 => (),
            1 => checks.push("1 count on the full model agrees".to_owned()),
            many => checks.push(format!("{many} counts on the full model agree")),
        }
        checks
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::modes::Growing;

    #[test]
    fn the_sentence_says_what_agrees_and_what_does_not() {
        let found = GrowingModes {
            modes: 1,
            growing: Growing::of(&[faer::c64::new(3.0, 0.0)], 100.0, true),
            krein: Some([2, 2]),
            full_basis_counts: 5,
            miscounts: Vec::new(),
        };
        let says = |found: &GrowingModes| {
            let state = State {
                name: "in the cut",
                found,
            };
            state.sentence()
        };
        assert_eq!(
            says(&found),
            "in the cut 1 mode grows (Krein index matches, 5 counts on the full model agree)"
        );
        let wrong = GrowingModes {
            krein: Some([4, 2]),
            miscounts: vec![MiscountedModes {
                rpm: 955.0,
                from_hz: 10.0,
                to_hz: 12.0,
                missing: -2,
            }],
            ..found
        };
        assert_eq!(
            says(&wrong),
            "in the cut 1 mode grows (Krein index 2 does not match 4 of the stiffness, \
             miscounted on the full model: 2 too many between 10.0 and 12.0 Hz)"
        );
        assert_eq!(
            says(&GrowingModes::default()),
            "in the cut no mode grows (not counted on the full model)"
        );
    }
}
