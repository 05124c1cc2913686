"""Blender's depth pass, set up as BlenderProc sets it up for a depth without antialiasing."""

import tempfile

import bpy
import numpy as np
import OpenEXR

MISS = 1e9


def add_mesh(view):
    mesh = bpy.data.meshes.new("mesh")
    mesh.from_pydata(view.points.tolist(), [], view.triangles.tolist())
    bpy.context.collection.objects.link(bpy.data.objects.new("mesh", mesh))


def add_camera(view, scene):
    """The formulas of BlenderProc's `set_intrinsics_from_K_matrix` for square pixels."""
    width, height = view.size
    camera = bpy.data.cameras.new("camera")
    camera.sensor_fit = "HORIZONTAL"
    camera.lens = view.K[0, 0] * camera.sensor_width / width
    camera.shift_x = -(view.K[0, 2] - (width - 1) / 2) / width
    camera.shift_y = (view.K[1, 2] - (height - 1) / 2) / width
    camera.clip_start, camera.clip_end = 1e-3, 1e6
    pose = np.eye(4)
    pose[:3, :3] = view.R.T @ np.diag([1, -1, -1])  # OpenCV's axes to Blender's
    pose[:3, 3] = -view.R.T @ view.t
    scene.camera = bpy.data.objects.new("camera", camera)
    scene.camera.matrix_world = pose.T.tolist()
    scene.render.resolution_x, scene.render.resolution_y = view.size


def blender(view):
    """Depths of a view. There are no numbers of primitives."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    add_mesh(view)
    return depth_of_scene(view), None


def depth_of_scene(view):
    """Depths of what is in the scene: Cycles on the CPU, one sample."""
    scene = bpy.context.scene
    scene.render.engine, scene.cycles.device, scene.cycles.samples = "CYCLES", "CPU", 1
    scene.cycles.use_denoising = False
    bpy.context.view_layer.use_pass_z = True
    add_camera(view, scene)
    with tempfile.TemporaryDirectory() as folder:
        settings = scene.render.image_settings
        settings.file_format, settings.color_depth = "OPEN_EXR_MULTILAYER", "32"
        scene.render.filepath = f"{folder}/depth.exr"
        bpy.ops.render.render(write_still=True)
        channels = OpenEXR.File(scene.render.filepath, separate_channels=True).channels()
        name = next(name for name in channels if name.endswith("Depth.Z"))
        depth = np.array(channels[name].pixels, np.float32)
    return np.where(depth < MISS, depth, np.inf).astype(np.float32)
