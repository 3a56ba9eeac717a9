//! The commands of one saw by their names, for faces that are given a name.

use std::sync::LazyLock;

use schemars::schema_for;
use serde::Serialize;
use serde_json::{Map, Value};

use super::CommandReport;
use crate::analyses::door::{
    Argument, CommandError, CommandOptions, Entered, Progress, described, entered,
};
use crate::analyses::{
    check, cut, deflect, fit, gap, place, report, response, runup, size, washboard,
};
use crate::model::scene::{Scene, SceneFile};

/// A command of one saw.
#[derive(Debug, Clone, Serialize)]
pub struct Call {
    /// Name on the command line, like `gap`.
    pub command: &'static str,
    /// Name of the method of a scene in Python, like `run_gap`.
    pub method: &'static str,
    /// What it does.
    pub about: String,
    /// Its arguments, in order.
    pub arguments: Vec<Argument>,
    #[serde(skip)]
    run: Run,
}

type Run = fn(Scene, Map<String, Value>, Progress<'_>) -> Result<Ran, CommandError>;

/// The result of a command.
pub struct Ran {
    /// The report, for its text and figures.
    pub report: Box<dyn CommandReport>,
    /// The report as JSON.
    pub json: Value,
    /// The scene that results of a fit or a placement, unless it misses a limit.
    pub scene: Option<SceneFile>,
    /// What was assumed beside the options, in words.
    pub assumed: Option<String>,
}

/// All commands of one saw.
static CALLS: LazyLock<Vec<Call>> = LazyLock::new(|| {
    vec![
        Call::of::<check::Options>(),
        Call::of::<cut::Options>(),
        Call::of::<runup::Options>(),
        Call::of::<deflect::Options>(),
        Call::of::<report::Options>(),
        Call::of::<response::Options>(),
        Call::of::<gap::Options>(),
        Call::of::<washboard::Options>(),
        Call::of::<fit::Request>(),
        Call::of::<place::Request>(),
        Call::of::<size::Options>(),
    ]
});

impl Call {
    /// All commands of one saw.
    pub fn all() -> &'static [Self] {
        &CALLS
    }

    /// The command of a name; `None` if it is none of one saw.
    pub fn named(command: &str) -> Option<&'static Self> {
        CALLS.iter().find(|call| call.command == command)
    }

    /// Runs the command with options by their names.
    ///
    /// # Errors
    /// [`CommandError`].
    pub fn run(
        &self,
        scene: Scene,
        options: Map<String, Value>,
        progress: Progress<'_>,
    ) -> Result<Ran, CommandError> {
        (self.run)(scene, options, progress)
    }

    fn of<C: CommandOptions<Report: CommandReport + 'static>>() -> Self {
        Call {
            command: C::COMMAND,
            method: C::METHOD,
            about: format!("{}.", described(schema_for!(C).as_value())),
            arguments: Argument::all::<C>(),
            run: run::<C>,
        }
    }
}

fn run<C: CommandOptions<Report: CommandReport + 'static>>(
    scene: Scene,
    given: Map<String, Value>,
    progress: Progress<'_>,
) -> Result<Ran, CommandError> {
    let Entered {
        scene,
        options,
        assumed,
    } = entered::<C>(scene, given)?;
    let report = options.compute(&scene, progress)?;
    let resulting = C::resulting_scene(&report).and_then(|(_, scene)| scene.cloned());
    Ok(Ran {
        json: serde_json::to_value(&report).map_err(CommandError::failed)?,
        scene: resulting,
        assumed,
        report: Box::new(report),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analyses::door::ArgumentKind;
    use crate::model::scene::Quantity;

    /// A number that replaces one of the scene is given in the unit of its key.
    #[test]
    fn numbers_of_the_scene_have_the_units_of_their_names() {
        let arguments = || Call::all().iter().flat_map(|call| &call.arguments);
        let numbers = || arguments().filter(|of| matches!(of.kind, ArgumentKind::Number(_)));
        assert!(numbers().filter(|of| !of.sets.is_empty()).count() > 8);
        for argument in numbers().filter(|of| !of.sets.is_empty()) {
            let unit = Quantity::of(&argument.sets).map(|quantity| quantity.unit);
            assert_eq!(Some(argument.unit()), unit, "{}", argument.name);
        }
    }

    /// Every field of every command is read: it has a kind, words where it is one of several, a meaning, and a name on the
    /// command line that no other has.
    #[test]
    fn every_argument_is_declared_in_full() {
        for call in Call::all() {
            assert!(call.about.len() > 20, "{}", call.command);
            let mut options = Vec::new();
            for argument in &call.arguments {
                let of = format!("{} {}", call.command, argument.name);
                assert!(argument.about.contains(' '), "{of}");
                if let ArgumentKind::Word(words) = &argument.kind {
                    assert!(words.len() > 1, "{of}");
                }
                if !argument.option.is_empty() {
                    options.push(&argument.option);
                }
            }
            let count = options.len();
            options.sort();
            options.dedup();
            assert_eq!(options.len(), count, "{}", call.command);
        }
    }

    /// Without any option each command has those of its defaults, and a name of none is refused.
    #[test]
    fn what_is_not_given_has_its_default() {
        let place = Call::named("place").unwrap();
        let samples = place.arguments.iter().find(|of| of.name == "samples");
        assert_eq!(samples.unwrap().kind, ArgumentKind::Count(64));
        let given = Map::from_iter([("sample".to_owned(), Value::from(3))]);
        let refused = place.run(Scene::paper(), given, &|_| ()).err().unwrap();
        assert!(refused.to_string().contains("sample"), "{refused}");
    }
}
