//! Trials: errors and counts beside dense eigenvalues, and times by stage.

use faer::{Mat, Scale, c64};
use sawflutter::plate::{Plate, Resolution};
use sawflutter::scene::{Scene, SceneFile, SweepFile, rpm};
use sawflutter::stability::{Analysis, InstabilityKind};
use sawflutter::system::GyroscopicSystem;

use super::dense::Whole;
use super::interval::{Interval, NODES, Root};
use super::near::Near;
use super::reduced::Frame;
use super::scenes;
use super::search::{Scope, Searched};
use super::series::{MODEL, TERMS};
use super::stages::Middle;
use super::waves::Saw;

/// Basis in which all eigenvalues are computed.
const SMALL: Resolution = Resolution {
    max_diameters: 12,
    radial_functions: 7,
};
/// Growth that has to be found, in 1/s.
const GROWS: f64 = 0.05;
/// Relative tolerance of the search.
const TOLERANCE: f64 = 1e-3;
/// Growth that does not matter, as a share of the window.
const NOISE: f64 = 1e-10;

/// Top of the window, as a multiple of the last speed.
const WINDOW: f64 = 2.0;
/// Entries of the model that are zero: the error of the columns.
const NEGLIGIBLE: f64 = 3e-6;

/// A setting of the trial that the environment may change.
fn from_environment(key: &str, usual: f64) -> f64 {
    std::env::var(key)
        .ok()
        .and_then(|text| text.parse().ok())
        .unwrap_or(usual)
}

/// Settings of a trial.
#[derive(Debug, Clone, Copy)]
pub struct Settings {
    /// Cut in windows.
    pub cut: f64,
    /// Number of intervals.
    pub intervals: usize,
    /// Error of the columns.
    pub columns: f64,
    /// Distance of the waves that stage one keeps, in windows.
    pub wide: f64,
    /// Number of nodes of stage one.
    pub nodes: usize,
    /// Whether loads at the rim are eliminated by signed columns and not densely.
    pub loads_by_columns: bool,
}

const USUAL: Settings = Settings {
    cut: 2.5,
    intervals: 4,
    columns: 1e-6,
    wide: 4.0,
    nodes: 8,
    loads_by_columns: false,
};

/// A saw by waves, over its range.
struct Model {
    saw: Saw,
    intervals: Vec<Interval>,
    window: f64,
    /// Highest frequency of a reflected free wave, in 1/s.
    reflected: f64,
    /// Number of unknowns after stage one, and error of its series.
    middle: usize,
    tail: f64,
    /// Seconds for the columns, stage one and the intervals.
    seconds: [f64; 3],
}

impl Model {
    fn new(plate: &Plate, (from, to): (f64, f64), settings: Settings, with_error: bool) -> Self {
        let begun = busy_s();
        let window = from_environment("WINDOW", WINDOW) * to;
        let by_columns = settings.loads_by_columns || plate.edge_stiffness.is_none();
        let saw = Saw::new(plate, window, settings.columns, by_columns);
        let columns = busy_s() - begun;
        let sizes = (window, settings.cut * window);
        let terms = if with_error { TERMS } else { MODEL };
        let system = (!by_columns).then(|| GyroscopicSystem::of_plate(plate));
        let begun = busy_s();
        let dampers = Near::new(&saw, (from, from), sizes);
        let wide = settings.wide * window;
        let near = Near::new(&saw, (from, to), (window, wide)).with_dampers_of(dampers);
        let stage = (window, terms, settings.nodes);
        let sweep = (from, to);
        let middle = match &system {
            None => {
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
            Some(system) => {
                let whole = Whole::new(&saw, system, &near, sweep, window);
                let unknowns = whole.unknowns(wide);
                let count = unknowns.len();
                let equations = |speed: f64, terms: usize| whole.equations(speed, terms, count);
                Middle::new(&equations, unknowns, sweep, stage, saw.is_conservative)
            }
        };
        let first = busy_s() - begun;
        let begun = busy_s();
        let intervals = middle.intervals(settings.intervals, sizes.1, terms, NODES);
        let reflected = saw.blocks.iter().map(|block| {
            let (squares, _) = block.waves(to);
            block.diameters as f64 * to - squares[0].max(0.0).sqrt()
        });
        Model {
            reflected: reflected.fold(0.0, f64::max),
            saw,
            intervals,
            window,
            middle: middle.size(),
            tail: middle.tail(),
            seconds: [columns, first, busy_s() - begun],
        }
    }

    fn at(&self, speed: f64) -> usize {
        let inside = |interval: &Interval| interval.from <= speed && speed <= interval.to;
        self.intervals.iter().position(inside).unwrap_or(0)
    }

    /// Highest frequency that the search follows: the whole window, or BANDS=1 times that of the reflected free waves.
    fn followed(&self) -> f64 {
        let share = from_environment("BANDS", 0.0);
        match share > 0.0 {
            true => (share * self.reflected).max(0.1 * self.window),
            false => self.window,
        }
    }

    fn searched(&self, rigid: usize, tolerance: f64) -> Vec<Searched> {
        let scope = Scope {
            window: self.followed(),
            reach: 1.8 * self.window,
            tolerance,
            noise_per_s: from_environment("NOISE", NOISE) * self.window,
            negligible: from_environment("NEGLIGIBLE", NEGLIGIBLE),
            rigid,
        };
        let of = |interval: &Interval| Searched::new(interval, scope);
        self.intervals.iter().map(of).collect()
    }
}

/// Processor time of this thread in s: other work on the machine does not count.
fn busy_s() -> f64 {
    let stat = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    let busy = stat
        .split_whitespace()
        .next()
        .and_then(|t| t.parse::<f64>().ok());
    1e-9 * busy.unwrap_or(f64::NAN)
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

/// Growth rates of oscillating and of divergent modes within a window, descending.
fn growing(values: &[c64], window: f64) -> [Vec<f64>; 2] {
    [true, false].map(|oscillates| {
        let mut growth: Vec<f64> = values
            .iter()
            .filter(|l| l.re > GROWS && l.norm() < window && (l.im > 1e-5 * window) == oscillates)
            .map(|l| l.re)
            .collect();
        growth.sort_by(|x, y| y.total_cmp(x));
        growth
    })
}

/// Whether two spectra have the same growing modes for one of three windows, so that one at the border does not count,
/// and the largest relative difference of growth.
fn same_growth(true_values: &[c64], found: &[c64], window: f64) -> Option<f64> {
    [0.9, 0.95, 1.0].iter().find_map(|share| {
        let [x, y] = [true_values, found].map(|v| growing(v, share * window));
        let counts = |v: &[Vec<f64>; 2]| [v[0].len(), v[1].len()];
        if counts(&x) != counts(&y) {
            return None;
        }
        let pairs = x.iter().flatten().zip(y.iter().flatten());
        Some(
            pairs
                .map(|(x, y)| (x - y).abs() / x.max(1.0))
                .fold(0.0, f64::max),
        )
    })
}

/// Numbers of one saw of a trial.
#[derive(Debug, Default, Clone)]
struct Outcome {
    sizes: Vec<usize>,
    strong: usize,
    rank: usize,
    worst: f64,
    low: f64,
    tail: f64,
    inertia: f64,
    speeds: usize,
    wrong_model: Vec<f64>,
    wrong_pieces: Vec<f64>,
    growth: f64,
    /// True error over its estimate.
    ratios: Vec<f64>,
    eigenproblems: usize,
    lost: f64,
    seconds: [f64; 4],
    /// Unknowns after stage one.
    middle: usize,
    /// Highest frequency followed, in windows.
    followed: f64,
}

impl Outcome {
    fn print(&self, name: &str, e: f64) {
        let mut ratios = self.ratios.clone();
        ratios.sort_by(f64::total_cmp);
        let at = |share: f64| {
            let last = ratios.len().saturating_sub(1);
            ratios
                .get((share * last as f64) as usize)
                .copied()
                .unwrap_or(f64::NAN)
        };
        let stage = |k: usize| self.seconds[k] / e;
        println!(
            "{name:20} m {:?} ({} strong) r {:3} of {:3} tail {:.0e} M {:8.2} | worst {:.1e} low {:.1e} | wrong {} model, {} pieces of {} | growth {:.0e} | true/est {:.2} (max {:.1}) | top {:.2}: eig {} lost {:.0e} | E: columns {:.2} stage one {:.2} intervals {:.2} search {:.2}",
            self.sizes,
            self.strong,
            self.rank,
            self.middle,
            self.tail,
            self.inertia,
            self.worst,
            self.low,
            self.wrong_model.len(),
            self.wrong_pieces.len(),
            self.speeds,
            self.growth,
            at(0.5),
            at(1.0),
            self.followed,
            self.eigenproblems,
            self.lost,
            stage(0),
            stage(1),
            stage(2),
            stage(3),
        );
        let told = |what: &str, speeds: &[f64]| {
            if !speeds.is_empty() {
                let speeds: Vec<String> =
                    speeds.iter().map(|s| format!("{:.1}", rpm(*s))).collect();
                println!("    {what} wrong at {} rpm", speeds.join(", "));
            }
        };
        told("model", &self.wrong_model);
        told("pieces", &self.wrong_pieces);
    }
}

/// Compares a saw with all its eigenvalues at a few speeds of a range.
fn compared(
    plate: &Plate,
    range: (f64, f64),
    settings: Settings,
    checks: usize,
    with_search: bool,
) -> Outcome {
    let model = Model::new(plate, range, settings, true);
    let mut outcome = Outcome {
        sizes: model.intervals.iter().map(|i| i.size).collect(),
        strong: model.intervals.iter().map(|i| i.strong).max().unwrap_or(0),
        rank: model.saw.rank(),
        followed: model.followed() / model.window,
        tail: model
            .intervals
            .iter()
            .map(Interval::tail)
            .fold(0.0, f64::max),
        inertia: f64::INFINITY,
        middle: model.middle,
        seconds: [model.seconds[0], model.seconds[1], model.seconds[2], 0.0],
        ..Outcome::default()
    };
    let system = GyroscopicSystem::of_plate(plate);
    let begun = busy_s();
    let searched = match with_search {
        true => model.searched(
            system.free_rigid.len(),
            from_environment("TOLERANCE", TOLERANCE),
        ),
        false => Vec::new(),
    };
    outcome.seconds[3] = busy_s() - begun;
    outcome.eigenproblems = searched.iter().map(|s| s.eigenproblems).sum();
    outcome.lost = searched.iter().map(Searched::lost).sum::<f64>() / range.1;
    let window = model.window;
    for k in 0..checks {
        let speed = range.0 + (range.1 - range.0) * (k as f64 + 0.63) / checks as f64;
        let place = model.at(speed);
        let interval = &model.intervals[place];
        outcome.inertia = outcome.inertia.min(interval.least_inertia(speed));
        let all = dense(&system, speed, window);
        let roots = interval.roots(speed, settings.cut * window);
        let values: Vec<c64> = roots.iter().map(|r| r.lambda).collect();
        let nearest = |values: &[c64], x: c64| {
            values
                .iter()
                .map(|v| (v - x).norm())
                .fold(f64::INFINITY, f64::min)
        };
        for lambda in all.iter().filter(|l| l.norm() < window) {
            let error = nearest(&values, *lambda) / window;
            outcome.worst = outcome.worst.max(error);
            if lambda.norm() < 0.35 * window {
                outcome.low = outcome.low.max(error);
            }
        }
        for Root { lambda, error, .. } in roots.iter().filter(|r| r.lambda.norm() < 0.97 * window) {
            let truth = nearest(&all, *lambda);
            if truth > 1e-6 * window {
                outcome.ratios.push(truth / error.norm());
            }
        }
        outcome.speeds += 1;
        if same_growth(&all, &values, window).is_none() {
            outcome.wrong_model.push(speed);
        }
        if let Some(searched) = searched.get(place) {
            match same_growth(&all, &searched.eigenvalues(speed), model.followed()) {
                Some(off) => outcome.growth = outcome.growth.max(off),
                None => outcome.wrong_pieces.push(speed),
            }
        }
    }
    outcome
}

fn valid(file: &SceneFile) -> Scene {
    Scene::try_from(file.clone()).expect("a valid scene")
}

/// End of the sweep of a scene, in rad/s: its own, or 1.9 times the lowest critical speed of its small basis.
fn end(scene: &Scene) -> f64 {
    scene.sweep().map_or_else(
        || {
            let plate = Plate::new(scene, SMALL).conservative();
            let critical = sawflutter::spectrum::SpectralModel::critical_speeds(&plate);
            1.9 * critical.expect("critical speeds")[0].speed_rad_per_s
        },
        |sweep| sweep.to_rad_per_s,
    )
}

/// Settings of the trial of loads at the rim, the most accurate first.
fn load_settings() -> Vec<(&'static str, Settings)> {
    let dense = |wide: f64, nodes: usize| Settings {
        wide,
        nodes,
        ..USUAL
    };
    let by_columns = |columns: f64| Settings {
        columns,
        loads_by_columns: true,
        ..USUAL
    };
    vec![
        ("8 windows, 12 nodes", dense(8.0, 12)),
        ("4 windows, 8 nodes", dense(4.0, 8)),
        ("4 windows, 6 nodes", dense(4.0, 6)),
        ("4 windows, 5 nodes", dense(4.0, 5)),
        ("4 windows, 4 nodes", dense(4.0, 4)),
        ("columns 1e-2", by_columns(1e-2)),
        ("columns 1e-3", by_columns(1e-3)),
    ]
}

/// Times of the set-up with loads at the rim, and differences from the dense elimination in windows.
fn loads(word: &str, resolution: Resolution, e: f64) {
    let all = scenes::named();
    let (name, file) = all
        .iter()
        .find(|(name, _)| *name == word)
        .expect("a named scene");
    let scene = valid(file);
    let plate = Plate::new(&scene, resolution);
    let range = (0.0, end(&scene));
    println!("{name}, {} functions", plate.degrees_of_freedom());
    let speeds: Vec<f64> = (0..7)
        .map(|k| range.1 * (f64::from(k) + 0.37) / 7.0)
        .collect();
    let mut exact: Vec<Vec<c64>> = Vec::new();
    for (kind, settings) in load_settings() {
        let model = Model::new(&plate, range, settings, false);
        let values: Vec<Vec<c64>> = speeds
            .iter()
            .map(|speed| {
                let roots = model.intervals[model.at(*speed)].roots(*speed, 1.2 * model.window);
                roots.iter().map(|r| r.lambda).collect()
            })
            .collect();
        if exact.is_empty() {
            exact.clone_from(&values);
        }
        let (mut worst, mut low) = (0.0_f64, 0.0_f64);
        for (here, there) in exact.iter().zip(&values) {
            for x in here.iter().filter(|x| x.norm() < model.window) {
                let off = there
                    .iter()
                    .map(|v| (v - x).norm())
                    .fold(f64::INFINITY, f64::min);
                worst = worst.max(off / model.window);
                if x.norm() < 0.35 * model.window {
                    low = low.max(off / model.window);
                }
            }
        }
        let sizes: Vec<usize> = model.intervals.iter().map(|i| i.size).collect();
        let tail = model
            .intervals
            .iter()
            .map(Interval::tail)
            .fold(0.0, f64::max);
        println!(
            "    {kind:20} {} then m {sizes:?} tails {:.0e} {tail:.0e}: off {worst:.1e}, low {low:.1e}; E: columns {:.2}, stage one {:.2}, intervals {:.2}",
            model.middle,
            model.tail,
            model.seconds[0] / e,
            model.seconds[1] / e,
            model.seconds[2] / e
        );
    }
}

/// Times of the parts of one eigenproblem.
fn speeds(file: &SceneFile, e: f64) {
    let scene = valid(file);
    let plate = Plate::new(&scene, SMALL);
    let model = Model::new(&plate, (0.0, end(&scene)), USUAL, false);
    for interval in &model.intervals {
        let speed = 0.4 * interval.from + 0.6 * interval.to;
        let time = |work: &dyn Fn()| {
            let begun = busy_s();
            (0..300).for_each(|_| work());
            1e3 * (busy_s() - begun) / 300.0
        };
        println!(
            "m {}: series {:.3} ms, all of it {:.3} ms = {:.4} E",
            interval.size,
            time(&|| drop(std::hint::black_box(interval.at(speed)))),
            time(&|| drop(std::hint::black_box(
                interval.roots(speed, 1.8 * model.window)
            ))),
            1e-3 * time(&|| drop(std::hint::black_box(
                interval.roots(speed, 1.8 * model.window)
            ))) / e,
        );
    }
}

/// Error of a basis by the far sums of a larger one, beside the true change of each eigenvalue.
fn basis(file: &SceneFile, [small, large]: [Resolution; 2]) {
    let scene = valid(file);
    let range = (0.0, end(&scene));
    let window = 2.0 * range.1;
    let [plate, larger] = [small, large].map(|r| Plate::new(&scene, r));
    let [saw, more] = [&plate, &larger].map(|p| Saw::new(p, window, USUAL.columns, true));
    let same = saw.blocks.iter().zip(&more.blocks).map(|(x, y)| {
        let (x, y) = (&x.system.stiffness, &y.system.stiffness);
        let size = saw.blocks[0].radial;
        (x.get(..size, ..size) - y.get(..size, ..size)).norm_max() / x.norm_max()
    });
    println!("nested to {:.0e}", same.fold(0.0, f64::max));
    let count = USUAL.intervals;
    let mut ratios: Vec<(f64, f64)> = Vec::new();
    let begun = busy_s();
    let mut seconds = 0.0;
    for k in 0..count {
        let end = |k: usize| range.1 * k as f64 / count as f64;
        let (from, to) = (end(k), end(k + 1));
        let near = Near::new(&saw, (from, to), (window, USUAL.cut * window));
        let frame = Frame::new(&saw, &near, window);
        let wider = Frame::new(&more, &near.enlarged(&more), window);
        let own = Interval::of(
            &|s| frame.reduced(s, TERMS),
            (from, to),
            (frame.size(), NODES),
            window,
            TERMS,
        );
        let begun = busy_s();
        let other = Interval::of(
            &|s| wider.reduced(s, 3),
            (from, to),
            (frame.size(), NODES),
            window,
            3,
        );
        seconds += busy_s() - begun;
        let systems = [&plate, &larger].map(GyroscopicSystem::of_plate);
        for share in [0.2, 0.7] {
            let speed = from + share * (to - from);
            let [here, there] = systems.each_ref().map(|s| dense(s, speed, window));
            for (lambda, change) in own.changes(&other, speed, 0.5 * window) {
                let nearest = |all: &[c64]| {
                    let off =
                        |x: &&c64, y: &&c64| (*x - lambda).norm().total_cmp(&(*y - lambda).norm());
                    *all.iter().min_by(off).expect("values")
                };
                let truth = nearest(&here) - nearest(&there);
                ratios.push((truth.norm() / window, (change + truth).norm() / window));
            }
        }
    }
    let total = busy_s() - begun;
    ratios.sort_by(|x, y| x.0.total_cmp(&y.0));
    let largest = ratios.last().copied().unwrap_or_default();
    let relative: Vec<f64> = ratios
        .iter()
        .filter(|r| r.0 > 1e-6)
        .map(|r| r.1 / r.0)
        .collect();
    let mut sorted = relative.clone();
    sorted.sort_by(f64::total_cmp);
    println!(
        "{} to {} functions: largest change {:.1e} (missed by {:.1e}); of {} changes above 1e-6 the estimate misses {:.1e} in the median, {:.1e} at most; {:.3} s of {total:.1}",
        plate.degrees_of_freedom(),
        larger.degrees_of_freedom(),
        largest.0,
        largest.1,
        relative.len(),
        sorted.get(sorted.len() / 2).unwrap_or(&f64::NAN),
        sorted.last().unwrap_or(&f64::NAN),
        seconds,
    );
}

/// Times of a whole search in the basis that the program chooses, and its bands where growth differs.
fn program(name: &str, file: &SceneFile, settings: Settings, tolerance: f64, e: f64) {
    let scene = valid(file);
    let analysis = match Analysis::new(&scene) {
        Ok(analysis) => analysis,
        Err(error) => return println!("{name}: {error}"),
    };
    let plate = &analysis.model.plate;
    let range = analysis.range_rad_per_s;
    let model = Model::new(plate, range, settings, false);
    let begun = busy_s();
    let rigid = analysis.model.components[0].full.free_rigid.len();
    let searched = model.searched(rigid, tolerance);
    let seconds = busy_s() - begun;
    let bands: Vec<_> = analysis.chart.instabilities.iter().collect();
    let flutter: Vec<_> = bands
        .iter()
        .filter(|b| b.kind == InstabilityKind::Flutter)
        .collect();
    let highest = analysis.model.complete_to_rad_per_s.min(0.9 * model.window);
    let growing = |speed: f64, least: f64| {
        let values = searched[model.at(speed)].eigenvalues(speed);
        let grows = |l: &&c64| l.re > least && l.norm() < highest && l.im > 1e-5 * highest;
        values.iter().filter(grows).count()
    };
    // A damped saw has modes next to the axis, of which the least growth decides.
    let least = if plate.is_conservative() { 1e-3 } else { 1e-7 };
    let (mut wrong, mut edges) = (Vec::new(), Vec::new());
    let checked = 400;
    for k in 0..checked {
        let speed = range.0 + (range.1 - range.0) * (f64::from(k) + 0.4) / f64::from(checked);
        let covering = flutter
            .iter()
            .filter(|b| b.from_rad_per_s < speed && speed < b.to_rad_per_s);
        let (covering, few, most) = (
            covering.count(),
            growing(speed, GROWS),
            growing(speed, least),
        );
        if !(few..=most).contains(&covering) {
            wrong.push(format!(
                "{:.1} rpm: pieces {few} to {most}, bands {covering}",
                rpm(speed)
            ));
        }
    }
    for band in flutter
        .iter()
        .filter(|b| b.closed && b.peak_growth_per_s > GROWS)
    {
        for edge in [band.from_rad_per_s, band.to_rad_per_s] {
            let count = |speed: f64| growing(speed, least);
            let (mut low, mut high) = (edge - 0.1, edge + 0.1);
            let first = count(low);
            if first == count(high) {
                edges.push(f64::INFINITY);
                continue;
            }
            for _ in 0..40 {
                let middle = 0.5 * (low + high);
                if count(middle) == first {
                    low = middle
                } else {
                    high = middle
                }
            }
            edges.push(rpm((low - edge).abs()));
        }
    }
    let lost_edges = edges.iter().filter(|e| !e.is_finite()).count();
    let worst = edges
        .iter()
        .copied()
        .filter(|e| e.is_finite())
        .fold(0.0, f64::max);
    let sizes: Vec<usize> = model.intervals.iter().map(|i| i.size).collect();
    let eigenproblems: usize = searched.iter().map(|s| s.eigenproblems).sum();
    let pieces = searched.iter().flat_map(|s| s.pieces.iter().flatten());
    let width =
        |p: &sawflutter::stability::Piece| p.ends[1].speed_rad_per_s - p.ends[0].speed_rad_per_s;
    let narrow = pieces.clone().filter(|p| width(p) < 1e-3 * range.1).count();
    let pieces = pieces.count();
    let parts: Vec<usize> = searched.last().map_or(Vec::new(), |s| s.sizes.clone());
    let lost: f64 = searched.iter().map(Searched::lost).sum();
    println!(
        "{name:16} to {:.0} rpm, {} functions, {} bands: m {sizes:?} (last in parts {parts:?}) r {} | {eigenproblems} eigenproblems, {pieces} pieces, {narrow} of them narrow, lost {:.0e} | {} of {checked} speeds differ, {lost_edges} of {} edges, others within {worst:.0e} rpm | E: columns {:.2} stage one {:.2} of {} intervals {:.2} search {:.2}",
        rpm(range.1),
        plate.degrees_of_freedom(),
        bands.len(),
        model.saw.rank(),
        lost / range.1,
        wrong.len(),
        edges.len(),
        model.seconds[0] / e,
        model.seconds[1] / e,
        model.middle,
        model.seconds[2] / e,
        seconds / e,
    );
    wrong.iter().take(6).for_each(|line| println!("    {line}"));
}

/// Runs a trial by name: `named [WORD]`, `drawn FROM TO`, `damped COUNT`, `cut COUNT`.
pub fn run(trial: &str, rest: &[String]) {
    let e = 1e-3 * from_environment("E_MS", 100.0);
    let number = |k: usize, usual: usize| rest.get(k).and_then(|n| n.parse().ok()).unwrap_or(usual);
    let of = |name: &str, file: &SceneFile, checks: usize| {
        let scene = valid(file);
        let to = end(&scene);
        let plate = Plate::new(&scene, SMALL);
        compared(&plate, (0.0, to), USUAL, checks, true).print(name, e);
    };
    match trial {
        "named" => {
            let word = rest.first().cloned().unwrap_or_default();
            for (name, file) in scenes::named()
                .iter()
                .filter(|(name, _)| name.contains(&word))
            {
                of(name, file, 12);
            }
        }
        "drawn" => {
            for k in number(0, 0)..number(1, 30) {
                of(&format!("drawn {k}"), &scenes::drawn_saw(k as u64), 8);
            }
        }
        "damped" => {
            for (k, file) in scenes::damped_saws(number(0, 12)).iter().enumerate() {
                of(&format!("damped {k}"), file, 8);
            }
        }
        "cut" => {
            let saws = (0..).filter_map(|k| Some((k, scenes::drawn_saw_in_cut(k)?)));
            for (k, file) in saws.take(number(0, 8)) {
                of(&format!("cut {k}"), &file, 8);
            }
        }
        "loads" => {
            let word = rest.first().map_or("cut", String::as_str);
            let resolution = Resolution {
                max_diameters: number(1, 16),
                radial_functions: number(2, 8),
            };
            loads(word, resolution, e);
        }
        "speeds" => {
            for (name, file) in scenes::named() {
                if ["pad", "pad c 50"].contains(&name) {
                    speeds(&file, e);
                }
            }
        }
        "basis" => {
            let of = |max_diameters: usize, radial_functions: usize| Resolution {
                max_diameters,
                radial_functions,
            };
            for (name, file) in scenes::named().iter().take(2) {
                println!("{name}");
                basis(file, [of(8, 5), of(12, 7)]);
                basis(file, [of(8, 5), of(12, 8)]);
                basis(file, [of(12, 7), of(16, 10)]);
            }
        }
        "program" => {
            let tolerance = rest
                .get(1)
                .and_then(|t| t.parse().ok())
                .unwrap_or(TOLERANCE);
            let intervals = number(2, USUAL.intervals);
            let settings = Settings {
                intervals,
                cut: from_environment("CUT", USUAL.cut),
                columns: from_environment("COLUMNS", USUAL.columns),
                wide: from_environment("WIDE", USUAL.wide),
                ..USUAL
            };
            for name in rest.first().map_or("", String::as_str).split(',') {
                program(name, &scenes::read(name), settings, tolerance, e);
            }
        }
        "fast" => {
            let mut file = scenes::named()[0].1.clone();
            file.sweep = Some(SweepFile {
                from_rpm: 0.0,
                to_rpm: number(0, 8000) as f64,
            });
            let settings = Settings {
                intervals: number(1, 12),
                cut: from_environment("CUT", USUAL.cut),
                ..USUAL
            };
            let plate = Plate::new(
                &valid(&file),
                Resolution {
                    max_diameters: 26,
                    radial_functions: 5,
                },
            );
            let to = sawflutter::scene::rad_per_s(number(0, 8000) as f64);
            compared(&plate, (0.0, to), settings, number(2, 8), true).print("fast", e);
        }
        _ => println!(
            "trials: named [WORD], drawn FROM TO, damped COUNT, cut COUNT, loads SCENE N J, speeds, basis, program SCENES TOLERANCE INTERVALS, fast RPM INTERVALS CHECKS"
        ),
    }
}
