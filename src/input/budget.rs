//! The account of what the files of one scene may expand to: few bytes must not cost hours, or all memory.

use std::collections::HashSet;
use std::fmt;
use std::num::NonZeroU32;
use std::path::Path;
use std::sync::{Mutex, MutexGuard, PoisonError};

use crate::error::{Diagnostic, Error};
use crate::file_id::FileId;

/// A file does not expand to more times its size than this, unless it is made to fill the memory.
const MOST_TIMES: u64 = 256;
/// What compressed files of a scene may hold beyond that: small ones may shrink more.
const FREE_DECOMPRESSED: u64 = 64 << 20;
/// What text read again, and meshes stored, may take beyond that.
const FREE_BYTES: u64 = 1 << 30;
/// What an image may take beyond that: one of misses alone shrinks a thousand times.
const FREE_IMAGE: u64 = 256 << 20;
/// Files that a scene includes.
const MOST_FILES: u64 = 100_000;
/// Faces that subdivision makes whatever it begins with, those it makes for each face it begins with, and all of them.
const FREE_FACES: u64 = 1 << 22;
const FACES_PER_FACE: u64 = 1 << 12;
const MOST_FACES: u64 = 1 << 24;
/// Pairs of corners that may be looked at to cut a polygon, for the square of its corners.
const PAIRS_PER_SQUARE: u64 = 8;
/// Those that may have been looked at before another one is begun, for the square of the corners of the largest and for each byte
/// read. A pair takes up to 10 ns.
const PAIRS_BEFORE_PER_SQUARE: u64 = 2;
const PAIRS_BEFORE_PER_BYTE: u64 = 1_000;

/// The flag of the command line that raises all limits.
const FLAG: &str = "--input-budget";

/// How many times the usual limits input files may expand to: 1 where nothing is said.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct BudgetFactor(NonZeroU32);

impl BudgetFactor {
    /// The usual limits.
    pub const ONCE: BudgetFactor = BudgetFactor(NonZeroU32::MIN);
    /// No factor is larger.
    pub const MAX: u32 = 1_000_000;

    /// The factor `factor`, if it is from 1 to [`BudgetFactor::MAX`].
    pub fn new(factor: u32) -> Option<BudgetFactor> {
        NonZeroU32::new(factor)
            .filter(|factor| factor.get() <= Self::MAX)
            .map(BudgetFactor)
    }

    fn times(self, limit: u64) -> u64 {
        limit.saturating_mul(self.0.get().into())
    }

    /// Bytes that the pixels of an image may take whose file has `size` bytes.
    pub(crate) fn image_limit(self, size: u64) -> u64 {
        self.times(size.saturating_mul(MOST_TIMES).saturating_add(FREE_IMAGE))
    }

    /// What a message advises where a limit is reached.
    pub(crate) fn advice(self) -> String {
        let wanted = self.0.get().saturating_mul(2).min(Self::MAX);
        format!("if this is meant, raise what input files may expand to: {FLAG} {wanted}")
    }
}

impl Default for BudgetFactor {
    fn default() -> BudgetFactor {
        BudgetFactor::ONCE
    }
}

impl fmt::Display for BudgetFactor {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

/// What the files of a scene have expanded to so far, and may expand to.
#[derive(Debug, Default)]
pub(crate) struct Budget {
    factor: BudgetFactor,
    account: Mutex<Account>,
}

#[derive(Debug, Default)]
struct Account {
    /// The files that have been read.
    known: HashSet<FileId>,
    /// Their bytes, each once.
    distinct: u64,
    /// Bytes of all readings.
    read: u64,
    decompressed: u64,
    /// Bytes of text that was read again.
    repeated: u64,
    /// Bytes of stored meshes.
    stored: u64,
    files: u64,
    control_faces: u64,
    faces: u64,
    largest_polygon: u64,
    pairs: u64,
}

impl Budget {
    /// An account that nothing is charged to yet.
    pub(crate) fn new(factor: BudgetFactor) -> Budget {
        Budget {
            factor,
            account: Mutex::default(),
        }
    }

    /// The account of a file alone that has `size` bytes.
    pub(crate) fn of_bytes(size: usize) -> Budget {
        let budget = Budget::default();
        budget.enter_bytes(size as u64);
        budget
    }

    fn account(&self) -> MutexGuard<'_, Account> {
        self.account.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The file `path` is about to be read. Whether it was read before; a file that is not there has no bytes, and its reader
    /// says so.
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

    /// `size` bytes have been read from `path`, which is standard input or a pipe: a file has been counted by its size.
    pub(crate) fn enter_stream(&self, path: &Path, size: u64) {
        if FileId::with_size(path).is_none_or(|(_, known)| known == 0) {
            self.enter_bytes(size);
        }
    }

    /// `size` bytes of what is no file have been read.
    pub(crate) fn enter_bytes(&self, size: u64) {
        let mut account = self.account();
        account.read = account.read.saturating_add(size);
        account.distinct = account.distinct.saturating_add(size);
    }

    /// Bytes that may still be decompressed.
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

    /// `bytes` have been decompressed.
    pub(crate) fn charge_decompressed(&self, bytes: u64) {
        let mut account = self.account();
        account.decompressed = account.decompressed.saturating_add(bytes);
    }

    /// The file of a scene whose text has `bytes` is read; `is_known` says whether it has been before.
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
            format!("the scene's files are read again and again: more than {limit} bytes of text")
        })
    }

    /// A mesh that takes `bytes` is stored.
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
            format!("the scene's meshes take more than {limit} bytes of memory, though its files have only {read}")
        })
    }

    /// One more file is included.
    pub(crate) fn charge_file(&self) -> Result<(), Error> {
        let mut account = self.account();
        account.files += 1;
        self.check(account.files, self.factor.times(MOST_FILES), |limit| {
            format!("the scene includes more than {limit} files")
        })
    }

    /// Subdivision is about to make `faces` of `control` ones.
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
                "subdivision would make {faces} faces of the scene's {control}: at most {limit} are made of so many"
            )
        })
        .map_err(|error| error.note("else take fewer levels"))
    }

    /// Pairs of corners that may be looked at to cut a polygon of `corners` corners.
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

    /// `pairs` have been looked at.
    pub(crate) fn charge_pairs(&self, pairs: u64) {
        let mut account = self.account();
        account.pairs = account.pairs.saturating_add(pairs);
    }

    /// What a message advises where a limit is reached.
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

/// Pairs that a polygon of `corners` corners may cost by itself.
pub(crate) fn pairs_of(corners: u64) -> u64 {
    PAIRS_PER_SQUARE.saturating_mul(corners.saturating_mul(corners))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_factor_raises_every_limit() {
        let budgets = [1, 3].map(|factor| Budget::new(BudgetFactor::new(factor).unwrap()));
        let [once, thrice] = budgets.each_ref();
        assert_eq!(
            (once.decompressed_left(), thrice.decompressed_left()),
            (64 << 20, 192 << 20)
        );
        assert_eq!((once.pairs_left(10), thrice.pairs_left(10)), (800, 2400));
        assert!(
            once.charge_stored((1 << 30) + 1).is_err()
                && thrice.charge_stored((1 << 30) + 1).is_ok()
        );
        assert!(
            once.charge_text((1 << 30) + 1, true).is_err()
                && thrice.charge_text((1 << 30) + 1, true).is_ok()
        );
        assert!(once.charge_faces(1, 1 << 23).is_err() && thrice.charge_faces(1, 1 << 23).is_ok());
        assert_eq!(BudgetFactor::new(0), None);
        let error = once.charge_faces(1, 1).unwrap_err().to_string();
        assert!(error.contains("--input-budget 2"), "{error}");
        let error = thrice.charge_stored(u64::MAX).unwrap_err().to_string();
        assert!(error.contains("--input-budget 6"), "{error}");
    }

    #[test]
    fn what_is_read_raises_what_it_may_expand_to() {
        let budget = Budget::default();
        budget.enter_bytes(1 << 20);
        assert_eq!(budget.decompressed_left(), (256 + 64) << 20);
        budget.charge_decompressed(300 << 20);
        assert_eq!(budget.decompressed_left(), 20 << 20);
        assert!(budget.charge_stored(1280 << 20).is_ok());
        assert!(budget.charge_stored(1).is_err());
        assert!(
            budget.charge_text(u64::MAX, false).is_ok(),
            "for the first time"
        );
    }

    #[test]
    fn pairs_are_those_of_all_polygons() {
        let budget = Budget::default();
        assert_eq!(budget.pairs_left(100), 80_000);
        budget.charge_pairs(20_000);
        assert_eq!(
            (budget.pairs_left(100), budget.pairs_left(10)),
            (80_000, 800)
        );
        budget.charge_pairs(1);
        assert_eq!((budget.pairs_left(100), budget.pairs_left(10)), (0, 0));
        budget.enter_bytes(1);
        assert_eq!(budget.pairs_left(100), 80_000);
    }

    #[test]
    fn a_file_read_again_counts_once() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        std::fs::write(&path, [0; 1000]).unwrap();
        let budget = Budget::default();
        assert!(!budget.enter(&path));
        assert!(budget.enter(&folder.path().join(".").join("a")));
        let account = budget.account();
        assert_eq!((account.distinct, account.read), (1000, 2000));
        drop(account);
        assert!(!budget.enter(&folder.path().join("missing")));
    }
}
