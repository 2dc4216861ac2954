//! What stands out of where a model fails: each remark as data, and the sentence it is said with.

use crate::measurement::signal_units::SignalUnits;
use crate::words::number::{significant, whole_percent, without_last_digits};
use crate::words::sentence::said::written_as_said;
use crate::words::size::amount;
use std::fmt::{self, Display, Formatter};

/// An error over the noise, or over the campaign's average error where the noise is not known.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Times {
    /// How many times; no unit.
    pub error: f64,
    /// Whether the noise is known.
    pub of_noise: bool,
}

impl Display for Times {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let of = match self.of_noise {
            true => "the noise",
            false => "the average error",
        };
        write!(f, "{:.1} times {of}", self.error)
    }
}

/// Something that stands out; shares are of the campaign's misfit, 0 to 1.
#[derive(Debug, Clone, PartialEq)]
pub enum Remark {
    /// Noise alone gives this error over the measured noise.
    OnlyNoise(f64),
    /// A stretch of time holds most of the misfit.
    Time {
        /// Share of the misfit.
        share: f64,
        /// Where it begins \[s\].
        from_s: f64,
        /// Where it ends \[s\].
        to_s: f64,
        /// Whether times count from the pulse's onset.
        since_onset: bool,
    },
    /// A phase of the pulse holds more than its due.
    Phase {
        /// The phase, as the aspect's part is called.
        phase: String,
        /// Share of the misfit.
        share: f64,
        /// Share of the time.
        of_time: f64,
        /// The error there.
        error: Times,
    },
    /// A band of frequency holds most of the misfit.
    Frequency {
        /// Share of the misfit.
        share: f64,
        /// Where it begins \[Hz\].
        from_hz: f64,
        /// Where it ends \[Hz\].
        to_hz: f64,
        /// From where on there is nothing but noise \[Hz\].
        quiet_from_hz: Option<f64>,
    },
    /// One steady tone that the input does not have holds most of the misfit.
    Tone {
        /// Share of the misfit.
        share: f64,
        /// Its frequency \[Hz\].
        hz: f64,
    },
    /// One steady tone of the mains holds most of the misfit, and the input has a faint one, too.
    PickedUp {
        /// Share of the misfit.
        share: f64,
        /// Its frequency \[Hz\].
        hz: f64,
    },
    /// The error differs between small and large displacements.
    Amplitude {
        /// Whether it grows with the displacement.
        grows: bool,
        /// Error below the first displacement, in `unit`.
        small: (f64, Times),
        /// Error above the second displacement, in `unit`.
        large: (f64, Times),
        /// `rad` of an angle, or what the rig's displacement is shown in.
        unit: String,
    },
    /// One value of a condition holds more than its due.
    Condition {
        /// The condition, as its aspect is called.
        condition: String,
        /// Its value.
        value: String,
        /// Share of the misfit.
        share: f64,
        /// Share of the data.
        of_data: f64,
    },
    /// The missing force follows a shape.
    Follows {
        /// The shape.
        shape: &'static str,
        /// Share of the misfit that it describes.
        share: f64,
        /// Others that do so nearly as well.
        others: Vec<(&'static str, f64)>,
    },
    /// No simple shape describes the missing force.
    FollowsNothing {
        /// The best.
        shape: &'static str,
        /// Share of the misfit that it leaves.
        left: f64,
    },
    /// Most of the misfit can be predicted from other tightenings: the share.
    Repeats(f64),
    /// Little of it can: the share.
    DoesNotRepeat(f64),
    /// Nothing stands out of a misfit beyond the noise.
    SpreadOut,
}

written_as_said!(Remark);

const SPREAD_OUT: &str =
    "Nothing stands out: the misfit is spread over time, frequency and conditions.";

/// Share by which a tone of the mains may be off its frequency \[–\]: grids keep within 0.4 %. Chosen.
const OFF_THE_MAINS: f64 = 0.005;

impl Remark {
    /// The same where displacements are shown in these units.
    pub fn told_in(self, units: &SignalUnits) -> Self {
        match self {
            Self::Amplitude {
                grows,
                small: (to, small),
                large: (from, large),
                ..
            } => Self::Amplitude {
                grows,
                small: (to * units.output_per_rad, small),
                large: (from * units.output_per_rad, large),
                unit: units.output.clone(),
            },
            same => same,
        }
    }
}

impl Display for Remark {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::OnlyNoise(error) => write!(
                f,
                "Nothing stands out: the error is {error:.2} times the measured noise, which is what noise alone gives."
            ),
            Self::Time {
                share,
                from_s,
                to_s,
                since_onset,
            } => time(f, *share, (*from_s, *to_s), *since_onset),
            Self::Phase {
                phase,
                share,
                of_time,
                error,
            } => write!(
                f,
                "The {} holds {} of the misfit in {} of the time: the error there is {error}.",
                phase_name(phase),
                whole_percent(*share),
                whole_percent(*of_time)
            ),
            Self::Frequency {
                share,
                from_hz,
                to_hz,
                quiet_from_hz,
            } => frequency(f, *share, (*from_hz, *to_hz), *quiet_from_hz),
            Self::Tone { share, hz } => tone(f, *share, *hz),
            Self::PickedUp { share, hz } => picked_up(f, *share, *hz),
            Self::Amplitude {
                grows,
                small,
                large,
                unit,
            } => amplitude(f, *grows, (*small, *large), unit),
            Self::Condition {
                condition,
                value,
                share,
                of_data,
            } => write!(
                f,
                "{} {value} carries {} of the misfit with {} of the data.",
                condition_name(condition),
                whole_percent(*share),
                whole_percent(*of_data)
            ),
            Self::Follows {
                shape,
                share,
                others,
            } => follows(f, shape, *share, others),
            Self::FollowsNothing { shape, left } => write!(
                f,
                "No simple function of displacement and velocity describes the missing force: the best, {shape}, leaves {} of the misfit.",
                whole_percent(*left)
            ),
            Self::Repeats(share) => write!(
                f,
                "{} of the misfit can be predicted from the other tightenings: a missing effect can explain it.",
                whole_percent(*share)
            ),
            Self::DoesNotRepeat(share) => does_not_repeat(f, *share),
            Self::SpreadOut => f.write_str(SPREAD_OUT),
        }
    }
}

fn time(
    f: &mut Formatter<'_>,
    share: f64,
    (from_s, to_s): (f64, f64),
    since_onset: bool,
) -> fmt::Result {
    let (scale, unit) = if to_s < 1.0 { (1e3, "ms") } else { (1.0, "s") };
    let whence = match since_onset {
        true => "after the pulse began",
        false => "into the recording",
    };
    let [from, to] = [from_s, to_s].map(|at| without_last_digits(at * scale));
    write!(
        f,
        "Most of the misfit ({}) lies {from} to {to} {unit} {whence}.",
        whole_percent(share)
    )
}

fn phase_name(phase: &str) -> &'static str {
    match phase {
        "before onset" => "time before the pulse",
        "rise" => "rise of the torque",
        "peak" => "torque's peak",
        "release" => "release",
        "rebound" => "rebound",
        _ => "rest after the rebound",
    }
}

fn frequency(
    f: &mut Formatter<'_>,
    share: f64,
    (from_hz, to_hz): (f64, f64),
    quiet_from_hz: Option<f64>,
) -> fmt::Result {
    write!(f, "Most of the misfit ({}) lies ", whole_percent(share))?;
    match from_hz == 0.0 {
        true => write!(f, "below {to_hz} Hz")?,
        false => write!(f, "between {from_hz} and {to_hz} Hz")?,
    }
    match quiet_from_hz {
        Some(from) => write!(f, "; above {from} Hz there is nothing but noise."),
        None => write!(f, "."),
    }
}

fn picked_up(f: &mut Formatter<'_>, share: f64, hz: f64) -> fmt::Result {
    write!(
        f,
        "One tone of {} Hz, alike all the time, is {} of the misfit, and a faint one is in the input, too: where nobody drives the rig with it, the mains get into the cables of both, and an effect that explains it explains no answer of the rig. Look at both cables first.",
        significant(hz, 4),
        whole_percent(share)
    )
}

fn tone(f: &mut Formatter<'_>, share: f64, hz: f64) -> fmt::Result {
    let (tone, share) = (significant(hz, 4), whole_percent(share));
    write!(
        f,
        "One tone of {tone} Hz, alike all the time and not in the input, is {share} of the misfit: no answer of the rig. "
    )?;
    match is_of_the_mains(hz) {
        true => f.write_str("Look at the mains in the sensor's cable first, then for what hums or turns so fast: a fan, a pump, a converter."),
        false => f.write_str("Look for what hums, turns or sways so fast, at the rig, at what it stands on or in the sensor."),
    }
}

/// Whether a frequency \[Hz\] is the mains' or one of its first ten multiples, as near as mains keep it.
pub fn is_of_the_mains(hz: f64) -> bool {
    [50.0, 60.0].into_iter().any(|mains| {
        let multiple = (hz / mains).round();
        (1.0..=10.0).contains(&multiple) && (hz / (multiple * mains) - 1.0).abs() < OFF_THE_MAINS
    })
}

fn condition_name(condition: &str) -> &'static str {
    match condition {
        "participant" => "Participant",
        "strategy" => "Strategy",
        "joint" => "Joint",
        "pace_per_min" => "The pace of",
        _ => "The target of",
    }
}

fn amplitude(
    f: &mut Formatter<'_>,
    grows: bool,
    ((to, small), (from, large)): ((f64, Times), (f64, Times)),
    unit: &str,
) -> fmt::Result {
    let what = match unit {
        "rad" => "angle",
        _ => "displacement",
    };
    let lead = match grows {
        true => format!("The misfit grows with the {what}"),
        false => format!("The misfit is largest at small {what}s"),
    };
    let [to, from] = [to, from].map(|edge| amount(edge, unit));
    write!(f, "{lead}: {small} below {to}, {large} above {from}.")
}

fn does_not_repeat(f: &mut Formatter<'_>, share: f64) -> fmt::Result {
    let (predicted, most) = match share < 0.005 {
        true => ("Nothing".to_owned(), "it"),
        false => (format!("Only {}", whole_percent(share)), "most of it"),
    };
    write!(
        f,
        "{predicted} of the misfit can be predicted from the other tightenings: {most} is different each time, or is no simple function of time, displacement and velocity."
    )
}

fn follows(f: &mut Formatter<'_>, shape: &str, share: f64, others: &[(&str, f64)]) -> fmt::Result {
    write!(
        f,
        "The missing force follows {shape}: that describes {} of the misfit",
        whole_percent(share)
    )?;
    let others: Vec<String> = (others.iter())
        .map(|(shape, share)| format!("{shape} ({})", whole_percent(*share)))
        .collect();
    match others.is_empty() {
        true => write!(f, "."),
        false => write!(f, "; nearly as well: {}.", others.join("; ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slide_has_displacements_in_metres_and_a_joint_angles() {
        let times = |error| Times {
            error,
            of_noise: true,
        };
        let grows = Remark::Amplitude {
            grows: true,
            small: (0.02, times(1.5)),
            large: (0.1, times(4.0)),
            unit: "rad".to_owned(),
        };
        let spaces = |remark: &Remark| remark.to_string().replace('\u{a0}', " ");
        assert_eq!(
            spaces(&grows),
            "The misfit grows with the angle: 1.5 times the noise below 0.0200 rad, 4.0 times the noise above 0.100 rad."
        );
        let slide = SignalUnits {
            output: "m".into(),
            output_per_rad: 0.5,
            ..SignalUnits::default()
        };
        assert_eq!(
            spaces(&grows.told_in(&slide)),
            "The misfit grows with the displacement: 1.5 times the noise below 0.0100 m, 4.0 times the noise above 0.0500 m."
        );
    }
    #[test]
    fn only_what_is_near_a_multiple_of_the_mains_is_called_theirs() {
        for (hz, is_theirs) in [
            (50.02, true),
            (59.9, true),
            (100.3, true),
            (360.0, true),
            (0.31, false),
            (25.0, false),
            (55.0, false),
            (403.7, false),
            (650.0, false),
        ] {
            let said = Remark::Tone { share: 0.9, hz }.to_string();
            assert_eq!(said.contains("the mains"), is_theirs, "{said}");
        }
        let (share, hz) = (0.9, 50.02);
        let said = Remark::PickedUp { share, hz };
        assert!(said.to_string().contains("the cables of both"), "{said}");
    }
}
