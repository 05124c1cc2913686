//! The Python module `feimos._feimos`, which the package in `python/feimos` dresses.

mod camera;
mod casting;
mod error;
mod pool;
mod program;
mod scene;
mod work;

use pyo3::prelude::*;

// Only memory that Rust allocates comes from it; Python and NumPy have their own.
#[cfg(target_os = "linux")]
#[global_allocator]
static ALLOCATOR: feimos::huge_pages::HugePageAllocator = feimos::huge_pages::HugePageAllocator;

/// What `feimos` is made of. Its functions take arrays of one type, which the package prepares.
#[pymodule]
mod _feimos {
    #[pymodule_export]
    use super::camera::Camera;
    #[pymodule_export]
    use super::program::run;
    #[pymodule_export]
    use super::scene::Scene;

    #[pymodule_export]
    #[allow(non_upper_case_globals, reason = "a name of Python")]
    const __version__: &str = env!("CARGO_PKG_VERSION");
}
