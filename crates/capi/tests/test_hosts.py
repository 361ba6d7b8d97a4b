"""The FMUs in FMPy and PathSim: all examples, states, bad calls. Arguments in the environment: STICKSLIP, the program; FMUS, a folder."""

import csv
import ctypes
import json
import math
import os
import random
import resource
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from fmpy import extract, read_model_description, simulate_fmu
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Slave
from fmpy.fmi3 import FMU3Slave
from fmpy.validation import validate_fmu

ROOT = Path(__file__).resolve().parents[3]
STICKSLIP = os.environ.get("STICKSLIP", "stickslip")
FMUS = Path(os.environ.get("FMUS", "fmus"))
EXAMPLES = sorted(path.stem for path in (ROOT / "scenarios").glob("*.json"))
VERSIONS = ["2", "3"]
FOLDERS = {}


def export(scenario, version, *more, name=None):
    """Writes an FMU of a scenario and returns its path."""
    path = FMUS / f"{name or Path(scenario).stem}-{version}.fmu"
    command = [STICKSLIP, "export", "fmu", str(scenario), "--fmi", version, "--out", str(path), *more]
    subprocess.run(command, check=True, capture_output=True, text=True)
    return path


def example(name, version):
    path = FMUS / f"{name}-{version}.fmu"
    return path if path.exists() else export(ROOT / "scenarios" / f"{name}.json", version)


class Fmu:
    """An instance of either version, with variables by name."""

    def __init__(self, path, initialise=True, early=False):
        self.description = read_model_description(str(path))
        if path not in FOLDERS:
            FOLDERS[path] = extract(str(path))
        self.is_two = self.description.fmiVersion.startswith("2")
        kind = FMU2Slave if self.is_two else FMU3Slave
        self.fmu = kind(
            guid=self.description.guid,
            unzipDirectory=FOLDERS[path],
            modelIdentifier="stickslip",
            instanceName="it",
        )
        self.fmu.instantiate() if self.is_two else self.fmu.instantiate(earlyReturnAllowed=early)
        self.variables = {it.name: it for it in self.description.modelVariables}
        self.outputs = [it for it in self.description.modelVariables if it.causality == "output"]
        self.time = 0.0
        if initialise:
            self.initialise()

    def initialise(self):
        if self.is_two:
            self.fmu.setupExperiment(startTime=0.0)
        self.fmu.enterInitializationMode()
        self.fmu.exitInitializationMode()

    def kind(self, variable):
        if variable.type in ("Real", "Float64"):
            return ("Real", "Float64")
        return ("Integer", "Int64" if variable.type == "Enumeration" else "Int32")

    def get(self, name):
        variable = self.variables[name]
        get = getattr(self.fmu, "get" + self.kind(variable)[0 if self.is_two else 1])
        return get([variable.valueReference])[0]

    def set(self, name, value):
        variable = self.variables[name]
        put = getattr(self.fmu, "set" + self.kind(variable)[0 if self.is_two else 1])
        put([variable.valueReference], [value])

    def step(self, length, t=None):
        t = self.time if t is None else t
        if self.is_two:
            self.fmu.doStep(t, length)
            self.time = t + length
            return False
        _, _, early, last = self.fmu.doStep(t, length)
        self.time = float(last)
        return bool(early)

    def row(self):
        return [float(self.get(it.name)) for it in self.outputs]

    def bytes(self):
        get, serialise, free = ("getFMUstate", "serializeFMUstate", "freeFMUstate") if self.is_two else ("getFMUState", "serializeFMUState", "freeFMUState")
        state = getattr(self.fmu, get)()
        data = getattr(self.fmu, serialise)(state)
        getattr(self.fmu, free)(state)
        return data

    def restore(self, data, time):
        read, put, free = ("deSerializeFMUstate", "setFMUstate", "freeFMUstate") if self.is_two else ("deserializeFMUState", "setFMUState", "freeFMUState")
        state = getattr(self.fmu, read)(data)
        getattr(self.fmu, put)(state)
        getattr(self.fmu, free)(state)
        self.time = time

    def close(self):
        self.fmu.freeInstance()


def program(scenario, *sets):
    """Columns of a run of the program, and the tolerance."""
    out = FMUS / "results"
    command = [STICKSLIP, "run", str(scenario), "--out", str(out), "--set", "plots=[]", "--set", "figures.steady_motion=false"]
    subprocess.run(command + [part for one in sets for part in ("--set", one)], check=True, capture_output=True)
    folder = out / Path(scenario).stem
    with open(folder / "trace.csv") as file:
        rows = list(csv.DictReader(file))
    resolved = json.loads((folder / "scenario.json").read_text())
    stepper = resolved["run"].get("stepper", {})
    tolerance = stepper.get("event", {}).get("tolerance", 1e-8) if isinstance(stepper, dict) else 1e-8
    return rows, tolerance


def positions(fmu):
    return [it.name for it in fmu.outputs if it.name.split(".")[-1] in ("x", "z", "pitch")]


def column(name, rows):
    """Name of the column of an output; None where the scenario leaves it out."""
    plain = name.replace("'", "")
    return next((key for key in rows[0] if key in (plain, plain + "_m", plain + "_rad", plain + "_m_s", plain + "_rad_s", plain + "_N", plain + "_J", plain + "_V", plain + "_A")), None)


@pytest.mark.parametrize("version", VERSIONS)
@pytest.mark.parametrize("name", EXAMPLES)
def test_every_example_is_valid_and_ends_as_the_program(name, version):
    path = example(name, version)
    assert validate_fmu(str(path)) == []
    scenario = ROOT / "scenarios" / f"{name}.json"
    rows, tolerance = program(scenario)
    finer, _ = program(scenario, f"run.stepper.event.tolerance={tolerance / 10}")
    end = float(rows[-1]["time_s"])
    fmu = Fmu(path)
    states = {"open": 0, "stick": 1, "partial": 2, "slip": 3}
    for it in (it for it in fmu.outputs if column(it.name, rows)):
        cell = rows[0][column(it.name, rows)]
        known = states[cell] if cell in states else float(cell)
        assert fmu.get(it.name) == known, (it.name, known)

    def reached(lengths):
        fmu = Fmu(path)
        for length in lengths:
            fmu.step(length)
        found = {name: fmu.get(name) for name in positions(fmu)}
        fmu.close()
        return found

    draw = random.Random(1)
    cuts = sorted(draw.random() for _ in range(60))
    drawn = [end * (b - a) for a, b in zip([0.0, *cuts], [*cuts, 1.0], strict=True)]
    ways = {"97 steps": [end / 97] * 97, "970 steps": [end / 970] * 970, "drawn steps": drawn}
    for way, lengths in ways.items():
        for name, value in reached(lengths).items():
            key = column(name, rows)
            if key is None:
                continue
            series = [float(row[key]) for row in rows]
            largest = max(abs(value) for value in series)
            # Impacts amplify what a smaller tolerance changes.
            allowed = 10 * tolerance * largest + 10 * abs(float(finer[-1][key]) - series[-1]) + 1e-18
            assert abs(value - series[-1]) <= allowed, (way, name, value, series[-1], allowed)
    fmu.close()


@pytest.mark.parametrize("version", VERSIONS)
def test_a_host_simulates(version):
    result = simulate_fmu(str(example("quickstart", version)), stop_time=0.02, output=["slider.x"])
    rows, _ = program(ROOT / "scenarios" / "quickstart.json", "run.duration=0.02")
    assert math.isclose(result["slider.x"][-1], float(rows[-1]["slider.x_m"]), rel_tol=1e-6)


@pytest.mark.parametrize("version", VERSIONS)
def test_communication_points_may_be_off_by_rounding(version):
    path = example("walking_drive", version)
    ends = []
    for off in (0.0, 1e-12, -1e-12):
        fmu = Fmu(path)
        for k in range(100):
            fmu.step(1e-5, t=k * 1e-5 + (off if k else 0.0))
        ends.append(fmu.get(positions(fmu)[0]))
        fmu.close()
    assert max(ends) - min(ends) < 1e-9 * abs(ends[0]) + 1e-18


@pytest.mark.parametrize("version", VERSIONS)
@pytest.mark.parametrize("name", ["p1", "walking_drive", "controlled", "commanded", "rocking_slider"])
def test_a_state_continues_in_another_process(name, version, tmp_path):
    path = example(name, version)
    fmu = Fmu(path)
    # In the flyback, where contacts slip.
    for k in range(47):
        if name == "controlled" and k % 5 == 0:
            fmu.set("drive", 1e-8 * (k % 7))
        fmu.step(1.97e-5)
    data, time = fmu.bytes(), fmu.time
    (tmp_path / "state").write_bytes(data)
    for _ in range(50):
        fmu.step(1.97e-5)
    here = [value.hex() for value in fmu.row()]
    there = subprocess.run(
        [sys.executable, __file__, str(path), str(tmp_path / "state"), repr(time)], check=True, capture_output=True, text=True
    ).stdout.split()
    assert here == there
    # The same instance goes back a thousand times, as the sigma points of a filter do.
    first = None
    for _ in range(1000):
        fmu.restore(data, time)
        fmu.step(1.97e-5)
        now = [value.hex() for value in fmu.row()]
        first = first or now
        assert now == first
    fmu.close()


def continued(path, state, time):
    fmu = Fmu(path)
    fmu.restore(state, time)
    for _ in range(50):
        fmu.step(1.97e-5)
    print(*(value.hex() for value in fmu.row()))


@pytest.mark.parametrize("version", VERSIONS)
def test_parameters_are_those_of_the_scenario(version):
    scenario = ROOT / "scenarios" / "quickstart.json"
    paths = ["contacts.ball.friction", "bodies.slider.mass"]
    more = [part for path in paths for part in ("--parameter", path)]
    fmu = Fmu(export(scenario, version, *more, name="parameters"), initialise=False)
    assert fmu.get("contacts.ball.friction") == 0.2
    fmu.set("contacts.ball.friction", 0.15)
    fmu.set("bodies.slider.mass", 0.02)
    fmu.initialise()
    for _ in range(20):
        fmu.step(1e-3)
    rows, _ = program(scenario, "contacts.ball.friction=0.15", "bodies.slider.mass=0.02", "run.duration=0.02")
    assert math.isclose(fmu.get("slider.x"), float(rows[-1]["slider.x_m"]), rel_tol=1e-6)
    data, time = fmu.bytes(), fmu.time
    with pytest.raises(FMICallException):
        fmu.set("contacts.ball.friction", 0.3)
    fmu.step(1e-3)
    known = fmu.row()
    fmu.close()
    # The parameters are part of a state.
    other = Fmu(FMUS / f"parameters-{version}.fmu")
    other.restore(data, time)
    other.step(1e-3)
    assert other.row() == known and other.get("contacts.ball.friction") == 0.15
    other.close()


@pytest.mark.parametrize("version", VERSIONS)
def test_commands_and_inputs(version):
    fmu = Fmu(example("commanded", version))
    stroke = fmu.variables["drive.stroke"]
    assert float(stroke.start) > 0.0 and fmu.get("drive.stroke") == float(stroke.start)
    fmu.set("drive.steps", 2)
    fmu.set("drive.heading", -1)
    for _ in range(30):
        fmu.step(1e-3)
    assert fmu.get("slider.x") < 0.0
    with pytest.raises(FMICallException):
        fmu.set("drive.stroke", 1.0)
    fmu.close()
    fmu = Fmu(example("controlled", version), initialise=False)
    fmu.set("drive", 5e-8)
    fmu.initialise()
    assert fmu.get("foot.x") == 5e-8
    fmu.close()


def test_steps_end_early_at_slip():
    fmu = Fmu(example("p1", "3"), early=True)
    events = []
    while fmu.time < 4e-3:
        if fmu.step(1e-3 - fmu.time % 1e-3 if fmu.time % 1e-3 > 1e-9 else 1e-3):
            events.append(fmu.time)
    rows, _ = program(ROOT / "scenarios" / "p1.json", "run.duration=0.004")
    with open(FMUS / "results" / "p1" / "events.csv") as file:
        known = [float(row["time_s"]) for row in csv.DictReader(file) if row["kind"] in ("gross slip", "gross slip ends")]
    # An event at the end of a step does not end it early.
    known = [t for t in known if abs(t - round(t, 3)) > 1e-12]
    assert len(events) == len(known) > 3
    assert max(abs(a - b) for a, b in zip(events, known, strict=True)) < 1e-9
    assert math.isclose(fmu.get("slider.x"), float(rows[-1]["slider.x_m"]), rel_tol=1e-6)
    fmu.close()


@pytest.mark.parametrize("version", VERSIONS)
def test_bad_calls_are_errors_with_messages(version):
    path = example("controlled", version)

    def refused(act, ready=True):
        fmu = Fmu(path, initialise=ready)
        with pytest.raises(FMICallException):
            act(fmu)
        if ready:
            # The instance goes on.
            fmu.step(1e-5)
        fmu.close()

    get = "getReal" if version == "2" else "getFloat64"
    put = "setReal" if version == "2" else "setFloat64"
    refused(lambda it: it.step(1e-5), ready=False)
    refused(lambda it: getattr(it.fmu, get)([4711]))
    refused(lambda it: getattr(it.fmu, put)([4711], [0.0]))
    refused(lambda it: it.set("slider.x", 0.0))
    refused(lambda it: it.set("drive", math.nan))
    refused(lambda it: it.set("drive", 1.0))
    refused(lambda it: it.step(-1e-5))
    refused(lambda it: it.step(math.nan))
    refused(lambda it: it.step(1e-5, t=1e-3))
    for data in (b"", b"nonsense", Fmu(path).bytes()[:-9] + b"123456789", Fmu(example("commanded", version)).bytes()):
        refused(lambda it, data=data: it.restore(data, 0.0))
    fmu = Fmu(path)
    fmu.step(1e-4)
    with pytest.raises(FMICallException):
        fmu.step(1e-5, t=5e-5)
    fmu.close()
    description = read_model_description(str(path))
    folder = FOLDERS[path]
    kind = FMU2Slave if version == "2" else FMU3Slave
    for guid, place in (("{wrong}", folder), (description.guid, str(FMUS))):
        with pytest.raises(Exception):
            stranger = kind(guid=guid, unzipDirectory=folder, modelIdentifier="stickslip", instanceName="it")
            stranger.unzipDirectory = place
            stranger.instantiate()
            assert stranger.component is None


def test_instances_leave_nothing_and_are_small():
    path = example("quickstart", "2")
    fmu = Fmu(path)
    address = f"file://{FOLDERS[path]}/resources".encode()

    def instantiate():
        return fmu.fmu.fmi2Instantiate(b"it", 1, fmu.description.guid.encode(), address, ctypes.byref(fmu.fmu.callbacks), 0, 0)

    def resident():
        with open("/proc/self/statm") as file:
            return int(file.read().split()[1]) * resource.getpagesize()

    for _ in range(100):
        fmu.fmu.fmi2FreeInstance(instantiate())
    before = resident()
    for _ in range(int(os.environ.get("INSTANCES", "2000"))):
        fmu.fmu.fmi2FreeInstance(instantiate())
    assert resident() - before < 2e6
    before = resident()
    many = [instantiate() for _ in range(1000)]
    for one in many:
        fmu.fmu.fmi2EnterInitializationMode(one)
        fmu.fmu.fmi2ExitInitializationMode(one)
        fmu.fmu.fmi2DoStep(one, 0.0, 1e-3, 0)
    each = (resident() - before) / len(many)
    assert each < 200e3, each
    for one in many:
        fmu.fmu.fmi2FreeInstance(one)
    fmu.close()


def test_another_host_runs_it():
    pathsim = pytest.importorskip("pathsim")
    fmi = pytest.importorskip("pathsim_fmi")
    from pathsim.blocks import Scope

    block = fmi.CoSimulationFMU(str(example("quickstart", "2")), dt=1e-4)
    scope = Scope()
    simulation = pathsim.Simulation([block, scope], [pathsim.Connection(block[0], scope[0])], dt=1e-4, log=False)
    simulation.run(0.02)
    times, values = scope.read()
    rows, _ = program(ROOT / "scenarios" / "quickstart.json", "run.duration=0.02", "output.every=1e-4")
    name = column(read_model_description(str(example("quickstart", "2"))).modelVariables[0].name, rows)
    known = {round(float(row["time_s"]) / 1e-4): float(row[name]) for row in rows}
    largest = max(abs(value) for value in known.values())
    # The host records at a time what the FMU has reached at the end of the step that begins there: one step ahead, also in the last row.
    pairs = [(value, known.get(round(t / 1e-4) + 1)) for t, value in zip(times, values[0], strict=True)]
    assert len(pairs) == len(known) and pairs[-1][1] is None
    assert max(abs(value - there) for value, there in pairs[:-1]) < 1e-6 * largest


if __name__ == "__main__":
    continued(Path(sys.argv[1]), Path(sys.argv[2]).read_bytes(), float(sys.argv[3]))
