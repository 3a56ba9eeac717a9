//! `sawflutter study`.

use std::io::IsTerminal;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use crate::figure;
use crate::scene::{SCENE_TEXT, Scene};
use crate::study::{
    self, Log, LogError, Saw, Shard, Study, StudyFile, StudyReport, finished_in, keep, read_inputs,
    read_log,
};
use anyhow::{Context, bail};
use clap::{Args, Subcommand};
use indicatif::{ProgressBar, ProgressStyle};

use super::common::{Finely, NamedFile, Output, read_scene, read_text, refused, say};
use super::output::OutputFolder;
use super::study_summary::summary;

pub const EXAMPLES: &str = "\
Examples:
  sawflutter study saw.json study.json --out runs   all saws; run it again to go
                                                    on after a stop
  sawflutter study saw.json study.json --out runs --shard 3/8
                                                    one of eight parts, for the
                                                    third of eight machines
  sawflutter study merge runs --out result          the parts together, the same
                                                    bytes as from one machine

In a job array of 8:
  sawflutter study saw.json study.json --out runs --shard $SLURM_ARRAY_TASK_ID/8

`sawflutter schema --study` says what a study may contain; scenes/studies/
has one.";

#[derive(Args)]
#[command(args_conflicts_with_subcommands = true, subcommand_negates_reqs = true)]
pub struct Arguments {
    #[command(subcommand)]
    merge: Option<Command>,
    /// Scene of the saw without deviations
    #[arg(required = true)]
    scene: Option<PathBuf>,
    /// What varies, how, and which limits the saws have to keep
    #[arg(required = true)]
    study: Option<PathBuf>,
    #[command(flatten)]
    finely: Finely,
    /// Compute part k of n only, into a log of its own
    #[arg(long, value_name = "k/n", value_parser = shard)]
    shard: Option<Shard>,
    #[command(flatten)]
    output: Output,
}

#[derive(Subcommand)]
enum Command {
    /// Sum up what parts of a study have computed
    Merge(Merge),
}

#[derive(Args)]
struct Merge {
    /// Folders with the logs of the parts
    #[arg(required = true, value_name = "DIR")]
    folders: Vec<PathBuf>,
    #[command(flatten)]
    output: Output,
}

/// Analyses the saws that no log has yet, and sums them all up.
pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    if let Some(Command::Merge(merge)) = &arguments.merge {
        return run_merge(merge);
    }
    let (scene, file) = (arguments.scene.as_deref(), arguments.study.as_deref());
    let scene = read_scene(scene.context("a scene is missing")?)?;
    let scene = arguments.finely.applied(scene)?;
    let study = read_study(file.context("a study is missing")?)?;
    let study = Study::new(scene, study).context("the study was refused")?;
    let folder = arguments.output.folder()?;
    let shard = arguments.shard.unwrap_or(Shard::WHOLE);
    // Whoever computes everything takes what parts have computed; a part keeps to itself, for
    // the others may be at work.
    let mut finished = match shard == Shard::WHOLE {
        true => finished_in(folder.path(), &study)?,
        false => vec![None; study.count()],
    };
    compute(&study, shard, &folder, &mut finished)?;
    if shard != Shard::WHOLE {
        return print_part(arguments, &study, shard, &folder);
    }
    print(&arguments.output, &study, &folder, finished)
}

/// Sums up logs without computing anything.
fn run_merge(merge: &Merge) -> anyhow::Result<()> {
    let mut logs = Vec::new();
    for folder in &merge.folders {
        logs.extend(Log::all_in(folder)?);
    }
    let Some(first) = logs.first() else {
        let folders: Vec<_> = merge
            .folders
            .iter()
            .map(|f| f.display().to_string())
            .collect();
        bail!(
            "there is no log of a study in {}; give the folders named by --out",
            folders.join(", ")
        );
    };
    let inputs = read_inputs(first)?;
    let refused = || format!("the study of {} was refused", first.display());
    let scene = Scene::try_from(inputs.scene).with_context(refused)?;
    let study = Study::new(scene, inputs.study).with_context(refused)?;
    let mut finished = vec![None; study.count()];
    for log in &logs {
        keep(&mut finished, read_log(log, &study)?);
    }
    let missing = finished.iter().filter(|saw| saw.is_none()).count();
    if let Some(first) = finished.iter().position(Option::is_none) {
        bail!(
            "{missing} of {} saws are missing, saw {first} the first; run the parts again that were stopped",
            finished.len()
        );
    }
    let folder = merge.output.folder()?;
    print(&merge.output, &study, &folder, finished)
}

/// Analyses what is missing, each saw logged as soon as it is done.
fn compute(
    study: &Study,
    shard: Shard,
    folder: &OutputFolder,
    finished: &mut [Option<Saw>],
) -> anyhow::Result<()> {
    let path = folder.path().join(Log::name(shard));
    let (log, before) = Log::open(&path, study)?;
    keep(finished, before);
    let own = (0..study.count()).filter(|index| shard.holds(*index));
    let (done, missing): (Vec<usize>, Vec<usize>) = own.partition(|k| finished[*k].is_some());
    let bar = progress_bar(done.len(), done.len() + missing.len());
    let state = Mutex::new((log, finished));
    study::run(study, &missing, &|saw| {
        let mut state = state.lock().unwrap_or_else(PoisonError::into_inner);
        let (log, finished) = &mut *state;
        log.append(study, &saw)?;
        let index = saw.index;
        finished[index] = Some(saw);
        bar.inc(1);
        Ok::<(), LogError>(())
    })?;
    bar.finish_and_clear();
    Ok(())
}

/// The time left is judged by the saws of this run.
fn progress_bar(done: usize, of: usize) -> ProgressBar {
    if !std::io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let template = "{bar:36} {pos}/{len} saws, {elapsed}, {eta} left";
    let style = ProgressStyle::with_template(template);
    let bar = ProgressBar::new(of as u64)
        .with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
    bar.set_position(done as u64);
    bar.reset_eta();
    bar
}

fn print(
    output: &Output,
    study: &Study,
    folder: &OutputFolder,
    finished: Vec<Option<Saw>>,
) -> anyhow::Result<()> {
    let saws: Vec<Saw> = finished.into_iter().flatten().collect();
    let report = StudyReport::new(study, &saws);
    let json = serde_json::to_string_pretty(&report)?;
    let files: Vec<NamedFile> = vec![
        ("study.png", figure::study_png(&report)?),
        ("study.svg", figure::study_svg(&report)?.into_bytes()),
        #[cfg(feature = "parquet")]
        ("study.parquet", study::parquet(study, &saws)?),
        ("study.csv", study::csv(study, &saws)?),
        ("study.json", json.clone().into_bytes()),
    ];
    // Of a program that was built with Parquet.
    let optional = ["study.parquet"];
    output.print(folder, &files, &optional, &json, || summary(&report))
}

fn print_part(
    arguments: &Arguments,
    study: &Study,
    shard: Shard,
    folder: &OutputFolder,
) -> anyhow::Result<()> {
    let saws = (0..study.count())
        .filter(|index| shard.holds(*index))
        .count();
    let path = folder.path().join(Log::name(shard));
    let (Shard { number, of }, log) = (shard, path.display().to_string());
    if arguments.output.json {
        let part = serde_json::json!({ "shard": number, "of": of, "saws": saws, "log": log });
        say(&format!("{part}\n"))?;
    } else {
        let folder = folder.path().display();
        say(&format!(
            "Part {number} of {of}: {saws} saws in {log}\n\
             When all parts are done: sawflutter study merge {folder}\n"
        ))?;
    }
    Ok(())
}

fn read_study(path: &Path) -> anyhow::Result<StudyFile> {
    let text = read_text(path, SCENE_TEXT)?;
    StudyFile::from_json(&text).map_err(|error| refused(path, error.into()))
}

/// More parts than a cluster has.
const MAX_SHARDS: usize = 100_000;

fn shard(text: &str) -> Result<Shard, String> {
    let numbers = text
        .split_once('/')
        .and_then(|(number, of)| Some((number.parse::<usize>().ok()?, of.parse::<usize>().ok()?)));
    match numbers {
        Some((number, of)) if (1..=of).contains(&number) && of <= MAX_SHARDS => {
            Ok(Shard { number, of })
        }
        _ => Err(format!(
            "must be k/n with k from 1 to n, n at most {MAX_SHARDS}: 3/8 is the third of eight parts"
        )),
    }
}
