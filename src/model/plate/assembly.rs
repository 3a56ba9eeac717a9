//! Assembly of the matrices of a scene.

use std::ops::RangeInclusive;

use faer::Mat;

use super::contact::{Contact, ContactTerms, LiftingPads};
use super::edge_load::{EdgeStress, RimForce, edge_stiffness};
use super::harmonic::HarmonicBlock;
use super::head::{self, Head};
use super::matrices::{Plate, sampled_radii};
use super::membrane::{MembraneStress, membrane_stiffness};
use super::pad_state::PadState;
use super::radial::RadialBasis;
use super::resolution::Resolution;
use super::stress::CentrifugalStress;
use crate::model::scene::{Blade, Cut, CutRun, Scene};

/// Stiffness of the free blade in a range of nodal diameters, without damping.
fn harmonics(
    blade: &Blade,
    basis: &RadialBasis,
    spinning: &CentrifugalStress,
    membrane: Option<&MembraneStress>,
    diameters: RangeInclusive<usize>,
) -> Vec<HarmonicBlock> {
    let mut blocks: Vec<HarmonicBlock> = diameters
        .clone()
        .map(|n| HarmonicBlock::new(blade, spinning, basis, n))
        .collect();
    if let Some(stress) = membrane {
        let stiffness = membrane_stiffness(basis, stress, diameters);
        for (block, stiffness) in blocks.iter_mut().zip(stiffness) {
            block.membrane = Some(stiffness);
        }
    }
    blocks
}

impl Plate {
    /// Assembles the matrices of a scene in a basis of a size that [`Resolution::new`] accepts.
    pub fn new(scene: &Scene, resolution: Resolution) -> Self {
        let basis = RadialBasis::new(scene.blade(), resolution.radial_functions);
        let spinning = CentrifugalStress::new(scene.blade());
        let membrane = scene
            .membrane()
            .and_then(|named| MembraneStress::new(scene.blade(), named));
        let all = 0..=resolution.max_diameters;
        let mut harmonics = harmonics(scene.blade(), &basis, &spinning, membrane.as_ref(), all);
        let damping = scene.damping();
        if let Some(damping) = damping.filter(|damping| damping.is_material()) {
            for (n, block) in harmonics.iter_mut().enumerate() {
                block
                    .set_material_damping(damping.material_retardation_time_s, damping.ratio_of(n));
            }
        }
        let heads = Head::of(scene.guides());
        let states = PadState::of(scene.guides(), scene.blade());
        head::stand(&heads, states.len(), &mut harmonics);
        let samples = [0, 1].map(|n| {
            sampled_radii(scene.blade())
                .into_iter()
                .map(|r| basis.evaluate(n, r).value)
                .collect()
        });
        let mut plate = Plate {
            blade: *scene.blade(),
            resolution,
            basis,
            spinning,
            heads,
            states,
            harmonics,
            contact: ContactTerms::default(),
            lifting: None,
            edge_stiffness: None,
            damping: damping.cloned(),
            membrane,
            samples,
        };
        let mut contact = ContactTerms::default();
        for guide in scene.guides() {
            guide.add_to(&plate, &mut contact);
        }
        plate.contact = contact;
        plate.lifting = LiftingPads::of(&plate, scene.guides());
        match scene.cut().and_then(|cut| cut.chart.map(|run| (cut, run))) {
            Some((cut, run)) => plate.in_cut(cut, &run),
            None => plate,
        }
    }

    /// The plate with one more contact. A guide stands on an arm without mass.
    pub fn with_contact(&self, more: &impl Contact) -> Self {
        let mut plate = self.clone();
        more.add_to(self, &mut plate.contact);
        if let Some(lifting) = &mut plate.lifting {
            more.add_to(self, &mut lifting.released);
        }
        plate
    }

    /// The plate with the pads that lift off inside their gaps, where they have only the stiffness of their
    /// films; `None` if no pad lifts off.
    pub(crate) fn released(&self) -> Option<Self> {
        let lifting = self.lifting.as_ref()?;
        Some(Plate {
            contact: lifting.released.clone(),
            lifting: None,
            ..self.clone()
        })
    }

    /// The plate under dead forces at its rim, with reactions at the bore as in [`EdgeStress`].
    pub fn with_edge_loads(&self, loads: &[RimForce]) -> Self {
        self.with_edge_stiffness(self.edge_stiffness_of(loads))
    }

    /// K_e of dead forces at the rim, in 1/s², N × N.
    pub(crate) fn edge_stiffness_of(&self, loads: &[RimForce]) -> Mat<f64> {
        let stress = EdgeStress::new(&self.blade, loads, 2 * self.max_diameters());
        edge_stiffness(self, &stress)
    }

    /// The plate in a cut: under its mean forces, as dead loads, and in contact with the wood.
    pub fn in_cut(&self, cut: &Cut, run: &CutRun) -> Self {
        let loads = RimForce::of_teeth(&cut.teeth.standing(), run);
        let loaded = self.with_edge_loads(&loads);
        match &cut.wood {
            Some(wood) => loaded.with_contact(wood),
            None => loaded,
        }
    }

    /// The plate with a given K_e, in 1/s², N × N.
    pub(crate) fn with_edge_stiffness(&self, edge_stiffness: Mat<f64>) -> Self {
        Plate {
            edge_stiffness: Some(edge_stiffness),
            ..self.clone()
        }
    }

    /// The plate without stress of heat, roll tension or manufacture.
    pub(crate) fn without_membrane(&self) -> Self {
        let mut plate = Plate {
            membrane: None,
            ..self.clone()
        };
        plate.harmonics.iter_mut().for_each(|h| h.membrane = None);
        plate
    }

    /// The plate without damping and without contact forces that have no potential.
    pub fn conservative(&self) -> Self {
        Plate {
            contact: self.contact.conservative(),
            lifting: self.lifting.as_ref().map(LiftingPads::conservative),
            damping: None,
            ..self.clone()
        }
    }

    /// Stiffness of the free blade in a range of nodal diameters that the basis may lack, in the radial functions
    /// of the plate and without damping.
    pub(crate) fn harmonics_of(&self, diameters: RangeInclusive<usize>) -> Vec<HarmonicBlock> {
        let (blade, basis, membrane) = (&self.blade, &self.basis, self.membrane.as_ref());
        harmonics(blade, basis, &self.spinning, membrane, diameters)
    }
}
