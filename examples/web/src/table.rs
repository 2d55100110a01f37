//! Handles: what JavaScript holds instead of a pointer.

use alloc::vec::Vec;

/// Things by handle. A handle that was freed, or never given, finds nothing, also when its place is taken again.
#[derive(Debug)]
pub struct Table<T> {
    places: Vec<(u16, Option<T>)>,
}

impl<T> Table<T> {
    pub const fn new() -> Self {
        Self { places: Vec::new() }
    }

    /// Keeps a thing; its handle is never 0. `None` where 65,535 are kept already.
    pub fn keep(&mut self, thing: T) -> Option<u32> {
        let free = self.places.iter().position(|(_, held)| held.is_none());
        let at = free.unwrap_or(self.places.len());
        let place = u32::from(u16::try_from(at + 1).ok()?);
        if free.is_none() {
            self.places.push((0, None));
        }
        let (generation, held) = self.places.get_mut(at)?;
        *held = Some(thing);
        Some(u32::from(*generation) << 16 | place)
    }

    fn place(&mut self, handle: u32) -> Option<&mut (u16, Option<T>)> {
        let at = (handle & 0xffff).checked_sub(1)? as usize;
        let place = self.places.get_mut(at)?;
        (u32::from(place.0) == handle >> 16).then_some(place)
    }

    pub fn get(&mut self, handle: u32) -> Option<&mut T> {
        self.place(handle)?.1.as_mut()
    }

    pub fn free(&mut self, handle: u32) -> bool {
        self.place(handle).is_some_and(|(generation, held)| {
            *generation = generation.wrapping_add(1);
            held.take().is_some()
        })
    }

    /// How many are kept.
    pub fn len(&self) -> usize {
        self.places
            .iter()
            .filter(|(_, held)| held.is_some())
            .count()
    }
}
