//! Hysteresis and creep of piezo stacks, and their compensation.

use super::{Builder, range};
use crate::fault::Fault;
use crate::form::{ActuatorForm, BoucWenForm, ControlForm, CreepForm, HysteresisForm, LoopForm, PlaysForm};
use crate::path::At;
use crate::units::Kind;
use std::f64::consts::TAU;
use std::sync::Arc;
use stickslip_drive::component::{Block, Input, Moment, SharedBlock, Standing};
use stickslip_drive::scene::{Named, Scene, Varying};
use stickslip_drive::{Sample, Waveform};
use stickslip_piezo::Reading;
use stickslip_piezo::creep::{Creep, CreepBlock, CreepError};
use stickslip_piezo::driver::Spec;
use stickslip_piezo::hysteresis::{BoucWen, BoucWenBlock, BoucWenError, PlayBlock, Plays, PlaysError};

/// Hysteresis and creep of the piezo ceramic.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Ceramic {
    /// Hysteresis.
    pub hysteresis: Option<Hysteresis>,
    /// Creep.
    pub creep: Option<Creep>,
    /// Whether inverse models of hysteresis and creep correct the command before the driver.
    pub compensated: bool,
    /// Whether hysteresis and creep have no effect, because the driver controls the charge.
    pub idle: bool,
}

/// Hysteresis law.
#[derive(Debug, Clone, PartialEq)]
pub enum Hysteresis {
    /// Prandtl–Ishlinskii operator. If it is defined by a loop width, the second field is the stroke of that loop, m.
    Plays(Plays, Option<f64>),
    /// Bouc–Wen.
    BoucWen(BoucWen),
}

/// Assumed rate of change of a signal whose rate is unknown, 1/s.
const UNKNOWN: f64 = 1e3;

/// Signal of a chain, with its range (`span`, m) and rates (1/s).
#[derive(Clone, Copy)]
struct Leg {
    signal: usize,
    span: f64,
    rate: f64,
    turns: f64,
}

impl Builder<'_> {
    /// Returns hysteresis and creep of the ceramic of an actuator.
    pub(super) fn ceramic(&self, at: &At<'_>, i: usize, form: &ActuatorForm) -> Result<Ceramic, Fault> {
        let hysteresis = match &form.hysteresis {
            Some(hysteresis) => Some(self.hysteresis(at, i, hysteresis)?),
            None => None,
        };
        let creep = form.creep.as_ref().map(|creep| law_of_creep(&at.key("creep"), creep)).transpose()?;
        if form.compensate {
            let fault = at.key("compensate");
            if hysteresis.is_none() && creep.is_none() {
                let fault = fault.fault("the stack has neither hysteresis nor creep to compensate");
                let fault = fault.against_path(at.key("hysteresis").path());
                return Err(fault.against_path(at.key("creep").path()).help("leave it out"));
            }
            if let Some(Hysteresis::BoucWen(_)) = hysteresis {
                let fault = fault.fault("hysteresis by \"bouc_wen\" has no inverse in this version");
                let fault = fault.against_path(at.key("hysteresis").path());
                return Err(fault.help("\"loop\" and \"plays\" have an exact inverse"));
            }
        }
        let idle = form.driver.as_ref().is_some_and(|driver| driver.control == ControlForm::Charge);
        Ok(Ceramic { hysteresis, creep, compensated: form.compensate, idle })
    }

    fn hysteresis(&self, at: &At<'_>, i: usize, form: &HysteresisForm) -> Result<Hysteresis, Fault> {
        let place = at.key("hysteresis");
        match form {
            HysteresisForm::Loop(form) => {
                let place = place.key("loop");
                let stroke = self.loop_stroke(&place, i, form)?;
                let plays = Plays::of_loop(0.01 * form.percent, stroke, form.operators.0 as usize);
                let plays = plays.map_err(|error| match error {
                    PlaysError::Width(_) => place.key("percent").expected("a number above 0 and below 50"),
                    PlaysError::Count(_) => {
                        place.key("operators").expected("a whole number between 1 and 64")
                    }
                    error => place.key("stroke").fault(error.to_string()),
                })?;
                Ok(Hysteresis::Plays(plays, Some(stroke)))
            }
            HysteresisForm::Plays(form) => Ok(Hysteresis::Plays(plays(&place.key("plays"), form)?, None)),
            HysteresisForm::BoucWen(form) => Ok(Hysteresis::BoucWen(bouc_wen(&place.key("bouc_wen"), form)?)),
        }
    }

    /// Returns the stroke for which a relative loop width is defined: the given stroke, or that of the data sheet, or that of the command.
    fn loop_stroke(&self, at: &At<'_>, i: usize, form: &LoopForm) -> Result<f64, Fault> {
        if let Some(stroke) = form.stroke {
            return range::above_zero(&at.key("stroke"), stroke);
        }
        if let Some(stroke) = self.form.actuators.0.get(i).and_then(|(_, form)| form.data_sheet?.stroke) {
            return Ok(stroke.si);
        }
        let (low, high) = match self.stacks[i].command {
            Varying::Follows(signal) => reach(&self.scene, signal),
            Varying::Constant(_) => (0.0, 0.0),
        };
        if high > low {
            return Ok(high - low);
        }
        let fault = at.missing("stroke").against(["waveforms"]);
        Err(fault.help("the stroke of this relative width, such as \"4.6 um\""))
    }

    /// Adds the compensation before the driver: command → inverse creep → inverse hysteresis.
    pub(super) fn compensation(&mut self, i: usize, command: Varying) -> Varying {
        let ceramic = self.stacks[i].ceramic.clone();
        let Varying::Follows(signal) = command else { return command };
        if !ceramic.compensated || ceramic.idle {
            return command;
        }
        let mut leg = self.leg(i, signal);
        if let Some(creep) = ceramic.creep {
            leg = self.push(i, "inverse_creep", leg, |reading| shared(CreepBlock::inverse(creep, reading)));
        }
        if let Some(Hysteresis::Plays(plays, _)) = ceramic.hysteresis {
            let inverse = plays.inverse();
            leg = self.push(i, "inverse_hysteresis", leg, |reading| shared(PlayBlock::new(inverse, reading)));
        }
        Varying::Follows(leg.signal)
    }

    /// Adds the response of the stack after the driver: hysteresis → creep.
    pub(super) fn response(&mut self, i: usize, driven: Varying) -> Varying {
        let ceramic = self.stacks[i].ceramic.clone();
        let Varying::Follows(signal) = driven else { return driven };
        if ceramic.idle {
            return driven;
        }
        let mut leg = self.leg(i, signal);
        if let Some(hysteresis) = ceramic.hysteresis {
            leg = self.push(i, "hysteresis", leg, |reading| match hysteresis {
                Hysteresis::Plays(plays, _) => shared(PlayBlock::new(plays, reading)),
                Hysteresis::BoucWen(law) => shared(BoucWenBlock::new(law, reading)),
            });
        }
        if let Some(creep) = ceramic.creep {
            leg = self.push(i, "creep", leg, |reading| shared(CreepBlock::new(creep, reading)));
        }
        Varying::Follows(leg.signal)
    }

    /// Returns range and rates of a signal of a chain. For a constant signal the range is 1 nm.
    fn leg(&self, i: usize, signal: usize) -> Leg {
        let (low, high) = reach(&self.scene, signal);
        let span = if high - low > 0.0 && (high - low).is_finite() { high - low } else { 1e-9 };
        let waveform = self.scene.waveform_of(signal).map(|w| &self.scene.waveforms[w].part);
        let driver = self.stacks[i].driver.as_ref().map_or(0.0, Spec::rate);
        let fastest = |time: Option<f64>| {
            time.filter(|time| time.is_finite()).map_or(UNKNOWN, |time| TAU / time).max(driver)
        };
        // For a burst or a chirp, the rate is that of a single wave.
        let rate = fastest(waveform.map(|waveform| waveform.extent().min(4.0 * waveform.resolution())));
        let turns = fastest(waveform.map(Waveform::quickest));
        Leg { signal, span, rate, turns }
    }

    /// Adds a block to a chain.
    fn push(&mut self, i: usize, what: &str, leg: Leg, block: impl FnOnce(Reading) -> SharedBlock) -> Leg {
        let Leg { signal, span, rate, turns } = leg;
        let part = block(Reading { signal, span, swings: rate, turns, column: "stroke_m" });
        let name = format!("{}.{what}", self.stacks[i].name);
        self.scene.blocks.push(Named { name, part });
        Leg { signal: self.scene.waveforms.len() + self.scene.blocks.len() - 1, ..leg }
    }
}

fn shared(block: impl Block + 'static) -> SharedBlock {
    SharedBlock(Arc::new(block))
}

/// Returns the play operators of a list of thresholds and weights.
fn plays(at: &At<'_>, form: &PlaysForm) -> Result<Plays, Fault> {
    let thresholds = form.thresholds.iter().map(|length| length.si).collect();
    Plays::new(form.direct, thresholds, form.weights.clone()).map_err(|error| match error {
        PlaysError::Threshold { place, .. } => {
            let last = place.checked_sub(1).and_then(|last| form.thresholds.get(last));
            let above = last
                .map_or("0 m".to_owned(), |last| format!("the length before, {} m", range::short(last.si)));
            at.key("thresholds").index(place).expected(format_args!("a length above {above}"))
        }
        PlaysError::Slope { taken_up: 0, .. } => at.key("direct").expected(range::ABOVE),
        PlaysError::Slope { taken_up, slope } => {
            let what = format!(
                "expected weights whose sum with \"direct\" stays above 0, got {}",
                range::short(slope)
            );
            let fault =
                at.key("weights").index(taken_up - 1).fault(what).against_path(at.key("direct").path());
            fault.help("the stroke must increase with the voltage for any number of moving play operators")
        }
        error => at.key("weights").fault(error.to_string()).against_path(at.key("thresholds").path()),
    })
}

fn bouc_wen(at: &At<'_>, form: &BoucWenForm) -> Result<BoucWen, Fault> {
    BoucWen::new(form.slope, form.limit.si, form.share, form.exponent).map_err(|error| match error {
        BoucWenError::Share(_) => at.key("share").expected("a number between 0.5 and 1"),
        BoucWenError::Slope { most, .. } => {
            let below = format!("a number above 0 and, with this share, below {}", range::short(most));
            at.key("slope").expected(below).against_path(at.key("share").path())
        }
        BoucWenError::Limit(_) => at.key("limit").expected(range::above(Kind::Length)),
        BoucWenError::Exponent { .. } => at.key("exponent").expected("a number between 1 and 16"),
    })
}

fn law_of_creep(at: &At<'_>, form: &CreepForm) -> Result<Creep, Fault> {
    let from = match form.from {
        Some(from) => range::above_zero(&at.key("from"), from)?,
        None => Creep::FROM,
    };
    Creep::new(form.per_decade, from, form.decades.0 as usize).map_err(|error| match error {
        CreepError::Strength { .. } => at.key("per_decade").expected("a number above 0 and below 0.5"),
        CreepError::From(_) => at.key("from").expected("a time above 0 s"),
        CreepError::Decades { .. } => at.key("decades").expected("a whole number between 1 and 6"),
    })
}

/// Returns the smallest and the largest value of a signal.
pub(super) fn reach(scene: &Scene, signal: usize) -> (f64, f64) {
    let Some(k) = signal.checked_sub(scene.waveforms.len()) else {
        return scene.waveforms[signal].part.range();
    };
    let block = &scene.blocks[k].part.0;
    let of = |input: &Input| match input {
        Input::Signal(signal) => reach(scene, *signal),
        Input::Length { .. } => (f64::NEG_INFINITY, f64::INFINITY),
    };
    block.range(&block.inputs().iter().map(of).collect::<Vec<_>>())
}

/// Returns value and derivatives of a signal at t = 0.
pub(super) fn first(scene: &Scene, signal: usize) -> Sample {
    let Some(k) = signal.checked_sub(scene.waveforms.len()) else {
        return scene.waveforms[signal].part.first();
    };
    let block = &scene.blocks[k].part.0;
    let of = |input: &Input| match input {
        Input::Signal(signal) => first(scene, *signal),
        Input::Length { .. } => Sample { value: 0.0, rate: 0.0, acceleration: 0.0 },
    };
    let inputs: Vec<Sample> = block.inputs().iter().map(of).collect();
    let (states, memory) = block.start(&inputs);
    let standing = Standing { law: &0, memory: &memory };
    block.signal(standing, &Moment { t: 0.0, inputs: &inputs[..], states: &states, located: true })
}
