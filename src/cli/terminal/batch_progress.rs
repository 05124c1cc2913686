//! The progress of a batch in words: `12/300 images, about 40 s left`.

use crate::error::grouped;
use std::fmt::{self, Display, Formatter};
use std::time::{Duration, Instant};

/// Counts finished images, or scenes, and estimates the time that the others take.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BatchProgress {
    /// "images" or "scenes".
    things: &'static str,
    count: usize,
    done: usize,
    /// Those of `done` that took work: others existed already.
    worked: usize,
    /// The time that these took.
    spent: Duration,
    /// When the present one was begun.
    begin: Instant,
}

impl BatchProgress {
    /// A batch of `count` `things` begins now.
    pub(super) fn new(count: usize, things: &'static str) -> BatchProgress {
        BatchProgress {
            things,
            count,
            done: 0,
            worked: 0,
            spent: Duration::ZERO,
            begin: Instant::now(),
        }
    }

    /// The present `count` things are done, and the next one begins. They took work, or existed.
    pub(super) fn advance(&mut self, count: usize, took_work: bool) {
        self.done += count;
        if took_work {
            self.worked += count;
            self.spent += self.begin.elapsed();
        }
        self.begin = Instant::now();
    }

    /// The time that the rest will take if each takes as long as those before; `None` if that is
    /// unknown, or less than a second.
    fn left(&self) -> Option<Duration> {
        let each = self.spent.checked_div(u32::try_from(self.worked).ok()?)?;
        let rest = u32::try_from(self.count.saturating_sub(self.done)).ok()?;
        let all = each.saturating_mul(rest);
        let left = all.saturating_sub(self.begin.elapsed());
        Some(left).filter(|left| left.as_secs() > 0)
    }
}

impl Display for BatchProgress {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let (done, count) = (grouped(self.done as u64), grouped(self.count as u64));
        write!(f, "{done}/{count} {}", self.things)?;
        self.left()
            .map_or(Ok(()), |left| write!(f, ", about {} left", roughly(left)))
    }
}

/// A time in words, to some two digits.
fn roughly(time: Duration) -> String {
    const MINUTE: u64 = 60;
    const HOUR: u64 = 60 * MINUTE;
    let nearest = |unit: u64| (time.as_secs() + unit / 2) / unit;
    match time.as_secs() {
        0..20 => format!("{} s", time.as_secs()),
        20..90 => format!("{} s", 10 * nearest(10)),
        seconds if seconds < 90 * MINUTE => format!("{} min", nearest(MINUTE)),
        _ => format!("{} h", nearest(HOUR)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_rounded() {
        for (seconds, expected) in [
            (1, "1 s"),
            (19, "19 s"),
            (20, "20 s"),
            (44, "40 s"),
            (89, "90 s"),
            (90, "2 min"),
            (5399, "90 min"),
            (5400, "2 h"),
            (90_000, "25 h"),
        ] {
            assert_eq!(roughly(Duration::from_secs(seconds)), expected);
        }
    }

    #[test]
    fn the_estimate_leaves_out_what_took_no_work() {
        let mut batch = BatchProgress::new(1300, "images");
        assert_eq!(batch.to_string(), "0/1,300 images");
        batch.advance(290, false);
        assert_eq!(batch.to_string(), "290/1,300 images");
        batch.begin = Instant::now() - Duration::from_secs(4);
        batch.advance(1, true);
        assert_eq!(batch.to_string(), "291/1,300 images, about 67 min left");
        // The present one has taken longer than all of them should.
        batch.begin = Instant::now() - Duration::from_secs(10_000);
        assert_eq!(batch.to_string(), "291/1,300 images");
        batch.advance(1009, true);
        assert_eq!(batch.to_string(), "1,300/1,300 images");
    }
}
