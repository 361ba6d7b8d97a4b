"""Results of runs: arrays, the summary, pictures."""

from __future__ import annotations

import base64
import html
import json
import os
import threading
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from . import _core
from ._report import Report

if TYPE_CHECKING:
    from ._scenario import Scenario


class Event(NamedTuple):
    """An event of a run: time (s), the part it happened to, and what happened, in the words of events.csv."""

    time: float
    source: str
    kind: str


@dataclass
class _Column:
    unit: str
    text: str
    is_state: bool
    values: np.ndarray
    full: str

    @cached_property
    def shown(self) -> np.ndarray:
        """Numbers, or the words of states."""
        return np.array(_core.STATES)[self.values.astype(int)] if self.is_state else self.values


class Value(float):
    """A number with its error bound: ``value.error``, in the same unit; None where no bound is known."""

    error: float | None

    def __new__(cls, value: float, error: float | None):
        self = super().__new__(cls, value)
        self.error = error
        return self

    def __getnewargs__(self) -> tuple[float, float | None]:
        return float(self), self.error

    def __repr__(self) -> str:
        return float.__repr__(self) if self.error is None else f"{float(self)!r} ± {self.error:.2g}"


class Summary(Report):
    """What ``summary.json`` says, with short names for what is asked most: ``step``, ``settled``, ``speed``, ``regime``."""

    @property
    def step(self) -> Value | None:
        """Steady step length (m) with its error; the extrapolated limit where it has not settled; None without steps."""
        steps = self.data.get("steps") or {}
        if "step_m" in (steps.get("steady") or {}):
            return Value(steps["steady"]["step_m"], steps["steady"].get("error_m"))
        settling = steps.get("settling") or {}
        limit = settling.get("limit_m", settling.get("mean_m", steps.get("last_m")))
        return None if limit is None else Value(limit, settling.get("limit_error_m"))

    @property
    def settled(self) -> bool | None:
        """Whether the step length has converged; None without steps."""
        settling = (self.data.get("steps") or {}).get("settling")
        return None if settling is None else settling.get("state") == "settled"

    @property
    def speed(self) -> float | None:
        """Mean speed (m/s) of the steady steps, or of the whole run where they have not settled; None without steps."""
        steps = self.data.get("steps") or {}
        if "step_m" in (steps.get("steady") or {}):
            return steps["steady"]["step_m"] / steps["period_s"]
        return steps.get("mean_speed_m_s")

    @property
    def regime(self) -> dict[str, str]:
        """Slip regime of each contact whose loop closes: partial or gross slip; a contact that is carried along has none."""
        contacts = (self.data.get("contacts") or {}).items()
        return {name: one["fretting"]["regime"] for name, one in contacts if "regime" in (one.get("fretting") or {})}


class Plots:
    """Plots of a result with matplotlib; each returns its axes, and takes axes to draw into as ``ax``."""

    def __init__(self, result: Result):
        self._result = result

    def __call__(self, *columns: str, x: str = "time", ax=None):
        """Columns over another one, by default over time; columns of several units get a pair of axes each.

        >>> import stickslip as ss
        >>> axes = ss.examples.quickstart().run().plot("slider.x", "foot.x")
        >>> axes.get_xlabel()
        'time (s)'
        """
        return self._draw(columns, x, ax, slice(None))

    def _draw(self, columns: tuple[str, ...], x: str, ax, rows: slice):
        result = self._result
        units = list(dict.fromkeys(result.units[result.name_of(name)] for name in columns))
        if len(units) > 1 and ax is None:
            # A pair of axes for each unit.
            import matplotlib.pyplot as plt

            groups = [[name for name in columns if result.units[result.name_of(name)] == unit] for unit in units]
            _, axes = plt.subplots(len(units), sharex=True)
            return [self._draw(tuple(group), x, own, rows) for group, own in zip(groups, axes, strict=True)]
        ax = _axes(ax)
        for name in columns:
            ax.plot(result[x][rows], result[name][rows], label=name)
        ax.set_xlabel(_label(x, result))
        ax.set_ylabel(_label(columns[0], result) if len(columns) == 1 else ", ".join(units))
        if len(columns) > 1:
            ax.legend()
        return ax

    def loop(self, contact: str, ax=None, *, all: bool = False):  # noqa: A002
        """Hysteresis loop of a contact: tangential force over displacement, in the last period, or in ``all`` of the run.

        The loop is as fine as the rows: ``output.every`` of a scenario must resolve the flyback.
        """
        r = self._result
        start = 0 if all else int(np.searchsorted(r.t, r.t[-1] - (r.period or np.inf) * (1 + 1e-9)))
        ax = self._draw((f"{contact}.fx",), f"{contact}.u", ax, slice(start, None))
        ax.set(xlabel=f"displacement u of {contact} (m)", ylabel="tangential force (N)", title=r.scenario.title)
        return ax

    def trajectory(self, ax=None):
        """Displacements of all bodies along the slide, over time."""
        ax = self(*[name for name in self._result if name.endswith(".x")], ax=ax)
        ax.set(ylabel="displacement (m)", title=self._result.scenario.title)
        return ax

    def energy(self, ax=None):
        """All energies and works over time."""
        ax = self(*[name for name, unit in self._result.units.items() if unit == "J"], ax=ax)
        ax.set(ylabel="energy (J)", title=self._result.scenario.title)
        return ax

    def phase(self, body: str, ax=None):
        """Velocity of a body over its displacement."""
        return self(f"{body}.vx", x=f"{body}.x", ax=ax)


class Result(Mapping[str, np.ndarray]):
    """The result of a run.

    ``result["slider.x"]`` is a column as an array, also by its name in trace.csv, ``result["slider.x_m"]``; ``result.units`` maps every
    column to its SI unit. The columns of states hold words. ``result.results`` is what summary.json says.

    >>> import stickslip as ss
    >>> r = ss.examples.quickstart().run()
    >>> r.units["slider.x"]
    'm'
    >>> r["ball.state"][0] in ("open", "stick", "partial", "slip")
    True
    >>> f"{r.results.step * 1e9:.1f} nm"
    '153.3 nm'
    """

    def __init__(self, scenario: Scenario, core: _core.Run):
        self.scenario = scenario
        self._core = core

    @cached_property
    def _loaded(self) -> dict[str, _Column]:
        columns = self._core.columns
        return {name: _Column(unit, text, is_state, values, full) for full, name, unit, text, is_state, values in columns}

    @cached_property
    def _names(self) -> dict[str, str]:
        return {column.full: name for name, column in self._loaded.items()}

    @cached_property
    def units(self) -> Mapping[str, str]:
        """SI unit of every column by its name; empty where it has none."""
        return MappingProxyType({name: column.unit for name, column in self._loaded.items()})

    @cached_property
    def texts(self) -> Mapping[str, str]:
        """What every column is, in a sentence."""
        return MappingProxyType({name: column.text for name, column in self._loaded.items()})

    def name_of(self, name: str) -> str:
        """The name of a column without its unit, from either of its names."""
        name = self._names.get(name, name)
        if name not in self._loaded:
            raise KeyError(f"{name!r}; columns: {', '.join(self._loaded)}")
        return name

    def __getitem__(self, name: str) -> np.ndarray:
        return self._loaded[self.name_of(name)].shown

    # Two results are compared by `==` of their columns.
    __eq__ = object.__eq__
    __hash__ = object.__hash__

    def __reduce__(self):
        raise TypeError("a Result cannot be pickled: send columns, to_pandas() or summary")

    def __iter__(self) -> Iterator[str]:
        return iter(self._loaded)

    def __len__(self) -> int:
        return len(self._loaded)

    @property
    def period(self) -> float | None:
        """Period of the drive or of the loops, s; None where there is none."""
        steps, contacts = self.summary.get("steps") or {}, (self.summary.get("contacts") or {}).values()
        cycles = [one["fretting"]["cycle_s"] for one in contacts if "cycle_s" in (one.get("fretting") or {})]
        return steps.get("period_s") or next((end - start for start, end in cycles), None)

    @property
    def t(self) -> np.ndarray:
        """Times of the rows, s."""
        return self["time"]

    @cached_property
    def events(self) -> list[Event]:
        """The events of events.csv, in order: all of them up to ``output.events.most``, of later ones a part."""
        return [Event(*one) for one in self._core.events]

    @cached_property
    def results(self) -> Summary:
        """What summary.json says, as an object; computed when it is first asked for."""
        return Summary(json.loads(self._core.summary()))

    @property
    def summary(self) -> dict[str, Any]:
        """What summary.json says, as a dict; without files and the time taken."""
        return self.results.data

    @property
    def plot(self) -> Plots:
        """Plots with matplotlib: ``plot.loop("ball")``, ``plot.trajectory()``, ``plot("slider.x", "foot.x")``."""
        return Plots(self)

    def png(self, plot: str, *, theme: str = "light", scale: int = 1) -> bytes:
        """The program's own picture, such as "loop" or "trajectory", as the bytes of a PNG.

        >>> import stickslip as ss
        >>> ss.examples.quickstart().run().png("loop")[1:4]
        b'PNG'
        """
        if theme not in ("light", "dark") or scale not in (1, 2, 3, 4):
            raise ValueError(f"expected the theme light or dark and a scale from 1 to 4, got {theme!r} and {scale!r}")
        return self._core.picture(plot, "png", theme, scale)

    def svg(self, plot: str, *, theme: str = "light") -> str:
        """The program's own picture as SVG."""
        return self._core.picture(plot, "svg", theme, 1).decode()

    def to_pandas(self):
        """A pandas.DataFrame of all columns over the time; ``attrs["units"]`` has their units. Needs pandas (``stickslip[tables]``)."""
        import pandas

        index = pandas.Index(self["time"], name="time")
        frame = pandas.DataFrame({name: self[name] for name in self if name != "time"}, index=index)
        frame.attrs["units"] = dict(self.units)
        return frame

    def to_xarray(self):
        """An xarray.Dataset over the coordinate time; the attributes of each variable have its units and its description. Needs xarray."""
        import xarray

        def attrs(name: str) -> dict[str, str]:
            return {"units": self.units[name], "long_name": self.texts[name]}

        data = {name: ("time", self[name], attrs(name)) for name in self if name != "time"}
        coords = {"time": ("time", self["time"], attrs("time"))}
        return xarray.Dataset(data, coords=coords, attrs={"title": self.scenario.title})

    def save(self, file: str | os.PathLike[str]) -> None:
        """Writes all columns: .parquet or .csv, under their names with units, or .nc; a file appears whole or not at all."""
        file = os.fspath(file)
        draft = f"{file}.{os.getpid()}.{threading.get_ident()}.part"
        frame = self.to_pandas().reset_index().rename(columns={name: column.full for name, column in self._loaded.items()})
        writers = {
            ".parquet": lambda: frame.to_parquet(draft),
            ".csv": lambda: frame.to_csv(draft, index=False),
            ".nc": lambda: self.to_xarray().to_netcdf(draft),
        }
        writer = writers.get(os.path.splitext(file)[1])
        if writer is None:
            raise ValueError(f"{file}: expected a file that ends with {', '.join(writers)}")
        try:
            writer()
            os.replace(draft, file)
        finally:
            if os.path.exists(draft):
                os.remove(draft)

    def __repr__(self) -> str:
        return f"<Result of {self.scenario.name}: {len(self['time'])} rows, {len(self)} columns, {self._core.event_count} events>"

    def _repr_html_(self) -> str:
        results = self.results
        step = results.step
        rows = {"status": results.get("status"), "step length (m)": step, "settled": results.settled} if step is not None else {"status": results.get("status")}
        rows |= {f"regime of {name}": regime for name, regime in results.regime.items()}
        cells = "".join(f"<tr><th>{html.escape(k)}</th><td>{html.escape(str(v))}</td></tr>" for k, v in rows.items())
        warnings = "".join(f"<pre>{html.escape(text)}</pre>" for _, text in self.scenario.warnings)
        try:
            image = base64.b64encode(self.png("loop")).decode()
            picture = f'<img style="max-width:100%" src="data:image/png;base64,{image}" alt="hysteresis loops">'
        except _core_errors():
            picture = ""
        return f"<h4>{html.escape(self.scenario.title)}</h4><table>{cells}</table>{warnings}{picture}"


def _core_errors() -> tuple[type[Exception], ...]:
    from ._errors import RunError

    return (RunError, ValueError)


def _axes(ax):
    if ax is not None:
        return ax
    import matplotlib.pyplot as plt

    return plt.subplots()[1]


def _label(name: str, result: Result) -> str:
    name = result.name_of(name)
    return f"{name} ({result.units[name]})" if result.units[name] else name
