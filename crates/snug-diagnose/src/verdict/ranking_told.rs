//! A ranking as it is told: every candidate with its size, its evidence, and what these data cannot tell from it.

use crate::data::clusters::Clusters;
use crate::library::{declaration, is_unlisted};
use crate::pooled::fitted::Fitted;
use crate::pooled::sizes::parameters;
use crate::ranking::rank::{Candidate, Ranking};
use crate::selection::path::{misfits, twins};
use crate::settings::DiagnoseSettings;
use crate::verdict::reasons::{Held, explanation};
use snug_campaign::{EffectParameter, RankedEffect};
use snug_identify::FitTask;
use snug_model::Law;

/// A ranking, and the model that it was made beside.
pub(crate) struct RankingTold<'a> {
    pub cases: &'a [FitTask<'a>],
    pub settings: &'a DiagnoseSettings,
    pub beside: &'a Fitted,
    pub ranking: &'a Ranking,
}

impl RankingTold<'_> {
    /// Every candidate, the chosen one first.
    pub fn all(&self, chosen: Option<usize>) -> Vec<RankedEffect> {
        let mut order: Vec<usize> = (0..self.ranking.candidates.len()).collect();
        if let Some(chosen) = chosen {
            order.retain(|&index| index != chosen);
            order.insert(0, chosen);
        }
        let Some(&first) = order.first() else {
            return Vec::new();
        };
        let first = &self.ranking.candidates[first];
        let told = order.iter().map(|&index| self.one(index, first));
        told.collect()
    }

    fn one(&self, index: usize, first: &Candidate) -> RankedEffect {
        let candidate = &self.ranking.candidates[index];
        let sizes = parameters(self.cases, &candidate.fitted, candidate.effect);
        let supported = candidate.is_supported(self.settings);
        let twins = match supported {
            true => twins(self.ranking, index, &Clusters::of(self.cases)),
            false => Vec::new(),
        };
        RankedEffect {
            effect: candidate.effect.name().to_owned(),
            kind: candidate.effect.description().kind.name().to_owned(),
            unlisted: is_unlisted(candidate.effect),
            expression: declaration(candidate.effect).map(|term| term.expression),
            score: candidate.score,
            p_family: candidate.p_family,
            heldout_gain: candidate.share_beside(self.beside),
            heldout_gain_error: candidate.share_error(&misfits(self.beside)),
            error_over_noise: candidate
                .fitted
                .is_weighted
                .then(|| candidate.fitted.error()),
            behind_first: first.ahead_of(candidate),
            supported,
            twins: twins.iter().map(|twin| twin.name().to_owned()).collect(),
            plausible: candidate.fitted.converged
                && sizes.iter().all(EffectParameter::is_plausible),
            explanation: explanation(candidate.effect, &candidate.fitted, Held::of(self.cases)),
            parameters: sizes,
        }
    }
}
