//! Every decomposition, compared with closed forms; and wrong results, which are refused.

use std::f64::consts::{PI, TAU};

use faer::{Col, Mat, Scale, c64};

use super::complex::trace_error;
use super::*;

/// Of the order at which faer divides and conquers.
const LARGE: usize = 200;

/// Stiffness of a chain of equal masses between equal springs and two walls, in a unit.
fn chain(order: usize, unit: f64) -> Mat<f64> {
    Mat::from_fn(order, order, |i, k| match i.abs_diff(k) {
        0 => 2.0 * unit,
        1 => -unit,
        _ => 0.0,
    })
}

/// Phase kπ/(N + 1) of a chain, k from 1 on.
fn phase_of_chain(order: usize, k: usize) -> f64 {
    (k + 1) as f64 * PI / (order + 1) as f64
}

/// Value k of a chain in its unit, 4 sin²(kπ/2(N + 1)).
fn value_of_chain(order: usize, k: usize) -> f64 {
    4.0 * (0.5 * phase_of_chain(order, k)).sin().powi(2)
}

/// Vector k of a chain, sin(ikπ/(N + 1)).
fn shape_of_chain(order: usize, k: usize) -> Col<f64> {
    let norm = (2.0 / (order + 1) as f64).sqrt();
    let phase = phase_of_chain(order, k);
    Col::from_fn(order, |i| norm * ((i + 1) as f64 * phase).sin())
}

/// Units of a stiffness in 1/s², which is 1e10 and more, and others. Without scaling the vectors of the larger ones are
/// wrong by 1e-4 and more.
#[test]
fn symmetric_values_and_vectors_are_those_of_a_chain_of_springs_in_any_unit() {
    for unit in [1e-200, 1e-14, 1.0, 1e10, 1e14, 1e18, 1e200] {
        let matrix = chain(LARGE, unit);
        let found = SymmetricEigen::new(matrix.as_ref()).unwrap();
        let values = symmetric_eigenvalues(matrix.as_ref()).unwrap();
        for (k, alone) in values.into_iter().enumerate() {
            let (value, shape) = (value_of_chain(LARGE, k), shape_of_chain(LARGE, k));
            for found in [found.values[k], alone] {
                let error = (found / unit - value).abs();
                assert!(error < 1e-13, "{unit:e} {k}: {error:e}");
            }
            let along = (found.vectors.col(k).transpose() * &shape).abs();
            assert!((along - 1.0).abs() < 1e-12, "{unit:e} {k}: {along}");
        }
    }
}

/// Of a symmetric matrix only the lower triangle is read; orders 0 and 1, and zero, have decompositions.
#[test]
fn matrices_of_any_order_are_decomposed() {
    let half = Mat::from_fn(3, 3, |i, k| if i >= k { 1.0 } else { f64::NAN });
    let found = SymmetricEigen::new(half.as_ref()).unwrap();
    assert!((found.values[2] - 3.0).abs() < 1e-14);
    assert!(
        SymmetricEigen::new(Mat::zeros(0, 0).as_ref())
            .unwrap()
            .values
            .is_empty()
    );
    assert_eq!(
        symmetric_eigenvalues(Mat::full(1, 1, -2.0).as_ref()),
        Ok(vec![-2.0])
    );
    let zero = SymmetricEigen::new(Mat::zeros(150, 150).as_ref()).unwrap();
    assert!(zero.values.iter().all(|value| *value == 0.0));
    for order in [0, 1, 2, 80] {
        let zero = RealEigen::new(Mat::zeros(order, order).as_ref()).unwrap();
        assert_eq!(zero.values, vec![c64::new(0.0, 0.0); order]);
    }
}

/// An error of 2.5e-9 of the norm in one of 200 values, two vectors that are turned in their plane, and two that are not
/// orthogonal, are refused.
#[test]
fn wrong_symmetric_vectors_are_refused() {
    let matrix = chain(LARGE, 1e12);
    let right = SymmetricEigen::new(matrix.as_ref()).unwrap();
    assert!(right.clone().checked(matrix.as_ref()).is_ok());
    for k in [0, 17, LARGE - 2] {
        let mut turned = right.clone();
        let (one, next) = (right.vectors.col(k), right.vectors.col(k + 1));
        turned
            .vectors
            .col_mut(k)
            .copy_from(one + Scale(1e-4) * next);
        turned
            .vectors
            .col_mut(k + 1)
            .copy_from(next - Scale(1e-4) * one);
        let mut leaning = right.clone();
        leaning
            .vectors
            .col_mut(k)
            .copy_from(one + Scale(1e-7) * next);
        let mut other = right.clone();
        other.values[k] += 1e4;
        for wrong in [turned, leaning, other] {
            let said = wrong
                .checked(matrix.as_ref())
                .map(|_| ())
                .unwrap_err()
                .to_string();
            assert!(
                said.contains("eigenvectors of a matrix of order 200 are wrong"),
                "{k}: {said}"
            );
        }
    }
}

#[test]
fn wrong_eigenvalues_are_refused() {
    let matrix = Mat::from_fn(6, 6, |i, k| ((i * i + 3 * k * i + k) as f64).sin());
    let eigen = RealEigen::new(matrix.as_ref()).unwrap();
    assert!(trace_error(matrix.as_ref(), &eigen.values) < 1e-14);
    for i in 0..6 {
        let mut wrong = eigen.values.clone();
        wrong[i] = c64::new(0.0, 0.0);
        assert!(trace_error(matrix.as_ref(), &wrong) > 1e-3, "{i}");
        let q = eigen.vector(i);
        let off = Col::from_fn(6, |row| {
            (0..6).map(|k| q[k] * matrix[(row, k)]).sum::<c64>() - eigen.values[i] * q[row]
        });
        assert!(off.norm_l2() < 1e-12 * q.norm_l2(), "{}", eigen.values[i]);
    }
    let lower = eigen.values.iter().filter(|value| value.im < 0.0).count();
    assert_eq!(eigen.upper().len(), 6 - lower);
    let mut wrong = eigen;
    wrong.values[0] += 1e-6;
    let said = wrong.checked(matrix.as_ref()).unwrap_err().to_string();
    assert!(
        said.contains("eigenvectors of a matrix of order 6 are wrong"),
        "{said}"
    );
}

/// State matrix of two equal chains, q̈ + Cq̇ + Kq = 0, C = 0.02K + damping, whose coordinates are mixed by a
/// reflection: every eigenvalue is double.
fn two_damped_chains(masses: usize, damping: impl Fn(usize) -> f64) -> Mat<f64> {
    let order = 2 * masses;
    let axis = probe(order);
    let mirror = Scale(-2.0 / axis.squared_norm_l2()) * &axis * axis.transpose()
        + Mat::<f64>::identity(order, order);
    let of_both = |of_one: &Mat<f64>| {
        let apart = Mat::from_fn(order, order, |i, k| {
            if i % 2 == k % 2 {
                of_one[(i / 2, k / 2)]
            } else {
                0.0
            }
        });
        &mirror * apart * &mirror
    };
    let springs = chain(masses, 1.0);
    let mut dampers = Scale(0.02) * &springs;
    (0..masses).for_each(|i| dampers[(i, i)] += damping(i));
    let (stiffness, velocity) = (of_both(&springs), of_both(&dampers));
    Mat::from_fn(2 * order, 2 * order, |i, k| match (i < order, k < order) {
        (true, _) => f64::from(u8::from(i + order == k)),
        (false, true) => -stiffness[(i - order, k)],
        (false, false) => -velocity[(i - order, k - order)],
    })
}

/// With light damping each double pair has two vectors. Critical damping of a wave makes four λ equal, which have two
/// vectors between them.
#[test]
fn vectors_of_double_pairs_satisfy_their_equation_and_are_independent() {
    for (masses, unit) in [(5, 1.0), (10, 1e100), (10, 1e-100), (30, 1.0)] {
        let frequency = value_of_chain(masses, masses / 2).sqrt();
        let critical = 2.0 * frequency - 0.02 * frequency * frequency;
        let uneven = |i| 0.01 + 0.03 * i as f64 / masses as f64;
        let light = two_damped_chains(masses, uneven);
        let heavy = two_damped_chains(masses, |_| critical);
        for (matrix, is_light) in [(light, true), (heavy, false)] {
            let matrix = Scale(unit) * matrix;
            let eigen = RealEigen::new(matrix.as_ref()).unwrap();
            let vectors: Vec<Col<c64>> = (0..4 * masses).map(|i| eigen.vector(i)).collect();
            for (i, (v, lambda)) in vectors.iter().zip(&eigen.values).enumerate() {
                let off = Col::from_fn(v.nrows(), |row| {
                    let terms = (0..v.nrows()).map(|k| v[k] * matrix[(row, k)]);
                    terms.sum::<c64>() - lambda * v[row]
                });
                let error = off.norm_l2() / (matrix.norm_l2() * v.norm_l2());
                assert!(error < 1e-13, "{masses} {is_light} {lambda}: {error:e}");
                for other in vectors.iter().take(i).filter(|_| is_light) {
                    let share = (other.adjoint() * v) / other.squared_norm_l2();
                    let rest = (v - Scale(share) * other).norm_l2() / v.norm_l2();
                    assert!(rest > 1e-4, "{masses} {lambda}: {rest:e}");
                }
            }
        }
    }
}

/// The matrix that moves each coordinate to the next one has the N-th roots of unity as eigenvalues.
#[test]
fn a_cyclic_shift_has_the_roots_of_unity() {
    for order in [1, 2, 7, 40] {
        let shift = Mat::from_fn(order, order, |i, k| {
            f64::from(u8::from((k + 1) % order == i))
        });
        let turned = Mat::from_fn(order, order, |i, k| c64::new(0.0, 1e9) * shift[(i, k)]);
        let real = real_eigenvalues(shift.as_ref()).unwrap();
        let complex = complex_eigenvalues(turned.as_ref()).unwrap();
        let with_vectors = RealEigen::new(shift.as_ref()).unwrap().values;
        for k in 0..order {
            let root = c64::cis(TAU * k as f64 / order as f64);
            let is_near = |found: &[c64], exact: c64| {
                found
                    .iter()
                    .any(|value| (value - exact).norm() < 1e-12 * exact.norm())
            };
            assert!(
                is_near(&real, root) && is_near(&with_vectors, root),
                "{order} {k}"
            );
            assert!(is_near(&complex, c64::new(0.0, 1e9) * root), "{order} {k}");
        }
    }
}

/// The elongations of the springs of a chain: σ² are the values of its stiffness, and the right vectors its waves.
#[test]
fn singular_values_and_vectors_are_those_of_the_springs_of_a_chain() {
    for unit in [1e-6, 1.0, 1e8] {
        let elongations = Mat::from_fn(LARGE + 1, LARGE, |i, k| match i.checked_sub(k) {
            Some(0) => unit,
            Some(1) => -unit,
            _ => 0.0,
        });
        let found = RightSingular::new(elongations.as_ref()).unwrap();
        for k in 0..LARGE {
            let place = LARGE - 1 - k;
            let (value, shape) = (value_of_chain(LARGE, place), shape_of_chain(LARGE, place));
            let error = (found.values[k] / unit - value.sqrt()).abs();
            assert!(error < 1e-13, "{unit:e} {k}: {error:e}");
            let along = (found.vectors.col(k).transpose() * &shape).abs();
            assert!((along - 1.0).abs() < 1e-11, "{unit:e} {k}: {along}");
        }
    }
}

#[test]
fn a_matrix_that_is_not_finite_is_refused_by_name() {
    let refused = Err(LinalgError::NotFinite { order: 4 });
    for entry in [f64::NAN, f64::INFINITY] {
        let matrix = Mat::from_fn(4, 4, |i, k| if i == k { entry } else { 1.0 });
        let complex = Mat::from_fn(4, 4, |i, k| c64::new(1.0, matrix[(i, k)]));
        assert_eq!(real_eigenvalues(matrix.as_ref()), refused);
        assert_eq!(complex_eigenvalues(complex.as_ref()), refused);
        assert_eq!(
            symmetric_eigenvalues(matrix.as_ref()).map(|_| Vec::new()),
            refused
        );
        assert_eq!(RealEigen::new(matrix.as_ref()).map(|_| Vec::new()), refused);
        assert_eq!(
            RightSingular::new(matrix.as_ref()).map(|_| Vec::new()),
            refused
        );
        assert_eq!(
            SymmetricEigen::new(matrix.as_ref()).map(|_| Vec::new()),
            refused
        );
        assert!(SymmetricEigen::or_nan(matrix.as_ref()).values[0].is_nan());
    }
}
