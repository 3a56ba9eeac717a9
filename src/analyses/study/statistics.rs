//! Quantiles of speeds, some of which may exceed the sweep, and confidence intervals of a probability.

use statrs::distribution::{Beta, ContinuousCDF};

/// A place among sorted values.
pub struct Rank {
    /// Rank of the value below, counted from 0.
    pub below: usize,
    /// Part of the way to the next value.
    part: f64,
}

/// Whether a sample of this size has a quantile of this share: at least one saw lies beyond it, on either side. The smallest and
/// the largest value are those of the sample.
pub fn is_resolved(share: f64, total: usize) -> bool {
    let finest = share.min(1.0 - share);
    finest == 0.0 || finest * total as f64 >= 1.0 - 1e-9
}

/// The rank of the quantile of `share` among `total` values (type 7
/// of Hyndman and Fan, The American Statistician 50 (1996), 361). `None` if there are no values.
pub fn rank(total: usize, share: f64) -> Option<Rank> {
    let place = share * total.checked_sub(1)? as f64;
    Some(Rank {
        below: place.floor() as usize,
        part: place - place.floor(),
    })
}

/// The value at a fractional rank, by linear interpolation; `value` returns the value at an integer rank.
pub fn between(Rank { below, part }: Rank, value: &dyn Fn(usize) -> Option<f64>) -> Option<f64> {
    let lower = value(below)?;
    if part == 0.0 {
        return Some(lower);
    }
    Some(lower + part * (value(below + 1)? - lower))
}

/// The quantile of `sorted`, ascending, extended by `beyond` values that are larger than any. `None` if the
/// quantile is one of these.
#[cfg(test)]
pub fn quantile(sorted: &[f64], beyond: usize, share: f64) -> Option<f64> {
    let rank = rank(sorted.len() + beyond, share)?;
    between(rank, &|rank| sorted.get(rank).copied())
}

/// The interval of Clopper and Pearson (Biometrika 26 (1934), 404) for a probability, from `passed` of `of`
/// independent trials. It contains the true value at least as often as the confidence states, for any
/// probability and number of trials.
pub fn interval(passed: usize, of: usize, confidence: f64) -> [f64; 2] {
    let tail = 0.5 * (1.0 - confidence);
    let beta = |a: usize, b: usize, share: f64| {
        let beta = Beta::new(a as f64, b as f64).expect("both are at least 1");
        beta.inverse_cdf(share)
    };
    let failed = of - passed;
    let low = match passed {
        0 => 0.0,
        _ => beta(passed, failed + 1, tail),
    };
    let high = match failed {
        0 => 1.0,
        _ => beta(passed + 1, failed, 1.0 - tail),
    };
    [low, high]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_lie_between_order_statistics_and_are_unknown_beyond_the_sweep() {
        let sorted = [1.0, 2.0, 4.0];
        assert_eq!(quantile(&sorted, 0, 0.0), Some(1.0));
        assert_eq!(quantile(&sorted, 0, 0.75), Some(3.0));
        assert_eq!(quantile(&sorted, 0, 1.0), Some(4.0));
        assert_eq!(quantile(&sorted, 2, 0.5), Some(4.0));
        assert_eq!(quantile(&sorted, 2, 0.6), None);
        assert_eq!(quantile(&[], 3, 0.0), None);
        assert_eq!(quantile(&[], 0, 0.5), None);
    }

    #[test]
    fn a_quantile_has_at_least_one_saw_on_either_side() {
        let found = [0.0, 0.01, 0.05, 0.5, 0.95, 0.999, 1.0].map(|share| is_resolved(share, 20));
        assert_eq!(found, [true, false, true, true, true, false, true]);
        assert!(is_resolved(0.999, 1000) && !is_resolved(0.999, 999));
        assert!(!is_resolved(0.5, 1) && is_resolved(0.5, 2));
    }

    /// Reference: the closed form (α/2)^(1/n) at the ends, and the definition of Clopper and Pearson, a
    /// binomial tail of α/2, summed term by term.
    #[test]
    fn the_interval_is_that_of_the_binomial_tails() {
        let [low, high] = interval(10, 10, 0.95);
        assert!(
            (low - 0.025_f64.powf(0.1)).abs() < 1e-10 && high == 1.0,
            "{low}"
        );
        let [low_of_all, high_of_all] = interval(0, 1000, 0.99);
        assert!(
            (high_of_all - (1.0 - 0.005_f64.powf(1e-3))).abs() < 1e-10 && low_of_all == 0.0,
            "{high_of_all}"
        );
        for (passed, of) in [(7, 10), (1, 3), (930, 1000), (2000, 4096)] {
            let [low_of_all, high_of_all] = interval(passed, of, 0.95);
            let above: f64 = (passed..=of).map(|k| binomial(of, k, low_of_all)).sum();
            let below: f64 = (0..=passed).map(|k| binomial(of, k, high_of_all)).sum();
            assert!((above - 0.025).abs() < 1e-8, "{passed} of {of}: {above}");
            assert!((below - 0.025).abs() < 1e-8, "{passed} of {of}: {below}");
        }
    }

    fn binomial(n: usize, k: usize, p: f64) -> f64 {
        let logarithm: f64 = (1..=k).map(|j| ((n - k + j) as f64 / j as f64).ln()).sum();
        (logarithm + k as f64 * p.ln() + (n - k) as f64 * (-p).ln_1p()).exp()
    }
}
