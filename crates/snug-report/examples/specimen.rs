//! Writes the report of an invented campaign into the folder given as argument (`specimen` without one).
//! A second argument is the number of tightenings.

#[path = "../tests/specimen/mod.rs"]
mod specimen;

use std::path::PathBuf;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let folder = PathBuf::from(arguments.next().unwrap_or_else(|| "specimen".into()));
    let count = arguments.next().map_or(Ok(24), |text| text.parse())?;
    let result = match count {
        0 => specimen::empty(),
        count => specimen::campaign(count),
    };
    snug_report::write(&folder, &result)?;
    Ok(())
}
