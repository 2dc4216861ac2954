//! What a physical effect may add to the equations: every hook stated once, and who answers which.
//!
//! [`hooks!`] is the table. The trait, what is asked at every stage of a simulation and the forwarding of the catalogue's
//! enum are made from it: a new hook is one entry here and one place in `simulate/` where its answer acts.

use crate::description::Description;
use crate::numeric::number::Number;
use snug_campaign::Quantity;

/// The instant at which a law is evaluated.
#[derive(Debug, Clone, Copy)]
pub struct Instant<N: Number> {
    /// Torque that acts on the joint \[Nm\].
    pub torque_nm: N,
    /// Grip displacement x = l θ \[m\].
    pub x_m: N,
    /// Grip velocity v = l ω \[m/s\].
    pub v_m_per_s: N,
    /// Time since the pulse began, as the input states it \[s\].
    pub since_onset_s: N::Real,
    /// Lever arm l \[m\].
    pub lever_arm_m: N::Real,
}

/// How far the hand's spring is stretched and how fast its damper moves.
#[derive(Debug, Clone, Copy)]
pub struct Deflection<N> {
    /// Stretch of the spring \[m\].
    pub x_m: N,
    /// Speed of the damper \[m/s\].
    pub v_m_per_s: N,
}

/// Over what a contact sets in, so that the response can be differentiated.
#[derive(Debug, Clone, Copy)]
pub struct Corner<R> {
    /// Least length \[m\].
    pub length_m: R,
    /// Time \[s\]: the length is at least what the tool moves in it.
    pub time_s: R,
}

/// A spring that acts on the displacement of a while ago.
#[derive(Debug, Clone, Copy)]
pub struct Delayed<N> {
    /// Its stiffness \[N/m\].
    pub stiffness_n_per_m: N,
    /// The delay \[s\].
    pub delay_s: N,
}

/// How the torque y that is logged relates to the torque that acts: T(t) = y(t − d) + τ y'(t − d) − T0.
#[derive(Debug, Clone, Copy)]
pub struct LoggedTorque<N> {
    /// d, how much earlier it is logged than it acts \[s\].
    pub delay_s: N,
    /// τ of the first-order lag behind which it is logged \[s\].
    pub lag_s: N,
    /// T0, what is logged when none acts \[Nm\].
    pub offset_nm: N,
}

impl<N: Number> LoggedTorque<N> {
    /// The torque that acts is the one that is logged; in numbers of `kind`'s.
    pub fn faithful(kind: N) -> Self {
        let none = kind.constant(0.0);
        Self {
            delay_s: none,
            lag_s: none,
            offset_nm: none,
        }
    }
}

/// Places, among an effect's parameters, of those of a resonance.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Resonance {
    /// Its share in the output \[1/kg\], or the mass that swings \[kg\], as it is [`excited`](Self::excited_by).
    pub size: usize,
    /// Its frequency \[Hz\].
    pub frequency: usize,
    /// Its damping ratio \[–\].
    pub damping: usize,
    /// What makes it swing, and so what it acts on.
    pub excited_by: ExcitedBy,
}

/// What makes a resonance swing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ExcitedBy {
    /// The torque: q'' + 2 ζ ω q' + ω² q = r T / l, by which the grip's displacement grows.
    Torque,
    /// The grip's motion: a mass on a spring, that holds the grip back with what it is pulled along by.
    Motion,
}

/// The measured motion at one sample.
#[derive(Debug, Clone, Copy)]
pub struct Kinematics<N> {
    /// θ \[rad\].
    pub displacement_rad: N,
    /// ω \[rad/s\].
    pub velocity_rad_per_s: N,
    /// α \[rad/s²\].
    pub acceleration_rad_per_s2: N,
}

impl<N: Number> Kinematics<N> {
    /// That of a displacement \[m\] and a velocity \[m/s\] which are an effect's first two own states.
    #[inline(always)]
    pub fn of_states(at: &Instant<N>, own: &[N], own_rates: &[N]) -> Self {
        let per_lever = at.lever_arm_m.constant(1.0) / at.lever_arm_m;
        Self {
            displacement_rad: own[0].times(per_lever),
            velocity_rad_per_s: own[1].times(per_lever),
            acceleration_rad_per_s2: own_rates[1].times(per_lever),
        }
    }

    /// The same with `more` on whichever of the three is looked at, in its own unit.
    #[inline(always)]
    pub fn shifted(self, more: N) -> Self {
        Self {
            displacement_rad: self.displacement_rad + more,
            velocity_rad_per_s: self.velocity_rad_per_s + more,
            acceleration_rad_per_s2: self.acceleration_rad_per_s2 + more,
        }
    }
}

/// Hands every hook to the macro `to`: its documentation, its arguments after `p`, and what it answers as an `Option`.
///
/// `p` are the effect's own parameters in the order of its [`Description`], `own` its own states. Arguments of one name
/// have one type.
macro_rules! hooks {
    ($to:ident) => {
        $to! {
            asked_at_every_stage {
                /// Added to the torque that acts \[Nm\]; `at` holds that torque without such additions.
                fn torque(at: &Instant<N>) -> N;

                /// Where the far end of the hand's spring and damper is and how it moves; without it, at rest.
                fn support(own: &[N]) -> Deflection<N>;

                /// What the hand's spring and damper see of the deflection between tool and support.
                fn deflection(between: Deflection<N>, corner: &Corner<N::Real>) -> Deflection<N>;

                /// By how much of itself the hand's stiffness grows.
                fn stiffening(at: &Instant<N>) -> N;

                /// Added to the hand force F \[N\] (acts as −l F on the tool).
                fn force(at: &Instant<N>, own: &[N]) -> N;

                /// With what dry friction holds against every motion \[N\], not negative. Where the motion is simulated this stands for
                /// the law's `force`, which then says what friction does along a motion that is given.
                fn dry_friction_n(at: &Instant<N>) -> N;

                /// What the grip transmits of the hand force \[N\].
                fn limit(force_n: N) -> N;

                /// Sets the rates of its own states, all of them; `hand_n` is what the hand's spring and damper alone exert
                /// \[N\]. An effect with states answers this, one without does not.
                fn rates(at: &Instant<N>, own: &[N], hand_n: N, rates: &mut [N]) -> ();
            }
            asked_once {
                /// A spring that acts on the displacement of a while ago, added to the hand force.
                ///
                /// Before the first sample the tool rests at its first displacement.
                fn delayed() -> Delayed<N>;

                /// How the logged torque relates to the torque that acts.
                fn logged_torque() -> LoggedTorque<N>;

                /// Time constant \[s\] of the first-order lag through which a drive gives the torque that it is told.
                fn actuator_lag_s() -> N;

                /// Most by which what a drive gives changes \[Nm/s\]; one effect says so.
                fn actuator_rate_nm_per_s() -> N;

                /// Sets its own states as the motion begins, with the instant that this begins at; without it, 0.
                fn begins(at: &Instant<N>, begun: &mut [N]) -> ();

                /// Initial angle \[rad\] and angular velocity \[rad/s\]; without it, at rest.
                fn initial() -> (N, N);
            }
            asked_of_sensors {
                /// How the place that is measured moves beside the one that is driven, in the tool's angle. Displacement and
                /// velocity may depend on its own states only.
                fn relative_motion(at: &Instant<N>, own: &[N], own_rates: &[N]) -> Kinematics<N>;

                /// What else the accelerometer senses \[rad/s²\]; the velocity and displacement integrated from it follow.
                ///
                /// `at` is the instant of the true motion `motion`.
                fn cross_sensitivity(at: &Instant<N>, motion: &Kinematics<N>) -> N;

                /// Time constant \[s\] of the lag behind which the acceleration is measured; what is integrated from it
                /// follows.
                fn acceleration_lag_s() -> N;

                /// What the sensor makes of the motion `seen`; `since_rest_s` is the time since the integration of its signal
                /// began.
                fn measure(since_rest_s: N::Real, seen: Kinematics<N>) -> Kinematics<N>;
            }
        }
    };
}
pub(crate) use hooks;

/// Declares the trait with every hook silent.
macro_rules! declare_law {
    ($($asked:ident { $($(#[$doc:meta])* fn $hook:ident($($argument:ident: $Kind:ty),*) -> $Answer:ty;)+ })+) => {
        /// A physical effect: what it adds to the base model, written once over the number type.
        ///
        /// A hook that an effect does not override answers `None`, and so adds nothing. Whether a hook answers depends on
        /// the effect alone, never on parameters or state: a simulation asks once and then leaves the silent ones out. `p`
        /// holds the effect's own parameters in the order of its [`Description`], `own` its own states; the assembly decides
        /// where they live. What several effects add to the same place is summed, so their order does not matter:
        ///
        /// ```text
        /// F = limit(k (1 + Σ stiffening) d + c dd/dt + Σ force + Σ delayed)     d = deflection(x − Σ support)
        /// u = y(t − Σ delay) + Σ lag · y'(t − Σ delay) − Σ offset               y: logged torque
        /// T = q + Σ torque                                       q' Σ actuator lag = u − q, |q'| ≤ actuator rate
        /// a = measure(lagged(α' + Σ cross_sensitivity, Σ acceleration lag))        α' = α + Σ relative_motion
        /// ```
        pub trait Law {
            /// What people read about it.
            fn description(&self) -> &'static Description;

            $($(
                $(#[$doc])*
                #[inline(always)]
                #[allow(unused_variables)]
                fn $hook<N: Number>(&self, p: &[N], $($argument: $Kind),*) -> Option<$Answer> {
                    None
                }
            )+)+

            /// Which of its parameters is a wavelength of its force over the displacement, if one is; the others are then sizes
            /// that the force is proportional to. Where several wavelengths fit, whoever fits reads off the measurement with
            /// which to begin.
            fn wavelength(&self) -> Option<usize> {
                None
            }

            /// Which of its parameters a resonance of its own has, if it has one: read off the spectra where several fit.
            fn resonance(&self) -> Option<Resonance> {
                None
            }

            /// The effect that it is one and the same with where `compared` is all that is compared; of the two the other is
            /// ranked.
            fn same_as(&self, compared: Quantity) -> Option<&'static str> {
                let _ = compared;
                None
            }

            /// The effect that is the likelier story where both explain as much.
            fn likelier(&self) -> Option<&'static str> {
                None
            }

            /// Whether it bends to a little of everything, so that it is believed only where it explains nearly all that is missing.
            fn is_general(&self) -> bool {
                false
            }

            /// The effect that it is where it is the same in all recordings.
            fn of_all(&self) -> Option<&'static str> {
                None
            }

            /// The effect beside which alone it can be told, if there is one.
            fn beside(&self) -> Option<&'static str> {
                None
            }
        }
    };
}
hooks!(declare_law);

/// What a law is asked with to learn whether it answers: everything at rest, one value for each argument of [`hooks!`].
struct AtRest<'a> {
    at: &'a Instant<f64>,
    own: &'a [f64],
    own_rates: &'a [f64],
    rates: &'a mut [f64],
    begun: &'a mut [f64],
    between: Deflection<f64>,
    corner: &'a Corner<f64>,
    motion: &'a Kinematics<f64>,
    seen: Kinematics<f64>,
    force_n: f64,
    hand_n: f64,
    since_rest_s: f64,
}

impl<'a> AtRest<'a> {
    fn of(own: &'a [f64], rates: &'a mut [f64], begun: &'a mut [f64]) -> Self {
        const STILL: Kinematics<f64> = Kinematics {
            displacement_rad: 0.0,
            velocity_rad_per_s: 0.0,
            acceleration_rad_per_s2: 0.0,
        };
        Self {
            at: &Instant {
                torque_nm: 0.0,
                x_m: 0.0,
                v_m_per_s: 0.0,
                since_onset_s: 0.0,
                lever_arm_m: 1.0,
            },
            own,
            own_rates: own,
            rates,
            begun,
            between: Deflection {
                x_m: 0.0,
                v_m_per_s: 0.0,
            },
            corner: &Corner {
                length_m: 1e-6,
                time_s: 1e-5,
            },
            motion: &STILL,
            seen: STILL,
            force_n: 0.0,
            hand_n: 0.0,
            since_rest_s: 0.0,
        }
    }
}

/// Declares what is known of a law's answers, one field per hook and one question per group of hooks.
macro_rules! declare_answered_hooks {
    ($($asked:ident { $($(#[$doc:meta])* fn $hook:ident($($argument:ident: $Kind:ty),*) -> $Answer:ty;)+ })+) => {
        /// The hooks that one law answers.
        #[derive(Debug, Clone, Copy)]
        pub(crate) struct AnsweredHooks {
            $($(pub $hook: bool,)+)+
        }

        impl AnsweredHooks {
            /// Asks once at rest: whether a law answers a hook depends on the law alone.
            ///
            /// Out of line: every law of the catalogue is worked out in it.
            #[inline(never)]
            pub fn of(law: &impl Law) -> Self {
                let description = law.description();
                let p: Vec<f64> = (description.parameters.iter())
                    .map(|spec| spec.starts[0])
                    .collect();
                let own = vec![0.0; description.states.len()];
                let (mut rates, mut begun) = (own.clone(), own.clone());
                Self {
                    $($($hook: {
                        #[allow(unused_variables)]
                        let rest = AtRest::of(&own, &mut rates, &mut begun);
                        law.$hook(&p, $(rest.$argument),*).is_some()
                    },)+)+
                }
            }

            $(
                fn $asked(&self) -> bool {
                    [$(self.$hook),+].contains(&true)
                }
            )+
        }
    };
}
hooks!(declare_answered_hooks);

impl AnsweredHooks {
    /// Whether nothing but what is measured changes.
    pub fn are_of_sensors(&self) -> bool {
        self.asked_of_sensors() && !self.asked_at_every_stage() && !self.asked_once()
    }

    /// Whether what is measured of the motion differs from it.
    pub fn are_heard_by_sensors(&self) -> bool {
        self.asked_of_sensors()
    }

    /// Whether there are any.
    #[cfg(test)]
    pub fn are_any(&self) -> bool {
        self.asked_of_sensors() || self.asked_at_every_stage() || self.asked_once()
    }
}
