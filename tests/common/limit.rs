//! A time limit for tests that may hang.

use std::io::Write;
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::time::Duration;

/// A limit that is in force until it is dropped. After its time it prints the running test and ends the test program,
/// because nothing else stops a thread that computes.
pub struct Limit {
    _over: Sender<()>,
}

impl Limit {
    pub fn of(seconds: u64, doing: &str) -> Self {
        let (over, ended) = channel();
        let doing = doing.to_owned();
        std::thread::spawn(move || {
            let waited = ended.recv_timeout(Duration::from_secs(seconds));
            if waited == Err(RecvTimeoutError::Timeout) {
                let mut error = std::io::stderr().lock();
                let _ = writeln!(error, "not over after {seconds} s: {doing}");
                std::process::abort();
            }
        });
        Limit { _over: over }
    }
}
