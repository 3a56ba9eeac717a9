//! Speeds at which the estimated error of an edge leaves open whether a saw is stable.

use super::analysis::Analysis;

/// An edge of a band that is so close to a speed that its error decides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UndecidedEdge {
    /// Speed at which a band that counts begins or ends, in rad/s.
    pub edge_rad_per_s: f64,
    /// Its estimated error, in rad/s.
    pub error_rad_per_s: f64,
}

impl Analysis {
    /// The nearest edge of a band that counts, if its estimated error exceeds its distance from a speed. The ends of the sweep are no
    /// edges, and neither are the speeds at which the growth in a damped band reaches the threshold: they have no estimated error.
    pub(crate) fn undecided(&self, speed_rad_per_s: f64) -> Option<UndecidedEdge> {
        let estimates = self.estimates.as_ref()?;
        let threshold = self.scene.flutter_threshold_per_s();
        let bands = self.chart.instabilities.iter().zip(&estimates.bands);
        let edges = bands.flat_map(|(band, error)| {
            let counted = band.counted(threshold).into_iter();
            let ends = counted.flat_map(|stretch| stretch.ends());
            let own = ends.filter(|edge| band.range().ends().contains(edge));
            own.filter_map(|edge| {
                Some(UndecidedEdge {
                    edge_rad_per_s: edge,
                    error_rad_per_s: error.speed? * edge,
                })
            })
        });
        let sweep = self.range_rad_per_s.ends();
        let away = |found: &UndecidedEdge| (found.edge_rad_per_s - speed_rad_per_s).abs();
        let open = edges.filter(|found| {
            !sweep.contains(&found.edge_rad_per_s) && away(found) <= found.error_rad_per_s
        });
        open.min_by(|x, y| away(x).total_cmp(&away(y)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::scene::{Accuracy, Scene};

    /// Reference: the edge on the basis of the accuracy `reference`, on whose side the saw truly is.
    #[test]
    #[cfg_attr(debug_assertions, ignore = "many eigenproblems: run it in release")]
    fn an_edge_within_its_error_leaves_a_speed_open_and_one_beyond_does_not() {
        let flutter = |accuracy| {
            let scene = Scene::paper()
                .edited(|file| file.accuracy = accuracy)
                .unwrap();
            let analysis = Analysis::new(&scene).unwrap();
            (analysis.flutter_speed_rad_per_s.unwrap(), analysis)
        };
        let (edge, analysis) = flutter(Accuracy::Draft);
        let (exact, _) = flutter(Accuracy::Reference);
        let found = analysis.undecided(exact).unwrap();
        assert_eq!(found.edge_rad_per_s, edge);
        for away in [-2.0, 2.0] {
            let beyond = edge + away * found.error_rad_per_s;
            assert_eq!(analysis.undecided(beyond), None);
        }
    }
}
