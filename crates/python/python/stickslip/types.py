"""Types of a scenario's dict, made from its JSON Schema by tools/make_types.py: editors complete keys and check values."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, Protocol, TypedDict, Union

if TYPE_CHECKING:
    from typing_extensions import NotRequired


class WithUnits(Protocol):
    """A quantity with units, such as those of pint."""

    def to_base_units(self) -> Any: ...


Quantity = Union[float, str, WithUnits]
"""A number in the SI unit, a text with a unit such as "0.5 mm", or a quantity of pint."""


class SawtoothKind(TypedDict):
    """Sawtooth cycle: a linear rise from 0 to the stroke and a linear fall in the flyback. The heading
    "backward" reverses the cycle in time."""

    sawtooth: "SawtoothCycle"
    """Sawtooth cycle: a linear rise from 0 to the stroke and a linear fall in the flyback. The heading
    "backward" reverses the cycle in time."""


class TriangleKind(TypedDict):
    """Triangle: a linear rise from 0 to the stroke in half a period and a linear fall."""

    triangle: "Triangle"
    """Triangle: a linear rise from 0 to the stroke in half a period and a linear fall."""


class SineKind(TypedDict):
    """Sine: offset + amplitude · sin(ωt + phase)."""

    sine: "Sine"
    """Sine: offset + amplitude · sin(ωt + phase)."""


class HarmonicsKind(TypedDict):
    """Harmonics: the sum of amplitude · sin(order · ωt + phase)."""

    harmonics: "Harmonics"
    """Harmonics: the sum of amplitude · sin(order · ωt + phase)."""


class CycloidKind(TypedDict):
    """Cycloid: a rise by the cycloidal law stroke · (τ - sin(2πτ)/2π), 0 ≤ τ ≤ 1. The fall by the same law is
    the flyback that ends the period."""

    cycloid: "Cycloid"
    """Cycloid: a rise by the cycloidal law stroke · (τ - sin(2πτ)/2π), 0 ≤ τ ≤ 1. The fall by the same law is
    the flyback that ends the period."""


class TableKind(TypedDict):
    """Profile given by points (r, f). The equivalent one-dimensional profile g(x) is computed from them."""

    table: "GapTable"
    """Profile given by points (r, f). The equivalent one-dimensional profile g(x) is computed from them."""


class InputKind(TypedDict):
    """Input: values that a calling program gives during the run, held or ramped in between. `stickslip run`
    holds the initial value. An input has no period, so steps per period are not evaluated."""

    input: "Input"
    """Input: values that a calling program gives during the run, held or ramped in between. `stickslip run`
    holds the initial value. An input has no period, so steps per period are not evaluated."""


class GeneratorKind(TypedDict):
    """Generator: cycles made by the program, whose stroke, frequency, heading and number a calling program
    commands during the run. `stickslip run` uses the values given here."""

    generator: "Generator"
    """Generator: cycles made by the program, whose stroke, frequency, heading and number a calling program
    commands during the run. `stickslip run` uses the values given here."""


class TwoHarmonicsKind(TypedDict):
    """Two harmonics: amplitude · (sin ωt + second · sin 2ωt), a smooth waveform that is faster in one direction
    than in the other."""

    two_harmonics: "TwoHarmonics"
    """Two harmonics: amplitude · (sin ωt + second · sin 2ωt), a smooth waveform that is faster in one direction
    than in the other."""


class ParabolaKind(TypedDict):
    """Parabola: a rise from rest at 0 with constant acceleration, a turn at the stroke (a cusp by default), and
    the mirror image back."""

    parabola: "Parabola"
    """Parabola: a rise from rest at 0 with constant acceleration, a turn at the stroke (a cusp by default), and
    the mirror image back."""


class TrapezoidKind(TypedDict):
    """Trapezoid: a linear rise from 0 to the stroke, a hold, a linear fall, and a rest until the period ends."""

    trapezoid: "Trapezoid"
    """Trapezoid: a linear rise from 0 to the stroke, a hold, a linear fall, and a rest until the period ends."""


class SCurveKind(TypedDict):
    """S-curve: a rise and, in the flyback that ends the period, a fall, each from rest to rest with a limited
    jerk."""

    s_curve: "SCurve"
    """S-curve: a rise and, in the flyback that ends the period, a fall, each from rest to rest with a limited
    jerk."""


class ChirpKind(TypedDict):
    """Chirp: a sine whose frequency changes linearly from one value to another, once."""

    chirp: "Chirp"
    """Chirp: a sine whose frequency changes linearly from one value to another, once."""


class StepKind(TypedDict):
    """Step: a jump from 0 to another value at a given time. In the jump, contacts move instantaneously on a
    straight path."""

    step: "Step"
    """Step: a jump from 0 to another value at a given time. In the jump, contacts move instantaneously on a
    straight path."""


class FollowsKind(TypedDict):
    """The coordinate follows a waveform, given in m for x and z, in rad for pitch. Write its name, or the
    waveform itself."""

    follows: "WaveformRef"
    """The coordinate follows a waveform, given in m for x and z, in rad for pitch. Write its name, or the
    waveform itself."""


class FlatKind(TypedDict):
    """Flat cylindrical punch."""

    flat: "Flat"
    """Flat cylindrical punch."""


class ConeKind(TypedDict):
    """Cone, f = slope · r."""

    cone: "Cone"
    """Cone, f = slope · r."""


class ParaboloidKind(TypedDict):
    """Paraboloid, f = r²/(2R), the profile of Hertzian contact."""

    paraboloid: "Ball"
    """Paraboloid, f = r²/(2R), the profile of Hertzian contact."""


class SphereKind(TypedDict):
    """Sphere, f = R - √(R²-r²), without the parabolic approximation."""

    sphere: "Ball"
    """Sphere, f = R - √(R²-r²), without the parabolic approximation."""


class PowerKind(TypedDict):
    """Power law, f = A rⁿ."""

    power: "Power"
    """Power law, f = A rⁿ."""


class FoundationKind(TypedDict):
    """One-dimensional foundation given by the heights of its springs, in any order."""

    foundation: "Foundation"
    """One-dimensional foundation given by the heights of its springs, in any order."""


class TruncatedConeKind(TypedDict):
    """Worn cone: flat up to a radius, beyond it f = slope · (r - flat)."""

    truncated_cone: "TruncatedCone"
    """Worn cone: flat up to a radius, beyond it f = slope · (r - flat)."""


class TruncatedParaboloidKind(TypedDict):
    """Worn ball: flat up to a radius, beyond it f = (r² - flat²)/(2R)."""

    truncated_paraboloid: "TruncatedParaboloid"
    """Worn ball: flat up to a radius, beyond it f = (r² - flat²)/(2R)."""


class RoundedFlatKind(TypedDict):
    """Flat punch with a rounded edge: flat up to a radius, beyond it f = (r - flat)²/(2R)."""

    rounded_flat: "RoundedFlat"
    """Flat punch with a rounded edge: flat up to a radius, beyond it f = (r - flat)²/(2R)."""


class TippedParaboloidKind(TypedDict):
    """Paraboloid with a conical tip: f = tip · r/R up to the tip's radius, beyond it f = (r² + tip²)/(2R)."""

    tipped_paraboloid: "TippedParaboloid"
    """Paraboloid with a conical tip: f = tip · r/R up to the tip's radius, beyond it f = (r² + tip²)/(2R)."""


class PowersKind(TypedDict):
    """Sum of powers, f = Σ A rⁿ."""

    powers: "Powers"
    """Sum of powers, f = Σ A rⁿ."""


class NormalLawKind(TypedDict):
    """Profile given by points of its normal law, force over indentation."""

    normal_law: "NormalLaw"
    """Profile given by points of its normal law, force over indentation."""


class RoughKind(TypedDict):
    """Rough one-dimensional profile: heights at equal distances, measured or computed. Only the distribution of
    the heights matters; the line is not a section of the surface."""

    rough: "Rough"
    """Rough one-dimensional profile: heights at equal distances, measured or computed. Only the distribution of
    the heights matters; the line is not a section of the surface."""


class ExponentialAsperitiesKind(TypedDict):
    """Rough surface of spherical tips with exponentially distributed heights. Under a prescribed normal force
    the tail of the distribution has no end; otherwise the heights end at the expected highest one, at which
    the indentation begins."""

    exponential_asperities: "ExponentialAsperities"
    """Rough surface of spherical tips with exponentially distributed heights. Under a prescribed normal force
    the tail of the distribution has no end; otherwise the heights end at the expected highest one, at which
    the indentation begins."""


class GaussianAsperitiesKind(TypedDict):
    """Rough surface of spherical tips with normally distributed heights. Under a prescribed normal force the
    tail of the distribution has no end; otherwise the heights end at the expected highest one, at which the
    indentation begins."""

    gaussian_asperities: "GaussianAsperities"
    """Rough surface of spherical tips with normally distributed heights. Under a prescribed normal force the
    tail of the distribution has no end; otherwise the heights end at the expected highest one, at which the
    indentation begins."""


class GradedParaboloidKind(TypedDict):
    """Paraboloid between bodies whose Young's modulus is E (z/depth)^exponent at the depth z; E is that of the
    materials. The ratio of tangential to normal stiffness is that of homogeneous bodies."""

    graded_paraboloid: "GradedParaboloid"
    """Paraboloid between bodies whose Young's modulus is E (z/depth)^exponent at the depth z; E is that of the
    materials. The ratio of tangential to normal stiffness is that of homogeneous bodies."""


class ForceKind(TypedDict):
    """Tangential preload force of one contact, N; its magnitude is below the friction coefficient times the
    normal force."""

    force: "Force"
    """Tangential preload force of one contact, N; its magnitude is below the friction coefficient times the
    normal force."""


class IndentationKind(TypedDict):
    """Indentation depth d, m; typical 1 nm to 1 um. At a negative depth the contact is open."""

    indentation: "MovingLength"
    """Indentation depth d, m; typical 1 nm to 1 um. At a negative depth the contact is open."""


class RadiusKind(TypedDict):
    """Contact radius, m, at least 0; typical 1 um to 100 um."""

    radius: "MovingLength"
    """Contact radius, m, at least 0; typical 1 um to 100 um."""


class DisplacementKind(TypedDict):
    """Tangential displacement u of the preload, m; typical below the onset of gross slip, some 10 nm."""

    displacement: "Length"
    """Tangential displacement u of the preload, m; typical below the onset of gross slip, some 10 nm."""


class RestKind(TypedDict):
    """Time for which the contact has rested without preload, s, at least 0; for a static friction coefficient
    that grows at rest."""

    rest: "Time"
    """Time for which the contact has rested without preload, s, at least 0; for a static friction coefficient
    that grows at rest."""


class SpringsKind(TypedDict):
    """Row of discrete springs in place of the continuous contact."""

    springs: "Springs"
    """Row of discrete springs in place of the continuous contact."""


class LoopKind(TypedDict):
    """Loop: the Prandtl–Ishlinskii model, given by the width of its hysteresis loop."""

    loop: "Loop"
    """Loop: the Prandtl–Ishlinskii model, given by the width of its hysteresis loop."""


class PlaysKind(TypedDict):
    """Plays: the Prandtl–Ishlinskii model, given by the thresholds and weights of its play operators."""

    plays: "Plays"
    """Plays: the Prandtl–Ishlinskii model, given by the thresholds and weights of its play operators."""


class BoucWenKind(TypedDict):
    """Bouc–Wen model: the output is the input v less a hysteretic part z. While |z| grows, dz/dv = A(1 -
    |z/z_m|ⁿ). While |z| decreases, dz/dv = A(1 + (2 `share` - 1)|z/z_m|ⁿ)."""

    bouc_wen: "BoucWen"
    """Bouc–Wen model: the output is the input v less a hysteretic part z. While |z| grows, dz/dv = A(1 -
    |z/z_m|ⁿ). While |z| decreases, dz/dv = A(1 + (2 `share` - 1)|z/z_m|ⁿ)."""


class EventKind(TypedDict):
    """Adaptive integration of order 8 with located events. A single slider without springs, under constant load
    and piecewise linear waveforms, is solved in closed form from event to event. The closed form exists for
    contacts whose profiles are cones, paraboloids, spheres or powers r³ and r⁴."""

    event: "Tolerance"
    """Adaptive integration of order 8 with located events. A single slider without springs, under constant load
    and piecewise linear waveforms, is solved in closed form from event to event. The closed form exists for
    contacts whose profiles are cones, paraboloids, spheres or powers r³ and r⁴."""


class VerletKind(TypedDict):
    """Velocity Verlet with a fixed time step."""

    verlet: "StepForm2"
    """Velocity Verlet with a fixed time step."""


class Rk4Kind(TypedDict):
    """Classical Runge–Kutta of order 4 with a fixed time step."""

    rk4: "StepForm2"
    """Classical Runge–Kutta of order 4 with a fixed time step."""


class FramesKind(TypedDict):
    """Real-time stepping in frames of equal length and bounded work. A frame has as many Runge–Kutta steps of
    order 4 as its accuracy needs. Steps end at corners of waveforms. A contact remembers at most 256 turning
    points, 1024 under a varying normal load."""

    frames: "Frames"
    """Real-time stepping in frames of equal length and bounded work. A frame has as many Runge–Kutta steps of
    order 4 as its accuracy needs. Steps end at corners of waveforms. A contact remembers at most 256 turning
    points, 1024 under a varying normal load."""


class Dopri5Kind(TypedDict):
    """Dormand–Prince 5(4) without located events, a plain explicit reference method."""

    dopri5: "Tolerance"
    """Dormand–Prince 5(4) without located events, a plain explicit reference method."""


class Material(TypedDict):
    """A linear elastic, isotropic material."""

    youngs_modulus: "Pressure"
    """Young's modulus E, Pa, above 0; typical 1 GPa to 1000 GPa, steel 210 GPa."""
    poisson_ratio: float
    """Poisson's ratio ν, above -1 and up to 0.5; typical 0.2 to 0.35, rubber 0.5."""

Pressure = Quantity
"""A pressure: a number in Pa, or a string such as "210 GPa"."""

Waveform = Union["SawtoothKind", "TriangleKind", "SineKind", "HarmonicsKind", "CycloidKind", "TableKind", "InputKind", "GeneratorKind", "TwoHarmonicsKind", "ParabolaKind", "TrapezoidKind", "SCurveKind", "ChirpKind", "StepKind"]
"""Waveform, a prescribed function of time. The peak-to-peak value is called the stroke, and half of the stroke
is called the amplitude."""


class Sawtooth(TypedDict):
    """Sawtooth."""

    stroke: "Quantity"
    """Peak-to-peak value, in the unit of the driven quantity; typical 10 nm to 10 um."""
    flyback: NotRequired["Time"]
    """Duration of the flyback, the return to 0, s, at least 0 (a jump) and below the period; typical a hundredth
    of the period. Give this or `resonance`; with `rate`, the flyback is 0 by default."""
    resonance: NotRequired["Frequency"]
    """Resonance frequency that the flyback shall not excite, Hz, above 0; give either this or `flyback`. The
    flyback takes one period of this resonance."""
    rate: NotRequired["Quantity"]
    """Slew rate limit of the waveform, per s, in the unit of the driven quantity, at least the slew rate of the
    rise; no limit by default. The waveform falls at this rate in the flyback until it meets the next rise."""
    period: NotRequired["Time"]
    """Period, s, above 0; give either this or `frequency`; typical 1 us to 1 s."""
    frequency: NotRequired["Frequency"]
    """Frequency, Hz, above 0; give either this or `period`; typical 1 Hz to 1 MHz."""
    phase: NotRequired["Angle"]
    """Phase, rad: the waveform is advanced by phase/2π of a cycle. In a burst or a sequence, the phase is
    counted in single cycles, not in lengths of the whole pattern."""
    delay: NotRequired["Time"]
    """Delay, s, at least 0: the first value is held until the delay has passed."""
    cycles: NotRequired[float]
    """Number of cycles, above 0, after which the last value is held; without end by default. With `burst` or
    `sequence`, the whole pattern counts as one cycle."""
    burst: NotRequired["Burst"]
    """Burst: some cycles and a rest at the initial value of a cycle, repeated periodically; give either this or
    `sequence`."""
    sequence: NotRequired[list["Section"]]
    """Sequence of at most 1000 sections, repeated periodically; give either this or `burst`. A section is a run
    of cycles, forward or reversed, or a rest."""

Time = Quantity
"""A time: a number in s, or a string such as "10 ms"."""

Frequency = Quantity
"""A frequency: a number in Hz, or a string such as "1 kHz"."""

Angle = Quantity
"""An angle: a number in rad, or a string such as "90 deg"."""


class Burst(TypedDict):
    """Burst: a number of cycles and a rest, repeated periodically."""

    cycles: int
    """Number of cycles in a burst, a whole number from 1 to 10 000."""
    period: NotRequired["Time"]
    """Time from the start of a burst to the start of the next, s, at least as long as its cycles; give either
    this or `dwell`."""
    dwell: NotRequired["Time"]
    """Rest between two bursts, s, above 0; give either this or `period`."""


class Section(TypedDict):
    """Section of a sequence: a run of cycles, or a rest."""

    cycles: NotRequired[int]
    """Number of cycles, a whole number of at least 1, at most 10 000 in the whole sequence; give either this or
    `dwell`."""
    reversed: NotRequired[bool]
    """Whether each cycle is reversed in time, so that a drive steps in the opposite direction; false by default.
    The range of values is unchanged."""
    dwell: NotRequired["Time"]
    """Duration of a rest at the initial value of a cycle, s, above 0; give either this or `cycles`."""


class Triangle(TypedDict):
    """Triangle."""

    stroke: "Quantity"
    """Peak-to-peak value, in the unit of the driven quantity; typical 10 nm to 10 um."""
    period: NotRequired["Time"]
    """Period, s, above 0; give either this or `frequency`; typical 1 us to 1 s."""
    frequency: NotRequired["Frequency"]
    """Frequency, Hz, above 0; give either this or `period`; typical 1 Hz to 1 MHz."""
    phase: NotRequired["Angle"]
    """Phase, rad: the waveform is advanced by phase/2π of a cycle. In a burst or a sequence, the phase is
    counted in single cycles, not in lengths of the whole pattern."""
    delay: NotRequired["Time"]
    """Delay, s, at least 0: the first value is held until the delay has passed."""
    cycles: NotRequired[float]
    """Number of cycles, above 0, after which the last value is held; without end by default. With `burst` or
    `sequence`, the whole pattern counts as one cycle."""
    burst: NotRequired["Burst"]
    """Burst: some cycles and a rest at the initial value of a cycle, repeated periodically; give either this or
    `sequence`."""
    sequence: NotRequired[list["Section"]]
    """Sequence of at most 1000 sections, repeated periodically; give either this or `burst`. A section is a run
    of cycles, forward or reversed, or a rest."""


class Sine(TypedDict):
    """Sine."""

    amplitude: "Quantity"
    """Half the peak-to-peak value, in the unit of the driven quantity; typical 10 nm to 10 um."""
    offset: NotRequired["Quantity"]
    """Mean value, in the unit of the driven quantity."""
    period: NotRequired["Time"]
    """Period, s, above 0; give either this or `frequency`; typical 1 us to 1 s."""
    frequency: NotRequired["Frequency"]
    """Frequency, Hz, above 0; give either this or `period`; typical 1 Hz to 1 MHz."""
    phase: NotRequired["Angle"]
    """Phase, rad: the waveform is advanced by phase/2π of a cycle. In a burst or a sequence, the phase is
    counted in single cycles, not in lengths of the whole pattern."""
    delay: NotRequired["Time"]
    """Delay, s, at least 0: the first value is held until the delay has passed."""
    cycles: NotRequired[float]
    """Number of cycles, above 0, after which the last value is held; without end by default. With `burst` or
    `sequence`, the whole pattern counts as one cycle."""
    burst: NotRequired["Burst"]
    """Burst: some cycles and a rest at the initial value of a cycle, repeated periodically; give either this or
    `sequence`."""
    sequence: NotRequired[list["Section"]]
    """Sequence of at most 1000 sections, repeated periodically; give either this or `burst`. A section is a run
    of cycles, forward or reversed, or a rest."""


class Harmonics(TypedDict):
    """Sum of sines."""

    terms: list["Harmonic"]
    """Sine terms of the sum, at least one; at most 1000 in all waveforms together."""
    offset: NotRequired["Quantity"]
    """Mean value, in the unit of the driven quantity; 0 by default."""
    period: NotRequired["Time"]
    """Period, s, above 0; give either this or `frequency`; typical 1 us to 1 s."""
    frequency: NotRequired["Frequency"]
    """Frequency, Hz, above 0; give either this or `period`; typical 1 Hz to 1 MHz."""
    phase: NotRequired["Angle"]
    """Phase, rad: the waveform is advanced by phase/2π of a cycle. In a burst or a sequence, the phase is
    counted in single cycles, not in lengths of the whole pattern."""
    delay: NotRequired["Time"]
    """Delay, s, at least 0: the first value is held until the delay has passed."""
    cycles: NotRequired[float]
    """Number of cycles, above 0, after which the last value is held; without end by default. With `burst` or
    `sequence`, the whole pattern counts as one cycle."""
    burst: NotRequired["Burst"]
    """Burst: some cycles and a rest at the initial value of a cycle, repeated periodically; give either this or
    `sequence`."""
    sequence: NotRequired[list["Section"]]
    """Sequence of at most 1000 sections, repeated periodically; give either this or `burst`. A section is a run
    of cycles, forward or reversed, or a rest."""


class Harmonic(TypedDict):
    """One sine of a sum."""

    amplitude: "Quantity"
    """Amplitude, in the unit of the driven quantity; typical 1 nm to 10 um."""
    order: int
    """Multiple of the frequency, a whole number, 1 to 1000."""
    phase: NotRequired["Angle"]
    """Phase of this sine, rad."""


class Cycloid(TypedDict):
    """Cycloid."""

    stroke: "Quantity"
    """Peak-to-peak value, in the unit of the driven quantity; typical 10 nm to 10 um."""
    flyback: NotRequired["Time"]
    """Duration of the flyback, the return to 0, s, above 0 and below the period; half a period by default."""
    period: NotRequired["Time"]
    """Period, s, above 0; give either this or `frequency`; typical 1 us to 1 s."""
    frequency: NotRequired["Frequency"]
    """Frequency, Hz, above 0; give either this or `period`; typical 1 Hz to 1 MHz."""
    phase: NotRequired["Angle"]
    """Phase, rad: the waveform is advanced by phase/2π of a cycle. In a burst or a sequence, the phase is
    counted in single cycles, not in lengths of the whole pattern."""
    delay: NotRequired["Time"]
    """Delay, s, at least 0: the first value is held until the delay has passed."""
    cycles: NotRequired[float]
    """Number of cycles, above 0, after which the last value is held; without end by default. With `burst` or
    `sequence`, the whole pattern counts as one cycle."""
    burst: NotRequired["Burst"]
    """Burst: some cycles and a rest at the initial value of a cycle, repeated periodically; give either this or
    `sequence`."""
    sequence: NotRequired[list["Section"]]
    """Sequence of at most 1000 sections, repeated periodically; give either this or `burst`. A section is a run
    of cycles, forward or reversed, or a rest."""


class Table(TypedDict):
    """Table of times and values, given by `points`, or by `file` with the names of its columns."""

    points: NotRequired[list["Point"]]
    """Pairs of time and value, at least two, in the order of time; two equal times are a jump; give either this
    or `file`."""
    file: NotRequired[str]
    """Table of an instrument, or CSV file with a header line, in the scenario's own folder or below it; give
    either this or `points`. Numbers are in SI, or in the unit of their column head, as in `disp (µm)`, `t
    [ms]`, `disp_um` and `time/ms`."""
    time: NotRequired[str]
    """Name of the column of times, with or without the unit in its head; required with `file` unless there is a
    `recipe`. Times are in s unless the head has a unit."""
    value: NotRequired[str]
    """Name of the column of values, with or without the unit in its head; required with `file` unless there is a
    `recipe`. Values are in SI unless the head has a unit."""
    recipe: NotRequired["Recipe"]
    """How the file is read: a recipe of `stickslip import`, or its path; by default the file is read as
    `stickslip import` shows it."""
    smooth: NotRequired["Time"]
    """Time window, s, above 0, in which a measured motion is a parabola: the noise of the values is removed by
    least squares; by default the values are used as they are."""
    interpolation: NotRequired["Join"]
    """Interpolation between the points: "straight" by default, or "cubic", which is smooth and without
    overshoot."""
    gain: NotRequired[float]
    """Factor by which all values are multiplied, of any sign but not 0; 1 by default."""
    offset: NotRequired["Quantity"]
    """Offset added to all values after the gain, in the unit of the driven quantity; 0 by default."""
    repeat: NotRequired[bool]
    """Whether the table is repeated periodically; by default the table runs once. The period is the time from
    the first to the last point."""
    delay: NotRequired["Time"]
    """Delay, s, at least 0, which is added to all times."""


class Point(TypedDict):
    """A point of a body in the reference position, relative to the body's reference point, its centre of mass."""

    x: NotRequired["Length"]
    """Coordinate along the slide, m, 0 by default."""
    z: NotRequired["Length"]
    """Coordinate normal to the slide, upwards, m, 0 by default."""

Recipe = Union[str, dict[str, Any]]
"""How a file is read."""

Join = Literal["straight", "cubic"]
"""Interpolation between the points of a table."""


class Input(TypedDict):
    """Input: values that a calling program supplies during the run."""

    initial: "Quantity"
    """Initial value, in the unit of the driven quantity; within the range. The input keeps the initial value
    until the calling program gives another value. `stickslip run` has no calling program and keeps the
    initial value throughout."""
    range: list["Quantity"]
    """Smallest and largest value that a calling program may give, in the unit of the driven quantity. A value
    outside this range is refused. The checks before a run cover the whole range."""
    interpolation: NotRequired["Interpolation"]
    """Interpolation between supplied values: "held", the default, or "linear". A "held" input keeps each value
    until the next one, and then jumps. In a jump, contacts move instantaneously on a straight path, and the
    friction work of this motion counts. A damper whose end would jump is refused, because its force would be
    infinite. A "linear" input ramps to the supplied value at the supplied time."""

Interpolation = Literal["held", "linear"]
"""Interpolation of an input between supplied values."""


class Generator(TypedDict):
    """Generator: a waveform of cycles whose parameters a calling program commands during the run. A cycle begins
    and ends at 0. A cycle has the stroke, frequency and heading that are commanded when the cycle begins.
    After the commanded number of cycles, the generator rests at 0, and a new command begins a cycle at once.
    `stickslip run` has no calling program and uses the values given here. A generator has no phase, no delay
    and no key `cycles`: the calling program sets the start, and `steps` gives the number of cycles."""

    shape: "Cycle"
    """Shape of a cycle: a sawtooth or a triangle."""
    stroke: "Quantity"
    """Initial peak-to-peak value, in the unit of the driven quantity, within `range`; at 0 the generator rests;
    typical 10 nm to 10 um."""
    frequency: "Frequency"
    """Initial frequency, Hz, at least 0, within `range`; at 0 the generator rests; typical 1 Hz to 10 kHz."""
    heading: NotRequired["Heading"]
    """Initial direction of a cycle in time: "forward", slow to the stroke and fast back, by default, or
    "backward", reversed in time."""
    steps: NotRequired[int]
    """Initial number of cycles, a whole number; without end by default. After these cycles the generator rests
    at 0 until the next command. With 0 cycles the generator rests from the start."""
    range: "Commands"
    """Ranges of the stroke and frequency that a calling program may command. The checks before a run cover these
    ranges."""

Cycle = Union[Literal["triangle"], "SawtoothKind"]
"""Shape of a cycle: a sawtooth or a triangle."""


class SawtoothCycle(TypedDict):
    """Sawtooth cycle."""

    flyback: "Time"
    """Duration of the flyback at all frequencies, s, above 0 and below the period of the largest frequency in
    range; typical 1 us to 100 us."""

Heading = Literal["forward", "backward"]
"""Direction of a cycle in time."""


class Commands(TypedDict):
    """Ranges of the values that a calling program may command."""

    stroke: list["Quantity"]
    """Smallest and largest stroke, in the unit of the driven quantity."""
    frequency: list["Frequency"]
    """Smallest and largest frequency, Hz, at least 0; the period at the largest frequency is longer than the
    flyback."""


class TwoHarmonics(TypedDict):
    """Two harmonics."""

    amplitude: "Quantity"
    """Amplitude of the fundamental, in the unit of the driven quantity; typical 10 nm to 10 um."""
    second: NotRequired[float]
    """Amplitude of the second harmonic as a share of `amplitude`, -0.25 to 0.25, not 0; 0.25 by default. A
    positive share makes the waveform rise fast and fall slowly, which carries a slider in the negative
    direction. A negative share does the opposite."""
    period: NotRequired["Time"]
    """Period, s, above 0; give either this or `frequency`; typical 1 us to 1 s."""
    frequency: NotRequired["Frequency"]
    """Frequency, Hz, above 0; give either this or `period`; typical 1 Hz to 1 MHz."""
    phase: NotRequired["Angle"]
    """Phase, rad: the waveform is advanced by phase/2π of a cycle. In a burst or a sequence, the phase is
    counted in single cycles, not in lengths of the whole pattern."""
    delay: NotRequired["Time"]
    """Delay, s, at least 0: the first value is held until the delay has passed."""
    cycles: NotRequired[float]
    """Number of cycles, above 0, after which the last value is held; without end by default. With `burst` or
    `sequence`, the whole pattern counts as one cycle."""
    burst: NotRequired["Burst"]
    """Burst: some cycles and a rest at the initial value of a cycle, repeated periodically; give either this or
    `sequence`."""
    sequence: NotRequired[list["Section"]]
    """Sequence of at most 1000 sections, repeated periodically; give either this or `burst`. A section is a run
    of cycles, forward or reversed, or a rest."""


class Parabola(TypedDict):
    """Parabola."""

    stroke: "Quantity"
    """Peak-to-peak value, in the unit of the driven quantity; typical 10 nm to 10 um."""
    turn: NotRequired["Time"]
    """Duration of the turn at the stroke, s, at least 0 (a cusp, the default) and below the period."""
    period: NotRequired["Time"]
    """Period, s, above 0; give either this or `frequency`; typical 1 us to 1 s."""
    frequency: NotRequired["Frequency"]
    """Frequency, Hz, above 0; give either this or `period`; typical 1 Hz to 1 MHz."""
    phase: NotRequired["Angle"]
    """Phase, rad: the waveform is advanced by phase/2π of a cycle. In a burst or a sequence, the phase is
    counted in single cycles, not in lengths of the whole pattern."""
    delay: NotRequired["Time"]
    """Delay, s, at least 0: the first value is held until the delay has passed."""
    cycles: NotRequired[float]
    """Number of cycles, above 0, after which the last value is held; without end by default. With `burst` or
    `sequence`, the whole pattern counts as one cycle."""
    burst: NotRequired["Burst"]
    """Burst: some cycles and a rest at the initial value of a cycle, repeated periodically; give either this or
    `sequence`."""
    sequence: NotRequired[list["Section"]]
    """Sequence of at most 1000 sections, repeated periodically; give either this or `burst`. A section is a run
    of cycles, forward or reversed, or a rest."""


class Trapezoid(TypedDict):
    """Trapezoid."""

    stroke: "Quantity"
    """Peak-to-peak value, in the unit of the driven quantity; typical 10 nm to 10 um."""
    rise: "Time"
    """Duration of the rise to the stroke, s, at least 0 (a jump)."""
    hold: NotRequired["Time"]
    """Duration of the hold at the stroke, s, at least 0, which is the default."""
    fall: NotRequired["Time"]
    """Duration of the fall to 0, s, at least 0 (a jump); by default equal to the rise. The waveform rests at 0
    for the remaining period."""
    period: NotRequired["Time"]
    """Period, s, above 0; give either this or `frequency`; typical 1 us to 1 s."""
    frequency: NotRequired["Frequency"]
    """Frequency, Hz, above 0; give either this or `period`; typical 1 Hz to 1 MHz."""
    phase: NotRequired["Angle"]
    """Phase, rad: the waveform is advanced by phase/2π of a cycle. In a burst or a sequence, the phase is
    counted in single cycles, not in lengths of the whole pattern."""
    delay: NotRequired["Time"]
    """Delay, s, at least 0: the first value is held until the delay has passed."""
    cycles: NotRequired[float]
    """Number of cycles, above 0, after which the last value is held; without end by default. With `burst` or
    `sequence`, the whole pattern counts as one cycle."""
    burst: NotRequired["Burst"]
    """Burst: some cycles and a rest at the initial value of a cycle, repeated periodically; give either this or
    `sequence`."""
    sequence: NotRequired[list["Section"]]
    """Sequence of at most 1000 sections, repeated periodically; give either this or `burst`. A section is a run
    of cycles, forward or reversed, or a rest."""


class SCurve(TypedDict):
    """S-curve."""

    stroke: "Quantity"
    """Peak-to-peak value, in the unit of the driven quantity; typical 10 nm to 10 um."""
    flyback: NotRequired["Time"]
    """Duration of the flyback, the return to 0, s, above 0 and below the period; half a period by default."""
    rounding: "Time"
    """Duration of each phase of constant jerk, s, above 0 and at most a quarter of the shorter of rise and
    flyback. Rise and flyback each have four such phases."""
    period: NotRequired["Time"]
    """Period, s, above 0; give either this or `frequency`; typical 1 us to 1 s."""
    frequency: NotRequired["Frequency"]
    """Frequency, Hz, above 0; give either this or `period`; typical 1 Hz to 1 MHz."""
    phase: NotRequired["Angle"]
    """Phase, rad: the waveform is advanced by phase/2π of a cycle. In a burst or a sequence, the phase is
    counted in single cycles, not in lengths of the whole pattern."""
    delay: NotRequired["Time"]
    """Delay, s, at least 0: the first value is held until the delay has passed."""
    cycles: NotRequired[float]
    """Number of cycles, above 0, after which the last value is held; without end by default. With `burst` or
    `sequence`, the whole pattern counts as one cycle."""
    burst: NotRequired["Burst"]
    """Burst: some cycles and a rest at the initial value of a cycle, repeated periodically; give either this or
    `sequence`."""
    sequence: NotRequired[list["Section"]]
    """Sequence of at most 1000 sections, repeated periodically; give either this or `burst`. A section is a run
    of cycles, forward or reversed, or a rest."""

_Chirp = TypedDict("_Chirp", {"from": "Frequency"}, total=False)


class Chirp(_Chirp):
    """Chirp."""

    amplitude: "Quantity"
    """Half the peak-to-peak value, in the unit of the driven quantity; typical 1 nm to 1 um."""
    offset: NotRequired["Quantity"]
    """Mean value, in the unit of the driven quantity."""
    to: "Frequency"
    """Frequency at the end, Hz, at least 0; `from` and `to` are not both 0."""
    duration: "Time"
    """Duration of the frequency sweep, s, above 0; then the last value is held."""
    phase: NotRequired["Angle"]
    """Phase at the start, rad."""
    delay: NotRequired["Time"]
    """Delay, s, at least 0: the first value is held until the delay has passed."""


class Step(TypedDict):
    """Step."""

    height: "Quantity"
    """Value after the step, in the unit of the driven quantity; the value before it is 0."""
    at: NotRequired["Time"]
    """Time of the step, s, at least 0, which is the default."""


class Body(TypedDict):
    """A rigid body in the plane of the axes x, along the slide, and z, normal to the slide. The coordinates of a
    body are displacements from the reference position."""

    mass: NotRequired["Mass"]
    """Mass, kg, above 0; needed where x or z is free; typical 1 g to 1 kg."""
    inertia: NotRequired["Inertia"]
    """Moment of inertia about the reference point, the centre of mass, kg m², above 0; needed where pitch is
    free. A solid ball of radius R has 2/5 m R². A block of length l and height h has m (l² + h²)/12."""
    x: NotRequired["Freedom"]
    """Coordinate along the slide: "fixed" by default, "free", "balanced", or a coordinate that follows a
    waveform of lengths."""
    z: NotRequired["Freedom"]
    """Coordinate normal to the slide, upwards: "fixed" by default, "free", "balanced", or a coordinate that
    follows a waveform of lengths. If z is fixed, a guide carries weight and loads."""
    pitch: NotRequired["Freedom"]
    """Small angle θ of rotation, positive from x towards z: "fixed" by default, "free", or an angle that follows
    a waveform of angles. A point at (X, Z) from the reference point moves by -Zθ along x and by Xθ along z."""
    start: NotRequired["BodyStart"]
    """Initial position and velocity of the body at t = 0; by default at rest in the reference position."""

Mass = Quantity
"""A mass: a number in kg, or a string such as "10 g"."""

Inertia = Quantity
"""A moment of inertia: a number in kg m², or a string such as "1e-6 kg m²"."""

Freedom = Union[Literal["fixed", "free", "balanced"], "FollowsKind"]
"""Type of motion of a coordinate: "fixed", "free", "balanced", or {"follows": waveform}."""

WaveformRef = Union[str, "Waveform"]
"""A waveform: the name of one of `waveforms`, or one written out here."""


class BodyStart(TypedDict):
    """Initial position and velocity of a body at t = 0."""

    x: NotRequired["Length"]
    """Position x, m, as a displacement from the reference position, 0 by default; not allowed if x follows a
    waveform."""
    vx: NotRequired["Velocity"]
    """Velocity along x, m/s, 0 by default; only where x is free."""
    z: NotRequired["Length"]
    """Position z, m, as a displacement from the reference position, 0 by default; not allowed if z follows a
    waveform."""
    vz: NotRequired["Velocity"]
    """Velocity along z, m/s, 0 by default; only where z is free."""
    pitch: NotRequired["Angle"]
    """Angle, rad, 0 by default; only where pitch is free."""
    vpitch: NotRequired["AngularVelocity"]
    """Angular velocity, rad/s, 0 by default; only where pitch is free."""

Length = Quantity
"""A length: a number in m, or a string such as "5 um"."""

Velocity = Quantity
"""A velocity: a number in m/s, or a string such as "2 mm/s"."""

AngularVelocity = Quantity
"""An angular velocity: a number in rad/s, or a string such as "3 rad/s"."""


class Contact(TypedDict):
    """A frictional contact between two bodies. The tangential displacement is u = x(first) - x(second) at the
    contact point. Friction drags the second body along with the first body."""

    between: list[str]
    """Names of the first (lower) and the second body; the fixed `ground` counts as a body."""
    materials: list[str]
    """Names of the two materials, in any order. Each name is an entry of `materials` or a built-in material:
    alumina, aluminium, brass, glass, hardened steel, PTFE, ruby, sapphire, silicon, steel, titanium,
    zirconia."""
    profile: "Profile"
    """Profile of the gap between the undeformed bodies."""
    friction: Union[float, "StaticKinetic"]
    """The Coulomb coefficient of the pair, 0 to 1000; typical 0.05 to 0.6. Or the static and the kinetic
    coefficient."""
    normal: "Normal"
    """Normal loading of the contact: a force, an indentation or a contact radius, or the motion of the bodies."""
    count: NotRequired[int]
    """Number of identical contacts with the same motion, 1 to 1 000 000."""
    start: NotRequired["ContactStart"]
    """Initial state of the contact at t = 0; u is measured from the initial positions of the bodies."""
    engine: NotRequired["Engine"]
    """Method that solves the tangential contact problem: by default the exact solution from the stored turning
    points of the loading history, or a row of discrete springs."""
    at: NotRequired[dict[str, "Point"]]
    """Contact point on each body by body name, relative to the body's reference point; by default the reference
    point itself."""
    gap: NotRequired["Length"]
    """Gap between the bodies in the reference position, m, 0 by default; a negative value is an initial overlap.
    Only a contact whose `normal` is "coupled" has a gap."""
    damping: NotRequired[Union["Time", "BothDamping"]]
    """Damping of the contact: a time constant of its tangential springs, s, 0 by default, or an object with the
    damping along both directions."""

Profile = Union["FlatKind", "ConeKind", "ParaboloidKind", "SphereKind", "PowerKind", "FoundationKind", "TruncatedConeKind", "TruncatedParaboloidKind", "RoundedFlatKind", "TippedParaboloidKind", "PowersKind", "TableKind", "NormalLawKind", "RoughKind", "ExponentialAsperitiesKind", "GaussianAsperitiesKind", "GradedParaboloidKind"]
"""Profile f(r) of the gap between the undeformed bodies."""


class Flat(TypedDict):
    """A flat punch, given by its radius or its diameter."""

    radius: NotRequired["Length"]
    """Radius of the flat face, m, above 0; typical 10 um to 5 mm. Give this or `diameter`."""
    diameter: NotRequired["Length"]
    """Diameter of the flat face, m, above 0; give either this or `radius`; results always use `radius`."""


class Cone(TypedDict):
    """A cone."""

    slope: float
    """Slope of the flank against the plane, tan θ, above 0; typical 0.001 to 0.1."""


class Ball(TypedDict):
    """A ball, given by its radius or its diameter."""

    radius: NotRequired["Length"]
    """Radius of curvature R, m, above 0; typical 0.1 mm to 50 mm. Give this or `diameter`."""
    diameter: NotRequired["Length"]
    """Diameter 2R, m, above 0; give either this or `radius`; results always use `radius`."""


class Power(TypedDict):
    """A power law f = A rⁿ."""

    coefficient: float
    """Coefficient A of f = A rⁿ in SI, m^(1-n), above 0; the paraboloid of radius R has A = 1/(2R) and n = 2."""
    exponent: float
    """Exponent n of f = A rⁿ, above 0; 1 is a cone, 2 a paraboloid."""


class Foundation(TypedDict):
    """A one-dimensional foundation of springs."""

    heights: list["Length"]
    """Heights of the springs above the lowest point, m, at least 0, in any order; typical 1 nm to 10 um."""
    length: "Lengths"
    """Length of foundation at each height, m, above 0: one value for all heights, or one for each; typical 10 nm
    to 100 um."""

Lengths = Union["Length", list["Length"]]


class TruncatedCone(TypedDict):
    """A worn cone, whose tip is a flat."""

    flat: "Length"
    """Radius of the flat, m, above 0; typical 1 um to 100 um."""
    slope: float
    """Slope of the flank against the plane, tan θ, above 0; typical 0.001 to 0.1."""


class TruncatedParaboloid(TypedDict):
    """A worn ball, whose lowest part is a flat."""

    flat: "Length"
    """Radius of the flat, m, above 0; typical 1 um to 100 um."""
    radius: "Length"
    """Radius of curvature R of the ball, m, above 0; typical 0.1 mm to 50 mm."""


class RoundedFlat(TypedDict):
    """A flat punch with a rounded edge."""

    flat: "Length"
    """Radius of the flat, m, above 0; typical 10 um to 5 mm."""
    radius: "Length"
    """Radius of curvature R of the edge, m, above 0; typical 10 um to 10 mm."""


class TippedParaboloid(TypedDict):
    """A paraboloid with a conical tip."""

    radius: "Length"
    """Radius of curvature R of the paraboloid, m, above 0; typical 0.1 mm to 50 mm."""
    tip: "Length"
    """Radius of the conical tip, m, above 0; typical 1 um to 50 um. The cone has the slope tip/R and joins the
    paraboloid smoothly."""


class Powers(TypedDict):
    """A sum of powers of the radius r."""

    terms: list["Term"]
    """Terms A rⁿ of the sum, at least one of them above 0."""


class Term(TypedDict):
    """A term of a sum of powers."""

    coefficient: float
    """Coefficient A of A rⁿ in SI, m^(1-n), at least 0."""
    exponent: float
    """Exponent n of A rⁿ, any number above 0."""


class GapTable(TypedDict):
    """Profile given by points of radius and gap."""

    points: NotRequired[list["GapPoint"]]
    """Pairs of radius and gap, 2 to 4000: the first is [0, 0], radii increase, gaps do not decrease; give either
    this or `file`."""
    file: NotRequired[str]
    """CSV file with a header line, in the scenario's own folder or below it; give either this or `points`. Each
    column head contains a unit, as in `f (nm)`, `r [um]`, `r_um` and `f/nm`."""
    radius: NotRequired[str]
    """Name of the column of radii, with or without the unit in its head; required with `file` unless there is a
    `recipe`."""
    gap: NotRequired[str]
    """Name of the column of gaps, with or without the unit in its head; required with `file` unless there is a
    `recipe`."""
    recipe: NotRequired["Recipe"]
    """How the file is read: a recipe of `stickslip import`, or its path; by default the file is read as
    `stickslip import` shows it."""
    kinks: NotRequired[list["Length"]]
    """Radii of the points at which the slope of the profile jumps, m, such as the edge of a flat; none by
    default. Between these kinks the profile is assumed to be smooth."""

GapPoint = list["Length"]
"""Radius and gap."""


class NormalLaw(TypedDict):
    """Profile given by its normal law, force over indentation."""

    points: NotRequired[list["LawPoint"]]
    """Pairs of indentation and normal force of one contact, at least two: the first is [0, 0], both increase,
    and the slope never decreases; give either this or `file`. Give the forces for the two materials of this
    contact."""
    file: NotRequired[str]
    """CSV file with a header line, in the scenario's own folder or below it; give either this or `points`. Each
    column head contains a unit, as in `d (nm)` and `F_mN`."""
    indentation: NotRequired[str]
    """Name of the column of indentations, with or without the unit in its head; required with `file` unless
    there is a `recipe`."""
    force: NotRequired[str]
    """Name of the column of forces, with or without the unit in its head; required with `file` unless there is a
    `recipe`."""
    recipe: NotRequired["Recipe"]
    """How the file is read: a recipe of `stickslip import`, or its path; by default the file is read as
    `stickslip import` shows it."""

LawPoint = list[Union["Length", "Force"]]
"""Indentation and normal force."""

Force = Quantity
"""A force: a number in N, or a string such as "0.3 N"."""


class Rough(TypedDict):
    """Rough line: the height profile of the one-dimensional foundation."""

    heights: NotRequired[list["Length"]]
    """Heights at equal distances, m, positive outwards from the body, relative to any reference level; give this
    or `file` or `self_affine`. The highest point touches first."""
    file: NotRequired[str]
    """CSV file with a header line, in the scenario's own folder or below it; give either this or `heights`. The
    column head contains a unit, as in `z (nm)`."""
    height: NotRequired[str]
    """Name of the column of heights, with or without the unit in its head; required with `file` unless there is
    a `recipe`."""
    recipe: NotRequired["Recipe"]
    """How the file is read: a recipe of `stickslip import`, or its path; by default the file is read as
    `stickslip import` shows it."""
    level: NotRequired["Level"]
    """Shape that is removed from the heights by least squares: none by default, or a straight line (levelling),
    or a parabola (the form of a ball or cylinder)."""
    within: NotRequired[list["Length"]]
    """Places between which the line counts, m from its first point; by default all of it."""
    spacing: NotRequired["Length"]
    """Spacing of the heights, m, above 0; required with `heights`; with `file` by default the mean distance of
    its places. Typical 10 nm to 10 um."""
    self_affine: NotRequired["SelfAffine"]
    """Self-affine line, computed from these parameters, identical on every machine; give either this or
    `heights`."""

Level = Literal["line", "parabola"]
"""A shape that is removed from heights."""


class SelfAffine(TypedDict):
    """Self-affine rough line: a sum of cosines with wavelengths between two cut-offs and pseudo-random phases.
    The amplitude of the wavelength λ is proportional to λ^(H + 1/2)."""

    rms: "Length"
    """Root mean square of the heights, m, above 0; typical 1 nm to 1 um."""
    hurst: float
    """The Hurst exponent H, 0 to 1; typical 0.8."""
    longest: "Length"
    """Longest wavelength, m, at most the length."""
    shortest: "Length"
    """Shortest wavelength, m, at most the longest and at least twice the spacing of the points."""
    length: "Length"
    """Length of the line, m, above 0."""
    points: int
    """Number of points, a power of two from 4 to 1 048 576."""
    seed: NotRequired[int]
    """Seed of the pseudo-random phases, a whole number, 0 by default."""


class ExponentialAsperities(TypedDict):
    """Spherical tips with exponentially distributed heights."""

    mean_height: "Length"
    """Mean height l of the tips above the reference plane, m, above 0; typical 10 nm to 5 um."""
    radius: "Length"
    """Radius of the tips, m, above 0; typical 1 um to 1 mm."""
    count: float
    """Number of tips, 10 to 1e15."""


class GaussianAsperities(TypedDict):
    """Spherical tips with normally distributed heights."""

    rms_height: "Length"
    """Standard deviation of the heights about their mean plane, m, above 0; typical 10 nm to 5 um."""
    radius: "Length"
    """Radius of the tips, m, above 0; typical 1 um to 1 mm."""
    count: float
    """Number of tips, 10 to 1e15."""


class GradedParaboloid(TypedDict):
    """Paraboloid between graded bodies."""

    radius: "Length"
    """Radius of curvature R, m, above 0; typical 1 mm to 10 mm."""
    exponent: float
    """Exponent k of the modulus, at least 0 and below 1; 0 for homogeneous bodies."""
    depth: "Length"
    """Depth at which the modulus is that of the material, m, above 0; typical 1 um to 1 mm."""


class StaticKinetic(TypedDict):
    """Static and kinetic friction coefficient. Partial slip obeys the static coefficient. When the last spring
    of the contact reaches its limit, the contact breaks loose: the limits of all springs fall to the kinetic
    coefficient at once. When it stops, it sticks again."""

    static: Union[float, "Growth"]
    """The static coefficient, 0 to 1000; typical 0.1 to 0.8. Or its growth while the contact rests."""
    kinetic: float
    """The kinetic coefficient, 0 to the static one; typical 0.6 to 1 times the static one."""

_Growth = TypedDict("_Growth", {"from": float}, total=False)


class Growth(_Growth):
    """Growth of the static friction coefficient μ_s with the time at rest t: μ_s = from + (to - from)(1 -
    e^(-t/time)), or μ_s = from + per_e_fold ln(1 + t/time). The coefficient grows in 1024 stairs of `to -
    from` or `per_e_fold`; each stair keeps the value with which it began. The time at rest begins when the
    contact closes or sticks again."""

    to: NotRequired[float]
    """The static coefficient after a long rest, at least `from`; by default there is `per_e_fold` in its place."""
    per_e_fold: NotRequired[float]
    """Growth of the static coefficient each time that the time at rest grows by the factor e; by default there
    is `to` in its place."""
    time: "Time"
    """Time constant of the growth, s, above 0."""

Normal = Union[Literal["coupled"], "ForceKind", "IndentationKind", "RadiusKind"]
"""Normal loading of a contact."""

MovingForce = Union["Force", "Follows"]
"""Force, constant or following a waveform."""


class Follows(TypedDict):
    """Reference to a waveform, written as `{"follows": waveform}`."""

    follows: "WaveformRef"
    """The waveform to follow: a name in `waveforms`, or a waveform written out here."""

MovingLength = Union["Length", "Follows"]
"""Length, constant or following a waveform."""

ContactStart = Union[Literal["untouched"], "ForceKind", "DisplacementKind", "RestKind"]
"""Initial tangential state of a contact at t = 0. A preload is applied monotonically to a contact without
loading history."""

Engine = Union[Literal["curve"], "SpringsKind"]
"""Method that solves the tangential problem of a contact."""


class Springs(TypedDict):
    """Row of discrete springs in place of the continuous contact."""

    count: int
    """Number of springs, 1 to 1 000 000; typical 256 to 4096."""
    span: NotRequired["Length"]
    """Length of the row, m, above 0; by default the contact width at the largest known load. The largest known
    load is an indentation or a normal force."""


class BothDamping(TypedDict):
    """Damping of a contact along both directions. Along the normal the contact is that of the elastic one
    pressed by d + βḋ: force, radius, friction limit and slip memory follow d + βḋ, without tension. The
    damping time β along the normal is given by `normal`, or by the coefficient of restitution of an impact."""

    tangential: NotRequired["Time"]
    """Damping time constant of the tangential springs, s, at least 0, 0 by default."""
    normal: NotRequired["Time"]
    """Damping time constant along the normal, s, at least 0, by default 0 or that of `restitution`. Only for a
    contact whose `normal` is "coupled" or an indentation."""
    restitution: NotRequired[float]
    """Coefficient of restitution of an impact of the two bodies at the speed `at`, above 0, at most 1; none by
    default. The impact has the effective mass of the bodies along the normal; a body that follows a waveform
    is infinitely heavy."""
    at: NotRequired["Velocity"]
    """Speed of the impact, m/s, above 0; required beside `restitution`, none by default."""


class Spring(TypedDict):
    """Linear spring with a damper. The force on the second body is preload - k e - c ė. The elongation e is
    x(second) - x(first) at the ends of the spring, or z(second) - z(first)."""

    between: list[str]
    """Names of the first and the second body; the fixed `ground` counts as a body."""
    direction: NotRequired["Direction"]
    """Direction in which the spring acts: "x", along the slide, by default, or "z", normal to the slide."""
    at: NotRequired[dict[str, "Point"]]
    """End point of the spring on each body by body name, relative to the body's reference point; by default the
    reference point itself."""
    stiffness: NotRequired["Stiffness"]
    """Stiffness k, N/m, at least 0; typical 1 kN/m to 100 N/um."""
    damping: NotRequired["Damping"]
    """Damping c, N s/m, at least 0; typical 0.1 N s/m to 100 N s/m."""
    preload: NotRequired["Force"]
    """Preload, the force on the second body at e = 0, N; typical 1 mN to 100 N."""

Direction = Literal["x", "z"]
"""Direction of a spring or actuator."""

Stiffness = Quantity
"""A stiffness: a number in N/m, or a string such as "2 N/um"."""

Damping = Quantity
"""A damping: a number in N s/m, or a string such as "0.5 N s/m"."""


class Actuator(TypedDict):
    """Piezo stack: a spring and a damper with a free stroke s. The stack acts on the second body with the force
    k(s-e) + c(ṡ-ė). The elongation e is x(second) - x(first) at the ends of the stack, or z(second) -
    z(first). Data-sheet values are enough to describe a stack: see docs/how/data_sheet.md."""

    between: list[str]
    """Names of the first and the second body; the fixed `ground` counts as a body."""
    direction: NotRequired["Direction"]
    """Direction in which the stack acts: "x", along the slide, by default, or "z", normal to the slide."""
    at: NotRequired[dict[str, "Point"]]
    """End point of the stack on each body by body name, relative to the body's reference point; by default the
    reference point itself."""
    stiffness: NotRequired["Stiffness"]
    """Stiffness k, N/m, above 0; by default that of `data_sheet`; typical 1 N/um to 500 N/um."""
    damping: NotRequired["Damping"]
    """Damping c, N s/m, at least 0; typical 0.1 N s/m to 100 N s/m. By default the damping is 0 for a stack
    without `voltage`, `data_sheet` and `mass`. For other stacks the default is √(k m)/50, with the reduced
    mass m = m₁m₂/(m₁ + m₂) of the bodies at the ends. A body that is not free counts as infinitely heavy. The
    default gives the quality factor 50 of a soft piezo ceramic with electrodes."""
    mass: NotRequired["Mass"]
    """Mass m of the stack itself, kg, above 0; none by default unless `data_sheet` gives a resonance. If one end
    is held, 4m/π² is added to the free body at the other end. If both ends are free, 2m/π² is added to each
    body. These shares reproduce the first resonance of the stack."""
    stroke: NotRequired["MovingLength"]
    """Free stroke s, m; give either this or `voltage`; typical 10 nm to 100 um."""
    voltage: NotRequired["MovingVoltage"]
    """Commanded voltage, V; give either this or `stroke`; typical 10 V to 200 V. Without hysteresis and creep,
    the free stroke is `stroke_per_volt` times the output voltage of the driver."""
    stroke_per_volt: NotRequired["StrokePerVoltage"]
    """Free stroke per voltage, m/V, above 0; by default that of `data_sheet`; typical 1 nm/V to 200 nm/V."""
    capacitance: NotRequired["Capacitance"]
    """Capacitance C, F, above 0; needed with a `driver`; by default that of `data_sheet`; typical 10 nF to 10
    uF. Give the capacitance at the amplitude of the drive voltage, which is up to twice the capacitance at 1
    V."""
    data_sheet: NotRequired["DataSheet"]
    """Values of the manufacturer's data sheet; none by default. Missing keys of the stack are computed from
    these values."""
    driver: NotRequired["Driver"]
    """Driver electronics that turn the command into the voltage of the stack; an ideal voltage source by
    default."""
    hysteresis: NotRequired["Hysteresis"]
    """Hysteresis of the stroke; none by default, and none under charge control."""
    creep: NotRequired["Creep"]
    """Creep of the stroke; none by default, and none under charge control."""
    compensate: NotRequired[bool]
    """Feedforward compensation: whether inverse models of hysteresis and creep correct the command before the
    driver; false by default."""

MovingVoltage = Union["Voltage", "Follows"]
"""Voltage, constant or following a waveform."""

Voltage = Quantity
"""A voltage: a number in V, or a string such as "60 V"."""

StrokePerVoltage = Quantity
"""A stroke per voltage: a number in m/V, or a string such as "20 nm/V"."""

Capacitance = Quantity
"""A capacitance: a number in F, or a string such as "200 nF"."""


class DataSheet(TypedDict):
    """Values of the data sheet of a stack. Values that determine the same quantity must agree within 1 %."""

    stroke: NotRequired["Length"]
    """Nominal free stroke, m, above 0, at `voltage`; unknown by default; typical 1 um to 100 um."""
    voltage: NotRequired["Voltage"]
    """Nominal voltage, V, above 0; unknown by default; typical 60 V to 1000 V."""
    stiffness: NotRequired["Stiffness"]
    """Stiffness, N/m, above 0; by default `blocking_force` over `stroke`; typical 1 N/um to 500 N/um."""
    blocking_force: NotRequired["Force"]
    """Blocking force at the nominal voltage, N, above 0: stiffness times stroke; unknown by default; typical 10
    N to 5 kN."""
    capacitance: NotRequired["Capacitance"]
    """Capacitance, F, above 0; unknown by default; typical 10 nF to 10 uF."""
    free_resonance: NotRequired["Frequency"]
    """First resonance without a load, both ends free, Hz, above 0; unknown by default; typical 10 kHz to 500
    kHz. This frequency determines the mass of the stack."""
    held_resonance: NotRequired["Frequency"]
    """First resonance without a load, one end held, Hz, above 0; unknown by default. This frequency is half of
    `free_resonance` and also determines the mass of the stack."""


class Driver(TypedDict):
    """Driver electronics between the command and the stack. A limit is inactive if its key is missing."""

    window: NotRequired[list["Voltage"]]
    """Smallest and largest voltage, V, to which the commanded voltage is limited; unlimited by default. The
    range may be unipolar, such as 0 V to 120 V, or bipolar."""
    current: NotRequired["Current"]
    """Largest current I into the stack, A, above 0; no limit by default; typical 10 mA to 20 A. The voltage
    changes no faster than I/C."""
    sink_current: NotRequired["Current"]
    """Largest current out of the stack, A, above 0; by default the same as `current`."""
    resistance: NotRequired["Resistance"]
    """Resistance R between driver and stack, Ω, at least 0; none by default; typical 1 ohm to 1 kohm. The
    voltage of the stack follows the driver with the time constant RC."""
    bandwidth: NotRequired["Frequency"]
    """Bandwidth, Hz, above 0; no limit by default; typical 100 Hz to 100 kHz. The bandwidth is the natural
    frequency of a second-order low-pass before the output stage."""
    damping_ratio: NotRequired[float]
    """Damping ratio ζ of the low-pass with the natural frequency `bandwidth`, 0.05 to 10; 1/√2 by default. At
    1/√2 and above, the frequency response has no resonance peak."""
    resolution: NotRequired["Voltage"]
    """Resolution, the smallest step of the voltage, V, above 0; none by default; typical 1 mV to 50 mV. `info`
    shows the resolution as a stroke. The simulated voltage is not quantised."""
    control: NotRequired["Control"]
    """Controlled quantity of the driver: the "voltage" by default, or the "charge" C·V. Under charge control the
    stack has no hysteresis and no creep."""
    reciprocal: NotRequired[bool]
    """Direct piezoelectric effect: whether a change of length of the stack generates electric charge; false by
    default. The charge of the stack is then Q = CV + kα(e - αV), with stiffness k, elongation e, voltage V
    and free stroke per volt α. C is the capacitance of the stack without a force. The driver supplies this
    charge. Under charge control, the effect increases the stiffness from k to k/(1 - kα²/C). `info` shows the
    coupling kα²/C."""

Current = Quantity
"""A current: a number in A, or a string such as "100 mA"."""

Resistance = Quantity
"""A resistance: a number in Ω, or a string such as "50 Ω"."""

Control = Literal["voltage", "charge"]
"""Controlled quantity of a driver."""

Hysteresis = Union["LoopKind", "PlaysKind", "BoucWenKind"]
"""Rate-independent hysteresis of the free stroke: the input v is the stroke without hysteresis, m; the output is
the actual stroke, m. The hysteresis has no effect on the voltage or on the energy balance: see
docs/how/hysteresis.md."""


class Loop(TypedDict):
    """Hysteresis loop given by its width."""

    percent: float
    """Greatest width of the hysteresis loop in per cent of the peak-to-peak stroke, above 0 and below 50;
    typical 8 to 15."""
    stroke: NotRequired["Length"]
    """Peak-to-peak stroke at which the loop has the width `percent`, m, above 0; by default the stroke of
    `data_sheet`, or the commanded stroke if there is no data sheet. The relative width of smaller loops
    decreases about in proportion to their stroke."""
    operators: NotRequired[int]
    """Number of play operators, 1 to 64; 10 by default. Each operator adds a corner to each branch of the loop."""


class Plays(TypedDict):
    """Prandtl–Ishlinskii model s = w₀ v + Σ wᵢ pᵢ of the input v, with play operators |v - pᵢ| ≤ rᵢ."""

    direct: float
    """Weight w₀ of the input itself, above 0; typical 0.7 to 1."""
    thresholds: list["Length"]
    """Thresholds rᵢ of the play operators, m, ascending from above 0; at most 64."""
    weights: list[float]
    """Weights wᵢ of the play operators, one for each threshold. Every partial sum w₀ + w₁ + … + wᵢ is above 0."""


class BoucWen(TypedDict):
    """Bouc–Wen model z' = A v' - β|v'||z|ⁿ⁻¹z - γ v'|z|ⁿ of the hysteretic part z, with A/(β + γ) = z_mⁿ."""

    slope: float
    """Slope A = dz/dv at z = 0, above 0 and below 1/(2 `share`); typical 0.1 to 0.4. A is the fraction by which
    hysteresis reduces the stroke of a small motion."""
    limit: "Length"
    """Limit z_m of the hysteretic part z, m, above 0; typical a twentieth of the stroke."""
    share: NotRequired[float]
    """Ratio β/(β + γ), 0.5 to 1; 0.5 by default. With a larger ratio, |z| decreases faster after a reversal."""
    exponent: NotRequired[float]
    """Exponent n, 1 to 16; 1 by default. With a larger exponent, the knee at which z reaches the limit z_m is
    sharper."""

_Creep = TypedDict("_Creep", {"from": "Time"}, total=False)


class Creep(_Creep):
    """Logarithmic creep: after a step of the command, the stroke grows as L₁[1 + γ lg(t/t₀)]. A sum of
    exponentials represents this law over a number of decades."""

    per_decade: float
    """Creep factor γ, the relative stroke added per decade of time, above 0 and below 0.5; typical 0.01 to 0.02."""
    decades: NotRequired[int]
    """Number of decades of time after t₀ in which creep is logarithmic, 1 to 6; 5 by default. After these
    decades the stroke settles."""


class Load(TypedDict):
    """Force and moment on a body; give at least one of `x`, `z` and `pitch`."""

    on: str
    """Name of the body on which the load acts."""
    x: NotRequired["MovingForce"]
    """Force along x, N, 0 by default; typical 1 mN to 10 N."""
    z: NotRequired["MovingForce"]
    """Force along z, N, 0 by default."""
    pitch: NotRequired["MovingMoment"]
    """Moment about the pitch axis, N m, 0 by default; positive from x towards z."""
    at: NotRequired["Point"]
    """Point at which the forces act, relative to the body's reference point; by default the reference point
    itself."""

MovingMoment = Union["Moment", "Follows"]
"""Moment, constant or following a waveform."""

Moment = Quantity
"""A moment: a number in N m, or a string such as "1e-3 N m"."""


class Stop(TypedDict):
    """End stops of a body: springs that act beyond a position only and never pull. At the penetration p the
    force is kp + cṗ, at least 0."""

    on: str
    """Name of the body."""
    x: NotRequired[list[Union["Length", Literal[null]]]]
    """Lowest and highest free position of the body along x, m; `null` without a stop there. Give `x` or `z`; the
    other one has no stops by default."""
    z: NotRequired[list[Union["Length", Literal[null]]]]
    """Lowest and highest free position of the body along z, m; `null` without a stop there. Give `x` or `z`; the
    other one has no stops by default."""
    stiffness: "Stiffness"
    """Stiffness k of each stop, N/m, above 0; typical 1 N/um to 1 kN/um."""
    damping: NotRequired["Damping"]
    """Damping c of each stop, N s/m, at least 0, 0 by default."""


class Gravity(TypedDict):
    """Gravity: a force of -m g sin(incline) along x and -m g cos(incline) along z acts on a body of mass m.
    Along a coordinate that is not free, a guide carries the weight."""

    acceleration: NotRequired["Acceleration"]
    """Acceleration g, m/s², at least 0; standard gravity by default."""
    incline: NotRequired["Angle"]
    """Inclination by which the slide rises along x from the horizontal, a number in rad, -180 deg to 180 deg;
    typical 0 deg or 90 deg."""

Acceleration = Quantity
"""An acceleration: a number in m/s², or a string such as "9.81 m/s²"."""


class Run(TypedDict):
    """Run of the simulation: its duration, initial state, stepper and limits."""

    duration: NotRequired["Time"]
    """Simulated time, s, above 0; give either this or `cycles`; typical 1 ms to 10 s."""
    cycles: NotRequired[float]
    """Simulated time in cycles of the waveform that `figures` names, above 0; give either this or `duration`.
    The delay of the waveform is added to the simulated time."""
    until_steady: NotRequired[float]
    """Largest relative change of the step length at which the run counts as steady and ends early, 1e-12 to 0.1;
    by default the run is not stopped early; typical 1e-9 to 1e-3. The step is the displacement of the free
    body of `figures` in one period of the waveform of `figures`. The run ends when each of the last three
    steps agrees with the preceding step within this change. For steps shorter than u_c, the displacement at
    the onset of gross slip, the change is relative to u_c. Until the run ends, it is identical to a run
    without this key."""
    start: NotRequired["RunStart"]
    """Initial state of the free coordinates: "given" by default, or "equilibrium"."""
    stepper: NotRequired["Stepper"]
    """Stepper, the method of time integration. A method with a tolerance suits every scenario. A fixed step must
    stay below a limit set by the fastest oscillation."""
    limits: NotRequired["Limits"]
    """Limits on the work and memory of a run."""

RunStart = Literal["given", "equilibrium"]
"""Initial state of the free coordinates: "given" by default, or "equilibrium"."""

Stepper = Union["EventKind", "VerletKind", "Rk4Kind", "FramesKind", "Dopri5Kind"]
"""Stepper, the method of time integration. A tolerance is relative to the natural scales of length, force and
velocity."""


class Tolerance(TypedDict):
    """Stepping with an adaptive time step."""

    tolerance: NotRequired[float]
    """Local error per step, relative to the natural scales u_c and μF_N, 1e-13 to 1e-2; typical 1e-10 to 1e-6.
    u_c is the displacement at the onset of gross slip, μF_N the friction limit."""


class StepForm2(TypedDict):
    """Stepping with a fixed time step."""

    step: "Time"
    """Time step, s, above 0; typical 10 ns to 1 us."""


class Frames(TypedDict):
    """Stepping in frames of equal length."""

    length: "Time"
    """Length of a frame, s, above 0; typical 10 us to 1 ms."""
    accuracy: NotRequired[float]
    """Allowed error per stroke of the drive, as a share of the stroke, 1e-9 to 0.1; typical 1e-5 to 1e-3. A
    frame has as many steps as the fastest oscillation needs for this accuracy. Under a varying normal load, a
    frame has 3 times as many steps. `stickslip info` shows the number of steps."""


class Limits(TypedDict):
    """Limits on the work and memory of a run."""

    steps: NotRequired[int]
    """Maximum number of accepted and rejected steps, at least 1."""
    events: NotRequired[int]
    """Maximum number of located events, at least 1."""
    wall: NotRequired["Time"]
    """Maximum wall-clock time, s, above 0; no limit by default."""
    memory: NotRequired["Storage"]
    """Maximum memory of the run, B, above 0; no limit by default. The memory is estimated before the run and
    counted during the run. The data for plots grow with the duration of the run."""

Storage = Quantity
"""An amount of memory: a number in B, or a string such as "512 MB"."""


class Figures(TypedDict):
    """Waveform and body from which the steps and speeds of the drive are computed."""

    waveform: NotRequired[str]
    """Name of the waveform whose period is one step of the drive; by default the only waveform."""
    body: NotRequired[str]
    """Name of the body whose steps and speed are computed; by default the only free body, or the only body."""
    steady_motion: NotRequired[bool]
    """Whether `run` and `info` search for the periodic motion of the drive. By default `run` spends at most a
    fifth of its own time steps on the search. `true` allows as many time steps as needed; `false` turns the
    search off. `stickslip steady` always searches."""


class Output(TypedDict):
    """Output tables of a run."""

    every: NotRequired["Time"]
    """Time interval between rows of `trace.csv`, s, above 0; typical a thousandth of the period. By default only
    the first and the last row are written. In a scenario without `output`, the program chooses an interval
    that resolves the motion."""
    channels: NotRequired[list[str]]
    """Columns of `trace.csv`, called channels; all by default."""
    events: NotRequired["EventsOutput"]
    """Events written to `events.csv`: `all`, `off`, or a selection of kinds or contacts. By default the first
    100 000 events are written, or fewer with more than 50 contacts. A decreasing share of later events is
    written. Results are computed from all events in any case."""
    steps: NotRequired["StepsOutput"]
    """Steps of a drive written to `steps.csv`, and of single pulses of a burst or a sequence to `pulses.csv`:
    `all` (default) or `off`. Results are computed from all steps in any case."""
    window: NotRequired["Window"]
    """Time window in which rows and events are written; by default the whole run; give this or `last`. The first
    and the last row are always written."""
    last: NotRequired[float]
    """Number of periods at the end of the run in which rows and events are written, above 0; by default the
    whole run; give this or `window`. The periods are periods of the waveform that `figures` names."""
    float: NotRequired[int]
    """Significant digits of the numbers in `trace.csv` and `events.csv`, 1 to 17; by default as many digits as
    are needed to read back exactly the same numbers."""
    states: NotRequired["States"]
    """States of contacts in the tables: as words (default), or as numbers 0 open, 1 stick, 2 partial, 3 slip."""
    springs: NotRequired["SpringsOutput"]
    """State, stretch and forces of every spring of every contact over time, in `springs.csv`. By default they
    are written only if the plot `state` is drawn."""
    memory: NotRequired["MemoryOutput"]
    """Memory curves of all contacts at some moments, in `memory.csv`. By default they are written only if the
    plot `memory` or `substitute` is drawn. A contact on a row of springs has no memory curve."""
    fields: NotRequired["FieldsOutput"]
    """Stress and displacement fields of all contacts at some moments, in `fields.csv`, and the friction work per
    area up to these moments, in `friction.csv`. By default they are written only if the plot `fields` or
    `friction` is drawn. A contact whose profile is a list of springs or a normal law has no fields."""

EventsOutput = Union[Literal["all", "off"], "SomeEvents"]
"""Which events are written: all, off, or some of them."""


class SomeEvents(TypedDict):
    """Selection of the events that are written."""

    kinds: NotRequired[list["Kind"]]
    """Kinds of events that are written; all by default."""
    contacts: NotRequired[list[str]]
    """Names of contacts; only events of these contacts are written; by default all events."""
    most: NotRequired[int]
    """Number of events up to which all events are written, at least 100. By default this number is 100 000, or 5
    000 000 divided by the number of contacts if there are more than 50 contacts. After this number, half of
    the events are written until twice this number have occurred, then a quarter until four times this number,
    and so on. Events are left out in blocks of a hundredth of this number."""

Kind = Literal["reversal", "loop closed", "gross slip", "gross slip ends", "breaks loose", "sticks again", "full stick", "slip begins", "touch", "lift-off", "corner", "jump"]
"""Kind of an event."""

StepsOutput = Literal["all", "off"]
"""Which steps of a drive are written."""

_Window = TypedDict("_Window", {"from": "Time"}, total=False)


class Window(_Window):
    """Time window in which rows and events are written."""

    to: NotRequired["Time"]
    """End of the window, s, at least 0; by default the end of the run."""

States = Literal["words", "numbers"]
"""Format of the states of contacts."""


class SpringsOutput(TypedDict):
    """Output of every spring of every contact over time."""

    count: NotRequired[int]
    """Number of springs written for a contact with the engine "curve", 1 to 1 000 000; 101 by default. These
    springs lie at the midpoints of equal cells over the largest known contact width. For a contact on a row
    of springs or with a foundation, the springs of the contact itself are written."""
    every: NotRequired["Time"]
    """Time interval of the output, s, above 0; by default the interval of the rows, or a 400th of the run if
    there are no rows."""


class MemoryOutput(TypedDict):
    """Moments at which the memory curves are written. By default six moments are spread evenly over the last
    period, or over the run if there is no period. A run with `until_steady` also has six moments in each of
    the first hundred periods."""

    every: NotRequired["Time"]
    """Time interval of the output, s, above 0; give either this or `at`."""
    at: NotRequired[list["Time"]]
    """Moments of the output, s, ascending, within the run; give either this or `every`."""


class FieldsOutput(TypedDict):
    """Radii and moments at which stress and displacement are written. By default the moments are those of the
    memory curves."""

    radii: NotRequired[int]
    """Number of radii, 2 to 10 000, evenly spaced from 0 to `extent`; 151 by default. While the contact moves,
    friction work is computed at each radius, not only at the written moments."""
    extent: NotRequired["Length"]
    """Largest radius of the output, m, above 0; by default 1.5 times the largest known contact radius."""
    every: NotRequired["Time"]
    """Time interval of the output, s, above 0; give either this or `at`."""
    at: NotRequired[list["Time"]]
    """Moments of the output, s, ascending, within the run; give either this or `every`."""

Plot = Union["PlotName", "OwnPlot"]
"""A plot by its name, or channels over another channel. These plots are written to `xy-1.png`, `xy-2.png` and so
on."""

PlotName = Literal["layout", "loop", "trajectory", "energy", "phase", "events", "state", "memory", "fields", "substitute", "friction", "waveform", "drive"]
"""Name of a predefined plot."""

_OwnPlot = TypedDict("_OwnPlot", {"from": "Time"}, total=False)


class OwnPlot(_OwnPlot):
    """User-defined plot: one or several channels over another channel."""

    x: str
    """Channel on the horizontal axis, a numeric column of `trace.csv`."""
    y: "Channels"
    """One or several channels on the vertical axis; channels with another unit are drawn on a separate axis
    below."""
    to: NotRequired["Time"]
    """End of the plotted time, s, after `from`; by default the end of the run."""

Channels = Union[str, list[str]]
"""One channel or a list of them."""


class Interface(TypedDict):
    """Inputs, outputs and parameters for a program that runs the scenario as a part of its own model, such as
    the host of an FMU."""

    inputs: NotRequired[list[str]]
    """Names of waveforms of kind `input` or `generator` that the host sets; by default all of them."""
    outputs: NotRequired[list[str]]
    """Names of columns of `trace.csv` that the host reads; by default all of them."""
    parameters: NotRequired[list[str]]
    """Key paths of numbers that the host may set before the start; none by default."""

_ScenarioDict = TypedDict("_ScenarioDict", {"$schema": str}, total=False)


class ScenarioDict(_ScenarioDict):
    """Scenario of a stick-slip drive: bodies, contacts, waveforms and the settings of a run. A quantity is a
    number in SI or a string with a unit, such as "5 um"."""

    stickslip: Literal[1]
    """Version of the scenario format."""
    title: NotRequired[str]
    """Title of the scenario for its readers; empty by default."""
    materials: NotRequired[dict[str, "Material"]]
    """Materials by name; none by default. Common materials need no entry: `stickslip materials` lists them with
    their sources."""
    waveforms: NotRequired[dict[str, "Waveform"]]
    """Waveforms, prescribed functions of time, by name; none by default. `{"follows": name}` refers to one of
    them."""
    bodies: NotRequired[dict[str, "Body"]]
    """Bodies by name; none by default. The fixed body `ground` always exists."""
    contacts: NotRequired[dict[str, "Contact"]]
    """Frictional contacts by name; none by default."""
    springs: NotRequired[dict[str, "Spring"]]
    """Linear springs with dampers by name; none by default."""
    actuators: NotRequired[dict[str, "Actuator"]]
    """Piezo stacks by name; none by default."""
    loads: NotRequired[list["Load"]]
    """Forces and moments on bodies; none by default."""
    stops: NotRequired[dict[str, "Stop"]]
    """End stops of bodies by name; none by default."""
    gravity: NotRequired["Gravity"]
    """Gravity; none by default."""
    run: "Run"
    """Run of the simulation: its duration, initial state, stepper and limits."""
    figures: NotRequired["Figures"]
    """Waveform and body from which the steps and speeds of the drive are computed; by default the only waveform
    and the only free body of the scenario."""
    output: NotRequired["Output"]
    """Output tables of a run. By default `trace.csv` has all channels and 400 to 20 000 rows. The shortest
    period of a waveform has 80 to 200 rows."""
    plots: NotRequired[list["Plot"]]
    """Plots to draw: names of predefined plots, or channels over another channel. By default `loop` is drawn if
    there are contacts, and `trajectory` is drawn if a body is free along x."""
    interface: NotRequired["Interface"]
    """Inputs, outputs and parameters for a program that runs the scenario as a part of its own model, such as
    the host of an FMU. By default these are all inputs and all columns."""
