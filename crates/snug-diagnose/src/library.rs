//! Terms that are in no catalogue, to describe what no effect of it explains: the simplest polynomials in x and v and a
//! few shapes the field knows.

use crate::error::DiagnoseError;
use snug_campaign::Rig;
use snug_model::{CustomEffectSettings, CustomParameterSettings, Effect, Place, Scale};

/// One candidate: name, what it is in words, and expression of force \[N\].
struct Term {
    name: &'static str,
    says: &'static str,
    /// What it is where its size p is negative.
    says_below_zero: &'static str,
    /// `{slow}` is a speed \[m/s\] over which it turns or sets in, see [`Term::slow_m_per_s`].
    expression: &'static str,
    parameters: &'static [Factor],
}

/// Speeds over which two of the terms turn or set in, on a hand \[m/s\].
const SLOW_M_PER_S: [(&str, f64); 2] = [("sqrt_v_law", 0.001), ("abs_x_friction_law", 0.01)];

/// A number in an expression.
struct Factor {
    name: &'static str,
    unit: &'static str,
    /// Worth trying, the usual one first.
    starts: &'static [f64],
    minimum: f64,
    maximum: f64,
}

/// The factor p of a term that has no other number.
const fn p(unit: &'static str) -> Factor {
    Factor {
        name: "p",
        unit,
        starts: &[0.0],
        minimum: f64::NEG_INFINITY,
        maximum: f64::INFINITY,
    }
}

const TERMS: &[Term] = &[
    Term {
        name: "x_v_law",
        says: "damping that is stronger the further the tool turns, and weaker on the far side of rest",
        says_below_zero: "damping that is weaker the further the tool turns, and stronger on the far side of rest",
        expression: "p*x*v",
        parameters: &[p("N s/m^2")],
    },
    Term {
        name: "x2_v_law",
        says: "damping that grows with the square of the displacement",
        says_below_zero: "damping that falls with the square of the displacement",
        expression: "p*x^2*v",
        parameters: &[p("N s/m^3")],
    },
    Term {
        name: "abs_x_v_law",
        says: "damping that grows with the displacement",
        says_below_zero: "damping that falls with the displacement",
        expression: "p*abs(x)*v",
        parameters: &[p("N s/m^2")],
    },
    Term {
        name: "x_v2_law",
        says: "a spring that is stiffer the faster the tool moves, with the square of its speed",
        says_below_zero: "a spring that is softer the faster the tool moves, with the square of its speed",
        expression: "p*x*v^2",
        parameters: &[p("N s^2/m^3")],
    },
    Term {
        name: "x_v_abs_v_law",
        says: "damping that grows with the speed, and changes sign with the displacement",
        says_below_zero: "damping that falls with the speed, and changes sign with the displacement",
        expression: "p*x*v*abs(v)",
        parameters: &[p("N s^2/m^3")],
    },
    Term {
        name: "v2_law",
        says: "a push to one side that grows with the square of the speed",
        says_below_zero: "a pull to one side that grows with the square of the speed",
        expression: "p*v^2",
        parameters: &[p("N s^2/m^2")],
    },
    Term {
        name: "v3_law",
        says: "damping that grows with the square of the speed",
        says_below_zero: "damping that falls with the square of the speed",
        expression: "p*v^3",
        parameters: &[p("N s^3/m^3")],
    },
    Term {
        name: "sqrt_v_law",
        says: "something between friction and a damper: it grows with the root of the speed",
        says_below_zero: "damping that is weaker the slower the tool moves: it falls short of a damper's by the root of the speed",
        expression: "p*v/sqrt(abs(v)+{slow})",
        parameters: &[p("N s^0.5/m^0.5")],
    },
    Term {
        name: "stribeck_law",
        says: "friction that fades as the tool moves faster",
        says_below_zero: "friction that is missing at low speed and comes as the tool moves faster",
        expression: "p*tanh(v/0.002)*exp(-(v/v0)^2)",
        parameters: &[
            Factor {
                starts: &[1.0],
                ..p("N")
            },
            Factor {
                name: "v0",
                unit: "m/s",
                starts: &[0.05, 0.1],
                minimum: 0.005,
                maximum: 1.0,
            },
        ],
    },
    Term {
        name: "end_stop_law",
        says: "a second spring that is met beyond the displacement x0",
        says_below_zero: "a spring that gives way beyond the displacement x0",
        expression: "p*max(0,x-x0)",
        parameters: &[
            Factor {
                starts: &[1000.0],
                ..p("N/m")
            },
            Factor {
                name: "x0",
                unit: "m",
                starts: &[0.005, 0.01],
                minimum: 0.0005,
                maximum: 0.05,
            },
        ],
    },
    Term {
        name: "exponential_spring_law",
        says: "a spring that stiffens ever faster, as tissue does",
        says_below_zero: "a spring that gives way ever faster",
        expression: "p*(exp(x/x0)-1-x/x0)",
        parameters: &[
            Factor {
                starts: &[1.0],
                ..p("N")
            },
            Factor {
                name: "x0",
                unit: "m",
                starts: &[0.01, 0.005],
                minimum: 0.002,
                maximum: 0.1,
            },
        ],
    },
    Term {
        name: "latch_law",
        says: "a force that turns over where the grip passes x0, as at a latch",
        says_below_zero: "a force that turns over where the grip passes x0, and pushes away from there",
        expression: "p*tanh((x-x0)/0.001)",
        parameters: &[
            Factor {
                starts: &[2.0],
                ..p("N")
            },
            Factor {
                name: "x0",
                unit: "m",
                starts: &[0.0, 0.004, 0.008],
                minimum: -0.02,
                maximum: 0.05,
            },
        ],
    },
    Term {
        name: "late_damping_law",
        says: "a damper that sets in a time t0 after the pulse begins",
        says_below_zero: "a damper that lets go a time t0 after the pulse begins",
        expression: "p*v*smooth_step((t-t0)/0.05)",
        parameters: &[
            Factor {
                starts: &[5.0],
                ..p("N s/m")
            },
            Factor {
                name: "t0",
                unit: "s",
                starts: &[0.08, 0.04, 0.12],
                minimum: 0.0,
                maximum: 0.3,
            },
        ],
    },
    Term {
        name: "x4_law",
        says: "a spring that sets in late and pushes to one side only",
        says_below_zero: "a spring that gives way late and to one side only",
        expression: "p*x^4",
        parameters: &[p("N/m^4")],
    },
    Term {
        name: "x5_law",
        says: "a spring that hardly acts at first and stiffens steeply",
        says_below_zero: "a spring that hardly changes at first and gives way steeply",
        expression: "p*x^5",
        parameters: &[p("N/m^5")],
    },
    Term {
        name: "abs_x_x_law",
        says: "a spring that stiffens in proportion to the displacement",
        says_below_zero: "a spring that softens in proportion to the displacement",
        expression: "p*x*abs(x)",
        parameters: &[p("N/m^2")],
    },
    Term {
        name: "abs_x_friction_law",
        says: "friction that grows with the displacement",
        says_below_zero: "friction that falls with the displacement",
        expression: "p*abs(x)*tanh(v/{slow})",
        parameters: &[p("N/m")],
    },
    Term {
        name: "x_abs_v_law",
        says: "a spring that is stiffer the faster the tool moves",
        says_below_zero: "a spring that is softer the faster the tool moves",
        expression: "p*x*abs(v)",
        parameters: &[p("N s/m^2")],
    },
    Term {
        name: "torque_v_law",
        says: "damping that grows with the torque",
        says_below_zero: "damping that falls with the torque",
        expression: "p*T*v",
        parameters: &[p("s/m^2")],
    },
    Term {
        name: "sine_law",
        says: "a weight on an arm, as of a pendulum",
        says_below_zero: "a weight on an arm that stands upright, as of an inverted pendulum",
        expression: "p*sin(theta)",
        parameters: &[p("N")],
    },
];

/// Every term as an effect on a rig of this scale; on a machine those that have no number but p: places, speeds and times are a
/// hand's.
pub(crate) fn terms(scale: Scale, rig: &Rig) -> Result<Vec<Effect>, DiagnoseError> {
    let is_machine = matches!(scale, Scale::Rig { .. });
    let can_act = |term: &&Term| !is_machine || term.parameters.len() == 1;
    let able = TERMS.iter().filter(can_act);
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

/// What an effect is in words, if it is one of these terms; `size` is that of its first number.
pub(crate) fn in_words(effect: Effect, size: f64) -> Option<&'static str> {
    let term = term(effect.name())?;
    Some(match size < 0.0 {
        true => term.says_below_zero,
        false => term.says,
    })
}

fn term(name: &str) -> Option<&'static Term> {
    TERMS.iter().find(|term| term.name == name)
}

impl Term {
    fn settings(&self, scale: Scale, rig: &Rig) -> CustomEffectSettings {
        let slow = self.slow_m_per_s(scale, rig);
        CustomEffectSettings {
            name: self.name.to_owned(),
            place: Place::Force,
            expression: self.expression.replace("{slow}", &slow),
            parameters: self.parameters.iter().map(Factor::settings).collect(),
        }
    }
}

impl Term {
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
    fn settings(&self) -> CustomParameterSettings {
        CustomParameterSettings {
            name: self.name.to_owned(),
            unit: self.unit.to_owned(),
            start: self.starts[0],
            further_starts: self.starts[1..].to_vec(),
            minimum: self.minimum,
            maximum: self.maximum,
            shared: true,
        }
    }
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
        assert_eq!(FORCES.len(), TERMS.len());
        for &(name, expected) in FORCES {
            close(
                force_n(made_up::term(name), 2.0, 0.06, [0.012, -0.3]),
                expected,
                1e-9,
            );
        }
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
    fn a_machine_has_no_terms_with_places_speeds_or_times_of_a_hand() {
        let names = |scale| -> Vec<&str> {
            let terms = terms(scale, &RIG).expect("the terms are well formed");
            terms.iter().map(|term| term.name()).collect()
        };
        let (all, of_machine) = (names(Scale::HandOnTool), names(MACHINE));
        let a_hand_s: Vec<&&str> = all
            .iter()
            .filter(|name| !of_machine.contains(name))
            .collect();
        let expected = [
            "stribeck_law",
            "end_stop_law",
            "exponential_spring_law",
            "latch_law",
            "late_damping_law",
        ];
        assert_eq!(a_hand_s, expected.iter().collect::<Vec<_>>());
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
        let mut told: Vec<&str> = (TERMS.iter())
            .flat_map(|term| [term.says, term.says_below_zero])
            .collect();
        told.sort_unstable();
        told.dedup();
        assert_eq!(told.len(), 2 * TERMS.len());
    }
}
