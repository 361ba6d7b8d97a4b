//! Series for the plots of a load history at its corners.

use super::spread;
use stickslip_contact::{Interface, SpringState, Zone, ZoneKind};
use stickslip_plot::{AnchorMoment, FieldsMoment, FieldsZone, SpringCondition, SubstituteMoment};
use stickslip_run::theory::{Moment, Walk};
use stickslip_run::{Real, quantity};

/// Maximum number of corners in a plot.
const MOST: usize = 6;

/// Corners that are shown.
pub(super) struct Shown<'a> {
    law: &'a Interface,
    moments: Vec<Columns<'a>>,
    /// Common scales: radius, indentation and stretch, m.
    scale: (f64, f64, f64),
}

/// Data of one corner as columns.
struct Columns<'a> {
    heading: String,
    moment: &'a Moment,
    r: Vec<f64>,
    pressure: Vec<f64>,
    shear: Vec<f64>,
    displacement: Vec<f64>,
    slip: Vec<f64>,
    zones: Vec<FieldsZone>,
    /// Position, height, stretch and state of each spring.
    x: Vec<f64>,
    g: Vec<f64>,
    stretch: Vec<f64>,
    conditions: Vec<SpringCondition>,
    /// Position, height and reversal displacement of each spring in contact.
    anchored: [Vec<f64>; 3],
}

impl<'a> Shown<'a> {
    /// Selects some corners, including the first and the last. The start is selected only if there is no corner.
    pub(super) fn of(law: &'a Interface, walk: &'a Walk) -> Self {
        // The start has no tangential load.
        let first = usize::from(walk.moments.len() > 1);
        let shown = &walk.moments[first..];
        let moments = spread(shown.len(), MOST).map(|place| Columns::of(&shown[place])).collect();
        Self { law, moments, scale: scale(law, walk) }
    }

    pub(super) fn fields(&self) -> Vec<FieldsMoment<'_>> {
        let moments = self.moments.iter().map(|columns| FieldsMoment {
            heading: &columns.heading,
            r: &columns.r,
            pressure: &columns.pressure,
            shear: &columns.shear,
            displacement: &columns.displacement,
            slip: &columns.slip,
            friction: self.law.friction(),
            zones: &columns.zones,
        });
        moments.collect()
    }

    pub(super) fn anchors(&self) -> Vec<AnchorMoment<'_>> {
        let moments = self.moments.iter().map(|columns| AnchorMoment {
            heading: &columns.heading,
            apex: (columns.moment.stop.apex.d, columns.moment.stop.apex.u),
            slope: self.law.stick_slope(),
            corners: &columns.moment.knots,
            x: &columns.anchored[0],
            g: &columns.anchored[1],
            p: &columns.anchored[2],
        });
        moments.collect()
    }

    pub(super) fn substitutes(&self) -> Vec<SubstituteMoment<'_>> {
        let (scale, deepest, largest_stretch) = self.scale;
        let moments = self.moments.iter().map(|columns| {
            let stop = &columns.moment.stop;
            SubstituteMoment {
                heading: &columns.heading,
                d: stop.apex.d,
                radii: (stop.a, stop.c),
                scale,
                deepest,
                largest_stretch,
                forces: (stop.normal_force, stop.force),
                limit: self.law.friction() * stop.normal_force,
                x: &columns.x,
                g: &columns.g,
                stretch: &columns.stretch,
                conditions: &columns.conditions,
            }
        });
        moments.collect()
    }
}

/// Calls `drawn` with the springs of each animation frame.
pub(super) fn frames(law: &Interface, walk: &Walk, mut drawn: impl FnMut(&SubstituteMoment<'_>)) {
    for frame in &walk.frames {
        // Only the springs are needed.
        let moment = Moment {
            stop: frame.stop,
            fields: Vec::new(),
            zones: Vec::new(),
            springs: frame.springs.clone(),
            knots: Vec::new(),
        };
        let shown = Shown { law, moments: vec![Columns::of(&moment)], scale: scale(law, walk) };
        shown.substitutes().iter().for_each(&mut drawn);
    }
}

/// Returns the common scales of the plots: largest radius, indentation and stretch, m.
fn scale(law: &Interface, walk: &Walk) -> (f64, f64, f64) {
    let springs = walk.moments.iter().flat_map(|moment| &moment.springs);
    let largest = springs.fold(0.0_f64, |most, spring| most.max(spring.spring.stretch.abs()));
    let stretch = law.gross_slip_displacement(walk.deepest).max(largest);
    (law.profile().radius(walk.deepest), walk.deepest, stretch)
}

impl<'a> Columns<'a> {
    fn of(moment: &'a Moment) -> Self {
        let apex = moment.stop.apex;
        let fields = |value: fn(&stickslip_contact::Field) -> f64| moment.fields.iter().map(value).collect();
        let touching = || moment.springs.iter().filter(|spring| spring.spring.state != SpringState::Open);
        Self {
            heading: heading(moment),
            r: fields(|field| field.r),
            pressure: fields(|field| field.pressure),
            shear: fields(|field| field.shear),
            displacement: fields(|field| field.displacement),
            slip: fields(|field| field.slip),
            zones: moment.zones.iter().map(ring).collect(),
            x: moment.springs.iter().map(|spring| spring.spring.x).collect(),
            g: moment.springs.iter().map(|spring| spring.spring.height).collect(),
            stretch: moment.springs.iter().map(|spring| spring.spring.stretch).collect(),
            conditions: moment.springs.iter().map(|spring| condition(spring.spring.state)).collect(),
            anchored: [
                touching().map(|spring| spring.spring.x).collect(),
                touching().map(|spring| spring.spring.height).collect(),
                touching().map(|spring| apex.u - spring.spring.stretch).collect(),
            ],
            moment,
        }
    }
}

/// Returns the heading of a corner: its number and displacement.
fn heading(moment: &Moment) -> String {
    let stop = &moment.stop;
    let words = format!("{}: u = {}", stop.corner, quantity(Real(stop.apex.u), "m"));
    // Minus signs as on the axes.
    words.replace('-', "−")
}

/// Converts a ring of the contact to a ring of the plot.
fn ring(zone: &Zone) -> FieldsZone {
    let slips = |sense: i8| {
        if sense < 0 { SpringCondition::SlipBackward } else { SpringCondition::SlipForward }
    };
    let (condition, frozen) = match zone.kind {
        ZoneKind::Stick => (SpringCondition::Stick, false),
        ZoneKind::Frozen(_) => (SpringCondition::Stick, true),
        ZoneKind::Slip(sense) => (slips(sense), false),
    };
    FieldsZone { radii: [zone.from, zone.to], condition, frozen }
}

pub(crate) fn condition(state: SpringState) -> SpringCondition {
    match state {
        SpringState::Open => SpringCondition::Open,
        SpringState::Stick => SpringCondition::Stick,
        SpringState::SlipForward => SpringCondition::SlipForward,
        SpringState::SlipBackward => SpringCondition::SlipBackward,
    }
}
