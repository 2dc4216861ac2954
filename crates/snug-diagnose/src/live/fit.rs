//! One set of effects fitted to all tightenings together, as it is shown.

use crate::pooled::fitted::Fitted;
use crate::pooled::sizes::parameters;
use snug_campaign::EffectParameter;
use snug_identify::FitTask;
use snug_model::Effect;

/// A set of effects, fitted to all tightenings together.
#[derive(Debug, Clone)]
pub struct LiveFit {
    pub(super) fitted: Fitted,
    sizes: Vec<(Effect, Vec<EffectParameter>)>,
}

impl LiveFit {
    pub(super) fn new(cases: &[FitTask<'_>], fitted: Fitted) -> Self {
        let of = |&effect: &Effect| (effect, parameters(cases, &fitted, effect));
        let sizes = fitted.effects.iter().map(of).collect();
        Self { fitted, sizes }
    }

    /// The effects, in the order in which they came in.
    pub fn effects(&self) -> &[Effect] {
        &self.fitted.effects
    }

    /// Root mean square of the residual: over noise, where that [is known](Self::is_over_noise) of every tightening, else in the
    /// output's unit.
    pub fn error(&self) -> f64 {
        self.fitted.error()
    }

    /// Whether errors count in multiples of the measured noise.
    pub fn is_over_noise(&self) -> bool {
        self.fitted.is_weighted
    }

    /// Whether nothing but the noise is left.
    pub fn is_at_noise(&self) -> bool {
        self.fitted.is_at_floor()
    }

    /// Whether no step promised more.
    pub fn has_converged(&self) -> bool {
        self.fitted.converged
    }

    /// The sizes of its effects with their 95 % intervals, each in its own unit.
    pub fn sizes(&self) -> &[(Effect, Vec<EffectParameter>)] {
        &self.sizes
    }

    /// Root mean square of the residual of each tightening, in the unit of [`LiveFit::error`].
    pub fn errors(&self) -> Vec<f64> {
        let mut sums = vec![(0.0, 0_usize); self.fitted.own.len()];
        for (block, &member) in self.fitted.blocks.iter().zip(&self.fitted.members) {
            sums[member].0 += block.squares;
            sums[member].1 += block.count;
        }
        let root = |(squares, count): (f64, usize)| (squares / count.max(1) as f64).sqrt();
        sums.into_iter().map(root).collect()
    }

    /// What it leaves beyond the noise, Σ (r² − 1); all it leaves where the noise is not known.
    pub(super) fn misfit(&self) -> f64 {
        match self.fitted.is_weighted {
            true => self.fitted.squares() - self.fitted.count() as f64,
            false => self.fitted.squares(),
        }
    }
}
