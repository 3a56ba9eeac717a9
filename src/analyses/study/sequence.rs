//! Evenly distributed points for random saws.
//!
//! The Sobol sequence with Owen's scrambling of [`sobol_burley`] ends after 2¹⁶ points. Longer studies
//! continue with blocks of 2¹⁶ points, each scrambled with its own seed: a replicated randomized net (Owen,
//! Journal of Complexity 13 (1997), 83; L'Ecuyer and Lemieux, in Modeling Uncertainty (2002), 419). Every
//! block is an unbiased estimate with the small variance of a net, and blocks are independent, so the mean of
//! b of them has this variance divided by b. This never exceeds the variance of as many independent points,
//! so that an interval for independent points is conservative.

/// Number of points in a block.
const BLOCK: u64 = 1 << 16;
/// Largest dimension of a point.
pub(super) const DIMENSIONS: usize = sobol_burley::NUM_DIMENSIONS as usize;
/// Largest number of points.
#[cfg(test)]
const POINTS: u64 = 1 << 32;
/// Half a step of the sequence's 24 bits. It shifts the coordinates, which begin at 0, into the open interval
/// from 0 to 1.
const HALF_STEP: f64 = 1.0 / (1u64 << 25) as f64;
/// Difference of the seeds of successive blocks: 2³² divided by the golden ratio. Its multiples up to 2¹⁶ are as far
/// as possible from each other and from 0 modulo 2³², so that studies whose seeds differ by less than 25 000 share no
/// block.
const SEED_STEP: u32 = 0x9E37_79B9;

/// A coordinate of a point, between 0 and 1, both excluded.
pub(super) fn even(point: u64, dimension: u32, seed: u32) -> f64 {
    let (block, place) = (point / BLOCK, point % BLOCK);
    let own = seed.wrapping_add((block as u32).wrapping_mul(SEED_STEP));
    f64::from(sobol_burley::sample(place as u32, dimension, own)) + HALF_STEP
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_two_seeds_of_a_study_are_near_each_other() {
        let steps = 1..(POINTS / BLOCK) as u32;
        let nearest = steps.map(|block| {
            let seed = block.wrapping_mul(SEED_STEP);
            seed.min(seed.wrapping_neg())
        });
        assert!(nearest.min() > Some(25_000));
    }

    /// Share of the points of a sequence with x + y < limit.
    fn share(points: std::ops::Range<u64>, seed: u32, limit: f64) -> f64 {
        let count = (points.end - points.start) as f64;
        let inside = points.filter(|&k| even(k, 0, seed) + even(k, 1, seed) < limit);
        inside.count() as f64 / count
    }

    /// Every block fills the square, and the errors of blocks are independent: the error of eight blocks
    /// together is √8 times smaller than that of one, and less than a tenth of that of independent points.
    #[test]
    fn blocks_are_even_and_independent() {
        let (limit, seeds) = (0.7_f64, 40);
        let exact = 0.5 * limit * limit;
        let mean_square = |of: &dyn Fn(u32) -> f64| {
            let squares = (0..seeds).map(|seed| (of(seed) - exact).powi(2));
            squares.sum::<f64>() / f64::from(seeds)
        };
        let far = POINTS - BLOCK;
        let first = mean_square(&|seed| share(0..BLOCK, seed, limit));
        let last = mean_square(&|seed| share(far..POINTS, seed, limit));
        let eight = mean_square(&|seed| share(0..8 * BLOCK, seed, limit));
        let independent = exact * (1.0 - exact) / BLOCK as f64;
        assert!(first < 0.01 * independent && last < 0.01 * independent);
        // The mean of 40 squares has a standard deviation of √(2/40) = 22 %; three of these are allowed for
        // each of the two means.
        let ratio = 8.0 * eight / first;
        assert!((0.4..2.5).contains(&ratio), "{ratio}");
    }

    /// In the first two coordinates each of 256 × 256 squares contains one of the 2¹⁶ points of a block, and
    /// in a single coordinate each of 2¹⁶ intervals does.
    #[test]
    fn each_block_is_a_net() {
        for block in [0, 1, 255, POINTS / BLOCK - 1] {
            let points = block * BLOCK..(block + 1) * BLOCK;
            let mut squares = vec![0_u32; BLOCK as usize];
            let mut stretches = vec![0_u32; BLOCK as usize];
            for k in points {
                let (x, y) = (even(k, 0, 7), even(k, 1, 7));
                squares[(256.0 * x) as usize * 256 + (256.0 * y) as usize] += 1;
                stretches[(BLOCK as f64 * even(k, 5, 7)) as usize] += 1;
            }
            assert!(squares.iter().all(|count| *count == 1), "{block}");
            assert!(stretches.iter().all(|count| *count == 1), "{block}");
        }
    }
}
