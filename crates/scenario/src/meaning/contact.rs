//! Contacts: pair, profile, what presses them and how they start.

use super::{Builder, range};
use crate::fault::Fault;
use crate::form::{ContactForm, ContactStartForm, EngineForm, Lengths, NormalForm, ProfileForm};
use crate::guide::Help;
use crate::path::At;
use crate::suggest;
use stickslip_contact::{Interface, Pair, Profile};
use stickslip_drive::scene::{Contact, ContactStart, EngineChoice, Named, Normal};

/// Most identical contacts, and most springs of a row.
const MAX_COUNT: u64 = 1_000_000;
/// Most springs of all rows together: some 40 bytes each.
pub(super) const MAX_SPRINGS: u64 = 10_000_000;

impl Builder<'_> {
    /// All contacts, in the order of the file.
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
        let profile = profile(&at.key("profile"), &form.profile)?;
        let friction_at = at.key("friction");
        let friction = range::number_between(&friction_at, form.friction, 0.0, Interface::MAX_FRICTION)
            .map_err(|fault| fault.help("the Coulomb coefficient of the pair; typical 0.05 to 0.6"))?;
        let interface = Interface::new(pair, profile.clone(), friction)
            .map_err(|error| friction_at.fault(error.to_string()))?;
        let normal = self.normal(&at.key("normal"), &form.normal, &form.profile)?;
        self.reach(&at.key("normal"), normal, &interface)?;
        let start = self.contact_start(&at.key("start"), &form.start, &interface, normal)?;
        let engine = self.engine(&at.key("engine"), &form.engine)?;
        let count = range::count_between(&at.key("count"), form.count.0, 1, MAX_COUNT)? as u32;
        let damping = range::at_least_zero(&at.key("damping"), form.damping)?;
        let gap = gap(at, form)?;
        let at = self.points(at, &form.between, &form.at)?;
        Ok(Contact { between, at, pair, profile, friction, normal, gap, damping, start, engine, count })
    }

    fn pair(&self, at: &At<'_>, names: &[String; 2]) -> Result<Pair, Fault> {
        let find = |i: usize| {
            let materials = &self.form.materials;
            let index = materials.find(&names[i]).ok_or_else(|| {
                let fault = at
                    .index(i)
                    .fault(format!("there is no material \"{}\"", crate::document::shown(&names[i])));
                fault.maybe_help(suggest::help(&names[i], materials.names()))
            })?;
            self.material(index)
        };
        Ok(Pair::new(find(0)?, find(1)?))
    }

    fn normal(&mut self, at: &At<'_>, form: &NormalForm, profile: &ProfileForm) -> Result<Normal, Fault> {
        match form {
            NormalForm::Force(force) => {
                self.varying_at_least_zero(&at.key("force"), force).map(Normal::Force)
            }
            NormalForm::Indentation(depth) => {
                self.varying(&at.key("indentation"), depth).map(Normal::Indentation)
            }
            NormalForm::Radius(radius) => {
                let at = at.key("radius");
                if matches!(profile, ProfileForm::Flat(_) | ProfileForm::Foundation(_)) {
                    let fault =
                        at.fault("the radius of this profile does not tell how deep it is pressed").on_key();
                    return Err(fault.help("give \"force\" or \"indentation\""));
                }
                self.varying_at_least_zero(&at, radius).map(Normal::Radius)
            }
            NormalForm::Coupled => Ok(Normal::Coupled),
        }
    }

    /// A sphere ends at its equator.
    fn reach(&self, at: &At<'_>, normal: Normal, interface: &Interface) -> Result<(), Fault> {
        let Some(reach) = interface.profile().reach() else { return Ok(()) };
        let (key, varying, most, unit) = match normal {
            Normal::Force(force) => ("force", force, interface.normal_force(reach), "N"),
            Normal::Indentation(depth) => ("indentation", depth, reach, "m"),
            Normal::Radius(radius) => ("radius", radius, interface.profile().radius(reach), "m"),
            // How deep the bodies press it is a matter of the whole scene.
            Normal::Coupled => return Ok(()),
        };
        let (_, high) = self.range(varying);
        if high < most {
            return Ok(());
        }
        let (most, high) = (range::short(most), range::short(high));
        let message = format!(
            "expected less than {most} {unit}, where the contact reaches the sphere's equator, got {high} {unit}"
        );
        Err(at.key(key).fault(message).help("half-spaces touch in circles much smaller than the sphere"))
    }

    fn contact_start(
        &self,
        at: &At<'_>,
        form: &ContactStartForm,
        interface: &Interface,
        normal: Normal,
    ) -> Result<ContactStart, Fault> {
        let force = match form {
            ContactStartForm::Untouched => return Ok(ContactStart::Untouched),
            ContactStartForm::Displacement(u) => return Ok(ContactStart::Displacement(u.si)),
            ContactStartForm::Force(force) => force.si,
        };
        let Some(normal) = self.normal_force_at_start(normal, interface) else {
            return Ok(ContactStart::Force(force));
        };
        let limit = interface.friction() * normal;
        if force.abs() < limit || force == 0.0 {
            return Ok(ContactStart::Force(force));
        }
        let at = at.key("force");
        let fault = at.expected(format_args!("a force below μF_N = {} N in magnitude", range::short(limit)));
        Err(fault
            .help("at μF_N the contact slips; this is the force of one contact, whatever \"count\" says"))
    }

    /// None where the whole scene decides.
    fn normal_force_at_start(&self, normal: Normal, interface: &Interface) -> Option<f64> {
        let depth = match normal {
            Normal::Force(force) => return Some(self.at_start(force)),
            Normal::Indentation(depth) => self.at_start(depth),
            Normal::Radius(radius) => interface.profile().depth(self.at_start(radius)),
            Normal::Coupled => return None,
        };
        Some(interface.normal_force(depth))
    }

    fn engine(&mut self, at: &At<'_>, form: &EngineForm) -> Result<EngineChoice, Fault> {
        let EngineForm::Springs(springs) = form else { return Ok(EngineChoice::Curve) };
        let at = at.key("springs");
        let count = range::count_between(&at.key("count"), springs.count.0, 1, MAX_COUNT)?;
        self.springs += count;
        if self.springs > MAX_SPRINGS {
            let message = format!("expected at most {MAX_SPRINGS} springs in all rows, got {}", self.springs);
            return Err(at.key("count").fault(message));
        }
        let span = springs.span.map(|span| range::above_zero(&at.key("span"), span)).transpose()?;
        Ok(EngineChoice::Springs { count: count as usize, span })
    }
}

/// The gap in the position drawn; only bodies that move along the normal can open or close one.
fn gap(at: &At<'_>, form: &ContactForm) -> Result<f64, Fault> {
    match (&form.normal, form.gap) {
        (NormalForm::Coupled, gap) => Ok(gap.map_or(0.0, |gap| gap.si)),
        (_, None) => Ok(0.0),
        (_, Some(_)) => {
            let message =
                "only a contact whose normal is \"coupled\" has a gap: here the indentation is given";
            Err(at.key("gap").fault(message).on_key().help("remove it, or make \"normal\" \"coupled\""))
        }
    }
}

fn profile(at: &At<'_>, form: &ProfileForm) -> Result<Profile, Fault> {
    let (key, profile) = match form {
        ProfileForm::Flat(flat) => {
            ("flat", Profile::flat(range::above_zero(&at.key("flat").key("radius"), flat.radius)?))
        }
        ProfileForm::Cone(cone) => {
            ("cone", Profile::cone(range::number_above_zero(&at.key("cone").key("slope"), cone.slope)?))
        }
        ProfileForm::Paraboloid(form) => (
            "paraboloid",
            Profile::paraboloid(range::above_zero(&at.key("paraboloid").key("radius"), form.radius)?),
        ),
        ProfileForm::Sphere(sphere) => {
            ("sphere", Profile::sphere(range::above_zero(&at.key("sphere").key("radius"), sphere.radius)?))
        }
        ProfileForm::Power(power) => {
            let at = at.key("power");
            let coefficient = range::number_above_zero(&at.key("coefficient"), power.coefficient)?;
            (
                "power",
                Profile::power(coefficient, range::number_above_zero(&at.key("exponent"), power.exponent)?),
            )
        }
        ProfileForm::Foundation(form) => {
            return foundation(&at.key("foundation"), &form.heights, &form.length);
        }
        ProfileForm::Table(_) => return Err(at.key("table").not_yet()),
        ProfileForm::Rough(_) => return Err(at.key("rough").not_yet()),
    };
    profile.map_err(|error| at.key(key).fault(error.to_string()))
}

fn foundation(at: &At<'_>, heights: &[crate::quantity::Length], length: &Lengths) -> Result<Profile, Fault> {
    let heights_at = at.key("heights");
    if heights.is_empty() {
        return Err(heights_at.fault("expected at least one height").ask(Help::Shape));
    }
    let mut levels = Vec::with_capacity(heights.len());
    for (i, height) in heights.iter().enumerate() {
        levels.push(range::at_least_zero(&heights_at.index(i), *height)?);
    }
    let length_at = at.key("length");
    let lengths = match length {
        Lengths::All(length) => vec![range::above_zero(&length_at, *length)?; heights.len()],
        Lengths::Each(lengths) if lengths.len() != heights.len() => {
            let message = format!(
                "expected one length for each of the {} heights, got {}",
                heights.len(),
                lengths.len()
            );
            return Err(length_at.fault(message).help("or one length for all, without brackets"));
        }
        Lengths::Each(lengths) => {
            let each = lengths.iter().enumerate();
            each.map(|(i, length)| range::above_zero(&length_at.index(i), *length))
                .collect::<Result<_, _>>()?
        }
    };
    Profile::foundation(&levels, &lengths).map_err(|error| at.fault(error.to_string()))
}
