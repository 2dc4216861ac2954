//! Units of input and output as the source declares them: volts stay volts, lengths of the grip stay metres.

use snug_campaign::{Quantity, SignalUnits};

/// Words, symbol and unit of a motion, for an axis: `angle θ [rad]`, `displacement [V]`.
pub fn motion_axis(units: &SignalUnits, quantity: Quantity) -> String {
    let name = match (quantity, units.output.as_str()) {
        (Quantity::Displacement, "rad") => "angle θ",
        (Quantity::Displacement, "m") => "displacement of the grip",
        (Quantity::Displacement, _) => "output",
        (Quantity::Velocity, "rad") => "velocity ω",
        (Quantity::Velocity, "m") => "velocity of the grip",
        (Quantity::Velocity, _) => "output's first derivative",
        (Quantity::Acceleration, "rad") => "acceleration α",
        (Quantity::Acceleration, "m") => "acceleration of the grip",
        (Quantity::Acceleration, _) => "output's second derivative",
    };
    format!("{name} [{}]", units.motion(quantity))
}

/// An effect parameter's unit with the declared input and output in place of Nm and rad.
pub fn effect_parameter(units: &SignalUnits, unit: String) -> String {
    if units.mechanical() || units.output_per_rad != 1.0 {
        unit
    } else {
        unit.replace("rad", &units.output)
            .replace("N·m", &units.input)
            .replace("Nm", &units.input)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn units(input: &str, output: &str) -> SignalUnits {
        SignalUnits {
            input: input.into(),
            output: output.into(),
            input_per_nm: 1.0,
            output_per_rad: 1.0,
        }
    }

    #[test]
    fn volts_are_never_called_radians() {
        let volts = units("V", "V");
        assert_eq!(motion_axis(&volts, Quantity::Displacement), "output [V]");
        assert_eq!(volts.motion(Quantity::Acceleration), "V/s²");
        assert_eq!(volts.base_parameter("mass_kg").as_deref(), Some("V/(V/s²)"));
        assert_eq!(
            volts.base_parameter("stiffness_n_per_m").as_deref(),
            Some("V/V")
        );
        assert_eq!(effect_parameter(&volts, "rad".into()), "V");
        assert_eq!(SignalUnits::default().base_parameter("mass_kg"), None);
        assert_eq!(
            effect_parameter(&SignalUnits::default(), "rad".into()),
            "rad"
        );
    }
}
