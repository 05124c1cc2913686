"""From a PLY file to an .npy of depths: whole processes, in turn, on two threads; medians in ms."""

import json
import os
import statistics
import subprocess
import sys
import tempfile
import time

from programs import FEIMOS, write_camera, write_mesh
from views import dragon

ROUNDS = 9
# Slow programs run in every third round only.
SLOW = {"blender"}
THREADS = "2"


def open3d(mesh, view, clock):
    import numpy as np
    import open3d as o3d

    clock("import")
    triangles = o3d.t.io.read_triangle_mesh(mesh)
    clock("load")
    scene = o3d.t.geometry.RaycastingScene(int(THREADS))
    scene.add_triangles(triangles)
    scene.cast_rays(o3d.core.Tensor(np.array([[0, 0, 0, 0, 0, 1]], np.float32)))  # builds the tree
    clock("build")
    K, pose = view.K.copy(), np.eye(4)
    K[:2, 2] += 0.5
    pose[:3, :3], pose[:3, 3] = view.R, view.t
    rays = scene.create_rays_pinhole(o3d.core.Tensor(K), o3d.core.Tensor(pose), *view.size)
    depth = scene.cast_rays(rays, int(THREADS))["t_hit"].numpy()
    clock("trace")
    return depth


def mitsuba(mesh, view, clock):
    import mitsuba as mi
    import numpy as np

    mi.set_variant("llvm_ad_rgb")
    import drjit

    drjit.set_thread_count(int(THREADS))
    clock("import")
    shape = mi.load_dict({"type": "ply", "filename": mesh})
    clock("load")
    pose = np.eye(4)
    pose[:3, :3] = view.R.T @ np.diag([-1, -1, 1])  # OpenCV's axes to Mitsuba's
    pose[:3, 3] = -view.R.T @ view.t
    width, height = view.size
    film = {"type": "hdrfilm", "width": width, "height": height, "rfilter": {"type": "box"}}
    sensor = {
        "type": "perspective",
        "fov": 2 * np.degrees(np.arctan(width / 2 / view.K[0, 0])),
        "to_world": mi.ScalarTransform4f(pose),
        "near_clip": 1e-3,
        "film": film,
        "sampler": {"type": "stratified", "sample_count": 1, "jitter": False},
    }
    integrator = {"type": "aov", "aovs": "depth:depth"}
    scene = mi.load_dict(
        {"type": "scene", "shape": shape, "sensor": sensor, "integrator": integrator}
    )
    clock("build")
    depth = np.array(mi.render(scene))[..., 0]
    clock("trace")
    return depth


def blender(mesh, view, clock):
    import bpy

    import blender

    clock("import")
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.context.scene.render.threads_mode = "FIXED"
    bpy.context.scene.render.threads = int(THREADS)
    bpy.ops.wm.ply_import(filepath=mesh, forward_axis="Y", up_axis="Z")
    clock("load")
    depth = blender.depth_of_scene(view)
    clock("trace")
    return depth


def child(program, mesh, image):
    """One process of a peer: prints its phases in ms as JSON."""
    import numpy as np

    last, phases = time.perf_counter(), {}

    def clock(phase):
        nonlocal last
        now = time.perf_counter()
        phases[phase], last = (now - last) * 1000, now

    view = dragon_camera()
    np.save(image, globals()[program](mesh, view, clock))
    clock("write")
    print("\n" + json.dumps(phases))


def dragon_camera():
    """The camera of the dragon; its mesh is in the file."""
    with open(os.environ["CAMERA"]) as file:
        camera = json.load(file)[0]
    import numpy as np

    class Camera:
        K, R, t = (np.array(camera[key]) for key in ("K", "R", "t"))
        size = tuple(camera["resolution"])

    return Camera


def command_of(program, folder):
    mesh, image = f"{folder}/mesh.ply", f"{folder}/{program}.npy"
    if program == "feimos":
        flags = ["--threads", THREADS, "--json", "--force", "--quiet"]
        return [FEIMOS, "render", mesh, "--cameras", f"{folder}/poses.json", "-o", image, *flags]
    return [sys.executable, __file__, program, mesh, image]


def phases_of(output):
    """The last line of a program: phases in ms."""
    line = json.loads(output.strip().splitlines()[-1])
    return {key: value for key, value in line.get("ms", line).items() if key != "total"}


def main():
    if len(sys.argv) == 4:
        child(*sys.argv[1:])
        return
    view = dragon()
    programs = ["feimos", "open3d", "mitsuba", "blender"]
    results = {program: [] for program in programs}
    with tempfile.TemporaryDirectory() as folder:
        write_mesh(view, f"{folder}/mesh.ply")
        write_camera(view, f"{folder}/poses.json")
        os.environ["CAMERA"] = f"{folder}/poses.json"
        for number in range(ROUNDS + 1):
            for program in programs:
                if program in SLOW and number % 3:
                    continue
                run = measured(command_of(program, folder))
                if number:  # the first run of each warms caches
                    results[program].append(run)
    for program, runs in results.items():
        medians = {key: statistics.median(run[key] for run in runs) for key in runs[0]}
        spread = f"{min(run['total'] for run in runs):.0f}-{max(run['total'] for run in runs):.0f}"
        print(program, spread, {key: round(value) for key, value in medians.items()})


def measured(command):
    """Runs a process; returns its wall-clock time, its CPU time and its phases in ms."""
    before, start = os.times(), time.perf_counter()
    done = subprocess.run(command, check=True, capture_output=True, text=True)
    total, after = time.perf_counter() - start, os.times()
    cpu = after.children_user + after.children_system
    cpu -= before.children_user + before.children_system
    return {"total": total * 1000, "cpu": cpu * 1000} | phases_of(done.stdout)


if __name__ == "__main__":
    main()
