//! Malformed scenes: each ends with status 2 and one line that names the file, the key and the
//! value, and nothing is written.

use crate::support::{BEAM, Folder};

/// Runs a scene that has to fail, and returns its error line.
fn fails(folder: &Folder, scene: &[u8], arguments: &[&str]) -> String {
    folder.write("scene.toml", scene);
    let all = [&["run", "scene.toml", "--out", "out"], arguments].concat();
    let run = folder.femto(&all);
    assert_eq!(run.status, 2, "{}", run.err);
    assert_eq!(run.out, "");
    assert_eq!(run.err.lines().count(), 1, "{}", run.err);
    assert!(!folder.path("out").exists(), "nothing is written");
    run.err
        .trim_end()
        .strip_prefix("error: ")
        .expect("an error")
        .to_owned()
}

/// What is replaced in the good scene, by what, and the line that follows. A line that ends in
/// `...` may go on.
#[rustfmt::skip] // a row stays a row
const ROWS: &[(&str, &str, &str)] = &[
    // time
    ("dt = 0.01", "dt = 0.0", "scene.toml: time.dt = 0.0: must be above 0"),
    ("dt = 0.01", "dt = -1", "scene.toml: time.dt = -1.0: must be above 0"),
    ("dt = 0.01", "dt = nan", "scene.toml: time.dt = NaN: must be finite"),
    ("dt = 0.01", "dt = inf", "scene.toml: time.dt = inf: must be finite"),
    ("dt = 0.01", "dt = 1e-60", "scene.toml: time.dt = 1e-60: rounds to 0.0 in f32: must be above 0"),
    ("dt = 0.01", "dt = 1e-40", "scene.toml: time.dt / budget.substeps = 1e-40: must be at least 1.2e-38"),
    ("dt = 0.01", "dt = 1e60", "scene.toml: time.dt = 1e60: is too large for f32"),
    ("dt = 0.01", "dt = \"0.01\"", "scene.toml: line 3, column 6: `dt = \"0.01\"`: time.dt: invalid type: string \"0.01\", expected f64"),
    ("dt = 0.01\n", "", "scene.toml: line 2, column 1: `[time]`: time: missing field `dt`"),
    ("steps = 10", "steps = -1", "scene.toml: line 4, column 9: `steps = -1`: time.steps: invalid value: integer `-1`, expected u32"),
    ("steps = 10", "steps = 1.5", "scene.toml: line 4, column 9: `steps = 1.5`: time.steps: invalid type: floating point `1.5`, expected u32"),
    ("steps = 10", "steps = 10\ntheta = 0.4", "scene.toml: time.theta = 0.4: must be from 0.5 to 1"),
    ("steps = 10", "steps = 10\ntheta = 2", "scene.toml: time.theta = 2.0: must be from 0.5 to 1"),
    ("steps = 10", "steps = 10\nend = 3", "scene.toml: line 5, column 1: `end = 3`: time.end: unknown field `end`, expected one of `dt`, `steps`, `theta`"),
    // budget and solver
    ("[time]", "[budget]\nsubsteps = 0\n[time]", "scene.toml: budget.substeps = 0: must be at least 1"),
    ("[time]", "[budget]\niterations = -5\n[time]", "scene.toml: line 3, column 14: `iterations = -5`: budget.iterations: invalid value: integer `-5`, expected u32"),
    ("[time]", "[budget]\npolar_sweeps = \"many\"\n[time]", "scene.toml: line 3, column 16: `polar_sweeps = \"many\"`: budget.polar_sweeps: ..."),
    ("[time]", "[solver]\nstart = \"rest\"\n[time]", "scene.toml: solver.start = \"rest\": must be zero, velocity, velocity-force, galerkin-m or rigid-m with ..."),
    ("[time]", "[solver]\nstart = \"galerkin-\"\n[time]", "scene.toml: solver.start = \"galerkin-\": must be zero, ..."),
    ("[time]", "[solver]\nstart = \"galerkin-m\"\n[time]", "scene.toml: solver.start = \"galerkin-m\": must be zero, ..."),
    ("[time]", "[solver]\nstart = \"rigid-999\"\n[time]", "scene.toml: solver.start = \"rigid-999\": must be zero, ..."),
    ("[time]", "[solver]\nlayout = \"sparse\"\n[time]", "scene.toml: solver.layout = \"sparse\": must be factored or dense"),
    ("[time]", "[solver]\npreconditioner = \"ilu\"\n[time]", "scene.toml: solver.preconditioner = \"ilu\": must be identity, ..."),
    // material
    ("young = 1e5", "young = 0", "scene.toml: body[0].young = 0.0: must be above 0"),
    ("young = 1e5", "young = -1e5", "scene.toml: body[0].young = -100000.0: must be above 0"),
    ("young = 1e5", "young = 1e39", "scene.toml: body[0].young = 1e39: is too large for f32"),
    ("young = 1e5\n", "", "scene.toml: line 6, column 1: `[[body]]`: body[0]: missing field `young`"),
    ("young = 1e5", "young = true", "scene.toml: line 8, column 9: `young = true`: body[0].young: invalid type: boolean `true`, expected f64"),
    ("poisson = 0.4", "poisson = 0.5", "scene.toml: body[0].poisson = 0.5: must be below 0.5 and above -1"),
    ("poisson = 0.4", "poisson = -1", "scene.toml: body[0].poisson = -1.0: must be below 0.5 and above -1"),
    ("poisson = 0.4", "poisson = 0.49999999999", "scene.toml: body[0].poisson = 0.49999999999: rounds to 0.5 in f32: must be below 0.5 and above -1"),
    ("density = 1000.0", "density = 0", "scene.toml: body[0].density = 0.0: must be above 0"),
    ("density = 1000.0", "density = 1000.0\nalpha = -0.1", "scene.toml: body[0].alpha = -0.1: must not be negative"),
    ("density = 1000.0", "density = 1000.0\nbeta = -0.1", "scene.toml: body[0].beta = -0.1: must not be negative"),
    ("density = 1000.0", "density = 1000.0\nyuong = 3", "scene.toml: line 11, column 1: `yuong = 3`: body[0].yuong: unknown field `yuong`, expected one of ..."),
    ("density = 1000.0", "density = 1000.0\ndensity = 3", "scene.toml: line 11, column 1: `density = 3`: duplicate key"),
    // materials, plasticity, fracture
    ("density = 1000.0", "density = 1000.0\n[[body.material]]\nyoung = 3", "scene.toml: body[0].material[0]: must have exactly one of box, sphere and volume"),
    ("density = 1000.0", "density = 1000.0\n[[body.material]]\nvolume = 1\nsphere = { centre = [0, 0, 0], radius = 1 }", "scene.toml: body[0].material[0]: must have exactly one of box, sphere and volume"),
    ("density = 1000.0", "density = 1000.0\n[[body.material]]\nbox = [[5, 5, 5], [6, 6, 6]]", "scene.toml: body[0].material[0].box = [[5.0, 5.0, 5.0], [6.0, 6.0, 6.0]]: holds the middle of no tet of the placed rest shape"),
    ("density = 1000.0", "density = 1000.0\n[[body.material]]\nvolume = 3", "scene.toml: body[0].material[0].volume = 3: no tet of the mesh is in this volume"),
    ("density = 1000.0", "density = 1000.0\n[[body.material]]\nsphere = { centre = [0, 0, 0], radius = 1 }\nyoung = -3", "scene.toml: body[0].material[0].young = -3.0: must be above 0"),
    ("density = 1000.0", "density = 1000.0\n[[body.material]]\nsphere = { centre = [0, 0, 0], radius = 1 }\npoisson = 0.5", "scene.toml: body[0].material[0].poisson = 0.5: must be below 0.5 and above -1"),
    ("density = 1000.0", "density = 1000.0\n[[body.material]]\nsphere = { centre = [0, 0, 0], radius = 1 }\nbeta = 0.5", "scene.toml: line 13, column 1: `beta = 0.5`: body[0].material[0].beta: unknown field `beta`, expected one of ..."),
    ("density = 1000.0", "density = 1000.0\nfibre = { direction = [0, 0, 0], young = 1e6 }", "scene.toml: body[0].fibre.direction = [0.0, 0.0, 0.0]: must not be zero"),
    ("density = 1000.0", "density = 1000.0\nfibre = { direction = [1, 0, 0], young = 0 }", "scene.toml: body[0].fibre.young = 0.0: must be above 0"),
    ("density = 1000.0", "density = 1000.0\nfibre = { direction = [1, 0, 0], young = 1e4 }", "scene.toml: body[0].fibre.young = 10000.0: too soft along the fibres for poisson = 0.4000000059604645: ..."),
    ("density = 1000.0", "density = 1000.0\nfibre = { direction = [1, 0, 0], young = 1e6, shear = nan }", "scene.toml: body[0].fibre.shear = NaN: must be finite"),
    ("density = 1000.0", "density = 1000.0\nplasticity = { yield_strain = -1 }", "scene.toml: body[0].plasticity.yield_strain = -1.0: must not be negative"),
    ("density = 1000.0", "density = 1000.0\nplasticity = { yield_strain = 0.1, limit = 0 }", "scene.toml: body[0].plasticity.limit = 0.0: must be above 0"),
    ("density = 1000.0", "density = 1000.0\nplasticity = { yield_strain = 0.1, relaxation = inf }", "scene.toml: body[0].plasticity.relaxation = inf: must be finite"),
    ("density = 1000.0", "density = 1000.0\nplasticity = { limit = 1 }", "scene.toml: line 11, column 14: `plasticity = { limit = 1 }`: body[0].plasticity: missing field `yield_strain`"),
    ("density = 1000.0", "density = 1000.0\nfracture = { strength = 0 }", "scene.toml: body[0].fracture.strength = 0.0: must be above 0"),
    ("density = 1000.0", "density = 1000.0\nfracture = { strength = 1e5, per_step = 17 }", "scene.toml: body[0].fracture.per_step = 17: must be from 1 to 16"),
    ("density = 1000.0", "density = 1000.0\nfracture = { strength = 1e5, per_step = 0 }", "scene.toml: body[0].fracture.per_step = 0: must be from 1 to 16"),
    ("density = 1000.0", "density = 1000.0\nfracture = { strength = 1e5, reserve = -1 }", "scene.toml: line 11, column 40: `fracture = { strength = 1e5, reserve = -1 }`: body[0].fracture.reserve: invalid value: integer `-1`, expected u32"),
    // placing and start
    ("density = 1000.0", "density = 1000.0\nscale = 0", "scene.toml: body[0].scale = 0.0: must be above 0"),
    ("density = 1000.0", "density = 1000.0\nrotate = { axis = [0, 0, 0], degrees = 3 }", "scene.toml: body[0].rotate.axis = [0.0, 0.0, 0.0]: must not be zero"),
    ("density = 1000.0", "density = 1000.0\nrotate = { axis = [0, 0, 1] }", "scene.toml: line 11, column 10: `rotate = { axis = [0, 0, 1] }`: body[0].rotate: missing field `degrees`"),
    ("density = 1000.0", "density = 1000.0\ntranslate = [1, 2]", "scene.toml: line 11, column 13: `translate = [1, 2]`: body[0].translate: expected 3 numbers, found 2"),
    ("density = 1000.0", "density = 1000.0\ntranslate = [1, 2, 3, 4]", "scene.toml: line 11, column 13: `translate = [1, 2, 3, 4]`: body[0].translate: expected 3 numbers, found 4"),
    ("density = 1000.0", "density = 1000.0\ntranslate = [1e39, 2, 3]", "scene.toml: body[0].translate = [1e39, 2.0, 3.0]: is too large for f32"),
    ("density = 1000.0", "density = 1000.0\ntranslate = [0, 3e38, 0]\nscale = 3e38", "scene.toml: body[0].mesh = { box = [1.0, 0.25, 0.25], cells = [4, 1, 1] }: ..."),
    ("density = 1000.0", "density = 1000.0\nvelocity = [nan, 0, 0]", "scene.toml: body[0].velocity = [NaN, 0.0, 0.0]: must be finite"),
    ("density = 1000.0", "density = 1000.0\nstretch = [1, inf, 1]", "scene.toml: body[0].stretch = [1.0, inf, 1.0]: must be finite"),
    // pins
    ("box = [[-1e-6, -1.0, -1.0], [1e-6, 1.0, 1.0]]", "box = [[5, 5, 5], [6, 6, 6]]", "scene.toml: body[0].pin[0].box = [[5.0, 5.0, 5.0], [6.0, 6.0, 6.0]]: holds no node of the placed rest shape"),
    ("box = [[-1e-6, -1.0, -1.0], [1e-6, 1.0, 1.0]]", "sphere = { centre = [0, 9, 0], radius = 0.5 }", "scene.toml: body[0].pin[0].sphere = { centre = [0.0, 9.0, 0.0], radius = 0.5 }: holds no node of the placed rest shape"),
    ("box = [[-1e-6, -1.0, -1.0], [1e-6, 1.0, 1.0]]", "sphere = { centre = [0, 9, 0], radius = -1 }", "scene.toml: body[0].pin[0].sphere.radius = -1.0: must be above 0"),
    ("box = [[-1e-6, -1.0, -1.0], [1e-6, 1.0, 1.0]]", "box = [[1, 1, 1], [0, 0, 0]]", "scene.toml: body[0].pin[0].box = [[1.0, 1.0, 1.0], [0.0, 0.0, 0.0]]: the first corner must be the low one"),
    ("box = [[-1e-6, -1.0, -1.0], [1e-6, 1.0, 1.0]]", "box = [[nan, 1, 1], [0, 0, 0]]", "scene.toml: body[0].pin[0].box = [[NaN, 1.0, 1.0], [0.0, 0.0, 0.0]]: must be finite"),
    ("box = [[-1e-6, -1.0, -1.0], [1e-6, 1.0, 1.0]]", "box = [[0, 0, 0]]", "scene.toml: line 13, column 7: `box = [[0, 0, 0]]`: body[0].pin[0].box: expected 2 corners, found 1"),
    ("box = [[-1e-6, -1.0, -1.0], [1e-6, 1.0, 1.0]]", "velocity = [0, 0, 0]", "scene.toml: body[0].pin[0]: must have exactly one of box and sphere"),
    ("box = [[-1e-6, -1.0, -1.0], [1e-6, 1.0, 1.0]]", "box = [[-1e-6, -1.0, -1.0], [1e-6, 1.0, 1.0]]\nangular_velocity = [nan, 0, 0]", "scene.toml: body[0].pin[0].angular_velocity = [NaN, 0.0, 0.0]: must be finite"),
    ("box = [[-1e-6, -1.0, -1.0], [1e-6, 1.0, 1.0]]", "box = [[-1e-6, -1.0, -1.0], [1e-6, 1.0, 1.0]]\nangular_velocity = [1e30, 0, 0]", "scene.toml: body[0].pin[0].angular_velocity = [1e30, 0.0, 0.0]: the spin must be finite, and its square"),
    // colliders
    ("[time]", "[[collider]]\nplane = { normal = [0, 0, 0] }\n[time]", "scene.toml: collider[0].plane.normal = [0.0, 0.0, 0.0]: must not be zero"),
    ("[time]", "[[collider]]\nplane = { normal = [0, 1, 0], offset = nan }\n[time]", "scene.toml: collider[0].plane.offset = NaN: must be finite"),
    ("[time]", "[[collider]]\nsphere = { centre = [0, 0, 0], radius = 0 }\n[time]", "scene.toml: collider[0].sphere.radius = 0.0: must be above 0"),
    ("[time]", "[[collider]]\nsphere = { centre = [0, 0, 0], radius = 1 }\nfriction = -1\n[time]", "scene.toml: collider[0].friction = -1.0: must not be negative"),
    ("[time]", "[[collider]]\nfriction = 0.5\n[time]", "scene.toml: collider[0] = []: must have exactly one shape: plane, sphere, capsule, box or height_field"),
    ("[time]", "[[collider]]\ncapsule = { radius = 1 }\n[time]", "scene.toml: line 3, column 11: `capsule = { radius = 1 }`: collider[0].capsule: missing field `from`"),
    ("[time]", "[[collider]]\ncapsule = { from = [0, 0, 0], to = [1, 0, 0], radius = 0 }\n[time]", "scene.toml: collider[0].capsule.radius = 0.0: must be above 0"),
    ("[time]", "[[collider]]\ncapsule = { from = [0, 0, 0], to = [1e30, 0, 0], radius = 1 }\n[time]", "scene.toml: collider[0].capsule = { ... }: the offset or centre must be finite"),
    ("[time]", "[[collider]]\nbox = { centre = [0, 0, 0], size = [1, 0, 1] }\n[time]", "scene.toml: collider[0].box.size = 0.0: must be above 0"),
    ("[time]", "[[collider]]\nbox = { centre = [0, nan, 0], size = [1, 1, 1] }\n[time]", "scene.toml: collider[0].box.centre = [0.0, NaN, 0.0]: must be finite"),
    ("[time]", "[[collider]]\nbox = { centre = [0, 0, 0], size = [1, 1, 1], rotate = { axis = [0, 0, 0], degrees = 3 } }\n[time]", "scene.toml: collider[0].box.rotate.axis = [0.0, 0.0, 0.0]: must not be zero"),
    ("[time]", "[[collider]]\nbox = { centre = [0, 0, 0], size = [1, 1, 1] }\nplane = { normal = [0, 1, 0] }\n[time]", "scene.toml: collider[0] = [\"plane\", \"box\"]: must have exactly one shape: ..."),
    ("[time]", "[[collider]]\nheight_field = { spacing = [1], heights = [[0, 0], [0, 0]] }\n[time]", "scene.toml: line 3, column 28: `height_field = { spacing = [1], heights = [[0, 0], [0, 0]] }`: collider[0].height_field.spacing: expected 2 numbers, found 1"),
    ("[time]", "[[collider]]\nheight_field = { spacing = [1, 0], heights = [[0, 0], [0, 0]] }\n[time]", "scene.toml: collider[0].height_field.spacing = 0.0: must be above 0"),
    ("[time]", "[[collider]]\nheight_field = { spacing = [1, 1], heights = [[0, 0]] }\n[time]", "scene.toml: collider[0].height_field.heights = [1, 2]: must have at least 2 rows of 2 heights"),
    ("[time]", "[[collider]]\nheight_field = { spacing = [1, 1], heights = [[0, 0], [0]] }\n[time]", "scene.toml: collider[0].height_field.heights[1] = 1: must have 2 heights, as the first row has"),
    ("[time]", "[[collider]]\nheight_field = { spacing = [1, 1], heights = [[0, 0], [0, nan]] }\n[time]", "scene.toml: collider[0].height_field.heights[1][1] = NaN: must be finite"),
    ("[time]", "[[collider]]\nheight_field = { spacing = [1e-3, 1], heights = [[0, 0], [0, 1e30]] }\n[time]", "scene.toml: collider[0].height_field = { ... }: height 1, or the slope there, is not finite"),
    ("[time]", "[[collider]]\nsphere = { centre = [0, 0, 0], radius = 1 }\nangular_velocity = [0, inf, 0]\n[time]", "scene.toml: collider[0].angular_velocity = [0.0, inf, 0.0]: must be finite"),
    ("[time]", "[[collider]]\nsphere = { centre = [0, 0, 0], radius = 1 }\nangular_velocity = [0, 1e30, 0]\n[time]", "scene.toml: collider[0].sphere = { ... }: the spin must be finite, and its square"),
    ("[time]", "[[collider]]\nsphere = { centre = [0, 0, 0], radius = 1 }\npivot = [0, 1]\n[time]", "scene.toml: line 4, column 9: `pivot = [0, 1]`: collider[0].pivot: expected 3 numbers, found 2"),
    // loads
    ("[time]", "[[pressure]]\nbody = 1\npascals = 10\n[time]", "scene.toml: pressure[0].body = 1: there is no such body; they count from 0 to 0"),
    ("[time]", "[[pressure]]\nbody = 0\n[time]", "scene.toml: line 2, column 1: `[[pressure]]`: pressure[0]: missing field `pascals`"),
    ("[time]", "[[pressure]]\npascals = nan\n[time]", "scene.toml: pressure[0].pascals = NaN: must be finite"),
    ("[time]", "[[pressure]]\npascals = -1\ngas = true\n[time]", "scene.toml: pressure[0].pascals = -1.0: must be above 0"),
    ("[time]", "[[pressure]]\npascals = 3e38\noutside = -3e38\n[time]", "scene.toml: pressure[0] = ...: the pressure must be finite"),
    ("[time]", "[[wind]]\nvelocity = [0, inf, 0]\n[time]", "scene.toml: wind[0].velocity = [0.0, inf, 0.0]: must be finite"),
    ("[time]", "[[wind]]\nvelocity = [0, 1, 0]\ndensity = -1\n[time]", "scene.toml: wind[0].density = -1.0: must not be negative"),
    ("[time]", "[[wind]]\nvelocity = [0, 1, 0]\ntangential = -1\n[time]", "scene.toml: wind[0].tangential = -1.0: must not be negative"),
    ("[time]", "[[wind]]\nvelocity = [0, 1, 0]\nbody = 7\n[time]", "scene.toml: wind[0].body = 7: there is no such body; they count from 0 to 0"),
    ("[time]", "[[wind]]\nspeed = 3\n[time]", "scene.toml: line 3, column 1: `speed = 3`: wind[0].speed: unknown field `speed`, expected one of ..."),
    ("[time]", "[[collider]]\nwall = 3\n[time]", "scene.toml: line 3, column 1: `wall = 3`: collider[0].wall: unknown field `wall`, expected one of ..."),
    ("[time]", "gravity = [0, 1e300, 0]\n[time]", "scene.toml: gravity = [0.0, 1e300, 0.0]: is too large for f32"),
    // the mesh
    ("mesh = { box = [1.0, 0.25, 0.25], cells = [4, 1, 1] }", "mesh = \"none.msh\"", "scene.toml: body[0].mesh = \"none.msh\": cannot be read: No such file ..."),
    ("mesh = { box = [1.0, 0.25, 0.25], cells = [4, 1, 1] }", "mesh = \"beam.obj\"", "scene.toml: body[0].mesh = \"beam.obj\": not a mesh format known here ..."),
    ("mesh = { box = [1.0, 0.25, 0.25], cells = [4, 1, 1] }", "mesh = 3", "scene.toml: line 7, column 8: `mesh = 3`: body[0].mesh: invalid type: integer `3`, expected a file name or { box = [..], cells = [..] }"),
    ("cells = [4, 1, 1]", "cells = [4, 0, 1]", "scene.toml: body[0].mesh.cells = [4, 0, 1]: must be at least 1"),
    ("cells = [4, 1, 1]", "cells = [4, 1.5, 1]", "scene.toml: line 7, column 47: `mesh = { box = [1.0, 0.25, 0.25], cells = [4, 1.5, 1] }`: body[0].mesh.cells[1]: invalid type: floating point `1.5`, expected u32"),
    ("cells = [4, 1, 1]", "cells = [4000000, 4000000, 4000000]", "scene.toml: body[0].mesh = { box = [1.0, 0.25, 0.25], cells = [4000000, 4000000, 4000000] }: ..."),
    ("cells = [4, 1, 1]", "cell = [4, 1, 1]", "scene.toml: line 7, column 35: `mesh = { box = [1.0, 0.25, 0.25], cell = [4, 1, 1] }`: body[0].mesh.cell: unknown field ..."),
    ("box = [1.0, 0.25, 0.25]", "box = [1.0, -0.25, 0.25]", "scene.toml: body[0].mesh.box = -0.25: must be above 0"),
    // the top
    ("[time]", "speed = 3\n[time]", "scene.toml: line 2, column 1: `speed = 3`: speed: unknown field `speed`, expected one of `gravity`, ..."),
    ("[[body]]", "[body]", "scene.toml: line 6, column 1: `[body]`: body: ..."),
    ("density = 1000.0", "density = ", "scene.toml: line 10, column 11: `density =`: ..."),
];

#[test]
fn every_bad_value_is_named() {
    let folder = Folder::new();
    let mut wrong = Vec::new();
    for (from, to, expected) in ROWS {
        assert!(BEAM.contains(from), "{from}");
        let line = fails(&folder, BEAM.replacen(from, to, 1).as_bytes(), &[]);
        let good = match expected.strip_suffix("...") {
            Some(start) => line.starts_with(start),
            None => line == *expected,
        };
        if !good {
            wrong.push(format!("{to}\n  expected {expected}\n  found    {line}"));
        }
    }
    assert!(
        wrong.is_empty(),
        "{} of {}:\n{}",
        wrong.len(),
        ROWS.len(),
        wrong.join("\n")
    );
}

#[test]
fn files_that_are_no_scene() {
    let folder = Folder::new();
    for (scene, expected) in [
        (
            &b""[..],
            "scene.toml: line 1, column 1: missing field `time`",
        ),
        (
            b"[time]\ndt = 1\nsteps = 1\n",
            "scene.toml: body: there is none: at least one [[body]] is needed",
        ),
        (b"\xff\xfe\x00", "scene.toml: is not UTF-8 text"),
        (b"[time", "scene.toml: line 1, column 6: `[time`: "),
        (
            b"[time]\ndt = [1, ",
            "scene.toml: line 2, column 9: `dt = [1,`: ",
        ),
        (
            b"\x00\x01\x1b[2J",
            "scene.toml: line 1, column 4: `\\u{0}\\u{1}\\u{1b}[2J`: ",
        ),
    ] {
        let line = fails(&folder, scene, &[]);
        assert!(
            line.starts_with(expected),
            "expected {expected}\nfound    {line}"
        );
    }
    let endless = std::fs::File::create(folder.path("long.toml")).expect("a file");
    endless.set_len((64 << 20) + 1).expect("room");
    let run = folder.femto(&["run", "long.toml", "--out", "out"]);
    let line = "error: long.toml: has more than 64 MB\n";
    assert_eq!((run.status, run.err.as_str()), (2, line));
    // Every beginning of a good scene is an error or a scene, never a crash.
    for end in (0..BEAM.len()).step_by(7) {
        folder.write("scene.toml", &BEAM.as_bytes()[..end]);
        let run = folder.femto(&["run", "scene.toml", "--out", "out", "--quiet"]);
        assert!(run.status == 2 || run.status == 0, "{end}: {}", run.err);
        assert_eq!(
            run.err.lines().count(),
            usize::from(run.status == 2),
            "{end}: {}",
            run.err
        );
    }
}

#[test]
fn bad_mesh_files() {
    let folder = Folder::new();
    let node = "5 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n4 1 1 1\n";
    let ele = "2 4 0\n0 0 1 2 3\n1 1 2 3 4\n";
    let msh = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 4 1 4\n3 1 0 4\n1\n2\n3\n4\n\
               0 0 0\n1 0 0\n0 1 0\n0 0 1\n$EndNodes\n$Elements\n1 1 1 1\n3 1 4 1\n1 1 2 3 4\n$EndElements\n";
    let write = |name: &str, content: &[u8]| folder.write(name, content);
    for (name, node, ele) in [
        (
            "range",
            node,
            ele.replace("1 1 2 3 4", "1 1 2 3 5").as_str(),
        ),
        (
            "repeated",
            node,
            ele.replace("1 1 2 3 4", "1 1 2 3 3").as_str(),
        ),
        (
            "negative",
            node,
            ele.replace("0 0 1 2 3", "0 0 2 1 3").as_str(),
        ),
        ("flat", node.replace("4 1 1 1", "4 0.5 0.5 0").as_str(), ele),
        ("unused", node, "1 4 0\n0 0 1 2 3\n"),
        (
            "infinite",
            node.replace("4 1 1 1", "4 1 1 inf").as_str(),
            ele,
        ),
        ("empty", "", ele),
        ("none", "0 3\n", "0 4\n"),
        ("ten", node, "1 10 0\n0 0 1 2 3 0 1 2 3 0 1\n"),
        ("short", node, "2 4 0\n0 0 1 2 3\n"),
    ] {
        write(&format!("{name}.node"), node.as_bytes());
        write(&format!("{name}.ele"), ele.as_bytes());
    }
    folder.write("old.msh", msh.replace("4.1 0 8", "2.2 0 8"));
    folder.write("binary.msh", msh.replace("4.1 0 8", "4.1 1 8"));
    folder.write("garbage.msh", [0, 159, 146, 150, 10, 27, 255]);
    folder.write("negative.msh", msh.replace("1 1 2 3 4", "1 2 1 3 4"));
    folder.write("lost.msh", msh.replace("1 1 2 3 4", "1 1 2 3 8"));
    folder.write("cut.msh", &msh[..msh.len() - 30]);
    folder.write(
        "triangles.msh",
        msh.replace("3 1 4 1\n1 1 2 3 4", "2 1 2 1\n1 1 2 3"),
    );
    for (file, expected) in [
        (
            "range.node",
            "tet 1: node 5 is out of range (nodes go from 0 to 4); and 1 more",
        ),
        ("repeated.node", "tet 1: node 3 is repeated; and 1 more"),
        (
            "negative.node",
            "tet 0: its volume is negative (-1.6666666666666666e-1): inside out",
        ),
        ("flat.node", "tet 1: its volume is "),
        ("unused.node", "node 4: belongs to no tet"),
        (
            "infinite.node",
            "node 4: its position [1.0, 1.0, inf] is not finite in f32",
        ),
        (
            "empty.node",
            ".node ends before its head, the number of nodes",
        ),
        ("none.node", "the mesh has no nodes; and 1 more"),
        (
            "ten.node",
            ".ele line 1: 10-node tets are not supported, only 4-node tets",
        ),
        ("short.node", ".ele ends before tet 2 of 2"),
        ("old.msh", "Gmsh format 2.2: only 4.1 (ASCII) is supported"),
        ("binary.msh", "a binary Gmsh file: only ASCII is supported"),
        ("garbage.msh", "not a Gmsh file"),
        ("negative.msh", "tet 1: its volume is negative"),
        (
            "lost.msh",
            "tet 1: node 8 is out of range (no node has this tag)",
        ),
        ("cut.msh", ""),
        ("triangles.msh", "the mesh has no 4-node tets"),
    ] {
        let scene = BEAM.replace(
            "{ box = [1.0, 0.25, 0.25], cells = [4, 1, 1] }",
            &format!("\"{file}\""),
        );
        let line = fails(&folder, scene.as_bytes(), &[]);
        let expected = format!("scene.toml: body[0].mesh = \"{file}\": {expected}");
        assert!(
            line.starts_with(&expected),
            "expected {expected}\nfound    {line}"
        );
    }
}

#[test]
fn bad_command_lines() {
    let folder = Folder::new();
    folder.write("scene.toml", BEAM);
    folder.write("file", "");
    for arguments in [
        &["run", "scene.toml"][..],
        &["run", "--out", "out"],
        &["run", "scene.toml", "--out", "out", "--frames", "0"],
        &["run", "scene.toml", "--out", "out", "--frames", "12"],
        &["run", "scene.toml", "--out", "out", "--frames", "many"],
        &["run", "none.toml", "--out", "out"],
        &["run", "scene.toml", "--out", "file"],
        &["run", "scene.toml", "--out", "out", "--fast"],
        &["walk"],
        &["info"],
    ] {
        let run = folder.femto(arguments);
        assert_eq!((run.status, run.out.as_str()), (2, ""), "{arguments:?}");
        assert!(run.err.starts_with("error: "), "{}", run.err);
        assert!(!folder.path("out").exists(), "{arguments:?}");
    }
    let line = fails(&folder, BEAM.as_bytes(), &["--frames", "12"]);
    assert_eq!(
        line,
        "--frames 12: the run has only 11 states, the start and 10 steps"
    );
}
