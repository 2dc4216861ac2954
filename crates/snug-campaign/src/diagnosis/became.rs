//! What became of a rung's candidates once the next effect was in the model.

use crate::diagnosis::result::Diagnosis;

/// What became of a candidate once the next rung's effects were in the model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Became {
    /// It is in that model itself.
    Added,
    /// It was ranked again.
    Ranked {
        /// What it removes then, as a share of the misfit that it was judged by before; no unit.
        share: f64,
        /// Whether the data support it still.
        supported: bool,
    },
    /// It was not ranked again: it cannot stand beside what was added, or nothing was ranked.
    NotRanked,
}

impl Diagnosis {
    /// What became of an effect that was ranked beside the model of a rung (counted from 0), by the next ranking there is.
    pub fn became(&self, rung: usize, effect: &str) -> Became {
        let later = self.ladder.iter().enumerate().skip(rung + 1);
        let last = self.ladder.len().saturating_sub(1);
        let (next, ranking) = later
            .map(|(place, later)| (place, &later.ranking))
            .find(|(_, ranking)| !ranking.is_empty())
            .unwrap_or((last, &self.ranking));
        let (Some(before), Some(after)) = (self.ladder.get(rung), self.ladder.get(next)) else {
            return Became::NotRanked;
        };
        if next > rung && after.effects.iter().any(|known| known == effect) {
            return Became::Added;
        }
        match ranking.iter().find(|one| one.effect == effect) {
            Some(again) if next > rung => Became::Ranked {
                share: again.heldout_gain * after.misfit() / before.misfit(),
                supported: again.supported,
            },
            _ => Became::NotRanked,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnosis::comparison::Comparison;
    use crate::diagnosis::location::Location;
    use crate::diagnosis::noise::NoiseStatement;
    use crate::diagnosis::rung::Rung;
    use crate::diagnosis::verdict::Verdict;
    use crate::diagnosis::work::WorkDone;
    use crate::effect::ranked::RankedEffect;
    use crate::words::sentence::headline::{Headline, Left};

    fn rung(effects: &[&str], error: Option<f64>, ranking: &[(&str, f64, bool)]) -> Rung {
        Rung {
            effects: effects.iter().map(|name| (*name).into()).collect(),
            error_over_noise: error,
            heldout_error_over_noise: error,
            heldout_target_error_over_noise: None,
            heldout_participant_error_over_noise: None,
            rms_fitted_output: 2.0,
            rms_displacement_rad: None,
            fit_percent_median: None,
            selected_fraction: 1.0,
            ranking: ranked(ranking),
        }
    }

    fn ranked(ranking: &[(&str, f64, bool)]) -> Vec<RankedEffect> {
        let one = |(effect, heldout_gain, supported): &(&str, f64, bool)| RankedEffect {
            effect: (*effect).into(),
            kind: "mechanical".into(),
            unlisted: false,
            expression: None,
            parameters: Vec::new(),
            score: 1.0,
            p_family: 0.001,
            heldout_gain: *heldout_gain,
            heldout_gain_error: 0.01,
            error_over_noise: None,
            behind_first: 0.0,
            supported: *supported,
            twins: Vec::new(),
            plausible: true,
            explanation: Vec::new(),
        };
        ranking.iter().map(one).collect()
    }

    fn climbed(ladder: Vec<Rung>, ranking: &[(&str, f64, bool)]) -> Diagnosis {
        Diagnosis {
            verb: "improve".into(),
            verdict: Verdict::Adequate,
            headline: Headline::Unexplained(Left::over_noise(1.0)),
            reasons: Vec::new(),
            stopped: None,
            level: 0.05,
            interrupted: false,
            tightenings: 8,
            noise: NoiseStatement {
                source: "pre_roll".into(),
                acceleration_rad_per_s2: None,
            },
            compared_output: "acceleration".into(),
            added: Vec::new(),
            corrected: Vec::new(),
            ladder,
            ranking: ranked(ranking),
            removals: Vec::new(),
            comparison: Comparison::default(),
            location: Location::default(),
            final_location: None,
            drift: Vec::new(),
            detectability: Vec::new(),
            control: None,
            unlisted: None,
            experiment: None,
            work: WorkDone::default(),
        }
    }

    /// An error of √5 times the noise leaves 4 beyond it, one of √2 leaves 1: half of that is an eighth of the first.
    #[test]
    fn what_a_candidate_still_removes_is_a_share_of_the_misfit_it_was_judged_by() {
        let first = [
            ("spring", 0.75, true),
            ("friction", 0.4, true),
            ("gone", 0.2, true),
        ];
        let ladder = vec![
            rung(&[], Some(5_f64.sqrt()), &first),
            rung(&["spring"], Some(2_f64.sqrt()), &[]),
        ];
        let found = climbed(ladder, &[("friction", 0.5, false)]);
        assert_eq!(found.became(0, "spring"), Became::Added);
        assert_eq!(found.became(0, "gone"), Became::NotRanked);
        let Became::Ranked { share, supported } = found.became(0, "friction") else {
            panic!("it was ranked again")
        };
        assert!((share - 0.125).abs() < 1e-12 && !supported, "{share}");
        assert_eq!(
            found.became(1, "friction"),
            Became::NotRanked,
            "no later ranking"
        );
    }

    #[test]
    fn a_rung_before_which_nothing_was_ranked_is_passed_over() {
        let ladder = vec![
            rung(&[], None, &[("spring", 0.7, true), ("delay", 0.1, true)]),
            rung(&["spring"], None, &[]),
            rung(&["spring", "delay"], None, &[("friction", 0.1, true)]),
            rung(&["spring", "delay", "friction"], None, &[]),
        ];
        let found = climbed(ladder, &[]);
        assert_eq!(found.became(0, "delay"), Became::Added);
        assert_eq!(found.became(2, "friction"), Became::Added);
    }
}
