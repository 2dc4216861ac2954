//! Many starts tried roughly: on the same tightening with every few samples replaced by their mean.
//!
//! Which valley a start leads to shows on a record of a few hundred samples as well as on the whole one, for a fraction of
//! the work. Only the ends of the best rough fits are worth a fit of every sample.

use crate::fit::Work;
use crate::race::{Rules, race};
use crate::{Constraints, IdentifyError, IdentifySettings, Settings, Subject, TighteningResidual};
use snug_campaign::{Intersample, Quantity};
use snug_model::Input;

/// Samples that a rough record should have: its noise is then still small beside a whole tightening's motion.
const ENOUGH_SAMPLES: usize = 375;
/// Longest interval between rough samples \[s\]: a shut-off, the fastest event of a tightening, takes several of them.
const LONGEST_INTERVAL_S: f64 = 1e-3;
/// A rough fit has gone far enough when this share of the residual could still be removed.
const ROUGH_TOLERANCE: f64 = 1e-3;
/// Most steps of a rough fit: what takes longer crawls.
const MOST_STEPS: usize = 150;
/// Ends are worth a fit of every sample up to this multiple of the lowest rough cost, and at most so many.
const WORTH: f64 = 1.2;
const MOST_ENDS: usize = 2;
/// Of the race between rough fits.
const RULES: Rules = Rules {
    heat: 40,
    worth: WORTH,
};
/// Rough costs that agree to this share are those of one valley.
const SAME_VALLEY: f64 = 1e-3;

/// Where fits of every sample should begin.
pub(crate) struct Tried {
    /// Best first.
    pub starts: Vec<Vec<f64>>,
    /// Steps and simulations on the rough record; of these every one is a fraction of one on the whole.
    pub work: Work,
}

/// Tries `starts` on a rough record of `subject`; `None` where the record is too short for one, or the simulation is
/// restarted from the measured motion.
pub(crate) fn try_roughly(
    subject: &Subject<'_>,
    starts: &[Vec<f64>],
    set: &Constraints,
    settings: &IdentifySettings,
) -> Result<Option<Tried>, IdentifyError> {
    let quantity = settings.fitted_output;
    let Some(rough) = RoughRecord::of(subject, quantity) else {
        return Ok(None);
    };
    let solver = Settings {
        gradient_tolerance: ROUGH_TOLERANCE.max(settings.solver.gradient_tolerance),
        max_iterations: MOST_STEPS.min(settings.solver.max_iterations),
        ..settings.solver.clone()
    };
    let residual = TighteningResidual::new(
        subject.model,
        &rough.input,
        &rough.measured,
        quantity,
        None,
        settings.unscored_samples.div_ceil(rough.factor),
    );
    let (mut ends, work) = race(&residual, starts, set, &solver, RULES)?;
    ends.retain(|end| end.cost.is_finite());
    ends.dedup_by(|next, kept| (next.cost / kept.cost - 1.0).abs() < SAME_VALLEY);
    let Some(lowest) = ends.first().map(|end| end.cost) else {
        return Ok(None);
    };
    let worthy = ends.into_iter().filter(|end| end.cost <= WORTH * lowest);
    let starts = worthy.map(|end| end.values).take(MOST_ENDS).collect();
    Ok(Some(Tried { starts, work }))
}

/// A tightening with every few samples replaced by their mean.
struct RoughRecord {
    /// Samples that became one.
    factor: usize,
    input: Input,
    measured: Vec<f64>,
}

impl RoughRecord {
    fn of(subject: &Subject<'_>, quantity: Quantity) -> Option<Self> {
        let (input, measured) = (subject.input, subject.tightening.motion.get(quantity)?);
        let interval_s = input.grid_interval_s() * input.substeps() as f64;
        let shortest = (LONGEST_INTERVAL_S / interval_s) as usize;
        let factor = shortest.min(input.samples() / ENOUGH_SAMPLES);
        if factor < 2 || input.is_restarted() {
            return None;
        }
        let torque_nm: Vec<f64> =
            (input.grid_nm().iter().step_by(input.substeps()).copied()).collect();
        // Means stand for the middle of what they are taken over.
        let late_s = 0.5 * (factor - 1) as f64 * interval_s;
        let rough = Input::new(
            &means(&torque_nm, factor),
            interval_s * factor as f64,
            Intersample::Linear,
        )
        .with_onset(input.onset_s() - late_s)
        .with_rest_before(input.rest_before_s() + late_s)
        .with_zero_at(input.zero_at().map(|sample| sample / factor));
        Some(Self {
            factor,
            input: rough,
            measured: means(measured, factor),
        })
    }
}

/// Of every `factor` samples; what is left over at the end is left out.
fn means(signal: &[f64], factor: usize) -> Vec<f64> {
    let parts = signal.chunks_exact(factor);
    parts
        .map(|part| part.iter().sum::<f64>() / factor as f64)
        .collect()
}
