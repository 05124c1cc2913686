//! Tells the program what it is built for and how: Cargo says so to build scripts alone.

use std::env;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    for name in ["TARGET", "PROFILE"] {
        let value = env::var(name).expect("Cargo sets it for build scripts");
        println!("cargo::rustc-env=FEIMOS_{name}={value}");
    }
}
