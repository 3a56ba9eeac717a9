//! Goal: the exported matrices, sliced by their documented layout, have the frequencies of the blade.

use std::f64::consts::TAU;

use nalgebra::DMatrix;
use sawflutter::analyses::campbell::Report;
use serde_json::{Value, json};
use tempfile::TempDir;

use super::program::{sawflutter, text};

/// A square matrix as NumPy reads it, and its order.
fn matrix(bytes: &[u8]) -> DMatrix<f64> {
    let header = usize::from(u16::from_le_bytes([bytes[8], bytes[9]])) + 10;
    let numbers: Vec<f64> = bytes[header..]
        .chunks(8)
        .map(|eight| f64::from_le_bytes(eight.try_into().unwrap()))
        .collect();
    let order = numbers.len().isqrt();
    assert_eq!(order * order, numbers.len());
    DMatrix::from_row_slice(order, order, &numbers)
}

/// Blades with a step of the thickness, with tips, and with both have more basis functions than even blades: the number
/// of each n is equal in matrices.json, on the console and in the report, and the block of n = 2 at the stated place
/// has the lowest frequency of two diameters.
#[test]
fn blocks_of_the_matrices_are_where_their_description_says() {
    let content = std::fs::read_to_string(crate::common::path("scenes/gallery/stepped-rim.json"));
    let stepped: Value = serde_json::from_str(&content.unwrap()).unwrap();
    for absent in [&["rim"][..], &["profile"], &[]] {
        let mut scene = stepped.clone();
        scene["guides"] = json!([]);
        scene["sweep"] = json!({ "to_rpm": 300 });
        scene.as_object_mut().unwrap().remove("operating_rpm");
        let blade = scene["blade"].as_object_mut().unwrap();
        absent.iter().for_each(|key| drop(blade.remove(*key)));
        let folder = TempDir::new().unwrap();
        let path = folder.path().join("scene.json");
        std::fs::write(&path, scene.to_string()).unwrap();
        let said = |name: &str, more: &[&str]| {
            let (out, path) = (folder.path().join("out"), path.to_str().unwrap());
            let done = sawflutter()
                .args([name, path, "--out"])
                .arg(out)
                .args(more)
                .output()
                .unwrap();
            assert!(done.status.success(), "{}", text(&done.stderr));
            text(&done.stdout).to_owned()
        };
        let console = said("export", &["--matrices"]);
        let report: Report = serde_json::from_str(&said("analyze", &["--json"])).unwrap();
        let file = |name: &str| std::fs::read(folder.path().join("out").join(name)).unwrap();
        let about: Value = serde_json::from_slice(&file("matrices.json")).unwrap();
        let number = |key: &str| about[key].as_u64().unwrap() as usize;
        let (diameters, radial) = (number("max_diameters"), number("radial_functions"));
        assert_eq!(report.accuracy.max_diameters, diameters);
        assert_eq!(report.accuracy.radial_functions, radial);
        // These two numbers name the same basis when they are given to the command.
        let named = format!("{diameters},{radial}");
        let again = said("export", &["--matrices", "--basis", &named]);
        assert_eq!(again, console);
        let all = radial * (1 + 2 * diameters);
        let expected =
            format!("{all} functions: n up to {diameters}, {radial} radial functions each");
        assert!(console.contains(&expected), "{expected}: {console}");

        let stiffness = matrix(&file("stiffness.npy"));
        assert_eq!(stiffness.nrows(), all);
        // n = 0: J cosines; n = 1: J cosines, J sines; then the cosines of n = 2.
        let block = stiffness.view((3 * radial, 3 * radial), (radial, radial));
        let squares = block.clone_owned().symmetric_eigenvalues();
        let found_hz = squares.min().sqrt() / TAU;
        let own = report.modes_at_rest.iter().find(|m| m.nodal_diameters == 2);
        let expected_hz = own.unwrap().frequency_hz;
        assert!(
            (found_hz / expected_hz - 1.0).abs() < 1e-6,
            "{absent:?}: {found_hz} {expected_hz}"
        );
        // No other block is coupled to it.
        let size = block.norm();
        let rows = stiffness.rows(3 * radial, radial).norm();
        assert!((rows / size - 1.0).abs() < 1e-12);
    }
}
