//! Time histories of a run that are kept for the summary and the plots.

use std::collections::HashMap;
use stickslip_drive::Channel;
use stickslip_scenario::PlotName;

/// Quantities of the model that are kept for every scenario.
const KEPT: [&str; 11] =
    ["time_s", "x_m", "vx_m_s", "z_m", "vz_m_s", "pitch_rad", "vpitch_rad_s", "u_m", "d_m", "fx_N", "fn_N"];

/// Quantities of a driver.
const DRIVER: [&str; 2] = ["voltage_V", "current_A"];

/// Tolerance for the time of a row at an end of a time interval, relative to the length of the interval.
const SAME: f64 = 1e-9;

/// Part name of the channels of the total energies.
pub const ENERGY: &str = "energy";

/// Time history of a run: the rows and the states after events, in order of time. All values are computed states without interpolation.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    columns: Vec<Column>,
    /// Column indices by name.
    places: HashMap<String, usize>,
}

#[derive(Debug, Clone, PartialEq)]
struct Column {
    place: usize,
    values: Vec<f64>,
}

impl Series {
    /// Creates an empty series for the channels of a model. Some channels are kept only if the plots in `plots` need them.
    pub fn new(channels: &[Channel], plots: &[PlotName]) -> Self {
        let (with_energies, with_all) = (plots.contains(&PlotName::Energy), plots.contains(&PlotName::Xy));
        let with_drive = plots.contains(&PlotName::Drive);
        let is_kept = |channel: &Channel| match channel.name.rsplit_once('.') {
            _ if with_all => !channel.is_state,
            Some((_, quantity)) if with_drive && DRIVER.contains(&quantity) => true,
            Some((ENERGY, _)) if with_energies => true,
            Some((_, quantity)) => KEPT.contains(&quantity),
            None => KEPT.contains(&channel.name.as_str()),
        };
        Self::kept(channels, is_kept)
    }

    /// Creates a series without columns.
    pub fn none() -> Self {
        Self { columns: Vec::new(), places: HashMap::new() }
    }

    fn kept(channels: &[Channel], is_kept: impl Fn(&Channel) -> bool) -> Self {
        let kept = channels.iter().enumerate().filter(|(_, channel)| is_kept(channel));
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

    /// Returns the number of columns.
    pub fn width(&self) -> usize {
        self.columns.len()
    }

    /// Returns the number of values kept so far.
    pub fn size(&self) -> u64 {
        self.columns.len() as u64 * self.time().len() as u64
    }

    /// Returns the times, s.
    pub fn time(&self) -> &[f64] {
        self.columns.first().map_or(&[], |column| &column.values)
    }

    /// Returns the rows within a time interval, s. If the ends of the interval lie between rows, end rows are interpolated linearly.
    #[must_use]
    pub fn part(&self, (from, to): (f64, f64)) -> Self {
        let time = self.time();
        let hair = SAME * (to - from);
        let (start, end) =
            (time.partition_point(|t| *t < from - hair), time.partition_point(|t| *t <= to + hair));
        let between = |t: f64, after: usize| {
            let before = after.checked_sub(1)?;
            let (a, b) = (*time.get(before)?, *time.get(after)?);
            (t > a + hair && t < b - hair).then(|| (before, (t - a) / (b - a)))
        };
        let ends = (between(from, start), between(to, end));
        let cut = |column: &Column| {
            let at = |(before, share): (usize, f64)| {
                let (a, b) = (column.values[before], column.values[before + 1]);
                a + share * (b - a)
            };
            let inside = column.values.get(start..end).unwrap_or_default();
            let values = ends.0.map(at).into_iter().chain(inside.iter().copied()).chain(ends.1.map(at));
            Column { place: column.place, values: values.collect() }
        };
        Self { columns: self.columns.iter().map(cut).collect(), places: self.places.clone() }
    }

    /// Returns the series with NaN rows before and after a time window, s.
    ///
    /// Plots then draw no line from the window to the first and the last row of the run, which are outside of the window.
    #[must_use]
    pub fn broken(&self, [from, to]: [f64; 2]) -> Self {
        let time = self.time();
        let inside = [
            time.partition_point(|t| *t < from * (1.0 - SAME)),
            time.partition_point(|t| *t <= to * (1.0 + SAME)),
        ];
        let gaps = inside.map(|place| Some(place).filter(|place| (1..time.len()).contains(place)));
        let split = |column: &Column| {
            let mut values = column.values.clone();
            for place in gaps.into_iter().flatten().rev() {
                values.insert(place, f64::NAN);
            }
            Column { place: column.place, values }
        };
        Self { columns: self.columns.iter().map(split).collect(), places: self.places.clone() }
    }

    /// Returns the series with the initial values of the given quantities subtracted.
    #[must_use]
    pub fn counted_from_start(mut self, quantities: &[&str]) -> Self {
        let is_counted = |name: &str| name.rsplit_once('.').is_some_and(|(_, it)| quantities.contains(&it));
        let counted = self.places.iter().filter(|(name, _)| is_counted(name)).map(|(_, place)| *place);
        for place in counted.collect::<Vec<_>>() {
            let Some(column) = self.columns.get_mut(place) else { continue };
            let start = column.values.first().copied().unwrap_or(0.0);
            column.values.iter_mut().for_each(|value| *value -= start);
        }
        self
    }

    /// Returns whether a column is kept.
    pub fn has(&self, name: &str) -> bool {
        self.places.contains_key(name)
    }

    /// Returns a column by its name, or an empty slice if the column was not kept.
    pub fn named(&self, name: &str) -> &[f64] {
        let place = self.places.get(name);
        place.and_then(|place| self.columns.get(*place)).map_or(&[], |column| &column.values)
    }

    /// Returns a column by the names of part and quantity, or an empty slice if the column was not kept.
    pub fn column(&self, part: &str, quantity: &str) -> &[f64] {
        self.named(&format!("{part}.{quantity}"))
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

    #[test]
    fn no_line_leads_to_a_window() {
        let channels = ["time_s", "ball.u_m"].map(|name| Channel { name: name.to_owned(), is_state: false });
        let mut series = Series::new(&channels, &[]);
        [0.0, 3.0, 4.0, 5.0, 9.0].iter().for_each(|t| series.push(&[*t, 10.0 * t]));
        let gaps = |window| {
            let broken = series.broken(window);
            assert_eq!(broken.time().len(), broken.column("ball", "u_m").len());
            let gaps = broken.time().iter().enumerate().filter(|(_, t)| t.is_nan());
            gaps.map(|(place, _)| place).collect::<Vec<_>>()
        };
        assert_eq!(gaps([3.0, 5.0]), [1, 5]);
        assert_eq!(gaps([3.0, f64::INFINITY]), [1]);
        // The first row and the last are those of the window.
        assert_eq!((gaps([0.0, 4.0]), gaps([0.0, f64::INFINITY])), (vec![3], vec![]));
        assert_eq!(series.broken([0.0, 9.0]), series);
    }

    #[test]
    fn a_part_ends_where_it_is_asked_to() {
        let channels = ["time_s", "ball.u_m"].map(|name| Channel { name: name.to_owned(), is_state: false });
        let mut series = Series::new(&channels, &[]);
        for (t, u) in [(0.0, 0.0), (1.0, 2.0), (2.0, 0.0), (2.0, 1.0), (3.0, 5.0)] {
            series.push(&[t, u]);
        }
        let part = |span| {
            let part = series.part(span);
            (part.time().to_vec(), part.column("ball", "u_m").to_vec())
        };
        assert_eq!(part((0.5, 2.5)), (vec![0.5, 1.0, 2.0, 2.0, 2.5], vec![1.0, 2.0, 0.0, 1.0, 3.0]));
        // Rounded interval ends coincide with rows. Beyond the last row the part is empty.
        assert_eq!(part((1.0 + 1e-10, 2.0 - 1e-10)), (vec![1.0, 2.0, 2.0], vec![2.0, 0.0, 1.0]));
        assert_eq!(part((2.5, 9.0)), (vec![2.5, 3.0], vec![3.0, 5.0]));
        assert_eq!(part((4.0, 9.0)), (vec![], vec![]));
        assert_eq!(part((1.25, 1.5)), (vec![1.25, 1.5], vec![1.5, 1.0]));
    }
}
