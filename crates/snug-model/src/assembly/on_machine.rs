//! Laws of the catalogue on a rig that is no hand on a tool: friction holds it at rest, and a ripple goes by the rig's own zero.

use crate::assembly::scale::{Scale, WIDER};
use crate::custom::law::CustomEffect;
use crate::custom::settings::{CustomEffectSettings, CustomParameterSettings, Place};
use crate::description::{Description, ParameterSpec};
use crate::effects::Effect;
use crate::error::ModelError;
use crate::law::Law;
use snug_campaign::Rig;

/// Speed over which dry friction turns along a measured motion, as a share of the rig's typical speed. A hand gives way to friction softly;
/// in a machine the force turns at once, and a soft turn would leave a step at every reversal to other effects. Where the motion is simulated it
/// turns at once.
const SHARE_OF_SPEED: f64 = 0.003;

/// Least speed at which friction that turns over that gives way, likewise: several times that one. Chosen: the friction of a valve's stem gives
/// way at a twenty-fifth of its typical speed, and bound to a tenth was told as dry friction alone.
const LEAST_SHARE_OF_SPEED: f64 = 0.02;

impl Scale {
    /// The effect as it acts on a rig of this scale.
    ///
    /// # Errors
    /// [`ModelError`] where the scale gives no finite law.
    pub fn effect(&self, effect: Effect, rig: &Rig) -> Result<Effect, ModelError> {
        let Some(turn_m_per_s) = self.friction_turns_over(rig) else {
            return Ok(effect);
        };
        let holds = match effect {
            Effect::CoulombFriction => "fc_n",
            Effect::StribeckFriction => "fc_n+max(0,fs_n-fc_n)*exp(-(v/v_s_m_per_s)^2)",
            // Where its zero of x is says nothing of where it is at rest.
            Effect::TorqueRipple | Effect::SecondRipple => {
                let ripple = "a_sin_n*sin(2*pi*x/wavelength_m)+a_cos_n*cos(2*pi*x/wavelength_m)";
                return self.written(effect, ripple.to_owned(), None, rig);
            }
            _ => return Ok(effect),
        };
        let along_motion = format!("({holds})*tanh(v/{turn_m_per_s:e})");
        self.written(effect, along_motion, Some(holds.to_owned()), rig)
    }

    /// Speed over which dry friction turns along a measured motion \[m/s\]; `None` on a hand, where it is the catalogue's.
    pub fn friction_turns_over(&self, rig: &Rig) -> Option<f64> {
        let Self::Rig {
            angle_rad, time_s, ..
        } = self
        else {
            return None;
        };
        Some(SHARE_OF_SPEED * angle_rad * rig.lever_arm_m / time_s)
    }

    /// A force of the catalogue written as this expression, under its own name; of dry friction with what it `holds`.
    fn written(
        &self,
        effect: Effect,
        expression: String,
        holds: Option<String>,
        rig: &Rig,
    ) -> Result<Effect, ModelError> {
        let description = effect.description();
        let parameter = |(place, spec): (usize, &ParameterSpec)| {
            let mut range = self.range(spec, rig);
            // A wave that is longer than the way is no ripple: it would stand in for gravity, or for any spring.
            if effect.wavelength() == Some(place) {
                range.maximum /= WIDER;
            }
            // A speed at which friction gives way must not stand in for the one over which it turns.
            if let (
                Self::Rig {
                    angle_rad, time_s, ..
                },
                "m/s",
            ) = (self, spec.unit)
            {
                let least = LEAST_SHARE_OF_SPEED * angle_rad * rig.lever_arm_m / time_s;
                range.minimum = range.minimum.max(least);
            }
            CustomParameterSettings {
                name: spec.name.to_owned(),
                unit: spec.unit.to_owned(),
                start: range.starts[0],
                further_starts: range.starts[1..].to_vec(),
                minimum: range.minimum,
                maximum: range.maximum,
                ..CustomParameterSettings::default()
            }
        };
        let settings = CustomEffectSettings {
            name: description.name.to_owned(),
            place: Place::Force,
            expression,
            parameters: description
                .parameters
                .iter()
                .enumerate()
                .map(parameter)
                .collect(),
        };
        let held = holds.clone();
        let told = |written: &'static Description| Description {
            equation: match held {
                Some(holds) => format!("F + ({holds}) sgn(v); a rig at rest is held").leak(),
                None => written.equation,
            },
            parameters: named_as(written.parameters, description.parameters),
            ..*description
        };
        let law = CustomEffect::intern_as(&settings, holds, told);
        law.map(Effect::Custom)
    }
}

/// The scaled starts and bounds under the catalogue's own names, meanings and units.
fn named_as(
    scaled: &'static [ParameterSpec],
    own: &'static [ParameterSpec],
) -> &'static [ParameterSpec] {
    let both = scaled.iter().zip(own).map(|(scaled, own)| ParameterSpec {
        name: own.name,
        meaning: own.meaning,
        unit: own.unit,
        vanishes_at: own.vanishes_at,
        ..*scaled
    });
    Box::leak(both.collect::<Vec<_>>().into_boxed_slice())
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::law::Instant;

    const RIG: Rig = Rig {
        lever_arm_m: 1.0,
        known_inertia_kg_m2: 0.0,
    };

    #[test]
    fn friction_is_full_at_a_hundredth_of_the_usual_speed() {
        let scale = Scale::Rig {
            torque_nm: 40.0,
            angle_rad: 0.07,
            time_s: 0.7,
        };
        let sharp = scale.effect(Effect::CoulombFriction, &RIG).unwrap();
        assert_eq!(sharp.name(), "coulomb_friction");
        assert_eq!(sharp, scale.effect(Effect::CoulombFriction, &RIG).unwrap());
        let at = Instant {
            torque_nm: 0.0,
            x_m: 0.0,
            v_m_per_s: 0.0015,
            since_onset_s: 0.0,
            lever_arm_m: 1.0,
        };
        let force = sharp.force(&[20.0], &at, &[]).unwrap();
        assert!((force - 20.0).abs() < 0.1, "{force}");
        let hand = Scale::HandOnTool.effect(Effect::CoulombFriction, &RIG);
        assert_eq!(hand.unwrap(), Effect::CoulombFriction);
    }

    /// The stem of a valve: 0.02 m/s, of typically 0.55 m/s.
    #[test]
    fn friction_may_give_way_at_a_small_part_of_the_usual_speed() {
        let scale = Scale::Rig {
            torque_nm: 130.0,
            angle_rad: 0.0143,
            time_s: 0.026,
        };
        let friction = scale.effect(Effect::StribeckFriction, &RIG).unwrap();
        let speed = friction.description().parameters[2];
        assert_eq!(speed.name, "v_s_m_per_s");
        assert!(speed.limits.0 < 0.02, "{:?}", speed.limits);
        // As fast as that it would be the speed over which it turns.
        let turns_over = scale.friction_turns_over(&RIG).unwrap();
        assert!(speed.limits.0 > 3.0 * turns_over);
    }
}
