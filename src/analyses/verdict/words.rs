//! Words that verdicts share.

use crate::model::scene::{Accuracy, rpm};
use crate::page::text::shown_to;
use crate::stability::{CRITICAL_MARGIN, FloquetGrowth};

/// Says that a speed is close to a critical speed.
pub(crate) fn near_critical(critical_rpm: f64) -> String {
    let margin = 100.0 * CRITICAL_MARGIN;
    format!("within {margin:.0} % of the critical speed {critical_rpm:.1} rpm")
}

/// States that the estimated error of the edge of a band leaves open whether a saw is stable, and the remedy.
pub(crate) fn too_close(edge_rpm: f64, error_rpm: Option<f64>, accuracy: Accuracy) -> String {
    let error = error_rpm.map_or("an error that is unknown".to_owned(), |error| {
        format!("an estimated error of {error:.2} rpm")
    });
    format!(
        "the edge of a band, {edge_rpm:.2} rpm, has {error}; {}",
        sharper(accuracy)
    )
}

/// The remedy for a result that is not accurate enough.
pub(crate) fn sharper(accuracy: Accuracy) -> &'static str {
    match accuracy {
        Accuracy::Draft => "use --accuracy design",
        Accuracy::Design => "use --accuracy reference",
        Accuracy::Reference => "give a smaller --tolerance",
    }
}

/// The growth of a slotted saw while its slots pass guides.
pub(super) fn by_floquet(growth: &FloquetGrowth) -> String {
    format!(
        "a vibration grows by {} ± {} 1/s at {} rpm while slots pass the guides, by Floquet multipliers",
        shown_to(3, growth.growth_per_s),
        shown_to(2, growth.error_per_s),
        typed_rpm(growth.speed_rad_per_s)
    )
}

/// A speed in rpm with six digits, so that the rounding error of conversion to rad/s and back is not visible.
pub(crate) fn typed_rpm(rad_per_s: f64) -> String {
    shown_to(6, rpm(rad_per_s))
}

/// Two numbers without decimals, or with as many as are needed to distinguish them.
pub(crate) fn apart(first: f64, second: f64) -> [String; 2] {
    let with = |decimals: usize| [first, second].map(|value| format!("{value:.decimals$}"));
    let mut different = (0..=MOST_DECIMALS)
        .map(with)
        .filter(|[one, other]| one != other);
    different.next().unwrap_or_else(|| with(0))
}

/// Largest number of decimals; smaller differences are rounding errors.
const MOST_DECIMALS: usize = 3;
