//! Normals, positions and texture coordinates at the pixels of a tile.

use crate::accel::{TILE, TracedTile};
use crate::camera::Camera;
use crate::film::ChannelName;
use crate::shape::{Geometry, SurfacePoint, SurfacePoints, SurfaceWants};

/// The samples of [`ChannelName::SURFACE`] in a tile, rounded once from `f64`; 0 where nothing is
/// hit.
pub(super) struct SurfaceTile<'a> {
    camera: &'a Camera,
    points: SurfacePoints<'a>,
    samples: Vec<[f32; ChannelName::SURFACE.len()]>,
}

impl<'a> SurfaceTile<'a> {
    /// A tile for these channels; `None` if none of them describes surfaces.
    pub(super) fn of_channels(
        channels: &[ChannelName],
        camera: &'a Camera,
        geometry: &'a Geometry,
    ) -> Option<SurfaceTile<'a>> {
        use ChannelName::{Nx, Ny, Nz, Px, Py, Pz, U, V};
        let wants = |some: &[ChannelName]| channels.iter().any(|channel| some.contains(channel));
        let wanted = SurfaceWants {
            normal: wants(&[Nx, Ny, Nz]),
            point: wants(&[Px, Py, Pz]),
            uv: wants(&[U, V]),
        };
        let is_wanted = wanted.normal || wanted.point || wanted.uv;
        is_wanted.then(|| SurfaceTile {
            camera,
            points: SurfacePoints::new(geometry, wanted),
            samples: Vec::new(),
        })
    }

    /// Fills the columns and rows from the first to before the second of a `tile` whose first pixel
    /// on the film is `first`.
    pub(super) fn fill(
        &mut self,
        tile: &TracedTile,
        first: [u32; 2],
        columns: [u32; 2],
        rows: [u32; 2],
    ) {
        self.samples.clear();
        self.samples
            .resize((TILE * TILE) as usize, Default::default());
        for y in rows[0]..rows[1] {
            let (hits, primitives) = (tile.hits_of_row(y), tile.primitives_of_row(y));
            for x in (columns[0]..columns[1]).filter(|x| hits >> x & 1 == 1) {
                let ray = self.camera.ray(first[0] + x, first[1] + y);
                let point = self.points.of(primitives[x as usize], &ray);
                self.samples[(y * TILE + x) as usize] = samples(&point);
            }
        }
    }

    /// The samples of a row.
    pub(super) fn row(&self, y: u32) -> &[[f32; ChannelName::SURFACE.len()]] {
        &self.samples[(y * TILE) as usize..((y + 1) * TILE) as usize]
    }
}

/// The samples of a point in the order of [`ChannelName::SURFACE`]. Zeros are positive.
fn samples(SurfacePoint { normal, point, uv }: &SurfacePoint) -> [f32; ChannelName::SURFACE.len()] {
    [
        normal.x, normal.y, normal.z, point.x, point.y, point.z, uv[0], uv[1],
    ]
    .map(|value| value as f32 + 0.0)
}
