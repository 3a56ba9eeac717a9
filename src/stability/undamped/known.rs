//! Modes of an undamped blade between the speeds of its search.

use std::collections::BTreeSet;

use faer::{Col, c64};

use crate::modes::branches::ModesAt;
use crate::modes::{Mode, ModeKind, SpectralModel, smallest};
use crate::stability::group::Sloped;
use crate::stability::pieces::{Grouped, Piece};
use crate::stability::sample::squared;

/// Pieces of a search and the modes at its speeds.
pub struct Known<'a> {
    pub model: &'a SpectralModel,
    pub pieces: Vec<Piece>,
    /// Modes by ascending speed.
    pub solved: Vec<ModesAt>,
}

impl Known<'_> {
    /// Modes at a speed; `None` if no piece shows them.
    pub fn modes_at(&self, speed_rad_per_s: f64) -> Option<Vec<Mode>> {
        let piece = Piece::settled(&self.pieces, speed_rad_per_s)?;
        let mut modes = Vec::new();
        for grouped in &piece.groups {
            let component = self.component(piece, grouped)?;
            let squares = piece.squares_at(grouped, speed_rad_per_s)?;
            if grouped.sign.is_some() && cross(&squares) {
                return None;
            }
            let squares = squares.into_iter();
            modes.extend(squares.flat_map(|(number, sign)| modes_of(number, sign, component)));
        }
        Some(modes)
    }

    /// Component of all modes of a group; `None` if there are several.
    fn component(&self, piece: &Piece, grouped: &Grouped) -> Option<usize> {
        if self.model.components.len() == 1 {
            return Some(0);
        }
        let mut found = BTreeSet::new();
        for (end, places) in piece.ends.iter().zip(&grouped.places) {
            let speed = |at: &ModesAt| at.speed_rad_per_s;
            let at = self
                .solved
                .partition_point(|at| speed(at) < end.speed_rad_per_s);
            let modes = &self.solved.get(at)?.modes;
            for place in places {
                let (square, _) = end.eigenvalues[*place];
                let off = |mode: &&Mode| (squared((mode.lambda, mode.slope)).0 - square).norm();
                found.insert(smallest(modes, off)?.component);
            }
        }
        found.pop_first().filter(|_| found.is_empty())
    }
}

/// Waves of one sign whose squares differ by less than this share cross: the interpolation does not show whether they do, or veer, and
/// their slopes, by which branches are followed, are wrong.
const CROSSING: f64 = 0.02;

/// Whether two of some ascending squares cross.
fn cross(squares: &[(Sloped, i8)]) -> bool {
    let mut pairs = squares.windows(2);
    pairs.any(|pair| {
        let [first, second] = [pair[0].0.0.re, pair[1].0.0.re];
        (first - second).abs() < CROSSING * first.abs().max(second.abs())
    })
}

/// The modes of a number λ² with the Krein sign of a wave: one, or a growing and a decaying one of a quadruple, which the
/// conjugate number has, too.
fn modes_of((square, slope): Sloped, sign: i8, component: usize) -> Vec<Mode> {
    let lambda = square.sqrt();
    let growing = |kind: ModeKind| Mode {
        lambda,
        kind,
        slope: slope / (2.0 * lambda),
        action: 1,
        component,
        coordinates: Col::zeros(0),
    };
    if sign != 0 {
        let frequency = (-square.re).sqrt();
        let kind = if sign > 0 {
            ModeKind::Positive
        } else {
            ModeKind::Negative
        };
        let wave = Mode {
            lambda: c64::new(0.0, frequency),
            slope: c64::new(0.0, -0.5 * slope.re / frequency),
            action: sign,
            ..growing(kind)
        };
        return vec![wave];
    }
    if square.im == 0.0 {
        return vec![growing(ModeKind::Divergent)];
    }
    if square.im < 0.0 {
        return Vec::new();
    }
    let flutter = growing(ModeKind::Flutter);
    let decaying = Mode {
        lambda: -flutter.lambda.conj(),
        slope: -flutter.slope.conj(),
        kind: ModeKind::Decaying,
        action: -1,
        ..flutter.clone()
    };
    vec![flutter, decaying]
}
