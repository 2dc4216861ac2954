//! A campaign as one HTML page, CSV and JSON.
#![doc = include_str!("../README.md")]

mod curves;
mod figure;
mod grouping;
mod page;
mod quartiles;
mod section;
mod tables;
pub mod viewer;
mod words;

pub use page::html;
pub use tables::findings_json::findings_json;
pub use tables::statistics_json::statistics_json;
pub use tables::tightenings_csv::tightenings_csv;
pub use tables::verdict_json::verdict_json;
pub use words::machine_words::markup;

use snug_campaign::CampaignResult;

/// Every file of a report: `report.html`, `tightenings.csv`, `statistics.json`, `findings.json` and, when the result has a
/// diagnosis, `verdict.json`; each a name and its whole content.
pub fn files(result: &CampaignResult) -> Vec<(&'static str, String)> {
    let mut files = vec![
        ("report.html", html(result)),
        ("tightenings.csv", tightenings_csv(result)),
        ("statistics.json", statistics_json(result)),
        ("findings.json", findings_json(result)),
    ];
    if let Some(diagnosis) = &result.diagnosis {
        files.push(("verdict.json", verdict_json(diagnosis, result.vocabulary)));
    }
    files
}
