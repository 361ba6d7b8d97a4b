//! Dimensions and units of the scenario file.

mod advice;

pub(crate) use advice::{advice, of_another};

use std::f64::consts::PI;

/// Dimension of a quantity.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) enum Kind {
    Length,
    Time,
    Frequency,
    Velocity,
    AngularVelocity,
    Acceleration,
    Mass,
    Inertia,
    Force,
    Moment,
    Stiffness,
    Damping,
    Pressure,
    Angle,
    Resistance,
    SlewRate,
    StrokePerVoltage,
    Voltage,
    Current,
    Capacitance,
    Storage,
}

/// Conversion of a unit to the SI unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Scale {
    /// Power of ten, added to the decimal exponent so that the number is rounded only once.
    Ten(i32),
    /// Factor that is not a power of ten.
    Factor(f64),
}

impl Kind {
    /// Returns the name of the dimension with its article.
    pub(crate) fn article(self) -> &'static str {
        self.words().0
    }

    /// Returns an example of a quantity of this dimension.
    pub(crate) fn example(self) -> &'static str {
        self.words().1
    }

    /// Returns the dimension of this name.
    pub(crate) fn named(name: &str) -> Option<Self> {
        UNITS.iter().map(|(_, kind, _)| *kind).find(|kind| format!("{kind:?}") == name)
    }

    /// Returns the symbol of the SI unit.
    pub(crate) fn si(self) -> &'static str {
        self.words().2
    }

    fn words(self) -> (&'static str, &'static str, &'static str) {
        match self {
            Self::Length => ("a length", "5 um", "m"),
            Self::Time => ("a time", "10 ms", "s"),
            Self::Frequency => ("a frequency", "1 kHz", "Hz"),
            Self::Velocity => ("a velocity", "2 mm/s", "m/s"),
            Self::AngularVelocity => ("an angular velocity", "3 rad/s", "rad/s"),
            Self::Acceleration => ("an acceleration", "9.81 m/s²", "m/s²"),
            Self::Mass => ("a mass", "10 g", "kg"),
            Self::Inertia => ("a moment of inertia", "1e-6 kg m²", "kg m²"),
            Self::Force => ("a force", "0.3 N", "N"),
            Self::Moment => ("a moment", "1e-3 N m", "N m"),
            Self::Stiffness => ("a stiffness", "2 N/um", "N/m"),
            Self::Damping => ("a damping", "0.5 N s/m", "N s/m"),
            Self::Pressure => ("a pressure", "210 GPa", "Pa"),
            Self::Angle => ("an angle", "90 deg", "rad"),
            Self::Resistance => ("a resistance", "50 Ω", "Ω"),
            Self::SlewRate => ("a slew rate", "10 V/us", "V/s"),
            Self::StrokePerVoltage => ("a stroke per voltage", "20 nm/V", "m/V"),
            Self::Voltage => ("a voltage", "60 V", "V"),
            Self::Current => ("a current", "100 mA", "A"),
            Self::Capacitance => ("a capacitance", "200 nF", "F"),
            Self::Storage => ("an amount of memory", "512 MB", "B"),
        }
    }
}

/// Blank, tab, no-break space, thin space, narrow no-break space.
pub(crate) const BLANKS: [char; 5] = [' ', '\t', '\u{a0}', '\u{2009}', '\u{202f}'];

/// All units: normalised symbol (see [`normalise`]), dimension, scale.
pub(crate) const UNITS: &[(&str, Kind, Scale)] = {
    use Kind::*;
    use Scale::{Factor, Ten};
    &[
        ("nm", Length, Ten(-9)),
        ("um", Length, Ten(-6)),
        ("mm", Length, Ten(-3)),
        ("m", Length, Ten(0)),
        ("ns", Time, Ten(-9)),
        ("us", Time, Ten(-6)),
        ("ms", Time, Ten(-3)),
        ("s", Time, Ten(0)),
        ("min", Time, Factor(60.0)),
        ("Hz", Frequency, Ten(0)),
        ("kHz", Frequency, Ten(3)),
        ("MHz", Frequency, Ten(6)),
        ("GHz", Frequency, Ten(9)),
        ("m/s", Velocity, Ten(0)),
        ("mm/s", Velocity, Ten(-3)),
        ("um/s", Velocity, Ten(-6)),
        ("nm/s", Velocity, Ten(-9)),
        ("rad/s", AngularVelocity, Ten(0)),
        ("mrad/s", AngularVelocity, Ten(-3)),
        ("m/s^2", Acceleration, Ten(0)),
        ("mg", Mass, Ten(-6)),
        ("g", Mass, Ten(-3)),
        ("kg", Mass, Ten(0)),
        ("kg m^2", Inertia, Ten(0)),
        ("kg mm^2", Inertia, Ten(-6)),
        ("g mm^2", Inertia, Ten(-9)),
        ("uN", Force, Ten(-6)),
        ("mN", Force, Ten(-3)),
        ("N", Force, Ten(0)),
        ("kN", Force, Ten(3)),
        ("N m", Moment, Ten(0)),
        ("mN m", Moment, Ten(-3)),
        ("uN m", Moment, Ten(-6)),
        ("N/m", Stiffness, Ten(0)),
        ("N/mm", Stiffness, Ten(3)),
        ("N/um", Stiffness, Ten(6)),
        ("kN/m", Stiffness, Ten(3)),
        ("N s/m", Damping, Ten(0)),
        ("Pa", Pressure, Ten(0)),
        ("kPa", Pressure, Ten(3)),
        ("MPa", Pressure, Ten(6)),
        ("GPa", Pressure, Ten(9)),
        ("deg", Angle, Factor(PI / 180.0)),
        ("rad", Angle, Ten(0)),
        ("mrad", Angle, Ten(-3)),
        ("urad", Angle, Ten(-6)),
        ("mohm", Resistance, Ten(-3)),
        ("ohm", Resistance, Ten(0)),
        ("kohm", Resistance, Ten(3)),
        ("Mohm", Resistance, Ten(6)),
        ("V/s", SlewRate, Ten(0)),
        ("V/us", SlewRate, Ten(6)),
        ("m/V", StrokePerVoltage, Ten(0)),
        ("nm/V", StrokePerVoltage, Ten(-9)),
        ("um/V", StrokePerVoltage, Ten(-6)),
        ("mV", Voltage, Ten(-3)),
        ("V", Voltage, Ten(0)),
        ("kV", Voltage, Ten(3)),
        ("nA", Current, Ten(-9)),
        ("uA", Current, Ten(-6)),
        ("mA", Current, Ten(-3)),
        ("A", Current, Ten(0)),
        ("pF", Capacitance, Ten(-12)),
        ("nF", Capacitance, Ten(-9)),
        ("uF", Capacitance, Ten(-6)),
        ("mF", Capacitance, Ten(-3)),
        ("F", Capacitance, Ten(0)),
        ("B", Storage, Ten(0)),
        ("kB", Storage, Ten(3)),
        ("MB", Storage, Ten(6)),
        ("GB", Storage, Ten(9)),
    ]
};

/// Normalises the spelling of a unit. µ (U+00B5) and μ (U+03BC) become u, ² becomes ^2, Ω ohm, ° deg, a middle dot or star a blank.
pub(crate) fn normalise(unit: &str) -> String {
    let mut plain = String::with_capacity(unit.len());
    for c in unit.chars() {
        match c {
            '\u{b5}' | '\u{3bc}' => plain.push('u'),
            '\u{b2}' => plain.push_str("^2"),
            '\u{3a9}' | '\u{2126}' => plain.push_str("ohm"),
            '\u{b0}' => plain.push_str("deg"),
            c if is_times(c) => plain.push(' '),
            c if is_blank(c) => plain.push(' '),
            c => plain.push(c),
        }
    }
    plain.split(' ').filter(|word| !word.is_empty()).collect::<Vec<_>>().join(" ")
}

/// Returns whether a character is a blank that may separate number and unit.
pub(crate) fn is_blank(c: char) -> bool {
    BLANKS.contains(&c)
}

/// Returns whether a character is a multiplication sign.
fn is_times(c: char) -> bool {
    matches!(c, '\u{b7}' | '\u{22c5}' | '*')
}

/// Returns dimension and scale of a unit.
pub(crate) fn find(symbol: &str) -> Option<(Kind, Scale)> {
    let symbol = symbol.trim_matches(is_blank);
    if symbol.starts_with(is_times) || symbol.ends_with(is_times) {
        return None;
    }
    let plain = normalise(symbol);
    UNITS.iter().find(|(known, ..)| *known == plain).map(|&(_, kind, scale)| (kind, scale))
}

/// Returns the dimension with this SI unit, or `None` if no quantity of a scenario has it.
pub(crate) fn of_si(symbol: &str) -> Option<Kind> {
    let plain = normalise(symbol);
    UNITS.iter().map(|(_, kind, _)| *kind).find(|kind| normalise(kind.si()) == plain)
}

/// Returns the symbols of a dimension, or of all dimensions.
pub(crate) fn symbols(kind: Option<Kind>) -> impl Iterator<Item = &'static str> {
    UNITS.iter().filter(move |(_, k, _)| kind.is_none_or(|kind| *k == kind)).map(|(symbol, ..)| *symbol)
}
