//! Embree's threads and instruction set.

use super::ffi;
use crate::Result;
use std::ffi::CString;

/// An Embree device.
#[derive(Debug)]
pub(crate) struct Device {
    pub(super) handle: ffi::RTCDevice,
}

// SAFETY: Embree's API may be called from any thread; a device handle is a counted reference to shared state.
unsafe impl Send for Device {}
// SAFETY: as above; nothing here changes the device after it is made.
unsafe impl Sync for Device {}

impl Device {
    /// `isa` as in Embree's configuration ("avx2"); without it, what the processor has.
    pub(crate) fn new(threads: usize, isa: Option<&str>) -> Result<Device> {
        let limit = isa.map(|isa| format!(",isa={isa}")).unwrap_or_default();
        let config = CString::new(format!("threads={threads},start_threads=1{limit}"))?;
        // SAFETY: the text ends with a zero and is read during the call only.
        let handle = unsafe { ffi::rtcNewDevice(config.as_ptr()) };
        if handle.is_null() {
            return Err(format!("Embree refuses the device {config:?}").into());
        }
        let device = Device { handle };
        match device.property(ffi::RTC_DEVICE_PROPERTY_VERSION_MAJOR) {
            3 => Ok(device),
            version => Err(format!("Embree 3 is wanted, this is version {version}").into()),
        }
    }

    /// Whether packets of 16 rays use instructions for 16 lanes.
    pub(crate) fn has_16_lanes(&self) -> bool {
        self.property(ffi::RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED) != 0
    }

    /// Panics where Embree has met an error since the last call.
    pub(super) fn check(&self) {
        // SAFETY: the handle is valid until `self` is dropped.
        let error = unsafe { ffi::rtcGetDeviceError(self.handle) };
        assert_eq!(
            error,
            ffi::RTC_ERROR_NONE,
            "Embree reports an error, see `RTCError` in rtcore_device.h"
        );
    }

    fn property(&self, property: u32) -> isize {
        // SAFETY: the handle is valid until `self` is dropped.
        unsafe { ffi::rtcGetDeviceProperty(self.handle, property) }
    }
}

impl Drop for Device {
    fn drop(&mut self) {
        // SAFETY: the reference is ours, and this is its last use.
        unsafe { ffi::rtcReleaseDevice(self.handle) };
    }
}
