//! States as different as can be, in which a step must cost the same.

/// Changes x and v, which are those of the body at rest.
pub type State = fn(&mut [[f32; 3]], &mut [[f32; 3]]);

/// All of them, by name. The box is [`CELL`](crate::mesh::CELL) times a few wide, its low corner at the origin, and
/// the ground is at y = 0.
pub const STATES: [(&str, State); 13] = [
    ("rest", |_, _| {}),
    ("wild-spin", |x, v| {
        for (x, v) in x.iter().zip(v) {
            *v = [-50.0 * x[1], 50.0 * x[0], 1.0];
        }
    }),
    ("crushed-to-a-point", |x, _| x.fill([0.1; 3])),
    ("flattened", |x, _| x.iter_mut().for_each(|x| x[1] = 0.2)),
    ("mirrored", |x, _| x.iter_mut().for_each(|x| x[0] = -x[0])),
    ("half-inverted", |x, _| {
        x.iter_mut()
            .filter(|x| x[0] > 0.15)
            .for_each(|x| x[1] = -x[1]);
    }),
    ("random", |x, v| {
        let mut seed = 1_u32;
        for c in x.iter_mut().chain(v).flatten() {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            *c = (seed >> 8) as f32 / 8_388_608.0 - 1.0;
        }
    }),
    ("deep-in-contact", |x, v| {
        for (x, v) in x.iter_mut().zip(v) {
            x[1] -= 0.3;
            *v = [1.0, -2.0, 0.5];
        }
    }),
    ("just-in-contact", |x, _| {
        x.iter_mut().for_each(|x| x[1] -= 0.02)
    }),
    ("out-of-contact", |x, _| {
        x.iter_mut().for_each(|x| x[1] += 5.0)
    }),
    ("10-km/s", |_, v| v.fill([1e4, -1e4, 0.0])),
    ("subnormal", |_, v| v.fill([1e-39, 1e-41, 0.0])),
    ("after-a-refusal", |_, v| v.fill([f32::MAX, 0.0, 0.0])),
];

/// The state whose first step is refused; the step after it is counted, from rest.
pub const REFUSED: &str = "after-a-refusal";
