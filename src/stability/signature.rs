//! The Krein signature of the low spectrum of an undamped blade at one speed, and what can
//! have happened between two speeds.

use faer::c64;

use super::interpolation::Cubic;
use crate::spectrum::{Mode, ModeKind};

/// What a mode is, by its eigenvalue and Krein sign.
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

/// A mode as the search for bands sees it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SignedMode {
    /// What it is.
    pub sign: Sign,
    /// λ, in 1/s.
    pub lambda: c64,
    /// dλ/dΩ, dimensionless.
    pub slope: c64,
}

/// The modes of one speed up to the last that a band can involve.
#[derive(Debug, Clone, PartialEq)]
pub struct Signature {
    /// Ω.
    pub speed_rad_per_s: f64,
    /// Waves of both signs by frequency, up to the first + mode above the last − mode: the
    /// others have nothing to coalesce with.
    pub waves: Vec<SignedMode>,
    /// Coalesced modes by frequency.
    pub quadruples: Vec<SignedMode>,
    /// Real λ > 0, ascending.
    pub real: Vec<SignedMode>,
}

impl Signature {
    /// Of the modes of a speed.
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
                Sign::Plus | Sign::Minus => (
                    c64::new(0.0, mode.lambda.im),
                    c64::new(0.0, mode.frequency_slope),
                ),
                Sign::Quadruple => (mode.lambda, mode.growth_slope),
                Sign::Real => (
                    c64::new(mode.lambda.re, 0.0),
                    c64::new(mode.growth_slope.re, 0.0),
                ),
            };
            list.push(SignedMode {
                sign,
                lambda,
                slope,
            });
        }
        let by_frequency = |x: &SignedMode, y: &SignedMode| x.lambda.im.total_cmp(&y.lambda.im);
        signature.waves.sort_by(by_frequency);
        signature.quadruples.sort_by(by_frequency);
        let by_growth = |x: &SignedMode, y: &SignedMode| x.lambda.re.total_cmp(&y.lambda.re);
        signature.real.sort_by(by_growth);
        let last = signature.waves.iter().rposition(|w| w.sign == Sign::Minus);
        signature.waves.truncate(last.map_or(1, |last| last + 2));
        signature
    }

    /// Signs of the waves by frequency, without the + at the end.
    pub fn order(&self) -> Vec<Sign> {
        let mut order: Vec<Sign> = self.waves.iter().map(|w| w.sign).collect();
        while order.last() == Some(&Sign::Plus) {
            order.pop();
        }
        order
    }

    /// By Krein's theory the number of negative eigenvalues of K(Ω), see
    /// [`ModeKind::krein_index`].
    pub fn krein_index(&self) -> usize {
        let negative = self.waves.iter().filter(|w| w.sign == Sign::Minus).count();
        let counts = [
            (ModeKind::Divergent, self.real.len()),
            (ModeKind::Flutter, self.quadruples.len()),
            (ModeKind::Negative, negative),
        ];
        let share = |(kind, count): (ModeKind, usize)| kind.krein_index() * count;
        counts.into_iter().map(share).sum()
    }

    /// Largest growth of a divergent mode.
    pub fn divergence(&self) -> Option<SignedMode> {
        self.real.last().copied()
    }

    /// Highest frequency looked at, in rad/s.
    pub fn highest_rad_per_s(&self) -> f64 {
        let modes = self.waves.iter().chain(&self.quadruples);
        modes.fold(0.0, |top, mode| mode.lambda.im.max(top))
    }
}

/// The order of the waves at two speeds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Change {
    /// The same.
    None,
    /// Two neighbours, of which the lower has this index, have changed places.
    Exchange(usize),
    /// Two neighbours of opposite sign are gone at the second speed, or have come.
    Pair,
    /// More than one of these: look in between.
    Several,
}

/// Reads the change between two orders of waves.
pub fn change(before: &[Sign], after: &[Sign]) -> Change {
    if before == after {
        return Change::None;
    }
    let opposite = |pair: &[Sign]| pair[0] != pair[1];
    let exchanged = |place: usize| {
        let mut exchanged = padded(before, after.len().max(before.len()));
        exchanged.swap(place, place + 1);
        opposite(&exchanged[place..place + 2]) && trimmed(&exchanged) == after
    };
    let longest = before.len().max(after.len());
    if let Some(place) = (0..longest.saturating_sub(1)).find(|&place| exchanged(place)) {
        return Change::Exchange(place);
    }
    let without_a_pair = |more: &[Sign], fewer: &[Sign]| {
        let more = padded(more, more.len() + 1);
        (0..more.len() - 1).any(|place| {
            let rest = [&more[..place], &more[place + 2..]].concat();
            opposite(&more[place..place + 2]) && trimmed(&rest) == fewer
        })
    };
    if without_a_pair(before, after) || without_a_pair(after, before) {
        return Change::Pair;
    }
    Change::Several
}

/// With + modes above the highest that is listed: there always are such.
fn padded(order: &[Sign], length: usize) -> Vec<Sign> {
    let mut padded = order.to_vec();
    padded.resize(length, Sign::Plus);
    padded
}

fn trimmed(order: &[Sign]) -> &[Sign] {
    let last = order.iter().rposition(|sign| *sign == Sign::Minus);
    &order[..last.map_or(0, |last| last + 1)]
}

/// Where, as a share of the way from `a` to `b`, the widest gap lies between two speeds at
/// which a − and a + wave seem to cross. `None` where fewer than two seem to. The k-th wave
/// of a sign at `a` is taken for the k-th at `b`.
pub fn between_crossings(a: &Signature, b: &Signature) -> Option<f64> {
    let width = b.speed_rad_per_s - a.speed_rad_per_s;
    let waves = |sign: Sign| {
        let of = |signature: &Signature| -> Vec<SignedMode> {
            let waves = signature.waves.iter().filter(|w| w.sign == sign);
            waves.copied().collect()
        };
        of(a).into_iter().zip(of(b)).collect::<Vec<_>>()
    };
    let (plus, minus) = (waves(Sign::Plus), waves(Sign::Minus));
    let pairs = plus.iter().flat_map(|p| minus.iter().map(move |m| (p, m)));
    let gaps = pairs.map(|(p, m)| frequency_gap([&p.0, &m.0], [&p.1, &m.1], width));
    let crosses = |gap: &Cubic| gap.values[0] * gap.values[1] < 0.0;
    let mut crossings: Vec<f64> = gaps.filter(crosses).map(|gap| gap.sign_change()).collect();
    crossings.sort_by(f64::total_cmp);
    let gaps = crossings.windows(2);
    let widest = gaps.max_by(|x, y| (x[1] - x[0]).total_cmp(&(y[1] - y[0])))?;
    Some(0.5 * (widest[0] + widest[1]))
}

/// Speed at which the waves at two neighbouring places cross, which stand there in one order at
/// `a` and in the other at `b`, and the frequency of the crossing.
pub fn crossing(a: &Signature, b: &Signature, place: usize) -> Option<(f64, f64)> {
    let width = b.speed_rad_per_s - a.speed_rad_per_s;
    let [low, high] = a.waves.get(place..place + 2)?.try_into().ok()?;
    let [after_high, after_low]: [SignedMode; 2] =
        b.waves.get(place..place + 2)?.try_into().ok()?;
    let gap = frequency_gap([&low, &high], [&after_low, &after_high], width);
    let share = gap.sign_change();
    let way = Cubic {
        values: [low.lambda.im, after_low.lambda.im],
        slopes: [low.slope.im * width, after_low.slope.im * width],
    };
    Some((a.speed_rad_per_s + share * width, way.at(share)))
}

/// ω₂ − ω₁ of two modes over the way from one speed to another.
fn frequency_gap(left: [&SignedMode; 2], right: [&SignedMode; 2], width: f64) -> Cubic {
    let values = [left, right].map(|pair| pair[1].lambda.im - pair[0].lambda.im);
    let slopes = [left, right].map(|pair| (pair[1].slope.im - pair[0].slope.im) * width);
    Cubic { values, slopes }
}

/// Whether a + and a − mode next to each other, or two real λ, may coalesce and split again
/// between two speeds of the same signature: their gap closes at one end, opens at the other,
/// and its tangents meet below a quarter of the smaller gap.
pub fn may_touch(a: &Signature, b: &Signature) -> bool {
    let width = b.speed_rad_per_s - a.speed_rad_per_s;
    let dips = |gap: Cubic| {
        let ([left, right], [fall, rise]) = (gap.values, gap.slopes);
        if fall >= 0.0 || rise <= 0.0 {
            return false;
        }
        let meet = (right - left - rise) / (fall - rise);
        left + fall * meet.clamp(0.0, 1.0) < 0.25 * left.min(right)
    };
    let waves = a.waves.windows(2).zip(b.waves.windows(2));
    let opposite = |pair: &[SignedMode]| pair[0].sign != pair[1].sign;
    let mut waves = waves.filter(|(left, right)| opposite(left) && opposite(right));
    let real = a.real.windows(2).zip(b.real.windows(2));
    let growth_gap = |(left, right): (&[SignedMode], &[SignedMode])| {
        let ends = [left, right];
        Cubic {
            values: ends.map(|pair| pair[1].lambda.re - pair[0].lambda.re),
            slopes: ends.map(|pair| (pair[1].slope.re - pair[0].slope.re) * width),
        }
    };
    waves.any(|(x, y)| dips(frequency_gap([&x[0], &x[1]], [&y[0], &y[1]], width)))
        || real.map(growth_gap).any(dips)
}

#[cfg(test)]
mod tests {
    use super::Sign::{Minus, Plus};
    use super::*;

    fn wave(sign: Sign, frequency: f64, slope: f64) -> SignedMode {
        SignedMode {
            sign,
            lambda: c64::new(0.0, frequency),
            slope: c64::new(0.0, slope),
        }
    }

    fn signature(speed_rad_per_s: f64, waves: Vec<SignedMode>) -> Signature {
        Signature {
            speed_rad_per_s,
            waves,
            quadruples: Vec::new(),
            real: Vec::new(),
        }
    }

    /// A rising − wave passes + waves of constant 1, 2 and 4: at 1, 2 and 4 fifths.
    #[test]
    fn the_widest_gap_between_crossings_is_found() {
        let at = |speed, minus| {
            let mut waves = vec![wave(Minus, minus, 0.5)];
            waves.extend([1.0, 2.0, 4.0].map(|f| wave(Plus, f, 0.0)));
            signature(speed, waves)
        };
        let share = between_crossings(&at(10.0, 0.0), &at(20.0, 5.0)).unwrap();
        assert!((share - 0.6).abs() < 1e-6, "{share}");
        assert!(between_crossings(&at(10.0, 0.0), &at(12.0, 1.5)).is_none());
    }

    #[test]
    fn orders_tell_what_happened() {
        assert_eq!(change(&[Minus], &[Minus]), Change::None);
        assert_eq!(change(&[Minus], &[Plus, Minus]), Change::Exchange(0));
        assert_eq!(change(&[Plus, Minus], &[Minus]), Change::Exchange(0));
        assert_eq!(change(&[Minus], &[]), Change::Pair);
        assert_eq!(change(&[Minus, Plus, Minus], &[Minus]), Change::Pair);
        assert_eq!(change(&[Minus], &[Plus, Plus, Minus]), Change::Several);
        assert_eq!(
            change(&[Minus, Minus], &[Plus, Minus, Minus]),
            Change::Several
        );
    }

    /// Two waves 1 apart that close at slope 1 and open again touch in the middle of 2.
    #[test]
    fn waves_that_may_touch_between_two_speeds_are_suspected() {
        let at =
            |speed, slope| signature(speed, vec![wave(Minus, 1.0, slope), wave(Plus, 2.0, 0.0)]);
        assert!(may_touch(&at(10.0, 1.0), &at(12.0, -1.0)));
        assert!(!may_touch(&at(10.0, 1.0), &at(11.0, -1.0)));
        assert!(!may_touch(&at(10.0, -1.0), &at(12.0, 1.0)));
    }
}
