//! `sawflutter schema`.

use std::io::Write;

use crate::analyses::study;
use crate::model::scene;
use clap::Args;

#[derive(Args)]
pub struct Arguments {
    /// Print the schema of a study instead
    #[arg(long)]
    study: bool,
}

/// Prints the JSON schema of a scene, or of a study.
pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let schema = if arguments.study {
        study::json_schema()
    } else {
        scene::json_schema()
    };
    writeln!(
        std::io::stdout(),
        "{}",
        serde_json::to_string_pretty(&schema)?
    )?;
    Ok(())
}
