//! The reduced model in two stages.
//!
//! Stage one, once for a saw: waves that are far at every speed of the sweep, and the forces of columns, are eliminated
//! at the nodes of a Chebyshev series over the whole sweep ([`Middle`]). Waves are those of one speed in its middle, so
//! that every matrix is a polynomial in the speed. Stage two, at the nodes of each interval: waves that are far there, a
//! dense problem of some forty to hundred unknowns. A Schur complement of a Schur complement is that of both at once,
//! also in its power series.

use faer::Mat;

use super::interval::Interval;
use super::near::is_near;
use super::series::{Eliminated, Series, eliminate};

/// An unknown of stage one.
#[derive(Debug, Clone, Copy)]
pub enum Unknown {
    /// Displacement of a strong damper, which is always kept.
    Strong,
    /// A wave, with ω² at both ends of the sweep and n.
    Wave([f64; 2], f64),
}

/// Equations at a speed, by how many powers of λ.
pub type Equations<'a> = &'a dyn Fn(f64, usize) -> Series;

/// The saw after stage one.
pub struct Middle {
    unknowns: Vec<Unknown>,
    series: Interval,
    sweep: (f64, f64),
    window: f64,
    is_conservative: bool,
}

impl Middle {
    /// A series over the sweep, in rad/s, of equations in these unknowns.
    pub fn new(
        equations: Equations<'_>,
        unknowns: Vec<Unknown>,
        sweep: (f64, f64),
        (window, terms, nodes): (f64, usize, usize),
        is_conservative: bool,
    ) -> Self {
        let of = |speed: f64| equations(speed, terms);
        let series = Interval::of(&of, sweep, (unknowns.len(), nodes), window, terms);
        Middle {
            unknowns,
            series,
            sweep,
            window,
            is_conservative,
        }
    }

    /// The model of `count` equal intervals, for a cut in 1/s.
    pub fn intervals(&self, count: usize, cut: f64, terms: usize, nodes: usize) -> Vec<Interval> {
        let (low, high) = self.sweep;
        let end = |k: usize| low + (high - low) * k as f64 / count as f64;
        (0..count)
            .map(|k| self.interval((end(k), end(k + 1)), cut, terms, nodes))
            .collect()
    }

    fn interval(&self, range: (f64, f64), cut: f64, terms: usize, nodes: usize) -> Interval {
        let (low, high) = self.sweep;
        let is_kept = |unknown: &Unknown| match unknown {
            Unknown::Strong => true,
            Unknown::Wave([first, last], n) => [range.0, range.1].iter().any(|speed| {
                // ω² is concave in Ω²: this is at most its value, so that no near wave is left out.
                let share = (speed * speed - low * low) / (high * high - low * low);
                is_near(first + share * (last - first), n * speed, cut)
            }),
        };
        let all = 0..self.unknowns.len();
        let kept: Vec<usize> = all.filter(|k| is_kept(&self.unknowns[*k])).collect();
        let reduced = |speed: f64| split(&self.series.series(speed), &kept, terms);
        let mut found = Interval::of(&reduced, range, (kept.len(), nodes), self.window, terms);
        let strong = self
            .unknowns
            .iter()
            .filter(|u| matches!(u, Unknown::Strong));
        found.strong = strong.count();
        found.is_conservative = self.is_conservative;
        found
    }
}

/// The Schur complement on the unknowns `kept`.
pub fn split(all: &Series, kept: &[usize], terms: usize) -> Series {
    let order = all.0.iter().flatten().map(Mat::nrows).max().unwrap_or(0);
    let mut is_kept = vec![false; order];
    kept.iter().for_each(|&k| is_kept[k] = true);
    let far: Vec<usize> = (0..order).filter(|k| !is_kept[*k]).collect();
    let part = |rows: &[usize], columns: &[usize]| {
        let of =
            |m: &Mat<f64>| Mat::from_fn(rows.len(), columns.len(), |i, k| m[(rows[i], columns[k])]);
        Series(all.0.each_ref().map(|term| term.as_ref().map(of)))
    };
    let mut reduced = part(kept, kept);
    let parts = Eliminated {
        kept_by_far: &part(kept, &far),
        far_by_kept: &part(&far, kept),
        far: &part(&far, &far),
    };
    eliminate(&mut reduced, &parts, terms);
    reduced
}
