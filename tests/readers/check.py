"""Renders small scenes in every format, and compares what readers of others say with each other, bit for bit.

Usage: check.py FEIMOS. The last line counts the checks; the exit code is 1 where one failed.
"""

import json
import math
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import cv2
import numpy as np

import poses
import scenes
import views
from checks import bits, checks
from images import by_openexr, by_openimageio, pfm, png_texts

REPOSITORY = Path(__file__).resolve().parents[2]
WHOLE_NUMBERS = {"id", "prim", "instance", "cost"}
ATTRIBUTES = ["feimos", "screenWindowWidth", "screenWindowCenter", "worldToCamera", "worldToNDC"]
MEANINGS = {"Z", "t", "A", "id", "prim"}


class Renderer:
    def __init__(self, program, folder):
        self.program, self.folder = program, folder

    def __call__(self, scene, name, *flags):
        """Renders to the file `name` and returns its path."""
        path = self.folder / name
        command = [self.program, "render", "-q", str(scene), "-o", str(path), *flags]
        run = subprocess.run(command, capture_output=True, text=True, timeout=120)
        if run.returncode:
            raise RuntimeError(f"{' '.join(command)}: exit {run.returncode}\n{run.stderr}")
        return path

    def exr(self, scene, name, *flags):
        """Renders to an EXR, which both libraries have to read alike, and returns it."""
        path = self(scene, name, *flags)
        image, other = by_openexr(path), by_openimageio(path)
        checks.equal(f"{name}: channels", sorted(other.channels), sorted(image.channels))
        for channel, pixels in image.channels.items():
            expected = np.uint32 if channel in WHOLE_NUMBERS else np.float32
            checks.equal(f"{name}: type of {channel}", pixels.dtype, np.dtype(expected))
            checks.same_bits(f"{name}: {channel} in OpenImageIO and OpenEXR", other.channels[channel], pixels)
        for field in ["film", "window", "compression", "increasing"]:
            checks.equal(f"{name}: {field}", getattr(other, field), getattr(image, field))
        checks.equal(f"{name}: compression and order", (image.compression, image.increasing), ("zips", True))
        for attribute in ATTRIBUTES:
            found, expected = (np.ravel(read.attributes.get(attribute)) for read in [other, image])
            checks.that(f"{name}: {attribute} in OpenImageIO and OpenEXR", np.array_equal(found, expected), f"{found}, {expected}")
        return image


def usual(render):
    """What every EXR holds of which nothing else was said."""
    for scene, width, height in [("sphere", 400, 400), ("instances", 640, 360), ("quadrics", 640, 360)]:
        image = render.exr(REPOSITORY / f"scenes/{scene}.pbrt", f"{scene}.exr")
        checks.equal(f"{scene}: size", image.channels["Z"].shape, (height, width))
        checks.equal(f"{scene}: windows", (image.film, image.window), ((0, 0, width - 1, height - 1),) * 2)
        values(scene, image)
        header(scene, image, {"miss": "inf"})


def values(what, image):
    """What channels say together."""
    checks.equal(f"{what}: channels", sorted(image.channels), sorted(MEANINGS))
    z, t, a, id, prim = (image.channels[name] for name in ["Z", "t", "A", "id", "prim"])
    hit = a == 1
    checks.that(f"{what}: hits and misses", hit.any() and (a[~hit] == 0).all() and (~hit).any())
    checks.that(f"{what}: id and prim are 0 for misses alone", ((id > 0) == hit).all() and ((prim > 0) == hit).all())
    checks.that(f"{what}: misses are infinite", np.isposinf(z[~hit]).all() and np.isposinf(t[~hit]).all())
    checks.that(f"{what}: hits are in front", np.isfinite(t[hit]).all() and (z[hit] > 0).all())
    checks.that(f"{what}: no planar depth beyond its distance", (z[hit] <= t[hit]).all())


def header(what, image, expected):
    """The attribute `feimos`: what it has to say, and no more than docs/images.md says."""
    try:
        found = json.loads(image.attributes["feimos"])
    except (KeyError, ValueError) as error:
        checks.that(f"{what}: header", False, str(error))
        return
    documented = {"version", "scene", "precision", "miss"} | MEANINGS
    checks.equal(f"{what}: keys of the header", sorted(found), sorted(documented | expected.keys()))
    for key, value in expected.items():
        checks.equal(f"{what}: header: {key}", found.get(key), value)


def crops(render):
    """Crops are parts of the whole, and say where they are."""
    scene = REPOSITORY / "scenes/instances.pbrt"
    whole = by_openexr(render(scene, "whole.exr"))
    crop = render.exr(scene, "crop.exr", "--pixelbounds", "100,300,50,250")
    checks.equal("crop: film", crop.film, (0, 0, 639, 359))
    checks.equal("crop: window", crop.window, (100, 50, 299, 249))
    for name, pixels in whole.channels.items():
        checks.same_bits(f"crop: {name}", crop.channels[name], pixels[50:250, 100:300])
    for name in ATTRIBUTES:
        same = np.array_equal(crop.attributes.get(name), whole.attributes.get(name))
        checks.that(f"crop: {name} is that of the whole", same)
    # Ten columns are in neither.
    parts = [render(scene, f"{x}.exr", "--pixelbounds", f"{x},{x + 10},0,20") for x in [0, 20]]
    path = render.folder / "partial.exr"
    subprocess.run([render.program, "merge", "-q", "--partial", *parts, "-o", path], check=True, timeout=60)
    header("partial", by_openexr(path), {"holes": 200})


def misses(render):
    """`--miss`."""
    for text, holds in [
        ("nan", np.isnan),
        ("0", lambda z: bits(z) == 0),
        ("-1.5", lambda z: z == -1.5),
        ("inf", np.isposinf),
    ]:
        image = render.exr(REPOSITORY / "scenes/sphere.pbrt", "miss.exr", "--miss", text)
        missed = image.channels["A"] == 0
        for name in ["Z", "t"]:
            checks.that(f"--miss {text}: {name}", holds(image.channels[name][missed]).all())
        found = json.loads(image.attributes["feimos"])["miss"]
        checks.that(f"--miss {text} in the header", bool(holds(np.float32(found))), repr(found))


def numbers(render):
    """Numbers that no f32 could hold are exact."""
    scene = render.folder / "numbers.pbrt"
    scene.write_text(scenes.numbers_beyond_2_to_24())
    prim = render.exr(scene, "numbers.exr").channels["prim"]
    rows, columns = np.mgrid[: scenes.SIDE, : scenes.SIDE]
    first = (scenes.INSTANCES - 1) * scenes.TRIANGLES + 1
    expected = first + 2 * ((scenes.SIDE - 1 - rows) * scenes.SIDE + columns)
    checks.that("numbers are beyond 2^24", first > 1 << 24)
    checks.same_bits("numbers beyond 2^24", prim, expected.astype(np.uint32))
    array = np.load(render(scene, "numbers.npy", "--aov", "prim"))
    checks.same_bits("numbers beyond 2^24 in NumPy", array, prim)


def cameras(render):
    """Attributes of the view: a point of the world, as a row, times the matrix."""
    orthographic, perspective = render.folder / "orthographic.pbrt", render.folder / "perspective.pbrt"
    orthographic.write_text(scenes.ORTHOGRAPHIC)
    perspective.write_text(scenes.PERSPECTIVE)
    tangent = math.tan(math.radians(50 / 2))
    for scene, window in [
        (orthographic, [-2.5, 1.5, -1, 2]),
        (perspective, [tangent * x for x in [-1.2, 0.8, -0.5, 1]]),
    ]:
        x0, x1, y0, y1 = window
        image = render.exr(scene, f"{scene.stem}.exr", "--aov", "Z,t,A,id,prim,P")
        attributes = image.attributes
        checks.close(f"{scene.stem}: screenWindowWidth", attributes["screenWindowWidth"], x1 - x0, 1e-6)
        checks.close(f"{scene.stem}: screenWindowCenter", attributes["screenWindowCenter"], [(x0 + x1) / 2, (y0 + y1) / 2], 1e-6)
        aspect = (x1 - x0) / 64 / ((y1 - y0) / 48)
        checks.close(f"{scene.stem}: pixelAspectRatio", attributes["pixelAspectRatio"], aspect, 1e-6)
        projections(scene.stem, image)


def projections(what, image):
    """Points of hits go where the matrices say, and pixels come from there."""
    hit = image.channels["A"] == 1
    z, t = (image.channels[name][hit].astype(np.float64) for name in ["Z", "t"])
    points = np.stack([image.channels[f"P.{axis}"][hit] for axis in "XYZ"], axis=1).astype(np.float64)
    camera, film = (np.asarray(image.attributes[name], np.float64).reshape(4, 4) for name in ["worldToCamera", "worldToNDC"])
    depth = z if what == "orthographic" else 1 / z
    height, width = hit.shape
    rows, columns = np.nonzero(hit)
    in_film = np.stack([(columns + 0.5) / width, (rows + 0.5) / height, depth], axis=1)

    from_pixels = transformed(in_film, np.linalg.inv(film))
    checks.close(f"{what}: worldToCamera gives Z of pixels", transformed(from_pixels, camera)[:, 2], z, 1e-5)
    if what == "perspective":
        eye = np.linalg.inv(camera)[3, :3]
        checks.close(f"{what}: pixels are t away from the eye", np.linalg.norm(from_pixels - eye, axis=1), t, 1e-5)
    on_ball = image.channels["id"][hit] == 1
    checks.close(f"{what}: pixels are on the sphere", np.linalg.norm(from_pixels[on_ball], axis=1), np.full(on_ball.sum(), 0.8), 1e-5)

    checks.close(f"{what}: P is where pixels come from", points, from_pixels, 1e-5)
    checks.close(f"{what}: worldToCamera gives Z of P", transformed(points, camera)[:, 2], z, 1e-5)
    checks.close(f"{what}: worldToNDC gives the pixel and the depth of P", transformed(points, film), in_film, 1e-5)


def transformed(points, matrix):
    """Points as rows, each with a 1 behind it, times the matrix, and back."""
    rows = np.hstack([points, np.ones((len(points), 1))]) @ matrix
    return rows[:, :3] / rows[:, 3:]


def opencv_depth(render):
    """Depth for programs that know colours alone."""
    scene = REPOSITORY / "scenes/instances.pbrt"
    z = by_openexr(render(scene, "whole.exr")).channels["Z"]
    for name, aovs in [("Y", "Z"), ("Y", "Z,id,prim"), ("R", "Z"), ("R", "Z,t,id")]:
        image = render.exr(scene, "renamed.exr", "--depth-channel", name, "--aov", aovs)
        checks.that(f"--depth-channel {name}: channels", name in image.channels and "Z" not in image.channels)
        checks.same_bits(f"--depth-channel {name} --aov {aovs}: OpenEXR", image.channels[name], z)
        found = cv2.imread(str(render.folder / "renamed.exr"), cv2.IMREAD_UNCHANGED)
        # OpenCV makes blue, green and red of a lone red.
        found = found if name == "Y" else found[:, :, 2]
        checks.same_bits(f"--depth-channel {name} --aov {aovs}: OpenCV", found, z)
        told = json.loads(image.attributes["feimos"]).get("depth_channel")
        checks.equal(f"--depth-channel {name}: header", told, name)


def pngs(render):
    """Pictures: colours of hits, depths of 16 bits, texts."""
    scene = REPOSITORY / "scenes/instances.pbrt"
    whole = by_openexr(render(scene, "whole.exr")).channels
    hit = whole["A"] == 1
    for scale in ["1000", "256.5"]:
        path = render(scene, "depth16.png", "--view", "depth16", "--scale", scale)
        depths = cv2.imread(str(path), cv2.IMREAD_UNCHANGED)
        expected = np.where(hit, np.rint(np.where(hit, whole["Z"], 0).astype(np.float64) * float(scale)), 0)
        checks.equal("depth16: type", depths.dtype, np.dtype(np.uint16))
        checks.that(f"depth16: depths by {scale}", np.array_equal(depths, expected.astype(np.uint16)))
        told = json.loads(png_texts(path)["feimos"])
        checks.equal("depth16: scale and view in the header", (told.get("scale"), told.get("view")), (float(scale), "depth16"))
    colors = cv2.imread(str(render(scene, "hit.png", "--view", "hit")), cv2.IMREAD_UNCHANGED)
    expected = np.where(hit[:, :, None], [0, 0, 255], [0, 255, 255]).astype(np.uint8)
    checks.that("hit: red hits, yellow misses", np.array_equal(colors, expected))
    for view in ["depth", "normal", "id", "cost"]:
        path = render(scene, "view.png", "--view", view)
        colors = cv2.imread(str(path), cv2.IMREAD_UNCHANGED)
        checks.equal(f"{view}: size and type", (colors.shape, colors.dtype), ((360, 640, 3), np.dtype(np.uint8)))
        missed, seen = (len(np.unique(colors[part], axis=0)) for part in [~hit, hit])
        checks.that(f"{view}: one colour for misses, but of costs", missed == 1 or view == "cost", f"{missed}")
        ids = len(np.unique(whole["id"][hit]))
        checks.that(f"{view}: colours of hits", seen == ids if view == "id" else seen > 5, f"{seen}")
        texts = png_texts(path)
        checks.that(f"{view}: texts", texts.get("Software", "").startswith("feimos") and "Description" in texts, str(texts))
        checks.equal(f"{view}: header", json.loads(texts["feimos"]).get("view"), view)


def arrays(render):
    """NumPy's arrays and PFM beside the EXR."""
    scene = REPOSITORY / "scenes/instances.pbrt"
    all_aovs = "Z,t,A,id,prim,instance,N,P,uv,cost"
    exr = render.exr(scene, "all.exr", "--aov", all_aovs).channels
    parts = {"N": ["N.X", "N.Y", "N.Z"], "P": ["P.X", "P.Y", "P.Z"], "uv": ["u", "v"]}
    structured = np.load(render(scene, "all.npy", "--aov", all_aovs))
    checks.equal("npy: fields", list(structured.dtype.names), all_aovs.split(","))
    for aov in all_aovs.split(","):
        names = parts.get(aov, [aov])
        expected = exr[aov] if len(names) == 1 else np.stack([exr[name] for name in names], axis=2)
        checks.same_bits(f"npy: {aov} of all", structured[aov], expected)
        checks.same_bits(f"npy: {aov} alone", np.load(render(scene, "one.npy", "--aov", aov)), expected)
        if aov in WHOLE_NUMBERS or aov == "uv":
            continue
        path = render(scene, "one.pfm", "--aov", aov)
        checks.same_bits(f"pfm: {aov}", pfm(path), expected)
        by_opencv = cv2.imread(str(path), cv2.IMREAD_UNCHANGED)
        # OpenCV has blue first.
        by_opencv = by_opencv if by_opencv.ndim == 2 else by_opencv[:, :, ::-1]
        checks.same_bits(f"pfm: {aov} in OpenCV", by_opencv, expected)
    crop = np.load(render(scene, "crop.npy", "--aov", "Z", "--pixelbounds", "100,300,50,250"))
    checks.same_bits("npy: a crop", crop, exr["Z"][50:250, 100:300])


def lists_of_cameras(render):
    """One camera in three formats: the same depths, and they lie on the surface."""
    scene = render.folder / "poses.pbrt"
    scene.write_text(poses.SCENE)
    lists = poses.write_all(render.folder)
    for name, path in lists.items():
        (render.folder / name).mkdir()
        render(scene, f"{name}/{{camera}}.npy", "--cameras", str(path))
    hits = 0
    for number, (rotation, translation) in enumerate(poses.poses()):
        z = [np.load(render.folder / name / f"view_{number:02}.npy") for name in lists]
        for name, found in zip(lists, z):
            checks.same_bits(f"camera {number}: {name}", found, z[0])
        points = poses.unprojected(z[0], rotation, translation)
        hits += len(points)
        off = poses.distance_to_surface(points)
        checks.that(f"camera {number}: points are on the surface", np.max(off) < 3e-6, f"off by {np.max(off)}")
    checks.that("the cameras see something", hits > 5000, f"{hits} hits")


def lenses(render):
    """OpenCV projects points of hits to the centres of their pixels."""
    scene = render.folder / "poses.pbrt"
    scene.write_text(poses.SCENE)
    rotation, translation = next(poses.poses())
    camera = {"K": poses.K.tolist(), "R": rotation.tolist(), "t": translation.tolist(), "resolution": [poses.WIDTH, poses.HEIGHT]}
    seen = []
    for lens, (model, coefficients) in poses.LENSES.items():
        path = render.folder / f"{lens}.json"
        path.write_text(json.dumps({**camera, model: coefficients} if coefficients else camera))
        image = render.exr(scene, f"{lens}.exr", "--cameras", str(path), "--aov", "Z,t,A,id,prim,P")
        hit = image.channels["A"] == 1
        points = np.stack([image.channels[f"P.{axis}"][hit] for axis in "XYZ"], axis=1).astype(np.float64)
        rows, columns = np.nonzero(hit)
        found = poses.projected(points, lens, rotation, translation)
        off = np.max(np.abs(found - np.stack([columns, rows], axis=1)))
        checks.that(f"{lens}: points are where OpenCV projects them", off < 1e-4, f"off by {off} pixels")
        depth = (points @ rotation.T + translation)[:, 2]
        if model != "fisheye":
            checks.close(f"{lens}: Z is the depth", image.channels["Z"][hit], depth, 1e-5)
        checks.that(f"{lens}: hits", len(points) > 200, f"{len(points)}")
        seen.append(points)
    checks.that("lenses differ", len({points.tobytes() for points in seen}) == len(seen))


def main():
    program = os.path.abspath(sys.argv[1])
    with tempfile.TemporaryDirectory() as folder:
        render = Renderer(program, Path(folder))
        ours = [usual, crops, misses, numbers, cameras, opencv_depth, pngs, arrays, lists_of_cameras, lenses]
        for check in ours + [views.data, views.conventions, views.pictures, views.several]:
            try:
                check(render)
            except Exception as error:
                # The other checks can still tell something.
                checks.that(check.__name__, False, f"{type(error).__name__}: {error}")
    print(f"readers: {checks.passed} passed, {checks.failed} failed")
    return 1 if checks.failed or not checks.passed else 0


if __name__ == "__main__":
    sys.exit(main())
