//! What the tabs beside the chart show is what the commands of the same names print.

use serde_json::{Value, json};

use crate::browser::{Page, run, same};

impl Page {
    /// Asks for what a tab can compute and waits for its answer.
    async fn compute(&self, tab: &str) {
        self.find(&format!("#tab-{tab}"))
            .await
            .click()
            .await
            .unwrap();
        let start = self.find(&format!("#panel-{tab} .start button")).await;
        start.click().await.unwrap();
        self.wait(&format!("!!document.querySelector('#panel-{tab} pre')"))
            .await;
    }
}

#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn a_cut_is_the_one_that_the_command_line_finds() {
    run(async {
        let page = Page::open(&["--accuracy", "draft"]).await;
        page.settle().await;
        page.compute("cut").await;
        page.screenshot("1280-cut.png").await;
        let shown = page.text("#panel-cut pre").await;
        assert!(shown.contains("1800 rpm: stable"), "{shown}");
        assert!(shown.contains("2800 rpm: UNSTABLE"), "{shown}");
        let (_, printed) = page.command(&["cut"]).await;
        assert!(printed.starts_with(shown.trim_end()), "{shown}\n{printed}");
        let pictures = page
            .value("[...document.querySelectorAll('#panel-cut img')].filter((i) => i.naturalWidth > 0).length")
            .await;
        assert!(pictures.as_u64().unwrap() >= 2, "{pictures}");

        // Of an earlier scene as soon as the scene is another one.
        let old = "document.querySelector('#panel-cut .answer').classList.contains('earlier')";
        assert_eq!(page.value(old).await, json!(false));
        page.enter("blade.thickness_m", "3").await;
        page.settle().await;
        assert_eq!(page.value(old).await, json!(true));
        page.close().await;
    });
}

#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn a_fit_is_taken_over_and_a_part_that_lacks_is_put_in() {
    run(async {
        let page = Page::open(&["--accuracy", "draft"]).await;
        page.settle().await;
        page.value("sawflutter.state.set('runup', undefined, { structure: true })")
            .await;
        page.find("#tab-runup").await.click().await.unwrap();
        let disabled = "document.querySelector('#panel-runup .start button').disabled";
        assert_eq!(page.value(disabled).await, json!(true));
        let missing = page.find("#panel-runup .remark button").await;
        missing.click().await.unwrap();
        assert_eq!(page.value(disabled).await, json!(false));
        page.compute("runup").await;

        page.value("sawflutter.state.set('guides[0].stiffness_n_per_m', 1.5e7)")
            .await;
        page.compute("fit").await;
        let before = page.value("sawflutter.state.scene.guides[0]").await;
        page.find("#panel-fit .answer .tools button")
            .await
            .click()
            .await
            .unwrap();
        page.settle().await;
        let fitted = page.value("sawflutter.state.scene.guides[0]").await;
        assert!(!same(&before, &fitted), "{fitted}");
        page.close().await;
    });
}

#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn a_task_tells_how_far_it_is_and_can_be_stopped() {
    run(async {
        let page = Page::open(&["--accuracy", "draft"]).await;
        page.settle().await;
        page.find("#tab-study").await.click().await.unwrap();
        page.find("#panel-study .start button")
            .await
            .click()
            .await
            .unwrap();
        page.wait("document.querySelector('#panel-study progress').value > 0")
            .await;
        // A chart does not wait for a task.
        page.enter("blade.thickness_m", "3").await;
        page.settle().await;
        let stop = page.find("#panel-study .start button + button").await;
        stop.click().await.unwrap();
        page.wait("document.querySelector('#panel-study progress').hidden")
            .await;
        let shown = page
            .value("document.querySelector('#panel-study pre')")
            .await;
        assert_eq!(shown, Value::Null);
        page.close().await;
    });
}

/// The bar beside a field against two charts, of the number as it is and 1 % larger.
#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn the_influence_of_a_number_is_what_changing_it_does() {
    run(async {
        let page = Page::open(&[]).await;
        page.settle().await;
        let words = "document.querySelector(\"[id='blade.thickness_m']\").closest('.field').querySelector('.words')";
        page.wait(&format!("{words}.textContent !== ''")).await;
        let told = page.value(&format!("{words}.textContent")).await;
        let told = told.as_str().unwrap().to_owned();
        let critical = "sawflutter.report().critical_speeds[0].rpm";
        let before = page.value(critical).await.as_f64().unwrap();
        page.enter("blade.thickness_m", "2.828").await;
        page.settle().await;
        let change = page.value(critical).await.as_f64().unwrap() - before;
        assert!(
            told.contains(&format!("+1 %: critical +{change:.0}")),
            "{change}: {told}"
        );
        page.close().await;
    });
}

#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn inches_and_examples_show_the_same_saws() {
    run(async {
        let page = Page::open(&["--accuracy", "draft"]).await;
        page.settle().await;
        let scene = page.value("sawflutter.state.scene").await;
        page.find("#inches").await.click().await.unwrap();
        let field = "document.getElementById('blade.thickness_m').value";
        assert_eq!(page.value(field).await, json!("0.110236"));
        assert_eq!(page.value("sawflutter.state.scene").await, scene);
        page.enter("blade.thickness_m", "0.125").await;
        page.settle().await;
        let thickness = page.value("sawflutter.state.scene.blade.thickness_m").await;
        assert_eq!(thickness, json!(0.003175));
        page.find("#inches").await.click().await.unwrap();

        // A task knows units too, and an example is a saw that computes.
        let count = page
            .value("document.querySelectorAll('#examples option').length - 1")
            .await;
        for k in [1, count.as_u64().unwrap() - 1] {
            page.value(&format!(
                "(document.getElementById('examples').value = {k}, document.getElementById('examples').dispatchEvent(new Event('change')))"
            ))
            .await;
            page.settle().await;
            assert_eq!(page.text("#fault").await, "");
        }
        page.close().await;
    });
}
