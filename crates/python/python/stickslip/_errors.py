"""Exceptions and the warning of the package."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from ._result import Result


class ErrorReport(NamedTuple):
    """One error of a scenario: key path, line and column in the text (from 1), message, help."""

    path: str
    line: int | None
    column: int | None
    message: str
    help: str | None


class ScenarioError(ValueError):
    """A scenario that is refused; the message is that of ``stickslip check``.

    ``path``, ``line``, ``column`` and ``help`` are those of the first of ``reports``, which are all errors that were found.
    Line and column are None where an override or the scenario as a whole is to blame.

    >>> import stickslip as ss
    >>> try:
    ...     ss.examples.quickstart().set("contacts.ball.friction", -1)
    ... except ss.ScenarioError as error:
    ...     print(error.path)
    contacts.ball.friction
    """

    path: str = ""
    line: int | None = None
    column: int | None = None
    help: str | None = None
    reports: tuple[ErrorReport, ...] = ()

    def _set(self, reports: list[tuple[str, int | None, int | None, str, str | None]]) -> None:
        self.reports = tuple(ErrorReport(*one) for one in reports)
        self.path, self.line, self.column, _, self.help = self.reports[0]


class RunError(RuntimeError):
    """A run that stopped early: ``t`` is the time reached, s, and ``result`` the result so far (None for a held run)."""

    t: float | None = None
    result: Result | None = None
    results: list[Result] | None = None

    def __reduce__(self):
        # A result stays in its process.
        return _run_error, (str(self), self.t)


def _run_error(text: str, t: float | None) -> RunError:
    error = RunError(text)
    error.t = t
    return error


class StickslipWarning(UserWarning):
    """An implausible scenario; the message begins with the kind of the warning."""
