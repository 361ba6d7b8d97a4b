//! Quantities that are increased, and their sizes.

use super::Point;
use super::scenes::{PERIOD, drive, remembering};
use stickslip_contact::Memory;
use stickslip_drive::scene::EngineChoice;
use stickslip_drive::{Limits, Model, Plan, Scene, Stepper};
use stickslip_run::Unrecorded;

/// Quantity that is increased.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Springs,
    Contacts,
    Frames,
    Coordinates,
    Time,
    Rows,
    Memory,
}

/// Time integrator for all quantities except springs and frames.
const EVENT: Stepper = Stepper::Event { tolerance: 1e-6 };
const FRAMES: Stepper = Stepper::Frames { length: 0.02 * PERIOD, accuracy: 1e-3 };
/// Number of periods of the shorter runs.
const PERIODS: f64 = 10.0;
/// Number of inner cycles of a memory measurement.
const INNER: u32 = 50;

impl Kind {
    pub(super) const ALL: [Self; 7] = [
        Self::Springs,
        Self::Contacts,
        Self::Frames,
        Self::Coordinates,
        Self::Time,
        Self::Rows,
        Self::Memory,
    ];

    /// Returns the name in the table.
    pub(super) fn key(self) -> &'static str {
        match self {
            Self::Springs => "springs",
            Self::Contacts => "contacts",
            Self::Frames => "contacts_in_frames",
            Self::Coordinates => "coordinates",
            Self::Time => "simulated_s",
            Self::Rows => "rows_per_period",
            Self::Memory => "knots",
        }
    }

    /// Returns the name in plots, and the unit.
    pub(super) fn words(self) -> (&'static str, &'static str) {
        match self {
            Self::Springs => ("springs of a row", ""),
            Self::Contacts => ("contacts of a slider", ""),
            Self::Frames => ("contacts, by frames", ""),
            Self::Coordinates => ("sliders", ""),
            Self::Time => ("simulated time", "s"),
            Self::Rows => ("rows per period", ""),
            Self::Memory => ("corners of the memory", ""),
        }
    }

    /// Returns the measurements of all sizes.
    pub(super) fn points(self) -> Result<Vec<Point>, String> {
        let sizes: &[u32] = match self {
            Self::Springs => &[16, 64, 256, 1024, 4096, 16_384],
            Self::Contacts => &[1, 2, 4, 8, 16, 32, 64, 128],
            Self::Frames => &[1, 2, 4, 8, 16, 32, 64, 128, 256, 512],
            Self::Coordinates => &[1, 2, 4, 8, 16, 32],
            Self::Time => &[10, 100, 1000, 10_000],
            Self::Rows => &[1, 10, 100, 1000],
            Self::Memory => &[1, 4, 16, 64, 256],
        };
        sizes.iter().map(|size| self.point(*size)).collect()
    }

    fn point(self, size: u32) -> Result<Point, String> {
        let curve = EngineChoice::Curve;
        let row = EngineChoice::Springs { count: size as usize, span: None };
        let verlet = Stepper::Verlet { step: 1e-3 * PERIOD };
        let rows = PERIOD / f64::from(size);
        let whole = f64::from(size);
        match self {
            Self::Springs => from_rest(whole, drive(1, 1, row), plan(PERIODS, verlet, None)),
            Self::Contacts => from_rest(whole, drive(1, size, curve), plan(PERIODS, EVENT, None)),
            Self::Frames => from_rest(whole, drive(1, size, curve), plan(PERIODS, FRAMES, None)),
            Self::Coordinates => from_rest(whole, drive(size, 1, curve), plan(PERIODS, EVENT, None)),
            Self::Time => from_rest(PERIOD * whole, drive(1, 1, curve), plan(whole, EVENT, None)),
            Self::Rows => from_rest(whole, drive(1, 1, curve), plan(PERIODS, EVENT, Some(rows))),
            Self::Memory => swung(size),
        }
    }
}

fn plan(periods: f64, stepper: Stepper, every: Option<f64>) -> Plan {
    Plan { duration: periods * PERIOD, stepper, limits: Limits::default(), every, until_steady: None }
}

fn from_rest(size: f64, scene: Result<Scene, String>, plan: Plan) -> Result<Point, String> {
    let model = Model::new(&scene?).map_err(|error| error.to_string())?;
    Point::new(size, model, plan)
}

/// Returns the measurement of a contact with the memory of decreasing cycles, during a smaller cycle. The size is the number of breakpoints
/// of the memory.
fn swung(swings: u32) -> Result<Point, String> {
    let (scene, from) = remembering(swings, INNER)?;
    let model = Model::new(&scene).map_err(|error| error.to_string())?;
    let before = Plan { duration: from, ..plan(0.0, EVENT, None) };
    let mut state = model.start(&before).map_err(|error| error.to_string())?;
    stickslip_drive::run(&model, &before, &mut state, &mut Unrecorded(&()))
        .map_err(|error| error.to_string())?;
    let depth = match state.memories().first() {
        Some(Memory::Curve(curve)) => curve.knot_count(),
        _ => 0,
    };
    let after = Plan { duration: from + f64::from(INNER) * PERIOD, ..before };
    Ok(Point::from(depth as f64, model, after, state))
}
