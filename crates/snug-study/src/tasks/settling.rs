//! What a study leaves to the tool on a rig that is no hand on a nutrunner: the scale of its effects, and whether the
//! model runs freely over a long record.

use crate::evaluation::validation::every_s_of;
use crate::study::Study;
use crate::tasks::cases::with_settled;
use crate::tasks::free_run::{Restarts, restarts};
use crate::tasks::initial_state;
use crate::tasks::own_effects::begun_together;
use snug_campaign::Quantity;
use snug_campaign::words::reason::Reason;
use snug_diagnose::steps_per_sample;
use snug_identify::{
    FitTask, Simulation, SpectralStart, motions, spectral_start, widest_half_width,
};
use snug_model::{BASE_PARAMETERS, Scale};
use snug_preprocess::Window;

/// The study with its automatic choices made, and what is to be said about them.
pub(crate) struct Settled {
    pub study: Study,
    pub reasons: Vec<Reason>,
    /// Whether the model is restarted, though a free run would follow once it lacks little.
    pub may_run_freely: bool,
}

/// Whether a study leaves anything to be settled: how large things are on its rig, where m, c, k begin, how it is simulated.
pub(crate) fn leaves_open(study: &Study) -> bool {
    let is_open = study.model.scale == Scale::Automatic
        || study.identify.simulation == Simulation::Automatic
        || study.model.steps_per_sample.is_none()
        || !states_a_start(study);
    study.preprocess.window == Window::Whole && is_open
}

/// Makes the choices that the study [leaves open](leaves_open); `None` where there are none.
pub(crate) fn settle(study: &Study, cases: &[FitTask<'_>]) -> Option<Settled> {
    if !leaves_open(study) {
        return None;
    }
    let start = spectral_start(cases);
    let sizes = Sizes::of(cases, start.as_ref())?;
    let mut settled = Settled {
        study: sized(study, cases, start.as_ref(), &sizes)?,
        reasons: Vec::new(),
        may_run_freely: false,
    };
    let runs_freely = !matches!(study.identify.simulation, Simulation::Restarted { .. });
    let moving = runs_freely
        .then(|| initial_state::moving(&settled.study, cases, start.as_ref()))
        .flatten();
    let (mut moving, cases) = match moving {
        Some((moving, cases)) => (Some(moving), cases),
        None => {
            let lent = cases.iter().map(FitTask::lent).collect();
            (None, with_settled(&settled.study, lent).ok()?)
        }
    };
    if study.identify.simulation == Simulation::Automatic {
        let every_s = every_s_of(sizes.period_s(), &cases[0].tightening);
        let restarts = every_s.and_then(|every_s| {
            let restarts = restarts(&settled.study, &cases, start.as_ref());
            restarts.map(|restarts| (restarts, every_s))
        });
        settled.study.identify.simulation = match restarts {
            Some((Restarts { why, comes_back }, every_s)) => {
                settled.may_run_freely = comes_back;
                // A simulation that takes up the measured motion begins with it.
                moving = None;
                settled.reasons.push(Reason::Restarted { why, every_s });
                let search = &mut settled.study.diagnosis.search;
                for gain in [
                    &mut search.smallest_gain,
                    &mut search.smallest_gain_at_noise,
                ] {
                    *gain = gain.max(RESTARTED_GAIN);
                }
                Simulation::Restarted { every_s }
            }
            None => Simulation::FreeRun,
        };
    }
    if let Some(moving) = moving {
        settled.study.model = moving.model;
        settled.reasons.push(Reason::BeginsMoving);
    }
    if !states_a_start(study) {
        settled.study = begun_together(settled.study, &cases);
    }
    Some(settled)
}

/// The study with how large things are on its rig, where m, c, k begin and in how many steps it is simulated, as far as it leaves that
/// open.
fn sized(
    study: &Study,
    cases: &[FitTask<'_>],
    start: Option<&SpectralStart>,
    sizes: &Sizes,
) -> Option<Study> {
    let mut sized = study.clone();
    let values = start.map(|start| start.values);
    let values = values.or_else(|| sizes.base_of(cases));
    if let Some(values) = values.filter(|_| !states_a_start(study)) {
        for (name, value) in BASE_PARAMETERS.iter().zip(values) {
            let told = sized.model.parameters.entry((*name).to_owned());
            let told = told.or_default();
            if !told.fixed {
                told.value = Some(value);
            }
        }
    }
    if study.model.scale == Scale::Automatic {
        sized.model.scale = Scale::Rig {
            torque_nm: sizes.torque_nm,
            angle_rad: sizes.angle_rad,
            time_s: sizes.time_s,
        };
    }
    if study.model.steps_per_sample.is_none() {
        let lent = cases.iter().map(FitTask::lent).collect();
        let cases = with_settled(&sized, lent).ok()?;
        sized.model.steps_per_sample = Some(steps_per_sample(&cases));
    }
    Some(sized)
}

/// Whether the study says where those of m, c and k begin that it leaves free; a parameter that is held begins nowhere.
fn states_a_start(study: &Study) -> bool {
    let told = |name: &&str| study.model.parameters.get(*name);
    let is_free = |name: &&&str| told(name).is_none_or(|one| !one.fixed);
    let mut free = BASE_PARAMETERS.iter().filter(is_free).peekable();
    free.peek().is_none() || free.any(|name| told(name).is_some_and(|one| one.value.is_some()))
}

/// Smallest gain that matters where a model is restarted: less is within reach of errors of the motion taken up.
const RESTARTED_GAIN: f64 = 0.05;
/// Places in each record at which its motion is looked at.
const PLACES: usize = 400;

/// Fewest samples over which a change of speed is looked at.
const FEWEST_APART: usize = 4;

/// How large things are on this rig, root mean square over all records.
struct Sizes {
    torque_nm: f64,
    angle_rad: f64,
    time_s: f64,
}

impl Sizes {
    /// As measured where the angle was, and where no torque acts as what is known of the rig would take one; otherwise as the model moves
    /// from its `start`: an angle that was integrated drifts.
    fn of(cases: &[FitTask<'_>], start: Option<&SpectralStart>) -> Option<Self> {
        let is_undriven = cases.iter().all(FitTask::is_undriven);
        let is_measured =
            |case: &FitTask<'_>| is_undriven || case.quantity() == Quantity::Displacement;
        if !cases.iter().all(is_measured) {
            let samples = || {
                cases
                    .iter()
                    .map(|case| case.tightening.torque_nm.len() as f64)
            };
            let torques = cases
                .iter()
                .map(|case| mean_square(&case.tightening.torque_nm));
            let squares: f64 = torques.zip(samples()).map(|(square, n)| square * n).sum();
            return start.map(|start| Self {
                torque_nm: f64::sqrt(squares / samples().sum::<f64>()),
                angle_rad: start.angle_rad,
                time_s: start.time_s,
            });
        }
        let (mut angle, mut velocity, mut torque, mut count) = (0.0, 0.0, 0.0, 0.0);
        for case in cases {
            let measured = displacement(case);
            let apart = (measured.len() / PLACES).max(1);
            let places = motions(
                measured,
                interval_s(case),
                apart,
                widest_half_width(measured),
            );
            let n = places.len() as f64;
            let mean = places.iter().map(|[angle, _]| angle).sum::<f64>() / n;
            angle += places
                .iter()
                .map(|[at, _]| (at - mean).powi(2))
                .sum::<f64>();
            velocity += places.iter().map(|[_, speed]| speed * speed).sum::<f64>();
            torque += n * mean_square(&case.tightening.torque_nm);
            count += n;
        }
        let mut sizes = Self {
            torque_nm: f64::sqrt(torque / count),
            angle_rad: f64::sqrt(angle / count),
            time_s: f64::sqrt(angle / velocity),
        };
        // Long rests and turns that add up make the angle large for its speed: how fast the speed changes says more. It
        // is looked at over a part of the time found before, so that vibration does not count.
        for _ in 0..2 {
            let time_s = sizes.time_of_speed(cases);
            sizes.time_s = time_s.map_or(sizes.time_s, |time_s| sizes.time_s.min(time_s));
        }
        if is_undriven {
            let first = cases.first()?;
            sizes.torque_nm = first.known_torque(sizes.angle_rad, sizes.time_s)?;
        }
        let all = [sizes.torque_nm, sizes.angle_rad, sizes.time_s];
        let sane = |size: &f64| size.is_finite() && *size > 0.0;
        all.iter().all(sane).then_some(sizes)
    }

    /// Speed over its change, root mean square, seen over a fourth of the present time; `None` where that is too short.
    fn time_of_speed(&self, cases: &[FitTask<'_>]) -> Option<f64> {
        let (mut speeds, mut changes) = (0.0, 0.0);
        for case in cases {
            let interval_s = interval_s(case);
            let apart = (self.time_s / 4.0 / interval_s) as usize;
            if apart < FEWEST_APART {
                return None;
            }
            let places = motions(displacement(case), interval_s, apart, apart / 2);
            let step_s = apart as f64 * interval_s;
            for pair in places.windows(2) {
                speeds += pair[0][1].powi(2);
                changes += ((pair[1][1] - pair[0][1]) / step_s).powi(2);
            }
        }
        Some(f64::sqrt(speeds / changes)).filter(|time_s| time_s.is_finite())
    }

    /// Mass, damping and stiffness \[kg, kg/s, N/m\] that each take this torque to move so far in that time, where no torque acts and
    /// spectra say nothing.
    fn base_of(&self, cases: &[FitTask<'_>]) -> Option<[f64; 3]> {
        let first = cases.first().filter(|case| case.is_undriven())?;
        let arm_m = first.model.rig().lever_arm_m;
        let stiffness = self.torque_nm / self.angle_rad / (arm_m * arm_m);
        let damping = stiffness * self.time_s;
        Some([damping * self.time_s, damping, stiffness])
    }

    /// Of an oscillation that is as large and as fast.
    fn period_s(&self) -> f64 {
        std::f64::consts::TAU * self.time_s
    }
}

fn displacement<'a>(case: &'a FitTask<'_>) -> &'a [f64] {
    case.tightening
        .motion
        .get(Quantity::Displacement)
        .unwrap_or_default()
}

fn interval_s(case: &FitTask<'_>) -> f64 {
    case.tightening.time_base.interval_s
}

fn mean_square(values: &[f64]) -> f64 {
    values.iter().map(|value| value * value).sum::<f64>() / values.len().max(1) as f64
}
