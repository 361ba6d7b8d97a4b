"""Reports of the program as objects: attributes for keys, arrays for tables."""

from __future__ import annotations

import csv
import html
import io
import json
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np


def si(value: Any, unit: str) -> float:
    """A quantity in its SI unit: a number, a text such as "1 ms", or an object with ``to_base_units`` (pint)."""
    from . import _core

    if isinstance(value, str):
        return _core.quantity(value, unit)
    if hasattr(value, "to_base_units"):
        value = (value.to(unit) if unit else value.to_base_units()).magnitude
    return float(value)


def _array(values: list[Any]) -> np.ndarray:
    if all(value is None or (isinstance(value, (int, float)) and not isinstance(value, bool)) for value in values):
        return np.array([np.nan if value is None else value for value in values], dtype=float)
    if all(isinstance(value, (str, bool)) for value in values):
        return np.array(values)
    return np.array([wrap(value) for value in values] + [None], dtype=object)[:-1]


class Table(Sequence[Mapping[str, Any]]):
    """Rows with the same keys. ``table["speed_m_s"]`` and ``table.speed_m_s`` are arrays; ``table[3]`` is a row."""

    report: Any = None
    """What is told beside the rows, where anything is."""

    def __init__(self, rows: list[dict[str, Any]]):
        self._rows = rows
        self._columns: dict[str, np.ndarray] = {}

    @classmethod
    def from_csv(cls, text: str) -> Table:
        """A table from CSV text; an empty field is None."""

        def value(field: str) -> Any:
            try:
                return float(field) if field else None
            except ValueError:
                return field

        rows = csv.DictReader(io.StringIO(text))
        return cls([{key: value(field) for key, field in row.items()} for row in rows])

    @property
    def columns(self) -> list[str]:
        """Names of the columns."""
        return list(dict.fromkeys(key for row in self._rows for key in row))

    def __getitem__(self, key: Any) -> Any:
        if not isinstance(key, str):
            return wrap(self._rows[key])
        if key not in self._columns:
            if key not in self.columns:
                raise KeyError(f"{key!r}; columns: {', '.join(self.columns)}")
            self._columns[key] = _array([row.get(key) for row in self._rows])
        return self._columns[key]

    def __getattr__(self, key: str) -> np.ndarray:
        try:
            return self[key]
        except KeyError as error:
            raise AttributeError(*error.args) from None

    def __reduce__(self):
        return Table, (self._rows,)

    def __len__(self) -> int:
        return len(self._rows)

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self.columns]

    def to_pandas(self):
        """A pandas.DataFrame."""
        import pandas

        return pandas.DataFrame({name: self[name] for name in self.columns})

    def __repr__(self) -> str:
        shown = self._rows if len(self) <= 12 else [*self._rows[:6], None, *self._rows[-6:]]
        cells = [self.columns, *([_plain(row.get(k)) for k in self.columns] if row else ["…"] * len(self.columns) for row in shown)]
        widths = [max(len(row[k]) for row in cells) for k in range(len(self.columns))]
        lines = ("  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip() for row in cells)
        return "\n".join([*lines, f"[{len(self)} rows]"])

    def _repr_html_(self) -> str:
        head = "".join(f"<th>{html.escape(name)}</th>" for name in self.columns)
        shown = self._rows if len(self) <= 20 else self._rows[:10] + self._rows[-10:]
        rows = "".join("<tr>" + "".join(f"<td>{_cell(row.get(k))}</td>" for k in self.columns) + "</tr>" for row in shown)
        return f"<table><tr>{head}</tr>{rows}</table><p>{len(self)} rows</p>"


class Report(Mapping[str, Any]):
    """A report of the program: ``report.steps.steady.step_m`` is ``report["steps"]["steady"]["step_m"]``.

    Lists of numbers are arrays, lists of objects are tables. ``report.data`` is the plain dict.
    """

    def __init__(self, data: dict[str, Any]):
        self.data = data

    @classmethod
    def from_json(cls, text: str):
        """A report from JSON text."""
        return cls(json.loads(text))

    def __getitem__(self, key: str) -> Any:
        return wrap(self.data[key])

    def __iter__(self) -> Iterator[str]:
        return iter(self.data)

    def __len__(self) -> int:
        return len(self.data)

    def __getattr__(self, key: str) -> Any:
        if key in self.__dict__.get("data", {}):
            return self[key]
        own = [name for name in vars(type(self)) if not name.startswith("_")]
        known = ", ".join([*own, *self.__dict__.get("data", {})])
        raise AttributeError(f"no {key!r} here; there are: {known}")

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self.data]

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Report) and self.data == other.data

    __hash__ = object.__hash__

    def __repr__(self) -> str:
        return "\n".join(f"{key}: {_plain(value)}" for key, value in self.data.items())

    def _repr_html_(self) -> str:
        return _html(self.data)


def wrap(value: Any) -> Any:
    """A value of a report as an object: dicts as reports, lists as arrays or tables."""
    if isinstance(value, dict):
        return Report(value)
    if isinstance(value, list):
        if value and all(isinstance(one, dict) for one in value):
            return Table(value)
        return _array(value) if value and not isinstance(value[0], (dict, list)) else value
    return value


def _plain(value: Any) -> str:
    if isinstance(value, float):
        return f"{value:.6g}"
    if isinstance(value, (dict, list)):
        value = json.dumps(value, ensure_ascii=False)
        value = value if len(value) < 80 else value[:77] + "…"
    return "" if value is None else str(value)


def _cell(value: Any) -> str:
    return html.escape(_plain(value))


def _html(data: dict[str, Any]) -> str:
    def row(key: str, value: Any) -> str:
        if isinstance(value, dict):
            inner = _html(value)
        elif isinstance(value, list) and value and all(isinstance(one, dict) for one in value):
            inner = Table(value)._repr_html_()
        else:
            inner = _cell(value)
        return f"<tr><th style='text-align:left'>{html.escape(key)}</th><td style='text-align:left'>{inner}</td></tr>"

    return "<table>" + "".join(row(key, value) for key, value in data.items()) + "</table>"
