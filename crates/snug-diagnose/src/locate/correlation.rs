//! Whether what is left is white, and whether it follows from the torque.
//!
//! With w the whitened residual of a tightening and u its torque about its mean, over all tightenings
//!
//! ```text
//! own(k) = Σ w_t w_{t+k} / Σ w²,  with_torque(k) = Σ w_{t+k} u_t / √(Σ w² Σ u²)
//! ```
//!
//! each w over its own root mean square, so that a loud tightening does not drown the others. Of white w either has the standard
//! deviation 1/√N (Ljung, System Identification, 2nd edition, section 16.6). A residual that follows the torque after a while, k > 0,
//! is dynamics that the model lacks; one that goes before it, k < 0, is feedback or a torque that is logged late.

use super::residual::{Residuals, White};
use crate::locate::thresholds::{CORRELATED_SHARE, CORRELATION_LAGS};
use snug_campaign::{NORMAL_95, ResidualCorrelation};

/// `None` without a residual, or one so short that it has no lag.
pub fn correlation(residuals: &Residuals<'_>) -> Option<ResidualCorrelation> {
    let all: Vec<Pair> = residuals.all.iter().filter_map(Pair::of).collect();
    let shortest = all.iter().map(|pair| pair.w.len()).min()?;
    let samples: usize = all.iter().map(|pair| pair.w.len()).sum();
    let interval_s = all.first()?.interval_s;
    let lags = lags((shortest as f64 * CORRELATED_SHARE) as usize);
    if lags.is_empty() {
        return None;
    }
    let mean = |of: &dyn Fn(&Pair) -> f64| {
        let weighted = all.iter().map(|pair| of(pair) * pair.w.len() as f64);
        weighted.sum::<f64>() / samples as f64
    };
    let own = (lags.iter()).map(|&k| mean(&|pair| pair.own(k)));
    let both = lags.iter().rev().map(|&k| -(k as isize));
    let both: Vec<isize> = both
        .chain([0])
        .chain(lags.iter().map(|&k| k as isize))
        .collect();
    let with_torque = both.iter().map(|&k| mean(&|pair| pair.with_torque(k)));
    Some(ResidualCorrelation {
        lag_s: lags.iter().map(|&k| k as f64 * interval_s).collect(),
        own: own.collect(),
        torque_lag_s: both.iter().map(|&k| k as f64 * interval_s).collect(),
        with_torque: with_torque.collect(),
        half_width: NORMAL_95 / (samples as f64).sqrt(),
    })
}

/// Lags \[samples\] from 1 to the longest, each longer than the one before by the same factor: neighbours matter most.
fn lags(longest: usize) -> Vec<usize> {
    let ratio = (longest as f64)
        .powf(1.0 / CORRELATION_LAGS as f64)
        .max(1.0);
    let mut lags: Vec<usize> = (0..=CORRELATION_LAGS)
        .map(|step| ratio.powi(step as i32).round() as usize)
        .filter(|&lag| lag <= longest)
        .collect();
    lags.dedup();
    lags
}

/// Residual and torque of one tightening, both of unit mean square.
struct Pair {
    w: Vec<f64>,
    u: Vec<f64>,
    interval_s: f64,
}

impl Pair {
    fn of(one: &White<'_>) -> Option<Self> {
        let tightening = one.seen.tightening;
        let torque = tightening.torque_nm.get(one.samples())?;
        let mean = torque.iter().sum::<f64>() / torque.len() as f64;
        let unit = |values: Vec<f64>| -> Option<Vec<f64>> {
            let square = values.iter().map(|value| value * value).sum::<f64>();
            let root = (square / values.len() as f64).sqrt();
            (root > 0.0).then(|| values.into_iter().map(|value| value / root).collect())
        };
        Some(Self {
            w: unit(one.values.clone())?,
            u: unit(torque.iter().map(|torque| torque - mean).collect())?,
            interval_s: tightening.time_base.interval_s,
        })
    }

    fn own(&self, k: usize) -> f64 {
        products(&self.w[k..], &self.w) / self.w.len() as f64
    }

    fn with_torque(&self, k: isize) -> f64 {
        let later = k.unsigned_abs();
        let sum = match k >= 0 {
            true => products(&self.w[later..], &self.u),
            false => products(&self.w, &self.u[later..]),
        };
        sum / self.w.len() as f64
    }
}

/// Σ a_t b_t as far as both go.
fn products(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
