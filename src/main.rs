//! The `feimos` program: parse the command line, run, print what went wrong, exit.

use std::process::ExitCode;

#[cfg(target_os = "linux")]
#[global_allocator]
static ALLOCATOR: feimos::huge_pages::HugePageAllocator = feimos::huge_pages::HugePageAllocator;

fn main() -> ExitCode {
    #[cfg(target_os = "linux")]
    feimos::huge_pages::prepare();
    feimos::cli::run(std::env::args_os()).into()
}
