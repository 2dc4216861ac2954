//! Terms that are in no catalogue, to describe what no effect of it explains: the simplest polynomials in x and v and a
//! few shapes the field knows.

mod terms;

use self::terms::{Factor, OF_A_HAND, OF_A_MACHINE, TERMS, Term};
use crate::error::DiagnoseError;
use snug_campaign::Rig;
use snug_campaign::words::effect_name::Named;
use snug_model::{CustomEffectSettings, CustomParameterSettings, Effect, Place, Scale};

/// Speeds over which two of the terms turn or set in, on a hand \[m/s\].
const SLOW_M_PER_S: [(&str, f64); 2] = [("sqrt_v_law", 0.001), ("abs_x_friction_law", 0.01)];

/// A displacement over which a force turns over that acts all at once, on a hand \[m\]. Chosen: a five-hundredth of a hand's motion; of a made-up
/// spring with a preload that turns over that fast, 1e-4 leaves three times as much, and half of it no more than half as much again.
const NEAR_M: f64 = 2e-5;

/// A torque at which one whose square acts is as large as one that acts itself, on a hand \[Nm\]. Chosen: of a hand's size, so that the
/// factor is of the size of 1 over the lever arm.
const LARGE_NM: f64 = 10.0;

/// Terms, and those of fewer numbers that each is where some of its own are equal or out of reach.
const SPECIAL_CASES: [(&str, &[&str]); 1] = [(
    "uneven_slack_spring_law",
    &["slack_spring_law", "end_stop_law", "lower_end_stop_law"],
)];

/// Whether `simple` is a special case of the term `rich`.
pub(crate) fn is_special_case(simple: Effect, rich: Effect) -> bool {
    let mut all = SPECIAL_CASES.iter();
    all.any(|(of, cases)| *of == rich.name() && cases.contains(&simple.name()))
}

/// Every term that can act on a rig of this scale, as an effect.
pub(crate) fn terms(scale: Scale, rig: &Rig) -> Result<Vec<Effect>, DiagnoseError> {
    let more = match scale {
        Scale::Rig { .. } => OF_A_MACHINE,
        _ => OF_A_HAND,
    };
    let able = TERMS.iter().chain(more);
    able.map(|term| Ok(Effect::custom(&term.settings(scale, rig))?))
        .collect()
}

/// How a study declares the effect, if it is one of these terms.
pub(crate) fn declaration(effect: Effect) -> Option<CustomEffectSettings> {
    term(effect.name())?;
    match effect {
        Effect::Custom(law) => Some(law.settings().clone()),
        _ => None,
    }
}

/// An effect by itself, with its expression if it is one of these terms.
pub(crate) fn named(effect: Effect) -> Named {
    let expression = declaration(effect).map(|term| term.expression);
    Named::alone(effect.name().to_owned(), expression)
}

/// What an effect is in words, if it is one of these terms; `size` is that of its first number.
pub(crate) fn in_words(effect: Effect, size: f64) -> Option<&'static str> {
    let term = term(effect.name())?;
    Some(match size < 0.0 {
        true => term.says_below_zero,
        false => term.says,
    })
}

fn term(name: &str) -> Option<&'static Term> {
    let mut all = TERMS.iter().chain(OF_A_HAND).chain(OF_A_MACHINE);
    all.find(|term| term.name == name)
}

impl Term {
    fn settings(&self, scale: Scale, rig: &Rig) -> CustomEffectSettings {
        let slow = self.slow_m_per_s(scale, rig);
        // Any of this size does: the factor makes up for it.
        let large_nm = format!("{:.0e}", LARGE_NM * scale.times_hand("Nm", rig));
        let near_m = format!("{:.0e}", NEAR_M * scale.times_hand("m", rig));
        CustomEffectSettings {
            name: self.name.to_owned(),
            place: Place::Force,
            expression: (self.expression)
                .replace("{slow}", &slow)
                .replace("{near}", &near_m)
                .replace("{large}", &large_nm),
            parameters: (self.parameters.iter())
                .map(|factor| factor.settings(scale.times_hand(factor.unit, rig)))
                .collect(),
        }
    }

    /// The speed that its expression names, as a hand or as much more or less as a rig moves.
    fn slow_m_per_s(&self, scale: Scale, rig: &Rig) -> String {
        let of_hand = SLOW_M_PER_S.iter().find(|(name, _)| *name == self.name);
        let times = scale.times_hand("m/s", rig);
        match of_hand.map(|(_, speed)| speed) {
            Some(speed) if times == 1.0 => speed.to_string(),
            Some(speed) => format!("{:e}", speed * times),
            None => String::new(),
        }
    }
}

impl Factor {
    /// Its numbers on a rig where they are so many times a hand's.
    fn settings(&self, times_hand: f64) -> CustomParameterSettings {
        let mut starts = self.starts.iter().map(|start| start * times_hand);
        CustomParameterSettings {
            name: self.name.to_owned(),
            unit: self.unit.to_owned(),
            start: starts.next().unwrap_or_default(),
            further_starts: starts.collect(),
            minimum: self.minimum * times_hand,
            maximum: self.maximum * times_hand,
            shared: true,
        }
    }
}

/// Whether it is a term that turns over all at once where the displacement does, as dry friction where the speed does.
pub(crate) fn turns_at_once(effect: Effect) -> bool {
    term(effect.name()).is_some_and(|term| term.expression.contains("{near}"))
}

/// Whether an effect is one of these terms.
pub(crate) fn is_unlisted(effect: Effect) -> bool {
    term(effect.name()).is_some()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::made_up::{self, RIG, close};
    use snug_model::{Instant, Law};

    /// Twice a hand's speed: 0.06 rad · 0.33 m in 0.04 s.
    const MACHINE: Scale = Scale::Rig {
        torque_nm: 10.0,
        angle_rad: 0.06,
        time_s: 0.04,
    };

    #[test]
    fn a_term_that_takes_away_is_told_as_one_that_takes_away() {
        let [effect] = terms(MACHINE, &RIG)
            .expect("the terms are well formed")
            .into_iter()
            .filter(|one| one.name() == "sqrt_v_law")
            .collect::<Vec<_>>()[..]
        else {
            panic!("there is one such term");
        };
        let says = |size| in_words(effect, size).expect("it is a term");
        assert!(says(2.0).contains("grows with the root of the speed"));
        assert!(says(-2.0).contains("weaker the slower"));
        assert!(in_words(Effect::CubicStiffness, -2.0).is_none());
    }

    /// Forces \[N\] of the terms with p = 2 where x = 12 mm, v = −0.3 m/s, T = 25 Nm on an arm of 0.33 m, 60 ms after the
    /// onset, their other number at its usual start; NumPy 2.4.6.
    const FORCES: &[(&str, f64)] = &[
        ("x_v_law", -0.0072),
        ("x2_v_law", -8.64e-5),
        ("abs_x_v_law", -0.0072),
        ("x_v2_law", 0.00216),
        ("x_v_abs_v_law", -0.00216),
        ("v2_law", 0.18),
        ("v3_law", -0.054),
        ("sqrt_v_law", -1.093_623_924_864_733_7),
        // −2 tanh(150) exp(−36).
        ("stribeck_law", -4.639_045_660_487e-16),
        ("end_stop_law", 0.014),
        ("exponential_spring_law", 2.240_233_845_473_094_6),
        // 2 tanh(12).
        ("latch_law", 1.999_999_999_848_994_7),
        // It has not begun.
        ("late_damping_law", 0.0),
        ("x4_law", 4.1472e-8),
        ("x5_law", 4.976_64e-10),
        ("abs_x_x_law", 2.88e-4),
        ("abs_x_friction_law", -0.024),
        ("x_abs_v_law", 0.0072),
        ("torque_v_law", -15.0),
        ("sine_law", 0.072_711_245_737_859_18),
        ("abs_x_law", 0.024),
        // It is 5 mm on the other side.
        ("lower_end_stop_law", 0.0),
        ("uneven_slack_spring_law", 0.01),
        // Beyond 5 mm.
        ("slack_spring_law", 0.01),
        // 2 tanh(600).
        ("preload_law", 2.0),
        ("abs_torque_law", 50.0),
        ("peak_v_law", -0.06),
        ("level_v_law", -0.189_736_659_610_102_8),
        // 2 (25 − 62.5).
        ("torque2_law", -75.0),
        ("torque_abs_torque_law", -75.0),
        ("torque_x_law", 0.6),
        ("torque_x2_law", 0.0072),
        ("torque_abs_v_law", 15.0),
    ];

    fn force_n(effect: Effect, size: f64, since_onset_s: f64, [x_m, v_m_per_s]: [f64; 2]) -> f64 {
        let specs = effect.description().parameters;
        let mut values: Vec<f64> = specs.iter().map(|spec| spec.starts[0]).collect();
        values[0] = size;
        let at = Instant {
            torque_nm: 25.0,
            x_m,
            v_m_per_s,
            since_onset_s,
            lever_arm_m: 0.33,
        };
        effect.force(&values, &at, &[]).expect("it is a force")
    }

    #[test]
    fn every_term_pushes_as_its_formula_says() {
        let all = TERMS.iter().chain(OF_A_HAND).chain(OF_A_MACHINE);
        assert_eq!(FORCES.len(), all.count());
        for &(name, expected) in FORCES {
            close(
                force_n(made_up::term(name), 2.0, 0.06, [0.012, -0.3]),
                expected,
                1e-9,
            );
        }
    }

    /// 2 · (5 mm − 12 mm), on either side.
    #[test]
    fn both_stops_push_back() {
        let pushes = |name, x| force_n(made_up::term(name), 2.0, 0.06, [x, 0.0]);
        close(pushes("end_stop_law", 0.012), 0.014, 1e-12);
        close(pushes("lower_end_stop_law", -0.012), -0.014, 1e-12);
        assert_eq!(pushes("end_stop_law", -0.012), 0.0);
        close(pushes("uneven_slack_spring_law", -0.012), -0.01, 1e-12);
    }

    /// Half of 2 · v, 25 ms after it has begun at 80 ms.
    #[test]
    fn a_late_damper_sets_in_at_its_time() {
        let late = made_up::term("late_damping_law");
        close(force_n(late, 2.0, 0.105, [0.0, -0.3]), -0.3, 1e-12);
        close(force_n(late, 2.0, 0.2, [0.0, -0.3]), -0.6, 1e-12);
    }

    /// As they begin a refit: a tool that rests where the hand is at ease stays there.
    #[test]
    fn no_term_pushes_a_tool_that_rests() {
        for effect in terms(Scale::HandOnTool, &RIG).expect("the terms are well formed") {
            let rest = force_n(
                effect,
                effect.description().parameters[0].starts[0],
                0.06,
                [0.0; 2],
            );
            assert_eq!(rest, 0.0, "{}", effect.name());
        }
    }

    #[test]
    fn a_hand_and_a_machine_have_terms_of_their_own() {
        let names = |scale| -> Vec<&str> {
            let terms = terms(scale, &RIG).expect("the terms are well formed");
            terms.iter().map(|term| term.name()).collect()
        };
        let (hand_s, machine_s) = (names(Scale::HandOnTool), names(MACHINE));
        let beyond = |all: &[&'static str], others: &[&str]| -> Vec<&str> {
            let own = all.iter().filter(|name| !others.contains(name));
            own.copied().collect()
        };
        let of_a_hand = [
            "stribeck_law",
            "exponential_spring_law",
            "latch_law",
            "late_damping_law",
        ];
        assert_eq!(beyond(&hand_s, &machine_s), of_a_hand);
        let of_a_machine = [
            "abs_x_law",
            "lower_end_stop_law",
            "slack_spring_law",
            "uneven_slack_spring_law",
            "preload_law",
            "peak_v_law",
            "level_v_law",
            "abs_torque_law",
            "torque2_law",
            "torque_abs_torque_law",
            "torque_x_law",
            "torque_x2_law",
            "torque_abs_v_law",
        ];
        assert_eq!(beyond(&machine_s, &hand_s), of_a_machine);
    }

    #[test]
    fn places_are_as_far_in_on_a_machine_that_moves_further() {
        let far = Scale::Rig {
            torque_nm: 10.0,
            angle_rad: 0.6,
            time_s: 0.04,
        };
        let [near, far] = [MACHINE, far].map(|scale| {
            let terms = terms(scale, &RIG).expect("the terms are well formed");
            let stop = terms.into_iter().find(|term| term.name() == "end_stop_law");
            declaration(stop.expect("there is such a term")).expect("it is one of them")
        });
        let [near, far] = [near, far].map(|stop| stop.parameters[1].clone());
        close(far.start / near.start, 10.0, 1e-12);
        close(far.maximum / near.minimum, 1000.0, 1e-12);
    }

    #[test]
    fn a_term_s_declaration_makes_the_same_effect_again() {
        let declared = declaration(made_up::term("end_stop_law")).expect("it is a term");
        assert_eq!(declared.parameters[1].further_starts, [0.01]);
        let again = Effect::custom(&declared).expect("the declaration is well formed");
        assert_eq!(again, made_up::term("end_stop_law"));
        assert!(is_unlisted(again) && !is_unlisted(Effect::CubicStiffness));
        assert!(declaration(Effect::CubicStiffness).is_none());
    }

    #[test]
    fn a_speed_that_is_slow_for_a_hand_is_as_slow_on_a_machine() {
        let term = |scale, name: &str| {
            let terms = terms(scale, &RIG).expect("the terms are well formed");
            let found = terms.into_iter().find(|term| term.name() == name);
            declaration(found.expect("there is such a term")).expect("it is one of them")
        };
        let says = |scale| term(scale, "abs_x_friction_law").expression;
        assert_eq!(says(Scale::HandOnTool), "p*abs(x)*tanh(v/0.01)");
        assert_eq!(says(MACHINE), "p*abs(x)*tanh(v/2e-2)");
    }

    #[test]
    fn no_two_terms_are_told_alike() {
        let all = || TERMS.iter().chain(OF_A_HAND).chain(OF_A_MACHINE);
        let mut told: Vec<&str> = all()
            .flat_map(|term| [term.says, term.says_below_zero])
            .collect();
        told.sort_unstable();
        told.dedup();
        assert_eq!(told.len(), 2 * all().count());
    }
}
