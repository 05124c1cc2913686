//! A line of `images.txt`: number, quaternion, translation, camera and name.

use super::super::checks::Refusal;
use super::super::intrinsics;
use super::lines::{Line, number};
use crate::exact::Dyadic;
use crate::geometry::Matrix;

/// An image.
#[derive(Debug)]
pub(super) struct ImageLine {
    /// w, x, y and z; of any length.
    quaternion: [f64; 4],
    translation: [f64; 3],
    pub(super) camera: u64,
    pub(super) name: String,
}

impl ImageLine {
    pub(super) fn read(line: &Line) -> Result<ImageLine, Refusal> {
        let refusal = |found: &str| {
            let expected = "number, quaternion (w x y z), translation, camera and name: \
                            1 1 0 0 0 0 0 3 1 a.png";
            (found.to_owned(), expected.to_owned())
        };
        let numbers: Option<Vec<f64>> = line.words().take(9).map(number).collect();
        let numbers = numbers.filter(|numbers| numbers.len() == 9);
        let numbers = numbers.ok_or_else(|| refusal("a line that is no image"))?;
        let camera = numbers[8];
        if camera.fract() != 0.0 || !(0.0..=u32::MAX.into()).contains(&camera) {
            return Err(refusal("a camera that is no whole number"));
        }
        let name = String::from_utf8_lossy(line.after(9)).into_owned();
        if name.is_empty() {
            return Err(refusal("an image without a name"));
        }
        Ok(ImageLine {
            quaternion: [1, 2, 3, 4].map(|k| numbers[k]),
            translation: [5, 6, 7].map(|k| numbers[k]),
            camera: camera as u64,
            name,
        })
    }

    pub(super) fn world_from_camera(&self) -> Result<Matrix, Refusal> {
        let rotation = rotation(self.quaternion).ok_or_else(|| {
            let found = "a quaternion of zeros".to_owned();
            (found, "one that is not 0: 1 0 0 0 does not turn".to_owned())
        })?;
        intrinsics::world_from_camera(&rotation, &self.translation)
    }
}

/// The rotation by a quaternion of any length other than 0: each entry is the `f64` nearest to the
/// exact quotient by the square of the length.
fn rotation(quaternion: [f64; 4]) -> Option<[[f64; 3]; 3]> {
    let [w, x, y, z] = quaternion.map(Dyadic::from);
    let length = &(&w.square() + &x.square()) + &(&y.square() + &z.square());
    if length.is_zero() {
        return None;
    }
    let entry = |numerator: Dyadic| numerator.quotient_to_f64(&length);
    // On the diagonal, what is positive and what is negative.
    let diagonal = |a: &Dyadic, b: &Dyadic, c: &Dyadic| {
        let positive = &w.square() + &a.square();
        entry(&positive - &(&b.square() + &c.square()))
    };
    let two = Dyadic::from(2.0);
    let sum = |a: &Dyadic, b: &Dyadic, c: &Dyadic| {
        let (ab, cw) = (a * b, c * &w);
        [entry(&two * &(&ab + &cw)), entry(&two * &(&ab - &cw))]
    };
    let ([yx, xy], [xz, zx], [zy, yz]) = (sum(&x, &y, &z), sum(&x, &z, &y), sum(&y, &z, &x));
    Some([
        [diagonal(&x, &y, &z), xy, xz],
        [yx, diagonal(&y, &x, &z), yz],
        [zx, zy, diagonal(&z, &x, &y)],
    ])
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn quarter_turns_are_exact() {
        // Around z, from x to y; and around (1, 1, 1), from x to y to z.
        let z = rotation([1.0, 0.0, 0.0, 1.0]);
        assert_eq!(
            z,
            Some([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
        );
        let all = rotation([0.5; 4]);
        assert_eq!(
            all,
            Some([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
        );
        assert_eq!(rotation([0.0; 4]), None);
    }

    proptest! {
        #[test]
        fn quaternions_give_rotations(quaternion in prop::array::uniform4(-1.0f64..1.0)) {
            prop_assert!(intrinsics::is_rotation(&rotation(quaternion).unwrap()));
        }
    }
}
