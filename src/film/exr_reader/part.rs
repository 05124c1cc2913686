//! The part of a file to read: its windows and channels, checked.

use super::errors::wrong;
use crate::error::{Error, Result};
use crate::film::{CameraAttributes, ChannelName, Metadata, PixelBounds, exr_file};
use exr::compression::Compression;
use exr::math::Vec2;
use exr::meta::MetaData;
use exr::meta::attribute::{AttributeValue, ChannelDescription, IntegerBounds, SampleType, Text};
use exr::meta::header::Header;

/// A limit on the pixels of an image.
const MAX_AREA: u64 = 1 << 30;

/// A part, and the image that it becomes.
pub(super) struct Part<'a> {
    pub(super) index: usize,
    pub(super) header: &'a Header,
    pub(super) metadata: Metadata,
    /// Width and height of the film, and the pixels of it that the part holds.
    pub(super) film: (u32, u32),
    /// The data window, relative to the display window.
    pub(super) window: PixelBounds,
    pub(super) channels: Vec<FileChannel>,
}

/// A channel of the file.
pub(super) struct FileChannel {
    pub(super) name: ChannelName,
    pub(super) sample_type: SampleType,
    /// Bytes of a pixel in the channels before this one. Times the width, this is the place of the
    /// channel in a row.
    pub(super) offset: usize,
}

impl FileChannel {
    /// Bytes of a sample.
    pub(super) fn bytes(&self) -> usize {
        self.sample_type.bytes_per_sample()
    }
}

impl<'a> Part<'a> {
    /// The first part of the file with a channel that feimos knows.
    pub(super) fn find(meta: &'a MetaData) -> Result<Part<'a>> {
        let mut parts = meta.headers.iter().enumerate().map(|(index, header)| {
            let metadata = metadata(header);
            let channels = known_channels(header, &metadata);
            (index, header, metadata, channels)
        });
        let Some((index, header, metadata, channels)) =
            parts.find(|(.., channels)| !channels.is_empty())
        else {
            return Err(unknown_channels(meta));
        };
        if let Some(channel) = header
            .channels
            .list
            .iter()
            .find(|channel| channel.sampling != Vec2(1, 1))
        {
            let found = format!(
                "channel {} does not have a sample for every pixel",
                channel.name
            );
            return Err(wrong(found, "channels that are not subsampled"));
        }
        refuse_compression(header.compression)?;
        let (film, window) = windows(header)?;
        Ok(Part {
            index,
            header,
            metadata,
            film,
            window,
            channels,
        })
    }

    /// Bytes of all channels of a pixel.
    pub(super) fn bytes_per_pixel(&self) -> usize {
        self.header.channels.bytes_per_pixel
    }
}

/// The metadata of a header: the attribute of feimos and the camera.
fn metadata(header: &Header) -> Metadata {
    let attributes = &header.own_attributes;
    let json = match attributes.other.get(&Text::from(exr_file::ATTRIBUTE)) {
        Some(AttributeValue::Text(text)) => String::from_utf8_lossy(text.as_slice()).into_owned(),
        _ => String::new(),
    };
    let camera = attributes
        .world_to_camera
        .map(|world_to_camera| CameraAttributes {
            pixel_aspect: header.shared_attributes.pixel_aspect,
            screen_window_center: [
                attributes.screen_window_center.x(),
                attributes.screen_window_center.y(),
            ],
            screen_window_width: attributes.screen_window_width,
            world_to_camera,
            world_to_ndc: attributes.world_to_normalized_device,
        });
    Metadata {
        camera,
        ..Metadata::of_json(json)
    }
}

fn known_channels(header: &Header, metadata: &Metadata) -> Vec<FileChannel> {
    let mut channels: Vec<FileChannel> = Vec::new();
    let mut offset = 0;
    for ChannelDescription {
        name, sample_type, ..
    } in &header.channels.list
    {
        let known = ChannelName::ALL
            .into_iter()
            .find(|known| name.as_slice() == metadata.name_in_file(*known).as_bytes());
        if let Some(name) =
            known.filter(|known| channels.iter().all(|channel| channel.name != *known))
        {
            channels.push(FileChannel {
                name,
                sample_type: *sample_type,
                offset,
            });
        }
        offset += sample_type.bytes_per_sample();
    }
    channels
}

/// DWA and B44 are made for colours, which they change. Their decoders trust sizes and sums that
/// they read.
fn refuse_compression(compression: Compression) -> Result<()> {
    use Compression::{PIZ, PXR24, RLE, Uncompressed, ZIP1, ZIP16};
    match compression {
        Uncompressed | RLE | ZIP1 | ZIP16 | PIZ | PXR24 => Ok(()),
        other => {
            let expected = "none, RLE, ZIP, ZIPS, PIZ or PXR24: write it with one of these";
            Err(wrong(
                format!("the image is compressed by {other}, which is not read"),
                expected,
            ))
        }
    }
}

/// A limit on the channel names in a message.
const MAX_NAMES: usize = 10;

fn unknown_channels(meta: &MetaData) -> Error {
    let mut names = meta
        .headers
        .iter()
        .flat_map(|header| &header.channels.list)
        .map(|channel| channel.name.to_string());
    let mut found: Vec<String> = names.by_ref().take(MAX_NAMES).collect();
    found.extend(names.next().map(|_| "...".to_owned()));
    let known = ChannelName::ALL.map(ChannelName::name).join(", ");
    let found = format!(
        "feimos knows no channel of this image, which has {}",
        found.join(", ")
    );
    wrong(found, format!("one or more of {known}"))
}

/// Width and height of the film, and the pixels of it that the part holds.
fn windows(header: &Header) -> Result<((u32, u32), PixelBounds)> {
    let (data, display) = (
        header.data_window(),
        header.shared_attributes.display_window,
    );
    let shifted = |at: i32, origin: i32| u32::try_from(i64::from(at) - i64::from(origin)).ok();
    let x0 = shifted(data.position.x(), display.position.x());
    let y0 = shifted(data.position.y(), display.position.y());
    let [width, height] =
        [data.size.x(), data.size.y()].map(|side| u32::try_from(side).unwrap_or(u32::MAX));
    let film =
        [display.size.x(), display.size.y()].map(|side| u32::try_from(side).unwrap_or(u32::MAX));
    let window = x0.zip(y0).and_then(|(x0, y0)| {
        Some(PixelBounds {
            x0,
            x1: x0.checked_add(width)?,
            y0,
            y1: y0.checked_add(height)?,
        })
    });
    let within =
        window.filter(|window| PixelBounds::of_film(film[0], film[1]).contains_bounds(window));
    let Some(window) = within else {
        let found = format!(
            "the data window, {}, leaves the display window, {}",
            words(&data),
            words(&display)
        );
        return Err(wrong(
            found,
            "a part of the display window: crop the image to it first",
        ));
    };
    if window.is_empty() {
        return Err(wrong(
            format!("the image is {width} x {height} pixels"),
            "at least one pixel",
        ));
    }
    if film[0].max(film[1]) > PixelBounds::MAX_SIDE || window.area() > MAX_AREA {
        let found = format!(
            "the image is {width} x {height} pixels, of a film of {} x {}",
            film[0], film[1]
        );
        let note = format!(
            "up to {MAX_AREA} pixels, and a film with sides of up to {} pixels",
            PixelBounds::MAX_SIDE
        );
        return Err(wrong(found, note));
    }
    Ok(((film[0], film[1]), window))
}

fn words(bounds: &IntegerBounds) -> String {
    let (first, last) = (bounds.position, bounds.max());
    format!(
        "x {} to {} and y {} to {}",
        first.x(),
        last.x(),
        first.y(),
        last.y()
    )
}
