"""Makes docs/overview.png: `FEIMOS=target/release/feimos python docs/overview.py`.

Needs NumPy and Pillow.
"""

import os
import subprocess
import tempfile
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw, ImageFont

DOCS = Path(__file__).resolve().parent
SCENES = DOCS.parent / "scenes"
PROGRAM = os.path.abspath(os.environ["FEIMOS"]) if "FEIMOS" in os.environ else "feimos"
WIDTH, HEIGHT, CAPTION, GAP = 400, 280, 26, 8
SIZE = ("--resolution", f"{WIDTH}x{HEIGHT}")
BACKGROUND = (244, 246, 248)
EYE = np.array([-0.1, 0.35, 3.6])
# The first Scale undoes the mirror of pbrt's left-handed camera.
SCENE = f"""Scale -1 1 1
LookAt {EYE[0]} {EYE[1]} {EYE[2]}  -0.1 -0.05 0  0 1 0
Camera "perspective" "float fov" 52
Film "image" "integer xresolution" {WIDTH} "integer yresolution" {HEIGHT}
WorldBegin
Translate 0 -2.5 0
Scale 20 20 20
Shape "plymesh" "string filename" "{SCENES}/dragon_vrip.ply.gz"
"""


def render(scene, output, *flags):
    command = [PROGRAM, "render", scene, "-o", output, "--force", "--quiet", *flags]
    subprocess.run(command, check=True)
    if output.endswith(".npy"):
        return np.load(output)
    return np.array(Image.open(output).convert("RGB"))


def picture(scene, view, *flags):
    """A view on the background of the panels."""
    colours = render(scene, "view.png", "--view", view, *flags)
    mask = render(scene, "mask.png", "--view", "mask", *flags)[..., 0]
    colours[mask == 0] = BACKGROUND
    return colours


def surface(hits):
    """The surface in gray, lit from the eye and from the upper right."""
    normal = hits["N"]
    view = EYE - hits["P"]
    view /= np.linalg.norm(view, axis=-1, keepdims=True)
    lamp = np.array([0.5, 0.7, 0.6]) / np.linalg.norm([0.5, 0.7, 0.6])
    light = 0.08 + 0.35 * abs((normal * view).sum(-1)) + 0.6 * np.clip(normal @ lamp, 0, 1)
    gray = np.clip(light, 0, 1)[..., None] * [225, 222, 215]
    return np.where(np.isfinite(hits["Z"])[..., None], gray, BACKGROUND).astype(np.uint8)


def points_from_the_side(hits, colours):
    """The points as a camera to the right sees them, near ones over far ones."""
    hit = np.isfinite(hits["Z"])
    points, colours = hits["P"][hit][::2], colours[hit][::2]
    a, b = np.radians(62), 0.25
    aside = [[np.cos(a), 0, -np.sin(a)], [0, 1, 0], [np.sin(a), 0, np.cos(a)]]
    above = [[1, 0, 0], [0, np.cos(b), -np.sin(b)], [0, np.sin(b), np.cos(b)]]
    x, y, z = ((points - points.mean(0)) @ (np.array(above) @ aside).T).T
    far_first = np.argsort(z)
    columns = (WIDTH / 2 + 520 * x / (6.6 - z)).round().astype(int)[far_first]
    rows = (HEIGHT / 2 - 520 * y / (6.6 - z)).round().astype(int)[far_first]
    seen = (columns >= 0) & (columns < WIDTH) & (rows >= 0) & (rows < HEIGHT)
    panel = np.full((HEIGHT, WIDTH, 3), BACKGROUND, np.uint8)
    panel[rows[seen], columns[seen]] = colours[far_first][seen]
    return panel


def panels():
    Path("dragon.pbrt").write_text(SCENE)
    scene, fine = "dragon.pbrt", ("--resolution", "600x420")
    hits = render(scene, "hits.npy", "--aov", "Z,N,P")
    yield "a mesh or a PBRT scene, and a camera", surface(hits)
    yield "Z: depth    (t: distance)", picture(scene, "depth")
    points = render(scene, "points.npy", "--aov", "Z,P", *fine)
    yield "P: points, here seen from the side", points_from_the_side(
        points, picture(scene, "depth", *fine)
    )
    yield "N: normals", picture(scene, "normal")
    part = ("--resolution", "9000x6300", "--pixelbounds", "2662,3062,2240,2520")
    yield "prim: the triangle, here enlarged", picture(scene, "prim", *part)
    trees = render(f"{SCENES}/instances.pbrt", "trees.png", "--view", "instance", *SIZE)
    trees[(trees == 0).all(-1)] = BACKGROUND
    yield "id, instance: what was hit", trees


def main():
    sheet = Image.new("RGB", (3 * WIDTH + 4 * GAP, 2 * (HEIGHT + CAPTION) + 3 * GAP), "white")
    draw, font = ImageDraw.Draw(sheet), ImageFont.load_default(size=16)
    for number, (caption, panel) in enumerate(panels()):
        row, column = divmod(number, 3)
        x, y = GAP + column * (WIDTH + GAP), GAP + row * (HEIGHT + CAPTION + GAP)
        sheet.paste(Image.fromarray(panel), (x, y))
        draw.text((x + 4, y + HEIGHT + 3), caption, fill=(40, 40, 40), font=font)
    palette = sheet.quantize(192, method=Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE)
    palette.save(DOCS / "overview.png", optimize=True)


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        main()
