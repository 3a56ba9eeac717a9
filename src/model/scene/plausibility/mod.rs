//! Finds numbers of a scene that no saw has, and the unit that they seem to be in.
//!
//! Each message names the key, its value, the usual range and the remedy. Such numbers are possible and are
//! computed, but the message precedes every verdict.

use std::f64::consts::{PI, TAU};

use super::SceneFile;
use super::entries::Entry;
use super::quantities::{QUANTITIES, typical_value};
use super::quantity::{Kind, Quantity, Typical};
use crate::page::text::{shown, shown_to};

/// Units that are used by mistake, each with its value in the unit of the quantity.
const MISTAKEN: [(&str, &str, f64); 15] = [
    ("m", "mm", 1e-3),
    ("m", "cm", 1e-2),
    ("m", "inches", 0.0254),
    ("kg", "g", 1e-3),
    ("kg/m³", "g/cm³", 1e3),
    ("kg/m³", "kg/mm³", 1e9),
    ("kg/m³", "t/mm³", 1e12),
    ("Pa", "GPa", 1e9),
    ("Pa", "MPa", 1e6),
    ("N/m", "N/mm", 1e3),
    ("rpm", "thousands of rpm", 1e3),
    ("rpm", "turns per second (Hz)", 60.0),
    ("W", "kW", 1e3),
    ("m/s", "m/min", 1.0 / 60.0),
    ("°", RADIANS, 180.0 / PI),
];
const RADIANS: &str = "radians";

/// Rim speeds of running saws: from dry cutting of steel by carbide to far above the limit of wood saws.
/// Slower cold saws exist, but critical speeds do not limit them.
const RIM_M_PER_S: (f64, f64) = (2.0, 300.0);
/// Rim speed of most saws for wood and stone.
const TYPICAL_RIM_M_PER_S: f64 = typical_value("operating_rpm");
/// Paths of the speeds at which a saw runs.
const RUNS: [&str; 3] = ["operating_rpm", "cut.chart_rpm", "cut.speeds[].rpm"];
/// Paths of the largest speeds of an analysis and of a measurement.
const ENDS: [&str; 3] = ["sweep.to_rpm", "runup.to_rpm", "measured.rows[].rpm"];

/// Usual step between angles.
const ANGLE_STEP_DEG: f64 = 5.0;
/// Smallest number of decimals: a number with fewer may be a round angle in radians by chance.
const MIN_DECIMALS: usize = 2;
/// Angles typed in degrees are multiples of this.
const TYPED_DEG: f64 = 0.25;
/// From this number of different angles on, it is suspicious that all are within 2π degrees of zero.
const MANY_ANGLES: usize = 3;

/// Usual range of a quantity.
struct Usual {
    from: f64,
    to: f64,
    typical: f64,
    /// The range as text.
    words: String,
}

/// A number that no saw has.
struct Unusual {
    path: String,
    value: f64,
    unit: &'static str,
    /// Reason for which the number is unusual.
    why: String,
    /// Another unit that the number may be in, and its value when converted from it.
    meant: Option<Meant>,
}

impl SceneFile {
    /// Messages about numbers that no saw has: one for each, and a single one for all that seem to be in the same
    /// other unit.
    pub fn unusual_numbers(&self) -> Vec<String> {
        let mut alike: Vec<Vec<Unusual>> = Vec::new();
        for one in out_of_range(self).into_iter().chain(in_radians(self)) {
            let unit = one.unit_meant();
            let known = |group: &&mut Vec<Unusual>| unit.is_some() && group[0].unit_meant() == unit;
            match alike.iter_mut().find(known) {
                Some(group) => group.push(one),
                None => alike.push(vec![one]),
            }
        }
        alike.iter().map(|group| together(group)).collect()
    }

    /// [`Self::unusual_numbers`] without the one that is refused, which the error describes.
    #[cfg(any(feature = "cli", feature = "page"))]
    pub(crate) fn unusual_numbers_beside(&self, refused: Option<&str>) -> Vec<String> {
        let begins = refused.map(|key| format!("{key} is "));
        let is_refused = |number: &String| {
            begins
                .as_ref()
                .is_some_and(|begins| number.starts_with(begins))
        };
        let mut numbers = self.unusual_numbers();
        numbers.retain(|number| !is_refused(number));
        numbers
    }
}

/// The message for a speed that is not part of the scene; `label` is its name, `path` that of its quantity.
pub fn unusual_number(scene: &SceneFile, label: &str, path: &str, value: f64) -> Option<String> {
    let usual = Usual::of(scene, Quantity::of(path)?);
    Some(
        usual
            .judged(label, value, Quantity::of(path)?.unit)?
            .sentence(),
    )
}

impl Quantity {
    /// Asks whether a number was meant in another unit, in which it is usual.
    pub(super) fn question_of_unit(&self, value: f64) -> Option<String> {
        let meant = Usual::of_quantity(self).meant(value, self.unit);
        meant.map(|meant| meant.question(self.unit))
    }
}

fn out_of_range(scene: &SceneFile) -> Vec<Unusual> {
    let rows = scene.measured.iter().flat_map(|measured| &measured.rows);
    let largest_rpm = rows.map(|row| row.rpm).fold(0.0, f64::max);
    let judged = |Entry { path, value }: Entry<f64>| {
        let quantity = Quantity::of(&path)?;
        // Only the largest measured speed is compared with the usual range: lower ones, down to rest, are usual.
        let is_slower = quantity.path == "measured.rows[].rpm" && value < largest_rpm;
        let usual = Usual::of(scene, quantity);
        (!is_slower).then(|| usual.judged(&path, value, quantity.unit))?
    };
    scene.numbers().into_iter().filter_map(judged).collect()
}

/// A number in the unit in which it was probably meant.
#[derive(Debug, Clone, Copy)]
struct Meant {
    /// The unit.
    unit: &'static str,
    /// The number converted from it.
    value: f64,
}

impl Usual {
    /// The usual range of a quantity for a saw of any size.
    fn of_quantity(quantity: &Quantity) -> Self {
        let (from, to) = quantity.usual;
        Usual {
            from,
            to,
            typical: (from * to).abs().sqrt(),
            words: match quantity.typical.filter(Typical::is_number) {
                Some(typical) => format!(
                    "{}, typically {}",
                    quantity.usual_in_words(),
                    shown(typical.value)
                ),
                None => quantity.usual_in_words(),
            },
        }
    }

    /// The usual range of a quantity for a saw of this size.
    fn of(scene: &SceneFile, quantity: &Quantity) -> Self {
        let (_, to) = quantity.usual;
        let (is_run, is_end) = (RUNS.contains(&quantity.path), ENDS.contains(&quantity.path));
        let diameter_m = scene.blade.outer_diameter_m;
        let is_known =
            Quantity::of("blade.outer_diameter_m").is_some_and(|q| q.is_usual(diameter_m));
        if !is_known || !(is_run || is_end) {
            return Self::of_quantity(quantity);
        }
        let rpm = |rim_m_per_s: f64| 60.0 * rim_m_per_s / (PI * diameter_m);
        let slowest = rpm(RIM_M_PER_S.0);
        let fastest = if is_run {
            to.min(rpm(RIM_M_PER_S.1))
        } else {
            to
        };
        let words = if is_run {
            format!("saws of this diameter run at {slowest:.0} to {fastest:.0} rpm")
        } else {
            format!("saws of this diameter run at {slowest:.0} rpm or more")
        };
        Usual {
            from: slowest,
            to: fastest,
            typical: rpm(TYPICAL_RIM_M_PER_S),
            words,
        }
    }

    fn has(&self, value: f64) -> bool {
        value == 0.0 || (self.from..=self.to).contains(&value)
    }

    fn judged(&self, path: &str, value: f64, unit: &'static str) -> Option<Unusual> {
        (!self.has(value)).then(|| Unusual {
            path: path.to_owned(),
            value,
            unit,
            why: self.words.clone(),
            meant: self.meant(value, unit),
        })
    }

    /// The number in the unit from which a conversion makes it usual. Of several units, the one whose converted value is
    /// nearest to the typical value is chosen.
    fn meant(&self, value: f64, unit: &str) -> Option<Meant> {
        // Zero is zero in any unit.
        let of_unit = MISTAKEN
            .iter()
            .filter(|(own, _, _)| *own == unit && value != 0.0);
        let meant = of_unit.map(|(_, other, factor)| Meant {
            unit: other,
            value: value * factor,
        });
        let usual = meant.filter(|meant| self.has(meant.value));
        let distance = |meant: &Meant| (meant.value / self.typical).ln().abs();
        usual.min_by(|x, y| distance(x).total_cmp(&distance(y)))
    }
}

impl Unusual {
    fn unit_meant(&self) -> Option<&'static str> {
        self.meant.map(|meant| meant.unit)
    }

    fn sentence(&self) -> String {
        let Unusual { path, why, .. } = self;
        let remedy = match &self.meant {
            Some(meant) => meant.question(self.unit),
            None => "is it in the unit that ends the key's name?".into(),
        };
        format!("{path} is {} ({why}); {remedy}", self.with_unit(self.value))
    }

    fn with_unit(&self, value: f64) -> String {
        with_unit(value, self.unit)
    }
}

impl Meant {
    /// The question to the user; `own` is the unit of the quantity.
    fn question(&self, own: &str) -> String {
        let Meant { unit, value } = self;
        format!("are these {unit}? That would be {}", with_unit(*value, own))
    }
}

fn with_unit(value: f64, unit: &str) -> String {
    let space = if matches!(unit, "" | "°") { "" } else { " " };
    // Seven digits hide the rounding error of a conversion of units.
    format!("{}{space}{unit}", shown_to(7, value))
}

/// Message about numbers that seem to be in the same other unit.
fn together(group: &[Unusual]) -> String {
    if let [one] = group {
        return one.sentence();
    }
    let each: Vec<String> = group
        .iter()
        .map(|one| {
            let meant_value = one.meant.map_or(one.value, |meant| meant.value);
            let (value, meant) = (shown(one.value), one.with_unit(meant_value));
            format!(
                "{} is {value} (that would be {meant}; {})",
                one.path, one.why
            )
        })
        .collect();
    let unit = group[0].unit_meant().unwrap_or_default();
    format!("these numbers look like {unit}: {}", each.join(", "))
}

/// Angles that seem to be in radians.
fn in_radians(scene: &SceneFile) -> Vec<Unusual> {
    let typed = scene.numbers();
    let of_path = |general: &str| -> Vec<Entry<f64>> {
        let own = typed.iter().filter(|entry| {
            entry.value != 0.0 && Quantity::of(&entry.path).is_some_and(|q| q.path == general)
        });
        own.cloned().collect()
    };
    // Their usual range includes every value, so that it does not reveal radians.
    let angles = QUANTITIES.iter().filter(|q| q.kind == Kind::Angle);
    let groups = angles.map(|quantity| of_path(quantity.path));
    let suspect = groups.filter(|group| seem_radians(group));
    let unusual = |Entry { path, value }: Entry<f64>| Unusual {
        path,
        value,
        unit: "°",
        why: "angles are rarely set to such a fraction of a degree".to_owned(),
        meant: Some(Meant {
            unit: RADIANS,
            value: (100.0 * value.to_degrees()).round() / 100.0,
        }),
    };
    suspect.flatten().map(unusual).collect()
}

/// Whether angles of one kind seem to be in radians: all are within one turn, none is a usual number of degrees,
/// and one is a round number of degrees when converted, or there are many different ones.
fn seem_radians(angles: &[Entry<f64>]) -> bool {
    let mut distinct: Vec<f64> = angles.iter().map(|angle| angle.value).collect();
    distinct.sort_by(f64::total_cmp);
    distinct.dedup();
    let is_many = distinct.len() >= MANY_ANGLES;
    distinct
        .iter()
        .all(|value| value.abs() <= TAU + 0.01 && (value / TYPED_DEG).fract() != 0.0)
        && (is_many || distinct.iter().any(|value| is_round_in_radians(*value)))
}

/// Whether a number equals, to its decimals, a round number of degrees in radians.
fn is_round_in_radians(value: f64) -> bool {
    let text = value.to_string();
    let decimals = text
        .split_once('.')
        .map_or(0, |(_, decimals)| decimals.len());
    let round_deg = ANGLE_STEP_DEG * (value.to_degrees() / ANGLE_STEP_DEG).round();
    let as_radians = format!("{:.decimals$}", round_deg.to_radians());
    decimals >= MIN_DECIMALS && as_radians == text
}

#[cfg(test)]
mod tests;
