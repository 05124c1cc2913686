//! Memory from the system.
#![allow(unsafe_code)]

use rustix::mm::{MapFlags, ProtFlags, mmap_anonymous, munmap};
use std::ffi::c_void;
use std::ptr::null_mut;

/// A new mapping of `size` bytes that is zero.
pub(super) fn map_anywhere(size: usize) -> Option<*mut u8> {
    let access = ProtFlags::READ | ProtFlags::WRITE;
    // SAFETY: without a fixed address, a new mapping changes no existing one.
    let mapped = unsafe { mmap_anonymous(null_mut(), size, access, MapFlags::PRIVATE) };
    mapped.ok().map(<*mut c_void>::cast)
}

/// Unmaps `size` bytes from `start`, if any.
///
/// # Safety
/// They are mapped by [`map_anywhere`], and nothing refers to them.
pub(super) unsafe fn unmap(start: *mut u8, size: usize) {
    if size > 0 {
        // SAFETY: the caller promises that nothing refers to this memory. The call fails only if
        // the process has too many mappings. Then the memory is lost, which is safe.
        let _ = unsafe { munmap(start.cast(), size) };
    }
}
