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
use snug_identify::FitTask;
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
    /// Of every sample of a tightening's window whether it counts.
    fn of(&self, task: &FitTask<'_>) -> Vec<bool> {
        let samples = 0..task.measured().len();
        match self {
            Self::All => samples.map(|_| true).collect(),
            Self::Stretch(stretch) => samples.map(|at| stretch.contains(&at)).collect(),
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
                samples.map(is_there).collect()
            }
        }
    }
}

/// The tightenings of a focus, with two models as they are on these.
pub struct CloserLook {
    cases: LiveCases,
    /// Of every residual of each tightening whether it counts.
    counted: Vec<Vec<bool>>,
    now: Fitted,
    /// Σ r² of those residuals that each leaves, the first and the present one.
    left: [f64; 2],
}

impl LiveCases {
    /// A closer look at what `base` and `now` leave, which were fitted to all tightenings: no number of them changes.
    ///
    /// # Errors
    /// [`DiagnoseError::NothingToCompare`] without tightenings, [`DiagnoseError::FewSamples`] where no more samples count than a
    /// tightening has parameters of its own, and what the model refuses.
    ///
    /// # Panics
    /// Where there is no such tightening.
    pub fn closer(
        &self,
        focus: &Focus,
        base: &LiveFit,
        now: &LiveFit,
    ) -> Result<CloserLook, DiagnoseError> {
        let cases = self.some(&focus.members)?;
        let (base, counted) = cases.as_fitted(&base.fitted, focus)?;
        let (now, _) = cases.as_fitted(&now.fitted, focus)?;
        let look = CloserLook {
            left: [base.squares, now.squares],
            now: now.fitted,
            cases,
            counted,
        };
        let samples = look.samples();
        let own = base.fitted.own.first().map_or(1, |own| own.len().max(1));
        match samples > own {
            true => Ok(look),
            false => Err(DiagnoseError::FewSamples { samples, own }),
        }
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

    /// `fitted`, of which these tightenings are the members of a focus, as it is on these; and which residuals of each count.
    fn as_fitted(
        &self,
        fitted: &Fitted,
        focus: &Focus,
    ) -> Result<(Standing, Vec<Vec<bool>>), DiagnoseError> {
        let tally = Tally::default();
        let mut pooled =
            PooledModel::shared_by(self.counted(&tally), &fitted.effects, &fitted.sharing)?;
        let there = fitted.start_of(&pooled, &focus.members);
        let no_step = PooledSettings {
            max_iterations: 0,
            ..PooledSettings::default()
        };
        let stays = pooled.fit(&there, &no_step)?;
        let fitted = Fitted::new(&pooled, stays, &self.clusters);
        let (mut squares, mut counted, mut room) = (0.0, Vec::new(), Room::default());
        for (member, (task, own)) in self.cases.iter().zip(&fitted.own).enumerate() {
            let values = pooled.values(member, own, &fitted.shared);
            let (residual, _) = pooled.weighted(member, &values, &[], &mut room);
            let mut samples = focus.counted.of(task);
            // A residual stands for the last sample that it is made of.
            let counts = samples.split_off(samples.len() - residual.len());
            let those = residual.iter().zip(&counts).filter(|(_, counts)| **counts);
            squares += those.map(|(r, _)| r * r).sum::<f64>();
            counted.push(counts);
        }
        Ok((Standing { fitted, squares }, counted))
    }
}

/// A model on some tightenings.
struct Standing {
    fitted: Fitted,
    /// Σ r² of those residuals that count.
    squares: f64,
}

impl CloserLook {
    /// Root mean square of what the models leave there, in the unit of [`LiveFit::error`]: the first, and the present one.
    pub fn errors(&self) -> [f64; 2] {
        (self.left).map(|squares| (squares / self.samples() as f64).sqrt())
    }

    /// How many samples count, of all tightenings together.
    pub fn samples(&self) -> usize {
        self.counted
            .iter()
            .flatten()
            .filter(|counts| **counts)
            .count()
    }

    /// As [`LiveCases::promises`], of what is left there: what each candidate takes there in the size that the whole windows predict.
    ///
    /// # Errors
    /// What the model refuses.
    pub fn promises(&self, candidates: &[Effect]) -> Result<Vec<f64>, DiagnoseError> {
        let (tally, now) = (Tally::default(), &self.now);
        let cases = self.cases.counted(&tally);
        let pooled = PooledModel::shared_by(cases, &now.effects, &now.sharing)?;
        let scorer = Scorer::new(&pooled, now, self.cases.clusters, Control::default());
        let columns = scorer.counting(&self.counted).score(candidates)?.columns;
        let gains = (columns.iter()).map(|column| (column.effect, column.predicted_gain_counted()));
        let noise = match now.is_weighted {
            true => self.samples() as f64,
            false => 0.0,
        };
        Ok(shares(candidates, gains, self.left[0] - noise))
    }
}
