"""Arguments: arrays of all layouts, and messages about those that are wrong."""

import numpy as np
import pytest

import feimos
from conftest import POINTS, SCENES, TRIANGLES, same

K = [[50, 0, 20], [0, 50, 15], [0, 0, 1]]


@pytest.mark.parametrize("points", ["<f4", ">f4", "<f8", ">f8", "i1", "<i4", ">i8", "f2", "g"])
@pytest.mark.parametrize("triangles", ["<i4", ">i4", "i8", "u1", "<u4", "u8"])
def test_types_of_a_mesh_do_not_matter(points, triangles):
    expected = feimos.mesh(POINTS, TRIANGLES).render(channels=("Z", "prim"))
    corners = np.asfortranarray(np.array(POINTS, dtype=points))
    indices = np.repeat(np.array(TRIANGLES, dtype=triangles), 2, axis=1)[:, ::2]
    indices.flags.writeable = corners.flags.writeable = False
    image = feimos.mesh(corners, indices).render(channels=("Z", "prim"))
    assert all(same(image[name], expected[name]) for name in expected)


def test_doubles_are_rounded_to_the_nearest_float():
    tenth = np.float64(0.1)
    assert feimos.mesh([[tenth, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]).bounds[1, 0] == 1
    shifted = np.array([[tenth, 0, 0], [0, -1, 0], [0, 1, 0]])
    assert feimos.mesh(shifted, [[0, 1, 2]]).bounds[1, 0] == np.float32(0.1)


def test_numbers_that_are_not_finite_are_points_that_are_never_hit():
    points = [*POINTS, [np.nan, np.inf, 0]]
    scene = feimos.mesh(points, [*TRIANGLES, [0, 1, 6]])
    assert scene.render(channels="prim")["prim"].max() <= 8


@pytest.mark.parametrize(
    ("points", "triangles", "message"),
    [
        (POINTS, [[0, 1, 2], [3, -1, 2]], "triangle 1 has the index -1, but there are 6 points"),
        (POINTS, [[0, 1, 6]], "triangle 0 has the index 6, but there are 6 points"),
        (POINTS, [[0, 1, 2**40]], "triangle 0 has the index 1099511627776"),
        (POINTS, [0, 1, 2], r"triangles: expected the shape \(n, 3\), found \(3,\)"),
        (POINTS, [[0, 1, 2, 3]], r"triangles: expected the shape \(n, 3\), found \(1, 4\)"),
        ([[0, 0], [1, 1]], TRIANGLES, r"points: expected the shape \(n, 3\), found \(2, 2\)"),
        ([[0, 0, 1e39]], [], r"points: point 0 has the coordinate 1e\+39, beyond float32"),
    ],
)
def test_wrong_meshes(points, triangles, message):
    with pytest.raises(feimos.ArgumentError, match=message):
        feimos.mesh(points, triangles)


def test_wrong_types_of_meshes():
    with pytest.raises(TypeError, match="triangles: expected integers, found float64"):
        feimos.mesh(POINTS, np.array(TRIANGLES, dtype=float))
    with pytest.raises(TypeError, match="points: expected real numbers, found complex128"):
        feimos.mesh(np.array(POINTS) * 1j, TRIANGLES)
    with pytest.raises(TypeError, match="points: expected real numbers, found bool"):
        feimos.mesh(np.array(POINTS) > 0, TRIANGLES)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"K": K}, "size is missing"),
        ({"R": np.eye(3)}, "K is missing"),
        ({"K": np.eye(4), "size": (4, 3)}, r"K: expected the shape \(3, 3\), found \(4, 4\)"),
        ({"K": K, "t": [1, 2], "size": (4, 3)}, r"t: expected the shape \(3,\), found \(2,\)"),
        ({"K": K, "t": [1, 2, np.nan], "size": (4, 3)}, "t: expected finite numbers"),
        ({"K": K, "size": (0, 3)}, "size: expected a positive width and height"),
        ({"K": K, "size": (3,)}, r"size: expected \(width, height\)"),
        ({"K": K, "size": (2**40, 3)}, "size: expected a positive width and height"),
        ({"K": K, "R": np.ones((3, 3)), "size": (4, 3)}, "R"),
        ({"K": [[1, 0, 0], [0, 1, 0], [0, 0, 2]], "size": (4, 3)}, "K"),
        ({"channels": ["Z", "depth"]}, "depth"),
        ({"channels": []}, "channel"),
        ({"accel": "fastest"}, "fastest"),
        ({"precision": "double"}, "double"),
        ({"threads": 0}, "threads: expected 1 to 4096, found 0"),
    ],
)
def test_wrong_views(arguments, message):
    scene = feimos.load(SCENES / "sphere.pbrt")
    with pytest.raises(feimos.ArgumentError, match=message):
        scene.render(**arguments)


def test_a_camera_beside_k():
    scene = feimos.load(SCENES / "sphere.pbrt")
    with pytest.raises(feimos.ArgumentError, match="camera: K, R, t and size are the camera's own"):
        scene.render(K, size=(4, 3), camera=scene.camera)
    with pytest.raises(TypeError, match="camera: expected a feimos.Camera, found str"):
        scene.render(camera="front")


def test_images_that_are_too_large():
    scene = feimos.load(SCENES / "sphere.pbrt")
    with pytest.raises(feimos.Error, match="too large"):
        scene.render(K, size=(65_000, 65_000))


def test_options_of_loading():
    path = SCENES / "sphere.pbrt"
    assert feimos.load(str(path), resolution=(np.int64(7), 5)).camera.size == (7, 5)
    for wrong in ({"time": 2.0}, {"alpha_cutoff": 1.0}, {"input_budget": 0}):
        with pytest.raises(feimos.ArgumentError):
            feimos.load(path, **wrong)


def test_scenes_are_made_by_functions():
    with pytest.raises(TypeError, match="feimos.load or feimos.mesh"):
        feimos.Scene()
    with pytest.raises(AttributeError, match="no attribute 'lode'"):
        feimos.lode
    assert set(feimos.__all__) <= set(dir(feimos))
