//! Sizes of the basis in ascending order.

use crate::model::plate::Resolution;

/// Sizes (n_max, J), each with about 1.5 times as many functions as the previous one. The errors of smaller
/// sizes cannot be estimated reliably by a larger basis.
pub(crate) const LADDER: [(usize, usize); 11] = [
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

/// Size of the ladder with at least a given number of nodal diameters.
pub(super) fn sized(rung: usize, diameters: usize) -> Resolution {
    let (own, functions) = LADDER[rung];
    resolution((own.max(diameters), functions))
}

/// Number of nodal diameters of a size from [`sized`] if it has more than the ladder; 0 otherwise.
pub(crate) fn diameters_beyond(size: Resolution) -> usize {
    if size.max_diameters > LADDER[rung_of(size)].0 {
        size.max_diameters
    } else {
        0
    }
}

/// Size that measures the error of a size from [`sized`]. It has more diameters in the same proportion.
pub(crate) fn ahead(size: Resolution) -> Resolution {
    let rung = rung_of(size);
    let mut sizes = LADDER.into_iter().chain(BEYOND);
    let ahead = sizes.nth(rung + steps_ahead(rung));
    let larger = resolution(ahead.unwrap_or(BEYOND[1]));
    let diameters = (size.max_diameters * larger.max_diameters).div_ceil(LADDER[rung].0);
    Resolution {
        max_diameters: larger.max_diameters.max(diameters),
        ..larger
    }
}

/// The next smaller size of the ladder, if there is one.
pub(super) fn next_smaller(size: Resolution) -> Resolution {
    resolution(LADDER[rung_of(size).saturating_sub(1)])
}

/// Index of the size in the ladder with the same number of radial functions; 0 for any other size.
pub(super) fn rung_of(size: Resolution) -> usize {
    let functions = size.radial_functions;
    let place = LADDER.iter().position(|rung| rung.1 == functions);
    place.unwrap_or(0)
}

/// Size of the ladder as a resolution.
pub(crate) const fn resolution((max_diameters, radial_functions): (usize, usize)) -> Resolution {
    Resolution {
        max_diameters,
        radial_functions,
    }
}
