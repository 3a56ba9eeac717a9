"""Exceptions of the package.

>>> import sawflutter as sf
>>> try:
...     sf.Scene.paper().replace({"blade.thickness_m": -1})
... except sf.SceneError as error:
...     print(error.key, error.value, error.allowed, sep="; ")
blade.thickness_m; -1; above 0, usual range 0.0001 to 0.04 m
"""

from __future__ import annotations

import sys
import warnings
from collections.abc import Iterable


class InputError(ValueError):
    """Input that was refused: :attr:`key` is the path of the number in the scene, or the name of the
    argument, :attr:`value` what was given, :attr:`allowed` what is allowed, and :attr:`remedy` advice;
    each is a text or None."""

    def __init__(
        self,
        message: str,
        key: str | None = None,
        value: str | None = None,
        allowed: str | None = None,
        remedy: str | None = None,
    ) -> None:
        super().__init__(message)
        self.key, self.value, self.allowed, self.remedy = key, value, allowed, remedy

    def __reduce__(self) -> tuple[type[InputError], tuple[str | None, ...]]:
        return type(self), (str(self), self.key, self.value, self.allowed, self.remedy)


class SceneError(InputError):
    """A text that is not a scene, or a scene with a number out of range."""


class PathError(SceneError, KeyError):
    """A path that the scene does not have."""

    # KeyError would show the message in quotes.
    __str__ = Exception.__str__


class StudyError(InputError):
    """A text that is not a study, or a folder that belongs to another study."""


class ArgumentError(InputError):
    """An argument of a method that is out of range."""


def refused(key: str, value: object, allowed: str, remedy: str) -> ArgumentError:
    """The error of an argument."""
    given = "" if value is None else f" (you gave {value!r})"
    message = f"{key} must be {allowed}{given}; {remedy}"
    return ArgumentError(message, key, str(value), allowed, remedy)


class AnalysisError(RuntimeError):
    """A computation that failed; the message states the reason and gives advice."""


class ModelWarning(UserWarning):
    """An implausible number of the scene, or a result outside the validity of the model; see the
    ``warnings`` of a result. ``warnings.simplefilter("error", sawflutter.ModelWarning)`` turns
    them into exceptions.
    """


def warned(texts: Iterable[str]) -> None:
    """Warns of each text, and names the line of the user that calls the package."""
    frame, level = sys._getframe(1), 2
    while frame.f_back is not None and frame.f_globals["__name__"].partition(".")[0] == __package__:
        frame, level = frame.f_back, level + 1
    for text in dict.fromkeys(texts):
        warnings.warn(text, ModelWarning, stacklevel=level)
