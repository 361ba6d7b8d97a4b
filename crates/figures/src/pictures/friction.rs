//! Plot of the friction work per area over radius and time.

use super::{Kind, Sources, Undrawn, written};
use crate::look::{Pen, Picture};
use stickslip_plot::{FrictionWork, friction_figures};
use stickslip_run::apart;
use stickslip_run::curves;
use stickslip_run::files::FRICTION;
use stickslip_run::moments::{self, OverRadius};
use stickslip_scenario::PlotName;

/// Maximum number of contacts.
const MOST: usize = 4;
/// Maximum number of times with a radial distribution.
const MARKED: usize = 6;

pub(super) const KIND: Kind =
    Kind { shows: "friction work per area over radius and time", needs: |_| Vec::new(), draw };

/// Friction work of a contact: times, radii, and work per area time by time.
struct Course {
    name: String,
    moments: Vec<f64>,
    r: Vec<f64>,
    work: Vec<f64>,
}

/// Draws two panels per contact.
fn draw(sources: &Sources<'_>, pen: &Pen<'_>) -> Result<Vec<Picture>, Undrawn> {
    let mut courses: Vec<Course> = Vec::new();
    for moment in moments::friction(written(&sources.insides.friction, FRICTION)?)? {
        match courses.iter().position(|course| course.name == moment.contact) {
            Some(place) => courses[place].push(moment),
            None => courses.push(Course::of(moment)),
        }
    }
    let (told, all) = (courses.len(), courses.iter().filter(|course| course.most() > 0.0).count());
    let courses = Course::busiest(courses);
    let marks: Vec<Vec<(f64, String)>> = courses.iter().map(Course::marks).collect();
    let works: Vec<FrictionWork<'_>> = courses
        .iter()
        .zip(&marks)
        .map(|(course, marks)| FrictionWork {
            axis: ("time t", "s"),
            moments: &course.moments,
            r: &course.r,
            work: &course.work,
            marks,
        })
        .collect();
    let named = told > 1;
    let title = match all {
        all if courses.len() < all => {
            format!("{} ({} of {all} slipping contacts)", sources.job.title(), courses.len())
        }
        _ => sources.job.title().to_owned(),
    };
    let works: Vec<(&str, &FrictionWork<'_>)> = courses
        .iter()
        .zip(&works)
        .map(|(course, work)| (if named { course.name.as_str() } else { "" }, work))
        .collect();
    Ok(pen.draw(PlotName::Friction, friction_figures(&title, &works))?)
}

impl Course {
    fn of(moment: OverRadius) -> Self {
        let (name, r) = (moment.contact.clone(), moment.columns[0].clone());
        let mut course = Self { name, moments: Vec::new(), r, work: Vec::new() };
        course.push(moment);
        course
    }

    /// Returns the largest friction work per area, J/m².
    fn most(&self) -> f64 {
        self.work.iter().copied().filter(|work| work.is_finite()).fold(0.0, f64::max)
    }

    /// Returns the contacts with friction work, at most [`MOST`] with the largest values, in their order.
    fn busiest(mut courses: Vec<Self>) -> Vec<Self> {
        let mut most: Vec<f64> = courses.iter().map(Self::most).collect();
        most.sort_by(|a, b| b.total_cmp(a));
        let least = most.get(MOST - 1).copied().unwrap_or(0.0);
        if most.first().is_some_and(|most| *most > 0.0) {
            courses.retain(|course| course.most() > 0.0 && course.most() >= least);
        }
        courses.truncate(MOST);
        courses
    }

    /// Returns the equally spaced times with their names.
    fn marks(&self) -> Vec<(f64, String)> {
        let chosen: Vec<f64> = curves::chosen(&self.moments, MARKED).into_iter().collect();
        let told = apart(&chosen, "s");
        chosen.into_iter().zip(told).map(|(time, told)| (time, format!("t = {told}"))).collect()
    }

    fn push(&mut self, mut moment: OverRadius) {
        // The radii are the same throughout a run.
        if moment.columns[1].len() == self.r.len() {
            self.moments.push(moment.time);
            self.work.append(&mut moment.columns[1]);
        }
    }
}
