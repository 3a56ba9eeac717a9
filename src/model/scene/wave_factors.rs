//! Stiffness of the waves of a blade against a plain one, as measured or computed elsewhere.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::rule::refuse;
use super::{RefusedValue, SceneError};

/// Factors of the waves with a number of nodal diameters, relative to a plain blade of the same dimensions. Waves that are not listed
/// have the factors of the next listed ones with more diameters, and beyond these the smallest of all.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WaveFactorRow {
    /// Number of nodal diameters.
    pub nodal_diameters: u32,
    /// Factor of the bending stiffness: the square of the frequency at rest over that of the plain blade; of a split pair, of the lower
    /// one.
    pub bending: f64,
    /// Factor of the stiffening by rotation, which raises the square of the frequency in the frame of the blade with that of the speed. By
    /// default that of bending, which leaves critical speeds of slotted blades some 1 to 3 % too high.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rotation: Option<f64>,
    /// Distance of the two frequencies of a split pair at rest, relative to the lower one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub split: Option<f64>,
}

/// Validated factors of a number of nodal diameters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WaveFactor {
    /// Number of nodal diameters.
    pub diameters: usize,
    /// Factor of K_b.
    pub bending: f64,
    /// Factor of K_σ.
    pub rotation: f64,
    /// Distance of the frequencies of a pair, relative to the lower one.
    pub split: f64,
}

/// Largest number of rows.
const MAX_ROWS: usize = 16;

/// Validated factors, ascending in the number of nodal diameters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WaveFactors {
    /// Rows, of which the first `count` are in use.
    rows: [WaveFactor; MAX_ROWS],
    count: usize,
    /// Smallest factors of all, with more diameters than listed.
    beyond: WaveFactor,
}

impl WaveFactors {
    /// Validates the factors of a blade; `None` if there are none.
    pub(super) fn new(
        listed: &[WaveFactorRow],
        has_slots: bool,
        has_membrane: bool,
    ) -> Result<Option<Self>, SceneError> {
        let key = "blade.wave_factors";
        if listed.is_empty() {
            return Ok(None);
        }
        if listed.len() > MAX_ROWS {
            let allowed = format!("at most {MAX_ROWS} rows");
            let remedy = "waves of more diameters have the smallest factors listed";
            return Err(refuse(key, listed.len() as f64, allowed, remedy));
        }
        if has_slots {
            let allowed = "left out beside blade.slots, from which such factors are computed";
            let remedy =
                "leave out blade.slots to use these factors, or blade.wave_factors to compute them";
            return Err(RefusedValue::new(key, "given", allowed, remedy).into());
        }
        if has_membrane {
            let allowed = "left out beside blade.wave_factors: how heat, roll tension and residual stress act on such a blade is not known";
            let remedy =
                "leave out membrane; factors measured on a tensioned blade contain its tension";
            return Err(RefusedValue::new("membrane", "given", allowed, remedy).into());
        }
        for (k, row) in listed.iter().enumerate() {
            let n = row.nodal_diameters;
            if listed[..k].iter().any(|other| other.nodal_diameters == n) {
                let key = format!("{key}[{k}].nodal_diameters");
                let remedy = "give one row for each number of nodal diameters";
                return Err(refuse(&key, f64::from(n), "named once", remedy));
            }
        }
        let mut rows: Vec<WaveFactor> = listed.iter().map(WaveFactor::of).collect();
        rows.sort_by_key(|row| row.diameters);
        let smallest =
            |of: fn(&WaveFactor) -> f64| rows.iter().map(of).fold(f64::INFINITY, f64::min);
        let beyond = WaveFactor {
            diameters: rows[rows.len() - 1].diameters + 1,
            bending: smallest(|row| row.bending),
            rotation: smallest(|row| row.rotation),
            split: 0.0,
        };
        let count = rows.len();
        rows.resize(MAX_ROWS, beyond);
        Ok(Some(WaveFactors {
            rows: std::array::from_fn(|k| rows[k]),
            count,
            beyond,
        }))
    }

    /// The rows, ascending in the number of nodal diameters.
    pub fn rows(&self) -> &[WaveFactor] {
        &self.rows[..self.count]
    }

    /// The factors of a number of nodal diameters.
    pub fn of(&self, diameters: usize) -> &WaveFactor {
        let next = self.rows().iter().find(|row| row.diameters >= diameters);
        next.unwrap_or(&self.beyond)
    }

    /// Number of nodal diameters from which on the factors are the same for all.
    pub fn even_from(&self) -> usize {
        self.beyond.diameters
    }
}

impl WaveFactorRow {
    /// Whether these are the factors of a plain blade.
    pub(super) fn is_plain(&self) -> bool {
        let given = WaveFactor::of(self);
        given.bending == 1.0 && given.rotation == 1.0 && given.split == 0.0
    }
}

impl WaveFactor {
    fn of(typed: &WaveFactorRow) -> Self {
        WaveFactor {
            diameters: typed.nodal_diameters as usize,
            bending: typed.bending,
            rotation: typed.rotation.unwrap_or(typed.bending),
            split: typed.split.unwrap_or(0.0),
        }
    }
}
