//! The program `sawflutter`; `sawflutter --help` describes its commands.

#![forbid(unsafe_code)]

use std::process::ExitCode;

fn main() -> ExitCode {
    ExitCode::from(sawflutter::app::cli::run(std::env::args_os()))
}
