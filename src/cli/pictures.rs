//! Files of the figures of a report.

use rayon::prelude::*;

use super::common::NamedFile;
use crate::commands::CommandReport;
use crate::figure::{Figure, FigureError};

/// Draws every figure of a report as PNG and SVG.
pub fn drawn(report: &impl CommandReport) -> Result<Vec<NamedFile>, FigureError> {
    files(&report.figures())
}

/// Draws figures as PNG and SVG, in parallel because one picture takes as long as a hundred spectra.
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
