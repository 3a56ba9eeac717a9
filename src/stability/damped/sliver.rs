//! Slivers of divergence that rounding makes where Im λ of a growing mode passes zero.
//!
//! Guides that lie evenly around the blade give two modes λ and λ̄ whose Im λ passes zero at some speeds, where both are one double real
//! number. Computed, a double number is two, √ε apart: over a short interval two real ones, which would be two bands of divergence within
//! the band of the mode.

use faer::c64;

use super::hump::VALLEY;
use crate::stability::band::Instability;
use crate::stability::instability_kind::InstabilityKind;

/// Distance of two computed values of one double number, as a share of the highest accurate frequency. That of six equal films was 3e-7.
const DOUBLE: f64 = 1e-6;
/// Relative distance within which two bands begin or end at the same speed.
const SAME_SPEED: f64 = 1e-9;

/// The bands of a component without slivers, whose speeds belong to the band of flutter beside them. Two bands of divergence are a sliver
/// if they begin and end together, differ by no more than the rounding of a double number, and flutter begins or ends there.
pub fn without_slivers(mut bands: Vec<Instability>, highest_rad_per_s: f64) -> Vec<Instability> {
    bands.sort_by(|x, y| x.from_rad_per_s.total_cmp(&y.from_rad_per_s));
    let rounding = DOUBLE * highest_rad_per_s;
    while let Some([first, second]) = twins(&bands, rounding) {
        let twin = bands.remove(second);
        let sliver = bands.remove(first);
        if !is_taken(&mut bands, &sliver) {
            // Without flutter beside them they stay, apart from the others, so that the search for further ones ends.
            let mut rest = without_slivers(bands, highest_rad_per_s);
            rest.extend([sliver, twin]);
            return rest;
        }
    }
    bands
}

/// Number of modes of a spectrum that rounding has made two growing real numbers.
pub fn rounded_to_real(values: &[c64], highest_rad_per_s: f64) -> usize {
    let real = values
        .iter()
        .filter(|value| value.im == 0.0 && value.re > 0.0);
    let mut growth: Vec<f64> = real.map(|value| value.re).collect();
    growth.sort_by(f64::total_cmp);
    let pairs = growth.windows(2);
    pairs
        .filter(|pair| pair[1] - pair[0] <= DOUBLE * highest_rad_per_s)
        .count()
}

fn is_same(x: f64, y: f64) -> bool {
    (x - y).abs() <= SAME_SPEED * y
}

/// Indices, ascending, of two bands of divergence that rounding may have made of one mode.
fn twins(bands: &[Instability], rounding: f64) -> Option<[usize; 2]> {
    let is_closed = |band: &Instability| band.closed && band.kind == InstabilityKind::Divergence;
    let are_twins = |first: &Instability, second: &Instability| {
        is_same(first.from_rad_per_s, second.from_rad_per_s)
            && is_same(first.to_rad_per_s, second.to_rad_per_s)
            && first.curve.iter().all(|point| {
                let other = second.growth_at(point.speed_rad_per_s);
                other.is_none_or(|other| (other - point.number.re).abs() <= rounding)
            })
    };
    (0..bands.len()).find_map(|first| {
        let mut later = first + 1..bands.len();
        let second = later.find(|&second| {
            let both = [&bands[first], &bands[second]];
            both.into_iter().all(is_closed) && are_twins(both[0], both[1])
        })?;
        Some([first, second])
    })
}

/// Adds the speeds of a sliver to the flutter beside it; false if there is none. Flutter on both sides is one band unless the growth
/// between is a valley.
fn is_taken(bands: &mut Vec<Instability>, sliver: &Instability) -> bool {
    let place = |edge: &dyn Fn(&Instability) -> f64, speed: f64| {
        let is_beside = |band: &Instability| {
            band.kind == InstabilityKind::Flutter && is_same(edge(band), speed)
        };
        bands.iter().position(is_beside)
    };
    let before = place(&|band| band.to_rad_per_s, sliver.from_rad_per_s);
    let after = place(&|band| band.from_rad_per_s, sliver.to_rad_per_s);
    match (before, after) {
        (Some(before), Some(after)) => {
            let lower = f64::min(
                bands[before].peak_growth_per_s,
                bands[after].peak_growth_per_s,
            );
            let joint = sliver.curve.iter().map(|point| point.number.re);
            if joint.fold(f64::INFINITY, f64::min) < VALLEY.get() * lower {
                lead_in(&mut bands[after], sliver);
            } else {
                let mut next = bands[after].clone();
                lead_in(&mut next, sliver);
                join(&mut bands[before], next);
                bands.remove(after);
            }
            true
        }
        (None, Some(after)) => {
            lead_in(&mut bands[after], sliver);
            true
        }
        (Some(before), None) => {
            join(&mut bands[before], sliver.clone());
            true
        }
        (None, None) => false,
    }
}

/// Lets a band begin where a sliver does.
fn lead_in(band: &mut Instability, sliver: &Instability) {
    let own = std::mem::take(&mut band.curve);
    band.from_rad_per_s = sliver.from_rad_per_s;
    band.ends[0] = sliver.ends[0];
    band.curve = [sliver.curve.as_slice(), &own].concat();
    band.curve.dedup_by_key(|point| point.speed_rad_per_s);
}

/// Continues a band by the next one, which begins where it ends.
fn join(band: &mut Instability, next: Instability) {
    if next.peak_growth_per_s > band.peak_growth_per_s {
        band.peak_rad_per_s = next.peak_rad_per_s;
        band.peak_growth_per_s = next.peak_growth_per_s;
        band.frequency_rad_per_s = next.frequency_rad_per_s;
    }
    band.to_rad_per_s = next.to_rad_per_s;
    band.ends[1] = next.ends[1];
    band.closed &= next.closed;
    band.curve.extend(next.curve);
    band.curve.dedup_by_key(|point| point.speed_rad_per_s);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::scene::{Scene, rpm};
    use crate::stability::Onsets;
    use crate::stability::band::{BandEnd, CurvePoint};

    /// Six equal films that lag by a second: modes of 4 diameters grow from the double critical speed of 4951.83 rpm on. Reference: dense
    /// eigenvalues of the exported matrices, of which Im λ is 2e-5 rad/s at 4951.84 rpm, 0.1 at 4973, 7e-4 at 4973.816 and 0.02 at 4974, with
    /// Re λ of 5e-4, 10.76, 11.47 and 11.63 1/s.
    #[test]
    #[cfg_attr(debug_assertions, ignore = "a damped search: run it in release")]
    fn six_equal_films_flutter_without_slivers_of_divergence() {
        let guide = |angle: usize| {
            format!(
                r#"{{ "radius_m": 0.17, "angle_deg": {angle}, "radial_length_m": 0.03, "tangential_length_m": 0.04,
                    "stiffness_n_per_m": 3e4, "damping_n_s_per_m": 1e4, "film": {{ "lag_s": 1 }} }}"#
            )
        };
        let guides: Vec<String> = (0..6).map(|k| guide(10 + 60 * k)).collect();
        let text = format!(
            r#"{{ "name": "six films", "tolerance": 0.1, "blade": {{ "outer_diameter_m": 0.4, "inner_diameter_m": 0.05,
                "thickness_m": 0.002, "material": {{ "youngs_modulus_pa": 2.06e11, "poisson_ratio": 0.3,
                "density_kg_per_m3": 7850 }} }}, "mount": {{ "kind": "collar", "diameter_m": 0.12, "in_plane": "fixed" }},
                "guides": [{}], "sweep": {{ "from_rpm": 4900, "to_rpm": 5000 }} }}"#,
            guides.join(", ")
        );
        let found = Onsets::new(&Scene::from_json(&text).unwrap()).unwrap();
        let bands = &found.instabilities;
        let narrow = |band: &&Instability| band.range().width() < 1e-5 * band.to_rad_per_s;
        assert_eq!(bands.iter().filter(narrow).count(), 0, "{bands:?}");
        let from_critical: Vec<&Instability> = bands
            .iter()
            .filter(|band| (rpm(band.from_rad_per_s) - 4951.829).abs() < 0.01)
            .collect();
        let [flutter] = from_critical[..] else {
            panic!("{bands:?}");
        };
        assert_eq!(flutter.kind, InstabilityKind::Flutter);
        assert!(
            flutter.to_rad_per_s > 1.004 * flutter.from_rad_per_s,
            "{flutter:?}"
        );
        for (speed_rpm, growth) in [(4960.0, 0.7229), (4973.0, 10.757), (4974.0, 11.626)] {
            let at = flutter
                .growth_at(crate::model::scene::rad_per_s(speed_rpm))
                .unwrap();
            assert!((at / growth - 1.0).abs() < 0.02, "{speed_rpm}: {at}");
        }
    }

    /// A band through points (speed, λ), of which the fastest is its peak.
    fn band(kind: InstabilityKind, points: &[(f64, f64, f64)]) -> Instability {
        let curve: Vec<CurvePoint> = points
            .iter()
            .map(|(speed, re, im)| CurvePoint {
                speed_rad_per_s: *speed,
                number: c64::new(*re, *im),
                slope: c64::ZERO,
            })
            .collect();
        let peak = curve.iter().copied();
        let peak = peak
            .max_by(|x, y| x.number.re.total_cmp(&y.number.re))
            .unwrap();
        Instability {
            kind,
            from_rad_per_s: points[0].0,
            to_rad_per_s: points[points.len() - 1].0,
            ends: [BandEnd::Growth; 2],
            closed: true,
            peak_rad_per_s: peak.speed_rad_per_s,
            peak_growth_per_s: peak.number.re,
            frequency_rad_per_s: peak.number.im,
            curve,
        }
    }

    /// Im λ = 10 |Ω − 100| + 1 of a mode: at 100 rad/s rounding makes two real numbers of it.
    #[test]
    fn a_mode_whose_frequency_passes_zero_is_one_band() {
        use InstabilityKind::{Divergence, Flutter};
        let sliver = |split: f64, growth: f64| {
            let speeds = [99.9999, 100.0, 100.0001];
            [-split, split].map(|off| {
                let points = speeds.map(|speed| {
                    (
                        speed,
                        growth + off * (1.0 - 1e4 * (speed - 100.0_f64).abs()),
                        0.0,
                    )
                });
                band(Divergence, &points)
            })
        };
        let before = band(Flutter, &[(90.0, 0.0, 5.0), (99.9999, 11.0, 0.001)]);
        let after = band(
            Flutter,
            &[
                (100.0001, 11.0, 0.001),
                (110.0, 58.0, 20.0),
                (120.0, 0.0, 30.0),
            ],
        );
        let all = |split: f64, growth: f64| {
            let mut all = vec![before.clone(), after.clone()];
            all.extend(sliver(split, growth));
            without_slivers(all, 1e3)
        };
        let [one] = &all(1e-4, 11.0)[..] else {
            panic!("{:?}", all(1e-4, 11.0));
        };
        assert_eq!(
            (one.kind, one.from_rad_per_s, one.to_rad_per_s),
            (Flutter, 90.0, 120.0)
        );
        assert_eq!((one.peak_rad_per_s, one.peak_growth_per_s), (110.0, 58.0));
        assert!(
            one.curve
                .windows(2)
                .all(|pair| pair[0].speed_rad_per_s < pair[1].speed_rad_per_s)
        );
        // Two real numbers that differ by more than rounding are divergence.
        assert_eq!(all(0.1, 11.0).len(), 4);
        // Growth that vanishes between two humps parts them.
        assert_eq!(all(1e-4, 2.0).len(), 2);
        // At an onset the flutter begins with the sliver.
        let mut begun = vec![after];
        begun.extend(sliver(1e-4, 1e-4));
        let [one] = &without_slivers(begun, 1e3)[..] else {
            panic!("one band is expected");
        };
        assert_eq!(one.from_rad_per_s, 99.9999);
        // Without flutter beside them both stay.
        assert_eq!(without_slivers(sliver(1e-4, 1.0).into(), 1e3).len(), 2);
    }
}
