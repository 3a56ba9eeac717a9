//! Files of the page, embedded in the program.

use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Response};

const HTML: &str = "text/html; charset=utf-8";
const SCRIPT: &str = "text/javascript; charset=utf-8";
const STYLE: &str = "text/css; charset=utf-8";
const FONT: &str = "font/otf";

macro_rules! files {
    ($($name:literal: $kind:expr, $path:literal;)*) => {
        const FILES: &[(&str, &str, &[u8])] = &[$(($name, $kind, include_bytes!($path))),*];
    };
}

files! {
    "index.html": HTML, "page/index.html";
    "style.css": STYLE, "page/style.css";
    "main.js": SCRIPT, "page/main.js";
    "result.js": SCRIPT, "page/result.js";
    "answers.js": SCRIPT, "page/answers.js";
    "talk.js": SCRIPT, "page/talk.js";
    "times.js": SCRIPT, "page/times.js";
    "backend.js": SCRIPT, "page/backend.js";
    "scene.js": SCRIPT, "page/scene.js";
    "kept.js": SCRIPT, "page/kept.js";
    "link.js": SCRIPT, "page/link.js";
    "branches.js": SCRIPT, "page/branches.js";
    "files.js": SCRIPT, "page/files.js";
    "pointed.js": SCRIPT, "page/pointed.js";
    "live.js": SCRIPT, "page/live.js";
    "pinned.js": SCRIPT, "page/pinned.js";
    "range.js": SCRIPT, "page/range.js";
    "fields.js": SCRIPT, "page/fields.js";
    "pairs.js": SCRIPT, "page/pairs.js";
    "parts.js": SCRIPT, "page/parts.js";
    "dock.js": SCRIPT, "page/dock.js";
    "dom.js": SCRIPT, "page/dom.js";
    "figure.js": SCRIPT, "page/figure.js";
    "form.js": SCRIPT, "page/form.js";
    "controls.js": SCRIPT, "page/controls.js";
    "schema.js": SCRIPT, "page/schema.js";
    "gallery.js": SCRIPT, "page/gallery.js";
    "hand.js": SCRIPT, "page/hand.js";
    "blade.js": SCRIPT, "page/blade.js";
    "shapes.js": SCRIPT, "page/shapes.js";
    "sheet.js": SCRIPT, "page/sheet.js";
    "phrases.js": SCRIPT, "page/phrases.js";
    "motion.js": SCRIPT, "page/motion.js";
    "charts.js": SCRIPT, "page/charts.js";
    "colours.js": SCRIPT, "page/colours.js";
    "marks.js": SCRIPT, "page/marks.js";
    "panel.js": SCRIPT, "page/panel.js";
    "tabs.js": SCRIPT, "page/tabs.js";
    "task.js": SCRIPT, "page/task.js";
    "inputs.js": SCRIPT, "page/inputs.js";
    "map.js": SCRIPT, "page/map.js";
    "outline.js": SCRIPT, "page/outline.js";
    "ruler.js": SCRIPT, "page/ruler.js";
    "readout.js": SCRIPT, "page/readout.js";
    "relief.js": SCRIPT, "page/relief.js";
    "toolbar.js": SCRIPT, "page/toolbar.js";
    "waiting.js": SCRIPT, "page/waiting.js";
    "words.js": SCRIPT, "page/words.js";
    "uplot.js": SCRIPT, "../../../assets/uplot/uPlot.iife.min.js";
    "uplot.css": STYLE, "../../../assets/uplot/uPlot.min.css";
    "Inter-Regular.otf": FONT, "../../../assets/fonts/Inter-Regular.otf";
    "Inter-SemiBold.otf": FONT, "../../../assets/fonts/Inter-SemiBold.otf";
}

/// Returns a file by its name, or status 404.
pub fn file(name: &str) -> Response {
    match FILES.iter().find(|(known, ..)| *known == name) {
        Some((_, kind, content)) => ([(header::CONTENT_TYPE, *kind)], *content).into_response(),
        None => StatusCode::NOT_FOUND.into_response(),
    }
}
