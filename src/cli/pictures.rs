//! The figures of a report as files.

use rayon::prelude::*;

use super::common::NamedFile;
use crate::figure::{Figure, FigureError, Figures};

/// Every figure of a report as PNG and SVG.
pub fn drawn(report: &impl Figures) -> Result<Vec<NamedFile>, FigureError> {
    files(&report.figures())
}

/// Figures as PNG and SVG, drawn side by side: a picture takes as long as a hundred spectra.
pub fn files(figures: &[Figure]) -> Result<Vec<NamedFile>, FigureError> {
    let files: Vec<[Result<NamedFile, FigureError>; 2]> = figures
        .par_iter()
        .map(|figure| {
            let [png, svg] = figure.names();
            let (png, svg) = rayon::join(
                || Ok((png, figure.png()?)),
                || Ok((svg, figure.svg()?.into_bytes())),
            );
            [png, svg]
        })
        .collect();
    files.into_iter().flatten().collect()
}

/// Names of the files of all figures that such a report may have.
pub fn figure_names<R: Figures>() -> Vec<&'static str> {
    R::NAMES.iter().flatten().copied().collect()
}
