//! Pairs of two lists by distance.

/// Partner in the second of two lists of each element of the first, or none: the nearest pairs first, each element in one pair.
/// A pair without a distance is none.
pub fn nearest_pairs(
    [first, second]: [usize; 2],
    distance: impl Fn(usize, usize) -> Option<f64>,
) -> Vec<Option<usize>> {
    let all = (0..first).flat_map(|i| (0..second).map(move |k| (i, k)));
    let mut pairs: Vec<(f64, usize, usize)> = all
        .filter_map(|(i, k)| Some((distance(i, k)?, i, k)))
        .collect();
    pairs.sort_by(|x, y| x.0.total_cmp(&y.0));
    let mut partners = vec![None; first];
    let mut is_taken = vec![false; second];
    for (_, i, k) in pairs {
        if partners[i].is_none() && !is_taken[k] {
            partners[i] = Some(k);
            is_taken[k] = true;
        }
    }
    partners
}
