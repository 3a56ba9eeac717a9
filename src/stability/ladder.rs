//! The sizes of basis that are tried, one after another.

use crate::plate::Resolution;

/// (n_max, J), each about 1.5 times as large as the one before. Of smaller ones a larger basis does not tell the error.
pub(super) const LADDER: [(usize, usize); 11] = [
    (10, 6),
    (12, 7),
    (14, 9),
    (18, 10),
    (23, 11),
    (30, 12),
    (34, 15),
    (40, 18),
    (48, 21),
    (56, 25),
    (70, 30),
];
/// So many of them are within reach of eigenproblems of their order; the others take the structure of a guided
/// blade, or the harmonics of a free one.
pub(crate) const DENSE_LADDER: &[(usize, usize)] = LADDER.split_at(6).0;
/// Sizes that only measure what the largest of the ladder leave out.
const BEYOND: [(usize, usize); 2] = [(80, 34), (90, 38)];

/// Steps of the ladder from a size to the one that its error is measured against: more for the
/// small ones, which cost nothing and converge slowly at first.
const fn steps_ahead(rung: usize) -> usize {
    if rung <= 4 { 3 } else { 2 }
}

/// The size that the error of a size of the ladder is measured against.
pub(super) fn ahead(rung: usize) -> Resolution {
    let mut sizes = LADDER.into_iter().chain(BEYOND);
    let larger = sizes.nth(rung + steps_ahead(rung));
    resolution(larger.unwrap_or(BEYOND[1]))
}

/// The sizes of more nodal diameters.
pub(super) fn larger_than(least: Resolution) -> impl Iterator<Item = Resolution> {
    let larger = LADDER.into_iter();
    let larger = larger.filter(move |(max_diameters, _)| *max_diameters > least.max_diameters);
    larger.map(resolution)
}

/// Where a size of the ladder stands in it; any other counts as the first.
pub(super) fn rung_of(size: Resolution) -> usize {
    let place = LADDER.iter().position(|rung| resolution(*rung) == size);
    place.unwrap_or(0)
}

/// A size of the ladder.
pub(super) const fn resolution((max_diameters, radial_functions): (usize, usize)) -> Resolution {
    Resolution {
        max_diameters,
        radial_functions,
    }
}
