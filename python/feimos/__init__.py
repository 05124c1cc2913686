"""Exact hit and depth images of PBRT scenes and meshes, as NumPy arrays.

>>> import feimos
>>> scene = feimos.load("scene.pbrt")
>>> depth = scene.render()["Z"]

Lengths are in units of the scene, positions and directions in its world space. Images are indexed
``[row, column]`` from the top left.
"""

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


def __getattr__(name: str) -> Any:
    # On demand, because the program `feimos` imports this package and needs no NumPy.
    if name == "__version__":
        from . import _feimos as module
    elif name == "Camera":
        from . import camera as module
    elif name in ("Scene", "load", "mesh"):
        from . import scene as module
    else:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    globals()[name] = value = getattr(module, name)
    return value


def __dir__() -> List[str]:
    return sorted(set(globals()) | set(__all__))
