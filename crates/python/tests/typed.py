"""Read by a type checker, never run: each line with "expected" is an error, and no other is."""

import stickslip as ss
from stickslip.types import ScenarioDict

good: ScenarioDict = {
    "stickslip": 1,
    "waveforms": {"drive": {"sine": {"amplitude": "1 um", "frequency": 10.0}}},
    "bodies": {"slider": {"mass": "1 g", "x": "free"}},
    "contacts": {},
    "run": {"duration": 1e-3},
}
misspelt: ScenarioDict = {"stickslip": 1, "bodies": {"a": {"mas": "1 g"}}, "contacts": {}, "run": {"cycles": 3}}  # expected
no_mass: ScenarioDict = {"stickslip": 1, "bodies": {"a": {"mass": [1]}}, "contacts": {}, "run": {"cycles": 3}}  # expected
result: ss.Result = ss.Scenario(good).run()
step: ss.Value | None = result.results.step
wrong: int = result["slider.x"]  # expected
