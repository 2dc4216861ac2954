//! Writes the report of an invented campaign into the folder given as argument (a temporary one without).
//! A second argument is the number of tightenings, or `diagnose`, `improve` or `unlisted` for one with a diagnosis.

#[path = "../tests/specimen/mod.rs"]
mod specimen;

#[path = "../tests/diagnosed/mod.rs"]
mod diagnosed;

use std::path::PathBuf;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let folder = (arguments.next())
        .map_or_else(|| std::env::temp_dir().join("snug-specimen"), PathBuf::from);
    let result = match arguments.next().as_deref() {
        None => specimen::campaign(24),
        Some("0") => specimen::empty(),
        Some("diagnose") => diagnosed::diagnose(),
        Some("improve") => diagnosed::improve(),
        Some("unlisted") => diagnosed::unlisted(),
        Some(count) => specimen::campaign(count.parse()?),
    };
    std::fs::create_dir_all(&folder)?;
    for (name, content) in snug_report::files(&result) {
        std::fs::write(folder.join(name), content)?;
    }
    Ok(())
}
