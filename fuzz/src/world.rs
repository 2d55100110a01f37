//! What the newer parts of a scene add to it: shapes that turn, a shape of one's own, pins that a frame carries, and
//! loads on a surface.

use femto::collider::{Capsule, Cuboid, HeightField, Near, Placed, SignedDistance};
use femto::frame::Frame;
use femto::glam::{Mat3, Quat, Vec3};
use femto::load::{Gas, Pressure, Triangles, Wind};
use femto::surface::boundary_triangles;
use femto::{Collider, Pin, Scene};

use super::bytes::Bytes;
use super::scene::{SceneData, check_normal};

/// Heights of a grid, which a collider borrows.
pub struct Heights(Vec<f32>, [u32; 2]);

impl Heights {
    pub fn new(bytes: &mut Bytes<'_>) -> Self {
        let samples = [1 + bytes.below(4), 1 + bytes.below(4)];
        let count = samples[0] * samples[1] + usize::from(bytes.byte() == 255);
        Self(
            (0..count).map(|_| bytes.usual(&[0.0])).collect(),
            samples.map(|n| n as u32),
        )
    }
}

enum Shape<'a> {
    Capsule(Placed<Capsule>),
    Cuboid(Placed<Cuboid>),
    Field(Placed<HeightField<'a>>),
    /// Inside of a ball.
    Bowl(Vec3, f32),
    /// Anything at all.
    Wild(Near),
}

/// A borrowed shape, and its friction.
pub struct Solid<'a>(Shape<'a>, f32);

impl SignedDistance for Solid<'_> {
    fn near(&self, x: Vec3, later: f32) -> Near {
        match &self.0 {
            Shape::Capsule(shape) => shape.near(x, later),
            Shape::Cuboid(shape) => shape.near(x, later),
            Shape::Field(shape) => shape.near(x, later),
            Shape::Bowl(centre, radius) => {
                let bowl = |x: Vec3| {
                    let length = (x - centre).length().max(1e-9);
                    (radius - length, (centre - x) / length)
                };
                bowl.near(x, later)
            }
            Shape::Wild(near) => *near,
        }
    }

    fn moves(&self) -> bool {
        match &self.0 {
            Shape::Capsule(shape) => shape.moves(),
            Shape::Cuboid(shape) => shape.moves(),
            Shape::Field(shape) => shape.moves(),
            Shape::Bowl(..) => false,
            Shape::Wild(near) => near.velocity != Vec3::ZERO,
        }
    }
}

impl<'a> Solid<'a> {
    pub fn new(bytes: &mut Bytes<'_>, heights: &'a Heights) -> Option<Self> {
        let mut vector = |usual: &[f32]| Vec3::from(bytes.usual_vector(usual));
        let (a, b) = (vector(&[0.0, 1.0]), vector(&[1.0, 0.5]));
        let size = bytes.usual(&[0.5, 1.0]);
        let kind = bytes.below(5);
        let frame = frame(bytes);
        let shape = match kind {
            0 => Shape::Capsule(Placed::new(Capsule::new(a, b, size).ok()?, frame?)),
            1 => Shape::Cuboid(Placed::new(Cuboid::new(a, b).ok()?, frame?)),
            2 => {
                let field = HeightField::new(&heights.0, heights.1, [b.x, b.z]);
                Shape::Field(Placed::new(field.ok()?, frame?))
            }
            3 => Shape::Bowl(a, size),
            _ => Shape::Wild(Near {
                velocity: Vec3::from(bytes.usual_vector(&[0.0])),
                acceleration: Vec3::from(bytes.usual_vector(&[0.0])),
                way_out: Vec3::from(bytes.usual_vector(&[0.0, 1.0])),
                ..Near::fixed(size, a)
            }),
        };
        let solid = Self(shape, bytes.usual(&[0.0, 0.5]));
        let ours = matches!(kind, 0..3);
        let collider = solid.collider()?;
        if ours {
            check_normal(&collider, bytes);
        }
        Some(solid)
    }

    fn collider(&self) -> Option<Collider<'_>> {
        Collider::shape(self).with_friction(self.1).ok()
    }

    pub fn advance(&mut self, time: f32) {
        match &mut self.0 {
            Shape::Capsule(shape) => shape.advance(time),
            Shape::Cuboid(shape) => shape.advance(time),
            Shape::Field(shape) => shape.advance(time),
            Shape::Bowl(..) | Shape::Wild(_) => {}
        }
    }
}

/// A pose with velocity and spin.
pub fn frame(bytes: &mut Bytes<'_>) -> Option<Frame> {
    let origin = bytes.usual_vector(&[0.0]).into();
    let [x, y, z] = bytes.usual_vector(&[0.0, 1.0]);
    let turn = Mat3::from_quat(Quat::from_xyzw(x, y, z, 1.0).normalize());
    let frame = Frame::new(origin, turn).ok()?;
    frame
        .with_velocity(bytes.usual_vector(&[0.0]).into())
        .ok()?
        .with_spin(bytes.usual_vector(&[0.0, 1.0]).into())
        .ok()
}

enum Load {
    Pressure(Pressure),
    Gas(Gas),
    Wind(Wind),
}

impl Load {
    fn new(bytes: &mut Bytes<'_>, volume: f32) -> Option<Self> {
        match bytes.below(3) {
            0 => Pressure::new(bytes.number()).ok().map(Self::Pressure),
            1 => {
                let volume = bytes.usual(&[volume, 1.0]);
                let gas = Gas::new(bytes.usual(&[1e3, 1e5]), volume).ok()?;
                gas.with_outside(bytes.usual(&[0.0, 1e5]))
                    .ok()
                    .map(Self::Gas)
            }
            _ => {
                let wind = Wind::new(bytes.vector().into(), bytes.usual(&[1.2])).ok()?;
                let wind = wind.with_coefficients(bytes.usual(&[2.0]), bytes.usual(&[0.0, 2.0]));
                wind.ok().map(Self::Wind)
            }
        }
    }
}

/// A scene with all that this page knows, over data of the caller's.
pub struct World<'a> {
    pub plain: SceneData,
    solids: &'a mut [Solid<'a>],
    triangles: Vec<[u32; 3]>,
    loads: Vec<Load>,
    carrier: Option<(Frame, Vec<[f32; 3]>)>,
}

impl<'a> World<'a> {
    pub fn new(
        bytes: &mut Bytes<'_>,
        x: &[[f32; 3]],
        tets: &[[u32; 4]],
        solids: &'a mut [Solid<'a>],
    ) -> Self {
        let plain = SceneData::new(bytes, x.len());
        let mut triangles = boundary_triangles(tets);
        if bytes.byte() == 255 {
            // Any triangles at all, but for nodes that are not there.
            triangles.push([
                bytes.byte().into(),
                bytes.byte().into(),
                bytes.byte().into(),
            ]);
        }
        let mut loads = Vec::new();
        match Triangles::new(&triangles, x.len()) {
            Ok(surface) => {
                let volume = surface.volume(x);
                loads.extend((0..bytes.below(4)).filter_map(|_| Load::new(bytes, volume)));
            }
            Err(error) => {
                assert!(!error.to_string().is_empty());
                triangles.clear();
            }
        }
        let carrier = bytes.flag().then(|| frame(bytes)).flatten().map(|frame| {
            let mut local = vec![[0.0; 3]; plain.pins.len()];
            frame.hold(&plain.pins, x, &mut local);
            (frame, local)
        });
        Self {
            plain,
            solids,
            triangles,
            loads,
            carrier,
        }
    }

    /// Forces and pins of a step from here on; then `step` with the scene.
    pub fn act<T>(
        &self,
        x: &[[f32; 3]],
        v: &[[f32; 3]],
        dt: f32,
        step: impl FnOnce(&Scene<'_>) -> T,
    ) -> T {
        let mut forces = self.plain.forces.clone();
        if !self.loads.is_empty() && forces.is_empty() {
            forces = vec![[0.0; 3]; x.len()];
        }
        // None where the triangles were refused.
        if let Ok(surface) = Triangles::new(&self.triangles, x.len()) {
            for load in &self.loads {
                match load {
                    Load::Pressure(load) => load.add(&surface, x, &mut forces),
                    Load::Gas(gas) => {
                        let inside = gas.pressure(surface.volume(x));
                        inside.add(&surface, x, &mut forces);
                    }
                    Load::Wind(load) => load.add(&surface, x, v, &mut forces),
                }
            }
        }
        let mut pins: Vec<Pin> = self.plain.pins.clone();
        if let Some((frame, local)) = &self.carrier {
            frame.carry(local, x, dt, &mut pins);
        }
        let mut colliders = self.plain.colliders.clone();
        colliders.extend(self.solids.iter().filter_map(Solid::collider));
        step(&Scene {
            gravity: self.plain.gravity,
            forces: &forces,
            pins: &pins,
            colliders: &colliders,
        })
    }

    /// Moves on what moves by itself.
    pub fn advance(&mut self, dt: f32) {
        for collider in &mut self.plain.colliders {
            collider.advance(dt);
        }
        for solid in self.solids.iter_mut() {
            solid.advance(dt);
        }
        if let Some((frame, _)) = &mut self.carrier {
            frame.advance(dt);
        }
    }
}
