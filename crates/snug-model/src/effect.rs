use crate::numeric::number::Number;
use snug_campaign::Quantity;

/// Where in the chain from bolt to sample an effect sits.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// Passive mechanics of hand, arm and grip.
    Mechanical,
    /// Muscles and nerves.
    Muscular,
    /// Sensors and their alignment.
    Measurement,
    /// Change from tightening to tightening.
    Trend,
    /// A law that the study wrote itself.
    Custom,
}

impl Kind {
    /// What it is called in texts and files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Mechanical => "mechanical",
            Self::Muscular => "muscular",
            Self::Measurement => "measurement",
            Self::Trend => "trend",
            Self::Custom => "custom",
        }
    }
}

/// Over what an effect's parameter is constant.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Scope {
    /// A property of the rig or the sensor: may be shared by tightenings.
    Shared,
    /// Each tightening has its own.
    PerTightening,
}

/// One parameter of an effect.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct ParameterSpec {
    /// Name with unit suffix.
    pub name: &'static str,
    /// What it is, in a few words.
    pub meaning: &'static str,
    /// Unit as people write it.
    pub unit: &'static str,
    /// Starting values, the usual one first; more than one where the cost has several minima.
    pub starts: &'static [f64],
    /// Smallest plausible value.
    pub minimum: f64,
    /// Largest plausible value.
    pub maximum: f64,
    /// What a fit may reach: beyond what is plausible, where the law still means something. An estimate there says that
    /// something is wrong, and how much; one held at the edge of the plausible would hide it.
    pub limits: (f64, f64),
    /// Over what it is constant.
    pub scope: Scope,
}

/// What people read about an effect; the catalogue's text, bounds, columns and help all come from here.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Description {
    /// Fixed name in snake case.
    pub name: &'static str,
    /// Where it sits.
    pub kind: Kind,
    /// One sentence in plain words.
    pub summary: &'static str,
    /// What is added to the model's equations.
    pub equation: &'static str,
    /// Its parameters.
    pub parameters: &'static [ParameterSpec],
    /// Names of its own states, all zero at the start.
    pub states: &'static [&'static str],
    /// Effects that look alike in data.
    pub twins: &'static [&'static str],
    /// What has to happen in a tightening for it to show.
    pub excited_by: &'static str,
    /// How it shows in the residual of a model without it.
    pub shows_as: &'static str,
    /// What to check at the bench when it is suspected.
    pub check: &'static str,
    /// Where it comes from in the literature.
    pub source: &'static str,
}

impl Description {
    /// Whether its sizes are accelerations, or it comes of how an acceleration is measured.
    pub fn of_accelerometer(&self) -> bool {
        let is_acceleration = |spec: &ParameterSpec| spec.unit == "rad/s^2";
        self.parameters.iter().any(is_acceleration) || self.equation.starts_with("a ")
    }
}

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

/// A physical effect: what it adds to the base model, written once over the number type.
///
/// A hook that an effect does not override answers `None`, and so adds nothing. Whether a hook answers depends on the effect
/// alone, never on parameters or state: a simulation asks once and then leaves the silent ones out. `p` holds the effect's own parameters in the order of its
/// [`Description`], `own` its own states; the assembly decides where they live. What several effects add to the same
/// place is summed, so their order does not matter:
///
/// ```text
/// F = limit(k (1 + Σ stiffening) d + c dd/dt + Σ force + Σ delayed)     d = deflection(x − Σ support)
/// T = y(t − Σ delay) + Σ lag · y'(t − Σ delay) − Σ offset + Σ torque    y: logged torque
/// a = measure(lagged(α + Σ leak, Σ acceleration lag))
/// ```
pub trait Law {
    /// What people read about it.
    fn description(&self) -> &'static Description;

    /// Added to the hand force F \[N\] (acts as −l F on the tool).
    #[inline(always)]
    fn force<N: Number>(&self, _p: &[N], _at: &Instant<N>, _own: &[N]) -> Option<N> {
        None
    }

    /// Rates of its own states; `hand_n` is what the hand's spring and damper alone exert \[N\].
    #[inline(always)]
    fn rates<N: Number>(
        &self,
        _p: &[N],
        _at: &Instant<N>,
        _own: &[N],
        _hand_n: N,
        _rates: &mut [N],
    ) {
    }

    /// Where the far end of the hand's spring and damper is and how it moves; without it, at rest.
    #[inline(always)]
    fn support<N: Number>(&self, _p: &[N], _own: &[N]) -> Option<Deflection<N>> {
        None
    }

    /// What the hand's spring and damper see of the deflection between tool and support.
    #[inline(always)]
    fn deflection<N: Number>(&self, _p: &[N], _between: Deflection<N>) -> Option<Deflection<N>> {
        None
    }

    /// By how much of itself the hand's stiffness grows.
    #[inline(always)]
    fn stiffening<N: Number>(&self, _p: &[N], _at: &Instant<N>) -> Option<N> {
        None
    }

    /// What the grip transmits of the hand force \[N\].
    #[inline(always)]
    fn limit<N: Number>(&self, _p: &[N], _force_n: N) -> Option<N> {
        None
    }

    /// A spring that acts on the displacement of a while ago, added to the hand force.
    ///
    /// Before the first sample the tool rests at its first displacement.
    #[inline(always)]
    fn delayed<N: Number>(&self, _p: &[N]) -> Option<Delayed<N>> {
        None
    }

    /// How the logged torque relates to the torque that acts.
    #[inline(always)]
    fn logged_torque<N: Number>(&self, _p: &[N]) -> Option<LoggedTorque<N>> {
        None
    }

    /// Added to the torque that acts \[Nm\]; `at` holds that torque without such additions.
    #[inline(always)]
    fn torque<N: Number>(&self, _p: &[N], _at: &Instant<N>) -> Option<N> {
        None
    }

    /// Initial angle \[rad\] and angular velocity \[rad/s\]; without it, at rest.
    #[inline(always)]
    fn initial<N: Number>(&self, _p: &[N]) -> Option<(N, N)> {
        None
    }

    /// What else the accelerometer senses \[rad/s²\]; the velocity and displacement integrated from it follow.
    ///
    /// `at` is the instant of the true motion `motion`.
    #[inline(always)]
    fn cross_sensitivity<N: Number>(
        &self,
        _p: &[N],
        _at: &Instant<N>,
        _motion: &Kinematics<N>,
    ) -> Option<N> {
        None
    }

    /// Time constant \[s\] of the lag behind which the acceleration is measured; what is integrated from it follows.
    #[inline(always)]
    fn acceleration_lag_s<N: Number>(&self, _p: &[N]) -> Option<N> {
        None
    }

    /// What the sensor makes of the true motion; `since_rest_s` is the time since the integration of its signal began.
    #[inline(always)]
    fn measure<N: Number>(
        &self,
        _p: &[N],
        _since_rest_s: N::Real,
        _motion: Kinematics<N>,
    ) -> Option<Kinematics<N>> {
        None
    }

    /// True when the effect only changes what is measured, so that the motion itself stays the base model's.
    fn measurement_only(&self) -> bool {
        false
    }

    /// The effect that it is one and the same with where `compared` is all that is compared; of the two the other is
    /// ranked.
    fn same_as(&self, _compared: Quantity) -> Option<&'static str> {
        None
    }
}
