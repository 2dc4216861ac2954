use snug_campaign::{Finding, Severity};

/// Collects what is found out about one file.
#[derive(Debug)]
pub(crate) struct FindingLog {
    file: String,
    findings: Vec<Finding>,
}

/// Which part of a file a finding is about.
#[derive(Debug, Clone, Copy)]
pub(crate) enum About<'a> {
    File,
    Channel(&'a str),
    Tightening(u32),
}

impl FindingLog {
    pub(crate) fn new(file: &str) -> Self {
        Self {
            file: file.to_owned(),
            findings: Vec::new(),
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

    pub(crate) fn finish(self) -> Vec<Finding> {
        self.findings
    }
}
