//! Pressure, wind, and pins that turning frames carry: checked, and as they act on a body.

use femto::constraint::Pin;
use femto::glam::Vec3;
use femto::load::{Gas, LoadError, Pressure, Triangles, Wind};
use femto::surface::boundary_triangles;

use crate::colliders::Motion;
use crate::error::Error;
use crate::scene::{Body, Checker};
use crate::scene_file as file;

/// What acts on the surface of one body, or of all.
#[derive(Clone, Copy, Debug)]
pub struct Load {
    pub body: Option<usize>,
    pub kind: Kind,
}

#[derive(Clone, Copy, Debug)]
pub enum Kind {
    Pressure(Pressure),
    /// In the volume at rest, Pa, against so much outside.
    Gas {
        pressure: f32,
        outside: f32,
    },
    Wind(Wind),
}

/// Pinned nodes of a body that follow a frame which turns.
#[derive(Clone, Debug)]
pub struct Carried {
    pub motion: Motion,
    pub nodes: Vec<u32>,
}

/// Checks the loads of the file.
pub fn check(
    check: &Checker,
    pressures: &[file::Pressure],
    winds: &[file::Wind],
    bodies: &[Body],
) -> Result<Vec<Load>, Error> {
    let mut loads = Vec::new();
    let known = |key: String, body: usize| match bodies.get(body) {
        Some(_) => Ok(body),
        None => {
            let why = format!(
                "there is no such body; they count from 0 to {}",
                bodies.len().saturating_sub(1)
            );
            Err(check.wrong(&key, &body, why))
        }
    };
    let wrong = |key: &str, e: LoadError| check.wrong(key, &format_args!("..."), e.to_string());
    for (i, raw) in pressures.iter().enumerate() {
        let key = format!("pressure[{i}]");
        let body = known(format!("{key}.body"), raw.body)?;
        let pascals = check.any(&format!("{key}.pascals"), raw.pascals)?;
        let outside = check.any(&format!("{key}.outside"), raw.outside)?;
        let kind = if raw.gas {
            Kind::Gas {
                pressure: check.positive(&format!("{key}.pascals"), raw.pascals)?,
                outside,
            }
        } else {
            Kind::Pressure(Pressure::new(pascals - outside).map_err(|e| wrong(&key, e))?)
        };
        loads.push(Load {
            body: Some(body),
            kind,
        });
    }
    for (i, raw) in winds.iter().enumerate() {
        let key = format!("wind[{i}]");
        let body = raw.body.map(|body| known(format!("{key}.body"), body));
        let velocity = check.vector(&format!("{key}.velocity"), raw.velocity)?;
        let density = check.not_negative(&format!("{key}.density"), raw.density)?;
        let normal = check.not_negative(&format!("{key}.normal"), raw.normal)?;
        let tangential = check.not_negative(&format!("{key}.tangential"), raw.tangential)?;
        let wind = Wind::new(Vec3::from_array(velocity), density)
            .and_then(|wind| wind.with_coefficients(normal, tangential));
        loads.push(Load {
            body: body.transpose()?,
            kind: Kind::Wind(wind.map_err(|e| wrong(&key, e))?),
        });
    }
    Ok(loads)
}

/// What acts on some bodies whose nodes are numbered through.
pub struct Acting {
    /// A surface, and what acts on it.
    loads: Vec<(Vec<[u32; 3]>, Act)>,
    forces: Vec<[f32; 3]>,
    carried: Vec<Group>,
}

enum Act {
    Pressure(Pressure),
    Gas(Gas),
    Wind(Wind),
}

/// Pins that one frame carries.
struct Group {
    motion: Motion,
    pins: Vec<Pin>,
    local: Vec<[f32; 3]>,
}

impl Acting {
    pub fn new<'a>(
        loads: &[Load],
        bodies: impl Iterator<Item = (usize, &'a Body)>,
    ) -> Result<Self, String> {
        let mut acting = Acting {
            loads: Vec::new(),
            forces: Vec::new(),
            carried: Vec::new(),
        };
        let mut base = 0;
        for (index, body) in bodies {
            // A rigid body has no surface of its own.
            let soft = body.shown.is_none();
            let on_it = |load: &&Load| soft && load.body.is_none_or(|b| b == index);
            for load in loads.iter().filter(on_it) {
                let own = boundary_triangles(&body.tets);
                let act = match load.kind {
                    Kind::Pressure(pressure) => Act::Pressure(pressure),
                    Kind::Wind(wind) => Act::Wind(wind),
                    Kind::Gas { pressure, outside } => {
                        let volume = Triangles::new(&own, body.rest.len())
                            .map(|surface| surface.volume(&body.rest));
                        let gas = volume
                            .and_then(|volume| Gas::new(pressure, volume))
                            .and_then(|gas| gas.with_outside(outside));
                        Act::Gas(gas.map_err(|e| e.to_string())?)
                    }
                };
                let surface = own.iter().map(|nodes| nodes.map(|n| n + base)).collect();
                acting.loads.push((surface, act));
            }
            for carried in &body.carried {
                let pins: Vec<Pin> = carried.nodes.iter().map(|&n| Pin::held(n)).collect();
                let mut local = vec![[0.0; 3]; pins.len()];
                carried.motion.frame(0.0)?.hold(&pins, &body.x, &mut local);
                let pins = pins.iter().map(|pin| Pin::held(pin.node + base)).collect();
                acting.carried.push(Group {
                    motion: carried.motion,
                    pins,
                    local,
                });
            }
            base += body.x.len() as u32;
        }
        if !acting.loads.is_empty() {
            acting.forces = vec![[0.0; 3]; base as usize];
        }
        Ok(acting)
    }

    /// The forces on the nodes; none where nothing acts.
    pub fn forces(&mut self, x: &[[f32; 3]], v: &[[f32; 3]]) -> &[[f32; 3]] {
        self.forces.fill([0.0; 3]);
        for (surface, act) in &self.loads {
            let Ok(surface) = Triangles::new(surface, x.len()) else {
                continue;
            };
            match act {
                Act::Pressure(pressure) => pressure.add(&surface, x, &mut self.forces),
                Act::Gas(gas) => {
                    gas.pressure(surface.volume(x))
                        .add(&surface, x, &mut self.forces);
                }
                Act::Wind(wind) => wind.add(&surface, x, v, &mut self.forces),
            }
        }
        &self.forces
    }

    /// Gives carried pins the velocities of a step of `dt` that begins at `time`.
    pub fn carry(
        &mut self,
        time: f64,
        dt: f32,
        x: &[[f32; 3]],
        pins: &mut [Pin],
    ) -> Result<(), String> {
        for group in &mut self.carried {
            let frame = group.motion.frame(time)?;
            frame.carry(&group.local, x, dt, &mut group.pins);
            for pin in &group.pins {
                if let Ok(at) = pins.binary_search_by_key(&pin.node, |pin| pin.node) {
                    pins[at] = *pin;
                }
            }
        }
        Ok(())
    }
}
