//! The saws with extreme numbers, and the numbers that are compared.

use sawflutter::model::plate::{Plate, Resolution};
use sawflutter::model::scene::{Scene, SceneFile, SpeedRange};
use sawflutter::modes::{SpectralModel, Strategy};
use sawflutter::stability::undamped_bands;

pub const SMALL: Resolution = Resolution {
    max_diameters: 6,
    radial_functions: 5,
};

pub fn scene(file: &SceneFile) -> Scene {
    Scene::try_from(file.clone()).unwrap_or_else(|error| panic!("{error}"))
}

pub fn paper() -> SceneFile {
    let mut file = Scene::paper().file().clone();
    file.sweep = None;
    file.measured = None;
    file.operating_rpm = None;
    // Removes the blocks of the paper's own blade.
    (file.spline, file.cut, file.runup, file.probe) = (None, None, None, None);
    file
}

pub fn unguided() -> SceneFile {
    let mut file = paper();
    file.guides.clear();
    file
}

pub fn critical(file: &SceneFile, resolution: Resolution) -> Vec<f64> {
    SpectralModel::critical_speeds(&Plate::new(&scene(file), resolution))
        .unwrap()
        .iter()
        .map(|c| c.speed_rad_per_s)
        .collect()
}

/// Edges and growth of every band up to 1.6 times the first critical speed, then the critical speeds: all results that
/// have the unit of a frequency.
pub fn signature(file: &SceneFile) -> Vec<f64> {
    let plate = Plate::new(&scene(file), SMALL);
    let first = SpectralModel::critical_speeds(&plate).unwrap()[0].speed_rad_per_s;
    let range = SpeedRange::new(0.0, 1.6 * first);
    let model = SpectralModel::new(plate, range, Strategy::Reduced).unwrap();
    let found = undamped_bands(&model, range, 21).unwrap();
    let (bands, certificate) = (found.instabilities, found.certificate);
    assert_eq!(certificate.violations_rad_per_s, Vec::<f64>::new());
    assert!(bands.len() >= 3, "{bands:?}");
    let edges = bands
        .iter()
        .flat_map(|b| [b.from_rad_per_s, b.to_rad_per_s, b.peak_growth_per_s]);
    let critical = model.critical.iter().take(6).map(|c| c.speed_rad_per_s);
    edges.chain(critical).collect()
}

pub fn scaled(values: &[f64], factor: f64) -> Vec<f64> {
    values.iter().map(|v| v * factor).collect()
}
