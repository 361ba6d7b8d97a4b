//! Tables in files: read once, and from then on points of the scenario.

use crate::document::shown;
use crate::fault::Fault;
use crate::form::{Form, FreedomForm, Moving, NormalForm, Point, TableForm, WaveformForm, WaveformRef};
use crate::path::At;
use crate::quantity::{AnyQuantity, Time};
use crate::{suggest, syntax};
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

/// Most bytes read from the files of all tables together.
const MAX_TOTAL: u64 = 16 * syntax::MAX_BYTES as u64;

/// Where files are looked for, and how much of them may still be read.
struct Files<'a> {
    base: &'a Path,
    left: u64,
}

/// Replaces the files of all tables by their points. Says whether there were any.
pub(crate) fn inline(form: &mut Form, base: &Path) -> Result<bool, Fault> {
    let mut found = false;
    let files = &mut Files { base, left: MAX_TOTAL };
    let root = At::ROOT;
    let at = root.key("waveforms");
    for (name, waveform) in &mut form.waveforms.0 {
        found |= in_waveform(&at.key(name), waveform, files)?;
    }
    let at = root.key("bodies");
    for (name, body) in &mut form.bodies.0 {
        if let FreedomForm::Follows(waveform) = &mut body.x {
            found |= in_reference(&at.key(name).key("x"), waveform, files)?;
        }
    }
    let at = root.key("contacts");
    for (name, contact) in &mut form.contacts.0 {
        let at = at.key(name);
        let at = at.key("normal");
        found |= match &mut contact.normal {
            NormalForm::Force(moving) => in_moving(&at.key("force"), moving, files)?,
            NormalForm::Indentation(moving) => in_moving(&at.key("indentation"), moving, files)?,
            NormalForm::Radius(moving) => in_moving(&at.key("radius"), moving, files)?,
            NormalForm::Coupled => false,
        };
    }
    let at = root.key("actuators");
    for (name, actuator) in &mut form.actuators.0 {
        if let Some(stroke) = &mut actuator.stroke {
            found |= in_moving(&at.key(name).key("stroke"), stroke, files)?;
        }
    }
    let at = root.key("loads");
    for (i, load) in form.loads.iter_mut().enumerate() {
        if let Some(x) = &mut load.x {
            found |= in_moving(&at.index(i).key("x"), x, files)?;
        }
    }
    Ok(found)
}

fn in_moving<D>(at: &At<'_>, moving: &mut Moving<D>, files: &mut Files<'_>) -> Result<bool, Fault> {
    match moving {
        Moving::Constant(_) => Ok(false),
        Moving::Follows(waveform) => in_reference(at, waveform, files),
    }
}

fn in_reference(at: &At<'_>, waveform: &mut WaveformRef, files: &mut Files<'_>) -> Result<bool, Fault> {
    match waveform {
        WaveformRef::Name(_) => Ok(false),
        WaveformRef::Inline(waveform) => in_waveform(&at.key("follows"), waveform, files),
    }
}

fn in_waveform(at: &At<'_>, waveform: &mut WaveformForm, files: &mut Files<'_>) -> Result<bool, Fault> {
    let WaveformForm::Table(table) = waveform else { return Ok(false) };
    let at = at.key("table");
    let Some(file) = table.file.take() else {
        for (key, given) in [("time", table.time.is_some()), ("value", table.value.is_some())] {
            if given {
                return Err(at.key(key).fault("names a column, but there is no file").on_key());
            }
        }
        return Ok(false);
    };
    if table.points.is_some() {
        return Err(at.key("file").fault("the points are given already").on_key().help("keep one of them"));
    }
    table.points = Some(read(&at, &file, table, files)?);
    (table.time, table.value) = (None, None);
    Ok(true)
}

fn read(at: &At<'_>, file: &str, table: &TableForm, files: &mut Files<'_>) -> Result<Vec<Point>, Fault> {
    let file_at = at.key("file");
    let path = inside(&file_at, file, files.base)?;
    let unreadable =
        |error: std::io::Error| file_at.fault(format!("cannot read \"{}\": {error}", shown(file)));
    let mut text = String::new();
    let limit = syntax::MAX_BYTES as u64;
    let opened = File::open(path).map_err(unreadable)?;
    opened.take(limit + 1).read_to_string(&mut text).map_err(unreadable)?;
    if text.len() as u64 > limit {
        return Err(file_at.fault(format!("a table has at most {limit} bytes")).help("keep fewer points"));
    }
    files.left = files.left.checked_sub(text.len() as u64).ok_or_else(|| {
        let fault =
            file_at.fault(format!("the files of all tables have more than {MAX_TOTAL} bytes together"));
        fault.help("keep fewer points; a table that is used twice can be a waveform with a name")
    })?;
    let text = text.strip_prefix('\u{feff}').unwrap_or(&text);
    let mut reader =
        csv::ReaderBuilder::new().trim(csv::Trim::All).comment(Some(b'#')).from_reader(text.as_bytes());
    let broken = |error: &csv::Error| {
        let message = error.to_string();
        let plain = message.strip_prefix("CSV error: ").unwrap_or(&message);
        file_at.fault(format!("\"{}\" is not a CSV table: {plain}", shown(file)))
    };
    let header = reader.headers().map_err(|error| broken(&error))?.clone();
    let time = column(at, "time", table.time.as_deref(), &header)?;
    let value = column(at, "value", table.value.as_deref(), &header)?;
    let mut points = Vec::new();
    for record in reader.records() {
        let record = record.map_err(|error| broken(&error))?;
        let line = record.position().map_or(0, csv::Position::line);
        let number = |column: usize| number(&file_at, file, line, record.get(column).unwrap_or(""));
        points.push(Point(Time::new(number(time)?), AnyQuantity { si: number(value)?, kind: None }));
    }
    Ok(points)
}

/// A file at or below the scenario's own folder, wherever links and `..` lead.
fn inside(at: &At<'_>, file: &str, base: &Path) -> Result<PathBuf, Fault> {
    let cannot = |error: std::io::Error| at.fault(format!("cannot read \"{}\": {error}", shown(file)));
    let base = if base.as_os_str().is_empty() { Path::new(".") } else { base };
    let base = base.canonicalize().map_err(cannot)?;
    let path = base.join(file).canonicalize().map_err(cannot)?;
    if !path.starts_with(&base) {
        let fault = at.fault(format!("\"{}\" lies outside the scenario's folder", shown(file)));
        return Err(fault.help("a scenario may name files at or below its own folder only"));
    }
    if !path.is_file() {
        return Err(at.fault(format!("\"{}\" is not a file", shown(file))));
    }
    Ok(path)
}

fn column(at: &At<'_>, key: &str, name: Option<&str>, header: &csv::StringRecord) -> Result<usize, Fault> {
    let Some(name) = name else {
        return Err(at.missing(key).help("the name of a column of the file"));
    };
    let mut columns = header.iter().enumerate().filter(|(_, head)| *head == name).map(|(i, _)| i);
    let at = at.key(key);
    match (columns.next(), columns.next()) {
        (Some(only), None) => Ok(only),
        (Some(_), Some(_)) => Err(at.fault(format!("the file has more than one column \"{}\"", shown(name)))),
        (None, _) => {
            let fault = at.fault(format!("the file has no column \"{}\"", shown(name)));
            Err(fault.maybe_help(suggest::help(name, header.iter())))
        }
    }
}

fn number(at: &At<'_>, file: &str, line: u64, text: &str) -> Result<f64, Fault> {
    match text.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        _ => Err(at.fault(format!(
            "\"{}\", line {line}: expected a number, got \"{}\"",
            shown(file),
            shown(text)
        ))),
    }
}
