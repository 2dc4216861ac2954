//! A diagnosis in a few words: its verdict.

use crate::diagnosis::result::Diagnosis;
use crate::diagnosis::verdict::Verdict;
use crate::words::sentence::headline::Headline;

impl Diagnosis {
    /// The verdict in a few words.
    pub fn word(&self) -> &'static str {
        let mut rungs = self.ladder.iter();
        let is_noise_known = rungs.any(|rung| rung.error_over_noise.is_some());
        // A comparison asks how much is missing, not what.
        let is_comparison = self.verb == "compare";
        match self.verdict {
            _ if self.interrupted => "stopped before there was a verdict",
            Verdict::Adequate => "the model is adequate",
            Verdict::MissingEffect => "an effect is missing",
            Verdict::UnlistedEffect => "something is missing that is in no catalogue",
            Verdict::Undecided if is_comparison && is_noise_known => {
                "the model leaves more than the noise"
            }
            Verdict::Undecided if is_comparison => {
                "the model leaves an error, and the noise is not known"
            }
            Verdict::Undecided if matches!(self.headline, Headline::MoreThanNoise { .. }) => {
                "more than noise is left, and nothing tried explains it"
            }
            Verdict::Undecided => "too little data to say",
            Verdict::NotFitted => "no model was found that fits",
        }
    }
}
