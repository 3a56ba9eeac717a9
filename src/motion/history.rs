//! Three saws between pads with a gap, and their time histories by the Runge-Kutta method, with a contact law of their own: independent
//! values for stationary deflections and oscillations.

use faer::{Col, Mat};

use crate::model::linalg::symmetric_eigenvalues;
use crate::model::plate::{Plate, ReducedStretching, Resolution, Stretching};
use crate::model::scene::{
    ContactLaw, DampingFile, GuideFile, GuideSide, InPlane, Mount, Scene, SideForceFile, SweepFile,
};
use crate::model::system::GyroscopicSystem;

/// A basis whose highest frequency is low.
pub const SMALL: Resolution = Resolution {
    max_diameters: 3,
    radial_functions: 2,
};
/// Number of points of a pad in either direction.
const POINTS: usize = 14;
/// Length of a step over the shortest time of a radian; up to 2.8 the method is stable.
const STEP: f64 = 1.8;

/// One pad, two pads with unlike gaps, and a collar with a pad, under a side force with an oscillating part of its frequency of rotation.
pub fn saws(gap_m: f64, force_n: f64, oscillating_n: f64) -> [(&'static str, Scene); 3] {
    let pad = |angle_deg: f64, gap_m: f64| GuideFile {
        radius_m: 0.25,
        radial_length_m: 0.1,
        tangential_length_m: 0.08,
        angle_deg,
        stiffness_n_per_m: 1e6,
        contact: ContactLaw::OneSided,
        gap_m: Some(gap_m),
        ..Scene::paper().file().guides[0].clone()
    };
    let of = |guides: Vec<GuideFile>, is_clamped: bool, factor: f64| {
        let scene = Scene::paper().edited(|file| {
            (file.cut, file.runup, file.measured) = (None, None, None);
            file.guides = guides;
            file.sweep = Some(SweepFile {
                from_rpm: 0.0,
                to_rpm: 1400.0,
            });
            file.damping = Some(DampingFile {
                air_n_s_per_m3: 400.0,
                ..DampingFile::default()
            });
            file.side_force = Some(SideForceFile {
                oscillating_n: factor * oscillating_n,
                ..SideForceFile::of(factor * force_n)
            });
            if is_clamped {
                (file.spline, file.mount) = (
                    None,
                    Mount::Collar {
                        diameter_m: 0.25,
                        in_plane: InPlane::Free,
                        clamp_stiffness_n_m_per_rad_per_m: None,
                    },
                );
            }
        });
        scene.unwrap()
    };
    [
        ("one pad", of(vec![pad(-50.0, gap_m)], false, 1.0)),
        (
            "two gaps",
            of(vec![pad(-50.0, gap_m), pad(60.0, 2.0 * gap_m)], false, 1.0),
        ),
        ("collar", of(vec![pad(20.0, gap_m)], true, 8.0)),
    ]
}

/// The saw with its pads changed.
pub fn with_pads(scene: &Scene, change: impl Fn(&mut GuideFile)) -> Scene {
    let changed = scene.edited(|file| file.guides.iter_mut().for_each(&change));
    changed.unwrap()
}

/// A blade whose motion is integrated.
pub struct History {
    order: usize,
    stiffness: Mat<f64>,
    velocity: Mat<f64>,
    points: Vec<Point>,
    steady: Vec<f64>,
    alternating: Vec<f64>,
    frequency_rad_per_s: f64,
    stretching: Option<ReducedStretching>,
    /// A step that resolves the highest frequency.
    pub step_s: f64,
}

/// A point of a pad.
struct Point {
    shape: Vec<f64>,
    stiffness_n_per_m: f64,
    gap_m: f64,
    offset_m: f64,
    side: GuideSide,
}

/// Displacement and velocity.
#[derive(Clone)]
pub struct Moving {
    pub q: Vec<f64>,
    pub v: Vec<f64>,
}

impl History {
    /// The blade at a speed. With `damping_per_s` all its motions have this viscous damping in place of their own terms of velocity, which
    /// do not change a deflection at rest.
    pub fn new(
        scene: &Scene,
        speed_rad_per_s: f64,
        damping_per_s: Option<f64>,
        stretches: bool,
    ) -> Self {
        let bare = scene.edited(|file| file.guides.clear()).unwrap();
        let plate = Plate::new(&bare, SMALL);
        let system = GyroscopicSystem::of_plate(&plate);
        let order = system.order();
        let force = scene.side_force();
        let at = crate::motion::transient::at_point(&plate, force.at.polar());
        let oscillating_n = scene
            .oscillating_force()
            .map_or(0.0, |force| force.amplitude_n);
        let points: Vec<Point> = scene
            .file()
            .guides
            .iter()
            .flat_map(|pad| points(&plate, pad))
            .collect();
        let stiffness = system.stiffness_at(speed_rad_per_s);
        let velocity = match damping_per_s {
            Some(damping) => Mat::from_fn(order, order, |i, j| if i == j { damping } else { 0.0 }),
            None => system.velocity_at(speed_rad_per_s),
        };
        let touching = Mat::from_fn(order, order, |i, j| {
            let products = points
                .iter()
                .map(|point| point.stiffness_n_per_m * point.shape[i] * point.shape[j]);
            stiffness[(i, j)] + products.sum::<f64>()
        });
        let squares = symmetric_eigenvalues(touching.as_ref()).unwrap();
        let highest = squares.last().unwrap().sqrt();
        let stretching = stretches.then(|| {
            let all = Mat::<f64>::identity(order, order);
            ReducedStretching::new(&Stretching::new(&plate).unwrap(), all.as_ref()).unwrap()
        });
        History {
            order,
            stiffness,
            velocity,
            points,
            steady: at.iter().map(|x| force.force_n * x).collect(),
            alternating: at.iter().map(|x| oscillating_n * x).collect(),
            frequency_rad_per_s: speed_rad_per_s,
            stretching,
            step_s: STEP / highest,
        }
    }

    pub fn still(&self) -> Moving {
        let zero = vec![0.0; self.order];
        Moving {
            q: zero.clone(),
            v: zero,
        }
    }

    fn acceleration(&self, t: f64, q: &[f64], v: &[f64], rate: &mut [f64]) {
        let cos = (self.frequency_rad_per_s * t).cos();
        for (i, rate) in rate.iter_mut().enumerate() {
            *rate = self.steady[i] + cos * self.alternating[i];
        }
        for j in 0..self.order {
            let (elastic, viscous) = (
                self.stiffness.col_as_slice(j),
                self.velocity.col_as_slice(j),
            );
            for i in 0..self.order {
                rate[i] -= elastic[i] * q[j] + viscous[i] * v[j];
            }
        }
        for point in &self.points {
            let w: f64 = point.shape.iter().zip(q).map(|(x, q)| x * q).sum();
            let w = w - point.offset_m;
            let left = (w - point.gap_m).max(0.0);
            let right = (-w - point.gap_m).max(0.0);
            let pressed = match point.side {
                GuideSide::Both => left - right,
                GuideSide::Left => left,
                GuideSide::Right => -right,
            };
            if pressed != 0.0 {
                for (rate, x) in rate.iter_mut().zip(&point.shape) {
                    *rate -= point.stiffness_n_per_m * pressed * x;
                }
            }
        }
        if let Some(stretching) = &self.stretching {
            let force = stretching.gradient(&Col::from_fn(self.order, |i| q[i]));
            for (rate, force) in rate.iter_mut().zip(force.unwrap().iter()) {
                *rate -= force;
            }
        }
    }

    /// Moves over a time in a number of steps.
    pub fn run(
        &self,
        state: &mut Moving,
        (from_s, step_s, steps): (f64, f64, usize),
        mut seen: impl FnMut(f64, &[f64]),
    ) {
        let n = self.order;
        let mut rates = vec![vec![0.0; n]; 4];
        let (mut q, mut v) = (vec![0.0; n], vec![0.0; n]);
        let mut speeds = vec![vec![0.0; n]; 4];
        for step in 0..steps {
            let t = from_s + step as f64 * step_s;
            seen(t, &state.q);
            for part in 0..4 {
                let share = [0.0, 0.5, 0.5, 1.0][part] * step_s;
                for i in 0..n {
                    let (dq, dv) = match part {
                        0 => (0.0, 0.0),
                        _ => (speeds[part - 1][i], rates[part - 1][i]),
                    };
                    q[i] = state.q[i] + share * dq;
                    v[i] = state.v[i] + share * dv;
                }
                speeds[part].copy_from_slice(&v);
                self.acceleration(t + share, &q, &v, &mut rates[part]);
            }
            for i in 0..n {
                let sum = |of: &[Vec<f64>]| of[0][i] + 2.0 * (of[1][i] + of[2][i]) + of[3][i];
                state.q[i] += step_s / 6.0 * sum(&speeds);
                state.v[i] += step_s / 6.0 * sum(&rates);
            }
        }
    }

    /// The deflection at which the blade comes to rest, from the flat shape; `None` if it does not within a time.
    pub fn settled(&self, most_s: f64) -> Option<Vec<f64>> {
        let mut state = self.still();
        let steps = (0.1 / self.step_s).ceil() as usize;
        for _ in 0..(most_s / 0.1) as usize {
            self.run(&mut state, (0.0, self.step_s, steps), |_, _| ());
            if norm(&state.v) < 1e-4 * norm(&state.q) {
                return Some(state.q);
            }
        }
        None
    }
}

/// Length of a vector.
pub fn norm(vector: &[f64]) -> f64 {
    vector.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// Values of the functions of the basis at the rim at the cut.
pub fn at_cut(scene: &Scene) -> Vec<f64> {
    let plate = Plate::new(scene, SMALL);
    plate.functions_at(plate.blade.outer_radius_m, scene.cut_angle_rad())
}

/// Product of two vectors.
pub fn product(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Points of a pad within the blade: midpoints of equal rectangles, moved apart so that the mean of x² is exact, with which the pad resists
/// tilt.
fn points(plate: &Plate, pad: &GuideFile) -> Vec<Point> {
    let count = POINTS as f64;
    let apart = count / (count * count - 1.0).sqrt();
    let place = |k: usize, length: f64| ((k as f64 + 0.5) / count - 0.5) * apart * length;
    let mut points = Vec::new();
    for i in 0..POINTS {
        for j in 0..POINTS {
            let x = pad.radius_m + place(i, pad.radial_length_m);
            let y = place(j, pad.tangential_length_m);
            let (radius_m, angle_rad) = (x.hypot(y), pad.angle_deg.to_radians() + y.atan2(x));
            points.push(Point {
                shape: plate.functions_at(radius_m, angle_rad),
                stiffness_n_per_m: pad.stiffness_n_per_m / (POINTS * POINTS) as f64,
                gap_m: pad.gap_m.unwrap_or_default(),
                offset_m: pad.offset_m,
                side: pad.side,
            });
        }
    }
    points
}
