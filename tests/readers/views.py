"""Views for programs and for people, and several files of one trace, as OpenCV, NumPy and OpenEXR read them."""

import json
import subprocess
from pathlib import Path

import cv2
import numpy as np

from checks import checks
from images import by_openexr, pfm, png_texts

SCENES = Path(__file__).resolve().parents[2] / "scenes"
SCENE = SCENES / "instances.pbrt"


def read(path):
    """The pixels as they are stored: of colours, blue comes first."""
    return cv2.imread(str(path), cv2.IMREAD_UNCHANGED)


def data(render):
    """Masks and numbers are those of the EXR."""
    exr = by_openexr(render(SCENE, "data.exr", "--aov", "A,id,instance")).channels
    mask = read(render(SCENE, "mask.png", "--view", "mask"))
    expected = np.where(exr["A"] == 1, 255, 0).astype(np.uint8)
    checks.equal("mask: type", mask.dtype, np.dtype(np.uint8))
    checks.that("mask: 255 for hits", np.array_equal(mask, expected))
    for view, name in [("id16", "id"), ("instance16", "instance")]:
        path = render(SCENE, f"{view}.png", "--view", view)
        numbers = read(path)
        checks.equal(f"{view}: type", numbers.dtype, np.dtype(np.uint16))
        checks.that(f"{view}: numbers", np.array_equal(numbers, exr[name]) and numbers.max() > 1)
        checks.equal(f"{view}: header", json.loads(png_texts(path)["feimos"])["view"], view)


def conventions(render):
    """Depths as data sets store them."""
    scene = SCENES / "sphere.pbrt"
    exr = by_openexr(render(scene, "z.exr", "--aov", "Z,A")).channels
    hit = exr["A"] == 1
    metres = np.where(hit, exr["Z"], 0).astype(np.float64)
    for name, scale in [("tum", 5000), ("kitti", 256), ("scannet", 1000)]:
        depths = read(render(scene, f"{name}.png", "--view", "depth16", "--scale", name))
        error = np.abs(depths / scale - metres).max()
        checks.that(f"--scale {name}: depths", error <= 0.5001 / scale, f"off by {error}")
        checks.that(f"--scale {name}: 0 is no depth", np.array_equal(depths > 0, hit))


def pictures(render):
    """Backgrounds and legends change no pixel of a hit."""
    hit = by_openexr(render(SCENE, "a.exr", "--aov", "A")).channels["A"] == 1
    for view in ["depth", "shaded", "hit", "normal", "id", "prim", "instance"]:
        usual = read(render(SCENE, "usual.png", "--view", view))
        clear = read(render(SCENE, "clear.png", "--view", view, "--background", "transparent"))
        checks.equal(f"{view}: shape with alpha", clear.shape, (*usual.shape[:2], 4))
        checks.that(f"{view}: alpha", np.array_equal(clear[:, :, 3], np.where(hit, 255, 0)))
        checks.that(f"{view}: hits with alpha", np.array_equal(clear[hit, :3], usual[hit]))
        orange = read(render(SCENE, "orange.png", "--view", view, "--background", "ff8000"))
        checks.that(f"{view}: background", (orange[~hit] == [0, 128, 255]).all())
        checks.that(f"{view}: hits before it", np.array_equal(orange[hit], usual[hit]))
    for view in ["depth", "shaded", "cost"]:
        usual = read(render(SCENE, "usual.png", "--view", view))
        legend = read(render(SCENE, "legend.png", "--view", view, "--legend"))
        width = usual.shape[1]
        checks.that(f"{view}: picture beside a legend", np.array_equal(legend[:, :width], usual))
        checks.that(f"{view}: legend", len(np.unique(legend[:, width:].reshape(-1, 3), axis=0)) > 100)


def several(render):
    """Files of one trace are those of traces of their own."""
    outputs = {"s.exr": [], "s.npy": [], "s.pfm": [], "s1.png": ["--view", "depth16"], "s2.png": ["--view", "mask"]}
    paths = {name: render.folder / name for name in outputs}
    command = [render.program, "render", "-q", str(SCENE), "--view", "depth16,mask"]
    for path in paths.values():
        command += ["-o", str(path)]
    subprocess.run(command, check=True, timeout=60)
    for name, flags in outputs.items():
        alone = render(SCENE, f"alone-{name}", *flags)
        checks.that(f"several outputs: {name}", paths[name].read_bytes() == alone.read_bytes())
    z = by_openexr(paths["s.exr"]).channels["Z"]
    checks.same_bits("several outputs: npy", np.load(paths["s.npy"]), z)
    checks.same_bits("several outputs: pfm", pfm(paths["s.pfm"]), z)
