//! Files that hold channels as computed: EXR, NPY and PFM.

use crate::cli::terminal::reporter::Reporter;
use crate::cli::terminal::words::counted;
use crate::film::npy_file::{self, Field};
use crate::film::{Aov, CameraAttributes, ChannelName, Image, Metadata, exr_file, pfm_file};
use crate::progress::Progress;
use crate::shape::Geometry;
use std::io::{self, Seek, Write};

/// The channels of a file, and its format.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ChannelFile {
    pub(crate) format: ChannelFormat,
    pub(crate) aovs: Vec<Aov>,
    /// The value of `Z` and `t` at a miss.
    pub(crate) miss: f32,
    /// `prim` counts within each instance, because the scene has more primitives than fit.
    pub(crate) within_instances: bool,
}

#[derive(Debug, Clone, PartialEq)]
pub(crate) enum ChannelFormat {
    Exr {
        /// The name of `Z` in the file, if it is another one.
        depth_channel: Option<String>,
    },
    Npy,
    Pfm,
}

impl ChannelFile {
    pub(crate) fn channels(&self) -> Vec<ChannelName> {
        self.aovs
            .iter()
            .flat_map(|aov| aov.channels())
            .copied()
            .collect()
    }

    /// Adds the channel `instance` if `prim` alone does not identify a primitive.
    pub(super) fn for_scene(mut self, geometry: &Geometry, reporter: &Reporter) -> ChannelFile {
        self.within_instances = geometry.counts_within_instances();
        let has = |aov| self.aovs.contains(&aov);
        if self.within_instances && has(Aov::Prim) && !has(Aov::Instance) {
            self.aovs.push(Aov::Instance);
            reporter.note(format_args!(
                "`prim` cannot count {}: it counts within each instance, \
                 and the channel `instance` is added",
                counted(geometry.primitive_count(), "primitive")
            ));
        }
        self
    }

    /// Writes `image`; only an EXR holds the `header` and the camera.
    pub(super) fn encode(
        &self,
        image: &Image,
        header: Option<&str>,
        camera: Option<CameraAttributes>,
        out: &mut (impl Write + Seek + Send),
        progress: Progress,
    ) -> io::Result<()> {
        match &self.format {
            ChannelFormat::Exr { .. } => {
                // The header names the depth channel.
                let metadata = Metadata::of_json(header.unwrap_or_default().to_owned());
                let metadata = Metadata { camera, ..metadata };
                exr_file::write_channels(image, &self.channels(), &metadata, out, progress)
            }
            ChannelFormat::Npy => {
                let field = |aov: &Aov| Field {
                    name: aov.name(),
                    channels: aov.channels().to_vec(),
                };
                let fields: Vec<Field> = self.aovs.iter().map(field).collect();
                npy_file::write(image, &fields, out, progress)
            }
            ChannelFormat::Pfm => pfm_file::write(image, &self.channels(), out, progress),
        }
    }
}
