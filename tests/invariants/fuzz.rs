//! Goal: no scene makes the program panic, hang, or report a NaN.
//!
//! The version of `fuzz/` for the stable toolchain: scenes from random bytes, the same in every run;
//! `tests/trials/fuzz.rs` continues the sequence.

use proptest::prelude::Rng;
use rayon::prelude::*;
use sawflutter::model::scene::{Scene, SceneFile};

use crate::draw;
use crate::survivors::{Keys, assert_survives, rng, sawing_scenes, scenes};

#[test]
fn drawn_scenes_on_a_small_basis() {
    let drawn = scenes(2000, Keys::All);
    println!("{} of 2000 are valid", drawn.len());
    assert!(drawn.len() > 300, "the draw tests nothing: {}", drawn.len());
    drawn
        .par_iter()
        .for_each(|scene| assert_survives(scene, draw::survives_two_speeds));
    scenes(100, Keys::Plain)[..10]
        .par_iter()
        .for_each(|scene| assert_survives(scene, draw::survives_chart));
}

#[test]
fn drawn_scenes_analyzed_in_full() {
    let scenes = scenes(40, Keys::Plain);
    let survives = |scene| assert_survives(scene, draw::survives_analysis);
    let charted = scenes.par_iter().take(2).filter(|s| survives(s)).count();
    println!("{charted} of 2 are charted, the others refused");
    assert!(charted > 0);
}

#[test]
fn washboarding_of_drawn_saws() {
    let scenes = sawing_scenes(60);
    let survives = |scene| assert_survives(scene, draw::survives_washboard);
    let looked_at = scenes.par_iter().take(4).filter(|s| survives(s)).count();
    println!("{looked_at} of 4 are looked at, the others refused");
    assert!(looked_at > 0);
}

/// The text of a scene, damaged: bytes exchanged, removed, doubled; numbers replaced by others. The reader refuses it
/// or reads a scene.
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
            // A scene that was read can be written and read again.
            let again: SceneFile =
                serde_json::from_str(&serde_json::to_string(scene.file()).unwrap()).unwrap();
            assert_eq!(again, *scene.file());
        }
    }
    println!("{read} of 30000 are still scenes");
    assert!((100..29_000).contains(&read), "{read}");
}

/// Deeply nested or endless text is refused before it exhausts the stack or the memory.
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
