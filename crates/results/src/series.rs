//! What is kept of a run for the summary and the pictures.

use std::collections::HashMap;
use stickslip_drive::Channel;
use stickslip_scenario::PlotName;

/// Quantities kept; the rest is in the tables only.
const KEPT: [&str; 11] =
    ["time_s", "x_m", "vx_m_s", "z_m", "vz_m_s", "pitch_rad", "vpitch_rad_s", "u_m", "d_m", "fx_N", "fn_N"];

/// Part that the energies of the whole belong to.
pub const ENERGY: &str = "energy";

/// Rows and the moments after events, in order of time: all are exact states of the run, and the turning points
/// between two rows are among them.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    columns: Vec<Column>,
    /// Places of the columns by name: a scene may have tens of thousands.
    places: HashMap<String, usize>,
}

#[derive(Debug, Clone, PartialEq)]
struct Column {
    place: usize,
    values: Vec<f64>,
}

impl Series {
    /// An empty series of a model's channels; what only pictures need is kept for those in `plots`.
    pub fn new(channels: &[Channel], plots: &[PlotName]) -> Self {
        let with_energies = plots.contains(&PlotName::Energy);
        let is_kept = |name: &str| match name.rsplit_once('.') {
            Some((ENERGY, _)) if with_energies => true,
            Some((_, quantity)) => KEPT.contains(&quantity),
            None => KEPT.contains(&name),
        };
        Self::kept(channels, is_kept)
    }

    /// One that keeps nothing.
    pub(crate) fn none() -> Self {
        Self { columns: Vec::new(), places: HashMap::new() }
    }

    fn kept(channels: &[Channel], is_kept: impl Fn(&str) -> bool) -> Self {
        let kept = channels.iter().enumerate().filter(|(_, channel)| is_kept(&channel.name));
        let (mut columns, mut places) = (Vec::new(), HashMap::new());
        for (place, channel) in kept {
            places.insert(channel.name.clone(), columns.len());
            columns.push(Column { place, values: Vec::new() });
        }
        Self { columns, places }
    }

    /// Appends a row of all channels.
    pub fn push(&mut self, row: &[f64]) {
        for column in &mut self.columns {
            column.values.extend(row.get(column.place));
        }
    }

    /// Number of columns.
    pub fn width(&self) -> usize {
        self.columns.len()
    }

    /// Numbers kept so far.
    pub fn size(&self) -> u64 {
        self.columns.len() as u64 * self.time().len() as u64
    }

    /// Times, s.
    pub fn time(&self) -> &[f64] {
        self.columns.first().map_or(&[], |column| &column.values)
    }

    /// Whether a column is kept.
    pub fn has(&self, name: &str) -> bool {
        self.places.contains_key(name)
    }

    /// A column by part and quantity; empty where there is none.
    pub fn column(&self, part: &str, quantity: &str) -> &[f64] {
        let place = self.places.get(&format!("{part}.{quantity}"));
        place.and_then(|place| self.columns.get(*place)).map_or(&[], |column| &column.values)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_column_is_found_by_part_and_quantity() {
        let names = ["time_s", "ball.state", "ball.u_m", "ball 2.u_m"];
        let channels = names.map(|name| Channel { name: name.to_owned(), is_state: false });
        let mut series = Series::new(&channels, &[]);
        series.push(&[0.0, 1.0, 2.0, 3.0]);
        assert_eq!((series.time(), series.column("ball", "u_m")), (&[0.0][..], &[2.0][..]));
        assert_eq!((series.column("ball 2", "u_m"), series.column("ball", "state")), (&[3.0][..], &[][..]));
        assert_eq!(series.size(), 3);
    }
}
