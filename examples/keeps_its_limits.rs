//! Compares a saw with limits, as in a test: `cargo run --release --example keeps_its_limits`.

use sawflutter::model::scene::{LimitsFile, rad_per_s};
use sawflutter::prelude::*;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let saw = Scene::paper(); // Scene::from_path("saws/edger.json")?
    let limits = Limits {
        limits: LimitsFile {
            min_flutter_rpm: Some(2000.0),
            ..LimitsFile::default()
        },
        ..Limits::at(rad_per_s(1250.0))
    };
    let report = sawflutter::check(&saw, &limits)?;
    assert!(report.passed, "{:?}", report.failures());
    Ok(())
}
