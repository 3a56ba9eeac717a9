//! The trial: errors and counts of growing modes beside dense eigenvalues, sizes, and run times by stage.

use faer::{Mat, Scale, c64};
use sawflutter::plate::{Plate, Resolution};
use sawflutter::scene::{Scene, SceneFile};
use sawflutter::system::GyroscopicSystem;

use super::dense::Whole;
use super::interval::{Interval, NODES, Root};
use super::near::Near;
use super::reduced::Frame;
use super::scenes;
use super::search::{Scope, Searched};
use super::series::TERMS;
use super::stages::Middle;
use super::waves::Saw;

/// Basis in which all eigenvalues are computed.
const SMALL: Resolution = Resolution {
    max_diameters: 12,
    radial_functions: 7,
};
/// Top of the window, as a multiple of the last speed.
const WINDOW: f64 = 2.0;
/// Cut of the intervals, and distance of the waves that stage one keeps, in windows. For one pad the error of the worst
/// eigenvalue of the window is 9e-4, 4e-4 and 2e-4 of it at cuts of 1.5, 2 and 2.5 windows.
const CUTS: (f64, f64) = (2.5, 4.0);
/// Number of intervals.
const INTERVALS: usize = 4;
/// Trace of what the columns leave out: eigenvalues of 1e-4 are the same to 2e-5 of the window.
const COLUMNS: f64 = 1e-6;
/// Speeds of a comparison.
const SPEEDS: usize = 8;
/// Growth that has to be found, in 1/s.
const GROWS: f64 = 0.05;
/// True error over the estimated one that is allowed; 1.4 is the largest of 50 drawn saws.
const OFF: f64 = 2.0;
/// Error, in windows, below which the estimate is not compared: that of columns and series.
const FINE: f64 = 3e-6;

/// Processor time of this thread in s: other work on the machine does not count.
fn busy_s() -> f64 {
    let stat = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    let busy = stat.split_whitespace().next();
    1e-9 * busy.and_then(|t| t.parse().ok()).unwrap_or(f64::NAN)
}

/// A saw by waves from rest to a speed.
struct Model {
    intervals: Vec<Interval>,
    searched: Vec<Searched>,
    window: f64,
    /// Seconds for the columns, stage one, the intervals and the search.
    seconds: [f64; 4],
}

impl Model {
    fn new(plate: &Plate, system: &GyroscopicSystem, to: f64) -> Self {
        let window = WINDOW * to;
        let mut times = vec![busy_s()];
        let saw = Saw::new(plate, window, COLUMNS);
        times.push(busy_s());
        let sweep = (0.0, to);
        // Rule 2 is applied with all waves that are far at rest.
        let dampers = Near::new(&saw, (0.0, 0.0), (window, CUTS.0 * window));
        let wide = CUTS.1 * window;
        let near = Near::new(&saw, sweep, (window, wide)).with_dampers_of(dampers);
        let stage = (window, TERMS, NODES);
        let middle = match plate.edge_stiffness.is_some() {
            false => {
                let frame = Frame::new(&saw, &near, window);
                let equations = |speed: f64, terms: usize| frame.reduced(speed, terms);
                Middle::new(
                    &equations,
                    frame.unknowns(),
                    sweep,
                    stage,
                    saw.is_conservative,
                )
            }
            true => {
                let whole = Whole::new(&saw, system, &near, sweep, window);
                let unknowns = whole.unknowns(wide);
                let count = unknowns.len();
                let equations = |speed: f64, terms: usize| whole.equations(speed, terms, count);
                Middle::new(&equations, unknowns, sweep, stage, saw.is_conservative)
            }
        };
        times.push(busy_s());
        let intervals = middle.intervals(INTERVALS, CUTS.0 * window, TERMS, NODES);
        times.push(busy_s());
        let scope = Scope {
            window,
            reach: 1.8 * window,
            tolerance: 1e-3,
            noise_per_s: 1e-6 * window,
            negligible: 3.0 * COLUMNS,
            rigid: system.free_rigid.len(),
        };
        let searched = intervals.iter().map(|i| Searched::new(i, scope)).collect();
        times.push(busy_s());
        Model {
            intervals,
            searched,
            window,
            seconds: [0, 1, 2, 3].map(|k| times[k + 1] - times[k]),
        }
    }
}

/// All eigenvalues of the full matrices with Im λ ≥ 0.
fn dense(system: &GyroscopicSystem, speed: f64, unit: f64) -> Vec<c64> {
    let n = system.order();
    let stiffness = Scale(unit.powi(-2)) * system.stiffness_at(speed);
    let velocity = Scale(unit.recip()) * system.velocity_at(speed);
    let companion = Mat::from_fn(2 * n, 2 * n, |i, k| match (i < n, k < n) {
        (true, true) => 0.0,
        (true, false) => f64::from(u8::from(i + n == k)),
        (false, true) => -stiffness[(i - n, k)],
        (false, false) => -velocity[(i - n, k - n)],
    });
    let values = companion.eigenvalues().expect("converges");
    let values = values.into_iter().map(|value: c64| value * unit);
    values.filter(|value| value.im >= 0.0).collect()
}

/// Whether two spectra have the same growing modes, of which a few percent may differ: in one of three windows, because a
/// mode may lie at the border of one.
fn grow_alike(exact: &[c64], found: &[c64], window: f64) -> bool {
    let growing = |values: &[c64], window: f64, oscillates: bool| {
        let grows =
            |l: &&c64| l.re > GROWS && l.norm() < window && (l.im > 1e-5 * window) == oscillates;
        let mut growth: Vec<f64> = values.iter().filter(grows).map(|l| l.re).collect();
        growth.sort_by(f64::total_cmp);
        growth
    };
    [0.9, 0.95, 1.0].iter().any(|share| {
        [true, false].iter().all(|oscillates| {
            let [x, y] = [exact, found].map(|v| growing(v, share * window, *oscillates));
            let near = |(x, y): (&f64, &f64)| (x - y).abs() < 0.02 * x + GROWS;
            x.len() == y.len() && x.iter().zip(&y).all(near)
        })
    })
}

fn nearest(values: &[c64], x: c64) -> f64 {
    let distances = values.iter().map(|value| (value - x).norm());
    distances.fold(f64::INFINITY, f64::min)
}

/// Compares a saw with all its eigenvalues, and prints the result; whether it is right.
fn compared(name: &str, file: &SceneFile, e: f64) -> bool {
    let scene = Scene::try_from(file.clone()).expect("a valid scene");
    let to = scene.sweep().expect("a sweep").to_rad_per_s;
    let plate = Plate::new(&scene, SMALL);
    let system = GyroscopicSystem::of_plate(&plate);
    let model = Model::new(&plate, &system, to);
    let window = model.window;
    let (mut worst, mut off, mut wrong) = (0.0_f64, 0.0_f64, [0, 0]);
    for k in 0..SPEEDS {
        let speed = to * (k as f64 + 0.63) / SPEEDS as f64;
        let place = k * INTERVALS / SPEEDS;
        let exact = dense(&system, speed, window);
        let roots = model.intervals[place].roots(speed, CUTS.0 * window);
        let values: Vec<c64> = roots.iter().map(|root| root.lambda).collect();
        let inside = exact.iter().filter(|l| l.norm() < window);
        worst = inside
            .map(|l| nearest(&values, *l) / window)
            .fold(worst, f64::max);
        for Root { lambda, error, .. } in roots.iter().filter(|r| r.lambda.norm() < 0.97 * window) {
            let truth = nearest(&exact, *lambda);
            off = off.max((truth - FINE * window) / error.norm());
        }
        let read_off = model.searched[place].eigenvalues(speed);
        for (wrong, found) in wrong.iter_mut().zip([&values, &read_off]) {
            *wrong += usize::from(!grow_alike(&exact, found, window));
        }
    }
    let sizes: Vec<usize> = model.intervals.iter().map(|i| i.size).collect();
    let strong = model.intervals[0].strong;
    let tails = model.intervals.iter().map(Interval::tail);
    let solved: usize = model.searched.iter().map(|s| s.eigenproblems).sum();
    let lost: f64 = model.searched.iter().map(Searched::lost).sum();
    let [columns, first, second, search] = model.seconds.map(|s| s / e);
    println!(
        "{name:22} {sizes:?}, {strong} strong | tail {:.0e}, error {worst:.1e} of the window, {off:.1} x the estimate | wrong: model {}, pieces {} of {SPEEDS} | {solved} eigenproblems, given up {:.0e} | columns {columns:.2}, stages {first:.2} + {second:.2}, search {search:.2} E",
        tails.fold(0.0, f64::max),
        wrong[0],
        wrong[1],
        lost / to,
    );
    wrong == [0, 0] && off < OFF && lost < 1e-4 * to
}

/// Compares the saws whose names contain a word; whether all are right.
pub fn run(word: &str) -> bool {
    let e = std::env::var("E_MS")
        .ok()
        .and_then(|e| e.parse::<f64>().ok());
    let e = 1e-3 * e.unwrap_or(100.0);
    let all = scenes::named();
    let right = all
        .iter()
        .filter(|(name, _)| name.contains(word))
        .map(|(name, file)| compared(name, file, e));
    right.fold(true, |all, one| all & one)
}
