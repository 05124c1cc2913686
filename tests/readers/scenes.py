"""Scenes that are made for the checks."""

# Seen askew, from outside its axes, on a film that is not square.
ORTHOGRAPHIC = """
LookAt 3 2 -4  0 0 0  0 1 0
Camera "orthographic" "float screenwindow" [-2.5 1.5 -1 2]
Film "image" "integer xresolution" 64 "integer yresolution" 48 "string filename" "orthographic.exr"
WorldBegin
Shape "sphere" "float radius" 0.8
Translate 0.5 0 1
Shape "trianglemesh" "point3 P" [-2 -1 0  2 -1 0.5  0 2 0] "integer indices" [0 1 2]
"""

# The same, from within a window of a perspective that is off its middle.
PERSPECTIVE = ORTHOGRAPHIC.replace("orthographic", "perspective").replace(
    '"float screenwindow" [-2.5 1.5 -1 2]', '"float fov" 50 "float screenwindow" [-1.2 0.8 -0.5 1]'
)

# Triangles in an object, two to each square of a grid, and its instances: the last one alone is seen. The camera stands a
# quarter to the right, so that each ray meets the first triangle of its square.
SIDE = 64
TRIANGLES = 2 * SIDE * SIDE
INSTANCES = 2200


def numbers_beyond_2_to_24():
    """A scene whose last primitives have numbers that no f32 can tell apart."""
    points = " ".join(f"{x} {y} 0" for y in range(SIDE + 1) for x in range(SIDE + 1))
    corner = lambda x, y: y * (SIDE + 1) + x
    indices = " ".join(
        f"{corner(x, y)} {corner(x + 1, y)} {corner(x + 1, y + 1)} {corner(x, y)} {corner(x + 1, y + 1)} {corner(x, y + 1)}"
        for y in range(SIDE)
        for x in range(SIDE)
    )
    behind = 'ObjectInstance "grid"\n' * (INSTANCES - 1)
    return f"""
LookAt 32.25 32 -10  32.25 32 0  0 1 0
Camera "orthographic" "float screenwindow" [-32 32 -32 32]
Film "image" "integer xresolution" {SIDE} "integer yresolution" {SIDE} "string filename" "numbers.exr"
WorldBegin
ObjectBegin "grid"
Shape "trianglemesh" "point3 P" [{points}] "integer indices" [{indices}]
ObjectEnd
AttributeBegin
Translate 0 0 100
{behind}
AttributeEnd
ObjectInstance "grid"
"""
