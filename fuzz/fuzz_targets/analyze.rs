//! Any valid scene gives a chart of finite numbers or is refused.
#![no_main]

#[path = "../../tests/common/draw.rs"]
mod draw;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let mut bytes = draw::Bytes(bytes);
    let file = draw::scene_file(&mut bytes);
    let file = draw::with_details(&mut bytes, file);
    if let Ok(scene) = sawflutter::model::scene::Scene::try_from(file) {
        draw::survives_two_speeds(&scene);
        draw::survives_chart(&scene);
        draw::survives_analysis(&scene);
        draw::survives_washboard(&scene);
    }
});
