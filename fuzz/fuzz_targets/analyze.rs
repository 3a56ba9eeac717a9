//! Any valid scene is charted in finite numbers, or refused.
#![no_main]

#[path = "../../tests/common/draw.rs"]
mod draw;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let file = draw::scene_file(&mut draw::Bytes(bytes));
    if let Ok(scene) = sawflutter::scene::Scene::try_from(file) {
        draw::survives_two_speeds(&scene);
        draw::survives_chart(&scene);
        draw::survives_analysis(&scene);
        draw::survives_washboard(&scene);
    }
});
