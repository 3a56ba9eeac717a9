//! The matrices of the equation of motion.

use faer::Mat;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use sawflutter::model::plate::{Plate, Resolution};
use sawflutter::model::scene::Scene;
use sawflutter::model::system::GyroscopicSystem;

use crate::arguments;
use crate::beside::chosen_basis;
use crate::failure::Failure;
use crate::watch::compute;

/// The matrices by name, row by row as little-endian doubles, and the size of their basis. The result is bytes because
/// NumPy reads them without a copy; rust-numpy would switch on features of dependencies, for which the whole library
/// would have to be built a second time.
#[pyfunction]
#[pyo3(signature = (scene, *, basis=None, beside=None))]
pub fn matrices<'py>(
    py: Python<'py>,
    scene: &str,
    basis: Option<(usize, usize)>,
    beside: Option<String>,
) -> PyResult<(Bound<'py, PyDict>, usize, usize)> {
    let scene = arguments::scene(scene)?;
    let basis = basis
        .map(|basis| resolution(basis.into(), &scene))
        .transpose()?;
    let (named, diameters, functions) = compute(py, None, move |_| {
        let plate = match basis {
            Some(resolution) => Plate::new(&scene, resolution),
            None => chosen_basis(&scene, beside.as_deref())?.saw.plate,
        };
        let system = GyroscopicSystem::of_plate(&plate);
        let mut named = vec![
            ("stiffness", bytes(&system.stiffness_at(0.0))),
            ("spin", bytes(&system.spin)),
            ("gyroscopic", bytes(&system.gyroscopic)),
        ];
        named.extend(system.damping.iter().map(|m| ("damping", bytes(m))));
        named.extend(system.circulatory.iter().map(|m| ("circulatory", bytes(m))));
        Ok((named, plate.max_diameters(), plate.radial_functions()))
    })?;
    let found = PyDict::new(py);
    for (name, matrix) in named {
        found.set_item(name, PyBytes::new(py, &matrix))?;
    }
    Ok((found, diameters, functions))
}

/// Every basis function at points of the blade, in 1/√kg, row by row as little-endian doubles.
#[pyfunction]
pub fn functions_at<'py>(
    py: Python<'py>,
    scene: &str,
    basis: (usize, usize),
    radius_m: Vec<f64>,
    angle_rad: Vec<f64>,
) -> PyResult<Bound<'py, PyBytes>> {
    let scene = arguments::scene(scene)?;
    let blade = scene.blade();
    let (inner, outer) = (blade.inner_radius_m, blade.outer_radius_m);
    // Values in metres within rounding of an edge are on the blade.
    let within = |r: &f64| inner * (1.0 - 1e-12) <= *r && *r <= outer * (1.0 + 1e-12);
    if let Some(off) = radius_m.iter().find(|radius| !within(radius)) {
        let allowed = format!("from {inner} to {outer}, the radii of the blade");
        return Err(
            Failure::argument("radius_m", off, allowed, "name a point of the blade").into(),
        );
    }
    let plate = Plate::new(&scene, resolution(basis.into(), &scene)?);
    let points = radius_m.iter().zip(&angle_rad);
    let values = points.flat_map(|(radius, angle)| plate.functions_at(*radius, *angle));
    let bytes: Vec<u8> = values.flat_map(f64::to_le_bytes).collect();
    Ok(PyBytes::new(py, &bytes))
}

fn resolution([diameters, radial]: [usize; 2], scene: &Scene) -> Result<Resolution, Failure> {
    Ok(Resolution::new(diameters, radial, scene.blade())?)
}

fn bytes(matrix: &Mat<f64>) -> Vec<u8> {
    let (rows, columns) = (matrix.nrows(), matrix.ncols());
    let places = (0..rows).flat_map(|i| (0..columns).map(move |k| (i, k)));
    places
        .flat_map(|(i, k)| matrix[(i, k)].to_le_bytes())
        .collect()
}
