//! Shapes of the modes of a slotted blade on a circle.

use super::elements::hermite;
use super::symmetry::Part;
use super::turning::{TurningMode, TurningModes};

/// The modes of a blade on a circle.
pub struct TurningCircle<'a> {
    modes: &'a TurningModes<'a>,
    /// By mode and by angle on half a pitch: value and slope over the angle of the even part, then of the odd one, in 1/√kg.
    nodes: Vec<Vec<[f64; 4]>>,
}

impl TurningModes<'_> {
    /// Number of coordinates.
    pub fn coordinates(&self) -> usize {
        self.modes.iter().map(TurningMode::coordinates).sum()
    }

    /// The modes on a circle of the blade.
    pub fn circle(&self, radius_m: f64) -> TurningCircle<'_> {
        let radii = &self.blade.mesh.radii_m;
        let after = radii.partition_point(|edge| *edge <= radius_m);
        let i = after.clamp(1, radii.len() - 1) - 1;
        let [radial, ..] = hermite(radius_m - radii[i], radii[i + 1] - radii[i]);
        let angles = self.blade.mesh.angles_rad.len();
        let of_mode = |mode: &TurningMode| {
            let own = &self.blade.classes[mode.class];
            let vector = self.vectors[mode.class].col(mode.column);
            let mut nodes = vec![[0.0; 4]; angles];
            for (part, kind) in own.class.parts().iter().enumerate() {
                for (angle, node) in nodes.iter_mut().enumerate() {
                    for turns in 0..2 {
                        let mut sum = 0.0;
                        for (p, value) in radial.iter().enumerate() {
                            let unknown = 2 * (p % 2) + turns;
                            if let Some(((block, index), factor)) =
                                own.unknowns.of_node(part, [i + p / 2, angle], unknown)
                            {
                                let row = own.basis.row(own.first[block] + index);
                                sum += value * factor * (row * vector);
                            }
                        }
                        node[2 * usize::from(*kind == Part::Odd) + turns] = sum / mode.norm;
                    }
                }
            }
            nodes
        };
        TurningCircle {
            modes: self,
            nodes: self.modes.iter().map(of_mode).collect(),
        }
    }
}

impl TurningCircle<'_> {
    /// Deflection of every coordinate at an angle on the blade, from the middle between two slots, and its slope over the angle, in 1/√kg.
    pub fn at(&self, angle_rad: f64, mut each: impl FnMut(f64, f64)) {
        let blade = self.modes.blade;
        let angles = &blade.mesh.angles_rad;
        let pitch = (angle_rad / blade.pitch_rad()).round();
        let within = angle_rad - pitch * blade.pitch_rad();
        let side = if within < 0.0 { -1.0 } else { 1.0 };
        let place = within.abs().min(angles[angles.len() - 1]);
        let after = angles.partition_point(|edge| *edge <= place);
        let j = after.clamp(1, angles.len() - 1) - 1;
        let [g, d, _] = hermite(place - angles[j], angles[j + 1] - angles[j]);
        for (mode, nodes) in self.modes.modes.iter().zip(&self.nodes) {
            let (from, to) = (&nodes[j], &nodes[j + 1]);
            let of = |part: usize, f: &[f64; 4]| {
                f[0] * from[part] + f[1] * from[part + 1] + f[2] * to[part] + f[3] * to[part + 1]
            };
            // On the other side of the middle the odd part and the slope of the even one change their signs.
            let (even, odd) = (of(0, &g), side * of(2, &g));
            let (even_slope, odd_slope) = (side * of(0, &d), of(2, &d));
            let (sin, cos) = (mode.phase_rad * pitch).sin_cos();
            if mode.is_pair {
                each(even * cos - odd * sin, even_slope * cos - odd_slope * sin);
                each(
                    -(even * sin + odd * cos),
                    -(even_slope * sin + odd_slope * cos),
                );
            } else {
                // One part is zero, and the phase is 0 or π.
                each((even + odd) * cos, (even_slope + odd_slope) * cos);
            }
        }
    }
}
