//! Dry friction on a rig that is no hand on a tool: the catalogue's law with a turn as sharp as the rig's speed asks.

use crate::assembly::scale::Scale;
use crate::custom::law::CustomEffect;
use crate::custom::settings::{CustomEffectSettings, CustomParameterSettings, Place};
use crate::description::{Description, ParameterSpec};
use crate::effects::Effect;
use crate::error::ModelError;
use crate::law::Law;
use snug_campaign::Rig;

/// Speed over which dry friction turns, as a share of the rig's typical speed. A hand gives way to friction softly; in a
/// machine the force turns at once, and a soft turn would leave a step at every reversal to other effects.
const SHARE_OF_SPEED: f64 = 0.003;

impl Scale {
    /// The effect as it acts on a rig of this scale.
    ///
    /// # Errors
    /// [`ModelError`] where the scale gives no finite law.
    pub fn effect(&self, effect: Effect, rig: &Rig) -> Result<Effect, ModelError> {
        let (
            Effect::CoulombFriction,
            Self::Rig {
                angle_rad, time_s, ..
            },
        ) = (effect, self)
        else {
            return Ok(effect);
        };
        let turn_m_per_s = SHARE_OF_SPEED * angle_rad * rig.lever_arm_m / time_s;
        let description = effect.description();
        let spec = &description.parameters[0];
        let range = self.range(spec, rig);
        let settings = CustomEffectSettings {
            name: description.name.to_owned(),
            place: Place::Force,
            expression: format!("{}*tanh(v/{turn_m_per_s:e})", spec.name),
            parameters: vec![CustomParameterSettings {
                name: spec.name.to_owned(),
                unit: spec.unit.to_owned(),
                start: range.starts[0],
                minimum: range.minimum,
                maximum: range.maximum,
                ..CustomParameterSettings::default()
            }],
        };
        let sharp =
            CustomEffect::intern_as(&settings, |written: &'static Description| Description {
                equation: written.equation,
                parameters: named_as(written.parameters, description.parameters),
                ..*description
            });
        sharp.map(Effect::Custom)
    }
}

/// The scaled starts and bounds under the catalogue's own names and units.
fn named_as(
    scaled: &'static [ParameterSpec],
    own: &'static [ParameterSpec],
) -> &'static [ParameterSpec] {
    let both = scaled.iter().zip(own).map(|(scaled, own)| ParameterSpec {
        name: own.name,
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

    #[test]
    fn friction_is_full_at_a_hundredth_of_the_usual_speed() {
        let rig = Rig {
            lever_arm_m: 1.0,
            known_inertia_kg_m2: 0.0,
        };
        let scale = Scale::Rig {
            torque_nm: 40.0,
            angle_rad: 0.07,
            time_s: 0.7,
        };
        let sharp = scale.effect(Effect::CoulombFriction, &rig).unwrap();
        assert_eq!(sharp.name(), "coulomb_friction");
        assert_eq!(sharp, scale.effect(Effect::CoulombFriction, &rig).unwrap());
        let at = Instant {
            torque_nm: 0.0,
            x_m: 0.0,
            v_m_per_s: 0.0015,
            since_onset_s: 0.0,
            lever_arm_m: 1.0,
        };
        let force = sharp.force(&[20.0], &at, &[]).unwrap();
        assert!((force - 20.0).abs() < 0.1, "{force}");
        let hand = Scale::HandOnTool.effect(Effect::CoulombFriction, &rig);
        assert_eq!(hand.unwrap(), Effect::CoulombFriction);
    }
}
