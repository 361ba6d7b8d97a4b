//! The files of a study: a table, what is told of all, and pictures. One that was interrupted has names of its own, and a finished
//! one stays beside it.

use serde::Serialize;
use std::io;
use stickslip_run::folder::Folder;
use stickslip_run::hash;

/// Names of a table and of what is told of all: of a whole study, and of one that was interrupted.
pub(crate) type Names = [[&'static str; 2]; 2];

/// Word of what is told for a study that is whole or not.
pub(crate) fn status(is_cut: bool) -> &'static str {
    if is_cut { "interrupted" } else { "done" }
}

/// Writes a table, pictures and last what is told of all, which `report` makes of the names of all files and the hash of the table.
/// Pictures of the names `stale` that are not among them go, and with a whole study what one before it had left when it was
/// interrupted. Returns the names.
///
/// # Errors
/// What the system says; nothing that was there is gone then, unless it says so while names are given.
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
