//! Where friction has done its work, over radius and time.

use super::{Kind, Sources, Undrawn, written};
use crate::look::{Pen, Picture};
use stickslip_plot::{FrictionWork, friction_figures};
use stickslip_results::curves;
use stickslip_results::files::FRICTION;
use stickslip_results::moments::{self, OverRadius};
use stickslip_results::{Real, quantity};
use stickslip_scenario::PlotName;

/// Contacts in one picture, at most.
const MOST: usize = 4;
/// Moments that are marked, at most.
const MARKED: usize = 6;

pub(super) const KIND: Kind =
    Kind { shows: "where friction has done its work, over the radius and time", needs: |_| Vec::new(), draw };

/// What a contact has gone through.
struct Course {
    name: String,
    moments: Vec<f64>,
    r: Vec<f64>,
    work: Vec<f64>,
}

/// Two panels for each contact.
fn draw(sources: &Sources<'_>, pen: &Pen<'_>) -> Result<Vec<Picture>, Undrawn> {
    let mut courses: Vec<Course> = Vec::new();
    for moment in moments::friction(written(&sources.insides.friction, FRICTION)?)? {
        match courses.iter().position(|course| course.name == moment.contact) {
            Some(place) => courses[place].push(moment),
            None if courses.len() < MOST => courses.push(Course::of(moment)),
            None => {}
        }
    }
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
    let named = courses.len() > 1;
    let works: Vec<(&str, &FrictionWork<'_>)> = courses
        .iter()
        .zip(&works)
        .map(|(course, work)| (if named { course.name.as_str() } else { "" }, work))
        .collect();
    Ok(pen.draw(PlotName::Friction, friction_figures(sources.job.title(), &works))?)
}

impl Course {
    fn of(moment: OverRadius) -> Self {
        let (name, r) = (moment.contact.clone(), moment.columns[0].clone());
        let mut course = Self { name, moments: Vec::new(), r, work: Vec::new() };
        course.push(moment);
        course
    }

    /// Some of its moments, evenly chosen: with a line for each a long run would be a hatching.
    fn marks(&self) -> Vec<(f64, String)> {
        let mark = |time: f64| (time, format!("t = {}", quantity(Real(time), "s")));
        curves::chosen(&self.moments, MARKED).into_iter().map(mark).collect()
    }

    fn push(&mut self, mut moment: OverRadius) {
        // Radii stay the same throughout a run.
        if moment.columns[1].len() == self.r.len() {
            self.moments.push(moment.time);
            self.work.append(&mut moment.columns[1]);
        }
    }
}
