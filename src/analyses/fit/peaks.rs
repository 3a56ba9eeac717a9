//! Peaks over the speed from a table, of which it is not known of what modes they are.

use super::FitError;
use super::cells::wrong;
use super::measurement::{MAX_HZ, MAX_RPM, number};
use super::table::{Others, read};

/// Speed in rpm and frequency in Hz of each peak of a table with one frequency in a line, or several. Columns that are
/// neither are left out.
///
/// # Errors
/// [`FitError::Table`] with line, column and description.
pub fn peaks(text: &str) -> Result<Vec<(f64, f64)>, FitError> {
    let mut found = Vec::new();
    for row in read(text, Others::LeftOut)?.rows {
        let Some((speed, frequencies)) = row.cells.split_first() else {
            let problem = "it has no speed; give it in rpm";
            return Err(wrong(row.line, problem.to_owned()));
        };
        let rpm = number(row.line, speed, MAX_RPM, "revolutions per minute")?;
        for cell in frequencies.iter().filter(|(_, text)| !text.is_empty()) {
            found.push((
                rpm,
                number(row.line, cell, MAX_HZ, "Hz, or leave it blank")?,
            ));
        }
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn peaks_are_read_in_any_form_of_a_table() {
        let expected = [(0.0, 68.9), (300.0, 60.1), (300.0, 78.2)];
        for text in [
            "rpm,frequency_hz\n0,68.9\n300,60.1\n300,78.2\n",
            "rpm;frequency_hz\n0;68,9\n300;60,1\n300;78,2\n",
            "rpm;f1;f2\n0;68,9;\n300;60,1;78,2\n",
            "file,rpm,frequency_hz,amplitude,order\n\"a, b.csv\",0,68.9,1,\na,300,60.1,1,\na,300,78.2,.5,1\n",
            "frequency_hz\trpm\n68.9\t0\n60.1\t300\n78.2\t300\n",
            "* peaks of a run-up\nrpm frequency_hz\n0 68.9\n300 60.1\n300 78.2\n",
            "Drehzahl;Frequenz\n1/min;Hz\n0;68,9\n300;60,1\n300;78,2\n",
            "rpm,frequency_hz,mode,probability\n0,68.9,1,.9\n300,60.1,2,1\n300,78.2,-1,.5\n",
        ] {
            assert_eq!(peaks(text).unwrap(), expected, "{text:?}");
        }
    }

    #[test]
    fn a_table_without_names_or_with_other_units_is_refused() {
        for (text, expected) in [
            ("0,68.9\n", "name the columns rpm and frequency_hz"),
            (
                "rpm,amplitude\n0,1\n",
                "has rpm, amplitude, but no frequency",
            ),
            ("rpm,frequency [kHz]\n0,1\n", "frequencies in Hz"),
            ("rpm,frequency_hz\n0,fast\n", "line 2"),
            ("frequency_hz,rpm\n7.5,100\n8.5\n", "line 3"),
        ] {
            let error = peaks(text).unwrap_err().to_string();
            assert!(error.contains(expected), "{error}");
        }
    }
}
