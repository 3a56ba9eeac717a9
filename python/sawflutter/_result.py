"""Methods of all results."""

from __future__ import annotations

import base64
import json
import os

from collections.abc import Callable
from functools import partial
from operator import attrgetter
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar, TypeVar

from . import _native
from ._drawn import Drawn
from ._entry import Entry
from ._extras import entries
from ._saving import Contents, csv, write
from .errors import InputError, refused
from .plot.chart import Chart
from .plot.described import read

if TYPE_CHECKING:
    import pandas as pd

    from .scene import Scene

R = TypeVar("R", bound="Result")

# Facts of a chart for which the report has no data.
_MISSING = {
    "root-loci": "no two modes meet within the sweep",
    "sensitivity": "the sensitivities were not asked for",
}


class Report(Drawn):
    """Base of all reports. It keeps the JSON of the program unchanged: :meth:`save` writes the
    same bytes as the program.
    """

    # Name of the attribute of which a table has a row each.
    _rows_of: ClassVar[str] = ""
    _text: str

    def to_json(self) -> str:
        """The report as JSON, as written by the program."""
        return self._text

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes a file by the ending of its name: .json the report, the same bytes as the program, which
        :func:`sawflutter.load` reads; .csv the table of :meth:`to_dataframe`; .html one self-contained page
        with verdict, inputs, tables, figures, warnings and certificate; .svg or .png the figure of this
        name, of ``figure_names``, or the first one.

        Raises
        ------
        ArgumentError
            The name has another ending, or the report has no such page or figure; no file is written.
        """
        write(path, self._contents(Path(path).name))

    def _contents(self, name: str) -> Contents:
        """Functions that make the content of a file of this name, by its ending."""
        return {".json": self._text.encode, ".csv": lambda: csv(self.to_dataframe())}

    def to_dataframe(self) -> pd.DataFrame:
        """The results as a table, which needs pandas. It has one row for each limit of a check,
        number of a fit or a place, setting of a tradeoff, saw of a comparison or a map, speed of a
        cut (without histories and maps), or mode of a washboard. A run-up has a row for each sample (``rpm``, ``deflection_m``);
        a response for each speed, with a column for the amplitude at the probe in m of each line; a
        slow sweep for each stable equilibrium, without its frequencies; guides with a gap for each
        ``gap_factor`` and ``force_n``, with the deflections at the cut.
        """
        return entries(attrgetter(self._rows_of)(self))

    def __eq__(self, other: object) -> bool:
        return isinstance(other, type(self)) and self._text == other._text

    def __hash__(self) -> int:
        return hash(self._text)


class Result(Report, Entry):
    """Base of all results of a saw."""

    figure_names: ClassVar[tuple[str, ...]] = ()
    """Names of the program's own figures of this result, see :meth:`figure`."""

    # The command of the program that reports it, and the name of its steps for the progress bar.
    _command: ClassVar[str] = ""
    _steps: ClassVar[str] = "speeds"
    _scene: dict[str, Any]

    def __init_subclass__(cls) -> None:
        super().__init_subclass__()
        # The attributes are those of the report, its last base.
        _, heading, fields = (cls.__bases__[-1].__doc__ or "").partition("Attributes\n")
        cls.__doc__ = f"{(cls.__doc__ or '').rstrip()}\n\n    {heading}{fields}"
        cls.figure_names = tuple(_native.figure_names(cls._command))

    @classmethod
    def _from_json(cls: type[R], text: str) -> R:
        """Reads a result from JSON, as returned by :meth:`to_json`."""
        data = json.loads(text)
        try:
            result = cls._from_dict(data)
        except TypeError as error:
            version = data.get("sawflutter") if isinstance(data, dict) else None
            written = f"one of sawflutter {version}" if version else "something else"
            raise InputError(
                f"this is no report of {cls._command!r} that this version reads, but {written} "
                f"({error}); sawflutter.load reads a report of any kind"
            ) from error
        vars(result).update(_text=text, _scene=data["scene"])
        result._read()
        return result

    def _read(self) -> None:
        """Completes a result after all of it was read."""

    def _warnings(self) -> tuple[str, ...]:
        """Warnings of implausible numbers, and of a result outside the validity of the model."""
        return (*getattr(self, "unusual_numbers", ()), *getattr(self, "warnings", ()))

    def to_dict(self) -> dict[str, Any]:
        """The report as a dict with all keys of the JSON."""
        data: dict[str, Any] = json.loads(self._text)
        return data

    @property
    def saw(self) -> Scene:
        """The scene of the computation; for a fit or a placement, the resulting scene."""
        from .scene import Scene

        return Scene(self._scene)

    def summary(self, *, details: bool = False) -> str:
        """The report as text, as printed by the program, with ``details`` as by --details:
        certificates, backward errors and the basis."""
        return _native.summary(self._command, self._text, details)

    def figure(self, name: str) -> bytes | None:
        """A figure with the same bytes as that of the program, by one of :attr:`figure_names`, PNG
        or SVG; None if this report has no such figure."""
        return _native.picture(self._command, name, self._text)

    def _contents(self, name: str) -> Contents:
        ending = Path(name).suffix.lower()
        own = [figure for figure in self.figure_names if figure.endswith(ending)]
        figure = name if name in own or not own else own[0]
        made = {
            ".html": lambda: (_native.page(self._command, self._text) or "").encode(),
            **dict.fromkeys((".svg", ".png"), lambda: self.figure(figure)),
        }
        return {**super()._contents(name), **{of: partial(_made, name, make) for of, make in made.items()}}

    def chart(self, name: str | None = None) -> Chart:
        """The figure of the program as numbers, by its ``name``, one of :attr:`figure_names` without its
        ending, such as ``"root-loci"`` or ``"cut-map"``, by default the first. Its ``plot()`` and
        ``plot_matplotlib()`` draw it. A chart for which the report has no data has no panels."""
        own = list(dict.fromkeys(name.partition(".")[0] for name in self.figure_names))
        if name is not None and name not in own:
            raise refused("name", name, f"one of {', '.join(own)}", "leave it out for the first of them")
        text = _native.chart(self._command, name or own[0], self._text)
        if text is not None:
            return read(text)
        return Chart(self._scene["name"], self._answer() if name is None else _MISSING.get(name, ""))

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self)._from_json, (self._text,)

    def __repr__(self) -> str:
        warned = "".join(f"WARNING: {warning}; " for warning in self._warnings())
        return f"<{type(self).__name__} {self._scene['name']!r}: {warned}{self._answer()}>"

    def _answer(self) -> str:
        return _native.answer(self._command, self._text)

    def _repr_html_(self) -> str:
        """The answer and the program's figure, for a notebook."""
        name = next((name for name in self.figure_names if name.endswith(".svg")), None)
        picture = None if name is None else self.figure(name)
        text = f"<div>{_native.html(self._command, self._text)}</div>"
        if picture is not None:
            # An image, so that its styles and scripts and those of the page do not affect each other.
            source = f"data:image/svg+xml;base64,{base64.b64encode(picture).decode()}"
            text += f"<img alt='' style='width:34em;max-width:100%' src='{source}'>"
        style = "display:flex;flex-wrap:wrap;gap:1.5em;align-items:flex-start"
        return f"<div style='{style}'>{text}</div>"


def _made(name: str, make: Callable[[], bytes | None]) -> bytes:
    """The page or figure of a report that has one."""
    content = make()
    if not content:
        raise refused("path", name, "the name of a page or a figure of this report", "save the report as .json")
    return content
