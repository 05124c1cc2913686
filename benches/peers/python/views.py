"""Meshes and cameras that the programs render, in OpenCV's convention."""

import gzip
import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

REPOSITORY = Path(__file__).resolve().parents[3]


@dataclass
class View:
    """Triangles, and a camera: `x_camera = R x_world + t`, `K` in pixels, width and height.

    Whole numbers are pixel centres.
    """

    points: np.ndarray
    triangles: np.ndarray
    K: np.ndarray
    R: np.ndarray
    t: np.ndarray
    size: tuple


def turn(axis, degrees):
    """The rotation by an angle around an axis, in f64."""
    x, y, z = np.asarray(axis, float) / np.linalg.norm(axis)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    angle = math.radians(degrees)
    return np.eye(3) + math.sin(angle) * cross + (1 - math.cos(angle)) * cross @ cross


def grid(heights):
    """Two triangles for each cell of a grid of heights; columns are x, rows are y."""
    rows, columns = heights.shape
    y, x = np.mgrid[:rows, :columns]
    points = np.stack([x, y, heights], -1).reshape(-1, 3).astype(float)
    corner = np.arange(rows * columns).reshape(rows, columns)
    a, b, c, d = corner[:-1, :-1], corner[:-1, 1:], corner[1:, 1:], corner[1:, :-1]
    triangles = np.stack([a, b, c, a, c, d], -1).reshape(-1, 3)
    return points, triangles.astype(np.uint32)


def intrinsics(f, size):
    return np.array([[f, 0, (size[0] - 1) / 2], [0, f, (size[1] - 1) / 2], [0, 0, 1]])


def wall():
    """A wall of 512 x 512 cells whose corners are under pixel centres; no number is rounded."""
    points, triangles = grid(np.zeros((513, 513)))
    points += [-256, -256, 64]
    K = np.array([[64.0, 0, 255], [0, 64, 255], [0, 0, 1]])
    return View(points.astype(np.float32), triangles, K, np.eye(3), np.zeros(3), (511, 511))


def turned_wall():
    """The same wall and camera, turned: corners are almost, not exactly, under pixel centres."""
    view = wall()
    world = turn([1, 2, 3], 30)
    view.points = (view.points.astype(float) @ world.T).astype(np.float32)
    view.R = world.T
    return view


def terrain():
    """Hills in map coordinates, a grid of 10 m, from 800 m above: far from the origin."""
    random = np.random.default_rng(7)
    points, triangles = grid(np.zeros((401, 401)))
    phase = random.uniform(0, 6.28, 2)
    points[:, 2] = 20 * np.sin(points[:, 0] / 9 + phase[0]) * np.cos(points[:, 1] / 7 + phase[1])
    place = np.array([500_000.0, 5_400_000.0, 0])
    points = points * [10, 10, 1] + place
    eye = place + [2000.37, 1500.37, 800.37]
    R = turn([1, 0, 0], 150)
    size = (1280, 720)
    return View(points.astype(np.float32), triangles, intrinsics(900, size), R, -R @ eye, size)


def dragon(size=(1920, 1080)):
    """The Stanford dragon of `scenes`, 871,414 triangles, filling the film."""
    path = REPOSITORY / "scenes" / "dragon_vrip.ply.gz"
    with gzip.open(path, "rt") as file:
        header = list(iter(lambda: file.readline().strip(), "end_header"))
        counts = [int(line.split()[2]) for line in header if line.startswith("element")]
        vertices = counts[0]
        numbers = np.array(file.read().split(), float)
    points = numbers[: 3 * vertices].reshape(-1, 3)
    triangles = numbers[3 * vertices :].reshape(-1, 4)[:, 1:]
    R = np.diag([1.0, -1, -1])
    eye = np.array([-0.005, 0.125, 0.18])
    f = size[1] / 2 / math.tan(math.radians(20))
    K = intrinsics(f, size)
    return View(points.astype(np.float32), triangles.astype(np.uint32), K, R, -R @ eye, size)


VIEWS = {"wall": wall, "turned wall": turned_wall, "terrain": terrain, "dragon": dragon}
