//! Files of the figures of a report.

use rayon::prelude::*;

use super::output::NamedFile;
use crate::analyses::commands::CommandReport;
use crate::page::figure::{Figure, FigureError};

/// Draws the figures of a report as PNG and SVG; those that a designer does not need only with `details`.
pub fn drawn(report: &dyn CommandReport, details: bool) -> Result<Vec<NamedFile>, FigureError> {
    files(&shown(report, report.figures(), details))
}

/// The figures that are drawn with or without details.
pub fn shown(report: &dyn CommandReport, figures: Vec<Figure>, details: bool) -> Vec<Figure> {
    let is_shown = |figure: &Figure| {
        let [png, _] = figure.names();
        details || !report.is_detail(png.trim_end_matches(".png"))
    };
    figures.into_iter().filter(is_shown).collect()
}

/// Draws figures as PNG and SVG, in parallel because one picture takes as long as a hundred spectra.
pub fn files(figures: &[Figure]) -> Result<Vec<NamedFile>, FigureError> {
    let files: Vec<[Result<NamedFile, FigureError>; 2]> = figures
        .par_iter()
        .map(|figure| {
            let [png, svg] = figure.names();
            rayon::join(
                || Ok((png, figure.png()?)),
                || Ok((svg, figure.svg()?.into_bytes())),
            )
            .into()
        })
        .collect();
    files.into_iter().flatten().collect()
}
