//! Mappings that were freed and wait for the next array.

#![allow(unsafe_code)]

use super::mapping::unmap;
use std::sync::Mutex;

/// Mappings that are kept, and their bytes in sum. More would be memory that a phase pays for
/// another.
const MAX_COUNT: usize = 8;
const MAX_BYTES: usize = 16 << 20;

/// A mapping that nothing refers to: its address and bytes; 0 bytes for none.
#[derive(Clone, Copy)]
struct Spare {
    address: usize,
    size: usize,
}

const NONE: Spare = Spare {
    address: 0,
    size: 0,
};

/// The kept mappings, the latest first.
static SPARES: Mutex<[Spare; MAX_COUNT]> = Mutex::new([NONE; MAX_COUNT]);

/// A mapping of `size` bytes with any content, if one fits that was kept.
pub(super) fn take(size: usize) -> Option<*mut u8> {
    // If another thread is here, a new mapping costs less than waiting. Nothing panics inside.
    let mut spares = SPARES.try_lock().ok()?;
    let fits = |spare: &&mut Spare| spare.size >= size && spare.size / 2 <= size;
    let best = spares
        .iter_mut()
        .filter(fits)
        .min_by_key(|spare| spare.size)?;
    let Spare {
        address,
        size: kept,
    } = *best;
    best.size = 0;
    drop(spares);
    let start = std::ptr::with_exposed_provenance_mut::<u8>(address);
    // SAFETY: the spare is a whole mapping, which is this function's alone now.
    unsafe { unmap(start.wrapping_add(size), kept - size) };
    Some(start)
}

/// Keeps a mapping for [`take`], or unmaps it.
///
/// # Safety
/// `start` is a whole mapping of `size` bytes, and nothing refers to it.
pub(super) unsafe fn keep(start: *mut u8, size: usize) {
    let mut old = [NONE; MAX_COUNT];
    if size <= MAX_BYTES
        && let Ok(mut spares) = SPARES.try_lock()
    {
        old = *spares;
        spares[0] = Spare {
            address: start.expose_provenance(),
            size,
        };
        // The latest that fit move back by a place; the others go.
        let mut sum = size;
        for place in 1..MAX_COUNT {
            spares[place] = NONE;
            if sum + old[place - 1].size <= MAX_BYTES {
                sum += old[place - 1].size;
                spares[place] = std::mem::replace(&mut old[place - 1], NONE);
            }
        }
    } else {
        old[0] = Spare {
            address: start.expose_provenance(),
            size,
        };
    }
    for Spare { address, size } in old {
        let start = std::ptr::with_exposed_provenance_mut(address);
        // SAFETY: the caller promises it of the new mapping; an old one belongs to this function
        // since it left the list.
        unsafe { unmap(start, size) };
    }
}
