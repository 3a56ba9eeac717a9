//! Sensitivity of critical speeds, onsets and eigenvalues to the numbers of the scene.
//!
//! Differences of assembled matrices give their derivatives, see [`matrix_slopes`]; the derivatives of the
//! eigenvalues are then exact, with left and right vectors.

use std::f64::consts::TAU;

use faer::{Col, c64};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::analysis::Analysis;
use super::band::Instability;
use super::instability_kind::InstabilityKind;
use super::verdict::flutter_onsets;
use crate::model::plate::Plate;
use crate::model::scene::{Parameter, Quantity, Scene, SceneError, SceneFile};
use crate::model::system::GyroscopicSystem;
use crate::modes::{
    Differences, Mode, ModeKind, SpectralModel, SpectrumError, complex, derivative, matrix_slopes,
    smallest,
};

/// Step of the differences as a share of the change, thus 1e-3 of the number for a change of 1 %: the
/// truncation error (1e-3)⁴ and the rounding error 1e-16/1e-3 are both below 1e-11.
const STEP: f64 = 0.1;

/// Relative distance below the onset of a band at which the two coalescing modes are expected.
const BELOW: f64 = 1e-8;
/// Relative distance within which an onset is a critical speed.
const SAME_SPEED: f64 = 1e-10;
/// Relative distance within which a coalescence is the onset of a band: more than the shift of an edge by a search with more waves, 1e-5.
const SAME_ONSET: f64 = 3e-5;
/// Difference of a growth rate within which a band has it, as a share of its largest growth.
const SAME_GROWTH: f64 = 1e-6;

/// First-order effect of changing one number of the scene by 1 %, an angle by 1 degree, or a temperature rise
/// by 1 K.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "SensitivityEntry")]
pub struct Sensitivity {
    /// JSON path of the number in the scene.
    pub parameter: String,
    /// The change: "1 %" or "1 degree".
    pub change: String,
    /// Change of each critical speed up to the end of the sweep, in percent; double ones of a free blade are
    /// listed twice.
    pub critical_speeds_percent: Vec<f64>,
    /// Change of the onset of each reported band, in percent; null if the sweep begins inside the band.
    pub onsets_percent: Vec<Option<f64>>,
    /// Change of the flutter speed, in percent; null without one, or if the sweep begins above it.
    #[serde(default)]
    pub flutter_speed_percent: Option<f64>,
    /// dλ/dp of each mode at the operating speed (at the start of the sweep without one), times the change: real
    /// part, growth in 1/s.
    pub growth_per_s: Vec<f64>,
    /// Imaginary part of this change: frequency in Hz.
    pub frequency_hz: Vec<f64>,
}

impl Sensitivity {
    /// The change in the unit of the number, which has this value.
    pub(crate) fn step(&self, value: f64) -> f64 {
        By::of(&self.parameter).step(value)
    }

    /// Change of the first critical speed, in percent; `None` without a critical speed.
    pub(crate) fn of_first_critical(&self) -> Option<f64> {
        self.critical_speeds_percent.first().copied()
    }
}

/// Reason why no sensitivity could be computed.
#[derive(Debug, thiserror::Error)]
pub enum SensitivityError {
    /// A number is too close to the end of its allowed range to be changed.
    #[error(
        "a number of the scene cannot be moved by a tenth of a percent to differentiate by it: {0}"
    )]
    Edge(#[from] SceneError),
    /// An eigenproblem failed.
    #[error(transparent)]
    Spectrum(#[from] SpectrumError),
}

/// Change of a number for which effects are computed.
#[derive(Debug, Clone, Copy, PartialEq)]
enum By {
    /// One percent of the number.
    Percent,
    /// One unit, with its text.
    One(&'static str),
}

impl By {
    fn of(path: &str) -> Self {
        match Quantity::of(path).map_or("", |quantity| quantity.unit) {
            "°" => By::One("1 degree"),
            "K" => By::One("1 K"),
            _ => By::Percent,
        }
    }

    /// The change of a number with this value, in its unit.
    fn step(self, value: f64) -> f64 {
        match self {
            By::Percent => 0.01 * value,
            By::One(_) => 1.0,
        }
    }
}

/// A number of the scene and its change.
struct Variation {
    parameter: Parameter,
    value: f64,
    by: By,
}

impl Analysis {
    /// Effects of each number of the scene on the critical speeds, on the onsets of the bands, on the flutter
    /// speed, and on the eigenvalues at one speed. The number with the largest effect on the first critical speed is
    /// first.
    ///
    /// dλ = −yᴴ(dL)x / yᴴ(∂L/∂λ)x with right and left eigenvectors x, y of L(λ) = λ² + λD(Ω) + K(Ω). Critical
    /// speeds and the onsets of undamped bands change by dΩ = −yᴴ(dL)x / yᴴ(∂L/∂Ω)x, with λ = 0 for a
    /// critical speed, with λ = iω and y = x where two waves coalesce, and with a real λ where two real ones
    /// coalesce (P. Lancaster, *Lambda-Matrices and Vibrating Systems*, 1966). The speed at which Re λ of a damped
    /// mode has a certain value, zero or the flutter threshold, changes by −Re dλ / Re(∂λ/∂Ω).
    ///
    /// # Errors
    /// [`SensitivityError`].
    pub fn sensitivities(
        &self,
        modes_at_rad_per_s: f64,
    ) -> Result<Vec<Sensitivity>, SensitivityError> {
        let scene = &self.scene;
        let beside = self.model.for_speed_beside(modes_at_rad_per_s)?;
        let model = beside.as_ref().unwrap_or(&self.model);
        let modes = model.describe(modes_at_rad_per_s, model.modes(modes_at_rad_per_s)?);
        let mergings: Vec<Option<Merging>> = self
            .chart
            .instabilities
            .iter()
            .map(|band| Merging::new(self, band))
            .collect::<Result<_, _>>()?;
        let flutter = Merging::flutter(self)?;
        let mut all = Vec::new();
        for variation in Variation::of_scene(scene.file()) {
            let changes = variation.of_matrices(scene, &self.model.plate)?;
            let percent = |merging: &Merging| {
                let system = &self.model.components[merging.component].full;
                let change = &changes[merging.component];
                100.0 * (merging.change(system, change) / merging.speed)
            };
            let eigenvalues: Vec<c64> = modes
                .iter()
                .map(|m| {
                    let component = &model.components[m.mode.component];
                    let x = component.coordinates(&m.shape);
                    let change = &changes[m.mode.component];
                    derivative::with_change(
                        &component.full,
                        modes_at_rad_per_s,
                        m.mode.lambda,
                        &x,
                        change,
                    )
                })
                .collect();
            let critical = self.model.critical.iter();
            all.push(Sensitivity {
                critical_speeds_percent: critical
                    .take_while(|c| c.speed_rad_per_s <= self.range_rad_per_s.to_rad_per_s)
                    .map(|c| percent(&Merging::standing(c.component, c.speed_rad_per_s, &c.shape)))
                    .collect(),
                onsets_percent: mergings.iter().map(|m| m.as_ref().map(percent)).collect(),
                flutter_speed_percent: flutter.as_ref().map(percent),
                growth_per_s: eigenvalues.iter().map(|change| change.re).collect(),
                frequency_hz: eigenvalues.iter().map(|change| change.im / TAU).collect(),
                parameter: variation.parameter.path().to_owned(),
                change: match variation.by {
                    By::Percent => "1 %".to_owned(),
                    By::One(unit) => unit.to_owned(),
                },
            });
        }
        let influence =
            |s: &Sensitivity| s.critical_speeds_percent.first().map_or(0.0, |c| c.abs());
        all.sort_by(|x, y| influence(y).total_cmp(&influence(x)));
        Ok(all)
    }
}

impl Sensitivity {
    /// Sensitivities of an analysis, with eigenvalues at the operating speed, or at the start of the sweep if
    /// there is none; sorted by their influence on the first critical speed.
    ///
    /// # Errors
    /// [`SensitivityError`].
    pub fn all(analysis: &Analysis) -> Result<Vec<Self>, SensitivityError> {
        let start = analysis.range_rad_per_s.from_rad_per_s;
        analysis.sensitivities(analysis.scene.operating_rad_per_s().unwrap_or(start))
    }
}

impl Variation {
    /// Variations of blade, guides, temperature and roll tension, for the numbers that the scene contains.
    fn of_scene(scene: &SceneFile) -> Vec<Self> {
        let mut all = Vec::new();
        let mut add = |path: String| {
            let parameter = Parameter::new(&path);
            let by = By::of(&path);
            // A key that the scene omits has no number to vary, and a percent of zero is no change.
            let value = parameter.get(scene).ok();
            if let Some(value) = value.filter(|value| by.step(*value) != 0.0) {
                all.push(Variation {
                    parameter,
                    value,
                    by,
                });
            }
        };
        for name in [
            "thickness_m",
            "material.youngs_modulus_pa",
            "material.density_kg_per_m3",
        ] {
            add(format!("blade.{name}"));
        }
        for index in 0..scene.blade.profile.len() {
            add(format!("blade.profile[{index}].thickness_m"));
        }
        add("blade.rim.mass_per_tooth_kg".into());
        for index in 0..scene.guides.len() {
            for name in ["radius_m", "angle_deg", "stiffness_n_per_m"] {
                add(format!("guides[{index}].{name}"));
            }
        }
        let membrane = scene.membrane.as_ref();
        add("membrane.temperature.expansion_per_k".into());
        add("membrane.temperature.rim_rise_k".into());
        for index in 0..membrane.map_or(0, |m| m.roll_tension.len()) {
            for name in ["radius_m", "eigenstrain", "groove_depth_m"] {
                add(format!("membrane.roll_tension[{index}].{name}"));
            }
        }
        all
    }

    /// Change of the matrices of every component for the full change of the number.
    fn of_matrices(
        &self,
        scene: &Scene,
        plate: &Plate,
    ) -> Result<Vec<GyroscopicSystem>, SceneError> {
        matrix_slopes(STEP, Differences::Central, |share| {
            let number = self.value + share * self.by.step(self.value);
            let scene = scene.file().with(&[(&self.parameter, number)])?;
            Ok(Plate::new(&scene, plate.resolution))
        })
    }
}

/// Onset: a speed at which two modes coalesce or a wave stands still.
struct Merging {
    component: usize,
    speed: f64,
    lambda: c64,
    x: Col<c64>,
    /// Left vector; `None` if it equals the right one.
    y: Option<Col<c64>>,
    /// Whether the onset is the speed at which Re λ of a damped mode reaches a value.
    damped: bool,
}

impl Merging {
    fn standing(component: usize, speed: f64, shape: &Col<f64>) -> Self {
        Merging {
            component,
            speed,
            lambda: c64::new(0.0, 0.0),
            x: complex(shape),
            y: None,
            damped: false,
        }
    }

    /// Onset of a band; `None` if the range begins inside it.
    fn new(analysis: &Analysis, band: &Instability) -> Result<Option<Self>, SpectrumError> {
        let model = &analysis.model;
        if band.from_rad_per_s <= analysis.range_rad_per_s.from_rad_per_s {
            return Ok(None);
        }
        if !model.is_conservative() {
            return Self::damped(analysis, band, band.from_rad_per_s, 0.0);
        }
        let is_onset = |speed: f64| (speed / band.from_rad_per_s - 1.0).abs() < SAME_SPEED;
        if band.kind == InstabilityKind::Divergence {
            let mut critical = model.critical.iter();
            return match critical.find(|c| is_onset(c.speed_rad_per_s)) {
                Some(c) => Ok(Some(Self::standing(
                    c.component,
                    c.speed_rad_per_s,
                    &c.shape,
                ))),
                None => Self::coalescing(model, band),
            };
        }
        Self::coalescing(model, band)
    }

    /// The flutter speed: onset of an undamped band, or speed at which Re λ of a damped mode reaches the threshold; `None` without one, or
    /// if the range begins above it.
    fn flutter(analysis: &Analysis) -> Result<Option<Self>, SpectrumError> {
        let threshold = analysis.scene.flutter_threshold_per_s();
        let [Some(onset), _] = flutter_onsets(analysis.bands(), threshold) else {
            return Ok(None);
        };
        let band = &analysis.bands()[onset.band];
        if analysis.model.is_conservative() {
            Self::new(analysis, band)
        } else {
            Self::damped(analysis, band, onset.speed_rad_per_s, threshold)
        }
    }

    /// Coalescence of two waves, or of two real λ where flutter turns into divergence; `None` if there is none at the onset. Two waves that
    /// cross there without coalescing may be nearer to each other than those that do.
    fn coalescing(
        model: &SpectralModel,
        band: &Instability,
    ) -> Result<Option<Self>, SpectrumError> {
        let speed = band.from_rad_per_s;
        let modes = model.modes(speed * (1.0 - BELOW))?;
        let expected: Vec<(usize, c64)> = match band.kind {
            InstabilityKind::Flutter => closest_opposite(&modes)
                .map(|[plus, minus]| (plus.component, 0.5 * (plus.lambda + minus.lambda)))
                .collect(),
            InstabilityKind::Divergence => {
                let flutter = modes.iter().filter(|mode| mode.kind == ModeKind::Flutter);
                let mut slowest: Vec<&Mode> = flutter.collect();
                slowest.sort_by(|x, y| x.lambda.im.total_cmp(&y.lambda.im));
                let at = |mode: &Mode| (mode.component, mode.lambda.re.into());
                slowest.into_iter().map(at).collect()
            }
        };
        let at_onset = |(component, expected): (usize, c64)| {
            let found = model.double_eigenvalue(component, speed, expected)?;
            let off = (found.speed_rad_per_s / speed - 1.0).abs();
            (off <= SAME_ONSET).then_some((component, found))
        };
        let found = expected.into_iter().find_map(at_onset);
        Ok(found.map(|(component, found)| {
            let lifted = |lambda: c64, x: &Col<c64>| {
                model.components[component].lifted(found.speed_rad_per_s, lambda, x)
            };
            // L(λ)ᴴ = L(−λ̄).
            Merging {
                component,
                speed,
                lambda: found.lambda,
                x: lifted(found.lambda, &found.right),
                y: Some(lifted(-found.lambda.conj(), &found.left)),
                damped: false,
            }
        }))
    }

    /// Speed of a damped band at which Re λ reaches a value, in 1/s; `None` if the band begins there with another one, at the end of the
    /// previous band.
    fn damped(
        analysis: &Analysis,
        band: &Instability,
        speed: f64,
        growth_per_s: f64,
    ) -> Result<Option<Self>, SpectrumError> {
        let is_reached =
            |lambda: &c64| (lambda.re - growth_per_s).abs() <= SAME_GROWTH * band.peak_growth_per_s;
        let Some(expected) = band.lambda_at(speed).filter(is_reached) else {
            return Ok(None);
        };
        let modes = analysis.model.modes(speed)?;
        let nearest = smallest(&modes, |mode| (mode.lambda - expected).norm());
        Ok(nearest.map(|mode| Merging {
            component: mode.component,
            speed,
            lambda: mode.lambda,
            x: analysis.model.components[mode.component].lifted(
                speed,
                mode.lambda,
                &mode.coordinates,
            ),
            y: None,
            damped: true,
        }))
    }

    /// Change of the speed, in rad/s, for a change of the matrices.
    fn change(&self, system: &GyroscopicSystem, change: &GyroscopicSystem) -> f64 {
        if self.damped {
            let moved = derivative::with_change(system, self.speed, self.lambda, &self.x, change);
            let slope = derivative::with_speed(system, self.speed, self.lambda, &self.x);
            return -moved.re / slope.re;
        }
        let left = self.y.as_ref().unwrap_or(&self.x);
        derivative::of_coalescence(system, self.speed, self.lambda, [&self.x, left], change)
    }
}

/// The + and − modes, the pair whose frequencies are nearest to each other first.
fn closest_opposite(modes: &[Mode]) -> impl Iterator<Item = [&Mode; 2]> {
    let signed = |sign: i8| modes.iter().filter(move |m| m.krein_sign() == sign);
    let pairs = signed(1).flat_map(|plus| signed(-1).map(move |minus| [plus, minus]));
    let mut pairs: Vec<[&Mode; 2]> = pairs.collect();
    let apart = |[plus, minus]: &[&Mode; 2]| (plus.lambda - minus.lambda).norm();
    pairs.sort_by(|x, y| apart(x).total_cmp(&apart(y)));
    pairs.into_iter()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::scene::{Accuracy, SpeedRange};

    /// Newton's method leads from a speed beside each onset to the coalescence at the onset, which is not one at that speed.
    #[test]
    fn a_coalescence_at_another_speed_is_not_the_onset_of_a_band() {
        let draft = Scene::paper().edited(|saw| saw.accuracy = Accuracy::Draft);
        let range = SpeedRange::between_rpm(0.0, 3000.0);
        let analysis = Analysis::new(&draft.unwrap().swept(range).unwrap()).unwrap();
        let flutter = |band: &&Instability| band.kind == InstabilityKind::Flutter && band.closed;
        let bands: Vec<&Instability> = analysis.bands().iter().filter(flutter).collect();
        assert!(bands.len() > 2, "{}", bands.len());
        for band in bands {
            let at = |share: f64| {
                let moved = Instability {
                    from_rad_per_s: share * band.from_rad_per_s,
                    ..band.clone()
                };
                Merging::coalescing(&analysis.model, &moved).unwrap()
            };
            let found = at(1.0).expect("the onset").speed;
            assert!(
                (found / band.from_rad_per_s - 1.0).abs() < 1e-9,
                "{band}: {found}"
            );
            for share in [1.0 - 1e-4, 1.0 + 1e-4] {
                assert!(at(share).is_none(), "{band} {share}");
            }
        }
    }
}
