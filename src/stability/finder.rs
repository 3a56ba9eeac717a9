//! Every instability band of an undamped blade, however narrow.
//!
//! Modes can merge only if their Krein signs differ, so a change in the order of
//! signs between two speeds betrays a crossing or a band between them. Intervals are
//! halved until each holds at most one such change; intervals without a change are
//! halved too where the tangents of a + and a − mode meet inside.

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;

use super::bands::Certificate;
use super::pursuit::Inside;
use super::refine;
use super::station::{Change, Sign, Station, between_crossings, change};
use crate::spectrum::{LowModel, LowModes, ModePair, SpectralModel, SpectrumError};

/// Relative distance kept from a critical speed: λ² passes through zero there, and is
/// known to 1e-15 of the stiffness only.
pub const CRITICAL_GAP: f64 = 5e-6;
/// Critical speeds closer than this are passed in one step. The divergence between them
/// grows by less than a hundredth of 1/s; that it is there follows from the inertia.
pub const CRITICAL_GROUP: f64 = 2e-5;
/// Intervals below this relative width are not halved any more.
const LEAST_WIDTH: f64 = 1e-9;

/// Speeds that a search may look at: twenty times what a saw needs. It bounds the time
/// where modes cannot be told apart.
const MOST_SPEEDS: usize = 20_000;

/// Speeds at which the search solves the whole projected system; between two of them it goes
/// by their modes.
const ANCHORS: usize = 13;

/// What happens between two stations, in order of speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Event {
    /// A merged pair begins.
    Begin(Edge),
    /// A merged pair ends.
    End(Edge),
    /// A whole band, from one speed to another.
    Band(f64, f64),
}

/// Begin or end of a merged pair.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Edge {
    /// Index of the pair among the merged ones, by frequency.
    pub index: usize,
    /// Ω.
    pub speed_rad_per_s: f64,
    /// Whether the pair comes from, or goes on as, two real λ.
    pub real: bool,
}

/// Where the Krein index was compared, and where it did not match.
#[derive(Debug, Default)]
struct Tally {
    checked: AtomicUsize,
    violations: Mutex<Vec<f64>>,
}

/// Evaluates stations, checks the Krein index of each, and counts.
pub struct Finder<'a> {
    model: &'a SpectralModel,
    low: Option<LowModel<'a>>,
    /// The same between neighbouring anchors, with the upper of both.
    pieces: Vec<(f64, LowModel<'a>)>,
    tally: Tally,
}

impl<'a> Finder<'a> {
    /// A finder on an undamped blade, for the speeds between the first and the last given.
    ///
    /// # Errors
    /// [`SpectrumError`] when an eigenproblem fails.
    pub fn new(model: &'a SpectralModel, speeds: &[f64]) -> Result<Self, SpectrumError> {
        let low = model.low_model();
        let mut pieces = Vec::new();
        if let Some(low) = &low {
            let anchors: Vec<_> = anchors(speeds)
                .into_par_iter()
                .map(|speed| low.modes(speed))
                .collect();
            let anchors: Vec<LowModes> = anchors.into_iter().collect::<Result<_, _>>()?;
            pieces = anchors
                .par_windows(2)
                .map(|ends| (ends[1].speed_rad_per_s, low.between([&ends[0], &ends[1]])))
                .collect();
        }
        Ok(Finder {
            model,
            low,
            pieces,
            tally: Tally::default(),
        })
    }

    /// The speeds checked so far.
    pub fn certificate(&self) -> Certificate {
        let violations = self.tally.violations.lock();
        let mut violations =
            violations.map_or_else(|poisoned| poisoned.into_inner().clone(), |v| v.clone());
        violations.sort_by(f64::total_cmp);
        Certificate {
            speeds_checked: self.tally.checked.load(Ordering::Relaxed),
            violations,
            gave_up: self.is_exhausted(),
        }
    }

    fn is_exhausted(&self) -> bool {
        self.tally.checked.load(Ordering::Relaxed) >= MOST_SPEEDS
    }

    /// The word of signs at a speed. Where it contradicts the Krein index it is read
    /// again off the whole basis; what contradicts even then is a violation.
    ///
    /// # Errors
    /// [`SpectrumError`] when the eigenproblem fails.
    pub fn station(&self, speed_rad_per_s: f64) -> Result<Station, SpectrumError> {
        self.tally.checked.fetch_add(1, Ordering::Relaxed);
        if let Some(low) = self.near(speed_rad_per_s) {
            let modes = low.modes(speed_rad_per_s)?.modes;
            let station = Station::new(speed_rad_per_s, modes.iter());
            if self.matches(&station) {
                return Ok(station);
            }
        }
        self.exact_station(speed_rad_per_s)
    }

    /// The same without the haste of few states.
    ///
    /// # Errors
    /// [`SpectrumError`] when the eigenproblem fails.
    pub fn exact_station(&self, speed_rad_per_s: f64) -> Result<Station, SpectrumError> {
        let modes = match &self.low {
            Some(low) => low.modes(speed_rad_per_s)?.modes,
            None => self.model.all_modes(speed_rad_per_s)?,
        };
        let station = Station::new(speed_rad_per_s, modes.iter());
        if self.matches(&station) {
            return Ok(station);
        }
        let modes = self.model.full_modes(speed_rad_per_s)?;
        let station = Station::new(speed_rad_per_s, modes.iter());
        if !self.matches(&station)
            && let Ok(mut violations) = self.tally.violations.lock()
        {
            violations.push(speed_rad_per_s);
        }
        Ok(station)
    }

    /// The smallest model for a speed.
    fn near(&self, speed_rad_per_s: f64) -> Option<&LowModel<'a>> {
        let place = self.pieces.partition_point(|(to, _)| *to < speed_rad_per_s);
        self.pieces.get(place).map(|(_, low)| low)
    }

    /// The two modes of a speed next to a frequency, to rounding.
    ///
    /// # Errors
    /// [`SpectrumError`] when the eigenproblem fails.
    pub fn pair(
        &self,
        speed_rad_per_s: f64,
        frequency_rad_per_s: f64,
    ) -> Result<Option<ModePair>, SpectrumError> {
        match self.near(speed_rad_per_s).or(self.low.as_ref()) {
            Some(low) => low.pair(speed_rad_per_s, frequency_rad_per_s),
            None => Ok(None),
        }
    }

    /// A pair followed to another speed.
    pub fn moved(&self, pair: &ModePair, speed_rad_per_s: f64) -> Option<ModePair> {
        self.low.as_ref()?.moved(pair, speed_rad_per_s)
    }

    /// Largest growth of a divergent mode next to a critical speed, where the Krein index
    /// cannot be read off rounded eigenvalues.
    ///
    /// # Errors
    /// [`SpectrumError`] when the eigenproblem fails.
    pub fn divergence(&self, speed_rad_per_s: f64) -> Result<f64, SpectrumError> {
        let modes = match &self.low {
            Some(low) => low.modes(speed_rad_per_s)?.modes,
            None => return Ok(0.0),
        };
        Ok(Station::new(speed_rad_per_s, modes.iter())
            .divergence()
            .unwrap_or(0.0))
    }

    /// Holds the spectrum against the inertia of the stiffness, which comes from
    /// another, symmetric eigenproblem on the whole basis.
    fn matches(&self, station: &Station) -> bool {
        station.krein_index()
            == self
                .model
                .negative_stiffness_directions(station.speed_rad_per_s)
    }

    /// The words of many speeds, in parallel.
    ///
    /// # Errors
    /// [`SpectrumError`] of the lowest speed that fails.
    pub fn stations(&self, speeds: &[f64]) -> Result<Vec<Station>, SpectrumError> {
        let stations: Vec<_> = speeds
            .par_iter()
            .map(|&speed| self.station(speed))
            .collect();
        stations.into_iter().collect()
    }

    /// Events between neighbouring stations; the intervals are independent.
    ///
    /// # Errors
    /// [`SpectrumError`] when an eigenproblem fails.
    pub fn events(&self, stations: &[Station]) -> Result<Vec<Vec<Event>>, SpectrumError> {
        let found: Vec<Result<Vec<Event>, SpectrumError>> = stations
            .par_windows(2)
            .map(|pair| {
                let mut events = Vec::new();
                if !self.spans_critical(&pair[0], &pair[1]) {
                    self.search(&pair[0], &pair[1], 0, &mut events)?;
                }
                Ok(events)
            })
            .collect();
        found.into_iter().collect()
    }

    /// Whether a critical speed lies between: then a mode passes through zero there,
    /// and the stations are so close on both sides that nothing else happens.
    fn spans_critical(&self, a: &Station, b: &Station) -> bool {
        let count = |s: &Station| self.model.negative_stiffness_directions(s.speed_rad_per_s);
        count(a) != count(b)
    }

    fn search(
        &self,
        a: &Station,
        b: &Station,
        depth: usize,
        events: &mut Vec<Event>,
    ) -> Result<(), SpectrumError> {
        let (x, y) = (a.speed_rad_per_s, b.speed_rad_per_s);
        let seen = change(&a.word(), &b.word());
        if y - x > LEAST_WIDTH * y && !self.is_exhausted() {
            let doubtful = seen == Change::None && a.merged().next().is_some();
            if seen == Change::Several || doubtful || (seen == Change::None && may_touch(a, b)) {
                let share = match between_crossings(a, b) {
                    // Halving now and then bounds the depth wherever the waves go.
                    Some(share) if seen == Change::Several && depth % 4 != 3 => share,
                    _ => 0.5,
                };
                let middle = self.station(x + share * (y - x))?;
                if !doubtful || may_touch(a, b) || merged_pairs_bend(a, &middle, b) {
                    self.search(a, &middle, depth + 1, events)?;
                    return self.search(&middle, b, depth + 1, events);
                }
            }
        }
        if seen != Change::None {
            events.extend(self.refined(a, b, seen)?);
        }
        Ok(())
    }

    fn refined(
        &self,
        a: &Station,
        b: &Station,
        seen: Change,
    ) -> Result<Option<Event>, SpectrumError> {
        Ok(match seen {
            Change::Exchange(place) => refine::band_between(self, a, b, place)?
                .map(|Inside { from, to }| Event::Band(from, to)),
            Change::Merge(place) => refine::boundary(self, a, b, place)?.map(|speed_rad_per_s| {
                Event::Begin(Edge {
                    index: merged_before(b, place),
                    speed_rad_per_s,
                    real: refine::is_real(a, place),
                })
            }),
            Change::Part(place) => refine::boundary(self, b, a, place)?.map(|speed_rad_per_s| {
                Event::End(Edge {
                    index: merged_before(a, place),
                    speed_rad_per_s,
                    real: refine::is_real(b, place),
                })
            }),
            Change::None | Change::Several => None,
        })
    }
}

/// Of ascending speeds the first, the last, and some about evenly spread between.
fn anchors(speeds: &[f64]) -> Vec<f64> {
    let (Some(&first), Some(&last)) = (speeds.first(), speeds.last()) else {
        return Vec::new();
    };
    let spacing = (last - first) / ANCHORS as f64;
    let mut chosen = vec![first];
    for &speed in speeds {
        let latest = chosen[chosen.len() - 1];
        if speed - latest >= spacing && last - speed >= 0.5 * spacing {
            chosen.push(speed);
        }
    }
    if last > first {
        chosen.push(last);
    }
    chosen
}

/// Number of merged pairs below a place of the doubled list.
fn merged_before(station: &Station, place: usize) -> usize {
    let below = station.doubled();
    below
        .iter()
        .take(place)
        .filter(|t| t.sign == Sign::Merged)
        .count()
        / 2
}

/// Whether a merged pair may have parted and merged again, or met the real axis and left
/// it, between two stations of the same word. σ² and ω² are smooth there and pass through
/// zero; where the middle is off the straight line by a quarter of the smallest value,
/// zero may lie between.
fn merged_pairs_bend(a: &Station, middle: &Station, b: &Station) -> bool {
    if middle.word() != a.word() {
        return true;
    }
    let bends = |values: [f64; 3]| {
        let [left, between, right] = values.map(|v| v * v);
        (between - 0.5 * (left + right)).abs() > 0.25 * left.min(between).min(right)
    };
    let pairs = a.merged().zip(middle.merged()).zip(b.merged());
    pairs.into_iter().any(|((x, m), y)| {
        bends([x.growth, m.growth, y.growth]) || bends([x.frequency, m.frequency, y.frequency])
    })
}

/// Whether a + and a − mode next to each other may meet and part again between two
/// stations of the same word: their gap closes at one end, opens at the other, and
/// its tangents meet below a quarter of the smaller gap.
fn may_touch(a: &Station, b: &Station) -> bool {
    let width = b.speed_rad_per_s - a.speed_rad_per_s;
    let (left, right) = (a.doubled(), b.doubled());
    (0..left.len().min(right.len()).saturating_sub(1)).any(|i| {
        let opposite = |x: Sign, y: Sign| {
            matches!(
                (x, y),
                (Sign::Plus, Sign::Minus) | (Sign::Minus, Sign::Plus)
            )
        };
        if !(opposite(left[i].sign, left[i + 1].sign) && opposite(right[i].sign, right[i + 1].sign))
        {
            return false;
        }
        let gap_a = left[i + 1].frequency - left[i].frequency;
        let gap_b = right[i + 1].frequency - right[i].frequency;
        let slope_a = left[i + 1].slope - left[i].slope;
        let slope_b = right[i + 1].slope - right[i].slope;
        if slope_a >= 0.0 || slope_b <= 0.0 {
            return false;
        }
        let meet = (gap_b - gap_a - slope_b * width) / (slope_a - slope_b);
        let lowest = gap_a + slope_a * meet.clamp(0.0, width);
        lowest < 0.25 * gap_a.min(gap_b)
    })
}
