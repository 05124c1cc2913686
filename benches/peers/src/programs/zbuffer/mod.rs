//! A rasterizer with a depth buffer and no tree: single precision, tiles, all threads.

mod batch;
mod bins;
mod instructions;
mod large;
mod projection;
mod tile;

use super::loader;
use super::report::{Clock, Report};
use crate::Result;
use crate::args::{Isa, ProgramOptions};
use crate::geometry::Geometry;
use batch::Corners;
use bins::{Bins, Projected, tile_counts};
use feimos::camera::Camera;
use glam::Vec4;
use instructions::{Instructions, Work, prefetch};
use projection::Projection;
use rayon::prelude::*;
use tile::{HEIGHT, LANES, Rectangle, Tile, WIDTH};

/// Points that one task projects.
const POINTS: usize = 1 << 14;

/// Renders a scene from each of its cameras, and prints a [`Report`].
pub(crate) fn run(options: &ProgramOptions) -> Result<()> {
    let mut clock = Clock::start();
    let mut report = Report::default();
    let scene = loader::load(&options.scene, options.cameras.as_deref())?;
    let Geometry::Triangles {
        vertices,
        triangles,
    } = &scene.geometry
    else {
        return Err("the rasterizer draws triangles only".into());
    };
    report.load = clock.lap();
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(options.threads)
        .build()?;
    let mut rasterizer = Rasterizer::new(options.isa);
    let mut depths = Vec::new();
    for (name, camera) in &scene.cameras {
        pool.install(|| rasterizer.render(camera, vertices, triangles, &mut depths));
        report.trace += clock.lap();
        report.compare(&depths, options, name)?;
        clock.lap();
    }
    report.print_and_exit()
}

/// Renders on the threads of the current pool.
struct Rasterizer {
    instructions: Instructions,
    /// Memory for points on the film.
    places: Vec<Vec4>,
}

impl Rasterizer {
    fn new(limit: Option<Isa>) -> Rasterizer {
        Rasterizer {
            instructions: Instructions::detect(limit),
            places: Vec::new(),
        }
    }

    /// Fills `depths`, row by row from the top; infinite where nothing is hit.
    fn render(
        &mut self,
        camera: &Camera,
        points: &[[f32; 3]],
        triangles: &[[u32; 3]],
        depths: &mut Vec<f32>,
    ) {
        let projection = Projection::new(camera);
        let [width, height] = projection.film;
        if depths.len() != width * height {
            *depths = vec![0.0; width * height];
        }
        let narrowed = projection.narrowed();
        let places = points.par_iter().with_min_len(POINTS);
        self.places.clear();
        self.places
            .par_extend(places.map(|&point| narrowed.project(point)));
        let mesh = Projected {
            projection: &projection,
            points,
            places: &self.places,
            triangles,
        };
        draw(mesh, depths, self.instructions);
    }
}

/// Draws tile by tile.
fn draw(mesh: Projected, depths: &mut [f32], instructions: Instructions) {
    let bins = Bins::new(mesh);
    let [width, _] = mesh.projection.film;
    let [columns, _] = tile_counts(mesh.projection.film);
    let bands = depths.par_chunks_mut(width * HEIGHT).enumerate();
    bands.for_each(|(row, band)| {
        let mut tiles: Vec<Vec<&mut [f32]>> = (0..columns).map(|_| Vec::new()).collect();
        for line in band.chunks_mut(width) {
            for (tile, part) in tiles.iter_mut().zip(line.chunks_mut(WIDTH)) {
                tile.push(part);
            }
        }
        let tiles = tiles.into_par_iter().enumerate();
        let memory = || (Tile::new(), Vec::new());
        tiles.for_each_init(memory, |(tile, triangles), (column, rows)| {
            let index = row * columns + column;
            bins.list(index, triangles);
            instructions.run(DrawTile {
                mesh,
                bins: &bins,
                triangles,
                tile,
                x: column * WIDTH,
                y: row * HEIGHT,
                rows,
            });
        });
    });
}

/// Draws all triangles of a tile, and writes depths to the picture.
struct DrawTile<'a, 'b> {
    mesh: Projected<'a>,
    bins: &'a Bins,
    triangles: &'a [u32],
    tile: &'a mut Tile,
    /// The first pixel.
    x: usize,
    y: usize,
    rows: Vec<&'b mut [f32]>,
}

impl Work for DrawTile<'_, '_> {
    #[inline(always)]
    fn run(mut self) {
        let projection = self.mesh.projection;
        let background = projection.background();
        self.tile.clear(background);
        let (x, y) = (self.x as f32, self.y as f32);
        let mut corners = Corners::new();
        for (i, group) in self.triangles.chunks(LANES).enumerate() {
            self.prefetch((i + 1) * LANES);
            for lane in 0..LANES {
                // To draw the last one again changes nothing.
                let triangle = group[lane.min(group.len() - 1)];
                let places = self.mesh.triangles[triangle as usize];
                let places = places.map(|corner| self.mesh.places[corner as usize]);
                corners.set(lane, places, x, y);
            }
            corners.draw(self.tile, background);
        }
        for large in &self.bins.large {
            if let Some(shape) = large.in_tile(self.x, self.y) {
                self.tile.draw(&shape, Rectangle::WHOLE, background);
            }
        }
        for (row, depths) in self.rows.iter_mut().enumerate() {
            for (depth, &nearness) in depths.iter_mut().zip(self.tile.row(row)) {
                *depth = projection.depth(nearness);
            }
        }
    }
}

impl DrawTile<'_, '_> {
    /// Asks for the corners of a group from place `start`, and for the triangles of the next.
    #[inline(always)]
    fn prefetch(&self, start: usize) {
        let triangles = self.triangles.get(start..).unwrap_or_default();
        for &triangle in triangles.iter().take(LANES) {
            for corner in self.mesh.triangles[triangle as usize] {
                prefetch(&self.mesh.places[corner as usize]);
            }
        }
        for &triangle in triangles.iter().skip(LANES).take(LANES) {
            prefetch(&self.mesh.triangles[triangle as usize]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::competitors::{self, Device};
    use crate::memory;
    use crate::picture::Picture;
    use crate::views::ViewName;
    use feimos::simd::Level;

    /// The same hits but for a pixel in ten thousand, with depths that differ by roundings.
    #[test]
    fn sees_what_feimos_sees_with_all_instructions() {
        let _alone = memory::MEASURED.lock();
        let device = Device::new(2, None).unwrap();
        for name in [
            ViewName::Wall,
            ViewName::Terrain,
            ViewName::Interior,
            ViewName::Orthographic,
        ] {
            let view = name.make().unwrap();
            let mut feimos = competitors::all(&view, Level::detect(), &device).swap_remove(0);
            feimos.build();
            let mut picture = Picture::new(view.width(), view.height());
            feimos.trace(0, &mut picture);
            let Geometry::Triangles {
                vertices,
                triangles,
            } = &view.geometry
            else {
                panic!("{name:?} has spheres")
            };
            let mut pictures = Vec::new();
            for limit in [None, Some(Isa::Avx2), Some(Isa::Sse42), Some(Isa::Sse2)] {
                let mut depths = Vec::new();
                Rasterizer::new(limit).render(&view.camera, vertices, triangles, &mut depths);
                pictures.push(depths);
            }
            let exact = picture.depths.iter();
            let is_off = |&(depth, exact): &(&f32, &f32)| {
                depth.is_finite() != exact.is_finite() || (depth - exact).abs() > 1e-4 * exact
            };
            let differences = pictures[0].iter().zip(exact).filter(is_off).count();
            assert!(differences <= picture.depths.len() / 10_000, "{name:?}");
            assert!(pictures.iter().all(|depths| *depths == pictures[0]));
        }
    }
}
