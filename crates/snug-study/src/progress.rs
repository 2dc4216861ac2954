/// What a run tells while it works.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ProgressEvent {
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
    /// Results are being written.
    Writing {
        /// Which.
        what: &'static str,
    },
}
