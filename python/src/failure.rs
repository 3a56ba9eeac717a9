//! Reasons of a failed computation, and the Python exceptions for them.

use pyo3::exceptions::{PyIsADirectoryError, PyOSError, PyRuntimeError};
use pyo3::prelude::*;
use pyo3::types::PyType;
use sawflutter::analyses::compare::CompareError;
use sawflutter::analyses::door::CommandError;
use sawflutter::analyses::study::{LogError, StudyError};
use sawflutter::page::figure::FigureError;

use sawflutter::model::scene::{RefusedValue, SceneError};
use sawflutter::modes::SpectrumError;
use sawflutter::motion::stretched_blade::StretchedError;
use sawflutter::page::text::FileError;
use sawflutter::stability::{AnalysisError, SensitivityError};

/// Reason of a failed computation.
#[derive(Debug)]
pub enum Failure {
    /// The input is refused.
    Refused(Box<Refusal>),
    /// A file cannot be read.
    Unreadable(std::io::Error, String),
    /// A file is a folder.
    Directory(String),
    /// The computation failed.
    Failed(String),
    /// The library has a fault.
    Fault(String),
}

/// The error of an input, for the attributes of the exception.
#[derive(Debug)]
pub struct Refusal {
    /// Name of the exception in `sawflutter.errors`.
    pub class: &'static str,
    pub message: String,
    pub key: Option<String>,
    pub value: Option<String>,
    pub allowed: Option<String>,
    pub remedy: Option<String>,
}

impl Refusal {
    /// An error with a message only.
    pub fn saying(class: &'static str, message: impl ToString, key: Option<String>) -> Failure {
        Failure::Refused(Box::new(Refusal {
            class,
            message: message.to_string(),
            key,
            value: None,
            allowed: None,
            remedy: None,
        }))
    }
}

impl Failure {
    /// An argument of a method that is out of range.
    pub fn argument(
        key: &str,
        value: impl ToString,
        allowed: String,
        remedy: &'static str,
    ) -> Self {
        let (key, value) = (key.to_owned(), value.to_string());
        RefusedValue {
            key,
            value,
            allowed,
            remedy: remedy.into(),
        }
        .into()
    }
}

impl From<RefusedValue> for Failure {
    fn from(refused: RefusedValue) -> Self {
        value("ArgumentError", refused)
    }
}

/// A value that cannot be used, for an exception of this name.
fn value(class: &'static str, refused: RefusedValue) -> Failure {
    Failure::Refused(Box::new(Refusal {
        class,
        message: refused.to_string(),
        key: Some(refused.key),
        value: Some(refused.value),
        allowed: Some(refused.allowed),
        remedy: Some(refused.remedy.into_string()),
    }))
}

impl From<SceneError> for Failure {
    fn from(error: SceneError) -> Self {
        let message = error.to_string();
        let class = "SceneError";
        match error {
            SceneError::File(source) => file(class, source),
            SceneError::Syntax {
                key,
                message,
                allowed,
                remedy,
            } => syntax(class, key, &message, [allowed, remedy]),
            SceneError::Value(refused) => value(class, refused),
            _ => Refusal::saying(class, message, None),
        }
    }
}

/// A key or a value that is no part of a scene or a study.
fn syntax(
    class: &'static str,
    key: String,
    message: &str,
    [allowed, remedy]: [Option<String>; 2],
) -> Failure {
    // The text is a single generated line, so its line number is meaningless to the user.
    let message = message.replace(" (line 1)", "");
    Failure::Refused(Box::new(Refusal {
        class,
        message: format!("{key}: {message}"),
        key: Some(key),
        value: None,
        allowed,
        remedy,
    }))
}

/// A file whose text cannot be read.
pub fn file(class: &'static str, error: FileError) -> Failure {
    let message = error.to_string();
    match error {
        FileError::Read { source, .. } => Failure::Unreadable(source, message),
        FileError::Directory { .. } => Failure::Directory(message),
        _ => Refusal::saying(class, message, None),
    }
}

impl From<StudyError> for Failure {
    fn from(error: StudyError) -> Self {
        let message = error.to_string();
        let class = "StudyError";
        match error {
            StudyError::Syntax {
                key,
                message,
                allowed,
                remedy,
            } => syntax(class, key, &message, [allowed, remedy]),
            StudyError::Value(refused) => value(class, refused),
            StudyError::Scene { key, source } => match Failure::from(source) {
                Failure::Refused(refusal) => Failure::Refused(Box::new(Refusal {
                    message,
                    key: Some(key),
                    ..*refusal
                })),
                other => other,
            },
            StudyError::Nominal(source) => source.into(),
            StudyError::Kept(source) => Failure::Unreadable(source, message),
        }
    }
}

impl From<CommandError> for Failure {
    fn from(error: CommandError) -> Self {
        match error {
            CommandError::Refused(refused) => refused.into(),
            CommandError::Set { source, .. } | CommandError::Scene(source) => source.into(),
            CommandError::Unanswered { key, message } => {
                let class = if key.is_some() {
                    "SceneError"
                } else {
                    "ArgumentError"
                };
                Refusal::saying(class, message, key.map(str::to_owned))
            }
            CommandError::Failed(error) => Failure::Failed(error.to_string()),
        }
    }
}

impl From<LogError> for Failure {
    fn from(error: LogError) -> Self {
        let message = error.to_string();
        match error {
            LogError::Io { source, .. } | LogError::Tables(source) => {
                Failure::Unreadable(source, message)
            }
            _ => Refusal::saying("StudyError", message, None),
        }
    }
}

/// Conversions of errors whose message is complete.
macro_rules! failed {
    ($($error:ty),*) => {
        $(impl From<$error> for Failure {
            fn from(error: $error) -> Self {
                Failure::Failed(error.to_string())
            }
        })*
    };
}
failed!(
    CompareError,
    StretchedError,
    AnalysisError,
    SensitivityError,
    SpectrumError,
    FigureError,
    serde_json::Error
);

impl From<Failure> for PyErr {
    fn from(failure: Failure) -> Self {
        Python::attach(|py| exception(py, failure).unwrap_or_else(|error| error))
    }
}

fn exception(py: Python<'_>, failure: Failure) -> PyResult<PyErr> {
    let class = |name: &str| -> PyResult<Bound<'_, PyType>> {
        let class = py.import("sawflutter.errors")?.getattr(name)?;
        Ok(class.cast_into::<PyType>()?)
    };
    Ok(match failure {
        Failure::Refused(refusal) => PyErr::from_type(
            class(refusal.class)?,
            (
                refusal.message,
                refusal.key,
                refusal.value,
                refusal.allowed,
                refusal.remedy,
            ),
        ),
        // Python derives FileNotFoundError and similar exceptions from the number.
        Failure::Unreadable(source, message) => match source.raw_os_error() {
            Some(number) => PyOSError::new_err((number, message)),
            None => PyOSError::new_err(message),
        },
        Failure::Directory(message) => PyIsADirectoryError::new_err(message),
        Failure::Failed(message) => PyErr::from_type(class("AnalysisError")?, (message,)),
        Failure::Fault(message) => PyRuntimeError::new_err(message),
    })
}
