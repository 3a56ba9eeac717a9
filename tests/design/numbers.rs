//! Sets and frees numbers of a scene by their paths.

use sawflutter::model::scene::{Freed, Parameter, Scene};

pub fn with(scene: &Scene, numbers: &[(&str, f64)]) -> Scene {
    let named: Vec<(Parameter, f64)> = numbers
        .iter()
        .map(|(path, value)| (Parameter::new(path), *value))
        .collect();
    let numbers: Vec<(&Parameter, f64)> = named.iter().map(|(p, v)| (p, *v)).collect();
    scene.file().with(&numbers).unwrap()
}

pub fn freed(scene: &Scene, numbers: &[(&str, f64, f64)]) -> Vec<Freed> {
    let freed = numbers
        .iter()
        .map(|(path, from, to)| Freed::new(scene.file(), path, *from, *to).unwrap());
    freed.collect()
}
