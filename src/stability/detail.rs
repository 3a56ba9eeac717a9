//! How closely a chart is drawn.

/// How closely a chart is drawn. Critical speeds and bands do not depend on it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Detail {
    /// As the figures show it.
    #[default]
    Full,
    /// At fewer speeds, without root loci: for a chart that is looked at for a moment.
    Sketch,
}
