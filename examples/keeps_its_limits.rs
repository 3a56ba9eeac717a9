//! Compares a saw with limits, as in a test: `cargo run --release --example keeps_its_limits`.

use sawflutter::model::scene::rad_per_s;
use sawflutter::prelude::*;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let saw = Scene::paper(); // Scene::from_path("saws/edger.json")?
    let limits = Limits {
        min_flutter_rad_per_s: Some(rad_per_s(2000.0)),
        ..Limits::at(rad_per_s(1250.0))
    };
    let report = sawflutter::check(&saw, &limits)?;
    assert!(report.passed, "{:?}", report.failures());
    Ok(())
}
