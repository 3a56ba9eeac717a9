//! Collects the statistics of a study for a [`StudyReport`], one saw after the other, in bounded memory.

use std::io;
use std::path::{Path, PathBuf};

use super::counts::Counts;
use super::distribution::Distribution;
use super::log::LogError;
use super::order::Values;
use super::plan::Study;
use super::report::{
    GridNumber, Group, Quantile, Refusal, Reliability, ReliabilityPoint, StudyReport, WorstSaw,
};
use super::rows::Rows;
use super::saw::{Found, Saw};
use super::statistics::is_resolved;
use super::table::Table;
use crate::model::scene::rpm;

/// Largest number of saws that were not analysed in the list of the report; the table contains all.
const LISTED: usize = 20;
/// Number of saws listed with the lowest speeds.
const WORST: usize = 10;
/// Largest number of points of the grid for which the report contains the statistics of each point.
const MAX_GROUPS: usize = 10_000;
/// Number of points of the curve of reliability.
const CURVE: usize = 61;
/// Shares of saws for which the report gives the highest operating speed, if the saws are enough.
const RELIABLE: [f64; 6] = [1.0, 0.999, 0.99, 0.95, 0.9, 0.5];

/// Statistics of the saws added so far.
pub(super) struct Tally<'a> {
    study: &'a Study,
    folder: PathBuf,
    all: Counts<'a>,
    group: Option<Counts<'a>>,
    groups: Vec<Group>,
    /// Highest operating speed of each saw, unless it exceeds the speeds of the study.
    allowed: Values,
    first_critical: Lowest,
    flutter: Lowest,
    largest_error: f64,
    with_violations: usize,
    not_analysed: Vec<Refusal>,
}

impl<'a> Tally<'a> {
    /// Statistics without saws. Values that do not fit into memory are written to `folder`.
    pub fn new(study: &'a Study, folder: &Path) -> Self {
        Tally {
            study,
            folder: folder.to_owned(),
            all: Counts::new(study, Vec::new(), folder),
            group: None,
            groups: Vec::new(),
            allowed: Values::new(folder),
            first_critical: Lowest::default(),
            flutter: Lowest::default(),
            largest_error: 0.0,
            with_violations: 0,
            not_analysed: Vec::new(),
        }
    }

    /// Adds the next saw, in the order of the numbers.
    pub fn add(&mut self, saw: &Saw) -> io::Result<()> {
        self.all.add(saw)?;
        self.add_to_group(saw)?;
        if let Some(reason) = saw.outcome.reason()
            && self.not_analysed.len() < LISTED
        {
            self.not_analysed.push(Refusal {
                saw: saw.index,
                reason: reason.to_owned(),
            });
        }
        saw.found()
            .map_or(Ok(()), |found| self.add_found(saw, found))
    }

    fn add_found(&mut self, saw: &Saw, found: &Found) -> io::Result<()> {
        self.largest_error = self.largest_error.max(found.estimated_relative_error);
        self.with_violations += usize::from(found.krein_violations > 0);
        self.first_critical.add(saw, found.first_critical_rpm);
        self.flutter.add(saw, found.flutter_rpm);
        match highest_operating_rpm(found, margin(self.study)) {
            Some(rpm) => self.allowed.push(rpm),
            None => Ok(()),
        }
    }

    fn add_to_group(&mut self, saw: &Saw) -> io::Result<()> {
        let (study, drawn) = (self.study, self.study.drawn());
        let points = study.count() / drawn;
        if drawn == 1 || points == 1 || points > MAX_GROUPS {
            return Ok(());
        }
        let folder = &self.folder;
        let group = self
            .group
            .get_or_insert_with(|| Counts::new(study, place(study, saw), folder));
        group.add(saw)?;
        if group.saws == drawn
            && let Some(group) = self.group.take()
        {
            self.groups.push(group.report()?);
        }
        Ok(())
    }

    /// The report of all saws.
    pub fn report(mut self, processors: Vec<String>) -> io::Result<StudyReport> {
        let study = self.study;
        let reliability = self.reliability()?;
        if let Some(group) = self.group.take() {
            self.groups.push(group.report()?);
        }
        Ok(StudyReport {
            sawflutter: env!("CARGO_PKG_VERSION").to_owned(),
            scene: study.scene().file().clone(),
            condition: study.scene().condition(),
            unusual_numbers: match study.limits() {
                Some(limits) => limits.unusual_numbers(study.scene()),
                None => study.scene().file().unusual_numbers(),
            },
            study: study.file().clone(),
            swept_to_rpm: rpm(study.to_rad_per_s()),
            largest_estimated_relative_error: self.largest_error,
            saws_with_krein_violations: self.with_violations,
            all: self.all.report()?,
            groups: self.groups,
            not_analysed: self.not_analysed,
            reliability,
            worst_first_critical: self.first_critical.0,
            worst_flutter: self.flutter.0,
            processors: match processors.len() {
                0 | 1 => Vec::new(),
                _ => processors,
            },
        })
    }

    /// The curve of reliability; `None` if every analysed saw can run at any speed of the study.
    fn reliability(&mut self) -> io::Result<Option<Reliability>> {
        let Some([from, to]) = self.allowed.range() else {
            return Ok(None);
        };
        let (saws, analysed) = (self.all.saws, self.all.analysed());
        let step = (to - from) / (CURVE - 1) as f64;
        let points = if to > from { CURVE } else { 1 };
        let speeds: Vec<f64> = (0..points)
            .map(|k| {
                if k + 1 == points {
                    to
                } else {
                    from + k as f64 * step
                }
            })
            .collect();
        // Element k of `below` is the number of saws whose highest operating speed lies between the speeds
        // k − 1 and k; element 0 counts the saws below the first speed.
        let mut below = vec![0_usize; points];
        self.allowed.each(&mut |allowed| {
            let above = speeds.partition_point(|speed| *speed <= allowed);
            if let Some(count) = below.get_mut(above) {
                *count += 1;
            }
        })?;
        let mut running = analysed;
        let curve = speeds
            .iter()
            .zip(&below)
            .map(|(speed, count)| {
                running -= count;
                ReliabilityPoint {
                    operating_rpm: *speed,
                    share: running as f64 / saws as f64,
                }
            })
            .collect();
        let mut fastest = Vec::new();
        for share in RELIABLE {
            if !is_resolved(share, saws) {
                continue;
            }
            // `out` is the number of saws that may fail. The margin is needed because the computed
            // value of 1000 × (1 − 0.9) is slightly below 100.
            let out = (saws as f64 * (1.0 - share) + 1e-6).floor() as usize;
            let rank = out
                .checked_sub(saws - analysed)
                .filter(|rank| *rank < self.allowed.count());
            let rpm = match rank {
                Some(rank) => self.allowed.ranked(&[rank])?.first().copied(),
                None => None,
            };
            fastest.push(Quantile { share, rpm });
        }
        Ok(Some(Reliability {
            margin: margin(self.study),
            fastest,
            curve,
        }))
    }
}

fn margin(study: &Study) -> f64 {
    let own = study.limits().map(|limits| limits.limits.margin());
    own.unwrap_or(study.scene().limits().margin())
}

/// Highest speed at which a saw keeps its margin and does not flutter; `None` if it exceeds the speeds of the
/// study.
fn highest_operating_rpm(found: &Found, margin: f64) -> Option<f64> {
    let critical = found.first_critical_rpm.map(|rpm| margin * rpm);
    match (critical, found.flutter_rpm) {
        (Some(critical), Some(flutter)) => Some(critical.min(flutter)),
        (one, other) => one.or(other),
    }
}

/// The saws with the lowest speeds, ascending.
#[derive(Default)]
struct Lowest(Vec<WorstSaw>);

impl Lowest {
    fn add(&mut self, saw: &Saw, speed: Option<f64>) {
        let Some(rpm) = speed else {
            return;
        };
        // Of saws with equal speeds the one with the smaller number is listed first.
        let place = self.0.partition_point(|other| other.rpm <= rpm);
        if place < WORST {
            self.0.truncate(WORST - 1);
            let worst = WorstSaw {
                saw: saw.index,
                rpm,
                values: saw.values.clone(),
            };
            self.0.insert(place, worst);
        }
    }
}

/// The values of the grid for a saw.
fn place(study: &Study, saw: &Saw) -> Vec<GridNumber> {
    let numbers = study.varying.iter().zip(&saw.values);
    numbers
        .filter(|(varying, _)| matches!(varying.distribution, Distribution::Grid(_)))
        .map(|(varying, value)| GridNumber {
            parameter: varying.parameter.path().to_owned(),
            value: *value,
        })
        .collect()
}

impl Study {
    /// Statistics of saws given in the order of their numbers. [`sum_up`] reads saws from logs, a block at a
    /// time.
    ///
    /// # Errors
    /// With more than a million saws, the error of writing temporary files.
    pub fn report(&self, saws: &[Saw]) -> io::Result<StudyReport> {
        let mut tally = Tally::new(self, &std::env::temp_dir());
        saws.iter().try_for_each(|saw| tally.add(saw))?;
        tally.report(Vec::new())
    }
}

/// Writes the tables of all saws and returns their statistics. Temporary files are in `folder` and are
/// removed.
///
/// # Errors
/// [`LogError`] where a log cannot be read or a table cannot be written.
pub fn sum_up(
    rows: &Rows<'_>,
    folder: &Path,
    mut tables: Vec<Box<dyn Table + '_>>,
) -> Result<StudyReport, LogError> {
    let mut tally = Tally::new(rows.study(), folder);
    rows.each_block(&mut |saws| {
        for saw in saws {
            tally.add(saw).map_err(LogError::Tables)?;
        }
        let mut tables = tables.iter_mut();
        tables
            .try_for_each(|table| table.add(saws))
            .map_err(LogError::Tables)
    })?;
    for table in tables {
        table.finish().map_err(LogError::Tables)?;
    }
    let processors = rows.processors().cloned().collect();
    tally.report(processors).map_err(LogError::Tables)
}
