//! A slotted blade that turns beside what is fixed in space.

use super::error::NotComputed;
use crate::model::plate::{PadPoint, Plate, TurningBlade, TurningModes, pad_points};
use crate::model::scene::{DampingFile, Scene};

/// A point fixed in space with a spring and a damper.
#[derive(Debug, Clone, Copy)]
pub(super) struct Site {
    /// Index of its radius in the list of radii.
    pub circle: usize,
    /// Angle in space.
    pub angle_rad: f64,
    pub stiffness_n_per_m: f64,
    pub damping_n_s_per_m: f64,
}

/// Springs and dampers beside a turning blade, and the damping of the blade.
pub struct GuidedBlade<'a> {
    pub(super) blade: &'a TurningBlade,
    pub(super) damping: Option<&'a DampingFile>,
    pub(super) radii_m: Vec<f64>,
    pub(super) sites: Vec<Site>,
}

impl<'a> GuidedBlade<'a> {
    /// The guides of a scene beside a blade, as points with shares of their stiffness and damping.
    ///
    /// # Errors
    /// [`NotComputed`] for guides with arms, films or controllers, whose own motions are not contained, for the forces of the cut, for air
    /// that does not turn with the blade, and without guides.
    pub fn new(
        blade: &'a TurningBlade,
        scene: &'a Scene,
        plate: &Plate,
    ) -> Result<Self, NotComputed> {
        if plate.edge_stiffness.is_some() || scene.cut().is_some_and(|cut| cut.chart.is_some()) {
            return Err(NotComputed::Cut);
        }
        let damping = scene.damping();
        let is_moving = |air: f64, share: f64| air > 0.0 && share != 1.0;
        if damping.is_some_and(|it| is_moving(it.air_n_s_per_m3, it.air_rotation_share)) {
            return Err(NotComputed::Air);
        }
        let mut own = GuidedBlade {
            blade,
            damping,
            radii_m: Vec::new(),
            sites: Vec::new(),
        };
        for guide in scene.guides() {
            let pad = &guide.typed;
            if pad.arm.is_some() {
                return Err(NotComputed::Guide("an arm"));
            }
            if pad.film.is_some() || guide.film.is_some() {
                return Err(NotComputed::Guide("a film whose damping lags"));
            }
            if pad.controller.is_some() {
                return Err(NotComputed::Guide("a controller"));
            }
            for point in pad_points(&plate.blade, pad) {
                own.add(
                    &point,
                    pad.angle_rad(),
                    [pad.stiffness_n_per_m, pad.damping_n_s_per_m],
                );
            }
        }
        if own.sites.is_empty() {
            return Err(NotComputed::Nothing);
        }
        Ok(own)
    }

    fn add(&mut self, point: &PadPoint, centre_rad: f64, [stiffness, damping]: [f64; 2]) {
        let is_its = |radius: &f64| (radius / point.radius_m - 1.0).abs() < SAME;
        let known = self.radii_m.iter().position(is_its);
        let circle = known.unwrap_or_else(|| {
            self.radii_m.push(point.radius_m);
            self.radii_m.len() - 1
        });
        self.sites.push(Site {
            circle,
            angle_rad: centre_rad + point.angle_rad,
            stiffness_n_per_m: stiffness * point.share,
            damping_n_s_per_m: damping * point.share,
        });
    }

    /// Whether a site has a damper.
    pub(super) fn is_damped(&self) -> bool {
        self.sites.iter().any(|site| site.damping_n_s_per_m > 0.0)
    }

    /// The lowest modes of the blade at a speed, with at most so many coordinates.
    pub(super) fn modes(&self, speed_rad_per_s: f64, most: usize) -> Option<TurningModes<'a>> {
        self.blade.modes(speed_rad_per_s, self.damping, most)
    }
}

/// Radii that differ by a smaller share are one: those of points on both sides of a centre line differ by rounding.
const SAME: f64 = 1e-9;
