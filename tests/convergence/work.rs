//! Goal: a loss of speed makes a test fail. Times depend on the machine; the number and size of the eigenproblems of a
//! chart do not.
//!
//! The limits are 20 % above the counts of the chart of the paper's saw when they were written.

use std::sync::LazyLock;

use sawflutter::analyses::campbell::{Report, SolveCounts};
use sawflutter::model::scene::{Accuracy, GuideArmFile, Scene, SweepFile};
use sawflutter::stability::Analysis;

fn analysis(accuracy: Accuracy, to_rpm: f64) -> (Scene, Analysis) {
    let scene = Scene::paper()
        .edited(|saw| {
            saw.accuracy = accuracy;
            let from_rpm = 0.0;
            saw.sweep = Some(SweepFile { from_rpm, to_rpm });
        })
        .unwrap();
    let analysis = Analysis::new(&scene).unwrap();
    (scene, analysis)
}

fn report(accuracy: Accuracy) -> Report {
    let (_, analysis) = analysis(accuracy, 3000.0);
    analysis.report()
}

/// Work of the chart of the paper's saw at `design`.
static DESIGN: LazyLock<SolveCounts> = LazyLock::new(|| report(Accuracy::Design).work);

#[test]
fn a_chart_takes_no_more_work_than_it_took() {
    let work = &*DESIGN;
    println!("{work:?}");
    assert!(work.full_solves <= 3, "{work:?}");
    assert_eq!(work.reduced_solves, 0, "{work:?}");
    assert!(work.refined_pairs <= 206, "{work:?}");
    assert!(work.local_solves <= 277, "{work:?}");
    assert!(work.full_solves > 0 && work.local_solves > 0, "{work:?}");
}

/// Guides lead to blocks and few columns, edge loads couple every wave with every other, and dampers lead to
/// eigenvalues without mirror images: the report names the method.
#[test]
fn the_report_says_how_many_solves_went_by_the_structure_of_the_matrices() {
    let guided = &*DESIGN;
    println!("{guided:?}");
    assert_eq!(guided.structured_solves, guided.full_solves);
    let changed = |change: fn(&mut sawflutter::model::scene::SceneFile)| {
        let scene = Scene::paper().edited(change).unwrap();
        Analysis::new(&scene).unwrap().report().work
    };
    let in_cut = changed(|saw| saw.cut.as_mut().unwrap().chart_rpm = Some(2800.0));
    assert!(
        in_cut.full_solves > 0 && in_cut.structured_solves == 0,
        "{in_cut:?}"
    );
    let damped = changed(|saw| {
        saw.guides[0].damping_n_s_per_m = 5.0;
        saw.sweep.as_mut().unwrap().to_rpm = 1600.0;
    });
    assert!(damped.structured_solves < damped.full_solves, "{damped:?}");
}

/// A damper on the arm of a pad moves little in some waves, whose decay is rounding. The search does not follow this rounding, which took
/// it from 350 to 8600 eigenproblems.
#[test]
fn a_search_does_not_follow_the_rounding_of_a_decay() {
    let scene = Scene::paper().edited(|saw| {
        saw.guides[0].arm = Some(GuideArmFile {
            stiffness_n_per_m: 2e7,
            mass_kg: 5.0,
            damping_n_s_per_m: 0.0,
            loss_factor: 0.05,
        });
    });
    let work = Analysis::new(&scene.unwrap()).unwrap().report().work;
    println!("{work:?}");
    assert!(work.local_solves <= 420, "{work:?}");
}

/// More functions need the same number of eigenproblems; only the few of the full model are larger. At `reference` the
/// listed modes are refined: those at rest and those at the peaks of eleven bands.
#[test]
fn work_hardly_depends_on_the_accuracy() {
    let [draft, reference] = [Accuracy::Draft, Accuracy::Reference].map(|a| report(a).work);
    println!("{draft:?} {reference:?}");
    assert!(reference.full_solves <= draft.full_solves + 4);
    assert!(reference.local_solves <= 2 * draft.local_solves);
    assert!(reference.reduced_solves <= draft.reduced_solves + 12);
}

/// Below the first critical speed no wave is reflected, and no band is searched for.
#[test]
fn a_slow_saw_takes_less_work() {
    let (_, analysis) = analysis(Accuracy::Design, 1400.0);
    assert!(analysis.bands().is_empty());
    assert!(analysis.chart.certificate.speeds_checked > 0);
    let work = analysis.report().work;
    println!("{work:?}");
    assert_eq!(work.refined_pairs, 0);
    assert!(work.full_solves <= 3 && work.local_solves <= 80, "{work:?}");
}

/// Counts depend on the work and not on the threads that do it.
#[test]
fn the_report_does_not_depend_on_the_threads() {
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| report(Accuracy::Draft))
    };
    assert!(on(1) == on(2));
}
