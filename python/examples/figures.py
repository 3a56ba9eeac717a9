"""A Campbell diagram by plotly and by matplotlib, and a mode in motion, into a folder."""

from __future__ import annotations

import sys
from pathlib import Path

import matplotlib.pyplot as plt

import sawflutter as sf


def main(folder: Path) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    saw = sf.Scene.paper().with_accuracy("draft")
    r = saw.run_campbell()
    r.plot().write_html(folder / "campbell.html", include_plotlyjs="directory")
    r.plot_matplotlib()
    plt.savefig(folder / "campbell-matplotlib.png")
    mode = saw.modes(rpm=1800)[0]
    saw.animate(mode).write_html(folder / "mode.html", include_plotlyjs="directory")
    print(f"{mode.name}, {mode.direction}, at {mode.frequency_hz:.2f} Hz: see {folder}")


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "sawflutter-out"))
