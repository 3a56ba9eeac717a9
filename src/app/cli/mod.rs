//! The command line: arguments become calls of the library, and their results files and text.

mod analyze;
mod batch;
mod block_text;
mod colour;
mod common;
mod compare;
mod examples;
#[cfg(feature = "explore")]
mod explore;
mod export;
mod keys;
mod map;
mod margin;
mod mistyped;
mod one_scene;
mod output;
mod page;
mod pictures;
mod progress;
mod python;
mod records;
mod scheduler;
mod schema;
mod shell;
mod study;
mod tradeoff;

use std::ffi::OsString;
use std::path::Path;

use crate::analyses::{
    check, cut, deflect, fit, gap, place, report, response, runup, size, washboard,
};
use crate::page::text::{printable, printable_line};
use clap::{CommandFactory, Parser, Subcommand};

use self::common::in_words;
pub use self::keys::listed as keys;
use self::one_scene::Given;

/// Stability of thin, fast, guided circular saws: Campbell diagram, critical
/// speeds, divergence and flutter bands, and a plain verdict.
#[derive(Parser)]
#[command(version, after_help = EXAMPLES)]
struct Arguments {
    #[command(subcommand)]
    command: Option<Command>,
    /// Show no progress; messages and results remain
    #[arg(long, global = true)]
    quiet: bool,
}

#[derive(Subcommand)]
enum Command {
    /// Chart a saw: report.json, campbell.csv, and figures as PNG and SVG
    #[command(after_help = analyze::EXAMPLES)]
    Analyze(analyze::Arguments),
    /// Report a saw on one page: answer, deviation, margins, what to change; report.html, design.json
    #[command(after_help = examples::REPORT)]
    Report(Given<report::Options>),
    /// Cut wood: is the saw stable before, during and after? cut.json and figures
    #[command(after_help = examples::CUT)]
    Cut(Given<cut::Options>),
    /// Run up under a lateral force: deflection and response; runup.json and figures
    #[command(after_help = examples::RUNUP)]
    Runup(Given<runup::Options>),
    /// Amplitude over speed: side force, a blade not flat or not balanced, teeth; response.json, figures
    #[command(after_help = examples::RESPONSE)]
    Response(Given<response::Options>),
    /// How far does the blade lean, and at which speeds does it jump? deflect.json and a figure
    #[command(after_help = examples::DEFLECT)]
    Deflect(Given<deflect::Options>),
    /// How tight may the guides be? Chart over the amplitude, deflection over the gap; gap.json, a figure
    #[command(after_help = examples::GAP)]
    Gap(Given<gap::Options>),
    /// Does washboarding grow: teeth that cut the wavy surface of the last passage?
    #[command(after_help = examples::WASHBOARD)]
    Washboard(Given<washboard::Options>),
    /// Compare a saw with limits: exit code 0 if it keeps them, 1 if not
    #[command(after_help = examples::CHECK)]
    Check(Given<check::Options>),
    /// Change a saw by hand on a page in the browser, which computes its chart again
    #[cfg(feature = "explore")]
    #[command(after_help = explore::EXAMPLES)]
    Explore(explore::Arguments),
    /// Fit guides, density or other numbers to measured frequencies; fit.json, a scene, figures
    #[command(after_help = examples::FIT)]
    Fit(Given<fit::Request>),
    /// Read records of a measured saw, with the Python package: peaks, rows for fit, figures
    #[command(after_help = records::EXAMPLES)]
    Records(records::Arguments),
    /// How fast may a measured saw turn? From peaks over speed, with the Python package
    #[command(after_help = margin::EXAMPLES)]
    Margin(margin::Arguments),
    /// Put the guides where flutter comes latest; place.json, a scene, a map
    #[command(after_help = examples::PLACE)]
    Place(Given<place::Request>),
    /// How thick, how stiff, how fast? Values with which the saw keeps its limits; size.json, a figure
    #[command(after_help = examples::SIZE)]
    Size(Given<size::Options>),
    /// Vary a saw within tolerances or over a grid: quantiles and probability of passing
    #[command(after_help = study::EXAMPLES)]
    Study(study::Arguments),
    /// Chart stability over one number and the speed, or over two numbers; map.json and a figure
    #[command(after_help = map::EXAMPLES)]
    Map(map::Arguments),
    /// Compare saws: Campbell diagrams one over the other, a table; compare.json and a figure
    #[command(after_help = compare::EXAMPLES)]
    Compare(compare::Arguments),
    /// Measure run time against true error; tradeoff.json, a figure
    #[command(after_help = tradeoff::EXAMPLES)]
    Tradeoff(tradeoff::Arguments),
    /// Write the matrices of a saw as NumPy files
    #[command(after_help = export::EXAMPLES)]
    Export(export::Arguments),
    /// Print the keys of a scene, or of a study: units, defaults, usual ranges
    #[command(after_help = keys::EXAMPLES)]
    Keys(keys::Arguments),
    /// Print the JSON schema of a scene, or of a study
    Schema(schema::Arguments),
    /// Print the completions of a shell
    #[command(after_help = shell::COMPLETIONS)]
    Completions(shell::Completions),
    /// Print the manual page
    #[command(after_help = shell::MAN)]
    Man,
}

const EXAMPLES: &str = "\
Examples:
  sawflutter                            # chart the built-in guided spline saw
  sawflutter my-saw.json                # chart your own saw
  sawflutter saws/*.json                # chart many, and put them in a table
  sawflutter cut                        # is it stable in the wood?
  sawflutter check --rpm 1250           # does it keep the 85 % rule?
  sawflutter explore --open             # drag the guides in your browser
  sawflutter runup                      # how does it vibrate as it speeds up?
  sawflutter deflect                    # how far does it lean?
  sawflutter schema > scene.schema.json # let your editor complete scene keys

Exit code: 0 done, 1 a check failed, 2 the input was refused or the run failed.";

/// Runs the command given by the arguments, the first of which is the name of the program. Returns the exit code:
/// 0 done, 1 a check failed, 2 refused or failed.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> u8 {
    let typed = with_command(arguments);
    let arguments = match Arguments::try_parse_from(&typed) {
        Ok(arguments) => arguments,
        // The message repeats the user's words, and control characters in them could control the terminal:
        // they are made visible.
        Err(refusal) if refusal.use_stderr() => {
            let refusal = mistyped::explained(refusal, &Arguments::command(), &typed);
            eprint!("{}", printable(&refusal.render().to_string()));
            return 2;
        }
        // A request for the help or the version is no failure.
        Err(help) => {
            let _ = help.print();
            return 0;
        }
    };
    progress::hush(arguments.quiet);
    match command(arguments.command) {
        Ok(true) => 0,
        Ok(false) => 1,
        Err(error) if is_closed_pipe(&error) => 0,
        Err(error) => {
            eprintln!("error: {}", printable_line(&in_words(&error)));
            2
        }
    }
}

/// The arguments, with `analyze` before an option or a file if no command is named. A word with a dot or a slash
/// counts as a file even if it does not exist; another word is left to be refused as a misspelt command.
fn with_command(arguments: impl IntoIterator<Item = OsString>) -> Vec<OsString> {
    let mut arguments: Vec<OsString> = arguments.into_iter().collect();
    let mut words = arguments.iter().skip(1);
    let Some(first) = words.find(|word| *word != "--quiet") else {
        return arguments;
    };
    let text = first.to_string_lossy();
    let of_program = ["-h", "--help", "-V", "--version", "help"].contains(&&*text)
        || Arguments::command().find_subcommand(first).is_some();
    let option = text.starts_with('-');
    let file = text.contains(['.', '/', '\\']) || Path::new(first).exists();
    if !of_program && (option || file) {
        arguments.insert(1, "analyze".into());
    }
    arguments
}

/// Runs a command; without one, `analyze`. Returns false if a limit of the command is not kept.
fn command(command: Option<Command>) -> anyhow::Result<bool> {
    match command {
        None => analyze::run(&analyze::Arguments::default()),
        Some(Command::Analyze(arguments)) => analyze::run(&arguments),
        Some(Command::Cut(arguments)) => return one_scene::run(&arguments),
        Some(Command::Runup(arguments)) => return one_scene::run(&arguments),
        Some(Command::Report(arguments)) => return one_scene::run(&arguments),
        Some(Command::Response(arguments)) => return one_scene::run(&arguments),
        Some(Command::Deflect(arguments)) => return one_scene::run(&arguments),
        Some(Command::Gap(arguments)) => return one_scene::run(&arguments),
        Some(Command::Washboard(arguments)) => return one_scene::run(&arguments),
        #[cfg(feature = "explore")]
        Some(Command::Explore(arguments)) => explore::run(&arguments),
        Some(Command::Fit(arguments)) => return one_scene::run(&arguments),
        Some(Command::Records(arguments)) => records::run(&arguments),
        Some(Command::Margin(arguments)) => margin::run(&arguments),
        Some(Command::Map(arguments)) => map::run(&arguments),
        Some(Command::Compare(arguments)) => compare::run(&arguments),
        Some(Command::Tradeoff(arguments)) => tradeoff::run(&arguments),
        Some(Command::Export(arguments)) => export::run(&arguments),
        Some(Command::Place(arguments)) => return one_scene::run(&arguments),
        Some(Command::Size(arguments)) => return one_scene::run(&arguments),
        Some(Command::Check(arguments)) => return one_scene::run(&arguments),
        Some(Command::Study(arguments)) => study::run(&arguments),
        Some(Command::Keys(arguments)) => return keys::run(&arguments),
        Some(Command::Schema(arguments)) => schema::run(&arguments),
        Some(Command::Completions(arguments)) => {
            shell::completions(&arguments, Arguments::command())
        }
        Some(Command::Man) => shell::man(&Arguments::command()),
    }
    .map(|()| true)
}

/// Whether the reader of the output has closed it, like `head`, which is no failure.
fn is_closed_pipe(error: &anyhow::Error) -> bool {
    error
        .chain()
        .filter_map(|cause| cause.downcast_ref::<std::io::Error>())
        .any(|cause| cause.kind() == std::io::ErrorKind::BrokenPipe)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The commands of examples, in words: continued lines are joined, pipes are split, and comments and
    /// redirections are removed.
    fn commands(examples: &str) -> Vec<Vec<String>> {
        let joined = examples.replace("\\\n", "");
        let lines = joined.lines().filter(|line| line.starts_with("  "));
        let bare = lines.filter_map(|line| line.split(" # ").next());
        let parts = bare.flat_map(|line| line.split('|'));
        let called = parts.filter_map(|part| part.split('>').next().map(str::trim));
        let ours = called.filter(|part| part.split(' ').next() == Some("sawflutter"));
        let words = |part: &str| {
            let words = part.split_whitespace().map(|word| word.replace('"', ""));
            words
                .map(|word| word.replace("$SLURM_ARRAY_TASK_ID", "3"))
                .collect()
        };
        ours.map(words).collect()
    }

    /// The arguments of each example in `--help` are accepted.
    #[test]
    fn every_example_of_help_is_a_command() {
        let program = Arguments::command();
        let mut helps = vec![program.get_after_help().map(ToString::to_string)];
        helps.extend(
            program
                .get_subcommands()
                .map(|c| c.get_after_help().map(ToString::to_string)),
        );
        let found: Vec<Vec<String>> = helps
            .iter()
            .flatten()
            .flat_map(|help| commands(help))
            .collect();
        assert!(found.len() > 35, "{}", found.len());
        for words in found {
            let asked = with_command(words.iter().map(OsString::from));
            let parsed = Arguments::try_parse_from(asked);
            assert!(parsed.is_ok(), "{words:?}: {}", parsed.err().unwrap());
        }
    }

    #[test]
    fn quiet_stands_before_a_command_or_after_it() {
        for words in [
            "--quiet check",
            "check --quiet",
            "--quiet",
            "--quiet --json",
            "saw.json --quiet",
        ] {
            let words = ["sawflutter"].into_iter().chain(words.split(' '));
            let asked = with_command(words.map(OsString::from));
            assert!(Arguments::try_parse_from(asked).unwrap().quiet);
        }
    }

    /// No option of a command has the name of one that every command has, and every default is read.
    #[test]
    fn no_two_options_have_one_name() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn a_text_that_is_no_number_is_refused_in_plain_words() {
        let refused = |words: &[&str]| {
            let words = std::iter::once(&"sawflutter")
                .chain(words)
                .map(OsString::from);
            Arguments::try_parse_from(words).err().unwrap().to_string()
        };
        let fast = refused(&["check", "--rpm", "fast"]);
        assert!(fast.contains("it must be a number in rpm"), "{fast}");
        let comma = refused(&["check", "--rpm", "1,250"]);
        assert!(comma.contains("write one of these"), "{comma}");
        let count = refused(&["place", "--samples", "2.5"]);
        assert!(count.contains("a whole number"), "{count}");
        for said in [fast, comma, count] {
            assert!(
                !said.contains("literal") && !said.contains("digit"),
                "{said}"
            );
        }
    }
}
