//! The chart of the page has the results of the command line, and it follows the input.

use serde_json::{Value, json};

use crate::browser::{Key, PAD, Page, drag, hand, let_go, run, same};

#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn a_dragged_pad_moves_the_chart_to_what_the_command_line_finds() {
    run(async {
        let page = Page::open(&[]).await;
        page.settle().await;
        let before = page.text("#facts").await;
        assert!(before.contains("1531 rpm"), "{before}");
        page.screenshot("1280-light.png").await;

        drag(&page, PAD, 40, (2, -1)).await;
        // The chart is that of the present position of the pad, because moves come faster than charts.
        page.wait("sawflutter.latencies.draft.length > 0 && sawflutter.follows()")
            .await;
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

/// A stable saw, one that breaks the rule, and one that flutters: each with the program's text and a symbol of its own.
#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn the_answer_is_the_one_that_the_program_prints() {
    run(async {
        let page = Page::open(&["--accuracy", "draft"]).await;
        let words = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
        for (rpm, class, mark, says) in [
            ("900", "yes", "✓", "it can run up to 1301 rpm"),
            ("1800", "at_risk", "!", "118 % of the first critical speed"),
            ("2400", "no", "✗", "flutter grows by up to"),
        ] {
            page.enter("operating_rpm", rpm).await;
            page.settle().await;
            assert_eq!(
                page.value("document.querySelector('#verdict').className")
                    .await,
                json!(class)
            );
            let shown = page
                .value("getComputedStyle(document.querySelector('#verdict strong'), '::before').content")
                .await;
            assert_eq!(shown, json!(format!("\"{mark}\"")));
            let line = page.text("#verdict strong + span").await;
            assert!(line.contains(says), "{line}");
            page.screenshot(&format!("1280-{class}.png")).await;
            let (_, printed_text) = page.command(&["analyze"]).await;
            let printed = words(&printed_text);
            assert!(printed.contains(&line), "{line}\n{printed}");
            // The answer in full, its reasons and the checks are folded, with the tables of all numbers.
            page.script("document.querySelector('#why').open = true")
                .await;
            page.wait("document.querySelectorAll('#why caption').length > 2")
                .await;
            for part in [
                "Can it run at ",
                "window without instability: ",
                "Checks: all ",
                "(in brackets: ",
            ] {
                let found = page
                    .value(&format!(
                        "[...document.querySelectorAll('#why p')].map((p) => p.textContent).find((text) => text.startsWith({part:?})) ?? ''"
                    ))
                    .await;
                let sentence = words(found.as_str().unwrap());
                let is_unstable = class == "no" && part.starts_with("window");
                assert_eq!(sentence.is_empty(), is_unstable, "{part}");
                assert!(printed.contains(&sentence), "{sentence}\n{printed}");
            }
            page.script("document.querySelector('#why').open = false")
                .await;
        }
        page.close().await;
    });
}

/// The handle of the ruler is the operating speed, and the marks on it are the speeds of the report.
#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn the_ruler_has_the_speeds_of_the_report_and_sets_the_operating_speed() {
    run(async {
        let page = Page::open(&["--accuracy", "draft"]).await;
        page.settle().await;
        // A mark as a share of the ruler, times the last speed of the sweep.
        let marks = |class: &str| {
            format!(
                "[...document.querySelectorAll('.marks .{class}')].map((mark) => [mark, mark.parentElement].map((part) => part.getBoundingClientRect()))\
                 .map(([own, all]) => Math.round((own.left - all.left) / all.width * sawflutter.report().campbell.to_rpm))"
            )
        };
        let report = page.value("sawflutter.report()").await;
        let close = |found: &Value, wanted: &[f64]| {
            let found: Vec<f64> = serde_json::from_value(found.clone()).unwrap();
            found.len() == wanted.len()
                && found.iter().zip(wanted).all(|(x, y)| (x - y).abs() < 4.0)
        };
        let critical: Vec<f64> = report["critical_speeds"]
            .as_array()
            .unwrap()
            .iter()
            .map(|critical| critical["rpm"].as_f64().unwrap())
            .collect();
        let found = page.value(&marks("critical")).await;
        assert!(close(&found, &critical), "{found} {critical:?}");
        let found = page.value(&marks("limit")).await;
        assert!(close(&found, &[0.85 * critical[0]]), "{found}");
        let window = report["operating"]["safe_window_rpm"][0].as_f64().unwrap();
        let found = page.value(&marks("window")).await;
        assert!(close(&found, &[window]), "{found}");

        let handle = page.find("#ruler input").await;
        handle.send_keys(Key::Right + "").await.unwrap();
        page.settle().await;
        let rpm = page.value("sawflutter.state.scene.operating_rpm").await;
        assert_eq!(rpm, json!(1801));
        assert!(page.text("#verdict").await.contains("1801 rpm"));
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
        // The pointer moves downwards from the middle until it reaches a branch.
        let plot = page.find("#campbell .u-over").await;
        let middle = hand(&page).move_to_element_center(&plot);
        middle.perform().await.unwrap();
        let is_told = "document.querySelector('#mode').textContent.includes('Krein')";
        for _ in 0..60 {
            if page.value(is_told).await == json!(true) {
                break;
            }
            let lower = hand(&page).move_by_offset(0, 3);
            lower.perform().await.unwrap();
        }
        page.wait(is_told).await;
        hand(&page).move_to(2, 2).perform().await.unwrap();
        page.wait("!document.querySelector('#mode').textContent.includes('Krein')")
            .await;
        chart.focus().await.unwrap();
        // The arrow keys move along a branch and to the next ones.
        let mut told = Vec::new();
        for key in [Key::Right, Key::Right, Key::Up, Key::Up] {
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
            // A reflected wave has a negative Krein sign.
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
        // The blade moves in relief, sharp on every screen.
        let picture = "document.querySelector('#motion').toDataURL()";
        let before = page.value(picture).await;
        page.wait(&format!("{picture} !== {before}")).await;
        let size = "(({ width, clientWidth }) => [width, Math.round(clientWidth * devicePixelRatio)])(document.querySelector('#motion'))";
        let sizes = page.value(size).await;
        assert_eq!(sizes[0], sizes[1]);
        let is_in_relief = "document.body.classList.contains('in-relief')";
        assert_eq!(page.value(is_in_relief).await, json!(true));
        page.screenshot("1280-mode.png").await;
        // The mode that was selected last can be saved as a video.
        page.script("document.querySelector('#film').click()").await;
        page.wait_for_file("mode.webm").await;
        // It is flat and at rest for users who want less motion.
        let media =
            json!({ "features": [{ "name": "prefers-reduced-motion", "value": "reduce" }] });
        page.driver
            .chromium("Emulation.setEmulatedMedia", media)
            .await
            .unwrap();
        page.script("delete window.sawflutter").await;
        page.driver.refresh().await.unwrap();
        page.wait("window.sawflutter?.computed.length > 0").await;
        page.settle().await;
        assert_eq!(page.value(is_in_relief).await, json!(false));
        page.step_to_a_mode().await;
        let still = page.value(picture).await;
        tokio::time::sleep(std::time::Duration::from_millis(300)).await;
        assert_eq!(page.value(picture).await, still);
        page.close().await;
    });
}

#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn a_chart_of_an_earlier_scene_is_not_shown_as_the_present_one() {
    run(async {
        let page = Page::open(&["--accuracy", "reference"]).await;
        page.settle().await;
        let marked = "sawflutter.isEarlier()";
        assert_eq!(page.value(marked).await, json!(false));
        page.enter("blade.thickness_m", "3.1").await;
        page.wait(marked).await;
        let told = "document.querySelector('#outdated').checkVisibility()";
        assert_eq!(page.value(told).await, json!(true));
        page.settle().await;
        assert_eq!(page.value(marked).await, json!(false));
        assert_eq!(page.value(told).await, json!(false));
        let told_again = page.text("#computed").await;
        assert!(told_again.starts_with("reference accuracy"), "{told_again}");
        page.close().await;
    });
}

/// The page writes the speeds of critical speeds, of bands and of operation into the diagram, as the program's figure
/// does.
#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn critical_speeds_bands_and_operation_have_their_numbers() {
    run(async {
        let page = Page::open(&["--accuracy", "draft"]).await;
        page.settle().await;
        page.script(
            "window.written = []; \
            const own = CanvasRenderingContext2D.prototype.fillText; \
            CanvasRenderingContext2D.prototype.fillText = function (text, ...at) { \
                written.push(text); return own.call(this, text, ...at); };",
        )
        .await;
        page.enter("blade.thickness_m", "2.9").await;
        page.settle().await;
        let critical = "sawflutter.report().critical_speeds[0].rpm.toFixed(0)";
        let band = "sawflutter.report().instabilities[0]";
        for text in [
            critical.to_owned(),
            format!(
                "{band}.kind + ' ' + {band}.from_rpm.toFixed(0) + '–' + {band}.to_rpm.toFixed(0)"
            ),
            "'operating 1800'".to_owned(),
        ] {
            let found = format!("written.includes({text})");
            assert_eq!(page.value(&found).await, json!(true), "{text}");
        }
        page.close().await;
    });
}

/// A chart that takes longer than a second shows its progress, can be stopped, and can be requested again.
#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn a_long_chart_reports_its_progress_and_can_be_stopped() {
    run(async {
        let page = Page::drafted("gallery/six-pads").await;
        let is_hidden = "document.querySelector('#stop').hidden";
        page.script("sawflutter.state.set('accuracy', 'reference')")
            .await;
        page.wait(&format!("!{is_hidden}")).await;
        page.wait("document.querySelector('#busy').textContent.includes(' of ')")
            .await;
        page.screenshot("1280-computing.png").await;
        // The key press moves the focus to the button that starts the computation again.
        page.find("#stop")
            .await
            .send_keys(Key::Enter + "")
            .await
            .unwrap();
        page.wait(is_hidden).await;
        assert_eq!(
            page.value("document.activeElement.id").await,
            json!("again")
        );
        let told = page.text("#fault").await;
        assert!(told.contains("before the last change"), "{told}");
        page.script("sawflutter.state.set('accuracy', 'draft')")
            .await;
        page.settle().await;
        assert_eq!(
            page.value("document.querySelector('#waiting').hidden")
                .await,
            json!(true)
        );
        assert_eq!(page.text("#fault").await, "");
        page.close().await;
    });
}

/// Script that returns the ends of all axes.
const AXES: &str = "['#campbell', '#growth'].map((place) => document.querySelector(place).chart.scales)\
    .flatMap(({ x, y }) => [x.min, x.max, y.min, y.max])";

#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn the_axes_stay_while_a_pad_is_moved_and_follow_after_the_release() {
    run(async {
        let page = Page::open(&["--accuracy", "draft"]).await;
        page.settle().await;
        let before = page.value(AXES).await;
        page.script(&format!(
            "window.seenAxes = new Set(); const look = () => {{ window.seenAxes.add(JSON.stringify({AXES})); \
             requestAnimationFrame(look); }}; look();"
        ))
        .await;
        drag(&page, PAD, 40, (1, 2)).await;
        page.wait("sawflutter.follows()").await;
        let charts = page.value("sawflutter.latencies.draft.length").await;
        assert!(charts.as_u64().unwrap() > 1, "{charts}");
        assert_eq!(page.value("window.seenAxes.size").await, json!(1));
        let_go(&page).await;
        page.settle().await;
        assert_ne!(page.value(AXES).await, before);
        // The axes change once, from those of the drag to those of the chart after the release.
        assert_eq!(page.value("window.seenAxes.size").await, json!(2));
        page.close().await;
    });
}

#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn several_saws_are_pinned_listed_and_taken_out() {
    run(async {
        let page = Page::open(&["--accuracy", "draft"]).await;
        page.settle().await;
        for thickness in ["3.2", "3.6", "2.6"] {
            page.script("document.querySelector('#pin').click()").await;
            page.enter("blade.thickness_m", thickness).await;
            page.settle().await;
        }
        let rows = "[...document.querySelectorAll('#pinned tbody tr')].map((row) => (row.cells[0].querySelector('span') ?? row.cells[0]).textContent)";
        assert_eq!(
            page.value(rows).await,
            json!([
                "Guided spline arbor saw",
                "thickness 3.2 mm",
                "thickness 3.6 mm",
                "as it is now"
            ])
        );
        let column = "[...document.querySelectorAll('#pinned tbody tr')].map((row) => row.cells[1].textContent)";
        let cells = page.value(column).await;
        let mut speeds: Vec<&str> = cells
            .as_array()
            .unwrap()
            .iter()
            .filter_map(|s| s.as_str())
            .collect();
        assert!(
            speeds.iter().all(|speed| speed.ends_with(" rpm")),
            "{speeds:?}"
        );
        speeds.sort_unstable();
        speeds.dedup();
        assert_eq!(speeds.len(), 4, "{speeds:?}");
        // The dashes of the pinned saws differ.
        let dashes = "new Set([...document.querySelectorAll('#pinned line')].map((line) => line.getAttribute('stroke-dasharray'))).size";
        assert_eq!(page.value(dashes).await, json!(3));
        for (width, height) in [(1440, 1000), (390, 1400)] {
            page.resize(width, height).await;
            page.script("scrollTo(0, 0)").await;
            page.screenshot(&format!("{width}-several.png")).await;
        }
        page.resize(1280, 900).await;
        page.find("[aria-label='Unpin thickness 3.2 mm']")
            .await
            .click()
            .await
            .unwrap();
        let kept = json!([
            "Guided spline arbor saw",
            "thickness 3.6 mm",
            "as it is now"
        ]);
        assert_eq!(page.value(rows).await, kept);
        // The pinned saws survive a reload.
        page.script("delete window.sawflutter").await;
        page.driver.refresh().await.unwrap();
        page.wait("window.sawflutter?.computed.length > 0").await;
        page.settle().await;
        assert_eq!(page.value(rows).await, kept);
        page.close().await;
    });
}
