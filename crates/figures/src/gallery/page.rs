//! The page of the gallery, in Markdown.

use crate::look::{Colours, Format, Look};
use crate::pictures::shows;
use std::fmt::Write;
use std::io;
use std::path::{Path, PathBuf};
use stickslip_run::Job;
use stickslip_run::markdown::{link, plain, relative, word};
use stickslip_scenario::PlotName;

/// The pictures of a scenario.
pub struct Exhibit {
    /// Name of the scenario and of the folder of its pictures.
    name: String,
    title: String,
    /// The scenario's file.
    file: PathBuf,
    /// What is shown.
    pub plots: Vec<PlotName>,
    /// Names of the pictures' files.
    files: Vec<String>,
}

impl Exhibit {
    /// The pictures that a job left: `file` is its scenario, `files` are the names of the pictures.
    pub fn new(job: &Job, file: &Path, files: Vec<String>) -> Self {
        let is_there = |plot: &PlotName| files.contains(&look().file(*plot, Colours::Light, Format::Png));
        let plots = PlotName::ALL.into_iter().filter(is_there).collect();
        Self { name: job.name.clone(), title: job.title().to_owned(), file: file.to_owned(), plots, files }
    }
}

/// The page in the folder `out` of pictures of the scenarios in a folder: scenario by scenario, each picture with the
/// command that draws it.
///
/// # Errors
/// A scenario whose place cannot be told from that of the page.
pub fn page(exhibits: &[Exhibit], scenarios: &Path, out: &Path) -> io::Result<String> {
    let mut command = "stickslip-lab gallery".to_owned();
    for (option, path, usual) in [("--scenarios", scenarios, "scenarios"), ("--out", out, "plots")] {
        if path != Path::new(usual) {
            command += &format!(" {option} {}", word(path));
        }
    }
    let mut page = format!(
        "# Gallery\n\nEvery picture here is written by the program, from the scenario and by the command beside it; all \
         of them and\nthis page by\n\n```sh\n{command}\n```\n\nA picture carries its scenario and a fingerprint of the \
         run: `stickslip repro FILE` runs it again and says\n\"identical\", or which channel differs from when.\n"
    );
    for exhibit in exhibits {
        let file = link(&relative(&exhibit.file, out)?);
        // Writing to a string cannot fail.
        let _ = write!(
            page,
            "\n## {}\n\n[`{}`]({file}): ",
            plain(&exhibit.title),
            exhibit.name.replace('`', "'")
        );
        let _ = writeln!(page, "`stickslip run {}`", word(&exhibit.file));
        exhibit.plots.iter().for_each(|plot| picture(&mut page, exhibit, *plot));
    }
    Ok(page)
}

fn picture(page: &mut String, exhibit: &Exhibit, plot: PlotName) {
    let path = |name: &str| link(&Path::new(&exhibit.name).join(name));
    let file = |colours, format| look().file(plot, colours, format);
    let light = path(&file(Colours::Light, Format::Png));
    let dark = path(&file(Colours::Dark, Format::Png));
    let mut others = format!("[dark]({dark})");
    let svg = file(Colours::Light, Format::Svg);
    if exhibit.files.contains(&svg) {
        others += &format!(", [SVG]({})", path(&svg));
    }
    let results = word(&Path::new("results").join(&exhibit.name));
    let (name, shows) = (plot.name(), shows(plot));
    let _ = write!(
        page,
        "\n**{name}** – {shows}: `stickslip plot {results} --plots {name}` ({others})\n\n<picture>\n  \
         <source media=\"(prefers-color-scheme: dark)\" srcset=\"{dark}\">\n  \
         <img src=\"{light}\" width=\"720\" alt=\"{name}: {}\">\n</picture>\n",
        plain(&exhibit.title),
    );
}

fn look() -> Look {
    Look { formats: Vec::new(), themes: Vec::new(), scale: 1, width: None }
}
