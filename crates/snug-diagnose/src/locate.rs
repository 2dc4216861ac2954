//! Where a model fails: over time, phase, frequency, amplitude and conditions, and as a missing force.
//!
//! All of it looks at the whitened residual w of each tightening (measured − simulated, through the filter that makes the
//! measurement's noise white with unit variance), so that 1 means "nothing but noise" whatever the part. The unit of
//! chance is the tightening: intervals come from drawing tightenings, never samples.

mod amplitude;
mod aspect;
mod bootstrap;
mod comparison;
mod condition;
mod correlation;
pub(crate) mod drift;
mod exposure;
mod force_shape;
mod frequency;
mod grid;
mod missing_force;
mod phase;
mod remark;
mod repeatable;
mod residual;
mod response;
mod spectra;
mod time_since_onset;
mod tone;

#[cfg(test)]
mod tests;
pub(crate) mod thresholds;

use aspect::View;
use bootstrap::Draws;
use residual::Residuals;
use snug_campaign::{Comparison, Drift, Estimate, Location, Motion, Tightening};
use spectra::Spectra;

/// One tightening with what a model makes of it.
#[derive(Debug, Clone, Copy)]
pub struct Seen<'a> {
    /// The measurement.
    pub tightening: &'a Tightening,
    /// The model's motion with the tightening's own estimate.
    pub simulated: &'a Motion,
    /// The estimate.
    pub estimate: &'a Estimate,
    /// Samples at the window's start that count for nothing.
    pub unscored: usize,
}

/// Model against measurement per tightening (worst first) and pooled, in every quantity that is measured, and in force.
///
/// The force is F2 − F3 = −I_n (α_measured − α_simulated) / l \[N\]. Pooled values take all samples of all tightenings
/// together; their fit compares with each tightening's own mean. Tightenings whose residual is not finite are left out.
pub fn compare(seen: &[Seen<'_>]) -> Comparison {
    comparison::compare(seen)
}

/// Where the model fails; same seed, same bits.
///
/// Over an aspect's part P: error_over_noise = √(Σ_P w² / n_P), share_of_excess = Σ_P (w² − 1) / Σ (w² − 1). Shares are
/// 0 where the whole error is not beyond what noise alone gives. Where no tightening's noise is known, w is the residual
/// over its pooled root mean square and the share is that of Σ w². Times count from the pulse's onset, or from the
/// window's start where no tightening has an onset. The periodogram's window falls off over the first and last 5 % of the
/// samples. Parts without a sample are left out, and aspects that no tightening can say anything about.
///
/// `correlation` is that of the residual with itself later and with the torque (see the `correlation` module); `response` how motion
/// and simulated motion answer the torque over frequency (see the `response` module).
///
/// `repeatable_share` is the larger of two: what the other tightenings' mean residual predicts over the time since onset,
/// and what a force over displacement and velocity with sizes from the other files predicts (see the `repeatable` and
/// `force_shape` modules for the equations). It is 0 where the error is not beyond the noise.
///
/// # Missing force
/// What would have to be added to the hand force for the model to move as measured:
/// ΔF = −(I_n + m l²)/l · e_α − c l e_ω − k l e_θ with e = measured − simulated. Without effects in the model this is
/// exactly the equation error along the measured motion, (T − I α)/l − k x − c v; with effects, their force is taken along
/// the simulated motion. Where ω and θ are not measured, only the first term is known. Since m, c, k were fitted without
/// it, what looks like inertia, damper or spring is not in it. With fewer than three tightenings `low_n` and `high_n` are
/// empty: no band can be stated.
pub fn locate(seen: &[Seen<'_>], seed: u64) -> Location {
    let residuals = Residuals::of(seen);
    if residuals.all.is_empty() {
        return Location::default();
    }
    let draws = Draws::new(residuals.all.len(), seed);
    let spectra = Spectra::of(&residuals);
    let views: Vec<View> = [
        time_since_onset::view(&residuals),
        phase::view(&residuals),
        frequency::view(&spectra),
        amplitude::view(&residuals),
    ]
    .into_iter()
    .chain(condition::views(&residuals))
    .flatten()
    .collect();
    let aspects: Vec<_> = views
        .iter()
        .map(|view| view.aspect(&residuals, &draws))
        .collect();
    let (force_over_time, force_map) = missing_force::curve_and_map(&residuals, &draws);
    let followed = force_shape::followed(&residuals);
    let repeatable_share = repeatable::share(&residuals, followed.predicted);
    let remarks = remark::remarks(&residuals, &spectra, &aspects, &followed, repeatable_share);
    Location {
        aspects,
        force_over_time,
        force_map,
        correlation: correlation::correlation(&residuals),
        response: response::response(&residuals),
        repeatable_share,
        remarks,
    }
}

/// What the fitted m, c, k drift with, in the order parameter, covariate; drifts that the data cannot show are left out.
///
/// ln p = (group's own level) + b z + scatter, by least squares within groups, where p is m, c or k. Groups are
/// participants (files where no participant is named, and for the trial number, which means something only within a
/// file). Only converged estimates with positive values take part, without those more than five robust standard
/// deviations off their group's median. `change_percent` is 100 (exp(b Δz) − 1) with Δz the widest range of z within a
/// group, for the trial number that of all tightenings of a file, so that exp(b) − 1 per tightening follows from it; p of the slope by Student's t with n − groups − 1 degrees of freedom.
///
/// A hand that happens to be stiffer is also moved less, so the measured peaks depend on k by themselves. Peak angle and
/// peak velocity are therefore those that the tightening's torque gives with the group's geometric-mean m, c, k.
pub fn drifts(seen: &[Seen<'_>]) -> Vec<Drift> {
    drift::drifts(seen)
}

/// What is left alone: the missing force over time and over displacement and velocity, whether the residual is white and follows
/// from the torque, and the response over frequency; nothing where nothing can be compared.
pub(crate) fn what_is_left(seen: &[Seen<'_>], seed: u64) -> Location {
    let residuals = Residuals::of(seen);
    let draws = Draws::new(residuals.all.len(), seed);
    let (force_over_time, force_map) = missing_force::curve_and_map(&residuals, &draws);
    Location {
        force_over_time,
        force_map,
        correlation: correlation::correlation(&residuals),
        response: response::response(&residuals),
        ..Location::default()
    }
}
