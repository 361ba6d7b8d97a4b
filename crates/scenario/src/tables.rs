//! Reads tables in files and replaces them by points in the scenario.

mod foreign;
mod head;
mod heights;
mod pairs;
mod profiles;
mod sheet;

pub use pairs::{Pairs, pairs};

use crate::document::{Document, Source, SourceKind, shown};
use crate::fault::{Fault, Mend};
use crate::folder::{self, Denied};
use crate::form::{Form, FreedomForm, Moving, NormalForm, Point, RecipeForm, WaveformForm, WaveformRef};
use crate::path::{At, KeyPath, Step};
use crate::place::Span;
use crate::quantity::{AnyQuantity, Time};
use crate::units::{Kind, Scale};
use crate::{suggest, syntax, text};
use head::{Column, Head};
use std::io;
use std::ops::Range;
use std::path::Path;
use stickslip_record::smoothed;

/// Maximum size of one file and of all files together, bytes.
const MAX_BYTES: (usize, usize) = (syntax::MAX_BYTES, 16 * syntax::MAX_BYTES);

/// Origin of the points of a table in a file.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct TableFile {
    /// Path of the table.
    path: KeyPath,
    /// Index of the file in the list of sources.
    source: usize,
    /// Key of the list that receives the rows of the file.
    list: &'static str,
    /// Columns of the numbers of an entry; at least one for plain tables, none for tables of instruments.
    columns: Vec<usize>,
}

impl TableFile {
    /// Returns whether a path leads to a value in a row of the file.
    pub(crate) fn has(&self, path: &KeyPath) -> bool {
        let list = self.path.0.iter().cloned().chain([Step::Key(self.list.to_owned())]);
        KeyPath(list.collect()).holds(path)
    }

    /// Returns the path of the table.
    pub(crate) fn path(&self) -> &KeyPath {
        &self.path
    }

    /// Returns the span of the number at a path such as `waveforms.w.table.points[3][0]`, if it is in this table.
    pub(crate) fn locate(&self, path: &KeyPath, sources: &[Source]) -> Option<Span> {
        let [Step::Key(points), Step::Index(row), rest @ ..] = path.0.strip_prefix(self.path.0.as_slice())?
        else {
            return None;
        };
        let column = match rest.first() {
            Some(Step::Index(column)) => *self.columns.get(*column)?,
            _ => *self.columns.first()?,
        };
        let text = &sources.get(self.source)?.text;
        let Range { start, end } = sheet::cell(text, *row, column)?;
        (points == self.list).then_some(Span { source: self.source, start, end })
    }
}

/// Replaces the files of all tables by their points. Returns whether any table was in a file.
pub(crate) fn inline(form: &mut Form, document: &mut Document) -> Result<bool, Fault> {
    let mut shelf = Shelf { document, bytes: 0 };
    let root = At::ROOT;
    let at = root.key("waveforms");
    for (name, waveform) in &mut form.waveforms.0 {
        shelf.in_waveform(&at.key(name), waveform)?;
    }
    let at = root.key("bodies");
    for (name, body) in &mut form.bodies.0 {
        if let FreedomForm::Follows(waveform) = &mut body.x {
            shelf.in_reference(&at.key(name).key("x"), waveform)?;
        }
    }
    let at = root.key("contacts");
    for (name, contact) in &mut form.contacts.0 {
        let at = at.key(name);
        shelf.in_profile(&at.key("profile"), &mut contact.profile)?;
        let at = at.key("normal");
        match &mut contact.normal {
            NormalForm::Force(moving) => shelf.in_moving(&at.key("force"), moving)?,
            NormalForm::Indentation(moving) => shelf.in_moving(&at.key("indentation"), moving)?,
            NormalForm::Radius(moving) => shelf.in_moving(&at.key("radius"), moving)?,
            NormalForm::Coupled => {}
        }
    }
    let at = root.key("actuators");
    for (name, actuator) in &mut form.actuators.0 {
        if let Some(stroke) = &mut actuator.stroke {
            shelf.in_moving(&at.key(name).key("stroke"), stroke)?;
        }
        if let Some(voltage) = &mut actuator.voltage {
            shelf.in_moving(&at.key(name).key("voltage"), voltage)?;
        }
    }
    let at = root.key("loads");
    for (i, load) in form.loads.iter_mut().enumerate() {
        if let Some(x) = &mut load.x {
            shelf.in_moving(&at.index(i).key("x"), x)?;
        }
    }
    Ok(!document.tables.is_empty())
}

/// Rows of a file, and the dimension of each column if its header has a unit.
type Rows<const N: usize> = (Vec<[f64; N]>, [Option<Kind>; N]);

/// Reader of the files of a scenario.
struct Shelf<'a> {
    document: &'a mut Document,
    /// Number of bytes read so far.
    bytes: usize,
}

impl Shelf<'_> {
    fn in_moving<D>(&mut self, at: &At<'_>, moving: &mut Moving<D>) -> Result<(), Fault> {
        match moving {
            Moving::Constant(_) => Ok(()),
            Moving::Follows(waveform) => self.in_reference(at, waveform),
        }
    }

    fn in_reference(&mut self, at: &At<'_>, waveform: &mut WaveformRef) -> Result<(), Fault> {
        match waveform {
            WaveformRef::Name(_) => Ok(()),
            WaveformRef::Inline(waveform) => self.in_waveform(&at.key("follows"), waveform),
        }
    }

    fn in_waveform(&mut self, at: &At<'_>, waveform: &mut WaveformForm) -> Result<(), Fault> {
        let WaveformForm::Table(table) = waveform else { return Ok(()) };
        let at = at.key("table");
        let columns = [("time", table.time.take()), ("value", table.value.take())];
        let recipe = table.recipe.take();
        match table.file.take() {
            None => no_columns(&at, &columns, recipe.as_ref())?,
            Some(_) if table.points.is_some() => return Err(given_twice(&at)),
            Some(file) => {
                let [time, value] = columns;
                let columns = [(time.0, time.1, Column::Time), (value.0, value.1, Column::Value)];
                let (rows, [_, kind]) = self.rows(&at, (&file, recipe), "points", &columns)?;
                let point = |[time, si]: [f64; 2]| Point(Time::new(time), AnyQuantity { si, kind });
                table.points = Some(rows.into_iter().map(point).collect());
            }
        }
        if let (Some(points), Some(window)) = (&mut table.points, table.smooth.take()) {
            if window.si <= 0.0 {
                return Err(at.key("smooth").fault("expected more than 0 s"));
            }
            let rows: Vec<[f64; 2]> = points.iter().map(|Point(time, value)| [time.si, value.si]).collect();
            for (point, value) in points.iter_mut().zip(smoothed(&rows, window.si)) {
                point.1.si = value;
            }
        }
        Ok(())
    }

    /// Reads rows of a file by the columns named under the given keys. Returns the rows and the dimensions in the headers. The argument
    /// `list` is the key that receives the rows. Without a recipe, the file is read as a plain table. If this fails, it is read as a table
    /// of an instrument, provided that no line has to be skipped.
    fn rows<const N: usize>(
        &mut self,
        at: &At<'_>,
        (file, recipe): (&str, Option<RecipeForm>),
        list: &'static str,
        columns: &[(&str, Option<String>, Column); N],
    ) -> Result<Rows<N>, Fault> {
        let read = match recipe {
            Some(recipe) => {
                self.recipe(at, recipe).and_then(|recipe| self.foreign(at, file, Some(recipe), columns))
            }
            None => self.read_rows(at, file, list, columns).or_else(|fault| {
                if self.document.base.is_none() || columns.iter().any(|(_, name, _)| name.is_none()) {
                    return Err(fault);
                }
                self.foreign(at, file, None, columns).map_err(|_| fault)
            }),
        };
        read.map_err(|fault| fault.mend(Mend::Around(at.path())))
    }

    fn read_rows<const N: usize>(
        &mut self,
        at: &At<'_>,
        file: &str,
        list: &'static str,
        columns: &[(&str, Option<String>, Column); N],
    ) -> Result<Rows<N>, Fault> {
        let file_at = at.key("file");
        let bytes = self.read(&file_at, file)?;
        let source = self.document.sources.len();
        let name = match Path::new(&self.document.sources[0].name).parent() {
            Some(folder) => folder.join(file).display().to_string(),
            None => file.to_owned(),
        };
        let kind = SourceKind::Table(file_at.path());
        let span = |Range { start, end }: Range<usize>| Span { source, start, end };
        let text = match text::decode(bytes) {
            Ok(text) => text,
            Err(garbled) => {
                self.document.add(name, garbled.text, kind);
                let fault = file_at.fault(garbled.message).at_span(span(garbled.range));
                return Err(fault.help(garbled.help));
            }
        };
        let slipped =
            |slip: sheet::Slip| file_at.fault(slip.message).at_span(span(slip.range)).maybe_help(slip.help);
        let text = self.document.add(name, text, kind);
        let header: Vec<Head> =
            sheet::header(text).map_err(slipped)?.iter().map(|head| Head::new(head)).collect();
        let mut scaled = [(0, Scale::Ten(0)); N];
        for (place, (key, name, _)) in scaled.iter_mut().zip(columns) {
            place.0 = column(at, key, name.as_deref(), &header)?;
        }
        let mut kinds = [None; N];
        for (((place, scale), kind), (_, _, column)) in scaled.iter_mut().zip(&mut kinds).zip(columns) {
            let measure = header[*place].measure(*column).map_err(|odd| {
                let fault = file_at.fault(odd.message).at_span(span(sheet::head(text, *place)));
                fault.help(odd.help)
            })?;
            (*scale, *kind) = (measure.scale, measure.kind);
        }
        let rows = sheet::numbers(text, scaled, header.len()).map_err(slipped)?;
        let columns = scaled.map(|(place, _)| place).to_vec();
        self.document.tables.push(TableFile { path: at.path(), source, list, columns });
        Ok((rows, kinds))
    }

    // Inlined, so that without files nothing is left of what reads them.
    #[cfg_attr(target_family = "wasm", inline(always))]
    fn read(&mut self, at: &At<'_>, file: &str) -> Result<Vec<u8>, Fault> {
        let unreadable = |error: io::Error| at.fault(format!("cannot read \"{}\": {error}", shown(file)));
        // In a browser there are no files, and what reads them is left out.
        let base = self.document.base.as_deref().filter(|_| !cfg!(target_family = "wasm"));
        let Some(base) = base else {
            return Err(at.fault("this scenario has no folder, so it cannot name files").on_key());
        };
        let path = folder::find(base, Path::new(file)).map_err(|denied| match denied {
            Denied::Outside => at
                .fault(format!("\"{}\" lies outside the scenario's folder", shown(file)))
                .help("a scenario can only name files in its own folder or below"),
            Denied::NotThere => {
                let fault = at.fault(format!("there is no file \"{}\"", shown(file)));
                let names = folder::names(base);
                let near = suggest::nearest(file, names.iter().map(String::as_str));
                fault.help(match near {
                    Some(near) => format!("did you mean \"{near}\"?"),
                    None => "file names are relative to the folder of the scenario".to_owned(),
                })
            }
            Denied::NotAFile => at.fault(format!("\"{}\" is not a file", shown(file))),
            Denied::Unreadable(error) => unreadable(error),
        })?;
        let (most, most_together) = MAX_BYTES;
        let Some(bytes) = text::read(&path, most).map_err(unreadable)? else {
            return Err(at.fault(format!("a table has at most {most} bytes")).help("keep fewer points"));
        };
        self.bytes += bytes.len();
        if self.bytes > most_together {
            let message = format!("the files of all tables have more than {most_together} bytes together");
            let help = "use fewer points; a table that is used twice can be a named waveform";
            return Err(at.fault(message).help(help));
        }
        Ok(bytes)
    }
}

/// Refuses column names and recipes if no file is given.
fn no_columns(
    at: &At<'_>,
    columns: &[(&str, Option<String>)],
    recipe: Option<&RecipeForm>,
) -> Result<(), Fault> {
    if recipe.is_some() {
        let fault = at.key("recipe").fault("describes how to read a file, but there is no file").on_key();
        return Err(fault.help("leave it out").mend(Mend::Around(at.path())));
    }
    match columns.iter().find(|(_, name)| name.is_some()) {
        None => Ok(()),
        Some((key, _)) => {
            let fault = at.key(key).fault("names a column, but there is no file").on_key();
            Err(fault.help("leave it out; points have no columns").mend(Mend::Around(at.path())))
        }
    }
}

/// Returns the error for a file that is given together with points.
fn given_twice(at: &At<'_>) -> Fault {
    let fault = at.key("file").fault("the points are already given").on_key().mend(Mend::Around(at.path()));
    fault.help("keep one of them")
}

/// Returns the index of a column by its full header, or by its header without the unit if no full header matches.
fn column(at: &At<'_>, key: &str, name: Option<&str>, header: &[Head]) -> Result<usize, Fault> {
    let Some(name) = name else {
        return Err(at.missing(key));
    };
    let places = |is: fn(&Head, &str) -> bool| -> Vec<usize> {
        header.iter().enumerate().filter(|(_, head)| is(head, name)).map(|(i, _)| i).collect()
    };
    let mut columns = places(Head::is);
    if columns.is_empty() {
        columns = places(Head::is_bare);
    }
    let at = at.key(key);
    match (&columns[..], header) {
        ([only], _) => Ok(*only),
        ([_, _, ..], _) => {
            let fault = at.fault(format!("the file has more than one column \"{}\"", shown(name)));
            Err(fault.help("give its columns different names"))
        }
        ([], header) => {
            let fault = at.fault(format!("the file has no column \"{}\"", shown(name)));
            Err(fault.maybe_help(help(name, header)))
        }
    }
}

/// Returns help for a column that was not found: a similar name, or the missing commas of the header line.
fn help(name: &str, header: &[Head]) -> Option<String> {
    match header {
        [only] if only.full.contains([';', '\t']) => {
            Some(format!("its first line is \"{}\": separate the fields by commas", shown(&only.full)))
        }
        _ => suggest::help(name, header.iter().map(|head| head.full.as_str())),
    }
}
