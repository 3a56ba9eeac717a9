//! Size of the basis of the deflection.

use super::radial::RadialBasis;
use crate::model::scene::{Accuracy, Blade, RefusedValue};

/// Size of the basis of the deflection.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Resolution {
    /// Largest number of nodal diameters n_max.
    pub max_diameters: usize,
    /// Number J of polynomials over the radius for each n; steps and kinks of the thickness add further
    /// functions.
    pub radial_functions: usize,
}

/// Largest number of nodal diameters, that of the slowest standing wave of a blade whose flange has 0.994 of its
/// diameter.
pub(crate) const MOST_DIAMETERS: usize = 300;
/// Largest number of radial functions; polynomials of more lose digits.
const MOST_FUNCTIONS: usize = 30;
/// Largest number of unknowns, which memory limits: that of the finest basis that a tolerance selects.
pub(crate) const MOST_UNKNOWNS: usize = 4230;

impl Resolution {
    /// A basis with a given number of radial functions of a blade, as reports state it: see
    /// [`Resolution::radial_functions_on`].
    ///
    /// # Errors
    /// [`RefusedValue`] if the basis is too small to bend, or larger than memory allows.
    pub fn new(
        max_diameters: usize,
        radial_functions: usize,
        blade: &Blade,
    ) -> Result<Self, RefusedValue> {
        let knots = RadialBasis::functions_at_knots(blade);
        let diameters = max_diameters.clamp(2, MOST_DIAMETERS);
        let most_radial = MOST_FUNCTIONS.min(MOST_UNKNOWNS / (2 * diameters + 1));
        let (least, most) = (2 + knots, most_radial + knots);
        if max_diameters == diameters && (least..=most).contains(&radial_functions) {
            return Ok(Resolution {
                max_diameters,
                radial_functions: radial_functions - knots,
            });
        }
        let given = format!("{max_diameters},{radial_functions}");
        let allowed = format!(
            "diameters 2 to {MOST_DIAMETERS} and, for {diameters} diameters of this blade, radial functions {least} to {most}"
        );
        let remedy = "16,8 is usual, and more functions for a thickness with steps";
        Err(RefusedValue::new("basis", given, allowed, remedy))
    }

    /// The basis of a named accuracy.
    pub fn of(accuracy: Accuracy) -> Self {
        let (max_diameters, radial_functions) = match accuracy {
            Accuracy::Draft => (8, 5),
            Accuracy::Design => (16, 8),
            Accuracy::Reference => (24, 12),
        };
        Resolution {
            max_diameters,
            radial_functions,
        }
    }

    /// Number of radial functions of a blade for each n: the polynomials, and the functions that steps and kinks of
    /// the thickness add.
    pub fn radial_functions_on(&self, blade: &Blade) -> usize {
        self.radial_functions + RadialBasis::functions_at_knots(blade)
    }

    /// Number of unknowns of a blade, with these functions.
    pub fn degrees_of_freedom_on(&self, blade: &Blade) -> usize {
        self.radial_functions_on(blade) * (2 * self.max_diameters + 1)
    }

    /// Number of unknowns of a blade of uniform thickness, J (2 n_max + 1).
    pub fn degrees_of_freedom(&self) -> usize {
        self.radial_functions * (2 * self.max_diameters + 1)
    }
}
