//! Goal: what `sawflutter explore` shows and saves in a real browser is what the command line
//! finds for the same scene, and it answers while a hand moves.
//!
//! Needs Debian's `chromium` and `chromium-driver`; `.ci/run` installs them and runs these tests
//! with `--ignored`. Screenshots go to `target/explore-screenshots/`;
//! `figures/explore.png` is `1280-after.png`.

mod browser;

use std::time::{Duration, Instant};

use browser::{PATIENCE, Page, drag, hand, let_go, percentile, run, same};
use serde_json::{Value, json};
use thirtyfour::Key;

const PAD: &str = "[data-path='guides[0]'] .body";

#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn a_dragged_pad_moves_the_chart_to_what_the_command_line_finds() {
    run(async {
        let page = Page::open(&[]).await;
        page.settle().await;
        let (before, verdict) = (page.text("#facts").await, page.text("#verdict").await);
        assert!(before.contains("1531 rpm"), "{before}");
        assert!(verdict.contains("beyond the 85 % rule"), "{verdict}");
        page.screenshot("1280-light.png").await;

        drag(&page, PAD, 40, (2, -1)).await;
        page.wait("sawflutter.latencies.draft.length > 0").await;
        let dragging = page.text("#facts").await;
        assert_ne!(before, dragging, "the chart did not follow the pad");
        page.screenshot("1280-dragging.png").await;
        let_go(&page).await;
        page.settle().await;
        let after = page.text("#facts").await;
        assert!(after.contains("1531 → "), "{after}");

        let out = page.command_line().await;
        let report: Value =
            serde_json::from_slice(&std::fs::read(out.join("report.json")).unwrap()).unwrap();
        let shown = page.value("sawflutter.report()").await;
        assert!(
            same(&shown, &report),
            "the page shows another chart than the command line"
        );
        let critical = report["critical_speeds"][0]["rpm"].as_f64().unwrap();
        assert!(
            after.contains(&format!("→ {critical:.0} rpm")),
            "{critical}: {after}"
        );
        for name in ["report.json", "campbell.png", "campbell.svg"] {
            let saved = page.download(name).await;
            assert!(
                saved == std::fs::read(out.join(name)).unwrap(),
                "{name} differs"
            );
        }
        page.screenshot("1280-after.png").await;

        page.find("#undo").await.click().await.unwrap();
        page.settle().await;
        assert_eq!(page.text("#facts").await, before);
        page.close().await;
    });
}

#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn a_bad_value_is_refused_at_its_field_and_the_chart_stays() {
    run(async {
        let page = Page::open(&["--accuracy", "draft"]).await;
        page.settle().await;
        let before = page.text("#facts").await;
        page.enter("blade.thickness_m", "-2.8").await;
        page.wait("document.body.classList.contains('stale')").await;

        // In the unit of the field, at the field and nowhere else.
        let told = page.text("[id='blade.thickness_m:fault']").await;
        assert!(told.starts_with("Thickness must be "), "{told}");
        assert!(told.ends_with(" mm"), "{told}");
        assert_eq!(page.text("#fault").await, "");
        assert_eq!(
            page.text("#facts").await,
            before,
            "the last good chart has gone"
        );
        page.screenshot("1280-refused.png").await;

        page.enter("blade.thickness_m", "3.0").await;
        page.settle().await;
        assert_eq!(page.text("[id='blade.thickness_m:fault']").await, "");
        assert_eq!(
            page.value("document.body.classList.contains('stale')")
                .await,
            json!(false)
        );
        assert_ne!(page.text("#facts").await, before);
        page.close().await;
    });
}

#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn a_branch_that_is_pointed_at_moves_on_the_blade() {
    run(async {
        let page = Page::open(&["--accuracy", "draft"]).await;
        page.settle().await;
        let chart = page.find("#campbell").await;
        // By pointer, downwards from the middle until it comes by a branch.
        let plot = page.find("#campbell .u-over").await;
        let middle = hand(&page).move_to_element_center(&plot);
        middle.perform().await.unwrap();
        let told = "document.querySelector('#mode').textContent.includes('Krein')";
        for _ in 0..60 {
            if page.value(told).await == json!(true) {
                break;
            }
            let lower = hand(&page).move_by_offset(0, 3);
            lower.perform().await.unwrap();
        }
        page.wait(told).await;
        hand(&page).move_to(2, 2).perform().await.unwrap();
        page.wait("!document.querySelector('#mode').textContent.includes('Krein')")
            .await;
        chart.focus().await.unwrap();
        // By keyboard alone: along a branch, and to the next ones.
        let mut told = Vec::new();
        for key in [Key::Right, Key::Up, Key::Up, Key::Up] {
            chart.send_keys(key + "").await.unwrap();
            let last = told.last().cloned().unwrap_or_default();
            page.wait(&format!(
                "document.querySelector('#mode').textContent !== {last:?}"
            ))
            .await;
            page.wait("document.querySelector('#mode').textContent.includes('Krein')")
                .await;
            told.push(page.text("#mode").await);
        }
        for told in &told {
            assert!(told.contains("Hz in space") && told.contains("Hz on the blade"));
            // A reflected wave is what has a negative Krein sign.
            assert_eq!(
                told.contains("falls behind the dot"),
                told.contains("Krein sign −1"),
                "{told}"
            );
        }
        assert_eq!(
            page.value("document.querySelector('#motion').hidden").await,
            json!(false)
        );
        let pixels = "[...document.querySelector('#motion').getContext('2d').getImageData(0, 0, 180, 180).data].join()";
        let before = page.value(pixels).await;
        page.wait(&format!("{pixels} !== {before}")).await;
        page.screenshot("1280-mode.png").await;
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
        // Presses that follow each other are one step.
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
fn a_stretch_of_speeds_is_magnified_and_let_go_again() {
    run(async {
        let page = Page::open(&["--accuracy", "draft"]).await;
        page.settle().await;
        let all = page.value("sawflutter.speeds()").await;
        assert_eq!(all, json!([0, 3000]));
        drag(&page, "#campbell .u-over", 20, (8, 0)).await;
        let_go(&page).await;
        let some = page.value("sawflutter.speeds()").await;
        let [from, to] = [0, 1].map(|end| some[end].as_f64().unwrap());
        assert!(0.0 < from && from < to && to < 3000.0, "{some}");
        page.screenshot("1280-magnified.png").await;
        let told = page.text("#zoomed").await;
        assert!(told.contains("rpm of the sweep"), "{told}");
        // By keyboard: closer, and all again.
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
        let report = std::fs::read(out.join("report.json")).unwrap();
        let report: Value = serde_json::from_slice(&report).unwrap();
        assert!(same(&page.value("sawflutter.report()").await, &report));
        page.close().await;
    });
}

#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn parts_that_are_put_in_begin_with_values_that_compute() {
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
                    page.value("document.body.classList.contains('stale')")
                        .await,
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
        // What a reader of the screen hears is never the same twice.
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
        // The tick shows or hides the points; the scene stays.
        let scene = page.value("sawflutter.state.scene").await;
        page.script("document.querySelector('#measured').click()")
            .await;
        assert_eq!(page.value("sawflutter.state.scene").await, scene);
        page.close().await;
    });
}

/// Prints the times from a move of the pointer to the painted chart that has it in.
#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn answers_come_while_the_hand_moves_and_none_is_computed_in_vain() {
    run(async {
        let page = Page::open(&[]).await;
        page.settle().await;
        // To and fro until enough charts have come, however busy the machine is.
        for (charts, step) in [(5, 1), (10, -1), (15, 1)] {
            drag(&page, PAD, 1, (step, 0)).await;
            let begun = Instant::now();
            for moves in 0.. {
                let painted =
                    page.value("sawflutter.computed.filter(([kind]) => kind === 'draft').length");
                if painted.await.as_u64() >= Some(charts) {
                    break;
                }
                assert!(begun.elapsed() < PATIENCE, "no charts while the hand moves");
                let back = if moves / 40 % 2 == 0 { step } else { -step };
                let moved = hand(&page).move_by_offset(back, 1 - 2 * (moves % 2));
                moved.perform().await.unwrap();
            }
            let_go(&page).await;
            page.settle().await;
        }
        let times = page.value("sawflutter.latencies.draft").await;
        let computed = page
            .value("sawflutter.computed.filter(([kind]) => kind === 'draft').map(([, ms]) => ms)")
            .await;
        let last = page.value("sawflutter.latencies.scene").await;
        println!(
            "pointer move to painted chart at draft: median {:.0} ms, 95th percentile {:.0} ms \
             ({} moves, {} charts of {:.0} ms median); moves still waiting at the release, to the \
             final chart: {}; load {}",
            percentile(&times, 0.5),
            percentile(&times, 0.95),
            times.as_array().unwrap().len(),
            computed.as_array().unwrap().len(),
            percentile(&computed, 0.5),
            last.as_array().unwrap().len(),
            std::fs::read_to_string("/proc/loadavg")
                .unwrap_or_default()
                .trim(),
        );

        // A design chart that a further change has made stale is stopped, not computed.
        let jobs = "fetch('jobs').then((answer) => answer.json())";
        let before = page.value(jobs).await;
        for _ in 0..4 {
            page.script("sawflutter.state.set('blade.thickness_m', sawflutter.state.scene.blade.thickness_m + 1e-6)").await;
        }
        page.settle().await;
        let after = page.value(jobs).await;
        let more = |key: &str| after[key].as_u64().unwrap() - before[key].as_u64().unwrap();
        assert_eq!(more("finished"), 1, "{before} {after}");
        page.close().await;
    });
}

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
