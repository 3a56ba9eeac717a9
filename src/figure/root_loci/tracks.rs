//! The paths of two eigenvalues, cut where they meet.

use std::f64::consts::TAU;

use super::super::meeting::{Meeting, between, interpolate};
use crate::report::RootLociEntry;

/// An eigenvalue at a speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    pub rpm: f64,
    pub growth: f64,
    pub hz: f64,
}

/// What is known of a stretch of a path.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Look {
    /// Krein sign +1.
    Plus,
    /// Krein sign −1.
    Minus,
    /// Without sign because of damping: of the first or the second path.
    Damped(usize),
    Growing,
    Decaying,
}

/// A stretch of a path.
#[derive(Debug, Clone, PartialEq)]
pub struct Track {
    pub look: Look,
    /// Name of the mode, on the stretches that begin before the onset.
    pub name: Option<String>,
    pub samples: Vec<Sample>,
}

/// Both paths.
#[derive(Debug, Clone, PartialEq)]
pub struct Loci {
    pub tracks: Vec<Track>,
    pub onset: Sample,
    pub peak: Sample,
    pub end: Sample,
    /// Whether the modes do merge, that is, whether there is no damping.
    pub merge: bool,
}

/// One speed, both paths.
struct Row {
    rpm: f64,
    growth: [f64; 2],
    hz: [f64; 2],
    sign: [i8; 2],
}

impl Loci {
    /// `None` if the report does not hold two paths through a band.
    pub fn new(entry: &RootLociEntry, is_damped: bool) -> Option<Self> {
        let rows = rows(entry);
        let ends = [entry.onset_rpm, entry.end_rpm];
        if rows.len() < 2 || !ends.iter().all(|rpm| is_sound(*rpm)) || ends[0] >= ends[1] {
            return None;
        }
        match is_damped {
            true => damped(entry, &rows),
            false => undamped(entry, &rows),
        }
    }

    pub fn samples(&self) -> impl Iterator<Item = &Sample> {
        self.tracks.iter().flat_map(|track| &track.samples)
    }
}

/// A number that a saw may have; labels have room for no other.
fn is_sound(value: f64) -> bool {
    value.abs() < 1e9
}

/// Speeds in ascending order at which all numbers are known.
fn rows(entry: &RootLociEntry) -> Vec<Row> {
    let [first, second, ..] = &entry.paths[..] else {
        return Vec::new();
    };
    let mut rows: Vec<Row> = Vec::new();
    for (i, &rpm) in entry.rpm.iter().enumerate() {
        let of_both = |list: fn(&crate::report::RootPathEntry) -> &[f64]| {
            let [a, b] = [first, second].map(|path| list(path).get(i).copied());
            [a.unwrap_or(f64::NAN), b.unwrap_or(f64::NAN)]
        };
        let growth = of_both(|path| &path.growth_per_s);
        let hz = of_both(|path| &path.frequency_hz);
        let sign = [first, second].map(|path| path.krein_sign.get(i).copied().unwrap_or(0));
        let known = [[rpm, 0.0], growth, hz];
        let ascends = rows.last().is_none_or(|last| last.rpm < rpm);
        if ascends && known.as_flattened().iter().all(|value| is_sound(*value)) {
            rows.push(Row {
                rpm,
                growth,
                hz,
                sign,
            });
        }
    }
    rows
}

/// Two eigenvalues without damping, about a band in which they have coalesced. Mean frequency and
/// square of half the difference are smooth through both ends of the band.
struct Coalescing {
    /// Onset and end of the band, in rpm.
    band: [f64; 2],
    meeting: Meeting,
    /// Speed in rpm and mean frequency in Hz.
    mean: Vec<[f64; 2]>,
}

impl Coalescing {
    fn new(band: [f64; 2], rows: &[Row]) -> Option<Self> {
        let mean = rows
            .iter()
            .map(|row| [row.rpm, (row.hz[0] + row.hz[1]) / 2.0]);
        let square = |row: &Row| {
            let growth = (row.growth[0] - row.growth[1]) / 2.0;
            let apart = TAU * (row.hz[0] - row.hz[1]) / 2.0;
            match (band[0]..=band[1]).contains(&row.rpm) {
                true => [row.rpm, growth * growth],
                false => [row.rpm, -apart * apart],
            }
        };
        Some(Coalescing {
            band,
            meeting: Meeting::new(band, [true; 2], rows.iter().map(square))?,
            mean: mean.collect(),
        })
    }

    /// One of the two, on this side (±1) of their mean.
    fn sample(&self, rpm: f64, side: f64) -> Sample {
        let square = self.meeting.square(rpm);
        let half = side * square.abs().sqrt();
        let mean = interpolate(&self.mean, rpm);
        let inside = (self.band[0]..=self.band[1]).contains(&rpm);
        Sample {
            rpm,
            growth: if inside { half } else { 0.0 },
            hz: if inside { mean } else { mean + half / TAU },
        }
    }

    fn track(&self, ends: [f64; 2], side: f64, look: Look, name: Option<String>) -> Track {
        let samples = between(ends).map(|rpm| self.sample(rpm, side));
        Track {
            look,
            name,
            samples: samples.collect(),
        }
    }
}

fn undamped(entry: &RootLociEntry, rows: &[Row]) -> Option<Loci> {
    let (onset, end) = (entry.onset_rpm, entry.end_rpm);
    let pair = Coalescing::new([onset, end], rows)?;
    let (first, last) = (&rows[0], &rows[rows.len() - 1]);
    let outside = [(first, [first.rpm, onset]), (last, [end, last.rpm])].into_iter();
    let outside = outside.filter(|(_, ends)| ends[0] < ends[1]);
    let mut tracks: Vec<Track> = outside
        .flat_map(|(outermost, ends)| {
            apart(outermost).map(|(path, side, look)| {
                let begins = outermost.rpm < onset;
                let name = begins.then(|| entry.paths[path].name.clone());
                pair.track(ends, side, look, name)
            })
        })
        .collect();
    tracks.push(pair.track([onset, end], -1.0, Look::Decaying, None));
    let growing = pair.track([onset, end], 1.0, Look::Growing, None);
    let peak = highest(&growing.samples)?;
    tracks.push(growing);
    Some(Loci {
        tracks,
        onset: pair.sample(onset, 1.0),
        peak,
        end: pair.sample(end, 1.0),
        merge: true,
    })
}

/// Path, side of the mean and look of the two waves at a speed outside their band.
fn apart(row: &Row) -> [(usize, f64, Look); 2] {
    let upper = usize::from(row.hz[1] > row.hz[0]);
    [(upper, 1.0), (1 - upper, -1.0)].map(|(path, side)| {
        let look = match row.sign[path] {
            1 => Look::Plus,
            -1 => Look::Minus,
            _ => Look::Damped(path),
        };
        (path, side, look)
    })
}

/// With damping the paths pass each other, and one of them strays to the right.
fn damped(entry: &RootLociEntry, rows: &[Row]) -> Option<Loci> {
    let samples = |path: usize| -> Vec<Sample> {
        let sample = |row: &Row| Sample {
            rpm: row.rpm,
            growth: row.growth[path],
            hz: row.hz[path],
        };
        rows.iter().map(sample).collect()
    };
    let mut both = [samples(0), samples(1)];
    let peaks = [highest(&both[0])?, highest(&both[1])?];
    let flutters = usize::from(peaks[1].growth > peaks[0].growth);
    let path: Vec<_> = both[flutters].iter().map(|s| [s.rpm, s.hz]).collect();
    let ends = [entry.onset_rpm, entry.end_rpm].map(|rpm| Sample {
        rpm,
        growth: 0.0,
        hz: interpolate(&path, rpm),
    });
    for end in ends {
        insert(&mut both[flutters], end);
    }
    let mut tracks: Vec<Track> = Vec::new();
    for (path, samples) in both.iter().enumerate() {
        let start = tracks.len();
        for pair in samples.windows(2) {
            let grows = pair[0].growth + pair[1].growth > 0.0;
            let look = if grows {
                Look::Growing
            } else {
                Look::Damped(path)
            };
            match tracks[start..].last_mut() {
                Some(track) if track.look == look => track.samples.push(pair[1]),
                _ => tracks.push(Track {
                    look,
                    name: None,
                    samples: pair.to_vec(),
                }),
            }
        }
        if let Some(track) = tracks.get_mut(start) {
            track.name = Some(entry.paths[path].name.clone());
        }
    }
    Some(Loci {
        tracks,
        onset: ends[0],
        peak: peaks[flutters],
        end: ends[1],
        merge: false,
    })
}

/// Puts a sample in its place, unless the speed is known already or not within.
fn insert(samples: &mut Vec<Sample>, new: Sample) {
    let i = samples.partition_point(|sample| sample.rpm < new.rpm);
    let known = samples.get(i).is_none_or(|next| next.rpm == new.rpm);
    if i > 0 && !known {
        samples.insert(i, new);
    }
}

fn highest(samples: &[Sample]) -> Option<Sample> {
    let highest = samples.iter().copied();
    highest.max_by(|a, b| a.growth.total_cmp(&b.growth))
}
