//! A value of a scene as given on a command line: `blade.thickness_m=2.6mm`, `guides[0].contact=one_sided`.

use std::str::FromStr;

use serde_json::{Map, Number, Value};

use super::quantities::{QUANTITIES, general};
use super::quantity::Quantity;
use super::schema::{json_schema, keys};
use super::unit::Unit;
use super::{RefusedValue, Scene, SceneError, SceneFile};

/// A value for the key of a scene at a path.
#[derive(Debug, Clone, PartialEq)]
pub struct Setting {
    path: String,
    value: Given,
}

/// A given value.
#[derive(Debug, Clone, PartialEq)]
enum Given {
    /// A number in the unit of the key.
    Number(f64),
    /// A word, such as `one_sided`.
    Word(String),
    /// Yes or no.
    Switch(bool),
}

/// Smallest Jaro–Winkler similarity of a known path that an error suggests.
const LIKENESS: f64 = 0.8;

impl Setting {
    /// A setting from a value in the unit of the key.
    pub fn new(path: String, value: f64) -> Self {
        Setting {
            path,
            value: Given::Number(value),
        }
    }

    /// A setting of yes or no; `None` if the scene lacks the block of the key.
    pub(crate) fn switched(path: &str, is_on: bool, scene: &SceneFile) -> Option<Self> {
        let (block, _) = path.rsplit_once('.').unwrap_or_default();
        let scene = super::entries::value(scene);
        let found = block.split('.').try_fold(&scene, |part, key| part.get(key));
        found.filter(|block| !block.is_null()).map(|_| Setting {
            path: path.to_owned(),
            value: Given::Switch(is_on),
        })
    }

    /// Path of the key.
    pub(super) fn path(&self) -> &str {
        &self.path
    }
}

impl FromStr for Setting {
    type Err = RefusedValue;

    /// Parses a text like `guides[0].stiffness_n_per_m=20 kN/mm` or `guides[0].contact=one_sided`.
    fn from_str(text: &str) -> Result<Self, RefusedValue> {
        let Some((name, number)) = text.split_once('=') else {
            let allowed = "a path, =, and a number with or without a unit";
            let remedy = "write it like blade.thickness_m=2.6mm";
            return Err(RefusedValue::new(
                "the setting",
                format!("{text:?}"),
                allowed,
                remedy,
            ));
        };
        let path = name.trim().to_owned();
        if Quantity::of(&path).is_none() && takes_words(&path) {
            let value = Given::Word(number.trim().to_owned());
            return Ok(Setting { path, value });
        }
        let value = number_of(&path, number)?;
        Ok(Setting::new(path, value))
    }
}

/// Whether the key at a path has one of several words as its value.
fn takes_words(path: &str) -> bool {
    let (schema, general) = (json_schema(), general(path));
    keys(&schema)
        .iter()
        .any(|key| key.path == general && is_word(&schema, &key.pointer))
}

/// Whether the value at a pointer of a schema, or one of its alternatives, is a constant text.
fn is_word(schema: &Value, pointer: &str) -> bool {
    let node = schema.pointer(pointer).unwrap_or(&Value::Null);
    if let Some(name) = node["$ref"].as_str() {
        return is_word(schema, name.trim_start_matches('#'));
    }
    let variants = ["anyOf", "oneOf"].map(|word| node[word].as_array().map_or(0, Vec::len));
    let mut all = ["anyOf", "oneOf"].into_iter().zip(variants);
    let is_listed = |(word, count): (&str, usize)| {
        (0..count).any(|k| is_word(schema, &format!("{pointer}/{word}/{k}")))
    };
    node["const"].is_string() || node["enum"].is_array() || all.any(is_listed)
}

/// Parses a number in the unit of a key: `2.6mm` for `blade.thickness_m` is 0.0026.
///
/// The decimal mark is a point or a comma, and `1/8 in` is a fraction. A mark before three digits may separate
/// thousands instead: a comma there is refused unless the decimal number alone is usual, a point if the whole number
/// alone is usual, as in `1.800` for `operating_rpm`. A comma before more digits, or between two usual numbers, as in `2400,640`,
/// may separate two numbers and is refused, too.
///
/// # Errors
/// [`RefusedValue`] if scenes have no such number, or the text is no number in its unit.
pub fn number_of(path: &str, text: &str) -> Result<f64, RefusedValue> {
    Reading::of(path)?.number(text)
}

/// Parses a number in a unit, as [`number_of`]: `2.6mm` in m is 0.0026. `key` names it in the error.
///
/// # Errors
/// [`RefusedValue`] if the text is no number in this unit.
pub fn number_in(key: &str, unit: &str, text: &str) -> Result<f64, RefusedValue> {
    let reading = Reading {
        key,
        unit,
        unit_left_out: unit,
        usual: (f64::NEG_INFINITY, f64::INFINITY),
    };
    reading.number(text)
}

/// Parses the numbers of a list where several are allowed: `2400,2640` and `2400, 2640 rpm` are two, `2400,5` is one number with a
/// decimal comma, because 5 is no usual number at the path.
///
/// # Errors
/// [`RefusedValue`] as for [`number_of`]. `key` names the numbers in the error.
pub fn numbers_of(key: &str, path: &str, text: &str) -> Result<Vec<f64>, RefusedValue> {
    let reading = Reading {
        key,
        ..Reading::of(path)?
    };
    let parts: Vec<&str> = text.split(',').collect();
    let as_list: Result<Vec<f64>, _> = parts.iter().map(|part| reading.number(part)).collect();
    match as_list {
        Ok(list) if parts.len() > 1 && list.iter().all(|value| reading.is_usual(*value)) => {
            Ok(list)
        }
        _ => Ok(vec![reading.number(text)?]),
    }
}

/// Units and usual range by which the text of a number is read.
pub(crate) struct Reading<'a> {
    key: &'a str,
    /// Unit of the result.
    unit: &'a str,
    /// Unit of a text without one.
    unit_left_out: &'a str,
    /// Usual range of the result.
    usual: (f64, f64),
}

impl<'a> Reading<'a> {
    /// A number of a scene.
    pub fn of(path: &'a str) -> Result<Self, RefusedValue> {
        let quantity = Quantity::of(path).ok_or_else(|| unknown(path))?;
        Ok(Reading {
            key: path,
            unit: quantity.unit,
            unit_left_out: quantity.unit,
            usual: quantity.usual,
        })
    }

    /// The same number, of which a text without a unit is in another one.
    #[cfg(feature = "page")]
    pub fn usually_in(self, unit_left_out: &'a str) -> Self {
        Reading {
            unit_left_out,
            ..self
        }
    }

    /// The same number under another name in its errors.
    pub fn named(self, key: &'a str) -> Self {
        Reading { key, ..self }
    }

    fn is_usual(&self, value: f64) -> bool {
        (self.usual.0..=self.usual.1).contains(&value)
    }

    /// Parses the number, in the unit of the result.
    pub fn number(&self, text: &str) -> Result<f64, RefusedValue> {
        let text = text.trim();
        let not =
            |allowed, remedy| RefusedValue::new(self.key, format!("{text:?}"), allowed, remedy);
        let refused = |remedy| {
            let allowed = match self.unit_left_out {
                "" => "a number without a unit".to_owned(),
                unit => format!("a number in {unit}, or with a unit of the same kind"),
            };
            not(allowed, remedy)
        };
        let plain = text.replace('−', "-");
        let (digits, rest) = plain.split_at(end_of_number(&plain));
        let decimal: f64 = digits
            .replace(',', ".")
            .parse()
            .map_err(|_| refused(example(self.unit_left_out)))?;
        let (below, unit) =
            over(rest.trim()).ok_or_else(|| refused("divide by a number above 0"))?;
        // A change in percent needs the present number, which is not known here. Without this check, +5% of a
        // dimensionless number would be read as 0.05.
        if unit == "%" && (text.starts_with('+') || !self.unit.is_empty()) {
            return Err(refused(
                "give the new number itself, not its change in percent",
            ));
        }
        let unit = if unit.is_empty() {
            self.unit_left_out
        } else {
            unit
        };
        let given = Unit::parse(unit).ok_or_else(|| {
            refused("write units like mm, kN/mm, g/cm^3 or rad/s, or leave the unit out")
        })?;
        let own = Unit::parse(self.unit)
            .filter(|own| own.is_of(&given))
            .ok_or_else(|| refused("give a unit of this quantity, or leave the unit out"))?;
        let in_key = |value| product(value, given.factor, own.factor);
        let value = in_key(decimal / below);
        if let Some([first, second]) = as_two(digits) {
            let are_usual = [first, second]
                .iter()
                .all(|one| self.is_usual(in_key(one / below)));
            if second_digits(digits) > GROUP || are_usual {
                let either = format!("{decimal}{rest}, or the two numbers {first} and {second}");
                return Err(not(
                    either,
                    "write the one number with a point, or give each number for itself",
                ));
            }
        }
        let Some(whole) = in_thousands(digits) else {
            return Ok(value);
        };
        let is_usual = |value: f64| self.is_usual(value);
        let is_whole_usual = is_usual(in_key(whole / below));
        let is_decimal = if digits.contains(',') {
            is_usual(value) && !is_whole_usual
        } else {
            is_usual(value) || !is_whole_usual
        };
        if is_decimal {
            Ok(value)
        } else {
            let either = format!("{whole}{rest} or {decimal}{rest}");
            Err(not(either, "write one of these"))
        }
    }
}

/// Remedy for a text that is no number, with examples of a number in the unit.
fn example(unit: &str) -> &'static str {
    match unit {
        "m" => "write it like 0.0026 or 2.6mm",
        "rpm" => "write it like 1800 or 30 rev/s",
        "" => "write it like 0.3",
        _ => "write it like 20 or 2e1, with or without a unit",
    }
}

/// `value * numerator / denominator` for two factors of units, so that 2.6 mm give the same number as 0.0026 m and 56 in
/// as 1.4224 m: products with whole numbers and divisions by them are rounded correctly, unlike those with fractions.
fn product(value: f64, numerator: f64, denominator: f64) -> f64 {
    const SCALE: f64 = 1e4;
    let (divisor, factor) = (denominator / numerator, numerator / denominator);
    let whole = SCALE * factor;
    if divisor.fract() == 0.0 {
        value / divisor
    } else if whole.fract() == 0.0 {
        value * whole / SCALE
    } else {
        value * factor
    }
}

/// The denominator with which a text begins after a stroke, otherwise 1, and the text after it; `None` if the
/// denominator is not above 0.
fn over(text: &str) -> Option<(f64, &str)> {
    let below = text.strip_prefix('/').map_or("", str::trim_start);
    if !below.starts_with(|c: char| c.is_ascii_digit()) {
        return Some((1.0, text));
    }
    let (digits, unit) = below.split_at(end_of_number(below));
    let denominator = digits.parse().ok().filter(|below| *below > 0.0)?;
    Some((denominator, unit.trim()))
}

/// Number of digits of a group of thousands.
const GROUP: usize = 3;

/// Number of digits behind the comma.
fn second_digits(digits: &str) -> usize {
    digits.split_once(',').map_or(0, |(_, second)| second.len())
}

/// The two numbers that a comma may separate, if more than three digits are before or behind it, at least three behind it, which do not
/// begin with a zero: 2400 and 640 for `2400,640`, 2 and 4000 for `2,4000`.
fn as_two(digits: &str) -> Option<[f64; 2]> {
    let (first, second) = digits.split_once(',')?;
    let before = first.trim_start_matches(['+', '-']);
    let is_long = before.len() > GROUP || second.len() > GROUP;
    let is_list = is_long && second.len() >= GROUP && !second.starts_with('0');
    let is_whole = [before, second]
        .iter()
        .all(|part| part.bytes().all(|c| c.is_ascii_digit()));
    if !(is_list && is_whole) {
        return None;
    }
    Some([first.parse().ok()?, second.parse().ok()?])
}

/// The number without the mark that may separate thousands: 1800 for `1.800` and `1,800`.
fn in_thousands(digits: &str) -> Option<f64> {
    let (thousands, rest) = digits.split_once(['.', ','])?;
    let first = thousands.trim_start_matches(['+', '-']);
    let is_group = (1..=3).contains(&first.len()) && !first.starts_with('0') && rest.len() == 3;
    let is_number = is_group && rest.bytes().all(|c| c.is_ascii_digit());
    is_number.then(|| format!("{thousands}{rest}").parse().ok())?
}

/// End of the number with which a text begins.
fn end_of_number(text: &str) -> usize {
    let mut end = text.len() - text.trim_start_matches(['+', '-']).len();
    end += text[end..]
        .find(|c: char| !(c.is_ascii_digit() || c == '.' || c == ','))
        .unwrap_or(text.len() - end);
    let exponent = text[end..]
        .strip_prefix(['e', 'E'])
        .map(|rest| rest.strip_prefix(['+', '-']).unwrap_or(rest));
    if exponent.is_some_and(|digits| digits.starts_with(|c: char| c.is_ascii_digit())) {
        end += 1;
        end += usize::from(text[end..].starts_with(['+', '-']));
        let rest = &text[end..];
        end += rest
            .find(|c: char| !c.is_ascii_digit())
            .unwrap_or(rest.len());
    }
    end
}

fn unknown(path: &str) -> RefusedValue {
    let general = general(path);
    let last = |path: &str| path.rsplit('.').next().unwrap_or_default().to_owned();
    let likeness = |own: &str| {
        let whole = strsim::jaro_winkler(&general, own);
        whole.max(strsim::jaro_winkler(&last(&general), &last(own)))
    };
    let near = QUANTITIES
        .iter()
        .rev()
        .map(|q| (likeness(q.path), q.path))
        .max_by(|x, y| x.0.total_cmp(&y.0))
        .filter(|(likeness, _)| *likeness > LIKENESS);
    let meant = near.map_or(String::new(), |(_, near)| format!(", perhaps {near}"));
    RefusedValue::new(
        "the path",
        format!("{path:?}"),
        format!("that of a number of a scene, like guides[0].radius_m{meant}"),
        "`sawflutter keys` prints them all",
    )
}

impl SceneFile {
    /// The scene with other numbers, by their paths. Creates a missing block, such as `cut` for
    /// `cut.power_w`, but no entry of a list.
    ///
    /// ```
    /// use sawflutter::model::scene::{Scene, Setting};
    ///
    /// let thinner: Setting = "blade.thickness_m=2.6mm".parse()?;
    /// let saw = Scene::paper().file().set(&[thinner])?;
    /// assert_eq!(saw.blade().thickness_m, 0.0026);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`SceneError`] if the scene has no place for a number, or a value is refused.
    pub fn set(&self, settings: &[Setting]) -> Result<Scene, SceneError> {
        set(super::entries::value(self), settings)
    }
}

/// The scene of a JSON with other values.
pub(super) fn set(mut json: Value, settings: &[Setting]) -> Result<Scene, SceneError> {
    for setting in settings {
        put(&mut json, setting)?;
    }
    let set = Scene::from_json(&json.to_string());
    set.map_err(|error| match error {
        // The text is a single generated line, so its line number is meaningless to the user.
        SceneError::Syntax {
            key,
            message,
            allowed,
            remedy,
        } => SceneError::Syntax {
            key,
            message: message.trim_end_matches(" (line 1)").to_owned(),
            allowed,
            remedy,
        },
        other => other,
    })
}

/// Writes a value at its path.
fn put(json: &mut Value, setting: &Setting) -> Result<(), RefusedValue> {
    let value = value(setting)?;
    let mut place = json;
    let mut reached = String::new();
    // `Quantity::of` has checked that the path consists of keys and indices.
    for step in setting
        .path
        .split('.')
        .flat_map(|part| part.split_inclusive('['))
    {
        let step = step.trim_end_matches('[');
        if let Some(index) = step.strip_suffix(']') {
            let entries = place
                .as_array_mut()
                .map(Vec::as_mut_slice)
                .unwrap_or_default();
            let count = entries.len();
            let entry = index.parse().ok().and_then(|at: usize| entries.get_mut(at));
            place = entry.ok_or_else(|| no_entry(&setting.path, &reached, count))?;
            reached += &format!("[{index}]");
            continue;
        }
        if place.is_null() {
            *place = Value::Object(Map::new());
        }
        let block = place
            .as_object_mut()
            .ok_or_else(|| no_entry(&setting.path, &reached, 0))?;
        place = block.entry(step).or_insert(Value::Null);
        reached += if reached.is_empty() { "" } else { "." };
        reached += step;
    }
    *place = value;
    Ok(())
}

/// The value as JSON; a whole number without a decimal point, which counts need and other numbers accept.
fn value(setting: &Setting) -> Result<Value, RefusedValue> {
    const EXACT: f64 = 9e15;
    let value = match &setting.value {
        Given::Number(value) => *value,
        Given::Word(word) => return Ok(Value::from(word.as_str())),
        Given::Switch(is_on) => return Ok(Value::from(*is_on)),
    };
    if value.fract() == 0.0 && (0.0..EXACT).contains(&value) {
        return Ok(Value::from(value as u64));
    }
    let number = Number::from_f64(value)
        .ok_or_else(|| RefusedValue::new(&setting.path, value, "finite", "give a number"))?;
    Ok(Value::Number(number))
}

fn no_entry(path: &str, list: &str, count: usize) -> RefusedValue {
    let allowed = match count {
        0 => format!("an index that the scene has, but its {list} has no entries"),
        _ => format!(
            "an index that the scene has: {list}[0] to {list}[{}]",
            count - 1
        ),
    };
    RefusedValue::new(
        "the path",
        format!("{path:?}"),
        allowed,
        "write the entry into the scene first",
    )
}

#[cfg(test)]
mod tests {
    use super::super::{ContactLaw, DampingFile};
    use super::*;

    fn set(texts: &[&str]) -> Result<Scene, String> {
        let settings = texts
            .iter()
            .map(|text| text.parse())
            .collect::<Result<Vec<Setting>, RefusedValue>>()
            .map_err(|error| error.to_string())?;
        let set = Scene::paper().file().set(&settings);
        set.map_err(|error| error.to_string())
    }

    /// Words are those of the scene; another one is refused with all that are allowed.
    #[test]
    fn a_key_with_words_takes_one_of_them() {
        let words = set(&["guides[0].contact=one_sided", "guides[0].gap_m=0.05mm"]).unwrap();
        let typed = Scene::paper().edited(|file| {
            file.guides[0].contact = ContactLaw::OneSided;
            file.guides[0].gap_m = Some(5e-5);
        });
        assert_eq!(words.file(), typed.unwrap().file());
        let refused = set(&["guides[0].contact=onesided"]).unwrap_err();
        assert!(
            refused.contains("one_sided") && refused.contains("onesided"),
            "{refused}"
        );
        let refused = set(&["blade.thicknes_m=thin"]).unwrap_err();
        assert!(refused.contains("perhaps blade.thickness_m"), "{refused}");
    }

    /// The result equals a scene with these numbers typed in the units of their keys.
    #[test]
    fn numbers_with_units_are_those_typed_in_si() {
        let texts = [
            "blade.thickness_m=2.6mm",
            "guides[0].stiffness_n_per_m = 20 kN/mm",
            "guides[0].angle_deg=-0.5rad",
            "blade.teeth=80",
            "operating_rpm=30 rev/s",
            "damping.air_n_s_per_m3=40",
            "blade.material.poisson_ratio=30%",
            "cut.power_w=2.5e1kW",
        ];
        let found = set(&texts).unwrap();
        let typed = Scene::paper().edited(|file| {
            file.blade.thickness_m = 0.0026;
            file.guides[0].stiffness_n_per_m = 2e7;
            file.guides[0].angle_deg = (-0.5_f64).to_degrees();
            file.blade.teeth = Some(80);
            file.operating_rpm = Some(1800.0);
            file.blade.material.poisson_ratio = 0.3;
            file.cut.as_mut().unwrap().power_w = Some(25e3);
            file.damping = Some(DampingFile {
                air_n_s_per_m3: 40.0,
                ..DampingFile::default()
            });
        });
        assert_eq!(found, typed.unwrap());
    }

    #[test]
    fn marks_and_fractions_are_read_as_a_designer_writes_them() {
        for (path, text, value) in [
            ("blade.thickness_m", "1/8 in", 0.003_175),
            ("blade.thickness_m", "2,6mm", 0.0026),
            ("blade.thickness_m", "2,850 mm", 0.00285),
            ("blade.thickness_m", "2.850 mm", 0.00285),
            ("blade.outer_diameter_m", "56in", 1.4224),
            ("guides[0].angle_deg", "−12.5", -12.5),
            ("side_force.force_n", "12.345", 12.345),
        ] {
            assert_eq!(number_of(path, text), Ok(value), "{text}");
        }
        for (path, text, either) in [
            ("operating_rpm", "1.800", "1800 or 1.8"),
            ("operating_rpm", "1,800 rpm", "1800 rpm or 1.8 rpm"),
            ("side_force.force_n", "12,345", "12345 or 12.345"),
        ] {
            let refused = number_of(path, text).unwrap_err();
            assert_eq!(refused.allowed, either, "{text}");
            assert_eq!(&*refused.remedy, "write one of these");
        }
        let thickness = Reading {
            unit_left_out: "mm",
            ..Reading::of("blade.thickness_m").unwrap()
        };
        assert_eq!(thickness.number("2.6"), Ok(0.0026));
        for (path, text, either) in [
            (
                "operating_rpm",
                "2400,2640",
                "2400.264, or the two numbers 2400 and 2640",
            ),
            (
                "operating_rpm",
                "2,4000 rpm",
                "2.4 rpm, or the two numbers 2 and 4000",
            ),
            (
                "operating_rpm",
                "2400,640",
                "2400.64, or the two numbers 2400 and 640",
            ),
            (
                "blade.thickness_m",
                "2,6500mm",
                "2.65mm, or the two numbers 2 and 6500",
            ),
            ("operating_rpm", "3.000", "3000 or 3"),
        ] {
            assert_eq!(number_of(path, text).unwrap_err().allowed, either, "{text}");
        }
        for (path, text, value) in [
            ("blade.thickness_m", "0,0026", 0.0026),
            ("operating_rpm", "2400,5", 2400.5),
            ("guides[0].angle_deg", "225,25", 225.25),
        ] {
            assert_eq!(number_of(path, text), Ok(value), "{text}");
        }
        assert_eq!(thickness.number("1/8 in"), Ok(0.003_175));
    }

    #[test]
    fn a_list_where_several_numbers_are_allowed_is_a_list() {
        let read = |text: &str| numbers_of("it", "operating_rpm", text);
        for (text, values) in [
            ("2400,2640", &[2400.0, 2640.0][..]),
            ("1800, 40rev/s,2800.5", &[1800.0, 2400.0, 2800.5]),
            ("2400", &[2400.0]),
            ("2400,5", &[2400.5]),
        ] {
            assert_eq!(read(text).unwrap(), values, "{text}");
        }
        for text in ["2,4000", "1,800", "", "2400,fast"] {
            assert!(read(text).is_err(), "{text}");
        }
    }

    #[test]
    fn refusals_name_path_value_and_remedy() {
        let cases = [
            ("blade.thickness_m", &["path, =, and a number"][..]),
            (
                "blade.thicknes_m=2",
                &[
                    "\"blade.thicknes_m\"",
                    "perhaps blade.thickness_m",
                    "sawflutter keys",
                ],
            ),
            ("thickness_m=2", &["perhaps blade.thickness_m"]),
            (
                "guides[7].radius_m=0.2",
                &["guides[7]", "guides[0] to guides[0]"],
            ),
            ("guides[].radius_m=0.2", &["guides[0] to guides[0]"]),
            (
                "blade.thickness_m=2.6 N",
                &["\"2.6 N\"", "a number in m", "a unit of this quantity"],
            ),
            (
                "blade.thickness_m=2.6 furlong",
                &["\"2.6 furlong\"", "write units like mm"],
            ),
            (
                "blade.thickness_m=-5%",
                &["\"-5%\"", "a number in m", "not its change in percent"],
            ),
            (
                "blade.material.poisson_ratio=+5%",
                &["\"+5%\"", "not its change in percent"],
            ),
            ("blade.thickness_m=1/0 in", &["\"1/0 in\"", "above 0"]),
            ("blade.thickness_m=1,2,3", &["like 0.0026 or 2.6mm"]),
            (
                "blade.thickness_m=thin",
                &["\"thin\"", "like 0.0026 or 2.6mm"],
            ),
            (
                "blade.thickness_m=",
                &["blade.thickness_m must be ", "(you gave \"\")"],
            ),
            ("blade.thickness_m=-1mm", &["blade.thickness_m", "-0.001"]),
            ("blade.teeth=80.5", &["blade.teeth", "whole number"]),
            ("blade.teeth=80 mm", &["without a unit"]),
            ("operating_rpm=30Hz", &["a number in rpm"]),
            (
                "blade.profile[0].thickness_m=2mm",
                &["blade.profile", "no entries"],
            ),
            ("operating_rpm=1e999", &["finite"]),
        ];
        for (text, expected) in cases {
            let error = set(&[text]).unwrap_err();
            for words in expected {
                assert!(error.contains(words), "{text}: {error}");
            }
        }
    }
}
