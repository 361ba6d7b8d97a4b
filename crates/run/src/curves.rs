//! Reads `memory.csv`: slip memory curves of the contacts at requested times.

use crate::frame::FrameError;
use crate::rows::Rows;
use crate::seal::SealedTable;
use stickslip_quantity::columns::MEMORY;

/// Slip memory of a contact at one time: rest positions p of the springs as a function of their height h.
#[derive(Debug, Clone, PartialEq)]
pub struct MemoryCurve {
    /// Name of the contact.
    pub contact: String,
    /// Time, s.
    pub time: f64,
    /// Indentation d and displacement u, m.
    pub apex: (f64, f64),
    /// Heights h of the breakpoints of the piecewise linear curve p(h), m, from the centre to the edge of the contact.
    pub h: Vec<f64>,
    /// Rest positions p(h) of the springs at these heights, m.
    pub p: Vec<f64>,
}

/// Reads the table, one line per breakpoint. If the table has more than `most` curves, only curves at evenly chosen times are read.
///
/// These times include the first and the last time of the table.
///
/// # Errors
/// The file cannot be read, has other columns, or contains a cell that is not a number.
pub fn read(table: &SealedTable, most: usize) -> Result<Vec<MemoryCurve>, FrameError> {
    let (times, curves) = survey(table)?;
    let each = curves.div_ceil(times.len().max(1)).max(1);
    let chosen = chosen(&times, (most / each).max(1));
    let mut corners = Corners::open(table)?;
    let mut curves: Vec<MemoryCurve> = Vec::new();
    while corners.rows.advance()? {
        let (t, [d, u, h, p]) = (corners.time()?, corners.corner()?);
        if !chosen.contains(&t) {
            continue;
        }
        let contact = corners.rows.text(1);
        if curves.last().is_none_or(|curve| curve.time != t || curve.contact != contact) {
            let (h, p) = (Vec::new(), Vec::new());
            curves.push(MemoryCurve { contact: contact.to_owned(), time: t, apex: (d, u), h, p });
        }
        if let Some(curve) = curves.last_mut() {
            curve.h.push(h);
            curve.p.push(p);
        }
    }
    Ok(curves)
}

/// Returns the number of curves in the table.
///
/// # Errors
/// The same errors as for [`read`].
pub fn count(table: &SealedTable) -> Result<usize, FrameError> {
    Ok(survey(table)?.1)
}

/// Returns all times of the table, s, and the number of its curves.
fn survey(table: &SealedTable) -> Result<(Vec<f64>, usize), FrameError> {
    let mut corners = Corners::open(table)?;
    let (mut times, mut curves, mut last) = (Vec::new(), 0, (f64::NAN, String::new()));
    while corners.rows.advance()? {
        let (t, contact) = (corners.time()?, corners.rows.text(1));
        if last.0 != t {
            times.push(t);
        }
        if last.0 != t || last.1 != contact {
            curves += 1;
            last = (t, contact.to_owned());
        }
    }
    Ok((times, curves))
}

/// Returns at most `most` evenly chosen times: the last time and, if `most` exceeds 1, the first time are among them.
pub fn chosen(times: &[f64], most: usize) -> Vec<f64> {
    if times.len() <= most {
        return times.to_vec();
    }
    let last = times.len() - 1;
    let place = |k: usize| if most == 1 { last } else { (k * last + (most - 1) / 2) / (most - 1) };
    (0..most).filter_map(|k| times.get(place(k)).copied()).collect()
}

/// The table, opened for reading.
struct Corners {
    rows: Rows,
}

impl Corners {
    fn open(table: &SealedTable) -> Result<Self, FrameError> {
        let mut rows = Rows::open(table)?;
        rows.check_head(MEMORY.names)?;
        Ok(Self { rows })
    }

    fn time(&self) -> Result<f64, FrameError> {
        self.rows.number(0, MEMORY.names[0])
    }

    /// Returns d, u, h and p of the current row, m.
    fn corner(&self) -> Result<[f64; 4], FrameError> {
        let mut corner = [0.0; 4];
        for (i, value) in corner.iter_mut().enumerate() {
            *value = self.rows.number(i + 2, MEMORY.names[i + 2])?;
        }
        Ok(corner)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_many_moments_some_are_chosen_evenly() {
        let times: Vec<f64> = (0..=100).map(f64::from).collect();
        assert_eq!(chosen(&times, 5), [0.0, 25.0, 50.0, 75.0, 100.0]);
        assert_eq!(chosen(&times, 4), [0.0, 33.0, 67.0, 100.0]);
        assert_eq!(chosen(&times[..3], 5), [0.0, 1.0, 2.0]);
        assert_eq!((chosen(&times, 1), chosen(&[], 3)), (vec![100.0], vec![]));
    }

    #[test]
    fn curves_are_told_apart_by_moment_and_contact() {
        let file = tempfile::NamedTempFile::new().unwrap();
        let line = |t: u32, contact: &str, h: u32| format!("{t},{contact},1,0.5,{h},0.{h}\n");
        let lines =
            (0..10).flat_map(|t| [line(t, "a", 0), line(t, "a", 1), line(t, "b", 0), line(t, "b", 1)]);
        std::fs::write(file.path(), format!("{}\n{}", MEMORY.names.join(","), lines.collect::<String>()))
            .unwrap();
        let of = |curve: &MemoryCurve| (curve.time, curve.contact.clone());
        let some: Vec<_> = read(&file.path().to_owned().into(), 5).unwrap().iter().map(of).collect();
        assert_eq!(some, [(0.0, "a".into()), (0.0, "b".into()), (9.0, "a".into()), (9.0, "b".into())]);
        let all = read(&file.path().to_owned().into(), 20).unwrap();
        assert_eq!(all.len(), 20);
        assert_eq!((all[3].apex, &*all[3].h, &*all[3].p), ((1.0, 0.5), &[0.0, 1.0][..], &[0.0, 0.1][..]));
    }
}
