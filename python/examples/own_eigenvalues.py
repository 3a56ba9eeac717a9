"""Eigenvalues computed from the matrices of the saw, beside those of the package."""

from __future__ import annotations

import numpy as np

import sawflutter as sf


def main() -> None:
    saw = sf.Scene.paper().with_accuracy("draft")
    matrices = saw.matrices()
    for rpm in (0.0, 1000.0, 2000.0):
        eigenvalues = np.linalg.eigvals(matrices.companion(rpm))
        oscillating = np.sort(eigenvalues.imag[eigenvalues.imag > 1e-3]) / (2.0 * np.pi)
        own = ", ".join(f"{hz:.3f}" for hz in oscillating[:4])
        package = ", ".join(f"{mode.frequency_hz:.3f}" for mode in saw.modes(rpm)[:4])
        print(f"{rpm:.0f} rpm: NumPy {own} Hz; sawflutter {package} Hz")


if __name__ == "__main__":
    main()
