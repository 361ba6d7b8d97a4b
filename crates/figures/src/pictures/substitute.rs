//! Plot of the contacts as rows of springs, compressed and sheared (handbook, figure 4.2).

use super::{Kind, Sources, Undrawn, of_all, written};
use crate::look::{Pen, Picture};
use stickslip_contact::{Interface, Springs};
use stickslip_plot::{SpringCondition, SubstituteMoment, substitute_figure};
use stickslip_run::apart;
use stickslip_run::curves::{self, MemoryCurve};
use stickslip_run::files::MEMORY;
use stickslip_scenario::PlotName;

/// Maximum number of sketches.
const MOST: usize = 6;
/// Number of springs of a sketch.
const SPRINGS: usize = 41;
/// Half-length of the row relative to the largest contact radius.
const BEYOND: f64 = 1.4;
/// Relative tolerance for slopes of the memory curve at the wedge, for the digits of the table.
const AT_LIMIT: f64 = 1e-6;

pub(super) const KIND: Kind = Kind {
    shows: "the contact as a row of springs, compressed and sheared, coloured by stick and slip",
    needs: |_| Vec::new(),
    draw,
};

/// Springs of a contact at one time.
struct Row<'a> {
    law: &'a Interface,
    heading: String,
    curve: MemoryCurve,
    x: Vec<f64>,
    g: Vec<f64>,
    stretch: Vec<f64>,
    conditions: Vec<SpringCondition>,
}

fn draw(sources: &Sources<'_>, pen: &Pen<'_>) -> Result<Vec<Picture>, Undrawn> {
    let job = sources.job;
    let table = written(&sources.insides.memory, MEMORY)?;
    let (mut curves, all) = (curves::read(table, MOST)?, curves::count(table)?);
    curves.drain(..curves.len().saturating_sub(MOST));
    let several = curves.iter().any(|curve| curve.contact != curves[0].contact);
    let deepest = curves.iter().map(|curve| curve.apex.0).fold(0.0, f64::max);
    let times = apart(&curves.iter().map(|curve| curve.time).collect::<Vec<f64>>(), "s");
    let rows = curves.into_iter().zip(times).filter_map(|(curve, time)| {
        let (_, law) = job.model.contacts().find(|(name, _)| *name == curve.contact)?;
        let time = format!("t = {time}");
        let heading = if several { format!("{}, {time}", curve.contact) } else { time };
        Row::of(law, curve, deepest, heading)
    });
    let rows: Vec<Row<'_>> = rows.collect();
    let stretches = rows.iter().flat_map(|row| row.stretch.iter().map(|s| s.abs()));
    let largest =
        rows.iter().map(|row| row.law.gross_slip_displacement(deepest)).chain(stretches).fold(0.0, f64::max);
    let moments: Vec<SubstituteMoment<'_>> = rows.iter().map(|row| row.moment(deepest, largest)).collect();
    let title = of_all(job.title(), "", (moments.len(), all));
    Ok(pen.draw(PlotName::Substitute, substitute_figure(&title, &moments))?)
}

impl<'a> Row<'a> {
    fn of(law: &'a Interface, curve: MemoryCurve, deepest: f64, heading: String) -> Option<Self> {
        let span = 2.0 * BEYOND * law.profile().radius(deepest);
        let springs = Springs::new(law.profile(), SPRINGS, span).ok()?;
        let mut row = Self { law, heading, curve, x: vec![], g: vec![], stretch: vec![], conditions: vec![] };
        for (x, height, _) in springs.cells() {
            let (stretch, condition) = row.spring(height);
            row.x.push(x);
            row.g.push(height);
            row.stretch.push(stretch);
            row.conditions.push(condition);
        }
        Some(row)
    }

    /// Returns the stretch in m and state of a spring of this height.
    fn spring(&self, height: f64) -> (f64, SpringCondition) {
        let MemoryCurve { apex: (d, u), h, p, .. } = &self.curve;
        if height >= *d || h.len() < 2 {
            return (0.0, SpringCondition::Open);
        }
        let above = h.partition_point(|corner| *corner <= height).clamp(1, h.len() - 1);
        let slope = (p[above] - p[above - 1]) / (h[above] - h[above - 1]);
        let stretch = u - (p[above] - slope * (h[above] - height));
        // Only the outermost piece of the memory curve can slip, if its slope is that of the wedge. The table does
        // not contain the slip front, so the piece may also have stuck since its last slip. It is drawn as slipping.
        // Without friction every piece has this slope and carries no force.
        let limit = self.law.stick_slope();
        let slips = limit > 0.0 && above + 1 == h.len() && (slope.abs() - limit).abs() <= AT_LIMIT * limit;
        let condition = match (slips, slope < 0.0) {
            (false, _) => SpringCondition::Stick,
            (true, false) => SpringCondition::SlipForward,
            (true, true) => SpringCondition::SlipBackward,
        };
        (stretch, condition)
    }

    fn moment(&self, deepest: f64, largest_stretch: f64) -> SubstituteMoment<'_> {
        let (law, d) = (self.law, self.curve.apex.0);
        let touching = |condition: &SpringCondition| *condition == SpringCondition::Stick;
        let stuck = self.x.iter().zip(&self.conditions).filter(|(_, condition)| touching(condition));
        let stick = stuck.map(|(x, _)| x.abs()).fold(0.0, f64::max);
        let slips = self.conditions.iter().any(|c| !touching(c) && *c != SpringCondition::Open);
        let radius = law.profile().radius(d);
        // The slip front is at the start of the outermost piece.
        let front = self.curve.h.iter().rev().nth(1).map_or(0.0, |h| law.profile().radius(*h));
        SubstituteMoment {
            heading: &self.heading,
            d,
            radii: (
                radius,
                if !slips {
                    radius
                } else if stick > 0.0 {
                    front
                } else {
                    0.0
                },
            ),
            scale: law.profile().radius(deepest),
            deepest,
            largest_stretch,
            forces: (law.normal_force(d), self.force()),
            limit: law.friction() * law.normal_force(d),
            x: &self.x,
            g: &self.g,
            stretch: &self.stretch,
            conditions: &self.conditions,
        }
    }

    /// Returns the tangential force F_x in N: G\* Σ slope ΔM over the pieces of the memory curve.
    fn force(&self) -> f64 {
        let (profile, MemoryCurve { h, p, .. }) = (self.law.profile(), &self.curve);
        let piece = |k: usize| {
            let rise = h[k] - h[k - 1];
            let swell = profile.reduced_force(h[k]) - profile.reduced_force(h[k - 1]);
            if rise > 0.0 { (p[k] - p[k - 1]) / rise * swell } else { 0.0 }
        };
        self.law.tangential_modulus() * (1..h.len()).map(piece).sum::<f64>()
    }
}
