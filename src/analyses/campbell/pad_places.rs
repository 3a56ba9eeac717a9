//! Remarks on pads that lie partly beside the blade, or on one another.

use crate::model::scene::{Guide, GuideFile, GuideSide, Scene};
use crate::page::text::shown_to;

/// Share of a length that is rounding.
const ROUNDING: f64 = 1e-9;

/// Names the pads that lie partly beside the blade, and the length along the radius of which each lies on it.
pub(super) fn beside_the_blade(scene: &Scene) -> Option<String> {
    let blade = scene.blade();
    let of_pad = |guide: &Guide| {
        let pad = &guide.typed;
        let length = pad.radial_length_m;
        let [from, to] = [-0.5, 0.5].map(|share| pad.radius_m + share * length);
        let on_blade = to.min(blade.outer_radius_m) - from.max(blade.inner_radius_m);
        (on_blade < (1.0 - ROUNDING) * length).then(|| {
            let [on_blade, length] = [on_blade, length].map(|metres| shown_to(3, 1e3 * metres));
            format!(
                "{on_blade} of {length} mm of guides[{}] lie on the blade",
                guide.index
            )
        })
    };
    let each: Vec<String> = scene.guides().iter().filter_map(of_pad).collect();
    let [inner, outer] =
        [blade.inner_radius_m, blade.outer_radius_m].map(|metres| shown_to(4, 1e3 * metres));
    (!each.is_empty()).then(|| {
        format!(
            "{}, which moves between the radii {inner} and {outer} mm: springs and dampers of the rest hold nothing",
            each.join("; ")
        )
    })
}

/// Names the pairs of pads that lie partly on one another.
pub(super) fn overlapping(scene: &Scene) -> Option<String> {
    let guides = scene.guides();
    let pairs = guides.iter().enumerate().flat_map(|(k, one)| {
        let before = guides[..k].iter();
        let same = before.filter(|other| overlap(&other.typed, &one.typed));
        same.map(|other| format!("guides[{}] and guides[{}]", other.index, one.index))
    });
    let pairs: Vec<String> = pairs.collect();
    (!pairs.is_empty()).then(|| {
        format!(
            "{} overlap: where both lie, the springs of both hold the blade",
            pairs.join("; ")
        )
    })
}

/// Whether two pads have an area in common on one face of the blade. Convex outlines have none if a side of one of them
/// separates them.
fn overlap(one: &GuideFile, other: &GuideFile) -> bool {
    let faces = [one.side, other.side];
    let are_opposite = faces.contains(&GuideSide::Left) && faces.contains(&GuideSide::Right);
    if are_opposite || one.is_point() || other.is_point() {
        return false;
    }
    let outlines = [one.outline_m(), other.outline_m()];
    let is_apart = |[x, y]: [f64; 2]| {
        let extents = outlines.each_ref().map(|outline| {
            let along = outline.iter().map(|corner| x * corner[0] + y * corner[1]);
            along.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], at| {
                [low.min(at), high.max(at)]
            })
        });
        let common = extents[0][1].min(extents[1][1]) - extents[0][0].max(extents[1][0]);
        common <= ROUNDING * (extents[0][1] - extents[0][0])
    };
    let mut sides = outlines.iter().flat_map(|outline| {
        let next = outline.iter().cycle().skip(1);
        outline
            .iter()
            .zip(next)
            .map(|(from, to)| [to[1] - from[1], from[0] - to[0]])
    });
    !sides.any(is_apart)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pad(radius_m: f64, angle_deg: f64) -> GuideFile {
        GuideFile {
            radius_m,
            angle_deg,
            radial_length_m: 0.06,
            tangential_length_m: 0.05,
            stiffness_n_per_m: 1e7,
            ..GuideFile::default()
        }
    }

    /// The ring of the blade between a collar of 120 mm and the rim of 550 mm.
    fn saw(guides: Vec<GuideFile>) -> Scene {
        let saw = Scene::paper().edited(|saw| {
            saw.spline = None;
            (saw.blade.outer_diameter_m, saw.blade.inner_diameter_m) = (0.55, 0.12);
            (saw.blade.rim, saw.cut, saw.runup, saw.probe) = (None, None, None, None);
            saw.blade.profile.clear();
            saw.guides = guides;
        });
        saw.unwrap()
    }

    /// Of the radii from 270 to 330 mm the blade has those to 275 mm, of 20 to 80 mm those from 60 mm on.
    #[test]
    fn a_pad_over_the_rim_or_the_collar_is_named_with_its_length_on_the_blade() {
        let remark = |pad: GuideFile| beside_the_blade(&saw(vec![pad]));
        let over = remark(pad(0.3, -40.0)).unwrap();
        assert!(
            over.starts_with("5 of 60 mm of guides[0] lie on the blade"),
            "{over}"
        );
        let under = remark(pad(0.05, -40.0)).unwrap();
        assert!(
            under.starts_with("20 of 60 mm of guides[0] lie on the blade"),
            "{under}"
        );
        assert_eq!(remark(pad(0.245, -40.0)), None);
        let point = GuideFile {
            radial_length_m: 0.0,
            tangential_length_m: 0.0,
            ..pad(0.275, 0.0)
        };
        assert_eq!(remark(point), None);
    }

    /// At 220 mm, pads of 50 mm whose inner corners are at 190 mm touch at 2 atan(25/190) = 14.99 degrees.
    #[test]
    fn pads_that_have_an_area_in_common_are_named() {
        let remark = |angle: f64| overlapping(&saw(vec![pad(0.22, -40.0), pad(0.22, angle)]));
        let named = remark(-38.0).unwrap();
        assert!(
            named.starts_with("guides[0] and guides[1] overlap"),
            "{named}"
        );
        assert!(remark(-40.0 + 14.9).is_some());
        assert_eq!(remark(-40.0 + 15.1), None);
        let on_face = |side: GuideSide, angle: f64| GuideFile {
            side,
            ..pad(0.22, angle)
        };
        let [left, right] = [
            on_face(GuideSide::Left, 0.0),
            on_face(GuideSide::Right, 5.0),
        ];
        assert!(!overlap(&left, &right) && overlap(&left, &pad(0.22, 5.0)));
    }
}
