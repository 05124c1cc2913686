"""Counts what was checked, and tells what was wrong."""

import numpy as np


class Checks:
    def __init__(self):
        self.passed = 0
        self.failed = 0

    def that(self, what, holds, why=""):
        """Whether something holds."""
        if holds:
            self.passed += 1
        else:
            self.failed += 1
            print(f"FAILED  {what}{': ' if why else ''}{why}")

    def equal(self, what, found, expected):
        """Whether two values are the same."""
        self.that(what, found == expected, f"found {found!r}, expected {expected!r}")

    def close(self, what, found, expected, tolerance):
        """Whether no number is off by more than `tolerance`, of numbers below 1 absolutely, of others relatively."""
        found, expected = np.asarray(found, np.float64), np.asarray(expected, np.float64)
        if found.shape != expected.shape:
            self.that(what, False, f"shape {found.shape}, expected {expected.shape}")
            return
        error = np.abs(found - expected) / np.maximum(1, np.abs(expected))
        worst = np.max(error, initial=0) if np.all(np.isfinite(error)) else np.inf
        self.that(what, worst <= tolerance, f"off by {worst}, {tolerance} allowed")

    def same_bits(self, what, found, expected):
        """Whether two arrays have one type, one shape, and the same bits everywhere."""
        kinds = [(array.dtype.newbyteorder("="), array.shape) for array in (found, expected)]
        if kinds[0] != kinds[1]:
            self.that(what, False, f"found {kinds[0]}, expected {kinds[1]}")
            return
        differ = np.argwhere(bits(found) != bits(expected))
        first = tuple(differ[0]) if len(differ) else None
        why = f"{len(differ)} samples differ, first at {first}: {found[first]}, expected {expected[first]}" if len(differ) else ""
        self.that(what, not len(differ), why)


checks = Checks()


def bits(array):
    """The same array as whole numbers, so that every NaN is itself and 0 is not -0."""
    return np.ascontiguousarray(array).astype(array.dtype.newbyteorder("="), copy=False).view(np.uint32)
