//! The laws of a driver: where its command stands to the window, and its output stage to the limits.

use super::Spec;

/// Where the command is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Window {
    Inside,
    Below,
    Above,
}

/// What the output stage does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Output {
    /// Follows, at once or through its resistance.
    Free,
    /// Charges at the largest current.
    Rising,
    /// Discharges at the largest current.
    Falling,
}

/// A law of the driver.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Course {
    pub(super) window: Window,
    pub(super) output: Output,
}

/// Guards, each named for what it leads to.
pub(super) const INSIDE: usize = 0;
pub(super) const BELOW: usize = 1;
pub(super) const ABOVE: usize = 2;
pub(super) const RISING: usize = 3;
pub(super) const FALLING: usize = 4;
pub(super) const FREE: usize = 5;

const WINDOWS: [Window; 3] = [Window::Inside, Window::Below, Window::Above];
const OUTPUTS: [Output; 3] = [Output::Free, Output::Rising, Output::Falling];

impl Course {
    /// All laws, in the order of their numbers.
    pub(super) fn all() -> impl Iterator<Item = Self> {
        WINDOWS.into_iter().flat_map(|window| OUTPUTS.map(|output| Self { window, output }))
    }

    /// The law of a number.
    pub(super) fn of(law: usize) -> Self {
        Self { window: WINDOWS[law / 3 % 3], output: OUTPUTS[law % 3] }
    }

    /// Its number.
    pub(super) fn law(self) -> usize {
        3 * self.window as usize + self.output as usize
    }

    /// What ends it.
    pub(super) fn guards(self, spec: &Spec) -> Vec<usize> {
        let window = match (spec.window, self.window) {
            (None, _) => &[][..],
            (_, Window::Inside) => &[BELOW, ABOVE],
            _ => &[INSIDE],
        };
        let output = match (spec.current, self.output) {
            (None, _) => &[][..],
            (_, Output::Free) => &[RISING, FALLING],
            _ => &[FREE],
        };
        [window, output].concat()
    }

    /// What it is called that this law begins after another.
    pub(super) fn word(self, before: Self) -> &'static str {
        if self.output == before.output {
            return match self.window {
                Window::Inside => "voltage in window",
                Window::Below => "voltage at lower end",
                Window::Above => "voltage at upper end",
            };
        }
        match self.output {
            Output::Free => "current in limits",
            Output::Rising => "current limit up",
            Output::Falling => "current limit down",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn laws_are_numbered_in_order() {
        for (law, course) in Course::all().enumerate() {
            assert_eq!((course.law(), Course::of(law)), (law, course));
        }
    }
}
