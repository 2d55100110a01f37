//! Ground given by heights on a grid.

use glam::Vec3;

use super::{ColliderError, Near, SignedDistance};
use crate::cost::Shapes;
use crate::math::{select, sqrt};

/// Everything below a surface over a grid of heights, up being y. Metres.
///
/// Sample (i, k) is at x = i·spacing, z = k·spacing of its axis, and `heights[i·nz + k]` high; cells are cut in two
/// triangles from their low corner to their high one. Beyond the grid its border goes on level. Place it by a
/// [`Frame`](crate::frame::Frame).
///
/// The distance is that to the plane of the triangle above or below a node: exact next to the triangle's inside, and
/// its sign is exact everywhere. Nodes that would end a step inside are put straight up (or down the frame's y), onto
/// the surface. A peak or ridge between the nodes of a body goes unseen, as with every collider here.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeightField<'a> {
    heights: &'a [f32],
    cells: [u32; 2],
    per_spacing: [f32; 2],
}

impl<'a> HeightField<'a> {
    /// `samples` and `spacing` (metres) along x and z.
    ///
    /// # Errors
    /// [`ColliderError::Grid`], [`ColliderError::Height`].
    pub fn new(
        heights: &'a [f32],
        samples: [u32; 2],
        spacing: [f32; 2],
    ) -> Result<Self, ColliderError> {
        let [nx, nz] = samples;
        let per_spacing = spacing.map(|s| 1.0 / s);
        let usable = |s: f32| s > 0.0 && s.is_normal();
        let count = u64::from(nx) * u64::from(nz);
        // Indices, and their f32, are exact.
        let small = |n: u32| (2..=1 << 23).contains(&n);
        if !(small(nx)
            && small(nz)
            && count == heights.len() as u64
            && u32::try_from(count).is_ok()
            && spacing.into_iter().chain(per_spacing).all(usable))
        {
            return Err(ColliderError::Grid);
        }
        let field = Self {
            heights,
            cells: [nx - 1, nz - 1],
            per_spacing,
        };
        let slopes_fit = |index: u32| {
            let (i, k) = (index / nz, index % nz);
            let here = field.height(i, k);
            let ahead = [(i + 1).min(nx - 1), (k + 1).min(nz - 1)];
            let [x, z] = per_spacing;
            let slope = (field.height(ahead[0], k) - here) * x;
            let other = (field.height(i, ahead[1]) - here) * z;
            (4.0 * (slope * slope + other * other)).is_finite()
        };
        let infinite = (0..).zip(heights).find(|(_, height)| !height.is_finite());
        let infinite = infinite.map(|(index, _)| index);
        let bad = infinite.or_else(|| (0..nx * nz).find(|&index| !slopes_fit(index)));
        bad.map_or(Ok(field), |index| Err(ColliderError::Height { index }))
    }

    #[inline]
    fn height(&self, i: u32, k: u32) -> f32 {
        let index = i * (self.cells[1] + 1) + k;
        self.heights.get(index as usize).copied().unwrap_or(0.0)
    }
}

/// The cell of a place along one axis, how far it is into it (0 to 1), and whether it lies over the grid.
#[inline]
fn cell(at: f32, cells: u32) -> (u32, f32, bool) {
    let most = cells as f32;
    let over = (at > 0.0) & (at < most);
    let at = select(at > 0.0, at, 0.0);
    let at = select(at < most, at, most);
    // The last sample belongs to the last cell.
    let last = cells - 1;
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "from 0 to `cells`"
    )]
    let index = (at as u32).min(last);
    (index, at - index as f32, over)
}

impl SignedDistance for HeightField<'_> {
    #[inline]
    fn near(&self, x: Vec3, _later: f32) -> Near {
        let (i, a, over_x) = cell(x.x * self.per_spacing[0], self.cells[0]);
        let (k, c, over_z) = cell(x.z * self.per_spacing[1], self.cells[1]);
        let low = self.height(i, k);
        let high = self.height(i + 1, k + 1);
        let along_x = self.height(i + 1, k);
        let along_z = self.height(i, k + 1);
        // The triangle's rise along x and z, a cell each.
        let first = a > c;
        let rise_x = select(first, along_x - low, high - along_z);
        let rise_z = select(first, high - along_x, along_z - low);
        let height = low + a * rise_x + c * rise_z;
        let slope_x = select(over_x, rise_x * self.per_spacing[0], 0.0);
        let slope_z = select(over_z, rise_z * self.per_spacing[1], 0.0);
        let steep = sqrt(1.0 + slope_x * slope_x + slope_z * slope_z);
        let up = 1.0 / steep;
        Near {
            way_out: Vec3::new(0.0, steep, 0.0),
            ..Near::fixed(
                (x.y - height) * up,
                Vec3::new(-slope_x * up, up, -slope_z * up),
            )
        }
    }

    fn count(&self, shapes: &mut Shapes) {
        shapes.height_fields += 1;
    }
}
