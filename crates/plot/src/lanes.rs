//! Names of lanes, wrapped into as many lines as fit the lane height, and shrunk where necessary.

use crate::label::Label;
use crate::panel::Lane;
use crate::{PlotError, thin::Point};

/// Wrapped names of lanes.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Names {
    /// Font size of names and notes, px per em.
    pub(crate) em: f64,
    /// Lines of each name.
    pub(crate) lines: Vec<Vec<Label>>,
}

/// Height of a line, em.
pub(crate) const LINE: f64 = 1.2;
/// Font sizes that are tried, relative to the requested one.
const SIZES: [f64; 7] = [1.0, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4];

impl Names {
    /// Wraps the names to a width and the height of a lane, px, at a font size of at most `em` px.
    pub(crate) fn new(lanes: &[Lane], (width, height): Point, em: f64) -> Result<Self, PlotError> {
        let mut smallest = Self::default();
        for em in SIZES.map(|share| share * em) {
            let count = (height / (LINE * em)) as usize;
            let wrapped = |lane: &Lane| Label::plain(&lane.label).wrapped(em, width, count.max(1));
            let lines = lanes.iter().map(wrapped).collect::<Result<Vec<_>, _>>()?;
            smallest = Self { em, lines };
            if count > 0
                && lanes.iter().zip(&smallest.lines).all(|(lane, lines)| is_whole(&lane.label, lines))
            {
                break;
            }
        }
        smallest.em = smallest.em.min(height / LINE);
        Ok(smallest)
    }

    /// Returns the width of the widest line, px.
    pub(crate) fn width(&self) -> Result<f64, PlotError> {
        self.lines.iter().flatten().try_fold(0.0, |most: f64, line| Ok(most.max(line.width(self.em)?)))
    }
}

/// Returns whether the lines contain all characters of a name.
fn is_whole(name: &str, lines: &[Label]) -> bool {
    let solid =
        |text: &str| text.chars().filter(|c| !c.is_whitespace() && !c.is_control()).collect::<String>();
    solid(name) == solid(&lines.iter().map(Label::text).collect::<String>())
}
