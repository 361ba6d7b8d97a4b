//! Output files of a study: table, JSON report and plots. The files of an interrupted study do not replace those of a complete study.

use serde::Serialize;
use std::io;
use stickslip_run::folder::Folder;
use stickslip_run::hash;

/// File names of table and report: first for a complete study, then for an interrupted study.
pub(crate) type Names = [[&'static str; 2]; 2];

/// Returns the `status` of a report: `interrupted` or `done`.
pub(crate) fn status(is_cut: bool) -> &'static str {
    if is_cut { "interrupted" } else { "done" }
}

/// Writes table, plots and, last, the report. Returns the names of all files.
///
/// `report` creates the report from the names of all files and the hash of the table. Old plots named in `stale` are deleted if they are
/// not written again. A complete study also deletes the files of an earlier interrupted study.
///
/// # Errors
/// Fails on file system errors. Old files are then kept, unless the error occurs while the new files are renamed to their final names.
pub(crate) fn publish<R: Serialize>(
    mut folder: Folder,
    (names, is_cut): (&Names, bool),
    (table, report): (&str, impl FnOnce(Vec<String>, String) -> R),
    (pictures, mut stale): (&[(String, Vec<u8>)], Vec<String>),
) -> io::Result<Vec<String>> {
    let [name, summary] = names[usize::from(is_cut)];
    folder.release();
    folder.write(name, table.as_bytes())?;
    pictures.iter().try_for_each(|(name, bytes)| folder.write(name, bytes))?;
    let mut files = folder.names();
    files.push(summary.to_owned());
    if !is_cut {
        stale.extend(names[1].map(str::to_owned));
    }
    folder.forget(stale);
    let mut json =
        serde_json::to_vec_pretty(&report(files.clone(), hash(table))).map_err(io::Error::other)?;
    json.push(b'\n');
    folder.write(summary, &json)?;
    folder.publish()?;
    Ok(files)
}
