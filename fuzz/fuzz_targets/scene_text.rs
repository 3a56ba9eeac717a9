//! Any text is a scene or is refused.
#![no_main]

libfuzzer_sys::fuzz_target!(|text: &str| {
    let _ = sawflutter::scene::Scene::from_json(text);
});
