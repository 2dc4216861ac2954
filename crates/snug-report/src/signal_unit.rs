//! Units of input and output as the source declares them: volts stay volts, lengths of the grip stay metres.

use snug_campaign::{Quantity, SignalUnits};

/// Unit of a motion: `rad/s²`, `m/s²`, `V/s²`.
pub fn motion(units: &SignalUnits, quantity: Quantity) -> String {
    let output = &units.output;
    match quantity {
        Quantity::Displacement => output.clone(),
        Quantity::Velocity => format!("{output}/s"),
        Quantity::Acceleration => format!("{output}/s²"),
    }
}

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
    format!("{name} [{}]", motion(units, quantity))
}

/// Unit of m, c or k where input or output are no mechanical quantities: input per output's derivative.
pub fn base_parameter(units: &SignalUnits, column: &str) -> Option<String> {
    let quantity = match column {
        "mass_kg" => Quantity::Acceleration,
        "damping_kg_per_s" => Quantity::Velocity,
        "stiffness_n_per_m" => Quantity::Displacement,
        _ => return None,
    };
    let output = motion(units, quantity);
    (!units.mechanical()).then(|| match output.contains('/') {
        true => format!("{}/({output})", units.input),
        false => format!("{}/{output}", units.input),
    })
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
        assert_eq!(motion(&volts, Quantity::Acceleration), "V/s²");
        assert_eq!(
            base_parameter(&volts, "mass_kg").as_deref(),
            Some("V/(V/s²)")
        );
        assert_eq!(
            base_parameter(&volts, "stiffness_n_per_m").as_deref(),
            Some("V/V")
        );
        assert_eq!(effect_parameter(&volts, "rad".into()), "V");
        assert_eq!(base_parameter(&SignalUnits::default(), "mass_kg"), None);
        assert_eq!(
            effect_parameter(&SignalUnits::default(), "rad".into()),
            "rad"
        );
    }
}
