//! Materials and bodies.

use super::{Builder, range};
use crate::fault::Fault;
use crate::form::{BodyForm, BodyStartForm, FreedomForm, RunStartForm};
use crate::path::At;
use crate::units::Kind;
use stickslip_contact::Material;
use stickslip_drive::scene::{Body, Freedom, Named, Start};

impl Builder<'_> {
    /// Checks all materials, also those that nothing uses.
    pub(super) fn materials(&self) -> Result<(), Fault> {
        (0..self.form.materials.0.len()).try_for_each(|index| self.material(index).map(|_| ()))
    }

    pub(super) fn material(&self, index: usize) -> Result<Material, Fault> {
        let (name, form) = &self.form.materials.0[index];
        let root = At::ROOT;
        let at = root.key("materials");
        let at = at.key(name);
        let modulus = range::above_zero(&at.key("youngs_modulus"), form.youngs_modulus)?;
        let ratio = form.poisson_ratio;
        if !(ratio > -1.0 && ratio <= 0.5) {
            let fault = at.key("poisson_ratio").expected("a number above -1 and up to 0.5");
            return Err(fault.help("0.2 to 0.35 for most solids, 0.5 for rubber"));
        }
        Material::new(modulus, ratio).map_err(|error| at.fault(error.to_string()))
    }

    /// All bodies, in the order of the file.
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
        for (key, freedom) in [("z", &form.z), ("pitch", &form.pitch)] {
            if !freedom.is_fixed() {
                return Err(at.key(key).not_yet().help("leave it out: fixed"));
            }
        }
        if form.inertia.is_some() {
            return Err(at.key("inertia").not_yet().help("leave it out: no body rotates"));
        }
        let mass = form.mass.map(|mass| range::above_zero(&at.key("mass"), mass)).transpose()?;
        let x = match &form.x {
            FreedomForm::Fixed => Freedom::Fixed,
            FreedomForm::Free if mass.is_none() => {
                return Err(at.missing("mass").help("x is free: a body that obeys Newton needs a mass"));
            }
            FreedomForm::Free => Freedom::Free,
            FreedomForm::Follows(waveform) => {
                Freedom::Follows(self.follow(&at.key("x"), waveform, Kind::Length)?)
            }
        };
        let (start_x, start_vx) = match &form.start {
            Some(start) => self.body_start(&at.key("start"), x, start)?,
            None => (0.0, 0.0),
        };
        Ok(Body { mass, x, start_x, start_vx })
    }

    fn body_start(&self, at: &At<'_>, x: Freedom, form: &BodyStartForm) -> Result<(f64, f64), Fault> {
        let later = [("z", form.z), ("vz", form.vz), ("pitch", form.pitch), ("vpitch", form.vpitch)];
        if let Some((key, _)) = later.iter().find(|(_, value)| value.is_some()) {
            return Err(at.key(key).not_yet());
        }
        if let (Freedom::Follows(_), Some(_)) = (x, form.x) {
            return Err(at.key("x").fault("x follows a waveform, which says where it starts").on_key());
        }
        if x != Freedom::Free && form.vx.is_some() {
            return Err(at
                .key("vx")
                .fault("only a free coordinate has a velocity of its own at the start")
                .on_key());
        }
        let settled = self.form.run.start == RunStartForm::Equilibrium && x == Freedom::Free;
        for (key, given) in [("x", form.x.is_some()), ("vx", form.vx.is_some())] {
            if settled && given {
                let fault = at.key(key).fault("run.start is \"equilibrium\", which says where it starts");
                return Err(fault.on_key().help("remove one of the two"));
            }
        }
        Ok((form.x.map_or(0.0, |x| x.si), form.vx.map_or(0.0, |vx| vx.si)))
    }

    /// How the free coordinates start.
    pub(super) fn start(&mut self) -> Result<(), Fault> {
        self.scene.start = match self.form.run.start {
            RunStartForm::Given => Start::Given,
            RunStartForm::Equilibrium => Start::Equilibrium,
        };
        Ok(())
    }
}
