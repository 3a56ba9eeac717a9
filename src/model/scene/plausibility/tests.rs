use super::*;
use crate::model::scene::{CutSpeedFile, Scene};

fn remarks(change: impl FnOnce(&mut SceneFile)) -> Vec<String> {
    let mut file = Scene::paper().file().clone();
    change(&mut file);
    file.unusual_numbers()
}

#[test]
fn numbers_in_other_units_are_recognized() {
    assert_eq!(remarks(|_| ()), [""; 0]);
    let density = remarks(|file| file.blade.material.density_kg_per_m3 = 7.85);
    assert_eq!(
        density,
        [
            "blade.material.density_kg_per_m3 is 7.85 kg/m³ (usual range 2000 to 20000 kg/m³); \
             are these g/cm³? That would be 7850 kg/m³"
        ]
    );
    let stiffness = remarks(|file| file.guides[0].stiffness_n_per_m = 2e4);
    assert!(
        stiffness[0].contains("N/mm? That would be 2e7 N/m"),
        "{stiffness:?}"
    );
}

/// For a blade of 0.71 m, 60 m/s at the rim are 1614 rpm.
#[test]
fn speeds_in_other_units_are_recognized_by_the_speed_of_the_rim() {
    let file = Scene::paper().file().clone();
    for (value, said) in [
        (1.25, "thousands of rpm? That would be 1250 rpm"),
        (3.0, "thousands of rpm? That would be 3000 rpm"),
        (20.8, "turns per second (Hz)? That would be 1248 rpm"),
        (50.0, "turns per second (Hz)? That would be 3000 rpm"),
    ] {
        let remark = unusual_number(&file, "--rpm", "operating_rpm", value).unwrap_or_default();
        assert!(remark.contains(said), "{value}: {remark}");
        assert!(remark.contains("run at 54 to 8070 rpm"), "{remark}");
        let ends = remarks(|file| file.sweep.as_mut().unwrap().to_rpm = value);
        assert!(ends[0].contains(said), "{ends:?}");
        let cut = remarks(|file| {
            let speed = CutSpeedFile {
                rpm: value,
                ..file.cut.as_ref().unwrap().speeds[1]
            };
            file.cut.as_mut().unwrap().speeds[1] = speed;
        });
        assert!(cut[0].contains(said), "{cut:?}");
    }
    for value in [60.0, 1250.0, 7000.0] {
        assert_eq!(unusual_number(&file, "it", "operating_rpm", value), None);
    }
    let fast = unusual_number(&file, "it", "operating_rpm", 20_000.0).unwrap();
    assert!(fast.contains("is it in the unit"), "{fast}");
}

#[test]
fn measured_speeds_in_thousands_get_one_remark() {
    let found = remarks(|file| {
        let rows = &mut file.measured.as_mut().unwrap().rows;
        rows.iter_mut().for_each(|row| row.rpm *= 1e-3);
    });
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(found[0].contains("thousands of rpm?"), "{found:?}");
}

#[test]
#[allow(clippy::approx_constant, reason = "as it is typed")]
fn angles_in_radians_are_recognized() {
    let one = |angle: f64| remarks(|file| file.guides[0].angle_deg = angle);
    for radians in [1.5708, -0.96, 1.047, -PI, 0.785] {
        let found = one(radians);
        assert_eq!(found.len(), 1, "{radians}");
        assert!(found[0].contains("radians?"), "{found:?}");
    }
    for degrees in [0.0, 1.0, -2.5, 5.25, 90.0, -55.3, 3.4] {
        assert_eq!(one(degrees), [""; 0], "{degrees}");
    }
    let several = |angles: &[f64]| {
        remarks(|file| {
            let pad = file.guides[0].clone();
            file.guides = vec![pad; angles.len()];
            for (pad, angle) in file.guides.iter_mut().zip(angles) {
                pad.angle_deg = *angle;
            }
        })
    };
    assert_eq!(several(&[-2.13, 0.41, 1.92]).len(), 1);
    assert_eq!(several(&[-2.13, 41.3, 1.92]).len(), 0);
    assert_eq!(several(&[-1.2, 1.2]).len(), 0);
}

#[test]
fn a_scene_wholly_in_millimetres_gets_one_remark() {
    let remarks = remarks(|file| {
        file.blade.outer_diameter_m *= 1e3;
        file.blade.inner_diameter_m *= 1e3;
        file.blade.thickness_m *= 1e3;
        file.guides[0].radius_m *= 1e3;
    });
    assert_eq!(remarks.len(), 1, "{remarks:?}");
    for part in [
        "look like mm",
        "outer_diameter_m is 710 (that would be 0.71 m; usual range 0.04 to 5 m)",
        "thickness_m is 2.8 (that would be 0.0028 m",
    ] {
        assert!(remarks[0].contains(part), "no {part:?} in {remarks:?}");
    }
}

#[test]
fn the_scenes_of_the_repository_have_no_unusual_number() {
    let scenes = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let mut seen = 0;
    for folder in [scenes.clone(), scenes.join("gallery")] {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path
                .extension()
                .is_some_and(|extension| extension == "json")
            {
                let scene = Scene::from_json(&std::fs::read_to_string(&path).unwrap()).unwrap();
                let found = scene.file().unusual_numbers();
                assert_eq!(found, [""; 0], "{}", path.display());
                seen += 1;
            }
        }
    }
    assert!(seen > 20);
}
