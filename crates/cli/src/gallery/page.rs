//! The page of the gallery, in Markdown.

use crate::arguments::GalleryArguments;
use crate::job::Job;
use crate::look::{Colours, Format, Look};
use std::fmt::Write;
use std::io;
use std::path::{Component, Path, PathBuf};
use stickslip_scenario::PlotName;

/// The pictures of a scenario.
pub(super) struct Exhibit {
    /// Name of the scenario and of the folder of its pictures.
    name: String,
    title: String,
    /// The scenario's file.
    file: PathBuf,
    pub(super) plots: Vec<PlotName>,
    /// Names of the pictures' files.
    files: Vec<String>,
}

impl Exhibit {
    /// The pictures that a job left.
    pub(super) fn new(job: &Job, file: &Path, files: Vec<String>) -> Self {
        let is_there = |plot: &PlotName| files.contains(&look(Colours::Light).file(*plot, Format::Png));
        let plots = PlotName::ALL.into_iter().filter(is_there).collect();
        Self { name: job.name.clone(), title: job.title().to_owned(), file: file.to_owned(), plots, files }
    }
}

/// The page: scenario by scenario, each picture with the command that draws it.
pub(super) fn text(exhibits: &[Exhibit], arguments: &GalleryArguments) -> io::Result<String> {
    let GalleryArguments { scenarios, out, .. } = arguments;
    let mut command = "stickslip gallery".to_owned();
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
    let file = |colours, format| look(colours).file(plot, format);
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

/// What a kind of picture shows.
fn shows(plot: PlotName) -> &'static str {
    match plot {
        PlotName::Layout => {
            "what there is, to scale: bodies, contacts, springs and forces; blue is free, orange follows a waveform"
        }
        PlotName::Loop => "tangential force over displacement, in newtons and as shares of μF_N and u_c",
        PlotName::Trajectory => "positions over time, displacements of the contacts below",
        PlotName::Energy => {
            "the work that went in and what became of it, what is stored, what the book misses"
        }
        PlotName::Phase => {
            "velocity over displacement in every free coordinate; of a body that travels on, the last period"
        }
        PlotName::Events => "what happened when",
        PlotName::State => "what every spring under a contact does over time",
        PlotName::Memory => "the curve by which a contact remembers, in its wedge, at some moments",
    }
}

fn look(theme: Colours) -> Look {
    Look { formats: Vec::new(), theme, scale: 1 }
}

/// The way from a folder to a file.
fn relative(file: &Path, folder: &Path) -> io::Result<PathBuf> {
    let (file, folder) = (file.canonicalize()?, folder.canonicalize()?);
    let common = file.components().zip(folder.components()).take_while(|(a, b)| a == b).count();
    let up = folder.components().skip(common).map(|_| Component::ParentDir);
    Ok(up.chain(file.components().skip(common)).collect())
}

/// A path as a link: slashes on every system, what a link cannot have as percent codes.
fn link(path: &Path) -> String {
    let parts: Vec<String> =
        path.components().map(|part| part.as_os_str().to_string_lossy().into_owned()).collect();
    let mut link = String::new();
    for byte in parts.join("/").bytes() {
        match byte {
            b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'/' | b'.' | b'-' | b'_' | b'@' => {
                link.push(char::from(byte));
            }
            byte => {
                let _ = write!(link, "%{byte:02X}");
            }
        }
    }
    link
}

/// A path as a word of a command line.
fn word(path: &Path) -> String {
    let text = path.to_string_lossy().replace('\\', "/");
    let is_plain = text.chars().all(|c| c.is_ascii_alphanumeric() || "/._-@".contains(c));
    if is_plain { text } else { format!("\"{text}\"") }
}

/// A text that means nothing to Markdown or HTML.
fn plain(text: &str) -> String {
    let mut plain = String::new();
    for c in text.chars() {
        match c {
            '<' => plain.push_str("&lt;"),
            '>' => plain.push_str("&gt;"),
            '&' => plain.push_str("&amp;"),
            '"' => plain.push_str("&quot;"),
            '*' | '_' | '[' | ']' | '`' | '|' | '#' | '\\' => {
                let _ = write!(plain, "&#{};", u32::from(c));
            }
            c if c.is_control() => plain.push(' '),
            c => plain.push(c),
        }
    }
    plain
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_way_from_folder_to_file_goes_up_as_far_as_needed() {
        let root = tempfile::tempdir().unwrap();
        let (scenarios, out) = (root.path().join("a/scenarios"), root.path().join("a/b/plots"));
        std::fs::create_dir_all(&scenarios).unwrap();
        std::fs::create_dir_all(&out).unwrap();
        std::fs::write(scenarios.join("p 1.json"), "").unwrap();
        let way = relative(&scenarios.join("p 1.json"), &out).unwrap();
        assert_eq!(link(&way), "../../scenarios/p%201.json");
        assert!(relative(&scenarios.join("none.json"), &out).is_err());
    }

    #[test]
    fn titles_and_names_do_not_become_markup() {
        assert_eq!(plain("a*b <i>_c_</i> \"d\" µ"), "a&#42;b &lt;i&gt;&#95;c&#95;&lt;/i&gt; &quot;d&quot; µ");
        assert_eq!(
            (word(Path::new("a/p1.json")), word(Path::new("a b"))),
            ("a/p1.json".into(), "\"a b\"".into())
        );
    }
}
