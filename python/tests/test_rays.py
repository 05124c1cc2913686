"""Rays: the hits of images, and arrays of any shape."""

import numpy as np
import pytest

import feimos
from conftest import POINTS, SCENES, TRIANGLES, same

NAMES = ["t", "distance", "prim", "id", "instance", "N", "P", "uv"]


@pytest.mark.parametrize("name", ["sphere", "quadrics", "instances", "triangles"])
def test_rays_of_pixels_hit_what_the_image_shows(name):
    scene = feimos.load(SCENES / f"{name}.pbrt", resolution=(60, 40))
    image = scene.render(channels=("Z", "t", "prim", "id", "instance", "N", "P", "uv"))
    hits = scene.cast(*scene.camera.rays())
    assert sorted(hits) == sorted(NAMES)
    assert np.isfinite(hits["t"]).any()
    assert same(hits["t"], image["Z"])
    assert same(hits["distance"], image["t"])
    for channel in ("prim", "id", "instance", "N", "P", "uv"):
        assert same(hits[channel], image[channel]), channel


def test_few_rays_and_many_have_the_same_hits():
    scene = feimos.load(SCENES / "quadrics.pbrt", resolution=(50, 50))
    origins, directions = (part.reshape(-1, 3) for part in scene.camera.rays())
    many = scene.cast(origins, directions)
    for start in range(0, 2500, 50):
        few = scene.cast(origins[start : start + 50], directions[start : start + 50])
        assert all(same(few[name], many[name][start : start + 50]) for name in NAMES)


def test_more_rays_than_a_block():
    scene = feimos.mesh(POINTS, TRIANGLES)
    count = 200_003
    origins = np.random.default_rng(1).uniform(-1.2, 1.2, size=(count, 3))
    origins[:, 2] = -5
    hits = scene.cast(origins, [0, 0, 1])
    expected = 4 + np.abs(origins[:, 0]) + np.abs(origins[:, 1])
    inside = expected < 5
    assert np.array_equal(np.isfinite(hits["t"]), inside)
    assert np.allclose(hits["t"][inside], expected[inside])


def test_shapes_are_broadcast():
    scene = feimos.mesh(POINTS, TRIANGLES)
    one = scene.cast([0.25, 0.25, -2], [0, 0, 2])
    assert one["t"].shape == () and one["N"].shape == (3,) and one["uv"].shape == (2,)
    assert one["t"] == 0.75 and one["distance"] == 1.5 and one["id"] == 1
    assert np.allclose(one["P"], [0.25, 0.25, -0.5])
    assert np.allclose(np.abs(one["N"]), 3**-0.5)
    row = scene.cast([0.25, 0.25, -2], np.zeros((4, 3)) + [0, 0, 2])
    grid = scene.cast(np.zeros((5, 1, 3)) + [0.25, 0.25, -2], np.zeros((4, 3)) + [0, 0, 2])
    assert row["t"].shape == (4,) and grid["P"].shape == (5, 4, 3)
    assert (row["t"] == 0.75).all() and (grid["prim"] == one["prim"]).all()
    none = scene.cast(np.empty((0, 3)), [0, 0, 1])
    assert none["t"].shape == (0,) and none["N"].shape == (0, 3)


def test_misses():
    scene = feimos.mesh(POINTS, TRIANGLES)
    origins = [[9, 9, 9], [0, 0, -2], [np.nan, 0, 0], [0, 0, -2]]
    directions = [[0, 0, 1], [0, 0, 0], [0, 0, 1], [0, np.inf, 1]]
    hits = scene.cast(origins, directions)
    assert np.isposinf(hits["t"]).all() and np.isposinf(hits["distance"]).all()
    for name in ("prim", "id", "instance", "N", "P", "uv"):
        assert not hits[name].any(), name


@pytest.mark.parametrize(
    "change",
    [
        lambda a: a.astype(">f8"),
        lambda a: np.asfortranarray(a),
        lambda a: np.repeat(a, 2, axis=0)[::2],
        lambda a: a[::-1][::-1],
        lambda a: a.astype(np.longdouble),
        lambda a: a.tolist(),
    ],
)
def test_layouts_of_rays_do_not_matter(change):
    scene = feimos.load(SCENES / "quadrics.pbrt", resolution=(20, 15))
    origins, directions = (part.reshape(-1, 3) for part in scene.camera.rays())
    expected = scene.cast(origins, directions)
    hits = scene.cast(change(origins), change(directions))
    assert all(same(hits[name], expected[name]) for name in NAMES)
    read_only = directions.copy()
    read_only.flags.writeable = False
    assert same(scene.cast(origins, read_only)["t"], expected["t"])


def test_hits_take_the_memory_of_the_caster():
    scene = feimos.mesh(POINTS, TRIANGLES)
    for array in scene.cast(np.zeros((100, 3)), [0, 0, 1]).values():
        while isinstance(array, np.ndarray):
            assert not array.flags.owndata
            array = array.base
        assert type(array).__name__ == "PySliceContainer"


def test_wrong_shapes_and_types():
    scene = feimos.mesh(POINTS, TRIANGLES)
    with pytest.raises(feimos.ArgumentError, match=r"origins: expected the shape \(..., 3\)"):
        scene.cast([0, 0], [0, 0, 1])
    with pytest.raises(feimos.ArgumentError, match="do not fit each other"):
        scene.cast(np.zeros((2, 3)), np.zeros((3, 3)))
    with pytest.raises(TypeError, match="directions: expected real numbers"):
        scene.cast([0, 0, 0], ["a", "b", "c"])
    with pytest.raises(TypeError, match="origins: expected real numbers"):
        scene.cast(np.zeros(3, dtype=complex), [0, 0, 1])
