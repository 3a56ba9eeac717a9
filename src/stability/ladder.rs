//! Sizes of the basis in ascending order.

use crate::plate::Resolution;

/// Sizes (n_max, J), each with about 1.5 times as many functions as the previous one. The errors of smaller
/// sizes cannot be estimated reliably by a larger basis.
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
/// Sizes for which dense eigenproblems are possible. Larger ones need the structure of a guided blade or the
/// harmonics of a free one.
pub(crate) const DENSE_LADDER: &[(usize, usize)] = LADDER.split_at(6).0;
/// Sizes that only measure the error of the largest ones of the ladder.
const BEYOND: [(usize, usize); 2] = [(80, 34), (90, 38)];

/// Steps from a size to the one that measures its error: more for small sizes, which need little time and
/// converge slowly at first.
const fn steps_ahead(rung: usize) -> usize {
    if rung <= 4 { 3 } else { 2 }
}

/// Size that measures the error of a size of the ladder.
pub(super) fn ahead(rung: usize) -> Resolution {
    let mut sizes = LADDER.into_iter().chain(BEYOND);
    let larger = sizes.nth(rung + steps_ahead(rung));
    resolution(larger.unwrap_or(BEYOND[1]))
}

/// Sizes with more nodal diameters than a given size, ascending.
pub(super) fn larger_than(least: Resolution) -> impl Iterator<Item = Resolution> {
    let larger = LADDER.into_iter();
    let larger = larger.filter(move |(max_diameters, _)| *max_diameters > least.max_diameters);
    larger.map(resolution)
}

/// The next smaller size of the ladder, if there is one.
pub(super) fn next_smaller(size: Resolution) -> Resolution {
    resolution(LADDER[rung_of(size).saturating_sub(1)])
}

/// Index of a size in the ladder; 0 for any other size.
pub(super) fn rung_of(size: Resolution) -> usize {
    let place = LADDER.iter().position(|rung| resolution(*rung) == size);
    place.unwrap_or(0)
}

/// Size of the ladder as a resolution.
pub(super) const fn resolution((max_diameters, radial_functions): (usize, usize)) -> Resolution {
    Resolution {
        max_diameters,
        radial_functions,
    }
}
