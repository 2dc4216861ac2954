//! Any assembly's response by the classical Runge–Kutta method, one step per grid point of the input.
//!
//! At 10 kHz the error of a step is (h ω)⁵/120 ≈ 1e−15 of the amplitude for an arm at 30 rad/s; a band-limited input
//! brings its own finer grid. What dry friction does within a step is known exactly where all else is constant, and acts in it as a
//! constant ([`Slowed`]). Where it slides on, that is known as the step begins; else such a step is made twice, first to learn what all else does.

use crate::assembly::inputs::{Restart, SimulationInputs};
use crate::assembly::layout::{Assembly, MAXIMUM_OWN_STATES};
use crate::law::{Instant, Kinematics};
use crate::numeric::number::Number;
use crate::simulate::acting_torque::ActingTorque;
use crate::simulate::dry_friction::{Slowed, at_once};
use crate::simulate::hook_set::HookSet;
use crate::simulate::plant::{Plant, initial_motion, own_states};
use crate::simulate::sensors::{Moment, moves_elsewhere, relative_motion};

const ENDS: f64 = 1.0 / 6.0;
const MIDDLE: f64 = 1.0 / 3.0;

/// How far ahead a stage is, in half intervals, how far on the next one, in intervals, and its weight in the mean.
const STAGES: [(usize, f64, f64); 4] = [
    (0, 0.5, ENDS),
    (1, 0.5, MIDDLE),
    (1, 1.0, MIDDLE),
    (2, 0.0, ENDS),
];

/// Simulates from rest (or the effects' initial motion, or again and again from the input's restarts) and hands every
/// sample's true motion and the effects' own states to `sample`.
///
/// `p` are all parameters of the assembly in its order.
///
/// The four stages are a loop, so that the equations stand once in the compiled program and stay in its cache. The first
/// stage's rates are those at the grid point itself: they give the sample's acceleration as well. Trial points are
/// changed where they lie: to copy numbers with their derivatives would take longer than to compute them. How many states
/// the effects have is known at run time only: for each number of them, the program would hold all of this once more.
#[inline(always)]
pub fn respond<N: Number>(
    assembly: &Assembly,
    p: &[N],
    inputs: &SimulationInputs<'_, N::Real>,
    acting_torque: &ActingTorque<'_, N>,
    mut sample: impl FnMut(usize, &Moment<'_, N>),
) {
    let (h, lever) = (inputs.interval_s, inputs.lever_arm_m);
    let [per_lever, per_h] = [lever, h].map(|one| inputs.zero.constant(1.0) / one);
    let hook_set = HookSet::with_dry_friction(assembly.parts(), p);
    let mut plant = Plant::new(assembly, p, inputs, acting_torque.is_known(), hook_set);
    let [mut x, mut v] = initial_motion(assembly.parts(), p).map(|one| one.times(lever));
    let states = assembly.own_state_count.min(MAXIMUM_OWN_STATES);
    let mut at = beginning(inputs, x, v);
    let mut own = own_states(assembly.parts(), p, &at);
    let (mut own_at, mut own_after, mut own_rates) = (own, own, own);
    let points = inputs.torque_nm().len();
    let last = points.saturating_sub(1);
    let mut index = 0;
    for point in 0..points {
        if let Some(restart) = inputs.restart_at(point) {
            [x, v] = taken_up(assembly, p, restart, (&at, &own[..states]), [x, v]);
        }
        plant.note(x, v);
        let torque = acting_torque.within(point);
        let mut slowed: Option<Slowed<N>> = None;
        let mut after = (x, v);
        for turn in 0..2 {
            let free = after.1;
            (at.x_m, at.v_m_per_s) = (x, v);
            after = (x, v);
            own_at[..states].copy_from_slice(&own[..states]);
            own_after[..states].copy_from_slice(&own[..states]);
            for (stage, (ahead, further, weight)) in STAGES.into_iter().enumerate() {
                let position = point as f64 + 0.5 * ahead as f64;
                plant.drive(&mut at, position, torque[ahead]);
                let mut acceleration =
                    plant.rates(position, &at, &own_at[..states], &mut own_rates[..states]);
                if turn == 0 && stage == 0 && point == index * inputs.substeps {
                    let motion = of_tool(x, v, felt(&plant, &at, acceleration), per_lever);
                    let moment = Moment::new(motion, &own[..states], &own_rates[..states]);
                    sample(index, &moment);
                    index += 1;
                }
                if point == last {
                    return;
                }
                if stage == 0 && plant.has_dry_friction() {
                    let on_average = (free - v).times(per_h);
                    slowed = Some(plant.slowed(&at, acceleration, on_average, slowed));
                }
                acceleration = less(acceleration, &slowed);
                let (weight, further) = (h * weight, h * further);
                after.0 += at.v_m_per_s.times(weight);
                after.1 += acceleration.times(weight);
                at.x_m = x + at.v_m_per_s.times(further);
                at.v_m_per_s = v + acceleration.times(further);
                for state in 0..states {
                    own_after[state] += own_rates[state].times(weight);
                    own_at[state] = own[state] + own_rates[state].times(further);
                }
            }
            if slowed.is_none_or(|slowed| slowed.is_foreseen()) {
                break;
            }
        }
        (x, v) = slowed.map_or(after, |slowed| slowed.ended(x, after));
        own[..states].copy_from_slice(&own_after[..states]);
    }
}

/// What is left of this `acceleration` by all but dry friction where that has `slowed` the motion.
#[inline(always)]
fn less<N: Number>(acceleration: N, slowed: &Option<Slowed<N>>) -> N {
    match slowed {
        Some(slowed) => acceleration - slowed.mean_m_per_s2,
        None => acceleration,
    }
}

/// The first sample's instant, before anything acts.
#[inline(always)]
fn beginning<N: Number>(
    inputs: &SimulationInputs<'_, N::Real>,
    x_m: N,
    v_m_per_s: N,
) -> Instant<N> {
    Instant {
        torque_nm: N::from(inputs.zero),
        x_m,
        v_m_per_s,
        since_onset_s: inputs.zero,
        lever_arm_m: inputs.lever_arm_m,
    }
}

/// What accelerates it at this instant \[m/s²\], of this `acceleration` by all but dry friction.
#[inline(always)]
fn felt<N: Number>(plant: &Plant<'_, N>, at: &Instant<N>, acceleration: N) -> N {
    match plant.has_dry_friction() {
        true => at_once(at.v_m_per_s, acceleration, plant.held(at)),
        false => acceleration,
    }
}

/// Displacement and velocity of what is driven, from the measured motion in the lanes that take it up there; `from` in the others.
#[inline(always)]
fn taken_up<N: Number>(
    assembly: &Assembly,
    p: &[N],
    restart: Restart<N::Real>,
    (at, own): (&Instant<N>, &[N]),
    from: [N; 2],
) -> [N; 2] {
    let [angle, velocity] = restart.motion;
    let measured = [N::from(angle), N::from(velocity)];
    let [angle, velocity] = driven(assembly, p, measured, at, own);
    let lever = at.lever_arm_m;
    [
        N::select(restart.lanes, angle.times(lever), from[0]),
        N::select(restart.lanes, velocity.times(lever), from[1]),
    ]
}

/// Angle \[rad\] and velocity \[rad/s\] of what is driven, where `measured` are those of what is measured.
#[inline(always)]
fn driven<N: Number>(
    assembly: &Assembly,
    p: &[N],
    measured: [N; 2],
    at: &Instant<N>,
    own: &[N],
) -> [N; 2] {
    let [angle, velocity] = measured;
    let parts = assembly.parts();
    if !moves_elsewhere(parts) {
        return measured;
    }
    let moment = Moment {
        motion: of_tool(at.x_m, at.v_m_per_s, at.x_m, at.lever_arm_m),
        own,
        own_rates: own,
    };
    let beside = relative_motion(parts, p, at, &moment);
    [
        angle - beside.displacement_rad,
        velocity - beside.velocity_rad_per_s,
    ]
}

/// The tool's motion when the grip has displacement `x`, velocity `v` and this acceleration; `per_lever` is 1/l.
#[inline(always)]
fn of_tool<N: Number>(x: N, v: N, acceleration: N, per_lever: N::Real) -> Kinematics<N> {
    Kinematics {
        displacement_rad: x.times(per_lever),
        velocity_rad_per_s: v.times(per_lever),
        acceleration_rad_per_s2: acceleration.times(per_lever),
    }
}
