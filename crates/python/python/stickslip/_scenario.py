"""Scenarios, and runs that are held."""

from __future__ import annotations

import json
import os
import tempfile
import warnings
from collections.abc import Mapping, Sequence
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core
from ._errors import RunError, ScenarioError, StickslipWarning
from ._linear import LinearSystem
from ._report import Report, Table, si
from ._result import Result, Value

if TYPE_CHECKING:
    from .types import ScenarioDict


def _plain(value: Any) -> Any:
    """A value that JSON does not know: an array, a numpy number, a quantity with units."""
    if hasattr(value, "to_base_units"):
        # With its unit, which is checked like that of a text.
        return float(value.magnitude) if value.dimensionless else f"{float(value.magnitude)!r} {value.units:~C}"
    if hasattr(value, "tolist"):
        return value.tolist()
    if isinstance(value, Mapping):
        return dict(value)
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    raise TypeError(f"a scenario holds numbers, texts, lists and dicts, not {type(value).__name__}")


def _text(value: Any) -> str:
    """A value as ``--set`` takes it: a text as it stands, anything else as JSON."""
    value = _plain(value) if hasattr(value, "to_base_units") else value
    return value if isinstance(value, str) else json.dumps(value, default=_plain)


def _end(value: Any) -> str:
    return repr(float(value)) if isinstance(value, (int, float)) else _text(value)


def _names(names: str | Sequence[str]) -> list[str]:
    return [names] if isinstance(names, str) else list(names)


def _pairs(pairs: tuple[Any, ...]) -> list[tuple[str, str]]:
    if len(pairs) == 1 and isinstance(pairs[0], Mapping):
        return [(path, _text(value)) for path, value in pairs[0].items()]
    if len(pairs) % 2:
        raise TypeError("expected pairs of path and value, or a dict")
    return [(path, _text(value)) for path, value in zip(pairs[::2], pairs[1::2], strict=True)]


class Scenario:
    """A checked scenario, from a dict with the keys of a scenario file. It never changes.

    Quantities are texts such as ``"300 nm"``, numbers in SI units, or objects of pint. Files of tables are looked for in ``folder``.
    Raises ScenarioError.

    >>> import stickslip as ss
    >>> s = ss.examples.quickstart()
    >>> s.set("contacts.ball.friction", 0.25).to_dict()["contacts"]["ball"]["friction"]
    0.25
    >>> ss.Scenario(s.to_dict()).to_dict() == s.to_dict()
    True
    """

    def __init__(self, data: ScenarioDict | Mapping[str, Any], *, name: str = "scenario", folder: str | os.PathLike[str] | None = None):
        if not isinstance(data, Mapping):
            raise TypeError("expected a dict; ss.load(file) reads a file, Scenario.from_text a text")
        text = json.dumps(data, default=_plain, indent=2, ensure_ascii=False)
        self._core = _core.Scenario(text, name, name, None if folder is None else os.fspath(folder), [])

    @classmethod
    def _of(cls, core: _core.Scenario) -> Scenario:
        scenario = cls.__new__(cls)
        scenario._core = core
        return scenario

    @classmethod
    def from_text(cls, text: str, *, name: str = "scenario", folder: str | os.PathLike[str] | None = None) -> Scenario:
        """A scenario from the text of a file."""
        return cls._of(_core.Scenario(text, name, name, None if folder is None else os.fspath(folder), []))

    def __reduce__(self):
        return _from_resolved, (self._core.resolved(), self.name)

    @property
    def name(self) -> str:
        """Its name: that of its file without the ending."""
        return self._core.name

    @property
    def title(self) -> str:
        """Its title, or else its name."""
        return self._core.title

    @cached_property
    def warnings(self) -> list[tuple[str, str]]:
        """Kind and text of every warning, as ``stickslip check`` prints them."""
        return self._core.warnings()

    def set(self, *pairs: Any) -> Scenario:
        """The scenario with other values: pairs of path and value, or a dict of them; paths are those of ``--set``.

        >>> import stickslip as ss
        >>> ss.examples.quickstart().set("waveforms.drive.sawtooth.stroke", "300 nm", "run.cycles", 5)
        <Scenario quickstart: Sawtooth drive on three ruby balls>
        """
        return Scenario._of(self._core.set(_pairs(pairs)))

    def to_dict(self) -> dict[str, Any]:
        """The scenario with all defaults, numbers in SI units; it means the same to the last bit."""
        return json.loads(self._core.resolved())

    def save(self, file: str | os.PathLike[str]) -> None:
        """Writes the scenario with all defaults to a file."""
        Path(file).write_text(self._core.resolved(), encoding="utf-8")

    def check(self) -> list[tuple[str, str]]:
        """The warnings; a Scenario has no errors, since it would not exist."""
        return self.warnings

    def _warn(self) -> None:
        for kind, text in self.warnings:
            warnings.warn(f"{kind}: {text}", StickslipWarning, stacklevel=3)

    def run(self) -> Result:
        """Runs the scenario; the interpreter's lock is released, and Ctrl-C ends it.

        Raises RunError where the run stops early; its ``result`` has what was computed until then.
        """
        self._warn()
        return _checked(Result(self, self._core.run()))

    def start(self) -> Simulation:
        """A run that stands at its start and is advanced step by step."""
        self._warn()
        return Simulation(self)

    def info(self) -> Report:
        """Derived quantities before a run: stiffness, slip limits, modes, expected cost (``stickslip info --json``)."""
        return Report.from_json(self._core.info())

    def steady(self, *, tolerance: float = 1e-12) -> Report:
        """The periodic motion without a long run: step, speed, stability, Floquet multipliers (``stickslip steady``).

        >>> import stickslip as ss
        >>> f"{ss.examples.quickstart().steady().step_m * 1e9:.2f} nm"
        '153.30 nm'
        """
        self._warn()
        return Report.from_json(self._core.steady(tolerance))

    def curve(
        self,
        kind: str | None = None,
        *,
        vary: str | None = None,
        range: tuple[Any, Any] | None = None,  # noqa: A002
        points: int = 41,
        log: bool = False,
        tolerance: float = 1e-4,
        threads: int = 0,
    ) -> Curve:
        """A curve of the periodic motion (``stickslip curve``).

        ``kind`` is one of

        - "step-amplitude": step length over the amplitude of the drive, with the zero-step stroke,
        - "speed-frequency": mean speed over the frequency of the drive,
        - "force-speed", "step-load": mean speed and power, or step length, over a load against the steps, which is added to the loads of
          the scenario, with the stall force,
        - "preload": step length over the normal force of the contacts,
        - "holding-force": the largest load that the drive at rest holds;

        or ``vary`` is the path of a number, which needs a ``range`` of two ends (numbers in SI, or texts with units). ``tolerance`` is the
        relative error of landmarks such as the stall force.

        >>> import stickslip as ss
        >>> curve = ss.examples.quickstart().curve("force-speed", points=5)
        >>> f"{curve.landmark('stall') * 1e3:.2f} mN"
        '102.50 mN'
        """
        if (kind is None) == (vary is None) and kind != "holding-force":
            raise ValueError("expected either kind or vary")
        if range is not None and (isinstance(range, str) or not hasattr(range, "__len__") or len(range) != 2):
            raise TypeError(f"expected a range of two ends, such as (0.1, 0.3) or ('1 N', '2 N'), got {range!r}")
        if vary is not None and range is None:
            raise ValueError(f"{vary} needs a range of two ends, such as range=(0.1, 0.3)")
        ends = None if range is None else (_end(range[0]), _end(range[1]))
        self._warn()
        return Curve.from_json(self._core.curve(kind or "", vary, ends, points, log, tolerance, threads))

    def sensitivity(
        self,
        of: str | Sequence[str] = (),
        to: str | Sequence[str] = (),
        *,
        steady: bool = False,
        tolerance: float = 1e-12,
        threads: int = 0,
    ) -> Report:
        """Derivatives of results ``of`` with respect to numbers ``to``, with error estimates (``stickslip sensitivity``).

        By default of the most important results with respect to all numbers of the scenario.
        """
        self._warn()
        return Report.from_json(self._core.sensitivity(_names(of), _names(to), steady, tolerance, threads))

    def contact(
        self,
        name: str | None = None,
        *,
        force: Any = None,
        indentation: Any = None,
        radius: Any = None,
        tangential_force: Any = None,
        displacement: Any = None,
        stick_radius: Any = None,
        history: str | Sequence[float] | None = None,
        points: int = 201,
    ) -> Report:
        """One contact without a run: constants, first loading, stresses, loading histories (``stickslip contact``).

        At most one of ``force``, ``indentation`` and ``radius`` presses it, by default what the scenario has; at most one of
        ``tangential_force``, ``displacement`` and ``stick_radius`` pushes it. ``history`` is a sequence of displacements (m), or a text
        as for ``--history``. Tables: ``normal``, ``universal``, ``history``, ``fields``, ``line``, ``friction``.

        >>> import stickslip as ss
        >>> contact = ss.examples.quickstart().contact(force="1 N", tangential_force="0.1 N")
        >>> f"{contact.fields['pressure_Pa'].max() / 1e6:.0f} MPa"
        '2596 MPa'
        """
        if not 2 <= points <= 100_000:
            raise ValueError(f"expected 2 to 100 000 points, got {points}")
        normal = _one({"force": (force, "N"), "indentation": (indentation, "m"), "radius": (radius, "m")})
        pushed = _one(
            {"tangential_force": (tangential_force, "N"), "displacement": (displacement, "m"), "stick_radius": (stick_radius, "m")}
        )
        if history is not None and not isinstance(history, str):
            history = ", ".join(repr(float(u)) for u in history)
        with tempfile.TemporaryDirectory() as folder:
            text = self._core.contact(name, normal, pushed, history, points, folder)
            tables = {file.stem: Table.from_csv(file.read_text(encoding="utf-8")) for file in Path(folder).glob("*.csv")}
        report = Report.from_json(text)
        report.data.update({name: table._rows for name, table in tables.items()})
        return report

    def linearise(self, at: str = "start") -> LinearSystem:
        """The linear system of small motions with all contacts stuck: A, B, C, D from the matrices behind the modes of ``info``.

        ``at`` is the indentation of the contacts: that of the "start", the "least" or the "most" over all time. Inputs are the waveforms
        that move bodies, stacks or loads; with a driver it is the free stroke behind it.

        >>> import stickslip as ss
        >>> system = ss.examples.quickstart().linearise()
        >>> system.inputs, system.outputs
        (['drive_m'], ['slider.x_m', 'slider.vx_m_s'])
        """
        if at not in ("start", "least", "most"):
            raise ValueError(f"expected start, least or most, got {at!r}")
        return LinearSystem(json.loads(self._core.linear(at)))

    def __repr__(self) -> str:
        return f"<Scenario {self.name}: {self.title}>"

    def _repr_html_(self) -> str:
        return Report(self.to_dict())._repr_html_()


class Curve(Report):
    """A curve: ``curve.table`` has its points, ``curve.landmarks`` stall force, zero-step stroke and maxima."""

    def landmark(self, name: str) -> Value:
        """Where a landmark such as "stall" lies, in the unit of what is varied, with its error bound."""
        # Of two with one name the first is meant; both stand in ``landmarks``.
        found = {one["name"]: one for one in reversed(self.data.get("landmarks", []))}
        if name not in found:
            raise KeyError(f"{name!r}; landmarks: {', '.join(found)}")
        if found[name].get("at") is None:
            raise ValueError(f"{name} was not found: {found[name].get('fault', 'not in this range')}")
        return Value(found[name]["at"], found[name].get("half_width"))

    @property
    def table(self) -> Table:
        """The points, a row each; ``value`` is what is varied, in SI."""
        return self["points"]

    def plot(self, ax=None):
        """Mean speed (or step, or holding force) over what is varied, with matplotlib."""
        from ._result import _axes

        ax = _axes(ax)
        if self.get("curve") == "holding-force":
            for way in ("along_x", "against_x"):
                forces = [np.nan if row[way]["force_N"] is None else row[way]["force_N"] for row in self.data["points"]]
                ax.plot(self.table["value"], forces, "o-", markersize=3, label=way.replace("_", " "))
            label = "holding force (N)"
            ax.legend()
        else:
            is_speed = self.get("curve") in ("force-speed", "speed-frequency")
            name, label = ("speed_m_s", "mean speed (m/s)") if is_speed else ("step_m", "step length (m)")
            ax.plot(self.table["value"], self.table[name], "o-", markersize=3)
            ax.axhline(0, color="grey", linewidth=0.8, linestyle="--")
        for one in self.data.get("landmarks", []):
            if one.get("at") is not None:
                ax.axvline(one["at"], color="grey", linewidth=0.8, linestyle=":")
                ax.annotate(one["name"].replace("_", " "), (one["at"], 1), xycoords=("data", "axes fraction"), rotation=90, va="top")
        ax.set(xlabel=f"{self['varied']} ({self.get('unit') or '1'})", ylabel=label, title=self["scenario"])
        return ax


class Simulation:
    """A run that stands between two calls: a plant for a controller.

    ``columns`` and ``units`` describe ``row()``; ``inputs`` maps every input to its smallest and largest value.

    >>> import stickslip as ss
    >>> with ss.examples.controlled().start() as sim:
    ...     for k in range(1, 11):
    ...         sim.advance(k * 1e-4, drive=k * 2e-8)
    ...     state = sim.state()
    >>> sim.time
    0.001
    """

    def __init__(self, scenario: Scenario, core: _core.Sim | None = None):
        self.scenario = scenario
        self._core = scenario._core.start() if core is None else core
        channels = self._core.channels()
        self.columns: list[str] = [full.removesuffix("_" + unit.replace("/", "_")) if unit else full for full, unit in channels]
        self.units: dict[str, str] = dict(zip(self.columns, (unit for _, unit in channels), strict=True))
        self._places = {name: k for k, name in enumerate(self.columns)} | {full: k for k, (full, _) in enumerate(channels)}
        self.inputs: dict[str, tuple[float, float]] = {}
        self._units: dict[str, str] = {}
        for name, unit, limits in self._core.inputs():
            self.inputs[name], self._units[name] = limits, unit

    def advance(self, t: Any, /, **inputs: Any) -> None:
        """Moves on to the absolute time ``t``, s or a text with a unit; inputs by their names.

        ``t`` is no step: for a step write ``sim.advance(sim.time + dt)``; it may lie beyond the duration of the scenario.
        An input takes its new value at once and is held, or goes to it in a straight line until ``t``, as its waveform says. A generator
        has the inputs ``NAME.stroke``, ``NAME.frequency``, ``NAME.heading`` and ``NAME.steps``:
        ``sim.advance(t, **{"drive.steps": 3})``. Raises
        RunError where the run stops, ValueError for a name that is no input, a value outside its range or a time before the present one.
        """
        values = [(name, si(value, self._units.get(name, ""))) for name, value in inputs.items()]
        self._core.advance(t if type(t) is float else si(t, "s"), values)

    @property
    def time(self) -> float:
        """Where it stands, s."""
        return self._core.time

    def row(self) -> np.ndarray:
        """Values of all columns, in the order of ``columns``; a state is its code in ``STATES``."""
        return self._core.row()

    def __getitem__(self, name: str) -> Any:
        """The value of a column where it stands; of a state its word."""
        if name not in self._places:
            raise KeyError(f"{name!r}; columns: {', '.join(self.columns)}")
        value = float(self._core.row()[self._places[name]])
        return _core.STATES[int(value)] if name.endswith(".state") else value

    def state(self) -> bytes:
        """All that its future depends on, as bytes; another process continues from them to the same bits."""
        return self._core.state()

    def restore(self, state: bytes) -> None:
        """Goes back to a state. Raises ValueError for bytes of another motion or damaged ones."""
        self._core.restore(state)

    def copy(self) -> Simulation:
        """Another run that stands at the same state."""
        return Simulation(self.scenario, self._core.copy())

    def __reduce__(self):
        return _from_state, (self.scenario, self.state())

    def __enter__(self) -> Simulation:
        return self

    def __exit__(self, *_: object) -> None:
        return None

    def __repr__(self) -> str:
        return f"<Simulation of {self.scenario.name} at {self.time:g} s>"


def load(file: str | os.PathLike[str]) -> Scenario:
    """Reads a scenario file. Raises ScenarioError with the text of ``stickslip check``, OSError where there is no file.

    >>> import stickslip as ss, tempfile, pathlib
    >>> file = pathlib.Path(tempfile.mkdtemp()) / "drive.json"
    >>> ss.examples.quickstart().save(file)
    >>> ss.load(file)
    <Scenario drive: Sawtooth drive on three ruby balls>
    """
    path = Path(file)
    try:
        text = path.read_bytes().decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise ScenarioError(f"{path}: byte {error.start + 1} is not UTF-8; save the file as UTF-8") from None
    return Scenario._of(_core.Scenario(text, str(path), path.stem, str(path.parent), []))


def run_many(scenarios: Sequence[Scenario], *, threads: int = 0) -> list[Result]:
    """Runs scenarios side by side, on all cores by default; the results in their order.

    A run that stops early raises RunError; its ``results`` are those of all runs.

    >>> import stickslip as ss
    >>> s = ss.examples.quickstart()
    >>> results = ss.run_many([s.set("contacts.ball.friction", mu) for mu in (0.1, 0.2, 0.3)])
    >>> len(results)
    3
    """
    scenarios = list(scenarios) if not isinstance(scenarios, Scenario) else [scenarios]
    if any(not isinstance(scenario, Scenario) for scenario in scenarios):
        raise TypeError("expected a list of scenarios; ss.Scenario(dict) makes one of a dict")
    found = _core.run_many([scenario._core for scenario in scenarios], threads)
    results = [Result(scenario, one) for scenario, one in zip(scenarios, found, strict=True)]
    try:
        return [_checked(result) for result in results]
    except RunError as error:
        error.results = results
        raise


def measure(
    displacement: Any,
    force: Any = None,
    *,
    time: Any = None,
    period: Any = None,
    normal_force: Any = None,
    recipe: Any = None,
    correct: str | Sequence[str] = (),
    rig_stiffness: Any = None,
) -> Table:
    """Evaluates measured hysteresis loops (``stickslip measure``): a row for each cycle.

    Either arrays of ``displacement`` (m), ``force`` (N) and, if known, ``time`` (s); or the path of a table as the first argument, where
    ``force`` and ``time`` may name its columns, by name or number and with a unit, such as ``"3:kN"``. ``recipe`` says how the file is read: a
    dictionary, or the path of a file that ``stickslip import`` wrote. ``normal_force`` (N) gives the friction coefficient of each loop.
    ``correct`` removes estimated errors of the signals: ``"lag"``, ``"drift"``, or both; ``rig_stiffness`` (N/m) removes the deformation of a rig.

    The attribute ``report`` of the table has what ``--json`` prints: results with their intervals of 95 %, stages, lag, drift and notes.

    >>> import numpy as np, stickslip as ss
    >>> phase = np.linspace(0, 6 * np.pi, 601)
    >>> loops = ss.measure(1e-6 * np.sin(phase), np.cos(phase), time=phase)
    >>> bool(abs(loops["dissipated_J"][0] / (np.pi * 1e-6) - 1) < 1e-3)
    True
    >>> f"{loops.report['results']['displacement_amplitude_m']['value'] * 1e6:.3f} um"
    '1.000 um'
    """
    period = None if period is None else si(period, "s")
    normal_force = None if normal_force is None else si(normal_force, "N")
    rig_stiffness = None if rig_stiffness is None else si(rig_stiffness, "N/m")
    wrong = [name for name in _names(correct) if name not in ("lag", "drift")]
    if wrong:
        raise ValueError(f"expected \"lag\" or \"drift\" to correct, got {wrong[0]!r}")
    both = ("lag" in _names(correct), "drift" in _names(correct))
    source = _record(displacement, force, time, recipe)
    text, report = _core.measure(*source, period, normal_force, both, rig_stiffness)
    table = Table.from_csv(text)
    table.report = Report.from_json(report)
    return table


def fit(
    scenario: Scenario,
    data: Any,
    free: str | Sequence[str],
    *,
    contact: str | None = None,
    displacement: str | None = None,
    force: str | None = None,
    time: str | None = None,
    recipe: Any = None,
    noise: Any = None,
    bootstrap: int = 0,
    threads: int = 0,
) -> Report:
    """Fits the numbers ``free`` of a scenario to a measured loop or trajectory (``stickslip fit``).

    ``data`` is the path of a table, or arrays: ``(displacement, force)`` or ``(time, displacement, force)`` in SI. ``displacement`` and ``force``
    say which channels these are, such as ``"rig.x"``; for a table they are ``"COLUMN=CHANNEL"``. ``noise`` (N) is the standard deviation of the
    force. Numbers that the data cannot tell apart raise ValueError with their names.

    >>> import numpy as np, stickslip as ss
    >>> s = ss.examples.fretting_sphere()
    >>> r = s.run()
    >>> data = [r[name] for name in ("time", "800 nm.u", "800 nm.fx")]
    >>> found = ss.fit(s.set("contacts.800 nm.friction", 0.4), data, "contacts.800 nm.friction", contact="800 nm")
    >>> f"{found.parameters['contacts.800 nm.friction']['value']:.3f}"
    '0.600'
    """
    if isinstance(data, (str, os.PathLike)):
        parts = [name.rsplit("=", 1) if name else [None] for name in (displacement, force)]
        columns = [part[0] or None if len(part) > 1 or part[0] is None else part[0] for part in parts]
        channels = [part[1] if len(part) > 1 else None for part in parts]
        recipe_text = _record(data, None, None, recipe)[3]
        source = (str(data), (time, *columns), None, recipe_text)
    else:
        *t, u, q = data
        channels = [displacement, force]
        source = _record(u, q, t[0] if t else None, recipe)
    noise = None if noise is None else si(noise, "N")
    asked = (_names(free), (contact, *channels), noise, bootstrap, threads)
    return Report.from_json(_core.fit(scenario._core, *source, *asked))


def _record(displacement: Any, force: Any, time: Any, recipe: Any) -> tuple[Any, Any, Any, Any]:
    """File, names of its columns, arrays and recipe of a measured record."""
    if isinstance(displacement, (str, os.PathLike)):
        if isinstance(recipe, (str, os.PathLike)):
            with open(recipe, encoding="utf-8") as file:
                recipe = file.read()
        elif recipe is not None:
            recipe = json.dumps(recipe)
        return str(displacement), (time, None, force), None, recipe
    if recipe is not None:
        raise ValueError("a recipe says how a file is read; arrays need none")
    if force is None:
        raise ValueError("expected the forces beside the displacements")
    t = None if time is None else np.ascontiguousarray(time, dtype=float)
    arrays = (t, np.ascontiguousarray(displacement, dtype=float), np.ascontiguousarray(force, dtype=float))
    return None, (None, None, None), arrays, None


def compare(
    a: str | os.PathLike[str],
    b: str | os.PathLike[str],
    *,
    exact: bool = False,
    tolerance: float | None = None,
    absolute: Mapping[str, str] | None = None,
    time_tolerance: Any = None,
    ignore: Sequence[str] = (),
) -> Report:
    """Compares two folders of results of the program (``stickslip compare``); ``verdict`` is identical, equal or differs."""
    time_tolerance = None if time_tolerance is None else si(time_tolerance, "s")
    pairs = list((absolute or {}).items())
    folders = (os.fspath(a), os.fspath(b))
    return Report.from_json(_core.compare(folders, exact, tolerance, pairs, time_tolerance, _names(ignore)))


def _checked(result: Result) -> Result:
    if result._core.error is not None:
        text, t = result._core.error
        error = RunError(f"{result.scenario.name}: {text}")
        error.t, error.result = t, result
        raise error
    return result


def _one(given: dict[str, tuple[Any, str]]) -> tuple[str, float] | None:
    found = [(name, si(value, unit)) for name, (value, unit) in given.items() if value is not None]
    if len(found) > 1:
        raise ValueError(f"expected one of {', '.join(given)}, got {len(found)}")
    return found[0] if found else None


def _from_resolved(text: str, name: str) -> Scenario:
    return Scenario._of(_core.Scenario(text, name, name, None, []))


def _from_state(scenario: Scenario, state: bytes) -> Simulation:
    simulation = Simulation(scenario)
    simulation.restore(state)
    return simulation
