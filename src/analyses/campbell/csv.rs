//! `campbell.csv`, with one row for each branch and speed.

use super::analysis::Report;

impl Report {
    /// The branches as comma-separated values.
    ///
    /// # Errors
    /// [`csv::Error`], which writing to memory does not raise.
    pub fn campbell_csv(&self) -> Result<Vec<u8>, csv::Error> {
        let mut writer = csv::Writer::from_writer(Vec::new());
        writer.write_record([
            "branch",
            "name",
            "rpm",
            "frequency_hz",
            "body_frequency_hz",
            "growth_per_s",
            "krein_sign",
        ])?;
        for branch in &self.campbell.branches {
            for k in 0..branch.rpm.len() {
                writer.write_record([
                    branch.branch.to_string(),
                    branch.name.clone(),
                    branch.rpm[k].to_string(),
                    branch.frequency_hz[k].to_string(),
                    branch.body_frequency_hz[k].to_string(),
                    branch.growth_per_s[k].to_string(),
                    branch.krein_sign[k].to_string(),
                ])?;
            }
        }
        writer
            .into_inner()
            .map_err(|error| error.into_error().into())
    }
}
