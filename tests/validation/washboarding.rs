//! Washboarding, compared with another discretisation of the delay.
//!
//! The delayed state is collocated at Chebyshev points of [−τ, 0]: with y(θ) = Bᵀx(t + θ) there, dy/dt = dy/dθ except
//! at θ = 0, where y = Bᵀx. Its eigenvalues, those of one matrix, tend to those of the delayed system faster than any
//! power of the number of points. Source: D. Breda, S. Maset & R. Vermiglio, *Pseudospectral differencing methods for
//! characteristic roots of delay differential equations*, SIAM J. Sci. Comput. 27 (2005), 482–495. The arc is
//! integrated by Gauss's rule over point forces, on the full model.

use std::f64::consts::{PI, TAU};

use faer::{Mat, c64};
use sawflutter::analyses::campbell::Verdict;
use sawflutter::analyses::washboard::{WashboardError, WashboardReport, washboard};
use sawflutter::model::plate::{Plate, Resolution};
use sawflutter::model::scene::{
    Accuracy, DampingFile, Scene, SceneFile, WashboardingFile, WoodFile, rad_per_s,
};
use sawflutter::model::system::GyroscopicSystem;
use sawflutter::modes::companion_eigenpairs;

use crate::common::relative_error;

/// Collocation points, on the arc and of the delay.
const ON_ARC: usize = 8;
const OF_DELAY: usize = 18;

fn resaw(change: impl FnOnce(&mut SceneFile)) -> Scene {
    let scene = crate::common::scene("gallery/washboarding");
    let edited = scene.edited(|saw| {
        saw.accuracy = Accuracy::Draft;
        change(saw);
    });
    edited.unwrap_or_else(|error| panic!("{error}"))
}

fn washboarding(saw: &mut SceneFile) -> &mut WashboardingFile {
    let cut = saw.cut.as_mut().expect("a cut");
    cut.washboarding.as_mut().expect("washboarding")
}

fn report(scene: &Scene) -> WashboardReport {
    look(scene).unwrap_or_else(|error| panic!("{error}"))
}

fn look(scene: &Scene) -> Result<WashboardReport, WashboardError> {
    let cut = scene.cut().expect("a cut");
    let run = cut.at_rpm(scene.file().operating_rpm.expect("a speed"));
    washboard(scene, &run.unwrap(), &|_, _| ())
}

/// Nodes and weights of Gauss's rule on [−1, 1], by Newton's method on the Legendre polynomial.
fn gauss(count: usize) -> Vec<[f64; 2]> {
    let node = |k: usize| {
        let mut x = (PI * (k as f64 + 0.75) / (count as f64 + 0.5)).cos();
        let mut slope = 0.0;
        for _ in 0..50 {
            let (mut before, mut here) = (1.0, x);
            for n in 2..=count {
                let n = n as f64;
                (before, here) = (here, ((2.0 * n - 1.0) * x * here - (n - 1.0) * before) / n);
            }
            slope = count as f64 * (x * here - before) / (x * x - 1.0);
            x -= here / slope;
        }
        [x, 2.0 / ((1.0 - x * x) * slope * slope)]
    };
    (0..count).map(node).collect()
}

/// Eigenvalues of the collocated delay, on the full model of a report.
fn collocated(scene: &Scene, report: &WashboardReport, stiffness: f64) -> Vec<c64> {
    let cut = scene.cut().unwrap();
    let typed = scene.file().cut.as_ref().unwrap();
    let delayed = typed.washboarding.as_ref().unwrap();
    let of_teeth = cut.teeth.arc_rad();
    let arc = delayed.arc_deg.map_or(of_teeth, f64::to_radians);
    let run = cut.at_rpm(report.rpm).unwrap();
    let resolution = Resolution {
        max_diameters: report.max_diameters,
        radial_functions: report.radial_functions,
    };
    let plate = Plate::new(&scene.idling().unwrap(), resolution).in_cut(cut, &run);
    let system = GyroscopicSystem::of_plate(&plate);
    let order = system.order();
    let mut columns = Mat::zeros(order, ON_ARC);
    for (k, [node, weight]) in gauss(ON_ARC).into_iter().enumerate() {
        let angle = cut.teeth.angle_deg.to_radians() + 0.5 * arc * node;
        let functions = plate.functions_at(plate.blade.outer_radius_m, angle);
        for (i, value) in functions.into_iter().enumerate() {
            columns[(i, k)] = value * (0.5 * weight).sqrt();
        }
    }
    let speed = rad_per_s(report.rpm);
    generator(
        [
            &system.stiffness_at(speed),
            &system.velocity_at(speed),
            &columns,
        ],
        stiffness,
        delayed.overlap,
        &report.delays_s,
    )
}

/// Chebyshev's points of [−τ, 0], the first at 0, and the matrix of the derivative.
fn chebyshev(longest: f64) -> (Vec<f64>, Mat<f64>) {
    let nodes: Vec<f64> = (0..=OF_DELAY)
        .map(|k| 0.5 * longest * ((PI * k as f64 / OF_DELAY as f64).cos() - 1.0))
        .collect();
    let weight = |k: usize| {
        let end = if k == 0 || k == OF_DELAY { 2.0 } else { 1.0 };
        if k.is_multiple_of(2) { end } else { -end }
    };
    let mut derivative = Mat::zeros(OF_DELAY + 1, OF_DELAY + 1);
    for i in 0..=OF_DELAY {
        for k in (0..=OF_DELAY).filter(|k| *k != i) {
            derivative[(i, k)] = weight(i) / weight(k) / (nodes[i] - nodes[k]);
            let entry = derivative[(i, k)];
            derivative[(i, i)] -= entry;
        }
    }
    (nodes, derivative)
}

/// Values of the polynomials of Lagrange at a place.
fn lagrange(nodes: &[f64], at: f64) -> Vec<f64> {
    let of = |k: usize| -> f64 {
        let others = (0..nodes.len()).filter(|i| *i != k);
        others
            .map(|i| (at - nodes[i]) / (nodes[k] - nodes[i]))
            .product()
    };
    (0..nodes.len()).map(of).collect()
}

fn generator(
    [stiffness, velocity, columns]: [&Mat<f64>; 3],
    cutting: f64,
    overlap: f64,
    delays: &[f64],
) -> Vec<c64> {
    let (order, width) = (stiffness.nrows(), columns.ncols());
    let longest = delays.iter().copied().fold(0.0, f64::max);
    let (nodes, derivative) = chebyshev(longest);
    // 1 − μ Σ over the delays, as weights of the values at the points.
    let mut force = [0.0; OF_DELAY + 1];
    force[0] = 1.0;
    for delay in delays {
        for (sum, value) in force.iter_mut().zip(lagrange(&nodes, -delay)) {
            *sum -= overlap / delays.len() as f64 * value;
        }
    }
    // Time in units of the delay, so that the blocks are of one size.
    let unit = 1.0 / longest;
    let mut matrix = Mat::<f64>::zeros(2 * order + OF_DELAY * width, 2 * order + OF_DELAY * width);
    let arc = columns * columns.transpose();
    for i in 0..order {
        matrix[(i, order + i)] = 1.0;
        for k in 0..order {
            let pressed = stiffness[(i, k)] + cutting * force[0] * arc[(i, k)];
            matrix[(order + i, k)] = -pressed / unit.powi(2);
            matrix[(order + i, order + k)] = -velocity[(i, k)] / unit;
        }
    }
    let place = |node: usize, column: usize| 2 * order + (node - 1) * width + column;
    for column in 0..width {
        for node in 1..=OF_DELAY {
            for i in 0..order {
                let of_node = cutting * force[node] * columns[(i, column)];
                matrix[(order + i, place(node, column))] = -of_node / unit.powi(2);
                matrix[(place(node, column), i)] =
                    derivative[(node, 0)] * columns[(i, column)] / unit;
            }
            for other in 1..=OF_DELAY {
                matrix[(place(node, column), place(other, column))] =
                    derivative[(node, other)] / unit;
            }
        }
    }
    let values = matrix.eigenvalues().expect("eigenvalues");
    values.into_iter().map(|value| value * unit).collect()
}

/// The eigenvalue with the largest real part in the frequency range of a report.
fn rightmost(values: &[c64], report: &WashboardReport) -> c64 {
    let within = |value: &&c64| value.im >= 0.0 && value.im <= TAU * report.complete_to_hz;
    let values = values.iter().filter(within);
    *values.max_by(|x, y| x.re.total_cmp(&y.re)).expect("some")
}

/// Modes, count and boundary for even teeth, for teeth of two pitches, and for half the overlap.
#[test]
fn washboarding_is_that_of_a_collocated_delay() {
    let scenes = [
        resaw(|_| ()),
        resaw(|saw| washboarding(saw).pitches_deg = vec![9.0, 11.0]),
        resaw(|saw| washboarding(saw).overlap = 0.6),
    ];
    for (case, scene) in scenes.into_iter().enumerate() {
        let report = report(&scene);
        let values = collocated(&scene, &report, report.stiffness_n_per_m);
        assert!(report.modes.len() >= 8);
        for mode in &report.modes {
            let lambda = c64::new(mode.growth_per_s, TAU * mode.frequency_hz);
            let nearest = values
                .iter()
                .map(|value| (value - lambda).norm())
                .fold(f64::INFINITY, f64::min);
            assert!(nearest < 2e-4 * lambda.norm(), "{}: {nearest}", mode.name);
        }
        let growing = values.iter().filter(|value| value.re > 0.0).count();
        assert_eq!(report.growing_eigenvalues, Some(growing));
        assert_eq!(report.verdict == Verdict::Unstable, growing > 0);
        let fastest = rightmost(&values, &report);
        let told = &report.modes[0];
        assert!(
            (told.growth_per_s - fastest.re).abs() < 5e-3,
            "{} {fastest}",
            told.growth_per_s
        );
        assert!(report.lobes.confirmed.iter().all(|confirmed| *confirmed));
        // One case is enough for the boundary, which needs two more computations.
        if case == 0 {
            boundary_is_between(&scene, &report);
        }
    }
}

/// Above the boundary an eigenvalue is right of the imaginary axis, at the reported frequency.
fn boundary_is_between(scene: &Scene, report: &WashboardReport) {
    let critical = report.critical_stiffness_n_per_m.unwrap();
    let at = |share: f64| rightmost(&collocated(scene, report, share * critical), report);
    let (below, above) = (at(0.999), at(1.001));
    assert!(below.re < 0.0 && above.re > 0.0, "{below} {above}");
    let frequency = above.im / TAU;
    assert!(relative_error(frequency, report.critical_frequency_hz.unwrap()) < 1e-3);
}

/// The diagram's curve passes through the boundary at the speed of the cut.
#[test]
fn the_diagram_goes_through_the_boundary_of_the_cut() {
    let report = report(&resaw(|_| ()));
    let lobes = &report.lobes;
    let after = lobes.rpm.partition_point(|rpm| *rpm < report.rpm);
    let [x, y] = [after - 1, after].map(|k| lobes.critical_stiffness_n_per_m[k].unwrap());
    let own = report.critical_stiffness_n_per_m.unwrap();
    let [low, high] = [x.min(y), x.max(y)];
    assert!(own > 0.9 * low && own < 1.1 * high, "{low} {own} {high}");
}

/// Without overlap the force is that of wood on an arc of the rim.
#[test]
fn without_overlap_it_is_wood_on_the_rim() {
    let scene = resaw(|saw| washboarding(saw).overlap = 0.0);
    let report = report(&scene);
    assert_eq!(report.critical_stiffness_n_per_m, None);
    assert_eq!(report.verdict, Verdict::Stable);
    let sprung = scene
        .edited(|saw| {
            let cut = saw.cut.as_mut().expect("a cut");
            cut.wood = Some(WoodFile {
                stiffness_n_per_m: report.stiffness_n_per_m,
                ..WoodFile::default()
            });
        })
        .unwrap();
    let cut = sprung.cut().unwrap();
    let resolution = Resolution {
        max_diameters: report.max_diameters,
        radial_functions: report.radial_functions,
    };
    let run = cut.at_rpm(report.rpm).unwrap();
    let plate = Plate::new(&sprung, resolution).in_cut(cut, &run);
    let system = GyroscopicSystem::of_plate(&plate);
    let exact = companion_eigenpairs(&system, rad_per_s(report.rpm)).unwrap();
    for mode in &report.modes {
        let lambda = c64::new(mode.growth_per_s, TAU * mode.frequency_hz);
        let nearest = exact
            .iter()
            .map(|(value, _)| (value - lambda).norm())
            .fold(f64::INFINITY, f64::min);
        assert!(nearest < 2e-4 * lambda.norm(), "{}: {nearest}", mode.name);
    }
}

/// The effect of a small stiffness is proportional to it, and the boundary does not depend on it.
#[test]
fn a_small_cutting_stiffness_changes_little() {
    let own = report(&resaw(|_| ()));
    let small = report(&resaw(|saw| washboarding(saw).stiffness_n_per_m = 100.0));
    assert_eq!(small.verdict, Verdict::Stable);
    for mode in &small.modes {
        let change = mode.growth_per_s - mode.growth_without_per_s.unwrap();
        assert!(change.abs() < 0.05, "{change}");
    }
    let boundary = |report: &WashboardReport| report.critical_stiffness_n_per_m.unwrap();
    assert!(relative_error(boundary(&small), boundary(&own)) < 1e-6);
}

/// Without a stiffness against the delayed force there is no answer.
#[test]
fn an_undamped_and_a_loose_saw_are_refused() {
    let undamped = resaw(|saw| saw.damping = None);
    let error = look(&undamped).unwrap_err();
    assert!(matches!(error, WashboardError::Undamped { .. }), "{error}");
    let loose = Scene::paper().edited(|saw| {
        saw.guides.clear();
        saw.operating_rpm = Some(1000.0);
        saw.damping = Some(DampingFile {
            air_n_s_per_m3: 10.0,
            ..DampingFile::default()
        });
        let cut = saw.cut.as_mut().expect("a cut");
        cut.washboarding = resaw(|_| ())
            .file()
            .cut
            .as_ref()
            .unwrap()
            .washboarding
            .clone();
    });
    let loose_error = look(&loose.unwrap()).unwrap_err();
    assert!(
        matches!(loose_error, WashboardError::Loose),
        "{loose_error}"
    );
}
