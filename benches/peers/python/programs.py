"""One function for each program: a view to planar depths and primitives.

Primitives count from 0. A miss has the depth inf and the primitive -1.
"""

import json
import os
import subprocess
import tempfile
from pathlib import Path

import numpy as np

FEIMOS = os.environ.get("FEIMOS", "feimos")


def write_mesh(view, path):
    """Writes the triangles as a binary PLY."""
    header = (
        "ply\nformat binary_little_endian 1.0\n"
        f"element vertex {len(view.points)}\nproperty float x\nproperty float y\nproperty float z\n"
        f"element face {len(view.triangles)}\nproperty list uchar int vertex_indices\nend_header\n"
    )
    faces = np.zeros(len(view.triangles), [("count", "u1"), ("corners", "<i4", 3)])
    faces["count"], faces["corners"] = 3, view.triangles
    Path(path).write_bytes(header.encode() + view.points.astype("<f4").tobytes() + faces.tobytes())


def write_camera(view, path):
    camera = {"name": "view", "resolution": list(view.size)}
    camera |= {key: getattr(view, key).tolist() for key in ("K", "R", "t")}
    Path(path).write_text(json.dumps([camera]))


def feimos(view, precision="exact"):
    """The program, by files; the truth that the others are compared with."""
    with tempfile.TemporaryDirectory() as folder:
        names = "mesh.ply", "poses.json", "hits.npy"
        mesh, camera, image = (f"{folder}/{name}" for name in names)
        write_mesh(view, mesh)
        write_camera(view, camera)
        command = [FEIMOS, "render", mesh, "--cameras", camera, "-o", image, "--aov", "Z,prim"]
        subprocess.run([*command, "--precision", precision, "--quiet"], check=True)
        hits = np.load(image)
    return hits["Z"], hits["prim"].astype(np.int64) - 1


def rays_of(view):
    """A ray through each pixel centre, of length 1 along the view axis: so t is planar depth."""
    width, height = view.size
    row, column = np.mgrid[:height, :width]
    pixels = np.stack([column, row, np.ones_like(row)], -1) @ np.linalg.inv(view.K).T
    return -view.R.T @ view.t, pixels @ view.R


def open3d(view):
    """RaycastingScene by its own rays. Its `K` counts pixels from the corner: half a pixel more."""
    import open3d as o3d

    scene = o3d.t.geometry.RaycastingScene()
    scene.add_triangles(o3d.core.Tensor(view.points), o3d.core.Tensor(view.triangles))
    K, pose = view.K.copy(), np.eye(4)
    K[:2, 2] += 0.5
    pose[:3, :3], pose[:3, 3] = view.R, view.t
    rays = scene.create_rays_pinhole(o3d.core.Tensor(K), o3d.core.Tensor(pose), *view.size)
    answer = scene.cast_rays(rays)
    depth, prim = answer["t_hit"].numpy(), answer["primitive_ids"].numpy().astype(np.int64)
    return depth, np.where(np.isfinite(depth), prim, -1)


def mitsuba(view, robust=False):
    """Scene.ray_intersect_preliminary for our rays in f32: no sensor, film or filter is between."""
    import mitsuba as mi

    mi.set_variant("llvm_ad_rgb")
    mesh = mi.Mesh("mesh", len(view.points), len(view.triangles))
    parameters = mi.traverse(mesh)
    parameters["vertex_positions"] = view.points.ravel()
    parameters["faces"] = view.triangles.ravel()
    parameters.update()
    scene = mi.load_dict({"type": "scene", "mesh": mesh, "embree_use_robust_intersections": robust})
    origin, direction = rays_of(view)
    direction = direction.reshape(-1, 3).astype(np.float32)
    ray = mi.Ray3f(mi.Point3f(*map(float, origin)), mi.Vector3f(direction.T))
    hit = scene.ray_intersect_preliminary(ray)
    shape = view.size[::-1]
    valid = np.array(hit.is_valid()).reshape(shape)
    depth = np.where(valid, np.array(hit.t).reshape(shape), np.inf).astype(np.float32)
    return depth, np.where(valid, np.array(hit.prim_index).reshape(shape).astype(np.int64), -1)


def mitsuba_robust(view):
    """The same with Embree's robust mode, which is off by default."""
    return mitsuba(view, robust=True)


def blender(view):
    """Blender, which loads slowly: see there."""
    from blender import blender as render

    return render(view)


PROGRAMS = {
    "feimos fast": lambda view: feimos(view, "fast"),
    "Open3D": open3d,
    "Mitsuba": mitsuba,
    "Mitsuba robust": mitsuba_robust,
    "Blender": blender,
}
