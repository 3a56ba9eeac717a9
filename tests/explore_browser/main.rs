//! Goal: `sawflutter explore` shows and saves the results of the command line for the same scene in a real browser, and
//! it answers during a drag.
//!
//! Needs Debian's `chromium` and `chromium-driver`; `.ci/run` installs them and runs these tests
//! with `--ignored`. Screenshots go to `target/explore-screenshots/`;
//! `figures/explore.png` is `1280-after.png`.

mod browser;
mod chart;
mod form;
mod hand;
mod kept;
mod looks;
mod meaning;
mod pace;
mod parts;
mod tabs;
mod tasks;
mod without_server;
