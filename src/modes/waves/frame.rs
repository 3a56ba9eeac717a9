//! The reduced model at one speed: near waves and strong dampers, everything else eliminated.
//!
//! With the displacements u = Pᵀq of the columns and their forces f = κ(λ) u,
//!
//! [D(λ) P; Pᵀ 0] [q; f] = [0; u].
//!
//! D is block diagonal. Its far part is eliminated block by block, which leaves the near waves x, f and u. Then the
//! forces are eliminated: those of weak columns with f = κu, those of strong dampers with u held, where u is kept
//! with κ(λ)u = f.

use faer::{Mat, MatRef, Scale};

use super::blade::Saw;
use super::near::Near;
use super::series::{Eliminated, QUADRATIC, Series, TERMS, eliminate};
use crate::model::system::GyroscopicSystem;

/// A block in the waves of the middle of an interval.
struct Turned {
    /// Unknowns: near cosines, near sines, far cosines, far sines.
    system: GyroscopicSystem,
    /// Rows of the columns P in these unknowns.
    columns: Mat<f64>,
    /// Number of near unknowns, and index of the first among all.
    near: usize,
    first: usize,
}

/// A column of forces.
#[derive(Clone, Copy)]
struct Force {
    stiffness: f64,
    damping: f64,
}

/// Everything about an interval that does not depend on the speed.
pub struct Frame {
    blocks: Vec<Turned>,
    /// Strong dampers first.
    forces: Vec<Force>,
    /// Number of near waves, and of strong dampers.
    waves: usize,
    strong: usize,
    /// Top of the window, in 1/s: the unit of λ.
    window: f64,
}

impl Frame {
    /// The frame of a saw for what is near.
    pub fn new(saw: &Saw, near: &Near, window: f64) -> Self {
        let (columns, forces) = gathered(saw, near, window);
        let mut first = 0;
        let mut blocks = Vec::new();
        for (block, part) in saw.blocks.iter().zip(&near.blocks) {
            let (radial, copies) = (block.radial, block.copies());
            let order = unknowns(radial, copies, part.near);
            let turn = Mat::from_fn(copies * radial, copies * radial, |i, k| {
                let (copy, wave) = order[k];
                match i / radial == copy {
                    true => part.vectors[(i % radial, wave)],
                    false => 0.0,
                }
            });
            let own = columns.subrows(block.first, copies * radial);
            let count = copies * part.near;
            blocks.push(Turned {
                system: block.system.project(turn.as_ref()),
                columns: turn.transpose() * own,
                near: count,
                first,
            });
            first += count;
        }
        Frame {
            blocks,
            forces,
            waves: first,
            strong: near.strong(),
            window,
        }
    }

    /// Number of unknowns of the reduced model.
    pub fn size(&self) -> usize {
        self.waves + self.strong
    }

    /// K̃, C̃, M̃ and further terms at a speed, in units of the window, in the displacements of strong dampers and the near
    /// waves.
    pub fn reduced(&self, speed: f64) -> Series {
        self.equations(speed).onto_first(self.size())
    }

    /// The equations of strong dampers z, near waves x and forces f, those of strong dampers first, after the
    /// elimination of the far waves.
    fn equations(&self, speed: f64) -> Series {
        let mut all = self.without_far_waves(speed);
        let (first, strong) = (self.size(), self.strong);
        // Rows of weak columns times κ(λ), from the last power down.
        for power in (0..TERMS).rev() {
            let earlier = match power {
                0 => None,
                _ => all.0[power - 1].clone(),
            };
            let Some(term) = all.0[power].as_mut() else {
                continue;
            };
            for (i, Force { stiffness, damping }) in self.forces.iter().enumerate().skip(strong) {
                for k in 0..term.ncols() {
                    let before = earlier.as_ref().map_or(0.0, |m| m[(first + i, k)]);
                    let own = stiffness * term[(first + i, k)];
                    term[(first + i, k)] = own + damping * before;
                }
            }
        }
        let size = first + self.forces.len();
        for (i, Force { stiffness, damping }) in self.forces.iter().enumerate() {
            let leading = all.term_mut(0, size, size);
            if i < strong {
                leading[(first + i, i)] = -1.0;
                leading[(i, first + i)] = -1.0;
                leading[(i, i)] = *stiffness;
                all.term_mut(1, size, size)[(i, i)] = *damping;
            } else {
                leading[(first + i, first + i)] -= 1.0;
            }
        }
        all
    }

    /// These equations before the forces are connected with displacements: Pᵀq in the rows of forces.
    fn without_far_waves(&self, speed: f64) -> Series {
        let size = self.size() + self.forces.len();
        let mut total = Series::default();
        for power in 0..TERMS {
            total.term_mut(power, size, size);
        }
        for block in &self.blocks {
            let inertia = Mat::identity(block.columns.nrows(), block.columns.nrows());
            let dynamic = [
                Scale(self.window.powi(-2)) * block.system.stiffness_at(speed),
                Scale(self.window.recip()) * block.system.velocity_at(speed),
                inertia,
            ];
            let own = block.eliminated(&dynamic);
            let place = |i: usize| match i < block.near {
                true => self.strong + block.first + i,
                false => self.size() + i - block.near,
            };
            for (into, from) in total.0.iter_mut().flatten().zip(own.0.iter().flatten()) {
                for k in 0..from.ncols() {
                    for i in 0..from.nrows() {
                        into[(place(i), place(k))] += from[(i, k)];
                    }
                }
            }
        }
        total
    }
}

impl Turned {
    /// Series of the near unknowns and of all forces, with the far unknowns of this block eliminated.
    fn eliminated(&self, dynamic: &[Mat<f64>; QUADRATIC]) -> Series {
        let (near, rank) = (self.near, self.columns.ncols());
        let size = near + rank;
        let near_columns = self.columns.subrows(0, near);
        let far_columns = self.columns.subrows(near, self.columns.nrows() - near);
        let mut kept = Series::default();
        let (mut by_far, mut by_kept) = (Series::default(), Series::default());
        let mut far = Series::default();
        for (power, matrix) in dynamic.iter().enumerate() {
            let into = kept.term_mut(power, size, size);
            into.get_mut(..near, ..near)
                .copy_from(matrix.get(..near, ..near));
            far.0[power] = Some(matrix.get(near.., near..).to_owned());
            if power < 2 {
                let count = matrix.nrows() - near;
                let into = by_far.term_mut(power, size, count);
                into.get_mut(..near, ..)
                    .copy_from(matrix.get(..near, near..));
                let into = by_kept.term_mut(power, count, size);
                into.get_mut(.., ..near)
                    .copy_from(matrix.get(near.., ..near));
            }
        }
        let copy = |into: &mut Series, first: (usize, usize), from: MatRef<'_, f64>| {
            if let Some(into) = into.0[0].as_mut() {
                into.get_mut(
                    first.0..first.0 + from.nrows(),
                    first.1..first.1 + from.ncols(),
                )
                .copy_from(from);
            }
        };
        copy(&mut kept, (0, near), near_columns);
        copy(&mut kept, (near, 0), near_columns.transpose());
        copy(&mut by_far, (near, 0), far_columns.transpose());
        copy(&mut by_kept, (0, near), far_columns);
        for power in QUADRATIC..TERMS {
            kept.term_mut(power, size, size);
        }
        let parts = Eliminated {
            kept_by_far: &by_far,
            far_by_kept: &by_kept,
            far: &far,
        };
        eliminate(&mut kept, &parts);
        kept
    }
}

/// Copy and wave of each unknown: near cosines, near sines, far cosines, far sines.
fn unknowns(radial: usize, copies: usize, near: usize) -> Vec<(usize, usize)> {
    let of = |waves: std::ops::Range<usize>| {
        (0..copies).flat_map(move |copy| waves.clone().map(move |wave| (copy, wave)))
    };
    of(0..near).chain(of(near..radial)).collect()
}

/// All columns in units of the window, strong ones first, and their forces.
fn gathered(saw: &Saw, near: &Near, window: f64) -> (Mat<f64>, Vec<Force>) {
    let mut found: Vec<(bool, usize, usize)> = Vec::new();
    let mut sets = Vec::new();
    for (k, (set, rotation)) in saw.columns.iter().zip(&near.rotations).enumerate() {
        let strong = rotation.as_ref().map_or(0, |r| r.strong);
        found.extend((0..set.vectors.ncols()).map(|i| (i >= strong, k, i)));
        sets.push(match rotation {
            Some(rotation) => &set.vectors * &rotation.matrix,
            None => set.vectors.clone(),
        });
    }
    found.sort_by_key(|(is_weak, ..)| *is_weak);
    let forces = found.iter().map(|(_, k, i)| {
        let weight = near.rotations[*k].as_ref().map_or(1.0, |r| r.weights[*i]);
        Force {
            stiffness: weight * saw.columns[*k].stiffness,
            damping: weight * saw.columns[*k].damping * window,
        }
    });
    let columns = Mat::from_fn(saw.order, found.len(), |row, column| {
        let (_, k, i) = found[column];
        sets[k][(row, i)] / window
    });
    (columns, forces.collect())
}
