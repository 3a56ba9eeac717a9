//! Reloading the page loses no edit, and the program ends with its page.

use std::time::{Duration, Instant};

use serde_json::{Value, json};

use crate::browser::{PATIENCE, Page, run, same};

const THICKNESS: &str = "sawflutter.state.scene.blade.thickness_m";

impl Page {
    /// Waits for the chart of a page that was opened.
    async fn shown(&self) {
        self.wait("window.sawflutter?.computed.length > 0").await;
        self.settle().await;
    }

    /// Loads the page again.
    async fn reload(&self) {
        self.script("delete window.sawflutter").await;
        self.driver.refresh().await.unwrap();
        self.shown().await;
    }
}

#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn edits_survive_a_reload_and_travel_in_the_address() {
    run(async {
        let page = Page::open(&["--accuracy", "draft"]).await;
        page.settle().await;
        page.enter("blade.thickness_m", "3").await;
        page.settle().await;
        page.reload().await;
        assert_eq!(page.value(THICKNESS).await, json!(0.003));
        let restored = page.value("document.querySelector('#restored').hidden");
        assert_eq!(restored.await, json!(false));
        page.screenshot("1280-restored.png").await;

        page.script("document.querySelector('#link').click()").await;
        page.wait("location.hash.startsWith('#scene=')").await;
        let address = page.driver.current_url().await.unwrap();
        page.reload().await;
        assert_eq!(page.value(THICKNESS).await, json!(0.003));
        // Edits after the link was opened remain.
        page.enter("blade.thickness_m", "3.2").await;
        page.settle().await;
        assert_eq!(page.value("location.hash").await, json!(""));
        page.reload().await;
        assert_eq!(page.value(THICKNESS).await, json!(0.0032));
        // The link is pasted into the address of the page, which asks first, because the scene was edited.
        let (_, hash) = address.split_once('#').unwrap();
        page.script("window.confirm = (asked) => { window.asked = asked; return true; }")
            .await;
        page.script(&format!("location.hash = '#{hash}'")).await;
        page.wait(&format!("{THICKNESS} === 0.003")).await;
        page.settle().await;
        let asked = page.value("window.asked").await;
        assert!(asked.as_str().unwrap().contains("Undo"), "{asked}");
        page.script("document.querySelector('#undo').click()").await;
        page.settle().await;
        assert_eq!(page.value(THICKNESS).await, json!(0.0032));

        page.script("document.querySelector('#restored').hidden = false; document.querySelector('#over').click()")
            .await;
        page.settle().await;
        assert_eq!(page.value(THICKNESS).await, json!(0.0028));
        page.reload().await;
        assert_eq!(page.value(THICKNESS).await, json!(0.0028));
        page.close().await;
    });
}

/// Each tab has edits of its own; a new tab starts with edits that no open tab has.
#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn two_tabs_keep_their_edits_apart() {
    run(async {
        let page = Page::open(&["--accuracy", "draft"]).await;
        page.settle().await;
        page.enter("blade.thickness_m", "3").await;
        page.settle().await;
        let first = page.driver.window().await.unwrap();
        let second = page.another_tab().await;
        page.shown().await;
        assert_eq!(page.value(THICKNESS).await, json!(0.0028));
        page.enter("blade.thickness_m", "3.4").await;
        page.settle().await;
        for (tab, thickness) in [(&first, 0.003), (&second, 0.0034)] {
            page.driver.switch_to_window(tab.clone()).await.unwrap();
            page.reload().await;
            assert_eq!(page.value(THICKNESS).await, json!(thickness));
        }
        page.driver.close_window().await.unwrap();
        page.driver.switch_to_window(first).await.unwrap();
        page.another_tab().await;
        page.shown().await;
        assert_eq!(page.value(THICKNESS).await, json!(0.0034));
        page.close().await;
    });
}

#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn another_saw_takes_the_place_of_an_edited_one_only_when_asked() {
    run(async {
        let page = Page::open(&["--accuracy", "draft"]).await;
        page.settle().await;
        let name = "sawflutter.state.scene.name";
        page.script("window.asked = 0; window.answer = false; window.confirm = () => { window.asked += 1; return window.answer; }")
            .await;
        // A saw without edits is replaced without a question.
        page.open_example(2).await;
        page.settle().await;
        let opened = page.value(name).await;
        assert_eq!(page.value("window.asked").await, json!(0));
        // Numbers are not compared with those of another saw.
        assert!(!page.text("#facts").await.contains(" → "));
        page.enter("blade.thickness_m", "3.1").await;
        page.settle().await;
        assert!(page.text("#facts").await.contains(" → "));
        page.open_example(1).await;
        assert_eq!(page.value(name).await, opened);
        page.script("window.answer = true").await;
        page.open_example(1).await;
        page.settle().await;
        assert_ne!(page.value(name).await, opened);
        assert_eq!(page.value("window.asked").await, json!(2));
        // The page does not ask before it is left, because the browser keeps the edits.
        page.enter("blade.thickness_m", "3.1").await;
        page.settle().await;
        let leaves = "dispatchEvent(new Event('beforeunload', { cancelable: true }))";
        assert_eq!(page.value(leaves).await, json!(true));
        page.script("Storage.prototype.setItem = () => { throw new Error('full'); }")
            .await;
        page.enter("blade.thickness_m", "3.2").await;
        page.settle().await;
        assert_eq!(page.value(leaves).await, json!(false));
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
            ("kilohertz.csv", "rpm,f1 [kHz]\n0,0.1\n"),
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
        // The table has the speed in its last column, a missing wave, and another order of columns: the page reads it
        // as `sawflutter fit` does.
        let named_table = "f2,f1,f3,rpm\n27.5,9.5,43,0\n,4.5,40,500\n";
        // A spreadsheet saves "Unicode text" as UTF-16.
        let bytes: Vec<u8> = format!("\u{feff}{named_table}")
            .encode_utf16()
            .flat_map(u16::to_le_bytes)
            .collect();
        page.script(&format!(
            "sawflutter.open(new File([new Uint8Array({bytes:?})], 'shop.csv'))"
        ))
        .await;
        page.wait("sawflutter.state.scene.measured.source === 'shop.csv'")
            .await;
        page.settle().await;
        assert_eq!(
            page.value("sawflutter.state.scene.measured.rows").await,
            json!([
                { "rpm": 0, "frequencies_hz": [9.5, 27.5, 43] },
                { "rpm": 500, "frequencies_hz": [4.5, null, 40] },
            ])
        );
        // The checkbox shows or hides the points; the scene does not change.
        let scene = page.value("sawflutter.state.scene").await;
        page.script("document.querySelector('#measured').click()")
            .await;
        assert_eq!(page.value("sawflutter.state.scene").await, scene);
        page.close().await;
    });
}

#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn a_program_that_is_started_again_takes_the_page_over() {
    run(async {
        let mut page = Page::open(&["--accuracy", "draft"]).await;
        page.settle().await;
        page.program.0.kill().unwrap();
        page.wait("!document.querySelector('#lost').hidden").await;
        // The banner stays in sight.
        page.script("scrollTo(0, 300)").await;
        let top = "document.querySelector('#lost').getBoundingClientRect().top >= 0";
        assert_eq!(page.value(top).await, json!(true));
        page.open_tab_of("place").await;
        page.script("document.querySelector('#panel-place .start button').click()")
            .await;
        page.wait("document.querySelector('#panel-place .fault').textContent !== ''")
            .await;
        page.enter("blade.thickness_m", "3").await;
        let told = "document.getElementById('blade.thickness_m:fault').textContent";
        page.wait(&format!("{told}.includes('does not answer')"))
            .await;
        page.start_again(&["--accuracy", "draft"]).await;
        page.wait("document.querySelector('#lost').hidden").await;
        // The number typed in the meantime is read and computed, and the chart has its modes.
        page.wait("sawflutter.state.scene.blade.thickness_m === 0.003")
            .await;
        page.settle().await;
        assert!(page.text("#facts").await.contains(" → "));
        assert_eq!(page.text("#fault").await, "");
        assert_eq!(page.text("#panel-place .fault").await, "");
        page.script("document.querySelector('#tab-chart').click()")
            .await;
        page.step_to_a_mode().await;
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

#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn a_saw_is_saved_to_the_file_that_the_program_was_started_with() {
    run(async {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("my-saw.json");
        let paper = include_str!("../../scenes/paper.json");
        std::fs::write(&path, paper).unwrap();
        let page = Page::open(&[path.to_str().unwrap(), "--accuracy", "draft"]).await;
        page.settle().await;
        let read = || std::fs::read_to_string(&path).unwrap();
        let save = page.find("#write").await;
        assert_eq!(page.text("#write").await, "Save to my-saw.json");
        page.enter("blade.thickness_m", "3").await;
        page.settle().await;
        // The file is not written before the button is pressed.
        assert_eq!(read(), paper);
        for (width, height) in [(1440, 1000), (390, 844)] {
            page.resize(width, height).await;
            page.script("scrollTo(0, 0)").await;
            page.screenshot(&format!("{width}-save.png")).await;
        }
        page.resize(1280, 900).await;
        save.click().await.unwrap();
        page.wait("document.querySelector('#write').disabled").await;
        let saved: Value = serde_json::from_str(&read()).unwrap();
        assert!(same(&saved, &page.value("sawflutter.state.scene").await));

        // Another program has changed the file in the meantime.
        std::fs::write(&path, paper).unwrap();
        page.enter("blade.thickness_m", "3.1").await;
        page.settle().await;
        save.click().await.unwrap();
        page.wait("!document.querySelector('#conflict').hidden")
            .await;
        assert_eq!(read(), paper);
        let told = page.text("#conflict span").await;
        assert_eq!(told, "Another program has changed my-saw.json.");
        page.find("#overwrite").await.click().await.unwrap();
        page.wait("document.querySelector('#write').disabled").await;
        let saved: Value = serde_json::from_str(&read()).unwrap();
        assert_eq!(saved["blade"]["thickness_m"], json!(0.0031));

        std::fs::write(&path, paper).unwrap();
        page.enter("blade.thickness_m", "3.2").await;
        page.settle().await;
        save.click().await.unwrap();
        page.wait("!document.querySelector('#conflict').hidden")
            .await;
        page.script("window.confirm = () => true").await;
        page.find("#load").await.click().await.unwrap();
        page.wait("sawflutter.state.scene.blade.thickness_m === 0.0028")
            .await;
        page.settle().await;
        page.wait("document.querySelector('#write').disabled").await;
        assert_eq!(read(), paper);
        page.enter("blade.thickness_m", "3.3").await;
        page.settle().await;

        let mut permissions = folder.path().metadata().unwrap().permissions();
        permissions.set_readonly(true);
        std::fs::set_permissions(folder.path(), permissions).unwrap();
        save.click().await.unwrap();
        page.wait("document.querySelector('#fault').textContent.includes('is read-only')")
            .await;

        // The button is hidden for another saw, which must not overwrite this one.
        page.script("window.confirm = () => true").await;
        page.open_example(1).await;
        page.settle().await;
        assert_eq!(
            page.value("document.querySelector('#write').hidden").await,
            json!(true)
        );
        page.script("sawflutter.state.undo()").await;
        page.settle().await;
        assert_eq!(page.text("#write").await, "Save to my-saw.json");
        page.wait("!document.querySelector('#write').hidden").await;
        page.close().await;
    });
}

/// A report that is opened as a scene opens its scene, and a damaged link is reported until the message is closed.
#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn a_report_opens_its_scene_and_a_damaged_link_is_reported() {
    run(async {
        let page = Page::open(&["--accuracy", "draft"]).await;
        page.settle().await;
        page.script("sawflutter.open(new File([JSON.stringify({ scene: { ...sawflutter.state.scene, name: 'of a report' }, accuracy: {} })], 'r.json'))")
            .await;
        page.wait("sawflutter.state.scene.name === 'of a report'")
            .await;
        let told = page.text("#notice span").await;
        assert!(told.starts_with("r.json is a report"), "{told}");
        page.script("location.hash = '#scene=abc%%'").await;
        page.wait("document.querySelector('#notice').textContent.includes('copy the whole link')")
            .await;
        page.settle().await;
        page.find("#dismiss").await.click().await.unwrap();
        assert_eq!(
            page.value("document.querySelector('#notice').hidden").await,
            json!(true)
        );

        // A saw that the program will refuse is not saved without a word.
        page.enter("operating_rpm", "-5").await;
        page.wait("document.getElementById('operating_rpm:fault').textContent !== ''")
            .await;
        page.download("scene.json").await;
        assert!(page.text("#notice").await.contains("will refuse it"));
        page.close().await;
    });
}

/// A saw is not saved under the name of a file that *Undo* has left.
#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn the_name_of_the_file_follows_undo() {
    run(async {
        let page = Page::open(&["--accuracy", "draft"]).await;
        let name = "sawflutter.nameOf('scene.json')";
        let before = page.value(name).await;
        page.script("sawflutter.open(new File([JSON.stringify({ ...sawflutter.state.scene, name: 'another' })], 'ring.json'))")
            .await;
        page.wait(&format!("{name} === 'ring.json'")).await;
        page.script("sawflutter.state.undo()").await;
        assert_eq!(page.value(name).await, before);
        page.script("sawflutter.state.redo()").await;
        assert_eq!(page.value(name).await, json!("ring.json"));
        page.close().await;
    });
}

/// The test uses a file in the storage of the browser in place of a file of the computer.
#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn a_saw_is_saved_to_the_file_that_was_opened_in_the_browser() {
    run(async {
        let page = Page::open(&["--accuracy", "draft"]).await;
        page.settle().await;
        assert_eq!(
            page.value("document.querySelector('#write').hidden").await,
            json!(true)
        );
        page.awaited(
            "{ const root = await navigator.storage.getDirectory(); \
             const handle = await root.getFileHandle('ring.json', { create: true }); \
             const stream = await handle.createWritable(); \
             await stream.write(JSON.stringify(sawflutter.state.scene)); await stream.close(); \
             window.showOpenFilePicker = async () => [handle]; }",
        )
        .await;
        page.script("document.querySelector('#open').click()").await;
        page.wait("!document.querySelector('#write').hidden").await;
        page.enter("blade.thickness_m", "3").await;
        page.settle().await;
        page.find("#write").await.click().await.unwrap();
        page.wait("document.querySelector('#write').disabled").await;
        let saved = page
            .awaited(
                "{ const root = await navigator.storage.getDirectory(); \
                 const file = await (await root.getFileHandle('ring.json')).getFile(); \
                 return JSON.parse(await file.text()).blade.thickness_m; }",
            )
            .await;
        assert_eq!(saved, json!(0.003));
        page.close().await;
    });
}
