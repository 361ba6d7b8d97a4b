//! Selection of trace columns by name.

use crate::document::shown;
use crate::fault::Fault;
use crate::path::At;
use crate::suggest;
use std::collections::{HashMap, HashSet};
use stickslip_drive::Channel;

/// Returns the indices of the channels with these names, which are those of the list `key` of a section.
pub(crate) fn places(
    [section, key]: [&'static str; 2],
    names: &[String],
    channels: &[Channel],
) -> Result<Vec<usize>, Fault> {
    let known: HashMap<&str, usize> =
        channels.iter().enumerate().map(|(place, channel)| (channel.name.as_str(), place)).collect();
    let (root, list) = (At::ROOT, format!("{section}.{key}"));
    let section = root.key(section);
    let at = section.key(key);
    let (mut places, mut taken) = (Vec::new(), HashSet::new());
    for (i, name) in names.iter().enumerate() {
        let at = at.index(i);
        let Some(&place) = known.get(name.as_str()) else {
            let fault = at.fault(format!("there is no channel \"{}\"", shown(name)));
            let fault = fault.against(["bodies", "contacts"]);
            return Err(fault.maybe_help(suggest::help(name, channels.iter().map(|c| c.name.as_str()))));
        };
        if !taken.insert(place) {
            return Err(at.fault("this channel is already in the list").against([list.as_str()]));
        }
        places.push(place);
    }
    Ok(places)
}
