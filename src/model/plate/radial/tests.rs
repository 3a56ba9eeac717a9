use super::*;
use crate::model::scene::Scene;

fn paper_basis(functions: usize) -> RadialBasis {
    RadialBasis::new(Scene::paper().blade(), functions)
}

#[test]
fn the_functions_are_orthonormal() {
    let basis = paper_basis(14);
    for n in [0, 1, 5] {
        for j in 0..14 {
            for k in 0..=j {
                let product: f64 = basis
                    .rule()
                    .iter()
                    .map(|(r, w)| {
                        let values = basis.evaluate(n, r).value;
                        w * r * values[j] * values[k]
                    })
                    .sum();
                let expected = f64::from(u8::from(j == k));
                assert!((product - expected).abs() < 1e-12, "{n} {j} {k}: {product}");
            }
        }
    }
}

#[test]
fn the_first_function_of_one_diameter_is_the_tilt() {
    let basis = paper_basis(8);
    let ratio = |r: f64| basis.evaluate(1, r).value[0] / r;
    assert!((ratio(0.11) / ratio(0.35) - 1.0).abs() < 1e-13);
    assert!(basis.evaluate(1, 0.2).curvature[0].abs() < 1e-10);
}

#[test]
fn derivatives_agree_with_central_differences() {
    let basis = paper_basis(8);
    let (r, step) = (0.21, 1e-6);
    let middle = basis.evaluate(1, r);
    let (low, high) = (basis.evaluate(1, r - step), basis.evaluate(1, r + step));
    for j in 1..8 {
        let slope = (high.value[j] - low.value[j]) / (2.0 * step);
        assert!((slope / middle.slope[j] - 1.0).abs() < 1e-6);
        let curvature = (high.slope[j] - low.slope[j]) / (2.0 * step);
        assert!(
            (curvature - middle.curvature[j]).abs() < 1e-6 * middle.curvature[j].abs().max(1.0)
        );
    }
}
