//! The terms themselves: those that act on a hand and on a machine, those of a hand alone, and those of a machine alone.

/// One candidate: name, what it is in words, and expression of force \[N\].
pub(super) struct Term {
    pub name: &'static str,
    pub says: &'static str,
    /// What it is where its size p is negative.
    pub says_below_zero: &'static str,
    /// `{slow}` is a speed \[m/s\] over which it turns or sets in, see [`Term::slow_m_per_s`]; `{near}` a displacement \[m\] over which it does,
    /// see `NEAR_M`; `{large}` a torque \[Nm\], see `LARGE_NM`.
    pub expression: &'static str,
    pub parameters: &'static [Factor],
}

/// A number in an expression.
pub(super) struct Factor {
    pub name: &'static str,
    pub unit: &'static str,
    /// Worth trying, the usual one first.
    pub starts: &'static [f64],
    pub minimum: f64,
    pub maximum: f64,
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

/// On a hand, and on a machine; places and sizes are a hand's, and follow a machine's scale.
pub(super) const TERMS: &[Term] = &[
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
        name: "end_stop_law",
        says: "a second spring that is met beyond the displacement x0",
        says_below_zero: "a spring that gives way beyond the displacement x0",
        expression: "p*max(0,x-x0)",
        parameters: &[SPRING, SIDE],
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

/// Speeds, lengths and times in these expressions are a hand's, or the catalogue has a machine's own effect for it.
pub(super) const OF_A_HAND: &[Term] = &[
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
];

/// A hand rests at one end of its way: it has no other side. A nutrunner's torque is measured where it acts; what drives a machine is often
/// a command, of which an actuator makes a force in its own way.
pub(super) const OF_A_MACHINE: &[Term] = &[
    Term {
        name: "abs_x_law",
        says: "a spring that is stiffer above rest than below it",
        says_below_zero: "a spring that is stiffer below rest than above it",
        expression: "p*abs(x)",
        parameters: &[p("N/m")],
    },
    Term {
        name: "lower_end_stop_law",
        says: "a second spring that is met below the displacement -x0",
        says_below_zero: "a spring that gives way below the displacement -x0",
        expression: "p*min(0,x+x0)",
        parameters: &[SPRING, SIDE],
    },
    Term {
        name: "slack_spring_law",
        says: "a spring that is stiffer within b of rest than beyond",
        says_below_zero: "a spring that is softer within b of rest than beyond, or does not act there",
        expression: "p*max(-b,min(b,x))",
        parameters: &[SPRING, Factor { name: "b", ..SIDE }],
    },
    Term {
        name: "uneven_slack_spring_law",
        says: "a spring that is stiffer between the displacements -x1 and x2 than beyond",
        says_below_zero: "a spring that is softer between the displacements -x1 and x2 than beyond, or does not act there, as between two stops",
        expression: "p*max(-x1,min(x2,x))",
        parameters: &[
            SPRING,
            Factor { name: "x1", ..SIDE },
            Factor { name: "x2", ..SIDE },
        ],
    },
    Term {
        name: "preload_law",
        says: "a preloaded spring: it pushes back with all of a force as soon as it is moved from rest, either way",
        says_below_zero: "a force that pushes away from rest as soon as it is moved from there, either way",
        expression: "p*tanh(x/{near})",
        parameters: &[p("N")],
    },
    Term {
        name: "peak_v_law",
        says: "a brake that is strongest at the speed v0, as of eddy currents",
        says_below_zero: "a pull along the motion that is strongest at the speed v0",
        expression: "p*v/(1+(v/v0)^2)",
        parameters: BRAKE,
    },
    Term {
        name: "level_v_law",
        says: "damping that levels off beyond the speed v0",
        says_below_zero: "damping that is weaker below the speed v0 than beyond",
        expression: "p*v/sqrt(1+(v/v0)^2)",
        parameters: BRAKE,
    },
    Term {
        name: "abs_torque_law",
        says: "an input that acts less forwards than backwards",
        says_below_zero: "an input that acts more forwards than backwards",
        expression: "p*abs(T)",
        parameters: &[p("N/Nm")],
    },
    Term {
        name: "torque2_law",
        says: "an input whose square acts as well, or instead",
        says_below_zero: "an input whose square acts against it",
        expression: "p*(T-T^2/{large})",
        parameters: &[p("N/Nm")],
    },
    Term {
        name: "torque_abs_torque_law",
        says: "an input that acts ever more the larger it is",
        says_below_zero: "an input that acts ever less the larger it is",
        expression: "p*(T-T*abs(T)/{large})",
        parameters: &[p("N/Nm")],
    },
    Term {
        name: "torque_x_law",
        says: "an input that acts less above rest than below it",
        says_below_zero: "an input that acts more above rest than below it",
        expression: "p*T*x",
        parameters: &[p("1/m^2")],
    },
    Term {
        name: "torque_x2_law",
        says: "an input that acts less the further the rig is from rest",
        says_below_zero: "an input that acts more the further the rig is from rest",
        expression: "p*T*x^2",
        parameters: &[p("1/m^3")],
    },
    Term {
        name: "torque_abs_v_law",
        says: "an input that acts less the faster the rig moves",
        says_below_zero: "an input that acts more the faster the rig moves",
        expression: "p*T*abs(v)",
        parameters: &[p("s/m^2")],
    },
];

/// Numbers of a damper that is another one beyond a speed.
const BRAKE: &[Factor] = &[
    Factor {
        starts: &[10.0],
        ..p("N s/m")
    },
    Factor {
        name: "v0",
        unit: "m/s",
        starts: &[0.1, 0.3],
        minimum: 0.01,
        maximum: 3.0,
    },
];

/// How much stiffer a spring is beyond some displacement, or within.
const SPRING: Factor = Factor {
    starts: &[1000.0],
    ..p("N/m")
};

/// How far from rest, to one side, it changes.
const SIDE: Factor = Factor {
    name: "x0",
    unit: "m",
    starts: &[0.005, 0.01],
    minimum: 0.0005,
    maximum: 0.05,
};
