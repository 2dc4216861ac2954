#![doc = include_str!("../README.md")]

mod curves;
mod decimation;
mod effect_words;
mod figure;
mod findings_json;
mod group_strip;
mod grouping;
mod json;
mod machine_words;
mod number;
mod outcome;
mod page;
mod quantity;
mod quartiles;
mod section;
mod signal_unit;
mod statistics_json;
mod tightenings_csv;
mod traces_json;
mod verdict_json;
pub mod viewer;

pub use findings_json::findings_json;
pub use machine_words::markup;
pub use page::html;
pub use statistics_json::statistics_json;
pub use tightenings_csv::tightenings_csv;
pub use verdict_json::verdict_json;

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
