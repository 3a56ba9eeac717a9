"""A saw as data: read by paths, changed into another one."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any, SupportsFloat, TypeAlias, cast

from . import _native, _paths, _values
from ._scene_types import (
    Accuracy,
    BladeDict,
    ContactLaw,
    CutDict,
    GuideDict,
    GuideSide,
    MountDict,
    SceneDict,
)

if TYPE_CHECKING:
    from typing_extensions import Self

Number: TypeAlias = "SupportsFloat | None"


class Block(dict[str, Any]):
    """A part of a scene: a dict that cannot be written to. ``dict(block)`` is one that can."""

    def _refuse(self, *_: object, **__: object) -> Any:
        raise TypeError(_UNCHANGED)

    __setitem__ = __delitem__ = __ior__ = _refuse
    clear = pop = popitem = setdefault = update = _refuse

    def __reduce__(self) -> tuple[Any, ...]:
        return dict, (dict(self),)


_UNCHANGED = "a scene cannot be changed; replace({path: value}) makes another one"


class SceneData(Mapping[str, Any]):
    """What a scene is, without what can be asked of it."""

    __slots__ = ("_data", "_text")
    _text: str
    _data: Block

    def __init__(self, data: SceneDict | Mapping[str, Any]) -> None:
        if not isinstance(data, Mapping):
            raise TypeError(
                f"a scene is made of a dict, not of {data!r}: Scene.load reads a file, and "
                "Scene.from_json a text"
            )
        self._setup(_native.scene(_values.to_json(data)))

    def _setup(self, text: str) -> None:
        object.__setattr__(self, "_text", text)
        object.__setattr__(self, "_data", json.loads(text, object_hook=Block))

    @classmethod
    def _of(cls, text: str) -> Self:
        """The scene of a text that the library has written."""
        scene = cls.__new__(cls)
        scene._setup(text)
        return scene

    @property
    def name(self) -> str:
        """Title of reports and figures.

        Examples
        --------
        >>> import sawflutter as sf
        >>> saw = sf.Scene.paper()
        >>> saw.name
        'Guided spline arbor saw'
        """
        return str(self._data["name"])

    @property
    def blade(self) -> BladeDict:
        """The blade, like ``saw.blade["thickness_m"]``.

        Examples
        --------
        >>> import sawflutter as sf
        >>> saw = sf.Scene.paper()
        >>> saw.blade["thickness_m"]
        0.0028
        """
        return cast(BladeDict, self._data["blade"])

    @property
    def mount(self) -> MountDict | None:
        """How the blade is held at the bore.

        Examples
        --------
        >>> import sawflutter as sf
        >>> saw = sf.Scene.paper()
        >>> saw.mount['kind']
        'spline'
        """
        return self._data.get("mount")

    @property
    def guides(self) -> tuple[GuideDict, ...]:
        """The guides, like ``saw.guides[0]["radius_m"]``.

        Examples
        --------
        >>> import sawflutter as sf
        >>> saw = sf.Scene.paper()
        >>> len(saw.guides)
        1
        """
        return tuple(self._data.get("guides", ()))

    @property
    def cut(self) -> CutDict | None:
        """The wood and its forces.

        Examples
        --------
        >>> import sawflutter as sf
        >>> saw = sf.Scene.paper()
        >>> saw.cut is None
        False
        """
        return self._data.get("cut")

    def __getitem__(self, path: str) -> Any:
        """The value at a path, like ``saw["guides[0].radius_m"]``."""
        return _paths.get(self._data, path)

    def __iter__(self) -> Iterator[str]:
        return iter(self._data)

    def __len__(self) -> int:
        return len(self._data)

    def replace(self, changes: Mapping[str, Any]) -> Self:
        """The scene with other values, by their paths.

        Parameters
        ----------
        changes : dict
            New values by path, like ``"guides[0].radius_m"``: numbers, those of NumPy, quantities
            of pint, or texts with a unit, like ``"2.6 mm"``. None takes a key out; a block that is not there, like ``damping`` in
            ``"damping.air_n_s_per_m3"``, is begun.

        Returns
        -------
        Scene

        Raises
        ------
        PathError
            Where the scene has no such path: it says what there is.
        SceneError
            Where a value is refused.

        Examples
        --------
        >>> import sawflutter as sf
        >>> free = sf.Scene.paper().replace({"guides": []})
        >>> round(float(free.run_campbell().critical_rpm[0]))
        1477
        >>> sf.Scene.paper().replace({"blade.thickness_m": "2.6 mm"})["blade.thickness_m"]
        0.0026
        """
        data = json.loads(self._text)
        for path, value in changes.items():
            if isinstance(value, str) and isinstance(path, str):
                number = _native.number(path, value)
                value = value if number is None else number
            _paths.put(data, path, _values.plain(value, path.rpartition(".")[2]))
        return type(self)(data)

    def add_guide(
        self,
        *,
        radius_m: Number = None,
        angle_deg: Number = None,
        radial_length_m: Number = None,
        tangential_length_m: Number = None,
        stiffness_n_per_m: Number = None,
        damping_n_s_per_m: Number = None,
        gap_m: Number = None,
        contact: ContactLaw | None = None,
        side: GuideSide | None = None,
        film_stiffness_n_per_m: Number = None,
    ) -> Self:
        """The scene with one more guide, the last of :attr:`guides`.

        Parameters
        ----------
        radius_m, angle_deg, radial_length_m, tangential_length_m : float, optional
            Its place and size, as in a scene file.
        stiffness_n_per_m, damping_n_s_per_m, gap_m, film_stiffness_n_per_m : float, optional
            Its other numbers.
        contact : {"linear", "one_sided"}, optional
            Whether it holds the blade at any deflection, or touches it beyond the gap only.
        side : {"both", "left", "right"}, optional
            Sides of the blade on which a one-sided guide stands. What is left out is as of the last guide.

        Returns
        -------
        Scene

        Raises
        ------
        SceneError
            Where a number is missing or refused.

        Examples
        --------
        >>> import sawflutter as sf
        >>> len(sf.Scene.paper().add_guide(angle_deg=120.0).guides)
        2
        """
        given = {key: value for key, value in locals().items() if key != "self"}
        guide = {key: value for key, value in given.items() if value is not None}
        last: Mapping[str, Any] = self.guides[-1] if self.guides else {}
        return self.replace({"guides": [*self.guides, {**last, **guide}]})

    def with_accuracy(self, accuracy: Accuracy | None = None, tolerance: Number = None) -> Self:
        """The scene with another accuracy, by name or as a relative error.

        Parameters
        ----------
        accuracy : {"draft", "design", "reference"}, optional
            Accuracy by name.
        tolerance : float, optional
            Relative error allowed of critical speeds and onsets, instead of a name.

        Returns
        -------
        Scene

        Raises
        ------
        TypeError
            Where both are given.
        SceneError
            Where one is refused.

        Examples
        --------
        >>> import sawflutter as sf
        >>> sf.Scene.paper().with_accuracy("draft")["accuracy"]
        'draft'
        """
        if accuracy is not None and tolerance is not None:
            raise TypeError("give accuracy or tolerance, not both")
        if accuracy is not None:
            return self.replace({"accuracy": accuracy, "tolerance": None})
        if tolerance is not None:
            return self.replace({"tolerance": tolerance})
        return self

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError(_UNCHANGED)

    def __setitem__(self, path: str, value: object) -> None:
        raise TypeError(_UNCHANGED)

    def __eq__(self, other: object) -> bool:
        return self._text == other._text if isinstance(other, SceneData) else NotImplemented

    def __hash__(self) -> int:
        return hash(self._text)

    def __reduce__(self) -> tuple[Any, tuple[str]]:
        return type(self)._of, (self._text,)

    def __repr__(self) -> str:
        blade, guides = self.blade, len(self.guides)
        count = f"{guides or 'no'} guide{'' if guides == 1 else 's'}"
        return (
            f"<Scene {self.name!r}: {1e3 * blade['outer_diameter_m']:.6g} mm outside, "
            f"{1e3 * blade['thickness_m']:.6g} mm thick, {count}>"
        )
