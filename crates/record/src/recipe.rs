//! Recipe for reading a table. Settings that it omits are detected from the file.

use crate::error::RecordError;
use crate::unit;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::Path;

/// How a table of an instrument is read. Keys that are left out are guessed from the beginning of the file.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Recipe {
    /// Encoding of the text
    #[serde(skip_serializing_if = "Option::is_none")]
    pub encoding: Option<Encoding>,
    /// Number of lines before the first row of numbers
    #[serde(skip_serializing_if = "Option::is_none")]
    pub skip: Option<usize>,
    /// Sign between two fields; " " stands for any number of blanks and tabs
    #[serde(skip_serializing_if = "Option::is_none")]
    pub delimiter: Option<char>,
    /// Decimal sign
    #[serde(skip_serializing_if = "Option::is_none")]
    pub decimal: Option<char>,
    /// Sign between groups of three digits
    #[serde(skip_serializing_if = "Option::is_none")]
    pub thousands: Option<char>,
    /// Lines that begin with this are passed over
    #[serde(skip_serializing_if = "Option::is_none")]
    pub comment: Option<String>,
    /// Words that stand for a missing value, beside empty fields, NaN, --- and the like
    #[serde(skip_serializing_if = "Option::is_none")]
    pub missing: Option<Vec<String>>,
    /// Time of the first row, s, where rows have no times
    #[serde(skip_serializing_if = "Option::is_none")]
    pub start: Option<f64>,
    /// Time from row to row, s, where rows have no times
    #[serde(skip_serializing_if = "Option::is_none")]
    pub increment: Option<f64>,
    /// What the columns are
    #[serde(skip_serializing_if = "BTreeMap::is_empty", default)]
    pub columns: BTreeMap<Role, ColumnRecipe>,
}

/// Encoding of a text.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum Encoding {
    /// UTF-8.
    #[serde(rename = "utf-8")]
    Utf8,
    /// UTF-16, of either order of bytes.
    #[serde(rename = "utf-16")]
    Utf16,
    /// Latin-1, as Windows has it.
    #[serde(rename = "latin-1")]
    Latin1,
}

/// What a column is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Role {
    /// Times.
    Time,
    /// Displacements.
    Displacement,
    /// Tangential forces.
    Force,
    /// Normal forces.
    Normal,
    /// Values of a waveform, or heights and gaps of a profile, in whatever unit.
    Value,
    /// Places along a profile.
    Position,
}

/// Which column it is, and what its numbers are: gain × cell + offset, in the unit.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ColumnRecipe {
    /// Number of the column, from 1, or its name
    #[serde(skip_serializing_if = "Option::is_none")]
    pub column: Option<Place>,
    /// Unit of its numbers; times also "clock"
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unit: Option<String>,
    /// Factor, 1 by default
    #[serde(skip_serializing_if = "Option::is_none")]
    pub gain: Option<f64>,
    /// What is added, 0 by default
    #[serde(skip_serializing_if = "Option::is_none")]
    pub offset: Option<f64>,
}

/// A column by its number, from 1, or by its name.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum Place {
    /// Its number.
    Number(usize),
    /// Its name.
    Name(String),
}

/// Columns selected by the user. Each text is a name or a number with an optional unit after a colon, such as `3:mm`.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Named {
    /// Column of the times.
    pub time: Option<String>,
    /// Column of the displacements.
    pub displacement: Option<String>,
    /// Column of the tangential forces.
    pub force: Option<String>,
    /// Column of the normal forces.
    pub normal: Option<String>,
}

impl Role {
    /// Roles of a measured loop.
    pub const ALL: [Self; 4] = [Self::Time, Self::Displacement, Self::Force, Self::Normal];

    /// Returns the name of the role.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Time => "time",
            Self::Displacement => "displacement",
            Self::Force => "force",
            Self::Normal => "normal",
            Self::Value => "value",
            Self::Position => "position",
        }
    }

    /// Returns the SI unit of the role; empty if it has none.
    #[must_use]
    pub fn si(self) -> &'static str {
        match self {
            Self::Time => "s",
            Self::Displacement | Self::Position => "m",
            Self::Value => "",
            Self::Force | Self::Normal => "N",
        }
    }
}

/// Returns the JSON Schema of recipes, version 1. A copy is in `schema/recipe-1.json`.
#[must_use]
pub fn recipe_schema() -> String {
    let schema =
        schemars::generate::SchemaSettings::draft2020_12().into_generator().into_root_schema_for::<Recipe>();
    // Serialisation of a schema cannot fail.
    serde_json::to_string_pretty(&schema).unwrap_or_default() + "\n"
}

impl Recipe {
    /// Reads a recipe from a file.
    ///
    /// # Errors
    /// The file cannot be read or is not a valid recipe.
    pub fn load(path: &Path) -> Result<Self, RecordError> {
        let failed = |why: String| RecordError::Recipe { file: path.display().to_string(), why };
        let text = std::fs::read_to_string(path).map_err(|error| failed(error.to_string()))?;
        Self::from_text(&text, &path.display().to_string())
    }

    /// Reads a recipe from a text. `name` is the name of the file for errors.
    ///
    /// # Errors
    /// The text is not a valid recipe.
    pub fn from_text(text: &str, name: &str) -> Result<Self, RecordError> {
        serde_json::from_str(text)
            .map_err(|error| RecordError::Recipe { file: name.to_owned(), why: error.to_string() })
    }

    /// Sets the column of a role. `text` is a number or a name with an optional unit after a colon.
    #[must_use]
    pub fn with_column(mut self, role: Role, text: &str) -> Self {
        let (column, unit) = match text.rsplit_once(':') {
            Some((column, unit)) if unit == "clock" || unit::find(unit).is_some() => (column, Some(unit)),
            _ => (text, None),
        };
        let own = self.columns.entry(role).or_default();
        own.column = Some(column.parse().map_or_else(|_| Place::Name(column.to_owned()), Place::Number));
        if unit.is_some() {
            own.unit = unit.map(str::to_owned);
        }
        self
    }

    /// Sets the columns selected by the user. They override the recipe.
    #[must_use]
    pub fn with(mut self, named: &Named) -> Self {
        let all = [&named.time, &named.displacement, &named.force, &named.normal];
        for (role, text) in Role::ALL.into_iter().zip(all) {
            if let Some(text) = text {
                self = self.with_column(role, text);
            }
        }
        self
    }
}
