//! Checks of plots.

use super::{Builder, range, run};
use crate::PlotName;
use crate::document::shown;
use crate::fault::Fault;
use crate::form::{OwnPlotForm, PlotForm};
use crate::guide::Help;
use crate::path::At;
use crate::suggest;
use stickslip_drive::{Channel, Plan};

/// Maximum number of user-defined plots, whose files are numbered.
pub(crate) const MOST_OWN: usize = 16;

/// User-defined plot of channels over a channel.
#[derive(Debug, Clone, PartialEq)]
pub struct OwnPlot {
    /// Channel of the horizontal axis.
    pub x: String,
    /// Channels of the vertical axis, at least one.
    pub y: Vec<String>,
    /// Start and end time, s.
    pub span: (f64, f64),
    /// Index in the list of all plots.
    pub(crate) place: usize,
    /// Whether `y` is a list in the file.
    is_list: bool,
}

impl Builder<'_> {
    /// Checks that the scenario has the contacts and bodies that the plots show.
    pub(super) fn plots(&self) -> Result<(), Fault> {
        let root = At::ROOT;
        let at = root.key("plots");
        for (i, plot) in self.form.plots.iter().enumerate() {
            let (lacks, section) = match plot.name() {
                PlotName::Loop if self.scene.contacts.is_empty() => ("contact", "contacts"),
                PlotName::Layout | PlotName::Trajectory if self.scene.bodies.is_empty() => ("body", "bodies"),
                _ => continue,
            };
            let fault = at.index(i).fault(format!("the scenario has no {lacks} to draw"));
            let fault = fault.against([section]);
            return Err(fault.help("leave this plot out"));
        }
        Ok(())
    }

    /// Returns the user-defined plots, each with its time range.
    pub(super) fn own_plots(&self, plan: Plan) -> Result<Vec<OwnPlot>, Fault> {
        let root = At::ROOT;
        let at = root.key("plots");
        let own = self.form.plots.iter().enumerate().filter_map(|(place, plot)| match plot {
            PlotForm::Own(own) => Some((place, own)),
            PlotForm::Named(_) => None,
        });
        let mut plots = Vec::new();
        for (place, own) in own {
            let at = at.index(place);
            if plots.len() == MOST_OWN {
                let message = format!("expected at most {MOST_OWN} plots of channels");
                return Err(at.fault(message).help("one plot can have several channels: \"y\" takes a list"));
            }
            plots.push(self.own_plot(&at, (place, own), plan)?);
        }
        Ok(plots)
    }

    fn own_plot(
        &self,
        at: &At<'_>,
        (place, own): (usize, &OwnPlotForm),
        plan: Plan,
    ) -> Result<OwnPlot, Fault> {
        let OwnPlotForm { x, y, from, to } = own;
        let from_at = at.key("from");
        let start = from.map(|from| range::at_least_zero(&from_at, from)).transpose()?.unwrap_or(0.0);
        if start >= plan.duration {
            let before = format_args!("a time before the end of the run, {} s", plan.duration);
            let fault = from_at.expected(before);
            return Err(fault.against(run::duration(self.form).iter().copied()));
        }
        let to_at = at.key("to");
        let end = to.map(|to| range::at_least_zero(&to_at, to)).transpose()?.unwrap_or(f64::INFINITY);
        if end <= start {
            let fault = to_at.expected(format_args!("a time after the start of the plot, {start} s"));
            return Err(fault.against_path(from_at.path()));
        }
        if y.names.is_empty() {
            return Err(at.key("y").fault("expected at least one channel").ask(Help::Shape));
        }
        Ok(OwnPlot { x: x.clone(), y: y.names.clone(), span: (start, end), place, is_list: y.is_list })
    }
}

/// Checks that the channels of user-defined plots exist and are numbers.
pub(crate) fn check(own: &[OwnPlot], channels: &[Channel]) -> Result<(), Fault> {
    let root = At::ROOT;
    let plots = root.key("plots");
    let numbers = || channels.iter().filter(|channel| !channel.is_state).map(|c| c.name.as_str());
    for plot in own {
        let at = plots.index(plot.place);
        known(&at.key("x"), &plot.x, numbers)?;
        let y = at.key("y");
        for (i, name) in plot.y.iter().enumerate() {
            let item = y.index(i);
            known(if plot.is_list { &item } else { &y }, name, numbers)?;
        }
    }
    Ok(())
}

fn known<'c, I: Iterator<Item = &'c str>>(
    at: &At<'_>,
    name: &str,
    numbers: impl Fn() -> I,
) -> Result<(), Fault> {
    if numbers().any(|number| number == name) {
        return Ok(());
    }
    let fault = at.fault(format!("there is no channel \"{}\" with numbers", shown(name)));
    Err(fault.against(["bodies", "contacts"]).maybe_help(suggest::help(name, numbers())))
}
