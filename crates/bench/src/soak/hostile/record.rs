//! The stability record: a page, its picture, its table.

use super::picture;
use crate::error::BenchError;
use crate::soak::finding::{Finding, Verdict};
use crate::soak::hostile::cell::{COLUMNS, Cells};
use crate::soak::sheet;
use std::collections::BTreeMap;
use std::fmt::Write;
use std::io;
use std::path::Path;
use stickslip_run::folder::{self, Folder};
use stickslip_run::markdown::{link, plain, relative, word};
use stickslip_run::program::this_program;

/// Verdicts of the columns of the page's table.
const HEADS: [Verdict; 12] = Verdict::ALL;
/// Lines told of one kind of exception, at the most.
const LINES: usize = 400;

/// Writes the page, and into a folder the picture and the table of all cells.
///
/// # Errors
/// What cannot be drawn or written.
pub fn write_record(findings: &[Finding], page: &Path, out: &Path) -> Result<(), BenchError> {
    let pictures = picture::draw(findings)
        .map_err(|source| BenchError::Picture { name: picture::NAME.to_owned(), source })?;
    let failed = |source| BenchError::File { path: out.to_owned(), source };
    let table = sheet::table(findings).map_err(failed)?;
    let mut folder = Folder::make(out).map_err(failed)?;
    folder.write(sheet::TABLE, &table).map_err(failed)?;
    pictures.iter().try_for_each(|(name, bytes)| folder.write(name, bytes)).map_err(failed)?;
    folder.publish().map_err(failed)?;
    let failed = |source| BenchError::File { path: page.to_owned(), source };
    let text = text(findings, page, out).map_err(failed)?;
    folder::write(page, text.as_bytes()).map_err(failed)
}

fn text(findings: &[Finding], page: &Path, out: &Path) -> io::Result<String> {
    let folder = relative(out, page.parent().unwrap_or(Path::new("")))?;
    let at = |name: &str| link(&folder.join(name));
    let mut text = format!(
        "# Stability\n\nWhat happens to a plain drive whose parts go to their extremes, one at a time, by every stepper and \
         tolerance: {} hostile scenes.\nThis page, its picture and its table are written by\n\n```sh\nstickslip-lab soak --hostile \
         --out {} --page {}\n```\n\nby {}. One cell is written as a scenario by `stickslip-lab soak --hostile NUMBER --write \
         DIR`.\n\n",
        findings.len(),
        word(out),
        word(page),
        this_program(),
    );
    shares(&mut text, findings);
    let (light, dark, svg) = (at("matrix.png"), at("matrix-dark.png"), at("matrix.svg"));
    let _ = write!(
        text,
        "<picture><source media=\"(prefers-color-scheme: dark)\" srcset=\"{dark}\"><img alt=\"the matrix\" \
         src=\"{light}\"></picture>\n\n[All cells]({}), [SVG]({svg}).\n\n",
        at(sheet::TABLE),
    );
    text.push_str(JUDGED);
    by_family(&mut text, findings);
    by_stepper(&mut text, findings);
    exceptions(&mut text, findings);
    Ok(text)
}

/// How a cell is judged.
const JUDGED: &str = "\
## How it is judged

* **event**: its energy books close to 100 tolerances (1e-12 counts as the least of these) of what went through them, and no row
  of any free coordinate is off the run at 1e-10 by more than 100 tolerances (1e-10 and the rounding of the stroke at the least) in
  natural lengths (u_c along the slide, the indentation along the normal), times S, the growth of a change of the start by 1e-9 of them.
* **verlet**, **rk4** at 60 steps or more in the fastest swing and 1 000 in a period of the drive, on whose steps its corners fall,
  **dopri5** at 1e-6: the second method. Run again at half and a quarter of the step, or a tenth and a hundredth of the tolerance, its
  own error is what these differ by (the last two, or half of the first two); right where the event stepper lies within twice
  that (1e-6 at the least), times S. Where its own error is beyond a tenth it decides nothing: *undecided*, as where the
  event stepper has no end.
* **refused** before anything ran, with what is allowed or what to try, as every tolerance of 1e-14: a scenario may ask for 1e-13
  at the finest; **limited**: ended by `run.limits` of the scene, a
  million steps, 60 000 events or, with many springs or periods, twenty seconds, and judged no further: without the limit of
  events, sliders of 1e-12 and 1e-11 kg, which ring 300 000 and 95 000 times in a period of the drive, took up to twenty seconds and more;
  **stopped** by an error that says what, where, when and what to try. **hung**: twenty seconds on the wall. **grazing**: off by more than S explains, but not more than the growth of a change
  as large as the tolerance.

";

/// The shares that count.
fn shares(text: &mut String, findings: &[Finding]) {
    let count = |verdicts: &[Verdict]| findings.iter().filter(|f| verdicts.contains(&f.verdict)).count();
    let share = |verdicts: &[Verdict]| {
        let count = count(verdicts);
        format!("{count} ({:.1} %)", 100.0 * count as f64 / findings.len().max(1) as f64)
    };
    use Verdict::{
        Grazing, Hung, Left, Limited, Panicked, Refused, Right, Stopped, Unbalanced, Undecided, Warned, Wrong,
    };
    let lines = [
        ("right", share(&[Right])),
        ("right, and the program says that something is odd", share(&[Warned])),
        ("refused with the reason", share(&[Refused])),
        ("left the model's range, by name", share(&[Left])),
        ("ended at the scene's own limit", share(&[Limited])),
        ("stopped, with what to try", share(&[Stopped])),
        ("undecided or grazing", share(&[Undecided, Grazing])),
        ("energy books open", share(&[Unbalanced])),
        ("wrong", share(&[Wrong])),
        ("hung", share(&[Hung])),
        ("panicked", share(&[Panicked])),
    ];
    text.push_str("| ended | cells |\n| --- | ---: |\n");
    for (name, share) in lines {
        let _ = writeln!(text, "| {name} | {share} |");
    }
    text.push('\n');
}

fn by_family(text: &mut String, findings: &[Finding]) {
    let cells = Cells::new();
    text.push_str("## By family\n\n");
    heads(text, "family | from | to");
    for family in cells.families() {
        let own: Vec<&Finding> = findings.iter().filter(|found| found.kind == family.name).collect();
        let range = family.values.first().zip(family.values.last());
        let (from, to) = range.map_or((f64::NAN, f64::NAN), |(from, to)| (*from, *to));
        let name = format!("{} ({}) | {} | {}", family.name, family.axis, short(from), short(to));
        line(text, &name, &own);
    }
    text.push('\n');
}

/// As a power of ten, or whole where it is near to 1.
fn short(value: f64) -> String {
    if (0.5..2.0).contains(&value) { format!("{value:.1}") } else { format!("{value:.0e}") }
}

fn by_stepper(text: &mut String, findings: &[Finding]) {
    text.push_str("## By stepper\n\n");
    heads(text, "stepper");
    for (place, column) in COLUMNS.iter().enumerate() {
        let own = findings.iter().filter(|found| found.seed as usize % COLUMNS.len() == place);
        line(text, &column.name(), &own.collect::<Vec<_>>());
    }
    text.push('\n');
}

fn heads(text: &mut String, first: &str) {
    let _ = write!(text, "| {first} |");
    HEADS.iter().for_each(|verdict| {
        let _ = write!(text, " {} |", verdict.name());
    });
    let _ = write!(text, "\n|{}", " --- |".repeat(first.split('|').count()));
    let _ = writeln!(text, "{}", " ---: |".repeat(HEADS.len()));
}

fn line(text: &mut String, name: &str, findings: &[&Finding]) {
    let _ = write!(text, "| {name} |");
    for verdict in HEADS {
        let count = findings.iter().filter(|found| found.verdict == verdict).count();
        let _ = if count == 0 { write!(text, " |") } else { write!(text, " {count} |") };
    }
    text.push('\n');
}

/// What is wrong, cell by cell; what ended otherwise by the number of cells that say the same.
fn exceptions(text: &mut String, findings: &[Finding]) {
    let faults: Vec<&Finding> =
        findings.iter().filter(|f| f.verdict.is_fault() && f.verdict != Verdict::Stopped).collect();
    let _ = writeln!(text, "## What is wrong today\n");
    if faults.is_empty() {
        text.push_str("Nothing.\n\n");
    } else {
        text.push_str("| cell | | what |\n| ---: | --- | --- |\n");
    }
    for found in faults.iter().take(LINES) {
        let (seed, verdict, note) = (found.seed, found.verdict.name(), plain(&found.note));
        let _ = writeln!(text, "| {seed} | {verdict} | {}: {note} |", found.kind);
    }
    if faults.len() > LINES {
        let _ = writeln!(text, "\nand {} more, in the table of all cells.", faults.len() - LINES);
    }
    text.push_str("\n## Refused, limited, stopped, undecided\n\n| | cells | first | what it says |\n| --- | ---: | ---: | --- |\n");
    let mut said: BTreeMap<(Verdict, &str, String), (usize, &Finding)> = BTreeMap::new();
    for found in findings {
        let told = matches!(found.verdict, Verdict::Refused | Verdict::Left | Verdict::Limited)
            || matches!(found.verdict, Verdict::Undecided | Verdict::Grazing | Verdict::Stopped);
        if told {
            let key = (found.verdict, found.kind, pattern(&found.note));
            said.entry(key).or_insert((0, found)).0 += 1;
        }
    }
    for ((verdict, ..), (count, first)) in said {
        let (seed, note) = (first.seed, plain(&first.note));
        let _ = writeln!(text, "| {} | {count} | {seed} | {}: {note} |", verdict.name(), first.kind);
    }
}

/// A message without its cell and its numbers.
fn pattern(note: &str) -> String {
    let said = note.split_once(": ").map_or(note, |(_, said)| said);
    said.split_whitespace().filter(|word| !word.contains(|c: char| c.is_ascii_digit())).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_record_counts_names_and_shows() {
        let mut findings: Vec<Finding> = (0..20).map(|seed| Finding::new(seed, "mass")).collect();
        findings[3].turns(Verdict::Wrong, || "mass, kg 1e-12, 1e-2: off by 3".to_owned());
        findings[9].turns(Verdict::Refused, || "mass, kg 1e-12, 1e-14: expected more than 1".to_owned());
        findings[19].turns(Verdict::Refused, || "mass, kg 1e-11, 1e-14: expected more than 2".to_owned());
        let folder = tempfile::tempdir().unwrap();
        let (page, out) = (folder.path().join("stability.md"), folder.path().join("stability"));
        write_record(&findings, &page, &out).unwrap();
        let text = std::fs::read_to_string(page).unwrap();
        for line in [
            "20 hostile scenes",
            "| right | 17 (85.0 %) |",
            "| wrong | 1 (5.0 %) |",
            "| hung | 0 (0.0 %) |",
            "| 3 | wrong | mass: mass, kg 1e-12, 1e-2: off by 3 |",
            // What says the same but for its numbers is told once.
            "| refused | 2 | 9 | mass: mass, kg 1e-12, 1e-14: expected more than 1 |",
            "src=\"stability/matrix.png\"",
        ] {
            assert!(text.contains(line), "{line}: {text}");
        }
        let names = ["matrix.png", "matrix-dark.png", "matrix.svg", "soak.csv"];
        assert!(names.iter().all(|name| out.join(name).is_file()));
    }
}
