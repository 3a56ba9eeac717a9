//! `sawflutter schema`.

use std::io::Write;

/// Prints the JSON schema of a scene.
pub fn run() -> anyhow::Result<()> {
    let schema = sawflutter::scene::json_schema();
    writeln!(
        std::io::stdout(),
        "{}",
        serde_json::to_string_pretty(&schema)?
    )?;
    Ok(())
}
