//! Whether a search simulates in steps short enough for what it finds, and in how many from sample to sample it would.

use crate::data::cases::Cases;
use crate::error::DiagnoseError;
use crate::library::{is_unlisted, turns_at_once};
use crate::pooled::fit::fit_effects;
use crate::pooled::fitted::Fitted;
use crate::pooled::steps::{friction, resolved};
use crate::ranking::kin::is_simpler;
use crate::ranking::rank::{Candidate, Ranking};
use crate::selection::model_selection::ModelSelection;
use crate::selection::thresholds::{PLAINLY_MORE, RESOLVED};
use snug_identify::FitTask;
use snug_model::{Effect, Law};

/// A model fitted in as many steps from sample to sample as it asks for.
struct Resolved {
    steps: usize,
    squares: f64,
}

/// What a candidate asked for, nothing where it needs no shorter steps, and what it leaves in the present ones.
struct Asked {
    resolved: Option<Resolved>,
    left: f64,
}

impl ModelSelection<'_> {
    /// Ends where a model must be simulated in shorter steps, and this search may ask for them.
    pub(super) fn must_be_resolved(&self, one: &Fitted) -> Result<(), DiagnoseError> {
        let resolved = self.may_ask_for_steps.then(|| self.resolved(one)).flatten();
        ended_with(resolved.map(|resolved| resolved.steps))
    }

    /// The same of what may come in next. One that comes second asks only where, resolved, it leaves plainly less than all that are: what was
    /// fitted to what too long a step makes of it does not, and would be at the edge of the steps again in shorter ones.
    pub(super) fn what_may_come_in_must_be_resolved(
        &self,
        ranking: &Ranking,
    ) -> Result<(), DiagnoseError> {
        if !self.may_ask_for_steps {
            return Ok(());
        }
        let all = &ranking.candidates;
        let may_ask = |place: usize, one: &Candidate| {
            let needs = place < RESOLVED && needs_short_steps(&one.effect);
            needs && !only_bends_to_a_simpler(one, all)
        };
        let supported = (all.iter().enumerate()).filter(|(_, one)| one.is_supported(self.settings));
        let asked: Vec<Asked> = supported
            .map(|(place, one)| Asked {
                resolved: may_ask(place, one)
                    .then(|| self.resolved(&one.fitted))
                    .flatten(),
                left: one.fitted.squares(),
            })
            .collect();
        ended_with(steps_of(&asked))
    }

    /// The model in as many steps as it asks for, fitted again in those as often as it then asks for more; `None` where it asks for none.
    fn resolved(&self, one: &Fitted) -> Option<Resolved> {
        let mut steps = self.asked(self.cases, one)?;
        let mut fitted = one.clone();
        loop {
            let finer: Vec<FitTask> = (self.cases.iter())
                .map(|case| resolved::in_steps(case, steps))
                .collect();
            let cases = self.cases.others(&finer);
            match fit_effects(cases, &one.effects, Some(&fitted), self.clusters) {
                Ok(refitted) => fitted = refitted,
                Err(_) => break,
            }
            match self.asked(cases, &fitted) {
                Some(more) => steps = more,
                None => break,
            }
        }
        let squares = fitted.squares();
        Some(Resolved { steps, squares })
    }

    /// The steps that a model asks for, of `cases` that are simulated in fewer.
    fn asked(&self, cases: Cases<'_>, one: &Fitted) -> Option<usize> {
        match one.effects.iter().any(needs_short_steps) {
            true => resolved::shorter_steps(cases, one),
            // Of a friction in which a load may hide, only where it shows in the simulation, too.
            false => friction::shorter_steps(cases, one)
                .filter(|_| resolved::shorter_steps(cases, one).is_some()),
        }
    }
}

/// In how many steps to begin again, of these candidates from the best.
fn steps_of(all: &[Asked]) -> Option<usize> {
    let least = (all.iter().filter(|one| one.resolved.is_none()))
        .map(|one| one.left)
        .fold(f64::INFINITY, f64::min);
    let must = |(place, one): (usize, &Asked)| {
        let resolved = one.resolved.as_ref()?;
        (place == 0 || PLAINLY_MORE * resolved.squares < least).then_some(resolved.steps)
    };
    all.iter().enumerate().filter_map(must).max()
}

fn ended_with(steps: Option<usize>) -> Result<(), DiagnoseError> {
    steps.map_or(Ok(()), |steps| Err(DiagnoseError::Unresolved { steps }))
}

/// Whether it may ask for shorter steps than the base model: it has a state of its own, or is a law, which may set in within a sample as a stop
/// does. In what steps dry friction, which has no state, is simulated was settled before, and what turns at once turns as that does.
fn needs_short_steps(effect: &Effect) -> bool {
    let may_set_in = is_unlisted(*effect) && !turns_at_once(*effect);
    may_set_in || !effect.description().states.is_empty()
}

/// Whether a simpler one of `all` leaves hardly more than this: what only bends to a simpler one, as a loop that turns at once does to dry
/// friction, would ask for ever shorter steps.
fn only_bends_to_a_simpler(rich: &Candidate, all: &[Candidate]) -> bool {
    let leaves_as_little =
        |simple: &Candidate| simple.fitted.squares() < PLAINLY_MORE * rich.fitted.squares();
    all.iter()
        .any(|simple| is_simpler(simple.effect, rich.effect) && leaves_as_little(simple))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::made_up::candidate;
    use snug_model::Effect::{BoucWen, CoulombFriction, CubicStiffness};

    /// A loop that turns at once is dry friction: where that leaves as little, how soon it turns says nothing of the steps.
    #[test]
    fn what_bends_to_dry_friction_asks_for_no_shorter_steps() {
        let left = |effect, squares: f64| Candidate {
            fitted: Fitted::made_up(&[effect], &[squares; 8], 100),
            ..candidate(effect, 0.01, &[200.0; 8])
        };
        let bends = |simple, squares| {
            let loops = left(BoucWen, 100.0);
            only_bends_to_a_simpler(&loops, &[left(simple, squares), loops.clone()])
        };
        assert!(bends(CoulombFriction, 110.0));
        assert!(!bends(CoulombFriction, 300.0));
        assert!(!bends(CubicStiffness, 100.0));
    }

    /// The first comes in next, so it must be resolved; a later one only where it would come first.
    #[test]
    fn a_later_one_asks_only_where_it_then_leaves_plainly_less() {
        let easy = |left| Asked {
            resolved: None,
            left,
        };
        let hard = |left, steps, squares| Asked {
            resolved: Some(Resolved { steps, squares }),
            left,
        };
        assert_eq!(steps_of(&[easy(100.0), hard(80.0, 8, 90.0)]), None);
        assert_eq!(steps_of(&[easy(100.0), hard(80.0, 8, 70.0)]), Some(8));
        let three = [hard(70.0, 4, 500.0), hard(80.0, 8, 90.0), easy(100.0)];
        assert_eq!(steps_of(&three), Some(4));
        assert_eq!(steps_of(&[easy(1.0), easy(2.0)]), None);
        assert_eq!(steps_of(&[]), None);
    }
}
