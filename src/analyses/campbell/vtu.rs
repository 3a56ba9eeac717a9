//! Shapes of a report as VTK files for ParaView: a grid for each phase of a period, and a list of the grids.
//!
//! The blade is a grid of quadrilaterals; each shape is an array of deflections by which the grid is warped.
//! Playing the list shows the motion of a wave.

use std::f64::consts::TAU;
use std::fmt::Write;

use super::analysis::Report;
use super::event_shape::EventShape;
use crate::page::text::escaped;

/// File names of the list and of the grids.
pub const VTK_NAMES: [&str; 1 + PHASES] = [
    "modes.pvd",
    "modes-00.vtu",
    "modes-01.vtu",
    "modes-02.vtu",
    "modes-03.vtu",
    "modes-04.vtu",
    "modes-05.vtu",
    "modes-06.vtu",
    "modes-07.vtu",
    "modes-08.vtu",
    "modes-09.vtu",
    "modes-10.vtu",
    "modes-11.vtu",
];
/// Number of phases of a period.
const PHASES: usize = 12;
/// Number of angles of the grid.
const ANGLES: usize = 120;
/// One in this number of radii of a shape is a radius of the grid.
const STRIDE: usize = 2;
/// VTK's number of the cell type quadrilateral.
const QUADRILATERAL: u8 = 9;

/// Title of a shape, and its complex deflections at the points of the grid.
type Titled = (String, Vec<[f64; 2]>);

/// A file for ParaView.
pub struct VtkFile {
    /// Name of the file.
    pub name: &'static str,
    /// Content of the file.
    pub text: String,
}

impl Report {
    /// The VTK files; none if the report has no shapes.
    pub fn vtk_files(&self) -> Vec<VtkFile> {
        let Some(first) = self.shapes.first() else {
            return Vec::new();
        };
        let turns = (0..ANGLES).map(|k| TAU * k as f64 / ANGLES as f64);
        let angles: Vec<f64> = turns.collect();
        let radii: Vec<f64> = first.radius_m.iter().step_by(STRIDE).copied().collect();
        let shapes: Vec<Titled> = self
            .shapes
            .iter()
            .enumerate()
            .map(|(number, shape)| {
                let rows = shape.at(&angles).into_iter().step_by(STRIDE);
                (title(number + 1, shape), rows.flatten().collect())
            })
            .collect();
        let grids = VTK_NAMES[1..].iter().enumerate().map(|(phase, name)| {
            let mut text = String::new();
            // Writing to a string cannot fail.
            let _ = grid(&mut text, &radii, &angles, &shapes, phase);
            VtkFile { name, text }
        });
        let list = VtkFile {
            name: VTK_NAMES[0],
            text: list(),
        };
        std::iter::once(list).chain(grids).collect()
    }
}

/// The list of grids with their times, in periods.
fn list() -> String {
    let sets = VTK_NAMES[1..].iter().enumerate().map(|(phase, name)| {
        let time = phase as f64 / PHASES as f64;
        format!("<DataSet timestep=\"{time:.6}\" part=\"0\" file=\"{name}\"/>\n")
    });
    format!(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n{}</Collection>\n</VTKFile>\n",
        sets.collect::<String>()
    )
}

fn grid(
    text: &mut String,
    radii_m: &[f64],
    angles: &[f64],
    shapes: &[Titled],
    phase: usize,
) -> std::fmt::Result {
    let points = radii_m.len() * ANGLES;
    let cells = radii_m.len().saturating_sub(1) * ANGLES;
    writeln!(
        text,
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"{points}\" NumberOfCells=\"{cells}\">\n<Points>"
    )?;
    let at = |radius: f64, angle: f64| {
        let (sin, cos) = angle.sin_cos();
        format!("{} {} 0", short(radius * cos), short(radius * sin))
    };
    let all = radii_m
        .iter()
        .flat_map(|r| angles.iter().map(move |a| at(*r, *a)));
    array(text, "Float64", "points", 3, all)?;
    writeln!(text, "</Points>\n<Cells>")?;
    let corners = (0..cells).map(quadrilateral);
    array(text, "Int32", "connectivity", 1, corners)?;
    let ends = (1..=cells).map(|k| (4 * k).to_string());
    array(text, "Int32", "offsets", 1, ends)?;
    let types = (0..cells).map(|_| QUADRILATERAL.to_string());
    array(text, "UInt8", "types", 1, types)?;
    writeln!(text, "</Cells>\n<PointData>")?;
    let (sin, cos) = (TAU * phase as f64 / PHASES as f64).sin_cos();
    for (title, values) in shapes {
        let moment = values.iter().map(|[re, im]| short(re * cos - im * sin));
        array(text, "Float32", title, 1, moment)?;
    }
    writeln!(
        text,
        "</PointData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>"
    )
}

/// The corners of a cell, counted ring by ring.
fn quadrilateral(cell: usize) -> String {
    let (ring, k) = (cell / ANGLES, cell % ANGLES);
    let next = (k + 1) % ANGLES;
    let at = |ring: usize, k: usize| ring * ANGLES + k;
    format!(
        "{} {} {} {}",
        at(ring, k),
        at(ring, next),
        at(ring + 1, next),
        at(ring + 1, k)
    )
}

/// A number with six decimals, enough for a picture.
fn short(value: f64) -> String {
    format!("{}", (1e6 * value).round() / 1e6)
}

/// Title of a shape: the name of its array, which ParaView lists.
fn title(number: usize, shape: &EventShape) -> String {
    escaped(&format!("{number:02} {:.0} rpm {}", shape.rpm, shape.name))
}

fn array(
    text: &mut String,
    kind: &str,
    name: &str,
    components: usize,
    values: impl Iterator<Item = String>,
) -> std::fmt::Result {
    writeln!(
        text,
        "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" format=\"ascii\">"
    )?;
    for value in values {
        writeln!(text, "{value}")?;
    }
    writeln!(text, "</DataArray>")
}
