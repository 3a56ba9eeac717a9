//! Sample of an undamped saw within a piece of a search, interpolated.

use faer::c64;

use crate::stability::group::Sloped;
use crate::stability::pieces::{Grouped, Piece};
use crate::stability::sample::Sample;

impl Piece {
    /// Sample at a speed of the piece, with one wave of unlimited frequency above all others, because those beyond the height of
    /// the search are not reflected. `None` if the piece was not settled, or if it does not show which of two waves has which sign.
    pub fn sample_at(&self, speed_rad_per_s: f64) -> Option<Sample> {
        let mut squares = vec![((c64::from(f64::NEG_INFINITY), c64::ZERO), 1)];
        for grouped in &self.groups {
            squares.extend(self.squares_at(grouped, speed_rad_per_s)?);
        }
        (!self.groups.is_empty()).then(|| Sample::of_squares(speed_rad_per_s, squares))
    }

    /// Squares of a group at a speed of the piece, with the Krein sign of each wave and zero for other numbers. `None` if the piece
    /// does not show which of two waves has which sign.
    pub fn squares_at(&self, grouped: &Grouped, speed_rad_per_s: f64) -> Option<Vec<(Sloped, i8)>> {
        let mut numbers = grouped.group.sloped_at(speed_rad_per_s);
        if grouped.sign.is_some() {
            // Waves of one sign cannot coalesce: where they cross, an imaginary part is an error of the interpolation.
            let real = numbers
                .iter_mut()
                .flat_map(|(square, slope)| [square, slope]);
            real.for_each(|number| number.im = 0.0);
        }
        numbers.sort_by(|x, y| x.0.re.total_cmp(&y.0.re));
        let is_wave = |square: c64| square.im == 0.0 && square.re < 0.0;
        let waves = numbers.iter().filter(|(square, _)| is_wave(*square));
        let mut signs = self.signs(grouped, waves.count())?.into_iter();
        let signed = numbers.into_iter().map(|number| {
            let sign = if is_wave(number.0) { signs.next()? } else { 0 };
            Some((number, sign))
        });
        signed.collect()
    }

    /// Krein signs of the `count` waves of a group somewhere in the piece, by ascending λ². `None` if the ends do not
    /// show them: two waves of opposite sign have crossed, or no end has as many waves.
    fn signs(&self, grouped: &Grouped, count: usize) -> Option<Vec<i8>> {
        if let Some(sign) = grouped.sign {
            return Some(vec![sign; count]);
        }
        let at = |end: usize| {
            let sample = &self.ends[end];
            let mut places = grouped.places[end].clone();
            places.retain(|&place| sample.signs[place] != 0);
            let square = |place: usize| sample.eigenvalues[place].0.re;
            places.sort_by(|&x, &y| square(x).total_cmp(&square(y)));
            places
                .into_iter()
                .map(|place| sample.signs[place])
                .collect::<Vec<i8>>()
        };
        let mut known = [at(0), at(1)]
            .into_iter()
            .filter(|signs| signs.len() == count);
        let first = known.next()?;
        known.all(|other| other == first).then_some(first)
    }
}
