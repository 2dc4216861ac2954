//! What a simulation is given from outside, lane by lane: rigs, torques, and measured motions to take up again.

use crate::assembly::layout::Assembly;
use crate::input::torque::Input;
use crate::law::Corner;
use crate::numeric::number::Real;
use std::borrow::Cow;

/// What is given from outside, lane by lane: rig and input of every tightening that is simulated side by side.
pub struct SimulationInputs<'a, R: Real> {
    inputs: Vec<&'a Input>,
    /// Logged torque at the grid points \[Nm\].
    torque_nm: Cow<'a, [R]>,
    /// Any number, to make others from.
    pub zero: R,
    /// l \[m\].
    pub lever_arm_m: R,
    /// I_n \[kg m²\].
    pub known_inertia_kg_m2: R,
    /// Over what a contact sets in.
    pub corner: Corner<R>,
    /// Time between grid points \[s\].
    pub interval_s: R,
    /// Grid points per sample.
    pub substeps: usize,
    /// Whether the input keeps each grid value until the next.
    pub held: bool,
    onset_s: R,
    rest_before_s: R,
}

/// A measured motion that is taken up.
pub struct Restart<R: Real> {
    /// The lanes that take it up.
    pub lanes: R::Mask,
    /// Angle \[rad\] and velocity \[rad/s\].
    pub motion: [R; 2],
}

impl<'a, R: Real> SimulationInputs<'a, R> {
    /// One assembly and input for each lane; of the inputs each must be [alike](Self::are_alike) the first.
    pub fn new(zero: R, of: impl Fn(usize) -> (&'a Assembly, &'a Input)) -> Self {
        let inputs: Vec<&Input> = (0..R::LANES).map(|lane| of(lane).1).collect();
        let grids: Vec<&[f64]> = inputs.iter().map(|input| input.grid_nm()).collect();
        Self {
            torque_nm: zero.interleave(&grids),
            lever_arm_m: zero.lane_by_lane(|lane| of(lane).0.rig().lever_arm_m),
            known_inertia_kg_m2: zero.lane_by_lane(|lane| of(lane).0.rig().known_inertia_kg_m2),
            corner: Corner {
                length_m: zero.lane_by_lane(|lane| of(lane).0.corner.length_m),
                time_s: zero.lane_by_lane(|lane| of(lane).0.corner.time_s),
            },
            interval_s: zero.lane_by_lane(|lane| inputs[lane].grid_interval_s()),
            onset_s: zero.lane_by_lane(|lane| inputs[lane].onset_s()),
            rest_before_s: zero.lane_by_lane(|lane| inputs[lane].rest_before_s()),
            substeps: inputs[0].substeps(),
            held: inputs[0].held(),
            inputs,
            zero,
        }
    }

    /// Whether two inputs can go side by side: the integration takes the same steps, whatever their length.
    pub fn are_alike(one: &Input, other: &Input) -> bool {
        one.substeps() == other.substeps()
            && one.held() == other.held()
            && one.is_restarted() == other.is_restarted()
    }

    /// Whether the simulation takes up the measured motion anywhere.
    #[inline(always)]
    pub fn is_restarted(&self) -> bool {
        self.inputs[0].is_restarted()
    }

    /// What the simulation goes on from at a grid point, in the lanes that take up the measured motion there.
    #[inline(always)]
    pub fn restart_at(&self, point: usize) -> Option<Restart<R>> {
        if !self.is_restarted() || !(self.inputs.iter()).any(|i| i.restart_at(point).is_some()) {
            return None;
        }
        let of = |lane: usize| self.inputs[lane].restart_at(point);
        let taken_up = (self.zero).lane_by_lane(|lane| f64::from(u8::from(of(lane).is_some())));
        let motion = |row: usize| {
            (self.zero).lane_by_lane(|lane| of(lane).map_or(0.0, |motion| motion[row]))
        };
        Some(Restart {
            lanes: taken_up.is_positive(),
            motion: [motion(0), motion(1)],
        })
    }

    /// The input of every lane.
    pub fn of_lanes(&self) -> &[&'a Input] {
        &self.inputs
    }

    /// Logged torque at the grid points \[Nm\], as many as the longest input has.
    #[inline(always)]
    pub fn torque_nm(&self) -> &[R] {
        &self.torque_nm
    }

    /// Time since the pulses began, `time_s` after the first samples \[s\].
    #[inline(always)]
    pub fn since_onset_s(&self, time_s: R) -> R {
        time_s - self.onset_s
    }

    /// Time since the integration of the sensor's signal began, at sample `index` \[s\].
    #[inline(always)]
    pub fn since_rest_s(&self, index: usize) -> R {
        self.rest_before_s + self.interval_s * index as f64 * self.substeps as f64
    }
}
