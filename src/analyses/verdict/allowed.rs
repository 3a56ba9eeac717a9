//! Ranges of speed with the answer yes.

use super::Criterion;
use super::judge::Judge;
use crate::model::scene::rad_per_s;
use crate::page::text::shown;
use crate::stability::CRITICAL_MARGIN;

/// Speeds at which a saw keeps all its limits, in rad/s.
pub struct Allowed {
    /// All ranges within the sweep, ascending.
    pub windows_rad_per_s: Vec<[f64; 2]>,
    /// End of the range that begins where the sweep does; `None` if there is none.
    pub first_end_rad_per_s: Option<f64>,
    /// What ends that range.
    pub ended_by: Option<String>,
}

/// Speeds at which a limit is not kept, and which limit that is.
struct Excluded {
    from: f64,
    to: f64,
    by: String,
}

/// The ranges of a saw whose limits have these results at its operating speed.
pub fn allowed(judge: &Judge<'_>, limits: &[Criterion]) -> Allowed {
    let [from, to] = judge.found.range_rad_per_s.ends();
    let mut excluded = excluded(judge, limits);
    excluded.sort_by(|x, y| x.from.total_cmp(&y.from));
    let end = Excluded {
        from: to,
        to: f64::INFINITY,
        by: "where the sweep ends".to_owned(),
    };
    let mut windows_rad_per_s = Vec::new();
    let ended_by = excluded.first().unwrap_or(&end).by.clone();
    let mut begin = from;
    for Excluded { from, to: over, .. } in excluded.into_iter().chain([end]) {
        let last = from.min(to);
        if last > begin {
            windows_rad_per_s.push([begin, last]);
        }
        if begin < over {
            begin = over;
        }
    }
    let first = windows_rad_per_s.first();
    Allowed {
        first_end_rad_per_s: first
            .filter(|[begin, _]| *begin == from)
            .map(|window| window[1]),
        windows_rad_per_s,
        ended_by: Some(ended_by),
    }
}

fn excluded(judge: &Judge<'_>, limits: &[Criterion]) -> Vec<Excluded> {
    let found = judge.found;
    let mut all = Vec::new();
    let mut above = |from: f64, by: String| {
        all.push(Excluded {
            from,
            to: f64::INFINITY,
            by,
        });
    };
    let of_all_speeds = judge.of_all_speeds();
    if found.has_failed || !judge.is_held || !of_all_speeds.iter().all(Criterion::is_kept) {
        above(0.0, String::new());
    }
    // A deflection is judged at the operating speed, below which it is smaller.
    let judged = |key: &str| limits.iter().find(|criterion| criterion.key == key);
    for key in ["max_deviation", "validity"] {
        if let Some(criterion) = judged(key) {
            let to = if criterion.is_kept() {
                rad_per_s(criterion.asked_rpm)
            } else {
                0.0
            };
            above(to, "the speed at which the deflection is judged".to_owned());
        }
    }
    for gap in limits.iter().filter(|criterion| criterion.key == "gap") {
        if let Some(closes_rpm) = gap.found_rpm {
            above(rad_per_s(closes_rpm), format!("{} closes", gap.name));
        }
    }
    if let Some(lowest) = found.critical_rad_per_s.first() {
        let margin = judge.limits.margin();
        let percent = shown(1e2 * margin);
        above(
            margin * lowest,
            format!("{percent} % of the first critical speed"),
        );
    }
    let limit = judge.limits.max_rim_m_per_s();
    let rim = format!("rim speed of {} m/s", shown(limit));
    above(limit / judge.rim_radius_m, rim);
    let passed = found.not_passed().into_iter();
    all.extend(passed.map(|[from, to]| Excluded {
        from,
        to,
        by: "slots pass guides".to_owned(),
    }));
    let percent = shown(1e2 * CRITICAL_MARGIN);
    all.extend(found.critical_rad_per_s.iter().map(|critical| Excluded {
        from: (1.0 - CRITICAL_MARGIN) * critical,
        to: (1.0 + CRITICAL_MARGIN) * critical,
        by: format!("{percent} % below a critical speed"),
    }));
    all.extend(bands(judge));
    all
}

/// Speeds at which flutter or divergence counts or is weak, widened by the errors of the edges.
fn bands(judge: &Judge<'_>) -> impl Iterator<Item = Excluded> {
    let found = judge.found;
    let sweep = found.range_rad_per_s.ends();
    found.bands.iter().flat_map(move |band| {
        let weak = if band.counted.is_empty() { "weak " } else { "" };
        let stretches = band.to_avoid(sweep).into_iter();
        let stretches = stretches.flat_map(|stretch| found.beside_quiet(stretch));
        stretches.map(move |[from, to]| Excluded {
            from,
            to,
            by: format!("where {weak}{} begins", band.kind),
        })
    })
}
