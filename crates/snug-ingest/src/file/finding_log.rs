//! What is found out about one file.

use crate::file::name::name_and_stem;
use snug_campaign::{Finding, Severity};
use std::collections::BTreeMap;
use std::path::Path;

/// Findings of one kind that one file may have; a table of events that is damaged throughout says no more with a million.
const MOST_OF_A_KIND: usize = 1000;

/// Collects what is found out about one file.
#[derive(Debug)]
pub(crate) struct FindingLog {
    file: String,
    findings: Vec<Finding>,
    /// How many of each kind came.
    kinds: BTreeMap<String, (Severity, usize)>,
}

/// Which part of a file a finding is about.
#[derive(Debug, Clone, Copy)]
pub(crate) enum About<'a> {
    File,
    Channel(&'a str),
    Tightening(u32),
}

impl FindingLog {
    /// For the file at `path`.
    pub(crate) fn new(path: &Path) -> Self {
        Self {
            file: name_and_stem(path).0,
            findings: Vec::new(),
            kinds: BTreeMap::new(),
        }
    }

    pub(crate) fn note(&mut self, code: &str, about: About<'_>, message: String) {
        self.put(Severity::Note, code, about, message);
    }

    pub(crate) fn repaired(&mut self, code: &str, about: About<'_>, message: String) {
        self.put(Severity::Repaired, code, about, message);
    }

    pub(crate) fn left_out(&mut self, code: &str, about: About<'_>, message: String) {
        self.put(Severity::LeftOut, code, about, message);
    }

    fn put(&mut self, severity: Severity, code: &str, about: About<'_>, message: String) {
        tracing::debug!(file = self.file, code, message, "finding");
        let kind = self.kinds.entry(code.to_owned()).or_insert((severity, 0));
        kind.1 += 1;
        if kind.1 > MOST_OF_A_KIND {
            return;
        }
        self.findings.push(Finding {
            severity,
            code: code.to_owned(),
            file: self.file.clone(),
            tightening: match about {
                About::Tightening(number) => Some(number),
                _ => None,
            },
            channel: match about {
                About::Channel(name) => Some(name.to_owned()),
                _ => None,
            },
            message,
        });
    }

    pub(crate) fn finish(mut self) -> Vec<Finding> {
        for (code, (severity, count)) in self.kinds {
            if count > MOST_OF_A_KIND {
                self.findings.push(Finding {
                    severity,
                    code,
                    file: self.file.clone(),
                    tightening: None,
                    channel: None,
                    message: format!(
                        "{} more of the same kind, which are not listed one by one",
                        count - MOST_OF_A_KIND
                    ),
                });
            }
        }
        self.findings
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_flood_is_counted() {
        let mut log = FindingLog::new("x.mat".as_ref());
        for number in 1..=1500 {
            log.note("a", About::Tightening(number), String::new());
        }
        log.note("b", About::File, String::new());
        let findings = log.finish();
        assert_eq!(findings.len(), 1002);
        assert!(findings[1001].message.starts_with("500 more"));
    }
}
