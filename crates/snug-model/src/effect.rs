use crate::{Input, Number};

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
    /// Unit as people write it.
    pub unit: &'static str,
    /// Starting values, the usual one first; more than one where the cost has several minima.
    pub starts: &'static [f64],
    /// Smallest plausible value.
    pub minimum: f64,
    /// Largest plausible value.
    pub maximum: f64,
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
    /// Where it comes from in the literature.
    pub source: &'static str,
}

/// The instant at which a law is evaluated.
#[derive(Debug, Clone, Copy)]
pub struct Instant<N> {
    /// Torque that acts on the joint \[Nm\].
    pub torque_nm: N,
    /// Grip displacement x = l θ \[m\].
    pub x_m: N,
    /// Grip velocity v = l ω \[m/s\].
    pub v_m_per_s: N,
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
/// Every hook adds nothing unless an effect overrides it. `p` holds the effect's own parameters in the order of its
/// [`Description`], `own` its own states; the assembly decides where they live.
pub trait Law {
    /// What people read about it.
    fn description(&self) -> &'static Description;

    /// Added to the hand force F \[N\] (acts as −l F on the tool).
    #[inline(always)]
    fn force<N: Number>(&self, _p: &[N], _at: &Instant<N>, _own: &[N]) -> N {
        N::from(0.0)
    }

    /// Rates of its own states.
    #[inline(always)]
    fn rates<N: Number>(&self, _p: &[N], _at: &Instant<N>, _own: &[N], _rates: &mut [N]) {}

    /// Added to the logged torque to give the acting torque \[Nm\], at `time_s` after the first sample.
    #[inline(always)]
    fn torque<N: Number>(&self, _p: &[N], _input: &Input, _time_s: f64) -> N {
        N::from(0.0)
    }

    /// Initial angle \[rad\] and angular velocity \[rad/s\].
    #[inline(always)]
    fn initial<N: Number>(&self, _p: &[N]) -> (N, N) {
        (N::from(0.0), N::from(0.0))
    }

    /// What the sensor makes of the true motion; `since_rest_s` is the time since the integration of its signal began.
    #[inline(always)]
    fn measure<N: Number>(
        &self,
        _p: &[N],
        _since_rest_s: f64,
        motion: Kinematics<N>,
    ) -> Kinematics<N> {
        motion
    }

    /// True when the effect only changes what is measured, so that the motion itself stays the base model's.
    fn measurement_only(&self) -> bool {
        false
    }
}
