//! A number of a scene that varies between two bounds.

use rayon::prelude::*;

use super::{Kind, Parameter, Quantity, RefusedValue, Scene, SceneError, SceneFile};
use crate::page::text::shown;

/// A number of a scene and its bounds. [`fit`](crate::analyses::fit) and [`place`](crate::analyses::place) work with its share, between 0 and
/// 1: the position between the bounds, on a linear or a logarithmic scale.
#[derive(Debug, Clone, PartialEq)]
pub struct Freed {
    /// The number that varies.
    pub parameter: Parameter,
    /// Lower bound.
    pub from: f64,
    /// Upper bound.
    pub to: f64,
}

/// Path of a number of a scene, with bounds if they are not the usual ones.
pub type NamedBounds = (String, Option<(f64, f64)>);

/// Path of a number of a scene, with values.
pub type NamedValues = (String, Vec<f64>);

/// Largest number of freed numbers; a search over more does not find their values reliably.
const MAX_FREED: usize = 12;
/// From this ratio of the bounds on, the scale is logarithmic.
const DECADE: f64 = 10.0;

/// Whether a search, the points of a map and an axis have a logarithmic scale from one number to another.
pub fn is_logarithmic(from: f64, to: f64) -> bool {
    from > 0.0 && to >= DECADE * from
}

impl Freed {
    /// Frees a number between two bounds, each of which must be a valid value.
    ///
    /// # Errors
    /// [`SceneError`] if the scene has no such number, a bound is refused, or the bounds are not in ascending
    /// order.
    pub fn new(scene: &SceneFile, path: &str, from: f64, to: f64) -> Result<Self, SceneError> {
        let parameter = Parameter::new(path);
        parameter.get(scene)?;
        if !(from.is_finite() && to.is_finite() && from < to) {
            let key = format!("the range of {path}");
            let allowed = "from a number to a larger one";
            let remedy = "write it like 0.15..0.3";
            return Err(RefusedValue::new(
                key,
                format!("{}..{}", shown(from), shown(to)),
                allowed,
                remedy,
            )
            .into());
        }
        for bound in [from, to] {
            scene.with(&[(&parameter, bound)])?;
        }
        Ok(Freed {
            parameter,
            from,
            to,
        })
    }

    /// Frees a number between usual bounds: the radius of a guide anywhere on the blade, a stiffness or damping
    /// within a factor of thirty, a gap within a factor of four, an angle within 60°, other numbers within 20 %,
    /// and no number outside of its allowed range.
    ///
    /// # Errors
    /// [`SceneError`] as for [`Freed::new`].
    pub fn with_usual_bounds(scene: &Scene, path: &str) -> Result<Self, SceneError> {
        let value = Parameter::new(path).get(&scene.file)?;
        let [from, to] = match Quantity::kind_of(path) {
            Kind::GuideRadius => [scene.blade.inner_radius_m, scene.blade.outer_radius_m],
            Kind::Stiffness | Kind::Damping => [value / 30.0, value * 30.0],
            Kind::Angle => [value - 60.0, value + 60.0],
            Kind::Gap => [0.25 * value, 4.0 * value],
            Kind::Radius | Kind::Count | Kind::Other => {
                [value - 0.2 * value.abs(), value + 0.2 * value.abs()]
            }
        }
        .map(|bound| Quantity::of(path).map_or(bound, |quantity| quantity.allowed.nearest(bound)));
        Freed::new(&scene.file, path, from, to)
    }

    /// The numbers that a fit adjusts. By default these are numbers that are rarely known: radius and stiffness of
    /// every guide, and the angles of all guides but the first; without guides, the density.
    ///
    /// # Errors
    /// [`SceneError`] as for [`Freed::new`], and if a number is named twice or too many are named.
    pub fn to_fit(scene: &Scene, asked: &[NamedBounds]) -> Result<Vec<Self>, SceneError> {
        let of_guide = |index: usize| {
            let angle = (index > 0).then_some("angle_deg");
            let names = ["radius_m", "stiffness_n_per_m"].into_iter().chain(angle);
            names.map(move |name| format!("guides[{index}].{name}"))
        };
        let usual: Vec<String> = match scene.file.guides.len() {
            0 => vec!["blade.material.density_kg_per_m3".into()],
            count => (0..count).flat_map(of_guide).collect(),
        };
        Freed::all(scene, asked, usual)
    }

    /// The numbers that a placement adjusts; by default radius, angle and stiffness of the first guide.
    ///
    /// # Errors
    /// [`SceneError`] as for [`Freed::new`], and if there is no guide and no number is named, a number is named
    /// twice, or too many are named.
    pub fn to_place(scene: &Scene, asked: &[NamedBounds]) -> Result<Vec<Self>, SceneError> {
        if scene.file.guides.is_empty() && asked.is_empty() {
            let allowed = "given, with a guide to be placed";
            return Err(RefusedValue::missing("guides", allowed, "add one to the scene").into());
        }
        let of_first = ["radius_m", "angle_deg", "stiffness_n_per_m"];
        let usual = of_first.map(|name| format!("guides[0].{name}"));
        Freed::all(scene, asked, usual.into())
    }

    fn all(
        scene: &Scene,
        asked: &[NamedBounds],
        usual: Vec<String>,
    ) -> Result<Vec<Self>, SceneError> {
        let usual: Vec<NamedBounds> = usual.into_iter().map(|path| (path, None)).collect();
        let asked = if asked.is_empty() { &usual } else { asked };
        if asked.len() > MAX_FREED {
            let allowed = format!("at most {MAX_FREED}");
            let remedy = "name the most important ones";
            let key = "the number of free paths";
            return Err(RefusedValue::new(key, asked.len(), allowed, remedy).into());
        }
        let mut freed: Vec<Freed> = Vec::new();
        for (path, bounds) in asked {
            let one = match bounds {
                Some((from, to)) => Freed::new(&scene.file, path, *from, *to)?,
                None => Freed::with_usual_bounds(scene, path)?,
            };
            if freed.iter().any(|other| other.parameter == one.parameter) {
                let given = format!("{path} again");
                return Err(RefusedValue::new("free", given, "named once", "name it once").into());
            }
            freed.push(one);
        }
        Ok(freed)
    }

    /// Whether the scale is logarithmic.
    pub fn is_logarithmic(&self) -> bool {
        is_logarithmic(self.from, self.to)
    }

    /// The value at a share.
    pub fn value(&self, share: f64) -> f64 {
        if self.is_logarithmic() {
            return self.from * (self.to / self.from).powf(share);
        }
        self.from + share * (self.to - self.from)
    }

    /// Values that are evenly spaced between the bounds, in the digits of a message, so that 0.66 is not 0.6599999999999999. The
    /// bounds are exact.
    pub(crate) fn values(&self, count: usize) -> Vec<f64> {
        let between = |k: usize| {
            let value = self.value(k as f64 / (count - 1) as f64);
            shown(value).parse().unwrap_or(value)
        };
        let value = |k: usize| match k {
            0 => self.from,
            _ if k + 1 == count => self.to,
            _ => between(k),
        };
        (0..count).map(value).collect()
    }

    /// The share of a value.
    pub fn share(&self, value: f64) -> f64 {
        if self.is_logarithmic() {
            let value = value.max(f64::MIN_POSITIVE);
            return (value / self.from).ln() / (self.to / self.from).ln();
        }
        (value - self.from) / (self.to - self.from)
    }

    /// The share of the value in a scene, limited to 0…1.
    pub fn share_of(&self, scene: &SceneFile) -> f64 {
        let value = self.parameter.get(scene).unwrap_or(self.from);
        self.share(value).clamp(0.0, 1.0)
    }
}

/// The scene in which the freed numbers have the given shares.
///
/// # Errors
/// [`SceneError`] if these values are refused together.
pub fn scene_at(scene: &SceneFile, freed: &[Freed], shares: &[f64]) -> Result<Scene, SceneError> {
    let numbers: Vec<(&Parameter, f64)> = freed
        .iter()
        .zip(shares)
        .map(|(freed, share)| (&freed.parameter, freed.value(*share)))
        .collect();
    scene.with(&numbers)
}

/// Index of the freed angle that a search keeps constant; `None` unless the angles of all guides are free. A common
/// rotation of all guides changes no frequency of the idling saw, in which nothing else is fixed in space.
pub fn common_turn(scene: &Scene, freed: &[Freed]) -> Option<usize> {
    let pads = scene.file.guides.iter().enumerate();
    let acting = pads.filter(|(_, pad)| pad.acts());
    let places = acting.map(|(index, _)| {
        let path = format!("guides[{index}].angle_deg");
        freed.iter().position(|f| f.parameter.path() == path)
    });
    let angles: Option<Vec<usize>> = places.collect();
    angles.and_then(|angles| angles.first().copied())
}

/// Freed numbers by their effect.
pub struct Parted {
    /// Numbers that change the answer.
    pub moving: Vec<Freed>,
    /// Numbers that do not.
    pub idle: Vec<Freed>,
}

/// Divides the freed numbers into those that change an answer and those that do not, such as the angle of a
/// single pad. Each number alone takes every one of `shares`, while the other numbers are those of the scene or
/// those of one other point, because its effect may depend on them. `answer` returns `None` for a saw without an
/// answer.
///
/// # Errors
/// The errors of `answer`.
pub fn effective<A, E: Send>(
    scene: &Scene,
    freed: &[Freed],
    shares: &[f64],
    answer: impl Fn(&[f64]) -> Result<Option<A>, E> + Sync,
    differ: impl Fn(&A, &A) -> bool + Sync,
) -> Result<Parted, E> {
    let own: Vec<f64> = freed.iter().map(|f| f.share_of(&scene.file)).collect();
    let constant = common_turn(scene, freed);
    let moves = |k: usize| -> Result<bool, E> {
        if constant == Some(k) {
            return Ok(false);
        }
        for base in [own.clone(), spread(freed.len(), 0, 0)] {
            let mut first = None;
            for share in shares {
                let mut moved = base.clone();
                moved[k] = *share;
                match (answer(&moved)?, &first) {
                    (Some(answer), None) => first = Some(answer),
                    (Some(answer), Some(first)) if differ(first, &answer) => return Ok(true),
                    _ => (),
                }
            }
        }
        Ok(false)
    };
    let has_effect = (0..freed.len())
        .into_par_iter()
        .map(moves)
        .collect::<Result<Vec<bool>, E>>()?;
    let with = |effect: bool| {
        let pairs = freed.iter().zip(&has_effect);
        let own = pairs.filter(|(_, has_effect)| **has_effect == effect);
        own.map(|(freed, _)| freed.clone()).collect()
    };
    Ok(Parted {
        moving: with(true),
        idle: with(false),
    })
}

/// Point `index` of a sequence that fills the unit cube evenly in any number d of dimensions: multiples of the
/// powers of 1/φ_d, where φ_d is the root of φ^(d+1) = φ + 1 (M. Roberts, *The unreasonable effectiveness of
/// quasirandom sequences*, 2018). The seed determines the offset.
pub fn spread(dimensions: usize, seed: u64, index: usize) -> Vec<f64> {
    let mut phi = 2.0_f64;
    for _ in 0..40 {
        phi = (1.0 + phi).powf(1.0 / (dimensions as f64 + 1.0));
    }
    let offset = 0.5 + (seed % 1_000_003) as f64 * 0.754_877_666_246_692_7;
    (1..=dimensions)
        .map(|k| (offset + (index + 1) as f64 * phi.powi(-(k as i32))).fract())
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_and_values_are_inverse() {
        let scene = Scene::paper();
        for (path, from, to, logarithmic) in [
            ("guides[0].radius_m", 0.15, 0.3, false),
            ("guides[0].stiffness_n_per_m", 1e5, 1e9, true),
            ("guides[0].angle_deg", -90.0, 90.0, false),
        ] {
            let freed = Freed::new(&scene.file, path, from, to).unwrap();
            assert_eq!(freed.is_logarithmic(), logarithmic);
            for share in [0.0, 0.3, 1.0] {
                assert!((freed.share(freed.value(share)) - share).abs() < 1e-12);
            }
        }
        let stiffness = "guides[0].stiffness_n_per_m";
        let freed = Freed::with_usual_bounds(&scene, stiffness).unwrap();
        assert!((freed.share_of(&scene.file) - 0.5).abs() < 1e-12);
    }

    #[test]
    fn bounds_that_no_saw_has_are_refused() {
        let scene = Scene::paper().file().clone();
        for (path, from, to, expected) in [
            ("guides[0].radius_m", 0.3, 0.2, "the range of"),
            ("guides[0].radius_m", 0.2, 3.0, "guides[0].radius_m"),
            (
                "guides[0].stiffness_n_per_m",
                -1.0,
                3.0,
                "stiffness_n_per_m",
            ),
            ("guides[7].radius_m", 0.2, 0.3, "guides[7]"),
        ] {
            let error = Freed::new(&scene, path, from, to).unwrap_err().to_string();
            assert!(error.contains(expected), "{error}");
        }
    }

    /// A fifth above 0.9 and 0.45 are not allowed.
    #[test]
    fn usual_bounds_are_allowed() {
        let scene = Scene::paper()
            .edited(|file| {
                file.blade.material.poisson_ratio = 0.45;
                file.damping.get_or_insert_default().loss_factor = 0.9;
            })
            .unwrap();
        let bound = |path| Freed::with_usual_bounds(&scene, path).unwrap().to;
        assert_eq!(bound("damping.loss_factor"), 1.0);
        let poisson = bound("blade.material.poisson_ratio");
        assert!(poisson > 0.499 && poisson < 0.5, "{poisson}");
    }

    #[test]
    fn one_angle_is_constant_if_all_pads_may_turn() {
        let turn = |scene: &Scene, guides: &[usize]| {
            let freed: Vec<Freed> = guides
                .iter()
                .map(|i| {
                    Freed::with_usual_bounds(scene, &format!("guides[{i}].angle_deg")).unwrap()
                })
                .collect();
            common_turn(scene, &freed)
        };
        let one = Scene::paper();
        let mut file = one.file.clone();
        file.guides.push(file.guides[0].clone());
        let two = Scene::try_from(file).unwrap();
        assert_eq!(turn(&one, &[0]), Some(0));
        assert_eq!(turn(&two, &[1]), None);
        assert_eq!(turn(&two, &[1, 0]), Some(1));
    }

    /// No two of a hundred points are close to each other, and every tenth of every axis has a point.
    #[test]
    fn the_sequence_fills_the_cube() {
        for seed in [0, 1, 12345] {
            let points: Vec<Vec<f64>> = (0..100).map(|i| spread(2, seed, i)).collect();
            for (i, p) in points.iter().enumerate() {
                assert!(p.iter().all(|x| (0.0..1.0).contains(x)));
                for q in &points[..i] {
                    assert!((p[0] - q[0]).hypot(p[1] - q[1]) > 0.03);
                }
            }
            for axis in 0..2 {
                for tenth in 0..10 {
                    let hit = |p: &Vec<f64>| (10.0 * p[axis]) as usize == tenth;
                    assert!(points.iter().any(hit));
                }
            }
        }
    }
}
