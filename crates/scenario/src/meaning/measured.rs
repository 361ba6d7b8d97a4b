//! Profiles given by points or lines. Points of files have already been read.

use super::range;
use crate::fault::Fault;
use crate::form::{GapTableForm, NormalLawForm, RoughForm, SelfAffineForm};
use crate::guide::Help;
use crate::path::At;
use crate::units::Kind;
use stickslip_contact::{Pair, Profile, ProfileError, RoughnessError, SelfAffine};

pub(super) fn table(at: &At<'_>, form: &GapTableForm) -> Result<Profile, Fault> {
    let Some(points) = &form.points else {
        let help = "or \"file\" with the names of its columns \"radius\" and \"gap\"";
        return Err(at.missing("points").help(help));
    };
    let (points_at, kinks_at) = (at.key("points"), at.key("kinks"));
    let points: Vec<(f64, f64)> = points.iter().map(|point| (point.0.si, point.1.si)).collect();
    let kinks: Vec<f64> = form.kinks.iter().map(|kink| kink.si).collect();
    Profile::table(&points, &kinks).map_err(|error| match error {
        ProfileError::TooMany(_) => points_at.fault(error.to_string()).help("keep one of several points"),
        ProfileError::Origin { .. } => {
            let fault = points_at.index(0).fault("expected the first point at [0, 0]");
            fault.help("radii are measured from the axis, gaps from the first point of contact")
        }
        ProfileError::Order { index } => {
            let fault =
                points_at.index(index).index(0).expected("a radius larger than that of the point before it");
            fault.against_path(points_at.path())
        }
        ProfileError::Fall { index } => {
            let fault =
                points_at.index(index).index(1).expected("a gap of at least that of the point before it");
            fault.against_path(points_at.path())
        }
        ProfileError::NoRise => {
            let fault =
                points_at.index(points.len() - 1).index(1).fault("expected a gap above 0 m at the last point");
            fault.help("a table of zeros is a flat punch: \"flat\"").against_path(points_at.path())
        }
        ProfileError::Kink { index, .. } => {
            let fault =
                kinks_at.index(index).expected("the radius of a point between the first and the last");
            let fault = fault.against_path(points_at.path());
            fault.help("a kink is a point of the table; neighbouring points may be arbitrarily near")
        }
        ProfileError::NotRising { index, .. } => {
            let message =
                "the profile bends down too far before this point: its equivalent g(x) does not increase";
            let help = "growing circles of contact need a profile that is convex or nearly convex; if points scatter, use fewer points, or smooth them";
            points_at.index(index).fault(message).help(help).against_path(points_at.path())
        }
        _ => few(&points_at, &error),
    })
}

pub(super) fn normal_law(at: &At<'_>, form: &NormalLawForm, pair: Pair) -> Result<Profile, Fault> {
    let Some(points) = &form.points else {
        let help = "or \"file\" with the names of its columns \"indentation\" and \"force\"";
        return Err(at.missing("points").help(help));
    };
    let at = at.key("points");
    let modulus = pair.normal_modulus();
    let points: Vec<(f64, f64)> = points.iter().map(|point| (point.0.si, point.1.si / modulus)).collect();
    Profile::normal_law(&points).map_err(|error| match error {
        ProfileError::Origin { .. } => {
            let fault = at.index(0).fault("expected the first point at [0, 0]");
            fault.help("indentations and forces are 0 at the first contact")
        }
        ProfileError::Order { index } => {
            let fault =
                at.index(index).index(0).expected("an indentation larger than that of the point before it");
            fault.against_path(at.path())
        }
        ProfileError::Fall { index } => {
            let fault = at.index(index).index(1).expected("a force above that of the point before it");
            fault.against_path(at.path())
        }
        ProfileError::Softening { index } => {
            let fault = at.index(index).fault("the force increases less steeply up to this point than before it");
            fault
                .help("the contact area grows with the load, so the stiffness does not decrease; if points scatter, use fewer points, or smooth them")
                .against_path(at.path())
        }
        _ => few(&at, &error),
    })
}

/// Returns the error for too few points.
fn few(at: &At<'_>, error: &ProfileError) -> Fault {
    at.fault(error.to_string()).ask(Help::Shape)
}

pub(super) fn rough(at: &At<'_>, form: &RoughForm) -> Result<Profile, Fault> {
    let heights_at = at.key("heights");
    let (heights, spacing) = match (&form.heights, &form.self_affine) {
        (Some(_), Some(_)) => {
            let fault = at.key("self_affine").fault("the heights are already given").on_key();
            return Err(fault.against_path(heights_at.path()).help("keep one of them"));
        }
        (None, None) => {
            let help = "or \"file\" with the name of its column \"height\", or \"self_affine\"";
            return Err(at.missing("heights").help(help));
        }
        (None, Some(line)) => {
            if form.spacing.is_some() {
                let fault =
                    at.key("spacing").fault("the length of the line and the number of points determine it");
                return Err(fault.on_key().help("leave it out"));
            }
            let count =
                range::count_between(&at.key("self_affine").key("points"), line.points.0, 4, MAX_POINTS)?;
            (made(&at.key("self_affine"), line)?, line.length.si / count as f64)
        }
        (Some(heights), None) => {
            let spacing = form.spacing.ok_or_else(|| at.missing("spacing"))?;
            let spacing = range::above_zero(&at.key("spacing"), spacing)?;
            (heights.iter().map(|height| height.si).collect(), spacing)
        }
    };
    Profile::rough(&heights, spacing).map_err(|error| match error {
        ProfileError::Empty => heights_at.fault(error.to_string()).ask(Help::Shape),
        ProfileError::TooManyHeights(_) if form.self_affine.is_some() => {
            at.key("self_affine").key("points").fault(error.to_string())
        }
        ProfileError::TooManyHeights(_) => heights_at.fault(error.to_string()),
        ProfileError::LineHeight { index, .. } => heights_at.index(index).fault(error.to_string()),
        _ => at.fault(error.to_string()),
    })
}

const MAX_POINTS: u64 = SelfAffine::MAX_POINTS as u64;

/// Returns the heights of a generated self-affine line.
fn made(at: &At<'_>, form: &SelfAffineForm) -> Result<Vec<f64>, Fault> {
    let line = SelfAffine {
        rms: form.rms.si,
        hurst: form.hurst,
        longest: form.longest.si,
        shortest: form.shortest.si,
        length: form.length.si,
        points: form.points.0 as usize,
        seed: form.seed.0,
    };
    line.heights().map_err(|error| match error {
        RoughnessError::Rms(_) => at.key("rms").expected(range::above(Kind::Length)),
        RoughnessError::Hurst(_) => at.key("hurst").expected("a number between 0 and 1"),
        RoughnessError::Length(_) => at.key("length").expected(range::above(Kind::Length)),
        RoughnessError::Points(count) => {
            let fault = at.key("points").expected("a power of two");
            fault.help(format!("the nearest above is {}", count.next_power_of_two()))
        }
        RoughnessError::Longest { length, .. } => {
            let wanted =
                format!("a wavelength above 0 m and at most the length of {} m", range::short(length));
            at.key("longest").expected(wanted).against_path(at.key("length").path())
        }
        RoughnessError::Swapped { longest, .. } => {
            let wanted =
                format!("a wavelength above 0 m and at most the longest of {} m", range::short(longest));
            let fault = at.key("shortest").expected(wanted).against_path(at.key("longest").path());
            fault.help("are \"longest\" and \"shortest\" swapped?")
        }
        RoughnessError::Shortest { least, .. } => {
            let wanted =
                format!("a wavelength of at least two distances of points, {} m", range::short(least));
            let fault = at.key("shortest").expected(wanted).against_path(at.key("length").path());
            fault.against_path(at.key("points").path()).help("or increase the number of points")
        }
        RoughnessError::NoWave => {
            at.fault(error.to_string()).help("increase the ratio of the cut-off wavelengths")
        }
    })
}
