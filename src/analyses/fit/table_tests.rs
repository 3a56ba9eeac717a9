//! A table is read the same, whatever program wrote it; an ambiguous one is refused.

use super::*;

/// Speed and frequencies of every row.
fn numbers(text: &str) -> Vec<Vec<Option<f64>>> {
    let table = read(text, Others::Refused).unwrap_or_else(|error| panic!("{text:?}: {error}"));
    let row = |row: &TableRow| {
        let cells = row.cells.iter();
        cells.map(|(_, text)| text.parse().ok()).collect()
    };
    table.rows.iter().map(row).collect()
}

#[test]
fn separators_decimal_commas_and_the_order_of_columns_are_read_off_the_table() {
    let expected = vec![
        vec![Some(0.0), Some(9.25), Some(10.5)],
        vec![Some(1250.0), None, Some(7.68)],
    ];
    for text in [
        "rpm,f1,f2\n0,9.25,10.5\n1250,,7.68\n",
        "0,9.25,10.5\r\n1250,,7.68\r\n",
        "rpm;f1;f2\n0;9,25;10,5\n1250;;7,68\n",
        "0;9,25;10,5\n1250;;7,68",
        "sep=;\nDrehzahl [1/min];f1 [Hz];f2 [Hz]\n0;9,25;10,5;\n1250;;7,68;\n",
        "rpm\tf1\tf2\n0\t9,25\t10,5\n1250\t\t7,68\n",
        "rpm\tf1\tf2\n0\t9.25\t10.5\n1250\t\t7.68\n",
        "\"rpm\",\"f1\",\"f2\"\n\"0\",\"9,25\",\"10,5\"\n\"1250\",\"\",\"7,68\"\n",
        "f1,f2,rpm\n9.25,10.5,0\n,7.68,1250\n",
        "f2;n;f1\n10,5;0;9,25\n7,68;1250;\n",
        "# a comment, with; marks\n\nSpeed,Mode 1,Mode 2\nrpm,Hz,Hz\n0,9.25,10.5\n1250,,7.68\n",
    ] {
        assert_eq!(numbers(text), expected, "{text:?}");
    }
    let blanks = "rpm f1 f2\n0   9.25 10.5\n1250 7.68\n";
    assert_eq!(
        numbers(blanks),
        [
            vec![Some(0.0), Some(9.25), Some(10.5)],
            vec![Some(1250.0), Some(7.68)]
        ]
    );
}

#[test]
fn what_could_mean_two_things_is_refused_with_its_line() {
    for (text, line, expected) in [
        // A decimal comma that is also the separator is refused.
        ("rpm,f1\n1250,7,68\n", 2, "semicolons"),
        ("rpm;f1\n1.250;7,68\n", 2, "thousands"),
        ("rpm;f1\n1.250,5;7,68\n", 2, "both"),
        ("rpm\tf1\n1,250\t9\n", 2, "thousands"),
        ("rpm,f1\n\"1,250\",9\n", 2, "thousands"),
        ("rpm,f1,temperature\n0,9,20\n", 1, "temperature"),
        ("speed (rad/s),f1\n0,9\n", 1, "rpm"),
        ("rpm,speed,f1\n0,0,9\n", 1, "2 of its columns"),
        ("rpm,f1\nrpm,kHz\n0,9\n", 1, "Hz"),
        ("datum,bemerkung\n1,2\n", 1, "neither"),
        (
            "rpm,f1,f2,f1\n0,9,12,9\n",
            1,
            "column 4 is \"f1\" once more",
        ),
        (
            "rpm,n0,n1,n0\n0,9,12,9\n",
            1,
            "one mode without nodal diameters",
        ),
        ("rpm,n1,n1,n1\n0,9,12,9\n", 1, "two frequencies at most"),
        (
            "rpm,n0,n1,f3\n0,9,12,9\n",
            1,
            "no number of nodal diameters, as others are",
        ),
        ("rpm,n0,n301\n0,9,12\n", 1, "more than 300 nodal diameters"),
        ("1O00,9.2S\n2000,9\n", 0, ""),
    ] {
        match (read(text, Others::Refused), expected) {
            (Err(FitError::Table { line: at, problem }), _) if !expected.is_empty() => {
                assert!(problem.contains(expected), "{text:?}: {problem}");
                assert_eq!(at, line, "{text:?}");
            }
            (Err(FitError::Table { .. }), "") => (),
            (other, _) => panic!("{text:?}: {other:?}"),
        }
    }
}

/// A row that contains a number is data: its other cells are typing mistakes.
#[test]
fn a_first_row_with_a_typing_mistake_is_no_header() {
    let rows = read("O,7.68,9.5\n1000,7,9\n", Others::Refused)
        .unwrap()
        .rows;
    assert_eq!(rows.len(), 2);
    assert_eq!(rows[0].cells[0], (1, "O".to_owned()));
}
