//! Materials and bodies.

use super::{Builder, range};
use crate::fault::Fault;
use crate::form::{BodyForm, BodyStartForm, FreedomForm, RunStartForm};
use crate::path::At;
use crate::units::Kind;
use stickslip_contact::{Material, MaterialError};
use stickslip_drive::scene::{Axis, Body, Coordinate, Freedom, Named, Start};

impl Builder<'_> {
    /// Checks all materials, including unused ones.
    pub(super) fn materials(&self) -> Result<(), Fault> {
        (0..self.form.materials.0.len()).try_for_each(|index| self.material(index).map(|_| ()))
    }

    pub(super) fn material(&self, index: usize) -> Result<Material, Fault> {
        let (name, form) = &self.form.materials.0[index];
        let root = At::ROOT;
        let at = root.key("materials");
        let at = at.key(name);
        Material::new(form.youngs_modulus.si, form.poisson_ratio).map_err(|error| match error {
            MaterialError::YoungsModulus(_) => {
                at.key("youngs_modulus").expected(range::above(Kind::Pressure))
            }
            MaterialError::PoissonRatio(_) => at
                .key("poisson_ratio")
                .expected("a number above -1 and up to 0.5")
                .help("typical: 0.2 to 0.35 for solids, 0.5 for rubber"),
            MaterialError::EffectiveModulus(_) => at.fault(error.to_string()),
        })
    }

    /// Adds all bodies in the order of the file.
    pub(super) fn bodies(&mut self) -> Result<(), Fault> {
        let form = self.form;
        let root = At::ROOT;
        let at = root.key("bodies");
        for (name, body) in form.bodies.iter() {
            let part = self.body_of(&at.key(name), body)?;
            self.scene.bodies.push(Named { name: name.to_owned(), part });
        }
        Ok(())
    }

    fn body_of(&mut self, at: &At<'_>, form: &BodyForm) -> Result<Body, Fault> {
        let mass = form.mass.map(|mass| range::above_zero(&at.key("mass"), mass)).transpose()?;
        let inertia = form.inertia.map(|it| range::above_zero(&at.key("inertia"), it)).transpose()?;
        let x = self.coordinate(at, Axis::X, form)?;
        let z = self.coordinate(at, Axis::Z, form)?;
        let pitch = self.coordinate(at, Axis::Pitch, form)?;
        Ok(Body { mass, inertia, x, z, pitch })
    }

    fn coordinate(&mut self, at: &At<'_>, axis: Axis, form: &BodyForm) -> Result<Coordinate, Fault> {
        let (freedom, kind) = match axis {
            Axis::X => (&form.x, Kind::Length),
            Axis::Z => (&form.z, Kind::Length),
            Axis::Pitch => (&form.pitch, Kind::Angle),
        };
        let freedom = match freedom {
            FreedomForm::Fixed => Freedom::Fixed,
            FreedomForm::Free => Freedom::Free,
            FreedomForm::Balanced => Freedom::Balanced,
            FreedomForm::Follows(waveform) => {
                Freedom::Follows(self.follow(&at.key(axis.key()), waveform, kind)?)
            }
        };
        let Some(start) = form.start else { return Ok(Coordinate { freedom, ..Coordinate::default() }) };
        let (position, velocity) = self.body_start(at, axis, freedom, start)?;
        Ok(Coordinate { freedom, position, velocity })
    }

    fn body_start(
        &self,
        body: &At<'_>,
        axis: Axis,
        freedom: Freedom,
        form: BodyStartForm,
    ) -> Result<(f64, f64), Fault> {
        let (rate, position, velocity) = match axis {
            Axis::X => ("vx", form.x.map(|x| x.si), form.vx.map(|v| v.si)),
            Axis::Z => ("vz", form.z.map(|z| z.si), form.vz.map(|v| v.si)),
            Axis::Pitch => ("vpitch", form.pitch.map(|p| p.si), form.vpitch.map(|v| v.si)),
        };
        let (at, key) = (body.key("start"), axis.key());
        let refused = |key: &str, message: &str| {
            let fault = at.key(key).fault(message).on_key();
            Err(fault.against_path(body.key(axis.key()).path()))
        };
        if position.is_some() && matches!(freedom, Freedom::Follows(_)) {
            return refused(key, &format!("{key} follows a waveform, which determines its start"));
        }
        if position.is_some() && freedom == Freedom::Balanced {
            return refused(key, &format!("{key} is balanced: forces determine its position"))
                .map_err(|fault| fault.help("remove it, or use a load at t = 0 that moves the body there"));
        }
        if position.is_some() && (axis, freedom) == (Axis::Pitch, Freedom::Fixed) {
            return refused(key, "pitch is fixed: the body does not rotate")
                .map_err(|fault| fault.help("make pitch \"free\", or give the rotated points"));
        }
        if velocity.is_some() && freedom != Freedom::Free {
            return refused(rate, "only a free coordinate has an initial velocity");
        }
        let settled = self.form.run.start == RunStartForm::Equilibrium && freedom == Freedom::Free;
        for (key, given) in [(key, position), (rate, velocity)] {
            if settled && given.is_some() {
                return refused(key, "run.start is \"equilibrium\", which determines the start")
                    .map_err(|fault: Fault| fault.against(["run.start"]).help("remove one of the two"));
            }
        }
        Ok((position.unwrap_or(0.0), velocity.unwrap_or(0.0)))
    }

    /// Sets the initial state: as given, or an equilibrium.
    pub(super) fn start(&mut self) -> Result<(), Fault> {
        self.scene.start = match self.form.run.start {
            RunStartForm::Given => Start::Given,
            RunStartForm::Equilibrium => Start::Equilibrium,
        };
        Ok(())
    }
}
