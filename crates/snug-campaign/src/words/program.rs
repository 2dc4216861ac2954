//! What people type before a verb when a text recommends a command: `snug`, or what the program that was started is called.

use std::sync::OnceLock;

/// The environment variable by which a program tells one that it starts what people typed: `cargo xtask`.
pub const VARIABLE: &str = "SNUG_PROGRAM";

/// What the installed program is called.
const INSTALLED: &str = "snug";

static PROGRAM: OnceLock<&'static str> = OnceLock::new();

/// What people type before a verb, as in `snug run --data DIR`.
pub fn program() -> &'static str {
    PROGRAM.get().copied().unwrap_or(INSTALLED)
}

/// Names the program that people started. It does so once, before it says anything; a second name is not taken.
pub fn set_program(name: &'static str) {
    PROGRAM.set(name).ok();
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_name_stays() {
        assert_eq!(program(), "snug");
        set_program("cargo xtask");
        set_program("another");
        assert_eq!(program(), "cargo xtask");
    }
}
