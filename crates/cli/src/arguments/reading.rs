//! How a table of an instrument is read.

use clap::Args;
use std::path::PathBuf;
use stickslip_record::{Named, Recipe, RecordError};

#[derive(Debug, Clone, Args)]
pub(crate) struct ReadingArguments {
    /// Recipe of the file, as written by `stickslip import`
    #[arg(long, value_name = "FILE")]
    recipe: Option<PathBuf>,
    /// Column of the times: name or number, with a unit after a colon, such as 1:ms
    #[arg(long, value_name = "COLUMN")]
    time: Option<String>,
    /// Column of the displacements, such as 2:um
    #[arg(long, value_name = "COLUMN")]
    displacement: Option<String>,
    /// Column of the tangential forces
    #[arg(long, value_name = "COLUMN")]
    force: Option<String>,
    /// Column of the normal forces
    #[arg(long, value_name = "COLUMN")]
    normal: Option<String>,
}

impl ReadingArguments {
    /// The recipe, with the columns that are named.
    pub(crate) fn recipe(&self) -> Result<Recipe, RecordError> {
        let recipe = self.recipe.as_deref().map_or_else(|| Ok(Recipe::default()), Recipe::load)?;
        let Self { time, displacement, force, normal, .. } = self;
        let named = Named {
            time: time.clone(),
            displacement: displacement.clone(),
            force: force.clone(),
            normal: normal.clone(),
        };
        Ok(recipe.with(&named))
    }

    /// The recipe, and the channels of a run that the displacement and the force are: `COLUMN=CHANNEL`, of which the column may be left out.
    pub(crate) fn meeting(&self) -> Result<(Recipe, [Option<String>; 2]), RecordError> {
        let parted = |text: &Option<String>| match text.as_deref().and_then(|text| text.rsplit_once('=')) {
            Some((column, channel)) => {
                (Some(column.to_owned()).filter(|column| !column.is_empty()), Some(channel.to_owned()))
            }
            None => (text.clone(), None),
        };
        let ((displacement, first), (force, second)) = (parted(&self.displacement), parted(&self.force));
        let own = Self { displacement, force, ..self.clone() };
        Ok((own.recipe()?, [first, second]))
    }
}
