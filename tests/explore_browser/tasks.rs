//! The tabs beside the chart show the output of the commands of the same names.

use serde_json::{Value, json};

use crate::browser::{Page, run, same};

impl Page {
    /// Clicks on the map over thickness, from 2.24 to 3.36 mm, and speed, up to 1800 rpm, at a quarter of both axes.
    async fn is_set_by_a_click_on_the_map(&self) {
        self.script(
            "window.written = []; const own = CanvasRenderingContext2D.prototype.fillText; \
            CanvasRenderingContext2D.prototype.fillText = function (text, ...at) { \
                written.push(text); return own.call(this, text, ...at); }; \
            document.querySelector('#inches').click()",
        )
        .await;
        // The map is in the units of the form.
        self.wait("written.includes('thickness of the blade [in]')")
            .await;
        self.script("document.querySelector('#inches').click()")
            .await;
        // The lower edge of the panel is the longest line of the canvas row.
        let place = "((canvas) => { \
            const [scale, bottom] = [devicePixelRatio, canvas.height - 40 * devicePixelRatio]; \
            const row = canvas.getContext('2d').getImageData(0, bottom, canvas.width, 1).data; \
            const isInked = (k) => row[4 * k + 3] > 100; \
            const isLong = (k) => Array.from({ length: 30 }, (_, next) => k + next).every(isInked); \
            const inked = Array.from({ length: canvas.width }, (_, k) => k).filter(isLong); \
            return [inked[0], inked.at(-1) + 29, bottom].map((at) => at / scale); \
            })(document.querySelector('#panel-map .answer canvas'))";
        let place = self.value(place).await;
        let [left, right, bottom]: [f64; 3] = serde_json::from_value(place).unwrap();
        let click = format!(
            "const canvas = document.querySelector('#panel-map .answer canvas'); \
             const box = canvas.getBoundingClientRect(); \
             canvas.dispatchEvent(new MouseEvent('click', {{ clientX: box.left + {}, clientY: box.top + {} }}))",
            0.75 * left + 0.25 * right,
            bottom - 75.0
        );
        self.script(&click).await;
        let set = "[1e3 * sawflutter.state.scene.blade.thickness_m, sawflutter.state.scene.operating_rpm]";
        let [thickness_mm, rpm]: [f64; 2] = serde_json::from_value(self.value(set).await).unwrap();
        assert!((thickness_mm - 2.52).abs() < 0.01, "{thickness_mm}");
        assert!((rpm - 450.0).abs() < 15.0, "{rpm}");
        // The map contains the new saw, so that it is not one of an earlier scene.
        let old = "document.querySelector('#panel-map .answer').classList.contains('earlier')";
        assert_eq!(self.value(old).await, json!(false));
    }

    /// Starts the computation of a tab and waits for its answer.
    pub async fn compute(&self, tab: &str) {
        self.open_tab_of(tab).await;
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
        assert!(shown.contains("Can it cut at 1800 rpm? "), "{shown}");
        assert!(
            shown.contains("Can it cut at 2800 rpm? NO: growth of "),
            "{shown}"
        );
        let (_, printed) = page.command(&["cut"]).await;
        assert!(printed.starts_with(shown.trim_end()), "{shown}\n{printed}");
        // The verdicts come first, and an unstable saw has no deflection.
        let lines = "[...document.querySelectorAll('#panel-cut .answer strong, #panel-cut dd')].map((line) => line.textContent)";
        let json = page.value(lines).await;
        let first: Vec<String> = serde_json::from_value(json).unwrap();
        assert!(first[0].starts_with("Can it cut at 1800 rpm? "));
        assert!(first[1].starts_with("Can it cut at 2800 rpm? NO: growth of "));
        assert_eq!(first.last().unwrap(), "leaves the linear model");
        let pictures = page
            .value("[...document.querySelectorAll('#panel-cut .answer canvas')].filter((canvas) => canvas.width > 0).length")
            .await;
        assert!(pictures.as_u64().unwrap() >= 2, "{pictures}");

        // A figure says what its data have under the pointer: the values of its axes, and the name of an item as a tooltip.
        let read = "((canvas) => { \
            const { left, top, width, height } = canvas.getBoundingClientRect(); \
            const names = new Set(); \
            for (let x = 60; x < width; x += 6) for (let y = 20; y < height - 40; y += 6) { \
                canvas.dispatchEvent(new PointerEvent('pointermove', { clientX: left + x, clientY: top + y })); \
                names.add(canvas.title); \
            } \
            canvas.dispatchEvent(new PointerEvent('pointermove', { clientX: left + 100, clientY: top + 100 })); \
            return [canvas.parentElement.querySelector('.at').textContent, [...names]]; \
            })(document.querySelector('#panel-cut .answer canvas'))";
        let (values, names): (String, Vec<String>) =
            serde_json::from_value(page.value(read).await).unwrap();
        assert!(
            values.contains(" s, ") && values.ends_with(" mm"),
            "{values}"
        );
        for name in ["deflection", "growth by the eigenvalues"] {
            assert!(names.iter().any(|own| own == name), "{names:?}");
        }

        // An answer is marked as one of an earlier scene as soon as the scene changes.
        let old = "document.querySelector('#panel-cut .answer').classList.contains('earlier')";
        assert_eq!(page.value(old).await, json!(false));
        let changed = format!("sawflutter.state.set('blade.thickness_m', 0.003); return {old}");
        assert_eq!(page.script(&changed).await, json!(true));
        page.close().await;
    });
}

/// An answer that takes little time comes when its tab is opened, and again after a change of the scene.
#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn a_cheap_answer_starts_by_itself() {
    run(async {
        let page = Page::drafted("collar-400mm").await;
        page.open_tab_of("response").await;
        let told = "document.querySelector('#panel-response pre')?.textContent ?? ''";
        page.wait(&format!(
            "({told}).includes('Deflection at the cut at 3800 rpm under 1 N')"
        ))
        .await;
        let unbounded =
            "[...document.querySelectorAll('#panel-response dd')].map((dd) => dd.textContent)";
        assert_eq!(page.value(unbounded).await, json!(["unbounded"]));
        page.script("sawflutter.state.set('operating_rpm', 3700)")
            .await;
        page.wait(&format!(
            "({told}).includes('Deflection at the cut at 3700 rpm under 1 N')"
        ))
        .await;
        page.close().await;
    });
}

#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn a_fit_is_taken_over_and_a_missing_part_is_added() {
    run(async {
        let page = Page::open(&["--accuracy", "draft"]).await;
        page.settle().await;
        page.value("sawflutter.state.set('runup', undefined, { structure: true })")
            .await;
        page.open_tab_of("runup").await;
        let disabled = "document.querySelector('#panel-runup .start button').disabled";
        assert_eq!(page.value(disabled).await, json!(true));
        let missing = page.find("#panel-runup .remark button").await;
        missing.click().await.unwrap();
        page.wait(&format!("!{disabled}")).await;
        page.compute("runup").await;

        page.value("sawflutter.state.set('guides[0].stiffness_n_per_m', 1.5e7)")
            .await;
        // Above the first critical speed the table is that of other modes, and the fit makes no saw of it.
        page.value("sawflutter.state.set('measured.rows', sawflutter.state.scene.measured.rows.filter(({ rpm }) => rpm <= 1250), { structure: true })")
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

/// The numbers of a map are chosen in its tab, within usual bounds.
#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn a_response_a_gap_a_size_and_a_map_are_those_of_the_command_line() {
    run(async {
        let folder = tempfile::tempdir().unwrap();
        let mut scene: Value =
            serde_json::from_str(include_str!("../../scenes/paper.json")).unwrap();
        scene["accuracy"] = json!("draft");
        scene["sweep"] = json!({ "from_rpm": 0, "to_rpm": 1800 });
        scene["operating_rpm"] = json!(1200);
        let path = folder.path().join("short-sweep.json");
        std::fs::write(&path, scene.to_string()).unwrap();
        let page = Page::open(&[path.to_str().unwrap()]).await;
        page.settle().await;
        page.open_tab_of("gap").await;
        let disabled = "document.querySelector('#panel-gap .start button').disabled";
        assert_eq!(page.value(disabled).await, json!(true));
        page.script(
            "const guides = structuredClone(sawflutter.state.scene.guides); \
             Object.assign(guides[0], { contact: 'one_sided', gap_m: 5e-5 }); \
             sawflutter.state.set('guides', guides, { structure: true })",
        )
        .await;
        page.settle().await;
        let map = ["map", "--x", "blade.thickness_m=2.24mm..3.36mm"];
        let size = ["size", "--vary", "blade.thickness_m"];
        for command in [&["response"], &["gap"], size.as_slice(), map.as_slice()] {
            let tab = command[0];
            page.compute(tab).await;
            page.screenshot(&format!("1280-{tab}.png")).await;
            let shown = page.text(&format!("#panel-{tab} pre")).await;
            let (_, printed) = page.command(command).await;
            assert!(printed.starts_with(shown.trim_end()), "{shown}\n{printed}");
            let pictures = format!(
                "[...document.querySelectorAll('#panel-{tab} .answer canvas')].filter((canvas) => canvas.width > 0).length"
            );
            assert!(page.value(&pictures).await.as_u64().unwrap() >= 1, "{tab}");
        }
        page.is_set_by_a_click_on_the_map().await;
        page.close().await;
    });
}

#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn a_task_reports_its_progress_and_can_be_stopped() {
    run(async {
        let page = Page::open(&["--accuracy", "draft"]).await;
        page.settle().await;
        page.open_tab_of("study").await;
        page.find("#panel-study .start button")
            .await
            .click()
            .await
            .unwrap();
        page.wait("document.querySelector('#panel-study progress').value > 0")
            .await;
        // The saws that are finished so far are drawn.
        page.wait("document.querySelector('#panel-study .so-far img')?.naturalWidth > 0")
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
        let told = page.text("#panel-study .start .remark").await;
        assert!(told.starts_with("ended early, saws: "), "{told}");
        page.close().await;
    });
}

/// A saw whose sweep ends soon after its first flutter is placed within seconds.
#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn a_placement_tells_its_steps_and_ends_with_the_text_of_the_command_line() {
    run(async {
        let folder = tempfile::tempdir().unwrap();
        let mut scene: Value =
            serde_json::from_str(include_str!("../../scenes/paper.json")).unwrap();
        scene["accuracy"] = json!("draft");
        scene["sweep"] = json!({ "from_rpm": 0, "to_rpm": 2300 });
        let path = folder.path().join("short-sweep.json");
        std::fs::write(&path, scene.to_string()).unwrap();
        let page = Page::open(&[path.to_str().unwrap()]).await;
        page.settle().await;
        page.open_tab_of("place").await;
        let start = page.find("#panel-place .start button").await;
        start.click().await.unwrap();
        let told = "document.querySelector('#panel-place .start .remark').textContent";
        page.wait(&format!("{told}.startsWith('refinement')")).await;
        page.wait("!!document.querySelector('#panel-place pre')")
            .await;
        page.screenshot("1280-place.png").await;
        let shown = page.text("#panel-place pre").await;
        let (_, printed) = page.command(&["place"]).await;
        assert!(printed.starts_with(shown.trim_end()), "{shown}\n{printed}");
        page.close().await;
    });
}

/// The text beside a field is compared with the charts of the number itself and of one that is 1 % larger.
#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn the_influence_of_a_number_is_what_changing_it_does() {
    run(async {
        let page = Page::open(&[]).await;
        page.settle().await;
        let words = "document.querySelector(\"[id='blade.thickness_m']\").closest('.field').querySelector('.words')";
        page.wait(&format!("{words}.textContent !== ''")).await;
        let told = page
            .value(&format!("{words}.textContent"))
            .await
            .as_str()
            .unwrap()
            .to_owned();
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
        let words = "[...document.querySelectorAll('.influence .words')].map((words) => words.textContent).join('')";
        page.wait(&format!("{words} !== ''")).await;
        page.script("document.querySelector('#inches').click()")
            .await;
        // The results do not depend on the unit.
        let known = page.value(words).await;
        assert!(known.as_str().unwrap().contains("critical"), "{known}");
        let field = "document.getElementById('blade.thickness_m').value";
        assert_eq!(page.value(field).await, json!("0.110236"));
        assert_eq!(page.value("sawflutter.state.scene").await, scene);
        page.enter("blade.thickness_m", "0.125").await;
        page.settle().await;
        let thickness = page.value("sawflutter.state.scene.blade.thickness_m").await;
        assert_eq!(thickness, json!(0.003175));
        page.script("document.querySelector('#inches').click()")
            .await;

        // A tolerance in a field keeps its length when the unit changes.
        page.open_tab_of("study").await;
        page.enter("study:blade.thickness_m", "0.254").await;
        page.script("document.querySelector('#inches').click()")
            .await;
        let tolerance = "document.getElementById('study:blade.thickness_m')";
        assert_eq!(
            page.value(&format!("{tolerance}.value")).await,
            json!("0.254 mm")
        );
        let label = format!("{tolerance}.closest('.field').textContent");
        assert_eq!(page.value(&label).await, json!("± thickness, in"));
        page.script("document.querySelector('#inches').click()")
            .await;
        page.find("#tab-chart").await.click().await.unwrap();

        // An example from the menu can be computed.
        let count = page
            .value("document.querySelectorAll('#examples .card').length")
            .await;
        page.script("window.confirm = () => true").await;
        for k in [1, count.as_u64().unwrap() as usize - 1] {
            page.open_example(k).await;
            page.settle().await;
            assert_eq!(page.text("#fault").await, "");
        }
        page.close().await;
    });
}

#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn a_task_that_cannot_be_done_says_why_in_the_words_of_the_form() {
    run(async {
        let page = Page::open(&["--accuracy", "draft"]).await;
        page.settle().await;
        let cases = [
            (
                "place",
                "document.querySelector('#place-least').value = '-9'",
                "Lowest allowed first critical speed must be above 0, usual range 10 to 100000 rpm (you gave -9); speeds are positive; for a saw that turns the other way change the sign of every angle",
            ),
            (
                "study",
                "document.querySelectorAll('#panel-study input').forEach((i) => (i.value = '0'))",
                "At least one tolerance must be above 0: without one all saws are the same",
            ),
            (
                "cut",
                "sawflutter.state.set('blade.thickness_m', -1)",
                "Thickness must be above 0 mm; usual: 0.1 to 40 mm",
            ),
        ];
        for (tab, script, wanted) in cases {
            page.open_tab_of(tab).await;
            page.script(script).await;
            let start = page.find(&format!("#panel-{tab} .start button")).await;
            start.click().await.unwrap();
            let told = format!("#panel-{tab} .fault");
            page.wait(&format!(
                "document.querySelector('{told}').textContent !== ''"
            ))
            .await;
            assert_eq!(page.text(&told).await, wanted);
        }
        page.script("sawflutter.state.undo(); sawflutter.state.set('measured', undefined)")
            .await;
        page.open_tab_of("fit").await;
        let disabled = "document.querySelector('#panel-fit .start button').disabled";
        assert_eq!(page.value(disabled).await, json!(true));
        let told = page.text("#panel-fit").await;
        assert!(told.contains("no measured frequencies yet"), "{told}");
        page.close().await;
    });
}

/// The main numbers of an answer have three digits, and follow the units of the form.
#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn answers_are_in_the_units_of_the_form() {
    run(async {
        let page = Page::open(&["--accuracy", "draft"]).await;
        page.settle().await;
        page.compute("runup").await;
        let told = "[...document.querySelectorAll('#panel-runup .fact')].map((fact) => [...fact.children].map((part) => part.textContent))";
        let metric = page.value(told).await;
        assert_eq!(metric[0][0], json!("largest deflection of the rim"));
        let number = |told: &Value, unit: &str| -> f64 {
            let text = told[0][1].as_str().unwrap();
            text.strip_suffix(unit)
                .unwrap_or_else(|| panic!("{text}"))
                .trim()
                .parse()
                .unwrap()
        };
        let (out, _) = page.command(&["runup"]).await;
        let content = std::fs::read(out.join("runup.json")).unwrap();
        let report: Value = serde_json::from_slice(&content).unwrap();
        let largest = report["largest_deflection_m"].as_f64().unwrap();
        let in_mm = number(&metric, "mm");
        assert!(
            (in_mm / (1e3 * largest) - 1.0).abs() < 5e-3,
            "{in_mm} {largest}"
        );
        page.script("document.querySelector('#inches').click()")
            .await;
        let in_inches = number(&page.value(told).await, "in");
        assert!((25.4 * in_inches / in_mm - 1.0).abs() < 1e-2, "{in_inches}");
        page.script("document.querySelector('#inches').click()")
            .await;

        page.script("sawflutter.state.set('guides[0].stiffness_n_per_m', 1.5e7)")
            .await;
        page.settle().await;
        page.compute("fit").await;
        let fit = page.text("#panel-fit .numbers-of-answer").await;
        assert!(fit.contains("stiffness of guide 115 → "), "{fit}");
        page.resize(1440, 1000).await;
        page.screenshot("1440-fit.png").await;
        page.resize(390, 844).await;
        page.screenshot("390-fit.png").await;
        page.close().await;
    });
}
