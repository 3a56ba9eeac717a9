//! Goal: what `sawflutter explore` shows and saves in a real browser is what the command line
//! finds for the same scene, and it answers while a hand moves.
//!
//! Needs Debian's `chromium` and `chromium-driver`; `.ci/run` installs them and runs these tests
//! with `--ignored`. Screenshots go to `target/explore-screenshots/`;
//! `figures/explore.png` is `1280-after.png`.

mod browser;
mod chart;
mod form;
mod kept;
mod looks;
mod pace;
mod tabs;
mod tasks;
mod without_server;
