"""Data of a saw, with access by paths."""

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
    GuideShape,
    GuideSide,
    MountDict,
    SceneDict,
)

if TYPE_CHECKING:
    from typing_extensions import Self

Number: TypeAlias = "SupportsFloat | None"


class Block(dict[str, Any]):
    """A part of a scene: a read-only dict. ``dict(block)`` is a copy that can be changed."""

    def _refuse(self, *_: object, **__: object) -> Any:
        raise TypeError(_UNCHANGED)

    __setitem__ = __delitem__ = __ior__ = _refuse
    clear = pop = popitem = setdefault = update = _refuse

    def __reduce__(self) -> tuple[Any, ...]:
        return dict, (dict(self),)


_UNCHANGED = "a scene cannot be changed; replace({path: value}) makes another one"


def _numbers(path: str, value: Any) -> Any:
    """A value in which texts with a unit are numbers, in blocks and lists too."""
    if isinstance(value, str):
        number = _native.number(path, value)
        return value if number is None else number
    if isinstance(value, Mapping):
        return {key: _numbers(f"{path}.{key}", inner) for key, inner in value.items()}
    if isinstance(value, (list, tuple)):
        return [_numbers(f"{path}[{place}]", inner) for place, inner in enumerate(value)]
    return value


class SceneData(Mapping[str, Any]):
    """Data of a scene, without its computations."""

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
        """The blade, for instance ``saw.blade["thickness_m"]``.

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
        """The support of the blade at the bore.

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
        """The guides, for instance ``saw.guides[0]["radius_m"]``.

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
        """The cut: wood and cutting forces.

        Examples
        --------
        >>> import sawflutter as sf
        >>> saw = sf.Scene.paper()
        >>> saw.cut is None
        False
        """
        return self._data.get("cut")

    def __getitem__(self, path: str) -> Any:
        """The value at a path, for instance ``saw["guides[0].radius_m"]``."""
        return _paths.get(self._data, path)

    def __iter__(self) -> Iterator[str]:
        return iter(self._data)

    def __len__(self) -> int:
        return len(self._data)

    def replace(self, changes: Mapping[str, Any]) -> Self:
        """Returns the scene with other values at given paths.

        Parameters
        ----------
        changes : dict
            New values by path, such as ``"guides[0].radius_m"``: numbers, NumPy numbers, pint
            quantities, or texts with a unit such as ``"2.6 mm"``, in blocks and lists too. None
            removes a key. A missing block, such as ``damping`` in ``"damping.air_n_s_per_m3"``, is created.

        Returns
        -------
        Scene

        Raises
        ------
        PathError
            If the scene has no such path; the message lists the existing ones.
        SceneError
            If a value is invalid.

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
            if isinstance(path, str):
                value = _numbers(path, value)
            _paths.put(data, path, _values.plain(value, path.rpartition(".")[2]))
        return type(self)(data)

    def add_guide(
        self,
        *,
        radius_m: Number = None,
        angle_deg: Number = None,
        radial_length_m: Number = None,
        tangential_length_m: Number = None,
        shape: GuideShape | None = None,
        stiffness_n_per_m: Number = None,
        damping_n_s_per_m: Number = None,
        gap_m: Number = None,
        contact: ContactLaw | None = None,
        side: GuideSide | None = None,
        film_stiffness_n_per_m: Number = None,
        offset_m: Number = None,
    ) -> Self:
        """Returns the scene with one more guide at the end of :attr:`guides`. Arguments that are
        not given are copied from the last guide.

        Parameters
        ----------
        radius_m, angle_deg, radial_length_m, tangential_length_m : float, optional
            Position and size, as in a scene file.
        stiffness_n_per_m, damping_n_s_per_m, gap_m, film_stiffness_n_per_m, offset_m : float, optional
            Other numbers, as in a scene file.
        shape : {"rectangle", "round"}, optional
            Shape of the guide with these two lengths.
        contact : {"linear", "one_sided"}, optional
            Whether it holds the blade at any deflection or touches it only beyond the gap.
        side : {"both", "left", "right"}, optional
            Sides of the blade with a one-sided guide.

        Returns
        -------
        Scene

        Raises
        ------
        SceneError
            If a number is missing or invalid.

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
        """Returns the scene with another accuracy, by name or as a relative error.

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
            If both are given.
        SceneError
            If one is invalid.

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
