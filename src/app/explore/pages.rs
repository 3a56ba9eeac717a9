//! Open pages: the server ends with the last of them.
//!
//! A page reports every few seconds that it is open, and when it is closed. An open connection would be
//! faster, but a browser opens only six to one server, and a seventh page would wait forever.

use std::collections::HashMap;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// Time within which a reloaded page returns.
const GRACE: Duration = Duration::from_secs(3);
/// Interval between checks.
const LOOK: Duration = Duration::from_millis(500);
/// Longest silence of an open page: browsers may run the timers of background pages once a minute only.
const SILENCE: Duration = Duration::from_secs(150);

/// Open pages, by names that they choose themselves.
#[derive(Default)]
pub struct Pages(Mutex<Open>);

#[derive(Default)]
struct Open {
    seen: HashMap<String, Instant>,
    /// Time at which the last page was closed, if no page is open.
    empty_since: Option<Instant>,
}

/// Largest number of pages; it limits the memory for names.
const MOST: usize = 1000;
/// Largest length of a name.
const LONGEST: usize = 64;

impl Pages {
    fn open(&self) -> MutexGuard<'_, Open> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Registers a page.
    pub fn seen(&self, page: String) {
        let mut open = self.open();
        if page.len() <= LONGEST && (open.seen.len() < MOST || open.seen.contains_key(&page)) {
            open.seen.insert(page, Instant::now());
            open.empty_since = None;
        }
    }

    /// Removes a page.
    pub fn left(&self, page: &str) {
        self.open().leave(|name, _| name == page);
    }

    /// Ends when the last page has been closed and none has been opened since.
    pub async fn last_closed(&self) {
        loop {
            tokio::time::sleep(LOOK).await;
            let mut open = self.open();
            open.leave(|_, seen| seen.elapsed() > SILENCE);
            if open
                .empty_since
                .is_some_and(|since| since.elapsed() > GRACE)
            {
                return;
            }
        }
    }
}

impl Open {
    fn leave(&mut self, gone: impl Fn(&str, &Instant) -> bool) {
        let before = self.seen.len();
        self.seen.retain(|name, seen| !gone(name, seen));
        if before > 0 && self.seen.is_empty() {
            self.empty_since = Some(Instant::now());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_page_that_leaves_is_noticed_and_one_that_comes_back() {
        let pages = Pages::default();
        assert!(pages.open().empty_since.is_none());
        pages.seen("a".into());
        pages.seen("b".into());
        pages.left("a");
        pages.left("unknown");
        assert!(pages.open().empty_since.is_none());
        pages.left("b");
        assert!(pages.open().empty_since.is_some());
        pages.seen("b".into());
        assert!(pages.open().empty_since.is_none());
    }

    #[test]
    fn names_are_short_and_not_too_many() {
        let pages = Pages::default();
        pages.seen("x".repeat(LONGEST + 1));
        for name in 0..2 * MOST {
            pages.seen(name.to_string());
        }
        assert_eq!(pages.open().seen.len(), MOST);
    }
}
