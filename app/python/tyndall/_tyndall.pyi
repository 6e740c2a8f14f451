"""What the package takes from the library; for type checkers. The package's own functions are the ones to use."""

from typing import Any, Optional

import numpy

class Error(ValueError):
    file: str
    place: str
    found: str
    expected: str

class Progress:
    spp: int
    seconds: float
    error: float
    mrays_per_s: float

class Scene:
    def __init__(self, other: Scene = ...) -> None: ...
    @staticmethod
    def load(what: bytes) -> Scene: ...
    @staticmethod
    def parse(json: str, folder: str | bytes) -> Scene: ...
    @staticmethod
    def built_in() -> list[str]: ...
    def set_json(self, pointer: str, json: str) -> None: ...
    def get_json(self, pointer: str) -> str: ...
    def remove(self, pointer: str) -> None: ...
    def add_json(self, object: str) -> None: ...
    def json(self) -> str: ...
    def save(self, file: bytes) -> None: ...
    width: int
    height: int
    folder: bytes

class Film:
    @staticmethod
    def load(file: bytes) -> Film: ...
    @staticmethod
    def merge(films: list[Film]) -> Film: ...
    def save(self, file: bytes) -> None: ...
    def picture(self) -> Picture: ...
    scene: Scene
    width: int
    height: int
    spp: int
    hash: str

class Picture:
    rgb: numpy.ndarray
    error_map: numpy.ndarray
    clean: numpy.ndarray
    albedo: numpy.ndarray
    normal: numpy.ndarray
    depth: numpy.ndarray
    width: int
    height: int
    error: float
    error_is_reliable: bool
    clean_error: float
    hash: str
    clean_hash: str
    spp: int
    seconds: float
    stopped: bool
    rejected: int
    film: Film
    scene: Scene
    def save(self, file: bytes) -> None: ...
    def png(self) -> bytes: ...

class RenderOptions:
    spp: int
    time: float
    target_error: float
    clean: bool
    threads: int
    isa: str
    first_sample: int
    film: Optional[Film]
    def set_region(self, x0: int, y0: int, x1: int, y1: int) -> None: ...

class Comparison:
    mse: float
    rmse: float
    relmse: float
    psnr: float
    flip: float
    blocks: int
    block_score: float
    block_limit: float
    worst_z: float
    only_noise: bool
    z: float
    unclear_blocks: int
    enough_spp: float
    mean_image: tuple
    mean_reference: tuple

def render(scene: Scene, options: RenderOptions, progress: Any) -> Picture: ...
def compare_pictures(image: Picture, reference: Picture) -> Comparison: ...
def compare_arrays(image: numpy.ndarray, reference: numpy.ndarray, width: int, height: int) -> Comparison: ...
def version() -> str: ...
