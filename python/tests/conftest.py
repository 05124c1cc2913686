"""What the tests share: scenes, and runs of the program that the wheel has installed."""

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Callable, List

import numpy as np
import pytest

SCENES = Path(__file__).resolve().parents[2] / "scenes"
PROGRAM = Path(sys.executable).parent / ("feimos.exe" if os.name == "nt" else "feimos")

# An octahedron: points and triangles.
POINTS = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]]
TRIANGLES = [
    [0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5],
]


def run(*arguments: object, **options: object) -> "subprocess.CompletedProcess[str]":
    """Runs the program."""
    command = [str(PROGRAM), *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, timeout=120, **options)


@pytest.fixture
def program() -> Callable[..., "subprocess.CompletedProcess[str]"]:
    return run


@pytest.fixture
def ply(tmp_path: Path) -> Path:
    """The octahedron as a file."""
    lines = ["ply", "format ascii 1.0", f"element vertex {len(POINTS)}"]
    lines += [f"property float {axis}" for axis in "xyz"]
    lines += [f"element face {len(TRIANGLES)}", "property list uchar int vertex_indices"]
    lines += ["end_header"]
    lines += [" ".join(map(str, point)) for point in POINTS]
    lines += ["3 " + " ".join(map(str, triangle)) for triangle in TRIANGLES]
    path = tmp_path / "octahedron.ply"
    path.write_text("\n".join(lines) + "\n")
    return path


def rotation(seed: int) -> np.ndarray:
    """A random rotation."""
    q, _ = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))
    return q * np.sign(np.linalg.det(q))


def poses(count: int) -> List[dict]:
    """Cameras around the origin, four units away, as in a list of cameras."""
    return [
        {
            "name": f"pose-{number}",
            "K": [[60.5, 0, 31.25], [0, 61, 23], [0, 0, 1]],
            "R": rotation(number).tolist(),
            "t": [0.1, -0.2, 4],
            "resolution": [64, 48],
        }
        for number in range(count)
    ]


@pytest.fixture
def pose_list(tmp_path: Path) -> Path:
    """A list of cameras in a file."""
    path = tmp_path / "poses.json"
    path.write_text(json.dumps(poses(3)))
    return path


def same(left: np.ndarray, right: np.ndarray) -> bool:
    """Whether two arrays have the same type, shape and bytes."""
    return (
        left.dtype == right.dtype
        and left.shape == right.shape
        and left.tobytes() == right.tobytes()
    )
