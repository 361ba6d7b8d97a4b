//! Export of the results to one CSV table.

use super::part::{CASE, ERROR};
use super::{Study, StudyError};
use csv::Writer;
use std::io;
use std::path::Path;
use stickslip_run::folder;

impl Study {
    /// Writes all parts of a folder to one CSV file, ordered by case. Codes are written as words. Numbers have enough
    /// digits to restore all bits.
    ///
    /// # Errors
    /// Fails if parts are missing or cannot be read, or if the file cannot be written. No incomplete file is left.
    pub fn write_csv(&self, parts: &Path, path: &Path) -> Result<(), StudyError> {
        self.check_complete(parts)?;
        let failed = |source: io::Error| StudyError::Disk { path: path.to_owned(), source };
        let place = path.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let mut draft = folder::draft(place, &name).map_err(failed)?;
        let mut table = Writer::from_writer(draft.as_file_mut());
        let mut head = vec![CASE];
        head.extend(self.varied().map(|(path, _)| path));
        head.extend(self.results());
        head.push(ERROR);
        let mut outcome = table.write_record(&head);
        self.each_part(parts, |number, open| {
            let columns = (0..self.wanted.len()).map(|result| open.result(self, result));
            let columns = columns.collect::<Result<Vec<_>, _>>()?;
            let errors = open.errors(self)?;
            for ((row, case), error) in (0..open.rows()).zip(self.part(number)).zip(errors) {
                let mut cells = vec![case.to_string()];
                cells.extend(self.values(case).iter().map(|value| format!("{value:?}")));
                cells.extend(
                    columns.iter().enumerate().map(|(result, column)| self.cell(result, column[row])),
                );
                cells.push(error.unwrap_or_default());
                if outcome.is_ok() {
                    outcome = table.write_record(&cells);
                }
            }
            Ok(())
        })?;
        outcome.map_err(io::Error::from).and_then(|()| table.flush()).map_err(failed)?;
        drop(table);
        draft.as_file().sync_all().map_err(failed)?;
        draft.persist(path).map_err(|error| failed(error.error))?;
        Ok(())
    }

    /// Formats a result as a number, as a word, or as an empty cell.
    fn cell(&self, result: usize, value: f64) -> String {
        if !value.is_finite() {
            return String::new();
        }
        let word = self.codes(result).and_then(|codes| codes.get(value as usize));
        word.cloned().unwrap_or_else(|| format!("{value:?}"))
    }
}
