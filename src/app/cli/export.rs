//! `sawflutter export`.

use crate::model::plate::{Plate, Resolution};
use crate::model::system::GyroscopicSystem;
use crate::stability::ChosenBasis;
use anyhow::bail;
use clap::Args;
use faer::Mat;
use serde_json::json;

use super::common::{Common, of_option};
use super::output::NamedFile;

pub const EXAMPLES: &str = "\
Examples:
  sawflutter export --matrices # the built-in saw
  sawflutter export --matrices saw.json --basis 16,8 --out matrices
  python3 -c 'import numpy; numpy.load(\"sawflutter-out/stiffness.npy\")'";

#[derive(Args)]
pub struct Arguments {
    #[command(flatten)]
    common: Common,
    /// Write the matrices of the equation of motion as NumPy files
    #[arg(long, required = true)]
    matrices: bool,
    /// Nodal diameters and radial functions of the basis, instead of what the accuracy takes
    #[arg(long, value_name = "N,J", value_parser = basis)]
    basis: Option<Resolution>,
}

/// Parses nodal diameters and radial functions, like `16,8`.
fn basis(text: &str) -> Result<Resolution, String> {
    let numbers = text.split_once(',').and_then(|(diameters, radial)| {
        Some(Resolution {
            max_diameters: diameters.trim().parse().ok()?,
            radial_functions: radial.trim().parse().ok()?,
        })
    });
    numbers.ok_or_else(|| "give two numbers, such as 16,8".to_owned())
}

/// Writes the matrices of a scene, and a description of them.
pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    if !arguments.matrices {
        bail!("say what to export: --matrices");
    }
    let scene = arguments.common.scene()?;
    let checked = |asked: Resolution| {
        Resolution::new(asked.max_diameters, asked.radial_functions, scene.blade())
    };
    let asked = arguments
        .basis
        .map(checked)
        .transpose()
        .map_err(|refused| of_option("basis", refused))?;
    let folder = arguments.common.folder()?;
    let plate = match asked {
        Some(resolution) => Plate::new(&scene, resolution),
        None => ChosenBasis::new(&scene, scene.tolerance())?.saw.plate,
    };
    let system = GyroscopicSystem::of_plate(&plate);
    let mut files: Vec<NamedFile> = vec![
        ("stiffness.npy", npy(&system.stiffness_at(0.0))),
        ("spin.npy", npy(&system.spin)),
        ("gyroscopic.npy", npy(&system.gyroscopic)),
    ];
    let optional = OPTIONAL
        .into_iter()
        .zip([&system.damping, &system.circulatory]);
    for (name, matrix) in optional {
        files.extend(matrix.as_ref().map(|matrix| (name, npy(matrix))));
    }
    let about = json!({
        "scene": scene.file().name,
        "condition": scene.condition(),
        "equation": "q'' + (2*W*gyroscopic + damping) q' + (stiffness + W^2*spin + W*circulatory) q = 0, W in rad/s",
        "units": { "stiffness": "1/s^2", "spin": "1", "gyroscopic": "1", "damping": "1/s", "circulatory": "1/s" },
        "unknowns": "n = 0: J cosines, sqrt(m) h for each guide head with mass m and deflection h, and the states of films and controllers; then for each n >= 1: J cosines, J sines; J = radial_functions; mass matrix one",
        "max_diameters": plate.resolution.max_diameters,
        "radial_functions": plate.radial_functions(),
        "files": files.iter().map(|(name, _)| *name).collect::<Vec<_>>(),
    });
    let json = serde_json::to_string_pretty(&about)?;
    files.push(("matrices.json", json.clone().into_bytes()));
    arguments
        .common
        .output
        .print(&folder, &files, &OPTIONAL, &json, || {
            format!(
                "{}: {}\n{} functions: n up to {}, {} radial functions each\n{}\n",
                scene.file().name,
                scene.condition(),
                plate.degrees_of_freedom(),
                plate.resolution.max_diameters,
                plate.radial_functions(),
                "equation and units in matrices.json"
            )
        })
}

/// Files of matrices that not every saw has.
const OPTIONAL: [&str; 2] = ["damping.npy", "circulatory.npy"];

/// The content of a `.npy` file of a matrix, format 1.0, row by row (NumPy Enhancement Proposal 1). The crates that
/// write this format depend on a parser of Python literals, which depends on a C compiler.
fn npy(matrix: &Mat<f64>) -> Vec<u8> {
    let (rows, columns) = (matrix.nrows(), matrix.ncols());
    let header =
        format!("{{'descr': '<f8', 'fortran_order': False, 'shape': ({rows}, {columns}), }}");
    // The magic number, the version and the length take ten bytes, and the header ends with a line break;
    // together they take a multiple of 64 bytes.
    let length = (10 + header.len() + 1).next_multiple_of(64) - 10;
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend((length as u16).to_le_bytes());
    bytes.extend(format!("{header:<width$}\n", width = length - 1).bytes());
    for i in 0..rows {
        for k in 0..columns {
            bytes.extend(matrix[(i, k)].to_le_bytes());
        }
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_matrix_is_written_as_numpy_reads_it() {
        let bytes = npy(&Mat::from_fn(2, 3, |i, k| (3 * i + k) as f64));
        assert_eq!(&bytes[..10], b"\x93NUMPY\x01\x00\x76\x00");
        let header = std::str::from_utf8(&bytes[10..128]).unwrap();
        assert!(header.starts_with("{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3), }"));
        assert!(header.ends_with(" \n"));
        let value = |place: usize| {
            let start = 128 + 8 * place;
            f64::from_le_bytes(bytes[start..start + 8].try_into().unwrap())
        };
        assert_eq!((bytes.len(), value(1), value(5)), (176, 1.0, 5.0));
    }

    #[test]
    fn a_basis_is_two_numbers() {
        let asked = Resolution {
            max_diameters: 16,
            radial_functions: 8,
        };
        assert_eq!(basis("16, 8"), Ok(asked));
        for wrong in ["", "16", "a,b", "16,8,4"] {
            assert!(basis(wrong).is_err(), "{wrong}");
        }
    }
}
