//! `sawflutter study`.

use std::io::BufWriter;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use crate::analyses::study::{
    self, CsvTable, Log, Rows, Shard, Study, StudyFile, StudyReport, Table, read_inputs, sum_up,
};
use crate::model::scene::{SCENE_TEXT, Scene};
use anyhow::{Context, bail};
use clap::{Args, Subcommand};
use indicatif::{ProgressBar, ProgressStyle};

use super::common::{Changes, Output, read_scene, read_text, refused, say};
use super::output::OutputFolder;
use super::pictures::drawn;
use super::progress::has_bar;
use super::scheduler;

pub const EXAMPLES: &str = "\
Examples:
  # All saws; the same line again goes on after a stop
  sawflutter study saw.json study.json --out runs
  # One of eight parts, for the third of eight machines
  sawflutter study saw.json study.json --out runs --shard 3/8
  # The parts together, the same bytes as from one machine
  sawflutter study merge runs --out result
  # On a cluster of Dask
  sawflutter study saw.json study.json --out runs --scheduler tcp://host:8786

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
    /// File of the numbers that vary, their distributions, and the limits of the saws
    #[arg(required = true)]
    study: Option<PathBuf>,
    #[command(flatten)]
    changes: Changes,
    /// Compute part k of n only, into a log of its own
    #[arg(long, value_name = "k/n", value_parser = shard)]
    shard: Option<Shard>,
    /// Compute on the workers of this scheduler of Dask, like tcp://host:8786; needs the Python
    /// package
    #[arg(long, value_name = "ADDRESS", conflicts_with = "shard")]
    scheduler: Option<String>,
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

/// Analyses the saws that no log has yet, and sums up all saws.
pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    if let Some(Command::Merge(merge)) = &arguments.merge {
        return run_merge(merge);
    }
    let typed = read_scene(arguments.scene.as_deref().context("a scene is missing")?)?;
    let scene = arguments.changes.applied(typed)?;
    let file = read_study(arguments.study.as_deref().context("a study is missing")?)?;
    let study = Study::new(scene, file).context("the study was refused")?;
    let folder = arguments.output.folder()?;
    let shard = arguments.shard.unwrap_or(Shard::WHOLE);
    match &arguments.scheduler {
        Some(address) => scheduler::compute(&study, folder.created()?, address)?,
        None => compute(&study, shard, &folder)?,
    }
    if shard != Shard::WHOLE {
        let next = format!("sawflutter study merge {}", folder.path().display());
        return print_part(&arguments.output, &study, shard, &folder, &next);
    }
    let rows = Rows::in_folder(&study, folder.path())?;
    print(&arguments.output, &folder, &rows)
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
    let rows = Rows::of(&study, logs)?;
    let (count, done) = (study.count(), rows.finished().done());
    if let Some(missing) = rows.finished().missing(0, 1) {
        bail!(
            "{} of {count} saws are missing, saw {} the first; run the parts again that were stopped",
            count - done,
            missing.start
        );
    }
    let folder = merge.output.folder()?;
    print(&merge.output, &folder, &rows)
}

/// Analyses the saws of a part that its log lacks, and logs each one as soon as it is done.
pub fn compute(study: &Study, shard: Shard, folder: &OutputFolder) -> anyhow::Result<()> {
    let mut log = Log::open(folder.created()?, shard, study)?;
    let (done, of) = (log.finished().done(), shard.count(study.count()));
    if done == of {
        return Ok(());
    }
    log.append_processor(&study::processor())?;
    let missing = log
        .finished()
        .clone()
        .into_missing()
        .filter(|index| shard.holds(*index));
    let bar = progress_bar(done, of);
    let shared_log = Arc::new(Mutex::new(log));
    #[cfg(feature = "explore")]
    stop_when_interrupted(Arc::clone(&shared_log), of);
    study.run(None, missing, &|saw| {
        let mut shared_log = shared_log.lock().unwrap_or_else(PoisonError::into_inner);
        shared_log.append(study, &saw)?;
        bar.inc(1);
        anyhow::Ok(())
    })?;
    bar.finish_and_clear();
    Ok(())
}

/// Ends the program at Ctrl-C between two rows of the log, and prints how to continue.
///
/// The handler of the signal is registered before the function returns, so that no saw is computed without it.
#[cfg(feature = "explore")]
fn stop_when_interrupted(log: Arc<Mutex<Log>>, of: usize) {
    let runtime = tokio::runtime::Builder::new_current_thread()
        .enable_io()
        .build();
    let Ok(runtime) = runtime else {
        return;
    };
    let interrupts = {
        let _context = runtime.enter();
        interrupts()
    };
    let Ok(mut interrupts) = interrupts else {
        return;
    };
    std::thread::spawn(move || {
        if runtime.block_on(interrupts.recv()).is_some() {
            let log = log.lock().unwrap_or_else(PoisonError::into_inner);
            let done = log.finished().done();
            eprintln!(
                "\nStopped: {done} of {of} saws are in the log; the same command goes on with the others."
            );
            std::process::exit(INTERRUPTED);
        }
    });
}

#[cfg(all(feature = "explore", unix))]
fn interrupts() -> std::io::Result<tokio::signal::unix::Signal> {
    tokio::signal::unix::signal(tokio::signal::unix::SignalKind::interrupt())
}

#[cfg(all(feature = "explore", windows))]
fn interrupts() -> std::io::Result<tokio::signal::windows::CtrlC> {
    tokio::signal::windows::ctrl_c()
}

/// Exit code of a program that Ctrl-C has ended, as shells report it: 128 plus the number of the signal.
#[cfg(feature = "explore")]
const INTERRUPTED: i32 = 130;

/// Bar over the saws of a part; the remaining time is estimated from the saws of this run alone.
fn progress_bar(done: usize, of: usize) -> ProgressBar {
    if !has_bar() {
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

/// Writes the tables while the logs are read, then figures and summary, and prints the summary.
fn print(output: &Output, folder: &OutputFolder, rows: &Rows<'_>) -> anyhow::Result<()> {
    let (mut writing, study) = (folder.begin()?, rows.study());
    let csv = writing.create("study.csv")?;
    #[cfg(feature = "parquet")]
    let parquet = writing.create("study.parquet")?;
    let tables: Vec<Box<dyn Table>> = vec![
        Box::new(CsvTable::new(study, BufWriter::new(csv.as_file()))?),
        #[cfg(feature = "parquet")]
        Box::new(study::ParquetTable::new(
            study,
            BufWriter::new(parquet.as_file()),
        )?),
    ];
    let report = sum_up(rows, folder.path(), tables)?;
    let json = serde_json::to_string_pretty(&report)?;
    for (name, content) in drawn(&report, true)? {
        writing.stage_bytes(name, &content)?;
    }
    #[cfg(feature = "parquet")]
    writing.stage("study.parquet", parquet)?;
    writing.stage("study.csv", csv)?;
    writing.stage_bytes(StudyReport::COMMAND.file, json.as_bytes())?;
    // Only a program that was built with the feature `parquet` writes this file.
    let optional = ["study.parquet"];
    output.print_written(folder, writing, &optional, &json, || output.words(&report))
}

/// Prints the path of the log of a part, and the step that follows when all parts are done.
pub fn print_part(
    output: &Output,
    study: &Study,
    shard: Shard,
    folder: &OutputFolder,
    next: &str,
) -> anyhow::Result<()> {
    let saws = shard.count(study.count());
    let path = folder.path().join(Log::name(shard));
    let (Shard { number, of }, log) = (shard, path.display().to_string());
    if output.json {
        let part = serde_json::json!({ "shard": number, "of": of, "saws": saws, "log": log });
        say(&format!("{part}\n"))?;
    } else {
        say(&format!(
            "Part {number} of {of}: {saws} saws in {log}\n\
             When all parts are done: {next}\n"
        ))?;
    }
    Ok(())
}

fn read_study(path: &Path) -> anyhow::Result<StudyFile> {
    let text = read_text(path, SCENE_TEXT)?;
    StudyFile::from_json(&text).map_err(|error| refused(path, error.into()))
}

/// Largest number of parts, which is more than a cluster has.
const MAX_SHARDS: usize = 100_000;

/// Parses a part like `3/8`.
pub fn shard(text: &str) -> Result<Shard, String> {
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
