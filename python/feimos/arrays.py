"""Arguments as arrays that the extension takes: of one type, contiguous, and checked."""

from operator import index
from typing import TYPE_CHECKING, Any, Optional, Tuple

import numpy as np

from .errors import ArgumentError

if TYPE_CHECKING:
    from numpy.typing import NDArray


def numbers(values: Any, name: str) -> "NDArray[Any]":
    """``values`` as an array of real numbers of any type and shape.

    :raises TypeError: they are no numbers.
    """
    array = np.asarray(values)
    if array.size and array.dtype.kind not in "fiu":
        raise TypeError(f"{name}: expected real numbers, found {array.dtype}")
    return array


def floats(values: Any, name: str, *shapes: Tuple[int, ...]) -> "NDArray[np.float64]":
    """``values`` as contiguous float64 of one of the ``shapes``; the first one is returned."""
    array = numbers(values, name)
    if array.shape not in shapes:
        raise ArgumentError(f"{name}: expected the shape {shapes[0]}, found {array.shape}")
    array = np.ascontiguousarray(array, dtype=np.float64).reshape(shapes[0])
    if not np.isfinite(array).all():
        raise ArgumentError(f"{name}: expected finite numbers")
    return array


def vectors(values: Any, name: str) -> "NDArray[np.float64]":
    """``values`` as float64 of the shape (..., 3)."""
    array = numbers(values, name)
    if array.ndim == 0 or array.shape[-1] != 3:
        if array.size == 0:
            return np.empty((0, 3))
        raise ArgumentError(f"{name}: expected the shape (..., 3), found {array.shape}")
    return array.astype(np.float64, copy=False)


def points(values: Any) -> "NDArray[np.float32]":
    """``values`` as contiguous float32 of the shape (n, 3), each rounded to the nearest.

    :raises ArgumentError: a finite number is beyond float32, or the shape is wrong.
    """
    array = numbers(values, "points")
    if array.size == 0:
        return np.empty((0, 3), dtype=np.float32)
    if array.ndim != 2 or array.shape[1] != 3:
        raise ArgumentError(f"points: expected the shape (n, 3), found {array.shape}")
    with np.errstate(over="ignore", under="ignore"):
        rounded = np.ascontiguousarray(array, dtype=np.float32)
    lost = np.argwhere(np.isinf(rounded) & np.isfinite(array))
    if len(lost):
        row, column = lost[0]
        value = array[row, column]
        raise ArgumentError(f"points: point {row} has the coordinate {value}, beyond float32")
    return rounded


def triangles(values: Any, count: int) -> "NDArray[np.uint32]":
    """``values`` as contiguous uint32 of the shape (n, 3): numbers of ``count`` points.

    :raises ArgumentError: one is no number of a point, or the shape is wrong.
    """
    array = np.asarray(values)
    if array.size == 0:
        return np.empty((0, 3), dtype=np.uint32)
    if array.dtype.kind not in "iu":
        raise TypeError(f"triangles: expected integers, found {array.dtype}")
    if array.ndim != 2 or array.shape[1] != 3:
        raise ArgumentError(f"triangles: expected the shape (n, 3), found {array.shape}")
    wrong = np.argwhere((array < 0) | (array >= count))
    if len(wrong):
        row, column = wrong[0]
        raise ArgumentError(
            f"triangles: triangle {row} has the index {array[row, column]}, "
            f"but there are {count:,} points, from 0"
        )
    return np.ascontiguousarray(array, dtype=np.uint32)


def size(values: Any, name: str) -> Optional[Tuple[int, int]]:
    """``values`` as width and height in pixels; None stays None."""
    if values is None:
        return None
    try:
        width, height = (index(value) for value in values)
    except ValueError:
        raise ArgumentError(f"{name}: expected (width, height), found {values!r}") from None
    if not (0 < width < 1 << 32 and 0 < height < 1 << 32):
        raise ArgumentError(f"{name}: expected a positive width and height, found {values!r}")
    return width, height
