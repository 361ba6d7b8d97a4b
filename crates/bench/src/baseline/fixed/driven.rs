//! Prescribed quantities, tabulated at half steps.

use crate::baseline::Track;
use crate::contestant::Stop;

/// Maximum length of a table.
const TABLE: usize = 1 << 23;

/// Values of a prescribed quantity at half steps, over a period or the whole run.
pub(super) struct Table(Vec<f64>);

/// Current values of the prescribed quantities.
pub(super) struct Driven<'t> {
    pub(super) values: Vec<f64>,
    tables: Vec<(&'t [f64], usize)>,
}

impl<'t> Driven<'t> {
    pub(super) fn new(tables: &'t [Table]) -> Self {
        let values = tables.iter().map(|table| table.0[0]).collect();
        Self { values, tables: tables.iter().map(|table| (table.0.as_slice(), 0)).collect() }
    }

    /// Advances by one or two half steps.
    #[inline(always)]
    pub(super) fn advance(&mut self, halves: usize) {
        for k in 0..self.tables.len() {
            let (table, at) = &mut self.tables[k];
            *at += halves;
            if *at >= table.len() {
                *at -= table.len();
            }
            self.values[k] = table[*at];
        }
    }
}

impl Table {
    /// Tabulates one period if it is a multiple of the step, otherwise the whole run.
    pub(super) fn new(track: &Track, step: f64, duration: f64) -> Result<Self, Stop> {
        let timing = track.waveform.timing();
        let endless = timing.delay == 0.0 && timing.cycles.is_none();
        let period = track.waveform.period().filter(|_| endless).map(|period| period / step);
        let divided = period.filter(|steps| (steps - steps.round()).abs() < 1e-9 * steps);
        let steps = divided.map_or((duration / step).round() + 1.0, f64::round);
        let length = 2 * steps as usize;
        if length > TABLE {
            return Err(Stop::Failed("the table of prescribed positions would be too long".to_owned()));
        }
        let place = |n: usize| track.place(0.5 * n as f64 * step);
        Ok(Self((0..length).map(place).collect()))
    }
}
