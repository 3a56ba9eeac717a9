//! Eigenvalues followed over speed, with as many speeds in between as it takes to tell them
//! apart, to see where one may grow, and to draw its growth.

use rayon::prelude::*;

use super::super::root::share_of_zero;
use super::link::{LAST, Link, Pair, STRICT};
use super::spectrum::{Solver, Spectrum};
use crate::spectrum::SpectrumError;
use crate::tuned::Tuned;

/// Intervals narrower than this share of the speed are not divided: there a complex pair
/// becomes two real eigenvalues, or back.
const LEAST_WIDTH: f64 = 1e-10;
/// The same where the path is known and only its growth is drawn.
const LEAST_DRAWN: f64 = 1e-6;
/// A cubic through growth rates may be off by this share of them in its middle, before the
/// middle joins the curve.
const CURVE_TOLERANCE: Tuned = Tuned::new("stability/damped/trace::CURVE_TOLERANCE", 5e-3);
/// Or by this share of the highest frequency.
const CURVE_FLOOR: f64 = 1e-8;
/// Looks at one place of an interval in which nothing grows at the ends: each brings the place
/// of a crossing closer by two digits.
const LOOKS: Tuned = Tuned::new("stability/damped/trace::LOOKS", 4.0);

/// Spectra by ascending speed: the given ones and those between them.
pub fn refined(solver: &Solver<'_>, given: Vec<Spectrum>) -> Result<Vec<Spectrum>, SpectrumError> {
    let between: Result<Vec<Vec<Spectrum>>, SpectrumError> = given
        .par_windows(2)
        .map(|ends| within(solver, &ends[0], &ends[1], 0))
        .collect();
    let mut between = between?.into_iter();
    let mut spectra = Vec::new();
    for spectrum in given {
        spectra.push(spectrum);
        spectra.extend(between.next().into_iter().flatten());
    }
    Ok(spectra)
}

/// Spectra that an interval needs between its ends.
fn within(
    solver: &Solver<'_>,
    a: &Spectrum,
    b: &Spectrum,
    looks: usize,
) -> Result<Vec<Spectrum>, SpectrumError> {
    let width = b.speed - a.speed;
    if width <= LEAST_WIDTH * b.speed || solver.is_exhausted() {
        return Ok(Vec::new());
    }
    let link = Link::new(a, b, solver.highest(), STRICT.get());
    let middle = a.speed + 0.5 * width;
    if link.is_ambiguous {
        return halves(solver, [a, b], solver.at(middle)?, looks);
    }
    let growing = |p: &&Pair| p.growth() > solver.noise();
    if link.pairs.iter().any(|p| growing(&p)) {
        let between = solver.at(middle)?;
        let is_narrow = width <= LEAST_DRAWN * b.speed;
        let mut growing = link.pairs.iter().filter(growing);
        if is_narrow || growing.all(|pair| is_drawn(solver, pair, &between)) {
            return Ok(vec![between]);
        }
        return halves(solver, [a, b], between, looks);
    }
    match place_to_look(&link.pairs).filter(|_| looks < LOOKS.count()) {
        Some(share) => {
            let speed = a.speed + share * width;
            halves(solver, [a, b], solver.at(speed)?, looks + 1)
        }
        None => Ok(Vec::new()),
    }
}

fn halves(
    solver: &Solver<'_>,
    [a, b]: [&Spectrum; 2],
    between: Spectrum,
    looks: usize,
) -> Result<Vec<Spectrum>, SpectrumError> {
    let mut spectra = within(solver, a, &between, looks)?;
    let after = within(solver, &between, b, looks)?;
    spectra.push(between);
    spectra.extend(after);
    Ok(spectra)
}

/// Whether the cubic of a pair meets the growth in the middle.
fn is_drawn(solver: &Solver<'_>, pair: &Pair, middle: &Spectrum) -> bool {
    let expected = pair.at(0.5);
    let found = middle.nearest(pair.ends[0].component, expected);
    found.is_some_and(|found| {
        let size = pair.growth().max(found.lambda.re);
        let tolerance = CURVE_TOLERANCE.get() * size + CURVE_FLOOR * solver.highest();
        (found.lambda.re - expected.re).abs() <= tolerance
    })
}

/// Share of an interval at which something may grow though nothing does at its ends: where the
/// cubic of a pair is above zero, and where a reflected wave crosses another one in frequency,
/// which is the only place at which two light dampings can be outdone by a weak coupling.
fn place_to_look(pairs: &[Pair]) -> Option<f64> {
    const SHARES: u32 = 32;
    let inner = |k: u32| f64::from(k) / f64::from(SHARES);
    for pair in pairs {
        let growth = |k: &u32| pair.at(inner(*k)).re;
        let top = (1..SHARES).max_by(|x, y| growth(x).total_cmp(&growth(y)));
        if let Some(top) = top.filter(|top| growth(top) > 0.0) {
            return Some(inner(top));
        }
    }
    let reflected = pairs.iter().filter(|p| p.ends[0].action < 0);
    let mut crossings = reflected.flat_map(|minus| {
        let others = pairs.iter().filter(|p| p.ends[0].action > 0);
        let others = others.filter(|p| p.ends[0].component == minus.ends[0].component);
        others.filter_map(|plus| crossing(plus, minus))
    });
    crossings.next()
}

/// Share of an interval at which the frequencies of two pairs are equal; `None` where they are
/// not, or only at an end.
fn crossing(plus: &Pair, minus: &Pair) -> Option<f64> {
    const END: f64 = 1e-3;
    let apart = |share: f64| plus.at(share).im - minus.at(share).im;
    if (apart(0.0) < 0.0) == (apart(1.0) < 0.0) {
        return None;
    }
    let share = share_of_zero(apart);
    (END..1.0 - END).contains(&share).then_some(share)
}

/// One eigenvalue over speed: (index of the spectrum, index in it), a spectrum each.
pub type Path = Vec<(usize, usize)>;

/// The paths of eigenvalues through spectra of ascending speeds. One ends where its eigenvalue
/// leaves the sound range, and where a complex pair becomes two real ones or back.
pub fn paths(solver: &Solver<'_>, spectra: &[Spectrum]) -> Vec<Path> {
    let mut paths: Vec<Path> = Vec::new();
    let mut current: Vec<usize> = Vec::new();
    for (index, spectrum) in spectra.iter().enumerate() {
        let mut next = vec![usize::MAX; spectrum.values.len()];
        if let Some(before) = index.checked_sub(1).map(|i| &spectra[i]) {
            for pair in Link::new(before, spectrum, solver.highest(), LAST).pairs {
                next[pair.after] = current[pair.before];
            }
        }
        for (value, path) in next.iter_mut().enumerate() {
            if *path == usize::MAX {
                *path = paths.len();
                paths.push(Path::new());
            }
            paths[*path].push((index, value));
        }
        current = next;
    }
    paths
}
