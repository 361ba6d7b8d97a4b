"""What the tests share: the program to compare with, and the warnings of examples, which are not at issue here."""

import json
import os
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]


@pytest.fixture(scope="session")
def program() -> str:
    """The program: STICKSLIP, or the one of this checkout."""
    found = os.environ.get("STICKSLIP")
    if found is None:
        subprocess.run(["cargo", "build", "--release"], cwd=ROOT, check=True)
        target = os.environ.get("CARGO_TARGET_DIR", str(ROOT / "target"))
        found = f"{target}/release/stickslip"
    return found


@pytest.fixture
def answer(program, tmp_path):
    """Runs the program in an empty folder; its JSON."""

    def run(*arguments: str) -> dict:
        done = subprocess.run([program, *arguments], cwd=tmp_path, capture_output=True, text=True, check=False)
        assert done.returncode in (0, 1), done.stderr
        return json.loads(done.stdout)

    return run
