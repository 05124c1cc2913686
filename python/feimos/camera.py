"""Cameras."""

from typing import TYPE_CHECKING, Any, Optional, Tuple

import numpy as np

from . import _feimos, arrays

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

__all__ = ["Camera"]


class Camera:
    """A camera: the ray through each pixel of an image.

    The convention is that of OpenCV. A point ``X`` of the world is at ``x = R X + t`` in camera
    space, where x points right, y down and z forward. It projects to ``K x``, in pixels; whole
    numbers are the centres of pixels, and (0, 0) is the centre of the first pixel.

    :param K: (3, 3), focal lengths and principal point in pixels; no skew.
    :param R: (3, 3), the rotation from world to camera space. The default is the identity.
    :param t: (3,), the translation, in units of the scene. The default is zero.
    :param size: width and height of the image in pixels.
    :raises ArgumentError: a shape is wrong, ``K`` is no such matrix, or ``R`` is no rotation.
    """

    __slots__ = ("_camera",)

    def __init__(
        self,
        K: "ArrayLike",
        R: "Optional[ArrayLike]" = None,
        t: "Optional[ArrayLike]" = None,
        *,
        size: Tuple[int, int],
    ) -> None:
        k = arrays.floats(K, "K", (3, 3))
        r = np.eye(3) if R is None else arrays.floats(R, "R", (3, 3))
        translation = np.zeros(3) if t is None else arrays.floats(t, "t", (3,), (3, 1))
        pixels = arrays.size(size, "size")
        if pixels is None:
            raise TypeError("size: expected (width, height), found None")
        self._camera = _feimos.Camera(k.tolist(), r.tolist(), translation.tolist(), pixels)

    @classmethod
    def _of(cls, camera: "_feimos.Camera") -> "Camera":
        made = cls.__new__(cls)
        made._camera = camera
        return made

    @property
    def size(self) -> Tuple[int, int]:
        """Width and height of the image in pixels."""
        return self._camera.size

    @property
    def name(self) -> Optional[str]:
        """The name in a list of cameras, if the camera has one."""
        return self._camera.name

    def rays(self) -> "Tuple[NDArray[np.float64], NDArray[np.float64]]":
        """Rays through the centres of all pixels, for :meth:`Scene.cast`.

        :returns: origins and directions in world space, each of the shape (h, w, 3). Directions
            are not normalized.
        """
        origins, directions = self._camera.rays()
        return origins, directions

    def __repr__(self) -> str:
        width, height = self.size
        name = "" if self.name is None else f"{self.name!r}, "
        return f"<feimos.Camera {name}{width} x {height}>"
