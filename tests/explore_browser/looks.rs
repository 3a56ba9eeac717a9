//! The page can be read on any screen, and by those who do not see it.

use std::time::Duration;

use serde_json::json;

use crate::browser::{Page, run};

#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn the_page_is_readable_on_a_small_and_on_a_dark_screen() {
    run(async {
        let page = Page::open(&["--accuracy", "draft"]).await;
        page.settle().await;
        let tools = page.driver.cdp();
        let mut wide = Vec::new();
        for (width, height) in [(1280, 900), (390, 844)] {
            let size = json!({ "width": width, "height": height, "deviceScaleFactor": 2, "mobile": width < 500 });
            tools
                .send_raw("Emulation.setDeviceMetricsOverride", size)
                .await
                .unwrap();
            for scheme in ["light", "dark"] {
                let media =
                    json!({ "features": [{ "name": "prefers-color-scheme", "value": scheme }] });
                tools
                    .send_raw("Emulation.setEmulatedMedia", media)
                    .await
                    .unwrap();
                tokio::time::sleep(Duration::from_millis(300)).await;
                page.screenshot(&format!("{width}-{scheme}.png")).await;
                let paper = page
                    .value("getComputedStyle(document.body).backgroundColor")
                    .await;
                let end = page
                    .value("document.querySelector('#campbell').getBoundingClientRect().bottom")
                    .await;
                let (end, height) = (end.as_f64().unwrap(), f64::from(height));
                assert!(end <= height, "blade and chart are not seen together");
                assert_eq!(paper == json!("rgb(255, 255, 255)"), scheme == "light");
            }
            wide.push(
                page.value("document.documentElement.scrollWidth <= innerWidth")
                    .await,
            );
        }
        assert_eq!(
            wide,
            [json!(true), json!(true)],
            "the page is wider than the screen"
        );
        page.close().await;
    });
}

/// axe-core: labels, roles, contrast, order.
const AUDITOR: &str = include_str!("browser/axe.min.js");

impl Page {
    async fn audit(&self, what: &str) {
        let found = self
            .awaited("(await axe.run(document)).violations.map((v) => [v.id, v.nodes.map((n) => n.html)])")
            .await;
        assert_eq!(found, json!([]), "{what}");
    }
}

#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn an_audit_finds_no_barrier() {
    run(async {
        let page = Page::open(&["--accuracy", "draft"]).await;
        page.settle().await;
        page.script(AUDITOR).await;
        page.script("document.querySelectorAll('details').forEach((part) => (part.open = true))")
            .await;
        for scheme in ["light", "dark"] {
            let media =
                json!({ "features": [{ "name": "prefers-color-scheme", "value": scheme }] });
            let tools = page.driver.cdp();
            tools
                .send_raw("Emulation.setEmulatedMedia", media)
                .await
                .unwrap();
            for tab in ["cut", "runup", "fit", "place", "study", "chart"] {
                page.find(&format!("#tab-{tab}"))
                    .await
                    .click()
                    .await
                    .unwrap();
                page.audit(&format!("{tab}, {scheme}")).await;
            }
        }
        page.enter("blade.thickness_m", "-1").await;
        page.wait("document.body.classList.contains('stale')").await;
        page.audit("refused").await;
        page.close().await;
    });
}
