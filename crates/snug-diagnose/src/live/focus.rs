//! A closer look: some of the tightenings, or some samples of each, under the models that were fitted to all.
//!
//! A model's own parameters follow over the whole window whatever counts: samples of a stretch alone they could follow almost
//! whatever happens there, and nothing would be missing.

use super::cases::LiveCases;
use super::fit::LiveFit;
use super::promise::shares;
use crate::data::cases::{Cases, Tally};
use crate::data::clusters::Clusters;
use crate::error::DiagnoseError;
use crate::pooled::fitted::Fitted;
use crate::pooled::model::{PooledModel, Room};
use crate::ranking::score_test::{Control, Scorer};
use snug_identify::{FitTask, IdentifyError};
use snug_least_squares::PooledSettings;
use snug_model::Effect;
use std::ops::{Range, RangeInclusive};

/// Which tightenings, and which of their samples count.
#[derive(Debug, Clone, PartialEq)]
pub struct Focus {
    /// Numbers of [`LiveCases::tasks`].
    pub members: Vec<usize>,
    /// What of each counts.
    pub counted: Counted,
}

/// Samples that count.
#[derive(Debug, Clone, PartialEq)]
pub enum Counted {
    /// All of them.
    All,
    /// A stretch of every window, by its samples.
    Stretch(Range<usize>),
    /// Those in which the grip is there and moves so fast, as measured: a cell of the map of the missing force.
    Cell {
        /// Displacement of the grip \[m\].
        x_m: RangeInclusive<f64>,
        /// Velocity of the grip \[m/s\].
        v_m_per_s: RangeInclusive<f64>,
    },
}

impl Counted {
    /// Of every sample of a tightening's window whether it counts; `None` where all do.
    fn of(&self, task: &FitTask<'_>) -> Option<Vec<bool>> {
        let samples = task.measured().len();
        match self {
            Self::All => None,
            Self::Stretch(stretch) => Some((0..samples).map(|at| stretch.contains(&at)).collect()),
            Self::Cell { x_m, v_m_per_s } => {
                let (motion, l) = (&task.tightening.motion, task.tightening.rig.lever_arm_m);
                let measured = |signal: &Option<Vec<f64>>, at: usize| -> Option<f64> {
                    Some(l * signal.as_ref()?.get(at)?)
                };
                let is_there = |at: usize| {
                    let x = measured(&motion.displacement_rad, at);
                    let v = measured(&motion.velocity_rad_per_s, at);
                    x.is_some_and(|x| x_m.contains(&x)) && v.is_some_and(|v| v_m_per_s.contains(&v))
                };
                Some((0..samples).map(is_there).collect())
            }
        }
    }
}

/// The tightenings of a focus, with two models as they are on these.
pub struct CloserLook {
    cases: LiveCases,
    /// Of every residual of each tightening whether it counts; `None` where all do.
    counted: Option<Vec<Vec<bool>>>,
    base: Fitted,
    now: Fitted,
    /// Σ r² that each leaves, and of how many.
    left: [f64; 2],
    count: usize,
}

impl LiveCases {
    /// A closer look at what `base` and `now` leave, which were fitted to all tightenings: no number of them changes.
    ///
    /// # Errors
    /// [`DiagnoseError::NothingToCompare`] without tightenings, [`DiagnoseError::Identify`] where fewer samples count than a tightening
    /// has parameters of its own, and what the model refuses.
    ///
    /// # Panics
    /// Where there is no such tightening.
    pub fn closer(
        &self,
        focus: &Focus,
        base: &LiveFit,
        now: &LiveFit,
    ) -> Result<CloserLook, DiagnoseError> {
        let members = &focus.members;
        let cases = self.some(members)?;
        let fits = [base, now].map(|fit| cases.as_fitted(&fit.fitted, members));
        let [base, now] = fits;
        let (base, now) = (base?, now?);
        let counted = cases.residuals_that_count(&focus.counted, &base)?;
        let is_counted = |member: usize| counted.as_ref().map(|all| all[member].as_slice());
        let mut left = [0.0; 2];
        let mut count = 0;
        for (sum, fitted) in left.iter_mut().zip([&base, &now]) {
            (*sum, count) = cases.squares(fitted, is_counted)?;
        }
        let needed = base.own.first().map_or(1, |own| own.len().max(1));
        if count <= needed {
            return Err(IdentifyError::TooShort {
                residuals: count,
                parameters: needed,
            }
            .into());
        }
        Ok(CloserLook {
            cases,
            counted,
            base,
            now,
            left,
            count,
        })
    }

    fn some(&self, members: &[usize]) -> Result<Self, DiagnoseError> {
        let all = members.iter().map(|&member| self.cases[member].clone());
        let cases: Vec<FitTask<'static>> = all.collect();
        Cases::checked(&cases, &Tally::default(), "none is looked at")?;
        Ok(Self {
            clusters: Clusters::of(&cases),
            cases,
            settings: self.settings.clone(),
            sharing: self.sharing.clone(),
            custom: self.custom.clone(),
            each_its_own: self.each_its_own,
        })
    }

    /// `fitted`, of which these tightenings are the numbers `members`, as it is on these.
    fn as_fitted(&self, fitted: &Fitted, members: &[usize]) -> Result<Fitted, DiagnoseError> {
        let tally = Tally::default();
        let mut pooled =
            PooledModel::shared_by(self.counted(&tally), &fitted.effects, &fitted.sharing)?;
        let there = fitted.start_of(&pooled, members);
        let no_step = PooledSettings {
            max_iterations: 0,
            ..PooledSettings::default()
        };
        let stays = pooled.fit(&there, &no_step)?;
        Ok(Fitted::new(&pooled, stays, &self.clusters))
    }

    fn residuals_that_count(
        &self,
        counted: &Counted,
        fitted: &Fitted,
    ) -> Result<Option<Vec<Vec<bool>>>, DiagnoseError> {
        let tally = Tally::default();
        let pooled =
            PooledModel::shared_by(self.counted(&tally), &fitted.effects, &fitted.sharing)?;
        let of_one = |(member, task): (usize, &FitTask<'_>)| {
            let mut samples = counted.of(task)?;
            // A residual stands for the last sample that it is made of.
            Some(samples.split_off(samples.len() - pooled.residual_count(member)))
        };
        Ok(self.cases.iter().enumerate().map(of_one).collect())
    }

    /// Σ r² of the residuals that count, and how many those are.
    fn squares<'m>(
        &self,
        fitted: &Fitted,
        is_counted: impl Fn(usize) -> Option<&'m [bool]>,
    ) -> Result<(f64, usize), DiagnoseError> {
        let tally = Tally::default();
        let pooled =
            PooledModel::shared_by(self.counted(&tally), &fitted.effects, &fitted.sharing)?;
        let (mut squares, mut count, mut room) = (0.0, 0, Room::default());
        for (member, own) in fitted.own.iter().enumerate() {
            let values = pooled.values(member, own, &fitted.shared);
            let (residual, _) = pooled.weighted(member, &values, &[], &mut room);
            for (at, r) in residual.iter().enumerate() {
                if is_counted(member).is_none_or(|counted| counted[at]) {
                    squares += r * r;
                    count += 1;
                }
            }
        }
        Ok((squares, count))
    }
}

impl CloserLook {
    /// Root mean square of what the models leave there, in the unit of [`LiveFit::error`]: the first, and the present one.
    pub fn errors(&self) -> [f64; 2] {
        (self.left).map(|squares| (squares / self.count as f64).sqrt())
    }

    /// How many samples count, of all tightenings together.
    pub fn samples(&self) -> usize {
        self.count
    }

    /// As [`LiveCases::promises`], of what is left there: what each candidate takes there in the size that the whole windows predict.
    ///
    /// # Errors
    /// What the model refuses.
    pub fn promises(&self, candidates: &[Effect]) -> Result<Vec<f64>, DiagnoseError> {
        let (tally, now) = (Tally::default(), &self.now);
        let cases = self.cases.counted(&tally);
        let pooled = PooledModel::shared_by(cases, &now.effects, &now.sharing)?;
        let scored = |counted: &[Vec<bool>]| {
            let scorer = Scorer::new(&pooled, now, self.cases.clusters, Control::default());
            Ok::<_, DiagnoseError>(scorer.counting(counted).score(candidates)?.columns)
        };
        let all: Vec<Vec<bool>> = (0..self.cases.cases.len())
            .map(|member| vec![true; pooled.residual_count(member)])
            .collect();
        let whole = scored(&all)?;
        let part = match &self.counted {
            Some(counted) => scored(counted)?,
            None => whole.clone(),
        };
        let gains = (whole.iter().zip(&part))
            .map(|(whole, part)| (whole.effect, whole.predicted_gain_in(part)));
        let noise = match self.base.is_weighted {
            true => self.count as f64,
            false => 0.0,
        };
        Ok(shares(candidates, gains, self.left[0] - noise))
    }
}
