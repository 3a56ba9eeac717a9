//! `sawflutter study --scheduler`: the saws of a study on a cluster of Dask, through the Python
//! package of this program.

use std::io::{ErrorKind, Read, Write};
use std::path::Path;
use std::process::{Command, Stdio};

use crate::analyses::study::{Inputs, Study};
use anyhow::{Context, bail};

/// Environment variable that names the Python with the package; the program that pip installs sets it.
const PYTHON: &str = "SAWFLUTTER_PYTHON";
/// Python code that fails unless the package and Dask are installed, and prints the version of the package.
const PROBE: &str = "import sawflutter, distributed; print(sawflutter.__version__)";

/// Computes the saws that the log of a folder lacks.
pub fn compute(study: &Study, folder: &Path, address: &str) -> anyhow::Result<()> {
    let python = std::env::var_os(PYTHON).unwrap_or_else(|| "python3".into());
    let name = Path::new(&python).display();
    let remedy = format!(
        "--scheduler needs Python with this program's package and Dask: pip install 'sawflutter[dask]=={}'; {PYTHON} names a Python other than {name}",
        env!("CARGO_PKG_VERSION")
    );
    let probe = match Command::new(&python).args(["-c", PROBE]).output() {
        Err(error) if error.kind() == ErrorKind::NotFound => bail!("there is no {name}; {remedy}"),
        other => other.with_context(|| format!("cannot start {name}"))?,
    };
    if !probe.status.success() {
        let said = String::from_utf8_lossy(&probe.stderr);
        let last = said.trim().lines().last().unwrap_or("it does not say why");
        bail!("{name} cannot load what it takes ({last}); {remedy}");
    }
    let version = String::from_utf8_lossy(&probe.stdout).trim().to_owned();
    if version != env!("CARGO_PKG_VERSION") {
        bail!("{name} has version {version} of sawflutter; {remedy}");
    }
    let mut child = Command::new(&python)
        .args(["-m", "sawflutter._scheduler", address])
        .arg(folder)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .with_context(|| format!("cannot start {name}"))?;
    let inputs = serde_json::to_string(&Inputs::of(study))?;
    if let Some(mut input) = child.stdin.take() {
        // A write error is ignored: a child that ends before it has read the inputs writes the reason to its
        // standard output.
        let _ = input.write_all(inputs.as_bytes());
    }
    // The child writes its progress to the error stream, which it inherits, and its errors to the standard
    // output.
    let mut said = String::new();
    if let Some(mut output) = child.stdout.take() {
        output.read_to_string(&mut said)?;
    }
    let status = child.wait()?;
    match (status.success(), said.trim()) {
        (true, _) => Ok(()),
        (false, "") => bail!("{name} has stopped ({status}); run the study again, it goes on"),
        (false, said) => bail!("{said}"),
    }
}
