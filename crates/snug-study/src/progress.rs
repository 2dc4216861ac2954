//! What whoever watches a run is told; how it is shown is theirs to decide.

/// What a run tells while it works.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ProgressEvent<'a> {
    /// The files are listed.
    Started {
        /// How many.
        files: usize,
    },
    /// One more file is evaluated.
    FileDone {
        /// Tightenings evaluated so far.
        tightenings: usize,
    },
    /// A stage of a diagnosis begins.
    Stage {
        /// Which.
        what: &'a str,
    },
    /// The stage at hand fits candidates.
    Candidates {
        /// How many.
        of: usize,
    },
    /// One more candidate is fitted.
    CandidateDone,
    /// Results are being written.
    Writing {
        /// Which.
        what: &'a str,
    },
}
