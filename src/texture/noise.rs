//! Gradient noise (Perlin, "Improving Noise", SIGGRAPH 2002), in `f64`.

use crate::per_axis::per_axis;

/// The permutation of that paper, which pbrt takes over.
const PERMUTATION: [u8; 256] = [
    151, 160, 137, 91, 90, 15, 131, 13, 201, 95, 96, 53, 194, 233, 7, 225, 140, 36, 103, 30, 69,
    142, 8, 99, 37, 240, 21, 10, 23, 190, 6, 148, 247, 120, 234, 75, 0, 26, 197, 62, 94, 252, 219,
    203, 117, 35, 11, 32, 57, 177, 33, 88, 237, 149, 56, 87, 174, 20, 125, 136, 171, 168, 68, 175,
    74, 165, 71, 134, 139, 48, 27, 166, 77, 146, 158, 231, 83, 111, 229, 122, 60, 211, 133, 230,
    220, 105, 92, 41, 55, 46, 245, 40, 244, 102, 143, 54, 65, 25, 63, 161, 1, 216, 80, 73, 209, 76,
    132, 187, 208, 89, 18, 169, 200, 196, 135, 130, 116, 188, 159, 86, 164, 100, 109, 198, 173,
    186, 3, 64, 52, 217, 226, 250, 124, 123, 5, 202, 38, 147, 118, 126, 255, 82, 85, 212, 207, 206,
    59, 227, 47, 16, 58, 17, 182, 189, 28, 42, 223, 183, 170, 213, 119, 248, 152, 2, 44, 154, 163,
    70, 221, 153, 101, 155, 167, 43, 172, 9, 129, 22, 39, 253, 19, 98, 108, 110, 79, 113, 224, 232,
    178, 185, 112, 104, 218, 246, 97, 228, 251, 34, 242, 193, 238, 210, 144, 12, 191, 179, 162,
    241, 81, 51, 145, 235, 249, 14, 239, 107, 49, 192, 214, 31, 181, 199, 106, 157, 184, 84, 204,
    176, 115, 121, 50, 45, 127, 4, 150, 254, 138, 236, 205, 93, 222, 114, 67, 29, 24, 72, 243, 141,
    128, 195, 78, 66, 215, 61, 156, 180,
];

/// Noise at a point, 0 at integers. The coordinates are finite.
pub(super) fn noise(point: [f64; 3]) -> f64 {
    let cell = point.map(f64::floor);
    let within = per_axis(|k| point[k] - cell[k]);
    // Beyond 2^63 the conversion saturates; no digit is left within the cell there.
    let place = cell.map(|x| (x as i64).rem_euclid(256) as usize);
    let corner = |x: usize, y: usize, z: usize| {
        let offset = [x, y, z];
        let lattice = per_axis(|k| place[k] + offset[k]);
        gradient(lattice, per_axis(|k| within[k] - offset[k] as f64))
    };
    let [wx, wy, wz] = within.map(weight);
    let along_x = |y, z| lerp(wx, corner(0, y, z), corner(1, y, z));
    let along_y = |z| lerp(wy, along_x(0, z), along_x(1, z));
    lerp(wz, along_y(0), along_y(1))
}

/// The product of the gradient of a lattice point and the vector from there.
fn gradient([x, y, z]: [usize; 3], [dx, dy, dz]: [f64; 3]) -> f64 {
    let permuted = |place: usize| usize::from(PERMUTATION[place & 255]);
    let hash = permuted(permuted(permuted(x) + y) + z) & 15;
    let u = if hash < 8 || hash == 12 || hash == 13 {
        dx
    } else {
        dy
    };
    let v = if hash < 4 || hash == 12 || hash == 13 {
        dy
    } else {
        dz
    };
    (if hash & 1 != 0 { -u } else { u }) + (if hash & 2 != 0 { -v } else { v })
}

fn weight(t: f64) -> f64 {
    let cube = t * t * t;
    6.0 * (cube * t * t) - 15.0 * (cube * t) + 10.0 * cube
}

fn lerp(t: f64, a: f64, b: f64) -> f64 {
    (1.0 - t) * a + t * b
}
