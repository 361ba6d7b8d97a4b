"""Studies against the program, and their parts against other readers of Parquet."""

import hashlib
import os
import subprocess
from pathlib import Path

import numpy as np
import pytest
import stickslip as ss

pd = pytest.importorskip("pandas")
pq = pytest.importorskip("pyarrow.parquet")

PROGRAM = os.environ.get("STICKSLIP", "stickslip")


@pytest.fixture
def quick():
    s = ss.examples.p1().set("run.stepper.event.tolerance", 1e-6, "run.cycles", 5)
    return ss.study(
        s,
        {"bodies.slider.mass": ss.values("20 g", "-1 g")},
        friction=ss.normal(0.15, 0.01),
        n=50,
        chunk=30,
        results=["slider.x_m", "steps.settling.state", "ball.state"],
    )


def digest(folder):
    files = sorted(Path(folder).iterdir())
    return [(file.name, hashlib.sha256(file.read_bytes()).hexdigest()) for file in files]


def test_the_program_computes_the_same_parts(quick, tmp_path):
    quick.run(tmp_path / "python", threads=2)
    file = tmp_path / "study.json"
    file.write_text(quick._core.portable())
    run = subprocess.run([PROGRAM, "study", "run", file, "--out", tmp_path / "program", "-q", "--threads", "1"], check=False)
    assert run.returncode == 0
    assert digest(tmp_path / "python") == digest(tmp_path / "program")
    loaded = ss.Study.load(file).run(tmp_path / "shards", shard=(2, 2))
    assert loaded.status() == (2, [0, 2])
    for part in (0, 2):
        loaded._core.run(tmp_path / "shards", part, loaded.parts, 1)
    assert digest(tmp_path / "shards") == digest(tmp_path / "program")


def test_a_frame_is_what_pyarrow_reads(quick, tmp_path):
    own = quick.run(tmp_path).frame()
    table = pq.read_table(tmp_path)
    other = table.to_pandas()
    assert list(own.columns) == list(other.columns)
    words = pq.read_metadata(tmp_path / "part-000000.parquet").metadata[b"stickslip.codes.ball.state"]
    assert words == b'["open","stick","partial","slip"]'
    for name in own.columns:
        if own[name].dtype == "category":
            codes = own[name].cat.codes.where(own[name].notna())
            np.testing.assert_array_equal(codes.to_numpy(float), other[name].to_numpy(float))
        else:
            pd.testing.assert_series_equal(own[name], other[name], check_dtype=False, check_exact=True)
    failed = own["bodies.slider.mass"] < 0
    assert (own["error"].notna() == failed).all() and own["slider.x_m"].isna().equals(failed)
    assert own["steps.settling.state"].cat.categories.tolist()[0] == "settled"
    # A case by itself.
    case = own[~failed].iloc[7]
    base = ss.examples.p1().set("run.stepper.event.tolerance", 1e-6, "run.cycles", 5)
    alone = base.set(quick.overrides(int(case["case"]))).run()
    assert alone["slider.x"][-1] == case["slider.x_m"]


def test_errors_are_those_of_the_package(tmp_path):
    p1 = ss.examples.p1()
    with pytest.raises(ss.ScenarioError, match="did you mean"):
        ss.study(p1, {"contacts.bal.friction": ss.uniform(0.1, 0.2)}, n=3)
    with pytest.raises(ValueError, match="no such number"):
        ss.study(p1, radiuss=ss.uniform(0.1, 0.2), n=3)
    with pytest.raises(ValueError, match="lower and an upper"):
        ss.normal(1, 2, 0)
    a = ss.study(p1.set("run.cycles", 2), friction=ss.uniform(0.1, 0.2), n=3).run(tmp_path)
    assert a.results == ["slider.x_m", "steps.last_m", "energy.friction_J"]
    with pytest.raises(ValueError, match="has parts of another study"):
        ss.study(p1.set("run.cycles", 3), friction=ss.uniform(0.1, 0.2), n=3).run(tmp_path)
    with pytest.raises(ValueError, match="parts are missing"):
        ss.study(p1.set("run.cycles", 2), friction=ss.uniform(0.1, 0.2), n=3).run(tmp_path / "b", shard=(2, 2)).frame()
    (tmp_path / "file").write_text("")
    with pytest.raises(OSError):
        a.run(tmp_path / "file")
