//! Forward selection: rank, add the best, again, until nothing more is justified; then backward elimination.

use crate::error::DiagnoseError;
use crate::question::Begun;
use crate::rung_model::RungModel;
use crate::selection::backward_elimination::{look_at_twins_again, prefer_simpler, try_removals};
use crate::selection::may_be_nothing::take_out_what_may_be_nothing;
use crate::selection::model_selection::{ModelSelection, Step};
use crate::selection::path::{SelectionPath, Stop, justified};
use crate::selection::thresholds::{MOST_EFFECTS, SMALL};

impl ModelSelection<'_> {
    /// Adds to the study's own effects, begun with those others `from` which the way is known to lead that are supported beside those before or
    /// take much, as far as the data justify, or until whoever watches ends it.
    pub fn improve(
        &self,
        from: &[Begun],
        mut path: SelectionPath,
    ) -> Result<SelectionPath, DiagnoseError> {
        let least = SMALL * path.rungs[0].squares();
        let others = from.iter().filter(|one| !self.own.contains(&one.effect));
        let others: Vec<Begun> = others.cloned().collect();
        let put_in = self.put_in(&others, &mut path, |candidate, falls| {
            candidate.is_supported(self.settings) || falls > least
        });
        let ended = put_in.and_then(|()| self.add_justified(&mut path));
        path.until_interrupted(ended)
    }

    /// Rung by rung; `path` holds those that were reached also where this fails.
    fn add_justified(&self, path: &mut SelectionPath) -> Result<(), DiagnoseError> {
        self.go_on(path)?;
        let Some((place, law)) = self.one_law(path)? else {
            return Ok(());
        };
        path.go_back_to(place);
        self.go_up(path, vec![law])?;
        match self.is_enough(path) {
            true => Ok(()),
            false => self.go_on(path),
        }
    }

    /// Whether beside the last model nothing more is asked for.
    fn is_enough(&self, path: &SelectionPath) -> bool {
        let model = || RungModel::of(&self.cases, path.last());
        self.until
            .is_some_and(|until| until.is_reached_by(&model()))
    }

    /// To all that the data justify, or to a model beside which nothing more is asked for.
    fn go_on(&self, path: &mut SelectionPath) -> Result<(), DiagnoseError> {
        loop {
            self.rank_last(path)?;
            if path.additions.len() >= MOST_EFFECTS {
                path.stopped = Some(Stop::Full);
                break;
            }
            let next = justified(&path.ranking, path.last(), &path.rungs[0], self.settings);
            if let Some(by_group) = self.last_by_group(path, next.ok())? {
                path.replace_last(by_group);
                continue;
            }
            let best = match next {
                Ok(best) => best,
                Err(stop) => match self.two_at_once(path)? {
                    Some(steps) => {
                        self.go_up(path, steps)?;
                        continue;
                    }
                    None => {
                        path.stopped = Some(stop);
                        break;
                    }
                },
            };
            let room = MOST_EFFECTS - path.additions.len();
            let steps = self.choose(path.last(), &path.ranking, best, room)?;
            self.go_up(path, steps)?;
            if let Some((place, law)) = self.plainly_one_law(path)? {
                path.go_back_to(place);
                self.go_up(path, vec![law])?;
            }
            if self.is_enough(path) {
                return Ok(());
            }
        }
        try_removals(self, path)?;
        prefer_simpler(self, path)?;
        look_at_twins_again(self, path)
    }

    fn go_up(&self, path: &mut SelectionPath, steps: Vec<Step>) -> Result<(), DiagnoseError> {
        for (addition, fitted) in steps {
            path.add(addition, self.settled(&fitted)?);
        }
        self.exchange_kin(path)?;
        take_out_what_may_be_nothing(self, path, 2)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::cases::{Cases, Tally};
    use crate::data::watch::Watch;
    use crate::pooled::sharing::Sharing;
    use crate::question::Until;
    use crate::tests::made_up::{WHOLE, close, noisy, quick, with_selection};
    use snug_identify::FitTask;
    use snug_model::Effect::{self, CubicStiffness};
    use std::sync::atomic::{AtomicBool, Ordering};

    /// Selects with eight tightenings that were made with `effects`, until `tell` says so.
    fn selected(
        effects: &[Effect],
        sizes: &[f64],
        ends: impl Fn(&str) -> bool + Sync,
    ) -> SelectionPath {
        selected_until(None, effects, sizes, ends)
    }

    fn selected_until(
        until: Option<&Until<'_>>,
        effects: &[Effect],
        sizes: &[f64],
        ends: impl Fn(&str) -> bool + Sync,
    ) -> SelectionPath {
        let cases: Vec<FitTask> = (0..8).map(|n| noisy(n, effects, sizes)).collect();
        let ended = AtomicBool::new(false);
        let tell = |stage: &str| ended.store(ends(stage), Ordering::Relaxed);
        let tally = Tally::default();
        let settings = quick(999);
        let selection = ModelSelection {
            cases: Cases::new(&cases, &tally),
            own: &[],
            sharing: &Sharing::default(),
            custom: &[],
            clusters: WHOLE,
            settings: &settings,
            watch: &Watch::new(&tell).until(&ended),
            may_ask_for_steps: false,
            until,
        };
        let path = selection.compare().expect("it can be fitted");
        selection.improve(&[], path).expect("it can be fitted")
    }

    #[test]
    fn the_selection_adds_the_effect_of_the_data_and_stops_at_the_noise() {
        let path = selected(&[CubicStiffness], &[2e6], |_| false);
        let added: Vec<Effect> = path.additions.iter().map(|one| one.effect).collect();
        assert_eq!(added, [CubicStiffness]);
        assert_eq!(path.rungs.len(), 2);
        close(path.last().size(CubicStiffness), 2e6, 0.05);
        assert!(path.last().is_at_floor(), "{}", path.last().error());
        assert!(
            !path.ranking.candidates.is_empty(),
            "what is left was ranked"
        );
        let [Some(first)] = &path.ranked[..] else {
            panic!("what was ranked beside the first model is kept")
        };
        assert!(first.beside.effects.is_empty());
        let mut tried = first.ranking.candidates.iter();
        assert!(tried.any(|one| one.effect == CubicStiffness));
        assert!(matches!(
            path.stopped,
            Some(Stop::NothingSupported { .. } | Stop::TooSmall { .. })
        ));
    }

    #[test]
    fn a_selection_looks_no_further_than_it_is_asked_to() {
        for is_enough in [true, false] {
            let cubic = |model: &RungModel| is_enough && model.effects == ["cubic_stiffness"];
            let until = Until::new(&cubic);
            let path = selected_until(Some(&until), &[CubicStiffness], &[2e6], |_| false);
            assert_eq!(path.last().effects, [CubicStiffness]);
            assert_eq!(until.is_reached(), is_enough);
            assert_eq!(path.ranking.candidates.is_empty(), is_enough);
            assert_eq!(path.stopped.is_none(), is_enough);
        }
    }

    /// As a search is taken up again that began with it.
    #[test]
    fn a_way_that_begins_with_the_studys_own_effect_does_not_add_it_again() {
        let cases: Vec<FitTask> = (0..8)
            .map(|number| noisy(number, &[CubicStiffness], &[2e6]))
            .collect();
        with_selection(&cases, &quick(999), |selection| {
            let own = [CubicStiffness];
            let selection = ModelSelection {
                own: &own,
                ..*selection
            };
            let path = selection.compare().expect("it can be fitted");
            let path = selection.improve(&own.map(Begun::as_usual), path);
            let path = path.expect("it goes on");
            assert_eq!(path.last().effects, own);
            assert!(path.additions.is_empty());
        });
    }

    /// The second ranking is that beside the first addition: it is not made any more.
    #[test]
    fn a_selection_that_is_ended_keeps_the_rungs_it_reached() {
        let path = selected(&[CubicStiffness], &[2e6], |stage| {
            stage.ends_with("the base model")
        });
        assert!(path.is_interrupted());
        assert_eq!((path.rungs.len(), path.additions.len()), (1, 0));
    }

    #[test]
    fn nothing_is_added_to_a_model_that_the_data_were_made_with() {
        let path = selected(&[], &[], |_| false);
        assert!(path.additions.is_empty() && path.attempts.is_empty());
        assert_eq!(path.rungs.len(), 1);
        assert!(path.stopped.is_some() && !path.is_interrupted());
    }
}
