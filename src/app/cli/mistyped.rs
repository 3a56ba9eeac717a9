//! The option that was meant by a mistyped one.

use std::ffi::OsString;

use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{Command, Error};
use strsim::damerau_levenshtein;

/// Largest number of letters by which an option may differ from a mistyped one, by the length of that one.
fn largest_distance(length: usize) -> usize {
    if length < 6 { 1 } else { 2 }
}

/// The refusal with the option that was meant, where clap does not find it: it compares the letters at their places, so that it misses
/// two that are exchanged in a short word.
pub fn explained(mut refusal: Error, program: &Command, arguments: &[OsString]) -> Error {
    if refusal.kind() != ErrorKind::UnknownArgument
        || refusal.get(ContextKind::SuggestedArg).is_some()
    {
        return refusal;
    }
    let Some(ContextValue::String(given)) = refusal.get(ContextKind::InvalidArg) else {
        return refusal;
    };
    if let Some(meant) = meant(given, program, arguments) {
        refusal.remove(ContextKind::Suggested);
        refusal.insert(ContextKind::SuggestedArg, ContextValue::String(meant));
    }
    refusal
}

/// The nearest option of the command among the arguments.
fn meant(given: &str, program: &Command, arguments: &[OsString]) -> Option<String> {
    let word = given.strip_prefix("--")?;
    let mut named = arguments.iter().skip(1);
    let command = named.find_map(|name| program.find_subcommand(name))?;
    let options = command.get_arguments().filter_map(clap::Arg::get_long);
    let distances = options.map(|option| (damerau_levenshtein(word, option), option));
    let (distance, option) = distances.min()?;
    (distance <= largest_distance(word.len())).then(|| format!("--{option}"))
}

#[cfg(test)]
mod tests {
    use clap::{CommandFactory, Parser};

    use super::super::Arguments;
    use super::*;

    #[test]
    fn the_option_that_was_meant_is_named() {
        for (command, given, meant) in [
            ("check", "--rmp", Some("--rpm")),
            ("map", "--piont", Some("--points")),
            ("place", "--sampels", Some("--samples")),
            ("check", "--zebra", None),
        ] {
            let words: Vec<OsString> = ["sawflutter", command, given, "3"].map(Into::into).into();
            let refusal = Arguments::try_parse_from(&words).err().unwrap();
            let told = explained(refusal, &Arguments::command(), &words).to_string();
            match meant {
                Some(meant) => assert!(told.contains(&format!("exists: '{meant}'")), "{told}"),
                None => assert!(!told.contains("exists"), "{told}"),
            }
        }
    }
}
