//! Which units a source's declared channels are shown in; conversion to SI is `signal.rs`.

use crate::source::Source;
use crate::unit::Unit;
use snug_campaign::SignalUnits;

impl Source {
    /// In which units input and output are shown: as declared where that is a voltage, a current or a pure number, m for
    /// lengths of the grip, N for forces that drive it, else Nm and rad.
    ///
    /// The first motion channel decides for the output.
    pub fn units(&self, lever_arm_m: f64) -> SignalUnits {
        let mut units = SignalUnits::default();
        for (signal, unit, _) in self.format.layout().declared().into_iter().rev() {
            if signal.is_input() {
                let force = unit.factor(signal, 2.0) != unit.factor(signal, 1.0);
                let standing_for = if force { "N" } else { "Nm" };
                units.input = symbol(unit).unwrap_or(standing_for).to_owned();
                units.input_per_nm = if force { 1.0 / lever_arm_m } else { 1.0 };
            } else if signal.quantity().is_some() {
                let length = unit.is_length();
                let standing_for = if length { "m" } else { "rad" };
                units.output = symbol(unit).unwrap_or(standing_for).to_owned();
                units.output_per_rad = if length { lever_arm_m } else { 1.0 };
            }
        }
        units
    }
}

/// The symbol of a unit that stands for the signal 1:1; `None` for one that measures it.
fn symbol(unit: Unit) -> Option<&'static str> {
    match unit {
        Unit::One => Some("1"),
        Unit::Volt => Some("V"),
        Unit::Ampere => Some("A"),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::csv::{Column, CsvChannel, CsvLayout};
    use crate::signal::Signal;
    use crate::source::Format;

    fn units(channels: &[(Signal, Unit)]) -> (String, String, f64) {
        let channel = |&(signal, unit): &(Signal, Unit)| CsvChannel {
            column: Column::Index(0),
            signal,
            unit,
            scale: 1.0,
        };
        let layout = CsvLayout {
            channels: channels.iter().map(channel).collect(),
            ..CsvLayout::default()
        };
        let source = Source {
            format: Format::Csv(layout),
            ..Source::default()
        };
        let units = source.units(0.4);
        (units.input, units.output, units.output_per_rad)
    }

    #[test]
    fn declared_units_reach_the_reader() {
        use Signal::{Displacement, Torque, Velocity};
        let words = |input: &str, output: &str, scale| (input.to_owned(), output.to_owned(), scale);
        let drive = [
            (Signal::Force, Unit::Ampere),
            (Velocity, Unit::MillimetrePerSecond),
        ];
        assert_eq!(units(&drive), words("A", "m", 0.4));
        let volts = [(Torque, Unit::Volt), (Displacement, Unit::Volt)];
        assert_eq!(units(&volts), words("V", "V", 1.0));
        let length = [
            (Torque, Unit::NewtonCentimetre),
            (Displacement, Unit::Millimetre),
        ];
        assert_eq!(units(&length), words("Nm", "m", 0.4));
        let linear = [
            (Signal::Force, Unit::Kilonewton),
            (Displacement, Unit::Millimetre),
        ];
        assert_eq!(units(&linear), words("N", "m", 0.4));
        let angle = [
            (Displacement, Unit::Degree),
            (Velocity, Unit::Volt),
            (Torque, Unit::One),
        ];
        assert_eq!(units(&angle), words("1", "rad", 1.0));
        assert_eq!(Source::default().units(0.4), SignalUnits::default());
    }
}
