//! Saws of the gallery, which the page offers as examples.

use crate::model::scene::{Scene, SceneFile};

const SCENES: &[&str] = &[
    include_str!("../../../scenes/paper.json"),
    include_str!("../../../scenes/two-pads.json"),
    include_str!("../../../scenes/collar-400mm.json"),
    include_str!("../../../scenes/collar-400mm-tensioned.json"),
    include_str!("../../../scenes/free-blade.json"),
    include_str!("../../../scenes/paper-spline.json"),
    include_str!("../../../scenes/gallery/carbide-slitting-saw.json"),
    include_str!("../../../scenes/gallery/controlled-pad.json"),
    include_str!("../../../scenes/gallery/damped-material.json"),
    include_str!("../../../scenes/gallery/damped-pad.json"),
    include_str!("../../../scenes/gallery/dental-disk.json"),
    include_str!("../../../scenes/gallery/excitation-lines.json"),
    include_str!("../../../scenes/gallery/hammered.json"),
    include_str!("../../../scenes/gallery/heated-rim.json"),
    include_str!("../../../scenes/gallery/in-cut-wood.json"),
    include_str!("../../../scenes/gallery/in-cut.json"),
    include_str!("../../../scenes/gallery/lagging-film.json"),
    include_str!("../../../scenes/gallery/loose-collar.json"),
    include_str!("../../../scenes/gallery/opposed-pads.json"),
    include_str!("../../../scenes/gallery/pad-on-arm.json"),
    include_str!("../../../scenes/gallery/point-roller.json"),
    include_str!("../../../scenes/gallery/ring.json"),
    include_str!("../../../scenes/gallery/six-pads.json"),
    include_str!("../../../scenes/gallery/stepped-rim.json"),
    include_str!("../../../scenes/gallery/stone-saw.json"),
    include_str!("../../../scenes/gallery/tapered.json"),
    include_str!("../../../scenes/gallery/thin-kerf.json"),
    include_str!("../../../scenes/gallery/turning-air.json"),
    include_str!("../../../scenes/gallery/washboarding.json"),
    include_str!("../../../scenes/gallery/water-film.json"),
    include_str!("../../../scenes/gallery/weak-pad.json"),
];

/// Returns all examples in the order of the menu.
pub fn examples() -> Vec<SceneFile> {
    let scenes = SCENES.iter().filter_map(|text| Scene::from_json(text).ok());
    scenes.map(|scene| scene.file().clone()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every saw of the gallery is offered and can be read.
    #[test]
    fn the_whole_gallery_is_offered() {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes");
        let count = |folder: &str| {
            let files = std::fs::read_dir(folder).unwrap().map(|file| file.unwrap());
            let scenes = files.filter(|file| file.path().extension().is_some_and(|e| e == "json"));
            scenes.count()
        };
        let there = count(folder) + count(&format!("{folder}/gallery"));
        assert_eq!(SCENES.len(), there);
        assert_eq!(examples().len(), there);
    }
}
