//! VTK unstructured grids (`.vtu`, XML with ASCII data) and the `.pvd` that lists them with
//! their times, for ParaView.

use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;

use quick_xml::Writer;
use quick_xml::events::{BytesDecl, BytesEnd, BytesStart, BytesText, Event};

use crate::scene::Body;
use crate::sim::Sim;

/// VTK's number for a 4-node tet.
const TETRA: u8 = 10;

type Xml = Writer<BufWriter<File>>;

/// All bodies in one grid: positions, velocities, and the body of each tet; where bodies yield, the norm of its plastic
/// strain. What has broken is left out.
pub fn write_frame(path: &Path, sim: &Sim, bodies: &[Body]) -> io::Result<()> {
    let tets: Vec<_> = bodies.iter().map(Body::shown_tets).collect();
    let shown = |of: &dyn Fn(usize) -> Vec<[f32; 3]>| (0..bodies.len()).map(of).collect::<Vec<_>>();
    let positions = shown(&|b| bodies[b].show(sim.positions(b)));
    let velocities = shown(&|b| bodies[b].show(sim.velocities(b)));
    let points: usize = positions.iter().map(Vec::len).sum();
    let whole: Vec<Vec<bool>> = (tets.iter().enumerate())
        .map(|(b, t)| sim.whole(b, t.len()))
        .collect();
    let cells = whole.iter().flatten().filter(|&&whole| whole).count();
    let mut xml = begin(path, "UnstructuredGrid")?;
    open(&mut xml, "UnstructuredGrid", &[])?;
    let counts = [
        ("NumberOfPoints", points.to_string()),
        ("NumberOfCells", cells.to_string()),
    ];
    open(&mut xml, "Piece", &counts)?;

    open(&mut xml, "PointData", &[("Vectors", "velocity".into())])?;
    let velocities = velocities.iter().flatten();
    array(&mut xml, "Float32", "velocity", 3, velocities.map(triple))?;
    close(&mut xml, "PointData")?;

    open(&mut xml, "CellData", &[("Scalars", "body".into())])?;
    let body_of = (whole.iter().enumerate())
        .flat_map(|(b, whole)| whole.iter().filter(|&&whole| whole).map(move |_| b));
    array(&mut xml, "Int32", "body", 1, body_of)?;
    if sim.yields() {
        let strains = whole.iter().enumerate().flat_map(|(b, whole)| {
            let strains = sim.plastic_strain(b, whole.len());
            let strains = strains.into_iter().zip(whole);
            strains
                .filter(|(_, whole)| **whole)
                .map(|(strain, _)| strain)
        });
        array(&mut xml, "Float32", "plastic_strain", 1, strains)?;
    }
    close(&mut xml, "CellData")?;

    open(&mut xml, "Points", &[])?;
    let all = positions.iter().flatten();
    array(&mut xml, "Float32", "position", 3, all.map(triple))?;
    close(&mut xml, "Points")?;

    open(&mut xml, "Cells", &[])?;
    let mut first = 0;
    let mut corners = Vec::with_capacity(cells);
    for (body, (tets, whole)) in tets.iter().zip(&whole).enumerate() {
        let here = tets.iter().zip(whole).filter(|(_, whole)| **whole);
        corners.extend(here.map(|(t, _)| {
            let [a, b, c, d] = t.map(|node| node as usize + first);
            format!("{a} {b} {c} {d}")
        }));
        first += positions[body].len();
    }
    array(&mut xml, "Int64", "connectivity", 1, corners)?;
    array(&mut xml, "Int64", "offsets", 1, (1..=cells).map(|n| 4 * n))?;
    array(&mut xml, "UInt8", "types", 1, (0..cells).map(|_| TETRA))?;
    close(&mut xml, "Cells")?;

    close(&mut xml, "Piece")?;
    close(&mut xml, "UnstructuredGrid")?;
    end(xml)
}

/// The files of a run with their times.
pub fn write_collection(path: &Path, frames: &[(f64, String)]) -> io::Result<()> {
    let mut xml = begin(path, "Collection")?;
    open(&mut xml, "Collection", &[])?;
    for (time, file) in frames {
        let entry = BytesStart::new("DataSet").with_attributes([
            ("timestep", time.to_string().as_str()),
            ("part", "0"),
            ("file", file),
        ]);
        xml.write_event(Event::Empty(entry))?;
    }
    close(&mut xml, "Collection")?;
    end(xml)
}

fn begin(path: &Path, kind: &str) -> io::Result<Xml> {
    let mut xml = Writer::new_with_indent(BufWriter::new(File::create(path)?), b' ', 1);
    xml.write_event(Event::Decl(BytesDecl::new("1.0", None, None)))?;
    let attributes = [
        ("type", kind),
        ("version", "1.0"),
        ("byte_order", "LittleEndian"),
    ];
    let attributes = attributes.map(|(key, value)| (key, value.to_string()));
    open(&mut xml, "VTKFile", &attributes)?;
    Ok(xml)
}

fn end(mut xml: Xml) -> io::Result<()> {
    close(&mut xml, "VTKFile")?;
    let mut file = xml.into_inner();
    file.write_all(b"\n")?;
    file.flush()
}

fn open(xml: &mut Xml, name: &str, attributes: &[(&str, String)]) -> io::Result<()> {
    let attributes = attributes.iter().map(|(key, value)| (*key, value.as_str()));
    xml.write_event(Event::Start(
        BytesStart::new(name).with_attributes(attributes),
    ))
}

fn close(xml: &mut Xml, name: &str) -> io::Result<()> {
    xml.write_event(Event::End(BytesEnd::new(name)))
}

fn array<T: ToString>(
    xml: &mut Xml,
    kind: &str,
    name: &str,
    components: usize,
    values: impl IntoIterator<Item = T>,
) -> io::Result<()> {
    let attributes = [
        ("type", kind.to_string()),
        ("Name", name.to_string()),
        ("NumberOfComponents", components.to_string()),
        ("format", "ascii".to_string()),
    ];
    open(xml, "DataArray", &attributes)?;
    let mut text = String::from("\n");
    for value in values {
        text += &value.to_string();
        text.push('\n');
    }
    xml.write_event(Event::Text(BytesText::from_escaped(text)))?;
    close(xml, "DataArray")
}

fn triple([x, y, z]: &[f32; 3]) -> String {
    format!("{x:?} {y:?} {z:?}")
}
