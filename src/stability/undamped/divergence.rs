//! Divergence: a real λ > 0 between critical speeds.

use super::checked_modes::{CRITICAL_GAP, CRITICAL_GROUP, CheckedModes};
use super::flutter::VICINITY;
use super::growing_stretch::{End, GrowingStretch, UNKNOWN};
use crate::model::scene::SpeedRange;
use crate::modes::{SpectralModel, SpectrumError, smallest};
use crate::stability::band::{CurvePoint, Instability, InstabilityKind};
use crate::stability::sample::Sample;
use crate::stability::search_result::Found;

/// Intervals of divergence, from samples in ascending order. They begin and end at critical speeds or at
/// `coalescences`, where two real λ continue as flutter.
pub fn divergence(
    model: &SpectralModel,
    checked: &CheckedModes<'_>,
    samples: &[Sample],
    coalescences: &[CurvePoint],
) -> Result<Vec<GrowingStretch>, SpectrumError> {
    let critical: Vec<f64> = model.critical.iter().map(|c| c.speed_rad_per_s).collect();
    let mut samples = samples.to_vec();
    for speed in unseen(&samples, &critical, coalescences) {
        samples.push(checked.at(speed)?);
    }
    samples.sort_by(|x, y| x.speed_rad_per_s.total_cmp(&y.speed_rad_per_s));
    let mut stretches = Vec::new();
    let mut stable: Option<f64> = None;
    let mut runs = samples
        .chunk_by(|x, y| diverges(x) == diverges(y))
        .peekable();
    while let Some(run) = runs.next() {
        let points: Vec<CurvePoint> = run.iter().filter_map(fastest).collect();
        if let [first, .., last] | [first @ last] = points.as_slice() {
            let next = runs.peek().map(|run| run[0].speed_rad_per_s);
            let ends = [(stable, first), (next, last)].map(|(stable, unstable)| {
                edge(&critical, coalescences, stable, unstable.speed_rad_per_s)
            });
            stretches.push(GrowingStretch {
                kind: InstabilityKind::Divergence,
                ends,
                points,
            });
        }
        stable = run.last().map(|sample| sample.speed_rad_per_s);
    }
    Ok(stretches)
}

fn diverges(sample: &Sample) -> bool {
    sample.divergences().next().is_some()
}

/// λ² of the fastest growing real λ.
fn fastest(sample: &Sample) -> Option<CurvePoint> {
    let square = sample.divergences().next()?;
    Some(CurvePoint::new(sample.speed_rad_per_s, square))
}

/// Speeds between two samples at which divergence may be interrupted, because two real λ coalesce,
/// continue as flutter and split again, or pass zero before others do. The result has the middle between
/// every two neighbouring edges without a sample between them.
fn unseen(samples: &[Sample], critical: &[f64], coalescences: &[CurvePoint]) -> Vec<f64> {
    let mut edges: Vec<End> = Vec::new();
    edges.extend(critical.iter().copied().map(End::Critical));
    edges.extend(coalescences.iter().copied().map(End::Coalescence));
    edges.sort_by(|x, y| x.speed().total_cmp(&y.speed()));
    let is_unseen = |pair: &[End]| {
        let [from, to] = [pair[0].speed(), pair[1].speed()];
        let next = samples.partition_point(|sample| sample.speed_rad_per_s <= from);
        let before = next.checked_sub(1).map(|last| &samples[last]);
        let both = before.zip(samples.get(next));
        let passes = both.is_some_and(|(before, after)| {
            after.speed_rad_per_s >= to && diverges(before) && diverges(after)
        });
        let is_clear = to - from > 4.0 * CRITICAL_GAP.get() * to;
        let coalesce = |edge: &End| matches!(edge, End::Coalescence(_));
        passes && is_clear && pair.iter().any(coalesce)
    };
    let unseen = edges.windows(2).filter(|pair| is_unseen(pair));
    unseen
        .map(|pair| 0.5 * (pair[0].speed() + pair[1].speed()))
        .collect()
}

/// Bands of divergence between two critical speeds that the search passes in one step. An odd number of negative
/// eigenvalues of K(Ω) implies a real λ > 0.
pub fn close_pairs(
    model: &SpectralModel,
    checked: &CheckedModes<'_>,
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
        .map(|(_, pair)| Found::new(range, |limits| close_pair(checked, pair, limits)))
        .collect()
}

/// Band between two close critical speeds, clipped to the limits. Its growth is nearly constant.
fn close_pair(
    checked: &CheckedModes<'_>,
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
        peak_growth_per_s: checked.divergence(peak)?,
        frequency_rad_per_s: 0.0,
        curve: Vec::new(),
    })
}

/// Begin or end of divergence between a stable and an unstable speed: the critical speed or the coalescence
/// of two real λ between them, or the end of the range.
fn edge(critical: &[f64], coalescences: &[CurvePoint], stable: Option<f64>, unstable: f64) -> End {
    let Some(stable) = stable else {
        return End::Range(unstable);
    };
    // Of several coalescences, the nearest to the divergence ends it. It may be slightly beyond the stable
    // speed, because the speed of a coalescence has an error (`VICINITY`).
    let coalescence = |to: f64| {
        let beyond = stable + (stable - to).signum() * VICINITY * stable;
        let between = beyond.min(to)..=beyond.max(to);
        let is_between = |point: &&CurvePoint| between.contains(&point.speed_rad_per_s);
        let possible = coalescences.iter().filter(is_between);
        smallest(possible, |point| (point.speed_rad_per_s - to).abs())
    };
    let (low, high) = (unstable.min(stable), unstable.max(stable));
    let critical = critical
        .iter()
        .copied()
        .find(|speed| (low..=high).contains(speed));
    // If one of two real λ passes through zero at the critical speed, both may continue up to a coalescence
    // beyond it, which is then the edge.
    let (to, otherwise) = match critical {
        Some(speed) => (speed, End::Critical(speed)),
        None => (unstable, End::Unknown(unstable)),
    };
    coalescence(to).map_or(otherwise, |point| {
        // The slope of the faster of both is unbounded.
        let slope = UNKNOWN;
        End::Coalescence(CurvePoint { slope, ..*point })
    })
}

#[cfg(test)]
mod tests {
    use faer::c64;

    use super::*;

    fn double(speed_rad_per_s: f64) -> CurvePoint {
        CurvePoint {
            speed_rad_per_s,
            number: c64::ONE,
            slope: c64::ZERO,
        }
    }

    /// Two real λ coalesce at 3 and split at 4, between the only two samples, so that one more speed is
    /// examined.
    #[test]
    fn a_speed_is_added_where_real_eigenvalues_coalesce_and_split_between_two_samples() {
        let diverging = |speed_rad_per_s: f64| {
            Sample::of_squares(speed_rad_per_s, vec![((c64::ONE, c64::ZERO), 0)])
        };
        let both = [diverging(2.0), diverging(5.0)];
        assert_eq!(unseen(&both, &[1.0, 6.0], &[3.0, 4.0].map(double)), [3.5]);
        assert_eq!(unseen(&both, &[3.0], &[4.0].map(double)), [3.5]);
        assert!(unseen(&both, &[3.0, 4.0], &[]).is_empty());
        assert!(
            unseen(
                &[both[0].clone(), diverging(3.5), both[1].clone()],
                &[],
                &[3.0, 4.0].map(double)
            )
            .is_empty()
        );
    }

    /// Flutter turns into two real λ at 3, one of which passes zero at 4: divergence lasts from 3 on, not
    /// from 4.
    #[test]
    fn divergence_begins_where_two_real_eigenvalues_split() {
        let ends = |critical: &[f64], coalescences: &[f64], stable: Option<f64>, unstable: f64| {
            let doubles: Vec<CurvePoint> = coalescences.iter().copied().map(double).collect();
            match edge(critical, &doubles, stable, unstable) {
                End::Coalescence(point) => ("coalescence", point.speed_rad_per_s),
                End::Critical(speed) => ("critical", speed),
                End::Range(speed) => ("range", speed),
                End::Unknown(speed) => ("unknown", speed),
            }
        };
        let begin =
            |critical: &[f64], coalescences: &[f64]| ends(critical, coalescences, Some(2.0), 5.0);
        assert_eq!(begin(&[1.0, 4.0], &[3.0]), ("coalescence", 3.0));
        assert_eq!(begin(&[4.0], &[]), ("critical", 4.0));
        assert_eq!(begin(&[3.0], &[4.0]), ("critical", 3.0));
        assert_eq!(begin(&[], &[3.0, 4.0]), ("coalescence", 4.0));
        // The end of divergence is found in the same way; without a stable speed it is that of the range.
        assert_eq!(ends(&[3.0], &[4.0], Some(5.0), 2.0), ("coalescence", 4.0));
        assert_eq!(ends(&[3.0], &[4.0], None, 2.0), ("range", 2.0));
        // The stable speed is slightly on the wrong side of the coalescence.
        assert_eq!(
            ends(&[], &[5.0001], Some(5.0), 2.0),
            ("coalescence", 5.0001)
        );
    }
}
