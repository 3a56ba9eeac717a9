//! Words and colours of the page have one meaning each.

use serde_json::{Value, json};

use crate::browser::{Page, run};

/// Green is yes, blue is what can be touched, and pads, cut and probe have colours of their own.
#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn each_colour_has_one_meaning() {
    run(async {
        let page = Page::open(&["--accuracy", "draft"]).await;
        page.settle().await;
        page.enter("operating_rpm", "900").await;
        page.settle().await;
        for scheme in ["light", "dark"] {
            let media =
                json!({ "features": [{ "name": "prefers-color-scheme", "value": scheme }] });
            page.driver
                .chromium("Emulation.setEmulatedMedia", media)
                .await
                .unwrap();
            page.wait(&format!("(getComputedStyle(document.body).backgroundColor === 'rgb(255, 255, 255)') === ({scheme:?} === 'light')"))
                .await;
            let parts = "['.pad .body', '.cut .body', '.probe .body'].map((part) => getComputedStyle(document.querySelector(`#drawing ${part}`)).stroke)";
            let touched = "[getComputedStyle(document.querySelector('#drawing .handle')).stroke, getComputedStyle(document.querySelector('button.main:not([hidden])')).backgroundColor]";
            let yes = "[getComputedStyle(document.querySelector('#verdict')).borderLeftColor]";
            let waves = "['forward', 'backward', 'standing', 'divergence', 'flutter'].map((name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`))";
            let of = async |script: &str| -> Vec<String> {
                serde_json::from_value(page.value(script).await).unwrap()
            };
            let (touched, yes) = (of(touched).await, of(yes).await);
            assert_eq!(touched[0], touched[1]);
            let mut all = [of(parts).await, yes.clone(), of(waves).await].concat();
            all.push(touched[0].clone());
            let count = all.len();
            all.sort();
            all.dedup();
            assert_eq!(all.len(), count, "{scheme}: {all:?}");
            let channels = |colour: &str| -> Vec<f64> {
                let numbers = colour.split(|c: char| !c.is_ascii_digit());
                numbers.filter_map(|number| number.parse().ok()).collect()
            };
            let (green, blue) = (channels(&yes[0]), channels(&touched[0]));
            assert!(green[1] > green[0] && green[1] > green[2], "{yes:?}");
            assert!(blue[2] > blue[0] && blue[2] > blue[1], "{touched:?}");
        }
        page.close().await;
    });
}

/// The pointer on a term shows its definition in the documentation.
#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn terms_are_explained_by_the_glossary() {
    run(async {
        let page = Page::open(&["--accuracy", "draft"]).await;
        page.settle().await;
        let glossary = include_str!("../../docs/reference/glossary.md");
        for (place, term) in [
            ("#facts", "Flutter speed"),
            ("#facts", "growth rate"),
            (".key", "backward"),
            ("#verdict", "critical speed"),
        ] {
            let found = format!(
                "[...document.querySelectorAll({place:?} + ' dfn')].find(({{ textContent }}) => textContent === {term:?}).title"
            );
            let found = page.value(&found).await;
            let told = found.as_str().unwrap();
            // Definitions are compared up to their first formula.
            let shown = told
                .split(['λ', ':'])
                .next()
                .unwrap()
                .trim_end_matches("Re ");
            assert!(told.len() > 20, "{term}: {told}");
            assert!(glossary.contains(shown), "{term}: {told}");
        }
        page.close().await;
    });
}

/// The note that nothing grows is broken into lines that fit a narrow chart, and the disabled button can be read.
#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn words_in_a_narrow_chart_and_on_a_disabled_button_can_be_read() {
    run(async {
        let page = Page::drafted("collar-400mm").await;
        page.script(
            "window.lines = []; const own = CanvasRenderingContext2D.prototype.fillText; \
            CanvasRenderingContext2D.prototype.fillText = function (text, x, ...rest) { \
                lines.push([text, x + (this.textAlign === 'left' ? this.measureText(text).width : 0), this.canvas.width]); \
                return own.call(this, text, x, ...rest); };",
        )
        .await;
        page.resize(390, 844).await;
        page.wait("lines.length > 0").await;
        let note = page
            .value("document.querySelector('#growth').chart && sawflutter.report() && lines.filter(([text]) => /[a-z]{3}/.test(text)).map(([text, right, width]) => [text, right <= width])")
            .await;
        let all: Vec<(String, bool)> = serde_json::from_value(note).unwrap();
        let words = all.iter().map(|(text, _)| text.as_str());
        assert!(words.clone().any(|text| text.contains("grow")), "{all:?}");
        assert!(all.iter().all(|(_, fits)| *fits), "{all:?}");

        // The saw equals its file, so that it cannot be saved.
        let colours = "(({ color, backgroundColor }) => [color, backgroundColor].map((colour) => { \
            const context = new OffscreenCanvas(1, 1).getContext('2d'); context.fillStyle = colour; \
            context.fillRect(0, 0, 1, 1); return [...context.getImageData(0, 0, 1, 1).data]; }))\
            (getComputedStyle(document.querySelector('#write')))";
        assert_eq!(
            page.value("document.querySelector('#write').disabled")
                .await,
            json!(true)
        );
        let found = page.value(colours).await;
        let contrast = contrast(&found[0], &found[1]);
        assert!(contrast > 4.5, "{contrast}: {found}");
        page.close().await;
    });
}

/// A browser that cannot run the page says what it lacks.
#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn a_browser_that_lacks_something_says_so() {
    run(async {
        let page = Page::open(&["--accuracy", "draft"]).await;
        let is_shown =
            "document.querySelector('#lacking').checkVisibility({ visibilityProperty: true })";
        assert_eq!(page.value(is_shown).await, json!(false));
        // Without this function, the page cannot be made.
        let source = json!({ "source": "delete crypto.__proto__.randomUUID" });
        page.driver
            .chromium("Page.addScriptToEvaluateOnNewDocument", source)
            .await
            .unwrap();
        page.driver.refresh().await.unwrap();
        page.wait(is_shown).await;
        page.close().await;
    });
}

/// Contrast of two colours by WCAG 2.
fn contrast(first: &Value, second: &Value) -> f64 {
    let luminance = |colour: &Value| -> f64 {
        let linear = |k: usize| {
            let channel = colour[k].as_f64().unwrap() / 255.0;
            if channel <= 0.03928 {
                channel / 12.92
            } else {
                ((channel + 0.055) / 1.055).powf(2.4)
            }
        };
        0.2126 * linear(0) + 0.7152 * linear(1) + 0.0722 * linear(2)
    };
    let [x, y] = [first, second].map(luminance);
    (x.max(y) + 0.05) / (x.min(y) + 0.05)
}

/// Texts of the program have the names and the units of the form.
#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn texts_of_the_program_have_the_words_of_the_form() {
    run(async {
        let page = Page::open(&["--accuracy", "draft"]).await;
        page.settle().await;
        let range = "blade.thickness_m (thickness of the blade) from 0.00224 to 0.00336 m; map.json has all";
        let pad = "guides[0].stiffness_n_per_m = 2e7 N/m at r = 355 mm";
        for (inches, wanted) in [
            (
                false,
                [
                    "thickness of the blade from 2.24 to 3.36 mm; map.json has all",
                    "guide 1: stiffness = 20 MN/m at r = 355 mm",
                ],
            ),
            (
                true,
                [
                    "thickness of the blade from 0.08819 to 0.1323 in; map.json has all",
                    "guide 1: stiffness = 20 MN/m at r = 13.98 in",
                ],
            ),
        ] {
            page.script(&format!("const box = document.getElementById('inches'); if (box.checked !== {inches}) box.click()"))
                .await;
            let told = page
                .awaited(&format!("{{ const {{ inForm }} = await import('./page/phrases.js'); return [{range:?}, {pad:?}].map(inForm); }}"))
                .await;
            assert_eq!(told, json!(wanted));
        }
        page.close().await;
    });
}
