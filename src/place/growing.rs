//! The map of a search while its saws are computed, for a progress display.

use std::sync::{Mutex, PoisonError};

use super::Progress;
use super::map::Map;
use super::outcome::Outcome;
use super::search::{Search, Seen};

/// The part of a map that is known so far.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct GrowingMap {
    /// The map; a cell that is not computed yet has no outcome.
    pub map: Map,
    /// Whether a cell is computed; one row for each value of y.
    pub is_computed: Vec<Vec<bool>>,
    /// Initial samples of the search.
    pub samples: Vec<Sample>,
}

/// A saw somewhere between the bounds.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Sample {
    /// Its numbers along the axes of the map.
    pub at: [f64; 2],
    /// Result; `None` if there is no such saw.
    pub outcome: Option<Outcome>,
}

/// Called whenever the map has changed.
pub(crate) type Watch<'a> = &'a (dyn Fn(&GrowingMap) + Sync);

/// Collects the results of all threads of a search into one map.
pub(super) struct Grower<'a> {
    growing: Mutex<GrowingMap>,
    watch: Watch<'a>,
}

impl<'a> Grower<'a> {
    /// An empty map with `points` points along each axis.
    pub fn new(search: &Search<'_>, points: usize, watch: Watch<'a>) -> Self {
        // A search without a map still shows its samples.
        let map = Map::unknown(search, points.max(2));
        let growing = GrowingMap {
            is_computed: unknown(&map),
            samples: Vec::new(),
            map,
        };
        Grower {
            growing: Mutex::new(growing),
            watch,
        }
    }

    fn grown(&self, grow: impl FnOnce(&mut GrowingMap)) {
        let mut growing = self.growing.lock().unwrap_or_else(PoisonError::into_inner);
        grow(&mut growing);
        (self.watch)(&growing);
    }

    /// Adds a sample.
    pub fn sampled(&self, search: &Search<'_>, seen: &Seen<'_>) {
        self.grown(|growing| {
            let sample = Sample {
                at: growing.map.place_of(search, seen.shares),
                outcome: seen.outcome.cloned(),
            };
            growing.samples.push(sample);
        });
    }

    /// Computes a map.
    pub fn drawn(&self, mut map: Map, search: &Search<'_>, progress: Progress<'_>) -> Map {
        self.begun(&map);
        let (columns, total) = (map.x.len(), map.x.len() * map.y.len());
        let seen = |seen: Seen<'_>| {
            progress("map", seen.done, total);
            self.filled(&seen);
        };
        let shares_of = |index| map.shares_of(index);
        let flat = search.outcomes(total, shares_of, &seen, |_, outcome| outcome);
        map.outcomes = flat.chunks(columns).map(<[_]>::to_vec).collect();
        map
    }

    /// Starts a map, with every cell unknown.
    fn begun(&self, map: &Map) {
        self.grown(|growing| {
            growing.is_computed = unknown(map);
            growing.map = map.clone();
        });
    }

    /// Adds a cell.
    fn filled(&self, seen: &Seen<'_>) {
        self.grown(|growing| {
            let columns = growing.map.x.len();
            let (row, column) = (seen.index / columns, seen.index % columns);
            growing.map.outcomes[row][column] = seen.outcome.cloned();
            growing.is_computed[row][column] = true;
        });
    }
}

fn unknown(map: &Map) -> Vec<Vec<bool>> {
    vec![vec![false; map.x.len()]; map.y.len()]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::place::{Demands, Options, Placement};
    use crate::plate::Resolution;
    use crate::scene::{Freed, Scene};

    /// The goal of the last map shown is that of the final map.
    #[test]
    #[cfg_attr(debug_assertions, ignore = "many eigenproblems: run it in release")]
    fn a_map_that_is_watched_grows_cell_by_cell_into_the_map_of_the_result() {
        let saw = Scene::paper().edited(|saw| saw.sweep.as_mut().unwrap().to_rpm = 2400.0);
        let saw = saw.unwrap();
        let radius = Freed::new(saw.file(), "guides[0].radius_m", 0.19, 0.25).unwrap();
        let stiffness = Freed::new(saw.file(), "guides[0].stiffness_n_per_m", 1e7, 3e7).unwrap();
        let options = Options {
            samples: 8,
            places: 1,
            refine: 24,
            map: 3,
            resolution: Some(Resolution {
                max_diameters: 6,
                radial_functions: 3,
            }),
            ..Options::default()
        };
        let shown = Mutex::new(Vec::new());
        let watch = |growing: &GrowingMap| {
            let known = growing.is_computed.iter().flatten().filter(|is| **is);
            let mut shown = shown.lock().unwrap();
            shown.push((known.count(), growing.samples.len(), growing.map.clone()));
        };
        let (freed, demands) = ([radius, stiffness], Demands::default());
        let found =
            Placement::watched(&saw, &freed, &demands, &options, &|_, _, _| (), &watch).unwrap();
        let shown = shown.into_inner().unwrap();
        let samples = shown.iter().map(|(_, samples, _)| *samples);
        assert!(samples.take(8).eq(1..=8), "the samples come one by one");
        let cells: Vec<usize> = shown[8..].iter().map(|(cells, ..)| *cells).collect();
        // A new map starts if a cell of the map leads to a better saw.
        assert!(
            cells.chunks(10).all(|map| map.iter().copied().eq(0..=9)),
            "{cells:?}"
        );
        assert_eq!(shown.last().unwrap().2, found.map.unwrap());
    }
}
