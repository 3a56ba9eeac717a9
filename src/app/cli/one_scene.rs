//! Commands that compute a report of one saw: their options become arguments of the command line, and their reports files
//! and text.

use std::marker::PhantomData;
use std::path::Path;

use crate::analyses::commands::{Call, CommandReport};
use crate::analyses::door::{
    Argument, ArgumentKind, CommandError, CommandOptions, Entered, Step, entered,
};
use crate::analyses::{
    check, cut, deflect, fit, gap, place, report, response, runup, size, washboard,
};
use crate::model::scene::RefusedValue;
use clap::{Arg, ArgAction, ArgMatches, Args, FromArgMatches};
use serde_json::{Map, Value, json};

use super::block_text::say_if_missing;
use super::common::{Input, Output, read_text};
use super::page::Page;
use super::progress::watched;

/// A command of one saw as the program runs it.
pub trait OneScene: CommandOptions<Report: CommandReport + Send> + Sync {
    /// Whether it writes files without `--out`.
    const WRITES: bool = true;
    /// File of the report as a page, if it is always written.
    const PAGE: Option<&'static str> = None;
}

impl OneScene for check::Options {
    const WRITES: bool = false;
}
impl OneScene for cut::Options {}
impl OneScene for deflect::Options {}
impl OneScene for fit::Request {}
impl OneScene for gap::Options {}
impl OneScene for place::Request {}
impl OneScene for report::Options {
    const PAGE: Option<&'static str> = Some("report.html");
}
impl OneScene for response::Options {}
impl OneScene for runup::Options {}
impl OneScene for size::Options {}
impl OneScene for washboard::Options {}

/// The arguments of a command as given.
pub struct Given<C> {
    input: Input,
    output: Output,
    page: Page,
    options: Map<String, Value>,
    command: PhantomData<C>,
}

/// Heading of options that are numbers of the scene.
const OF_SCENE: &str = "Numbers of the scene, lengths with their unit";

/// Arguments of a command that have a name on the command line.
fn arguments<C: CommandOptions>() -> impl Iterator<Item = &'static Argument> {
    let call = Call::named(C::COMMAND);
    let all = call.into_iter().flat_map(|call| &call.arguments);
    all.filter(|argument| !argument.option.is_empty())
}

impl<C: OneScene> Args for Given<C> {
    fn augment_args(command: clap::Command) -> clap::Command {
        let command = Input::augment_args(command).args(arguments::<C>().map(declared));
        let command = Output::augment_args(command);
        let command = if C::WRITES {
            command
        } else {
            command.mut_arg("out", |out| {
                out.help("Write the report and a picture to this folder")
            })
        };
        if C::PAGE.is_some() {
            command
        } else {
            Page::augment_args(command)
        }
    }

    fn augment_args_for_update(command: clap::Command) -> clap::Command {
        Self::augment_args(command)
    }
}

/// An argument as clap knows it.
fn declared(argument: &'static Argument) -> Arg {
    let name = argument.name.as_str();
    let arg = Arg::new(name).help(argument.about.as_str());
    let arg = match &argument.kind {
        ArgumentKind::Table => return arg.value_name("TABLE"),
        ArgumentKind::Flag => arg.action(ArgAction::SetTrue),
        ArgumentKind::Speeds | ArgumentKind::Bounds | ArgumentKind::Values => {
            read(arg, argument).action(ArgAction::Append)
        }
        ArgumentKind::Word(words) => {
            let words: Vec<&str> = words.iter().map(String::as_str).collect();
            arg.value_name("NAME").value_parser(words)
        }
        ArgumentKind::Text => arg.value_name("TEXT"),
        ArgumentKind::Number(_) | ArgumentKind::Count(_) => read(arg, argument),
    };
    let arg = match &argument.default {
        Some(default) => arg.default_value(default.as_str()),
        None => arg,
    };
    let arg = match &argument.requires {
        Some(other) => arg.requires(other.as_str()),
        None => arg,
    };
    let arg = if argument.sets.is_empty() {
        arg
    } else {
        arg.help_heading(OF_SCENE)
    };
    arg.long(argument.option.as_str())
}

fn read(arg: Arg, argument: &'static Argument) -> Arg {
    arg.value_name(value_name(argument))
        .allow_hyphen_values(true)
        .value_parser(move |text: &str| argument.read(text))
}

fn value_name(argument: &Argument) -> &'static str {
    match (&argument.kind, argument.unit()) {
        (ArgumentKind::Count(_), _) => "COUNT",
        (ArgumentKind::Speeds, _) => "RPM",
        (ArgumentKind::Bounds, _) => "PATH[=FROM..TO]",
        (ArgumentKind::Values, _) => "PATH=VALUE,VALUE",
        (_, "rpm") => "RPM",
        (_, "m") => "LENGTH",
        (_, "m/s") => "M/S",
        (_, "°") => "DEG",
        (_, "Hz") => "HZ",
        (_, "N") => "N",
        (_, "W") => "W",
        (_, "s") => "S",
        (_, "N/m") => "N/M",
        _ => "NUMBER",
    }
}

impl<C: OneScene> FromArgMatches for Given<C> {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        let page = if C::PAGE.is_some() {
            Page::default()
        } else {
            Page::from_arg_matches(matches)?
        };
        let options = arguments::<C>()
            .filter_map(|argument| Some((argument.name.clone(), value(matches, argument)?)));
        Ok(Given {
            input: Input::from_arg_matches(matches)?,
            output: Output::from_arg_matches(matches)?,
            page,
            options: options.collect(),
            command: PhantomData,
        })
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

/// The value of an argument; `None` if it is not given and has no default.
fn value(matches: &ArgMatches, argument: &Argument) -> Option<Value> {
    let name = argument.name.as_str();
    match &argument.kind {
        ArgumentKind::Flag => matches.get_flag(name).then_some(Value::Bool(true)),
        ArgumentKind::Speeds | ArgumentKind::Bounds | ArgumentKind::Values => {
            let lists = matches.get_many::<Value>(name)?;
            let entries = lists.filter_map(Value::as_array).flatten().cloned();
            Some(entries.collect())
        }
        ArgumentKind::Word(_) | ArgumentKind::Text | ArgumentKind::Table => {
            matches.get_one::<String>(name).map(|text| json!(text))
        }
        ArgumentKind::Number(_) | ArgumentKind::Count(_) => matches.get_one::<Value>(name).cloned(),
    }
}

/// Computes the report of a command, writes its files and prints its summary. Returns whether the saw keeps all limits.
pub fn run<C: OneScene>(given: &Given<C>) -> anyhow::Result<bool> {
    let scene = given.input.scene()?;
    let Entered {
        scene,
        mut options,
        assumed,
    } = entered::<C>(scene, with_table::<C>(given.options.clone())?).map_err(of_options::<C>)?;
    if let Some(said) = assumed {
        eprintln!("{said}");
    }
    given.page.tried()?;
    let writes = C::WRITES || given.output.has_folder();
    let folder = writes.then(|| given.output.folder()).transpose()?;
    if let Some(folder) = &folder {
        options.keep_in(folder.path());
    }
    let report = watched(|progress| {
        let show = |step: Step| {
            progress.show_best(step.best_rpm);
            progress.show(step.what, step.done, step.of);
        };
        options.compute(&scene, &show)
    })?
    .map_err(|error| {
        say_if_missing(&scene, &error);
        of_options::<C>(error)
    })?;
    let Some(folder) = folder else {
        given.page.write(&report)?;
        given.output.say(&report)?;
        return Ok(C::is_kept(&report));
    };
    let mut others = Vec::new();
    if let Some((name, scene)) = C::resulting_scene(&report) {
        others.push((name, scene.map(serde_json::to_vec_pretty).transpose()?));
    }
    if let Some(name) = C::PAGE {
        others.push((name, Some(report.page()?.into_bytes())));
    }
    given.output.report(&folder, &given.page, &report, others)?;
    Ok(C::is_kept(&report))
}

/// The options with the name and the text of a table in place of its path.
fn with_table<C: CommandOptions>(
    mut options: Map<String, Value>,
) -> anyhow::Result<Map<String, Value>> {
    let mut tables = arguments::<C>().filter(|argument| argument.kind == ArgumentKind::Table);
    if let Some(argument) = tables.next()
        && let Some(Value::String(path)) = options.get(&argument.name)
    {
        let path = Path::new(path);
        let name = path.file_name().unwrap_or(path.as_os_str());
        let table = json!([
            name.to_string_lossy(),
            read_text(path, crate::analyses::fit::TABLE_FILE)?
        ]);
        options.insert(argument.name.clone(), table);
    }
    Ok(options)
}

/// An error with the names of options on the command line.
fn of_options<C: CommandOptions>(error: CommandError) -> anyhow::Error {
    let option = |name: &str| {
        let mut all = arguments::<C>().filter(|argument| argument.kind != ArgumentKind::Table);
        let found = all.find(|argument| argument.name == name);
        found.map(|argument| format!("--{}", argument.option))
    };
    match error {
        CommandError::Refused(refused) => match option(&refused.key) {
            Some(key) => RefusedValue { key, ..refused }.into(),
            None => refused.into(),
        },
        CommandError::Set { names, source } => {
            let given: Vec<String> = names.iter().filter_map(|name| option(name)).collect();
            let verb = if given.len() > 1 { "were" } else { "was" };
            anyhow::Error::from(source).context(format!("{} {verb} refused", given.join(", ")))
        }
        other => other.into(),
    }
}
