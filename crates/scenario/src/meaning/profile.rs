//! Contact profiles.

use super::{measured, range};
use crate::fault::Fault;
use crate::form::{FoundationForm, Lengths, NormalForm, PowersForm, ProfileForm};
use crate::guide::Help;
use crate::path::At;
use crate::units::Kind;
use stickslip_contact::{Heights, Material, Pair, Profile, ProfileError};

/// Maximum number of terms of a sum of powers. Each term costs a power in every evaluation.
const MAX_TERMS: usize = 16;

/// Converts a profile between bodies of the given materials.
pub(super) fn profile(
    at: &At<'_>,
    form: &ProfileForm,
    (materials, normal): ([Material; 2], &NormalForm),
) -> Result<Profile, Fault> {
    let at = at.key(form.word());
    let endless = matches!(normal, NormalForm::Force(_));
    let profile = match form {
        ProfileForm::Flat(flat) => Profile::flat(flat.radius.si),
        ProfileForm::Cone(cone) => Profile::cone(cone.slope),
        ProfileForm::Paraboloid(ball) => Profile::paraboloid(ball.radius.si),
        ProfileForm::Sphere(ball) => Profile::sphere(ball.radius.si),
        ProfileForm::Power(power) => Profile::power(power.coefficient, power.exponent),
        ProfileForm::Foundation(form) => return foundation(&at, form),
        ProfileForm::TruncatedCone(cone) => Profile::truncated_cone(cone.flat.si, cone.slope),
        ProfileForm::TruncatedParaboloid(ball) => Profile::truncated_paraboloid(ball.flat.si, ball.radius.si),
        ProfileForm::RoundedFlat(punch) => Profile::rounded_flat(punch.flat.si, punch.radius.si),
        ProfileForm::TippedParaboloid(ball) => Profile::tipped_paraboloid(ball.radius.si, ball.tip.si),
        ProfileForm::Powers(form) => return powers(&at.key("terms"), form),
        ProfileForm::Table(form) => return measured::table(&at, form),
        ProfileForm::NormalLaw(form) => {
            return measured::normal_law(&at, form, Pair::new(materials[0], materials[1]));
        }
        ProfileForm::Rough(form) => return measured::rough(&at, form),
        ProfileForm::ExponentialAsperities(it) => {
            Profile::asperities(Heights::Exponential, it.mean_height.si, it.radius.si, it.count, endless)
        }
        ProfileForm::GaussianAsperities(it) => {
            Profile::asperities(Heights::Gaussian, it.rms_height.si, it.radius.si, it.count, endless)
        }
        ProfileForm::GradedParaboloid(it) => {
            Profile::graded_paraboloid(it.radius.si, it.exponent, it.depth.si, materials)
        }
    };
    let length = |key| at.key(key).expected(range::above(Kind::Length));
    profile.map_err(|error| match error {
        ProfileError::Radius(_) => length("radius"),
        ProfileError::Scale(_) => {
            let gaussian = matches!(form, ProfileForm::GaussianAsperities(_));
            length(if gaussian { "rms_height" } else { "mean_height" })
        }
        ProfileError::Depth(_) => length("depth"),
        ProfileError::Grading(_) => at.key("exponent").expected("a number of at least 0 and below 1"),
        ProfileError::Tips(_) => at.key("count").expected("a number between 10 and 1e15"),
        ProfileError::Flat(_) => length("flat"),
        ProfileError::Tip(_) => length("tip"),
        ProfileError::Slope(_) => at.key("slope").expected(range::ABOVE),
        // A positive coefficient fails because of its size, which may differ from the number in the file.
        ProfileError::Coefficient(value) if value <= 0.0 => at.key("coefficient").expected(range::ABOVE),
        ProfileError::Exponent(_) => at.key("exponent").expected(range::ABOVE),
        _ => at.fault(error.to_string()),
    })
}

fn powers(at: &At<'_>, form: &PowersForm) -> Result<Profile, Fault> {
    let terms: Vec<(f64, f64)> = form.terms.iter().map(|term| (term.coefficient, term.exponent)).collect();
    if terms.len() > MAX_TERMS {
        return Err(at.fault(format!("expected at most {MAX_TERMS} terms, got {}", terms.len())));
    }
    Profile::powers(&terms).map_err(|error| match error {
        ProfileError::TermCoefficient { index, .. } => {
            at.index(index).key("coefficient").expected("a number of at least 0")
        }
        ProfileError::TermExponent { index, .. } => at.index(index).key("exponent").expected(range::ABOVE),
        ProfileError::NoTerm => at.fault("expected at least one term above 0").ask(Help::Shape),
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
