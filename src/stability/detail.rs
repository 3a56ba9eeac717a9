//! Detail of a chart: full, or a quick preview.

use crate::modes::branches::Closeness;

/// Detail of a chart. Critical speeds do not depend on it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Detail {
    /// All speeds, checks and root loci that report and figures show.
    #[default]
    Full,
    /// Fewer speeds, neither proof nor root loci, and errors of the bands that are too small for a figure to
    /// show: for a quick preview.
    Sketch,
}

impl Detail {
    /// Accuracy of the lines of a chart.
    pub(super) fn closeness(self) -> Closeness {
        match self {
            Detail::Full => Closeness::FIGURE,
            Detail::Sketch => Closeness::SKETCH,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::scene::{Accuracy, Scene, rpm};
    use crate::stability::{Analysis, AnalysisOptions};

    /// A sketch has the critical speeds of the full chart, and its bands to 0.5 rpm and 3 % of their growth,
    /// also with damping and in the cut; none of its checks fails.
    #[test]
    fn a_sketch_has_the_bands_of_the_full_chart() {
        for scene in [
            "paper",
            "gallery/damped-pad",
            "gallery/in-cut",
            "gallery/weak-pad",
        ] {
            let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes");
            let text = std::fs::read_to_string(format!("{folder}/{scene}.json")).unwrap();
            let saw = Scene::from_json(&text)
                .unwrap()
                .edited(|file| file.accuracy = Accuracy::Draft)
                .unwrap();
            let [sketch, full] = [Detail::Sketch, Detail::Full].map(|detail| {
                let options = AnalysisOptions {
                    detail,
                    ..AnalysisOptions::default()
                };
                Analysis::with_options(&saw, options).unwrap()
            });
            assert_eq!(sketch.critical_rad_per_s(), full.critical_rad_per_s());
            assert!(sketch.chart.certificate.is_clean(), "{scene}");
            assert_eq!(sketch.bands().len(), full.bands().len(), "{scene}");
            for (sketched, band) in sketch.bands().iter().zip(full.bands()) {
                assert_eq!(sketched.kind, band.kind);
                let ends = [
                    (sketched.from_rad_per_s, band.from_rad_per_s),
                    (sketched.to_rad_per_s, band.to_rad_per_s),
                ];
                for (found, expected) in ends {
                    let off = rpm((found - expected).abs());
                    assert!(off < 0.5, "{scene}: {off} rpm at {:.1}", rpm(expected));
                }
                let growth = sketched.peak_growth_per_s / band.peak_growth_per_s;
                assert!((growth - 1.0).abs() < 0.03, "{scene}: {growth}");
            }
        }
    }
}
