//! Stick and slip of the springs of contacts over time.

use crate::figure::{Arrangement, Figure};
use crate::panel::{Axis, Mosaic, Panel};
use crate::{Ink, Label};

/// State of a spring.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum SpringCondition {
    /// Not in contact.
    Open,
    /// Sticking.
    Stick,
    /// Slipping towards larger displacements.
    SlipForward,
    /// Slipping towards smaller displacements.
    SlipBackward,
}

/// States of the springs of a contact over time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpringMap<'a> {
    /// Name of the contact.
    pub name: &'a str,
    /// Times, s, ascending.
    pub time: &'a [f64],
    /// Positions of the springs, m, ascending.
    pub x: &'a [f64],
    /// States, time by time: number of times multiplied by the number of springs.
    pub conditions: &'a [SpringCondition],
}

const NOTHING: &str = "no springs recorded";
/// Maximum number of contacts below each other, and the number of columns for more contacts.
const ROWS: usize = 17;
const COLUMNS: usize = 3;

/// Draws one panel per contact: time to the right, position of the springs upwards, states in colours. A state extends to the midpoints
/// between its time and the neighbouring times. If there are too many contacts, the first are shown and the title gives their number.
pub fn state_figure<'a>(title: &str, maps: &[SpringMap<'a>]) -> Figure<'a> {
    if maps.is_empty() {
        return Figure::without_data(title, NOTHING);
    }
    let shown = maps.len().min(ROWS * COLUMNS);
    let title = if shown < maps.len() {
        format!("{title}: {shown} of {} contacts", maps.len())
    } else {
        title.to_owned()
    };
    let (rows, arrangement) = if shown <= ROWS {
        (shown, Arrangement::Column { share_x: true })
    } else {
        (shown.div_ceil(COLUMNS), Arrangement::Columns { columns: COLUMNS })
    };
    Figure {
        title: Label::plain(&title),
        size: Figure::size_for(340, if shown < 3 { 560 } else { 420 }, rows),
        panels: maps[..shown].iter().map(panel).collect(),
        arrangement,
        ..Figure::default()
    }
}

fn panel<'a>(map: &SpringMap<'a>) -> Panel<'a> {
    let classes = ["open", "stick", "slip +", "slip −"].into_iter().enumerate();
    let mosaic = Mosaic {
        xs: map.time.into(),
        ys: map.x.into(),
        cells: map.conditions.iter().map(|condition| *condition as u8).collect::<Vec<u8>>().into(),
        classes: classes.map(|(shade, name)| (Label::plain(name), Ink::Shade(shade))).collect(),
    };
    Panel {
        heading: Label::plain(map.name),
        x: Axis { tight: true, ..Axis::new(Label::plain("time t"), "s") },
        y: Axis { tight: true, ..Axis::new(Label::plain("position x"), "m") },
        mosaic: Some(mosaic),
        absence: Label::plain(NOTHING),
        ..Panel::default()
    }
}
