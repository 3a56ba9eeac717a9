//! The Python package of this program, for what only Python can do.

use std::io::{ErrorKind, Read, Write};
use std::path::Path;
use std::process::{Command, Stdio};

use anyhow::{Context, bail};

/// Environment variable that names the Python with the package; the program that pip installs sets it.
const PYTHON: &str = "SAWFLUTTER_PYTHON";

/// A command or an option that needs the package.
pub struct Need {
    /// Name of the command or option.
    pub of: &'static str,
    /// What it needs beside the package, in words.
    pub beside: &'static str,
    /// Names of the modules to import.
    pub modules: &'static str,
    /// Names of the extras that install them.
    pub extras: &'static str,
    /// Module of the package that does the work.
    pub runs: &'static str,
}

impl Need {
    /// The output of the module for these arguments and this standard input. The module writes its progress to the error
    /// stream, which it inherits, and if it fails, the reason to its output.
    pub fn answer(&self, arguments: &[&str], input: &str) -> anyhow::Result<String> {
        let python = std::env::var_os(PYTHON).unwrap_or_else(|| "python3".into());
        let name = Path::new(&python).display();
        self.check(Command::new(&python), &name.to_string())?;
        let mut child = Command::new(&python)
            .args(["-m", self.runs])
            .args(arguments)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .with_context(|| format!("cannot start {name}"))?;
        if let Some(mut pipe) = child.stdin.take() {
            // A write error is ignored: a child that ends before it has read its input writes the reason to its output.
            let _ = pipe.write_all(input.as_bytes());
        }
        let mut said = Vec::new();
        if let Some(mut output) = child.stdout.take() {
            output.read_to_end(&mut said)?;
        }
        let said = String::from_utf8_lossy(&said).into_owned();
        let status = child.wait()?;
        match (status.success(), said.trim()) {
            (true, _) => Ok(said),
            (false, "") => bail!("{name} has stopped ({status}); run the same line again"),
            (false, said) => bail!("{said}"),
        }
    }

    /// Checks that Python has this version of the package, and what is needed beside it.
    fn check(&self, mut python: Command, name: &str) -> anyhow::Result<()> {
        let Need {
            of,
            beside,
            modules,
            extras,
            ..
        } = self;
        let own = env!("CARGO_PKG_VERSION");
        let remedy = format!(
            "{of} needs Python with this program's package and {beside}: pip install 'sawflutter[{extras}]=={own}'; {PYTHON} names a Python other than {name}"
        );
        let probe = format!("import sawflutter, {modules}; print(sawflutter.__version__)");
        let probe = match python.args(["-c", &probe]).output() {
            Err(error) if error.kind() == ErrorKind::NotFound => {
                bail!("there is no {name}; {remedy}")
            }
            other => other.with_context(|| format!("cannot start {name}"))?,
        };
        if !probe.status.success() {
            let said = String::from_utf8_lossy(&probe.stderr);
            let last = said.trim().lines().last().unwrap_or("it does not say why");
            bail!("{name} cannot load what it takes ({last}); {remedy}");
        }
        let version = String::from_utf8_lossy(&probe.stdout).trim().to_owned();
        if version != own {
            bail!("{name} has version {version} of sawflutter; {remedy}");
        }
        Ok(())
    }
}
