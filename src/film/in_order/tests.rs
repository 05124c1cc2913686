use super::*;
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
