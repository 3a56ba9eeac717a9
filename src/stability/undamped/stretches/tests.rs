use std::sync::Arc;

use super::*;
use crate::stability::group::Sloped;
use crate::stability::pieces::Search;

/// Three quadruples at one end of a piece and two at the other: the first one ends, and does not take the place of another.
#[test]
fn a_quadruple_that_ends_in_an_unsettled_piece_leaves_the_others_their_places() {
    let lambdas = [(0.01, 49.0), (3.25, 70.0), (37.0, 208.0)];
    let sample = |speed: f64, lambdas: &[(f64, f64)]| {
        let squares = lambdas.iter().flat_map(|(re, im)| {
            let square = c64::new(*re, *im) * c64::new(*re, *im);
            [square, square.conj()].map(|z| ((z, c64::ZERO), 0))
        });
        Arc::new(Sample::of_squares(speed, squares.collect()))
    };
    let piece = Piece {
        ends: [sample(1.0, &lambdas), sample(1.1, &lambdas[1..])],
        groups: Vec::new(),
    };
    let found = stretches(std::slice::from_ref(&piece), &[]);
    assert_eq!(found.len(), 3);
    for stretch in found {
        let frequencies: Vec<f64> = stretch.points.iter().map(|p| p.number.sqrt().im).collect();
        if let Bound::Coalescence { .. } = stretch.end {
            assert!((frequencies[0] - 49.0).abs() < 1e-9 && frequencies.len() == 1);
        } else {
            assert_eq!(frequencies.len(), 2);
            assert!((frequencies[0] - frequencies[1]).abs() < 1e-9);
        }
    }
}

/// The two numbers 1 ± √D of D and its slope.
fn around_one(square: [f64; 2]) -> [Sloped; 2] {
    let [d, rise] = square.map(c64::from);
    let root = d.sqrt();
    [root, -root].map(|root| (1.0 + root, rise / (2.0 * root)))
}

type Stretched = (InstabilityKind, [f64; 2]);

/// Pieces of two numbers in closed form over 0 to 10 rad/s. At the critical speeds one of them is zero.
fn pieces(numbers: &(dyn Fn(f64) -> [Sloped; 2] + Sync), critical: [f64; 2]) -> Vec<Piece> {
    const BESIDE: f64 = 1e-6;
    let solve = |speed: f64| {
        // A wave far above gives the search a gap to end in.
        let above = (c64::from(-1e4), c64::ZERO);
        let signed = numbers(speed).into_iter().chain([above]).map(|number| {
            let is_wave = number.0.im == 0.0 && number.0.re < 0.0;
            (number, i8::from(is_wave))
        });
        let is_clear = critical.iter().all(|c| (speed - c).abs() > 0.9 * BESIDE);
        Ok(is_clear.then(|| Sample::of_squares(speed, signed.collect())))
    };
    let search = Search {
        plane: Plane::Squares,
        top_rad_per_s: 20.0,
        tolerance: 1e-3,
        definite_tolerance: 0.05,
        growth_tolerance: 0.01,
        noise_per_s: 1e-9,
        solve: &solve,
    };
    let mut speeds: Vec<f64> = (0..9).map(|k| 1.25 * f64::from(k)).collect();
    speeds.extend(critical.iter().flat_map(|c| [c - BESIDE, c + BESIDE]));
    speeds.sort_by(f64::total_cmp);
    search.pieces(&speeds).unwrap()
}

/// Kind, begin and end of the intervals of such numbers, flutter first.
fn read(numbers: &(dyn Fn(f64) -> [Sloped; 2] + Sync), critical: [f64; 2]) -> Vec<Stretched> {
    let pieces = pieces(numbers, critical);
    let all = stretches(&pieces, &critical);
    let ends = |stretch: &Stretch<'_>| [stretch.begin.speed(), stretch.end.speed()];
    let mut found: Vec<Stretched> = all
        .iter()
        .map(|stretch| (stretch.kind, ends(stretch)))
        .collect();
    let rank = |(kind, _): &Stretched| *kind == InstabilityKind::Divergence;
    found.sort_by(|x, y| rank(x).cmp(&rank(y)).then(x.1.partial_cmp(&y.1).unwrap()));
    found
}

fn assert_read(found: &[Stretched], expected: &[Stretched]) {
    assert_eq!(found.len(), expected.len(), "{found:?}");
    for ((kind, ends), (expected_kind, expected_ends)) in found.iter().zip(expected) {
        assert_eq!(kind, expected_kind);
        for (end, expected) in ends.iter().zip(expected_ends) {
            assert!((end - expected).abs() < 1e-4, "{found:?}");
        }
    }
}

/// D = (Ω − 3)(Ω − 7)/4. One λ² is above zero at both ends of the range; the other one passes zero where D = 1; both coalesce at 3 and
/// split at 7.
#[test]
fn divergence_ends_where_two_real_eigenvalues_continue_as_flutter() {
    use InstabilityKind::{Divergence, Flutter};
    let numbers =
        |speed: f64| around_one([0.25 * (speed - 3.0) * (speed - 7.0), 0.5 * (speed - 5.0)]);
    let critical = [-1.0, 1.0].map(|side: f64| 5.0 + side * 8.0_f64.sqrt());
    let expected = [
        (Flutter, [3.0, 7.0]),
        (Divergence, [0.0, 3.0]),
        (Divergence, [critical[0], 3.0]),
        (Divergence, [7.0, critical[1]]),
        (Divergence, [7.0, 10.0]),
    ];
    assert_read(&read(&numbers, critical), &expected);
}

/// D = ((Ω − 5)² − 10⁻⁶)/10: flutter interrupts divergence far within a step of the search.
#[test]
fn narrow_flutter_interrupts_divergence() {
    use InstabilityKind::{Divergence, Flutter};
    let numbers =
        |speed: f64| around_one([0.1 * ((speed - 5.0).powi(2) - 1e-6), 0.2 * (speed - 5.0)]);
    let critical = [-1.0, 1.0].map(|side: f64| 5.0 + side * (10.0_f64 + 1e-6).sqrt());
    let expected = [
        (Flutter, [4.999, 5.001]),
        (Divergence, [0.0, 4.999]),
        (Divergence, [critical[0], 4.999]),
        (Divergence, [5.001, critical[1]]),
        (Divergence, [5.001, 10.0]),
    ];
    assert_read(&read(&numbers, critical), &expected);
}

/// λ² = 16·10⁻¹⁴ − (Ω − 5)² is above zero from 5 − 4·10⁻⁷ to 5 + 4·10⁻⁷, which the search passes in one step.
#[test]
fn divergence_within_a_step_is_found_by_its_critical_speeds() {
    let numbers = |speed: f64| {
        let off = speed - 5.0;
        let wave = (c64::from(-50.0), c64::ZERO);
        [
            (c64::from(1.6e-13 - off * off), c64::from(-2.0 * off)),
            wave,
        ]
    };
    let critical = [5.0 - 4e-7, 5.0 + 4e-7];
    assert_eq!(
        read(&numbers, critical),
        [(InstabilityKind::Divergence, critical)]
    );
}

/// λ² = 10⁻⁴ ± √(0.1 (Ω' − Ω)) with Ω' = 5 + 10⁻⁷: at 5 the smaller one passes zero, and just behind, in the same step, both coalesce.
#[test]
fn divergence_that_turns_into_flutter_behind_a_critical_speed_does_not_end_there() {
    let numbers = |speed: f64| {
        let root = c64::from(0.1 * (5.0 + 1e-7 - speed)).sqrt();
        [root, -root].map(|root| (1e-4 + root, -0.05 / root))
    };
    let critical = [5.0, 20.0];
    let pieces = pieces(&numbers, critical);
    let all = stretches(&pieces, &critical);
    let mut real = all
        .iter()
        .filter(|stretch| stretch.kind == InstabilityKind::Divergence);
    let end = real.next().map(|stretch| stretch.end);
    assert!(matches!(end, Some(Bound::Coalescence { .. })), "{end:?}");
    assert!(real.next().is_none());
}
