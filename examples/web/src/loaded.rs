//! Assets, with the bytes that they borrow from.

use alloc::rc::Rc;

use femto::Asset;
use femto::asset::AssetBytes;
use self_cell::self_cell;

use crate::fault::Fault;

self_cell!(
    /// An asset and its bytes.
    pub struct Loaded {
        owner: AssetBytes,
        #[covariant]
        dependent: Asset,
    }
);

/// Checks bytes and keeps them.
pub fn load(bytes: AssetBytes) -> Result<Rc<Loaded>, Fault> {
    Ok(Rc::new(Loaded::try_new(bytes, |bytes| Asset::new(bytes))?))
}

#[cfg(feature = "meshes")]
pub use made::{of_mesh, of_other_material};

#[cfg(feature = "meshes")]
mod made {
    use alloc::rc::Rc;
    use alloc::vec::Vec;

    use femto::asset::Metadata;
    use femto::owned::OwnedRest;
    use femto::{Asset, Factor, Material, Mesh, Pin, Settings};

    use super::{Loaded, load};
    use crate::fault::Fault;

    /// Young's modulus, Poisson's ratio, density, α, β.
    fn material([young, poisson, density, alpha, beta]: [f32; 5]) -> Result<Material, Fault> {
        let material = Material::new(young, poisson, density);
        Ok(material.and_then(|material| material.with_damping(alpha, beta))?)
    }

    /// An asset of a mesh: no factor, no pins.
    pub fn of_mesh(
        nodes: &[[f32; 3]],
        tets: &[[u32; 4]],
        numbers: [f32; 5],
    ) -> Result<Rc<Loaded>, Fault> {
        let mesh = Mesh::new(nodes, tets)?;
        let metadata = Metadata {
            source: "mesh",
            material: material(numbers)?,
            settings: Settings::new(1.0 / 150.0)?,
        };
        make(&mesh, None, &[], metadata)
    }

    /// The same body of another material. It keeps its factor, which then fits less well.
    pub fn of_other_material(asset: &Asset<'_>, numbers: [f32; 5]) -> Result<Rc<Loaded>, Fault> {
        let tets: Vec<[u32; 4]> = asset.rest.tets().collect();
        let mesh = Mesh::new(asset.rest.nodes, &tets)?;
        let metadata = Metadata {
            material: material(numbers)?,
            ..asset.metadata
        };
        make(&mesh, asset.factor, asset.pins, metadata)
    }

    fn make(
        mesh: &Mesh<'_>,
        factor: Option<Factor<'_>>,
        pins: &[Pin],
        metadata: Metadata<'_>,
    ) -> Result<Rc<Loaded>, Fault> {
        let rest = OwnedRest::new(mesh, &metadata.material)?;
        let asset = Asset {
            rest: rest.view(),
            factor,
            pins,
            metadata,
        };
        load(asset.to_bytes()?)
    }
}
