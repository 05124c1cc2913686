//! `feimos --version`: which program this is, for reports of bugs.

use feimos::simd::Level;

/// Where the C library is: in the program, which then runs on any Linux, or on the machine.
const C_RUNTIME: &str = if cfg!(target_feature = "crt-static") {
    "static"
} else {
    "dynamic"
};

/// The commit that the program was built from, where whoever built it said so.
const COMMIT: Option<&str> = option_env!("FEIMOS_COMMIT");

/// The version, how the program was built, and the instructions that this machine has.
pub(super) fn long_version() -> String {
    let build = [env!("FEIMOS_PROFILE"), env!("FEIMOS_TARGET"), C_RUNTIME].join(", ");
    let commit = COMMIT
        .map(|commit| format!("\ncommit  {commit}"))
        .unwrap_or_default();
    format!(
        "{}\nbuild   {build} C runtime{commit}\nSIMD    {}",
        env!("CARGO_PKG_VERSION"),
        Level::detect()
    )
}
