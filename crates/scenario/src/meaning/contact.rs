//! Contacts: pair of materials, profile, normal load and initial state.

use super::profile::profile;
use super::{Builder, names, range};
use crate::fault::Fault;
use crate::form::{ContactForm, ContactStartForm, EngineForm, FrictionForm, NormalForm};
use crate::named::MATERIALS;
use crate::path::At;
use crate::suggest;
use stickslip_contact::{Interface, Pair, Profile};
use stickslip_drive::scene::{Contact, ContactStart, EngineChoice, Named, Normal};

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
            let interface = Interface::new(pair, profile, two.at_rest)
                .map_err(|_| within(&at.key("static"), Interface::MAX_FRICTION))?;
            interface.with_kinetic_friction(two.kinetic).map_err(|_| {
                let fault = within(&at.key("kinetic"), two.at_rest);
                fault.help("the kinetic coefficient is at most the static one")
            })
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
        let pair = self.pair(&at.key("materials"), &form.materials.0)?;
        let profile = profile(&at.key("profile"), &form.profile, pair)?;
        let interface = interface(&at.key("friction"), &form.friction, pair, profile)?;
        let interface = interface.with_damping(form.damping.si);
        let normal = self.normal(&at.key("normal"), &form.normal)?;
        let start = contact_start(&form.start);
        let engine = self.engine(&at.key("engine"), &form.engine)?;
        let count = range::count_between(&at.key("count"), form.count.0, 1, MAX_COUNT)? as u32;
        let gap = gap(at, form)?;
        let at = self.points(at, &form.between, &form.at)?;
        Ok(Contact { between, at, interface, normal, gap, start, engine, count })
    }

    fn pair(&self, at: &At<'_>, names: &[String; 2]) -> Result<Pair, Fault> {
        let find = |i: usize| {
            let materials = &self.form.materials;
            let index = materials.find(&names[i]).ok_or_else(|| {
                let fault = names::unknown(&at.index(i), ("material", "materials"), &names[i], materials);
                let known = materials.names().chain(MATERIALS.iter().map(|material| material.name));
                fault.maybe_help(suggest::help(&names[i], known))
            })?;
            self.material(index)
        };
        Ok(Pair::new(find(0)?, find(1)?))
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

fn contact_start(form: &ContactStartForm) -> ContactStart {
    match form {
        ContactStartForm::Untouched => ContactStart::Untouched,
        ContactStartForm::Force(force) => ContactStart::Force(force.si),
        ContactStartForm::Displacement(u) => ContactStart::Displacement(u.si),
    }
}
