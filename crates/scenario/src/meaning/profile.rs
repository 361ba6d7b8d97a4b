//! Profiles of the gap.

use super::range;
use crate::fault::Fault;
use crate::form::{FoundationForm, Lengths, ProfileForm};
use crate::guide::Help;
use crate::path::At;
use crate::units::Kind;
use stickslip_contact::{Profile, ProfileError};

/// The profile of a form.
pub(super) fn profile(at: &At<'_>, form: &ProfileForm) -> Result<Profile, Fault> {
    let (key, profile) = match form {
        ProfileForm::Flat(flat) => ("flat", Profile::flat(flat.radius.si)),
        ProfileForm::Cone(cone) => ("cone", Profile::cone(cone.slope)),
        ProfileForm::Paraboloid(ball) => ("paraboloid", Profile::paraboloid(ball.radius.si)),
        ProfileForm::Sphere(ball) => ("sphere", Profile::sphere(ball.radius.si)),
        ProfileForm::Power(power) => ("power", Profile::power(power.coefficient, power.exponent)),
        ProfileForm::Foundation(form) => return foundation(&at.key("foundation"), form),
        ProfileForm::Table(_) => return Err(at.key("table").not_yet()),
        ProfileForm::Rough(_) => return Err(at.key("rough").not_yet()),
    };
    let at = at.key(key);
    profile.map_err(|error| match error {
        ProfileError::Radius(_) => at.key("radius").expected(range::above(Kind::Length)),
        ProfileError::Slope(_) => at.key("slope").expected(range::ABOVE),
        // Above 0 it is out of reach for another reason, and need not be the one in the file.
        ProfileError::Coefficient(value) if value <= 0.0 => at.key("coefficient").expected(range::ABOVE),
        ProfileError::Exponent(_) => at.key("exponent").expected(range::ABOVE),
        _ => at.fault(error.to_string()),
    })
}

fn foundation(at: &At<'_>, form: &FoundationForm) -> Result<Profile, Fault> {
    let heights: Vec<f64> = form.heights.iter().map(|height| height.si).collect();
    let lengths: Vec<f64> = match &form.length {
        Lengths::All(length) => vec![length.si; heights.len()],
        Lengths::Each(lengths) => lengths.iter().map(|length| length.si).collect(),
    };
    let (heights_at, length_at) = (at.key("heights"), at.key("length"));
    Profile::foundation(&heights, &lengths).map_err(|error| match (error, &form.length) {
        (ProfileError::Empty, _) => heights_at.fault("expected at least one height").ask(Help::Shape),
        (ProfileError::Unpaired { heights, lengths }, _) => {
            let message = format!("expected one length for each of the {heights} heights, got {lengths}");
            length_at.fault(message).help("or one length for all, without brackets")
        }
        (ProfileError::Height { index, .. }, _) => {
            heights_at.index(index).expected(range::at_least(Kind::Length))
        }
        (ProfileError::Length { .. }, Lengths::All(_)) => length_at.expected(range::above(Kind::Length)),
        (ProfileError::Length { index, .. }, Lengths::Each(_)) => {
            length_at.index(index).expected(range::above(Kind::Length))
        }
        _ => at.fault(error.to_string()),
    })
}
