//! Assigns roles (time, displacement, force) to columns, in this order: by the recipe, by name, by unit, by position.

use crate::error::RecordError;
use crate::layout::{Column, Layout};
use crate::recipe::{ColumnRecipe, Place, Recipe, Role};
use crate::unit;
use std::collections::BTreeMap;

/// A column that is read, with its conversion to SI units.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Reading {
    pub(crate) place: usize,
    pub(crate) is_clock: bool,
    pub(crate) gain: f64,
    pub(crate) offset: f64,
    /// Number of SI units per unit of the column.
    pub(crate) factor: f64,
    /// Unit of the column, and whether it was assumed.
    pub(crate) unit: String,
    pub(crate) is_assumed: bool,
}

impl Reading {
    /// Converts a number of the column to SI units.
    pub(crate) fn si(&self, cell: f64) -> f64 {
        let value = self.gain * cell + self.offset;
        // Division by an integer inverse avoids a second rounding: 1e-6 is not a binary fraction, but 1e6 is.
        let inverse = self.factor.recip().round();
        if (inverse * self.factor - 1.0).abs() < f64::EPSILON { value / inverse } else { value * self.factor }
    }
}

/// Usual names of columns with this role, in order of preference.
fn words(role: Role) -> &'static [&'static str] {
    match role {
        Role::Time => &[
            "t",
            "time",
            "zeit",
            "temps",
            "tiempo",
            "timestamp",
            "second",
            "seconds",
            "sec",
            "uhrzeit",
            "clock",
            "elapsed",
        ],
        Role::Displacement => &[
            "u",
            "x",
            "disp",
            "displacement",
            "weg",
            "position",
            "pos",
            "lvdt",
            "slip",
            "travel",
            "stroke",
            "auslenkung",
            "extension",
            "deplacement",
            "desplazamiento",
        ],
        Role::Force => &[
            "fx",
            "ft",
            "q",
            "querkraft",
            "tangential",
            "tangentialkraft",
            "friction",
            "reibkraft",
            "lateral",
            "f",
            "force",
            "kraft",
            "load",
            "last",
            "fuerza",
        ],
        Role::Normal => &["fz", "fn", "normal", "normalkraft", "normallast", "p"],
        Role::Value => &["value", "z", "height", "gap", "y", "ch1", "voltage", "spannung", "signal", "volt"],
        Role::Position => &["x", "r", "radius", "lateral", "position", "distance", "xpos"],
    }
}

/// Returns the columns of all roles that the file contains.
///
/// # Errors
/// A column of the recipe does not exist or is used twice, a `wanted` role has no column, or a unit is invalid.
pub(crate) fn readings(
    file: &str,
    layout: &Layout,
    recipe: &Recipe,
    wanted: &[Role],
) -> Result<BTreeMap<Role, Reading>, RecordError> {
    let mut places: BTreeMap<Role, usize> = BTreeMap::new();
    for (role, own) in &recipe.columns {
        let Some(place) = &own.column else { continue };
        let place = find(layout, place).ok_or_else(|| RecordError::NoColumn {
            file: file.to_owned(),
            role: *role,
            wanted: match place {
                Place::Number(number) => number.to_string(),
                Place::Name(name) => format!("\"{name}\""),
            },
            known: layout.words(),
        })?;
        if let Some((other, _)) = places.iter().find(|(_, taken)| **taken == place) {
            return Err(RecordError::Twice {
                file: file.to_owned(),
                column: place + 1,
                roles: [*other, *role],
            });
        }
        places.insert(*role, place);
    }
    // The normal force comes first, because "normal force" also contains a name of the tangential force.
    let usual = if wanted.contains(&Role::Value) { &[] } else { &[Role::Displacement, Role::Force][..] };
    let special = [Role::Position, Role::Value].into_iter().filter(|role| wanted.contains(role));
    for role in [Role::Normal, Role::Time].into_iter().chain(usual.iter().copied()).chain(special) {
        let is_known = places.contains_key(&role) || role == Role::Time && layout.pace.is_some();
        if !is_known && let Some(place) = guess(layout, role, &places) {
            places.insert(role, place);
        }
    }
    by_place(layout, &mut places, wanted);
    let has = |role: &Role| places.contains_key(role) || *role == Role::Time && layout.pace.is_some();
    if let Some(role) = wanted.iter().find(|role| !has(role)) {
        return Err(RecordError::Unknown { file: file.to_owned(), role: *role, known: layout.words() });
    }
    let reading = |(role, place): (Role, usize)| {
        let own = recipe.columns.get(&role).cloned().unwrap_or_default();
        Ok((role, reading(file, (role, place), &layout.columns[place], &own)?))
    };
    places.into_iter().map(reading).collect()
}

fn find(layout: &Layout, place: &Place) -> Option<usize> {
    match place {
        Place::Number(number) => {
            // Oscilloscopes use numbers as channel names.
            let named = layout.columns.iter().position(|column| column.name == number.to_string());
            named.or_else(|| number.checked_sub(1).filter(|place| *place < layout.columns.len()))
        }
        Place::Name(name) => {
            let (bare, _) = unit::part(name);
            let is = |text: &str| !text.is_empty() && text.eq_ignore_ascii_case(name.trim());
            let whole = |column: &Column| {
                let unit = column.unit.as_deref().unwrap_or_default();
                is(&column.name)
                    || is(unit)
                    || (!bare.is_empty() && column.name.eq_ignore_ascii_case(&bare) && name.contains(unit))
            };
            // The name may be the first of two heading lines.
            let start = format!("{} ", name.trim().to_lowercase());
            let begins = |column: &Column| column.name.to_lowercase().starts_with(&start);
            layout.columns.iter().position(whole).or_else(|| layout.columns.iter().position(begins))
        }
    }
}

/// Returns the first free column with a usual name and a possible unit. If there is none, the unit alone decides.
fn guess(layout: &Layout, role: Role, taken: &BTreeMap<Role, usize>) -> Option<usize> {
    let free = || {
        let all = layout.columns.iter().enumerate();
        all.filter(|(place, column)| column.is_number && !taken.values().any(|other| other == place))
    };
    let may = |column: &Column| match column.unit.as_deref().and_then(unit::find) {
        Some((kind, _)) => unit::fits(role, kind) || kind == unit::Kind::Voltage,
        None => true,
    };
    if role == Role::Time
        && let Some((place, _)) = free().find(|(_, column)| column.is_clock)
    {
        return Some(place);
    }
    let rank = |column: &Column| {
        let name = column.name.to_lowercase();
        let parts: Vec<&str> =
            name.split(|c: char| !c.is_alphanumeric()).filter(|part| !part.is_empty()).collect();
        words(role).iter().position(|word| parts.contains(word))
    };
    let named =
        free().filter(|(_, column)| may(column)).filter_map(|(place, column)| Some((rank(column)?, place)));
    named.min().map(|(_, place)| place).or_else(|| {
        let fits = |column: &Column| {
            column.unit.as_deref().and_then(unit::find).is_some_and(|(kind, _)| unit::fits(role, kind))
        };
        // The unit alone does not identify a normal force. A measured value comes after its position.
        let mut fitting = free().filter(|(_, column)| role != Role::Normal && fits(column));
        let found = if role == Role::Value { fitting.next_back() } else { fitting.next() };
        found.map(|(place, _)| place)
    })
}

/// Assigns roles by position in tables without names and units.
///
/// In tables of three or more columns, an ascending column is the time. Displacement and force follow.
fn by_place(layout: &Layout, places: &mut BTreeMap<Role, usize>, wanted: &[Role]) {
    let is_silent = |column: &Column| column.is_number && column.unit.is_none();
    let free = |places: &BTreeMap<Role, usize>| -> Vec<usize> {
        let all = layout.columns.iter().enumerate().filter(|(_, column)| is_silent(column));
        all.map(|(place, _)| place).filter(|place| !places.values().any(|other| other == place)).collect()
    };
    if wanted.contains(&Role::Value) {
        for role in [Role::Time, Role::Position].into_iter().filter(|role| wanted.contains(role)) {
            let is_known = places.contains_key(&role) || role == Role::Time && layout.pace.is_some();
            let rising = free(places).into_iter().find(|place| layout.columns[*place].rises);
            if let Some(place) = rising.filter(|_| !is_known) {
                places.insert(role, place);
            }
        }
        if let Some(place) = free(places).first().copied().filter(|_| !places.contains_key(&Role::Value)) {
            places.insert(Role::Value, place);
        }
        return;
    }
    if !places.contains_key(&Role::Time)
        && layout.pace.is_none()
        && free(places).len() + places.len() > 2
        && let Some(place) = free(places).into_iter().find(|place| layout.columns[*place].rises)
    {
        places.insert(Role::Time, place);
    }
    for role in [Role::Displacement, Role::Force] {
        let has_no_name = |place: &usize| layout.columns[*place].name.is_empty();
        if !places.contains_key(&role)
            && let Some(place) = free(places).into_iter().find(has_no_name)
        {
            places.insert(role, place);
        }
    }
}

fn reading(
    file: &str,
    (role, place): (Role, usize),
    column: &Column,
    own: &ColumnRecipe,
) -> Result<Reading, RecordError> {
    let is_clock = own.unit.as_deref() == Some("clock") || own.unit.is_none() && column.is_clock;
    let said = own.unit.as_ref().or(column.unit.as_ref()).filter(|_| !is_clock);
    let factor = match said {
        None => Some(1.0),
        // A value may have any unit. An unknown unit counts as none.
        Some(unit) => unit::of_role(role, unit).or(Some(1.0).filter(|_| role == Role::Value)),
    };
    let refused = |unit: &String| RecordError::Unit {
        file: file.to_owned(),
        role,
        unit: unit.clone(),
        known: unit::symbols(role),
    };
    let factor = match (factor, said) {
        (Some(factor), _) => factor,
        // Brackets in a heading may contain something other than a unit.
        (None, Some(unit)) => return Err(refused(unit)),
        (None, None) => 1.0,
    };
    let (gain, offset) = (own.gain.unwrap_or(1.0), own.offset.unwrap_or(0.0));
    let unit =
        if is_clock { "clock".to_owned() } else { said.cloned().unwrap_or_else(|| role.si().to_owned()) };
    Ok(Reading { place, is_clock, gain, offset, factor, unit, is_assumed: said.is_none() && !is_clock })
}
