//! Any text is read as a scene or refused.
#![no_main]

libfuzzer_sys::fuzz_target!(|text: &str| {
    let _ = sawflutter::model::scene::Scene::from_json(text);
});
