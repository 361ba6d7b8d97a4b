"""Linear models."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np


class LinearSystem:
    """ż = A z + B w, y = C z + D w: small motions of a scenario with all contacts stuck.

    Outputs y are displacements and velocities of the free coordinates, inputs w the waveforms. With M ẍ + C₀ ẋ + K x = P w + Q ẇ the states
    are z = (x, ẋ - M⁻¹Q w), so that no derivative of an input is needed. All in SI units, which end the names.
    """

    def __init__(self, data: dict[str, Any]):
        self.states: list[str] = data["states"]
        self.inputs: list[str] = data["inputs"]
        self.outputs: list[str] = data["outputs"]
        shapes = {"a": (self.states, self.states), "b": (self.states, self.inputs), "c": (self.outputs, self.states), "d": (self.outputs, self.inputs)}
        self.A, self.B, self.C, self.D = (
            np.array(data[key], dtype=float).reshape(len(rows), len(columns)) for key, (rows, columns) in shapes.items()
        )

    def frequency_response(self, frequencies: Sequence[float] | np.ndarray) -> np.ndarray:
        """Complex response C (2πif - A)⁻¹ B + D at frequencies (Hz): an array by frequency, output and input."""
        s = 2j * np.pi * np.atleast_1d(np.asarray(frequencies, dtype=float))
        identity = np.eye(len(self.states))
        return self.C @ np.linalg.solve(s[:, None, None] * identity - self.A, np.broadcast_to(self.B, (len(s), *self.B.shape))) + self.D

    def modes(self) -> tuple[np.ndarray, np.ndarray]:
        """Natural frequencies |λ|/2π (Hz) and damping ratios -Re λ/|λ| of the oscillating modes, by rising frequency."""
        rates = np.linalg.eigvals(self.A)
        rates = rates[rates.imag > 0]
        rates = rates[np.argsort(np.abs(rates))]
        return np.abs(rates) / (2 * np.pi), -rates.real / np.abs(rates) + 0.0

    def __repr__(self) -> str:
        return f"<LinearSystem from {', '.join(self.inputs)} to {', '.join(self.outputs)}>"
