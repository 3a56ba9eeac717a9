"""Methods of all results."""

from __future__ import annotations

import base64
import json
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar, TypeVar

from . import _native
from ._drawn import Drawn
from ._entry import Entry
from ._extras import entries
from .errors import InputError

if TYPE_CHECKING:
    import pandas as pd

    from .plot.chart import Chart
    from .scene import Scene

R = TypeVar("R", bound="Result")


class Report(Drawn):
    """Base of all reports. It keeps the JSON of the program unchanged: :meth:`save` writes the
    same bytes as the program.
    """

    table: ClassVar[str] = ""
    """Name of the attribute of which :meth:`to_dataframe` has a row each."""

    _text: str

    def to_json(self) -> str:
        """The report as JSON, as written by the program.

        Returns
        -------
        str

        Examples
        --------
        >>> import sawflutter as sf
        >>> r = sf.Scene.paper().run_campbell(accuracy="draft")
        >>> r.to_json().startswith("{")
        True
        """
        return self._text

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the report, the same bytes as the program; :func:`sawflutter.load` reads it. A study
        also writes the table of its saws, to the file of the same name with the ending .csv.

        Parameters
        ----------
        path : str or path
            The file.

        Raises
        ------
        OSError
            If the file cannot be written.

        Examples
        --------
        >>> import pathlib, tempfile
        >>> import sawflutter as sf
        >>> r = sf.Scene.paper().run_campbell(accuracy="draft")
        >>> path = pathlib.Path(tempfile.mkdtemp()) / "report.json"
        >>> r.save(path)
        >>> path.read_text(encoding="utf-8") == r.to_json()
        True
        """
        Path(path).write_bytes(self._text.encode())
        self._save_beside(Path(path))

    def _save_beside(self, path: Path) -> None:
        """Writes the other files of a report."""

    def to_dataframe(self) -> pd.DataFrame:
        """The results as a table, which needs pandas. It has one row for each limit of a check,
        number of a fit or a place, setting of a tradeoff, saw of a comparison or a map, speed of a
        cut (without histories and maps), or mode of a washboard; :attr:`table` names the attribute
        with these rows as objects. A run-up has a row for each sample (``rpm``, ``deflection_m``);
        a response for each speed, with a column for the amplitude at the probe in m of each line; a
        slow sweep for each stable equilibrium, without its frequencies; guides with a gap for each
        ``gap_factor`` and ``force_n``, with the deflections at the cut.

        Returns
        -------
        pandas.DataFrame

        Raises
        ------
        ImportError
            If pandas is missing; the message says how to install it.

        Examples
        --------
        >>> import sawflutter as sf
        >>> check = sf.Scene.paper().check(operating_rpm=1400, accuracy="draft")
        >>> bool(check.to_dataframe()["passed"].all())
        False
        """
        return self._rows()

    def _rows(self) -> pd.DataFrame:
        return entries(getattr(self, self.table))

    def __eq__(self, other: object) -> bool:
        return isinstance(other, type(self)) and self._text == other._text

    def __hash__(self) -> int:
        return hash(self._text)


class Result(Report, Entry):
    """Base of all results of a saw."""

    figure_names: ClassVar[tuple[str, ...]] = ()
    """Names of the program's own figures of this result, see :meth:`figure`."""

    command: ClassVar[str] = ""
    """The command of the program that reports it."""

    def __init_subclass__(cls) -> None:
        super().__init_subclass__()
        cls.figure_names = tuple(_native.figure_names(cls.command))

    _steps: ClassVar[str] = "speeds"
    """Name of its steps, for the progress bar."""

    @classmethod
    def from_json(cls: type[R], text: str) -> R:
        """Reads a result from JSON, as returned by :meth:`to_json`.

        Parameters
        ----------
        text : str
            The JSON text.

        Returns
        -------
        Result
            An object of the class of this method.

        Raises
        ------
        InputError
            If the text is a report of another kind.

        Examples
        --------
        >>> import sawflutter as sf
        >>> r = sf.Scene.paper().run_campbell(accuracy="draft")
        >>> sf.CampbellResults.from_json(r.to_json()) == r
        True
        """
        data = json.loads(text)
        try:
            result = cls.from_dict(data)
        except TypeError as error:
            version = data.get("sawflutter") if isinstance(data, dict) else None
            written = f"one of sawflutter {version}" if version else "something else"
            raise InputError(
                f"this is no report of {cls.command!r} that this version reads, but {written} "
                f"({error}); sawflutter.load reads a report of any kind"
            ) from error
        object.__setattr__(result, "_text", text)
        result._read()
        return result

    @classmethod
    def load(cls: type[R], path: str | os.PathLike[str]) -> R:
        """Reads a report of this kind that the program or :meth:`save` has written, and for a study
        the table of its saws in the same folder.

        Parameters
        ----------
        path : str or path
            The file.

        Returns
        -------
        Result
            An object of the class of this method.

        Raises
        ------
        InputError
            If the file is a report of another kind.
        OSError
            If the file cannot be read.

        Examples
        --------
        >>> import pathlib, tempfile
        >>> import sawflutter as sf
        >>> r = sf.Scene.paper().run_campbell(accuracy="draft")
        >>> path = pathlib.Path(tempfile.mkdtemp()) / "report.json"
        >>> r.save(path)
        >>> sf.CampbellResults.load(path) == r
        True
        """
        result = cls.from_json(Path(path).read_text(encoding="utf-8"))
        result._load_beside(Path(path))
        return result

    def _load_beside(self, path: Path) -> None:
        """Remembers where the other files of a report are."""

    def _read(self) -> None:
        """Completes a result after all of it was read."""

    def _warnings(self) -> tuple[str, ...]:
        """Warnings of implausible numbers, and of a result outside the validity of the model."""
        return (*getattr(self, "unusual_numbers", ()), *getattr(self, "warnings", ()))

    @property
    def raw(self) -> dict[str, Any]:
        """The report as a dict with all keys.

        Examples
        --------
        >>> import sawflutter as sf
        >>> r = sf.Scene.paper().run_campbell(accuracy="draft")
        >>> r.raw["critical_speeds"][0]["rpm"] == r.critical_speeds[0].rpm
        True
        """
        data: dict[str, Any] = json.loads(self._text)
        return data

    @property
    def saw(self) -> Scene:
        """The scene of the computation; for a fit or a placement, the resulting scene.

        Examples
        --------
        >>> import sawflutter as sf
        >>> r = sf.Scene.paper().run_campbell(accuracy="draft")
        >>> r.saw
        <Scene 'Guided spline arbor saw': 710 mm outside, 2.8 mm thick, 1 guide>
        """
        from .scene import Scene

        return Scene.from_json(json.dumps(self.raw["scene"]))

    def summary(self, *, details: bool = False) -> str:
        """The report as text, as printed by the program.

        Parameters
        ----------
        details : bool
            With certificates, backward errors and the basis, as printed with --details.

        Returns
        -------
        str

        Examples
        --------
        >>> import sawflutter as sf
        >>> r = sf.Scene.paper().run_campbell(accuracy="draft")
        >>> 'critical' in r.summary()
        True
        """
        return _native.summary(self.command, self._text, details)

    def figure(self, name: str) -> bytes | None:
        """A figure with the same bytes as that of the program; None if this report has no such
        figure.

        Parameters
        ----------
        name : str
            One of :attr:`figure_names`, PNG or SVG.

        Returns
        -------
        bytes or None

        Raises
        ------
        InputError
            If no figure has this name.

        Examples
        --------
        >>> import sawflutter as sf
        >>> r = sf.Scene.paper().run_campbell(accuracy="draft")
        >>> r.figure("campbell.png")[1:4]
        b'PNG'
        """
        return _native.picture(self.command, name, self._text)

    def save_page(self, path: str | os.PathLike[str]) -> None:
        """Writes one self-contained page of HTML, as the program does with ``--report``: verdict,
        inputs, tables, figures, warnings, certificate. A browser prints it as PDF.

        Parameters
        ----------
        path : str or path
            The file.

        Raises
        ------
        TypeError
            If this kind of result has no page.
        OSError
            If the file cannot be written.

        Examples
        --------
        >>> import pathlib, tempfile
        >>> import sawflutter as sf
        >>> r = sf.Scene.paper().run_campbell(accuracy="draft")
        >>> path = pathlib.Path(tempfile.mkdtemp()) / "page.html"
        >>> r.save_page(path)
        >>> "<svg" in path.read_text(encoding="utf-8")
        True
        """
        page = _native.page(self.command, self._text)
        if page is None:
            raise TypeError(f"there is no page of {self.command!r}; save its figures and its table")
        Path(path).write_bytes(page.encode())

    def _described(self, name: str, otherwise: str = "") -> Chart:
        """The chart of a figure of the program; if the report has no data for it, a chart without
        panels whose facts are ``otherwise``."""
        from .plot.chart import Chart
        from .plot.described import described

        chart = described(self.command, name, self._text)
        return Chart(self.raw["scene"]["name"], otherwise) if chart is None else chart

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self).from_json, (self._text,)

    def __repr__(self) -> str:
        warned = "".join(f"WARNING: {warning}; " for warning in self._warnings())
        return f"<{type(self).__name__} {self.raw['scene']['name']!r}: {warned}{self._facts()}>"

    def _chart(self) -> Chart:
        return self._described(self.figure_names[0].partition(".")[0], self._facts())

    def _facts(self) -> str:
        """The answer in one line."""
        raise NotImplementedError

    def _repr_html_(self) -> str:
        """The answer and the program's figure, for a notebook."""
        name = next((name for name in self.figure_names if name.endswith(".svg")), None)
        picture = None if name is None else self.figure(name)
        text = f"<div>{_native.html(self.command, self._text)}</div>"
        if picture is not None:
            # An image, so that its styles and scripts and those of the page do not affect each other.
            source = f"data:image/svg+xml;base64,{base64.b64encode(picture).decode()}"
            text += f"<img alt='' style='width:34em;max-width:100%' src='{source}'>"
        style = "display:flex;flex-wrap:wrap;gap:1.5em;align-items:flex-start"
        return f"<div style='{style}'>{text}</div>"
