//! Second axes in other units, right of and above a frame.

use crate::canvas::Anchor;
use crate::layout::{Placed, Sizes};
use crate::paint::Painter;
use crate::panel::{Axis, Rescaled};
use crate::place::{LABEL_LINE, TICK_LINE};
use crate::scale::{Along, Scale};
use crate::{Label, PlotError};
use plotters_backend::DrawingBackend;

/// Scales of the second axes of a panel.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Beside {
    /// Scale above the frame.
    pub(crate) top: Option<Scale>,
    /// Scale right of the frame.
    pub(crate) right: Option<Scale>,
}

impl Beside {
    /// Creates the scales of the second axes from the scales of the main axes.
    pub(crate) fn new(
        (top, right): (Option<&Rescaled>, Option<&Rescaled>),
        (x, y): (&Scale, &Scale),
    ) -> Self {
        let scale = |rescaled: Option<&Rescaled>, of: &Scale| {
            let Rescaled { label, by } = rescaled.filter(|r| r.by > 0.0 && r.by.is_finite())?;
            // If all values are 0, the range is arbitrary.
            let by = if of.is_of_nothing() { &1.0 } else { by };
            let range = of.range().map(|(low, high)| (low / by, high / by));
            Some(Scale::new(&Axis::new(label.clone(), ""), range).of_nothing(of.is_of_nothing()))
        };
        Self { top: scale(top, x), right: scale(right, y) }
    }

    pub(crate) fn set_top_ticks(&mut self, width: f64, em: f64) -> Result<(), PlotError> {
        self.top.as_mut().map_or(Ok(()), |scale| scale.set_ticks(Along::Width(width), em))
    }

    pub(crate) fn set_right_ticks(&mut self, height: f64, em: f64) -> Result<(), PlotError> {
        self.right.as_mut().map_or(Ok(()), |scale| scale.set_ticks(Along::Height(height), em))
    }

    /// Returns the height of the second horizontal axis above the frame, px.
    pub(crate) fn height(&self, sizes: Sizes) -> f64 {
        let height = sizes.mark + TICK_LINE * sizes.tick + LABEL_LINE * sizes.label;
        if self.top.is_some() { height } else { 0.0 }
    }

    /// Returns the width of the second vertical axis right of the frame, px.
    pub(crate) fn width(&self, sizes: Sizes) -> Result<f64, PlotError> {
        let Some(right) = &self.right else { return Ok(0.0) };
        Ok(sizes.mark + 0.4 * sizes.tick + right.label_width(sizes.tick)? + LABEL_LINE * sizes.label)
    }
}

impl<B: DrawingBackend> Painter<'_, B> {
    /// Draws ticks, numbers and labels of the second axes.
    pub(crate) fn beside(&mut self, place: &Placed<'_, '_>) -> Result<(), PlotError> {
        let (sizes, frame) = (self.sizes, place.frame);
        let right = frame.left + frame.width;
        if let Some(scale) = &place.beside.top {
            for (at, text) in &scale.ticks {
                let x = (frame.left + at * frame.width).round();
                self.canvas.line(&[(x, frame.top - sizes.mark), (x, frame.top)], self.mark())?;
                let baseline = frame.top - sizes.mark - 0.35 * sizes.tick;
                self.canvas.text(&Label::plain(text), sizes.tick, (x, baseline), Anchor::Centre)?;
            }
            let (label, em) = scale.label.fitted(&scale.unit, sizes.label, frame.width)?;
            let baseline = frame.top - sizes.mark - TICK_LINE * sizes.tick - 0.3 * sizes.label;
            self.canvas.text(&label, em, (frame.left + frame.width / 2.0, baseline), Anchor::Centre)?;
        }
        if let Some(scale) = &place.beside.right {
            for (at, text) in &scale.ticks {
                let y = (frame.top + (1.0 - at) * frame.height).round();
                self.canvas.line(&[(right, y), (right + sizes.mark, y)], self.mark())?;
                let start = (right + sizes.mark + 0.3 * sizes.tick, y + 0.36 * sizes.tick);
                self.canvas.text(&Label::plain(text), sizes.tick, start, Anchor::Left)?;
            }
            let (label, em) = scale.label.fitted(&scale.unit, sizes.label, frame.height)?;
            let baseline = right + place.beside.width(sizes)? - 0.35 * sizes.label;
            self.canvas.upright(&label, em, (baseline, frame.top + frame.height / 2.0))?;
        }
        Ok(())
    }
}
