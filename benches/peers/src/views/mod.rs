//! What there is to look at.

mod dragon;
mod interior;
mod place;
mod spheres;
mod terrain;
mod wall;

pub(crate) use dragon::path_of;
pub(crate) use place::camera;

use crate::Result;
use crate::view::View;
use clap::ValueEnum;

/// The views by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum ViewName {
    /// scenes/dragon.pbrt
    A,
    /// scenes/dragon-close.pbrt
    B,
    /// scenes/dragon-close.pbrt on 3840 x 2160 pixels
    B4k,
    /// A million small spheres
    Spheres,
    /// One huge triangle in front of a million
    Wall,
    /// A long thin terrain, seen nearly edge-on
    Terrain,
    /// A furnished hall, seen from inside
    Interior,
    /// The dragon by an orthographic camera
    Orthographic,
    /// The dragon on 64 x 64 pixels
    Thumbnail,
    /// The dragon on 8192 x 8192 pixels
    Film,
}

impl ViewName {
    pub(crate) fn title(self) -> &'static str {
        match self {
            ViewName::A => "A",
            ViewName::B => "B",
            ViewName::B4k => "B4K",
            ViewName::Spheres => "Spheres",
            ViewName::Wall => "Wall",
            ViewName::Terrain => "Terrain",
            ViewName::Interior => "Interior",
            ViewName::Orthographic => "Orthographic",
            ViewName::Thumbnail => "Thumbnail",
            ViewName::Film => "Film",
        }
    }

    /// Whether the mesh is that of `scenes/dragon.pbrt`, moved as there.
    pub(crate) fn is_of_dragon(self) -> bool {
        match self {
            ViewName::A
            | ViewName::B
            | ViewName::B4k
            | ViewName::Orthographic
            | ViewName::Thumbnail
            | ViewName::Film => true,
            ViewName::Spheres | ViewName::Wall | ViewName::Terrain | ViewName::Interior => false,
        }
    }

    pub(crate) fn make(self) -> Result<View> {
        match self {
            ViewName::A => dragon::of_file("dragon.pbrt", None),
            ViewName::B => dragon::of_file("dragon-close.pbrt", None),
            ViewName::B4k => dragon::of_file("dragon-close.pbrt", Some([3840, 2160])),
            ViewName::Spheres => spheres::view(),
            ViewName::Wall => wall::view(),
            ViewName::Terrain => terrain::view(),
            ViewName::Interior => interior::view(),
            ViewName::Orthographic => dragon::orthographic(),
            ViewName::Thumbnail => dragon::of_file("dragon.pbrt", Some([64, 64])),
            ViewName::Film => dragon::of_file("dragon.pbrt", Some([8192, 8192])),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::competitors::{self, Device};
    use crate::differences::Differences;
    use crate::memory;
    use crate::picture::Picture;
    use feimos::simd::Level;

    /// Every competitor sees what feimos sees, but for a pixel in a thousand.
    #[test]
    fn all_competitors_see_the_same() {
        let _alone = memory::MEASURED.lock();
        let device = Device::new(2, None).unwrap();
        for name in [
            ViewName::Spheres,
            ViewName::Wall,
            ViewName::Terrain,
            ViewName::Interior,
            ViewName::Thumbnail,
        ] {
            let view = name.make().unwrap();
            let mut first: Option<Picture> = None;
            for mut competitor in competitors::all(&view, Level::detect(), &device) {
                competitor.build();
                let mut picture = Picture::new(view.width(), view.height());
                competitor.trace(0, &mut picture);
                let first = first.get_or_insert_with(|| picture.clone());
                let differences = Differences::between(first, &picture);
                let allowed = (view.width() * view.height()) as u64 / 1000;
                let whom = format!("{} in {name:?}: {differences:?}", competitor.name());
                assert!(
                    differences.hits <= allowed && differences.primitives <= allowed,
                    "{whom}"
                );
            }
            assert!(first.unwrap().hits() > 0);
        }
    }
}
