//! Numbers of the low eigenvalues of a saw at one speed: λ, or λ² with Krein signs.

use faer::c64;

use super::group::Sloped;
use super::instability_kind::InstabilityKind;
use crate::modes::{Mode, ModeKind};

/// Number of modes above the highest accurate frequency among which a search finds a gap to end in.
pub const BESIDES: usize = 8;

/// Numbers that a search follows over speed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Plane {
    /// λ, with the conjugate of each oscillating one.
    Eigenvalues,
    /// z = λ² of an undamped saw, one for each pair ±λ: a wave has z < 0, a divergent mode z > 0, and the two
    /// modes of a quadruple ±σ ± iω have conjugate z. A mode that turns into divergence passes z = 0 like any
    /// other number.
    Squares,
}

impl Plane {
    /// Growth rate Re λ of a number: for λ² that of the growing one of ±λ.
    pub fn growth_per_s(self, number: c64) -> f64 {
        match self {
            Plane::Eigenvalues => number.re,
            Plane::Squares => number.sqrt().re,
        }
    }

    /// Derivative of the growth rate with respect to the speed.
    pub fn growth_slope(self, (number, slope): Sloped) -> f64 {
        match self {
            Plane::Squares if number != c64::ZERO => (slope / (2.0 * number.sqrt())).re,
            // At λ² = 0 only its sign is finite.
            Plane::Squares | Plane::Eigenvalues => slope.re,
        }
    }

    /// Size of the number of an eigenvalue of a given size.
    pub fn sized(self, size_rad_per_s: f64) -> f64 {
        match self {
            Plane::Eigenvalues => size_rad_per_s,
            Plane::Squares => size_rad_per_s * size_rad_per_s,
        }
    }
}

/// Numbers at a speed.
#[derive(Debug, Clone)]
pub struct Sample {
    /// Rotation speed Ω, in rad/s.
    pub speed_rad_per_s: f64,
    /// Numbers by frequency. Conjugate eigenvalues lie symmetrically about the middle, conjugate squares side
    /// by side.
    pub eigenvalues: Vec<Sloped>,
    /// For an undamped saw the Krein sign of each wave, and zero for every other mode.
    pub signs: Vec<i8>,
}

/// A wave λ = iω of an undamped saw.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wave {
    /// Krein sign, −1 for a reflected wave.
    pub sign: i8,
    /// ω, in rad/s.
    pub frequency: f64,
    /// dω/dΩ.
    pub slope: f64,
}

impl Sample {
    /// A sample from eigenvalues with Im λ ≥ 0.
    pub fn new(speed_rad_per_s: f64, upper: impl Iterator<Item = Sloped>) -> Self {
        let mut eigenvalues: Vec<Sloped> = upper
            .flat_map(|(z, slope)| {
                let conjugate = (z.im > 0.0).then(|| (z.conj(), slope.conj()));
                [Some((z, slope)), conjugate].into_iter().flatten()
            })
            .collect();
        let order = |x: &Sloped, y: &Sloped| {
            let side = |z: c64| if z.im < 0.0 { -z.re } else { z.re };
            let by_frequency = x.0.im.total_cmp(&y.0.im);
            by_frequency.then(side(x.0).total_cmp(&side(y.0)))
        };
        eigenvalues.sort_by(order);
        Sample {
            speed_rad_per_s,
            eigenvalues,
            signs: Vec::new(),
        }
    }

    /// A sample from the squares of the eigenvalues of an undamped saw with their Krein signs.
    pub fn of_squares(speed_rad_per_s: f64, mut squares: Vec<(Sloped, i8)>) -> Self {
        let order = |x: &(Sloped, i8), y: &(Sloped, i8)| {
            let by_size = y.0.0.re.total_cmp(&x.0.0.re);
            by_size.then(x.0.0.im.total_cmp(&y.0.0.im))
        };
        squares.sort_by(order);
        Sample {
            speed_rad_per_s,
            eigenvalues: squares.iter().map(|(square, _)| *square).collect(),
            signs: squares.iter().map(|(_, sign)| *sign).collect(),
        }
    }

    /// A sample from modes of an undamped saw.
    pub fn of_modes<'a>(speed_rad_per_s: f64, modes: impl Iterator<Item = &'a Mode>) -> Self {
        use ModeKind::{Divergent, Flutter, Negative, Positive};
        let mut squares = Vec::new();
        for mode in modes {
            let (square, slope) = squared((mode.lambda, mode.slope));
            let real = |z: c64| c64::new(z.re, 0.0);
            match mode.kind {
                Flutter => {
                    squares.push(((square, slope), 0));
                    squares.push(((square.conj(), slope.conj()), 0));
                }
                Positive | Negative | Divergent => {
                    squares.push(((real(square), real(slope)), mode.krein_sign()));
                }
                ModeKind::Decaying | ModeKind::Rigid | ModeKind::Damped => (),
            }
        }
        Sample::of_squares(speed_rad_per_s, squares)
    }

    /// A sample from modes of an undamped saw with a positive definite K(Ω), which are waves of sign +. A real part is rounding: of
    /// two modes with one frequency, and of a rigid motion that turns with the blade, whose frequency is nearly zero near rest.
    pub fn of_definite_modes<'a>(
        speed_rad_per_s: f64,
        modes: impl Iterator<Item = &'a Mode>,
    ) -> Self {
        let waves = modes.filter(|mode| mode.lambda.im > 0.0).map(|mode| {
            let (frequency, slope) = (mode.lambda.im, mode.slope.im);
            let square = (
                c64::from(-frequency * frequency),
                c64::from(-2.0 * frequency * slope),
            );
            (square, 1)
        });
        Sample::of_squares(speed_rad_per_s, waves.collect())
    }

    /// Index between the eigenvalues and their conjugates.
    pub fn middle(&self) -> usize {
        self.eigenvalues.len() / 2
    }

    /// Waves of both signs by frequency, up to the first + wave above the last − wave: higher ones have no partner to
    /// coalesce with.
    pub fn waves(&self) -> Vec<Wave> {
        let signed = self.eigenvalues.iter().zip(&self.signs);
        let mut waves: Vec<Wave> = signed
            .filter(|(_, sign)| **sign != 0)
            .map(|((square, slope), sign)| {
                let frequency = (-square.re).sqrt();
                Wave {
                    sign: *sign,
                    frequency,
                    slope: -0.5 * slope.re / frequency,
                }
            })
            .collect();
        let last = waves.iter().rposition(|wave| wave.sign < 0);
        waves.truncate(last.map_or(1, |last| last + 2));
        waves
    }

    /// Indices of the numbers λ² that grow in a given way, the fastest divergence first.
    pub fn growing(&self, kind: InstabilityKind) -> impl Iterator<Item = usize> {
        let all = self.eigenvalues.iter().enumerate();
        let of_kind =
            all.filter(move |(_, (square, _))| InstabilityKind::of_square(*square) == Some(kind));
        of_kind.map(|(place, _)| place)
    }

    /// (σ + iω)² of the growing mode of each quadruple.
    pub fn quadruples(&self) -> impl Iterator<Item = Sloped> {
        self.growing(InstabilityKind::Flutter)
            .map(|place| self.eigenvalues[place])
    }

    /// σ² of real λ = σ > 0, the fastest growing first.
    pub fn divergences(&self) -> impl Iterator<Item = Sloped> {
        self.growing(InstabilityKind::Divergence)
            .map(|place| self.eigenvalues[place])
    }

    /// Highest frequency of waves that may coalesce and of quadruples, in rad/s.
    pub fn highest_rad_per_s(&self) -> f64 {
        let waves = self.waves().into_iter().map(|wave| wave.frequency);
        let quadruples = self.quadruples().map(|(square, _)| square.sqrt().im);
        waves.chain(quadruples).fold(0.0, f64::max)
    }
}

/// λ² and its slope from λ and its slope.
pub fn squared((lambda, slope): Sloped) -> Sloped {
    (lambda * lambda, 2.0 * lambda * slope)
}
