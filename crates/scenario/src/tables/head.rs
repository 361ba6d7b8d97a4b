//! Headers of table columns: a name and optionally a unit.

use crate::units::{self, Kind, Scale, advice, of_another};

/// Expected contents of a column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Column {
    Time,
    /// Values of the quantity that follows the waveform.
    Value,
    /// Quantity of this dimension; the header must have a unit.
    Of(Kind),
}

/// Header of a column, such as `disp (µm)`, `t [ms]`, `disp_um` or `time/ms`.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Head {
    /// Header as it stands in the file.
    pub(super) full: String,
    /// Name without the unit.
    bare: String,
    unit: Option<Unit>,
}

/// Unit in a header.
#[derive(Debug, Clone, PartialEq)]
struct Unit {
    text: String,
    /// Whether the unit is in brackets. After a slash or an underscore, the end of a name may look like a unit.
    bracketed: bool,
}

/// Conversion of the numbers of a column to SI, and their dimension if the header has a unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Measure {
    pub(super) kind: Option<Kind>,
    pub(super) scale: Scale,
}

/// Reason why a header cannot be read, and help.
#[derive(Debug, PartialEq)]
pub(super) struct Unreadable {
    pub(super) message: String,
    pub(super) help: String,
}

impl Head {
    /// Reads the header of a column. The text has no blanks at its ends.
    pub(super) fn new(full: &str) -> Self {
        let bracketed = [('(', ')'), ('[', ']')].into_iter().find_map(|(open, close)| {
            let (bare, unit) = full.strip_suffix(close)?.rsplit_once(open)?;
            Some((bare, unit, true))
        });
        let of =
            |(bare, text): (&str, &str)| Some((bare.to_owned(), text.to_owned())).filter(|_| is_unit(text));
        // A text that is a unit as a whole, such as N/m, is the name.
        let apart = if is_unit(full) { None } else { full.split_once('/').and_then(of) };
        let apart = apart.or_else(|| full.rsplit_once('_').and_then(of));
        let apart = apart.map(|(bare, text)| (bare, Unit { text, bracketed: false }));
        let found = match bracketed {
            Some((bare, text, bracketed)) => {
                Some((bare.to_owned(), Unit { text: text.to_owned(), bracketed }))
            }
            None => apart,
        };
        let found =
            found.map(|(bare, unit)| (bare.trim().to_owned(), unit)).filter(|(bare, _)| !bare.is_empty());
        match found {
            Some((bare, unit)) => Self { full: full.to_owned(), bare, unit: Some(unit) },
            None => Self { full: full.to_owned(), bare: full.to_owned(), unit: None },
        }
    }

    /// Returns whether `name` is the full header.
    pub(super) fn is(&self, name: &str) -> bool {
        self.full == name
    }

    /// Returns whether `name` is the header without its unit.
    pub(super) fn is_bare(&self, name: &str) -> bool {
        self.bare == name
    }

    /// Returns the name without the unit.
    pub(super) fn bare(&self) -> &str {
        &self.bare
    }

    /// Returns the conversion of the numbers to SI. Numbers without a unit are in SI.
    ///
    /// A unit in brackets must be a known unit of a suitable dimension. A unit after a slash or an underscore counts only if its
    /// dimension is suitable; otherwise it is part of the name.
    pub(super) fn measure(&self, column: Column) -> Result<Measure, Unreadable> {
        let si = Measure { kind: None, scale: Scale::Ten(0) };
        let wanted = match column {
            Column::Time => Some(Kind::Time),
            Column::Value => None,
            Column::Of(kind) => Some(kind),
        };
        let unit = match (&self.unit, column) {
            (Some(unit), _) => unit,
            // Measured profiles are in micrometres or nanometres, so a missing unit is an error.
            (None, Column::Of(kind)) => return Err(self.without_unit(kind)),
            (None, Column::Time | Column::Value) => return Ok(si),
        };
        let Some((kind, scale)) = units::find(&unit.text) else {
            let message = format!("\"{}\" is not a unit", crate::document::shown(&unit.text));
            return Err(Unreadable { message, help: advice(&unit.text, wanted) });
        };
        let fits = match column {
            Column::Time => kind == Kind::Time,
            Column::Value => {
                matches!(kind, Kind::Length | Kind::Force | Kind::Moment | Kind::Angle | Kind::Voltage)
            }
            Column::Of(wanted) => kind == wanted,
        };
        match (fits, unit.bracketed) {
            (true, _) => Ok(Measure { kind: Some(kind), scale }),
            (false, false) => match column {
                Column::Of(kind) => Err(self.without_unit(kind)),
                Column::Time | Column::Value => Ok(si),
            },
            (false, true) => Err(Unreadable {
                message: match column {
                    Column::Time => "expected a column of times".to_owned(),
                    Column::Value => {
                        "expected a column of lengths, forces, moments, angles or voltages".to_owned()
                    }
                    Column::Of(kind) => format!("expected a column of {}s", plural(kind)),
                },
                help: match wanted {
                    Some(wanted) => of_another(&unit.text, kind, wanted),
                    None => {
                        format!(
                            "{} is a unit of {}, but no waveform has this quantity",
                            unit.text,
                            kind.article()
                        )
                    }
                },
            }),
        }
    }
}

impl Head {
    /// Returns the error of a header without the required unit.
    fn without_unit(&self, kind: Kind) -> Unreadable {
        let name = crate::document::shown(&self.full);
        Unreadable {
            message: format!("the header \"{name}\" has no unit of {}", kind.article()),
            help: format!(
                "add a unit after the name, such as \"{name} ({})\"",
                if kind == Kind::Force { "mN" } else { "um" }
            ),
        }
    }
}

/// Returns the word for a dimension without its article.
fn plural(kind: Kind) -> &'static str {
    kind.article().split_once(' ').map_or("", |(_, word)| word)
}

/// Returns whether a text after a slash or an underscore is a unit.
fn is_unit(text: &str) -> bool {
    // `min` mostly means minimum, not minutes.
    text.trim() != "min" && units::find(text).is_some()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(head: &str, column: Column) -> Option<(String, Option<Kind>, Scale)> {
        let head = Head::new(head);
        head.measure(column).ok().map(|measure| (head.bare.clone(), measure.kind, measure.scale))
    }

    #[test]
    fn units_are_read_wherever_people_write_them() {
        let length = |bare: &str, shift| Some((bare.to_owned(), Some(Kind::Length), Scale::Ten(shift)));
        for head in ["disp (µm)", "disp [um]", "disp(μm)", "disp_um", "disp/µm", "disp / um"] {
            assert_eq!(read(head, Column::Value), length("disp", -6), "{head}");
        }
        assert_eq!(read("stage x (fine) [nm]", Column::Value), length("stage x (fine)", -9));
        let time = |bare: &str, shift| Some((bare.to_owned(), Some(Kind::Time), Scale::Ten(shift)));
        assert_eq!(read("t [ms]", Column::Time), time("t", -3));
        assert_eq!(read("time/ms", Column::Time), time("time", -3));
        assert_eq!(read("time_s", Column::Time), time("time", 0));
        assert_eq!(read("t (min)", Column::Time).map(|t| t.2), Some(Scale::Factor(60.0)));
        assert_eq!(read("F [mN]", Column::Value).map(|f| f.1), Some(Some(Kind::Force)));
    }

    #[test]
    fn names_that_end_like_units_are_names() {
        for (head, column) in [
            ("t_min", Column::Time),
            ("index_s", Column::Value),
            ("channel_Hz", Column::Value),
            ("mass_g", Column::Value),
            ("run_um", Column::Time),
            ("N/m", Column::Value),
            ("_um", Column::Value),
            ("disp", Column::Value),
            ("left/right", Column::Value),
            ("", Column::Value),
        ] {
            assert_eq!(
                read(head, column).map(|read| (read.1, read.2)),
                Some((None, Scale::Ten(0))),
                "{head}"
            );
        }
    }

    #[test]
    fn what_stands_in_brackets_must_be_a_unit_that_fits() {
        let refused = |head: &str, column| Head::new(head).measure(column).unwrap_err();
        assert_eq!(refused("disp (microns)", Column::Value).message, "\"microns\" is not a unit");
        assert!(refused("disp (microns)", Column::Value).help.starts_with("did you mean \"um\"?"));
        assert_eq!(refused("t (um)", Column::Time).message, "expected a column of times");
        assert!(refused("v [mm/s]", Column::Value).help.contains("a velocity"));
        assert_eq!(refused("d (N)", Column::Of(Kind::Length)).message, "expected a column of lengths");
    }

    #[test]
    fn a_column_of_a_profile_names_its_unit() {
        let length = Column::Of(Kind::Length);
        assert_eq!(read("z_nm", length), Some(("z".to_owned(), Some(Kind::Length), Scale::Ten(-9))));
        for head in ["z", "F_mN", "z/a"] {
            let refused = Head::new(head).measure(length).unwrap_err();
            assert_eq!(refused.message, format!("the header \"{head}\" has no unit of a length"));
        }
    }
}
