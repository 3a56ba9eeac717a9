//! Bore ratios, Poisson's ratios and nodal diameters against Bessel roots.

use sawflutter::model::plate::{Plate, Resolution};
use sawflutter::model::scene::{InPlane, Material, Mount, Scene, SpeedRange};
use sawflutter::modes::{ModeKind, SpectralModel, Strategy};

use crate::common::{self, AnnulusRoot};
use crate::row::Row;
use crate::saws::{scene, unguided};

fn annulus(root: &AnnulusRoot) -> Scene {
    let mut file = unguided();
    let blade = &mut file.blade;
    blade.outer_diameter_m = 0.8;
    blade.inner_diameter_m = 0.8 * root.ratio;
    // The blade is thinner than the narrowest ring is wide.
    blade.thickness_m = 0.001;
    blade.material = Material {
        poisson_ratio: root.nu,
        ..blade.material
    };
    if root.bc == "CF" {
        file.mount = Mount::Collar {
            diameter_m: blade.inner_diameter_m,
            in_plane: InPlane::Free,
            clamp_stiffness_n_m_per_rad_per_m: None,
        };
    }
    scene(&file)
}

/// Lowest elastic λ² = ωb²√(ρh/D) of n diameters, as the program finds it at rest.
fn lowest_root(scene: &Scene, n: usize, radial_functions: usize) -> f64 {
    let resolution = Resolution {
        max_diameters: n,
        radial_functions,
    };
    let plate = Plate::new(scene, resolution);
    let model = SpectralModel::new(
        plate,
        SpeedRange::between_rpm(0.0, 100.0),
        Strategy::Reduced,
    )
    .unwrap();
    let modes = model.all_modes(0.0).unwrap();
    let lowest = common::of_diameters(&modes, n).find(|mode| mode.kind != ModeKind::Rigid);
    let blade = scene.blade();
    let specific = blade.flexural_rigidity_n_m() / blade.mass_per_area_kg_per_m2();
    lowest.unwrap().frequency_rad_per_s() / specific.sqrt() * blade.outer_radius_m.powi(2)
}

fn bessel(mut row: Row, functions: usize, chosen: impl Fn(&AnnulusRoot) -> bool) -> Row {
    let roots: Vec<AnnulusRoot> = common::table("annulus_extreme.csv");
    let mut count = 0;
    for root in roots.iter().filter(|root| chosen(root)) {
        assert_eq!(root.s, 0);
        let found = lowest_root(&annulus(root), root.n, functions);
        let AnnulusRoot {
            bc, nu, ratio, n, ..
        } = root;
        let place = format!("{bc}, nu = {nu}, a/b = {ratio}, n = {n}");
        row.compare(&[found], &[root.lambda2], &place);
        count += 1;
    }
    assert!(count > 0, "{}", row.what);
    row
}

const BESSEL: &str = "Bessel roots, 50 digits carried";

pub fn needle_bore() -> Row {
    let row = Row::new("bore ratio, free", "0.001, n = 0 to 4", BESSEL, 1e-5);
    bessel(row, 12, |r| r.ratio == 0.001 && r.bc == "FF")
}

pub fn narrow_ring() -> Row {
    // The fourth radial mode of such a ring is a million times faster than the first. The remaining error comes from
    // the slow rotation that separates forward and backward waves at rest.
    let row = Row::new("bore ratio, free", "0.995, n = 0 to 4", BESSEL, 1e-8);
    bessel(row, 12, |r| r.ratio == 0.995 && r.bc == "FF")
}

pub fn needle_collar() -> Row {
    let row = Row::new("bore ratio, clamped", "0.001, n = 2 to 4", BESSEL, 1e-4);
    bessel(row, 12, |r| r.ratio == 0.001 && r.bc == "CF" && r.n >= 2)
}

pub fn needle_collar_umbrella() -> Row {
    let what = "bore ratio, clamped (logarithmic at the bore)";
    bessel(Row::new(what, "0.001, n = 0", BESSEL, 1e-2), 12, |r| {
        r.ratio == 0.001 && r.bc == "CF" && r.n == 0
    })
}

pub fn narrow_clamped_ring() -> Row {
    let row = Row::new("bore ratio, clamped", "0.995, n = 0 to 4", BESSEL, 1e-5);
    bessel(row, 12, |r| r.ratio == 0.995 && r.bc == "CF")
}

pub fn poisson_ratios() -> Row {
    let row = Row::new("Poisson's ratio", "-0.99, 0, 0.4999", BESSEL, 1e-5);
    bessel(row, 12, |r| [-0.99, 0.0, 0.4999].contains(&r.nu))
}

pub fn diameters_of_the_reference_basis() -> Row {
    let row = Row::new(
        "nodal diameters, 12 radial functions",
        "8 to 24",
        BESSEL,
        1e-5,
    );
    bessel(row, 12, |r| {
        r.ratio == 0.3 && r.nu == 0.3 && (8..=24).contains(&r.n)
    })
}

pub fn many_diameters() -> Row {
    let row = Row::new(
        "nodal diameters, 24 radial functions",
        "8 to 64",
        BESSEL,
        1e-6,
    );
    bessel(row, 24, |r| r.ratio == 0.3 && r.nu == 0.3 && r.n >= 8)
}
