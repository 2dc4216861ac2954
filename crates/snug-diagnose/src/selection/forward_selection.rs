//! The way up: rank, add the best, again, until nothing more is justified; then tidy up.

use crate::error::DiagnoseError;
use crate::selection::backward_elimination::{look_at_twins_again, try_removals};
use crate::selection::path::{Climb, Stop, justified};
use crate::selection::search::Search;
use crate::selection::thresholds::MOST_EFFECTS;

impl Search<'_> {
    /// Climbs from the study's own effects as far as the data justify, or until whoever watches ends it.
    pub fn improve(&self) -> Result<Climb, DiagnoseError> {
        let mut climb = self.compare()?;
        let ended = self.ascend(&mut climb);
        climb.until_interrupted(ended)
    }

    /// Rung by rung; `climb` holds those that were reached also where this fails.
    fn ascend(&self, climb: &mut Climb) -> Result<(), DiagnoseError> {
        loop {
            climb.ranking = self.rank(climb.last(), self.settings.control_campaigns)?;
            if climb.additions.len() >= MOST_EFFECTS {
                climb.stopped = Some(Stop::Full);
                break;
            }
            let best = match justified(&climb.ranking, climb.last(), self.settings) {
                Ok(best) => best,
                Err(stop) => {
                    climb.stopped = Some(stop);
                    break;
                }
            };
            let room = MOST_EFFECTS - climb.additions.len();
            for (addition, fitted) in self.choose(climb.last(), &climb.ranking, best, room)? {
                climb.add(addition, self.settled(&fitted)?);
            }
        }
        try_removals(self, climb)?;
        look_at_twins_again(self, climb)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::cases::{Cases, Tally};
    use crate::made_up::{WHOLE, close, noisy};
    use crate::settings::DiagnoseSettings;
    use crate::watch::Watch;
    use snug_identify::FitTask;
    use snug_model::Effect::{self, CubicStiffness};
    use std::sync::atomic::{AtomicBool, Ordering};

    /// Climbs with eight tightenings that were made with `effects`, until `tell` says so.
    fn climbed(effects: &[Effect], sizes: &[f64], ends: impl Fn(&str) -> bool + Sync) -> Climb {
        let cases: Vec<FitTask> = (0..8).map(|n| noisy(n, effects, sizes)).collect();
        let ended = AtomicBool::new(false);
        let tell = |stage: &str| ended.store(ends(stage), Ordering::Relaxed);
        let tally = Tally::default();
        let settings = DiagnoseSettings {
            control_campaigns: 0,
            sign_flips: 999,
            starts: 1,
            ..DiagnoseSettings::default()
        };
        let search = Search {
            cases: Cases::new(&cases, &tally),
            own: &[],
            custom: &[],
            units: WHOLE,
            settings: &settings,
            watch: &Watch::new(&tell).until(&ended),
        };
        search.improve().expect("it can be fitted")
    }

    #[test]
    fn the_climb_adds_the_effect_of_the_data_and_stops_at_the_noise() {
        let climb = climbed(&[CubicStiffness], &[2e6], |_| false);
        let added: Vec<Effect> = climb.additions.iter().map(|one| one.effect).collect();
        assert_eq!(added, [CubicStiffness]);
        assert_eq!(climb.rungs.len(), 2);
        close(climb.last().size(CubicStiffness), 2e6, 0.05);
        assert!(climb.last().is_at_floor(), "{}", climb.last().error());
        assert!(
            !climb.ranking.candidates.is_empty(),
            "what is left was ranked"
        );
        assert!(matches!(
            climb.stopped,
            Some(Stop::NothingSupported { .. } | Stop::TooSmall { .. })
        ));
    }

    /// The second ranking is that beside the first addition: it is not made any more.
    #[test]
    fn a_climb_that_is_ended_keeps_the_rungs_it_reached() {
        let climb = climbed(&[CubicStiffness], &[2e6], |stage| {
            stage.ends_with("the base model")
        });
        assert!(climb.is_interrupted());
        assert_eq!((climb.rungs.len(), climb.additions.len()), (1, 0));
    }

    #[test]
    fn nothing_is_added_to_a_model_that_the_data_were_made_with() {
        let climb = climbed(&[], &[], |_| false);
        assert!(climb.additions.is_empty() && climb.attempts.is_empty());
        assert_eq!(climb.rungs.len(), 1);
        assert!(climb.stopped.is_some() && !climb.is_interrupted());
    }
}
