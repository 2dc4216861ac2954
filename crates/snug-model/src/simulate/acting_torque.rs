//! From the torque that is logged to the one that acts on the joint: delay, lag, offset, how a drive follows, and what effects add.

use crate::assembly::inputs::SimulationInputs;
use crate::assembly::layout::Part;
use crate::input::torque::Earlier;
use crate::law::{Instant, Law, LoggedTorque};
use crate::numeric::lanewise::{Lanewise, Task};
use crate::numeric::number::{Number, Real};
use crate::simulate::actuator::{Actuator, Within};

/// The torque that acts on the joint, from the one that is logged.
pub struct ActingTorque<'a, N: Number> {
    inputs: &'a SimulationInputs<'a, N::Real>,
    /// Absent when the one that is logged acts.
    logged: Option<Logged<N>>,
    /// Absent when the drive gives what it is told.
    drive: Option<Drive<N>>,
}

/// How a drive follows, and what it gave up to every grid point.
struct Drive<N> {
    actuator: Actuator<N>,
    given: Vec<N>,
}

/// How it is logged, and what was logged before every grid point.
struct Logged<N: Number> {
    how: LoggedTorque<N>,
    shifted: Vec<Shifted<N::Real>>,
}

/// The logged torque a delay ago.
#[derive(Clone, Copy)]
struct Shifted<R> {
    torque_nm: R,
    slope_nm_per_s: R,
    /// The slope that no single sample's noise disturbs, and how fast it changes.
    rate_nm_per_s: R,
    change_nm_per_s2: R,
}

impl<'a, N: Number> ActingTorque<'a, N> {
    /// What the effects `parts` say about how it is logged, summed; `p` are all parameters.
    pub fn new(parts: &[Part], p: &[N], inputs: &'a SimulationInputs<'a, N::Real>) -> Self {
        let logged = parts
            .iter()
            .filter_map(|part| part.effect.logged_torque(&p[part.parameters.clone()]))
            .reduce(|sum, more| LoggedTorque {
                delay_s: sum.delay_s + more.delay_s,
                lag_s: sum.lag_s + more.lag_s,
                offset_nm: sum.offset_nm + more.offset_nm,
            });
        let mut acting = Self {
            inputs,
            logged: logged.map(|how| Logged {
                shifted: shifted(inputs, how.delay_s.value()),
                how,
            }),
            drive: None,
        };
        acting.drive = actuator(parts, p, inputs).map(|actuator| {
            let given = inputs.zero.vectorize(Giving {
                acting: &acting,
                actuator: &actuator,
            });
            Drive { actuator, given }
        });
        acting
    }

    /// What was told before the first grid point.
    fn before(&self) -> N {
        let first = self.told(0);
        let zero = self.inputs.zero;
        let is_known = |lane: usize| self.inputs.of_lanes()[lane].torque_before_nm();
        let known = zero.lane_by_lane(|lane| is_known(lane).unwrap_or_default());
        let lanes = zero.lane_by_lane(|lane| f64::from(u8::from(is_known(lane).is_some())));
        N::select(lanes.is_positive(), N::from(known), first)
    }

    /// Whether it depends on no parameter.
    pub fn is_known(&self) -> bool {
        self.logged.is_none() && self.drive.is_none()
    }

    /// Torque at grid point number `point` of the input \[Nm\].
    #[inline(always)]
    pub fn at(&self, point: usize) -> N {
        match self.drive {
            Some(_) => self.within(point)[0],
            None => self.told(point),
        }
    }

    /// Torque within the step from a grid point.
    #[inline(always)]
    pub fn within(&self, point: usize) -> Within<N> {
        if self.is_known() {
            let told = self.inputs.torque_nm()[point];
            let rise = match self.next(point) {
                Some(next) => self.inputs.torque_nm()[next] - told,
                None => told.constant(0.0),
            };
            return [
                N::from(told),
                N::from(told + rise * 0.5),
                N::from(told + rise),
            ];
        }
        let told = self.told(point);
        let rise = self.rise(told, point);
        match &self.drive {
            Some(Drive { actuator, given }) => actuator.within(given[point], told, rise),
            None => [told, told + rise * 0.5, told + rise],
        }
    }

    /// By how much what is `told` at a grid point rises within the step from there.
    #[inline(always)]
    fn rise(&self, told: N, point: usize) -> N {
        match self.next(point) {
            Some(next) => self.told(next) - told,
            None => told.constant(0.0),
        }
    }

    /// The grid point to which the torque goes straight from a `point`; none where it stays as it is.
    #[inline(always)]
    fn next(&self, point: usize) -> Option<usize> {
        let last = self.inputs.torque_nm().len().saturating_sub(1);
        (!self.inputs.held && point < last).then_some(point + 1)
    }

    /// What is told at a grid point \[Nm\], whatever a drive makes of it.
    #[inline(always)]
    fn told(&self, point: usize) -> N {
        let Some(Logged { how, shifted }) = &self.logged else {
            return N::from(self.inputs.torque_nm()[point]);
        };
        let then = shifted[point];
        let delay = how.delay_s;
        delay.chain(then.torque_nm, -then.slope_nm_per_s)
            + how.lag_s * delay.chain(then.rate_nm_per_s, -then.change_nm_per_s2)
            - how.offset_nm
    }
}

/// What a drive gave up to every grid point; before the first it rested at what it was told there.
struct Giving<'a, N: Number> {
    acting: &'a ActingTorque<'a, N>,
    actuator: &'a Actuator<N>,
}

impl<N: Number> Task for Giving<'_, N> {
    type Output = Vec<N>;
    #[inline(always)]
    fn run(self) -> Vec<N> {
        let Self { acting, actuator } = self;
        let points = acting.inputs.torque_nm().len();
        let mut given = Vec::with_capacity(points);
        let mut last = acting.before();
        for point in 0..points {
            given.push(last);
            let told = acting.told(point);
            last = actuator.within(last, told, acting.rise(told, point))[2];
        }
        given
    }
}

/// How the drive follows by the effects `parts`, if any says so.
fn actuator<N: Number>(
    parts: &[Part],
    p: &[N],
    inputs: &SimulationInputs<'_, N::Real>,
) -> Option<Actuator<N>> {
    let lags =
        (parts.iter()).filter_map(|part| part.effect.actuator_lag_s(&p[part.parameters.clone()]));
    let lag_s = lags.reduce(|sum, more| sum + more);
    let rate = (parts.iter())
        .find_map(|part| (part.effect).actuator_rate_nm_per_s(&p[part.parameters.clone()]));
    if lag_s.is_none() && rate.is_none() {
        return None;
    }
    let (at_once, step_s) = (N::from(inputs.zero), inputs.interval_s);
    let actuator = Actuator::new(lag_s.unwrap_or(at_once), step_s);
    Some(match rate {
        Some(rate) => actuator.no_faster_than(rate, step_s),
        None => actuator,
    })
}

/// The logged torque `delay_s` before every grid point; each lane looks it up in its own input.
fn shifted<R: Real>(inputs: &SimulationInputs<'_, R>, delay_s: R) -> Vec<Shifted<R>> {
    let (points, zero) = (inputs.torque_nm().len(), inputs.zero);
    let found: Vec<Vec<Earlier>> = (inputs.of_lanes().iter().zip(delay_s.lanes()))
        .map(|(input, &delay_s)| input.before(delay_s))
        .collect();
    (0..points)
        .map(|point| {
            // A lane whose input has ended keeps its last value.
            let of = |lane: usize| -> Earlier {
                let earlier = found[lane].get(point).or(found[lane].last());
                earlier.copied().unwrap_or_default()
            };
            Shifted {
                torque_nm: zero.lane_by_lane(|lane| of(lane).torque_nm),
                slope_nm_per_s: zero.lane_by_lane(|lane| of(lane).slope_nm_per_s),
                rate_nm_per_s: zero.lane_by_lane(|lane| of(lane).rate_nm_per_s),
                change_nm_per_s2: zero.lane_by_lane(|lane| of(lane).change_nm_per_s2),
            }
        })
        .collect()
}

/// The instant with what the effects `parts` add to the torque at it, each on top of the same torque.
#[inline(always)]
pub fn with_added_torque<N: Number>(parts: &[Part], p: &[N], at: Instant<N>) -> Instant<N> {
    let mut torque_nm = at.torque_nm;
    for part in parts {
        if let Some(added) = part.effect.torque(&p[part.parameters.clone()], &at) {
            torque_nm += added;
        }
    }
    Instant { torque_nm, ..at }
}
