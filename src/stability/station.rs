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

#[cfg(test)]
mod tests {
    use super::Sign::{Merged, Minus, Plus, Real};
    use super::*;

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
