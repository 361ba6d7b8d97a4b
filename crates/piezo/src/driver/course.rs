//! Modes of the driver: position of the command relative to the window, and state of the output stage relative to the current limits.

use super::Spec;

/// Position of the command relative to the voltage window.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Window {
    Inside,
    Below,
    Above,
}

/// Operation of the output stage.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Output {
    /// Follows its input, directly or through the resistance.
    Free,
    /// Charges at the upper current limit.
    Rising,
    /// Discharges at the lower current limit.
    Falling,
}

/// Mode of the driver.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Course {
    pub(super) window: Window,
    pub(super) output: Output,
}

/// Indices of the event functions. Each event function is named after the mode that follows its event.
pub(super) const INSIDE: usize = 0;
pub(super) const BELOW: usize = 1;
pub(super) const ABOVE: usize = 2;
pub(super) const RISING: usize = 3;
pub(super) const FALLING: usize = 4;
pub(super) const FREE: usize = 5;

const WINDOWS: [Window; 3] = [Window::Inside, Window::Below, Window::Above];
const OUTPUTS: [Output; 3] = [Output::Free, Output::Rising, Output::Falling];

impl Course {
    /// Returns all modes in the order of their numbers.
    pub(super) fn all() -> impl Iterator<Item = Self> {
        WINDOWS.into_iter().flat_map(|window| OUTPUTS.map(|output| Self { window, output }))
    }

    /// Returns the mode with a number.
    pub(super) fn of(law: usize) -> Self {
        Self { window: WINDOWS[law / 3 % 3], output: OUTPUTS[law % 3] }
    }

    /// Returns the number of the mode.
    pub(super) fn law(self) -> usize {
        3 * self.window as usize + self.output as usize
    }

    /// Returns the indices of the event functions that end the mode.
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

    /// Returns the name of the event that changes the mode from `before` to this mode.
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
