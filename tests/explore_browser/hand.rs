//! Wheel, fingers, pointer and arrow keys on the diagram.

use serde_json::{Value, json};

use crate::browser::{Page, drag, hand, let_go, run};

impl Page {
    /// Turns the wheel by pixels with the pointer in the middle of an element.
    pub async fn wheel(&self, selector: &str, pixels: i64) {
        self.script(&format!(
            "const over = document.querySelector({selector:?}); const box = over.getBoundingClientRect(); \
             over.dispatchEvent(new WheelEvent('wheel', {{ deltaY: {pixels}, cancelable: true, ctrlKey: true, \
             clientX: box.left + box.width / 2, clientY: box.top + box.height / 2 }}))"
        ))
        .await;
    }

    /// Moves fingers on the plot of the diagram: of each, its first and last place in pixels from the left upper edge.
    async fn fingers(&self, all: &[[[f64; 2]; 2]]) {
        let place = "(({ left, top }) => [left, top])(document.querySelector('#campbell .u-over').getBoundingClientRect())";
        let [left, top]: [f64; 2] = serde_json::from_value(self.value(place).await).unwrap();
        for (kind, share) in [("touchStart", 0.0), ("touchMove", 0.5), ("touchMove", 1.0)] {
            let points = all.iter().enumerate().map(|(id, [from, to])| {
                let at = |k: usize| from[k] + share * (to[k] - from[k]);
                json!({ "x": left + at(0), "y": top + at(1), "id": id })
            });
            let event = json!({ "type": kind, "touchPoints": points.collect::<Vec<_>>() });
            self.driver
                .chromium("Input.dispatchTouchEvent", event)
                .await
                .unwrap();
        }
        let end = json!({ "type": "touchEnd", "touchPoints": [] });
        self.driver
            .chromium("Input.dispatchTouchEvent", end)
            .await
            .unwrap();
    }
}

/// Two fingers magnify the diagram, and a tap shows the mode until another place is tapped.
#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn fingers_magnify_the_diagram_and_show_a_mode() {
    run(async {
        let page = Page::open(&["--accuracy", "draft"]).await;
        let touch = json!({ "enabled": true, "maxTouchPoints": 2 });
        page.driver
            .chromium("Emulation.setTouchEmulationEnabled", touch)
            .await
            .unwrap();
        page.settle().await;
        let at = "(({ branch: [branch] }, chart) => [chart.valToPos(branch.rpm[9], 'x'), chart.valToPos(branch.frequency_hz[9], 'y')])\
            ({ branch: sawflutter.report().campbell.branches }, document.querySelector('#campbell').chart)";
        let there: [f64; 2] = serde_json::from_value(page.value(at).await).unwrap();
        page.fingers(&[[there, there]]).await;
        let is_told = "document.querySelector('#mode').textContent.includes('Krein')";
        page.wait(is_told).await;
        page.fingers(&[
            [[150.0, 100.0], [100.0, 100.0]],
            [[200.0, 100.0], [250.0, 100.0]],
        ])
        .await;
        let some = page.value("sawflutter.speeds()").await;
        let [from, to] = [0, 1].map(|end| some[end].as_f64().unwrap());
        assert!(to - from < 1500.0, "{some}");
        assert_eq!(page.value(is_told).await, json!(true));
        page.close().await;
    });
}

/// The arrow keys choose points in the picture only, also if it is magnified.
#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn arrow_keys_stay_in_the_picture() {
    run(async {
        let page = Page::open(&["--accuracy", "draft"]).await;
        page.settle().await;
        for _ in 0..3 {
            page.wheel("#campbell .u-over", -300).await;
        }
        let speeds = page.value("sawflutter.speeds()").await;
        let chart = page.find("#campbell").await;
        chart.focus().await.unwrap();
        let [from, to] = [0, 1].map(|end| speeds[end].as_f64().unwrap());
        page.script(
            "for (let k = 0; k < 40; k++) document.querySelector('#campbell')\
            .dispatchEvent(new KeyboardEvent('keydown', { key: 'ArrowRight', cancelable: true }))",
        )
        .await;
        page.wait("document.querySelector('#mode').textContent.includes('Krein')")
            .await;
        let text = page.text("#mode").await;
        let (_, after) = text.split_once(" at ").unwrap();
        let rpm: f64 = after.split(' ').next().unwrap().parse().unwrap();
        assert!(from - 1.0 <= rpm && rpm <= to + 1.0, "{rpm} in {speeds}");
        page.close().await;
    });
}

#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn a_range_of_speeds_is_magnified_and_reset() {
    run(async {
        let page = Page::open(&["--accuracy", "draft"]).await;
        page.settle().await;
        let all = page.value("sawflutter.speeds()").await;
        assert_eq!(all, json!([0, 3000]));
        page.wheel("#campbell .u-over", -300).await;
        let some = page.value("sawflutter.speeds()").await;
        let [from, to] = [0, 1].map(|end| some[end].as_f64().unwrap());
        assert!(0.0 < from && from < to && to < 3000.0, "{some}");
        // A drag shifts the range, and its right end stops at the end of the sweep.
        drag(&page, "#campbell .u-over", 10, (-4, 0)).await;
        let_go(&page).await;
        let shifted = page.value("sawflutter.speeds()").await;
        let [from_shifted, to_shifted] = [0, 1].map(|end| shifted[end].as_f64().unwrap());
        assert!(from_shifted > from + 50.0, "{shifted}");
        assert!((to_shifted - from_shifted - (to - from)).abs() < 1e-6);
        drag(&page, "#campbell .u-over", 10, (-40, 0)).await;
        let_go(&page).await;
        assert_eq!(page.value("sawflutter.speeds()[1]").await, json!(3000));
        page.screenshot("1280-magnified.png").await;
        let told = page.text("#zoomed").await;
        assert!(told.contains("rpm of the sweep"), "{told}");
        // The plus key magnifies the chart, and a double click shows all speeds.
        let chart = page.find("#campbell").await;
        chart.focus().await.unwrap();
        chart.send_keys("+").await.unwrap();
        let closer = page.value("sawflutter.speeds()").await;
        let width = |speeds: &Value| speeds[1].as_f64().unwrap() - speeds[0].as_f64().unwrap();
        assert!(width(&closer) < 0.6 * (to - from), "{closer}");
        let over = page.find("#campbell .u-over").await;
        let twice = hand(&page).double_click_element(&over);
        twice.perform().await.unwrap();
        assert_eq!(page.value("sawflutter.speeds()").await, all);
        assert_eq!(
            page.value("document.querySelector('#zoomed').hidden").await,
            json!(true)
        );
        page.close().await;
    });
}
