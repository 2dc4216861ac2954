//! Settings that preprocessing refuses before it looks at any data.

use thiserror::Error;

/// Why preprocessing could not start. Faults of the data are findings instead.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum PreprocessError {
    /// A setting lies outside what is allowed.
    #[error("setting `{setting}` is {value}; allowed: {allowed}")]
    SettingOutOfRange {
        /// Path of the setting, for example `window.length_s`.
        setting: &'static str,
        /// Its value.
        value: f64,
        /// What is allowed, in words.
        allowed: &'static str,
    },
    /// The `thesis` preset was asked for on segments without a pulse window.
    #[error("preset `Thesis` needs `window: Pulse(…)`; `Whole` has no window to cut")]
    ThesisWithoutWindow,
    /// The `thesis` preset was asked for on a part of every window.
    #[error(
        "preset `Thesis` takes whole windows, as the original program does; leave `stretch` out"
    )]
    ThesisWithStretch,
}

/// Checks that `minimum` ≤ `value` ≤ `maximum`; not-a-number is never in range.
pub(crate) fn in_range(
    setting: &'static str,
    value: f64,
    minimum: f64,
    maximum: f64,
    allowed: &'static str,
) -> Result<(), PreprocessError> {
    if (minimum..=maximum).contains(&value) {
        Ok(())
    } else {
        Err(PreprocessError::SettingOutOfRange {
            setting,
            value,
            allowed,
        })
    }
}
