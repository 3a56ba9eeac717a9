//! A validated study: the list of its saws.
//!
//! Saws are numbered over the grid, whose first parameter varies slowest, and within each point of the grid
//! over the points of a Sobol sequence with Owen's scrambling (Burley, Journal of Computer Graphics
//! Techniques 9 (2020), 1), see `sequence.rs`. A saw depends on its number alone, so that any machine can
//! compute any saw. Every point of the grid has the same deviations, so that differences between two points
//! are due to the grid.

use std::sync::OnceLock;

use super::distribution::Distribution;
use super::file::{StudyError, StudyFile};
use super::sequence::even;
use super::validation::{Counts, Varying, check_statistics, counts, gap, limits, varying};
use crate::analyses::check::{Limits, of_deviation};
use crate::analyses::gap::GapCase;
use crate::analyses::verdict::{Criterion, Judge};
use crate::model::plate::Resolution;
use crate::model::scene::{Parameter, Scene, SceneError, SpeedRange, rpm, speed_rad_per_s};
use crate::modes::SpectrumError;
use crate::stability::{AnalysisError, ChosenBasis, Evidence, end_of_sweep};

/// Names of the columns of guides with a gap; the last exists only if the study has an amplitude.
const GAP_COLUMNS: [&str; 3] = [
    "deflection_at_cut_m",
    "largest_pad_force_n",
    "critical_at_amplitude_rpm",
];

/// A scene, the numbers that vary, and the limits that each saw has to keep.
#[derive(Debug, Clone)]
pub struct Study {
    scene: Scene,
    file: StudyFile,
    limits: Option<Limits>,
    gap: Option<GapCase>,
    to_rad_per_s: f64,
    /// The numbers that vary, with their distributions, in the order of the file.
    pub(super) varying: Vec<Varying>,
    /// Number of saws in each point of the grid.
    drawn: usize,
    count: usize,
    /// Basis of the saw without deviations, computed when first needed.
    basis: OnceLock<Option<Resolution>>,
}

/// One of several equal parts of a study, for computation on different machines.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shard {
    /// Number of the part, from 1.
    pub number: usize,
    /// Number of parts.
    pub of: usize,
}

impl Shard {
    /// The whole study as a single part.
    pub const WHOLE: Shard = Shard { number: 1, of: 1 };

    /// Whether a saw belongs to this part: every `of`-th saw does, so that the parts take about the same
    /// time.
    pub fn holds(&self, index: usize) -> bool {
        index % self.of == self.number - 1
    }

    /// Number of saws in this part, of `saws` in all.
    pub fn count(&self, saws: usize) -> usize {
        (saws + self.of - self.number) / self.of
    }
}

impl Study {
    /// Validates a study of a scene.
    ///
    /// # Errors
    /// [`StudyError`] that names the key, what is allowed and what to do.
    pub fn new(scene: Scene, file: StudyFile) -> Result<Self, StudyError> {
        let varying = varying(scene.file(), &file)?;
        let Counts { drawn, count } = counts(&file, &varying)?;
        check_statistics(&file)?;
        let asked = file.limits.map(|l| limits(&l, &scene)).transpose()?;
        let gap = file.gap.map(|asked| gap(&asked, &scene)).transpose()?;
        let end = match file.to_rpm {
            Some(rpm) => speed_rad_per_s("to_rpm", rpm)?,
            None => end_of_sweep(&scene)?,
        };
        let reach = asked.map_or(0.0, |limits| limits.reach().end_rad_per_s);
        // A saw with an operating speed is judged there by the limits of its scene.
        let of_scene = || Some(Limits::of(&scene, scene.file().operating_rpm?));
        let limits = match asked {
            Some(limits) => Some(limits),
            None => of_scene().transpose()?,
        };
        Ok(Study {
            scene,
            file,
            limits,
            gap,
            to_rad_per_s: end.max(reach),
            varying,
            drawn,
            count,
            basis: OnceLock::new(),
        })
    }

    /// A saw alone, for the speeds of similar saws by [`Study::speeds`].
    ///
    /// # Errors
    /// [`StudyError`] if the end of its sweep cannot be found.
    pub fn of_one(scene: Scene) -> Result<Self, StudyError> {
        let to_rad_per_s = end_of_sweep(&scene)?;
        let file = StudyFile {
            bands: true,
            ..StudyFile::named(scene.file().name.clone())
        };
        Ok(Study {
            scene,
            file,
            limits: None,
            gap: None,
            to_rad_per_s,
            varying: Vec::new(),
            drawn: 1,
            count: 1,
            basis: OnceLock::new(),
        })
    }

    /// The scene without deviations.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// The study as typed.
    pub fn file(&self) -> &StudyFile {
        &self.file
    }

    /// The limits that each saw has to keep; `None` without an operating speed.
    pub fn limits(&self) -> Option<&Limits> {
        self.limits.as_ref()
    }

    /// Computations for guides with a gap.
    pub(super) fn gap(&self) -> Option<&GapCase> {
        self.gap.as_ref()
    }

    /// Names of the columns of guides with a gap, in the order of [`Found::gap`](super::Found::gap).
    pub(super) fn gap_columns(&self) -> &'static [&'static str] {
        match &self.gap {
            None => &[],
            Some(case) if case.amplitude_m().is_some() => &GAP_COLUMNS,
            Some(_) => &GAP_COLUMNS[..2],
        }
    }

    /// Last speed of the sweep, the same for every saw.
    pub fn to_rad_per_s(&self) -> f64 {
        self.to_rad_per_s
    }

    /// The basis of the saw without deviations, from which the choice of the basis of every saw starts. It
    /// does not depend on which saws are computed or in which order. `None` if that saw cannot be analysed.
    pub fn basis(&self) -> Option<Resolution> {
        if let Some(known) = self.basis.get() {
            return *known;
        }
        let swept = self
            .scene
            .swept(SpeedRange::new(0.0, self.to_rad_per_s))
            .ok()?;
        let found = match ChosenBasis::new(&swept, self.scene.tolerance()) {
            // A cancelled run must not store a result.
            Err(AnalysisError::Spectrum(SpectrumError::Cancelled)) => return None,
            chosen => chosen.ok().map(|chosen| chosen.saw.plate.resolution),
        };
        *self.basis.get_or_init(|| found)
    }

    /// Number of saws.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Number of saws in each point of the grid.
    pub fn drawn(&self) -> usize {
        self.drawn
    }

    /// Values of the varying numbers of a saw.
    pub fn values(&self, index: usize) -> Vec<f64> {
        let mut point = index / self.drawn;
        let mut values = vec![0.0; self.varying.len()];
        for (value, Varying { distribution, .. }) in values.iter_mut().zip(&self.varying).rev() {
            if let Distribution::Grid(grid) = distribution {
                *value = grid[point % grid.len()];
                point /= grid.len();
            }
        }
        let mut dimension = 0;
        for (value, Varying { distribution, .. }) in values.iter_mut().zip(&self.varying) {
            if !matches!(distribution, Distribution::Grid(_)) {
                let point = (index % self.drawn) as u64;
                *value = distribution.at(even(point, dimension, self.file.seed));
                dimension += 1;
            }
        }
        values
    }

    /// The scene of a saw, over the speeds of the study.
    pub(crate) fn scene_of(&self, values: &[f64]) -> Result<Scene, SceneError> {
        let parameters = self.varying.iter().map(|varying| &varying.parameter);
        let numbers: Vec<(&Parameter, f64)> = parameters.zip(values.iter().copied()).collect();
        let scene = self.scene.file().with(&numbers)?;
        scene.swept(SpeedRange::new(0.0, self.to_rad_per_s))
    }

    /// The criteria of the limits, evaluated for a saw without any critical speed or band.
    pub(super) fn criteria_of_nothing(&self) -> Vec<Criterion> {
        let nothing = Evidence {
            bands: Vec::new(),
            has_failed: false,
            critical_rad_per_s: &[],
            threshold_per_s: 0.0,
            range_rad_per_s: SpeedRange::new(0.0, self.to_rad_per_s),
            not_covered: Vec::new(),
            floquet: None,
        };
        let criteria = self.limits.map(|limits| {
            let judge = Judge {
                found: &nothing,
                limits: &limits.limits,
                rim_radius_m: self.scene.blade().outer_radius_m,
                is_held: true,
                accuracy: self.scene.accuracy(),
            };
            let operating = limits.operating_rad_per_s;
            let deviation = of_deviation(&limits.limits, rpm(operating), None);
            let criteria = judge.criteria(operating).into_iter();
            criteria.chain(deviation).collect()
        });
        criteria.unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::super::statistics::interval;
    use super::*;

    fn study(seed: u32, saws: u32) -> Study {
        let text = format!(
            r#"{{ "name": "even", "seed": {seed}, "saws": {saws}, "parameters": [
                {{ "path": "blade.material.density_kg_per_m3",
                   "distribution": {{ "kind": "uniform", "from": 7000, "to": 8000 }} }},
                {{ "path": "guides[0].angle_deg",
                   "distribution": {{ "kind": "uniform", "from": -60, "to": -50 }} }} ] }}"#
        );
        let file = StudyFile::from_json(&text).unwrap();
        Study::new(Scene::paper(), file).unwrap()
    }

    /// The points of the saws of a study in the unit square.
    fn points(study: &Study) -> Vec<[f64; 2]> {
        let even = |v: &[f64]| [(v[0] - 7000.0) / 1000.0, (v[1] + 60.0) / 10.0];
        let saws = 0..study.count();
        saws.map(|index| even(&study.values(index))).collect()
    }

    /// The interval of Clopper and Pearson assumes independent points. Sobol points are more even, so it
    /// contains the true value more often than required, and the estimate is better.
    #[test]
    fn intervals_contain_the_true_value_at_least_as_often_as_they_state() {
        const SEEDS: u32 = 300;
        const SAWS: usize = 200;
        for limit in [0.1_f64, 0.4, 0.9] {
            let exact = 0.5 * limit * limit;
            let (mut held, mut square) = (0, 0.0);
            for seed in 0..SEEDS {
                let inside = |p: &&[f64; 2]| p[0] + p[1] < limit;
                let passed = points(&study(seed, SAWS as u32))
                    .iter()
                    .filter(inside)
                    .count();
                let [low, high] = interval(passed, SAWS, 0.9);
                held += u32::from(low <= exact && exact <= high);
                square += (passed as f64 / SAWS as f64 - exact).powi(2) / f64::from(SEEDS);
            }
            assert!(f64::from(held) >= 0.9 * f64::from(SEEDS), "{limit}: {held}");
            let independent = exact * (1.0 - exact) / SAWS as f64;
            assert!(square < independent, "{limit}: {square} {independent}");
        }
    }

    #[test]
    fn seeds_draw_other_saws_and_parts_hold_each_saw_once() {
        assert_eq!(points(&study(3, 8)), points(&study(3, 8)));
        assert_ne!(points(&study(3, 8)), points(&study(4, 8)));
        // A longer study begins with the saws of a shorter one.
        assert_eq!(points(&study(3, 64))[..8], points(&study(3, 8)));
        for index in 0..100 {
            let parts = (1..=7).map(|number| Shard { number, of: 7 });
            assert_eq!(parts.filter(|part| part.holds(index)).count(), 1);
        }
        let part = Shard { number: 3, of: 7 };
        for saws in 0..30 {
            let held = (0..saws).filter(|index| part.holds(*index)).count();
            assert_eq!(part.count(saws), held);
        }
    }
}
