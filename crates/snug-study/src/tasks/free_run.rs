//! Whether a free run over a study's recordings tells effects apart, or the model is restarted from the measured motion instead.

use crate::evaluation::validation::is_of_an_accelerometer;
use crate::study::Study;
use crate::tasks::held_input;
use crate::tasks::initial_state::{longest_s, swings};
use snug_campaign::words::explained::is_white;
use snug_campaign::words::restarted::WhyRestarted;
use snug_campaign::{Estimate, Quantity};
use snug_diagnose::{ROUNDING, is_followed_with_an_effect};
use snug_identify::{FitTask, IdentifySettings, Simulation, SpectralStart, identify};
use snug_model::BASE_PARAMETERS;

/// Root mean square of a free run's error over that of the measured motion beyond which it is restarted, unless an effect of the catalogue
/// brings it below.
const POOR: f64 = 0.25;
/// What a free run leaves that goes on from sample to sample, over what does not, beyond which it is more than noise
/// \[–\]. Chosen.
const BEYOND_NOISE: f64 = 2.0;
/// Share of what a free run leaves up to which another leaves plainly less \[–\]. Chosen: of a tower that wind moves, a second mode that
/// restarts found leaves all of it.
const PLAINLY_LESS: f64 = 0.9;
/// Damping or stiffness over its standard error from which on it brings the motion back \[–\]: a path that nothing brings back seems to
/// be brought back by more than the 1.96 of other numbers. Dickey and Fuller (1979), at 5 % and with a mean estimated.
const BROUGHT_BACK: f64 = 2.86;
/// Times that a speed falls to 1/e while the longest recording lasts, below which the damping hardly brings it back \[–\]. Chosen: one that
/// falls 2.4 times was said to lack a law in no catalogue where it lacked a load that nobody had recorded, one that falls 6 times nothing.
const FALLS: f64 = 4.0;

/// That a study's model is restarted from the measured motion again and again.
pub(super) struct Restarts {
    pub why: WhyRestarted,
    /// Whether something brings the motion back, so that a free run follows it once the model lacks little.
    pub comes_back: bool,
}

/// Why the study's model is restarted, if it is. The motion between two restarts is that of the `start`, where the spectra give one.
pub(super) fn restarts(
    study: &Study,
    cases: &[FitTask<'_>],
    start: Option<&SpectralStart>,
) -> Option<Restarts> {
    let missed = missed(cases)?;
    let is_unheld = start.is_some_and(|start| is_unheld(start, &missed, cases));
    if !missed.asks_for_restarts(cases, is_unheld)
        || (is_unheld && is_followed_when_held(study, cases))
    {
        return None;
    }
    let share = missed.share();
    Some(Restarts {
        why: match is_unheld && missed.follows() {
            true => WhyRestarted::Unheld(cases[0].quantity()),
            false => WhyRestarted::Misses(share),
        },
        comes_back: !is_unheld,
    })
}

/// Whether what is fitted is a motion that nothing brings back while the longest recording lasts, an angle for want of a spring, a speed of
/// spring and damping: what a free run has missed once it misses to the end, and of all laws those come closest that bend the whole way
/// a little.
fn is_unheld(start: &SpectralStart, missed: &Missed, cases: &[FitTask<'_>]) -> bool {
    let [mass, damping, stiffness] = start.values;
    let longest_s = longest_s(cases);
    let creeps = damping > 2.0 * (mass * stiffness).sqrt();
    let back_s = (damping / stiffness).max((mass / stiffness).sqrt());
    let is_sprung =
        (swings(start, cases) && !creeps) || (missed.shows_a_spring && back_s <= longest_s);
    let is_damped = missed.shows_a_damping && FALLS * mass / damping <= longest_s;
    let quantity = cases[0].quantity();
    !is_sprung
        && cases.iter().all(|case| case.quantity() == quantity)
        && match quantity {
            Quantity::Displacement => true,
            Quantity::Velocity => !is_damped,
            Quantity::Acceleration => false,
        }
}

/// Whether a free run follows a motion that nothing brings back once the input is taken as held from sample to sample, where the study
/// leaves that open: what a straight input misses is no matter of the rig.
fn is_followed_when_held(study: &Study, cases: &[FitTask<'_>]) -> bool {
    let follows = |held: &[FitTask<'_>]| {
        missed(held).is_some_and(|missed| !missed.asks_for_restarts(held, true))
    };
    held_input::is_open(study, cases)
        && held_input::held(study, cases).is_ok_and(|(_, held)| follows(&held))
}

/// What a run of the model of some recordings leaves of the measured motion, both Σ over what is scored.
pub(crate) struct Missed {
    /// What is left at a sample times what is left at the next: noise is as often with as against its neighbour.
    left: f64,
    about_mean: f64,
    /// What is left beyond that: what neighbours do not share.
    noise: f64,
    /// Whether it shows in at least half of the recordings.
    shows_a_damping: bool,
    shows_a_spring: bool,
}

impl Missed {
    /// Root mean square of what is left, over that of the motion about its mean, as far as it goes on from sample to sample: a record that
    /// is half noise is not followed better for being restarted from its noise.
    fn share(&self) -> f64 {
        (self.left.max(0.0) / self.about_mean).sqrt()
    }

    /// Whether it misses the measured motion by little.
    pub fn follows(&self) -> bool {
        self.share() <= POOR
    }

    /// Whether it leaves plainly less of the motion than another.
    pub fn follows_better_than(&self, other: &Self) -> bool {
        self.left < PLAINLY_LESS * other.left
    }

    /// Whether it leaves more than noise.
    pub fn leaves_a_motion(&self) -> bool {
        self.left > self.most_of_noise()
    }

    /// Whether what it leaves is white noise, or rounding.
    pub fn leaves_white_noise(&self) -> bool {
        let all = self.left + self.noise;
        all <= ROUNDING * self.about_mean || is_white(self.left / all)
    }

    /// What noise, or rounding, may leave.
    fn most_of_noise(&self) -> f64 {
        ((1.0 + BEYOND_NOISE) * self.noise).max(ROUNDING * self.about_mean)
    }

    /// Whether the model is to be restarted from the measured motion: where a free run misses it by far, and where it misses an angle
    /// that nothing brings back by more than noise. Not where a free run follows the motion as nearly once one effect is added: it
    /// tells effects apart that a restarted run hardly does.
    fn asks_for_restarts(&self, cases: &[FitTask<'_>], is_unheld: bool) -> bool {
        let near = match is_unheld {
            true => self.most_of_noise(),
            false => POOR * POOR * self.about_mean,
        };
        self.left > near && !is_followed_with_an_effect(cases, near).unwrap_or(false)
    }
}

/// What the model of `cases`, run as they are, leaves; `None` where restarts make no sense: an acceleration does not drift, and what is
/// integrated from one has no measured motion to start from.
pub(crate) fn missed(cases: &[FitTask<'_>]) -> Option<Missed> {
    let (mut left, mut about_mean, mut noise) = (0.0, 0.0, 0.0);
    let [mut damped, mut sprung] = [0, 0];
    for case in cases {
        let motion = &case.tightening.motion;
        if case.quantity() == Quantity::Acceleration || is_of_an_accelerometer(&case.tightening) {
            return None;
        }
        let settings = IdentifySettings {
            fitted_output: case.quantity(),
            constraints: case.settings.constraints.clone(),
            unscored_samples: case.unscored(),
            simulation: Simulation::FreeRun,
            ..IdentifySettings::default()
        };
        let measured = motion.get(case.quantity())?;
        let mean = measured.iter().sum::<f64>() / measured.len() as f64;
        let found = identify(&case.model, &case.input, &case.tightening, &settings);
        let shows = |index: usize| found.as_ref().is_ok_and(|found| shows(found, index));
        damped += usize::from(shows(1));
        sprung += usize::from(shows(2));
        let error = found.and_then(|found| {
            let values: Vec<f64> = found.parameters.iter().map(|p| p.value).collect();
            let mut error = case.simulated(&case.model, &values)?;
            error
                .iter_mut()
                .zip(measured)
                .for_each(|(simulated, y)| *simulated -= y);
            Ok(error)
        });
        let about: f64 = measured[case.unscored()..]
            .iter()
            .map(|y| (y - mean).powi(2))
            .sum();
        // What cannot even be simulated misses everything.
        let (goes_on, all): (f64, f64) = error.map_or((about, about), |error| {
            let scored = &error[case.unscored()..];
            let pairs = scored.windows(2).map(|pair| pair[0] * pair[1]);
            (pairs.sum(), scored.iter().map(|one| one * one).sum())
        });
        left += goes_on;
        noise += all - goes_on;
        about_mean += about;
    }
    (about_mean > 0.0).then_some(Missed {
        left,
        about_mean,
        noise,
        shows_a_damping: 2 * damped >= cases.len(),
        shows_a_spring: 2 * sprung >= cases.len(),
    })
}

/// Whether the damping or the stiffness found, parameter number `index` of the base model, stands out from none.
fn shows(found: &Estimate, index: usize) -> bool {
    let mut all = found.parameters.iter();
    let it = all.find(|one| one.name == BASE_PARAMETERS[index]);
    it.is_some_and(|one| match one.standard_error {
        Some(error) => one.value > BROUGHT_BACK * error,
        None => one.fixed && one.value > 0.0,
    })
}
