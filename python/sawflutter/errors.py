"""Exceptions, by what went wrong.

>>> import sawflutter as sf
>>> try:
...     sf.Scene.paper().replace({"blade.thickness_m": -1})
... except sf.SceneError as error:
...     print(error.key, error.value, error.allowed, sep="; ")
blade.thickness_m; -1; above 0; saws have 0.0001 to 0.04 m
"""

from __future__ import annotations


class InputError(ValueError):
    """Input that was refused.

    Attributes
    ----------
    key : str or None
        What was refused: the JSON path of a number, or the name of an argument.
    value : str or None
        What was given.
    allowed : str or None
        What it must be.
    remedy : str or None
        What to do about it.
    """

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
    """A scene that is none, or a number of it that no saw has."""


class PathError(SceneError, KeyError):
    """A path that the scene does not have."""

    # That of KeyError shows its message in quotes.
    __str__ = Exception.__str__


class StudyError(InputError):
    """A study that is none, or a folder that belongs to another one."""


class ArgumentError(InputError):
    """An argument of a method that is out of range."""


class AnalysisError(RuntimeError):
    """A computation that failed: the message says on what and what to do."""


class ModelWarning(UserWarning):
    """A number of the scene that no saw has, or a result that the model may not hold for: the
    ``warnings`` of a result. ``warnings.simplefilter("error", sawflutter.ModelWarning)`` makes them
    exceptions.
    """
