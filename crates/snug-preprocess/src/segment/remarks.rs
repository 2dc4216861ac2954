//! What every step writes its findings to, so that they carry the tightening's name and its rejection is not forgotten.

use crate::segment::channel::Channel;
use snug_campaign::{Finding, Severity, TighteningId};

/// Collects the findings of one tightening while it is prepared.
#[derive(Debug)]
pub(crate) struct Remarks {
    id: TighteningId,
    findings: Vec<Finding>,
    rejects: bool,
}

impl Remarks {
    pub(crate) fn new(id: TighteningId) -> Self {
        Self {
            id,
            findings: Vec::new(),
            rejects: false,
        }
    }

    /// Something worth knowing; nothing is changed.
    pub(crate) fn note(&mut self, code: &str, channel: Option<Channel>, message: String) {
        self.push(Severity::Note, code, channel, message);
    }

    /// Something that was mended.
    pub(crate) fn repaired(&mut self, code: &str, channel: Option<Channel>, message: String) {
        self.push(Severity::Repaired, code, channel, message);
    }

    /// Data beside the tightening that are not used; the tightening itself is.
    pub(crate) fn lost(&mut self, code: &str, channel: Option<Channel>, message: String) {
        self.push(Severity::LeftOut, code, channel, message);
    }

    /// A fault that keeps the tightening out of the statistics, although it can still be fitted.
    pub(crate) fn reject(&mut self, code: &str, channel: Option<Channel>, message: String) {
        self.push(Severity::LeftOut, code, channel, message);
        self.rejects = true;
    }

    /// The finding that ends the preparation: nothing usable remains.
    pub(crate) fn left_out(
        &self,
        code: &str,
        channel: Option<Channel>,
        message: String,
    ) -> Finding {
        self.finding(Severity::LeftOut, code, channel, message)
    }

    pub(crate) fn rejects(&self) -> bool {
        self.rejects
    }

    pub(crate) fn id(&self) -> &TighteningId {
        &self.id
    }

    pub(crate) fn into_findings(self) -> Vec<Finding> {
        self.findings
    }

    fn push(&mut self, severity: Severity, code: &str, channel: Option<Channel>, message: String) {
        let finding = self.finding(severity, code, channel, message);
        self.findings.push(finding);
    }

    fn finding(
        &self,
        severity: Severity,
        code: &str,
        channel: Option<Channel>,
        message: String,
    ) -> Finding {
        Finding {
            severity,
            code: code.to_owned(),
            file: self.id.file.clone(),
            tightening: Some(self.id.number),
            channel: channel.map(|channel| channel.name().to_owned()),
            message,
        }
    }
}
