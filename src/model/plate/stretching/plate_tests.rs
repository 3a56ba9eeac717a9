//! Large deflections under a point load, compared with three-dimensional finite elements, and convergence.

use faer::linalg::solvers::Solve;
use faer::{Col, Mat, Scale, Side};

use super::test_blades::{Wave, plate, projected};
use super::*;
use crate::model::linalg::SymmetricEigen;

/// A result of CalculiX, extrapolated to zero thickness, for which plate theory is exact.
struct Calculated {
    /// Zero for the linear response to one newton.
    load_n: f64,
    place: String,
    deflection_m: f64,
}

fn calculix() -> Vec<Calculated> {
    let table = include_str!("../../../../tests/reference/large_deflection_point.csv");
    let rows = table.lines().filter(|line| line.starts_with("point,"));
    rows.map(|row| {
        let cells: Vec<&str> = row.split(',').collect();
        let thin_mm: f64 = cells[7].parse().expect("a number");
        Calculated {
            load_n: cells[1].parse().unwrap_or(0.0),
            place: cells[2].to_owned(),
            deflection_m: 1e-3 * thin_mm,
        }
    })
    .collect()
}

/// A blade whose middle plane is supported at three points of its bore, on an orthonormal basis of deflections even
/// in θ: its lowest modes and its response to the load.
struct SupportedBlade {
    plate: Plate,
    shapes: Mat<f64>,
    stiffness: Mat<f64>,
}

impl SupportedBlade {
    fn new(resolution: [usize; 2], shapes: usize, load_radius_m: f64) -> Self {
        let plate = plate(resolution, |_| ());
        let order = plate.degrees_of_freedom();
        let mut bending: Mat<f64> = Mat::zeros(order, order);
        for (n, block) in plate.harmonics.iter().enumerate() {
            for j in 0..plate.basis.count() {
                for k in 0..plate.basis.count() {
                    for first in [plate.offset(n), plate.offset(n) + plate.basis.count()] {
                        if n > 0 || first == 0 {
                            bending[(first + j, first + k)] = block.bending[(j, k)];
                        }
                    }
                }
            }
        }
        // Springs of 1e10 N/m, against 8e3 N/m of the blade, prevent motion of the points.
        let mut supported = bending.clone();
        for angle in [60.0_f64, 180.0, 300.0] {
            let at = functions(&plate, plate.blade.inner_radius_m, angle);
            supported += Scale(1e10) * &at * at.transpose();
        }
        let even: Vec<usize> = (0..=plate.max_diameters())
            .flat_map(|n| plate.offset(n)..plate.offset(n) + plate.basis.count())
            .collect();
        let on_even = Mat::from_fn(even.len(), even.len(), |i, k| supported[(even[i], even[k])]);
        let modes = SymmetricEigen::new(on_even.as_ref()).unwrap();
        let full_force = functions(&plate, load_radius_m, 0.0);
        let force = Col::from_fn(even.len(), |i| full_force[even[i]]);
        let answer = on_even.llt(Side::Lower).unwrap().solve(&force);
        let mut vectors = Mat::zeros(order, shapes);
        for (i, &row) in even.iter().enumerate() {
            for k in 1..shapes {
                vectors[(row, k)] = modes.vectors[(i, k - 1)];
            }
            vectors[(row, 0)] = answer[i];
        }
        let shapes = vectors.qr().compute_thin_Q();
        SupportedBlade {
            stiffness: shapes.transpose() * &supported * &shapes,
            plate,
            shapes,
        }
    }

    /// Deflections under increasing loads, in the functions of the plate, by Newton's method.
    fn bent(&self, loads_n: &[f64], load_radius_m: f64) -> Vec<Col<f64>> {
        let stretching = Stretching::new(&self.plate).unwrap();
        let reduced = ReducedStretching::new(&stretching, self.shapes.as_ref()).unwrap();
        let force = self.shapes.transpose() * functions(&self.plate, load_radius_m, 0.0);
        let mut p = Col::zeros(self.shapes.ncols());
        let mut all = Vec::new();
        for load_n in loads_n {
            for _ in 0..20 {
                let tangent = &self.stiffness + reduced.hessian(&p).unwrap();
                let rest =
                    Scale(*load_n) * &force - &self.stiffness * &p - reduced.gradient(&p).unwrap();
                let step = tangent.llt(Side::Lower).unwrap().solve(&rest);
                p += &step;
                if step.norm_l2() < 1e-10 * p.norm_l2() {
                    break;
                }
            }
            all.push(&self.shapes * &p);
        }
        all
    }
}

fn functions(plate: &Plate, radius_m: f64, angle_deg: f64) -> Col<f64> {
    let values = plate.functions_at(radius_m, angle_deg.to_radians());
    Col::from_fn(values.len(), |i| values[i])
}

/// A blade supported at three points of its bore, under a point force at the rim that deflects it by a tenth
/// to five and a half thicknesses. Point supports converge as 1/n_max², so that two bases give the limit.
#[test]
fn a_blade_under_a_point_load_bends_as_three_dimensional_elements_do() {
    let table = calculix();
    let mut loads_n: Vec<f64> = table
        .iter()
        .map(|row| row.load_n)
        .filter(|load| *load > 0.0)
        .collect();
    loads_n.dedup();
    let rim_m = 0.355;
    let bases = [12, 20].map(|diameters| {
        let blade = SupportedBlade::new([diameters, 8], 24, rim_m);
        (
            blade.bent(&loads_n, rim_m),
            blade,
            (diameters * diameters) as f64,
        )
    });
    let found = |index: usize, place: &str| {
        let radius_m = if place.starts_with("rim") { rim_m } else { 0.1 };
        let angle = place
            .trim_start_matches(char::is_alphabetic)
            .parse()
            .expect("an angle");
        let [coarse, fine] = bases.each_ref().map(|(bent, blade, n2)| {
            let w = functions(&blade.plate, radius_m, angle).transpose() * &bent[index];
            (w, *n2)
        });
        (fine.1 * fine.0 - coarse.1 * coarse.0) / (fine.1 - coarse.1)
    };
    for row in &table {
        let (load, place, expected) = (&row.load_n, &row.place, row.deflection_m);
        let Some(index) = loads_n.iter().position(|own| own == load) else {
            continue;
        };
        let (found, largest) = (found(index, place), found(index, "rim0"));
        let error = (found - expected) / largest;
        assert!(error.abs() < 1e-3, "{load} N, {place}: {found} {expected}");
    }
}

/// U₄ of a saddle with a ripple that is not a polynomial, over n_max and J.
#[test]
fn the_potential_converges_in_both_directions() {
    let energy = |resolution: [usize; 2]| {
        let plate = plate(resolution, |_| ());
        // w = r² cos 2θ / (1 + cos θ/2) / (1 + r), by its Fourier series over 128 points.
        let parts: Vec<(usize, f64)> = (0..=resolution[0])
            .map(|n| {
                let sum: f64 = (0..128)
                    .map(|k| f64::from(k) * std::f64::consts::TAU / 128.0)
                    .map(|angle| {
                        let w = (2.0 * angle).cos() / (1.0 + 0.5 * angle.cos());
                        w * (n as f64 * angle).cos()
                    })
                    .sum();
                (n, sum / if n == 0 { 128.0 } else { 64.0 })
            })
            .collect();
        let shapes: Vec<Box<dyn Fn(f64) -> f64>> = parts
            .iter()
            .map(|(_, factor)| {
                let factor = *factor;
                Box::new(move |r: f64| factor * r * r / (1.0 + r)) as Box<dyn Fn(f64) -> f64>
            })
            .collect();
        let zero: &dyn Fn(f64) -> f64 = &|_| 0.0;
        let waves: Vec<Wave<'_>> = parts
            .iter()
            .zip(&shapes)
            .map(|((n, _), shape)| (*n, [shape.as_ref(), zero]))
            .collect();
        let stretching = Stretching::new(&plate).unwrap();
        stretching.energy_j(&projected(&plate, &waves)).unwrap()
    };
    let exact = energy([20, 9]);
    // Coefficients fall as (2 − √3)ⁿ = 0.27ⁿ around the blade, and as 0.09ʲ over the radius.
    for (resolution, most) in [([6, 9], 2e-2), ([10, 9], 3e-4), ([14, 9], 3e-6)] {
        let error = energy(resolution) / exact - 1.0;
        assert!(error.abs() < most, "{resolution:?}: {error:e}");
    }
    for (resolution, most) in [([20, 3], 2e-2), ([20, 4], 2e-3), ([20, 6], 2e-5)] {
        let error = energy(resolution) / exact - 1.0;
        assert!(error.abs() < most, "{resolution:?}: {error:e}");
    }
}
