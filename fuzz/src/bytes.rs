//! Numbers from a fuzzer's bytes, so that one byte changed is one number changed.

/// Where the ranges of f32, of its squares, and of its digits end.
const EDGES: [f32; 16] = [
    0.0,
    f32::from_bits(1),
    f32::MIN_POSITIVE,
    1e-30,
    1e-20,
    1e-10,
    f32::EPSILON,
    1e-3,
    1e3,
    1e8,
    1e15,
    2e19,
    1e30,
    f32::MAX,
    f32::INFINITY,
    f32::NAN,
];

/// Bytes that are read once. Where they have run out, they are zero.
pub struct Bytes<'a>(&'a [u8]);

impl<'a> Bytes<'a> {
    pub fn new(data: &'a [u8]) -> Self {
        Self(data)
    }

    pub fn byte(&mut self) -> u8 {
        let Some((&first, rest)) = self.0.split_first() else {
            return 0;
        };
        self.0 = rest;
        first
    }

    pub fn below(&mut self, bound: usize) -> usize {
        usize::from(self.byte()) % bound
    }

    pub fn flag(&mut self) -> bool {
        self.byte() & 1 == 1
    }

    pub fn word(&mut self) -> u32 {
        u32::from_le_bytes([self.byte(), self.byte(), self.byte(), self.byte()])
    }

    /// Mostly a small multiple of 1/16, so that numbers coincide and cancel; else an edge, or any bits.
    pub fn number(&mut self) -> f32 {
        match self.byte() {
            small @ 0..96 => f32::from(small) / 16.0,
            small @ 96..192 => (f32::from(small) - 192.0) / 16.0,
            edge @ 192..208 => EDGES[usize::from(edge - 192)],
            edge @ 208..224 => -EDGES[usize::from(edge - 208)],
            224.. => f32::from_bits(self.word()),
        }
    }

    pub fn vector(&mut self) -> [f32; 3] {
        [self.number(), self.number(), self.number()]
    }

    /// One of the usual values, the first for a zero byte, or any number.
    pub fn usual(&mut self, values: &[f32]) -> f32 {
        let choice = self.below(values.len() + 1);
        values.get(choice).copied().unwrap_or_else(|| self.number())
    }

    pub fn usual_vector(&mut self, values: &[f32]) -> [f32; 3] {
        [self.usual(values), self.usual(values), self.usual(values)]
    }
}
