//! `study.parquet`: the table of `study.csv` with typed columns.

use std::io::{self, Write};
use std::sync::Arc;

use parquet::basic::{ConvertedType, LogicalType, Repetition, Type as Physical};
use parquet::data_type::{BoolType, ByteArrayType, DataType, DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedColumnWriter, SerializedFileWriter};
use parquet::schema::types::{Type, TypePtr};

use super::csv::{bands_in_words, columns, numbers_in_words};
use super::inputs::Inputs;
use super::plan::Study;
use super::saw::{Found, Saw};
use super::table::Table;

/// A column of values; saws that were not analysed have `None`.
enum Column {
    Integers(Vec<Option<i64>>),
    Numbers(Vec<Option<f64>>),
    Answers(Vec<Option<bool>>),
    Texts(Vec<Option<String>>),
}

/// The saws as an Apache Parquet file, whose metadata contain scene and study under `sawflutter`. Saws that are
/// added together form a row group.
pub struct ParquetTable<'a, W: Write + Send> {
    study: &'a Study,
    writer: SerializedFileWriter<W>,
}

impl<'a, W: Write + Send> ParquetTable<'a, W> {
    /// A table without saws.
    ///
    /// # Errors
    /// The error of writing.
    pub fn new(study: &'a Study, out: W) -> io::Result<Self> {
        let inputs = serde_json::to_string(&Inputs::of(study)).map_err(io::Error::other)?;
        let properties = WriterProperties::builder()
            .set_key_value_metadata(Some(vec![KeyValue::new("sawflutter".to_owned(), inputs)]))
            .build();
        let schema = schema(study).map_err(io::Error::other)?;
        let writer = SerializedFileWriter::new(out, schema, Arc::new(properties))
            .map_err(io::Error::other)?;
        Ok(ParquetTable { study, writer })
    }

    fn add_rows(&mut self, saws: &[Saw]) -> Result<(), ParquetError> {
        let mut rows = self.writer.next_row_group()?;
        for column in values(self.study, saws) {
            if let Some(mut open) = rows.next_column()? {
                write(&mut open, &column)?;
                open.close()?;
            }
        }
        rows.close()?;
        Ok(())
    }
}

impl<W: Write + Send> Table for ParquetTable<'_, W> {
    fn add(&mut self, saws: &[Saw]) -> io::Result<()> {
        self.add_rows(saws).map_err(io::Error::other)
    }

    fn finish(self: Box<Self>) -> io::Result<()> {
        let mut out = self.writer.into_inner().map_err(io::Error::other)?;
        out.flush()
    }
}

/// The columns in the order of [`columns`].
fn values(study: &Study, saws: &[Saw]) -> Vec<Column> {
    let numbers = |of: &dyn Fn(&Saw) -> Option<f64>| Column::Numbers(saws.iter().map(of).collect());
    let speeds = |of: fn(&Found) -> Option<f64>| numbers(&|saw| saw.found().and_then(of));
    let integers = |of: &dyn Fn(&Saw) -> Option<usize>| {
        Column::Integers(saws.iter().map(|saw| of(saw).map(|n| n as i64)).collect())
    };
    let answers = |of: &dyn Fn(&Found) -> Option<bool>| {
        Column::Answers(saws.iter().map(|saw| saw.found().and_then(of)).collect())
    };
    let texts = |of: fn(&Saw) -> Option<String>| Column::Texts(saws.iter().map(of).collect());
    let mut columns = vec![integers(&|saw| Some(saw.index))];
    columns.extend((0..study.varying.len()).map(|k| numbers(&|saw| Some(saw.values[k]))));
    columns.extend([
        texts(|saw| Some(saw.outcome.status().to_owned())),
        speeds(|found| found.first_critical_rpm),
        speeds(|found| found.flutter_rpm),
        speeds(|found| found.first_merge_rpm),
        answers(&Found::passed),
    ]);
    let kept = 0..study.criteria_of_nothing().len();
    columns.extend(kept.map(|k| answers(&|found| Some(found.kept[k]))));
    let gap = 0..study.gap_columns().len();
    columns.extend(gap.map(|k| numbers(&|saw| saw.found().and_then(|found| found.gap[k]))));
    columns.extend([
        integers(&|saw| saw.found().map(|found| found.functions)),
        speeds(|found| Some(found.estimated_relative_error)),
        integers(&|saw| saw.found().map(|found| found.krein_violations)),
    ]);
    if study.file().bands {
        columns.push(texts(|saw| {
            saw.found()
                .map(|found| numbers_in_words(&found.critical_rpm))
        }));
        columns.push(texts(|saw| {
            saw.found().map(|found| bands_in_words(&found.bands))
        }));
    }
    columns.push(texts(|saw| saw.outcome.reason().map(str::to_owned)));
    columns
}

fn schema(study: &Study) -> Result<TypePtr, ParquetError> {
    let mut fields = Vec::new();
    for (name, column) in columns(study).iter().zip(values(study, &[])) {
        let physical = match column {
            Column::Integers(_) => Physical::INT64,
            Column::Numbers(_) => Physical::DOUBLE,
            Column::Answers(_) => Physical::BOOLEAN,
            Column::Texts(_) => Physical::BYTE_ARRAY,
        };
        let mut field =
            Type::primitive_type_builder(name, physical).with_repetition(Repetition::OPTIONAL);
        if let Column::Texts(_) = column {
            field = field
                .with_converted_type(ConvertedType::UTF8)
                .with_logical_type(Some(LogicalType::String));
        }
        fields.push(Arc::new(field.build()?));
    }
    let group = Type::group_type_builder("study").with_fields(fields);
    Ok(Arc::new(group.build()?))
}

fn write(open: &mut SerializedColumnWriter<'_>, column: &Column) -> Result<(), ParquetError> {
    match column {
        Column::Integers(cells) => write_cells::<Int64Type, _>(open, cells, |cell| *cell),
        Column::Numbers(cells) => write_cells::<DoubleType, _>(open, cells, |cell| *cell),
        Column::Answers(cells) => write_cells::<BoolType, _>(open, cells, |cell| *cell),
        Column::Texts(cells) => {
            write_cells::<ByteArrayType, _>(open, cells, |cell| cell.as_str().into())
        }
    }
}

/// Writes the present values, and for each row a definition level: 1 if its value is present, 0 if not.
fn write_cells<D: DataType, T>(
    open: &mut SerializedColumnWriter<'_>,
    cells: &[Option<T>],
    stored: impl Fn(&T) -> D::T,
) -> Result<(), ParquetError> {
    let values: Vec<D::T> = cells.iter().flatten().map(stored).collect();
    let levels: Vec<i16> = cells.iter().map(|cell| i16::from(cell.is_some())).collect();
    open.typed::<D>()
        .write_batch(&values, Some(&levels), None)?;
    Ok(())
}
