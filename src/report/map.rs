//! `map.json`: a grid of saws over one number and the speed, or over two numbers.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::map::{Along, Contour, Map, contours, state_at};
use crate::scene::{Quantity, SceneFile, rpm};
use crate::stability::{StabilityState, critical_at};
use crate::study::{Found, FoundBand, LogError, Rows, Saw};

/// Report of a map (`map.json`).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MapReport {
    /// Version of the program that wrote the report.
    pub sawflutter: String,
    /// The scene, as typed.
    pub scene: SceneFile,
    /// Whether the saw idles or is in its cut: "idling", or "in the cut at 2800 rpm (4 teeth)".
    #[serde(default)]
    pub condition: String,
    /// Numbers that no saw has, each with its key, the usual range, and the remedy.
    #[serde(default)]
    pub unusual_numbers: Vec<String>,
    /// The number along the horizontal axis.
    pub x: MapAxisEntry,
    /// The number along the vertical axis; null if that is the speed.
    pub y: Option<MapAxisEntry>,
    /// Speed at which each saw is judged; null if neither the scene nor the options have one.
    pub rpm: Option<f64>,
    /// Last speed of the sweep, the same for every saw; flutter beyond it is unknown.
    pub to_rpm: f64,
    /// Growth rate from which on a band counts as flutter.
    pub flutter_threshold_per_s: f64,
    /// The saws, row by row: x varies fastest.
    pub saws: Vec<MappedSawEntry>,
    /// Contours of a map over two numbers; empty for a map over the speed.
    pub contours: Vec<ContourEntry>,
    /// Largest estimated relative error of the critical speeds of any saw.
    pub largest_estimated_relative_error: f64,
    /// Number of saws with a speed at which the Krein index disagrees; 0 is expected.
    pub saws_with_krein_violations: usize,
    /// Remarks on the validity of the result.
    pub warnings: Vec<String>,
}

/// A number along an axis of a map.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MapAxisEntry {
    /// JSON path in the scene.
    pub path: String,
    /// Name of the number.
    pub name: String,
    /// Unit of the values; empty for a dimensionless number.
    pub unit: String,
    /// Values, ascending; on a logarithmic scale if the last is at least ten times the first.
    pub values: Vec<f64>,
    /// Value of the scene.
    pub of_scene: f64,
}

/// A saw of a map.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MappedSawEntry {
    /// Value of the number along the horizontal axis.
    pub x: f64,
    /// Value of the number along the vertical axis; null for a map over the speed.
    pub y: Option<f64>,
    /// Lowest critical speed; null if the blade has none.
    pub lowest_critical_rpm: Option<f64>,
    /// Flutter speed; null if no flutter counts within the sweep.
    pub flutter_speed_rpm: Option<f64>,
    /// Critical speeds within the sweep, ascending.
    pub critical_rpm: Vec<f64>,
    /// Bands of instability within the sweep, by onset.
    pub instabilities: Vec<FoundBand>,
    /// Whether the saw is stable at the speed at which the saws are judged; null without such a speed.
    pub state: Option<StabilityState>,
    /// Critical speed within 5 % of that speed; null if there is none.
    pub at_critical_rpm: Option<f64>,
    /// Reason for which the saw was not analysed; null if it was.
    pub not_analysed: Option<String>,
}

/// A quantity of which a map over two numbers has contours.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ContouredEntry {
    /// The flutter speed.
    FlutterSpeed,
    /// The lowest critical speed.
    LowestCriticalSpeed,
}

/// A line of equal speed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ContourEntry {
    /// Quantity that is constant along the line.
    pub quantity: ContouredEntry,
    /// Value of this quantity.
    pub rpm: f64,
    /// Points of the line: values of x and of y.
    pub points: Vec<[f64; 2]>,
}

impl MapReport {
    /// Reports the saws of a map from their logs.
    ///
    /// # Errors
    /// [`LogError`] where a log cannot be read.
    pub fn of_rows(map: &Map, rows: &Rows<'_>) -> Result<Self, LogError> {
        let mut saws = Vec::new();
        rows.each_block(&mut |block| {
            saws.extend_from_slice(block);
            Ok(())
        })?;
        Ok(Self::new(map, &saws))
    }

    /// Reports saws in the order of their numbers.
    pub fn new(map: &Map, saws: &[Saw]) -> Self {
        let scene = map.study().scene();
        let entries: Vec<MappedSawEntry> = saws.iter().map(|saw| saw_entry(map, saw)).collect();
        let found = || saws.iter().filter_map(Saw::found);
        let errors = found().map(|found| found.estimated_relative_error);
        MapReport {
            sawflutter: env!("CARGO_PKG_VERSION").to_owned(),
            scene: scene.file().clone(),
            condition: scene.condition(),
            unusual_numbers: scene.file().unusual_numbers(),
            x: MapAxisEntry::new(map.x()),
            y: map.y().map(MapAxisEntry::new),
            rpm: map.rpm(),
            to_rpm: rpm(map.study().to_rad_per_s()),
            flutter_threshold_per_s: scene.flutter_threshold_per_s(),
            contours: contour_entries(map, &entries),
            largest_estimated_relative_error: errors.fold(0.0, f64::max),
            saws_with_krein_violations: found().filter(|found| found.krein_violations > 0).count(),
            warnings: warnings(&entries),
            saws: entries,
        }
    }

    /// Rows of the saws, one for each value of y.
    pub fn rows(&self) -> std::slice::Chunks<'_, MappedSawEntry> {
        self.saws.chunks(self.x.values.len().max(1))
    }
}

impl MapAxisEntry {
    fn new(along: &Along) -> Self {
        let quantity = Quantity::of(&along.path);
        MapAxisEntry {
            name: quantity.map_or(along.path.clone(), |quantity| quantity.name.to_owned()),
            unit: quantity.map_or(String::new(), |quantity| quantity.unit.to_owned()),
            path: along.path.clone(),
            values: along.values.clone(),
            of_scene: along.of_scene,
        }
    }
}

fn saw_entry(map: &Map, saw: &Saw) -> MappedSawEntry {
    let columns = map.x().values.len();
    let none = Found::default();
    let found = saw.found().unwrap_or(&none);
    let state = map.rpm().filter(|_| saw.found().is_some());
    let to_rad_per_s = map.study().to_rad_per_s();
    let within = |speed_rpm: &f64| *speed_rpm <= rpm(to_rad_per_s);
    MappedSawEntry {
        x: map.x().values[saw.index % columns],
        y: map.y().map(|y| y.values[saw.index / columns]),
        lowest_critical_rpm: found.lowest_critical_rpm,
        flutter_speed_rpm: found.flutter_rpm,
        at_critical_rpm: state
            .and_then(|rpm| critical_at(&found.critical_rpm, rpm))
            .map(|place| found.critical_rpm[place]),
        critical_rpm: found.critical_rpm.iter().copied().filter(within).collect(),
        instabilities: found.bands.clone(),
        state: state.map(|rpm| state_at(&found.bands, rpm)),
        not_analysed: saw.outcome.reason().map(str::to_owned),
    }
}

fn contour_entries(map: &Map, saws: &[MappedSawEntry]) -> Vec<ContourEntry> {
    let Some(y) = map.y() else {
        return Vec::new();
    };
    let of = |quantity: ContouredEntry, speed: fn(&MappedSawEntry) -> Option<f64>| {
        let rows = saws.chunks(map.x().values.len());
        let rows: Vec<Vec<Option<f64>>> = rows.map(|row| row.iter().map(speed).collect()).collect();
        let lines = contours(&rows).into_iter();
        lines.map(move |Contour { rpm, places }| ContourEntry {
            quantity,
            rpm,
            points: places
                .iter()
                .map(|[column, row]| [map.x().at(*column), y.at(*row)])
                .collect(),
        })
    };
    let flutter = of(ContouredEntry::FlutterSpeed, |saw| saw.flutter_speed_rpm);
    let critical = of(ContouredEntry::LowestCriticalSpeed, |saw| {
        saw.lowest_critical_rpm
    });
    flutter.chain(critical).collect()
}

fn warnings(saws: &[MappedSawEntry]) -> Vec<String> {
    let mut lost = saws.iter().filter_map(|saw| saw.not_analysed.as_ref());
    let first = lost.next();
    let first = first.map(|reason| {
        format!(
            "{} of {} saws were not analysed and are blank; the first one: {reason}",
            1 + lost.count(),
            saws.len()
        )
    });
    first.into_iter().collect()
}
