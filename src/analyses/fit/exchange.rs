//! Saws with the fitted numbers of two guides exchanged.

use crate::model::scene::Freed;

/// The places of guides are not exchanged: with the places too, equal guides are only numbered anew.
const PLACE: &str = "angle_deg";

/// Shares at which two guides have exchanged the numbers that are free for both, for each pair of such guides.
///
/// Saws with exchanged guides have similar frequencies, and between them is a ridge that no descent crosses.
pub fn exchanged(freed: &[Freed], shares: &[f64]) -> Vec<Vec<f64>> {
    let guides: Vec<Option<(&str, &str)>> = freed.iter().map(guide_and_key).collect();
    let mut names: Vec<&str> = guides.iter().flatten().map(|(guide, _)| *guide).collect();
    names.sort_unstable();
    names.dedup();
    let pairs = (0..names.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
    let of_pair = |(i, j): (usize, usize)| {
        let mut changed = shares.to_vec();
        for (k, l) in common(&guides, names[i], names[j]) {
            let value = |m: usize| freed[m].value(shares[m]);
            changed[k] = freed[k].share(value(l)).clamp(0.0, 1.0);
            changed[l] = freed[l].share(value(k)).clamp(0.0, 1.0);
        }
        (changed != shares).then_some(changed)
    };
    pairs.filter_map(of_pair).collect()
}

/// Numbers of the free keys that two guides have in common.
fn common(guides: &[Option<(&str, &str)>], first: &str, second: &str) -> Vec<(usize, usize)> {
    let of = |guide: &str| -> Vec<(usize, &str)> {
        let all = guides.iter().enumerate();
        let own = all.filter_map(|(k, found)| found.map(|(name, key)| (k, name, key)));
        let own = own.filter(|(_, name, key)| *name == guide && *key != PLACE);
        own.map(|(k, _, key)| (k, key)).collect()
    };
    let (first, second) = (of(first), of(second));
    let both = first.iter().filter_map(|(k, key)| {
        let other = second.iter().find(|(_, other)| other == key);
        other.map(|(l, _)| (*k, *l))
    });
    both.collect()
}

/// `guides[1]` and `radius_m` of `guides[1].radius_m`; `None` for other numbers.
fn guide_and_key(freed: &Freed) -> Option<(&str, &str)> {
    let (guide, key) = freed.parameter.path().split_once('.')?;
    guide.starts_with("guides[").then_some((guide, key))
}
