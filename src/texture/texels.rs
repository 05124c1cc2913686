//! Images of one channel, and the values between and beyond their texels.

use crate::digest::Digester;

/// What an image has beyond its borders.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Wrap {
    /// The image again.
    Repeat,
    /// 0.
    Black,
    /// The nearest texel.
    Clamp,
}

impl Wrap {
    /// The place in a row or column of `count` texels that stands for `place`; `None` for black.
    fn place(self, place: i64, count: u32) -> Option<usize> {
        let count = i64::from(count);
        match self {
            Wrap::Repeat => Some(place.rem_euclid(count) as usize),
            Wrap::Clamp => Some(place.clamp(0, count - 1) as usize),
            Wrap::Black => (0..count).contains(&place).then_some(place as usize),
        }
    }
}

/// What an image has between the centres of its texels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Filter {
    /// The texel around the point.
    Point,
    /// The weighted mean of the four texels around it.
    Bilinear,
}

/// An image of one channel, row by row from the top.
#[derive(Debug, Clone, PartialEq)]
pub struct Texels {
    size: [u32; 2],
    values: Values,
}

#[derive(Debug, Clone, PartialEq)]
enum Values {
    /// With what each byte means.
    Bytes(Vec<u8>, Box<[f64; 256]>),
    Floats(Vec<f32>),
}

/// Larger numbers are whole: nothing is between texels.
const FAR: f64 = (1u64 << 53) as f64;

impl Texels {
    /// An image of bytes, and what each byte means. `None` unless there is a byte for each texel,
    /// and a texel.
    pub fn of_bytes(size: [u32; 2], bytes: Vec<u8>, meaning: [f64; 256]) -> Option<Texels> {
        has_texels(size, bytes.len()).then(|| Texels {
            size,
            values: Values::Bytes(bytes, Box::new(meaning)),
        })
    }

    /// An image of numbers. `None` unless there is a number for each texel, and a texel.
    pub fn of_floats(size: [u32; 2], values: Vec<f32>) -> Option<Texels> {
        has_texels(size, values.len()).then_some(Texels {
            size,
            values: Values::Floats(values),
        })
    }

    /// Columns and rows.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// Its memory in bytes.
    pub fn bytes(&self) -> usize {
        match &self.values {
            Values::Bytes(bytes, meaning) => bytes.len() + size_of_val(&**meaning),
            Values::Floats(values) => size_of_val(&values[..]),
        }
    }

    /// The value at (s, t). The lower left corner of the image is (0, 0), the upper right one
    /// (1, 1). NaN where s or t is not finite.
    pub fn at(&self, [s, t]: [f64; 2], wrap: Wrap, filter: Filter) -> f64 {
        let x = s * f64::from(self.size[0]) - 0.5;
        let y = (1.0 - t) * f64::from(self.size[1]) - 0.5;
        if !(x.is_finite() && y.is_finite()) {
            return f64::NAN;
        }
        let [x, y] = [x, y].map(|at| at.clamp(-FAR, FAR));
        if filter == Filter::Point {
            return self.texel([x, y].map(|at| (at + 0.5).floor() as i64), wrap);
        }
        let (left, top) = (x.floor(), y.floor());
        let (dx, dy) = (x - left, y - top);
        let (column, row) = (left as i64, top as i64);
        let upper = (1.0 - dx) * (1.0 - dy) * self.texel([column, row], wrap)
            + dx * (1.0 - dy) * self.texel([column + 1, row], wrap);
        let lower = (1.0 - dx) * dy * self.texel([column, row + 1], wrap)
            + dx * dy * self.texel([column + 1, row + 1], wrap);
        upper + lower
    }

    fn texel(&self, [column, row]: [i64; 2], wrap: Wrap) -> f64 {
        let [width, height] = self.size;
        let (Some(column), Some(row)) = (wrap.place(column, width), wrap.place(row, height)) else {
            return 0.0;
        };
        let place = row * width as usize + column;
        match &self.values {
            Values::Bytes(bytes, meaning) => meaning[usize::from(bytes[place])],
            Values::Floats(values) => values[place].into(),
        }
    }

    pub(super) fn digest(&self, digester: &mut Digester) {
        self.size
            .iter()
            .for_each(|side| digester.word((*side).into()));
        match &self.values {
            Values::Bytes(bytes, meaning) => {
                digester.measures(&meaning[..]);
                digester.list(bytes, |byte| [u64::from(*byte)]);
            }
            Values::Floats(values) => digester.list(values, |value| [value.to_bits().into()]),
        }
    }
}

fn has_texels([width, height]: [u32; 2], count: usize) -> bool {
    count > 0 && u64::from(width) * u64::from(height) == count as u64
}
