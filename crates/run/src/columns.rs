//! The columns of the tables.

use stickslip_drive::Channel;

/// The columns of a table: places among a model's channels.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Columns {
    chosen: Vec<(usize, Channel)>,
}

impl Columns {
    /// All channels.
    pub fn all(channels: &[Channel]) -> Self {
        Self { chosen: channels.iter().cloned().enumerate().collect() }
    }

    /// The channels at these places, in this order, after the time.
    pub fn chosen(channels: &[Channel], places: &[usize]) -> Self {
        let rest = places.iter().copied().filter(|place| *place > 0);
        let chosen = std::iter::once(0).chain(rest);
        Self { chosen: chosen.filter_map(|place| Some((place, channels.get(place)?.clone()))).collect() }
    }

    /// Number of columns.
    pub fn len(&self) -> usize {
        self.chosen.len()
    }

    /// Whether there are none: even the time is left out.
    pub fn is_empty(&self) -> bool {
        self.chosen.is_empty()
    }

    /// The chosen of all channels' values. What is missing is NaN.
    pub fn of<'a>(&'a self, values: &'a [f64]) -> impl Iterator<Item = (f64, &'a Channel)> {
        self.chosen.iter().map(|(place, channel)| (values.get(*place).copied().unwrap_or(f64::NAN), channel))
    }

    /// The channels, the time first.
    pub fn channels(&self) -> Vec<Channel> {
        self.chosen.iter().map(|(_, channel)| channel.clone()).collect()
    }

    /// Names of the columns, the time first.
    pub(crate) fn names(&self) -> impl Iterator<Item = &str> {
        self.chosen.iter().map(|(_, channel)| channel.name.as_str())
    }

    /// Places among all channels, with the channel there.
    pub(crate) fn places(&self) -> &[(usize, Channel)] {
        &self.chosen
    }
}
