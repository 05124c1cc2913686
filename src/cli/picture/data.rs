//! Channels as they were computed, in a format for programs.

use super::Caption;
use crate::cli::reporter::Reporter;
use feimos::film::npy_file::{self, Field};
use feimos::film::{Aov, ChannelName, Image, Metadata, exr_file, pfm_file};
use feimos::shape::Geometry;
use std::io::{self, Seek, Write};

/// What is written of an image, and how.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Data {
    pub(crate) format: DataFormat,
    pub(crate) aovs: Vec<Aov>,
    /// What `Z` and `t` hold where nothing is hit.
    pub(crate) miss: f32,
    /// How `prim` counts.
    pub(crate) within_instances: bool,
}

/// A format that holds what was computed.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum DataFormat {
    Exr {
        /// What `Z` is called in the file, where that is another name.
        depth_channel: Option<String>,
    },
    Npy,
    Pfm,
}

impl Data {
    pub(super) fn channels(&self) -> Vec<ChannelName> {
        self.aovs
            .iter()
            .flat_map(|aov| aov.channels())
            .copied()
            .collect()
    }

    pub(super) fn for_scene(mut self, geometry: &Geometry, reporter: &Reporter) -> Data {
        self.within_instances = geometry.counts_within_instances();
        let has = |name| self.aovs.contains(&name);
        if self.within_instances && has(Aov::Prim) && !has(Aov::Instance) {
            self.aovs.push(Aov::Instance);
            reporter.note(format_args!(
                "{} primitives are more than `prim` can count: it counts within the instance, and the channel `instance` \
                 tells which",
                geometry.primitive_count()
            ));
        }
        self
    }

    pub(super) fn encode(
        &self,
        image: &Image,
        caption: &Caption,
        out: &mut (impl Write + Seek),
    ) -> io::Result<()> {
        match &self.format {
            DataFormat::Exr { .. } => {
                // The header says what the depth channel is called.
                let header = caption.header.clone().unwrap_or_default();
                let metadata = Metadata {
                    camera: caption.camera,
                    ..Metadata::of_json(header)
                };
                exr_file::write(image, &metadata, out)
            }
            DataFormat::Npy => {
                let field = |aov: &Aov| Field {
                    name: aov.name(),
                    channels: aov.channels().to_vec(),
                };
                npy_file::write(
                    image,
                    &self.aovs.iter().map(field).collect::<Vec<Field>>(),
                    out,
                )
            }
            DataFormat::Pfm => pfm_file::write(image, &self.channels(), out),
        }
    }
}
