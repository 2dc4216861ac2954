//! Makes the embedded campaigns again: `cargo run --release -p snug-synthetic --example fixtures -- fixtures`.

use std::path::Path;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = std::env::args()
        .nth(1)
        .ok_or("which folder? give the fixtures folder as the only argument")?;
    snug_synthetic::fixtures::write(Path::new(&folder))?;
    Ok(())
}
