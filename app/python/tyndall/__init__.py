"""Tyndall, a path tracer, as a Python module.

>>> import tyndall
>>> scene = tyndall.scene("cover")            # a built-in scene, a file, or a dict as in a scene file
>>> scene["/camera/vfov"] = 30                # JSON pointers, as the command's --set
>>> picture = scene.render(spp=64)
>>> picture.array                             # numpy, height x width x 3, linear radiance, top row first
>>> picture.error                             # estimated relative error; its square estimates relMSE
>>> picture.save("cover.png")

Lengths are in scene units, angles in degrees, colours linear Rec.709. The bits of a picture are those of the command
``tyndall render`` (``picture.hash`` is its ``image_hash``). Whatever is wrong raises `tyndall.Error` with the sentence
that the command prints.
"""

from __future__ import annotations

import base64
import json
import math
import os
import time as _time
from collections.abc import Iterator, MutableMapping, Sequence
from typing import Any, Callable, NamedTuple, Optional, Union

import numpy

from . import _tyndall
from ._tyndall import Error, Progress, __version__, built_in

__all__ = ["Comparison", "Error", "Features", "Film", "Picture", "Progress", "Scene", "built_in", "compare", "merge",
           "scene", "__version__"]


def _fail(place: str, found: Any, expected: str) -> Error:
    found = " ".join((found if isinstance(found, str) else repr(found)).split())
    found = found if len(found) <= 100 else found[:100] + "…"
    error = Error(f"{place}: found {found}, expected {expected}")
    error.file, error.place, error.found, error.expected = "", place, found, expected
    return error


def _whole(place: str, value: Any, most: int = 2**32 - 1) -> int:
    if not isinstance(value, (int, numpy.integer)) or isinstance(value, bool) or not 0 <= value <= most:
        raise _fail(place, value, f"a whole number from 0 to {most}")
    return int(value)


def _number(place: str, value: Any) -> float:
    if not isinstance(value, (int, float, numpy.integer, numpy.floating)) or isinstance(value, bool) \
            or not value >= 0 or not math.isfinite(value):
        raise _fail(place, value, "a finite number >= 0; 0: no limit")
    return float(value)


def _text(place: str, value: Any, expected: str = "text") -> str:
    try:
        if not isinstance(value, str):
            raise _fail(place, value, expected)
        value.encode()
        if "\0" in value:
            raise _fail(place, value, "text without a zero byte")
        return value
    except UnicodeEncodeError:
        raise _fail(place, ascii(value), "text in UTF-8") from None


def _file(place: str, value: Any) -> bytes:
    """A file's name as the system has it, which need not be text."""
    try:
        name = os.fsencode(_text(place, value, "a file's name") if isinstance(value, str) else value)
    except TypeError:
        raise _fail(place, value, "a file's name") from None
    if b"\0" in name:
        raise _fail(place, value, "a file's name without a zero byte")
    return name


def _json(place: str, value: Any) -> str:
    """The value as JSON. What numpy makes counts as Python's own."""

    def plain(thing: Any) -> Any:
        if isinstance(thing, (numpy.ndarray, numpy.generic)):
            return thing.tolist()
        if isinstance(thing, Node):
            return thing.value
        raise _fail(place, thing, "a value that JSON has: a number, text, a list, a dict, True, False")

    try:
        return json.dumps(value, default=plain, allow_nan=False)
    except ValueError as why:
        if isinstance(why, Error):
            raise
        raise _fail(place, value, "finite numbers, and no list or dict within itself") from None
    except (TypeError, RecursionError):
        raise _fail(place, value, "a value that JSON has: a number, text, a list, a dict, True, False") from None


def _adds_to(inner: type) -> Callable[[type], Any]:
    """Gives a class of the library what a class here has: the library's is the one that is used."""

    def add(mine: type) -> Any:
        for name, value in vars(mine).items():
            if name not in ("__dict__", "__weakref__"):
                setattr(inner, name, value)
        return inner

    return add


class _Part:
    """A part of a scene. Reading looks it up, writing changes the scene."""

    _empty: type  # what it is where the scene has none

    def __init__(self, scene: "Scene", pointer: str):
        self._scene, self.pointer = scene, pointer

    @property
    def value(self) -> Any:
        """A copy, as Python's own dict or list."""
        try:
            return self._scene._value(self.pointer)
        except Error:
            if self.pointer.count("/") == 1:  # the scene has no materials, textures or objects
                return self._empty()
            raise

    def _at(self, key: Any) -> str:
        return f"{self.pointer}/" + _text(self.pointer, key, "a name").replace("~", "~0").replace("/", "~1")

    def __getitem__(self, key: Any) -> Any:
        return self._scene[self._at(key)]

    def __setitem__(self, key: Any, value: Any) -> None:
        self._scene[self._at(key)] = value

    def __delitem__(self, key: Any) -> None:
        del self._scene[self._at(key)]

    def __len__(self) -> int:
        return len(self.value)

    def __repr__(self) -> str:
        return repr(self.value)


class Node(_Part, MutableMapping):
    """A part of a scene with names in it, such as a material."""

    _empty = dict

    def __iter__(self) -> Iterator[str]:
        return iter(self.value)

    def __contains__(self, key: object) -> bool:
        return key in self.value


class Objects(_Part, Sequence):
    """The objects of a scene, by index or by name; `append` adds one."""

    _empty = list

    def _at(self, key: Union[int, str]) -> str:
        objects = self.value
        if isinstance(key, str):
            for index, each in enumerate(objects):
                if each.get("name") == key:
                    return f"/objects/{index}"
            raise _fail("/objects", json.dumps(key), "the name of an object")
        if isinstance(key, bool) or not isinstance(key, (int, numpy.integer)):
            raise _fail("/objects", key, "an index or a name")
        if not -len(objects) <= key < len(objects):
            raise IndexError(f"/objects: found {key}, expected an index of {len(objects)} objects")
        return f"/objects/{int(key) % len(objects)}"

    def append(self, value: Any) -> None:
        """Adds an object, such as {"type": "sphere", "center": [0, 1, 0], "radius": 1, "material": "gold"}."""
        self._scene._add_json(_json("/objects", value))


@_adds_to(_tyndall.Scene)
class Scene:
    """A scene: what a scene file holds. `scene[pointer]` reads and writes values by JSON pointers (RFC 6901)."""

    def copy(self) -> "Scene":
        """A scene of its own with the same values."""
        return Scene(self)

    __copy__ = copy

    def __deepcopy__(self, memo: dict) -> "Scene":
        return Scene(self)

    def __reduce__(self) -> tuple:
        return _parsed, (self.json(), os.path.abspath(self._folder))

    def _value(self, pointer: str) -> Any:
        return json.loads(self._get_json(pointer))

    def __getitem__(self, pointer: str) -> Any:
        pointer = _text("pointer", pointer, "a JSON pointer, which begins with /")
        value = self._value(pointer)
        return Node(self, pointer) if isinstance(value, dict) else value

    def __setitem__(self, pointer: str, value: Any) -> None:
        pointer = _text("pointer", pointer, "a JSON pointer, which begins with /")
        self._set_json(pointer, _json(pointer, value))

    def __delitem__(self, pointer: str) -> None:
        self._remove(_text("pointer", pointer, "a JSON pointer, which begins with /"))

    @property
    def objects(self) -> Objects:
        """The objects, by index or name."""
        return Objects(self, "/objects")

    @property
    def materials(self) -> Node:
        """The materials, by name: scene.materials["gold"]["fuzz"] = 0.1."""
        return Node(self, "/materials")

    @property
    def textures(self) -> Node:
        """The textures, by name."""
        return Node(self, "/textures")

    def save(self, file: Union[str, os.PathLike]) -> None:
        """Writes the scene file, whole or not at all."""
        self._save(_file("file", file))

    def render(self, spp: int = 0, *, time: float = 0, target_error: float = 0, clean: bool = False, threads: int = 0,
               isa: str = "", region: Optional[Sequence] = None, first_sample: int = 0, film: Optional["Film"] = None,
               progress: Optional[Callable[[Progress], Any]] = None) -> "Picture":
        """Renders until the first limit is reached; without any, as many samples as the scene asks for, or 64.

        spp: samples a pixel, those of `film` included. time: seconds. target_error: estimated relative error. clean:
        make the clean view, too. threads: 0: one a processor. isa: instruction set, "": the best. region: x0, y0, x1,
        y1 in pixels, y down. first_sample: index of each pixel's first sample. film: to go on from. progress: called
        about every 50 ms; what is false stops it, but None. Other threads of Python run meanwhile, and Ctrl-C stops it.
        """
        if not isinstance(clean, (bool, numpy.bool_)):
            raise _fail("clean", clean, "True or False")
        if film is not None and not isinstance(film, Film):
            raise _fail("film", film, "a tyndall.Film")
        if progress is not None and not callable(progress):
            raise _fail("progress", progress, "a function")
        options = _tyndall.RenderOptions(
            _whole("spp", spp), _number("time", time), _number("target_error", target_error), bool(clean),
            _whole("threads", threads, 4096), _text("isa", isa), None if region is None else _region(region),
            _whole("first_sample", first_sample), film)
        return _tyndall.render(self, options, progress)

    def progressive(self, seconds: float = 0, spp: int = 0, **options: Any) -> Iterator["Picture"]:
        """Pictures of the scene with 1, 2, 4, 8, … samples a pixel, until the seconds or samples are used up.

        Each goes on from the samples of the one before; the last one is what render() gives.
        """
        seconds, spp = _number("seconds", seconds), _whole("spp", spp)
        if not seconds and not spp:
            raise _fail("seconds", "neither seconds nor spp", "one of them")
        end = _time.monotonic() + seconds if seconds else math.inf
        film, step = options.pop("film", None), 1
        while True:
            left = end - _time.monotonic()
            if film is not None and left <= 0:
                return
            limit = min(step, spp) if spp else step
            picture = self.render(limit, time=max(left, 1e-3) if seconds else 0, film=film, **options)
            yield picture
            if picture.stopped or (spp and picture.spp >= spp):
                return
            film, step = picture.film, max(2 * picture.spp, 2)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Scene) and self.json() == other.json()

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        return f"<tyndall.Scene {self.width} x {self.height}, {len(self.objects)} objects>"


def _parsed(text: str, folder: bytes) -> Scene:
    return Scene._parse(text, folder)


def _region(region: Any) -> _tyndall.Region:
    try:
        numbers = list(region)
    except TypeError:
        numbers = []
    if len(numbers) != 4:
        raise _fail("region", region, "four whole numbers: x0, y0, x1, y1")
    return _tyndall.Region(*(_whole("region", number, 65536) for number in numbers))


class Features(NamedTuple):
    """What is seen first through the middle of each pixel."""

    albedo: numpy.ndarray  # height x width x 3
    normal: numpy.ndarray  # height x width x 3, towards the outside of the shape; 0 where nothing is seen
    depth: numpy.ndarray  # height x width, scene units along the camera's axis; infinite where nothing is seen


@_adds_to(_tyndall.Film)
class Film:
    """Samples gathered so far, as exact sums: they can be saved, loaded, merged and gone on with."""

    @staticmethod
    def load(file: Union[str, os.PathLike]) -> "Film":
        """Reads an EXR that Tyndall wrote."""
        return Film._load(_file("file", file))

    def save(self, file: Union[str, os.PathLike]) -> None:
        """Writes an EXR with the picture, the film and the scene."""
        self._save(_file("file", file))

    def __repr__(self) -> str:
        return f"<tyndall.Film {self._width} x {self._height}, {self.spp} samples>"


def merge(films: Sequence) -> Film:
    """Adds films of disjoint ranges of samples: bit for bit the film of one render."""
    films = list(films)
    for film in films:
        if not isinstance(film, Film):
            raise _fail("films", film, "a tyndall.Film")
    return Film._merge(films)


@_adds_to(_tyndall.Picture)
class Picture:
    """A finished picture. In a notebook it shows itself."""

    def __array__(self, dtype: Any = None) -> numpy.ndarray:
        return numpy.asarray(self.array, dtype=dtype)

    @property
    def features(self) -> Features:
        """Albedo, normal and depth of what is seen first."""
        return Features(self._albedo, self._normal, self._depth)

    def save(self, file: Union[str, os.PathLike]) -> None:
        """Writes a .png, .exr, .ppm, .pfm or .hdr file, whole or not at all."""
        self._save(_file("file", file))

    def _repr_html_(self) -> str:
        image = base64.b64encode(self._repr_png_()).decode()
        error = f", error {100 * self.error:.2g} %" if math.isfinite(self.error) else ""
        return (f'<img src="data:image/png;base64,{image}" width="{self.width}" height="{self.height}" alt="">'
                f"<div>{self.width} x {self.height}, {self.spp} samples a pixel{error}</div>")

    def __repr__(self) -> str:
        return f"<tyndall.Picture {self.width} x {self.height}, {self.spp} samples, error {self.error:.2g}>"


class Comparison(NamedTuple):
    """How far a picture is from another one, with the numbers of "tyndall compare". Means over pixels and channels."""

    mse: float
    rmse: float
    relmse: float  # (x - reference)^2 / (reference^2 + 0.01)
    psnr: float  # dB, of the sRGB pictures clipped to [0, 1]
    flip: float  # mean difference that an eye sees, in [0, 1]
    mean_image: tuple
    mean_reference: tuple
    blocks: int  # of 16 x 16 pixels; 0: one of the two has no film with 2 samples a pixel
    block_score: float  # mean square of the blocks' differences in standard errors
    block_limit: float  # up to which noise explains it
    worst_z: float
    only_noise: bool
    z: float  # largest difference of a mean, a block or the number of outliers, in standard errors, corrected
    unclear_blocks: int  # with light, but too noisy for a difference to show: of 60 effective samples or fewer
    enough_spp: float  # above 0: no block with light can tell, and about so many samples a pixel would do


def compare(image: Any, reference: Any) -> Comparison:
    """Compares two pictures or films, or two arrays of linear radiance, height x width x 3."""

    if isinstance(image, (Picture, Film)) and isinstance(reference, (Picture, Film)):
        pictures = (thing if isinstance(thing, Picture) else thing.picture for thing in (image, reference))
        found = _tyndall.compare_pictures(*pictures)
    else:
        a, b = _pixels("image", image), _pixels("reference", reference)
        if a.shape != b.shape:
            raise _fail("image", f"shape {a.shape}", f"that of the reference, {b.shape}")
        found = _tyndall.compare_arrays(a, b, a.shape[1], a.shape[0])
    return Comparison(*found)


def _pixels(place: str, thing: Any) -> numpy.ndarray:
    try:
        with numpy.errstate(over="ignore"):
            array = numpy.ascontiguousarray(thing.picture.array if isinstance(thing, Film) else thing,
                                            dtype=numpy.float32)
    except (TypeError, ValueError):
        raise _fail(place, thing, "a picture, or an array of numbers, height x width x 3") from None
    if array.ndim != 3 or array.shape[2] != 3 or array.size == 0:
        raise _fail(place, f"shape {array.shape}", "height x width x 3")
    if not numpy.isfinite(array).all():
        raise _fail(place, "numbers that are not finite in single precision", "finite ones")
    return array


def scene(what: Any = None) -> Scene:
    """A scene: a built-in one's name, a file's, or a dict as a scene file holds. Nothing: an empty one."""
    if what is None:
        return Scene()
    if isinstance(what, dict):
        return Scene._parse(_json("scene", what), ".")
    return Scene._load(_file("scene", what))
