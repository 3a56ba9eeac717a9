//! Speeds at which the estimated error of an edge leaves open whether a saw is stable.

/// An edge of a band that counts, in any unit of speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Edge {
    /// Speed at which the band begins or ends.
    pub speed: f64,
    /// Its estimated error; `None` if it is unknown.
    pub error: Option<f64>,
}

/// Relative distance from an edge of unknown error within which it is open on which side a speed is: the tolerance of the coarsest
/// accuracy.
const UNKNOWN: f64 = 0.01;

impl Edge {
    /// Distance within which the edge leaves open on which side a speed is.
    fn reach(&self) -> f64 {
        self.error.unwrap_or(UNKNOWN * self.speed)
    }

    /// The speeds for which the edge leaves open on which side they are.
    pub(crate) fn open(&self) -> [f64; 2] {
        [self.speed - self.reach(), self.speed + self.reach()]
    }
}

/// The edges of a band that counts within some stretches of it. The ends of the sweep are no edges, and neither are the speeds at which
/// the growth in a damped band reaches the threshold: they have no estimated error.
pub(crate) fn edges<'a>(
    band: [f64; 2],
    stretches: impl IntoIterator<Item = [f64; 2]> + 'a,
    relative_error: Option<f64>,
    sweep: [f64; 2],
) -> impl Iterator<Item = Edge> + 'a {
    let ends = stretches.into_iter().flatten();
    let own = ends.filter(move |end| band.contains(end) && !sweep.contains(end));
    own.map(move |speed| Edge {
        speed,
        error: relative_error.map(|error| error * speed),
    })
}

/// The nearest of the edges whose error exceeds its distance from a speed.
pub(crate) fn undecided(edges: impl Iterator<Item = Edge>, speed: f64) -> Option<Edge> {
    let away = |edge: &Edge| (edge.speed - speed).abs();
    let open = edges.filter(|edge| away(edge) <= edge.reach());
    open.min_by(|x, y| away(x).total_cmp(&away(y)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::scene::{Accuracy, Scene};
    use crate::stability::{Analysis, StabilityState};

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
        let verdict = analysis.verdict(exact);
        assert_eq!(verdict.state, StabilityState::TooClose);
        let found = verdict.undecided.unwrap();
        assert_eq!(found.speed, edge);
        for away in [-2.0, 2.0] {
            let beyond = analysis.verdict(edge + away * found.error.unwrap());
            assert_eq!(beyond.undecided, None);
            assert_ne!(beyond.state, StabilityState::TooClose);
        }
    }

    #[test]
    fn ends_of_the_sweep_leave_nothing_open_and_edges_of_unknown_error_leave_a_percent() {
        let at =
            |error, sweep| undecided(edges([100.0, 200.0], [[100.0, 150.0]], error, sweep), 99.5);
        let edge = Edge {
            speed: 100.0,
            error: Some(1.0),
        };
        assert_eq!(at(Some(0.01), [0.0, 300.0]), Some(edge));
        assert_eq!(at(Some(0.01), [100.0, 300.0]), None);
        let unknown = Edge {
            error: None,
            ..edge
        };
        assert_eq!(at(None, [0.0, 300.0]), Some(unknown));
        let stretch = [[100.0, 150.0]];
        let beyond = edges([100.0, 200.0], stretch, None, [0.0, 300.0]);
        assert_eq!(undecided(beyond, 98.9), None);
        // Where the growth falls below the threshold, at 150, is no edge.
        assert_eq!(
            undecided(
                edges([100.0, 200.0], [[100.0, 150.0]], Some(0.01), [0.0, 300.0]),
                150.0
            ),
            None
        );
    }
}
