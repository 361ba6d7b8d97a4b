//! Reads profiles whose points or heights are in a file.

use super::head::Column;
use super::heights;
use super::{Shelf, given_twice, no_columns};
use crate::fault::{Fault, Mend};
use crate::form::{
    GapPoint, GapTableForm, LawPoint, LevelForm, NormalLawForm, ProfileForm, RecipeForm, RoughForm,
};
use crate::path::At;
use crate::quantity::{Force, Length};
use crate::units::Kind;

impl Shelf<'_> {
    pub(super) fn in_profile(&mut self, at: &At<'_>, profile: &mut ProfileForm) -> Result<(), Fault> {
        match profile {
            ProfileForm::Table(table) => self.in_table(&at.key("table"), table),
            ProfileForm::NormalLaw(law) => self.in_law(&at.key("normal_law"), law),
            ProfileForm::Rough(line) => self.in_line(&at.key("rough"), line),
            _ => Ok(()),
        }
    }

    fn in_table(&mut self, at: &At<'_>, table: &mut GapTableForm) -> Result<(), Fault> {
        let (radius, gap, recipe) = (table.radius.take(), table.gap.take(), table.recipe.take());
        let Some(file) = table.file.take() else {
            return no_columns(at, &[("radius", radius), ("gap", gap)], recipe.as_ref());
        };
        if table.points.is_some() {
            return Err(given_twice(at));
        }
        let length = Column::Of(Kind::Length);
        let (rows, _) =
            self.rows(at, (&file, recipe), "points", &[("radius", radius, length), ("gap", gap, length)])?;
        let points = rows.into_iter().map(|[r, f]| GapPoint(Length::new(r), Length::new(f)));
        table.points = Some(points.collect());
        Ok(())
    }

    fn in_law(&mut self, at: &At<'_>, law: &mut NormalLawForm) -> Result<(), Fault> {
        let (indentation, force, recipe) = (law.indentation.take(), law.force.take(), law.recipe.take());
        let Some(file) = law.file.take() else {
            return no_columns(at, &[("indentation", indentation), ("force", force)], recipe.as_ref());
        };
        if law.points.is_some() {
            return Err(given_twice(at));
        }
        let indentation = ("indentation", indentation, Column::Of(Kind::Length));
        let force = ("force", force, Column::Of(Kind::Force));
        let (rows, _) = self.rows(at, (&file, recipe), "points", &[indentation, force])?;
        let points = rows.into_iter().map(|[d, force]| LawPoint(Length::new(d), Force::new(force)));
        law.points = Some(points.collect());
        Ok(())
    }

    fn in_line(&mut self, at: &At<'_>, line: &mut RoughForm) -> Result<(), Fault> {
        let (height, recipe) = (line.height.take(), line.recipe.take());
        if let Some(file) = line.file.take() {
            if line.heights.is_some() || line.self_affine.is_some() {
                let fault = at.key("file").fault("the heights are already given").on_key();
                return Err(fault.mend(Mend::Around(at.path())).help("keep one of them"));
            }
            let height = ("height", height, Column::Of(Kind::Length));
            let heights: Vec<f64> = if line.spacing.is_some() {
                let (rows, _) = self.rows(at, (&file, recipe), "heights", &[height])?;
                rows.into_iter().map(|[z]| z).collect()
            } else {
                let position = ("position", None, Column::Of(Kind::Length));
                let recipe = Some(recipe.unwrap_or_else(|| RecipeForm::Own(serde_json::Map::new())));
                let (rows, _) = self.rows(at, (&file, recipe), "heights", &[position, height])?;
                let (spacing, heights) = heights::even(&rows).ok_or_else(|| {
                    let fault = at.key("file").fault("the positions of the line do not ascend");
                    fault.help("give the spacing of the heights, or the column of their positions as \"position\" in the recipe")
                })?;
                line.spacing = Some(Length::new(spacing));
                heights
            };
            line.heights = Some(heights.into_iter().map(Length::new).collect());
        } else {
            no_columns(at, &[("height", height)], recipe.as_ref())?;
        }
        if let (Some(list), Some(spacing)) = (&mut line.heights, line.spacing) {
            let mut heights: Vec<f64> = list.iter().map(|height| height.si).collect();
            if let Some([from, to]) = line.within.take() {
                let part = heights::within(&heights, spacing.si, [from.si, to.si]);
                heights = part.ok_or_else(|| {
                    at.key("within").fault("fewer than three heights lie between these positions")
                })?;
            }
            if let Some(level) = line.level.take() {
                heights::level(&mut heights, if level == LevelForm::Line { 1 } else { 2 });
            }
            *list = heights.into_iter().map(Length::new).collect();
        }
        Ok(())
    }
}
