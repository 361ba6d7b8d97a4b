//! Profiles whose points or heights lie in a file.

use super::head::Column;
use super::{Shelf, given_twice, no_columns};
use crate::fault::{Fault, Mend};
use crate::form::{GapPoint, GapTableForm, LawPoint, NormalLawForm, ProfileForm, RoughForm};
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
        let (radius, gap) = (table.radius.take(), table.gap.take());
        let Some(file) = table.file.take() else {
            return no_columns(at, &[("radius", radius), ("gap", gap)]);
        };
        if table.points.is_some() {
            return Err(given_twice(at));
        }
        let length = Column::Of(Kind::Length);
        let (rows, _) =
            self.rows(at, &file, "points", &[("radius", radius, length), ("gap", gap, length)])?;
        let points = rows.into_iter().map(|[r, f]| GapPoint(Length::new(r), Length::new(f)));
        table.points = Some(points.collect());
        Ok(())
    }

    fn in_law(&mut self, at: &At<'_>, law: &mut NormalLawForm) -> Result<(), Fault> {
        let (indentation, force) = (law.indentation.take(), law.force.take());
        let Some(file) = law.file.take() else {
            return no_columns(at, &[("indentation", indentation), ("force", force)]);
        };
        if law.points.is_some() {
            return Err(given_twice(at));
        }
        let indentation = ("indentation", indentation, Column::Of(Kind::Length));
        let force = ("force", force, Column::Of(Kind::Force));
        let (rows, _) = self.rows(at, &file, "points", &[indentation, force])?;
        let points = rows.into_iter().map(|[d, force]| LawPoint(Length::new(d), Force::new(force)));
        law.points = Some(points.collect());
        Ok(())
    }

    fn in_line(&mut self, at: &At<'_>, line: &mut RoughForm) -> Result<(), Fault> {
        let height = line.height.take();
        let Some(file) = line.file.take() else {
            return no_columns(at, &[("height", height)]);
        };
        if line.heights.is_some() || line.self_affine.is_some() {
            let fault = at.key("file").fault("the heights are given already").on_key();
            return Err(fault.mend(Mend::Around(at.path())).help("keep one of them"));
        }
        let height = ("height", height, Column::Of(Kind::Length));
        let (rows, _) = self.rows(at, &file, "heights", &[height])?;
        line.heights = Some(rows.into_iter().map(|[z]| Length::new(z)).collect());
        Ok(())
    }
}
