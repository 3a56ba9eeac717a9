//! The page is readable on any screen and with a screen reader.

use std::time::Duration;

use serde_json::json;

use crate::browser::{Key, PAD, Page, drag, let_go, run};

#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn the_page_is_readable_on_a_small_and_on_a_dark_screen() {
    run(async {
        let page = Page::open(&["--accuracy", "draft"]).await;
        page.settle().await;
        let mut wide = Vec::new();
        for (width, height) in [(1280, 900), (768, 1024), (390, 844)] {
            let size = json!({ "width": width, "height": height, "deviceScaleFactor": 2, "mobile": width < 500 });
            page.driver
                .chromium("Emulation.setDeviceMetricsOverride", size)
                .await
                .unwrap();
            for scheme in ["light", "dark"] {
                let media =
                    json!({ "features": [{ "name": "prefers-color-scheme", "value": scheme }] });
                page.driver
                    .chromium("Emulation.setEmulatedMedia", media)
                    .await
                    .unwrap();
                tokio::time::sleep(Duration::from_millis(300)).await;
                page.screenshot(&format!("{width}-{scheme}.png")).await;
                let paper = page
                    .value("getComputedStyle(document.body).backgroundColor")
                    .await;
                let bottom = page
                    .value("document.querySelector('#campbell').getBoundingClientRect().bottom")
                    .await;
                let (end, height) = (bottom.as_f64().unwrap(), f64::from(height));
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
            [json!(true), json!(true), json!(true)],
            "the page is wider than the screen"
        );
        page.close().await;
    });
}

/// While a phone scrolls, the docked chart stays as wide as the screen.
#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn a_phone_that_scrolls_keeps_its_width() {
    run(async {
        let page = Page::open(&["--accuracy", "draft"]).await;
        let size = json!({ "width": 390, "height": 844, "deviceScaleFactor": 3, "mobile": true });
        let touch = json!({ "enabled": true, "maxTouchPoints": 1 });
        for (name, value) in [
            ("Emulation.setDeviceMetricsOverride", size),
            ("Emulation.setTouchEmulationEnabled", touch),
        ] {
            page.driver.chromium(name, value).await.unwrap();
        }
        page.settle().await;
        for step in 0..30 {
            page.script(&format!("scrollTo(0, {})", 60 * step)).await;
            tokio::time::sleep(Duration::from_millis(50)).await;
        }
        page.wait("document.querySelector('.docked') !== null")
            .await;
        let widths = "[innerWidth, document.querySelector('#campbell').clientWidth]";
        assert_eq!(page.value(widths).await, json!([390, 390]));
        page.close().await;
    });
}

/// Script of axe-core, which checks labels, roles, contrast and order.
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
fn an_audit_finds_no_accessibility_fault() {
    run(async {
        let page = Page::open(&["--accuracy", "draft"]).await;
        page.settle().await;
        page.script(AUDITOR).await;
        page.script("document.querySelectorAll('details').forEach((part) => (part.open = true))")
            .await;
        for scheme in ["light", "dark"] {
            let media =
                json!({ "features": [{ "name": "prefers-color-scheme", "value": scheme }] });
            page.driver
                .chromium("Emulation.setEmulatedMedia", media)
                .await
                .unwrap();
            for tab in ["cut", "motion", "guides", "spread", "chart"] {
                page.find(&format!("#tab-{tab}"))
                    .await
                    .click()
                    .await
                    .unwrap();
                page.audit(&format!("{tab}, {scheme}")).await;
            }
        }
        page.enter("blade.thickness_m", "-1").await;
        page.wait("document.querySelector('[aria-invalid]') !== null")
            .await;
        page.audit("refused").await;
        page.close().await;
    });
}

impl Page {
    /// Sets the size of the screen.
    pub async fn resize(&self, width: u32, height: u32) {
        let size =
            json!({ "width": width, "height": height, "deviceScaleFactor": 1, "mobile": false });
        self.driver
            .chromium("Emulation.setDeviceMetricsOverride", size)
            .await
            .unwrap();
        tokio::time::sleep(Duration::from_millis(300)).await;
    }

    /// Returns the left and upper edges of both Campbell diagrams, the pinned one first.
    async fn diagrams(&self) -> Vec<[f64; 2]> {
        let found = self
            .value("[...document.querySelectorAll('.campbell canvas')].map((c) => c.getBoundingClientRect()).map((box) => [box.left, box.top])")
            .await;
        serde_json::from_value(found).unwrap()
    }
}

#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn two_saws_are_side_by_side_on_the_same_axes_on_a_wide_page() {
    run(async {
        let page = Page::open(&["--accuracy", "draft"]).await;
        page.settle().await;
        page.script("document.querySelector('#pin').click()").await;
        page.enter("blade.thickness_m", "3.4").await;
        page.settle().await;
        page.find("#side").await.click().await.unwrap();
        for width in [1440, 1280, 760] {
            page.resize(width, 900).await;
            let [pinned, present] = page.diagrams().await[..] else {
                panic!("two diagrams")
            };
            assert!(pinned[0] + 300.0 < present[0] && pinned[1] == present[1]);
            page.screenshot(&format!("{width}-side-by-side.png")).await;
        }
        page.resize(390, 844).await;
        let diagrams = page.diagrams().await;
        assert!(diagrams[0][0] == diagrams[1][0] && diagrams[0][1] + 200.0 < diagrams[1][1]);
        // The modes of the thicker blade are higher: both diagrams show them all, over the same range of speeds.
        page.resize(1280, 900).await;
        let ends = "[...document.querySelectorAll('.campbell')].map((place) => place.chart.scales)\
            .map(({ x, y }) => [x.min, x.max, y.min, y.max])";
        let all = page.value(ends).await;
        assert_eq!(all[0], all[1]);
        page.wheel("#campbell .u-over", -200).await;
        let some = page.value(ends).await;
        assert_eq!(some[0], some[1]);
        assert_ne!(some, all);
        page.close().await;
    });
}

/// Script that returns the upper edges of the diagrams and of a field on the page.
const PLACES: &str = "['#campbell', '#growth', \"[id='operating_rpm']\"]\
    .map((place) => document.querySelector(place).getBoundingClientRect().top + scrollY)";

#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn nothing_jumps_while_a_saw_is_changed_and_looked_at() {
    run(async {
        let page = Page::open(&["--accuracy", "draft"]).await;
        page.settle().await;
        let before = page.value(PLACES).await;
        // The influence of the numbers on the speeds is computed a moment after the chart.
        page.wait("[...document.querySelectorAll('.influence .words')].some((words) => words.textContent !== '')")
            .await;
        assert_eq!(page.value(PLACES).await, before, "influence");
        // Around the blade, beside which a pad is warned of.
        drag(&page, PAD, 12, (2, -2)).await;
        page.wait("sawflutter.latencies.draft.length > 0").await;
        assert_eq!(page.value(PLACES).await, before, "dragging");
        let_go(&page).await;
        page.settle().await;
        assert_eq!(page.value(PLACES).await, before, "let go");
        page.wheel("#campbell .u-over", -200).await;
        page.wait("!document.querySelector('#zoomed').hidden").await;
        assert_eq!(page.value(PLACES).await, before, "magnified");
        // A verdict of two lines takes the space of one.
        let inside = "sawflutter.report().instabilities.find((band) => band.kind === 'divergence')";
        let rpm = page
            .value(&format!(
                "Math.round(0.5 * ({inside}.from_rpm + {inside}.to_rpm))"
            ))
            .await;
        page.enter("operating_rpm", &rpm.to_string()).await;
        page.settle().await;
        let told = page.text("#verdict").await;
        // At draft accuracy a speed in a narrow band may be too close to its edges to call.
        let is_told = ["divergence grows", "the edge of a band"];
        assert!(is_told.iter().any(|words| told.contains(words)), "{told}");
        assert_eq!(page.value(PLACES).await, before, "verdict");
        page.close().await;
    });
}

/// The layout of the page does not change while it is loaded.
#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn the_page_hardly_moves_while_it_is_loaded() {
    run(async {
        let page = Page::open(&["--accuracy", "draft"]).await;
        for (width, height) in [(1440, 900), (1280, 900), (760, 900), (390, 844)] {
            page.resize(width, height).await;
            page.driver.refresh().await.unwrap();
            page.wait("window.sawflutter?.computed.length > 0").await;
            page.settle().await;
            let shifts = page
                .awaited(
                    "(await new Promise((resolve) => { const all = []; \
                     new PerformanceObserver((list) => all.push(...list.getEntries())).observe({ type: 'layout-shift', buffered: true }); \
                     setTimeout(() => resolve(all), 300); })).map(({ value, sources }) => \
                     [value, sources.map(({ node, previousRect, currentRect }) => `${node?.id || node?.className || node?.nodeName}: ${previousRect.top} to ${currentRect.top}`)])",
                )
                .await;
            let all: Vec<(f64, Vec<String>)> = serde_json::from_value(shifts).unwrap();
            let sum: f64 = all.iter().map(|(value, _)| value).sum();
            println!("layout shift at {width} pixels: {sum:.3}");
            assert!(sum < 0.1, "{width}: {sum} {all:#?}");
        }
        page.close().await;
    });
}

#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn the_focus_stays_at_the_field_in_use() {
    run(async {
        let page = Page::open(&["--accuracy", "draft"]).await;
        page.settle().await;
        page.script(
            "sawflutter.reveal(''); document.querySelectorAll('#fields details').forEach((part) => (part.open = true))",
        )
        .await;
        let focused = "document.activeElement.id";
        for (button, then) in [
            ("guides:add", "guides:add"),
            ("guides[1]:switch", "guides:add"),
            ("membrane:switch", "membrane:switch"),
            ("membrane:switch", "membrane:switch"),
        ] {
            let pressed = page.find(&format!("[id='{button}']")).await;
            pressed.send_keys(Key::Enter + "").await.unwrap();
            page.settle().await;
            assert_eq!(page.value(focused).await, json!(then), "{button}");
        }
        for _ in 0..4 {
            page.find("#undo")
                .await
                .send_keys(Key::Enter + "")
                .await
                .unwrap();
        }
        // Nothing is left to undo.
        assert_eq!(page.value(focused).await, json!("redo"));
        page.settle().await;
        page.open_tab_of("study").await;
        let start = page.find("#panel-study .start button").await;
        start.send_keys(Key::Enter + "").await.unwrap();
        let stop = page.find("#panel-study .start button + button").await;
        stop.send_keys(Key::Enter + "").await.unwrap();
        page.wait("document.querySelector('#panel-study progress').hidden")
            .await;
        assert_eq!(
            page.value("document.activeElement.textContent").await,
            json!("Compute")
        );
        page.close().await;
    });
}

#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn a_pad_and_its_fields_are_marked_together() {
    run(async {
        let page = Page::drafted("two-pads").await;
        let marked = "[...document.querySelectorAll('.selected')].map((marked) => [marked.dataset.path, marked.open ?? marked.querySelector('.number').textContent])";
        drag(&page, "[data-path='guides[1]'] .body", 3, (2, 0)).await;
        let_go(&page).await;
        page.settle().await;
        assert_eq!(
            page.value(marked).await,
            json!([["guides[1]", "2"], ["guides[1]", true]])
        );
        page.screenshot("1280-selected.png").await;
        page.find("[id='guides[0].radius_m']")
            .await
            .click()
            .await
            .unwrap();
        assert_eq!(
            page.value(marked).await,
            json!([["guides[0]", "1"], ["guides[0]", true]])
        );
        page.close().await;
    });
}

#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn a_slider_and_the_chart_are_seen_together_on_a_small_screen() {
    run(async {
        let page = Page::open(&["--accuracy", "draft"]).await;
        page.resize(390, 844).await;
        page.settle().await;
        page.script(
            "sawflutter.reveal('guides'); document.getElementById('guides[0].stiffness_n_per_m').scrollIntoView({ block: 'center' })",
        )
        .await;
        page.wait("document.querySelector('.docked') !== null")
            .await;
        page.screenshot("390-slider.png").await;
        let json = page
            .value("[document.querySelector('#campbell canvas'), document.getElementById('guides[0].stiffness_n_per_m')].map((part) => part.getBoundingClientRect()).map(({ top, bottom }) => [top, bottom])")
            .await;
        let seen: [[f64; 2]; 2] = serde_json::from_value(json).unwrap();
        assert!(
            seen[0][0] >= 0.0 && seen[0][1] <= seen[1][0] && seen[1][1] <= 844.0,
            "{seen:?}"
        );
        // The answer and the ruler are above the chart.
        let json = page
            .value("['#verdict strong', '#ruler'].map((part) => document.querySelector(part).getBoundingClientRect()).map(({ top, bottom }) => [top, bottom])")
            .await;
        let above: [[f64; 2]; 2] = serde_json::from_value(json).unwrap();
        assert!(
            above[0][0] >= 0.0 && above[1][1] <= seen[0][0] + 1.0,
            "{above:?}, {seen:?}"
        );
        page.script("scrollTo(0, 0)").await;
        page.wait("document.querySelector('.docked') === null")
            .await;
        page.close().await;
    });
}

/// The printed page has the saw's name, its answer and its chart in the colours of paper, without buttons and fields.
#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn the_printed_page_has_the_answer_and_the_chart_of_a_named_saw() {
    run(async {
        let page = Page::open(&["--accuracy", "draft"]).await;
        page.settle().await;
        let name = page.value("sawflutter.state.scene.name").await;
        assert_eq!(page.text("#saw-name").await, name.as_str().unwrap());
        assert_eq!(
            page.value("document.title").await,
            json!(format!("{} – sawflutter", name.as_str().unwrap()))
        );
        let file = page.value("sawflutter.nameOf('campbell.png')").await;
        assert!(file.as_str().unwrap().ends_with("-campbell.png"), "{file}");
        page.script(
            "sawflutter.open(new File([JSON.stringify(sawflutter.state.scene)], 'My saw.json'))",
        )
        .await;
        page.wait("sawflutter.nameOf('scene.json') === 'My saw.json'")
            .await;
        page.settle().await;
        let media = json!({ "media": "print", "features": [{ "name": "prefers-color-scheme", "value": "dark" }] });
        page.driver
            .chromium("Emulation.setEmulatedMedia", media)
            .await
            .unwrap();
        page.script("dispatchEvent(new Event('beforeprint'))").await;
        page.screenshot("1280-print.png").await;
        let seen = "['#saw-name', '#verdict', '#campbell', '#drawing', '#form', '#tabs', '#undo'].map((part) => document.querySelector(part).checkVisibility())";
        assert_eq!(
            page.value(seen).await,
            json!([true, true, true, true, false, false, false])
        );
        let numbers = page.text("#printed").await;
        for words in ["thickness of the blade2.8 mm", "guide 1: radius200 mm"] {
            assert!(numbers.contains(words), "{numbers}");
        }
        let paper = page
            .value("getComputedStyle(document.body).backgroundColor")
            .await;
        assert_eq!(paper, json!("rgb(255, 255, 255)"));
        page.close().await;
    });
}
