//! Detail of a chart.

/// Detail of a chart. Critical speeds and bands do not depend on it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Detail {
    /// Detail of the figures.
    #[default]
    Full,
    /// Fewer speeds and no root loci: for a quick preview.
    Sketch,
}
