//! The trial: errors and counts of growing modes beside dense eigenvalues, sizes, and run times by stage.

use faer::{Mat, Scale, c64};
use sawflutter::model::plate::{Plate, Resolution};
use sawflutter::model::scene::{Scene, SceneFile, SpeedRange};
use sawflutter::model::system::GyroscopicSystem;
use sawflutter::modes::waves::{self, WaveModel};
use sawflutter::modes::{Component, LowestModes};

use super::scenes;
use super::search::{Scope, Searched, roots};

/// Basis in which all eigenvalues are computed.
const SMALL: Resolution = Resolution {
    max_diameters: 12,
    radial_functions: 7,
};
/// Top of the window, as a multiple of the last speed.
const WINDOW: f64 = 2.0;
/// Speeds of a comparison.
const SPEEDS: usize = 8;
/// Growth that has to be found, in 1/s.
const GROWS: f64 = 0.05;
/// Processor time of this thread in s: other work on the machine does not count.
fn busy_s() -> f64 {
    let stat = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    let busy = stat.split_whitespace().next();
    1e-9 * busy.and_then(|t| t.parse().ok()).unwrap_or(f64::NAN)
}

/// A saw by waves from rest to a speed.
struct Model {
    waves: WaveModel,
    searched: Searched,
    scope: Scope,
    /// Seconds for the model and the search.
    seconds: [f64; 2],
}

impl Model {
    fn new(plate: &Plate, to: f64) -> Self {
        let window = WINDOW * to;
        let components: Vec<Component> = LowestModes::new(plate).components;
        let mut times = vec![busy_s()];
        let [guided] = &components[..] else {
            panic!("a free blade")
        };
        let modes = waves::modes(
            plate,
            guided.first,
            &guided.full,
            SpeedRange::new(0.0, to),
            window,
        );
        let reduced = modes.expect("no eigenproblem fails").model;
        times.push(busy_s());
        let scope = Scope {
            window,
            tolerance: 1e-3,
            noise_per_s: 1e-6 * window,
            rigid: components.iter().map(|c| c.full.free_rigid.len()).sum(),
            is_conservative: plate.is_conservative(),
        };
        let searched = Searched::new(&reduced, scope);
        times.push(busy_s());
        Model {
            waves: reduced,
            searched,
            scope,
            seconds: [0, 1].map(|k| times[k + 1] - times[k]),
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
    let values = companion
        .eigenvalues()
        .expect("converges")
        .into_iter()
        .map(|value: c64| value * unit);
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
    let model = Model::new(&plate, to);
    let window = model.scope.window;
    let (mut worst, mut wrong) = (0.0_f64, [0, 0]);
    for k in 0..SPEEDS {
        let speed = to * (k as f64 + 0.63) / SPEEDS as f64;
        let exact = dense(&system, speed, window);
        let roots = roots(&model.waves, speed, model.scope);
        let values: Vec<c64> = roots.iter().map(|root| root.lambda).collect();
        let inside = exact.iter().filter(|l| l.norm() < window);
        worst = inside
            .map(|l| nearest(&values, *l) / window)
            .fold(worst, f64::max);
        let read_off = model.searched.eigenvalues(speed);
        for (wrong, found) in wrong.iter_mut().zip([&values, &read_off]) {
            *wrong += usize::from(!grow_alike(&exact, found, window));
        }
    }
    let (size, tail, lost) = (
        model.waves.size(),
        model.waves.tail(),
        model.searched.lost(),
    );
    let solved = model.searched.eigenproblems;
    let [reduced, search] = model.seconds.map(|s| s / e);
    println!(
        "{name:22} {size} unknowns, tail {tail:.0e}, error {worst:.1e} of the window | wrong: model {}, pieces {} of {SPEEDS} | {solved} eigenproblems, given up {:.0e} | model {reduced:.2}, search {search:.2} E",
        wrong[0],
        wrong[1],
        lost / to,
    );
    wrong == [0, 0] && lost < 1e-4 * to
}

/// Compares the saws whose names contain a word; whether all are right.
pub fn run(word: &str) -> bool {
    let typed = std::env::var("E_MS")
        .ok()
        .and_then(|e| e.parse::<f64>().ok());
    let e = 1e-3 * typed.unwrap_or(100.0);
    let all = scenes::named();
    let right = all
        .iter()
        .filter(|(name, _)| name.contains(word))
        .map(|(name, file)| compared(name, file, e));
    right.fold(true, |all, one| all & one)
}
