//! No work is lost, and the program ends with its page.

use std::time::{Duration, Instant};

use serde_json::json;

use crate::browser::{PATIENCE, Page, run};

#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn edits_survive_a_reload_and_travel_in_the_address() {
    run(async {
        let page = Page::open(&["--accuracy", "draft"]).await;
        page.settle().await;
        page.enter("blade.thickness_m", "3").await;
        page.settle().await;
        let thickness = "sawflutter.state.scene.blade.thickness_m";
        let shown = "window.sawflutter?.computed.length > 0";
        page.script("sawflutter.leave()").await;
        page.driver.refresh().await.unwrap();
        page.wait(shown).await;
        page.settle().await;
        assert_eq!(page.value(thickness).await, json!(0.003));
        let restored = page.value("document.querySelector('#restored').hidden");
        assert_eq!(restored.await, json!(false));
        page.screenshot("1280-restored.png").await;

        page.script("document.querySelector('#link').click()").await;
        page.wait("location.hash.startsWith('#scene=')").await;
        page.script("document.querySelector('#over').click()").await;
        page.settle().await;
        assert_eq!(page.value(thickness).await, json!(0.0028));
        page.script("sawflutter.leave()").await;
        page.driver.refresh().await.unwrap();
        page.wait(shown).await;
        page.settle().await;
        assert_eq!(page.value(thickness).await, json!(0.003));
        page.close().await;
    });
}

#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn a_file_that_is_no_scene_leaves_the_scene_and_a_table_becomes_points() {
    run(async {
        let page = Page::open(&["--accuracy", "draft"]).await;
        page.settle().await;
        let before = page.value("sawflutter.state.scene").await;
        for (name, text) in [
            ("notes.json", "{ \"a\": 1 }"),
            ("broken.json", "not json"),
            ("empty.csv", "rpm,hz"),
            ("kilohertz.csv", "rpm,f1 [kHz]\n0,0.1\n"),
        ] {
            page.script(&format!("sawflutter.open(new File([{text:?}], {name:?}))"))
                .await;
            page.wait("document.querySelector('#fault').textContent !== ''")
                .await;
            let told = page.text("#fault").await;
            assert!(
                told.starts_with(&format!("{name} was not opened")),
                "{told}"
            );
            assert_eq!(page.value("sawflutter.state.scene").await, before);
            page.script("document.querySelector('#fault').textContent = ''")
                .await;
        }
        let table = "rpm;1;2\n0;9,5;11\n500;4,5;15\n";
        page.script(&format!(
            "sawflutter.open(new File([{table:?}], 'tap test.csv'))"
        ))
        .await;
        page.wait("sawflutter.state.scene.measured.source === 'tap test.csv'")
            .await;
        page.settle().await;
        let rows = page.value("sawflutter.state.scene.measured.rows").await;
        assert_eq!(rows[0], json!({ "rpm": 0, "frequencies_hz": [9.5, 11] }));
        // The speed in the last column, a wave that was not seen, and a column order of its own: as `sawflutter fit`
        // reads the table.
        let table = "f2,f1,f3,rpm\n27.5,9.5,43,0\n,4.5,40,500\n";
        page.script(&format!(
            "sawflutter.open(new File([{table:?}], 'shop.csv'))"
        ))
        .await;
        page.wait("sawflutter.state.scene.measured.source === 'shop.csv'")
            .await;
        page.settle().await;
        assert_eq!(
            page.value("sawflutter.state.scene.measured.rows").await,
            json!([
                { "rpm": 0, "frequencies_hz": [9.5, 27.5, 43] },
                { "rpm": 500, "frequencies_hz": [4.5, null, 40] },
            ])
        );
        // The tick shows or hides the points; the scene stays.
        let scene = page.value("sawflutter.state.scene").await;
        page.script("document.querySelector('#measured').click()")
            .await;
        assert_eq!(page.value("sawflutter.state.scene").await, scene);
        page.close().await;
    });
}

#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn a_program_that_is_started_again_takes_the_page_over() {
    run(async {
        let mut page = Page::open(&["--accuracy", "draft"]).await;
        page.settle().await;
        page.program.0.kill().unwrap();
        page.wait("!document.querySelector('#lost').hidden").await;
        page.enter("blade.thickness_m", "3").await;
        page.wait("document.body.classList.contains('stale')").await;
        page.start_again(&["--accuracy", "draft"]).await;
        page.wait("document.querySelector('#lost').hidden").await;
        // The change that was made meanwhile is computed, and the chart has its modes.
        page.settle().await;
        assert!(page.text("#facts").await.contains(" → "));
        assert_eq!(page.text("#fault").await, "");
        page.step_to_a_mode().await;
        page.close().await;
    });
}

#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn the_program_ends_with_its_page() {
    run(async {
        let mut page = Page::open(&["--accuracy", "draft"]).await;
        page.settle().await;
        page.driver.goto("about:blank").await.unwrap();
        let begun = Instant::now();
        let status = loop {
            if let Some(status) = page.program.0.try_wait().unwrap() {
                break status;
            }
            assert!(
                begun.elapsed() < PATIENCE,
                "the program goes on without its page"
            );
            tokio::time::sleep(Duration::from_millis(50)).await;
        };
        assert!(status.success(), "{status}");
        page.close().await;
    });
}
