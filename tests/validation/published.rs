//! Goal: the program gives the published numbers of other programs and tables, within the digits of their sources, and
//! the published rules of flutter and divergence.
//!
//! Sources: tests/reference/published.csv, and the notes of the scenes in tests/reference/published/.

use serde::Deserialize;

use sawflutter::analyses::campbell::{InstabilityKind, Report};
use sawflutter::model::scene::{Accuracy, Scene, SceneFile, rad_per_s};
use sawflutter::modes::{Direction, Mode, ModeKind};
use sawflutter::stability::Analysis;

use crate::common::{of_diameters, reference_model, relative_error};

fn published(name: &str, change: impl FnOnce(&mut SceneFile)) -> Scene {
    let file = crate::common::path(&format!("tests/reference/published/{name}.json"));
    let scene = Scene::from_path(file).unwrap_or_else(|error| panic!("{error}"));
    scene.edited(change).unwrap()
}

/// A published frequency at rest.
#[derive(Debug, Deserialize)]
struct Published {
    scene: String,
    quantity: String,
    n: usize,
    s: usize,
    value: f64,
    tolerance: f64,
    exact_lambda2: f64,
}

/// Bound of the distance from the exact roots, which for the disk are those without its bore of a two-hundredth of the radius.
const EXACT: f64 = 1e-4;

/// Each row has its own tolerance: the sources print three digits of λ², or frequencies that follow from these, and are off
/// the exact roots by up to half a percent. The program is not.
#[test]
fn frequencies_at_rest_are_those_of_other_programs_and_tables() {
    let rows: Vec<Published> = crate::common::table("published.csv");
    let mut compared = 0;
    for rows in rows.chunk_by(|x, y| x.scene == y.scene) {
        let scene = published(&rows[0].scene, |_| ());
        let model = reference_model(&scene, rad_per_s(1000.0));
        let modes = model.all_modes(0.0).unwrap();
        let blade = scene.blade();
        let unit = (blade.flexural_rigidity_n_m() / blade.mass_per_area_kg_per_m2()).sqrt()
            / blade.outer_radius_m.powi(2);
        for row in rows {
            // A rigid motion has no nodal circle, and each wave with nodal diameters occurs twice.
            let is_rigid = |mode: &&Mode| mode.kind == ModeKind::Rigid;
            let rigid = usize::from(of_diameters(&modes, row.n).any(|mode| is_rigid(&mode)));
            let twice = if row.n == 0 { 1 } else { 2 };
            let mut elastic = of_diameters(&modes, row.n).filter(|mode| !is_rigid(mode));
            let mode = elastic.nth(twice * (row.s - rigid)).unwrap();
            let omega = mode.frequency_rad_per_s();
            let found = match row.quantity.as_str() {
                "frequency_hz" => omega / std::f64::consts::TAU,
                "lambda2" => omega / unit,
                other => panic!("unknown quantity {other}"),
            };
            let error = relative_error(found, row.value);
            println!("{row:?}: {found:.4}, {error:.1e}");
            assert!(error <= row.tolerance, "{row:?}: {found} {error:e}");
            let exact = relative_error(omega / unit, row.exact_lambda2);
            assert!(exact <= EXACT, "{row:?}: {} {exact:e}", omega / unit);
            compared += 1;
        }
    }
    assert_eq!(compared, 23);
}

fn report(scene: &Scene) -> Report {
    Analysis::new(scene).unwrap().report()
}

/// Number of nodal diameters of each wave in "3 diameters, reflected" or "3 (52 %) + 2 (41 %), reflected".
fn diameters(waves: &str) -> Vec<i64> {
    let (shares, _) = waves.split_once(',').unwrap_or((waves, ""));
    let first = |term: &str| term.split([' ', '/']).next().unwrap().parse().unwrap();
    shares.split(" + ").map(first).collect()
}

/// Five springs: the critical speeds of n = 5 split, those of all other n are double; a reflected wave of n diameters
/// coalesces with a forward one of m where n − m, and with a backward one where n + m is a multiple of five.
#[test]
fn five_equal_springs_split_and_couple_the_waves_of_chens_rules() {
    let report = report(&published("chen-equal-springs", |_| ()));
    let critical = &report.critical_speeds;
    let mut split = Vec::new();
    for pair in critical.chunks(2) {
        let [first, second] = pair else { continue };
        assert_eq!(first.nodal_diameters, second.nodal_diameters);
        if relative_error(first.rpm, second.rpm) > 1e-6 {
            split.push(first.nodal_diameters);
        }
    }
    assert_eq!(split, [5]);
    let mut flutter = 0;
    for band in &report.instabilities {
        let [reflected, other] = &band.modes[..] else {
            assert_eq!(band.kind, InstabilityKind::Divergence);
            assert_eq!(diameters(&band.modes[0]), [5]);
            continue;
        };
        for n in diameters(reflected) {
            for m in diameters(other) {
                let allowed = match other {
                    other if other.ends_with("forward") => (n - m) % 5 == 0,
                    other if other.ends_with("backward") => (n + m) % 5 == 0,
                    _ => (n - m) % 5 == 0 || (n + m) % 5 == 0,
                };
                assert!(allowed, "{reflected} with {other}");
            }
        }
        flutter += 1;
    }
    assert!(flutter > 0, "{:?}", report.instabilities);
}

/// A compressive load at the rim lowers the frequencies of forward and backward waves and raises those of reflected ones.
/// Divergence begins below each critical speed of the idling saw, and waves coalesce above the lowest.
#[test]
fn a_compressive_edge_load_moves_frequencies_and_bands_as_chen_found() {
    let change = |file: &mut SceneFile| file.accuracy = Accuracy::Draft;
    let loaded = Analysis::new(&published("chen-edge-load", change)).unwrap();
    let unloaded = published("chen-edge-load", |file| {
        change(file);
        file.cut = None;
    });
    let idling = Analysis::new(&unloaded).unwrap();
    let frequency = |analysis: &Analysis, rpm: f64, n: usize, direction: Direction| {
        let speed = rad_per_s(rpm);
        let modes = analysis.model.modes(speed).unwrap();
        let described = analysis.model.describe(speed, modes).into_iter();
        let mut of_wave = described.filter(|described| {
            let name = &described.name;
            (name.diameters, name.circles, name.direction) == (n, 0, direction)
        });
        let found = of_wave.next().map(|found| found.mode.frequency_rad_per_s());
        found.unwrap_or_else(|| panic!("{n} {direction:?} at {rpm} rpm"))
    };
    let cases = [1, 2, 3].into_iter().flat_map(|n| {
        [Direction::Backward, Direction::Forward].map(|direction| (2960.0, n, direction, -1.0))
    });
    let reflected = [2, 3, 4].map(|n| (5600.0, n, Direction::Reflected, 1.0));
    for (rpm, n, direction, sign) in cases.chain(reflected) {
        let [with, without] = [&loaded, &idling].map(|a| frequency(a, rpm, n, direction));
        assert!(
            sign * (with - without) > 0.0,
            "{n} {direction:?}: {with} {without}"
        );
    }
    let (loaded, idling) = (loaded.report(), idling.report());
    let lowest = idling.critical_speeds[0].rpm;
    let begins = |kind: InstabilityKind| {
        let mut bands = loaded.instabilities.iter();
        bands.find(|band| band.kind == kind).unwrap().from_rpm
    };
    let (divergence, flutter) = (
        begins(InstabilityKind::Divergence),
        begins(InstabilityKind::Flutter),
    );
    println!("{divergence} < {lowest} < {flutter} rpm");
    assert!(divergence < lowest && lowest < flutter);
}

/// A maker's largest speed is at most the first critical speed of the plate between its collars, and not much less: with
/// the usual rule it is 0.85 of it. Teeth and expansion slots are not in the model.
#[test]
fn the_largest_speed_of_a_maker_is_near_the_usual_limit() {
    let report = report(&published("tenryu-305", |_| ()));
    let share = report.operating.unwrap().of_first_critical.unwrap();
    println!("6900 rpm is {share:.3} of the first critical speed");
    assert!((0.75..1.0).contains(&share), "{share}");
}
