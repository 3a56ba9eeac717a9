//! Checks of a study's file.

use super::distribution::Distribution;
use super::file::{GapFile, StudyError, StudyFile, StudyLimits};
use super::sequence::DIMENSIONS;
use crate::analyses::check::Limits;
use crate::analyses::gap::{self, GapCase};
use crate::model::scene::{Given, Parameter, RefusedValue, Scene, SceneError, SceneFile};

/// Largest number of saws; their log has a size of about 600 GB.
const MAX_SAWS: usize = u32::MAX as usize;
/// Largest number of quantiles in a report.
const MAX_QUANTILES: usize = 100;
/// Range of the confidence: at a lower one an interval has no meaning, for a higher one a study has too few saws.
const CONFIDENCE: (f64, f64) = (0.5, 0.999_999);

fn refuse(
    key: impl Into<String>,
    value: impl Given,
    allowed: impl Into<String>,
    remedy: &'static str,
) -> StudyError {
    RefusedValue::new(key, value, allowed, remedy).into()
}

/// Path of the speed at which saws are judged.
const OPERATING_SPEED: &str = "operating_rpm";

/// Refuses the operating speed as a number that varies: it changes no band, and every saw is judged at the same one.
///
/// # Errors
/// [`RefusedValue`] for the key or option `key`.
pub(crate) fn check_varies(key: &str, path: &str) -> Result<(), RefusedValue> {
    if path != OPERATING_SPEED {
        return Ok(());
    }
    let allowed = "a number that changes critical speeds or bands";
    let remedy = "name another one; a map over one number has the speed as its vertical axis";
    Err(RefusedValue::new(key, OPERATING_SPEED, allowed, remedy))
}

/// A number that varies.
#[derive(Debug, Clone)]
pub(super) struct Varying {
    pub parameter: Parameter,
    pub distribution: Distribution,
}

pub(super) fn varying(scene: &SceneFile, file: &StudyFile) -> Result<Vec<Varying>, StudyError> {
    if file.parameters.is_empty() {
        let allowed = "a list of the numbers that vary";
        let remedy = "name one, like blade.thickness_m; a single saw is analysed without a study";
        return Err(refuse("parameters", "an empty list", allowed, remedy));
    }
    let mut varying: Vec<Varying> = Vec::new();
    for (k, entry) in file.parameters.iter().enumerate() {
        let parameter = Parameter::new(&entry.path);
        let key = format!("parameters[{k}].path");
        if varying.iter().any(|other| other.parameter == parameter) {
            let value = format!("{:?} again", entry.path);
            let remedy = "a number varies in one way";
            return Err(refuse(key, value, "named once", remedy));
        }
        let unusable = |source| StudyError::Scene {
            key: key.clone(),
            source,
        };
        check_varies(&key, &entry.path)?;
        let nominal = parameter.get(scene).map_err(unusable)?;
        // This step refuses counts, which do not vary.
        scene.with(&[(&parameter, nominal)]).map_err(unusable)?;
        let distribution_key = format!("parameters[{k}].distribution");
        let distribution = Distribution::new(&entry.distribution, nominal, &distribution_key)?;
        varying.push(Varying {
            parameter,
            distribution,
        });
    }
    Ok(varying)
}

/// Numbers of saws.
pub(super) struct Counts {
    /// Saws in each point of the grid.
    pub drawn: usize,
    /// All saws.
    pub count: usize,
}

pub(super) fn counts(file: &StudyFile, varying: &[Varying]) -> Result<Counts, StudyError> {
    let grids = varying.iter().filter_map(|one| match &one.distribution {
        Distribution::Grid(values) => Some(values.len()),
        _ => None,
    });
    let points = grids.clone().fold(1, usize::saturating_mul);
    let dimensions = varying.len() - grids.count();
    let drawn = match (file.saws, dimensions) {
        (None, 0) => 1,
        (Some(saws), 0) => {
            let remedy = "leave it out: the grids alone determine the saws";
            return Err(refuse("saws", saws, "left out of a study of grids", remedy));
        }
        (Some(saws), 1..=DIMENSIONS) if saws > 0 => saws as usize,
        (saws, 1..=DIMENSIONS) => {
            let value = saws.map_or("missing".into(), |saws| saws.to_string());
            let allowed = format!("between 1 and {}", u32::MAX);
            let remedy = "1024 give a probability of passing to 3 %, 4096 to 1.5 %";
            return Err(refuse("saws", value, allowed, remedy));
        }
        _ => {
            let allowed = format!("at most {DIMENSIONS} numbers with a distribution");
            let value = format!("a list with {dimensions} of them");
            let remedy = "leave those out to which critical speeds and onsets are least sensitive";
            return Err(refuse("parameters", value, allowed, remedy));
        }
    };
    match drawn.saturating_mul(points) {
        count if count <= MAX_SAWS => Ok(Counts { drawn, count }),
        count => {
            let allowed = format!("of at most {MAX_SAWS} saws in all");
            let remedy = "take fewer saws, or a coarser grid";
            Err(refuse(
                "the study",
                format!("one of {count} saws"),
                allowed,
                remedy,
            ))
        }
    }
}

pub(super) fn check_statistics(file: &StudyFile) -> Result<(), StudyError> {
    if file.quantiles.len() > MAX_QUANTILES {
        let value = format!("a list of {}", file.quantiles.len());
        let allowed = format!("a list of at most {MAX_QUANTILES}");
        return Err(refuse(
            "quantiles",
            value,
            allowed,
            "study.csv has every saw",
        ));
    }
    if let Some(k) = (file.quantiles.iter()).position(|share| !(0.0..=1.0).contains(share)) {
        let key = format!("quantiles[{k}]");
        let remedy = "give it as a share: 0.05 for 5 %";
        return Err(refuse(key, file.quantiles[k], "between 0 and 1", remedy));
    }
    if !(CONFIDENCE.0..=CONFIDENCE.1).contains(&file.confidence) {
        let allowed = format!("between {} and {}", CONFIDENCE.0, CONFIDENCE.1);
        let remedy = "0.95 is usual";
        return Err(refuse("confidence", file.confidence, allowed, remedy));
    }
    Ok(())
}

/// Validates the block `limits` of the study.
pub(super) fn limits(file: &StudyLimits, scene: &Scene) -> Result<Limits, StudyError> {
    let of_study = |refused: RefusedValue| RefusedValue {
        key: format!("limits.{}", refused.key.trim_start_matches("limits.")),
        ..refused
    };
    let limited = scene.edited(|scene| {
        let limits = scene.limits.get_or_insert_default();
        limits.margin = file.margin.or(limits.margin);
        limits.min_flutter_rpm = file.min_flutter_rpm.or(limits.min_flutter_rpm);
        limits.min_critical_rpm = file.min_critical_rpm.or(limits.min_critical_rpm);
    });
    let limited = limited.map_err(|error| match error {
        SceneError::Value(refused) => StudyError::Value(of_study(refused)),
        source => StudyError::Scene {
            key: "limits".to_owned(),
            source,
        },
    })?;
    let operating_rpm = limited.needed_operating_rpm(file.operating_rpm);
    let found = operating_rpm.and_then(|rpm| Limits::of(&limited, rpm));
    Ok(found.map_err(of_study)?)
}

/// Validates the block `gap` of the study.
pub(super) fn gap(file: &GapFile, scene: &Scene) -> Result<GapCase, StudyError> {
    let in_m = |key, given: f64| {
        let (allowed, remedy) = ("above 0 and at most 1", "give it in metres, such as 1e-4");
        RefusedValue::new(key, given, allowed, remedy)
    };
    let options = gap::Options {
        rpm: file.rpm,
        ..gap::Options::default()
    };
    if let Some(limit) = file.max_deviation_m
        && !(limit > 0.0 && limit <= 1.0)
    {
        return Err(in_m("gap.max_deviation_m", limit).into());
    }
    let of_study = |refused: RefusedValue| match refused.key.as_str() {
        "rpm" => RefusedValue {
            key: "gap.rpm".into(),
            ..refused
        },
        "amplitude_m" => in_m("gap.amplitude_m", file.amplitude_m.unwrap_or_default()),
        _ => refused,
    };
    Ok(GapCase::new(scene, &options, file.amplitude_m).map_err(of_study)?)
}
