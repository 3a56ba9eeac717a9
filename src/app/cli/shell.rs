//! `sawflutter completions` and `sawflutter man`: what shells know of the program.

use clap::{Args, Command};
use clap_complete::Shell;

use super::common::say;

pub const COMPLETIONS: &str = "\
Examples:
  sawflutter completions bash > ~/.local/share/bash-completion/completions/sawflutter
  sawflutter completions zsh > ~/.zfunc/_sawflutter # a folder of $fpath
  sawflutter completions fish > ~/.config/fish/completions/sawflutter.fish";

pub const MAN: &str = "\
Examples:
  sawflutter man > ~/.local/share/man/man1/sawflutter.1";

#[derive(Args)]
pub struct Completions {
    /// The shell
    shell: Shell,
}

/// Prints the completions of the program for a shell.
pub fn completions(arguments: &Completions, mut program: Command) -> anyhow::Result<()> {
    let mut text = Vec::new();
    clap_complete::generate(arguments.shell, &mut program, "sawflutter", &mut text);
    Ok(say(&String::from_utf8(text)?)?)
}

/// Prints the manual page: the program, and every command after it.
pub fn man(program: &Command) -> anyhow::Result<()> {
    let mut text = Vec::new();
    clap_mangen::Man::new(program.clone()).render(&mut text)?;
    for command in program.get_subcommands() {
        let name = format!("sawflutter {}", command.get_name());
        let page = clap_mangen::Man::new(command.clone().bin_name(name.clone()));
        text.extend(format!(".SH {}\n", name.to_uppercase()).into_bytes());
        page.render_description_section(&mut text)?;
        page.render_options_section(&mut text)?;
    }
    Ok(say(&String::from_utf8(text)?)?)
}
