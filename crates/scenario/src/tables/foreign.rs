//! Reads tables of instruments, by a recipe or by automatic detection of the layout.

use super::head::Column;
use super::{Rows, Shelf, TableFile};
use crate::fault::Fault;
use crate::form::RecipeForm;
use crate::path::At;
use crate::units::Kind;
use stickslip_record::{self as record, Recipe, Record, RecordError, Role};

const KEYS: &str = "`stickslip schema recipe` prints the keys of a recipe";
const SHOWN: &str = "`stickslip import` shows how a file is read";

impl Shelf<'_> {
    /// Returns a recipe that is written in the scenario or in a file.
    pub(super) fn recipe(&mut self, at: &At<'_>, form: RecipeForm) -> Result<Recipe, Fault> {
        let at = at.key("recipe");
        match form {
            RecipeForm::Own(recipe) => serde_json::from_value(recipe.into())
                .map_err(|error| at.fault(format!("not a recipe: {error}")).help(KEYS)),
            RecipeForm::File(file) => {
                let bytes = self.read(&at, &file)?;
                let text = String::from_utf8_lossy(&bytes);
                Recipe::from_text(&text, &file).map_err(|error| at.fault(error.to_string()).help(KEYS))
            }
        }
    }

    /// Reads rows of a file by the columns named in the scenario, in the recipe or by the file.
    pub(super) fn foreign<const N: usize>(
        &mut self,
        at: &At<'_>,
        file: &str,
        recipe: Option<Recipe>,
        columns: &[(&str, Option<String>, Column); N],
    ) -> Result<Rows<N>, Fault> {
        let file_at = at.key("file");
        let bytes = self.read(&file_at, file)?;
        let is_said = recipe.is_some();
        let mut recipe = recipe.unwrap_or_default();
        let roles = std::array::from_fn::<Role, N, _>(|k| role(columns[k].0));
        // A recipe for a test rig names displacement or force; a waveform reads them as values.
        if roles.contains(&Role::Value) && !recipe.columns.contains_key(&Role::Value) {
            let other =
                [Role::Displacement, Role::Force].into_iter().find_map(|role| recipe.columns.remove(&role));
            recipe.columns.extend(other.map(|column| (Role::Value, column)));
        }
        for (role, (_, name, _)) in roles.iter().zip(columns) {
            if let Some(name) = name {
                recipe = recipe.with_column(*role, name);
            }
        }
        let read = Record::of(file, &bytes, &recipe, &roles);
        let mut record = match read {
            // Row numbers are no times if the file gives a start and an increment.
            Err(RecordError::Unit { role: Role::Time, .. })
                if recipe.columns.remove(&Role::Time).is_some() =>
            {
                Record::of(file, &bytes, &recipe, &roles)
            }
            read => read,
        }
        .map_err(|error| {
            let text = error.to_string();
            let (message, help) = text.split_once("\n   help: ").unwrap_or((&text, SHOWN));
            file_at.fault(message).help(help)
        })?;
        // For a plain table, the error of the plain reader is reported instead.
        let layout = &record.layout;
        let is_plain = layout.skip == 1 && layout.delimiter == ',' && layout.decimal == '.';
        if !is_said && (is_plain || record.passed.words + record.passed.missing > 0) {
            return Err(file_at.fault("has lines that are not rows of numbers"));
        }
        let mut kinds = [None; N];
        for (k, (key, _, column)) in columns.iter().enumerate() {
            kinds[k] = record.kind(roles[k]).map(kind);
            if let Column::Of(wanted) = column
                && kinds[k] != Some(*wanted)
            {
                let what = if *wanted == Kind::Force { "force" } else { "length" };
                let message = format!("the header of the column for \"{key}\" has no unit of a {what}");
                let help = "give the unit in the recipe, or after the name of the column, as in \"2:um\"";
                return Err(file_at.fault(message).help(help));
            }
        }
        let columns = roles.map(|role| record.columns.remove(&role).unwrap_or_default());
        let rows = (0..record.rows).map(|row| std::array::from_fn(|k| columns[k][row])).collect();
        // The numbers of such a file have no positions.
        self.document.tables.push(TableFile {
            path: at.path(),
            source: 0,
            list: "points",
            columns: Vec::new(),
        });
        Ok((rows, kinds))
    }
}

fn role(key: &str) -> Role {
    match key {
        "time" => Role::Time,
        "radius" | "position" => Role::Position,
        "indentation" => Role::Displacement,
        "force" => Role::Force,
        _ => Role::Value,
    }
}

fn kind(kind: record::Kind) -> Kind {
    match kind {
        record::Kind::Time => Kind::Time,
        record::Kind::Length => Kind::Length,
        record::Kind::Force | record::Kind::Mass => Kind::Force,
        record::Kind::Voltage => Kind::Voltage,
    }
}
