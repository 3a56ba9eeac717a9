//! Blades of varying thickness and with mass at the rim, against finite elements over the radius.
//!
//! The elements here share nothing with the library: Hermite cubics for the deflection and
//! quadratics for the displacement in the plane, ring by ring, for each number of nodal diameters,
//! with consistent mass. They converge with the fourth power of the element's width; eighty of them
//! leave about 1e-7.

use nalgebra::{DMatrix, DVector, SMatrix, SVector};
use sawflutter::plate::{Plate, Resolution, RimForce};
use sawflutter::scene::{
    InPlane, MembraneFile, Mount, RimFile, Scene, SceneFile, TemperatureFile, ThicknessRow,
};
use sawflutter::system::body_frame_stiffness;

use crate::common::{Worst, relative_error};

const ELEMENTS: usize = 80;
/// Gauss points and weights on [−1, 1], four of them.
const GAUSS: [(f64, f64); 4] = [
    (-0.861_136_311_594_052_6, 0.347_854_845_137_453_85),
    (-0.339_981_043_584_856_26, 0.652_145_154_862_546_2),
    (0.339_981_043_584_856_26, 0.652_145_154_862_546_2),
    (0.861_136_311_594_052_6, 0.347_854_845_137_453_85),
];

/// A ring as the finite elements see it.
struct Ring {
    /// Nodes, at every radius where the thickness is not smooth too.
    nodes: Vec<f64>,
    thickness: fn(f64) -> f64,
    /// Mass on a circle, all around, at the rim.
    rim_kg: f64,
    clamped: bool,
    held: bool,
    e: f64,
    nu: f64,
    rho: f64,
    /// Eigenstrain over the radius.
    free_strain: fn(f64) -> f64,
}

/// What the elements are integrated over: radius, weight and the place in the element.
fn points(from: f64, to: f64) -> impl Iterator<Item = (f64, f64, f64)> {
    let half = 0.5 * (to - from);
    GAUSS
        .into_iter()
        .map(move |(x, w)| (from + half * (1.0 + x), half * w, x))
}

impl Ring {
    /// σ_rr and σ_θθ at the points of every element: of rotation at one rad/s, or of the
    /// eigenstrain.
    fn stress(&self, of_rotation: bool) -> Vec<[[f64; 2]; 4]> {
        let count = 2 * (self.nodes.len() - 1) + 1;
        let plane = self.e / (1.0 - self.nu * self.nu);
        let mut stiffness = DMatrix::zeros(count, count);
        let mut load = DVector::zeros(count);
        let quadratic = |x: f64| {
            let n = [0.5 * x * (x - 1.0), 1.0 - x * x, 0.5 * x * (x + 1.0)];
            (n, [x - 0.5, -2.0 * x, x + 0.5])
        };
        for (k, pair) in self.nodes.windows(2).enumerate() {
            for (r, w, x) in points(pair[0], pair[1]) {
                let (n, dn) = quadratic(x);
                let half = 0.5 * (pair[1] - pair[0]);
                let h = (self.thickness)(r);
                for i in 0..3 {
                    let (ri, ti) = (dn[i] / half, n[i] / r);
                    load[2 * k + i] += match of_rotation {
                        true => w * r * h * self.rho * r * n[i],
                        false => {
                            let free = (self.free_strain)(r) * self.e / (1.0 - self.nu);
                            w * r * h * free * (ri + ti)
                        }
                    };
                    for j in 0..3 {
                        let (rj, tj) = (dn[j] / half, n[j] / r);
                        let energy = ri * rj + ti * tj + self.nu * (ri * tj + ti * rj);
                        stiffness[(2 * k + i, 2 * k + j)] += w * r * h * plane * energy;
                    }
                }
            }
        }
        if of_rotation {
            let rim = self.nodes.last().expect("a ring");
            load[count - 1] += self.rim_kg * rim / std::f64::consts::TAU;
        }
        if self.held {
            stiffness.row_mut(0).fill(0.0);
            stiffness.column_mut(0).fill(0.0);
            stiffness[(0, 0)] = 1.0;
            load[0] = 0.0;
        }
        let u = stiffness.cholesky().expect("definite").solve(&load);
        let of_element = |(k, pair): (usize, &[f64])| {
            let half = 0.5 * (pair[1] - pair[0]);
            let mut found = [[0.0; 2]; 4];
            for (place, (r, _, x)) in points(pair[0], pair[1]).enumerate() {
                let (n, dn) = quadratic(x);
                let free = if of_rotation {
                    0.0
                } else {
                    (self.free_strain)(r)
                };
                let sum = |f: [f64; 3]| (0..3).map(|i| f[i] * u[2 * k + i]).sum::<f64>();
                let (rr, tt) = (sum(dn) / half - free, sum(n) / r - free);
                found[place] = [plane * (rr + self.nu * tt), plane * (tt + self.nu * rr)];
            }
            found
        };
        self.nodes.windows(2).enumerate().map(of_element).collect()
    }

    /// Frequencies in the turning frame, in rad/s, ascending.
    fn frequencies(&self, n: usize, speed: f64, heated: bool) -> Vec<f64> {
        let size = 2 * self.nodes.len();
        let zero = || DMatrix::<f64>::zeros(size, size);
        let (mut k, mut m) = (zero(), zero());
        let rotation = self.stress(true);
        let heat = self.stress(false);
        let n2 = (n * n) as f64;
        for (index, pair) in self.nodes.windows(2).enumerate() {
            let l = pair[1] - pair[0];
            for (place, (r, w, x)) in points(pair[0], pair[1]).enumerate() {
                let (value, slope, curvature) = hermite(0.5 * (1.0 + x), l);
                let h = (self.thickness)(r);
                let d = self.e * h.powi(3) / (12.0 * (1.0 - self.nu * self.nu));
                let hoop = slope / r - value * (n2 / (r * r));
                let twist = (slope / r - value / (r * r)) * n as f64;
                let bending = curvature * curvature.transpose()
                    + hoop * hoop.transpose()
                    + (curvature * hoop.transpose() + hoop * curvature.transpose()) * self.nu
                    + twist * twist.transpose() * (2.0 * (1.0 - self.nu));
                let [mut rr, mut tt] = rotation[index][place].map(|s| s * speed * speed);
                if heated {
                    rr += heat[index][place][0];
                    tt += heat[index][place][1];
                }
                let tension = slope * slope.transpose() * rr
                    + value * value.transpose() * (tt * n2 / (r * r));
                let stiffness = bending * (w * r * d) + tension * (w * r * h);
                let mass = value * value.transpose() * (w * r * self.rho * h);
                for i in 0..4 {
                    for j in 0..4 {
                        k[(2 * index + i, 2 * index + j)] += stiffness[(i, j)];
                        m[(2 * index + i, 2 * index + j)] += mass[(i, j)];
                    }
                }
            }
        }
        m[(size - 2, size - 2)] += self.rim_kg / std::f64::consts::TAU;
        let first = if self.clamped { 2 } else { 0 };
        let keep = size - first;
        let (k, m) = (
            k.view((first, first), (keep, keep)).into_owned(),
            m.view((first, first), (keep, keep)).into_owned(),
        );
        let inverse = m.cholesky().expect("definite").l().try_inverse();
        let inverse: DMatrix<f64> = inverse.expect("a triangle");
        let squares = (&inverse * k * inverse.transpose()).symmetric_eigenvalues();
        let mut squares: Vec<f64> = squares.iter().copied().collect();
        squares.sort_by(f64::total_cmp);
        squares.into_iter().map(|s| s.max(0.0).sqrt()).collect()
    }
}

/// Hermite's cubics on an element of length l at a share t of it: values, slopes, curvatures.
fn hermite(t: f64, l: f64) -> (SVector<f64, 4>, SVector<f64, 4>, SVector<f64, 4>) {
    let value = [
        1.0 - 3.0 * t * t + 2.0 * t.powi(3),
        l * (t - 2.0 * t * t + t.powi(3)),
        3.0 * t * t - 2.0 * t.powi(3),
        l * (t.powi(3) - t * t),
    ];
    let slope = [
        (6.0 * t * t - 6.0 * t) / l,
        1.0 - 4.0 * t + 3.0 * t * t,
        (6.0 * t - 6.0 * t * t) / l,
        3.0 * t * t - 2.0 * t,
    ];
    let curvature = [
        (12.0 * t - 6.0) / (l * l),
        (6.0 * t - 4.0) / l,
        (6.0 - 12.0 * t) / (l * l),
        (6.0 * t - 2.0) / l,
    ];
    let column = SMatrix::<f64, 4, 1>::from_column_slice;
    (column(&value), column(&slope), column(&curvature))
}

const HUB: f64 = 3.6e-3;
const ROWS: [(f64, f64); 4] = [
    (0.16, 3.6e-3),
    (0.26, 2.4e-3),
    (0.31, 2.4e-3),
    (0.31, 1.9e-3),
];

/// The same in words of its own: hub, taper, land, thin rim.
fn stepped(r: f64) -> f64 {
    match r {
        r if r < 0.16 => HUB,
        r if r < 0.26 => HUB - 1.2e-3 * (r - 0.16) / 0.1,
        r if r < 0.31 => 2.4e-3,
        _ => 1.9e-3,
    }
}

fn rows(list: &[(f64, f64)]) -> Vec<ThicknessRow> {
    let row = |&(radius_m, thickness_m): &(f64, f64)| ThicknessRow {
        radius_m,
        thickness_m,
    };
    list.iter().map(row).collect()
}

fn saw(change: impl FnOnce(&mut SceneFile)) -> Scene {
    let saw = Scene::paper().edited(|saw| {
        saw.guides.clear();
        saw.blade.thickness_m = HUB;
        saw.blade.profile = rows(&ROWS);
        change(saw);
    });
    saw.unwrap_or_else(|error| panic!("{error}"))
}

fn ring(scene: &Scene, thickness: fn(f64) -> f64) -> Ring {
    let blade = scene.blade();
    let (a, b) = (blade.inner_radius_m, blade.outer_radius_m);
    let mut ends = vec![a];
    ends.extend([0.16, 0.26, 0.31].into_iter().filter(|r| *r > a));
    ends.push(b);
    let mut nodes = vec![a];
    for pair in ends.windows(2) {
        let count = (ELEMENTS as f64 * (pair[1] - pair[0]) / (b - a)).ceil() as usize;
        let share = |k: usize| pair[0] + (pair[1] - pair[0]) * k as f64 / count as f64;
        nodes.extend((1..=count).map(share));
    }
    let collar = matches!(scene.file().mount, Mount::Collar { .. });
    let fixed = matches!(
        scene.file().mount,
        Mount::Collar {
            in_plane: InPlane::Fixed,
            ..
        }
    );
    Ring {
        nodes,
        thickness,
        rim_kg: blade.rim.map_or(0.0, |rim| rim.mass_kg),
        clamped: collar,
        held: fixed,
        e: blade.material.youngs_modulus_pa,
        nu: blade.material.poisson_ratio,
        rho: blade.material.density_kg_per_m3,
        free_strain: |r| 1.2e-5 * 15.0 * (r - 0.2).max(0.0) / 0.155,
    }
}

const RESOLUTION: Resolution = Resolution {
    max_diameters: 5,
    radial_functions: 12,
};

/// Frequencies of the library in the turning frame, in rad/s, ascending.
fn frequencies(plate: &Plate, n: usize, speed: f64) -> Vec<f64> {
    let k = body_frame_stiffness(&plate.harmonics[n], speed);
    let k = DMatrix::from_fn(k.nrows(), k.ncols(), |i, j| k[(i, j)]);
    let mut squares: Vec<f64> = k.symmetric_eigenvalues().iter().copied().collect();
    squares.sort_by(f64::total_cmp);
    squares.into_iter().map(|s| s.max(0.0).sqrt()).collect()
}

fn compare(what: &str, scene: &Scene, thickness: fn(f64) -> f64, tolerance: f64) {
    let ring = ring(scene, thickness);
    let plate = Plate::new(scene, RESOLUTION);
    let mut worst = Worst::default();
    for n in 0..=5 {
        for speed in [0.0, 150.0, 300.0] {
            let heated = scene.membrane().is_some();
            let expected = ring.frequencies(n, speed, heated);
            let found = frequencies(&plate, n, speed);
            let free = !ring.clamped && n <= 1;
            for (found, expected) in found.iter().zip(&expected).skip(usize::from(free)).take(3) {
                worst.add(relative_error(*found, *expected), || {
                    format!("n = {n} at {speed} rad/s: {found} for {expected}")
                });
            }
        }
    }
    worst.assert_at_most(what, tolerance);
}

fn collar(in_plane: InPlane) -> Mount {
    Mount::Collar {
        diameter_m: 0.25,
        in_plane,
    }
}

#[test]
fn a_stepped_and_tapered_blade_has_the_frequencies_of_finite_elements() {
    compare("spline", &saw(|_| ()), stepped, 1e-4);
    for in_plane in [InPlane::Fixed, InPlane::Free] {
        let held = saw(|saw| saw.mount = collar(in_plane));
        compare(&format!("collar {in_plane:?}"), &held, stepped, 1e-4);
    }
}

#[test]
fn heat_stresses_a_stepped_blade_as_it_does_finite_elements() {
    for mount in [Mount::Spline {}, collar(InPlane::Fixed)] {
        let hot = saw(|saw| {
            saw.mount = mount;
            saw.membrane = Some(MembraneFile {
                temperature: Some(TemperatureFile {
                    expansion_per_k: 1.2e-5,
                    rim_rise_k: Some(15.0),
                    from_radius_m: Some(0.2),
                    exponent: None,
                    table: Vec::new(),
                }),
                roll_tension: Vec::new(),
                residual_stress: Vec::new(),
            });
        });
        compare("hot", &hot, stepped, 1e-4);
    }
}

#[test]
fn the_mass_of_teeth_is_that_of_finite_elements() {
    let heavy = |saw: &mut SceneFile| {
        saw.blade.rim = Some(RimFile {
            mass_per_tooth_kg: 0.012,
            radius_m: None,
        });
    };
    compare("steps and teeth", &saw(heavy), stepped, 1e-4);
    let plain = saw(|saw| {
        heavy(saw);
        saw.blade.profile.clear();
    });
    compare("teeth alone", &plain, |_| HUB, 1e-5);
    let held = saw(|saw| {
        heavy(saw);
        saw.mount = collar(InPlane::Fixed);
    });
    compare("steps, teeth and a collar", &held, stepped, 1e-4);
}

/// A profile of one thickness is the blade of that thickness, and so is a step of a billionth.
#[test]
fn a_profile_of_one_thickness_is_the_plain_blade() {
    let plain = Plate::new(&saw(|saw| saw.blade.profile.clear()), RESOLUTION);
    for rest in [0.0, 1e-9] {
        let thickness = HUB * (1.0 - rest);
        let same = saw(|saw| saw.blade.profile = rows(&[(0.16, HUB), (0.16, thickness)]));
        let same = Plate::new(&same, RESOLUTION);
        for n in 0..=5 {
            let pairs = frequencies(&plain, n, 200.0).into_iter();
            let pairs = pairs.zip(frequencies(&same, n, 200.0));
            for (one, other) in pairs.skip(usize::from(n <= 1)).take(3) {
                assert!(relative_error(other, one) < 1e-6, "{n}: {other} for {one}");
            }
        }
    }
}

/// The virial: what dead loads do to the rigid tilts depends on where they act alone, not on the
/// blade between.
#[test]
fn edge_loads_turn_a_stepped_blade_as_they_turn_a_plain_one() {
    let loads = [
        RimForce {
            angle_rad: 0.3,
            radial_n: -90.0,
            tangential_n: -1000.0,
        },
        RimForce {
            angle_rad: 0.7,
            radial_n: 40.0,
            tangential_n: 600.0,
        },
    ];
    let moments = |scene: &Scene| {
        let plate = Plate::new(scene, RESOLUTION).with_edge_loads(&loads);
        let stiffness = plate.edge_stiffness.as_ref().expect("loads").clone();
        let (b, count) = (plate.blade.outer_radius_m, plate.basis.count());
        let tilt = plate.basis.evaluate(1, b).value[0] / b / plate.angular_norm(1);
        let at = [plate.offset(1), plate.offset(1) + count];
        DMatrix::from_fn(2, 2, |i, j| stiffness[(at[i], at[j])] / (tilt * tilt))
    };
    let plain = moments(&saw(|saw| saw.blade.profile.clear()));
    let stepped = moments(&saw(|_| ()));
    let error = (&stepped - &plain).norm() / plain.norm();
    assert!(error < 1e-9, "{stepped} for {plain}, off by {error:e}");
}

/// The stress of edge loads of high order on a blade whose profile has one thickness.
#[test]
fn finite_elements_give_the_edge_stiffness_of_the_series() {
    let loads = [RimForce {
        angle_rad: 0.3,
        radial_n: -90.0,
        tangential_n: -1000.0,
    }];
    let buckled = |profile: Vec<ThicknessRow>| {
        let plate = Plate::new(&saw(|saw| saw.blade.profile = profile), RESOLUTION);
        let plate = plate.with_edge_loads(&loads);
        let system = sawflutter::system::GyroscopicSystem::of_plate(&plate);
        let k = DMatrix::from_fn(system.order(), system.order(), |i, j| {
            system.stiffness[(i, j)]
        });
        let mut all: Vec<f64> = k.symmetric_eigenvalues().iter().copied().collect();
        all.sort_by(f64::total_cmp);
        all
    };
    let (plain, elements) = (buckled(Vec::new()), buckled(rows(&[(0.2, HUB)])));
    for (one, other) in plain.iter().zip(&elements).take(14) {
        let error = (one - other).abs() / plain[13].abs();
        assert!(error < 1e-6, "{other} for {one}");
    }
}
