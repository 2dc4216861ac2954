//! Any assembly's response by the classical Runge–Kutta method, one step per grid point of the input.
//!
//! At 10 kHz the error of a step is (h ω)⁵/120 ≈ 1e−15 of the amplitude for an arm at 30 rad/s; a band-limited input
//! brings its own finer grid.

use crate::assembly::Assembly;
use crate::effect::Kinematics;
use crate::plant::{Plant, initial_state};
use crate::{Input, Number};

/// Simulates from rest (or the effects' initial motion, or again and again from the input's restarts) and hands every sample's true motion to `sample`.
///
/// `p` are all parameters of the assembly in its order, `S` is at least the number of its states.
///
/// The four stages are a loop, so that the equations stand once in the compiled program and stay in its cache. The first
/// stage's rates are those at the grid point itself: they give the sample's acceleration as well.
pub fn respond<N: Number, const S: usize>(
    assembly: &Assembly,
    p: &[N],
    input: &Input,
    mut sample: impl FnMut(usize, Kinematics<N>),
) {
    let h = input.grid_interval_s();
    // How far from the start each stage is, in intervals, and its weight in the sum.
    let stages = [(0.0, 1.0), (0.5, 2.0), (0.5, 2.0), (1.0, 1.0)];
    let mut plant = Plant::new(assembly, p, input);
    let mut state: [N; S] = initial_state(assembly.parts(), p);
    let last = input.grid().len().saturating_sub(1);
    let mut torque = plant.acting_torque(0);
    let mut index = 0;
    for point in 0..input.grid().len() {
        if let Some([angle, velocity]) = input.restart_at(point) {
            (state[0], state[1]) = (N::from(angle), N::from(velocity));
        }
        plant.note(&state);
        let next = plant.acting_torque((point + 1).min(last));
        let rise = if input.held() {
            N::from(0.0)
        } else {
            next - torque
        };
        let (from, mut slope, mut sum) = (state, [N::from(0.0); S], [N::from(0.0); S]);
        for (stage, (ahead, weight)) in stages.into_iter().enumerate() {
            let drive = plant.drive(point as f64 + ahead, torque + rise * ahead);
            let at = std::array::from_fn(|i| from[i] + slope[i] * (ahead * h));
            slope = plant.rates(&drive, &at);
            if stage == 0 && point == index * input.substeps() {
                let motion = Kinematics {
                    displacement_rad: state[0],
                    velocity_rad_per_s: state[1],
                    acceleration_rad_per_s2: slope[1],
                };
                sample(index, motion);
                index += 1;
            }
            if point == last {
                return;
            }
            for (sum, slope) in sum.iter_mut().zip(&slope) {
                *sum += *slope * weight;
            }
        }
        for (value, sum) in state.iter_mut().zip(&sum) {
            *value += *sum * (h / 6.0);
        }
        torque = next;
    }
}
