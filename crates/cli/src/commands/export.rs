//! `stickslip export fmu`: a scenario with the C library as an FMU.

mod description;

use crate::arguments::{ExportCommand, Fmi, FmuArguments};
use std::env::consts::{ARCH, DLL_EXTENSION, DLL_PREFIX, OS};
use std::io::{self, Cursor, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use stickslip_console::answer::{complain, say};
use stickslip_console::verdict::Verdict;
use stickslip_drive::RunError;
use stickslip_run::complaint::words;
use stickslip_run::interface::{Role, variables};
use stickslip_run::{Job, Refusal, Simulation, folder};
use stickslip_scenario::ScenarioError;
use thiserror::Error;
use zip::write::{SimpleFileOptions, ZipWriter};

/// Name of the binary in the FMU.
pub(crate) const IDENTIFIER: &str = "stickslip";

/// Error that stops the command.
#[derive(Debug, Error)]
enum ExportFailure {
    #[error(transparent)]
    Refused(#[from] Refusal),
    #[error(transparent)]
    Scenario(#[from] ScenarioError),
    #[error("{0}\n   help: {advice}", advice = .0.advice())]
    Run(#[from] RunError),
    #[error("{}: the C library of stickslip is not there\n   help: `cargo build --release -p stickslip-capi` makes it; or give its path with --library", .0.display())]
    NoLibrary(PathBuf),
    #[error("{}: {}", .path.display(), words(.source))]
    Read { path: PathBuf, source: io::Error },
    #[error("{}: cannot be written: {}", .path.display(), words(.source))]
    Write { path: PathBuf, source: io::Error },
    #[error("{}: cannot be packed: {source}", .path.display())]
    Pack { path: PathBuf, source: zip::result::ZipError },
}

/// Writes what is exported.
pub(crate) fn export(command: &ExportCommand) -> Verdict {
    let ExportCommand::Fmu(arguments) = command;
    match fmu(arguments) {
        Ok(()) => Verdict::Done,
        Err(failure) => {
            complain(format_args!("{failure}"));
            match failure {
                ExportFailure::Write { .. } | ExportFailure::Pack { .. } => Verdict::Stopped,
                _ => Verdict::BadInput,
            }
        }
    }
}

fn fmu(arguments: &FmuArguments) -> Result<(), ExportFailure> {
    let mut job = Job::prepare(&arguments.file, &arguments.set, Path::new(""))?;
    if !arguments.parameters.is_empty() {
        let known = job.interface.parameters.iter().map(|parameter| &parameter.path);
        let mut paths: Vec<&String> = known.collect();
        for path in &arguments.parameters {
            if !paths.contains(&path) {
                paths.push(path);
            }
        }
        // Texts have no errors in JSON.
        let list = serde_json::to_string(&paths).unwrap_or_default();
        job = job.with(&[("interface.parameters".to_owned(), list)])?;
    }
    let job = Arc::new(job);
    // The host would learn only later that a scenario cannot be advanced step by step.
    Simulation::new(Arc::clone(&job))?;
    let library = library(arguments.library.as_deref())?;
    let binary = std::fs::read(&library).map_err(|source| ExportFailure::Read { path: library, source })?;
    let path = arguments.out.clone().unwrap_or_else(|| PathBuf::from(format!("{}.fmu", job.name)));
    let packed = pack(&job, arguments.fmi, &binary)
        .map_err(|source| ExportFailure::Pack { path: path.clone(), source })?;
    folder::write(&path, &packed).map_err(|source| ExportFailure::Write { path: path.clone(), source })?;
    let variables = variables(&job);
    let count = |of: fn(&Role) -> bool| variables.iter().filter(|variable| of(&variable.role)).count();
    say(format_args!(
        "{}: FMI {}, {} inputs, {} outputs, {} parameters, {:.1} MB",
        path.display(),
        if arguments.fmi == Fmi::Two { "2.0" } else { "3.0" },
        count(|role| matches!(role, Role::Input(..))),
        count(|role| matches!(role, Role::Output(..))),
        count(|role| matches!(role, Role::Parameter(..))),
        packed.len() as f64 / 1e6
    ));
    Ok(())
}

/// Returns the path of the C library: that given, or one beside the program.
fn library(given: Option<&Path>) -> Result<PathBuf, ExportFailure> {
    let name = format!("{DLL_PREFIX}{IDENTIFIER}.{DLL_EXTENSION}");
    let program = std::env::current_exe().and_then(std::fs::canonicalize).unwrap_or_default();
    let beside = program.parent().unwrap_or(Path::new("."));
    let places = match given {
        Some(given) => vec![given.to_owned()],
        None => ["", "../lib", "deps"].map(|place| beside.join(place).join(&name)).to_vec(),
    };
    let first = places[0].clone();
    places.into_iter().find(|place| place.is_file()).ok_or(ExportFailure::NoLibrary(first))
}

/// Returns the bytes of the FMU. They depend on scenario, library and version only.
fn pack(job: &Job, fmi: Fmi, binary: &[u8]) -> zip::result::ZipResult<Vec<u8>> {
    let system = match (fmi, OS) {
        (Fmi::Two, "macos") => "darwin64".to_owned(),
        (Fmi::Two, "windows") => "win64".to_owned(),
        (Fmi::Two, _) => "linux64".to_owned(),
        (Fmi::Three, "macos") => format!("{ARCH}-darwin"),
        (Fmi::Three, system) => format!("{ARCH}-{system}"),
    };
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    let options = SimpleFileOptions::default();
    let description = description::of(job, fmi);
    let files: [(&str, &[u8]); 3] = [
        ("modelDescription.xml", description.as_bytes()),
        ("resources/scenario.json", job.resolved.as_bytes()),
        (&format!("binaries/{system}/{IDENTIFIER}.{DLL_EXTENSION}"), binary),
    ];
    for (name, bytes) in files {
        zip.start_file(name, options)?;
        zip.write_all(bytes)?;
    }
    Ok(zip.finish()?.into_inner())
}
