"""Measures 100 views of a scene: by the program with a list of cameras, and by a loop in Python.

Usage: poses.py [SCENE] [--program FEIMOS] [--size 640x480] [--runs 5]

Both read the scene and save all depth images as .npy; the loop is also measured without saving.
Prints the median of the runs, which alternate.
"""

import argparse
import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from statistics import median

import numpy as np

import feimos

POSES = 100


def poses(scene: feimos.Scene, width: int, height: int) -> list:
    """Cameras on a circle around the scene, which look at its middle."""
    low, high = scene.bounds
    middle, radius = (low + high) / 2, np.linalg.norm(high - low) / 2
    focal = 1.2 * width
    k = [[focal, 0, (width - 1) / 2], [0, focal, (height - 1) / 2], [0, 0, 1]]
    views = []
    for number in range(POSES):
        angle = 2 * np.pi * number / POSES
        forward = np.array([np.sin(angle), -0.3, np.cos(angle)])
        forward /= np.linalg.norm(forward)
        right = np.cross(forward, [0, 1, 0])
        right /= np.linalg.norm(right)
        r = np.array([right, np.cross(forward, right), forward])
        eye = middle - 3 * radius * forward
        view = {"name": f"{number:03}", "K": k, "R": r.tolist(), "t": (-r @ eye).tolist()}
        views.append({**view, "resolution": [width, height]})
    return views


def by_program(program: str, scene: str, cameras: Path, folder: Path) -> float:
    begin = time.perf_counter()
    output = folder / "p{camera}.npy"
    command = [program, "render", "-q", scene, "--cameras", cameras, "-o", output, "--force"]
    subprocess.run(command, check=True)
    return time.perf_counter() - begin


def by_loop(path: str, views: list, folder: "Path | None") -> float:
    begin = time.perf_counter()
    scene = feimos.load(path)
    for view in views:
        depth = scene.render(view["K"], view["R"], view["t"], view["resolution"])["Z"]
        if folder:
            np.save(folder / f"l{view['name']}.npy", depth)
    return time.perf_counter() - begin


def main() -> None:
    scenes = Path(__file__).resolve().parents[2] / "scenes"
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("scene", nargs="?", default=str(scenes / "dragon.pbrt"))
    parser.add_argument("--program", default=str(Path(sys.executable).parent / "feimos"))
    parser.add_argument("--size", default="640x480")
    parser.add_argument("--runs", type=int, default=5)
    options = parser.parse_args()
    width, height = map(int, options.size.split("x"))
    views = poses(feimos.load(options.scene), width, height)
    times = {"program": [], "loop that saves": [], "loop": []}
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        cameras = folder / "poses.json"
        cameras.write_text(json.dumps(views))
        for _ in range(options.runs):
            times["program"].append(by_program(options.program, options.scene, cameras, folder))
            times["loop that saves"].append(by_loop(options.scene, views, folder))
            times["loop"].append(by_loop(options.scene, views, None))
        for view in views:
            left, right = (folder / f"{side}{view['name']}.npy" for side in "pl")
            assert left.read_bytes() == right.read_bytes(), view["name"]
    for way, seconds in times.items():
        print(f"{way:16} {median(seconds):7.3f} s   ({min(seconds):.3f} to {max(seconds):.3f})")


if __name__ == "__main__":
    main()
