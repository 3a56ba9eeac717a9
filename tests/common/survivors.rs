//! Scenes from random bytes, the same in every run, and a check that the program computes or refuses each of them.
#![allow(dead_code)]

use std::panic::{AssertUnwindSafe, catch_unwind};

use proptest::prelude::Rng;
use proptest::test_runner::{RngAlgorithm, TestRng};
use sawflutter::model::scene::{CutFile, Scene};

use crate::common::limit::Limit;
use crate::draw::{self, Bytes};

/// Enough bytes for every number of a scene with three pads, steps, teeth, gaps, a cut and lines.
const SCENE_BYTES: usize = 260;

/// A limit a hundred times longer than a saw takes.
const SECONDS_A_SCENE: u64 = 600;

fn drawn(rng: &mut TestRng) -> Vec<u8> {
    let mut bytes = vec![0; SCENE_BYTES];
    rng.fill_bytes(&mut bytes);
    bytes
}

pub fn rng() -> TestRng {
    TestRng::deterministic_rng(RngAlgorithm::ChaCha)
}

/// The extent to which a scene is random.
#[derive(Clone, Copy, PartialEq)]
pub enum Keys {
    /// Blade, guides, damping and speeds.
    Plain,
    /// Also steps, teeth, gaps, rotating air, cuts with wood and lines of excitation. Steps need so many basis
    /// functions that a chart of each scene would take too long for a test.
    All,
}

/// Valid scenes among the first `count` random ones.
pub fn scenes(count: usize, keys: Keys) -> Vec<Scene> {
    let mut rng = rng();
    let files = (0..count).map(|_| {
        let drawn_bytes = drawn(&mut rng);
        let mut bytes = Bytes(&drawn_bytes);
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

/// Valid scenes with a cut, damping and guides. An analysis of washboarding takes as long as a chart.
pub fn sawing_scenes(count: usize) -> Vec<Scene> {
    let mut rng = rng();
    let files = (0..count).map(|_| {
        let drawn_bytes = drawn(&mut rng);
        let mut bytes = Bytes(&drawn_bytes);
        let plain = draw::scene_file(&mut bytes);
        let mut file = draw::with_details(&mut bytes, plain);
        file.blade.teeth = Some(24);
        file.operating_rpm = Some(1200.0);
        // Thinner blades have thousands of modes below the tooth passing frequency.
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
        file
    });
    files
        .filter_map(|file| Scene::try_from(file).ok())
        .collect()
}

/// Fails with the scene that caused a panic or exceeded the time limit.
pub fn assert_survives<T>(scene: &Scene, survives: impl Fn(&Scene) -> T) -> T {
    let text = serde_json::to_string(scene.file()).unwrap();
    let _limit = Limit::of(SECONDS_A_SCENE, &text);
    let survived = catch_unwind(AssertUnwindSafe(|| survives(scene)));
    survived.unwrap_or_else(|_| panic!("brought down by {text}"))
}
