//! Bodies that touch, are joined or are rigid: what `[contact]`, `[[rigid]]`, `[[attachment]]` and `[[spring]]` of a
//! scene file say, checked, and the one system that is made of them.

use femto::coupling::{Coupling, Link};
use femto::detect::Aabb;
use femto::glam::Vec3;
use femto::join::Assembly;
use femto::material::Regions;
use femto::mesh::{Mesh, MeshError};
use femto::order::fans;
use femto::owned::OwnedRest;
use femto::rigid::{Rigid, Shape};
use glam::{DMat3, DVec3};

use crate::error::Error;
use crate::material::{Laws, Substance, Substances};
use crate::place::Placing;
use crate::prepare::{self, Build};
use crate::scene::{Body, Checker, Scene, Shown};
use crate::scene_file::{self as file, SceneFile};

/// What makes one system of a scene's bodies.
#[derive(Clone, Debug)]
pub struct Coupled {
    /// Contacts and links that there is room for.
    pub capacity: usize,
    /// Whether sharp edges of soft bodies touch each other.
    pub edges: bool,
    /// Coulomb's coefficient of each body; soft ones first, then rigid ones.
    pub friction: Vec<f32>,
    pub rigid: Vec<RigidBody>,
    pub links: Vec<LinkSpec>,
}

/// A rigid body as the file has it.
#[derive(Clone, Copy, Debug)]
pub struct RigidBody {
    pub shape: Shape,
    pub mass: f32,
    pub centre: Vec3,
    pub axes: [Vec3; 3],
}

/// A place on a body: the soft body's node that is nearest to it, or the very point of a rigid one.
#[derive(Clone, Copy, Debug)]
pub enum End {
    Node(u32),
    Rigid(usize, Vec3),
}

/// An attachment or a spring.
#[derive(Clone, Copy, Debug)]
pub struct LinkSpec {
    pub first: End,
    pub second: Option<End>,
    /// Where a target is at time 0, and how it moves.
    pub target: DVec3,
    pub velocity: DVec3,
    /// Stiffness and damping; none for a hard one.
    pub soft: Option<[f32; 2]>,
}

/// Whether a scene asks for one system.
pub fn wanted(raw: &SceneFile) -> bool {
    raw.contact.is_some()
        || !raw.rigid.is_empty()
        || !raw.attachment.is_empty()
        || !raw.spring.is_empty()
}

/// Checks what the file says, and appends the rigid bodies to `bodies`.
pub fn check(checker: &Checker, raw: &SceneFile, bodies: &mut Vec<Body>) -> Result<Coupled, Error> {
    let contact = raw.contact.unwrap_or_default();
    let general = checker.not_negative("contact.friction", contact.friction)?;
    if raw.time.theta != 1.0 {
        let why = "must be 1 where bodies touch or are joined";
        return Err(checker.wrong("time.theta", &raw.time.theta, why));
    }
    let limit = femto::detect::MAX_PIECES.min(femto::detect::MAX_RIGIDS);
    for (key, count) in [("body", raw.body.len()), ("rigid", raw.rigid.len())] {
        if count > limit {
            return Err(checker.wrong(key, &count, format!("must not be more than {limit}")));
        }
    }
    for (i, body) in bodies.iter().enumerate() {
        for (name, value, first) in [
            ("alpha", body.alpha, bodies[0].alpha),
            ("beta", body.beta, bodies[0].beta),
        ] {
            if value != first {
                let why =
                    format!("must be body[0]'s {first:?}: bodies that touch have one damping");
                return Err(checker.wrong(&format!("body[{i}].{name}"), &value, why));
            }
        }
    }
    let own = |key: String, value: Option<f64>| {
        value.map_or(Ok(general), |x| {
            checker.not_negative(&format!("{key}.friction"), x)
        })
    };
    let mut friction = Vec::new();
    for (i, body) in raw.body.iter().enumerate() {
        friction.push(own(format!("body[{i}]"), body.friction)?);
    }
    let mut rigid = Vec::new();
    for (i, one) in raw.rigid.iter().enumerate() {
        let key = format!("rigid[{i}]");
        friction.push(own(key.clone(), one.friction)?);
        let (checked, body) = rigid_body(checker, &key, one, bodies.first())?;
        rigid.push(checked);
        bodies.push(body);
    }
    let soft = raw.body.len();
    let links = links(checker, raw, bodies, soft)?;
    let capacity = contact.capacity as usize;
    if capacity < links.len() || capacity > 1 << 20 {
        let why = format!(
            "must be at least {}, one for each attachment and spring, and at most 2^20",
            links.len()
        );
        return Err(checker.wrong("contact.capacity", &contact.capacity, why));
    }
    Ok(Coupled {
        capacity,
        edges: contact.edges,
        friction,
        rigid,
        links,
    })
}

fn rigid_body(
    checker: &Checker,
    key: &str,
    raw: &file::RigidBody,
    first: Option<&Body>,
) -> Result<(RigidBody, Body), Error> {
    let mass = checker.positive(&format!("{key}.mass"), raw.mass)?;
    let (shape, shown) = match (&raw.ball, &raw.cuboid) {
        (Some(ball), None) => {
            let radius = checker.positive(&format!("{key}.ball.radius"), ball.radius)?;
            (Shape::Ball { radius }, shown_ball(f64::from(radius)))
        }
        (None, Some(sides)) => {
            for side in sides.0 {
                checker.positive(&format!("{key}.box"), side)?;
            }
            let half = DVec3::from(sides.0) * 0.5;
            let rounded = Vec3::from_array(half.to_array().map(|x| x as f32));
            (Shape::Cuboid { half: rounded }, shown_box(half))
        }
        _ => {
            return Err(Error::Scene {
                file: checker.file.into(),
                what: format!("{key}: must have exactly one of ball and box"),
            });
        }
    };
    let placing = Placing::of_rigid(checker, key, raw)?;
    let at = placing.rest(&[DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z]);
    let [centre, x, y, z] = [at[0], at[1], at[2], at[3]];
    let axes = DMat3::from_cols(x - centre, y - centre, z - centre);
    let lengths = DVec3::from(shape.lengths().to_array().map(f64::from));
    // The four equal masses; `femto::rigid` has the formula.
    let nodes: Vec<DVec3> = SIGNS
        .iter()
        .map(|s| centre + axes * (DVec3::from(*s) * lengths))
        .collect();
    let wrong = |why: String| Error::Value {
        file: checker.file.into(),
        key: key.into(),
        value: format!("{shape:?}"),
        why,
    };
    let rest = placing.round(&nodes).map_err(&wrong)?;
    let (_, v) = placing.start(&nodes);
    let v = placing
        .round(&v)
        .map_err(|why| wrong(format!("velocity of {why}")))?;
    let small = |v: DVec3| Vec3::from_array(v.to_array().map(|x| x as f32));
    let checked = RigidBody {
        shape,
        mass,
        centre: small(centre),
        axes: [small(axes.x_axis), small(axes.y_axis), small(axes.z_axis)],
    };
    let weights = shown.0.iter().map(|&p| weights(p, lengths)).collect();
    let body = Body {
        source: key.into(),
        young: 0.0,
        poisson: 0.0,
        density: 0.0,
        alpha: first.map_or(0.0, |b| b.alpha),
        beta: first.map_or(0.0, |b| b.beta),
        x: rest.clone(),
        rest,
        tets: vec![[0, 1, 2, 3]],
        v,
        pins: Vec::new(),
        carried: Vec::new(),
        substances: Substances {
            list: vec![Substance {
                key: key.into(),
                young: 0.0,
                poisson: 0.0,
                density: 0.0,
                fibres: None,
            }],
            of: vec![0],
        },
        laws: Laws::default(),
        shown: Some(Shown {
            weights,
            tets: shown.1,
        }),
    };
    Ok((checked, body))
}

const SIGNS: [[f64; 3]; 4] = [
    [1.0, 1.0, 1.0],
    [-1.0, 1.0, -1.0],
    [1.0, -1.0, -1.0],
    [-1.0, -1.0, 1.0],
];

/// Of the four nodes at a point of the body.
fn weights(point: DVec3, lengths: DVec3) -> [f64; 4] {
    SIGNS.map(|s| 0.25 * (1.0 + (DVec3::from(s) * point / lengths).element_sum()))
}

/// A box as six tets.
fn shown_box(half: DVec3) -> (Vec<DVec3>, Vec<[u32; 4]>) {
    let mesh = crate::mesh::grid::mesh((half * 2.0).to_array(), [1; 3]).expect("one cell");
    (mesh.nodes.iter().map(|p| *p - half).collect(), mesh.tets)
}

/// A ball as tets from its centre to the triangles of an octahedron, cut twice.
fn shown_ball(radius: f64) -> (Vec<DVec3>, Vec<[u32; 4]>) {
    let mut points = vec![
        DVec3::X,
        DVec3::NEG_X,
        DVec3::Y,
        DVec3::NEG_Y,
        DVec3::Z,
        DVec3::NEG_Z,
    ];
    let mut faces = Vec::new();
    for (i, x) in [0_u32, 1].into_iter().enumerate() {
        for (j, y) in [2, 3].into_iter().enumerate() {
            for (k, z) in [4, 5].into_iter().enumerate() {
                let odd = (i + j + k) % 2 == 1;
                faces.push(if odd { [x, z, y] } else { [x, y, z] });
            }
        }
    }
    for _ in 0..2 {
        let mut middles = std::collections::HashMap::new();
        let mut middle = |a: u32, b: u32| {
            *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                points.push((points[a as usize] + points[b as usize]).normalize());
                points.len() as u32 - 1
            })
        };
        let mut finer = Vec::new();
        for [a, b, c] in faces {
            let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
            finer.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
        }
        faces = finer;
    }
    let centre = points.len() as u32;
    points.push(DVec3::ZERO);
    let tets = faces.iter().map(|&[a, b, c]| [centre, a, b, c]).collect();
    (points.into_iter().map(|p| p * radius).collect(), tets)
}

fn links(
    checker: &Checker,
    raw: &SceneFile,
    bodies: &[Body],
    soft: usize,
) -> Result<Vec<LinkSpec>, Error> {
    let end = |key: &str, raw: &file::End| -> Result<End, Error> {
        let point = DVec3::from(raw.point.0);
        checker.vector(&format!("{key}.point"), raw.point)?;
        let count = |what: &str, index: usize, count: usize| {
            let why = format!("the scene has {count}, from 0");
            (index < count)
                .then_some(index)
                .ok_or_else(|| checker.wrong(&format!("{key}.{what}"), &index, why))
        };
        match (raw.body, raw.rigid) {
            (Some(body), None) => {
                let body = count("body", body, soft)?;
                let first: usize = bodies[..body].iter().map(|b| b.x.len()).sum();
                let distance = |x: &[f32; 3]| DVec3::from(x.map(f64::from)).distance_squared(point);
                let nodes = bodies[body].x.iter().map(distance).enumerate();
                let nearest = nodes.min_by(|a, b| a.1.total_cmp(&b.1));
                Ok(End::Node((first + nearest.map_or(0, |n| n.0)) as u32))
            }
            (None, Some(rigid)) => {
                let rigid = count("rigid", rigid, bodies.len() - soft)?;
                let at = raw.point.0.map(|x| x as f32);
                Ok(End::Rigid(rigid, Vec3::from_array(at)))
            }
            _ => Err(Error::Scene {
                file: checker.file.into(),
                what: format!("{key}: must have exactly one of body and rigid"),
            }),
        }
    };
    let damping = |key: &str, value: f64| checker.not_negative(&format!("{key}.damping"), value);
    let stiffness = |key: &str, value: f64| checker.positive(&format!("{key}.stiffness"), value);
    let mut out = Vec::new();
    for (i, one) in raw.attachment.iter().enumerate() {
        let key = format!("attachment[{i}]");
        let soft = match (one.stiffness, one.damping) {
            (Some(k), c) => Some([stiffness(&key, k)?, damping(&key, c.unwrap_or(0.0))?]),
            (None, Some(c)) => {
                let why = "needs a stiffness: without one an attachment is hard";
                return Err(checker.wrong(&format!("{key}.damping"), &c, why));
            }
            (None, None) => None,
        };
        out.push(LinkSpec {
            first: end(&format!("{key}.a"), &one.a)?,
            second: Some(end(&format!("{key}.b"), &one.b)?),
            target: DVec3::ZERO,
            velocity: DVec3::ZERO,
            soft,
        });
    }
    for (i, one) in raw.spring.iter().enumerate() {
        let key = format!("spring[{i}]");
        checker.vector(&format!("{key}.target"), one.target)?;
        checker.vector(&format!("{key}.velocity"), one.velocity)?;
        out.push(LinkSpec {
            first: end(&format!("{key}.from"), &one.from)?,
            second: None,
            target: DVec3::from(one.target.0),
            velocity: DVec3::from(one.velocity.0),
            soft: Some([stiffness(&key, one.stiffness)?, damping(&key, one.damping)?]),
        });
    }
    Ok(out)
}

/// All bodies of a scene as one, without its solver.
pub struct Joint {
    pub parts: Assembly,
    pub rigids: Vec<Rigid>,
    pub links: Vec<Link>,
    pub specs: Vec<LinkSpec>,
    pub slots: Vec<Coupling>,
    /// Scratch of the search for contacts.
    pub boxes: Vec<Aabb>,
    /// Which of the assembly's tets each of the system's is.
    pub original: Vec<usize>,
}

/// Makes the system, its tetrahedra in fans, and its rest data.
pub fn joint<L: Build>(scene: &Scene, coupled: &Coupled) -> Result<(Joint, OwnedRest<L>), Error> {
    let wrong = |body: usize, value: String, why: String| Error::Value {
        file: scene.file.clone(),
        key: match body.checked_sub(scene.bodies.len() - coupled.rigid.len()) {
            None => format!("body[{body}]"),
            Some(rigid) => format!("rigid[{rigid}]"),
        },
        value,
        why,
    };
    let mut parts = Assembly::new();
    let mut materials = Vec::new();
    let mut substances = Substances {
        list: Vec::new(),
        of: Vec::new(),
    };
    let soft = scene.bodies.len() - coupled.rigid.len();
    for (i, (body, &friction)) in scene.bodies.iter().zip(&coupled.friction).enumerate() {
        let bad = |why: String| wrong(i, body.source.clone(), why);
        match i.checked_sub(soft) {
            None => {
                prepare::check_placed(scene, i)?;
                let own = prepare::materials(scene, body)?;
                parts
                    .soft(&body.rest, &body.tets, own[0], friction)
                    .map_err(|e| bad(e.to_string()))?;
                substances.add(&body.substances);
                materials.extend(own);
            }
            Some(rigid) => {
                let one = &coupled.rigid[rigid];
                let value = format!("{:?} of {:?} kg", one.shape, one.mass);
                let bad = |why: String| wrong(i, value.clone(), why);
                let like = femto::Material::new(1.0, 0.0, 1.0)
                    .and_then(|m| m.with_damping(body.alpha, body.beta))
                    .map_err(|e| bad(e.to_string()))?;
                let part = parts
                    .rigid(one.shape, one.mass, one.centre, one.axes, friction, &like)
                    .map_err(|e| bad(e.to_string()))?;
                let material = parts.materials[part.tets.start];
                let mut own = body.substances.clone();
                own.list[0].young = material.young();
                substances.add(&own);
                materials.push(material);
            }
        }
    }
    let ordered = fans(&parts.tets);
    parts.reorder(&ordered.original);
    let of: Vec<u16> = ordered.original.iter().map(|&t| substances.of[t]).collect();
    let regions = Regions {
        materials: &materials,
        of: &of,
    };
    let mesh = |e| bad_tet(scene, &parts, &ordered.original, e);
    let checked = Mesh::new(&parts.nodes, &ordered.tets).map_err(mesh)?;
    let rest = L::build(&checked, &regions, &substances, &ordered.original).map_err(mesh)?;
    if coupled.edges {
        parts.touch_by_edges();
    }
    let rigids = parts.rigids();
    let point = |end: End| match end {
        End::Node(node) => [(node, 1.0), (0, 0.0), (0, 0.0), (0, 0.0)],
        End::Rigid(index, at) => Link::point_of(&rigids[index], &parts.nodes, at),
    };
    let links = coupled.links.iter().map(|spec| {
        let link = match spec.second {
            Some(second) => Link::points(point(spec.first), point(second)),
            None => Link::to_target(point(spec.first), Vec3::ZERO, Vec3::ZERO),
        };
        match spec.soft {
            Some([stiffness, damping]) => link.soft(stiffness, damping),
            None => link,
        }
    });
    let links = links.collect();
    let joint = Joint {
        links,
        specs: coupled.links.clone(),
        slots: vec![Coupling::EMPTY; coupled.capacity],
        boxes: parts.boxes(),
        original: ordered.original,
        rigids,
        parts,
    };
    Ok((joint, rest))
}

/// Says whose tetrahedron is wrong, and which, as the file counts.
fn bad_tet(scene: &Scene, parts: &Assembly, original: &[usize], error: MeshError) -> Error {
    let MeshError::OutOfScale { tet } = error else {
        return prepare::bad_mesh(scene, 0, "", error);
    };
    let tet = original.get(tet as usize).copied().unwrap_or_default();
    let all = parts.parts.iter().enumerate();
    let (body, first) = all
        .filter(|(_, part)| part.tets.start <= tet)
        .map(|(body, part)| (body, part.tets.start))
        .next_back()
        .unwrap_or_default();
    let tet = (tet - first) as u32;
    let soft = scene.soft_bodies();
    match body.checked_sub(soft) {
        None => prepare::bad_mesh(scene, body, "", MeshError::OutOfScale { tet }),
        Some(rigid) => Error::Value {
            file: scene.file.clone(),
            key: format!("rigid[{rigid}]"),
            value: scene.bodies[body].source.clone(),
            why: "its mass is out of range beside those of the other bodies".into(),
        },
    }
}

impl Joint {
    /// Moves the targets of springs on to a time.
    pub fn move_targets(&mut self, time: f64) {
        let small = |v: DVec3| Vec3::from_array(v.to_array().map(|x| x as f32));
        for (link, spec) in self.links.iter_mut().zip(&self.specs) {
            if spec.second.is_none() {
                *link = link.with_target(
                    small(spec.target + spec.velocity * time),
                    small(spec.velocity),
                );
            }
        }
    }
}
