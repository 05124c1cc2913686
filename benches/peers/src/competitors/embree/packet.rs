//! Pictures by packets of 4 by 4 pixels.

use super::rtcore::{LANES, Packet, Scene};
use crate::camera_rays::CameraRays;
use crate::picture::Band;

/// Pixels along a side of a packet.
const SIDE: usize = 4;

/// What is asked of Embree.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Question {
    /// Depth and primitive.
    ClosestHit,
    /// Depth; primitives are left as they are.
    Depth,
    /// Hit or miss; depths are left as they are.
    AnyHit,
}

/// Who fills bands.
pub(crate) struct Packets<'a> {
    pub(crate) scene: &'a Scene,
    pub(crate) rays: &'a CameraRays,
    pub(crate) question: Question,
}

impl Packets<'_> {
    /// Packet by packet, down before to the right.
    pub(crate) fn fill(&self, mut band: Band) {
        // What varies is set for every packet.
        let mut packet = Packet::new(self.rays.common(), self.rays.common());
        for x0 in (0..band.width).step_by(SIDE) {
            for row in (0..band.height).step_by(SIDE) {
                self.aim(&mut packet, &band, x0, row);
                self.trace(&mut packet, &mut band, x0, row);
            }
        }
    }

    /// Sets the rays of the packet whose first pixel is `x0` in `row` of the band. Beyond the picture's edge the last
    /// ray is repeated and not traced.
    #[inline]
    fn aim(&self, packet: &mut Packet, band: &Band, x0: usize, row: usize) {
        let (columns, rows) = (SIDE.min(band.width - x0), SIDE.min(band.height - row));
        packet.set_valid(|lane| lane % SIDE < columns && lane / SIDE < rows);
        let varying = if self.rays.is_perspective() {
            packet.directions()
        } else {
            packet.origins()
        };
        for axis in 0..3 {
            for i in 0..SIDE {
                let y = band.y0 + row + i.min(rows - 1);
                varying[axis][i * SIDE..][..SIDE]
                    .copy_from_slice(&self.rays.varying::<SIDE>(axis, x0, y));
            }
        }
    }

    #[inline]
    fn trace(&self, packet: &mut Packet, band: &mut Band, x0: usize, row: usize) {
        match self.question {
            Question::ClosestHit => {
                let (depths, primitives) = packet.closest_hits(self.scene);
                put(band.depths, band.width, depths, x0, row);
                put(band.primitives, band.width, &primitives, x0, row);
            }
            Question::Depth => {
                let (depths, _) = packet.closest_hits(self.scene);
                put(band.depths, band.width, depths, x0, row);
            }
            Question::AnyHit => {
                let hits = packet.any_hits(self.scene).map(|t| u32::from(t < 0.0));
                put(band.primitives, band.width, &hits, x0, row);
            }
        }
    }
}

/// Puts what lanes hold into rows of the band, as far as they reach.
#[inline]
fn put<T: Copy>(values: &mut [T], width: usize, lanes: &[T; LANES], x0: usize, row: usize) {
    let columns = SIDE.min(width - x0);
    for (row, lanes) in values
        .chunks_exact_mut(width)
        .skip(row)
        .zip(lanes.chunks_exact(SIDE))
    {
        row[x0..x0 + columns].copy_from_slice(&lanes[..columns]);
    }
}
