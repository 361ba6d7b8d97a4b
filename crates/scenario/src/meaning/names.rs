//! Names of parts and references to them.

use super::Builder;
use crate::document::shown;
use crate::fault::{Fault, Mend};
use crate::form::{Form, Parts, Two};
use crate::path::At;
use crate::suggest;
use stickslip_drive::scene::Side;

/// Name of the fixed ground.
pub(super) const GROUND: &str = "ground";
/// Maximum length of a name, characters. Names occur in column headers and legends.
const MAX_LENGTH: usize = 64;
/// Maximum number of parts of one kind.
const MAX_PARTS: usize = 10_000;

/// Checks the names of all parts.
pub(super) fn check(form: &Form) -> Result<(), Fault> {
    let root = At::ROOT;
    check_part(&root.key("materials"), &form.materials)?;
    check_part(&root.key("waveforms"), &form.waveforms)?;
    check_part(&root.key("bodies"), &form.bodies)?;
    check_part(&root.key("contacts"), &form.contacts)?;
    check_part(&root.key("springs"), &form.springs)?;
    check_part(&root.key("stops"), &form.stops)?;
    check_part(&root.key("actuators"), &form.actuators)?;
    check_count(&root.key("loads"), form.loads.len())?;
    if form.bodies.find(GROUND).is_some() {
        let fault = root.key("bodies").key(GROUND).fault("the ground always exists and is fixed");
        let fault = fault.on_key().mend(Mend::Misnamed);
        return Err(fault.help("choose another name for this body"));
    }
    check_columns(form)
}

fn check_count(at: &At<'_>, count: usize) -> Result<(), Fault> {
    if count <= MAX_PARTS {
        return Ok(());
    }
    Err(at.fault(format!("expected at most {MAX_PARTS} of them, got {count}")).on_key())
}

fn check_part<T>(at: &At<'_>, parts: &Parts<T>) -> Result<(), Fault> {
    check_count(at, parts.0.len())?;
    for name in parts.names() {
        // Names occur in key paths and column headers.
        let good = |c: char| c.is_alphanumeric() || matches!(c, '_' | '-' | ' ' | '+');
        let trimmed = !name.starts_with(' ') && !name.ends_with(' ');
        if name.is_empty() || !trimmed || name.chars().count() > MAX_LENGTH || !name.chars().all(good) {
            let fault = at.key(name).fault("this name cannot be used").on_key();
            let help = format!("1 to {MAX_LENGTH} letters, digits, _, -, + or blanks inside");
            return Err(fault.help(help).mend(Mend::Misnamed));
        }
    }
    Ok(())
}

/// Checks that no column of the trace occurs twice: names of bodies and contacts begin column names.
fn check_columns(form: &Form) -> Result<(), Fault> {
    let root = At::ROOT;
    let at = root.key("contacts");
    for name in form.contacts.names() {
        if form.bodies.find(name).is_some() || name == GROUND {
            let fault = at.key(name).fault("a body already has this name").on_key();
            let fault = fault.against_path(root.key("bodies").key(name).path()).mend(Mend::Misnamed);
            return Err(fault.help("bodies and contacts name columns of the same table: choose another name"));
        }
        if name == "energy" || name == "time_s" {
            let fault = at.key(name).fault("trace.csv has a column of this name").on_key();
            return Err(fault.mend(Mend::Misnamed));
        }
    }
    Ok(())
}

/// Returns the error for a reference to an unknown part. `what` is the kind of part, `section` the section of the file with such parts.
pub(super) fn unknown<T>(
    at: &At<'_>,
    (what, section): (&str, &'static str),
    name: &str,
    parts: &Parts<T>,
) -> Fault {
    let fault = at.fault(format!("there is no {what} \"{}\"", shown(name)));
    let instead = suggest::nearest(name, parts.names()).or_else(|| parts.names().next()).map(str::to_owned);
    let fault = fault.against_path(At::ROOT.key(section).key(name).path());
    fault
        .mend(Mend::Name { section, name: name.to_owned(), instead })
        .maybe_help(suggest::help(name, parts.names()))
}

impl Builder<'_> {
    /// Returns the index of a body.
    pub(super) fn body(&self, at: &At<'_>, name: &str) -> Result<usize, Fault> {
        let bodies = &self.form.bodies;
        bodies.find(name).ok_or_else(|| unknown(at, ("body", "bodies"), name, bodies))
    }

    /// Returns both ends of a contact, spring or actuator.
    pub(super) fn between(&self, at: &At<'_>, names: &Two) -> Result<[Side; 2], Fault> {
        let at = at.key("between");
        let side = |i: usize| match names.0[i].as_str() {
            GROUND => Ok(Side::Ground),
            name => self
                .body(&at.index(i), name)
                .map(Side::Body)
                .map_err(|fault| self.or_ground(fault, name, &names.0[1 - i])),
        };
        Side::two(side(0)?, side(1)?).map_err(|_| {
            let message = format!("expected two different bodies, got \"{}\" twice", names.0[0]);
            let fault = at.index(1).fault(message).against_path(at.path());
            fault.help("name two bodies, or one and \"ground\"")
        })
    }

    /// Adds the ground to the suggested names of one end of a part, and excludes the body at the other end.
    fn or_ground(&self, mut fault: Fault, name: &str, other: &str) -> Fault {
        let names = || self.form.bodies.names().chain([GROUND]);
        let free = || names().filter(|name| *name != other);
        if let Mend::Name { instead, .. } = &mut fault.bearing.mend {
            *instead = suggest::nearest(name, free()).or_else(|| free().next()).map(str::to_owned);
        }
        fault.maybe_help(suggest::help(name, names()))
    }
}
