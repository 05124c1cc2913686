"""Checks exact depths of feimos by fractions, for random pixels of each view, without its code."""

from fractions import Fraction

import numpy as np

from programs import feimos, rays_of
from views import VIEWS

PIXELS = 2000


def fractions(vector):
    return [Fraction(float(value)) for value in vector]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3)]


def minus(a, b):
    return [x - y for x, y in zip(a, b)]


def hit_of(origin, direction, corners):
    """The parameter of the ray at the plane of the triangle, and the least barycentric coordinate."""
    a, b, c = corners
    normal = cross(minus(b, a), minus(c, a))
    t = dot(minus(a, origin), normal) / dot(direction, normal)
    point = [o + t * d for o, d in zip(origin, direction)]
    sides = [
        dot(cross(minus(end, start), minus(point, start)), normal)
        for start, end in ((a, b), (b, c), (c, a))
    ]
    return t, min(sides) / dot(normal, normal)


def main():
    random = np.random.default_rng(1)
    for name, make in VIEWS.items():
        view = make()
        depth, prim = feimos(view)
        origin, directions = rays_of(view)
        rows, columns = np.nonzero(np.isfinite(depth))
        worst, outside = 0, 0
        for pick in random.integers(0, len(rows), PIXELS):
            row, column = rows[pick], columns[pick]
            corners = view.points[view.triangles[prim[row, column]]]
            ray = fractions(origin), fractions(directions[row, column])
            t, least = hit_of(*ray, [fractions(corner) for corner in corners])
            found = depth[row, column]
            error = abs(Fraction(float(found)) - t) / Fraction(float(np.spacing(found)))
            worst, outside = max(worst, float(error)), min(outside, float(least))
        print(
            f"{name}: depths of {PIXELS:,} pixels within {worst:.9f} ulps of the fraction, "
            f"points at most {-outside:.1e} outside of the triangle"
        )


if __name__ == "__main__":
    main()
