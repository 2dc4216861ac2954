//! From the true motion to the measured one, sample by sample.

use crate::assembly::inputs::SimulationInputs;
use crate::assembly::layout::{Assembly, Part};
use crate::effects::Effect;
use crate::law::{Instant, Kinematics, Law};
use crate::numeric::number::Number;
use crate::simulate::accelerometer::Accelerometer;
use crate::simulate::acting_torque::{ActingTorque, with_added_torque};

/// The motion of the tool at one sample, and the effects' own states there with their rates.
#[derive(Debug, Clone, Copy)]
pub struct Moment<'s, N> {
    /// θ, ω, α of the tool.
    pub motion: Kinematics<N>,
    /// The effects' own states; none where they have none.
    pub own: &'s [N],
    /// Their rates.
    pub own_rates: &'s [N],
}

impl<'s, N> Moment<'s, N> {
    /// These three.
    #[inline(always)]
    pub fn new(motion: Kinematics<N>, own: &'s [N], own_rates: &'s [N]) -> Self {
        Self {
            motion,
            own,
            own_rates,
        }
    }
}

/// From the true motion to the measured one: cross-sensitivities and lag of the accelerometer, then what is added to its signals.
pub struct Sensors<'a, N: Number> {
    parts: &'a [Part],
    p: &'a [N],
    inputs: &'a SimulationInputs<'a, N::Real>,
    acting_torque: &'a ActingTorque<'a, N>,
    /// Whether what is measured moves otherwise than what is driven.
    is_elsewhere: bool,
    /// Absent when no effect of the assembly needs it.
    accelerometer: Option<Accelerometer<N>>,
}

impl<'a, N: Number> Sensors<'a, N> {
    /// At rest before the first sample.
    #[inline(always)]
    pub fn new(
        assembly: &'a Assembly,
        p: &'a [N],
        inputs: &'a SimulationInputs<'a, N::Real>,
        acting_torque: &'a ActingTorque<'a, N>,
    ) -> Self {
        let zero = N::from(inputs.zero);
        let still = Kinematics {
            displacement_rad: zero,
            velocity_rad_per_s: zero,
            acceleration_rad_per_s2: zero,
        };
        let mut sensors = Self {
            parts: assembly.parts(),
            p,
            inputs,
            acting_torque,
            is_elsewhere: moves_elsewhere(assembly.parts()),
            accelerometer: None,
        };
        let lag = sensors.total(
            #[inline(always)]
            |effect, p| effect.acceleration_lag_s(p),
        );
        if lag.is_some() || sensors.cross_sensitivity(0, &still).is_some() {
            let interval_s = inputs.since_rest_s(1) - inputs.since_rest_s(0);
            // A motion that is taken up again changes its velocity at once.
            let jumps = inputs.held && !inputs.is_restarted();
            sensors.accelerometer = Some(Accelerometer::new(interval_s, lag, jumps));
        }
        sensors
    }

    /// The measured motion of the next sample, which is number `index`.
    #[inline(always)]
    pub fn sample(&mut self, index: usize, moment: &Moment<'_, N>) -> Kinematics<N> {
        let mut motion = moment.motion;
        if self.is_elsewhere {
            let at = self.instant(index, &motion);
            motion = motion.plus(&relative_motion(self.parts, self.p, &at, moment));
        }
        let mut seen = motion;
        if self.accelerometer.is_some() {
            let cross_sensitivity = self.cross_sensitivity(index, &motion);
            if let Some(accelerometer) = &mut self.accelerometer {
                seen = accelerometer.sample(motion, cross_sensitivity);
            }
        }
        let since_rest_s = self.inputs.since_rest_s(index);
        for part in self.parts {
            let own = &self.p[part.parameters.clone()];
            seen = part.effect.measure(own, since_rest_s, seen).unwrap_or(seen);
        }
        seen
    }

    /// Whether an effect of the assembly changes what is measured of the motion.
    pub fn are_heard(&self) -> bool {
        self.parts
            .iter()
            .any(|part| part.answered.are_heard_by_sensors())
    }

    #[inline(always)]
    fn cross_sensitivity(&self, index: usize, motion: &Kinematics<N>) -> Option<N> {
        let at = self.instant(index, motion);
        self.total(
            #[inline(always)]
            |effect, p| effect.cross_sensitivity(p, &at, motion),
        )
    }

    /// The instant of sample `index`, at which the true motion is `motion`.
    #[inline(always)]
    fn instant(&self, index: usize, motion: &Kinematics<N>) -> Instant<N> {
        let point = index * self.inputs.substeps;
        let lever = self.inputs.lever_arm_m;
        let at = Instant {
            torque_nm: self.acting_torque.at(point),
            x_m: motion.displacement_rad.times(lever),
            v_m_per_s: motion.velocity_rad_per_s.times(lever),
            since_onset_s: (self.inputs).since_onset_s(self.inputs.interval_s * point as f64),
            lever_arm_m: lever,
        };
        with_added_torque(self.parts, self.p, at)
    }

    /// The sum of what the effects add to the same place, if any adds to it.
    #[inline(always)]
    fn total(&self, of: impl Fn(Effect, &[N]) -> Option<N>) -> Option<N> {
        let mut total: Option<N> = None;
        for part in self.parts {
            if let Some(more) = of(part.effect, &self.p[part.parameters.clone()]) {
                total = Some(match total {
                    Some(sum) => sum + more,
                    None => more,
                });
            }
        }
        total
    }
}

/// Whether what is measured moves otherwise than what is driven.
pub fn moves_elsewhere(parts: &[Part]) -> bool {
    parts.iter().any(|part| part.answered.relative_motion)
}

/// How it moves beside that, with all that the effects `parts` say; `p` are all parameters.
#[inline(always)]
pub fn relative_motion<N: Number>(
    parts: &[Part],
    p: &[N],
    at: &Instant<N>,
    moment: &Moment<'_, N>,
) -> Kinematics<N> {
    let none = at.x_m.constant(0.0);
    let mut whole = Kinematics {
        displacement_rad: none,
        velocity_rad_per_s: none,
        acceleration_rad_per_s2: none,
    };
    for part in parts.iter().filter(|part| part.answered.relative_motion) {
        let own = &moment.own[part.states.clone()];
        let rates = &moment.own_rates[part.states.clone()];
        let p = &p[part.parameters.clone()];
        if let Some(more) = part.effect.relative_motion(p, at, own, rates) {
            whole = whole.plus(&more);
        }
    }
    whole
}

impl<N: Number> Kinematics<N> {
    /// Both motions together.
    #[inline(always)]
    fn plus(self, other: &Self) -> Self {
        Self {
            displacement_rad: self.displacement_rad + other.displacement_rad,
            velocity_rad_per_s: self.velocity_rad_per_s + other.velocity_rad_per_s,
            acceleration_rad_per_s2: self.acceleration_rad_per_s2 + other.acceleration_rad_per_s2,
        }
    }
}
