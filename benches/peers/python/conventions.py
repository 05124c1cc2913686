"""What the depths and the pixels of each program are: a square of side 1, facing the eye 2 away."""

import numpy as np

from views import View

SIZE = (64, 48)


def square():
    """`fx` 64 and the principal point in the middle: the square covers 32 x 32 pixels."""
    points = np.array([[-0.5, -0.5, 2], [0.5, -0.5, 2], [0.5, 0.5, 2], [-0.5, 0.5, 2]], np.float32)
    triangles = np.array([[0, 1, 2], [0, 2, 3]], np.uint32)
    K = np.array([[64.0, 0, 31.5], [0, 64, 23.5], [0, 0, 1]])
    return View(points, triangles, K, np.eye(3), np.zeros(3), SIZE)


def show(what, depth):
    """The depth in the middle, at a corner, and outwards across the left edge."""
    middle, corner = depth[23, 31], depth[8, 16]
    across = ", ".join(f"{value:.4g}" for value in depth[23, 17:13:-1])
    print(f"{what}: middle {middle:.5f}, corner {corner:.5f}, across the edge {across}")


def open3d():
    import open3d as o3d

    view = square()
    rays_of = o3d.t.geometry.RaycastingScene.create_rays_pinhole
    for skew in (0, 5):
        K = view.K.copy()
        K[0, 1] = skew
        rays = rays_of(o3d.core.Tensor(K), o3d.core.Tensor(np.eye(4)), *SIZE).numpy()
        direction = rays[0, 0, 3:]
        pixel = K @ direction
        print(f"Open3D, skew {skew}: pixel (0, 0) has direction {direction}, in pixels {pixel[:2]}")


def mitsuba():
    import mitsuba as mi

    mi.set_variant("llvm_ad_rgb")
    transform = mi.ScalarTransform4f
    rectangle = {
        "type": "rectangle",
        "to_world": transform().translate([0, 0, 2]).rotate([0, 1, 0], 180).scale(0.5),
    }
    random = {"type": "independent", "sample_count": 16}
    centre = {"type": "stratified", "sample_count": 1, "jitter": False}
    for name, near, sampler, film_filter in (
        ("defaults, 16 samples", None, random, None),
        ("near_clip 1, box filter, 1 sample without jitter", 1.0, centre, "box"),
        ("near_clip 1e-5, box filter, 1 sample without jitter", 1e-5, centre, "box"),
    ):
        film = {"type": "hdrfilm", "width": SIZE[0], "height": SIZE[1]}
        sensor = {"type": "perspective", "fov": np.degrees(2 * np.arctan(0.5)), "film": film}
        sensor |= {"to_world": transform().look_at([0, 0, 0], [0, 0, 1], [0, 1, 0])}
        if film_filter:
            film["rfilter"] = {"type": film_filter}
        if near:
            sensor["near_clip"] = near
        scene = {"type": "scene", "sensor": sensor | {"sampler": sampler}, "square": rectangle}
        integrator = mi.load_dict({"type": "aov", "aovs": "depth:depth"})
        depth = np.array(mi.render(mi.load_dict(scene), integrator=integrator))[..., 0]
        show(f"Mitsuba, {name}", depth)


def blender():
    from blender import blender as render

    show("Blender, depth pass", render(square())[0])


def feimos():
    from programs import feimos as render

    show("feimos, Z", render(square())[0])


if __name__ == "__main__":
    print(f"distance of the corner {2 * np.sqrt(1 + 2 * (15.5 / 64) ** 2):.5f}, Z 2")
    feimos()
    open3d()
    mitsuba()
    blender()
