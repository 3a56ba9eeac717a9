//! `records` and `margin` without a Python that has the package; `python/tests` compare their results with known values.

use crate::program::{out, sawflutter, text};
use tempfile::TempDir;

#[test]
fn measured_saws_need_the_python_package() {
    let version = env!("CARGO_PKG_VERSION");
    for (arguments, extras) in [
        (["records", "tap.wav", "--rpm=0"], "records,plot"),
        (["margin", "scenes/paper.json", "peaks.csv"], "margin,plot"),
    ] {
        let folder = TempDir::new().unwrap();
        let mut command = sawflutter();
        command.args(arguments).arg("--out").arg(out(&folder));
        let done = command
            .env("SAWFLUTTER_PYTHON", "no-such-python")
            .output()
            .unwrap();
        assert_eq!(done.status.code(), Some(2));
        let message = text(&done.stderr);
        let remedy = format!("pip install 'sawflutter[{extras}]=={version}'");
        assert!(
            message.contains("there is no no-such-python") && message.contains(&remedy),
            "{message}"
        );
        assert!(!out(&folder).exists());
    }
}

#[test]
fn a_speed_that_is_no_number_is_refused() {
    let refused = sawflutter()
        .args(["records", "tap.wav", "--rpm", "0..fast"])
        .output()
        .unwrap();
    assert_eq!(refused.status.code(), Some(2));
    let message = text(&refused.stderr);
    assert!(message.contains("it must be a number"), "{message}");
}
