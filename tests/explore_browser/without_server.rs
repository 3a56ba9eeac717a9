//! The page without a server has the charts, files and results of the program.
//!
//! Needs the folder of `web/build`; `.ci/web` builds it and runs these tests.

use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::browser::{Page, run};

/// The folder that `web/build` has made.
fn folder() -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join("../web-page")
}

/// Largest relative difference of two numbers in equal places of both values; null and text are not compared.
fn difference(left: &Value, right: &Value) -> f64 {
    match (left, right) {
        (Value::Number(x), Value::Number(y)) => {
            let [x, y] = [x, y].map(|number| number.as_f64().unwrap());
            (x - y).abs() / x.abs().max(y.abs()).max(1e-300)
        }
        (Value::Array(x), Value::Array(y)) => {
            assert_eq!(x.len(), y.len());
            x.iter()
                .zip(y)
                .map(|(x, y)| difference(x, y))
                .fold(0.0, f64::max)
        }
        _ => 0.0,
    }
}

/// Returns the values of one key in all entries of a list of a report.
fn column(report: &Value, list: &str, key: &str) -> Value {
    let entries = report[list].as_array().unwrap();
    entries.iter().map(|entry| entry[key].clone()).collect()
}

/// Band edges, growth rates and critical speeds agree to a relative difference of 1e-6, because vector units round
/// differently.
async fn assert_is_that_of_the_program(page: &Page) {
    let found = page.value("sawflutter.report()").await;
    let out = page.command_line().await;
    let text = std::fs::read_to_string(out.join("report.json")).unwrap();
    let expected: Value = serde_json::from_str(&text).unwrap();
    for (list, key) in [
        ("critical_speeds", "rpm"),
        ("instabilities", "from_rpm"),
        ("instabilities", "to_rpm"),
        ("instabilities", "peak_growth_per_s"),
    ] {
        let columns = [&found, &expected].map(|report| column(report, list, key));
        assert!(!columns[0].as_array().unwrap().is_empty(), "{list}");
        let difference = difference(&columns[0], &columns[1]);
        assert!(difference < 1e-6, "{list}.{key}: {difference:e}");
    }
    let lines = page.text("#verdict").await;
    assert!(!lines.trim().is_empty());
}

#[test]
#[ignore = "needs chromium, chromium-driver and the folder of web/build; run by .ci/web"]
fn charts_files_and_tasks_are_those_of_the_program() {
    run(async {
        let page = Page::open_folder(&folder()).await;
        page.settle().await;
        assert_is_that_of_the_program(&page).await;
        page.enter("blade.thickness_m", "3").await;
        page.settle().await;
        assert_is_that_of_the_program(&page).await;
        let times = page.value("sawflutter.computed").await;
        println!("charts without a server, in milliseconds: {times}");

        page.step_to_a_mode().await;
        let png = page.download("campbell.png").await;
        assert!(png.starts_with(b"\x89PNG"), "{} bytes", png.len());
        let svg = page.download("campbell.svg").await;
        let drawn = page.command_line().await.join("campbell.svg");
        assert_eq!(svg.len() / 1000, std::fs::read(drawn).unwrap().len() / 1000);

        page.compute("cut").await;
        let shown = page.text("#panel-cut pre").await;
        let (_, printed) = page.command(&["cut"]).await;
        assert!(printed.starts_with(shown.trim_end()), "{shown}\n{printed}");
        page.screenshot("without-server.png").await;
        page.close().await;
    });
}

/// The folder can be put on any server: its policy is in the page, its modules are one file, and it names no program.
#[test]
#[ignore = "needs chromium, chromium-driver and the folder of web/build; run by .ci/web"]
fn the_folder_is_complete_and_speaks_of_the_browser() {
    run(async {
        let page = Page::open_folder(&folder()).await;
        page.settle().await;
        let told = page.text("#computed").await;
        assert!(told.ends_with(" ms in this browser"), "{told}");
        // Each worker loads its script.
        let scripts = "[...new Set(performance.getEntriesByType('resource').map(({ name }) => name.split('/').at(-1)).filter((name) => name.endsWith('.js')))].sort()";
        let found = page.value(scripts).await;
        assert_eq!(
            found,
            serde_json::json!(["main.js", "uplot.js", "worker.js"])
        );
        let policy = "document.querySelector('[http-equiv=Content-Security-Policy]').content";
        let policy = page.value(policy).await;
        assert!(
            policy.as_str().unwrap().starts_with("default-src 'none'"),
            "{policy}"
        );
        // A script of the page itself is not run.
        page.script("const made = document.createElement('script'); made.textContent = 'window.injected = true'; document.body.append(made)")
            .await;
        assert_eq!(page.value("window.injected ?? false").await, false);
        page.close().await;
    });
}

/// An outdated computation is ended with its worker, and the next one is answered.
#[test]
#[ignore = "needs chromium, chromium-driver and the folder of web/build; run by .ci/web"]
fn a_computation_is_stopped_and_the_page_goes_on() {
    run(async {
        let page = Page::open_folder(&folder()).await;
        page.settle().await;
        page.script("sawflutter.state.set('accuracy', 'reference')")
            .await;
        page.script("sawflutter.state.set('sweep.to_rpm', 6000)")
            .await;
        tokio::time::sleep(std::time::Duration::from_millis(300)).await;
        page.script("sawflutter.state.set('accuracy', 'draft')")
            .await;
        page.script("sawflutter.state.set('sweep.to_rpm', 2000)")
            .await;
        page.settle().await;
        page.step_to_a_mode().await;
        page.close().await;
    });
}
