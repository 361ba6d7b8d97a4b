//! What the name of a channel or figure says.

/// SI units by the end of a name.
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

/// SI unit of a channel or figure; empty where it has none.
pub fn unit(name: &str) -> &'static str {
    let name = name.split('[').next().unwrap_or(name);
    UNITS.iter().find(|(end, _)| name.ends_with(end)).map_or("", |(_, unit)| unit)
}

/// A name without its unit: `slider.x` of `slider.x_m`.
pub fn bare(name: &str) -> &str {
    UNITS.iter().find_map(|(end, _)| name.strip_suffix(end)).unwrap_or(name)
}

/// A name with its unit at the end, as columns have it: `stroke_m`.
pub fn with_unit(name: &str, unit: &str) -> String {
    let unit = unit.replace([' ', '/'], "_").replace('²', "2").replace('Ω', "Ohm");
    if unit.is_empty() { name.to_owned() } else { format!("{name}_{unit}") }
}

/// What a channel or figure belongs to: `slider` of `slider.x_m`, `ball` of `contacts.ball.friction_J`.
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
