//! Set of the saws that are finished.

use std::ops::Range;

/// Number of saws in a block.
pub(super) const BLOCK: usize = 1 << 16;
const WORD: usize = 64;

/// A set of saw numbers. A block in progress takes a bit for each saw; a block that is empty or full takes
/// almost no memory.
#[derive(Debug, Clone)]
pub struct Finished {
    count: usize,
    done: usize,
    blocks: Vec<Block>,
}

#[derive(Debug, Clone)]
enum Block {
    Empty,
    Begun { bits: Box<[u64]>, left: usize },
    Full,
}

impl Finished {
    /// The empty set, for `count` saws.
    pub fn none_of(count: usize) -> Self {
        Finished {
            count,
            done: 0,
            blocks: vec![Block::Empty; count.div_ceil(BLOCK)],
        }
    }

    /// Number of finished saws.
    pub fn done(&self) -> usize {
        self.done
    }

    /// Number of all saws.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Whether a saw is finished.
    pub fn has(&self, index: usize) -> bool {
        match &self.blocks[index / BLOCK] {
            Block::Empty => false,
            Block::Full => true,
            Block::Begun { bits, .. } => {
                let place = index % BLOCK;
                bits[place / WORD] >> (place % WORD) & 1 == 1
            }
        }
    }

    /// Adds a saw; returns whether it is new.
    pub fn insert(&mut self, index: usize) -> bool {
        let (number, place) = (index / BLOCK, index % BLOCK);
        let length = BLOCK.min(self.count - number * BLOCK);
        let block = &mut self.blocks[number];
        if let Block::Empty = block {
            *block = Block::Begun {
                bits: vec![0; length.div_ceil(WORD)].into(),
                left: length,
            };
        }
        let Block::Begun { bits, left } = block else {
            return false;
        };
        let (word, bit) = (&mut bits[place / WORD], 1 << (place % WORD));
        if *word & bit != 0 {
            return false;
        }
        *word |= bit;
        *left -= 1;
        if *left == 0 {
            *block = Block::Full;
        }
        self.done += 1;
        true
    }

    /// The numbers of all unfinished saws.
    pub fn into_missing(self) -> impl Iterator<Item = usize> + Send {
        let mut next = 0;
        std::iter::from_fn(move || {
            let first = self.missing(next, 1)?.start;
            next = first + 1;
            Some(first)
        })
    }

    /// The first consecutive unfinished saws from number `from` on, at most `most` of them; `None` if all of these
    /// saws are finished.
    pub fn missing(&self, from: usize, most: usize) -> Option<Range<usize>> {
        let mut first = from;
        while first < self.count && self.has(first) {
            // A full block is skipped as a whole.
            first = match self.blocks[first / BLOCK] {
                Block::Full => (first / BLOCK + 1) * BLOCK,
                _ => first + 1,
            };
        }
        let end = self.count.min(first.saturating_add(most));
        let last = (first..end).find(|index| self.has(*index)).unwrap_or(end);
        (first < last).then_some(first..last)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    /// The set agrees with a `BTreeSet`, also across the boundaries of blocks.
    #[test]
    fn saws_are_finished_once_and_the_missing_ones_are_found() {
        let count = 2 * BLOCK + 100;
        let (mut finished, mut set) = (Finished::none_of(count), BTreeSet::new());
        let mut state = 1_u64;
        for _ in 0..300_000 {
            // Knuth's linear congruential generator.
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            let index = (state >> 33) as usize % count;
            assert_eq!(finished.insert(index), set.insert(index));
        }
        assert_eq!(finished.done(), set.len());
        let (mut from, mut missing) = (0, 0);
        while let Some(range) = finished.missing(from, 50) {
            assert!(range.len() <= 50 && range.start >= from);
            assert!(range.clone().all(|index| !set.contains(&index)));
            assert!((from..range.start).all(|index| set.contains(&index)));
            missing += range.len();
            from = range.end;
        }
        assert_eq!(missing + set.len(), count);
        for index in 0..count {
            finished.insert(index);
        }
        assert_eq!((finished.done(), finished.missing(0, 1)), (count, None));
        assert!(finished.has(count - 1) && !finished.insert(0));
    }
}
