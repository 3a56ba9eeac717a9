//! Many pages of one program.

use serde_json::json;

use crate::browser::{PAD, Page, drag, let_go, run};

/// A browser opens six connections to one server: a page that kept one open would leave none for the seventh tab.
#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn eight_tabs_each_have_their_chart_and_answer_a_move() {
    run(async {
        let page = Page::open(&["--accuracy", "draft"]).await;
        let mut tabs = vec![page.driver.window().await.unwrap()];
        while tabs.len() < 8 {
            tabs.push(page.another_tab().await);
        }
        // Each tab except the last has been in the background in the meantime.
        let mut shown = Vec::new();
        for tab in &tabs {
            page.driver.switch_to_window(tab.clone()).await.unwrap();
            page.driver
                .chromium("Page.bringToFront", json!({}))
                .await
                .unwrap();
            page.wait("window.sawflutter?.computed.length > 0").await;
            page.settle().await;
            let before = page.text("#facts").await;
            drag(&page, PAD, 5, (4, -2)).await;
            page.wait("sawflutter.latencies.draft.length > 0").await;
            let_go(&page).await;
            page.settle().await;
            let after = page.text("#facts").await;
            assert_ne!(before, after);
            let lost = "document.querySelector('#lost').hidden";
            assert_eq!(page.value(lost).await, json!(true));
            shown.push(after);
        }
        assert_eq!(shown.len(), 8);
        // The program still has the chart of the first tab, whatever the others have requested since.
        page.driver.switch_to_window(tabs[0].clone()).await.unwrap();
        page.step_to_a_mode().await;
        page.close().await;
    });
}

/// A page that waits for a long computation must not keep a connection open: the eighth tab would have none.
#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn a_long_computation_leaves_all_other_tabs_their_charts_and_influences() {
    run(async {
        let page = Page::open(&["--accuracy", "draft"]).await;
        page.settle().await;
        let first = page.driver.window().await.unwrap();
        let begin = "document.querySelector('#tab-spread').click(), document.querySelector('#panel-study .start button').click()";
        // A fast machine may have finished the study of the first tab before the last one is open.
        let goes_on = |told: &str| {
            ["waits", "saws: ", "Tolerances"]
                .iter()
                .any(|word| told.starts_with(word))
        };
        let script = "document.querySelector('#panel-study .start .remark').textContent || document.querySelector('#panel-study pre')?.textContent || ''";
        page.script(begin).await;
        page.wait("document.querySelector('#panel-study progress').value > 0")
            .await;
        for _ in 0..7 {
            page.another_tab().await;
            page.wait("window.sawflutter?.computed.length > 0").await;
            page.settle().await;
            page.wait("[...document.querySelectorAll('.influence .words')].some((words) => words.textContent !== '')")
                .await;
            page.script(begin).await;
            let script = page.value(script).await;
            assert!(goes_on(script.as_str().unwrap()), "{script}");
        }
        page.driver.switch_to_window(first).await.unwrap();
        let told = page.value(script).await;
        assert!(goes_on(told.as_str().unwrap()), "{told}");
        page.close().await;
    });
}
