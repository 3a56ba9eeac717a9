//! The page follows a drag without delay, and computes and draws nothing in vain.

use std::path::Path;
use std::time::Instant;

use serde_json::Value;

use crate::browser::{PAD, PATIENCE, Page, drag, hand, let_go, percentile, run, same};

impl Page {
    /// Returns the durations, in milliseconds, of one stage between each move and its drawn draft.
    async fn parts(&self, name: &str) -> Value {
        let all = format!("sawflutter.parts.flatMap((parts) => parts.{name})");
        self.value(&all).await
    }

    async fn all_parts(&self) -> String {
        let mut told = Vec::new();
        for name in ["waiting", "computing", "sending", "drawing", "painting"] {
            let times = self.parts(name).await;
            let [middle, most] = [0.5, 0.95].map(|share| percentile(&times, share));
            told.push(format!("{name} {middle:.1} / {most:.1} ms"));
        }
        told.join(", ")
    }
}

/// Script that counts the drawing calls of canvases from now on.
const COUNT: &str = "window.drawn = { clearRect: 0, stroke: 0, lineTo: 0 }; \
    for (const name of Object.keys(drawn)) { \
        const own = CanvasRenderingContext2D.prototype[name]; \
        CanvasRenderingContext2D.prototype[name] = function (...given) { \
            drawn[name] += 1; return own.apply(this, given); }; }";

/// A damped saw is included, because it has thousands of ranges with a growth rate.
#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn a_chart_is_drawn_once_and_in_few_strokes() {
    run(async {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
        for scene in ["paper.json", "gallery/damped-pad.json"] {
            let path = folder.join(scene);
            let page = Page::open(&[path.to_str().unwrap(), "--accuracy", "draft"]).await;
            page.settle().await;
            page.script(COUNT).await;
            // Critical speeds and bands are drawn before their chart.
            let count = "sawflutter.computed.length + sawflutter.ahead";
            let before = page.value(count).await.as_u64().unwrap();
            page.enter("blade.thickness_m", "3").await;
            page.settle().await;
            let charts = page.value(count).await.as_u64().unwrap() - before;
            let drawn = page.value("drawn").await;
            let count = |what: &str| drawn[what].as_u64().unwrap();
            // Each chart clears two canvases, the diagram and the growth rates.
            assert_eq!(count("clearRect"), 2 * charts, "{scene}: {drawn}");
            assert!(count("stroke") < 400 * charts, "{scene}: {drawn}");
            assert!(count("lineTo") < 4000 * charts, "{scene}: {drawn}");
            println!("{scene}: {drawn} for {charts} charts and early results");
            page.close().await;
        }
    });
}

#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn answers_come_during_a_drag_and_none_is_computed_in_vain() {
    run(async {
        let page = Page::open(&[]).await;
        page.settle().await;
        // The pad moves to and fro until enough charts have arrived, also on a busy machine.
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
        let released = page.value("sawflutter.latencies.release").await;
        let critical = page.value("sawflutter.latencies.critical").await;
        let bands = page.value("sawflutter.latencies.bands").await;
        assert!(!critical.as_array().unwrap().is_empty());
        assert!(!bands.as_array().unwrap().is_empty());
        println!(
            "pointer move to painted critical speeds: median {:.0} ms, 95th percentile {:.0} ms; to painted bands and verdict: median {:.0} ms, 95th percentile {:.0} ms; to painted chart at draft: median {:.0} ms, 95th percentile {:.0} ms \
             ({} moves, {} charts of {:.0} ms median); release to painted chart at design \
             accuracy: median {:.0} ms of {}; parts of a move, median / 95th percentile: {}; load {}",
            percentile(&critical, 0.5),
            percentile(&critical, 0.95),
            percentile(&bands, 0.5),
            percentile(&bands, 0.95),
            percentile(&times, 0.5),
            percentile(&times, 0.95),
            times.as_array().unwrap().len(),
            computed.as_array().unwrap().len(),
            percentile(&computed, 0.5),
            percentile(&released, 0.5),
            released,
            page.all_parts().await,
            std::fs::read_to_string("/proc/loadavg")
                .unwrap_or_default()
                .trim(),
        );
        assert_eq!(released.as_array().unwrap().len(), 3);

        // A chart of `design` accuracy that a further change has made stale is stopped.
        let charts = "sawflutter.computed.filter(([kind]) => kind === 'scene').length";
        let before = page.value(charts).await.as_u64().unwrap();
        for _ in 0..4 {
            page.script("sawflutter.state.set('blade.thickness_m', sawflutter.state.scene.blade.thickness_m + 1e-6)").await;
        }
        page.settle().await;
        let after = page.value(charts).await.as_u64().unwrap();
        assert_eq!(after, before + 1);
        page.close().await;
    });
}

#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn a_drag_that_pauses_shows_the_chart_at_full_accuracy() {
    run(async {
        let page = Page::open(&[]).await;
        page.settle().await;
        drag(&page, PAD, 10, (2, -1)).await;
        // The mouse button is still pressed.
        page.settle().await;
        let told = page.text("#computed").await;
        assert!(told.starts_with("design accuracy"), "{told}");
        let shown = page.value("sawflutter.report()").await;
        let jobs = "fetch('jobs').then((answer) => answer.json())";
        let before = page.value(jobs).await;
        let_go(&page).await;
        page.wait("sawflutter.latencies.release.length === 1").await;
        assert_eq!(
            page.value(jobs).await,
            before,
            "the chart was computed twice"
        );
        assert!(same(&page.value("sawflutter.report()").await, &shown));
        // The chart follows further moves.
        drag(&page, PAD, 10, (2, -1)).await;
        page.wait("document.querySelector('#computed').textContent.startsWith('draft')")
            .await;
        let_go(&page).await;
        page.settle().await;
        page.close().await;
    });
}

/// Script that defines `giveUp`, which cancels a computation and sends a scene that is refused at once. It returns the
/// times in milliseconds until this scene is answered and until the cancelled computation has ended; null if it was
/// finished before.
const GIVE_UP: &str = "
    const pause = (ms) => new Promise((resolve) => setTimeout(resolve, ms));
    const jobs = async () => (await fetch('jobs')).json();
    const giveUp = async (change, after) => {
        const scene = structuredClone(sawflutter.state.scene);
        change(scene);
        const before = await jobs();
        const abort = new AbortController();
        const done = fetch('chart/scene', { method: 'POST', body: JSON.stringify(scene), signal: abort.signal });
        done.then((answer) => answer.text()).catch(() => {});
        await pause(after);
        const begun = performance.now();
        abort.abort();
        await (await fetch('chart/scene', { method: 'POST', body: '{}' })).text();
        const waited = performance.now() - begun;
        for (;;) {
            const { stopped, finished } = await jobs();
            if (stopped > before.stopped) return [waited, performance.now() - begun];
            if (finished > before.finished + 1) return null;
            await pause(2);
        }
    };";

/// The computation may be cancelled at any stage, and its matrices may have any size.
#[test]
#[ignore = "needs chromium and chromium-driver; run by .ci/run"]
fn a_computation_starts_within_a_fifth_of_a_second_after_a_cancelled_one() {
    run(async {
        let gallery = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
        for (scene, change) in [
            ("paper.json", "scene.sweep = { from_rpm: 0, to_rpm: 20000 }"),
            ("paper.json", "scene.guides[0].stiffness_n_per_m = 1e10"),
            ("gallery/six-pads.json", "scene.accuracy = 'reference'"),
            ("gallery/damped-material.json", ""),
            ("gallery/in-cut.json", ""),
        ] {
            let path = gallery.join(scene);
            let page = Page::open(&[path.to_str().unwrap(), "--accuracy", "draft"]).await;
            page.settle().await;
            let mut told = Vec::new();
            for after in [20, 100, 300, 700, 1500, 3000] {
                let asked = format!(
                    "{{ {GIVE_UP} return await giveUp((scene) => {{ delete scene.accuracy; {change} }}, {after}); }}"
                );
                let found = page.awaited(&asked).await;
                let Some([waited, ended]) =
                    serde_json::from_value::<Option<[f64; 2]>>(found).unwrap()
                else {
                    break;
                };
                told.push(format!("{waited:.0}/{ended:.0} at {after}"));
                assert!(waited < 200.0, "{scene}, {change}: {waited} at {after}");
            }
            println!(
                "{scene}, {change}: the next turn came, and the work ended, in milliseconds after it was given up: {}",
                told.join(", ")
            );
            page.close().await;
        }
    });
}
