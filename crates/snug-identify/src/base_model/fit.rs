//! The base model fitted to many tightenings side by side.
//!
//! Every tightening has a [`LevenbergMarquardt`] of its own. One sweep over the samples answers what the searches in all lanes of the
//! vector registers ask. A search that has ended gives its lane to the next tightening at once, so a hard fit does not hold
//! the others up. No lane knows its neighbours: a fit has the same bits alone and in any company.

use crate::base_model::thresholds::CLEAR;
use crate::residual::tightening::TighteningResidual;
use snug_campaign::Quantity;
use snug_least_squares::matrix::{entries_at, submatrix_at};
use snug_least_squares::{
    Constraints, DenseResidual, EvaluationError, Fit, LevenbergMarquardt, Query, Residual,
    Settings, SolveError, solve,
};
use snug_model::{LaneTask, NormalEquations, Real, Sweep, in_lanes};

/// The base model's fit of one tightening.
pub(crate) struct BaseFit<'r, 'a> {
    pub residual: &'r mut TighteningResidual<'a>,
    pub start: &'r [f64],
    /// Where the fit begins once more if it comes to nothing from there.
    pub usual_start: &'r [f64],
    pub set: &'r Constraints,
    pub outcome: &'r mut Option<Result<Fit, SolveError>>,
    /// m, c, k and the sums where the search stood last.
    pub latest: &'r mut Option<([f64; 3], NormalEquations)>,
}

/// Fits them all; one by itself needs no vector registers.
pub(crate) fn fit_all(fits: &mut [BaseFit<'_, '_>], quantity: Quantity, settings: &Settings) {
    // A sweep takes the same steps in every lane, and lasts as long as the longest of its records.
    let mut order: Vec<_> = fits.iter_mut().collect();
    order.sort_by_key(|fit| (fit.residual.substeps(), fit.residual.residual_count()));
    for alike in
        order.chunk_by_mut(|one, other| one.residual.substeps() == other.residual.substeps())
    {
        let is_alone = alike.len() == 1;
        let task = SideBySide {
            fits: alike,
            quantity,
            settings,
        };
        if is_alone {
            task.run(0.0);
        } else {
            in_lanes(task);
        }
    }
}

struct SideBySide<'s, 'f, 'r, 'a> {
    fits: &'s mut [&'f mut BaseFit<'r, 'a>],
    quantity: Quantity,
    settings: &'s Settings,
}

impl LaneTask for SideBySide<'_, '_, '_, '_> {
    type Output = ();
    fn run<R: Real>(self, zero: R) {
        let mut sweep = Sweep::new(zero, self.quantity, self.fits[0].residual.substeps());
        let mut waiting = self.fits.iter_mut();
        let mut lanes: Vec<_> = (0..R::LANES).map(|_| None).collect();
        let mut values = vec![[0.0; 3]; R::LANES];
        loop {
            for (lane, occupant) in lanes.iter_mut().enumerate() {
                if occupant.is_none() {
                    *occupant = waiting
                        .by_ref()
                        .find_map(|fit| Some((fit.begin(self.settings)?, fit)));
                    match occupant {
                        Some((_, fit)) => sweep.load(lane, fit.residual.scored()),
                        None => sweep.unload(lane),
                    }
                }
                if let Some((search, fit)) = occupant {
                    values[lane] = fit.values(search);
                }
            }
            if lanes.iter().all(Option::is_none) {
                return;
            }
            for (occupant, found) in lanes.iter_mut().zip(sweep.run(&values)) {
                *occupant = occupant.take().and_then(|(mut search, fit)| {
                    fit.answer(&mut search, &found);
                    fit.go_on(search, self.settings).map(|search| (search, fit))
                });
            }
        }
    }
}

impl<'r> BaseFit<'r, '_> {
    /// The search at its start, or the reason for none as the outcome.
    fn begin<'s>(&mut self, settings: &'s Settings) -> Option<LevenbergMarquardt<'s>>
    where
        'r: 's,
    {
        match LevenbergMarquardt::new(self.start.len(), self.start, self.set, settings) {
            Ok(search) => Some(search),
            Err(error) => {
                *self.outcome = Some(Err(error));
                None
            }
        }
    }

    /// m, c, k where the search wants to know something.
    fn values(&mut self, search: &mut LevenbergMarquardt<'_>) -> [f64; 3] {
        let (Query::Linearization { at, .. }
        | Query::Cost { at }
        | Query::SecondDerivative { at, .. }) = search.query()
        else {
            unreachable!("a search that has ended leaves its lane");
        };
        let all = self.residual.all_values(at);
        [all[0], all[1], all[2]]
    }

    /// Tells the search what a sweep has found.
    fn answer(&mut self, search: &mut LevenbergMarquardt<'_>, found: &NormalEquations) {
        let cost = 0.5 * found.squares;
        let values = self.values(search);
        match search.query() {
            Query::Linearization { into, .. } => {
                let free = self.residual.free();
                let gradient = entries_at(&found.gradient, free);
                let matrix = submatrix_at(&found.matrix, free);
                let outcome = into.set_normal_equations(cost, &gradient, &matrix);
                search.linearized(outcome);
                if self
                    .residual
                    .all_values(search.values())
                    .starts_with(&values)
                {
                    *self.latest = Some((values, *found));
                }
            }
            _ if cost.is_finite() => search.costed(Ok(cost)),
            _ => search.costed(Err(EvaluationError::NotFinite)),
        }
    }

    /// The search, as long as it asks for sweeps; one that has ended leaves its outcome.
    ///
    /// Sweeps know nothing of how a step bends; a search does without, since one more sweep costs less than to find out.
    fn go_on<'s>(
        &mut self,
        mut search: LevenbergMarquardt<'s>,
        settings: &Settings,
    ) -> Option<LevenbergMarquardt<'s>> {
        while let Query::SecondDerivative { .. } = search.query() {
            search.second_derivative_known(Ok(false));
        }
        if !matches!(search.query(), Query::Nothing) {
            return Some(search);
        }
        let fit = search.finish(self.residual.residual_count());
        let is_clear = fit.status.is_converged() && fit.identifiability.condition <= CLEAR;
        *self.outcome = Some(match is_clear {
            true => Ok(fit),
            false => self.again(&fit, settings),
        });
        None
    }

    /// The same fit with J factored by reflections; its work counts beside that of the first attempt.
    fn again(&mut self, first: &Fit, settings: &Settings) -> Result<Fit, SolveError> {
        *self.latest = None;
        let mut problem = DenseResidual::new(&mut *self.residual);
        let mut fit = solve(&mut problem, self.usual_start, self.set, settings)?;
        fit.work.add(&first.work);
        Ok(fit)
    }
}
