//! The program under test.

use std::path::PathBuf;

/// The program of the variable SAWFLUTTER_PROGRAM, which may be one that was built as users build it; otherwise the one
/// that was built with the tests, whose dev-dependencies can switch on features of dependencies that a user's build
/// does not have.
pub fn program() -> PathBuf {
    let built_with_tests = || env!("CARGO_BIN_EXE_sawflutter").into();
    std::env::var_os("SAWFLUTTER_PROGRAM").map_or_else(built_with_tests, PathBuf::from)
}
