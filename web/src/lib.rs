//! The live page without a server: its requests are answered by this module, which runs as WebAssembly in a worker of
//! the browser.
//!
//! The worker writes a request as JSON to the buffer of [`reserve`] and calls [`answer`]; the content of the answer
//! stays at [`content`] until the next request.

use std::cell::RefCell;

use sawflutter::app::explore::{Answer, Backend, Question};
use sawflutter::model::scene::Scene;

#[link(wasm_import_module = "page")]
unsafe extern "C" {
    /// Returns the time of the browser's clock in milliseconds.
    safe fn milliseconds() -> f64;
    /// Receives one line of JSON: progress of a task, or early results of a diagram.
    safe fn line(pointer: *const u8, length: usize);
    /// Receives the stage of a diagram as JSON.
    safe fn stage(pointer: *const u8, length: usize);
}

thread_local! {
    static BACKEND: RefCell<Option<Backend>> = const { RefCell::new(None) };
    static REQUEST: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
    static ANSWER: RefCell<Option<Answer>> = const { RefCell::new(None) };
}

fn clock() -> f64 {
    milliseconds()
}

/// Creates the backend; its diagrams are numbered from `first`.
#[unsafe(no_mangle)]
pub extern "C" fn begin(first: usize) {
    let backend = Backend::new(&Scene::paper(), clock).on_stage(|at| {
        if let Ok(text) = serde_json::to_string(&at) {
            stage(text.as_ptr(), text.len());
        }
    });
    BACKEND.set(Some(backend.numbered_from(first)));
}

/// Sets the length of the request buffer in bytes and returns its address.
#[unsafe(no_mangle)]
pub extern "C" fn reserve(length: usize) -> *mut u8 {
    REQUEST.with_borrow_mut(|request| {
        request.clear();
        request.resize(length, 0);
        request.as_mut_ptr()
    })
}

/// Answers the request in the buffer. Returns the HTTP status; 0 before [`begin`], and if the request cannot be read.
#[unsafe(no_mangle)]
pub extern "C" fn answer() -> u32 {
    let question = REQUEST.with_borrow(|request| serde_json::from_slice::<Question>(request));
    let told = |text: String| line(text.as_ptr(), text.len());
    let answer =
        BACKEND.with_borrow(|backend| Some(backend.as_ref()?.answer(&question.ok()?, told)));
    let status = answer.as_ref().map_or(0, |answer| answer.status.into());
    ANSWER.set(answer);
    status
}

/// Returns the address of the content of the answer.
#[unsafe(no_mangle)]
pub extern "C" fn content() -> *const u8 {
    of_answer(|answer| answer.content.as_ptr()).unwrap_or_default()
}

/// Returns the length of the content in bytes.
#[unsafe(no_mangle)]
pub extern "C" fn content_length() -> usize {
    of_answer(|answer| answer.content.len()).unwrap_or_default()
}

/// Returns the address of the media type of the answer.
#[unsafe(no_mangle)]
pub extern "C" fn media_type() -> *const u8 {
    of_answer(|answer| answer.media_type.as_ptr()).unwrap_or_default()
}

/// Returns the length of the media type in bytes.
#[unsafe(no_mangle)]
pub extern "C" fn media_type_length() -> usize {
    of_answer(|answer| answer.media_type.len()).unwrap_or_default()
}

fn of_answer<T>(get: impl FnOnce(&Answer) -> T) -> Option<T> {
    ANSWER.with_borrow(|answer| answer.as_ref().map(get))
}
