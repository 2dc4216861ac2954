//! A diagnosis in a few words: its verdict, and its effects and rungs by name.

use crate::diagnosis::result::Diagnosis;
use crate::diagnosis::verdict::Verdict;
use crate::words::effect_name::{effect_name, label};
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
            _ if self.changes() => "the rig changes while it is measured",
            Verdict::Adequate => "the model is adequate",
            Verdict::MissingEffect => "an effect is missing",
            Verdict::UnlistedEffect => "something is missing that is in no catalogue",
            Verdict::Undecided if is_comparison && is_noise_known => {
                "the model leaves more than the noise"
            }
            Verdict::Undecided if is_comparison => {
                "the model leaves an error, and the noise is not known"
            }
            Verdict::Undecided => match self.headline {
                Headline::MoreThanNoise { .. } => {
                    "more than noise is left, and nothing tried explains it"
                }
                Headline::TooNoisy { .. } => "nothing but noise is left, and too much of it",
                _ => "too little data to say",
            },
            Verdict::NotFitted => "no model was found that fits",
        }
    }

    /// Whether the rig changes while it is measured, and no model follows that.
    pub fn changes(&self) -> bool {
        match &self.headline {
            Headline::Changes { .. } => true,
            Headline::MoreThanNoise { changes, .. } => changes.is_some(),
            _ => false,
        }
    }

    /// An effect as commands and files name it; a term that is in no catalogue by what it is.
    pub fn label(&self, effect: &str) -> String {
        label(effect, self.expression(effect))
    }

    /// An effect as people say it; a term that is in no catalogue by what it is.
    pub fn called(&self, effect: &str) -> String {
        effect_name(&self.label(effect))
    }

    /// Effects as a sentence lists them.
    pub fn names(&self, effects: &[String]) -> String {
        let names = effects.iter().map(|effect| self.called(effect));
        names.collect::<Vec<_>>().join(", ")
    }

    /// What each rung changes against the one before.
    pub fn rung_names(&self) -> Vec<String> {
        let called = |effect: &String| self.called(effect);
        let mut before: &[String] = &[];
        let mut names = Vec::new();
        for (place, rung) in self.ladder.iter().enumerate() {
            let gained = rung.effects.iter().filter(|e| !before.contains(e));
            let lost = before.iter().filter(|e| !rung.effects.contains(e));
            let steps: Vec<String> = gained
                .map(|effect| format!("+ {}", called(effect)))
                .chain(lost.map(|effect| format!("− {}", called(effect))))
                .collect();
            names.push(match (steps.is_empty(), place) {
                (true, 0) => "mass, damper, spring".into(),
                (true, _) => "the same model".into(),
                (false, _) => steps.join(" "),
            });
            before = &rung.effects;
        }
        names
    }
}
