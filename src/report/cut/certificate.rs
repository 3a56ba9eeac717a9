//! Compares the growing modes of a cut with counts on the full model.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::report::MiscountEntry;
use crate::stability::GrowingModes;
use crate::transient::CutHistory;

/// How many modes grow in the cut and without its forces, and what counts on the full model say of that.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CutCertificateEntry {
    /// What was found, in a sentence.
    pub statement: String,
    /// Modes that grow in the cut; a pair of conjugate eigenvalues is one.
    pub growing_modes: usize,
    /// Modes that grow without the forces.
    pub idle_growing_modes: usize,
    /// Counts on the full model that the modes were held against, in the cut and without the forces.
    pub full_basis_counts: usize,
    /// In how many of the two the Krein index of an undamped saw does not match; expected 0.
    pub krein_violations: usize,
    /// Modes that the counts say are missing, or too many; expected none.
    pub miscounted_modes: Vec<MiscountEntry>,
    /// In how many of the two the fastest of these modes does not grow as the criteria say; expected 0.
    pub differing_growths: usize,
}

/// Relative tolerance, besides rounding, between growth rates that two methods give for one eigenvalue.
const ALIKE: f64 = 1e-5;
const ROUNDING_PER_S: f64 = 1e-5;

impl CutCertificateEntry {
    pub(super) fn new(history: &CutHistory) -> Self {
        let [idle, in_cut] = &history.growing;
        let states = [
            State {
                name: "in the cut",
                found: in_cut,
                reported_per_s: history.in_cut.growth_per_s,
            },
            State {
                name: "without the forces",
                found: idle,
                reported_per_s: history.idle.growth_per_s,
            },
        ];
        let sentences: Vec<String> = states.iter().map(State::sentence).collect();
        let miscounts = states.iter().flat_map(|state| &state.found.miscounts);
        CutCertificateEntry {
            statement: sentences.join("; "),
            growing_modes: in_cut.modes,
            idle_growing_modes: idle.modes,
            full_basis_counts: idle.full_basis_counts + in_cut.full_basis_counts,
            krein_violations: states.iter().filter(|s| !s.found.matches_krein()).count(),
            miscounted_modes: miscounts.map(Into::into).collect(),
            differing_growths: states.iter().filter(|s| s.differs()).count(),
        }
    }

    /// Whether no check disagrees.
    pub fn is_clean(&self) -> bool {
        self.krein_violations == 0
            && self.miscounted_modes.is_empty()
            && self.differing_growths == 0
    }
}

/// The saw with or without the forces of the cut.
struct State<'a> {
    name: &'a str,
    found: &'a GrowingModes,
    /// Largest growth used by the criteria.
    reported_per_s: f64,
}

impl State<'_> {
    fn differs(&self) -> bool {
        let [found, reported] = [self.found.growth_per_s.unwrap_or(0.0), self.reported_per_s];
        // A motion that decays faster than all examined modes has no reported growth; zero is used.
        let reported = reported.max(0.0);
        (found - reported).abs() > ALIKE * reported + ROUNDING_PER_S
    }

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
            checks.push(match stiffness == modes {
                true => "Krein index matches".to_owned(),
                false => format!("Krein index {modes} does not match {stiffness} of the stiffness"),
            });
        }
        for miscount in self.found.miscounts.iter().map(MiscountEntry::from) {
            checks.push(format!(
                "miscounted on the full model: {}",
                miscount.in_words()
            ));
        }
        if self.differs() {
            let [found, reported] = [self.found.growth_per_s.unwrap_or(0.0), self.reported_per_s];
            checks.push(format!(
                "the fastest grows by {found:.4} 1/s, the criteria go by {reported:.4} 1/s"
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
    use std::f64::consts::TAU;

    use super::*;
    use crate::stability::Miscount;

    #[test]
    fn the_sentence_says_what_agrees_and_what_does_not() {
        let found = GrowingModes {
            modes: 1,
            growth_per_s: Some(3.0),
            krein: Some([2, 2]),
            full_basis_counts: 5,
            miscounts: Vec::new(),
        };
        let says = |found: &GrowingModes, reported_per_s: f64| {
            let state = State {
                name: "in the cut",
                found,
                reported_per_s,
            };
            state.sentence()
        };
        assert_eq!(
            says(&found, 3.0),
            "in the cut 1 mode grows (Krein index matches, 5 counts on the full model agree)"
        );
        let wrong = GrowingModes {
            krein: Some([4, 2]),
            miscounts: vec![Miscount {
                speed_rad_per_s: 100.0,
                from_rad_per_s: 10.0 * TAU,
                to_rad_per_s: 12.0 * TAU,
                missing: -2,
            }],
            ..found
        };
        assert_eq!(
            says(&wrong, 4.0),
            "in the cut 1 mode grows (Krein index 2 does not match 4 of the stiffness, \
             miscounted on the full model: 2 too many between 10.0 and 12.0 Hz, \
             the fastest grows by 3.0000 1/s, the criteria go by 4.0000 1/s)"
        );
        assert_eq!(
            says(&GrowingModes::default(), -0.5),
            "in the cut no mode grows (not counted on the full model)"
        );
    }
}
