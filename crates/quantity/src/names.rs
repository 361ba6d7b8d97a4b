//! Unit and owner in the name of a channel or result.

/// SI units by the suffix of a name.
const UNITS: [(&str, &str); 13] = [
    ("_rad_s", "rad/s"),
    ("_m_s", "m/s"),
    ("_N_m", "N/m"),
    ("_m_V", "m/V"),
    ("_rad", "rad"),
    ("_Hz", "Hz"),
    ("_m", "m"),
    ("_N", "N"),
    ("_J", "J"),
    ("_V", "V"),
    ("_A", "A"),
    ("_F", "F"),
    ("_s", "s"),
];

/// Returns the SI unit of a channel or result, or an empty text if it has none.
pub fn unit(name: &str) -> &'static str {
    let name = name.split('[').next().unwrap_or(name);
    UNITS.iter().find(|(end, _)| name.ends_with(end)).map_or("", |(_, unit)| unit)
}

/// Returns a name without its unit: `slider.x` of `slider.x_m`.
pub fn bare(name: &str) -> &str {
    UNITS.iter().find_map(|(end, _)| name.strip_suffix(end)).unwrap_or(name)
}

/// Returns a name with its unit as suffix, as in the names of columns: `stroke_m`.
pub fn with_unit(name: &str, unit: &str) -> String {
    let unit = unit.replace([' ', '/'], "_").replace('²', "2").replace('Ω', "Ohm");
    if unit.is_empty() { name.to_owned() } else { format!("{name}_{unit}") }
}

/// Returns the part that a channel or result belongs to: `slider` of `slider.x_m`, `ball` of `contacts.ball.friction_J`.
pub fn owner(name: &str) -> &str {
    let mut parts = name.split('.');
    let first = parts.next().unwrap_or(name);
    match (parts.next(), parts.next()) {
        (Some(second), Some(_)) if first == "contacts" => second,
        _ => first,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_tell_unit_and_owner() {
        let read = |name| (owner(name), unit(name));
        assert_eq!(read("slider.x_m"), ("slider", "m"));
        assert_eq!(read("slider.vpitch_rad_s"), ("slider", "rad/s"));
        assert_eq!(read("stack.current_A"), ("stack", "A"));
        assert_eq!(read("ball.state"), ("ball", ""));
        assert_eq!(read("contacts.ball.fretting.cycle_s[1]"), ("ball", "s"));
        assert_eq!(read("contacts.x_m"), ("contacts", "m"));
        assert_eq!(read("steps.lengths_m[12]"), ("steps", "m"));
    }
}
