//! JSON schemas of the reports, for programs in other languages.

use schemars::JsonSchema;
use schemars::generate::SchemaSettings;
use serde_json::{Value, json};

use super::{
    CheckReport, CompareReport, CutReport, DeflectReport, FitReport, GapReport, MapReport,
    ModeEntry, PlaceReport, Report, ResponseReport, RunUpReport, WashboardReport,
};
use crate::stability::Setting;
use crate::study::StudyReport;

/// The JSON schema of each report, by the command that writes it; `modes` is that of the list of modes at one
/// speed.
pub fn json_schema() -> Value {
    json!({
        "analyze": of::<Report>(),
        "check": of::<CheckReport>(),
        "compare": of::<CompareReport>(),
        "cut": of::<CutReport>(),
        "deflect": of::<DeflectReport>(),
        "gap": of::<GapReport>(),
        "fit": of::<FitReport>(),
        "map": of::<MapReport>(),
        "modes": of::<Vec<ModeEntry>>(),
        "place": of::<PlaceReport>(),
        "response": of::<ResponseReport>(),
        "runup": of::<RunUpReport>(),
        "study": of::<StudyReport>(),
        "tradeoff": of::<Vec<Setting>>(),
        "washboard": of::<WashboardReport>(),
    })
}

/// The schema of a report as written, in which keys that are always present are required.
fn of<T: JsonSchema>() -> Value {
    let settings = SchemaSettings::default().for_serialize();
    settings
        .into_generator()
        .into_root_schema_for::<T>()
        .to_value()
}
