//! Contacts: pair of materials, profile, normal load and initial state.

use super::profile::profile;
use super::{Builder, names, range};
use crate::fault::Fault;
use crate::form::{
    ContactForm, ContactStartForm, DampingForm, EngineForm, FrictionForm, GrowthForm, NormalForm, StaticForm,
};
use crate::named::MATERIALS;
use crate::path::At;
use crate::suggest;
use stickslip_contact::{Growth, Interface, Material, Pair, Profile};
use stickslip_drive::scene::{Contact, ContactStart, EngineChoice, Named, Normal, NormalDamping};

/// Maximum number of identical contacts, and of springs of a row.
const MAX_COUNT: u64 = 1_000_000;
/// Maximum number of springs of all rows together, each about 40 bytes.
pub(super) const MAX_SPRINGS: u64 = 10_000_000;

/// Returns an interface with one or two friction coefficients.
fn interface(at: &At<'_>, form: &FrictionForm, pair: Pair, profile: Profile) -> Result<Interface, Fault> {
    let within = |at: &At<'_>, most: f64| at.expected(format_args!("a number between 0 and {most}"));
    match form {
        FrictionForm::One(friction) => Interface::new(pair, profile, *friction).map_err(|_| {
            let fault = within(at, Interface::MAX_FRICTION);
            fault.help("the Coulomb coefficient of the pair; typical 0.05 to 0.6")
        }),
        FrictionForm::Two(two) => {
            let at_rest = at.key("static");
            let own = |at: &At<'_>, value: f64| {
                Interface::new(pair, profile.clone(), value).map_err(|_| within(at, Interface::MAX_FRICTION))
            };
            let interface = match &two.at_rest {
                StaticForm::One(value) => own(&at_rest, *value)?,
                StaticForm::Growth(form) => {
                    let interface = own(&at_rest.key("from"), form.from)?;
                    let growth = growth(&at_rest, form)?;
                    interface.with_growth(growth).map_err(|fault| at_rest.fault(fault.to_string()))?
                }
            };
            let most = interface.friction();
            interface.with_kinetic_friction(two.kinetic).map_err(|_| {
                let fault = within(&at.key("kinetic"), most);
                fault.help("the kinetic coefficient is at most the static one")
            })
        }
    }
}

/// Returns the growth of a static friction coefficient at rest.
fn growth(at: &At<'_>, form: &GrowthForm) -> Result<Growth, Fault> {
    let time = range::above_zero(&at.key("time"), form.time)?;
    let most = Interface::MAX_FRICTION;
    let within = |key: &str, least: f64, value: f64| match (least..=most).contains(&value) {
        true => Ok(value),
        false => Err(at.key(key).expected(format_args!("a number between {least} and {most}"))),
    };
    match (form.to, form.per_e_fold) {
        (Some(to), None) => Ok(Growth::Exponential { rise: within("to", form.from, to)? - form.from, time }),
        (None, Some(rise)) => Ok(Growth::Logarithmic { rise: within("per_e_fold", 0.0, rise)?, time }),
        _ => {
            let fault = at.fault("expected either \"to\" or \"per_e_fold\" beside \"from\" and \"time\"");
            Err(fault.help("\"to\" is the coefficient after a long rest, \"per_e_fold\" a growth with the logarithm of time"))
        }
    }
}

impl Builder<'_> {
    /// Adds all contacts in the order of the file.
    pub(super) fn contacts(&mut self) -> Result<(), Fault> {
        let form = self.form;
        let root = At::ROOT;
        let at = root.key("contacts");
        for (name, contact) in form.contacts.iter() {
            let part = self.contact(&at.key(name), contact)?;
            self.scene.contacts.push(Named { name: name.to_owned(), part });
        }
        Ok(())
    }

    fn contact(&mut self, at: &At<'_>, form: &ContactForm) -> Result<Contact, Fault> {
        let between = self.between(at, &form.between)?;
        let materials = self.materials_of(&at.key("materials"), &form.materials.0)?;
        let profile = profile(&at.key("profile"), &form.profile, (materials, &form.normal))?;
        let pair = Pair::new(materials[0], materials[1]);
        let interface = interface(&at.key("friction"), &form.friction, pair, profile)?;
        let (tangential, normal_damping) = damping(&at.key("damping"), &form.damping)?;
        let interface = interface.with_damping(tangential);
        let normal = self.normal(&at.key("normal"), &form.normal)?;
        let start = contact_start(&at.key("start"), &form.start)?;
        let engine = self.engine(&at.key("engine"), &form.engine)?;
        let count = range::count_between(&at.key("count"), form.count.0, 1, MAX_COUNT)? as u32;
        let gap = gap(at, form)?;
        let at = self.points(at, &form.between, &form.at)?;
        Ok(Contact { between, at, interface, normal, gap, normal_damping, start, engine, count })
    }

    fn materials_of(&self, at: &At<'_>, names: &[String; 2]) -> Result<[Material; 2], Fault> {
        let find = |i: usize| {
            let materials = &self.form.materials;
            let index = materials.find(&names[i]).ok_or_else(|| {
                let fault = names::unknown(&at.index(i), ("material", "materials"), &names[i], materials);
                let known = materials.names().chain(MATERIALS.iter().map(|material| material.name));
                fault.maybe_help(suggest::help(&names[i], known))
            })?;
            self.material(index)
        };
        Ok([find(0)?, find(1)?])
    }

    fn normal(&mut self, at: &At<'_>, form: &NormalForm) -> Result<Normal, Fault> {
        match form {
            NormalForm::Force(force) => self.varying(&at.key("force"), force).map(Normal::Force),
            NormalForm::Indentation(depth) => {
                self.varying(&at.key("indentation"), depth).map(Normal::Indentation)
            }
            NormalForm::Radius(radius) => self.varying(&at.key("radius"), radius).map(Normal::Radius),
            NormalForm::Coupled => Ok(Normal::Coupled),
        }
    }

    fn engine(&mut self, at: &At<'_>, form: &EngineForm) -> Result<EngineChoice, Fault> {
        let EngineForm::Springs(springs) = form else { return Ok(EngineChoice::Curve) };
        let at = at.key("springs");
        let count = range::count_between(&at.key("count"), springs.count.0, 1, MAX_COUNT)?;
        self.springs += count;
        if self.springs > MAX_SPRINGS {
            let message = format!("expected at most {MAX_SPRINGS} springs in all rows, got {}", self.springs);
            return Err(at.key("count").fault(message).against_all());
        }
        let span = springs.span.map(|span| range::above_zero(&at.key("span"), span)).transpose()?;
        Ok(EngineChoice::Springs { count: count as usize, span })
    }
}

/// Returns the initial gap. Only contacts with coupled normal motion have one.
fn gap(at: &At<'_>, form: &ContactForm) -> Result<f64, Fault> {
    match (&form.normal, form.gap) {
        (NormalForm::Coupled, gap) => Ok(gap.map_or(0.0, |gap| gap.si)),
        (_, None) => Ok(0.0),
        (_, Some(_)) => {
            let message =
                "only a contact with \"normal\": \"coupled\" has a gap; here the indentation is prescribed";
            let fault = at.key("gap").fault(message).on_key().against_path(at.key("normal").path());
            Err(fault.help("remove it, or make \"normal\" \"coupled\""))
        }
    }
}

/// Returns the damping time of the tangential springs, s, and the damping along the normal.
fn damping(at: &At<'_>, form: &DampingForm) -> Result<(f64, NormalDamping), Fault> {
    let form = match form {
        DampingForm::Tangential(time) => return Ok((time.si, NormalDamping::None)),
        DampingForm::Both(form) => form,
    };
    let tangential = range::at_least_zero(&at.key("tangential"), form.tangential)?;
    let normal = match (form.normal, form.restitution, form.at) {
        (None, None, None) => NormalDamping::None,
        (Some(time), None, None) => NormalDamping::Time(range::at_least_zero(&at.key("normal"), time)?),
        (None, Some(coefficient), Some(speed)) => {
            if !(coefficient > 0.0 && coefficient <= 1.0) {
                let fault = at.key("restitution").expected("a number above 0, at most 1");
                return Err(fault.help("the speed after an impact divided by the speed before; 1 is no loss"));
            }
            let speed = range::above_zero(&at.key("at"), speed)?;
            NormalDamping::Restitution { coefficient, speed }
        }
        (Some(_), ..) => {
            let fault = at.fault("expected either \"normal\" or \"restitution\" and \"at\"");
            return Err(
                fault.help("a coefficient of restitution determines the damping time along the normal")
            );
        }
        (None, ..) => {
            let fault = at.fault("expected \"restitution\" and \"at\" together");
            return Err(fault.help("the coefficient of restitution depends on the speed \"at\" of the impact, such as \"0.1 m/s\""));
        }
    };
    Ok((tangential, normal))
}

fn contact_start(at: &At<'_>, form: &ContactStartForm) -> Result<ContactStart, Fault> {
    Ok(match form {
        ContactStartForm::Untouched => ContactStart::Untouched,
        ContactStartForm::Force(force) => ContactStart::Force(force.si),
        ContactStartForm::Displacement(u) => ContactStart::Displacement(u.si),
        ContactStartForm::Rest(time) => ContactStart::Rest(range::at_least_zero(&at.key("rest"), *time)?),
    })
}
