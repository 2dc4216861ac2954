//! How a recording begins, where that is part of the model: as it was measured.

use snug_campaign::{Quantity, Tightening};
use snug_model::{Effect, Model, ModelSettings};

/// The effect that says how a recording begins, its angle and its speed.
pub(crate) const BEGINS: Effect = Effect::InitialMotion;
pub(crate) const ANGLE: &str = "theta0_rad";
const SPEED: &str = "omega0_rad_per_s";

/// Lets the first angle and speed of `model`, if it has them and the study does not say where they begin, begin as they were measured, and
/// reach as far around that as they otherwise would around 0.
pub(crate) fn as_measured(model: &mut Model, tightening: &Tightening, settings: &ModelSettings) {
    if !model.effects().any(|effect| effect == BEGINS) {
        return;
    }
    for (name, quantity) in [(ANGLE, Quantity::Displacement), (SPEED, Quantity::Velocity)] {
        let told = settings.parameters.get(name);
        let measured = tightening.motion.get(quantity).and_then(<[f64]>::first);
        let mut all = model.parameters_mut().iter_mut();
        let Some((first, parameter)) = measured.zip(all.find(|one| one.name == name)) else {
            continue;
        };
        if told.is_none() && !parameter.fixed && first.is_finite() {
            parameter.value = *first;
            parameter.minimum = parameter.minimum.min(first + parameter.minimum);
            parameter.maximum = parameter.maximum.max(first + parameter.maximum);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use snug_campaign::Rig;
    use snug_model::ParameterSettings;

    const RIG: Rig = Rig {
        lever_arm_m: 1.0,
        known_inertia_kg_m2: 0.0,
    };

    fn begun(settings: &ModelSettings, angle_rad: f64) -> Vec<[f64; 3]> {
        let tightening = Tightening::from_torque(RIG, 1e-3, vec![0.0; 3])
            .with(Quantity::Displacement, vec![angle_rad; 3]);
        let mut model = Model::new(RIG, &[BEGINS]).expect("the rig is one");
        as_measured(&mut model, &tightening, settings);
        let own = model.parameters().iter().skip(3);
        own.map(|one| [one.value, one.minimum, one.maximum])
            .collect()
    }

    /// 12 rad, around which as much is allowed as otherwise around 0; of the speed nothing is measured.
    #[test]
    fn a_recording_begins_where_it_was_measured() {
        let settings = ModelSettings::default();
        let (usual, found) = (begun(&settings, 0.0), begun(&settings, 12.0));
        assert_eq!(usual[0][0], 0.0);
        assert_eq!(found[0], [12.0, usual[0][1], 12.0 + usual[0][2]]);
        assert_eq!(found[1], usual[1]);
    }

    #[test]
    fn what_the_study_says_of_it_stays() {
        let mut settings = ModelSettings::default();
        let told = ParameterSettings::default();
        settings.parameters.insert(ANGLE.to_owned(), told);
        assert_eq!(begun(&settings, 12.0)[0][0], 0.0);
    }
}
