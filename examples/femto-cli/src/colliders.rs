//! Colliders of a scene: checked, where they are at a time, and as the solver takes them.

use std::sync::Arc;

use femto::collider::{
    self, Capsule, ColliderError, Cuboid, HeightField, Near, Placed, SignedDistance,
};
use femto::frame::Frame;
use femto::glam::{Mat3, Vec3};
use glam::{DMat3, DVec3};

use crate::error::Error;
use crate::place::rotation;
use crate::scene::Checker;
use crate::scene_file as file;

/// At time 0, in f64: a moving collider is advanced before it is rounded.
#[derive(Clone, Debug)]
pub struct Collider {
    pub shape: Shape,
    pub friction: f32,
    pub motion: Motion,
}

#[derive(Clone, Debug)]
pub enum Shape {
    /// Keeps normal·x ≥ offset; the normal has length 1.
    Plane {
        normal: DVec3,
        offset: f64,
    },
    Sphere {
        centre: DVec3,
        radius: f64,
    },
    Capsule {
        ends: [DVec3; 2],
        radius: f64,
    },
    /// Half its lengths along its axes, the columns.
    Box {
        centre: DVec3,
        half: DVec3,
        axes: DMat3,
    },
    /// Along the x and z of its axes, up their y.
    HeightField {
        corner: DVec3,
        axes: DMat3,
        grid: Arc<Grid>,
    },
}

/// Heights by rows of constant x.
#[derive(Debug)]
pub struct Grid {
    pub heights: Vec<f32>,
    pub samples: [u32; 2],
    pub spacing: [f64; 2],
}

/// Of a rigid body that turns about a pivot which moves.
#[derive(Clone, Copy, Debug)]
pub struct Motion {
    pub velocity: DVec3,
    pub spin: DVec3,
    pub pivot: DVec3,
}

impl Motion {
    fn turn(&self, time: f64) -> DMat3 {
        let axis = self.spin.try_normalize();
        axis.map_or(DMat3::IDENTITY, |k| {
            rotation(k, (self.spin.length() * time).to_degrees())
        })
    }

    fn at(&self, x: DVec3, time: f64) -> DVec3 {
        if self.spin == DVec3::ZERO {
            return x + self.velocity * time;
        }
        self.pivot + self.velocity * time + self.turn(time) * (x - self.pivot)
    }

    /// The frame about the pivot at a time, for the solver.
    pub fn frame(&self, time: f64) -> Result<Frame, String> {
        let turn = self.turn(time);
        let columns = [turn.x_axis, turn.y_axis, turn.z_axis].map(single);
        let [x, y, z] = columns;
        Frame::new(
            single(self.pivot + self.velocity * time),
            Mat3::from_cols(x, y, z),
        )
        .and_then(|frame| frame.with_velocity(single(self.velocity)))
        .and_then(|frame| frame.with_spin(single(self.spin)))
        .map_err(|e| e.to_string())
    }
}

fn single(v: DVec3) -> Vec3 {
    Vec3::from_array(v.to_array().map(|x| x as f32))
}

impl Collider {
    pub fn shape_at(&self, time: f64) -> Shape {
        let motion = &self.motion;
        let turn = motion.turn(time);
        match &self.shape {
            &Shape::Plane { normal, offset } if motion.spin == DVec3::ZERO => Shape::Plane {
                normal,
                offset: offset + normal.dot(motion.velocity * time),
            },
            &Shape::Plane { normal, offset } => {
                let at = motion.at(normal * offset, time);
                let normal = turn * normal;
                Shape::Plane {
                    normal,
                    offset: normal.dot(at),
                }
            }
            &Shape::Sphere { centre, radius } => Shape::Sphere {
                centre: motion.at(centre, time),
                radius,
            },
            &Shape::Capsule { ends, radius } => Shape::Capsule {
                ends: ends.map(|end| motion.at(end, time)),
                radius,
            },
            &Shape::Box { centre, half, axes } => Shape::Box {
                centre: motion.at(centre, time),
                half,
                axes: turn * axes,
            },
            Shape::HeightField { corner, axes, grid } => Shape::HeightField {
                corner: motion.at(*corner, time),
                axes: turn * *axes,
                grid: grid.clone(),
            },
        }
    }
}

/// A collider as the solver takes it: one that it has itself, or a shape in a frame.
pub enum Solid<'a> {
    Plain(&'a Collider),
    Placed(&'a Collider, Placed<Own<'a>>),
}

/// Any shape, in the coordinates of its motion's frame at time 0.
pub struct Own<'a>(Box<dyn SignedDistance + 'a>);

impl SignedDistance for Own<'_> {
    fn near(&self, x: Vec3, later: f32) -> Near {
        self.0.near(x, later)
    }
}

impl<'a> Solid<'a> {
    pub fn new(collider: &'a Collider) -> Result<Self, String> {
        let motion = &collider.motion;
        let from_pivot = |x: DVec3| single(x - motion.pivot);
        let text = |e: ColliderError| e.to_string();
        let fixed = |at: DVec3, axes: DMat3| {
            let columns = [axes.x_axis, axes.y_axis, axes.z_axis].map(single);
            let [x, y, z] = columns;
            Frame::new(from_pivot(at), Mat3::from_cols(x, y, z)).map_err(|e| e.to_string())
        };
        let own: Box<dyn SignedDistance + 'a> = match &collider.shape {
            Shape::Plane { .. } | Shape::Sphere { .. } if motion.spin == DVec3::ZERO => {
                return Ok(Solid::Plain(collider));
            }
            &Shape::Plane { normal, offset } => {
                let n = single(normal);
                let offset = (offset - normal.dot(motion.pivot)) as f32;
                Box::new(move |x: Vec3| (n.dot(x) - offset, n))
            }
            &Shape::Sphere { centre, radius } => {
                let c = from_pivot(centre);
                Box::new(Capsule::new(c, c, radius as f32).map_err(text)?)
            }
            &Shape::Capsule { ends, radius } => {
                let [from, to] = ends.map(from_pivot);
                Box::new(Capsule::new(from, to, radius as f32).map_err(text)?)
            }
            &Shape::Box { centre, half, axes } => {
                let cuboid = Cuboid::new(Vec3::ZERO, single(half)).map_err(text)?;
                Box::new(Placed::new(cuboid, fixed(centre, axes)?))
            }
            Shape::HeightField { corner, axes, grid } => {
                let spacing = grid.spacing.map(|s| s as f32);
                let field = HeightField::new(&grid.heights, grid.samples, spacing).map_err(text)?;
                Box::new(Placed::new(field, fixed(*corner, *axes)?))
            }
        };
        Ok(Solid::Placed(
            collider,
            Placed::new(Own(own), motion.frame(0.0)?),
        ))
    }

    /// Where it is at a time; a substep of a moving one goes on from there.
    pub fn move_to(&mut self, time: f64) -> Result<(), String> {
        if let Solid::Placed(collider, placed) = self {
            placed.frame = collider.motion.frame(time)?;
        }
        Ok(())
    }

    pub fn at(&self, time: f64) -> Result<collider::Collider<'_>, ColliderError> {
        match self {
            Solid::Placed(collider, placed) => {
                collider::Collider::shape(placed).with_friction(collider.friction)
            }
            Solid::Plain(collider) => {
                let built = match collider.shape_at(time) {
                    Shape::Sphere { centre, radius } => {
                        collider::Collider::sphere(single(centre), radius as f32)
                    }
                    Shape::Plane { normal, offset } => {
                        collider::Collider::half_space(single(normal), offset as f32)
                    }
                    _ => Err(ColliderError::Borrowed),
                }?;
                built
                    .with_friction(collider.friction)?
                    .with_velocity(single(collider.motion.velocity))
            }
        }
    }
}

const SHAPES: &str = "must have exactly one shape: plane, sphere, capsule, box or height_field";

/// Checks a collider of the file.
pub fn check(check: &Checker, key: &str, raw: &file::Collider) -> Result<Collider, Error> {
    let at = |name: &str| format!("{key}.{name}");
    let friction = check.not_negative(&at("friction"), raw.friction)?;
    check.vector(&at("velocity"), raw.velocity)?;
    check.vector(&at("angular_velocity"), raw.angular_velocity)?;
    let kinds = [
        ("plane", raw.plane.is_some()),
        ("sphere", raw.sphere.is_some()),
        ("capsule", raw.capsule.is_some()),
        ("box", raw.cuboid.is_some()),
        ("height_field", raw.height_field.is_some()),
    ];
    let named: Vec<&str> = kinds.iter().filter(|k| k.1).map(|k| k.0).collect();
    if named.len() != 1 {
        return Err(check.wrong(key, &named, SHAPES));
    }
    let (shape, middle) = if let Some(plane) = &raw.plane {
        let (normal, length) = check.direction(&at("plane.normal"), plane.normal)?;
        check.any(&at("plane.offset"), plane.offset)?;
        // n·x ≥ offset for the normal as it is written: both sides are divided.
        let offset = plane.offset / length;
        check.any(&at("plane.offset / |normal|"), offset)?;
        (Shape::Plane { normal, offset }, normal * offset)
    } else if let Some(sphere) = &raw.sphere {
        let (centre, radius) = check.sphere(&at("sphere"), sphere)?;
        (Shape::Sphere { centre, radius }, centre)
    } else if let Some(capsule) = &raw.capsule {
        check.vector(&at("capsule.from"), capsule.from)?;
        check.vector(&at("capsule.to"), capsule.to)?;
        check.positive(&at("capsule.radius"), capsule.radius)?;
        let ends = [capsule.from, capsule.to].map(|end| DVec3::from(end.0));
        let radius = capsule.radius;
        (Shape::Capsule { ends, radius }, (ends[0] + ends[1]) / 2.0)
    } else if let Some(cuboid) = &raw.cuboid {
        check.vector(&at("box.centre"), cuboid.centre)?;
        for size in cuboid.size.0 {
            check.positive(&at("box.size"), size)?;
        }
        let axes = axes(check, &at("box.rotate"), cuboid.rotate.as_ref())?;
        let centre = DVec3::from(cuboid.centre.0);
        let half = DVec3::from(cuboid.size.0) / 2.0;
        (Shape::Box { centre, half, axes }, centre)
    } else {
        let field = raw.height_field.as_ref().expect("one shape is there");
        height_field(check, &at("height_field"), field)?
    };
    let pivot = match raw.pivot {
        Some(pivot) => {
            check.vector(&at("pivot"), pivot)?;
            DVec3::from(pivot.0)
        }
        None => middle,
    };
    let collider = Collider {
        shape,
        friction,
        motion: Motion {
            velocity: DVec3::from(raw.velocity.0),
            spin: DVec3::from(raw.angular_velocity.0),
            pivot,
        },
    };
    let usable = Solid::new(&collider).and_then(|solid| match solid.at(0.0) {
        Ok(_) => Ok(()),
        Err(e) => Err(e.to_string()),
    });
    usable.map_err(|why| Error::Value {
        file: check.file.into(),
        key: at(named[0]),
        value: "{ ... }".into(),
        why,
    })?;
    Ok(collider)
}

fn axes(check: &Checker, key: &str, raw: Option<&file::Rotate>) -> Result<DMat3, Error> {
    let Some(rotate) = raw else {
        return Ok(DMat3::IDENTITY);
    };
    let (axis, _) = check.direction(&format!("{key}.axis"), rotate.axis)?;
    check.any(&format!("{key}.degrees"), rotate.degrees)?;
    Ok(rotation(axis, rotate.degrees))
}

fn height_field(
    check: &Checker,
    key: &str,
    raw: &file::HeightField,
) -> Result<(Shape, DVec3), Error> {
    let at = |name: &str| format!("{key}.{name}");
    check.vector(&at("corner"), raw.corner)?;
    for spacing in raw.spacing.0 {
        check.positive(&at("spacing"), spacing)?;
    }
    let axes = axes(check, &at("rotate"), raw.rotate.as_ref())?;
    let columns = raw.heights.first().map_or(0, Vec::len);
    if raw.heights.len() < 2 || columns < 2 {
        let found = [raw.heights.len(), columns];
        return Err(check.wrong(
            &at("heights"),
            &found,
            "must have at least 2 rows of 2 heights",
        ));
    }
    let mut heights = Vec::new();
    for (i, row) in raw.heights.iter().enumerate() {
        let key = at(&format!("heights[{i}]"));
        if row.len() != columns {
            let why = format!("must have {columns} heights, as the first row has");
            return Err(check.wrong(&key, &row.len(), why));
        }
        for (k, &height) in row.iter().enumerate() {
            heights.push(check.any(&format!("{key}[{k}]"), height)?);
        }
    }
    let corner = DVec3::from(raw.corner.0);
    let [dx, dz] = raw.spacing.0;
    let (rows, columns) = (raw.heights.len(), columns);
    let across = DVec3::new(
        dx * (rows - 1) as f64 / 2.0,
        0.0,
        dz * (columns - 1) as f64 / 2.0,
    );
    let grid = Arc::new(Grid {
        heights,
        samples: [rows, columns].map(|n| u32::try_from(n).unwrap_or(u32::MAX)),
        spacing: raw.spacing.0,
    });
    let middle = corner + axes * across;
    Ok((Shape::HeightField { corner, axes, grid }, middle))
}
