"""How thin may the blade be, if it is to run at 1250 rpm?"""

from __future__ import annotations

import numpy as np

import sawflutter as sf


def main() -> None:
    saw = sf.Scene.paper().with_accuracy("draft")
    for thickness_m in np.arange(2.2e-3, 3.01e-3, 0.2e-3):
        checked = saw.replace({"blade.thickness_m": thickness_m}).check(operating_rpm=1250)
        lowest = checked.critical_speeds_rpm[0]
        word = "keeps" if checked.passed else "breaks"
        print(f"{1e3 * thickness_m:.1f} mm: lowest critical {lowest:.0f} rpm, {word} its limits")


if __name__ == "__main__":
    main()
