"""Exact hit and depth images of PBRT scenes and meshes, as NumPy arrays.

>>> import feimos
>>> scene = feimos.load("scene.pbrt")
>>> depth = scene.render()["Z"]

Lengths are in units of the scene, positions and directions in its world space. Images are indexed
``[row, column]`` from the top left.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any, List

from .errors import (
    ArgumentError,
    Error,
    FileError,
    InputError,
    InternalError,
    MissingInputError,
    ResourceError,
)

if TYPE_CHECKING:
    from ._feimos import __version__
    from .camera import Camera
    from .scene import Scene, load, mesh

__all__ = [
    "ArgumentError",
    "Camera",
    "Error",
    "FileError",
    "InputError",
    "InternalError",
    "MissingInputError",
    "ResourceError",
    "Scene",
    "__version__",
    "load",
    "mesh",
]


# Where the names are that are imported on demand: the program `feimos` imports this package, and
# needs no NumPy.
_MODULES = {
    "Camera": ".camera",
    "Scene": ".scene",
    "__version__": "._feimos",
    "load": ".scene",
    "mesh": ".scene",
}


def __getattr__(name: str) -> Any:
    if name not in _MODULES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value = getattr(import_module(_MODULES[name], __name__), name)
    globals()[name] = value
    return value


def __dir__() -> List[str]:
    return sorted(set(globals()) | set(__all__))
