"""Commands of the program that it leaves to this package: arguments in, text out."""

from __future__ import annotations

import io
import json
import re
import sys
import textwrap
import warnings
from collections.abc import Callable, Sequence
from typing import Any, TextIO

from ._extras import extra
from .errors import AnalysisError, ArgumentError, InputError
from .plot.chart import Chart

_WIDTH = 80


def answered(run: Callable[[dict[str, Any]], str]) -> int:
    """Runs a command with the arguments, as JSON on the standard input, and prints its text, or what
    has gone wrong; the exit code is 0 if nothing has."""
    warnings.showwarning = _warned
    try:
        text = run(json.load(sys.stdin))
    except (AnalysisError, InputError, ImportError) as error:
        _write(f"{error}\n")
        return 1
    except OSError as error:
        # The library's own errors name the file in their text.
        said = error.strerror or error
        _write(f"cannot read or write {error.filename}: {said}\n" if error.filename else f"{said}\n")
        return 1
    except KeyboardInterrupt:
        # The user who stopped it needs no message.
        return 130
    _write(text)
    return 0


def in_options(error: ArgumentError, options: Sequence[str]) -> str:
    """The message of an argument with the option of the command line in its place."""
    named = "|".join(options)

    def option(name: str) -> str:
        return "--" + name.replace("to_hz", "to_frequency").removesuffix("_hz").replace("_", "-")

    text = re.sub(rf"^({named})(?= must)", lambda of: option(of[1]), str(error))
    text = re.sub(r"between\(([\d.]+), ([\d.]+)\)", r"--between \1..\2", text)
    text = text.replace("between()", "--between")
    text = text.replace("rpm=(from, to)", "rpm=FROM..TO").replace("as speed or tacho", "as --speed or --tacho")
    return re.sub(rf"\b({named})=", lambda of: option(of[1]) + " ", text)


def wrapped(text: str, indent: str, first: str = "") -> list[str]:
    """Lines that fit a terminal; words are kept."""
    return textwrap.wrap(
        text, _WIDTH, initial_indent=first, subsequent_indent=indent,
        break_long_words=False, break_on_hyphens=False,
    )  # fmt: skip


def png(chart: Chart) -> bytes:
    """A figure as PNG."""
    with extra("plot"):
        import matplotlib
        from matplotlib import pyplot
    matplotlib.use("agg")
    content = io.BytesIO()
    figure: Any = chart.plot_matplotlib().figure
    figure.savefig(content, dpi=150, format="png")
    pyplot.close("all")
    return content.getvalue()


def _warned(
    message: Warning | str, category: type[Warning], filename: str, lineno: int,
    file: TextIO | None = None, line: str | None = None,
) -> None:  # fmt: skip
    print(f"warning: {message}", file=sys.stderr)


def _write(text: str) -> None:
    # The program that reads it expects UTF-8.
    sys.stdout.buffer.write(text.encode("utf-8", "replace"))
    sys.stdout.buffer.flush()
