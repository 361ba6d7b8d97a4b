//! Part of the results: the rows of some cases as a Parquet file.
//!
//! Columns: `case` (from 0), the varied parameters in SI under their key paths, the results under their names in the study file, and
//! `error`. Missing results are null; a word is stored as a code, and the words are in the metadata. `error` is null if the case ran.
//! Numbers use byte-stream splitting and LZ4. The metadata identify study and program.

use super::Study;
use parquet::basic::{Compression, ConvertedType, Encoding, LogicalType, Repetition, Type as Physical};
use parquet::column::reader::{ColumnReader, get_typed_column_reader};
use parquet::data_type::{ByteArray, ByteArrayType, DataType, DoubleType, Int32Type, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::metadata::{KeyValue, ParquetMetaDataReader};
use parquet::file::properties::{EnabledStatistics, WriterProperties};
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::{ColumnPath, Type};
use std::fs::File;
use std::io;
use std::ops::Range;
use std::path::Path;
use std::sync::Arc;
use stickslip_run::program;

/// Metadata keys.
const STUDY: &str = "stickslip.study";
const PROGRAM: &str = "stickslip.program";
const FIRST: &str = "stickslip.first_case";
const CODES: &str = "stickslip.codes.";
/// Names of the first and last column.
pub(crate) const CASE: &str = "case";
pub(crate) const ERROR: &str = "error";

/// Rows of a part.
#[derive(Debug, Clone, Default)]
pub(crate) struct Rows {
    /// Results, row after row; NaN if missing.
    pub(crate) results: Vec<f64>,
    /// Reason why a case has no results; `None` for cases with results.
    pub(crate) errors: Vec<Option<String>>,
}

/// Metadata of a part.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Label {
    pub(crate) study: String,
    pub(crate) program: String,
    pub(crate) first: u64,
    pub(crate) rows: u64,
}

/// Returns the file name of a part.
pub(crate) fn name(part: u64) -> String {
    format!("part-{part:06}.parquet")
}

/// Returns the number of a part from its file name.
pub(crate) fn number(name: &str) -> Option<u64> {
    let digits = name.strip_prefix("part-")?.strip_suffix(".parquet")?;
    let number = digits.parse().ok()?;
    (self::name(number) == name).then_some(number)
}

/// Returns the columns of a study's parts.
fn schema(study: &Study) -> Result<Arc<Type>, ParquetError> {
    let column = |name: &str, physical, repetition| {
        let built = Type::primitive_type_builder(name, physical).with_repetition(repetition).build();
        built.map(Arc::new)
    };
    let mut fields = vec![column(CASE, Physical::INT64, Repetition::REQUIRED)?];
    for axis in &study.design.axes {
        fields.push(column(&axis.path, Physical::DOUBLE, Repetition::REQUIRED)?);
    }
    for wanted in &study.wanted {
        let physical = if wanted.codes.is_some() { Physical::INT32 } else { Physical::DOUBLE };
        fields.push(column(&wanted.name, physical, Repetition::OPTIONAL)?);
    }
    let error = Type::primitive_type_builder(ERROR, Physical::BYTE_ARRAY)
        .with_repetition(Repetition::OPTIONAL)
        .with_converted_type(ConvertedType::UTF8)
        .with_logical_type(Some(LogicalType::String));
    fields.push(Arc::new(error.build()?));
    Type::group_type_builder("study").with_fields(fields).build().map(Arc::new)
}

fn properties(study: &Study, first: u64) -> WriterProperties {
    let said = |key: &str, value: String| KeyValue::new(key.to_owned(), value);
    let mut metadata = vec![
        said(STUDY, study.hash.clone()),
        said(PROGRAM, format!("{} {}", program::NAME, program::VERSION)),
        said(FIRST, first.to_string()),
    ];
    for wanted in &study.wanted {
        // Serialisation cannot fail, because codes are lists of strings.
        let words = wanted.codes.as_ref().map(|codes| serde_json::to_string(codes).unwrap_or_default());
        metadata.extend(words.map(|words| said(&format!("{CODES}{}", wanted.name), words)));
    }
    let place = |name: &str| ColumnPath::from(vec![name.to_owned()]);
    let mut properties = WriterProperties::builder()
        .set_dictionary_enabled(false)
        .set_statistics_enabled(EnabledStatistics::Chunk)
        .set_offset_index_disabled(true)
        .set_compression(Compression::LZ4_RAW)
        .set_encoding(Encoding::BYTE_STREAM_SPLIT)
        .set_column_encoding(place(CASE), Encoding::DELTA_BINARY_PACKED)
        .set_column_encoding(place(ERROR), Encoding::PLAIN)
        .set_column_dictionary_enabled(place(ERROR), true)
        .set_max_row_group_row_count(None)
        .set_key_value_metadata(Some(metadata));
    for wanted in study.wanted.iter().filter(|wanted| wanted.codes.is_some()) {
        properties = properties.set_column_dictionary_enabled(place(&wanted.name), true);
        properties = properties.set_column_encoding(place(&wanted.name), Encoding::PLAIN);
    }
    properties.build()
}

/// Returns the content of a part file.
pub(crate) fn bytes(study: &Study, cases: Range<u64>, rows: &Rows) -> Result<Vec<u8>, ParquetError> {
    let properties = Arc::new(properties(study, cases.start));
    let mut writer = SerializedFileWriter::new(Vec::new(), schema(study)?, properties)?;
    let mut group = writer.next_row_group()?;
    let numbers: Vec<i64> = cases.clone().map(|case| case as i64).collect();
    column::<Int64Type>(&mut group, &numbers, None)?;
    let axes = study.design.axes.len();
    let mut values = vec![0.0; axes * numbers.len()];
    cases.zip(values.chunks_exact_mut(axes)).for_each(|(case, row)| study.design.write(case, row));
    for axis in 0..axes {
        let own: Vec<f64> = values.iter().skip(axis).step_by(axes).copied().collect();
        column::<DoubleType>(&mut group, &own, None)?;
    }
    let width = study.wanted.len();
    for (place, wanted) in study.wanted.iter().enumerate() {
        let own = || rows.results.iter().skip(place).step_by(width).copied();
        let levels: Vec<i16> = own().map(|value| i16::from(value.is_finite())).collect();
        let there = own().filter(|value| value.is_finite());
        if wanted.codes.is_some() {
            column::<Int32Type>(
                &mut group,
                &there.map(|code| code as i32).collect::<Vec<_>>(),
                Some(&levels),
            )?;
        } else {
            column::<DoubleType>(&mut group, &there.collect::<Vec<_>>(), Some(&levels))?;
        }
    }
    let levels: Vec<i16> = rows.errors.iter().map(|error| i16::from(error.is_some())).collect();
    let texts: Vec<ByteArray> = rows.errors.iter().flatten().map(|text| text.as_str().into()).collect();
    column::<ByteArrayType>(&mut group, &texts, Some(&levels))?;
    group.close()?;
    writer.into_inner()
}

fn column<T: DataType>(
    group: &mut SerializedRowGroupWriter<'_, Vec<u8>>,
    values: &[T::T],
    levels: Option<&[i16]>,
) -> Result<(), ParquetError> {
    let missing = || ParquetError::General("more columns than in the schema".to_owned());
    let mut column = group.next_column()?.ok_or_else(missing)?;
    column.typed::<T>().write_batch(values, levels, None)?;
    column.close()
}

/// Reads the metadata of a part, or returns `None` if the file is not a complete Parquet file.
pub(crate) fn label(path: &Path) -> io::Result<Option<Label>> {
    let file = File::open(path)?;
    let Ok(metadata) = ParquetMetaDataReader::new().parse_and_finish(&file) else { return Ok(None) };
    let metadata = metadata.file_metadata();
    let value = |key: &str| {
        let all = metadata.key_value_metadata()?;
        all.iter().find(|known| known.key == key)?.value.clone()
    };
    let rows = u64::try_from(metadata.num_rows()).unwrap_or(0);
    let label = || {
        Some(Label {
            study: value(STUDY)?,
            program: value(PROGRAM)?,
            first: value(FIRST)?.parse().ok()?,
            rows,
        })
    };
    // A complete file without the metadata of this program was written by another program.
    Ok(Some(label().unwrap_or(Label { study: String::new(), program: String::new(), first: 0, rows })))
}

/// A part opened for reading by columns.
pub(crate) struct Open {
    reader: SerializedFileReader<File>,
    rows: usize,
}

impl Open {
    /// Opens a part of a study.
    ///
    /// # Errors
    /// Fails if the file cannot be read or its columns differ from those of the study.
    pub(crate) fn new(study: &Study, path: &Path) -> Result<Self, ParquetError> {
        let file = File::open(path)?;
        let reader = SerializedFileReader::new(file)?;
        let metadata = reader.metadata();
        let is_ours = metadata.num_row_groups() == 1
            && metadata.file_metadata().schema_descr().root_schema().get_fields()
                == schema(study)?.get_fields();
        if !is_ours {
            return Err(ParquetError::General("its columns differ from the study".to_owned()));
        }
        let rows = usize::try_from(metadata.file_metadata().num_rows()).unwrap_or(0);
        Ok(Self { reader, rows })
    }

    fn column(&self, place: usize) -> Result<ColumnReader, ParquetError> {
        self.reader.get_row_group(0)?.get_column_reader(place)
    }

    fn read<T: DataType>(&self, place: usize) -> Result<(Vec<T::T>, Vec<i16>), ParquetError> {
        let mut reader = get_typed_column_reader::<T>(self.column(place)?);
        let (mut values, mut levels) = (Vec::new(), Vec::new());
        let mut left = self.rows;
        while left > 0 {
            let (records, ..) = reader.read_records(left, Some(&mut levels), None, &mut values)?;
            if records == 0 {
                return Err(ParquetError::EOF("a column has too few rows".to_owned()));
            }
            left -= records;
        }
        Ok((values, levels))
    }

    /// Reads a result of each case; NaN for cases without the result.
    pub(crate) fn result(&self, study: &Study, result: usize) -> Result<Vec<f64>, ParquetError> {
        let place = 1 + study.design.axes.len() + result;
        let (values, levels) = if study.wanted.get(result).is_some_and(|wanted| wanted.codes.is_some()) {
            let (codes, levels) = self.read::<Int32Type>(place)?;
            (codes.into_iter().map(f64::from).collect(), levels)
        } else {
            self.read::<DoubleType>(place)?
        };
        let mut values = values.into_iter();
        Ok(levels
            .iter()
            .map(|level| if *level > 0 { values.next().unwrap_or(f64::NAN) } else { f64::NAN })
            .collect())
    }

    /// Reads the reason why a case has no results, for each case of the part.
    pub(crate) fn errors(&self, study: &Study) -> Result<Vec<Option<String>>, ParquetError> {
        let (texts, levels) = self.read::<ByteArrayType>(1 + study.design.axes.len() + study.wanted.len())?;
        let mut texts = texts.iter().map(|text| String::from_utf8_lossy(text.data()).into_owned());
        Ok(levels.iter().map(|level| if *level > 0 { texts.next() } else { None }).collect())
    }

    pub(crate) fn rows(&self) -> usize {
        self.rows
    }
}
