"""How thin may the blade be if it is to run at 1250 rpm?"""

from __future__ import annotations

import numpy as np

import sawflutter as sf


def main() -> None:
    saw = sf.Scene.paper().with_accuracy("draft")
    for thickness_m in np.arange(2.4e-3, 3.01e-3, 0.2e-3):
        thin = saw.replace({"blade.thickness_m": thickness_m})
        lowest = thin.run_campbell().critical_rpm[0]
        passed = thin.check(operating_rpm=1250).passed
        print(
            f"{1e3 * thickness_m:.1f} mm: first critical speed {lowest:.0f} rpm, "
            f"may be run at {0.85 * lowest:.0f} rpm, {'passes' if passed else 'fails'} at 1250 rpm"
        )


if __name__ == "__main__":
    main()
