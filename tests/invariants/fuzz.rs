//! Goal: no scene makes the program panic, hang, or report what is no number.
//!
//! The stable-toolchain version of `fuzz/`: the same scenes from drawn bytes, the same in
//! every run.

use std::panic::{AssertUnwindSafe, catch_unwind};

use crate::draw::{self, Bytes};
use proptest::prelude::Rng;
use proptest::test_runner::{RngAlgorithm, TestRng};
use rayon::prelude::*;
use sawflutter::scene::{CutFile, Scene, SceneFile};

fn drawn(rng: &mut TestRng, length: usize) -> Vec<u8> {
    let mut bytes = vec![0; length];
    rng.fill_bytes(&mut bytes);
    bytes
}

fn rng() -> TestRng {
    TestRng::deterministic_rng(RngAlgorithm::ChaCha)
}

/// Enough bytes for every number of a scene with three pads, steps, teeth, gaps, a cut and lines.
const SCENE_BYTES: usize = 260;

/// Scenes charted on the small basis, and drawn for a full analysis: as many as a minute allows.
const CHARTED: usize = 150;
const ANALYZED: usize = 8;
const WASHBOARDED: usize = 16;

/// How much of a scene is drawn.
#[derive(Clone, Copy, PartialEq)]
enum Keys {
    /// Blade, guides, damping and speeds.
    Plain,
    /// Steps, teeth, gaps, turning air, cuts with wood and lines of excitation besides. Steps take so many functions
    /// that a chart of each is beyond a test's time.
    All,
}

/// Valid scenes among the first `count` drawn ones.
fn scenes(count: usize, keys: Keys) -> Vec<Scene> {
    let mut rng = rng();
    let files = (0..count).map(|_| {
        let bytes = drawn(&mut rng, SCENE_BYTES);
        let mut bytes = Bytes(&bytes);
        let file = draw::scene_file(&mut bytes);
        match keys {
            Keys::Plain => file,
            Keys::All => draw::with_details(&mut bytes, file),
        }
    });
    files
        .filter_map(|file| Scene::try_from(file).ok())
        .collect()
}

/// Fails with the scene that brought it down.
fn assert_survives(scene: &Scene, survives: impl Fn(&Scene)) {
    if catch_unwind(AssertUnwindSafe(|| survives(scene))).is_err() {
        panic!(
            "brought down by {}",
            serde_json::to_string(scene.file()).unwrap()
        );
    }
}

#[test]
fn drawn_scenes_on_a_small_basis() {
    let drawn = scenes(10_000, Keys::All);
    println!("{} of 10000 are valid", drawn.len());
    assert!(
        drawn.len() > 3000,
        "the draw tests nothing: {}",
        drawn.len()
    );
    drawn
        .par_iter()
        .for_each(|scene| assert_survives(scene, draw::survives_two_speeds));
    scenes(10 * CHARTED, Keys::Plain)[..CHARTED]
        .par_iter()
        .for_each(|scene| assert_survives(scene, draw::survives_chart));
}

#[test]
fn drawn_scenes_analyzed_in_full() {
    let done: Vec<bool> = scenes(20 * ANALYZED, Keys::Plain)
        .par_iter()
        .take(ANALYZED)
        .map(|scene| {
            let charted = std::sync::atomic::AtomicBool::new(false);
            assert_survives(scene, |scene| {
                charted.store(
                    draw::survives_analysis(scene),
                    std::sync::atomic::Ordering::Relaxed,
                );
            });
            charted.into_inner()
        })
        .collect();
    let charted = done.iter().filter(|done| **done).count();
    println!(
        "{charted} of {} are charted, the others refused",
        done.len()
    );
    assert!(2 * charted > done.len());
}

/// A look at washboarding is as long as a chart: saws that are damped and held, and are cut with.
#[test]
fn drawn_saws_that_washboard_or_not() {
    let mut rng = rng();
    let draw = |rng: &mut TestRng| {
        let bytes = drawn(rng, SCENE_BYTES);
        let mut bytes = Bytes(&bytes);
        let file = draw::scene_file(&mut bytes);
        let mut file = draw::with_details(&mut bytes, file);
        file.blade.teeth = Some(24);
        file.operating_rpm = Some(1200.0);
        // Thinner ones have thousands of modes below tooth passing.
        let width = file.blade.outer_diameter_m - file.blade.inner_diameter_m;
        file.blade.thickness_m = file.blade.thickness_m.max(5e-3 * width);
        file.sweep = None;
        let damping = file.damping.get_or_insert_default();
        damping.material_retardation_time_s = damping.material_retardation_time_s.max(1e-6);
        file.cut.get_or_insert_with(|| CutFile {
            teeth_in_cut: Some(3),
            tangential_n_per_tooth: Some(1.0),
            ..CutFile::default()
        });
        let cut = file.cut.as_mut().expect("a cut");
        cut.washboarding = Some(draw::washboarding(&mut bytes));
        Scene::try_from(file).ok()
    };
    let all = (0..20 * ANALYZED).map(|_| draw(&mut rng));
    let scenes: Vec<Scene> = all.collect::<Vec<_>>().into_iter().flatten().collect();
    let done: Vec<bool> = scenes
        .par_iter()
        .take(WASHBOARDED)
        .map(|scene| {
            let done = std::sync::atomic::AtomicBool::new(false);
            assert_survives(scene, |scene| {
                done.store(
                    draw::survives_washboard(scene),
                    std::sync::atomic::Ordering::Relaxed,
                );
            });
            done.into_inner()
        })
        .collect();
    let looked_at = done.iter().filter(|done| **done).count();
    println!(
        "{looked_at} of {} are looked at, the others refused",
        done.len()
    );
    assert!(looked_at > 4, "{looked_at}");
}

/// The text of a scene, damaged: bytes exchanged, cut out, doubled; numbers exchanged for
/// others. The reader refuses it or makes a scene of it.
#[test]
fn damaged_scene_files_are_read_or_refused() {
    let texts: Vec<String> = ["paper", "free-blade", "collar-400mm", "two-pads"]
        .iter()
        .map(|name| {
            let folder = env!("CARGO_MANIFEST_DIR");
            std::fs::read_to_string(format!("{folder}/scenes/{name}.json")).unwrap()
        })
        .collect();
    let tokens = [
        "1e999", "-0", "null", "NaN", "{}", "[]", "\"\"", "true", "1e-400", "9e15", "}", ",", ":",
    ];
    let mut rng = rng();
    let mut read = 0;
    for _ in 0..30_000 {
        let mut text = texts[rng.next_u32() as usize % texts.len()]
            .clone()
            .into_bytes();
        for _ in 0..1 + rng.next_u32() % 4 {
            let at = rng.next_u32() as usize % text.len();
            let end = (at + rng.next_u32() as usize % 8).min(text.len());
            let token = tokens[rng.next_u32() as usize % tokens.len()].as_bytes();
            match rng.next_u32() % 4 {
                0 => text[at] = (rng.next_u32() & 0xff) as u8,
                1 => drop(text.drain(at..end)),
                2 => drop(text.splice(at..end, token.iter().copied())),
                _ => {
                    let doubled = text[at..end].to_vec();
                    text.splice(at..at, doubled);
                }
            }
            if text.is_empty() {
                break;
            }
        }
        let text = String::from_utf8_lossy(&text);
        if let Ok(scene) = Scene::from_json(&text) {
            read += 1;
            // What was read can be written and read again.
            let again: SceneFile =
                serde_json::from_str(&serde_json::to_string(scene.file()).unwrap()).unwrap();
            assert_eq!(again, *scene.file());
        }
    }
    println!("{read} of 30000 are still scenes");
    assert!((100..29_000).contains(&read), "{read}");
}

/// Deeply nested or endless text is refused before it takes the stack or the memory.
#[test]
fn hostile_texts_are_refused() {
    for text in [
        "[".repeat(200_000),
        "{\"name\":".repeat(100_000),
        "9".repeat(1 << 19),
    ] {
        assert!(Scene::from_json(&text).is_err());
    }
}
