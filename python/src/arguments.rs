//! Arguments of methods, checked by the library: the messages name them as Python does.

use sawflutter::place::{Demands, Goal};
use sawflutter::scene::Scene;

use crate::failure::Failure;

/// The scene of a JSON text.
pub fn scene(text: &str) -> Result<Scene, Failure> {
    Ok(Scene::from_json(text)?)
}

/// The target of a search for a place.
pub fn demands(
    scene: &Scene,
    goal: &str,
    min_critical_rpm: Option<f64>,
) -> Result<Demands, Failure> {
    let goal = match goal {
        "flutter" => Goal::FlutterSpeed,
        "window" => Goal::window_of(scene)?,
        _ => {
            let (value, allowed) = (format!("{goal:?}"), "\"flutter\" or \"window\"".to_owned());
            return Err(Failure::argument(
                "goal",
                value,
                allowed,
                "name one of them",
            ));
        }
    };
    Ok(Demands::new(goal, min_critical_rpm)?)
}
