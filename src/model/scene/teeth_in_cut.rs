//! Number and places of the teeth in the cut.
//!
//! Teeth one pitch apart pass the arc of the cut, so that arc over pitch is their mean number z + f, with an integer z and 0 ≤
//! f < 1. During the share f of the time z + 1 teeth cut, and during the rest z; in the mean over either of these times they are
//! symmetric about the middle of the arc.

use std::f64::consts::TAU;

/// The teeth that pass the arc of the cut.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TeethInCut {
    /// Angle of the middle of the cut.
    pub angle_deg: f64,
    /// Mean number of teeth in the cut: arc over pitch.
    pub mean: f64,
    /// Number of all teeth of the blade.
    pub all: u32,
}

/// A tooth at a place of the rim for a share of the time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tooth {
    /// Mean angle of the tooth during this time.
    pub angle_rad: f64,
    /// Share of the time, by which the forces of the tooth are multiplied to give their mean.
    pub share: f64,
}

impl TeethInCut {
    /// Angle between successive teeth.
    pub fn pitch_rad(&self) -> f64 {
        TAU / f64::from(self.all)
    }

    /// The teeth of the mean loads: z and z + 1 of them, one pitch apart, symmetric about the middle of the cut, each for its
    /// share of the time.
    pub fn standing(&self) -> Vec<Tooth> {
        let whole = self.mean.floor();
        let more = self.mean - whole;
        let row = |count: f64, share: f64| {
            let places = (0..count as u32).map(move |k| f64::from(k) - 0.5 * (count - 1.0));
            places.map(move |place| Tooth {
                angle_rad: self.angle_deg.to_radians() + place * self.pitch_rad(),
                share,
            })
        };
        let rows = row(whole, 1.0 - more).chain(row(whole + 1.0, more));
        rows.filter(|tooth| tooth.share > 0.0).collect()
    }

    /// The teeth while the blade turns by a part of a pitch, from one to another share of it; at zero a tooth enters the
    /// cut. A tooth that leaves it within this time counts for the share for which it cuts.
    pub fn passing(&self, [from, to]: [f64; 2]) -> Vec<Tooth> {
        let count = self.mean.ceil() as u32;
        let teeth = (0..count).map(f64::from).filter_map(|k| {
            // Distances from the begin of the arc, in pitches.
            let (enters, leaves) = (from + k, (to + k).min(self.mean));
            let middle = 0.5 * (enters + leaves) - 0.5 * self.mean;
            (enters < leaves).then(|| Tooth {
                angle_rad: self.angle_deg.to_radians() + middle * self.pitch_rad(),
                share: (leaves - enters) / (to - from),
            })
        });
        teeth.collect()
    }

    /// Arc of the cut, one pitch for each tooth in it.
    pub fn arc_rad(&self) -> f64 {
        self.mean * self.pitch_rad()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Angles of the teeth in the cut, relative to its middle, of a blade with 7 teeth that has turned by a share of a pitch
    /// since a tooth entered the cut.
    fn in_cut(teeth: &TeethInCut, turned: f64) -> Vec<f64> {
        let half = 0.5 * teeth.arc_rad();
        let all = (0..7).map(|k| (f64::from(k) + turned) * teeth.pitch_rad() - half);
        all.filter(|angle| *angle < half).collect()
    }

    const TIMES: u32 = 200_000;

    fn times([from, to]: [f64; 2]) -> impl Iterator<Item = f64> {
        let shares = (0..TIMES).map(|k| (f64::from(k) + 0.5) / f64::from(TIMES));
        shares.map(move |share| from + (to - from) * share)
    }

    fn teeth(mean: f64) -> TeethInCut {
        TeethInCut {
            angle_deg: 0.0,
            mean,
            all: 7,
        }
    }

    const MEANS: [f64; 6] = [0.03, 0.58, 1.0, 1.46, 2.45, 4.0];

    /// Each row of standing teeth is the mean, over the times at which as many teeth cut, of their places.
    #[test]
    fn standing_teeth_are_the_mean_of_those_that_enter_and_leave() {
        for mean in MEANS {
            let teeth = teeth(mean);
            let mut expected: Vec<Tooth> = Vec::new();
            for count in 1..=mean.ceil() as usize {
                let places: Vec<Vec<f64>> = times([0.0, 1.0])
                    .map(|turned| in_cut(&teeth, turned))
                    .filter(|all| all.len() == count)
                    .collect();
                expected.extend((0..count).filter(|_| !places.is_empty()).map(|k| Tooth {
                    angle_rad: places.iter().map(|all| all[k]).sum::<f64>() / places.len() as f64,
                    share: places.len() as f64 / f64::from(TIMES),
                }));
            }
            let found = teeth.standing();
            assert_eq!(found.len(), expected.len(), "{mean}");
            for (found, expected) in found.iter().zip(&expected) {
                assert!((found.share - expected.share).abs() < 1e-5, "{mean}");
                assert!(
                    (found.angle_rad - expected.angle_rad).abs() < 1e-4,
                    "{mean}"
                );
            }
            let total: f64 = found.iter().map(|tooth| tooth.share).sum();
            assert!((total - mean).abs() < 1e-12, "{mean}: {total}");
        }
    }

    /// Number and moment of the teeth in each step are the means over the times of the step.
    #[test]
    fn passing_teeth_act_for_the_time_in_which_they_cut() {
        const STEPS: u32 = 5;
        for mean in MEANS {
            let teeth = teeth(mean);
            for step in 0..STEPS {
                let part = [step, step + 1].map(|k| f64::from(k) / f64::from(STEPS));
                let mut sums = [0.0; 2];
                for place in times(part).flat_map(|turned| in_cut(&teeth, turned)) {
                    sums[0] += 1.0 / f64::from(TIMES);
                    sums[1] += place / f64::from(TIMES);
                }
                let found = teeth.passing(part);
                let count: f64 = found.iter().map(|tooth| tooth.share).sum();
                let moment: f64 = found
                    .iter()
                    .map(|tooth| tooth.share * tooth.angle_rad)
                    .sum();
                assert!((count - sums[0]).abs() < 2e-5, "{mean} {step}: {count}");
                assert!((moment - sums[1]).abs() < 2e-5, "{mean} {step}: {moment}");
            }
        }
    }
}
