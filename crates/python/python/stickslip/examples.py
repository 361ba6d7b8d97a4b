"""The examples of the project, one phenomenon each: ``examples.quickstart()`` returns a Scenario, ``examples.names()`` lists them."""

from __future__ import annotations

import json
from pathlib import Path

from ._scenario import Scenario, load

_FOLDER = Path(__file__).parent / "scenarios"


def names() -> list[str]:
    """Names of all examples.

    >>> "quickstart" in names()
    True
    """
    return sorted(file.stem for file in _FOLDER.glob("*.json"))


def __getattr__(name: str):
    file = _FOLDER / f"{name}.json"
    if name.startswith("_") or not file.is_file():
        raise AttributeError(f"no example {name!r}; there are: {', '.join(names())}")

    def example() -> Scenario:
        return load(file)

    example.__name__, example.__doc__ = name, f"The example {name}: {json.loads(file.read_text(encoding='utf-8'))['title']}."
    return example


def __dir__() -> list[str]:
    return ["names", *names()]
