//! Equations of motion and their integration.

use std::f64::consts::TAU;

use differential_equations::prelude::{Error, ExplicitRungeKutta, IVP, ODE};
use nalgebra::{Vector2, Vector3};

use crate::model::scene::{Blade, SplineFile};

use super::contact::Contact;
use super::load::PlaneLoad;
use super::reaction::{Accumulator, MeanReaction};
use super::run::{OrbitPoint, Run, SplineError, SplineRun, Start};

/// Smallest number of samples per revolution, whose mean resolves harmonics beyond any basis.
const SAMPLES_PER_REVOLUTION: usize = 720;

/// The rigid blade on its arbor.
#[derive(Debug, Clone)]
pub struct InPlaneMotion {
    /// Flanks of the spline teeth.
    pub contact: Contact,
    /// Inertia (m, m, J/r_p²).
    inertia_kg: Vector3<f64>,
    /// Load (F_x, F_y, T/r_p).
    load_n: Vector3<f64>,
    speed_rad_per_s: f64,
    pitch_radius_m: f64,
    teeth: usize,
    scale: Scale,
}

/// Units in which the numbers of a loaded blade are of order one, as the tolerance assumes.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Scale {
    length_m: f64,
    rate_per_s: f64,
    energy_j: f64,
}

/// Displacement, velocity, energy lost in the contacts, and work of the arbor on the displaced blade, all
/// scaled.
type State = [f64; 8];

impl InPlaneMotion {
    /// Prepares the motion of a blade on a spline under a constant load.
    ///
    /// # Errors
    /// [`SplineError::Speed`] unless the speed is positive.
    pub fn new(
        blade: &Blade,
        spline: &SplineFile,
        load: PlaneLoad,
        speed_rad_per_s: f64,
    ) -> Result<Self, SplineError> {
        if !(speed_rad_per_s > 0.0 && speed_rad_per_s.is_finite()) {
            return Err(SplineError::Speed {
                rad_per_s: speed_rad_per_s,
            });
        }
        let r = spline.pitch_radius_on_m(blade);
        let mass = blade.mass_kg();
        let rotary = blade.polar_inertia_kg_m2() / (r * r);
        let contact = Contact::new(spline, blade);
        let load_n = Vector3::new(load.force_n[0], load.force_n[1], load.torque_n_m / r);
        let length_m = contact.length_m(load_n.norm());
        let lightest = mass.min(rotary);
        // The rate of the motion is √(F/(mL)), with the load F, the smaller inertia m and the length L, or
        // the rotation speed of the arbor if this is larger.
        let fall_per_s = (load_n.norm() / (lightest * length_m)).sqrt();
        let rate_per_s = fall_per_s.max(speed_rad_per_s);
        Ok(InPlaneMotion {
            contact,
            inertia_kg: Vector3::new(mass, mass, rotary),
            load_n,
            speed_rad_per_s,
            pitch_radius_m: r,
            teeth: spline.teeth as usize,
            scale: Scale {
                length_m,
                rate_per_s,
                energy_j: lightest * (length_m * rate_per_s).powi(2),
            },
        })
    }

    /// Integrates the motion and averages the forces.
    ///
    /// # Errors
    /// [`SplineError`] if a setting is out of range or the motion is too fast.
    pub fn run(&self, run: &Run) -> Result<SplineRun, SplineError> {
        check(run)?;
        let samples = self.teeth * SAMPLES_PER_REVOLUTION.div_ceil(self.teeth);
        let revolutions = run.settling_revolutions as usize + run.averaged_revolutions as usize;
        let interval = TAU / (self.speed_rad_per_s * samples as f64) * self.scale.rate_per_s;
        let end = interval * (revolutions * samples) as f64;
        let first = self.start(run.start);
        let Scale {
            length_m, energy_j, ..
        } = self.scale;
        let numbers = [end, interval, length_m, energy_j, energy_j.recip()];
        if !first.iter().chain(&numbers).all(|x| x.is_finite()) {
            return Err(SplineError::NotFinite);
        }
        let method = ExplicitRungeKutta::dop853()
            .rtol(run.tolerance)
            .atol(run.tolerance)
            .max_steps(run.max_steps);
        let solution = IVP::ode(self, 0.0, end, first)
            .even(interval)
            .method(method)
            .solve()
            .map_err(|error| self.failure(&error, run.max_steps, end))?;
        if !solution.y.iter().flatten().all(|x| x.is_finite()) {
            return Err(SplineError::NotFinite);
        }
        let settled_from = run.settling_revolutions as usize * samples;
        Ok(SplineRun {
            settled_from,
            reaction: self.average(&solution.y, settled_from, samples),
            energy_defect: self.energy_defect(&solution.t, &solution.y),
            dissipated_j: solution
                .y
                .last()
                .map_or(0.0, |y| y[6] * self.scale.energy_j),
            steps: solution.steps.total(),
            orbit: solution
                .t
                .iter()
                .zip(&solution.y)
                .map(|(t, y)| self.orbit_point(*t, y))
                .collect(),
        })
    }

    fn start(&self, start: Start) -> State {
        let seat = match start {
            Start::Seated => self.contact.seat(self.load_n),
            Start::Centred => None,
        };
        let q = seat.unwrap_or_else(Vector3::zeros) / self.scale.length_m;
        [q.x, q.y, q.z, 0.0, 0.0, 0.0, 0.0, 0.0]
    }

    fn failure(&self, error: &Error<f64, State>, limit: usize, end: f64) -> SplineError {
        match error {
            Error::MaxSteps { t, .. } | Error::StepSize { t, .. } | Error::Stiffness { t, .. } => {
                SplineError::Steps {
                    limit,
                    reached_s: t / self.scale.rate_per_s,
                    asked_s: end / self.scale.rate_per_s,
                }
            }
            _ => SplineError::NotFinite,
        }
    }

    fn orbit_point(&self, t: f64, y: &State) -> OrbitPoint {
        OrbitPoint {
            time_s: t / self.scale.rate_per_s,
            x_m: y[0] * self.scale.length_m,
            y_m: y[1] * self.scale.length_m,
            twist_rad: y[2] * self.scale.length_m / self.pitch_radius_m,
        }
    }

    fn unscaled(&self, t: f64, y: &State) -> Moment {
        let Scale {
            length_m,
            rate_per_s,
            ..
        } = self.scale;
        Moment {
            angle: self.speed_rad_per_s * t / rate_per_s,
            q: Vector3::new(y[0], y[1], y[2]) * length_m,
            velocity: Vector3::new(y[3], y[4], y[5]) * (length_m * rate_per_s),
        }
    }

    /// Displacement and velocity in the frame of the arbor.
    fn seen_from_arbor(&self, Moment { angle, q, velocity }: Moment) -> [Vector3<f64>; 2] {
        let relative = velocity - self.carried(q);
        [q, relative].map(|vector| turned(vector, -angle))
    }

    /// Velocity Ω × q of the point of the arbor under the centre.
    fn carried(&self, q: Vector3<f64>) -> Vector3<f64> {
        Vector3::new(-q.y, q.x, 0.0) * self.speed_rad_per_s
    }

    /// Averages the forces over the samples of whole revolutions, without the last sample, which repeats the first.
    fn average(&self, states: &[State], from: usize, samples: usize) -> MeanReaction {
        let settled = &states[from.min(states.len())..];
        let revolutions = settled.len() / samples;
        let mut sums = Accumulator::new(self.teeth, samples, revolutions);
        for (index, y) in settled.iter().take(revolutions * samples).enumerate() {
            // The angle follows from the index, because times contain rounding errors.
            let angle = TAU * (index % samples) as f64 / samples as f64;
            let moment = Moment {
                angle,
                ..self.unscaled(0.0, y)
            };
            let [seen, relative] = self.seen_from_arbor(moment);
            sums.add(index, self.contact.touches(seen, relative));
        }
        sums.mean(self.pitch_radius_m, self.load_n)
    }

    /// [Kinetic plus contact energy, potential of the load], in J.
    fn energies(&self, t: f64, y: &State) -> [f64; 2] {
        let moment = self.unscaled(t, y);
        let Moment { q, velocity, .. } = moment;
        let kinetic = 0.5 * velocity.component_mul(&velocity).dot(&self.inertia_kg);
        let [seen, _] = self.seen_from_arbor(moment);
        [kinetic + self.contact.energy_j(seen), -self.load_n.dot(&q)]
    }

    fn energy_defect(&self, times: &[f64], states: &[State]) -> f64 {
        let mut first = None;
        let (mut defect, mut largest) = (0.0_f64, f64::MIN_POSITIVE);
        for (t, y) in times.iter().zip(states) {
            let [stored, potential] = self.energies(*t, y);
            let supplied = (y[7] - y[6]) * self.scale.energy_j;
            let constant = stored + potential - supplied;
            defect = defect.max((constant - *first.get_or_insert(constant)).abs());
            largest = largest.max(stored);
        }
        defect / largest
    }
}

/// State of the motion in SI units.
#[derive(Clone, Copy)]
struct Moment {
    /// Angle of the arbor.
    angle: f64,
    /// Displacement of the blade.
    q: Vector3<f64>,
    velocity: Vector3<f64>,
}

fn check(run: &Run) -> Result<(), SplineError> {
    let refuse = |what, value: f64, allowed| {
        Err(SplineError::Run {
            what,
            value,
            allowed,
        })
    };
    let revolutions = f64::from(run.averaged_revolutions);
    if run.averaged_revolutions < 2 || run.averaged_revolutions > MAX_REVOLUTIONS {
        return refuse("averaged_revolutions", revolutions, "from 2 to 1000");
    }
    if run.settling_revolutions > MAX_REVOLUTIONS {
        let revolutions = f64::from(run.settling_revolutions);
        return refuse("settling_revolutions", revolutions, "at most 1000");
    }
    if !(1e-13..=1e-3).contains(&run.tolerance) {
        return refuse("tolerance", run.tolerance, "from 1e-13 to 1e-3");
    }
    Ok(())
}

/// Largest number of settling and of averaged revolutions. All samples are kept: 2000 revolutions take 150 megabytes.
const MAX_REVOLUTIONS: u32 = 1000;

/// Rotates a displacement or a force about the axis; the third component does not change.
fn turned(v: Vector3<f64>, angle: f64) -> Vector3<f64> {
    let (sin, cos) = angle.sin_cos();
    let plane = Vector2::new(v.x * cos - v.y * sin, v.x * sin + v.y * cos);
    Vector3::new(plane.x, plane.y, v.z)
}

impl ODE<f64, State> for InPlaneMotion {
    fn diff(&self, t: f64, y: &State, slope: &mut State) {
        let moment = self.unscaled(t, y);
        let Moment { angle, q, .. } = moment;
        let [seen, relative] = self.seen_from_arbor(moment);
        let mut in_frame = Vector3::zeros();
        let mut lost_w = 0.0;
        for touch in self.contact.touches(seen, relative) {
            in_frame += touch.normal * touch.force_n;
            lost_w += (touch.elastic_n - touch.force_n) * touch.normal.dot(&relative);
        }
        let force = turned(in_frame, angle);
        let Scale {
            length_m,
            rate_per_s,
            energy_j,
        } = self.scale;
        let acceleration =
            (self.load_n + force).component_div(&self.inertia_kg) / (length_m * rate_per_s.powi(2));
        slope[..3].copy_from_slice(&y[3..6]);
        slope[3..6].copy_from_slice(acceleration.as_slice());
        slope[6] = lost_w / (energy_j * rate_per_s);
        slope[7] = force.dot(&self.carried(q)) / (energy_j * rate_per_s);
    }
}
