//! Allocates large arrays in huge pages, where the system has them.
//!
//! The system clears a page when it is first touched. For the same memory, pages of 4 KB take some
//! five times as long as pages of 2 MB, and as long again when they are freed. So arrays from 2 MB
//! on come directly from the system: they begin at a huge page, and it is advised to use huge
//! pages. They are never cleared a second time, so the threads that fill an array also touch it
//! first. When an array grows, its pages move without being copied.
//!
//! A few mappings that are freed are kept for the next arrays: otherwise each picture of many would
//! have the system clear the same pages again.
#![allow(unsafe_code)]

use self::mapping::{map_anywhere, unmap};
use rustix::mm::{Advice, MremapFlags, madvise, mremap, mremap_fixed};
use std::alloc::{GlobalAlloc, Layout, System};
use std::ffi::c_void;
use std::ptr::{copy_nonoverlapping, null_mut};

mod mapping;
mod spare;
#[cfg(test)]
mod tests;

/// Lets the system's allocator keep what is freed of arrays that are too small for huge pages.
///
/// That of glibc gives arrays from 128 KB on back to the system when they are freed, until a larger
/// array was freed. It sees none of the large arrays of [`HugePageAllocator`], so it would have the
/// pages of each picture's arrays cleared again. Freeing one array teaches it; nothing is touched.
pub fn prepare() {
    let array = Vec::<u8>::with_capacity(HUGE_PAGE - 1);
    drop(std::hint::black_box(array));
}

/// Bytes of a huge page, and of the smallest array that gets one.
const HUGE_PAGE: usize = 2 << 20;

/// Bytes that every size of a mapping is a multiple of: those of the largest page of any processor.
const PAGE: usize = 1 << 16;

/// The largest alignment that every mapping has.
const ALIGNMENT: usize = 4096;

/// An allocator for `#[global_allocator]`: large arrays in huge pages, anything else from
/// [`System`].
///
/// The system decides whether there are huge pages: on Linux,
/// `/sys/kernel/mm/transparent_hugepage/enabled` must be `madvise` or `always`.
#[derive(Debug, Clone, Copy, Default)]
pub struct HugePageAllocator;

// SAFETY: each layout is served either by `System` alone or by mappings alone, which `is_large`
// decides from the layout. A mapping has at least the size and the alignment of its layout. Nothing
// panics: sizes of layouts are below `isize::MAX`, so rounding them up cannot overflow.
unsafe impl GlobalAlloc for HugePageAllocator {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        if is_large(layout) {
            return spare::take(rounded(layout.size())).unwrap_or_else(|| map(layout.size()));
        }
        // SAFETY: the caller promises a size above 0.
        unsafe { System.alloc(layout) }
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        if is_large(layout) {
            // New mappings are zero.
            return map(layout.size());
        }
        // SAFETY: the caller promises a size above 0.
        unsafe { System.alloc_zeroed(layout) }
    }

    unsafe fn dealloc(&self, memory: *mut u8, layout: Layout) {
        // SAFETY: the caller promises that `memory` was allocated with this layout, so it is a
        // whole mapping if the layout is large, and memory of `System` otherwise.
        unsafe {
            match is_large(layout) {
                true => spare::keep(memory, rounded(layout.size())),
                false => System.dealloc(memory, layout),
            }
        }
    }

    unsafe fn realloc(&self, memory: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        // SAFETY: the caller promises a size that is valid for the alignment.
        let new = unsafe { Layout::from_size_align_unchecked(size, layout.align()) };
        // SAFETY: as in `dealloc`; and `size` is above 0. Old and new memory are both valid for
        // the smaller size, and do not overlap.
        unsafe {
            match (is_large(layout), is_large(new)) {
                (true, true) => resize(memory, rounded(layout.size()), rounded(size)),
                (false, false) => System.realloc(memory, layout, size),
                _ => {
                    let moved = self.alloc(new);
                    if !moved.is_null() {
                        copy_nonoverlapping(memory, moved, layout.size().min(size));
                        self.dealloc(memory, layout);
                    }
                    moved
                }
            }
        }
    }
}

fn is_large(layout: Layout) -> bool {
    layout.size() >= HUGE_PAGE && layout.align() <= ALIGNMENT
}

/// The bytes of the mapping for `size` bytes: whole huge pages if that takes little more.
fn rounded(size: usize) -> usize {
    let whole = size.next_multiple_of(HUGE_PAGE);
    match whole - size <= size / 8 {
        true => whole,
        false => size.next_multiple_of(PAGE),
    }
}

/// A new mapping of `size` bytes, rounded up, that is zero; null if the system refuses it.
fn map(size: usize) -> *mut u8 {
    let size = rounded(size);
    let more = size + HUGE_PAGE;
    let Some(all) = map_anywhere(more) else {
        // A limit of the address space may leave room for the array alone.
        return map_anywhere(size).unwrap_or(null_mut());
    };
    let before = all.addr().next_multiple_of(HUGE_PAGE) - all.addr();
    let start = all.wrapping_add(before);
    // SAFETY: the parts before `start` and after `size` bytes belong to the new mapping, and
    // nothing refers to them. The advice does not change the content of the rest.
    unsafe {
        unmap(all, before);
        unmap(start.wrapping_add(size), HUGE_PAGE - before);
        // Without huge pages, the usual ones do.
        let _ = madvise(start.cast(), size, Advice::LinuxHugepage);
    }
    start
}

/// Resizes a mapping and returns where it is then. If it cannot grow, it stays as it is, and the
/// result is null.
///
/// # Safety
/// `start` is a mapping of `old` bytes, and nothing else refers to it. Both sizes are rounded.
unsafe fn resize(start: *mut u8, old: usize, new: usize) -> *mut u8 {
    if new <= old {
        // SAFETY: the caller gives up the end of the mapping.
        unsafe { unmap(start.wrapping_add(new), old - new) };
        return start;
    }
    // SAFETY: the caller gives up the old place, if the mapping moves. Without a flag, it grows in
    // place or not at all.
    if unsafe { mremap(start.cast(), old, new, MremapFlags::empty()) }.is_ok() {
        return start;
    }
    let place = map(new);
    // SAFETY: as before. `place` is a new mapping of `new` bytes that nothing refers to. After an
    // error it may still be mapped or not, so it is left alone.
    let moved = unsafe {
        match place.is_null() {
            true => mremap(start.cast(), old, new, MremapFlags::MAYMOVE),
            false => mremap_fixed(start.cast(), old, new, MremapFlags::MAYMOVE, place.cast()),
        }
    };
    moved.map_or(null_mut(), <*mut c_void>::cast)
}
