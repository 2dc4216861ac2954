//! An error as a finding about the file that it costs.

use super::IngestError;
use snug_campaign::{Finding, Severity};
use std::path::Path;

impl IngestError {
    /// The finding that says this file was left out.
    pub fn finding(&self) -> Finding {
        let file = match self {
            Self::File { path, .. } => path.file_name(),
            Self::NoSuchPath { path }
            | Self::NotAFile { path, .. }
            | Self::DanglingLink { path }
            | Self::LinkLoop { path }
            | Self::NothingToRead { folder: path, .. } => path.file_name(),
            _ => None,
        };
        Finding {
            severity: Severity::LeftOut,
            code: self.code().to_owned(),
            file: file.unwrap_or_default().to_string_lossy().into_owned(),
            tightening: None,
            channel: self.channel().map(str::to_owned),
            message: match self {
                Self::File { source, .. } => format!("file left out: {source}"),
                other => other.to_string(),
            },
        }
    }

    /// Stable name of the kind of error, as in findings.
    pub fn code(&self) -> &'static str {
        match self {
            Self::File { source, .. } => source.code(),
            Self::NoSuchPath { .. } | Self::NothingToRead { .. } | Self::NoSuchFile { .. } => {
                "missing_data"
            }
            Self::NotAFile { .. } => "not_a_file",
            Self::DanglingLink { .. } => "dangling_link",
            Self::LinkLoop { .. } => "link_loop",
            Self::Setting { .. } | Self::UnitOfSignal { .. } => "bad_setting",
            Self::FormatNotBuilt { .. } => "unknown_format",
            Self::OverBudget { .. } => "over_budget",
            Self::MissingChannel { .. } => "missing_channel",
            Self::UnusableChannel { .. } => "unusable_channel",
            Self::DamagedVariable { channel, .. } if channel != "events" => "unusable_channel",
            Self::EventTable { .. } | Self::DamagedVariable { .. } => "unusable_events",
            Self::NoRows { .. } | Self::NoRecordings { .. } | Self::EmptyFile => "no_data",
            Self::TimeNotRising { .. } | Self::TimeGap { .. } | Self::UnusableRate { .. } => {
                "unusable_time"
            }
            _ => "unreadable_file",
        }
    }

    fn channel(&self) -> Option<&str> {
        match self {
            Self::File { source, .. } => source.channel(),
            Self::MissingChannel { channel, .. } => Some(channel),
            Self::UnusableChannel { variable, .. }
            | Self::DamagedVariable { variable, .. }
            | Self::UnusableRate { variable, .. }
            | Self::EventTable { variable, .. } => Some(variable),
            _ => None,
        }
    }

    /// Whether it would meet every part of the file, rather than this one.
    pub(crate) fn is_of_the_file(&self) -> bool {
        matches!(self, Self::OverBudget { .. } | Self::Read(_))
    }

    /// That a setting of the source cannot be `value`.
    pub(crate) fn setting(
        field: &'static str,
        value: impl ToString,
        allowed: &'static str,
    ) -> Self {
        let value = value.to_string();
        Self::Setting {
            field,
            value,
            allowed,
        }
    }

    /// Adds the file, unless it is already named.
    pub(crate) fn in_file(self, path: &Path) -> Self {
        match self {
            named @ Self::File { .. } => named,
            source => Self::File {
                path: path.to_owned(),
                source: Box::new(source),
            },
        }
    }
}
