//! Enlarged time range next to or below the panel of the whole time range.

use crate::figure::{Arrangement, Figure};
use crate::layout::{Area, Placed};
use crate::paint::Painter;
use crate::panel::Reference;
use crate::theme::{Dash, Stroke};
use crate::{Label, PlotError};
use plotters_backend::DrawingBackend;

/// Minimum width of a shaded range, px of a figure 1600 px wide.
const LEAST: f64 = 5.0;

/// Places each panel of `part` right of the same panel of `whole`, as an enlargement of the range `of`. The range is shaded in the left
/// panels; `heading` stands above the right panels. Returns `whole` unchanged unless both are columns with equally many panels.
pub fn enlarged_beside<'a>(whole: Figure<'a>, part: Figure<'a>, of: (f64, f64), heading: &str) -> Figure<'a> {
    let is_column = |figure: &Figure<'_>| figure.arrangement == Arrangement::Column { share_x: true };
    if whole.panels.len() != part.panels.len() || !is_column(&whole) || !is_column(&part) {
        return whole;
    }
    let mut panels = Vec::new();
    for (row, (mut left, mut right)) in whole.panels.into_iter().zip(part.panels).enumerate() {
        left.enlarged = Some(of);
        right.x.covers = Some(of);
        if row == 0 {
            right.heading = Label::plain(heading);
        }
        // Names that the left panel has already are not repeated.
        let is_named = |label: &Label| {
            left.series
                .iter()
                .map(|it| &it.label)
                .chain(left.bands.iter().map(|it| &it.label))
                .any(|it| it == label)
        };
        let labels = right.series.iter_mut().map(|series| &mut series.label);
        let labels = labels.chain(right.bands.iter_mut().map(|band| &mut band.label));
        labels.filter(|label| is_named(label)).for_each(|label| *label = Label::default());
        right.references.iter_mut().for_each(|reference| *label_of(reference) = Label::default());
        panels.extend([left, right]);
    }
    Figure { panels, arrangement: Arrangement::Columns { columns: 2 }, ..whole }.with_room_for_legends()
}

/// Places the single panel of `part` below the panel of `whole`, as an enlargement of the range `of` with a heading. Returns `whole`
/// unchanged unless both have exactly one panel.
pub fn enlarged_below<'a>(whole: Figure<'a>, part: Figure<'a>, of: (f64, f64), heading: &str) -> Figure<'a> {
    let (width, height) = whole.size;
    let mut panels = whole.panels;
    let mut others = part.panels;
    if let ([upper], [lower]) = (&mut panels[..], &mut others[..]) {
        upper.enlarged = Some(of);
        lower.x.covers = Some(of);
        lower.heading = Label::plain(heading);
        panels.append(&mut others);
        let arrangement = Arrangement::Column { share_x: false };
        return Figure { panels, arrangement, size: (width, height + part.size.1), ..whole };
    }
    Figure { panels, ..whole }
}

fn label_of(reference: &mut Reference) -> &mut Label {
    match reference {
        Reference::Horizontal { label, .. } | Reference::Vertical { label, .. } => label,
    }
}

impl<B: DrawingBackend> Painter<'_, B> {
    /// Shades a range of the x axis over the height of the frame.
    pub(crate) fn enlarged(
        &mut self,
        place: &Placed<'_, '_>,
        (from, to): (f64, f64),
    ) -> Result<(), PlotError> {
        let frame = place.frame;
        let pixel =
            |x: f64| frame.left + frame.width * place.x.place(place.panel.x.measure(x)).clamp(0.0, 1.0);
        let (mut left, mut right) = (pixel(from), pixel(to));
        if !(left.is_finite() && right.is_finite()) {
            return Ok(());
        }
        let least = LEAST * self.sizes.scale;
        if right - left < least {
            right = (left + right + least).min(2.0 * (frame.left + frame.width)) / 2.0;
            left = right - least;
        }
        let (top, bottom) = (frame.top, frame.top + frame.height);
        self.canvas
            .fill(Area { left, top, width: right - left, height: frame.height }, self.theme.shaded())?;
        let edge = Stroke { colour: self.theme.muted, dash: Dash::Solid, width: 1.5 };
        [left, right].into_iter().try_for_each(|x| self.canvas.line(&[(x, top), (x, bottom)], edge))
    }
}
