"""Scene: a saw and its computations."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import TYPE_CHECKING, cast

from . import _native
from ._pictures import Pictures
from ._questions import Questions
from ._scene_types import SceneDict

if TYPE_CHECKING:
    from typing_extensions import Self


class Scene(Pictures, Questions):
    """A saw (blade, mount, guides) with the conditions to compute. It is a mapping of the keys of
    a scene file and accepts paths too. It is read-only; :meth:`replace` returns a changed copy.

    Parameters
    ----------
    data : dict
        The scene as in a scene file, see :data:`sawflutter.SceneDict`; NumPy numbers and pint
        quantities are accepted.

    Raises
    ------
    SceneError
        If the scene is invalid; the error gives the key, the allowed values and advice.

    Examples
    --------
    >>> import sawflutter as sf
    >>> saw = sf.Scene.paper()
    >>> saw["blade.thickness_m"], saw.blade["thickness_m"], "damping" in saw
    (0.0028, 0.0028, False)
    >>> thin = saw.replace({"blade.thickness_m": 2.6e-3, "guides[0].radius_m": 0.22})
    >>> thin
    <Scene 'Guided spline arbor saw': 710 mm outside, 2.6 mm thick, 1 guide>
    """

    __slots__ = ()

    @classmethod
    def from_json(cls, text: str) -> Self:
        """Reads a scene from JSON.

        Parameters
        ----------
        text : str
            The JSON text.

        Returns
        -------
        Scene

        Raises
        ------
        SceneError
            If the scene is refused.

        Examples
        --------
        >>> import sawflutter as sf
        >>> saw = sf.Scene.paper()
        >>> sf.Scene.from_json(saw.to_json()) == saw
        True
        """
        return cls._of(_native.scene(text))

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Self:
        """Reads a scene file.

        Parameters
        ----------
        path : str or path
            The file.

        Returns
        -------
        Scene

        Raises
        ------
        SceneError
            If the scene is refused.
        OSError
            If the file cannot be read.

        Examples
        --------
        >>> import pathlib, tempfile
        >>> import sawflutter as sf
        >>> saw = sf.Scene.paper()
        >>> path = pathlib.Path(tempfile.mkdtemp()) / "saw.json"
        >>> saw.save(path)
        >>> sf.Scene.load(path) == saw
        True
        """
        return cls._of(_native.read_scene(path))

    @classmethod
    def paper(cls) -> Self:
        """The built-in guided spline saw, with the numbers of a paper.

        Returns
        -------
        Scene

        Examples
        --------
        >>> import sawflutter as sf
        >>> saw = sf.Scene.paper()
        >>> saw.name
        'Guided spline arbor saw'
        """
        return cls._of(_native.paper())

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes a scene file.

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
        >>> saw = sf.Scene.paper()
        >>> path = pathlib.Path(tempfile.mkdtemp()) / "saw.json"
        >>> saw.save(path)
        >>> sf.Scene.load(path) == saw
        True
        """
        text = json.dumps(self.to_dict(), indent=2, ensure_ascii=False)
        Path(path).write_text(text + "\n", encoding="utf-8")

    def to_dict(self) -> SceneDict:
        """A copy of the scene as a dict, which can be changed and converted to a scene again.

        Returns
        -------
        dict

        Examples
        --------
        >>> import sawflutter as sf
        >>> saw = sf.Scene.paper()
        >>> data = saw.to_dict()
        >>> data["name"] = "Mine"
        >>> sf.Scene(data).name
        'Mine'
        """
        return cast(SceneDict, json.loads(self._text))

    def to_json(self) -> str:
        """The scene as one line of JSON.

        Returns
        -------
        str

        Examples
        --------
        >>> import sawflutter as sf
        >>> saw = sf.Scene.paper()
        >>> sf.Scene.from_json(saw.to_json()) == saw
        True
        """
        return self._text
