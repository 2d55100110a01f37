//! The slots that a search fills: a list, and once it is full a heap with the shallowest contact on top.

use crate::coupling::Coupling;

/// The slots that are being filled.
#[derive(Debug)]
pub(crate) struct Slots<'a> {
    slots: &'a mut [Coupling],
    used: usize,
    dropped: u32,
}

impl<'a> Slots<'a> {
    pub fn new(slots: &'a mut [Coupling]) -> Self {
        slots.fill(Coupling::EMPTY);
        Self {
            slots,
            used: 0,
            dropped: 0,
        }
    }

    pub fn dropped(&self) -> u32 {
        self.dropped
    }

    /// In a full list takes the place of the shallowest, where that is shallower.
    #[inline(never)]
    pub fn push(&mut self, contact: &Coupling) {
        if let Some(slot) = self.slots.get_mut(self.used) {
            *slot = *contact;
            self.used += 1;
            return;
        }
        if self.dropped == 0 {
            for k in (0..self.slots.len() / 2).rev() {
                self.sink(k);
            }
        }
        self.dropped += 1;
        if let Some(top) = self.slots.first_mut()
            && top.predicted > contact.predicted
        {
            *top = *contact;
            self.sink(0);
        }
    }

    /// Moves what is at `k` down to where nothing below it is shallower.
    fn sink(&mut self, mut k: usize) {
        let depth = |slots: &[Coupling], k: usize| {
            slots
                .get(k)
                .map_or(f32::NEG_INFINITY, |slot| slot.predicted)
        };
        loop {
            let (a, b) = (2 * k + 1, 2 * k + 2);
            let lower = if depth(self.slots, b) > depth(self.slots, a) {
                b
            } else {
                a
            };
            if depth(self.slots, lower) <= depth(self.slots, k) {
                return;
            }
            if let Ok([upper, lower]) = self.slots.get_disjoint_mut([k, lower]) {
                core::mem::swap(upper, lower);
            }
            k = lower;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_full_list_holds_the_deepest() {
        for capacity in [0, 1, 2, 3, 10, 64] {
            let mut memory = [Coupling::EMPTY; 64];
            let mut slots = Slots::new(&mut memory[..capacity]);
            // 7^k mod 101: a shuffle of 1 ..= 100.
            let mut depth = 1_u8;
            for _ in 0..100 {
                slots.push(&Coupling {
                    predicted: -f32::from(depth),
                    ..Coupling::EMPTY
                });
                depth = (u16::from(depth) * 7 % 101) as u8;
            }
            assert_eq!(slots.dropped() as usize, 100 - capacity);
            let kept = &mut memory[..capacity];
            kept.sort_unstable_by(|a, b| a.predicted.total_cmp(&b.predicted));
            for (slot, depth) in kept.iter().zip((1..=100_u8).rev()) {
                assert_eq!(slot.predicted, -f32::from(depth));
            }
        }
    }
}
