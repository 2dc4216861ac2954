//! The climb: rank, add the best, tidy up, again, until nothing more is justified.

use crate::ranking::{Candidate, Ranking, fit_effects, gains, rank};
use crate::fitted::Fitted;
use crate::unlisted::{is_unlisted, terms};
use crate::units::Units;
use crate::{Case, DiagnoseError, DiagnoseSettings};
use snug_campaign::Quantity;
use snug_model::Effect;

/// An effect that was added, with what spoke for it then.
#[derive(Debug, Clone)]
pub(crate) struct Addition {
    pub effect: Effect,
    pub p_family: f64,
    /// Share of the misfit at that rung.
    pub heldout_gain: f64,
    pub twins: Vec<Effect>,
}

/// What became of an attempt to do without a term.
#[derive(Debug, Clone)]
pub(crate) struct Attempt {
    pub effect: Effect,
    pub removed: bool,
    /// Growth of the squared residual without it, and its standard error over units.
    pub loss: f64,
    pub loss_error: f64,
}

/// How far the climb went.
pub(crate) struct Climb {
    /// The models in order, the study's own first.
    pub rungs: Vec<Fitted>,
    pub additions: Vec<Addition>,
    pub attempts: Vec<Attempt>,
    /// The ranking against the last model.
    pub ranking: Ranking,
    pub stopped: Stop,
}

/// Why the climb stopped.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Stop {
    /// No candidate reaches the level.
    NothingSupported { best_p: f64 },
    /// The best supported candidate lowers the error by too little to matter.
    TooSmall { share: f64 },
    /// The model cannot carry more.
    Full,
}

/// Effects a model can be extended by before the climb is called off.
const MOST_EFFECTS: usize = 4;

impl Candidate {
    /// Whether the data support it: beyond chance over the family, and a gain in held-out tightenings.
    pub fn is_supported(&self, settings: &DiagnoseSettings) -> bool {
        self.p_family <= settings.level && self.gain() > 0.0 && self.clearness() > 1.0
    }
}

/// The first supported candidate that removes enough to matter, or why there is none.
pub(crate) fn justified(
    ranking: &Ranking,
    current: &Fitted,
    settings: &DiagnoseSettings,
) -> Result<usize, Stop> {
    let supported = |candidate: &Candidate| candidate.is_supported(settings);
    match ranking.candidates.iter().position(supported) {
        Some(index) => {
            let share = ranking.candidates[index].gain() / current.squares();
            match share >= settings.smallest_gain {
                true => Ok(index),
                false => Err(Stop::TooSmall { share }),
            }
        }
        None => {
            let all = ranking.candidates.iter();
            Err(Stop::NothingSupported {
                best_p: all.map(|candidate| candidate.p_family).fold(1.0, f64::min),
            })
        }
    }
}

/// The effects that may be missing beside `current`.
pub(crate) fn candidates(cases: &[Case], current: &Fitted, custom: &[Effect]) -> Result<Vec<Effect>, DiagnoseError> {
    let acceleration = cases.iter().all(|case| case.quantity == Quantity::Acceleration);
    let mut all: Vec<Effect> = Effect::ALL.to_vec();
    // In the acceleration an offset of the output is the bias: ranked once.
    all.retain(|effect| !(acceleration && effect.name() == "output_offset"));
    all.extend(custom);
    all.extend(terms()?);
    all.retain(|effect| !current.effects.contains(effect));
    Ok(all)
}

/// Climbs from the study's own effects as far as the data justify.
pub(crate) fn climb(
    cases: &[Case],
    own: &[Effect],
    custom: &[Effect],
    units: Units,
    settings: &DiagnoseSettings,
    tell: &(dyn Fn(&str) + Sync),
) -> Result<Climb, DiagnoseError> {
    let base = fit_effects(cases, own, None, units)?;
    let mut climb = Climb {
        rungs: vec![base],
        additions: Vec::new(),
        attempts: Vec::new(),
        ranking: Ranking::default(),
        stopped: Stop::Full,
    };
    loop {
        let current = climb.rungs.last().expect("the climb begins with a rung").clone();
        tell(&format!("ranking what is missing beside {}", list(&current.effects)));
        climb.ranking = rank(cases, &current, &candidates(cases, &current, custom)?, units, settings, settings.control_campaigns)?;
        show(&climb.ranking, tell);
        if climb.additions.len() >= MOST_EFFECTS {
            climb.stopped = Stop::Full;
            break;
        }
        let best = match justified(&climb.ranking, &current, settings) {
            Ok(best) => best,
            Err(stop) => {
                climb.stopped = stop;
                break;
            }
        };
        let room = MOST_EFFECTS - climb.additions.len();
        let steps = choose(cases, &current, &climb.ranking, best, custom, units, settings, room, tell)?;
        for step in steps {
            climb.additions.push(step.0);
            climb.rungs.push(step.1);
        }
    }
    Ok(climb)
}

fn show(ranking: &Ranking, tell: &(dyn Fn(&str) + Sync)) {
        if std::env::var("SHOW").is_ok() {
            for c in ranking.candidates.iter().take(8) {
                tell(&format!("   {:28} T {:6.2} p {:.4} gain {:10.1} ± {:7.1} z {:.1} err {:.4} conv {} lin {} {:?}", c.effect.name(), c.score, c.p_family, c.gain(), c.gain_error(), c.clearness(), c.fitted.error(), c.fitted.converged, c.fitted.linearizations, c.fitted.shared_named()));
            }
        }
}

type Step = (Addition, Fitted);

fn step(ranking: &Ranking, index: usize, current: &Fitted) -> Step {
    let candidate = &ranking.candidates[index];
    let addition = Addition {
        effect: candidate.effect,
        p_family: candidate.p_family,
        heldout_gain: candidate.gain() / misfit(current),
        twins: twins(ranking, index),
    };
    (addition, candidate.fitted.clone())
}

/// What to add: one effect, or, where one leaves much, the two that together leave least. Of equals a catalogue effect
/// comes before an unlisted term.
#[allow(clippy::too_many_arguments)]
fn choose(
    cases: &[Case],
    current: &Fitted,
    ranking: &Ranking,
    best: usize,
    custom: &[Effect],
    units: Units,
    settings: &DiagnoseSettings,
    room: usize,
    tell: &(dyn Fn(&str) + Sync),
) -> Result<Vec<Step>, DiagnoseError> {
    let listed = ranking
        .candidates
        .iter()
        .position(|c| !is_unlisted(c.effect) && c.is_supported(settings));
    let winner = &ranking.candidates[best];
    let single = match listed {
        Some(listed) if winner.ahead_of(&ranking.candidates[listed]) < EQUAL => listed,
        _ => best,
    };
    let left = &ranking.candidates[single].fitted;
    let leaves_much = misfit(left) > MUCH_LEFT * misfit(current)
        && (!left.is_weighted || left.scale() > 1.0 + 2.0 * settings.smallest_gain);
    let half = |listed: usize| ranking.candidates[listed].gain() > 0.5 * winner.gain();
    let in_doubt = is_unlisted(winner.effect) && listed.is_some_and(half) || leaves_much;
    if room < 2 || !in_doubt {
        return Ok(vec![step(ranking, single, current)]);
    }
    let heldout = current.heldout(&|unit| unit);
    let mut pair: Option<(usize, Candidate, Step)> = None;
    let seeds = (0..ranking.candidates.len())
        .filter(|&index| {
            let candidate = &ranking.candidates[index];
            !is_unlisted(candidate.effect) && candidate.is_supported(settings)
        })
        .take(SEEDS);
    for seed in seeds {
        let first = &ranking.candidates[seed].fitted;
        tell(&format!("looking ahead from {}", list(&first.effects)));
        let mut seconds = candidates(cases, first, custom)?;
        seconds.retain(|&effect| !is_unlisted(effect));
        let next = rank(cases, first, &seconds, units, settings, 0)?;
        show(&next, tell);
        let Ok(second) = justified(&next, first, settings) else {
            continue;
        };
        let mut together = next.candidates[second].clone();
        together.gains = gains(&heldout, &together.fitted);
        if pair.as_ref().is_none_or(|(_, known, _)| together.gain() > known.gain()) {
            pair = Some((seed, together, step(&next, second, first)));
        }
    }
    let alone = &ranking.candidates[single];
    Ok(match pair {
        // Two catalogue effects that leave as little as one unlisted term are the simpler story.
        Some((seed, together, second))
            if together.gain() > alone.gain() && together.ahead_of(alone) > EQUAL
                || is_unlisted(alone.effect) && alone.ahead_of(&together) < EQUAL =>
        {
            vec![step(ranking, seed, current), second]
        }
        _ => vec![step(ranking, single, current)],
    })
}

/// Share of the misfit left by one effect beyond which two are tried together.
const MUCH_LEFT: f64 = 0.1;
/// Effects from which a second is looked for.
const SEEDS: usize = 3;

/// Squared residual beyond the noise; where the noise is not known, all of it.
pub(crate) fn misfit(fitted: &Fitted) -> f64 {
    let squares = fitted.squares();
    let noise = if fitted.is_weighted { fitted.count() as f64 } else { 0.0 };
    (squares - noise).max(squares * 1e-3)
}

/// Standard deviations within which two candidates explain equally much.
pub(crate) const EQUAL: f64 = 2.0;

/// Supported candidates that these data cannot tell from the one at `index`.
pub(crate) fn twins(ranking: &Ranking, index: usize) -> Vec<Effect> {
    let chosen = &ranking.candidates[index];
    ranking
        .candidates
        .iter()
        .filter(|other| {
            other.effect != chosen.effect
                && !is_unlisted(other.effect)
                && other.gain() > 0.0
                && other.clearness() > 1.0
                && chosen.ahead_of(other) < EQUAL
        })
        .map(|other| other.effect)
        .collect()
}

fn list(effects: &[Effect]) -> String {
    match effects {
        [] => "the base model".to_owned(),
        some => some.iter().map(|effect| effect.name()).collect::<Vec<_>>().join(" + "),
    }
}
