"""Studies: many runs of one scenario that differ in some numbers."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping, Sequence
from functools import lru_cache, partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core
from ._errors import RunError
from ._report import Report
from ._scenario import Scenario, _plain

if TYPE_CHECKING:
    import pandas as pd


def uniform(low: Any, high: Any) -> dict[str, Any]:
    """The uniform distribution between two bounds."""
    return {"uniform": [low, high]}


def normal(mean: Any, deviation: Any, low: Any = None, high: Any = None) -> dict[str, Any]:
    """The normal distribution; with two bounds the truncated normal distribution."""
    if (low is None) != (high is None):
        raise ValueError("a truncated normal distribution needs a lower and an upper bound")
    return {"normal": [mean, deviation] if low is None else [mean, deviation, low, high]}


def lognormal(median: Any, deviation: float) -> dict[str, Any]:
    """The lognormal distribution, by its median and its geometric standard deviation (a factor above 1)."""
    return {"lognormal": [median, deviation]}


def triangular(low: Any, mode: Any, high: Any) -> dict[str, Any]:
    """The triangular distribution."""
    return {"triangular": [low, mode, high]}


def grid(first: Any, last: Any, count: int) -> dict[str, Any]:
    """Equally spaced values."""
    return {"grid": [first, last, count]}


def log_grid(first: Any, last: Any, count: int) -> dict[str, Any]:
    """Values in equal ratios."""
    return {"log": [first, last, count]}


def values(*all: Any) -> dict[str, Any]:  # noqa: A002
    """These values."""
    return {"list": list(all)}


def study(
    scenario: Scenario,
    vary: Mapping[str, Any] | None = None,
    *,
    n: int | None = None,
    results: Sequence[str] | None = None,
    sampling: str | None = None,
    seed: int = 1,
    chunk: int = 1000,
    **numbers: Any,
) -> Study:
    """A study of a scenario: ``vary`` has a distribution or a grid for each path; a number whose key stands only once in the scenario
    may be given by that key. ``n`` is the number of samples of the distributions at each point of the grids.

    ``results`` are paths of the summary, such as ``"steps.last_m"``, or channels at the end of the run, such as ``"slider.x_m"``; by
    default the place of each free body, the last step of a drive, and the friction work.

    >>> import stickslip as ss
    >>> s = ss.study(ss.examples.p1().set("run.cycles", 3), friction=ss.normal(0.15, 0.01), n=100)
    >>> s.cases, s.varied
    (100, ['contacts.ball.friction'])
    """
    data = scenario.to_dict()
    vary = dict(vary or {}) | {_path(data, key): how for key, how in numbers.items()}
    file = {
        "stickslip_study": 1,
        "scenario": data,
        "seed": seed,
        "vary": vary,
        "results": list(_results(data) if results is None else results),
        "chunk": chunk,
    }
    file |= {key: value for key, value in {"cases": n, "sampling": sampling}.items() if value is not None}
    text = json.dumps(file, default=_plain)
    return Study(_core.Study(text, scenario.name, scenario.name, ""))


def _path(data: Any, key: str) -> str:
    """The path of the only number under a key."""
    found: list[str] = []

    def look(here: Any, path: str) -> None:
        if isinstance(here, dict):
            for name, inner in here.items():
                look(inner, f"{path}.{name}" if path else name)
        elif isinstance(here, list):
            for place, inner in enumerate(here):
                look(inner, f"{path}[{place}]")
        elif isinstance(here, (int, float)) and not isinstance(here, bool) and path.rsplit(".", 1)[-1] == key:
            found.append(path)

    look(data, "")
    if len(found) == 1:
        return found[0]
    known = f"it is {' and '.join(found)}" if found else "the scenario has no such number"
    raise ValueError(f"{key}: {known}; name the path in vary={{...}}")


def _results(data: dict[str, Any]) -> list[str]:
    free = [name for name, body in data["bodies"].items() if body.get("x") == "free"]
    drives = len(free) == 1 or "body" in data.get("figures", {})
    periodic = bool(data.get("waveforms"))
    return [f"{name}.x_m" for name in free] + ["steps.last_m"] * (drives and periodic) + ["energy.friction_J"]


@lru_cache(maxsize=8)
def _portable(text: str) -> _core.Study:
    return _core.Study(text, "study", "study", "")


def _part(text: str, out: str, part: int) -> int:
    """Computes one part: what a worker of a cluster does."""
    core = _portable(text)
    core.run(out, part, core.parts, 1)
    return part


class Study:
    """Many runs of one scenario that differ in some numbers: a study file, or ``ss.study(...)``.

    The result is a folder of Parquet files, which pandas, polars and DuckDB read as one table. A finished part is not computed again:
    after an interruption, ``run`` computes what is missing.

    >>> import stickslip as ss, tempfile
    >>> s = ss.study(ss.examples.p1().set("run.cycles", 3), friction=ss.uniform(0.1, 0.2), n=8, results=["steps.last_m"])
    >>> with tempfile.TemporaryDirectory() as out:
    ...     s.run(out).statistics().failed
    0
    """

    def __init__(self, core: _core.Study, out: str | os.PathLike[str] | None = None):
        self._core = core
        self._out = out

    @classmethod
    def load(cls, file: str | os.PathLike[str]) -> Study:
        """Reads a study file. Raises ScenarioError."""
        path = Path(file)
        return cls(_core.Study(None, os.fspath(path), path.stem, ""), Path("results") / f"{path.stem}-study")

    def __reduce__(self):
        return _from_portable, (self._core.portable(), None if self._out is None else os.fspath(self._out))

    @property
    def name(self) -> str:
        """Name of the scenario."""
        return self._core.name

    @property
    def cases(self) -> int:
        """Number of cases."""
        return self._core.cases

    @property
    def parts(self) -> int:
        """Number of parts."""
        return self._core.parts

    @property
    def varied(self) -> list[str]:
        """Paths of the numbers that vary."""
        return self._core.varied

    @property
    def results(self) -> list[str]:
        """Names of the results."""
        return [name for name, _ in self._core.results]

    @property
    def out(self) -> Path:
        """The folder of the parts."""
        return Path("results") / f"{self.name}-study" if self._out is None else Path(self._out)

    def overrides(self, case: int) -> dict[str, float]:
        """The numbers of a case by path, as ``Scenario.set`` takes them."""
        return {path: float(value) for path, value in self._core.overrides(case)}

    def plan(self, *, threads: int = 0) -> Report:
        """Number of cases and parts, expected time and size, from ten cases (``stickslip study plan``)."""
        return Report.from_json(self._core.forecast(threads))

    def status(self) -> tuple[int, list[int]]:
        """Number of finished parts, and the missing ones."""
        parts, missing, _ = self._core.status(self.out)
        return parts, missing

    def run(
        self,
        out: str | os.PathLike[str] | None = None,
        *,
        threads: int = 0,
        shard: tuple[int, int] | None = None,
        client: Any = None,
        fresh: bool = False,
    ) -> Study:
        """Computes the parts that are missing in the folder ``out``, and returns the study with that folder.

        ``threads`` are those of this machine, all cores by default; ``shard=(i, n)`` computes every n-th part, i from 1 to n. With a
        ``dask.distributed.Client`` the parts are computed by the workers of a cluster, which must see the same folder; a part of a worker
        that dies is computed by another one. ``fresh`` removes the parts of this study first. Raises RunError where it is interrupted;
        finished parts stay.
        """
        done = Study(self._core, self.out if out is None else out)
        place = os.path.abspath(done.out)
        if fresh:
            self._core.remove(place)
        if client is None:
            index, count = (0, 1) if shard is None else (shard[0] - 1, shard[1])
            if not 0 <= index < count:
                raise ValueError(f"expected a shard (i, n) with i from 1 to n, got {shard}")
            self._core.run(place, index, count, threads)
            return done
        if shard is not None:
            raise ValueError("a client distributes the parts itself: leave shard out")
        _, missing, _ = self._core.status(place)
        work = partial(_part, self._core.portable(), place)
        futures = client.map(work, missing, pure=False, retries=3, key=f"stickslip-{self._core.hash[:8]}")
        client.gather(futures)
        left = self._core.status(place)[1]
        if left:
            raise RunError(f"{place}: {len(left)} parts are missing here: do the workers see the same folder?")
        return done

    def frame(self) -> pd.DataFrame:
        """The result as a pandas DataFrame: case, numbers that vary (SI), results, error. Words are categories."""
        import pandas as pd

        columns: dict[str, Any] = {"case": np.arange(self.cases)}
        columns |= {path: self._core.values(place) for place, path in enumerate(self.varied)}
        for place, (name, words) in enumerate(self._core.results):
            column = self._core.column(self.out, place)
            if words is not None:
                column = pd.Categorical.from_codes(np.where(np.isnan(column), -1, column).astype(int), words)
            columns[name] = column
        columns["error"] = pd.Series(self._core.errors(self.out), dtype=object)
        return pd.DataFrame(columns)

    def statistics(self) -> Report:
        """Quantiles of each result, failed cases by reason, and the cases with extreme results."""
        return Report.from_json(self._core.statistics(self.out))

    def indices(self, *, threads: int = 0) -> Report:
        """Variance-based sensitivity indices (Sobol indices) of the results; runs the cases that they need, beside the parts."""
        return Report.from_json(self._core.indices(self.out, threads))

    def __repr__(self) -> str:
        return f"<Study of {self.name}: {self.cases} cases in {self.parts} parts>"


def _from_portable(text: str, out: str | None) -> Study:
    return Study(_core.Study(text, "study", "study", ""), out)
