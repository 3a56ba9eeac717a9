//! The fields of the selected part, the search, the first visit and the examples.

use serde_json::json;

use crate::browser::{PAD, Page, drag, let_go, run};

/// Paths of the groups that are shown.
const SHOWN: &str = "[...document.querySelectorAll('#fields details')].filter((part) => part.checkVisibility()).map((part) => part.dataset.path)";

#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn the_fields_of_the_selected_part_are_beside_the_blade_and_all_others_are_found() {
    run(async {
        let page = Page::open(&["--accuracy", "draft"]).await;
        page.resize(1440, 900).await;
        page.settle().await;
        let groups = "[...document.querySelectorAll('#fields > div > details')].filter((part) => part.checkVisibility()).map((part) => part.dataset.path)";
        assert_eq!(page.value(groups).await, json!(["blade"]));
        drag(&page, PAD, 2, (1, 0)).await;
        let_go(&page).await;
        page.settle().await;
        assert_eq!(
            page.value(SHOWN).await,
            json!([
                "guides",
                "guides[0]",
                "guides[0].arm",
                "guides[0].film",
                "guides[0].controller"
            ])
        );
        let places = "['#drawing', '#fields', '#result'].map((part) => document.querySelector(part).getBoundingClientRect().left)";
        let lefts: Vec<f64> = serde_json::from_value(page.value(places).await).unwrap();
        assert!(lefts.is_sorted(), "{lefts:?}");
        // A click on the plate selects the blade.
        page.script("document.querySelector('#drawing .plate').dispatchEvent(new MouseEvent('click', { bubbles: true }))")
            .await;
        assert_eq!(page.value(groups).await, json!(["blade"]));

        // A word of a name or of a key finds fields of all parts, and the blade stays while they are scrolled.
        page.find("#search")
            .await
            .send_keys("modulus")
            .await
            .unwrap();
        let fields = "[...document.querySelectorAll('#fields .field')].filter((part) => part.checkVisibility()).map((part) => part.querySelector('input, select, textarea').id)";
        assert_eq!(
            page.value(fields).await,
            json!(["blade.material.youngs_modulus_pa"])
        );
        page.script("[...document.querySelectorAll('.parts button')].at(-1).click(); document.querySelectorAll('#fields details').forEach((part) => (part.open = true)); scrollTo(0, 600)")
            .await;
        let top = "document.querySelector('#drawing').getBoundingClientRect().top >= 0";
        assert_eq!(page.value(top).await, json!(true));
        let count = page.value(&format!("{groups}.length")).await;
        assert!(count.as_u64().unwrap() > 10, "{count}");
        page.close().await;
    });
}

#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn a_first_visit_begins_with_three_cards_and_a_hint_on_the_pad() {
    run(async {
        let page = Page::open_first(&["--accuracy", "draft"]).await;
        page.settle().await;
        for (width, height) in [(1440, 900), (390, 844)] {
            page.resize(width, height).await;
            page.screenshot(&format!("{width}-first.png")).await;
        }
        page.resize(1280, 900).await;
        let cards = "[...document.querySelectorAll('#welcome .card')].map((card) => card.querySelector('strong').textContent)";
        assert_eq!(
            page.value(cards).await,
            json!([
                "The saw of a paper",
                "A saw with a collar",
                "A saw of your own"
            ])
        );
        let hint = "document.querySelector('.hint').checkVisibility()";
        assert_eq!(page.value(hint).await, json!(true));
        let second = page.find("#welcome .card:nth-child(2)").await;
        second.click().await.unwrap();
        page.settle().await;
        let name = page.value("sawflutter.state.scene.name").await;
        assert_eq!(name, json!("400 mm blade between collars"));
        let is_hidden = "document.querySelector('#welcome').hidden";
        assert_eq!(page.value(is_hidden).await, json!(true));
        page.script("delete window.sawflutter").await;
        page.driver.refresh().await.unwrap();
        page.wait("window.sawflutter?.computed.length > 0").await;
        assert_eq!(page.value(is_hidden).await, json!(true));

        // Each example has a picture with its pads.
        page.script("document.querySelector('.menu').open = true")
            .await;
        page.find("#gallery").await.click().await.unwrap();
        page.screenshot("1280-examples.png").await;
        let pads = "[...document.querySelectorAll('#examples .card')].find((card) => card.textContent.includes('six equal pads')).querySelectorAll('.pad').length";
        assert_eq!(page.value(pads).await, json!(6));
        page.find("#examples form button")
            .await
            .click()
            .await
            .unwrap();
        assert_eq!(
            page.value("document.querySelector('#examples').open").await,
            json!(false)
        );
        page.close().await;
    });
}

/// The first screen of a small window has both panels of the chart, and the cards leave at the first change.
#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn the_cards_leave_room_for_the_chart_and_leave_with_the_first_change() {
    run(async {
        let page = Page::open_first(&["--accuracy", "draft"]).await;
        let size = json!({ "width": 1280, "height": 720, "deviceScaleFactor": 1, "mobile": false });
        page.driver
            .chromium("Emulation.setDeviceMetricsOverride", size)
            .await
            .unwrap();
        page.settle().await;
        let bottom =
            "document.querySelector('#growth').getBoundingClientRect().bottom <= innerHeight";
        page.wait(bottom).await;
        page.screenshot("1280x720-first.png").await;
        drag(&page, PAD, 2, (1, 0)).await;
        let_go(&page).await;
        let seen =
            "['.hint', '#welcome'].map((part) => document.querySelector(part).checkVisibility())";
        assert_eq!(page.value(seen).await, json!([false, false]));
        page.close().await;
    });
}

/// A number that the saw lacks is found with its part, and the picture shows how the pad is held.
#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn the_search_offers_parts_that_the_saw_lacks() {
    run(async {
        let page = Page::open(&["--accuracy", "draft"]).await;
        page.settle().await;
        let look_for = |words: &str| {
            format!(
                "const search = document.getElementById('search'); search.value = {words:?}; search.dispatchEvent(new Event('input'))"
            )
        };
        for (words, wanted) in [
            ("wood", "This saw has no wood. Put wood in"),
            (
                "tension",
                "This saw has no roll tension. Put roll tension in",
            ),
            ("no such thing", "No quantity has this name."),
            ("thickness", ""),
            (
                "controller",
                "This saw has no controller. Put controller in",
            ),
        ] {
            page.script(&look_for(words)).await;
            let told = page.text("#offers").await;
            assert!(told.starts_with(wanted), "{words}: {told}");
        }
        page.script("document.querySelector('#offers button').click()")
            .await;
        page.wait("sawflutter.state.scene.guides[0].controller !== undefined")
            .await;
        let remark = "[data-path='guides[0].controller'] .remark";
        let told = page.text(remark).await;
        assert!(told.contains("(300 s) / (0.001 s + 1)"), "{told}");
        let name = page.text("[data-path='guides[0]'] title").await;
        assert!(name.contains("with a controller"), "{name}");
        page.close().await;
    });
}

/// A guide that lifts off gets a gap, and the name of the saw does not change its results.
#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn a_guide_gets_a_gap_and_a_name_computes_nothing() {
    run(async {
        let page = Page::open(&["--accuracy", "draft"]).await;
        page.settle().await;
        let jobs = "fetch('jobs').then((answer) => answer.json())";
        let before = page.value(jobs).await;
        page.enter("name", "my saw").await;
        page.wait("sawflutter.state.scene.name === 'my saw'").await;
        page.settle().await;
        assert_eq!(page.text("#saw-name").await, "my saw");
        assert_eq!(page.value(jobs).await, before);

        page.script("sawflutter.reveal('guides[0].contact')").await;
        let slider = "document.getElementById('guides[0].gap_m').closest('.field').querySelector('[type=range]').disabled";
        assert_eq!(page.value(slider).await, json!(true));
        let damping = slider.replace("gap_m", "damping_n_s_per_m");
        assert_eq!(page.value(&damping).await, json!(true));
        page.script("const contact = document.getElementById('guides[0].contact'); contact.value = 'one_sided'; contact.dispatchEvent(new Event('change'))")
            .await;
        page.wait("sawflutter.state.scene.guides[0].gap_m === 4e-5")
            .await;
        page.settle().await;
        assert_eq!(page.text("#fault").await, "");
        assert_eq!(page.value(slider).await, json!(false));
        page.close().await;
    });
}
