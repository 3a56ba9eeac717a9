//! The low spectrum of an undamped blade as a word of signs.

use crate::spectrum::{Mode, ModeKind};

/// One letter of the word.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sign {
    /// A real λ > 0: divergence.
    Real,
    /// ω > 0 with Krein sign +1.
    Plus,
    /// ω > 0 with Krein sign −1.
    Minus,
    /// Two modes merged: λ = ±σ + iω.
    Merged,
}

/// A letter with its numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Token {
    /// Which.
    pub sign: Sign,
    /// ω, in rad/s.
    pub frequency: f64,
    /// dω/dΩ.
    pub slope: f64,
    /// σ, in 1/s.
    pub growth: f64,
}

/// The tokens of one speed, by frequency, up to the last that a band can involve.
#[derive(Debug, Clone, PartialEq)]
pub struct Station {
    /// Ω.
    pub speed_rad_per_s: f64,
    /// The word.
    pub tokens: Vec<Token>,
}

impl Station {
    /// Reads the word off the modes of a speed. Only + modes lie above the last −
    /// mode; of these just the next one is kept, as what that − mode may meet.
    pub fn new<'a>(speed_rad_per_s: f64, modes: impl Iterator<Item = &'a Mode>) -> Self {
        let mut tokens: Vec<Token> = modes
            .filter_map(|mode| {
                let sign = match mode.kind {
                    ModeKind::Positive => Sign::Plus,
                    ModeKind::Negative => Sign::Minus,
                    ModeKind::Flutter => Sign::Merged,
                    ModeKind::Divergent => Sign::Real,
                    ModeKind::Decaying | ModeKind::Rigid | ModeKind::Damped => return None,
                };
                Some(Token {
                    sign,
                    frequency: if sign == Sign::Real {
                        0.0
                    } else {
                        mode.lambda.im
                    },
                    slope: mode.frequency_slope,
                    growth: mode.growth_per_s(),
                })
            })
            .collect();
        tokens.sort_by(|x, y| {
            x.frequency
                .total_cmp(&y.frequency)
                .then(x.growth.total_cmp(&y.growth))
        });
        let last = tokens.iter().rposition(|t| t.sign != Sign::Plus);
        tokens.truncate(last.map_or(1, |last| last + 2));
        Station {
            speed_rad_per_s,
            tokens,
        }
    }

    /// The word without the + at its end.
    pub fn word(&self) -> Vec<Sign> {
        let mut word: Vec<Sign> = self.tokens.iter().map(|t| t.sign).collect();
        while word.last() == Some(&Sign::Plus) {
            word.pop();
        }
        word
    }

    /// Tokens with every merged pair twice, so that a place in the list stays the
    /// same when two neighbours merge or part.
    pub fn doubled(&self) -> Vec<Token> {
        let twice = |t: &Token| std::iter::repeat_n(*t, if t.sign == Sign::Merged { 2 } else { 1 });
        self.tokens.iter().flat_map(twice).collect()
    }

    /// Number of tokens with a sign.
    pub fn count(&self, sign: Sign) -> usize {
        self.tokens.iter().filter(|t| t.sign == sign).count()
    }

    /// k_real + 2 k_flutter + 2 k_negative: by Krein's theory the number of negative
    /// eigenvalues of K(Ω).
    pub fn krein_index(&self) -> usize {
        self.count(Sign::Real) + 2 * self.count(Sign::Merged) + 2 * self.count(Sign::Minus)
    }

    /// Merged pairs, by frequency.
    pub fn merged(&self) -> impl Iterator<Item = &Token> {
        self.tokens.iter().filter(|t| t.sign == Sign::Merged)
    }

    /// Largest growth of a divergent mode.
    pub fn divergence(&self) -> Option<f64> {
        let real = self.tokens.iter().filter(|t| t.sign == Sign::Real);
        real.map(|t| t.growth).reduce(f64::max)
    }
}

/// What happened between two words.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Change {
    /// Nothing that the words show.
    None,
    /// Neighbours at this place of the doubled list exchanged their order.
    Exchange(usize),
    /// Neighbours at this place merged, or two real modes met.
    Merge(usize),
    /// A pair at this place parted.
    Part(usize),
    /// More than one thing: look in between.
    Several,
}

/// Reads the change between two words.
pub fn change(before: &[Sign], after: &[Sign]) -> Change {
    if before == after {
        return Change::None;
    }
    let double = |word: &[Sign]| -> Vec<Sign> {
        word.iter()
            .flat_map(|s| std::iter::repeat_n(*s, if *s == Sign::Merged { 2 } else { 1 }))
            .collect()
    };
    let (mut x, mut y) = (double(before), double(after));
    let length = x.len().max(y.len());
    x.resize(length, Sign::Plus);
    y.resize(length, Sign::Plus);
    let Some(first) = (0..length).find(|&i| x[i] != y[i]) else {
        return Change::Several;
    };
    if first + 1 >= length {
        return Change::Several;
    }
    if x[first + 2..] != y[first + 2..] {
        return Change::Several;
    }
    let pairable = |pair: &[Sign]| {
        matches!(
            pair,
            [Sign::Plus, Sign::Minus] | [Sign::Minus, Sign::Plus] | [Sign::Real, Sign::Real]
        )
    };
    let merged = [Sign::Merged, Sign::Merged];
    let (old, new) = (&x[first..first + 2], &y[first..first + 2]);
    // A merged pair begins at `first` only if an even number of merged letters lies before it in its run.
    match (old, new) {
        _ if pairable(old) && pairable(new) && old[0] != Sign::Real && new[0] != Sign::Real => {
            Change::Exchange(first)
        }
        _ if pairable(old) && new == merged => Change::Merge(first),
        _ if old == merged && pairable(new) => Change::Part(first),
        _ => Change::Several,
    }
}

/// Where, as a share of the way from `a` to `b`, the widest gap lies between two speeds at
/// which a − and a + wave seem to cross. `None` where fewer than two seem to. The k-th wave
/// of a sign at `a` is taken for the k-th at `b`, and to go the cubic way that frequencies
/// and slopes at both ends give it.
pub fn between_crossings(a: &Station, b: &Station) -> Option<f64> {
    let width = b.speed_rad_per_s - a.speed_rad_per_s;
    let waves = |sign: Sign| {
        let of = |station: &Station| -> Vec<Token> {
            let has = |t: &&Token| t.sign == sign || t.sign == Sign::Merged;
            station.tokens.iter().filter(has).copied().collect()
        };
        of(a).into_iter().zip(of(b)).collect::<Vec<_>>()
    };
    let (plus, minus) = (waves(Sign::Plus), waves(Sign::Minus));
    let pairs = plus.iter().flat_map(|p| minus.iter().map(move |m| (p, m)));
    let mut crossings: Vec<f64> = pairs
        .filter_map(|(p, m)| {
            let gap = |x: &Token, y: &Token| (y.frequency - x.frequency, y.slope - x.slope);
            let (left, right) = (gap(&p.0, &m.0), gap(&p.1, &m.1));
            let cubic = |t: f64| hermite(t, left.0, left.1 * width, right.0, right.1 * width);
            (left.0 * right.0 < 0.0).then(|| sign_change(left.0, cubic))
        })
        .collect();
    crossings.sort_by(f64::total_cmp);
    let gaps = crossings.windows(2);
    let widest = gaps.max_by(|x, y| (x[1] - x[0]).total_cmp(&(y[1] - y[0])))?;
    Some(0.5 * (widest[0] + widest[1]))
}

/// Speed and frequency at which the two waves at a place of the doubled list cross, which
/// stand there in one order at `a` and in the other at `b`.
pub fn crossing(a: &Station, b: &Station, place: usize) -> Option<(f64, f64)> {
    let width = b.speed_rad_per_s - a.speed_rad_per_s;
    let (left, right) = (a.doubled(), b.doubled());
    let (left, right) = (left.get(place..place + 2)?, right.get(place..place + 2)?);
    let way = |x: &Token, y: &Token, t: f64| {
        hermite(
            t,
            x.frequency,
            x.slope * width,
            y.frequency,
            y.slope * width,
        )
    };
    let gap = |t: f64| way(&left[0], &right[1], t) - way(&left[1], &right[0], t);
    let share = sign_change(gap(0.0), gap);
    let frequency = way(&left[0], &right[1], share);
    Some((a.speed_rad_per_s + share * width, frequency))
}

/// Zero in [0, 1] of a function that begins with `first` and ends with the other sign; to
/// no more digits than a guess has.
fn sign_change(first: f64, f: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..24 {
        let middle = 0.5 * (low + high);
        if f(middle) * first > 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

/// Cubic Hermite polynomial on [0, 1].
pub fn hermite(t: f64, f0: f64, d0: f64, f1: f64, d1: f64) -> f64 {
    let u = 1.0 - t;
    u * u * ((1.0 + 2.0 * t) * f0 + t * d0) + t * t * ((1.0 + 2.0 * u) * f1 - u * d1)
}

#[cfg(test)]
mod tests {
    use super::Sign::{Merged, Minus, Plus, Real};
    use super::*;

    #[test]
    fn the_hermite_cubic_meets_its_ends() {
        assert_eq!(hermite(0.0, 2.0, 1.0, 5.0, 1.0), 2.0);
        assert_eq!(hermite(1.0, 2.0, 1.0, 5.0, 1.0), 5.0);
        assert_eq!(hermite(0.5, 0.0, 1.0, 1.0, 1.0), 0.5);
    }

    /// A rising − wave passes + waves of constant 1, 2 and 4: at 1, 2 and 4 fifths.
    #[test]
    fn the_widest_gap_between_crossings_is_found() {
        let token = |sign, frequency, slope| Token {
            sign,
            frequency,
            slope,
            growth: 0.0,
        };
        let station = |speed_rad_per_s, wave| Station {
            speed_rad_per_s,
            tokens: [1.0, 2.0, 4.0]
                .map(|f| token(Plus, f, 0.0))
                .into_iter()
                .chain([token(Minus, wave, 0.5)])
                .collect(),
        };
        let share = between_crossings(&station(10.0, 0.0), &station(20.0, 5.0)).unwrap();
        assert!((share - 0.6).abs() < 1e-6, "{share}");
        assert!(between_crossings(&station(10.0, 0.0), &station(12.0, 1.5)).is_none());
    }

    #[test]
    fn words_tell_what_happened() {
        assert_eq!(change(&[Minus], &[Minus]), Change::None);
        assert_eq!(change(&[Minus], &[Plus, Minus]), Change::Exchange(0));
        assert_eq!(
            change(&[Minus, Plus, Minus], &[Minus, Merged]),
            Change::Merge(1)
        );
        assert_eq!(
            change(&[Merged, Merged], &[Merged, Plus, Minus]),
            Change::Part(2)
        );
        assert_eq!(change(&[Real, Real], &[Merged]), Change::Merge(0));
        assert_eq!(change(&[Minus], &[Plus, Plus, Minus]), Change::Several);
        assert_eq!(
            change(&[Minus, Minus], &[Plus, Minus, Minus]),
            Change::Several
        );
    }
}
