"""Lists of cameras as other programs write them, and where their pixels should be: by NumPy and OpenCV alone."""

import json

import cv2
import numpy as np

WIDTH, HEIGHT = 64, 48
COUNT = 20

# A tetrahedron, as a mesh, and a ball beside it.
CORNERS = np.array([[-1, -1, -1], [1.5, -0.5, -1], [0, 1.25, -0.75], [0.25, 0, 1.5]])
FACES = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])
CENTRE, RADIUS = np.array([-1.5, 1, 0.5]), 0.75

SCENE = f"""
Film "image" "integer xresolution" {WIDTH} "integer yresolution" {HEIGHT}
WorldBegin
Shape "trianglemesh" "point3 P" [{" ".join(map(str, CORNERS.ravel()))}] "integer indices" [{" ".join(map(str, FACES.ravel()))}]
Translate {" ".join(map(str, CENTRE))}
Shape "sphere" "float radius" {RADIUS}
"""

# The principal point is off the middle, and counts from the centre of the first pixel.
K = np.array([[61.5, 0, 29.75], [0, 58.25, 25.125], [0, 0, 1]])

LENSES = {
    "none": ("distortion", []),
    "usual": ("distortion", [-0.28, 0.07, 0.0009, -0.0004, 0.01]),
    "rational": ("distortion", [0.5, -2.7, 0.0006, -0.0002, 1.6, 0.4, -2.5, 1.5]),
    "fisheye": ("fisheye", [-0.02, 0.008, -0.003, 0.0004]),
}


def poses():
    """World to camera, as OpenCV has it, from places around the middle: R and t of each."""
    random = np.random.default_rng(20)
    for _ in range(COUNT):
        eye = random.normal(size=3)
        eye *= 4 / np.linalg.norm(eye)
        forward = -eye / 4 + random.normal(size=3) / 20
        forward /= np.linalg.norm(forward)
        right = np.cross(forward, random.normal(size=3))
        right /= np.linalg.norm(right)
        rotation = np.stack([right, np.cross(forward, right), forward])
        yield rotation, -rotation @ eye


def quaternion(rotation):
    """w, x, y, z, by OpenCV's rotation vector."""
    vector = cv2.Rodrigues(rotation)[0].ravel()
    angle = np.linalg.norm(vector)
    return [np.cos(angle / 2), *(np.sin(angle / 2) * vector / angle)]


def write_all(folder):
    """Writes the cameras in three formats, and returns what --cameras takes for each."""
    cameras = [(f"view_{number:02}", *pose) for number, pose in enumerate(poses())]
    own = [
        {"name": name, "K": K.tolist(), "R": r.tolist(), "t": t.tolist(), "resolution": [WIDTH, HEIGHT]}
        for name, r, t in cameras
    ]
    (folder / "own.json").write_text(json.dumps(own))
    frames = []
    for name, r, t in cameras:
        to_world = np.eye(4)
        # OpenGL's y points up, and its z backwards.
        to_world[:3] = np.hstack([r.T * [1, -1, -1], (-r.T @ t)[:, None]])
        frames.append({"file_path": f"./images/{name}.png", "transform_matrix": to_world.tolist()})
    # Lengths count from the corner of the film.
    fx, fy, cx, cy = K[0, 0], K[1, 1], K[0, 2] + 0.5, K[1, 2] + 0.5
    nerf = {"fl_x": fx, "fl_y": fy, "cx": cx, "cy": cy, "w": WIDTH, "h": HEIGHT, "frames": frames}
    (folder / "transforms.json").write_text(json.dumps(nerf))
    model = folder / "sparse"
    model.mkdir(exist_ok=True)
    (model / "cameras.txt").write_text(f"# Cameras\n1 PINHOLE {WIDTH} {HEIGHT} {fx} {fy} {cx} {cy}\n")
    lines = [
        f"{number} {' '.join(map(repr, map(float, [*quaternion(r), *t])))} 1 images/{name}.png\n\n"
        for number, (name, r, t) in enumerate(cameras, 1)
    ]
    (model / "images.txt").write_text("# Images\n" + "".join(lines))
    return {"own": folder / "own.json", "transforms": folder / "transforms.json", "colmap": model}


def unprojected(z, rotation, translation):
    """The points in the world of a depth image of a pinhole, one for each hit."""
    rows, columns = np.nonzero(np.isfinite(z))
    pixels = np.stack([columns, rows, np.ones(len(rows))])
    in_camera = np.linalg.inv(K) @ pixels * z[rows, columns].astype(np.float64)
    return (rotation.T @ (in_camera - translation[:, None])).T


def distance_to_surface(points):
    """How far points are from the tetrahedron or the ball, whichever is nearer."""
    off = np.abs(np.linalg.norm(points - CENTRE, axis=1) - RADIUS)
    for a, b, c in CORNERS[FACES]:
        normal = np.cross(b - a, c - a)
        normal /= np.linalg.norm(normal)
        across = (points - a) @ normal
        basis = np.stack([b - a, c - a, normal], axis=1)
        u, v, _ = np.linalg.solve(basis, (points - a).T)
        inside = (u >= -1e-6) & (v >= -1e-6) & (u + v <= 1 + 1e-6)
        off = np.where(inside, np.minimum(off, np.abs(across)), off)
    return off


def projected(points, lens, rotation, translation):
    """Columns and rows where OpenCV projects points of the world."""
    model, coefficients = LENSES[lens]
    turn = cv2.Rodrigues(rotation)[0]
    if model == "fisheye":
        # OpenCV takes points in front of the camera alone, as these are.
        found = cv2.fisheye.projectPoints(points[:, None], turn, translation, K, np.array(coefficients))[0]
    else:
        found = cv2.projectPoints(points, turn, translation, K, np.array(coefficients))[0]
    return found.reshape(-1, 2)
