//! Messages that a batch would repeat for each image.

use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

/// Distinct messages that are remembered. Further ones are printed each time.
const MAX_MESSAGES: usize = 10_000;

/// Counts equal messages.
#[derive(Debug, Default)]
pub(super) struct Repetitions(Mutex<BTreeMap<String, Count>>);

#[derive(Debug)]
struct Count {
    /// The place among all distinct messages.
    place: usize,
    /// How often the message came again.
    again: u64,
}

impl Repetitions {
    /// Counts `message`, and returns true if it is new.
    pub(super) fn is_new(&self, message: &str) -> bool {
        let mut counts = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(count) = counts.get_mut(message) {
            count.again += 1;
            return false;
        }
        let place = counts.len();
        if place < MAX_MESSAGES {
            counts.insert(message.to_owned(), Count { place, again: 0 });
        }
        true
    }

    /// The messages that came again, in the order in which they came first, each with the number of
    /// repetitions. Forgets all messages.
    pub(super) fn take(&self) -> Vec<(String, u64)> {
        let mut counts = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let counts = std::mem::take(&mut *counts).into_iter();
        let repeated = counts.filter(|(_, count)| count.again > 0);
        let mut repeated: Vec<(String, Count)> = repeated.collect();
        repeated.sort_by_key(|(_, count)| count.place);
        let pairs = repeated.into_iter();
        pairs
            .map(|(message, count)| (message, count.again))
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn repetitions_are_counted_in_order() {
        let repetitions = Repetitions::default();
        let new = ["b", "a", "once", "a", "b", "b"].map(|message| repetitions.is_new(message));
        assert_eq!(new, [true, true, true, false, false, false]);
        assert_eq!(
            repetitions.take(),
            [("b".to_owned(), 2), ("a".to_owned(), 1)]
        );
        assert!(repetitions.is_new("b"));
    }

    #[test]
    fn memory_is_limited() {
        let repetitions = Repetitions::default();
        for number in 0..2 * MAX_MESSAGES {
            assert!(repetitions.is_new(&number.to_string()));
        }
        assert!(!repetitions.is_new("0"));
        assert!(repetitions.is_new(&(2 * MAX_MESSAGES - 1).to_string()));
    }
}
