//! States of springs over time: where a contact sticks, slips and is open.

use crate::figure::{Arrangement, Figure};
use crate::panel::{Axis, Mosaic, Panel};
use crate::{Ink, Label};

/// State of a spring.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum SpringCondition {
    /// Out of contact.
    Open,
    /// Held by friction.
    Stick,
    /// Slipping, dragged towards larger displacements.
    SlipForward,
    /// Slipping, dragged towards smaller displacements.
    SlipBackward,
}

/// The springs of a contact over time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpringMap<'a> {
    /// Name of the contact.
    pub name: &'a str,
    /// Moments, s, ascending.
    pub time: &'a [f64],
    /// Places of the springs, m, ascending.
    pub x: &'a [f64],
    /// States, moment by moment: as many as moments times springs.
    pub conditions: &'a [SpringCondition],
}

const NOTHING: &str = "no springs recorded";
/// Contacts that have room one below the other, and how many columns there are where more are shown.
const ROWS: usize = 17;
const COLUMNS: usize = 3;

/// One panel per contact: time to the right, the row of springs upwards, states in colours of their own. A state is
/// shown from half way since the moment before to half way to the moment after. Of more contacts than there is room for, the first
/// are shown, and the title says of how many.
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
