//! Results for programs: tables and JSON beside the page.

pub(crate) mod findings_json;
pub(crate) mod json;
pub(crate) mod statistics_json;
pub(crate) mod tightenings_csv;
pub(crate) mod verdict_json;
