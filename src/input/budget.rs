//! Limits what the files of one scene may expand to: a few bytes must not cost hours, or all
//! memory.

use std::collections::HashSet;
use std::path::Path;
use std::sync::{Mutex, MutexGuard, PoisonError};

use super::budget_factor::{BudgetFactor, MOST_TIMES};
use crate::error::{Diagnostic, Error, grouped};
use crate::file_id::FileId;
use crate::progress::Progress;

/// The bytes that all compressed files of a scene may have beyond [`MOST_TIMES`]: small ones may
/// shrink more.
const FREE_DECOMPRESSED: u64 = 64 << 20;
/// The bytes that repeated text, and stored meshes, may have beyond that.
const FREE_BYTES: u64 = 1 << 30;
/// The most files that a scene includes.
const MOST_FILES: u64 = 100_000;
/// The faces that subdivision may make in any case, for each control face, and in total.
const FREE_FACES: u64 = 1 << 22;
const FACES_PER_FACE: u64 = 1 << 12;
const MOST_FACES: u64 = 1 << 24;
/// The pairs of corners that cutting a polygon may look at, times the square of its corners.
const PAIRS_PER_SQUARE: u64 = 8;
/// The pairs that may have been looked at before another polygon is begun: times the square of the
/// corners of the largest, and for each byte read. A pair takes up to 10 ns.
const PAIRS_BEFORE_PER_SQUARE: u64 = 2;
const PAIRS_BEFORE_PER_BYTE: u64 = 1_000;

/// The expansion of a scene's files so far, and its limits. Also ends the reading if it is
/// cancelled.
#[derive(Default)]
pub(crate) struct Budget<'a> {
    factor: BudgetFactor,
    account: Mutex<Account>,
    progress: Progress<'a>,
}

#[derive(Debug, Default)]
struct Account {
    /// The files that have been read.
    known: HashSet<FileId>,
    /// Their bytes, counted once per file.
    distinct: u64,
    /// The bytes of all readings.
    read: u64,
    decompressed: u64,
    /// The bytes of text that was read again.
    repeated: u64,
    /// The bytes of stored meshes and images.
    stored: u64,
    files: u64,
    control_faces: u64,
    faces: u64,
    largest_polygon: u64,
    pairs: u64,
}

impl<'a> Budget<'a> {
    /// A budget without charges. Reading ends if `progress` cancels it.
    pub(crate) fn new(factor: BudgetFactor, progress: Progress<'a>) -> Budget<'a> {
        Budget {
            factor,
            account: Mutex::default(),
            progress,
        }
    }

    /// Unwinds if the reading is cancelled. Readers call it every few milliseconds.
    pub(crate) fn check_cancelled(&self) {
        self.progress.advance(0);
    }

    /// Like [`Budget::check_cancelled`], but only at every 4096th `number`.
    #[inline]
    pub(crate) fn check_sometimes(&self, number: u64) {
        if number.is_multiple_of(1 << 12) {
            self.check_cancelled();
        }
    }

    /// The budget of a single file of `size` bytes.
    pub(crate) fn of_bytes(size: usize) -> Budget<'a> {
        let budget = Budget::default();
        budget.enter_bytes(size as u64);
        budget
    }

    fn account(&self) -> MutexGuard<'_, Account> {
        self.account.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Notes that the file `path` is about to be read, and returns whether it was read before. A
    /// missing file has no bytes; its reader reports it.
    pub(crate) fn enter(&self, path: &Path) -> bool {
        let Some((id, size)) = FileId::with_size(path) else {
            return false;
        };
        let mut account = self.account();
        let is_new = account.known.insert(id);
        account.read = account.read.saturating_add(size);
        if is_new {
            account.distinct = account.distinct.saturating_add(size);
        }
        !is_new
    }

    /// Notes `size` bytes that do not come from a file.
    pub(crate) fn enter_bytes(&self, size: u64) {
        let mut account = self.account();
        account.read = account.read.saturating_add(size);
        account.distinct = account.distinct.saturating_add(size);
    }

    /// The bytes that may still be decompressed.
    pub(crate) fn decompressed_left(&self) -> u64 {
        let account = self.account();
        let limit = account
            .read
            .saturating_mul(MOST_TIMES)
            .saturating_add(FREE_DECOMPRESSED);
        self.factor
            .times(limit)
            .saturating_sub(account.decompressed)
    }

    /// Charges `bytes` that have been decompressed.
    pub(crate) fn charge_decompressed(&self, bytes: u64) {
        let mut account = self.account();
        account.decompressed = account.decompressed.saturating_add(bytes);
    }

    /// Charges the text of a scene file; `is_known` if it was read before.
    pub(crate) fn charge_text(&self, bytes: u64, is_known: bool) -> Result<(), Error> {
        let mut account = self.account();
        account.repeated = account
            .repeated
            .saturating_add(if is_known { bytes } else { 0 });
        let limit = self.factor.times(
            account
                .distinct
                .saturating_mul(MOST_TIMES)
                .saturating_add(FREE_BYTES),
        );
        self.check(account.repeated, limit, |limit| {
            format!(
                "the scene's files are read again and again: more than {} bytes of text",
                grouped(limit)
            )
        })
    }

    /// Charges a stored mesh or image.
    pub(crate) fn charge_stored(&self, bytes: u64) -> Result<(), Error> {
        let mut account = self.account();
        account.stored = account.stored.saturating_add(bytes);
        let limit = self.factor.times(
            account
                .distinct
                .saturating_mul(MOST_TIMES)
                .saturating_add(FREE_BYTES),
        );
        let read = account.distinct;
        self.check(account.stored, limit, |limit| {
            format!(
                "the scene's meshes and textures take more than {} bytes of memory, \
                 though its files have only {}",
                grouped(limit),
                grouped(read)
            )
        })
    }

    /// Charges an included file.
    pub(crate) fn charge_file(&self) -> Result<(), Error> {
        let mut account = self.account();
        account.files += 1;
        self.check(account.files, self.factor.times(MOST_FILES), |limit| {
            format!("the scene includes more than {} files", grouped(limit))
        })
    }

    /// Charges subdivision of `control` faces into `faces`.
    pub(crate) fn charge_faces(&self, control: u64, faces: u128) -> Result<(), Error> {
        let mut account = self.account();
        account.control_faces = account.control_faces.saturating_add(control);
        account.faces = account
            .faces
            .saturating_add(u64::try_from(faces).unwrap_or(u64::MAX));
        let limit = account
            .control_faces
            .saturating_mul(FACES_PER_FACE)
            .saturating_add(FREE_FACES)
            .min(MOST_FACES);
        self.check(account.faces, self.factor.times(limit), |limit| {
            let (faces, control) = (account.faces, account.control_faces);
            format!(
                "subdivision would make {} faces of the scene's {}: at most {} are made of so many",
                grouped(faces),
                grouped(control),
                grouped(limit)
            )
        })
        .map_err(|error| error.note("else take fewer levels"))
    }

    /// The pairs of corners that cutting a polygon of `corners` corners may look at.
    pub(crate) fn pairs_left(&self, corners: usize) -> u64 {
        let mut account = self.account();
        account.largest_polygon = account.largest_polygon.max(corners as u64);
        let of_largest = account
            .largest_polygon
            .saturating_mul(account.largest_polygon);
        let of_bytes = account.read.saturating_mul(PAIRS_BEFORE_PER_BYTE);
        let before = of_largest
            .saturating_mul(PAIRS_BEFORE_PER_SQUARE)
            .saturating_add(of_bytes);
        if account.pairs <= self.factor.times(before) {
            self.factor.times(pairs_of(corners as u64))
        } else {
            0
        }
    }

    /// Charges `pairs` of corners.
    pub(crate) fn charge_pairs(&self, pairs: u64) {
        let mut account = self.account();
        account.pairs = account.pairs.saturating_add(pairs);
    }

    /// The advice when a limit is reached.
    pub(crate) fn advice(&self) -> String {
        self.factor.advice()
    }

    fn check(
        &self,
        found: u64,
        limit: u64,
        message: impl FnOnce(u64) -> String,
    ) -> Result<(), Error> {
        if found <= limit {
            return Ok(());
        }
        Err(Error::bad_input(
            Diagnostic::new(message(limit)).note(self.advice()),
        ))
    }
}

/// The pairs that a polygon of `corners` corners may look at by itself.
pub(crate) fn pairs_of(corners: u64) -> u64 {
    PAIRS_PER_SQUARE.saturating_mul(corners.saturating_mul(corners))
}

#[cfg(test)]
mod tests;
