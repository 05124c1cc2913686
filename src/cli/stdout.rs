//! Results, on standard output.

use feimos::error::{Error, Result};
use serde::Serialize;
use std::io::{self, Write};
use std::path::Path;

/// Writes all of `bytes`, unless making them failed.
pub(super) fn write_to_stdout(bytes: io::Result<Vec<u8>>) -> Result<()> {
    let written = bytes.and_then(|bytes| {
        let mut stdout = io::stdout().lock();
        stdout.write_all(&bytes).and_then(|()| stdout.flush())
    });
    written.map_err(|error| Error::writing(Path::new("standard output"), &error))
}

/// Writes one line of JSON.
pub(super) fn write_json_line(value: &impl Serialize) -> Result<()> {
    let mut line = serde_json::to_vec(value).expect("a record has no keys that JSON lacks");
    line.push(b'\n');
    write_to_stdout(Ok(line))
}
