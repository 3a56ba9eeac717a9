//! How critical speeds, onsets and eigenvalues move with the numbers of the scene.
//!
//! The matrices are smooth in every number, so they are differentiated by a
//! fourth-order central difference of the assembly; the eigenvalues are then
//! differentiated exactly, with left and right vectors.

use faer::{Col, c64};

use super::analysis::Analysis;
use super::band::{Instability, InstabilityKind};
use crate::plate::Plate;
use crate::scene::{MembraneFile, Scene, SceneError, SceneFile};
use crate::spectrum::{Component, Mode, SpectrumError, derivative};
use crate::system::GyroscopicSystem;

/// Relative step of the difference: truncation (1e-3)⁴ and rounding 1e-16/1e-3 are
/// both below 1e-11.
const STEP: f64 = 1e-3;

/// Effect of one change of the scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Sensitivity {
    /// JSON path of the number.
    pub parameter: String,
    /// The change in words: "1 %".
    pub change: &'static str,
    /// Relative change of each critical speed within the range.
    pub critical_speeds: Vec<f64>,
    /// Relative change of the onset of each band; `None` where the range begins in it.
    pub onsets: Vec<Option<f64>>,
    /// Change of λ of each mode at `modes_at`, in 1/s.
    pub eigenvalues: Vec<c64>,
}

/// Why no sensitivity could be computed.
#[derive(Debug, thiserror::Error)]
pub enum SensitivityError {
    /// A number stands so close to the edge of what is allowed that it cannot be moved.
    #[error("a number of the scene cannot be moved by {STEP} to differentiate by it: {0}")]
    Edge(#[from] SceneError),
    /// An eigenproblem failed.
    #[error(transparent)]
    Spectrum(#[from] SpectrumError),
}

/// Moves a number of the scene by a multiple of the change asked about.
type Shift = Box<dyn Fn(&mut SceneFile, f64)>;

/// A number of the scene and the change that is asked about.
struct Parameter {
    path: String,
    words: &'static str,
    shift: Shift,
}

/// Sensitivities of an analysis, most influential on the lowest critical speed first.
///
/// # Errors
/// [`SensitivityError`].
pub fn sensitivities(
    analysis: &Analysis,
    modes_at_rad_per_s: f64,
) -> Result<Vec<Sensitivity>, SensitivityError> {
    let scene = &analysis.scene;
    let modes = analysis.model.modes(modes_at_rad_per_s)?;
    let modes = analysis.model.describe(modes_at_rad_per_s, modes);
    let mergings: Vec<Option<Merging>> = analysis
        .chart
        .instabilities
        .iter()
        .map(|band| Merging::new(analysis, band))
        .collect::<Result<_, _>>()?;
    let mut all = Vec::new();
    for parameter in parameters(scene) {
        let changes = changed_components(scene, &analysis.model.plate, &parameter)?;
        let relative = |merging: &Merging| {
            let system = &analysis.model.components[merging.component].full;
            let change = &changes[merging.component];
            merging.change(system, change) / merging.speed
        };
        let critical = analysis.model.critical.iter();
        all.push(Sensitivity {
            critical_speeds: critical
                .take_while(|c| c.speed_rad_per_s <= analysis.range_rad_per_s.1)
                .map(|c| relative(&Merging::standing(c.component, c.speed_rad_per_s, &c.shape)))
                .collect(),
            onsets: mergings.iter().map(|m| m.as_ref().map(relative)).collect(),
            eigenvalues: modes
                .iter()
                .map(|m| {
                    let component = &analysis.model.components[m.mode.component];
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
                .collect(),
            parameter: parameter.path,
            change: parameter.words,
        });
    }
    let influence = |s: &Sensitivity| s.critical_speeds.first().map_or(0.0, |c| c.abs());
    all.sort_by(|x, y| influence(y).total_cmp(&influence(x)));
    Ok(all)
}

fn parameters(scene: &Scene) -> Vec<Parameter> {
    let percent = |path: String, number: fn(&mut SceneFile) -> &mut f64| Parameter {
        path,
        words: "1 %",
        shift: Box::new(move |file, share| *number(file) *= 1.0 + 0.01 * share),
    };
    let mut parameters = vec![
        percent("blade.thickness_m".into(), |f| &mut f.blade.thickness_m),
        percent("blade.material.youngs_modulus_pa".into(), |f| {
            &mut f.blade.material.youngs_modulus_pa
        }),
        percent("blade.material.density_kg_per_m3".into(), |f| {
            &mut f.blade.material.density_kg_per_m3
        }),
    ];
    for index in 0..scene.file().guides.len() {
        let mut add = |name: &str, words, shift: Shift| {
            parameters.push(Parameter {
                path: format!("guides[{index}].{name}"),
                words,
                shift,
            });
        };
        let percent = |share: f64| 1.0 + 0.01 * share;
        add(
            "radius_m",
            "1 %",
            Box::new(move |f, share| f.guides[index].radius_m *= percent(share)),
        );
        add(
            "angle_deg",
            "1 degree",
            Box::new(move |f, share| f.guides[index].angle_deg += share),
        );
        let stiffness =
            move |f: &mut SceneFile, share| f.guides[index].stiffness_n_per_m *= percent(share);
        add("stiffness_n_per_m", "1 %", Box::new(stiffness));
    }
    parameters.extend(of_membrane(scene.file()));
    parameters
}

/// The numbers of heat and roll tension.
fn of_membrane(file: &SceneFile) -> Vec<Parameter> {
    let mut parameters = Vec::new();
    let mut add = |path: String, words, number: Box<Number>, change: fn(&mut f64, f64)| {
        parameters.push(Parameter {
            path: format!("membrane.{path}"),
            words,
            shift: Box::new(move |file, share| {
                let found = file.membrane.as_mut().and_then(&number);
                found.into_iter().for_each(|n| change(n, share));
            }),
        });
    };
    let percent = |number: &mut f64, share: f64| *number *= 1.0 + 0.01 * share;
    let membrane = file.membrane.as_ref();
    if let Some(temperature) = membrane.and_then(|m| m.temperature.as_ref()) {
        let expansion: Box<Number> =
            Box::new(|m| Some(&mut m.temperature.as_mut()?.expansion_per_k));
        add(
            "temperature.expansion_per_k".into(),
            "1 %",
            expansion,
            percent,
        );
        if temperature.rim_rise_k.is_some() {
            let rise: Box<Number> = Box::new(|m| m.temperature.as_mut()?.rim_rise_k.as_mut());
            let kelvin = |number: &mut f64, share: f64| *number += share;
            add("temperature.rim_rise_k".into(), "1 K", rise, kelvin);
        }
    }
    for index in 0..membrane.map_or(0, |m| m.roll_tension.len()) {
        let path = |name: &str| format!("roll_tension[{index}].{name}");
        let radius: Box<Number> = Box::new(move |m| Some(&mut m.roll_tension[index].radius_m));
        add(path("radius_m"), "1 %", radius, percent);
        let strain: Box<Number> = Box::new(move |m| Some(&mut m.roll_tension[index].eigenstrain));
        add(path("eigenstrain"), "1 %", strain, percent);
    }
    parameters
}

/// Finds a number of the membrane stress.
type Number = dyn Fn(&mut MembraneFile) -> Option<&mut f64>;

/// Change of the matrices of every component for the whole change of a parameter.
fn changed_components(
    scene: &Scene,
    plate: &Plate,
    parameter: &Parameter,
) -> Result<Vec<GyroscopicSystem>, SceneError> {
    // f' ≈ (f(−2h) − 8f(−h) + 8f(h) − f(2h)) / 12h, in shares of the change.
    let share = 100.0 * STEP;
    let stencil = [(-2.0, 1.0), (-1.0, -8.0), (1.0, 8.0), (2.0, -1.0)];
    let mut moved: Vec<Vec<(f64, GyroscopicSystem)>> = Vec::new();
    for (place, weight) in stencil {
        let scene = scene.edited(|file| (parameter.shift)(file, place * share))?;
        let components = Component::of(&Plate::new(&scene, plate.resolution));
        moved.resize_with(components.len(), Vec::new);
        for (terms, component) in moved.iter_mut().zip(components) {
            terms.push((weight / (12.0 * share), component.full));
        }
    }
    Ok(moved
        .iter()
        .filter_map(|terms| GyroscopicSystem::combination(terms))
        .collect())
}

/// A speed at which something begins: two modes merge, or a wave stands still.
struct Merging {
    component: usize,
    speed: f64,
    lambda: c64,
    x: Col<c64>,
    /// Re λ = 0 of a damped mode moves with the real part alone.
    damped: bool,
}

impl Merging {
    fn standing(component: usize, speed: f64, shape: &Col<f64>) -> Self {
        let x = Col::from_fn(shape.nrows(), |i| c64::new(shape[i], 0.0));
        Merging {
            component,
            speed,
            lambda: c64::new(0.0, 0.0),
            x,
            damped: false,
        }
    }

    /// The onset of a band; `None` where the range begins inside it.
    fn new(analysis: &Analysis, band: &Instability) -> Result<Option<Self>, SpectrumError> {
        let model = &analysis.model;
        if band.from_rad_per_s <= analysis.range_rad_per_s.0 {
            return Ok(None);
        }
        if !model.is_conservative() {
            return Self::damped(analysis, band);
        }
        if band.kind == InstabilityKind::Divergence {
            let distance = |speed: f64| (speed - band.from_rad_per_s).abs();
            let nearest = model
                .critical
                .iter()
                .min_by(|x, y| distance(x.speed_rad_per_s).total_cmp(&distance(y.speed_rad_per_s)));
            return Ok(nearest.map(|c| Self::standing(c.component, c.speed_rad_per_s, &c.shape)));
        }
        // Just below the onset the two vectors are x ± εu: their mean is x up to ε².
        let before = band.from_rad_per_s * (1.0 - 1e-8);
        let modes = model.modes(before)?;
        let pair = closest_opposite(&modes);
        let Some((first, second)) = pair else {
            return Ok(None);
        };
        let component = &model.components[first.component];
        let lift = |mode: &Mode| component.lifted(before, &mode.coordinates);
        let (x, y) = (lift(first), lift(second));
        let overlap: c64 = y.adjoint() * &x;
        let turn = overlap / overlap.norm().max(f64::MIN_POSITIVE);
        let mean = faer::Scale(c64::new(0.5, 0.0)) * (x + faer::Scale(turn) * y);
        Ok(Some(Merging {
            component: first.component,
            speed: band.from_rad_per_s,
            lambda: (first.lambda + second.lambda) * 0.5,
            x: mean,
            damped: false,
        }))
    }

    /// Re λ = 0 where the band begins; `None` where it begins otherwise, with the end of the
    /// one before.
    fn damped(analysis: &Analysis, band: &Instability) -> Result<Option<Self>, SpectrumError> {
        const ONSET: f64 = 1e-6;
        let Some(onset) = band.curve.first().map(|point| point.lambda) else {
            return Ok(None);
        };
        if onset.re.abs() > ONSET * band.peak_growth_per_s {
            return Ok(None);
        }
        let modes = analysis.model.modes(band.from_rad_per_s)?;
        let distance = |m: &&Mode| (m.lambda - onset).norm();
        let nearest = modes
            .iter()
            .min_by(|x, y| distance(x).total_cmp(&distance(y)));
        Ok(nearest.map(|mode| Merging {
            component: mode.component,
            speed: band.from_rad_per_s,
            lambda: mode.lambda,
            x: analysis.model.components[mode.component]
                .lifted(band.from_rad_per_s, &mode.coordinates),
            damped: true,
        }))
    }

    /// dΩ for a change of the matrices.
    fn change(&self, system: &GyroscopicSystem, change: &GyroscopicSystem) -> f64 {
        if self.damped {
            let moved = derivative::with_change(system, self.speed, self.lambda, &self.x, change);
            let slope = derivative::with_speed(system, self.speed, self.lambda, &self.x);
            return -moved.re / slope.re;
        }
        derivative::of_merging(system, self.speed, self.lambda, &self.x, change)
    }
}

/// The + and the − mode whose frequencies are closest.
fn closest_opposite(modes: &[Mode]) -> Option<(&Mode, &Mode)> {
    let signed = |sign: i8| modes.iter().filter(move |m| m.krein_sign() == sign);
    let gap = |pair: &(&Mode, &Mode)| (pair.0.lambda - pair.1.lambda).norm();
    signed(1)
        .flat_map(|plus| signed(-1).map(move |minus| (plus, minus)))
        .min_by(|x, y| gap(x).total_cmp(&gap(y)))
}
