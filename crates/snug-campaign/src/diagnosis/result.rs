//! A diagnosis: model against measurement, as far as a verb looked.

use crate::diagnosis::comparison::Comparison;
use crate::diagnosis::drift::Drift;
use crate::diagnosis::experiment::Experiment;
use crate::diagnosis::location::Location;
use crate::diagnosis::negative_control::NegativeControl;
use crate::diagnosis::noise::NoiseStatement;
use crate::diagnosis::removal::Removal;
use crate::diagnosis::rung::Rung;
use crate::diagnosis::verdict::Verdict;
use crate::diagnosis::work::WorkDone;
use crate::effect::added::AddedEffect;
use crate::effect::corrected::CorrectedEffect;
use crate::effect::detectability::Detectability;
use crate::effect::ranked::RankedEffect;
use crate::effect::unlisted::UnlistedTerm;
use crate::measurement::quantity::Quantity;
use crate::measurement::signal_units::SignalUnits;
use crate::words::effect_name::Named;
use crate::words::sentence::headline::{Fall, Headline, Left};
use crate::words::sentence::reason::Reason;
use crate::words::sentence::stopped::Stopped;
use serde::Serialize;

/// Model against measurement, as far as a verb looked.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Diagnosis {
    /// `compare`, `diagnose`, `add` or `improve`.
    pub verb: String,
    /// The verdict.
    pub verdict: Verdict,
    /// The verdict, to be said in one sentence.
    pub headline: Headline,
    /// Why.
    pub reasons: Vec<Reason>,
    /// Why nothing more was added; `None` for verbs that add nothing.
    pub stopped: Option<Stopped>,
    /// Family-wise p up to which an effect is believed; no unit.
    pub level: f64,
    /// Whether whoever asked ended the climb: what is told is what was known by then.
    pub interrupted: bool,
    /// Tightenings that took part.
    pub tightenings: usize,
    /// What errors are compared with.
    pub noise: NoiseStatement,
    /// The quantity compared, for example `acceleration`.
    pub compared_output: String,
    /// Effects in the final model.
    pub added: Vec<AddedEffect>,
    /// Effects taken out by preparation.
    pub corrected: Vec<CorrectedEffect>,
    /// The ladder, the study's own model first.
    pub ladder: Vec<Rung>,
    /// Candidates for what the final model still lacks (`diagnose`: what the study's model lacks), best first.
    pub ranking: Vec<RankedEffect>,
    /// Attempts to do without an added term.
    pub removals: Vec<Removal>,
    /// Model against measurement per tightening and pooled, of the study's own model.
    pub comparison: Comparison,
    /// Where the study's own model fails.
    pub location: Location,
    /// Where the final model fails; `None` when it is the study's own.
    pub final_location: Option<Location>,
    /// Drift of fitted m, c, k of the study's own model.
    pub drift: Vec<Drift>,
    /// How large effects not found would have to be.
    pub detectability: Vec<Detectability>,
    /// The negative control; `None` where nothing was ranked.
    pub control: Option<NegativeControl>,
    /// The simplest term for what is unlisted.
    pub unlisted: Option<UnlistedTerm>,
    /// What would tell the winner from its twins.
    pub experiment: Option<Experiment>,
    /// How much work it was.
    pub work: WorkDone,
}

impl Diagnosis {
    /// The formula of a term that is in no catalogue, added or ranked; nothing for an effect that has a name of its own.
    pub fn expression(&self, effect: &str) -> Option<&String> {
        let added = self.added.iter().map(|one| (&one.effect, &one.expression));
        let earlier = self.ladder.iter().flat_map(|rung| &rung.ranking);
        let ranked = self.ranking.iter().chain(earlier);
        let mut known = added.chain(ranked.map(|one| (&one.effect, &one.expression)));
        known.find(|(name, _)| *name == effect)?.1.as_ref()
    }

    /// The same as it is told where whoever asked ended what would have decided between it and another; errors in the `units` of the
    /// `fitted_output`.
    pub fn ended(self, fitted_output: Quantity, units: &SignalUnits) -> Self {
        let left = |rung: Option<&Rung>| match rung.and_then(|rung| rung.error_over_noise) {
            Some(error) => Left::over_noise(error),
            None => {
                let rms = rung.map_or(f64::NAN, |rung| rung.rms_fitted_output);
                Left::of_output(rms, fitted_output, units)
            }
        };
        let named = |one: &AddedEffect| Named {
            effect: one.effect.clone(),
            expression: one.expression.clone(),
            says: None,
            twins: Vec::new(),
        };
        Self {
            verdict: Verdict::Undecided,
            headline: Headline::Stopped {
                added: self.added.iter().map(named).collect(),
                fall: Fall {
                    before: left(self.ladder.first()),
                    after: left(self.ladder.last()),
                },
            },
            interrupted: true,
            ..self
        }
    }
}
