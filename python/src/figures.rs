//! The program's own figures, summary and colours, made of a report's JSON.

use pyo3::prelude::*;
use pyo3::types::PyBytes;
use sawflutter::figure::{self, FigureError};
use sawflutter::report::{CheckReport, CutReport, FitReport, PlaceReport, Report, RunUpReport};
use sawflutter::study::StudyReport;
use serde::de::DeserializeOwned;

use crate::failure::Failure;

type Picture = Result<Option<Vec<u8>>, Failure>;

/// A figure of a report by the name of its file; `None` where the saw has none of that name.
#[pyfunction]
pub fn picture(py: Python<'_>, name: &str, report: &str) -> PyResult<Option<Py<PyBytes>>> {
    let bytes = py.detach(|| drawn(name, report))?;
    Ok(bytes.map(|bytes| PyBytes::new(py, &bytes).unbind()))
}

fn drawn(name: &str, report: &str) -> Picture {
    match name {
        "campbell.png" => of::<Report>(report, |r| figure::campbell_png(r).map(Some)),
        "campbell.svg" => of::<Report>(report, |r| text(figure::campbell_svg(r).map(Some))),
        "root-loci.png" => of::<Report>(report, figure::root_loci_png),
        "root-loci.svg" => of::<Report>(report, |r| text(figure::root_loci_svg(r))),
        "membrane.png" => of::<Report>(report, figure::membrane_png),
        "membrane.svg" => of::<Report>(report, |r| text(figure::membrane_svg(r))),
        "check.png" => of::<CheckReport>(report, |r| figure::check_png(r).map(Some)),
        "check.svg" => of::<CheckReport>(report, |r| text(figure::check_svg(r).map(Some))),
        "cut.png" => of::<CutReport>(report, |r| figure::cut_png(r).map(Some)),
        "cut.svg" => of::<CutReport>(report, |r| text(figure::cut_svg(r).map(Some))),
        "cut-map.png" => of::<CutReport>(report, |r| figure::cut_map_png(r).map(Some)),
        "cut-map.svg" => of::<CutReport>(report, |r| text(figure::cut_map_svg(r).map(Some))),
        "spline-orbit.png" => of::<CutReport>(report, figure::spline_orbit_png),
        "spline-orbit.svg" => of::<CutReport>(report, |r| text(figure::spline_orbit_svg(r))),
        "runup.png" => of::<RunUpReport>(report, |r| figure::runup_png(r).map(Some)),
        "runup.svg" => of::<RunUpReport>(report, |r| text(figure::runup_svg(r).map(Some))),
        "response-map.png" => of::<RunUpReport>(report, |r| figure::response_map_png(r).map(Some)),
        "response-map.svg" => {
            of::<RunUpReport>(report, |r| text(figure::response_map_svg(r).map(Some)))
        }
        "fit.png" => of::<FitReport>(report, |r| figure::fit_png(r).map(Some)),
        "fit.svg" => of::<FitReport>(report, |r| text(figure::fit_svg(r).map(Some))),
        "place.png" => of::<PlaceReport>(report, figure::place_png),
        "place.svg" => of::<PlaceReport>(report, |r| text(figure::place_svg(r))),
        "study.png" => of::<StudyReport>(report, |r| figure::study_png(r).map(Some)),
        "study.svg" => of::<StudyReport>(report, |r| text(figure::study_svg(r).map(Some))),
        _ => Err(Failure::argument(
            "name",
            format!("{name:?}"),
            "the name of a figure that the program writes".to_owned(),
            "the method figure_names lists them",
        )),
    }
}

fn of<T: DeserializeOwned>(
    report: &str,
    draw: impl FnOnce(&T) -> Result<Option<Vec<u8>>, FigureError>,
) -> Picture {
    Ok(draw(&serde_json::from_str(report)?)?)
}

fn text(drawn: Result<Option<String>, FigureError>) -> Result<Option<Vec<u8>>, FigureError> {
    Ok(drawn?.map(String::into_bytes))
}

/// What `sawflutter analyze` prints of a report.
#[pyfunction]
pub fn summary(report: &str) -> PyResult<String> {
    let report: Report = serde_json::from_str(report).map_err(Failure::from)?;
    Ok(sawflutter::cli::summary(&report))
}

/// `campbell.csv` of a report.
#[pyfunction]
pub fn campbell_csv(report: &str) -> PyResult<String> {
    let report: Report = serde_json::from_str(report).map_err(Failure::from)?;
    let table = report.campbell_csv();
    let table = table.map_err(|error| Failure::Failed(error.to_string()))?;
    Ok(String::from_utf8_lossy(&table).into_owned())
}

/// The colours of the figures, red, green and blue by what is drawn, as JSON.
#[pyfunction]
pub fn palette() -> PyResult<String> {
    Ok(serde_json::to_string(&figure::PALETTE).map_err(Failure::from)?)
}
