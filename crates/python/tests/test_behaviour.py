"""What the package does with good and bad input: errors with their place, held runs, units, tables, linear models."""

import pickle
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import stickslip as ss

QUICK = {
    "stickslip": 1,
    "waveforms": {"drive": {"sawtooth": {"stroke": "200 nm", "period": "10 ms", "flyback": "10 us"}}},
    "bodies": {"foot": {"x": {"follows": "drive"}}, "slider": {"mass": "10 g", "x": "free"}},
    "contacts": {
        "ball": {
            "between": ["foot", "slider"],
            "materials": ["ruby", "hardened steel"],
            "profile": {"paraboloid": {"radius": "0.5 mm"}},
            "friction": 0.2,
            "normal": {"force": "0.3 N"},
        }
    },
    "run": {"cycles": 3},
}


def test_the_quick_start_of_the_page(tmp_path):
    ss.examples.quickstart().save(tmp_path / "quickstart.json")
    s = ss.load(tmp_path / "quickstart.json")
    s = s.set("contacts.ball.friction", 0.25, "waveforms.drive.sawtooth.stroke", "300 nm")
    r = s.run()
    assert r["slider.x"] is r["slider.x_m"]
    assert r.units["slider.x"] == "m" and r.units["time"] == "s"
    assert r.results.settled and r.results.step.error < 1e-12
    assert abs(r.results.step - s.steady().step_m) < 1e-12
    assert r.plot.loop("ball").get_xlabel()
    sim = s.start()
    sim.advance("1 ms")
    snap = sim.state()
    x = sim["slider.x"]
    sim.advance("2 ms")
    sim.restore(snap)
    assert (sim.time, sim["slider.x"]) == (1e-3, x)
    c = ss.examples.controlled().start()
    c.advance("1 ms", drive=2e-7)
    assert abs(c["foot.x"] - 2e-7) < 1e-20
    results = ss.run_many([s.set("contacts.ball.friction", m) for m in (0.1, 0.2, 0.3)])
    assert [r.scenario.to_dict()["contacts"]["ball"]["friction"] for r in results] == [0.1, 0.2, 0.3]


def test_a_scenario_is_a_dict_and_comes_back():
    s = ss.Scenario(QUICK, name="quick")
    assert ss.Scenario(s.to_dict()).to_dict() == s.to_dict()
    again = pickle.loads(pickle.dumps(s))
    assert again.name == "quick" and again.to_dict() == s.to_dict()
    assert np.array_equal(again.run()["slider.x"], s.run()["slider.x"])
    sim = s.start()
    sim.advance(1e-3)
    other = pickle.loads(pickle.dumps(sim))
    sim.advance(2e-3), other.advance(2e-3)
    assert sim.row().tobytes() == other.row().tobytes()


def test_quantities_of_pint_and_numpy():
    pint = pytest.importorskip("pint")
    unit = pint.UnitRegistry()
    s = ss.Scenario(QUICK).set("bodies.slider.mass", 20 * unit.gram, "contacts.ball.friction", np.float64(0.25))
    assert s.to_dict()["bodies"]["slider"]["mass"] == pytest.approx(0.02, rel=1e-15)
    with pytest.raises(ss.ScenarioError, match="bodies.slider.mass"):
        s.set("bodies.slider.mass", 3 * unit.second)
    with pytest.raises(pint.DimensionalityError):
        ss.examples.controlled().start().advance(1e-3 * unit.newton)
    sim = ss.examples.controlled().start()
    sim.advance(1 * unit.ms, drive=100 * unit.nm)
    assert sim.time == 1e-3 and sim["foot.x"] == pytest.approx(1e-7, rel=1e-12)


def test_tables_for_others(tmp_path):
    pandas, xarray = pytest.importorskip("pandas"), pytest.importorskip("xarray")
    pytest.importorskip("pyarrow")
    r = ss.Scenario(QUICK).run()
    frame, data = r.to_pandas(), r.to_xarray()
    assert np.array_equal(frame["slider.x"].to_numpy(), r["slider.x"]) and frame.attrs["units"]["ball.fx"] == "N"
    assert data["slider.x"].attrs["units"] == "m" and isinstance(data, xarray.Dataset)
    r.save(tmp_path / "run.parquet"), r.save(tmp_path / "run.csv")
    assert np.array_equal(pandas.read_parquet(tmp_path / "run.parquet")["slider.x_m"].to_numpy(), r["slider.x"])
    assert np.array_equal(pandas.read_csv(tmp_path / "run.csv", float_precision="round_trip")["slider.x_m"].to_numpy(), r["slider.x"])
    with pytest.raises(ValueError, match=r"\.parquet"):
        r.save(tmp_path / "run.xls")
    assert sorted(file.name for file in tmp_path.iterdir()) == ["run.csv", "run.parquet"]


BAD = {
    "unknown key": (lambda: ss.Scenario({**QUICK, "bodys": {}}), "bodys"),
    "wrong unit": (lambda: ss.Scenario(QUICK).set("bodies.slider.mass", "3 s"), "bodies.slider.mass"),
    "not a number": (lambda: ss.Scenario(QUICK).set("bodies.slider.mass", float("nan")), "bodies.slider.mass"),
    "not a number in an array": (
        lambda: ss.Scenario(QUICK).set("waveforms.drive", {"table": {"points": np.array([[0, 0], [1e-3, np.nan]])}}),
        "waveforms.drive",
    ),
    "wrong path": (lambda: ss.Scenario(QUICK).set("contacts.bal.friction", 0.1), "contacts.bal"),
    "out of range": (lambda: ss.Scenario(QUICK).set("contacts.ball.friction", -1), "contacts.ball.friction"),
    "several": (lambda: ss.Scenario({**QUICK, "run": {"cycles": -1}, "title": 3}), "title"),
}


@pytest.mark.parametrize("kind", BAD)
def test_a_scenario_that_is_refused_says_where(kind):
    act, path = BAD[kind]
    with pytest.raises(ss.ScenarioError) as caught:
        act()
    error = caught.value
    assert any(path in report.path for report in error.reports) or path in str(error), str(error)
    assert error.reports[0].message in str(error)


def test_an_error_in_a_file_has_line_and_column(tmp_path):
    file = tmp_path / "drive.json"
    file.write_text('{\n  "stickslip": 1,\n  "bodies": {"a": {"mass": "1 s"}},\n  "run": {"duration": 1}\n}')
    with pytest.raises(ss.ScenarioError) as caught:
        ss.load(file)
    assert (caught.value.line, caught.value.column, caught.value.path) == (3, 28, "bodies.a.mass")
    assert str(file) in str(caught.value)
    with pytest.raises(FileNotFoundError):
        ss.load(tmp_path / "nothing.json")


def test_a_run_that_stops_has_its_result_so_far():
    s = ss.Scenario(QUICK).set("run.limits.steps", 40)
    with pytest.raises(ss.RunError) as caught:
        s.run()
    error = caught.value
    assert error.result is not None and 0 < error.t < 0.03 and error.result["time"][-1] == error.t
    assert "40" in str(error) and error.result.results.status != "done"


def test_commands_of_a_generator():
    def after(**commands):
        sim = ss.examples.commanded().start()
        assert {"drive.stroke", "drive.frequency", "drive.heading", "drive.steps"} <= set(sim.inputs)
        sim.advance(1e-6, **commands)
        state = sim.state()
        sim.advance(50e-3)
        ahead = sim["slider.x"]
        sim.restore(state)
        sim.advance(50e-3)
        assert sim["slider.x"] == ahead
        return ahead

    forward, backward = after(**{"drive.steps": 3}), after(**{"drive.steps": 3, "drive.heading": -1})
    assert backward < 0.0 < forward
    with pytest.raises(ValueError, match="1 or -1"):
        after(**{"drive.heading": 0.5})


def test_bad_input_to_a_held_run():
    sim = ss.examples.controlled().start()
    sim.advance(1e-3, drive=1e-7)
    state = sim.state()
    for act, words in [
        (lambda: sim.advance(-1.0), "at least 0.001 s"),
        (lambda: sim.advance(float("nan")), "at least 0.001 s"),
        (lambda: sim.advance(2e-3, drve=1e-7), "inputs: drive"),
        (lambda: sim.advance(2e-3, drive=1.0), "drive"),
        (lambda: sim.advance(2e-3, drive=float("nan")), "drive"),
        (lambda: sim.advance("2 N"), "unit of a force"),
        (lambda: sim.restore(state[:-1]), "bytes"),
        (lambda: sim.restore(b""), "bytes"),
        (lambda: sim.restore(ss.Scenario(QUICK).start().state()), ""),
    ]:
        with pytest.raises(ValueError, match=words):
            act()
    with pytest.raises(KeyError, match=r"slider\.x"):
        sim["slider.z"]
    # Whatever was refused, the run goes on as if nobody had asked.
    assert sim.state() == state
    sim.advance(2e-3, drive=2e-7)
    # An input that is left out stays where it is.
    sim.advance(3e-3)
    assert sim["foot.x"] == 2e-7
    other = ss.examples.controlled().start()
    other.restore(sim.state())
    sim.advance(4e-3), other.advance(4e-3)
    assert sim.state() == other.state()


TWO = {**QUICK, "waveforms": {name: {"input": {"initial": 0, "range": [-1e-6, 1e-6], "interpolation": "linear"}} for name in ("drive", "other")}}
TWO["bodies"] = {**QUICK["bodies"], "second": {"x": {"follows": "other"}}}
TWO["contacts"] = {**QUICK["contacts"], "beside": {**QUICK["contacts"]["ball"], "between": ["second", "slider"]}}
TWO["run"] = {"duration": "5 ms"}


def test_a_refused_advance_feeds_nothing():
    """The first of two inputs was fed before the second was refused, and nothing could be advanced any more."""
    sim = ss.Scenario(TWO).start()
    sim.advance(1e-3, drive=1e-8, other=0.0)
    state = sim.state()
    with pytest.raises(ValueError, match="other"):
        sim.advance(2e-3, drive=2e-8, other=1.0)
    assert sim.state() == state
    sim.advance(2e-3, drive=2e-8, other=1e-8)
    with pytest.raises(TypeError):
        sim.advance(t=3e-3)


@pytest.mark.skipif(sys.platform == "win32", reason="signals of POSIX")
def test_a_handler_of_a_signal_does_not_wait_for_its_own_run():
    """It waited for ever for the run that it had interrupted."""
    code = """
import signal, stickslip as ss
s = ss.examples.quickstart().set("run.duration", "1e5 s", "output.every", "1 s", "output.events", "off", "plots", "[]")
sim = s.start()
signal.signal(signal.SIGALRM, lambda *_: print(sim.time))
signal.setitimer(signal.ITIMER_REAL, 0.3)
try:
    sim.advance(1e5)
except ss.RunError as error:
    print(error)
"""
    done = subprocess.run([sys.executable, "-W", "ignore", "-c", code], capture_output=True, text=True, timeout=60, check=False)
    assert "busy" in done.stdout, done


def test_what_is_sent_to_other_processes():
    r = ss.Scenario(QUICK).run()
    step = pickle.loads(pickle.dumps(r.results.step))
    assert (step, step.error) == (r.results.step, r.results.step.error)
    error = ss.RunError("stopped")
    error.t, error.result = 1.0, r
    assert pickle.loads(pickle.dumps(error)).t == 1.0
    with pytest.raises(TypeError, match="to_pandas"):
        pickle.dumps(r)
    assert r != ss.Scenario(QUICK).run() and r.scenario.info() == ss.Scenario(QUICK).info()


def test_forged_states_are_refused_or_go_on():
    """One bit changed anywhere: a refusal, or a run that moves on or says why it does not; never a crash."""
    sim = ss.Scenario(QUICK).start()
    sim.advance(1e-3)
    state = sim.state()
    for bit in range(0, 8 * len(state), 37):
        forged = bytearray(state)
        forged[bit // 8] ^= 1 << (bit % 8)
        other = ss.Scenario(QUICK).set("run.limits.steps", 100_000).start()
        try:
            other.restore(bytes(forged))
            other.advance(2e-3)
        except (ValueError, ss.RunError):
            pass


def test_two_threads_on_one_run_wait_for_each_other():
    sim = ss.examples.controlled().start()
    failures = []

    def feed():
        for _ in range(200):
            try:
                sim.advance(sim.time + 1e-5, drive=1e-7)
            except ValueError as error:
                # The other was ahead between both calls.
                failures.append("expected a time" in str(error))

    threads = [threading.Thread(target=feed) for _ in range(2)]
    [thread.start() for thread in threads], [thread.join() for thread in threads]
    assert all(failures) and 2e-3 - 1e-9 <= sim.time <= 4e-3 + 1e-9


def test_the_lock_of_the_interpreter_is_released():
    s = ss.examples.quickstart().set("run.duration", "30 s", "output.every", "1 ms", "output.events", "off", "plots", "[]")
    counted = []
    thread = threading.Thread(target=s.run)
    thread.start()
    while thread.is_alive():
        counted.append(time.perf_counter())
        time.sleep(1e-3)
    assert len(counted) > 10


@pytest.mark.skipif(sys.platform == "win32", reason="signals of POSIX")
@pytest.mark.parametrize(
    "call",
    [
        "s.run()",
        "s.start().advance(1e5)",
        "ss.run_many([s, s])",
        "ss.examples.three_ball_stage().curve('force-speed', points=1000)",
    ],
)
def test_ctrl_c_ends_long_work(call):
    code = f"""
import stickslip as ss, time
s = ss.examples.quickstart().set("run.duration", "1e5 s", "output.every", "1 s", "output.events", "off", "plots", "[]")
print("ready", flush=True)
try:
    {call}
except KeyboardInterrupt:
    print("interrupted", flush=True)
"""
    with subprocess.Popen([sys.executable, "-W", "ignore", "-c", code], stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout.readline() == "ready\n"
        time.sleep(0.5)
        process.send_signal(signal.SIGINT)
        assert process.communicate(timeout=60)[0] == "interrupted\n"


def test_warnings_are_those_of_python():
    with pytest.warns(ss.StickslipWarning, match="friction"):
        ss.Scenario(QUICK).set("contacts.ball.friction", 0).run()


def test_reports_show_themselves():
    r = ss.Scenario(QUICK).run()
    for one in (r, r.results, r.scenario, r.scenario.info(), r.scenario.curve("step-amplitude", points=3).table):
        assert "<table" in one._repr_html_()
    with pytest.raises(AttributeError, match="there are: "):
        r.results.nothing  # noqa: B018
    with pytest.raises(KeyError, match=r"columns: "):
        r["slider.y"]


def test_arrays_of_measured_loops_are_checked():
    with pytest.raises(ValueError, match="equal length"):
        ss.measure([0.0, 1.0], [0.0])
    with pytest.raises(ValueError):
        ss.measure(np.array([0.0, 1.0, np.nan]), np.zeros(3))
    with pytest.raises(ValueError, match="forces"):
        ss.measure([0.0, 1.0])


STAGE = {
    "stickslip": 1,
    "waveforms": {"drive": {"chirp": {"amplitude": 1e-12, "from": "0.2 kHz", "to": "6 kHz", "duration": "20 ms"}}},
    "bodies": {"foot": {"mass": "5 g", "x": "free"}, "stage": {"mass": "100 g", "x": "free"}},
    "contacts": {
        "balls": {
            "between": ["foot", "stage"],
            "materials": ["ruby", "hardened steel"],
            "profile": {"sphere": {"diameter": "4 mm"}},
            "count": 3,
            "friction": 0.5,
            "normal": {"force": "5 N"},
            "damping": "2 us",
        }
    },
    "actuators": {"stack": {"between": ["ground", "foot"], "stiffness": "50 N/um", "damping": "20 N s/m", "stroke": {"follows": "drive"}}},
    "run": {"duration": "20 ms", "stepper": {"event": {"tolerance": 1e-12}}},
    "output": {"every": "1 us"},
}


def simulated(system: ss.LinearSystem, w: np.ndarray, dt: float) -> np.ndarray:
    """Outputs for inputs that are straight between samples, by the exponential of the matrix of states, value and slope."""
    n = len(system.states)
    matrix = np.zeros((n + 2, n + 2))
    matrix[:n, :n], matrix[:n, n], matrix[n, n + 1] = system.A * dt, system.B[:, 0] * dt, 1.0
    values, vectors = np.linalg.eig(matrix[:n, :n])
    # e^M of [[A, b, 0], [0, 0, 1], [0, 0, 0]] by squaring of a Taylor series.
    small, step = matrix / 2**20, np.eye(n + 2)
    term = np.eye(n + 2)
    for k in range(1, 12):
        term = term @ small / k
        step = step + term
    for _ in range(20):
        step = step @ step
    assert np.all(values.real <= 1e-9) and vectors.shape == (n, n)
    z, outputs = np.zeros(n), np.zeros((len(w), len(system.outputs)))
    for k in range(len(w)):
        outputs[k] = system.C @ z + system.D[:, 0] * w[k]
        if k + 1 < len(w):
            z = step[:n, :n] @ z + step[:n, n] * w[k] + step[:n, n + 1] * (w[k + 1] - w[k])
    return outputs


def test_the_linear_model_is_a_small_run():
    """A chirp of 1 pm, far below the first slip, through foot and stage: the run against the matrices, to 1e-4 of the largest response."""
    s = ss.Scenario(STAGE)
    r, system = s.run(), s.linearise()
    assert system.inputs == ["drive_m"] and system.outputs == ["foot.x_m", "stage.x_m", "foot.vx_m_s", "stage.vx_m_s"]
    time = r["time"]
    w = 1e-12 * np.sin(2 * np.pi * (200 * time + 0.5 * (6000 - 200) / 20e-3 * time**2))
    outputs = simulated(system, w, 1e-6)
    for k, name in enumerate(["foot.x", "stage.x", "foot.vx", "stage.vx"]):
        assert np.abs(outputs[:, k] - r[name]).max() < 1e-4 * np.abs(r[name]).max(), name


def test_the_linear_model_has_the_modes_of_info():
    s = ss.Scenario(STAGE)
    frequencies, ratios = s.linearise().modes()
    modes = s.info().modes
    # Damped frequencies of both differ by the coupling of modes through dampers alone.
    assert frequencies == pytest.approx(modes["frequency_Hz"], rel=2e-3)
    assert ratios == pytest.approx(modes["damping_ratio"], rel=0.05)
    response = s.linearise().frequency_response([1e-3, *frequencies])
    # Far below resonance stack, foot and stage move as one; at it the stage moves more.
    assert abs(response[0, 1, 0] - 1) < 1e-6 and abs(response[1, 1, 0]) > 3
    with pytest.raises(ValueError, match="start, least or most"):
        s.linearise("now")


def test_the_types_are_those_of_the_schema():
    import importlib.util
    from pathlib import Path

    here = Path(__file__).parents[1]
    spec = importlib.util.spec_from_file_location("make_types", here / "tools/make_types.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    assert (here / "python/stickslip/types.py").read_text(encoding="utf-8") == module.main(), "run tools/make_types.py"


def test_intervals_and_fits_of_a_measured_loop():
    """A ball at constant load (Cattaneo 1938, Mindlin 1949): friction and radius of the drawn loop lie in their intervals."""
    load, friction, radius, young, poisson = 10.0, 0.6, 5e-3, 210e9, 0.3
    plane, shear = young / 2 / (1 - poisson**2), young / (1 + poisson) / (2 - poisson)
    gross = friction * plane / shear * (0.75 * load / plane / radius**0.5) ** (2 / 3)
    top = 0.7 * gross
    virgin = lambda u: friction * load * (1 - (1 - u / gross) ** 1.5)
    way = 2 * top * np.arange(100) / 100
    branch = virgin(top) - 2 * virgin(way / 2)
    u, force = np.concatenate([top - way, way - top]), np.concatenate([branch, -branch])
    force = force + np.random.default_rng(1).normal(0, 0.01 * friction * load, force.size)
    paths = ["contacts.ball.friction", "contacts.ball.profile.paraboloid.radius"]
    s = ss.Scenario(
        {
            "stickslip": 1,
            "bodies": {"rig": {"x": {"follows": {"sine": {"amplitude": "0.2 um", "period": "1 s"}}}}},
            "contacts": {
                "ball": {
                    "between": ["rig", "ground"], "materials": ["hardened steel", "hardened steel"],
                    "profile": {"paraboloid": {"radius": "4 mm"}}, "friction": 0.5, "normal": {"force": "10 N"},
                }
            },
            "run": {"cycles": 2},
        }
    )  # fmt: skip
    found = ss.fit(s, (u, force), paths)
    for path, exact in zip(paths, (friction, radius), strict=True):
        value = found["parameters"][path]
        assert value["low"] <= exact <= value["high"]
    with pytest.raises(ValueError, match="cannot distinguish contacts.ball.friction and contacts.ball.normal.force"):
        ss.fit(s, (u, force), [*paths[:1], "contacts.ball.normal.force"])
    with pytest.raises(ValueError, match="arrays need none"):
        ss.measure(u, force, recipe={})
    cycles = ss.measure(np.tile(u, 4), np.tile(force, 4), time=np.arange(800.0))
    results = cycles.report["results"]
    assert results["force_amplitude_N"]["low"] <= virgin(top) <= results["force_amplitude_N"]["high"]
    with pytest.raises(ValueError, match="to correct"):
        ss.measure(u, force, correct="noise")
