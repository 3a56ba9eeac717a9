//! Divergence: a real λ > 0 between critical speeds.

use super::band::{Instability, InstabilityKind};
use super::evaluator::{CRITICAL_GAP, CRITICAL_GROUP, SignatureEvaluator};
use super::flutter::VICINITY;
use super::maximum::{Sample, maximize};
use super::search_result::Found;
use super::signature::Signature;
use crate::model::scene::SpeedRange;
use crate::modes::{SpectralModel, SpectrumError, smallest};

/// Bands of divergence, from signatures in ascending order. They begin and end at critical speeds or at
/// `coalescences`, speeds at which two real λ coalesce and continue as flutter.
pub(super) fn divergence(
    model: &SpectralModel,
    evaluator: &SignatureEvaluator<'_>,
    signatures: &[Signature],
    coalescences: &[f64],
    range: SpeedRange,
) -> Result<Vec<Found>, SpectrumError> {
    let critical: Vec<f64> = model.critical.iter().map(|c| c.speed_rad_per_s).collect();
    let mut signatures = signatures.to_vec();
    for speed in unseen(&signatures, &critical, coalescences) {
        signatures.push(evaluator.at(speed)?);
    }
    signatures.sort_by(|x, y| x.speed_rad_per_s.total_cmp(&y.speed_rad_per_s));
    let is_unstable = |index: usize| !signatures[index].real.is_empty();
    let mut bands = Vec::new();
    let mut start = None;
    for index in (0..signatures.len()).filter(|&index| is_unstable(index)) {
        let first = *start.get_or_insert(index);
        let next = index + 1;
        if next == signatures.len() || !is_unstable(next) {
            let edge = |stable: Option<usize>, unstable: usize| {
                let stable = stable.map(|stable| signatures[stable].speed_rad_per_s);
                let unstable = signatures[unstable].speed_rad_per_s;
                edge(&critical, coalescences, stable, unstable)
            };
            let begins = edge(first.checked_sub(1), first);
            let ends = edge((next < signatures.len()).then_some(next), index);
            let unstable = &signatures[first..next];
            bands.push(Found::new(range, |limits| {
                band(evaluator, unstable, [begins, ends], limits)
            })?);
            start = None;
        }
    }
    Ok(bands)
}

/// Speeds between two signatures at which divergence may be interrupted, because two real λ coalesce,
/// continue as flutter and split again, or pass zero before others do. The result has the middle between
/// every two neighbouring edges without a signature between them.
fn unseen(signatures: &[Signature], critical: &[f64], coalescences: &[f64]) -> Vec<f64> {
    let mut edges: Vec<Edge> = Vec::new();
    edges.extend(critical.iter().copied().map(Edge::Critical));
    edges.extend(coalescences.iter().copied().map(Edge::Coalescence));
    edges.sort_by(|x, y| x.speed().total_cmp(&y.speed()));
    let is_unseen = |pair: &[Edge]| {
        let [from, to] = [pair[0].speed(), pair[1].speed()];
        let next = signatures.partition_point(|signature| signature.speed_rad_per_s <= from);
        let before = next.checked_sub(1).map(|last| &signatures[last]);
        let both = before.zip(signatures.get(next));
        let passes = both.is_some_and(|(before, after)| {
            after.speed_rad_per_s >= to && !before.real.is_empty() && !after.real.is_empty()
        });
        let is_clear = to - from > 4.0 * CRITICAL_GAP.get() * to;
        let coalesce = |edge: &Edge| matches!(edge, Edge::Coalescence(_));
        passes && is_clear && pair.iter().any(coalesce)
    };
    let unseen = edges.windows(2).filter(|pair| is_unseen(pair));
    unseen
        .map(|pair| 0.5 * (pair[0].speed() + pair[1].speed()))
        .collect()
}

/// Number of parts of a band whose ends are sampled for its largest growth, in addition to the speeds of the
/// search.
const PARTS: usize = 8;

/// Band between two edges, clipped to the limits, with its largest growth.
fn band(
    evaluator: &SignatureEvaluator<'_>,
    signatures: &[Signature],
    edges: [Edge; 2],
    limits: SpeedRange,
) -> Result<Instability, SpectrumError> {
    let [begin, end] = edges.map(|edge| edge.speed());
    let [from, to] = SpeedRange::new(begin, end).within(limits).ends();
    let of = |signature: &Signature| {
        signature.divergence().map(|mode| Sample {
            at: signature.speed_rad_per_s,
            value: mode.lambda.re.powi(2),
            slope: 2.0 * mode.lambda.re * mode.slope.re,
        })
    };
    let mut samples: Vec<Sample> = signatures.iter().filter_map(of).collect();
    let parts = (1..PARTS).map(|part| from + (to - from) * part as f64 / PARTS as f64);
    let is_clear = |speed: &f64| {
        [begin, end]
            .iter()
            .all(|edge| (speed / edge - 1.0).abs() > CRITICAL_GAP.get())
    };
    // At a critical speed λ² is zero. Its slope is unknown there, and the slope of the chord replaces it.
    let zero = |at: f64| Sample {
        at,
        value: 0.0,
        slope: f64::NAN,
    };
    let critical = edges
        .iter()
        .filter(|edge| matches!(edge, Edge::Critical(_)));
    samples.extend(critical.map(|edge| zero(edge.speed())));
    let cuts = [(begin < from).then_some(from), (to < end).then_some(to)];
    for cut in cuts.into_iter().flatten() {
        let value = evaluator.divergence(cut)?.powi(2);
        samples.push(Sample { value, ..zero(cut) });
    }
    samples.retain(|sample| (from..=to).contains(&sample.at));
    samples.sort_by(|x, y| x.at.total_cmp(&y.at));
    let at = |known: &[Sample], speed: f64| -> Result<Option<Sample>, SpectrumError> {
        let found = evaluator.divergent(speed, between(known, speed).max(0.0).sqrt())?;
        Ok(found.map(|[growth, slope]| Sample {
            at: speed,
            value: growth * growth,
            slope: 2.0 * growth * slope,
        }))
    };
    for speed in parts.filter(is_clear) {
        if let Some(sample) = at(&samples, speed)? {
            let place = samples.partition_point(|known| known.at < speed);
            samples.insert(place, sample);
        }
    }
    let found = maximize(samples, at)?;
    let peak_growth_per_s = found.map_or(0.0, |found| found.value.max(0.0).sqrt());
    Ok(Instability {
        kind: InstabilityKind::Divergence,
        from_rad_per_s: from,
        to_rad_per_s: to,
        closed: !edges.iter().any(|edge| matches!(edge, Edge::Range(_))),
        peak_rad_per_s: found.map_or(from, |sample| sample.at),
        peak_growth_per_s,
        frequency_rad_per_s: 0.0,
        curve: Vec::new(),
    })
}

/// A value at a speed between those of ascending samples.
fn between(known: &[Sample], speed: f64) -> f64 {
    let place = known.partition_point(|known| known.at < speed);
    match known.get(place.saturating_sub(1)..=place) {
        Some([before, after]) => {
            let share = (speed - before.at) / (after.at - before.at);
            before.value + share * (after.value - before.value)
        }
        _ => known
            .get(place.saturating_sub(1))
            .map_or(0.0, |nearest| nearest.value),
    }
}

/// Bands of divergence between two critical speeds that the search passes in one step. An odd number of negative
/// eigenvalues of K(Ω) implies a real λ > 0.
pub(super) fn close_pairs(
    model: &SpectralModel,
    evaluator: &SignatureEvaluator<'_>,
    speeds: &[f64],
    range: SpeedRange,
) -> Result<Vec<Found>, SpectrumError> {
    let (Some(&first), Some(&last)) = (speeds.first(), speeds.last()) else {
        return Ok(Vec::new());
    };
    let close = |pair: &[f64]| (1e-12..=CRITICAL_GROUP).contains(&(pair[1] / pair[0] - 1.0));
    let critical: Vec<f64> = model.critical.iter().map(|c| c.speed_rad_per_s).collect();
    let pairs = critical.windows(2).enumerate().filter(|(below, pair)| {
        below % 2 == 0 && first <= pair[0] && pair[1] <= last && close(pair)
    });
    pairs
        .map(|(_, pair)| Found::new(range, |limits| close_pair(evaluator, pair, limits)))
        .collect()
}

/// Band between two close critical speeds, clipped to the limits. Its growth is nearly constant.
fn close_pair(
    evaluator: &SignatureEvaluator<'_>,
    critical: &[f64],
    limits: SpeedRange,
) -> Result<Instability, SpectrumError> {
    let whole = SpeedRange::new(critical[0], critical[1]);
    let [from, to] = whole.within(limits).ends();
    let peak = 0.5 * (from + to);
    Ok(Instability {
        kind: InstabilityKind::Divergence,
        from_rad_per_s: from,
        to_rad_per_s: to,
        closed: true,
        peak_rad_per_s: peak,
        peak_growth_per_s: evaluator.divergence(peak)?,
        frequency_rad_per_s: 0.0,
        curve: Vec::new(),
    })
}

/// Begin or end of divergence, at a speed.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Edge {
    /// A critical speed: λ passes through zero.
    Critical(f64),
    /// Coalescence of two real λ, which continue as flutter.
    Coalescence(f64),
    /// End of the range inside the band.
    Range(f64),
}

impl Edge {
    fn speed(&self) -> f64 {
        match self {
            Edge::Critical(speed) | Edge::Coalescence(speed) | Edge::Range(speed) => *speed,
        }
    }
}

/// Begin or end of divergence between a stable and an unstable speed: the critical speed or the coalescence
/// of two real λ between them, or the end of the range.
fn edge(critical: &[f64], coalescences: &[f64], stable: Option<f64>, unstable: f64) -> Edge {
    let Some(stable) = stable else {
        return Edge::Range(unstable);
    };
    // Of several coalescences, the nearest to the divergence ends it. It may be slightly beyond the stable
    // speed, because the speed of a coalescence has an error (`VICINITY`).
    let coalescence = |to: f64| {
        let beyond = stable + (stable - to).signum() * VICINITY * stable;
        let between = |speed: &&f64| (beyond.min(to)..=beyond.max(to)).contains(*speed);
        let possible = coalescences.iter().filter(between).copied();
        smallest(possible, |speed| (speed - to).abs())
    };
    let (low, high) = (unstable.min(stable), unstable.max(stable));
    let critical = critical
        .iter()
        .copied()
        .find(|speed| (low..=high).contains(speed));
    // If one of two real λ passes through zero at the critical speed, both may continue up to a coalescence
    // beyond it, which is then the edge.
    let (to, otherwise) = match critical {
        Some(speed) => (speed, Edge::Critical(speed)),
        None => (unstable, Edge::Coalescence(unstable)),
    };
    coalescence(to).map_or(otherwise, Edge::Coalescence)
}

#[cfg(test)]
mod tests {
    use faer::c64;

    use super::*;
    use crate::stability::signature::{Sign, SignedMode};

    /// Two real λ coalesce at 3 and split at 4, between the only two signatures, so that one more speed is
    /// examined.
    #[test]
    fn a_speed_is_added_where_real_eigenvalues_coalesce_and_split_between_two_signatures() {
        let diverging = |speed_rad_per_s: f64| {
            let real = SignedMode {
                sign: Sign::Real,
                lambda: c64::new(1.0, 0.0),
                slope: c64::new(0.0, 0.0),
            };
            Signature {
                speed_rad_per_s,
                real: vec![real],
                ..Signature::new(speed_rad_per_s, [].iter())
            }
        };
        let both = [diverging(2.0), diverging(5.0)];
        assert_eq!(unseen(&both, &[1.0, 6.0], &[3.0, 4.0]), [3.5]);
        assert_eq!(unseen(&both, &[3.0], &[4.0]), [3.5]);
        assert!(unseen(&both, &[3.0, 4.0], &[]).is_empty());
        assert!(
            unseen(
                &[both[0].clone(), diverging(3.5), both[1].clone()],
                &[],
                &[3.0, 4.0]
            )
            .is_empty()
        );
    }

    /// Flutter turns into two real λ at 3, one of which passes zero at 4: divergence lasts from 3 on, not
    /// from 4.
    #[test]
    fn divergence_begins_where_two_real_eigenvalues_split() {
        let begin =
            |critical: &[f64], coalescences: &[f64]| edge(critical, coalescences, Some(2.0), 5.0);
        assert_eq!(begin(&[1.0, 4.0], &[3.0]), Edge::Coalescence(3.0));
        assert_eq!(begin(&[4.0], &[]), Edge::Critical(4.0));
        assert_eq!(begin(&[3.0], &[4.0]), Edge::Critical(3.0));
        assert_eq!(begin(&[], &[3.0, 4.0]), Edge::Coalescence(4.0));
        // The end of divergence is found in the same way; without a stable speed it is that of the range.
        assert_eq!(edge(&[3.0], &[4.0], Some(5.0), 2.0), Edge::Coalescence(4.0));
        assert_eq!(edge(&[3.0], &[4.0], None, 2.0), Edge::Range(2.0));
        // The stable speed is slightly on the wrong side of the coalescence.
        assert_eq!(
            edge(&[], &[5.0001], Some(5.0), 2.0),
            Edge::Coalescence(5.0001)
        );
    }
}
