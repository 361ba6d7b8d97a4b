"""The package against the program, to the bit: every example, its columns, events, summary, states and studies."""

import csv
import json
import subprocess
import sys
import warnings

import numpy as np
import pytest

import stickslip as ss

EXAMPLES = ss.examples.names()
FILE = ss.examples._FOLDER

pytestmark = pytest.mark.filterwarnings("ignore::stickslip.StickslipWarning")


def read(file):
    with open(file, newline="", encoding="utf-8") as lines:
        return list(csv.DictReader(lines))


@pytest.mark.parametrize("name", EXAMPLES)
def test_a_run_is_that_of_the_program(name, program, tmp_path):
    command = [program, "run", "-q", str(FILE / f"{name}.json"), "--out", str(tmp_path), "--set", "plots=[]"]
    subprocess.run(command, check=True, capture_output=True)
    result = ss.load(FILE / f"{name}.json").set("plots", "[]").run()
    folder = tmp_path / name
    rows = read(folder / "trace.csv")
    assert list(rows[0]) == [result._loaded[column].full for column in result]
    for column in result:
        full = result._loaded[column].full
        values = result[column]
        if values.dtype.kind == "f":
            # Shortest decimals come back to the same number.
            expected = np.array([float(row[full]) for row in rows])
            assert np.array_equal(values.view(np.uint64), expected.view(np.uint64)), full
        else:
            assert list(values) == [row[full] for row in rows], full
        assert result[full] is result[column]
    events = [(float(row["time_s"]), row["source"], row["kind"]) for row in read(folder / "events.csv")]
    assert [tuple(event) for event in result.events] == events
    expected = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    for own in ("timing", "files", "tables"):
        expected.pop(own, None)
        result.summary.pop(own, None)
    assert result.summary == expected


CONTINUE = """
import sys, stickslip as ss, numpy as np
s, t = ss.load(sys.argv[1]), float(sys.argv[3])
sim = s.start()
sim.restore(open(sys.argv[2], "rb").read())
sim.advance(t)
sys.stdout.buffer.write(sim.row().tobytes())
"""


@pytest.mark.parametrize("name", EXAMPLES)
def test_a_state_continues_in_another_process(name, tmp_path):
    file = FILE / f"{name}.json"
    scenario = ss.load(file)
    end = float(scenario.run()["time"][-1])
    sim = scenario.start()
    sim.advance(0.37 * end)
    state = sim.state()
    (tmp_path / "state").write_bytes(state)
    copy = sim.copy()
    sim.advance(0.9 * end)
    command = [sys.executable, "-W", "ignore", "-c", CONTINUE, str(file), str(tmp_path / "state"), repr(0.9 * end)]
    row = subprocess.run(command, check=True, capture_output=True).stdout
    assert row == sim.row().tobytes()
    copy.advance(0.9 * end)
    assert copy.row().tobytes() == row


def test_many_runs_are_the_runs_one_by_one():
    s = ss.examples.quickstart()
    variants = [s.set("contacts.ball.friction", friction) for friction in (0.1, 0.2, 0.3)]
    for threads in (1, 2):
        for one, many in zip([v.run() for v in variants], ss.run_many(variants, threads=threads), strict=True):
            assert all(np.array_equal(one[name], many[name]) for name in one)
            assert one.events == many.events
            assert {**one.summary, "timing": None} == {**many.summary, "timing": None}


def test_studies_are_those_of_the_program(answer, tmp_path):
    file = str(FILE / "quickstart.json")
    s = ss.load(file)
    assert s.info().data == answer("info", file, "--json")
    steady = answer("steady", file, "--json", "-q")
    own = s.steady().data
    assert {key: own[key] for key in ("step_m", "speed_m_s", "multipliers")} == {key: steady[key] for key in ("step_m", "speed_m_s", "multipliers")}
    curve = answer("curve", file, "--curve", "force-speed", "--points", "5", "--json", "-q")
    assert s.curve("force-speed", points=5).data == {key: value for key, value in curve.items()}
    vary = answer("curve", file, "--vary", "contacts.ball.friction=0.1..0.3", "--points", "3", "--json", "-q")
    assert s.curve(vary="contacts.ball.friction", range=(0.1, 0.3), points=3).data == vary
    held = answer("curve", file, "--curve", "holding-force", "--points", "3", "--json", "-q")
    assert s.curve("holding-force", points=3).data == held
    to = ["contacts.ball.friction", "bodies.slider.mass"]
    asked = answer("sensitivity", file, "--to", to[0], "--to", to[1], "--json", "-q")
    assert s.sensitivity(to=to).data == asked
    contact = answer("contact", file, "--force", "1 N", "--tangential", "0.1 N", "--json")
    found = s.contact(force="1 N", tangential_force="0.1 N")
    assert found.data["constants"] == contact["constants"] and found.data["loading"] == contact["loading"] and found.fields["corner"].size
    command = ["contact", file, "--force", "1 N", "--history", "30 nm, -30 nm, 30 nm", "--out", str(tmp_path / "c"), "-q"]
    program = answer.__closure__
    assert program is not None
    subprocess.run([answer_program(answer), *command], check=True)
    walk = s.contact(force="1 N", history=[30e-9, -30e-9, 30e-9])
    for table in ("history", "fields", "line", "friction"):
        rows = read(tmp_path / "c" / f"{table}.csv")
        for column in walk[table].columns:
            texts = [row[column] for row in rows]
            values = walk[table][column]
            same = [value == (np.nan if text == "" else float(text)) for value, text in zip(values, texts, strict=True)] if values.dtype.kind == "f" else [str(value) == text for value, text in zip(values, texts, strict=True)]
            assert all(same), (table, column)


def answer_program(answer) -> str:
    """The program that a fixture runs."""
    cells = dict(zip(answer.__code__.co_freevars, answer.__closure__, strict=True))
    return cells["program"].cell_contents


def test_measured_loops_are_those_of_the_program(program, tmp_path):
    r = ss.examples.fretting_force().run()
    contact = next(name.rsplit(".", 1)[0] for name in r if name.endswith(".fx"))
    u, force = r[f"{contact}.u"], r[f"{contact}.fx"]
    table = "t_s,u_m,f_N\n" + "\n".join(f"{t!r},{x!r},{f!r}" for t, x, f in zip(r["time"].tolist(), u.tolist(), force.tolist(), strict=True))
    (tmp_path / "loops.csv").write_text(table)
    command = [program, "measure", "loops.csv", "--out", "out", "-q", "--displacement", "u", "--force", "f"]
    subprocess.run(command, cwd=tmp_path, check=True, capture_output=True)
    expected = (tmp_path / "out" / "cycles.csv").read_text()
    columns = list(csv.DictReader(expected.splitlines()))
    from_arrays, from_file = ss.measure(u, force, time=r["time"]), ss.measure(tmp_path / "loops.csv", "f")
    for found in (from_arrays, from_file):
        assert found.columns == list(columns[0])
        for name in found.columns:
            assert [str(value) for value in found[name]] == [str(float(row[name])) if row[name] else "nan" for row in columns], name


def test_results_on_disk_are_compared(program, tmp_path):
    file = str(FILE / "p1.json")
    for out, friction in (("a", "0.15"), ("b", "0.16")):
        command = [program, "run", "-q", file, "--out", str(tmp_path / out), "--set", f"contacts.ball.friction={friction}", "--set", "plots=[]"]
        subprocess.run(command, check=True, capture_output=True)
    assert ss.compare(tmp_path / "a/p1", tmp_path / "a/p1")["verdict"] == "identical"
    assert ss.compare(tmp_path / "a/p1", tmp_path / "b/p1")["verdict"] == "differs"


def test_pictures_are_those_of_the_program(program, tmp_path):
    command = [program, "run", "-q", str(FILE / "quickstart.json"), "--out", str(tmp_path)]
    subprocess.run(command, check=True, capture_output=True)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        result = ss.examples.quickstart().run()
    for plot in ("loop", "trajectory"):
        assert result.png(plot) == (tmp_path / "quickstart" / f"{plot}.png").read_bytes()
    # One that the scenario does not name.
    assert result.png("energy", theme="dark")[1:4] == b"PNG" and "<svg" in result.svg("phase")
