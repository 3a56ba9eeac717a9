//! Many pages of one program.

use serde_json::json;
use thirtyfour::Key;

use crate::browser::{PAD, Page, drag, let_go, run};

/// A browser opens six connections to one server: a page that held one for good would leave none
/// for the seventh tab.
#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn eight_tabs_each_have_their_chart_and_answer_a_move() {
    run(async {
        let page = Page::open(&["--accuracy", "draft"]).await;
        let address = page.driver.current_url().await.unwrap();
        let mut tabs = vec![page.driver.window().await.unwrap()];
        while tabs.len() < 8 {
            let tab = page.driver.new_tab().await.unwrap();
            page.driver.switch_to_window(tab.clone()).await.unwrap();
            page.driver.goto(address.as_str()).await.unwrap();
            tabs.push(tab);
        }
        // Each but the last has been in the background meanwhile.
        let mut shown = Vec::new();
        for tab in &tabs {
            page.driver.switch_to_window(tab.clone()).await.unwrap();
            let tools = page.driver.cdp();
            tools
                .send_raw("Page.bringToFront", json!({}))
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
        // The first one's chart is still kept for its modes, whatever the others have asked since.
        page.driver.switch_to_window(tabs[0].clone()).await.unwrap();
        let chart = page.find("#campbell").await;
        chart.focus().await.unwrap();
        chart.send_keys(Key::Right + "").await.unwrap();
        page.wait("document.querySelector('#mode').textContent.includes('Krein')")
            .await;
        page.close().await;
    });
}
