//! `sawflutter explore`.

use std::io::Write;
use std::path::Path;

use crate::app::explore::{Options, serve};
use clap::Args;

use super::common::Input;

pub const EXAMPLES: &str = "\
Examples:
  sawflutter explore --open      # the built-in saw, in your browser
  sawflutter explore my-saw.json # your own; open the address that is printed
  sawflutter explore --port 8080 # at an address that stays the same

The page comes from the program itself, to this computer alone (127.0.0.1);
nothing is fetched from the net, nothing is written but what you save. Closing a
page stops what it computes; the program ends with Ctrl-C, or three seconds
after the last page that was opened has been closed, two and a half minutes
after a browser that was ended without closing it.";

#[derive(Args)]
pub struct Arguments {
    #[command(flatten)]
    input: Input,
    /// Port on 127.0.0.1 [default: a free one]
    #[arg(
        long,
        value_name = "PORT",
        default_value_t = 0,
        hide_default_value = true
    )]
    port: u16,
    /// Open the page in the browser
    #[arg(long)]
    open: bool,
}

/// Serves the page until Ctrl-C, or until the last opened page has been closed.
pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let scene = arguments.input.scene()?;
    let options = Options {
        port: arguments.port,
        file: arguments.input.file().map(Path::to_owned),
    };
    serve(&scene, &options, |address| {
        let mut stdout = std::io::stdout().lock();
        // A write error is ignored, because the page works even if the standard output is closed.
        let _ = writeln!(
            stdout,
            "{address}\nOpen this address; the program ends with Ctrl-C or with the page."
        );
        let _ = stdout.flush();
        if arguments.open
            && let Err(error) = open::that_detached(address)
        {
            eprintln!("no browser could be opened ({error}); open the address yourself");
        }
    })?;
    Ok(())
}
