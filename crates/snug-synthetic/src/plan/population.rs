//! Hand–arms to draw from: people differ, one person's tightenings differ less, conditions may shift both.

use crate::error::SyntheticError;
use crate::random::Stream;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use serde::{Deserialize, Serialize};

/// Draws before a population is declared unable to give a hand–arm.
const TRIES: usize = 1000;

/// Hand–arm mass, damping and stiffness.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct HandArm {
    /// m \[kg\].
    pub mass_kg: f64,
    /// c \[kg/s\].
    pub damping_kg_per_s: f64,
    /// k \[N/m\].
    pub stiffness_n_per_m: f64,
}

impl HandArm {
    /// Damping ratio with the tool: ζ = c l² / (2 √(k l² (I_n + m l²))); lightly damped means ζ < 1.
    pub fn damping_ratio(&self, lever_arm_m: f64, known_inertia_kg_m2: f64) -> f64 {
        let square = lever_arm_m * lever_arm_m;
        let inertia = known_inertia_kg_m2 + self.mass_kg * square;
        self.damping_kg_per_s * square / (2.0 * (self.stiffness_n_per_m * square * inertia).sqrt())
    }

    /// With m, c, k multiplied by these.
    pub(crate) fn scaled(&self, ratio: [f64; 3]) -> Self {
        Self {
            mass_kg: self.mass_kg * ratio[0],
            damping_kg_per_s: self.damping_kg_per_s * ratio[1],
            stiffness_n_per_m: self.stiffness_n_per_m * ratio[2],
        }
    }
}

/// How people, and one person's tightenings, spread: log-normal around a median, kept where the damping ratio with the
/// tool is plausible, so that every draw is lightly damped.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Population {
    /// Median person; default m 2.2 kg, c 95 kg/s, k 2350 N/m.
    pub median: HandArm,
    /// Standard deviation of ln m, ln c, ln k between participants, without unit; default 0.32, 0.25, 0.32.
    pub between_participants: [f64; 3],
    /// Standard deviation of ln m, ln c, ln k between one participant's tightenings, without unit; default 0.11 each.
    pub within_participant: [f64; 3],
    /// Smallest damping ratio with the tool that is kept; default 0.25.
    pub smallest_damping_ratio: f64,
    /// Largest damping ratio with the tool that is kept; default 0.8.
    pub largest_damping_ratio: f64,
    /// What Turbo Tight multiplies m, c, k by; default 1 each: strategy changes nothing.
    pub turbo_tight_ratio: [f64; 3],
    /// What a hard joint multiplies m, c, k by; default 1 each.
    pub hard_joint_ratio: [f64; 3],
    /// What 8 tightenings per minute multiply m, c, k by; default 1 each.
    pub fast_pace_ratio: [f64; 3],
}

impl Default for Population {
    fn default() -> Self {
        Self {
            median: HandArm {
                mass_kg: 2.2,
                damping_kg_per_s: 95.0,
                stiffness_n_per_m: 2350.0,
            },
            between_participants: [0.32, 0.25, 0.32],
            within_participant: [0.11; 3],
            smallest_damping_ratio: 0.25,
            largest_damping_ratio: 0.8,
            turbo_tight_ratio: [1.0; 3],
            hard_joint_ratio: [1.0; 3],
            fast_pace_ratio: [1.0; 3],
        }
    }
}

impl Population {
    /// The participant's own median hand–arm: the same in every file of a campaign.
    ///
    /// # Errors
    /// [`SyntheticError::NoSuchHandArm`] when the population hardly holds a hand–arm within its damping ratios.
    pub(crate) fn person(
        &self,
        participant: u32,
        lever_arm_m: f64,
        known_inertia_kg_m2: f64,
        seed: u64,
    ) -> Result<HandArm, SyntheticError> {
        let mut rng = Stream::Person.rng(seed, 0, participant as usize);
        // A margin inside the limits, so that the person's tightenings mostly stay there without being drawn again.
        let kept = 1.25 * self.smallest_damping_ratio..0.85 * self.largest_damping_ratio;
        self.draw(self.median, self.between_participants, &mut rng, |arm| {
            kept.contains(&arm.damping_ratio(lever_arm_m, known_inertia_kg_m2))
        })
    }

    /// One tightening's hand–arm around `around`.
    ///
    /// # Errors
    /// As [`Population::person`].
    pub(crate) fn tightening(
        &self,
        around: HandArm,
        lever_arm_m: f64,
        known_inertia_kg_m2: f64,
        rng: &mut ChaCha8Rng,
    ) -> Result<HandArm, SyntheticError> {
        let kept = self.smallest_damping_ratio..self.largest_damping_ratio;
        self.draw(around, self.within_participant, rng, |arm| {
            kept.contains(&arm.damping_ratio(lever_arm_m, known_inertia_kg_m2))
        })
    }

    /// `person` under the conditions of a file.
    pub(crate) fn under(
        &self,
        person: HandArm,
        turbo_tight: bool,
        hard_joint: bool,
        fast_pace: bool,
    ) -> HandArm {
        let mut arm = person;
        for (applies, ratio) in [
            (turbo_tight, self.turbo_tight_ratio),
            (hard_joint, self.hard_joint_ratio),
            (fast_pace, self.fast_pace_ratio),
        ] {
            if applies {
                arm = arm.scaled(ratio);
            }
        }
        arm
    }

    fn draw(
        &self,
        around: HandArm,
        spread: [f64; 3],
        rng: &mut ChaCha8Rng,
        accepted: impl Fn(&HandArm) -> bool,
    ) -> Result<HandArm, SyntheticError> {
        for _ in 0..TRIES {
            let ratio = spread.map(|sd| {
                let standard: f64 = StandardNormal.sample(rng);
                (sd * standard).exp()
            });
            let arm = around.scaled(ratio);
            if accepted(&arm) {
                return Ok(arm);
            }
        }
        Err(SyntheticError::NoSuchHandArm { tries: TRIES })
    }
}
