//! Decompresses gzip data in order, on another thread if there is one.

use std::io::{self, BufRead, Read};
use std::path::Path;
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;

use super::budget::Budget;
use super::gzip::{bomb, damaged};
use super::gzip_members::Members;
use super::has_threads;
use crate::error::Result;

/// The bytes that are decompressed at a time.
const BLOCK: usize = 1 << 18;

/// The blocks that are decompressed before they are needed, apart from the one that is being
/// decompressed.
const BLOCKS_AHEAD: usize = 2;

/// The content of gzip data.
pub(super) struct Inflated {
    blocks: Blocks,
    /// The block that is being read, and how much of it has been.
    block: (Vec<u8>, usize),
    /// The bytes of the compressed data.
    size: u64,
    /// The bytes that the budget allowed at the start.
    limit: u64,
}

type Compressed = Box<dyn BufRead + Send>;

/// The blocks of the content; one without bytes is the end.
enum Blocks {
    Here(Arc<Mutex<Members<Compressed>>>),
    Elsewhere(Receiver<io::Result<Vec<u8>>>),
    Ended,
}

impl Inflated {
    /// The content of `compressed`, which has `size` bytes.
    pub(super) fn new(compressed: Compressed, size: u64, budget: &Budget) -> Inflated {
        Inflated {
            blocks: Blocks::of(compressed),
            block: (Vec::new(), 0),
            size,
            limit: budget.decompressed_left(),
        }
    }

    /// Adds `count` bytes to `text`, fewer only at the end.
    ///
    /// # Errors
    /// Damaged data, and more content than `budget` allows.
    pub(super) fn read(
        &mut self,
        path: &Path,
        text: &mut Vec<u8>,
        count: usize,
        budget: &Budget,
    ) -> Result<()> {
        let mut missing = count;
        while missing > 0 {
            let (block, at) = &mut self.block;
            if *at == block.len() {
                (*block, *at) = (
                    self.blocks.next().map_err(|error| damaged(path, &error))?,
                    0,
                );
                let length = block.len() as u64;
                if length > budget.decompressed_left() {
                    return Err(bomb(path, self.size, self.limit).note(budget.advice()));
                }
                budget.charge_decompressed(length);
            }
            let taken = missing.min(block.len() - *at);
            if taken == 0 {
                break;
            }
            text.extend_from_slice(&block[*at..*at + taken]);
            *at += taken;
            missing -= taken;
        }
        Ok(())
    }
}

impl Blocks {
    fn of(compressed: Compressed) -> Blocks {
        let members = Arc::new(Mutex::new(Members::new(compressed)));
        if !has_threads() {
            return Blocks::Here(members);
        }
        let (sender, receiver) = sync_channel(BLOCKS_AHEAD);
        let there = Arc::clone(&members);
        match thread::Builder::new().spawn(move || send_blocks(&there, &sender)) {
            Ok(_) => Blocks::Elsewhere(receiver),
            // The system has no more threads.
            Err(_) => Blocks::Here(members),
        }
    }

    fn next(&mut self) -> io::Result<Vec<u8>> {
        let block = match self {
            Blocks::Here(members) => block(members),
            Blocks::Elsewhere(blocks) => blocks.recv().unwrap_or_else(|_| {
                Err(io::Error::other(
                    "the thread that decompresses it has ended",
                ))
            }),
            Blocks::Ended => Ok(Vec::new()),
        };
        if is_end(&block) {
            *self = Blocks::Ended;
        }
        block
    }
}

fn block(members: &Mutex<Members<Compressed>>) -> io::Result<Vec<u8>> {
    let mut members = members.lock().unwrap_or_else(PoisonError::into_inner);
    let mut block = Vec::with_capacity(BLOCK);
    members
        .by_ref()
        .take(BLOCK as u64)
        .read_to_end(&mut block)?;
    Ok(block)
}

/// Whether no other block follows.
fn is_end(block: &io::Result<Vec<u8>>) -> bool {
    block.as_ref().map_or(true, Vec::is_empty)
}

/// Sends blocks up to the end, the first error, or the end of the receiver.
fn send_blocks(members: &Mutex<Members<Compressed>>, blocks: &SyncSender<io::Result<Vec<u8>>>) {
    loop {
        let block = block(members);
        let is_end = is_end(&block);
        if blocks.send(block).is_err() || is_end {
            return;
        }
    }
}
