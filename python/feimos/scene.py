"""Scenes: loads them, renders them, and casts rays into them."""

import os
import warnings as python_warnings
from typing import TYPE_CHECKING, Any, Dict, List, Optional, Sequence, Tuple, Union

import numpy as np

from . import _feimos, arrays
from .camera import Camera
from .errors import ArgumentError

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

__all__ = ["Scene", "load", "mesh"]


def load(
    path: "Union[str, os.PathLike[str]]",
    *,
    resolution: Optional[Tuple[int, int]] = None,
    time: Optional[float] = None,
    alpha_cutoff: Optional[float] = None,
    input_budget: Optional[int] = None,
    threads: Optional[int] = None,
) -> "Scene":
    """Load a PBRT scene with the files that it names, or a mesh: PLY, OBJ, STL or OFF.

    Warnings of the scene, about directives that are not supported for example, are issued by
    :func:`warnings.warn` and kept in :attr:`Scene.warnings`.

    :param resolution: width and height of the scene's own image in pixels, instead of the file's.
    :param time: the moment that is shown of what moves, from 0 (the start of its motion) to 1.
    :param alpha_cutoff: hits with an alpha up to this number, from 0 to below 1, do not count. The
        default is 0.
    :param input_budget: a factor for the limits of what the files may expand to.
    :param threads: the number of threads; by default all that the process may use.
    :raises Error: the file is missing or wrong; the message has the line and the column.
    """
    loaded = _feimos.Scene.load(
        os.fspath(path),
        resolution=arrays.size(resolution, "resolution"),
        time=time,
        alpha_cutoff=alpha_cutoff,
        input_budget=input_budget,
        threads=threads,
    )
    scene = Scene._of(loaded)
    for warning in scene.warnings:
        python_warnings.warn(warning, stacklevel=2)
    return scene


def mesh(
    points: "ArrayLike", triangles: "ArrayLike", *, threads: Optional[int] = None
) -> "Scene":
    """Make a scene of triangles.

    Triangle ``i`` is the primitive ``i + 1`` of images and hits. Points that are not finite are
    allowed: their triangles are never hit.

    :param points: (n, 3), positions in world space, real numbers of any type. feimos computes with
        float32 vertices: other numbers are rounded to the nearest float32.
    :param triangles: (m, 3), integers of any type: the numbers of the points, from 0.
    :param threads: the number of threads; by default all that the process may use.
    :raises ArgumentError: a number of a point does not exist, a coordinate is beyond float32, or a
        shape is wrong.
    """
    corners = arrays.points(points)
    return Scene._of(
        _feimos.Scene.mesh(corners, arrays.triangles(triangles, len(corners)), threads=threads)
    )


class Scene:
    """Geometry and a camera, made by :func:`load` or :func:`mesh`.

    Any number of threads may use a scene at a time. A scene cannot be pickled: each process of
    :mod:`multiprocessing` loads its own, or inherits one by ``fork``.
    """

    __slots__ = ("_scene",)

    _scene: "_feimos.Scene"

    def __init__(self) -> None:
        raise TypeError("a Scene is made by feimos.load or feimos.mesh")

    @classmethod
    def _of(cls, scene: "_feimos.Scene") -> "Scene":
        made = cls.__new__(cls)
        made._scene = scene
        return made

    @property
    def camera(self) -> Camera:
        """The scene's own camera; that of a mesh frames it."""
        return Camera._of(self._scene.camera)

    def cameras(self, path: "Union[str, os.PathLike[str]]") -> List[Camera]:
        """The cameras of a list: feimos' JSON, ``transforms.json``, or a COLMAP text model.

        :raises Error: the list is missing or wrong.
        """
        return [Camera._of(camera) for camera in self._scene.cameras(os.fspath(path))]

    @property
    def bounds(self) -> "Optional[NDArray[np.float64]]":
        """The box around all primitives: its lowest and its highest corner, (2, 3), in world space.

        None if there is no primitive.
        """
        bounds = self._scene.bounds
        return None if bounds is None else np.array(bounds)

    @property
    def primitive_count(self) -> int:
        """The number of primitives, those of instances counted each time."""
        return self._scene.primitive_count

    @property
    def warnings(self) -> Tuple[str, ...]:
        """The warnings about the scene's files, as the command line prints them."""
        return tuple(self._scene.warnings)

    def render(
        self,
        K: "Optional[ArrayLike]" = None,
        R: "Optional[ArrayLike]" = None,
        t: "Optional[ArrayLike]" = None,
        size: Optional[Tuple[int, int]] = None,
        channels: Union[str, Sequence[str]] = ("Z",),
        *,
        camera: Optional[Camera] = None,
        accel: Optional[str] = None,
        precision: str = "exact",
        threads: Optional[int] = None,
    ) -> "Dict[str, NDArray[Any]]":
        """Render an image: one ray through the centre of each pixel.

        Without ``K`` and ``camera``, the view is that of the scene's own camera.

        :param K: (3, 3), calibration in pixels, with ``size``; see :class:`Camera`.
        :param R: (3, 3), rotation from world to camera space; by default the identity.
        :param t: (3,), translation from world to camera space; by default zero.
        :param size: width and height in pixels.
        :param channels: any of

            - ``"Z"``: depth along the view axis; inf for a miss; float32, (h, w)
            - ``"t"``: distance from the eye; inf for a miss; float32, (h, w)
            - ``"A"``: 1 for a hit, 0 for a miss; float32, (h, w)
            - ``"prim"``, ``"id"``, ``"instance"``: number of the primitive, the shape and the
              instance, from 1; 0 for none; uint32, (h, w)
            - ``"N"``: unit normal in world space; 0 for a miss; float32, (h, w, 3)
            - ``"P"``: point of the hit in world space; 0 for a miss; float32, (h, w, 3)
            - ``"uv"``: surface coordinates; 0 for a miss; float32, (h, w, 2)
            - ``"cost"``: nodes and primitives that the ray tests in a tree; uint32, (h, w)

        :param camera: a :class:`Camera`, instead of ``K``, ``R``, ``t`` and ``size``.
        :param accel: the tree: ``"sah"``, ``"hlbvh"``, ``"middle"``, ``"equal"`` or ``"none"``; the
            scene keeps it. The image does not depend on it. By default feimos takes the fastest
            way: bins of the view, and from the 16th view of a scene on a tree for all.
        :param precision: ``"exact"``, or ``"fast"`` for float32 without error bounds.
        :param threads: the number of threads; by default all that the process may use.
        :returns: one array for each channel, by its name. The arrays belong to the caller.
        :raises Error: the arguments contradict each other, or memory does not suffice.
        """
        view = self._view(K, R, t, size, camera)
        names = [channels] if isinstance(channels, str) else list(channels)
        return self._scene.render(
            view._camera, names, accel=accel, precision=precision, threads=threads
        )

    def _view(
        self,
        K: "Optional[ArrayLike]",
        R: "Optional[ArrayLike]",
        t: "Optional[ArrayLike]",
        size: Optional[Tuple[int, int]],
        camera: Optional[Camera],
    ) -> Camera:
        if camera is not None:
            if any(value is not None for value in (K, R, t, size)):
                raise ArgumentError("camera: K, R, t and size are the camera's own; leave them out")
            if not isinstance(camera, Camera):
                raise TypeError(f"camera: expected a feimos.Camera, found {type(camera).__name__}")
            return camera
        if K is None:
            if any(value is not None for value in (R, t, size)):
                raise ArgumentError("K is missing: R, t and size need it")
            return self.camera
        if size is None:
            raise ArgumentError("size is missing: K is in pixels of an image of (width, height)")
        return Camera(K, R, t, size=size)

    def cast(
        self,
        origins: "ArrayLike",
        directions: "ArrayLike",
        *,
        threads: Optional[int] = None,
    ) -> "Dict[str, NDArray[Any]]":
        """Cast rays: find the first hit of each.

        The first call builds a tree, which the scene keeps.

        :param origins: (..., 3), in world space; computed in float64.
        :param directions: (..., 3), of any length but 0. Both are broadcast against each other.
        :param threads: the number of threads; by default all that the process may use.
        :returns: arrays of the leading shape of the rays:

            - ``"t"``: the ray parameter: the hit is at ``origin + t * direction``; inf for a miss;
              float32
            - ``"distance"``: distance from the origin; inf for a miss; float32
            - ``"prim"``, ``"id"``, ``"instance"``: as in images; 0 for a miss; uint32
            - ``"N"``, ``"P"``, ``"uv"``: as in images, (..., 3) or (..., 2); float32

            A ray whose origin or direction is not finite, or whose direction is zero, hits nothing.
        :raises Error: a shape is wrong, or memory does not suffice.
        """
        starts, ways = arrays.vectors(origins, "origins"), arrays.vectors(directions, "directions")
        try:
            starts, ways = np.broadcast_arrays(starts, ways)
        except ValueError:
            raise ArgumentError(
                f"origins of the shape {starts.shape} and directions of the shape {ways.shape} "
                "do not fit each other"
            ) from None
        flat = [np.ascontiguousarray(part).reshape(-1, 3) for part in (starts, ways)]
        hits = self._scene.cast(*flat, threads=threads)
        shape = starts.shape[:-1]
        return {name: array.reshape(shape + array.shape[1:]) for name, array in hits.items()}

    def __repr__(self) -> str:
        return f"<feimos.Scene of {self.primitive_count:,} primitives>"
