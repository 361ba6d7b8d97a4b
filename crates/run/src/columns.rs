//! Columns of the tables.

use stickslip_drive::Channel;

/// Columns of a table, as indices among the channels of a model.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Columns {
    chosen: Vec<(usize, Channel)>,
}

impl Columns {
    /// Returns all channels as columns.
    pub fn all(channels: &[Channel]) -> Self {
        Self { chosen: channels.iter().cloned().enumerate().collect() }
    }

    /// Returns columns for the time and for the channels with the indices `places`, in this order.
    pub fn chosen(channels: &[Channel], places: &[usize]) -> Self {
        let rest = places.iter().copied().filter(|place| *place > 0);
        let chosen = std::iter::once(0).chain(rest);
        Self { chosen: chosen.filter_map(|place| Some((place, channels.get(place)?.clone()))).collect() }
    }

    /// Returns the number of columns.
    pub fn len(&self) -> usize {
        self.chosen.len()
    }

    /// Returns whether the list of columns is empty, even without the time.
    pub fn is_empty(&self) -> bool {
        self.chosen.is_empty()
    }

    /// Selects the values of the columns from `values`, a row of all channels. Missing values are NaN.
    pub fn of<'a>(&'a self, values: &'a [f64]) -> impl Iterator<Item = (f64, &'a Channel)> {
        self.chosen.iter().map(|(place, channel)| (values.get(*place).copied().unwrap_or(f64::NAN), channel))
    }

    /// Returns the channels of the columns, the time first.
    pub fn channels(&self) -> Vec<Channel> {
        self.chosen.iter().map(|(_, channel)| channel.clone()).collect()
    }

    /// Returns the names of the columns, the time first.
    pub(crate) fn names(&self) -> impl Iterator<Item = &str> {
        self.chosen.iter().map(|(_, channel)| channel.name.as_str())
    }

    /// Returns the channels with their indices among all channels.
    pub(crate) fn places(&self) -> &[(usize, Channel)] {
        &self.chosen
    }
}
