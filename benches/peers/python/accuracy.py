"""Counts wrong decisions and errors of depths of each program, against exact pictures of feimos."""

import subprocess
import sys

import numpy as np

from programs import PROGRAMS, feimos
from views import VIEWS


def ulps(a, b):
    """Differences of positive f32 in units in the last place."""
    return np.abs(a.view(np.int32).astype(np.int64) - b.view(np.int32))


def row(name, program, truth, found):
    (depth, prim), (expected, expected_prim) = found, truth
    hit, expected_hit = np.isfinite(depth), np.isfinite(expected)
    missed, false = (expected_hit & ~hit).sum(), (hit & ~expected_hit).sum()
    both = hit & expected_hit
    same = both if prim is None else both & (prim == expected_prim)
    other = "-" if prim is None else f"{(both & ~same).sum():,}"
    error = ulps(depth[same].astype(np.float32), expected[same])
    worst, high = (error.max(), np.percentile(error, 99)) if error.size else (0, 0)
    wrong = (error > 0).sum()
    print(
        f"| {name} | {program} | {missed:,} | {false:,} | {other} | {wrong:,} "
        f"| {high:.0f} | {worst:,} |",
        flush=True,
    )


def main():
    if len(sys.argv) == 3:
        name, program = sys.argv[1:]
        view = VIEWS[name]()
        row(name, program, feimos(view), PROGRAMS[program](view))
        return
    print("| view | program | missed | false | other prim | depths wrong | 99 % ulps | max ulps |")
    print("|---|---|---|---|---|---|---|---|", flush=True)
    for name in VIEWS:
        for program in PROGRAMS:
            subprocess.run([sys.executable, __file__, name, program], check=True)


if __name__ == "__main__":
    main()
