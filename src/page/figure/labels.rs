//! Labels of a panel: at vertical lines, at the ends of curves, on curves, and beside points.

use super::canvas::{Anchor, Frame, Lettering, Sheet, Stroke, text_frame};
use super::chart_data::PanelData;
use super::items::{Item, Label, Line, Upright};
use super::label_placement::{Extent, push_apart};
use super::painting::Ground;
use super::style::{Colour, HAIRLINE, LABEL_SIZE, PAPER, QUIET, label_width, shorten_label, tint};

/// Space between the labels of vertical lines.
const APART: f64 = 8.0;
/// Height of a label at the end of a curve.
const LINE: f64 = 16.0;
/// Length of the leader from the end of a curve to its label, and space at its ends.
const LEADER: f64 = 14.0;
const GAP: f64 = 4.0;
/// Largest width of a label at the end of a curve.
const LONGEST: f64 = 220.0;
/// Distances of a label from its point: across, and from the baseline of the letters.
const ASIDE: f64 = 11.0;
const BELOW: f64 = 4.0;
const OVER: f64 = -11.0;
const UNDER: f64 = 21.0;
const FAR_OVER: f64 = -28.0;
const FAR_UNDER: f64 = 38.0;
/// Number of marks up to which labels keep off them, and half the size of a mark.
const FEW: usize = 60;
const MARK: f64 = 4.0;
/// Space around labels on a curve and beside points.
const AROUND: f64 = 3.0;

/// The curves of a panel with a label at the end.
fn ended(panel: &PanelData) -> impl Iterator<Item = &Line> {
    panel.items.iter().filter_map(|item| match item {
        Item::Line(line) if !line.end.is_empty() => Some(line),
        _ => None,
    })
}

/// Space to the right of a panel for the labels at the ends of its curves.
pub fn end_room(panel: &PanelData) -> f64 {
    let widths = ended(panel).map(|line| label_width(&line.end).min(LONGEST));
    let widest = widths.fold(0.0, f64::max);
    if widest > 0.0 {
        widest + LEADER + 2.0 * GAP
    } else {
        0.0
    }
}

/// A place where a label may be written: a point of its baseline, and which part of the text is there.
struct Place {
    at: [f64; 2],
    anchor: Anchor,
}

/// The labels of a panel, which keep apart from each other.
pub struct Labels<'a> {
    sheet: &'a mut Sheet,
    ground: &'a Ground<'a>,
    taken: Vec<Frame>,
    /// Frames of marks and lines, off which labels keep where they can.
    shunned: Vec<Frame>,
}

impl<'a> Labels<'a> {
    /// Begins the labels of a panel.
    pub fn new(sheet: &'a mut Sheet, ground: &'a Ground<'a>) -> Self {
        Labels {
            sheet,
            ground,
            taken: Vec::new(),
            shunned: Vec::new(),
        }
    }

    /// Draws all labels; returns whether some are above the panel.
    pub fn draw(mut self, panel: &PanelData) -> bool {
        let has_labels = self.draw_uprights(panel);
        self.draw_ends(panel);
        self.avoid_names(panel);
        self.avoid_marks(panel);
        for item in &panel.items {
            match item {
                Item::Label(label) => self.draw_beside(label),
                Item::Line(line) if !line.label.is_empty() => self.draw_on(line),
                _ => {}
            }
        }
        has_labels
    }

    /// Draws the labels of the vertical lines above the panel.
    fn draw_uprights(&mut self, panel: &PanelData) -> bool {
        let (x, frame) = (self.ground.x, self.ground.frame);
        let labelled: Vec<&Upright> = panel
            .uprights()
            .filter(|line| !line.label.is_empty() && x.shows(line.x))
            .collect();
        let extents = labelled
            .iter()
            .map(|line| Extent::of_label(x.at(line.x), &line.label, APART));
        for (line, place) in labelled.iter().zip(push_apart(extents, frame.across())) {
            if let Some(place) = place {
                let colour = line.colour.colour();
                let letters = Lettering::regular(LABEL_SIZE, colour, Anchor::Middle);
                let leader = [[x.at(line.x), frame.top], [place, frame.top - 12.0]];
                self.sheet.line(leader, Stroke::solid(colour, HAIRLINE));
                self.sheet
                    .text([place, frame.top - 17.0], letters, &line.label);
            }
        }
        panel.uprights().any(|line| !line.label.is_empty())
    }

    /// Draws the labels at the right ends of curves, to the right of the panel.
    fn draw_ends(&mut self, panel: &PanelData) {
        let frame = self.ground.frame;
        let ends: Vec<(&Line, [f64; 2])> = ended(panel)
            .filter_map(|line| {
                let parts = self.ground.parts(line);
                let points = parts.iter().flatten().copied();
                let end = points.max_by(|a, b| a[0].total_cmp(&b[0]))?;
                Some((line, end))
            })
            .collect();
        let extents = ends.iter().map(|(_, [_, y])| Extent {
            centre: *y,
            length: LINE,
        });
        for ((line, end), place) in ends
            .iter()
            .zip(push_apart(extents, [frame.top, frame.bottom]))
        {
            let Some(y) = place else { continue };
            let elbow = [frame.right + LEADER, y];
            self.sheet
                .line([*end, elbow], Stroke::solid(QUIET, 0.6 * HAIRLINE));
            let colour = tint(line.colour.colour(), line.tint.max(0.8));
            let letters = Lettering::regular(LABEL_SIZE, colour, Anchor::Start);
            let label = shorten_label(&line.end, LONGEST);
            let at = [elbow[0] + GAP, y + 0.36 * LABEL_SIZE];
            self.sheet.text(at, letters, &label);
        }
    }

    /// Labels keep off the names of rows.
    fn avoid_names(&mut self, panel: &PanelData) {
        for (value, name) in panel.y.ticks.iter().zip(&panel.y.names) {
            let letters = Lettering::title(LABEL_SIZE, QUIET);
            let at = [self.ground.frame.left, self.ground.y.at(*value) - 10.0];
            self.taken.push(text_frame(at, &letters, name));
        }
    }

    /// Labels keep off vertical lines, and off the marks if there are few.
    fn avoid_marks(&mut self, panel: &PanelData) {
        let lines = panel
            .uprights()
            .map(|line| self.ground.x.at(line.x))
            .map(|x| self.ground.frame.between([x - 1.0, x + 1.0]));
        self.shunned.extend(lines);
        let place = |(x, y): (&f64, &f64)| [self.ground.x.at(*x), self.ground.y.at(*y)];
        for item in &panel.items {
            match item {
                Item::Points(points) if points.x.len() <= FEW => {
                    let marks = points.x.iter().zip(&points.y).map(place);
                    self.shunned.extend(marks.map(|at| Frame::around(at, MARK)));
                }
                Item::Line(line) if line.x.len() <= FEW && line.label.is_empty() => {
                    let places: Vec<_> = line.x.iter().zip(&line.y).map(place).collect();
                    let steps = places.windows(2).flat_map(filled);
                    self.shunned.extend(steps.map(|at| Frame::around(at, 1.0)));
                }
                _ => {}
            }
        }
    }

    /// Writes a label at the first of some places that is inside the panel and free, and off marks and lines if there is
    /// such a place.
    fn write(&mut self, text: &str, colour: Colour, places: impl Iterator<Item = Place>) {
        let framed = places.map(|place| {
            let letters = Lettering::regular(LABEL_SIZE, colour, place.anchor);
            let frame = text_frame(place.at, &letters, text).widened(AROUND);
            (place.at, letters, frame)
        });
        let inside = self.ground.frame;
        let free: Vec<([f64; 2], Lettering, Frame)> = framed
            .filter(|(_, _, frame)| {
                let is_inside = inside.left <= frame.left
                    && frame.right <= inside.right
                    && inside.top <= frame.top
                    && frame.bottom <= inside.bottom;
                is_inside && !self.taken.iter().any(|other| other.overlaps(frame))
            })
            .collect();
        let is_clear = |(_, _, frame): &&([f64; 2], Lettering, Frame)| {
            !self.shunned.iter().any(|other| other.overlaps(frame))
        };
        if let Some(&(at, letters, frame)) = free.iter().find(is_clear).or(free.first()) {
            self.sheet.fill(frame, PAPER);
            self.sheet.text(at, letters, text);
            self.taken.push(frame);
        }
    }

    /// Writes a label beside its point.
    fn draw_beside(&mut self, label: &Label) {
        let [x, y] = [self.ground.x.at(label.x), self.ground.y.at(label.y)];
        let sides = [
            (0.0, OVER, Anchor::Middle),
            (ASIDE, BELOW, Anchor::Start),
            (-ASIDE, BELOW, Anchor::End),
            (-ASIDE, OVER, Anchor::End),
            (ASIDE, OVER, Anchor::Start),
            (0.0, UNDER, Anchor::Middle),
            (ASIDE, UNDER, Anchor::Start),
            (-ASIDE, UNDER, Anchor::End),
            (0.0, FAR_OVER, Anchor::Middle),
            (0.0, FAR_UNDER, Anchor::Middle),
            (ASIDE, FAR_OVER, Anchor::Start),
            (-ASIDE, FAR_UNDER, Anchor::End),
        ];
        let places = sides.map(|(aside, below, anchor)| Place {
            at: [x + aside, y + below],
            anchor,
        });
        self.write(&label.text, label.colour.colour(), places.into_iter());
    }

    /// Writes a label on a curve, as close to its middle as there is room.
    fn draw_on(&mut self, line: &Line) {
        let points = line.x.iter().zip(&line.y);
        let drawn = points.map(|(x, y)| [self.ground.x.at(*x), self.ground.y.at(*y)]);
        let places = filled(&drawn.collect::<Vec<_>>());
        let middle = places.len() / 2;
        let tried = (0..=middle)
            .flat_map(|off| [middle + off, middle - off])
            .filter_map(|k| places.get(k))
            .map(|[x, y]| Place {
                at: [*x, y + 0.36 * LABEL_SIZE],
                anchor: Anchor::Middle,
            });
        self.write(&line.label, line.colour.colour(), tried);
    }
}

/// The points of a curve, with further ones on a straight line between two.
fn filled(places: &[[f64; 2]]) -> Vec<[f64; 2]> {
    const STEPS: u32 = 20;
    let &[from, to] = places else {
        return places.to_vec();
    };
    let between = |k: u32| {
        let share = f64::from(k) / f64::from(STEPS);
        [0, 1].map(|axis| from[axis] + share * (to[axis] - from[axis]))
    };
    (0..=STEPS).map(between).collect()
}
