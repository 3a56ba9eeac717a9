//! The Krein signature of the low spectrum of an undamped blade at one speed.

use faer::c64;

use super::pieces::{Grouped, Piece};
use crate::modes::{Mode, ModeKind};

/// Kind of a mode, by its eigenvalue and Krein sign.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sign {
    /// λ = iω, ω > 0, with Krein sign +1.
    Plus,
    /// λ = iω, ω > 0, with Krein sign −1: a reflected wave.
    Minus,
    /// λ = σ + iω, σ > 0: a + and a − mode that have coalesced.
    Quadruple,
    /// λ = σ > 0: divergence.
    Real,
}

/// A mode in the search for bands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SignedMode {
    /// Kind of mode.
    pub sign: Sign,
    /// λ, in 1/s.
    pub lambda: c64,
    /// dλ/dΩ, dimensionless.
    pub slope: c64,
}

/// Modes at one speed up to the last that can take part in a band.
#[derive(Debug, Clone, PartialEq)]
pub struct Signature {
    /// Rotation speed Ω.
    pub speed_rad_per_s: f64,
    /// Waves of both signs by frequency, up to the first + mode above the last − mode: higher ones have no
    /// partner to coalesce with.
    pub waves: Vec<SignedMode>,
    /// Coalesced modes by frequency.
    pub quadruples: Vec<SignedMode>,
    /// Real λ > 0, ascending.
    pub real: Vec<SignedMode>,
}

impl Signature {
    /// Signature of the modes of an undamped blade at a speed.
    pub fn new<'a>(speed_rad_per_s: f64, modes: impl Iterator<Item = &'a Mode>) -> Self {
        let mut signature = Signature {
            speed_rad_per_s,
            waves: Vec::new(),
            quadruples: Vec::new(),
            real: Vec::new(),
        };
        for mode in modes {
            let (sign, list) = match mode.kind {
                ModeKind::Positive => (Sign::Plus, &mut signature.waves),
                ModeKind::Negative => (Sign::Minus, &mut signature.waves),
                ModeKind::Flutter => (Sign::Quadruple, &mut signature.quadruples),
                ModeKind::Divergent => (Sign::Real, &mut signature.real),
                ModeKind::Decaying | ModeKind::Rigid | ModeKind::Damped => continue,
            };
            let (lambda, slope) = match sign {
                Sign::Plus | Sign::Minus | Sign::Quadruple => (mode.lambda, mode.slope),
                Sign::Real => (c64::from(mode.lambda.re), c64::from(mode.slope.re)),
            };
            list.push(SignedMode {
                sign,
                lambda,
                slope,
            });
        }
        signature.sorted()
    }

    /// Signature at a speed within a piece of a search, interpolated, with one wave of unlimited frequency above all others. `None`
    /// if the piece was not settled, or if it does not show which of two waves has which sign.
    pub fn within(piece: &Piece, speed_rad_per_s: f64) -> Option<Self> {
        let mut signature = Signature {
            speed_rad_per_s,
            waves: Vec::new(),
            quadruples: Vec::new(),
            real: Vec::new(),
        };
        for grouped in &piece.groups {
            signature.extend(piece, grouped)?;
        }
        // The pieces end in a gap above the height of the search. Waves beyond it are not reflected.
        signature.waves.push(SignedMode {
            sign: Sign::Plus,
            lambda: c64::new(0.0, f64::INFINITY),
            slope: c64::new(0.0, 0.0),
        });
        (!piece.groups.is_empty()).then(|| signature.sorted())
    }

    /// Adds the modes of a group.
    fn extend(&mut self, piece: &Piece, grouped: &Grouped) -> Option<()> {
        let mut squares = grouped.group.sloped_at(self.speed_rad_per_s);
        if grouped.sign.is_some() {
            // Waves of one sign cannot coalesce: where they cross, an imaginary part is an error of the interpolation.
            let real = squares
                .iter_mut()
                .flat_map(|(square, slope)| [square, slope]);
            real.for_each(|number| number.im = 0.0);
        }
        squares.sort_by(|x, y| x.0.re.total_cmp(&y.0.re));
        let is_wave = |square: c64| square.im == 0.0 && square.re < 0.0;
        let count = squares
            .iter()
            .filter(|(square, _)| is_wave(*square))
            .count();
        let mut signs = piece.signs(grouped, count)?.into_iter();
        for (square, slope) in squares {
            let (sign, list) = match (is_wave(square), square.im) {
                (true, _) if signs.next()? > 0 => (Sign::Plus, &mut self.waves),
                (true, _) => (Sign::Minus, &mut self.waves),
                (false, 0.0) => (Sign::Real, &mut self.real),
                (false, im) if im > 0.0 => (Sign::Quadruple, &mut self.quadruples),
                (false, _) => continue,
            };
            let lambda = if is_wave(square) {
                c64::new(0.0, (-square.re).sqrt())
            } else {
                square.sqrt()
            };
            list.push(SignedMode {
                sign,
                lambda,
                slope: slope / (2.0 * lambda),
            });
        }
        Some(())
    }

    /// The signature in order, without waves that have no partner to coalesce with.
    fn sorted(mut self) -> Self {
        let by_frequency = |x: &SignedMode, y: &SignedMode| x.lambda.im.total_cmp(&y.lambda.im);
        self.waves.sort_by(by_frequency);
        self.quadruples.sort_by(by_frequency);
        let by_growth = |x: &SignedMode, y: &SignedMode| x.lambda.re.total_cmp(&y.lambda.re);
        self.real.sort_by(by_growth);
        let last = self.waves.iter().rposition(|w| w.sign == Sign::Minus);
        self.waves.truncate(last.map_or(1, |last| last + 2));
        self
    }

    /// The fastest growing divergent mode.
    pub fn divergence(&self) -> Option<SignedMode> {
        self.real.last().copied()
    }

    /// Highest frequency of waves and quadruples, in rad/s.
    pub fn highest_rad_per_s(&self) -> f64 {
        let modes = self.waves.iter().chain(&self.quadruples);
        modes.fold(0.0, |top, mode| mode.lambda.im.max(top))
    }
}
