//! The primitives of a tile, from bins: sorted by tile and depth, then taken from the front.

mod large_entries;
mod segment_entries;
mod tile_entries;

pub(super) use self::segment_entries::SegmentEntries;
pub(super) use self::tile_entries::TileEntries;
