//! Reads files in UTF-8, UTF-16 or, for tables, ISO 8859-1, and recognizes files that are not text.

use std::io::Read;
use std::path::{Path, PathBuf};

/// Reason for which a file could not be read as text.
#[derive(Debug, thiserror::Error)]
pub enum FileError {
    /// The system could not open or read the file.
    #[error("cannot read {}: {source}", path.display())]
    Read {
        /// Path of the file.
        path: PathBuf,
        /// The error of the system.
        source: std::io::Error,
    },
    /// The path is that of a directory.
    #[error("{} is a directory; give a file inside it", path.display())]
    Directory {
        /// Path of the directory.
        path: PathBuf,
    },
    /// The file is larger than its kind allows.
    #[error(
        "{} is larger than {limit} bytes; it should be a page of text, so this is probably another file",
        path.display()
    )]
    TooLarge {
        /// Path of the file.
        path: PathBuf,
        /// Largest number of bytes that is allowed.
        limit: u64,
    },
    /// The file does not contain text, or contains text in an encoding that is refused.
    #[error("{} is {kind}", path.display())]
    NotText {
        /// Path of the file.
        path: PathBuf,
        /// Contents of the file, and remedy.
        kind: &'static str,
    },
}

/// Handling of text that is neither UTF-8 nor UTF-16.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OtherEncodings {
    /// The text is refused, as is right for JSON, which is Unicode.
    Refused,
    /// The text is read as ISO 8859-1, for tables: numbers and separators are ASCII in all common encodings, so that
    /// at most the name of a column is wrong.
    AsLatin1,
}

/// Expected properties of a file.
#[derive(Debug, Clone, Copy)]
pub struct Kind {
    /// Largest number of bytes that is allowed.
    pub limit: u64,
    /// Handling of text that is neither UTF-8 nor UTF-16.
    pub other_encodings: OtherEncodings,
}

/// Reads a file as text.
///
/// # Errors
/// [`FileError`] if the file cannot be read, is a directory, is too large, or is not text.
pub fn read_path(path: &Path, kind: Kind) -> Result<String, FileError> {
    let unreadable = |source| FileError::Read {
        path: path.to_owned(),
        source,
    };
    let file = std::fs::File::open(path).map_err(unreadable)?;
    if file.metadata().map_err(unreadable)?.is_dir() {
        return Err(FileError::Directory {
            path: path.to_owned(),
        });
    }
    read_stream(file, path, kind)
}

/// Reads a stream as text; `path` is its name in errors.
///
/// # Errors
/// [`FileError`] if the stream cannot be read, is too large, or is not text.
pub fn read_stream(stream: impl Read, path: &Path, kind: Kind) -> Result<String, FileError> {
    let path = path.to_owned();
    let limit = kind.limit;
    // The limit applies to the bytes that are read, because pipes and devices report no size.
    let mut bytes = Vec::new();
    if let Err(source) = stream.take(limit + 1).read_to_end(&mut bytes) {
        return Err(FileError::Read { path, source });
    }
    if bytes.len() as u64 > limit {
        return Err(FileError::TooLarge { path, limit });
    }
    decode(&bytes, kind.other_encodings).map_err(|kind| FileError::NotText { path, kind })
}

/// First bytes and descriptions of files that users give in place of tables or scenes.
const FOREIGN: [(&[u8], &str); 6] = [
    (
        b"PK\x03\x04",
        "a spreadsheet or another archive (.xlsx, .ods, .zip); save it as CSV in the spreadsheet, or unpack it",
    ),
    (
        b"\xd0\xcf\x11\xe0",
        "an old Office file (.xls); save it as CSV in the spreadsheet",
    ),
    (b"%PDF", "a PDF; give the text file it was made from"),
    (b"\x1f\x8b", "compressed (.gz); unpack it"),
    (
        b"\x89PNG",
        "a picture (.png); give the text file with the numbers",
    ),
    (
        b"PAR1",
        "an Apache Parquet table; give the text file with the numbers",
    ),
];

const BINARY: &str = "not text, but binary; give a file of plain text";
const UNKNOWN_ENCODING: &str = "not UTF-8 or UTF-16 text; save it as UTF-8";
const BROKEN_UTF_16: &str = "broken UTF-16 text; save it as UTF-8";

/// Decodes text and removes the byte order mark, or returns the description of a file that is not text.
fn decode(bytes: &[u8], other_encodings: OtherEncodings) -> Result<String, &'static str> {
    if let Some((_, kind)) = FOREIGN.iter().find(|(magic, _)| bytes.starts_with(magic)) {
        return Err(kind);
    }
    type Unit = fn([u8; 2]) -> u16;
    let (little, big): (Unit, Unit) = (u16::from_le_bytes, u16::from_be_bytes);
    let utf_16 = match bytes {
        [0xff, 0xfe, rest @ ..] => Some((rest, little)),
        [0xfe, 0xff, rest @ ..] => Some((rest, big)),
        // Without a byte order mark, UTF-16 is recognized by its first two characters, which are ASCII, so
        // that one byte of each is zero.
        [1..=255, 0, 1..=255, 0, ..] => Some((bytes, little)),
        [0, 1..=255, 0, 1..=255, ..] => Some((bytes, big)),
        _ => None,
    };
    if let Some((bytes, of_pair)) = utf_16 {
        let (pairs, rest) = bytes.as_chunks::<2>();
        if !rest.is_empty() {
            return Err(BROKEN_UTF_16);
        }
        return char::decode_utf16(pairs.iter().map(|pair| of_pair(*pair)))
            .collect::<Result<String, _>>()
            .map_err(|_| BROKEN_UTF_16);
    }
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    if bytes.contains(&0) {
        return Err(BINARY);
    }
    match (std::str::from_utf8(bytes), other_encodings) {
        (Ok(text), _) => Ok(text.to_owned()),
        (Err(_), OtherEncodings::Refused) => Err(UNKNOWN_ENCODING),
        (Err(_), OtherEncodings::AsLatin1) => {
            Ok(bytes.iter().map(|byte| char::from(*byte)).collect())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The expected bytes were produced by `iconv`.
    #[test]
    fn the_same_text_in_every_encoding() {
        let text = "{\"ä\": z}";
        let cases: [&[u8]; 6] = [
            b"{\"\xc3\xa4\": z}",
            b"\xef\xbb\xbf{\"\xc3\xa4\": z}",
            b"\xff\xfe{\0\"\0\xe4\0\"\0:\0 \0z\0}\0",
            b"\xfe\xff\0{\0\"\0\xe4\0\"\0:\0 \0z\0}",
            b"{\0\"\0\xe4\0\"\0:\0 \0z\0}\0",
            b"{\"\xe4\": z}",
        ];
        for bytes in cases {
            let decoded = decode(bytes, OtherEncodings::AsLatin1);
            assert_eq!(decoded.as_deref(), Ok(text), "{bytes:?}");
        }
        assert_eq!(decode(b"", OtherEncodings::Refused), Ok(String::new()));
        let refused = decode(cases[5], OtherEncodings::Refused);
        assert_eq!(refused, Err(UNKNOWN_ENCODING));
    }

    #[test]
    fn files_without_text_are_recognized() {
        for (bytes, expected) in [
            (&b"PK\x03\x04rest"[..], "save it as CSV"),
            (b"\xd0\xcf\x11\xe0", "save it as CSV"),
            (b"ab\0\0cd", "binary"),
            (b"\xff\xfea", "UTF-16"),
            (b"\xff\xfe\x00\xd8a\0", "UTF-16"),
        ] {
            let kind = decode(bytes, OtherEncodings::AsLatin1).unwrap_err();
            assert!(kind.contains(expected), "{bytes:?}: {kind}");
        }
    }
}
