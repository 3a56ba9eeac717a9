//! Every quantity can be set with the pointer, with the keyboard and in its field.

use std::time::{Duration, Instant};

use serde_json::{Value, json};

use crate::browser::{Key, PAD, PATIENCE, Page, drag, hand, let_go, run, same};

#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn a_bad_value_is_refused_at_its_field_and_the_chart_stays() {
    run(async {
        let page = Page::open(&["--accuracy", "draft"]).await;
        page.settle().await;
        let before = page.text("#facts").await;
        page.enter("blade.thickness_m", "-2.8").await;
        page.wait("document.querySelector('[aria-invalid]') !== null")
            .await;

        // The chart is marked, and the message has the unit of the field and is at the field only.
        assert_eq!(page.value("sawflutter.isEarlier()").await, json!(true));
        // The place of the verdict has the refusal, and not the answer for another saw.
        let shown = "['#verdict', '#instead'].map((part) => document.querySelector(part).checkVisibility())";
        assert_eq!(page.value(shown).await, json!([false, true]));
        assert!(page.text("#instead").await.starts_with("Not computed"));
        let told = page.text("[id='blade.thickness_m:fault']").await;
        assert_eq!(told, "Thickness must be above 0 mm; usual: 0.1 to 40 mm");
        assert_eq!(page.text("#fault").await, "");
        assert_eq!(
            page.text("#facts").await,
            before,
            "the last good chart has gone"
        );
        page.screenshot("1280-refused.png").await;
        // A refusal is of the text that was there.
        let field = page.find("[id='blade.thickness_m']").await;
        field.send_keys("1").await.unwrap();
        assert_eq!(page.text("[id='blade.thickness_m:fault']").await, "");

        // A refused speed, which is always in sight, leaves the form as it is.
        page.enter("operating_rpm", "-5").await;
        page.wait("document.getElementById('operating_rpm:fault').textContent !== ''")
            .await;
        let pressed = "document.querySelector('.parts [aria-pressed=true]').textContent";
        assert_eq!(page.value(pressed).await, json!("blade"));
        page.enter("operating_rpm", "1800").await;

        page.enter("blade.thickness_m", "3.0").await;
        page.settle().await;
        assert_eq!(page.text("[id='blade.thickness_m:fault']").await, "");
        assert_eq!(page.value("sawflutter.isEarlier()").await, json!(false));
        assert_ne!(page.text("#facts").await, before);
        page.close().await;
    });
}

#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn a_pad_is_resized_by_its_corner() {
    run(async {
        let page = Page::open(&["--accuracy", "draft"]).await;
        page.settle().await;
        let pad = "sawflutter.state.scene.guides[0]";
        let before = page.value(pad).await;
        drag(&page, "[data-path='guides[0]'] .handle", 20, (1, -1)).await;
        let_go(&page).await;
        page.settle().await;
        let after = page.value(pad).await;
        let [radial, tangential] = ["radial_length_m", "tangential_length_m"];
        assert!(before[radial] != after[radial] || before[tangential] != after[tangential]);
        for same in ["radius_m", "angle_deg", "stiffness_n_per_m"] {
            assert_eq!(before[same], after[same], "{same}");
        }
        assert!(page.text("#facts").await.contains(" → "));
        page.close().await;
    });
}

#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn a_pad_is_moved_and_put_back_by_keyboard_alone() {
    run(async {
        let page = Page::open(&["--accuracy", "draft"]).await;
        page.settle().await;
        let radius = "sawflutter.state.scene.guides[0].radius_m";
        page.script("document.querySelector(\"[data-path='guides[0]']\").focus()")
            .await;
        for key in [Key::Up, Key::Up, Key::Up] {
            hand(&page).send_keys(key + "").perform().await.unwrap();
        }
        page.settle().await;
        assert_eq!(page.value(radius).await, json!(0.203));
        assert!(page.text("#facts").await.contains(" → "));
        let moved = page.text("[data-path='guides[0]'] title").await;
        assert!(moved.contains("radius 203 mm"), "{moved}");
        // Key presses in a row are one step of undo.
        hand(&page)
            .key_down(Key::Control)
            .send_keys("z")
            .key_up(Key::Control)
            .perform()
            .await
            .unwrap();
        page.settle().await;
        assert_eq!(page.value(radius).await, json!(0.2));
        page.close().await;
    });
}

#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn heat_is_set_by_its_field() {
    run(async {
        let scene = concat!(
            env!("CARGO_MANIFEST_DIR"),
            "/scenes/collar-400mm-tensioned.json"
        );
        let page = Page::open(&[scene]).await;
        page.settle().await;
        let before = page.text("#facts").await;
        let opened =
            "document.querySelectorAll('[data-path^=membrane]').forEach((d) => (d.open = true))";
        page.script(opened).await;
        page.enter("membrane.temperature.rim_rise_k", "30").await;
        page.settle().await;
        let after = page.text("#facts").await;
        assert!(
            before.contains("33.6 K") && after.contains(" → "),
            "{before} {after}"
        );
        page.screenshot("1280-heat.png").await;
        let out = page.command_line().await;
        let content = std::fs::read(out.join("report.json")).unwrap();
        let report: Value = serde_json::from_slice(&content).unwrap();
        assert!(same(&page.value("sawflutter.report()").await, &report));
        page.close().await;
    });
}

#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn parts_are_added_with_values_that_can_be_computed() {
    run(async {
        let page = Page::open(&["--accuracy", "draft"]).await;
        page.settle().await;
        let press = |words: &'static str| {
            let find = format!(
                "[...document.querySelectorAll('#fields button')].find((b) => b.textContent === {words:?}).click()"
            );
            let page = &page;
            async move {
                page.script(&find).await;
                page.settle().await;
                assert_eq!(page.text("#fault").await, "", "{words}");
                assert_eq!(
                    page.value("sawflutter.isEarlier()").await,
                    json!(false),
                    "{words}"
                );
            }
        };
        press("Add a guide").await;
        press("Add a guide").await;
        let angles = page
            .value("sawflutter.state.scene.guides.map((pad) => pad.angle_deg)")
            .await;
        assert_eq!(angles, json!([-55, 125, -145]));
        press("Put membrane in").await;
        press("Put temperature in").await;
        press("Add a roll tension").await;
        press("Add a residual stress").await;
        press("Take cut out").await;
        press("Put cut in").await;
        press("Put damping in").await;
        page.screenshot("1280-parts.png").await;
        // The accessible names of all controls differ.
        let names = "[...document.querySelectorAll('#fields input, #fields select, #fields textarea')].map((field) => field.getAttribute('aria-label') ?? field.id)";
        let twice = page
            .value(&format!(
                "((all) => all.filter((name, i) => all.indexOf(name) !== i))({names})"
            ))
            .await;
        assert_eq!(twice, json!([]));
        page.close().await;
    });
}

#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn refusals_are_in_the_unit_of_the_field_and_name_what_a_designer_can_use() {
    run(async {
        let page = Page::open(&["--accuracy", "draft"]).await;
        page.settle().await;
        let opened = "document.querySelectorAll('#fields details').forEach((d) => (d.open = true))";
        page.script(opened).await;
        let cases = [
            (
                "blade.outer_diameter_m",
                "1e25",
                "Outer diameter is too large; usual: 40 to 5000 mm",
            ),
            ("blade.teeth", "2.5", "Teeth must be a whole number"),
            (
                "blade.material.youngs_modulus_pa",
                "0",
                "Young's modulus must be above 0 GPa; usual: 40 to 750 GPa",
            ),
            (
                "blade.material.poisson_ratio",
                "0.7",
                "Poisson ratio must be above -1 and below 0.5",
            ),
            (
                "guides[0].radius_m",
                "900",
                "Radius must be such that the pad lies on the blade, which reaches from r = 100 to 355 mm",
            ),
            (
                "guides[0].stiffness_n_per_m",
                "stiff",
                "Stiffness must be a number in MN/m, or with a unit of the same kind; write it like 20 or 2e1, with or without a unit",
            ),
            (
                "guides[0].tangential_length_m",
                "0",
                "Tangential length must be zero exactly when the radial length of the guide is",
            ),
            (
                "cut.depth_m",
                "0",
                "Depth must be above 0 mm; usual: 0.1 to 3000 mm",
            ),
            (
                "cut.chart_rpm",
                "-5",
                "Speed of the cut in the diagram must be above 0 rpm; usual: 30 to 60000 rpm",
            ),
            (
                "cut.idle_s",
                "601",
                "Time before and after the cut must be between 0 and 600 s",
            ),
            (
                "sweep.to_rpm",
                "0",
                "Last speed of the sweep must be more than the first speed of the sweep (0 rpm)",
            ),
            (
                "probe.radius_m",
                "10",
                "Radius must be on the blade, from 100 to 355 mm",
            ),
        ];
        for (path, typed, wanted) in cases {
            let before = page
                .value(&format!("document.getElementById({path:?}).value"))
                .await;
            page.enter(path, typed).await;
            let fault = format!("[id='{path}:fault']");
            page.wait(&format!(
                "document.querySelector({fault:?}).textContent !== ''"
            ))
            .await;
            assert_eq!(page.text(&fault).await, wanted, "{path}: {typed}");
            assert_eq!(page.text("#fault").await, "");
            // Without a text before, the backspace key empties the field.
            let before = before.as_str().filter(|text| !text.is_empty());
            page.enter(path, before.unwrap_or("\u{e003}")).await;
            page.wait(&format!(
                "document.querySelector({fault:?}).textContent === ''"
            ))
            .await;
            page.settle().await;
        }
        page.close().await;
    });
}

/// A number may be refused because of another one: both fields are marked.
#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn a_refusal_marks_the_field_that_was_changed() {
    run(async {
        let page = Page::open(&["--accuracy", "draft"]).await;
        page.settle().await;
        page.enter("blade.thickness_m", "1e-6").await;
        page.wait("document.querySelector('[aria-invalid]') !== null")
            .await;
        let told = page.text("[id='blade.thickness_m:fault']").await;
        assert_eq!(page.text("[id='sweep.to_rpm:fault']").await, told);
        assert!(told.contains("waves"), "{told}");
        page.enter("blade.thickness_m", "2.8").await;
        page.settle().await;
        assert_eq!(page.text("[id='blade.thickness_m:fault']").await, "");
        page.close().await;
    });
}

/// A field reads what the command line reads, also with a unit, and what it does not read stays in the field and out of
/// the scene.
#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn a_field_reads_numbers_as_the_command_line_does() {
    run(async {
        let page = Page::open(&["--accuracy", "draft"]).await;
        page.settle().await;
        let fault = "[id='operating_rpm:fault']";
        let before = page.value("JSON.stringify(sawflutter.state.scene)").await;
        for (typed, wanted) in [
            (
                "1.800",
                "Operating speed must be 1800 or 1.8; write one of these",
            ),
            (
                "1,800",
                "Operating speed must be 1800 or 1.8; write one of these",
            ),
            (
                "0x10",
                "Operating speed must be a number in rpm, or with a unit of the same kind; \
              write units like mm, kN/mm, g/cm^3 or rad/s, or leave the unit out",
            ),
        ] {
            page.enter("operating_rpm", typed).await;
            page.wait(&format!(
                "document.querySelector({fault:?}).textContent === {wanted:?}"
            ))
            .await;
            let now = page.value("JSON.stringify(sawflutter.state.scene)").await;
            assert_eq!(now, before, "{typed}");
        }
        for (path, typed, wanted) in [
            ("operating_rpm", "30 rev/s", json!(1800)),
            ("blade.thickness_m", "2,850", json!(0.00285)),
            ("blade.thickness_m", "1/8 in", json!(0.003175)),
            ("blade.outer_diameter_m", "28in", json!(0.7112)),
        ] {
            page.enter(path, typed).await;
            page.wait(&format!(
                "{path:?}.split('.').reduce((part, key) => part[key], sawflutter.state.scene) === {wanted}"
            ))
            .await;
        }
        assert_eq!(page.text(fault).await, "");
        page.settle().await;
        page.close().await;
    });
}

/// Script that puts all parts into the scene, edits every field of the form, and returns the paths of fields whose text did not
/// reach the scene, and those of numbers without a field. No chart is computed.
const EDIT_EVERY_FIELD: &str = "{
    const ask = window.fetch;
    window.fetch = (path, how) => (/^(chart|critical|influence)/.test(path) ? new Promise(() => {}) : ask(path, how));
    const { fields } = await (await ask('start')).json();
    const { state } = sawflutter;
    let { scene } = state;
    const lists = [...new Set(fields.flatMap(({ path }) => path.match(/^.+[[][\\]](?=[.])/) ?? []))];
    const blocks = [...new Set(fields.map(({ path }) => path.split('.').slice(0, -1).join('.')))];
    for (const path of ['guides[]', ...blocks.map((block) => block.replace(/^guides[[][\\]][.]/, 'guides[0].')), ...lists]) {
        const answer = await ask('part', { method: 'POST', body: JSON.stringify({ scene, path }) });
        if (answer.ok) scene = await answer.json();
    }
    state.replace(scene);
    const text = () => JSON.stringify(state.scene);
    const edited = new Set();
    const failed = [];
    // A choice may change which fields there are, and is made last, the kind of the mount after the others.
    const rank = (path) => document.getElementById(path).matches('select') + path.endsWith('.kind');
    const paths = [...document.querySelectorAll('#fields .field > label')].map((label) => label.htmlFor);
    for (const path of paths.sort((x, y) => rank(x) - rank(y))) {
        const before = text();
        const control = document.getElementById(path);
        const isList = control.closest('.list') !== null;
        control.value = control.matches('select') ? [...control.options].find(({ selected }) => !selected).value
            : isList ? '1, 2.5, 4' : control.matches('textarea') ? 'one' : control.value === '2' ? '3' : '2';
        control.dispatchEvent(new Event('change'));
        for (let tries = 0; tries < 100 && text() === before; tries++) await new Promise((resolve) => setTimeout(resolve, 20));
        if (text() === before) failed.push(path);
        edited.add(path.replace(/[[]\\d+[\\]]/g, '[]') + (isList ? '[]' : ''));
    }
    const lacking = fields.map(({ path }) => path).filter((path) => !path.startsWith('measured') && !edited.has(path));
    return [failed, lacking]; }";

/// A typed number is drawn as a draft first, and then with the tolerance of the scene.
#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn a_typed_number_gets_a_draft_first() {
    run(async {
        let page = Page::drafted("collar-400mm").await;
        let kinds = "sawflutter.computed.map(([kind]) => kind)";
        page.script("sawflutter.computed.length = 0").await;
        page.enter("blade.thickness_m", "2.9").await;
        page.settle().await;
        assert_eq!(page.value(kinds).await, json!(["draft", "scene"]));
        page.close().await;
    });
}

#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn every_field_of_the_schema_can_be_edited() {
    run(async {
        let page = Page::drafted("collar-400mm").await;
        assert_eq!(page.awaited(EDIT_EVERY_FIELD).await, json!([[], []]));
        page.close().await;
    });
}

#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn undo_in_a_field_undoes_the_scene() {
    run(async {
        let page = Page::open(&["--accuracy", "draft"]).await;
        page.settle().await;
        let thickness = "[sawflutter.state.scene.blade.thickness_m, document.getElementById('blade.thickness_m').value]";
        page.enter("blade.thickness_m", "3").await;
        page.settle().await;
        let field = page.find("[id='blade.thickness_m']").await;
        // The first undo restores the text of the field, as in every field; the next one restores the scene.
        field.send_keys("9").await.unwrap();
        field.send_keys(Key::Control + "z").await.unwrap();
        assert_eq!(page.value(thickness).await, json!([0.003, "3"]));
        let field_again = page.find("[id='blade.thickness_m']").await;
        field_again.send_keys(Key::Control + "z").await.unwrap();
        page.settle().await;
        assert_eq!(page.value(thickness).await, json!([0.0028, "2.8"]));
        let last_field = page.find("[id='blade.thickness_m']").await;
        last_field.send_keys(Key::Control + "y").await.unwrap();
        page.settle().await;
        assert_eq!(page.value(thickness).await, json!([0.003, "3"]));
        page.close().await;
    });
}

#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn escape_ends_a_drag_and_restores_the_saw() {
    run(async {
        let page = Page::open(&["--accuracy", "draft"]).await;
        page.settle().await;
        let scene = "JSON.stringify(sawflutter.state.scene)";
        let before = page.value(scene).await;
        drag(&page, PAD, 5, (6, 0)).await;
        assert_ne!(page.value(scene).await, before);
        page.script("dispatchEvent(new KeyboardEvent('keydown', { key: 'Escape' }))")
            .await;
        assert_eq!(page.value(scene).await, before);
        let moved = hand(&page).move_by_offset(30, 0);
        moved.perform().await.unwrap();
        let_go(&page).await;
        page.settle().await;
        assert_eq!(page.value(scene).await, before);
        assert_eq!(
            page.value("sawflutter.state.canUndo").await,
            json!(false),
            "an empty step of undo"
        );
        page.close().await;
    });
}

#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn a_pad_that_is_dragged_off_the_blade_stays_on_it() {
    run(async {
        let page = Page::open(&["--accuracy", "draft"]).await;
        page.settle().await;
        let radius = "sawflutter.state.scene.guides[0].radius_m";
        let edge = |name: &str| format!("{radius} === 0.5 * sawflutter.state.scene.blade.{name}");
        drag(&page, PAD, 12, (30, 0)).await;
        let_go(&page).await;
        page.settle().await;
        assert_eq!(page.value(&edge("outer_diameter_m")).await, json!(true));
        // The pad is dragged into the middle of the bore.
        let way = page
            .value(&format!(
                "['#drawing', {PAD:?}].map((part) => document.querySelector(part).getBoundingClientRect())\
                 .map((box) => [box.left + box.width / 2, box.top + box.height / 2])"
            ))
            .await;
        let [to, from]: [[f64; 2]; 2] = serde_json::from_value(way).unwrap();
        let step = [0, 1].map(|k| ((to[k] - from[k]) / 10.0).round() as i64);
        drag(&page, PAD, 10, (step[0], step[1])).await;
        let_go(&page).await;
        page.settle().await;
        assert_eq!(page.value(&edge("inner_diameter_m")).await, json!(true));
        assert_eq!(page.text("#fault").await, "");
        page.close().await;
    });
}

/// Script that tries the changes that the form and the tabs make to the saws of the gallery, and returns those that are
/// refused as "name: path: text of the button: reason".
const REFUSED: &str = "
    const [{ Form }, { lacks }, begun] = await Promise.all([
        import('/page/form.js'), import('/page/parts.js'), fetch('start').then((answer) => answer.json()),
    ]);
    const refused = [];
    const asked = new Set();
    const ask = async (path, body, words) => {
        const key = path + body;
        if (asked.has(key)) return;
        asked.add(key);
        const abort = new AbortController();
        const answer = await fetch(path, { method: 'POST', body, signal: abort.signal });
        // A task that reports its progress was not refused; a chart may be refused after its first results.
        const first = async () => new TextDecoder().decode((await answer.body.getReader().read()).value);
        const lines = (await (path.startsWith('chart') ? answer.text() : first())).trim().split('\\n');
        const line = path.startsWith('chart') ? lines.at(-1) : lines[0];
        if (answer.status !== 200 || line.startsWith('{\"refusal')) refused.push(`${words}: ${line}`);
        abort.abort();
    };
    const putIn = async (scene, path) => {
        const answer = await fetch('part', { method: 'POST', body: JSON.stringify({ scene, path }) });
        if (answer.status !== 200) refused.push(`${scene.name}: ${path}: ${await answer.text()}`);
        return answer.status === 200 ? answer.json() : scene;
    };
    const buttons = async (scene) => {
        const place = document.createElement('div');
        new Form(place, begun, { scene }, () => {}).build();
        const all = [...place.querySelectorAll('button')].filter(({ textContent }) => /^(Put|Add)/.test(textContent));
        return Promise.all(all.map(async ({ id, textContent }) => {
            const path = id.replace(/:switch$/, '').replace(/:add$/, '[]');
            return { words: `${path}: ${textContent}`, made: await putIn(scene, path) };
        }));
    };
    // Each saw is tried with every third part, and each part with every third saw.
    const isAsked = (saw, part) => (saw + part) % 3 === 0;
    for (const [saw, example] of begun.examples.entries()) {
        // A refusal does not depend on the range or the accuracy of the chart.
        const scene = { ...example, tolerance: 0.1, sweep: { from_rpm: 0, to_rpm: 300 } };
        delete scene.accuracy;
        const first = await buttons(scene);
        const known = new Set(first.map(({ words }) => words));
        const inner = [];
        for (const { words, made } of first) {
            const more = (await buttons(made)).filter((button) => !known.has(button.words));
            inner.push(...more.map((button) => ({ ...button, words: `${words}, ${button.words}` })));
        }
        for (const [part, { words, made }] of [...first, ...inner].entries()) {
            if (!isAsked(saw, part)) continue;
            const isInChart = !/^(cut|runup|probe|spline)/.test(words);
            await ask(isInChart ? 'chart/draft' : 'read', JSON.stringify(made), `${example.name}: ${words}`);
        }
        const tasks = [['cut', 'cut'], ['runup', 'runup'], ['washboard', 'cut.washboarding']];
        for (const [task, part] of tasks.filter((_, task) => isAsked(saw, task))) {
            if (lacks(begun.needs, part, scene)) continue;
            const made = part.split('.').reduce((value, key) => value?.[key], scene) ? scene : await putIn(scene, part);
            await ask(`task/${task}`, JSON.stringify({ scene: made }), `${example.name}: ${task}`);
        }
    }
    return { asked: asked.size, refused };";

#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn parts_added_to_saws_of_the_gallery_can_be_computed() {
    run(async {
        let page = Page::open(&["--accuracy", "draft"]).await;
        page.settle().await;
        page.script(&format!(
            "window.found = null; (async () => {{ {REFUSED} }})().then((found) => (window.found = found))"
        ))
        .await;
        let begun = Instant::now();
        while page.value("window.found").await.is_null() {
            assert!(begun.elapsed() < 5 * PATIENCE, "the parts take too long");
            tokio::time::sleep(Duration::from_millis(200)).await;
        }
        let found = page.value("window.found").await;
        println!("{} scenes computed", found["asked"]);
        let refused: Vec<String> = serde_json::from_value(found["refused"].clone()).unwrap();
        // Washboarding of so large a blade is refused, because it has too many modes.
        let is_out_of_reach = |told: &String| told.starts_with("Stone saw of 3.5 m: washboard:");
        let refused: Vec<&String> = refused
            .iter()
            .filter(|told| !is_out_of_reach(told))
            .collect();
        assert!(
            refused.is_empty(),
            "{} refused: {refused:#?}",
            refused.len()
        );
        page.close().await;
    });
}

#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn pads_are_added_by_a_click_and_moved_in_pairs() {
    run(async {
        let page = Page::open(&["--accuracy", "draft"]).await;
        page.settle().await;
        let angles = "sawflutter.state.scene.guides.map((pad) => pad.angle_deg)";
        page.script(
            "document.getElementById('pairs').value = 'mirrored'; \
            document.getElementById('pairs').dispatchEvent(new Event('change'))",
        )
        .await;
        // The click is above the centre of the blade, a little to the right. It adds nothing before the button is
        // pressed.
        let drawing = page.find("#drawing").await;
        let click = || {
            let there = hand(&page)
                .move_to_element_center(&drawing)
                .move_by_offset(40, -80);
            there.click_and_hold().release().perform()
        };
        click().await.unwrap();
        assert_eq!(page.value(&format!("{angles}.length")).await, json!(1));
        page.find("#add").await.click().await.unwrap();
        click().await.unwrap();
        page.wait(&format!("{angles}.length === 3")).await;
        page.settle().await;
        let found: Vec<f64> = serde_json::from_value(page.value(angles).await).unwrap();
        assert!((found[1] - 63.4).abs() < 1.0, "{found:?}");
        assert!((found[2] - (180.0 - found[1])).abs() < 1e-9, "{found:?}");
        assert_eq!(page.text("#fault").await, "");

        // The partner follows a drag and a change in a field.
        drag(&page, "[data-path='guides[1]'] .body", 10, (2, 1)).await;
        let_go(&page).await;
        page.settle().await;
        let pads = page.value("sawflutter.state.scene.guides").await;
        let angle = |k: usize| pads[k]["angle_deg"].as_f64().unwrap();
        assert!((angle(1) - found[1]).abs() > 1.0, "{pads}");
        assert!((angle(1) + angle(2) - 180.0).abs() < 0.11, "{pads}");
        assert_eq!(pads[1]["radius_m"], pads[2]["radius_m"]);
        let opened = "document.querySelectorAll('#fields details').forEach((d) => (d.open = true))";
        page.script(opened).await;
        page.enter("guides[2].stiffness_n_per_m", "7").await;
        page.settle().await;
        let stiffness = "sawflutter.state.scene.guides.map((pad) => pad.stiffness_n_per_m)";
        assert!(same(&page.value(stiffness).await, &json!([2e7, 7e6, 7e6])));
        page.script(
            "document.getElementById('pairs').value = ''; \
            document.getElementById('pairs').dispatchEvent(new Event('change'))",
        )
        .await;
        page.enter("guides[2].stiffness_n_per_m", "8").await;
        page.settle().await;
        assert!(same(&page.value(stiffness).await, &json!([2e7, 7e6, 8e6])));
        for (width, height) in [(1440, 1000), (390, 844)] {
            page.resize(width, height).await;
            page.script("scrollTo(0, 0)").await;
            page.screenshot(&format!("{width}-pairs.png")).await;
        }
        page.close().await;
    });
}
