//! Schema of a quantity.

use crate::units::{self, Kind};
use schemars::{Schema, json_schema};

/// [`units::BLANKS`] as a regular expression.
const BLANK: &str = r" \t\u00a0\u2009\u202f";

/// Returns the schema of a number, or a string with a unit of the dimension.
pub(super) fn schema_of(kind: Option<Kind>) -> Schema {
    let units: Vec<String> = units::symbols(kind).map(pattern_of).collect();
    let number = r"-?[0-9]+(\.[0-9]+)?([eE][+-]?[0-9]+)?";
    let pattern = format!("^[{BLANK}]*{number}[{BLANK}]*({})[{BLANK}]*$", units.join("|"));
    let description = match kind {
        Some(kind) => {
            let (article, si, example) = (capital(kind.article()), kind.si(), kind.example());
            format!("{article}: a number in {si}, or a string such as \"{example}\".")
        }
        None => "A quantity: a number in SI, or a string with a unit such as \"5 um\". Its dimension is that of the \
                 place that follows the waveform."
            .to_owned(),
    };
    json_schema!({
        "description": description,
        "anyOf": [{ "type": "number" }, { "type": "string", "pattern": pattern }]
    })
}

/// Returns a regular expression for all spellings of a unit that [`units::normalise`] accepts.
fn pattern_of(symbol: &str) -> String {
    let micro = if symbol.starts_with('u') || symbol.contains("/u") {
        symbol.replacen('u', "[uµμ]", 1)
    } else {
        symbol.to_owned()
    };
    micro
        .replace("^2", "(\\^2|²)")
        .replace("ohm", "(ohm|Ω|Ω)")
        .replace("deg", "(deg|°)")
        .replace(' ', &format!("[{BLANK}·⋅*]+"))
}

fn capital(text: &str) -> String {
    let mut chars = text.chars();
    chars.next().map(|c| c.to_uppercase().chain(chars).collect()).unwrap_or_default()
}
