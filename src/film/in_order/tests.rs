use super::*;
use crate::film::{
    Channel, ChannelName, Image, Metadata, PixelBounds, Samples, exr_file, npy_file, pfm_file,
    png_file,
};
use crate::progress::Progress;
use std::io::Cursor;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::Duration;

/// Runs `work` in pools of several sizes.
fn with_threads(work: impl Fn() + Send + Sync) {
    for threads in [1, 2, 5] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        pool.build().unwrap().install(&work);
    }
}

/// Takes longer for some parts than for others.
fn make(part: usize, buffer: &mut Vec<usize>) -> io::Result<()> {
    thread::sleep(Duration::from_micros((part * 37 % 11) as u64 * 20));
    buffer.clear();
    buffer.push(part);
    Ok(())
}

#[test]
fn parts_are_written_in_order() {
    with_threads(|| {
        for count in [0, 1, 2, 3, 100] {
            let mut written = Vec::new();
            write_in_order(count, make, |part| {
                written.extend_from_slice(part);
                Ok(())
            })
            .unwrap();
            assert!(written.into_iter().eq(0..count));
        }
    });
}

#[test]
fn an_error_ends_all_threads() {
    with_threads(|| {
        for bad in [0, 7, 99] {
            let mut written = Vec::new();
            let failing = |part: usize, buffer: &mut Vec<usize>| match part == bad {
                true => Err(io::Error::other("made")),
                false => make(part, buffer),
            };
            let write = |part: &Vec<usize>| {
                written.extend_from_slice(part);
                Ok(())
            };
            let error = write_in_order(100, failing, write).unwrap_err();
            assert_eq!(error.to_string(), "made");
            assert!(written.len() <= bad && written.iter().copied().eq(0..written.len()));

            let mut count = 0;
            let write = |part: &Vec<usize>| {
                count += 1;
                match part[0] == bad {
                    true => Err(io::Error::other("written")),
                    false => Ok(()),
                }
            };
            let error = write_in_order(100, make, write).unwrap_err();
            assert_eq!(error.to_string(), "written");
            assert_eq!(count, bad + 1);
        }
    });
}

#[test]
fn a_panic_ends_all_threads() {
    with_threads(|| {
        let panicking = |part: usize, buffer: &mut Vec<usize>| {
            assert!(part != 7, "part 7");
            make(part, buffer)
        };
        let run = || write_in_order(100, panicking, |_| Ok(()));
        assert!(catch_unwind(AssertUnwindSafe(run)).is_err());
        let run = || {
            write_in_order(100, make, |part| {
                assert!(part[0] != 7, "part 7");
                Ok(())
            })
        };
        assert!(catch_unwind(AssertUnwindSafe(run)).is_err());
    });
}

/// Progress of every writer adds up to the rows of the image, which take several parts.
#[test]
fn every_writer_counts_its_rows() {
    const ROWS: u32 = 700;
    let image = Image {
        display_window: (1000, ROWS),
        data_window: PixelBounds::of_film(1000, ROWS),
        channels: vec![Channel {
            name: ChannelName::Z,
            samples: Samples::F32(vec![1.5; 1000 * ROWS as usize]),
        }],
    };
    let (rgb, gray) = (vec![[7; 3]; 700_000], vec![7; 700_000]);
    let names = vec![ChannelName::Z];
    let field = npy_file::Field {
        name: "Z",
        channels: names.clone(),
    };
    let mut file = Cursor::new(Vec::new());
    type Write<'a> = &'a mut dyn FnMut(Progress) -> io::Result<()>;
    let count = |write: Write| {
        let rows = AtomicUsize::new(0);
        let report = |count| _ = rows.fetch_add(count, Ordering::Relaxed);
        write(Progress::new(&report)).unwrap();
        assert_eq!(rows.into_inner(), ROWS as usize);
    };
    let (out, size) = (&mut file, [1000, ROWS]);
    count(&mut |progress| exr_file::write(&image, &Metadata::default(), out, progress));
    count(&mut |progress| npy_file::write(&image, std::slice::from_ref(&field), out, progress));
    count(&mut |progress| pfm_file::write(&image, &names, out, progress));
    count(&mut |progress| png_file::write_rgb(size, &rgb, &[], out, progress));
    count(&mut |progress| png_file::write_gray16(size, &gray, &[], out, progress));
}
