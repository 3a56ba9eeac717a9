//! The search by pieces on the reduced model.

use std::sync::atomic::{AtomicUsize, Ordering};

use faer::c64;
use sawflutter::model::evenly_spaced;
use sawflutter::modes::waves::WaveModel;
use sawflutter::stability::{Grouped, Piece, Plane, Sample, Search};

use super::vectors::{REAL, Root, undamped_roots};

/// Largest number of eigenproblems.
const MOST: usize = 4000;
/// Number of eigenvalues above the window that a sample has.
const BESIDES: usize = 8;

/// Pieces of a saw.
pub struct Searched {
    /// Pieces, by speed, of each component of the saw.
    pub pieces: Vec<Vec<Piece>>,
    /// Number of eigenproblems.
    pub eigenproblems: usize,
    plane: Plane,
}

/// |λ| of a free rigid motion, which is zero except for rounding, as a share of the window.
const RIGID: f64 = 3e-6;

/// Frequency of a mode above all others of every sample, in multiples of the reach.
const FENCE: f64 = 3.0;

/// Data that a search needs besides its model.
#[derive(Debug, Clone, Copy)]
pub struct Scope {
    /// Top of the window, in 1/s.
    pub window: f64,
    /// Relative error allowed for eigenvalues and growth.
    pub tolerance: f64,
    /// Growth that does not matter, in 1/s.
    pub noise_per_s: f64,
    /// Number of free rigid motions, each of which has λ = 0 twice at every speed.
    pub rigid: usize,
    /// Whether nothing damps.
    pub is_conservative: bool,
}

/// All eigenvalues at a speed with Im λ ≥ 0 within the reach.
pub fn roots(model: &WaveModel, speed: f64, scope: Scope) -> Vec<Root> {
    if scope.is_conservative {
        return undamped_roots(model, speed, scope.window);
    }
    let found = model.eigenvalues(speed).expect("converges").into_iter();
    found
        .map(|(lambda, slope)| Root {
            lambda,
            slope,
            sign: 0,
        })
        .collect()
}

/// Eigenvalues at a speed as a sample of the search, without those beyond the reach of the model.
fn sample(model: &WaveModel, speed: f64, scope: Scope, plane: Plane) -> Sample {
    let Scope { window, rigid, .. } = scope;
    let mut roots = roots(model, speed, scope);
    roots.sort_by(|x, y| x.lambda.norm().total_cmp(&y.lambda.norm()));
    let zeros = roots.partition_point(|root| root.lambda.norm() < RIGID * window);
    roots.drain(..zeros.min(2 * rigid));
    roots.sort_by(|x, y| x.lambda.im.total_cmp(&y.lambda.im));
    let followed = roots.partition_point(|root| root.lambda.im <= window);
    roots.truncate(followed + BESIDES);
    // A component of a saw may have nothing above the window for the search to end in.
    roots.push(Root {
        lambda: c64::new(0.0, FENCE * model.reach_per_s()),
        slope: c64::new(0.0, 0.0),
        sign: 1,
    });
    let finite = |z: c64| if z.is_finite() { z } else { c64::new(0.0, 0.0) };
    if plane == Plane::Eigenvalues {
        let sloped = roots.iter().map(|r| (r.lambda, finite(r.slope)));
        return Sample::new(speed, sloped);
    }
    let mut squares = Vec::new();
    for root in &roots {
        let (lambda, own_slope) = (root.lambda, root.slope);
        let is_part = |part: f64| part.abs() > REAL * (lambda.norm() + 1e-3 * window);
        let (square, slope) = (lambda * lambda, finite(2.0 * lambda * own_slope));
        let real = |z: c64| c64::new(z.re, 0.0);
        match (is_part(lambda.re), is_part(lambda.im)) {
            // Both modes of a quadruple ±σ + iω have Im λ > 0, and their squares are conjugates.
            (true, true) => squares.push(((square, slope), 0)),
            // Of two real eigenvalues ±σ one gives the square.
            (true, false) if lambda.re < 0.0 => (),
            (true, false) => squares.push(((real(square), real(slope)), 0)),
            _ => squares.push(((real(square), real(slope)), root.sign)),
        }
    }
    Sample::of_squares(speed, squares)
}

/// Whether all numbers of a group are waves of one Krein sign at both ends.
fn is_definite(piece: &Piece, grouped: &Grouped) -> bool {
    let mut signs = [0, 1].into_iter().flat_map(|end| {
        let places = grouped.places[end].iter();
        places.map(move |place| piece.ends[end].signs.get(*place).copied().unwrap_or(0))
    });
    let first = signs.next().unwrap_or(0);
    first != 0 && signs.all(|sign| sign == first)
}

impl Searched {
    /// Searches component by component.
    pub fn new(model: &WaveModel, scope: Scope) -> Self {
        let plane = if scope.is_conservative {
            Plane::Squares
        } else {
            Plane::Eigenvalues
        };
        let components = model.components();
        let spent = AtomicUsize::new(0);
        let searched = |component: &WaveModel| {
            let solve = |speed: f64| {
                let found = sample(component, speed, scope, plane);
                let most = spent.fetch_add(1, Ordering::Relaxed) >= MOST;
                Ok(Some(found).filter(|_| !most))
            };
            let search = Search {
                plane,
                top_rad_per_s: scope.window,
                tolerance: scope.tolerance,
                growth_tolerance: scope.tolerance,
                noise_per_s: scope.noise_per_s,
                solve: &solve,
            };
            let speeds = evenly_spaced(component.range_rad_per_s().ends(), 9);
            let found = search.pieces(&speeds);
            found.expect("no eigenproblem fails")
        };
        Searched {
            pieces: components.iter().map(searched).collect(),
            eigenproblems: spent.load(Ordering::Relaxed),
            plane,
        }
    }

    /// Width of the pieces that were given up, in rad/s.
    pub fn lost(&self) -> f64 {
        let lost = self
            .pieces
            .iter()
            .flatten()
            .filter(|piece| piece.groups.is_empty());
        lost.map(|p| p.ends[1].speed_rad_per_s - p.ends[0].speed_rad_per_s)
            .sum()
    }

    /// Eigenvalues with Im λ ≥ 0 at a speed, read off the pieces; for an undamped saw those that grow and the waves.
    pub fn eigenvalues(&self, speed: f64) -> Vec<c64> {
        let inside = |piece: &&Piece| {
            piece.ends[0].speed_rad_per_s <= speed && speed <= piece.ends[1].speed_rad_per_s
        };
        let here = self
            .pieces
            .iter()
            .filter_map(|part| part.iter().find(inside));
        let numbers = here.flat_map(|piece| {
            let of = |grouped: &Grouped| {
                let mut numbers = grouped.group.at(speed);
                // Waves of one Krein sign do not coalesce: what their interpolation shows beside the axis is its error.
                if is_definite(piece, grouped) {
                    numbers.iter_mut().for_each(|z| z.im = 0.0);
                }
                numbers
            };
            piece.groups.iter().flat_map(of)
        });
        let mut found = Vec::new();
        for number in numbers {
            match self.plane {
                Plane::Eigenvalues if number.im >= 0.0 => found.push(number),
                Plane::Eigenvalues => (),
                Plane::Squares => {
                    let root = number.sqrt();
                    if number.im > REAL * number.norm() || number.im.abs() <= REAL * number.norm() {
                        found.push(c64::new(root.re, root.im.abs()));
                    }
                }
            }
        }
        found
    }
}
