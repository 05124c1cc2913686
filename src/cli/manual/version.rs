//! `feimos --version`: the version, the build and the machine, for bug reports.

use crate::simd::Level;

/// How the C library is linked; a static program runs on any Linux.
const C_RUNTIME: &str = if cfg!(target_feature = "crt-static") {
    "static"
} else {
    "dynamic"
};

/// The commit that the program was built from, if the build knew it.
const COMMIT: Option<&str> = option_env!("FEIMOS_COMMIT");

/// The version, the build, and the widest instruction set of this machine.
pub(crate) fn long_version() -> String {
    let version = env!("CARGO_PKG_VERSION");
    let build = [env!("FEIMOS_PROFILE"), env!("FEIMOS_TARGET"), C_RUNTIME].join(", ");
    let commit = COMMIT.map_or(String::new(), |commit| format!("\ncommit  {commit}"));
    format!(
        "{version}\nbuild   {build} C runtime{commit}\nSIMD    {}",
        Level::detect()
    )
}
