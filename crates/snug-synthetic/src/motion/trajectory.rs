//! The true motion, integrated in far finer steps than identification takes, so that its errors are not shared.

use crate::motion::history::History;
use crate::motion::plant::Plant;
use crate::motion::plant::{LAGGED_ACCELERATION, LAGGED_TORQUE, Now, OMEGA, STATES, State, THETA};
use crate::plan::effects::HiddenEffect::{AccelerationLag, StretchReflex, TorqueLag};

/// Integration steps per sample: far finer than what identification simulates with.
const STEPS_PER_SAMPLE: f64 = 8.0;

/// The true motion of one tightening on a uniform grid, free of noise.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Trajectory {
    /// Time since the window's start \[s\].
    pub time_s: Vec<f64>,
    /// θ \[rad\].
    pub theta_rad: Vec<f64>,
    /// ω \[rad/s\].
    pub omega_rad_per_s: Vec<f64>,
    /// α \[rad/s²\].
    pub acceleration_rad_per_s2: Vec<f64>,
    /// α as an accelerometer with the plant's lag would follow it \[rad/s²\]; the true α where there is no lag.
    pub sensed_acceleration_rad_per_s2: Vec<f64>,
    /// Torque that acts on the joint \[Nm\].
    pub acting_torque_nm: Vec<f64>,
    /// Torque as the log has it, before offset, gain and noise \[Nm\].
    pub logged_torque_nm: Vec<f64>,
    /// Force between tool and hand with the hand's inertia, (T − I_n α)/l \[N\].
    pub grip_force_n: Vec<f64>,
}

impl Trajectory {
    /// Integrates `plant` from rest and samples it at `first_s + i · interval_s`, `i` below `samples`.
    ///
    /// Classical Runge–Kutta of fourth order on the continuous torque, eight steps per sample or more: steps end at
    /// every sample and at every instant where a derivative of the torque jumps. `first_s` should not be later than
    /// the window's start (0), so that motion starts from rest.
    pub fn of(plant: &Plant, first_s: f64, interval_s: f64, samples: usize) -> Self {
        let knots_s = plant.knots_s();
        let mut run = Run::new(plant, first_s);
        let mut trajectory = Self::default();
        for index in 0..samples {
            let time_s = first_s + index as f64 * interval_s;
            run.advance(time_s, interval_s / STEPS_PER_SAMPLE, &knots_s);
            trajectory.sample(&run);
        }
        trajectory
    }

    /// Largest θ \[rad\].
    pub fn peak_rad(&self) -> f64 {
        self.theta_rad.iter().copied().fold(0.0, f64::max)
    }

    fn sample(&mut self, run: &Run) {
        let (plant, state) = (run.plant, &run.state);
        let Now { time_s, torque_nm } = run.now;
        let acceleration = plant.acceleration_rad_per_s2(run.now, state, &run.past);
        let torque_lags = plant.numbers_of(TorqueLag).is_some();
        let acceleration_lags = plant.numbers_of(AccelerationLag).is_some();
        self.time_s.push(time_s);
        self.theta_rad.push(state[THETA]);
        self.omega_rad_per_s.push(state[OMEGA]);
        self.acceleration_rad_per_s2.push(acceleration);
        self.sensed_acceleration_rad_per_s2
            .push(if acceleration_lags {
                state[LAGGED_ACCELERATION]
            } else {
                acceleration
            });
        self.acting_torque_nm.push(torque_nm);
        self.logged_torque_nm.push(if torque_lags {
            state[LAGGED_TORQUE]
        } else {
            plant.log_torque_nm(time_s)
        });
        self.grip_force_n
            .push((torque_nm - plant.known_inertia_kg_m2 * acceleration) / plant.lever_arm_m);
    }
}

/// An integration under way.
struct Run<'a> {
    plant: &'a Plant,
    now: Now,
    state: State,
    past: History,
    looks_back: bool,
    started: bool,
}

impl<'a> Run<'a> {
    fn new(plant: &'a Plant, first_s: f64) -> Self {
        Self {
            plant,
            now: plant.now(first_s),
            state: [0.0; STATES],
            past: History::default(),
            looks_back: plant.numbers_of(StretchReflex).is_some(),
            started: false,
        }
    }

    /// Integrates up to `end_s` in steps of at most `longest_s` that end at the knots on the way.
    fn advance(&mut self, end_s: f64, longest_s: f64, knots_s: &[f64]) {
        let first = knots_s.partition_point(|&knot| knot < self.now.time_s);
        let between = knots_s[first..].iter().copied();
        for stop_s in between
            .take_while(|&knot| knot < end_s)
            .chain(std::iter::once(end_s))
        {
            // A knot a rounding error away from a sample is that sample.
            let span_s = stop_s - self.now.time_s;
            let steps = (span_s / longest_s - 1e-9).ceil().max(0.0) as usize;
            let from_s = self.now.time_s;
            for step in 0..steps {
                let until_s = if step + 1 == steps {
                    stop_s
                } else {
                    from_s + span_s * (step + 1) as f64 / steps as f64
                };
                self.step(until_s);
            }
            if steps == 0 {
                self.now = self.plant.now(stop_s);
            }
            self.start_moving();
        }
    }

    /// Puts the motion that is there when the window starts, once.
    fn start_moving(&mut self) {
        if !self.started && self.now.time_s > -1e-12 {
            self.started = true;
            if let Some((theta0, omega0)) = self.plant.initial_motion() {
                self.state[THETA] += theta0;
                self.state[OMEGA] += omega0;
            }
        }
    }

    fn step(&mut self, until_s: f64) {
        if self.looks_back {
            self.past
                .note(self.now.time_s, self.state[THETA], self.state[OMEGA]);
        }
        let h = until_s - self.now.time_s;
        let middle = self.plant.now(self.now.time_s + 0.5 * h);
        let end = self.plant.now(until_s);
        let rates = |now: Now, state: &State| self.plant.rates(now, state, &self.past);
        let k1 = rates(self.now, &self.state);
        let k2 = rates(middle, &moved(&self.state, 0.5 * h, &k1));
        let k3 = rates(middle, &moved(&self.state, 0.5 * h, &k2));
        let k4 = rates(end, &moved(&self.state, h, &k3));
        for index in 0..STATES {
            self.state[index] += h / 6.0 * (k1[index] + 2.0 * (k2[index] + k3[index]) + k4[index]);
        }
        self.now = end;
    }
}

fn moved(state: &State, h: f64, rates: &State) -> State {
    std::array::from_fn(|index| state[index] + h * rates[index])
}
