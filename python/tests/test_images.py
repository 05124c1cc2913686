"""Images: those of the program, byte for byte."""

import json
from pathlib import Path

import numpy as np
import pytest

import feimos
from conftest import POINTS, SCENES, TRIANGLES, poses, same

CHANNELS = ["Z", "t", "A", "prim", "id", "instance", "N", "P", "uv", "cost"]


def of_program(program, folder: Path, scene: Path, channel: str, *flags: object) -> np.ndarray:
    path = folder / f"{channel}.npy"
    ran = program("render", "-q", scene, "-o", path, "--force", "--aov", channel, *flags)
    assert ran.returncode == 0, ran.stderr
    return np.load(path)


@pytest.mark.parametrize("channel", CHANNELS)
@pytest.mark.parametrize("name", ["sphere", "quadrics", "instances", "mesh"])
def test_channels_are_those_of_the_program(program, tmp_path, ply, name, channel):
    path = ply if name == "mesh" else SCENES / f"{name}.pbrt"
    expected = of_program(program, tmp_path, path, channel, "--resolution", "50x40")
    scene = feimos.load(path, resolution=(50, 40))
    image = scene.render(channels=channel)
    assert list(image) == [channel]
    assert same(image[channel], expected)
    assert (image[channel] != 0).any() or (channel == "instance" and name != "instances")


def test_channels_keep_the_order_in_which_they_are_asked_for():
    scene = feimos.load(SCENES / "sphere.pbrt", resolution=(8, 6))
    image = scene.render(channels=("uv", "Z", "prim", "Z"))
    assert list(image) == ["uv", "Z", "prim"]
    assert image["uv"].shape == (6, 8, 2) and image["prim"].dtype == np.uint32


@pytest.mark.parametrize("precision", ["exact", "fast"])
@pytest.mark.parametrize("accel", ["sah", "hlbvh", "middle", "equal", "none"])
def test_accelerators_make_the_image_of_the_program(program, tmp_path, accel, precision):
    path = SCENES / "triangles.pbrt"
    flags = ["--resolution", "50x40", "--accel", accel, "--precision", "exact"]
    expected = of_program(program, tmp_path, path, "Z", *flags)
    scene = feimos.load(path, resolution=(50, 40))
    image = scene.render(accel=accel, precision=precision)["Z"]
    if precision == "exact":
        assert same(image, expected)
    else:
        assert np.allclose(image, expected)


def test_k_r_and_t_are_those_of_a_list_of_cameras(program, tmp_path, pose_list):
    path = SCENES / "quadrics.pbrt"
    output = tmp_path / "{camera}.npy"
    ran = program("render", "-q", path, "--cameras", pose_list, "-o", output)
    assert ran.returncode == 0, ran.stderr
    scene = feimos.load(path)
    cameras = scene.cameras(pose_list)
    for pose, camera in zip(poses(3), cameras):
        expected = np.load(tmp_path / f"{pose['name']}.npy")
        assert np.isfinite(expected).any()
        k, r, t = np.array(pose["K"]), np.array(pose["R"]), np.array(pose["t"])
        assert same(scene.render(k, r, t, size=(64, 48))["Z"], expected)
        assert same(scene.render(k, r, t[:, None], size=(64, 48))["Z"], expected)
        assert same(scene.render(camera=camera)["Z"], expected)
        made = feimos.Camera(k, r, t, size=(64, 48))
        assert same(scene.render(camera=made)["Z"], expected)
        assert (camera.name, camera.size) == (pose["name"], (64, 48))


def test_r_and_t_are_the_identity_and_zero_by_default():
    scene = feimos.mesh(np.array(POINTS) + [0, 0, 4], TRIANGLES)
    k = [[50, 0, 20], [0, 50, 15], [0, 0, 1]]
    expected = scene.render(k, np.eye(3), [0, 0, 0], (41, 31))["Z"]
    image = scene.render(k, size=(41, 31))["Z"]
    assert same(image, expected) and image[15, 20] == 3


def test_many_views_give_the_images_of_few():
    path = SCENES / "quadrics.pbrt"
    scene = feimos.load(path)
    for pose in poses(20):
        view = feimos.Camera(pose["K"], pose["R"], pose["t"], size=(64, 48))
        alone = feimos.load(path).render(camera=view, channels=("Z", "prim"))
        image = scene.render(camera=view, channels=("Z", "prim"))
        assert all(same(image[name], alone[name]) for name in image)


def test_a_mesh_of_arrays_is_that_of_a_file(ply):
    of_arrays = feimos.mesh(POINTS, TRIANGLES)
    of_file = feimos.load(ply)
    assert of_arrays.primitive_count == of_file.primitive_count == 8
    assert np.array_equal(of_arrays.bounds, of_file.bounds)
    channels = ("Z", "prim", "id", "N")
    left, right = (scene.render(channels=channels) for scene in (of_arrays, of_file))
    assert all(same(left[name], right[name]) for name in channels)


def test_arrays_take_the_memory_of_the_renderer():
    scene = feimos.load(SCENES / "quadrics.pbrt")
    for array in scene.render(channels=CHANNELS).values():
        owner = array
        while isinstance(owner, np.ndarray):
            assert not owner.flags.owndata
            owner = owner.base
        assert type(owner).__name__ == "PySliceContainer"
        assert array.flags.writeable and array.flags.c_contiguous and array.flags.aligned


def test_arrays_outlive_their_scene():
    scene = feimos.load(SCENES / "sphere.pbrt")
    depth = scene.render()["Z"]
    before = depth.copy()
    del scene
    for _ in range(3):
        feimos.load(SCENES / "quadrics.pbrt").render(channels=CHANNELS)
    assert same(depth, before)


def test_properties_of_a_scene():
    scene = feimos.load(SCENES / "sphere.pbrt")
    assert scene.camera.size == (400, 400) and scene.camera.name is None
    assert scene.primitive_count == 1 and scene.warnings == ()
    # Bounds of quadrics are rounded outwards.
    assert np.allclose(scene.bounds, [[-1, -1, -1], [1, 1, 1]])
    assert feimos.mesh([], []).bounds is None
    assert repr(scene) == "<feimos.Scene of 1 primitives>"
    assert repr(scene.camera) == "<feimos.Camera 400 x 400>"


def test_json_of_cameras_may_hold_one(tmp_path):
    path = tmp_path / "one.json"
    path.write_text(json.dumps(poses(1)[0]))
    assert len(feimos.load(SCENES / "sphere.pbrt").cameras(path)) == 1
