//! Scenes of random bytes, many more than a daily test can take.

use crate::draw;
use crate::survivors::{Keys, assert_survives, sawing_scenes, scenes};
use crate::trial::{Trial, mine};
use sawflutter::model::scene::Scene;

/// Tries the scenes, and counts those that are not refused.
fn survive(name: &'static str, scenes: Vec<Scene>, survives: impl Fn(&Scene) -> bool) {
    let mut trial = Trial::new(name);
    let mut done = 0;
    for (k, scene) in mine(scenes.into_iter().enumerate()) {
        trial.saw(&format!("scene {k}"), || {
            done += usize::from(assert_survives(&scene, &survives));
            Vec::new()
        });
    }
    assert!(done > 0, "{name}: all are refused");
    trial.end();
}

#[test]
#[ignore = "a trial"]
fn ten_thousand_scenes_with_all_keys_at_two_speeds() {
    let mut trial = Trial::new("two speeds of 10000 drawn scenes");
    let scenes = scenes(10_000, Keys::All);
    for (k, part) in mine(scenes.chunks(500).enumerate()) {
        trial.saw(&format!("{} scenes from {}", part.len(), 500 * k), || {
            part.iter()
                .for_each(|scene| assert_survives(scene, draw::survives_two_speeds));
            Vec::new()
        });
    }
    trial.end();
}

#[test]
#[ignore = "a trial"]
fn a_hundred_and_fifty_charts_on_a_small_basis() {
    let scenes = scenes(1500, Keys::Plain).into_iter().take(150).collect();
    survive("charts of drawn scenes", scenes, |scene| {
        draw::survives_chart(scene);
        true
    });
}

#[test]
#[ignore = "a trial"]
fn twenty_four_analyses() {
    let scenes = scenes(160, Keys::Plain).into_iter().take(24).collect();
    survive("analyses of drawn scenes", scenes, draw::survives_analysis);
}

#[test]
#[ignore = "a trial"]
fn sixty_four_analyses_of_washboarding() {
    let scenes = sawing_scenes(600).into_iter().take(64).collect();
    survive(
        "washboarding of drawn scenes",
        scenes,
        draw::survives_washboard,
    );
}
