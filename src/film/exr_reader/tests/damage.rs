use super::*;

/// Small files, one for each encoding that is read in its own way.
fn files() -> Vec<Vec<u8>> {
    let ways = [
        (Compression::Uncompressed, Blocks::ScanLines),
        (Compression::RLE, Blocks::Tiles((2, 2).into())),
        (Compression::ZIP1, Blocks::ScanLines),
        (Compression::ZIP16, Blocks::Tiles((3, 1).into())),
        (Compression::PIZ, Blocks::ScanLines),
        (Compression::PXR24, Blocks::ScanLines),
    ];
    let pixels = 9 * 8;
    let file = |(compression, blocks)| {
        let encoding = Encoding {
            compression,
            blocks,
            line_order: LineOrder::Increasing,
        };
        let channels = ["A", "R", "Y", "Z", "id"].map(|name| match name {
            "R" | "Y" => (name, as_f16(&vec![0.5; pixels])),
            "id" => (name, FlatSamples::U32(vec![3; pixels])),
            _ => (name, FlatSamples::F32(small(pixels))),
        });
        one_layer((9, 8), channels.to_vec(), encoding)
    };
    ways.into_iter().map(file).collect()
}

#[test]
fn truncated_files_are_refused() {
    for file in files() {
        read(&file).unwrap();
        for end in 0..file.len() {
            refused(&file[..end]);
        }
    }
}

#[test]
fn a_missing_end_is_found_without_reading_pixels() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("a.exr");
    let is_whole = |bytes: &[u8]| {
        std::fs::write(&path, bytes).unwrap();
        is_whole(&path)
    };
    for file in files() {
        assert!(is_whole(&file).unwrap());
        let table = {
            let mut header = Cursor::new(&file[..]);
            meta_data(&mut header).unwrap();
            header.position() as usize
        };
        for end in table..file.len() {
            assert!(!is_whole(&file[..end]).unwrap(), "{end} of {}", file.len());
        }
        for end in 0..table {
            assert_eq!(
                is_whole(&file[..end]).unwrap_err().kind(),
                ErrorKind::BadInput
            );
        }
        // Space that was preallocated but not written holds zeros.
        let zeros = [&file[..table], &vec![0; file.len() - table]].concat();
        assert!(!is_whole(&zeros).unwrap());
    }
}

#[test]
fn changed_bytes_are_read_or_refused() {
    for file in files() {
        for place in 0..file.len() {
            for change in [0x01, 0x80, 0xff, file[place]] {
                let mut changed = file.clone();
                changed[place] ^= change;
                drop(read(&changed));
            }
        }
    }
}

#[test]
fn other_files_are_refused() {
    for bytes in [
        &b""[..],
        b"v",
        b"WorldBegin",
        b"\x89PNG\r\n\x1a\n",
        &[0; 4096],
    ] {
        assert!(refused(bytes).contains("this is not an OpenEXR file"));
    }
    refused(&[&MAGIC[..], &[2, 0, 0, 0]].concat());
    refused(&[&MAGIC[..], &[0xff; 500]].concat());
}

#[test]
fn a_missing_chunk_is_refused() {
    let image = strange((3, 4), PixelBounds::of_film(3, 4));
    let file = of_our_writer(&image);
    // The table: the only place whose entries point behind it, in order.
    let entry = |at: usize| u64::from_le_bytes(file[at..at + 8].try_into().unwrap());
    let table = (0..file.len() - 32).find(|at| {
        (0..4).all(|row| entry(at + 8 * row) >= *at as u64 + 32) && entry(*at) == *at as u64 + 32
    });
    let table = table.expect("a table of four chunks");
    let mut missing = file.clone();
    missing[table + 16..table + 24].fill(0);
    refused(&missing);
    let mut twice = file.clone();
    twice.copy_within(table..table + 8, table + 8);
    assert!(
        refused(&twice).contains("repeats pixels of another chunk"),
        "{}",
        refused(&twice)
    );
    // Bytes between chunks do not matter.
    let mut moved = file.clone();
    let chunk = file[entry(table) as usize..entry(table + 8) as usize].to_vec();
    moved.extend([[7; 5].to_vec(), chunk].concat());
    moved[table..table + 8].copy_from_slice(&(file.len() as u64 + 5).to_le_bytes());
    assert_same(&image, &read(&moved).unwrap());
}

#[test]
fn no_memory_is_allocated_for_pixels_that_the_file_cannot_hold() {
    // A row of 2^24 pixels in 20 bytes.
    let encoding = Encoding {
        compression: Compression::ZIP1,
        ..Encoding::UNCOMPRESSED
    };
    let file = one_layer(
        (1 << 16, 1),
        vec![("Z", FlatSamples::F32(vec![1.0; 1 << 16]))],
        encoding,
    );
    read(&file).unwrap();
    let width = ((1 << 16) - 1i32).to_le_bytes();
    let mut wide = file.clone();
    for at in 0..file.len() - 4 {
        if file[at..at + 4] == width {
            wide[at..at + 4].copy_from_slice(&((1 << 24) - 1i32).to_le_bytes());
        }
    }
    assert!(
        refused(&wide).contains("for 16777216 x 1 pixels"),
        "{}",
        refused(&wide)
    );
}
