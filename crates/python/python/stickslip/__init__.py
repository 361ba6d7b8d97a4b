"""stickslip: a simulator of stick-slip drives.

>>> import stickslip as ss
>>> s = ss.examples.quickstart()                  # or ss.load("drive.json"), or ss.Scenario({...})
>>> s = s.set("contacts.ball.friction", 0.25)
>>> r = s.run()
>>> r["slider.x"].shape == r["time"].shape
True
"""

from __future__ import annotations

import json as _json

from . import _core, examples, types
from ._errors import ErrorReport, RunError, ScenarioError, StickslipWarning
from ._linear import LinearSystem
from ._report import Report, Table
from ._result import Event, Plots, Result, Summary, Value
from ._scenario import Curve, Scenario, Simulation, compare, fit, load, measure, run_many
from ._study import Study, grid, log_grid, lognormal, normal, study, triangular, uniform, values

__version__ = "0.1.0"
STATES: list[str] = _core.STATES

__all__ = [
    "STATES", "Curve", "ErrorReport", "Event", "LinearSystem", "Plots", "Report", "Result", "RunError", "Scenario", "ScenarioError",
    "Simulation", "StickslipWarning", "Study", "Summary", "Table", "Value", "compare", "examples", "fit", "grid", "load", "log_grid", "lognormal",
    "measure", "normal", "run_many", "schema", "study", "triangular", "types", "uniform", "values",
]  # fmt: skip


def schema() -> dict[str, object]:
    """The JSON Schema of scenario files."""
    return _json.loads(_core.schema())
