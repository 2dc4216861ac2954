//! `/tightening/signals`: one protobuf message per sample with everything that was measured and simulated at it.
//!
//! Measurements are doubles and come back bit for bit; what the model adds is in single precision (relative rounding
//! 6·10⁻⁸), which halves the file. A channel that a tightening does not have is NaN, which plots leave empty.

use crate::encoding::schema::{Field, Message, count, group, number, single};
use crate::encoding::wire::{Fields, put_bytes, put_double, put_single, put_unsigned};
use crate::error::RecordError;
use snug_campaign::{Motion, Quantity, Traces};

const MEASURED: &[Field] = &[
    number("torque_nm", "N m", "Torque on the joint T"),
    number("displacement_rad", "rad", "Measured angle of the tool"),
    number("velocity_rad_per_s", "rad/s", "Measured angular velocity"),
    number(
        "acceleration_rad_per_s2",
        "rad/s^2",
        "Measured angular acceleration",
    ),
];

const SIMULATED: &[Field] = &[
    single("displacement_rad", "rad", "Simulated angle of the tool"),
    single("velocity_rad_per_s", "rad/s", "Simulated angular velocity"),
    single(
        "acceleration_rad_per_s2",
        "rad/s^2",
        "Simulated angular acceleration",
    ),
    single(
        "euler_displacement_rad",
        "rad",
        "Angle simulated by the explicit Euler method",
    ),
];

/// The motion alone: the first model's Euler displacement is not kept.
const BEFORE: &[Field] = SIMULATED.split_at(3).0;

const RESIDUAL: &[Field] = &[
    single("displacement_rad", "rad", "Measured minus simulated angle"),
    single(
        "velocity_rad_per_s",
        "rad/s",
        "Measured minus simulated angular velocity",
    ),
    single(
        "acceleration_rad_per_s2",
        "rad/s^2",
        "Measured minus simulated angular acceleration",
    ),
];

const FORCES: &[Field] = &[
    single("force_f1_n", "N", "F1: spring and damper, simulated motion"),
    single("force_f2_n", "N", "F2: torque and measured acceleration"),
    single("force_f3_n", "N", "F3: torque and simulated acceleration"),
    number("grip_force_n", "N", "F_op_J: measured grip force"),
];

/// The message's table.
pub(crate) const SIGNALS: Message = Message {
    name: "snug.Signals",
    about: "One sample of one tightening",
    fields: &[
        count(
            "tightening",
            "Running number of the tightening, as in /tightening/window",
        ),
        number("time_s", "s", "Time since the segment's start"),
        number(
            "time_since_onset_s",
            "s",
            "Time since the pulse began, or since the window's start",
        ),
        group("measured", MEASURED, "Measured signals"),
        group("simulated", SIMULATED, "Simulated signals"),
        group("residual", RESIDUAL, "Measured minus simulated"),
        group("forces", FORCES, "Force between tool and hand"),
        group(
            "before",
            BEFORE,
            "Simulated with the model that the diagnosis began with, where that is another",
        ),
    ],
};

/// The columns of one tightening, in the table's order.
pub(crate) struct Columns<'a> {
    running_number: u64,
    torque_nm: &'a [f64],
    measured: [Option<&'a [f64]>; 3],
    simulated: [Option<&'a [f64]>; 3],
    euler_displacement_rad: Option<&'a [f64]>,
    forces_n: [Option<&'a [f64]>; 3],
    grip_force_n: Option<&'a [f64]>,
    before: [Option<&'a [f64]>; 3],
    group: Vec<u8>,
}

impl<'a> Columns<'a> {
    /// Checks that every signal is as long as the torque; an empty simulated one counts as absent.
    pub(crate) fn new(
        running_number: u64,
        tightening: &dyn std::fmt::Display,
        traces: &'a Traces,
    ) -> Result<Self, RecordError> {
        let expected = traces.torque_nm.len();
        let check = |signal: &str, samples: Option<&'a [f64]>| match samples {
            Some(samples) if samples.len() != expected => Err(RecordError::UnequalLengths {
                tightening: tightening.to_string(),
                signal: signal.to_owned(),
                expected,
                found: samples.len(),
            }),
            samples => Ok(samples),
        };
        let motion = |group: &str, motion: &'a Motion| {
            let columns = Quantity::ALL.map(|quantity| motion.get(quantity));
            // Motions are called the same in every group; this one has nothing else.
            for (field, column) in RESIDUAL.iter().zip(columns) {
                check(&format!("{group}.{}", field.name), column)?;
            }
            Ok::<_, RecordError>(columns)
        };
        let optional = |signal: &str, samples: &'a [f64]| {
            check(signal, (!samples.is_empty()).then_some(samples))
        };
        Ok(Self {
            running_number,
            torque_nm: &traces.torque_nm,
            measured: motion("measured", &traces.measured)?,
            simulated: motion("simulated", &traces.simulated)?,
            euler_displacement_rad: optional(
                "euler_displacement_rad",
                &traces.euler_displacement_rad,
            )?,
            forces_n: [
                optional("force_f1_n", &traces.force_f1_n)?,
                optional("force_f2_n", &traces.force_f2_n)?,
                optional("force_f3_n", &traces.force_f3_n)?,
            ],
            grip_force_n: check("grip_force_n", traces.grip_force_n.as_deref())?,
            before: motion("before", &traces.before)?,
            group: Vec::new(),
        })
    }

    /// Writes the message of one sample over `out`.
    pub(crate) fn encode(
        &mut self,
        sample: usize,
        time_s: f64,
        time_since_onset_s: f64,
        out: &mut Vec<u8>,
    ) {
        let at = |column: Option<&[f64]>| column.map_or(f64::NAN, |samples| samples[sample]);
        out.clear();
        put_unsigned(out, 1, self.running_number);
        put_double(out, 2, time_s);
        put_double(out, 3, time_since_onset_s);
        let group = &mut self.group;
        group.clear();
        put_double(group, 1, self.torque_nm[sample]);
        for (number, column) in (2..).zip(self.measured) {
            put_double(group, number, at(column));
        }
        put_bytes(out, 4, group);
        group.clear();
        for (number, column) in (1..).zip(self.simulated) {
            put_single(group, number, at(column) as f32);
        }
        put_single(group, 4, at(self.euler_displacement_rad) as f32);
        put_bytes(out, 5, group);
        group.clear();
        for (number, (measured, simulated)) in (1..).zip(self.measured.iter().zip(self.simulated)) {
            put_single(group, number, (at(*measured) - at(simulated)) as f32);
        }
        put_bytes(out, 6, group);
        group.clear();
        for (number, column) in (1..).zip(self.forces_n) {
            put_single(group, number, at(column) as f32);
        }
        put_double(group, 4, at(self.grip_force_n));
        put_bytes(out, 7, group);
        if self.before.iter().any(Option::is_some) {
            group.clear();
            for (number, column) in (1..).zip(self.before) {
                put_single(group, number, at(column) as f32);
            }
            put_bytes(out, 8, group);
        }
    }
}

/// What was measured at one sample.
pub(crate) struct MeasuredSample {
    pub(crate) tightening: u64,
    /// In the order of [`crate::messages::measurement::CHANNELS`].
    pub(crate) channels: [f64; 5],
}

/// Reads the measured part of a message; `None` when it is not one of [`SIGNALS`].
pub(crate) fn decode(message: &[u8]) -> Option<MeasuredSample> {
    let mut tightening = 0;
    let mut channels = [f64::NAN; 5];
    for field in Fields::of(message) {
        match field? {
            (1, value) => tightening = value.varint()?,
            (4, group) => {
                for field in Fields::of(group.bytes()?) {
                    if let (number @ 1..=4, value) = field? {
                        channels[number as usize - 1] = value.double()?;
                    }
                }
            }
            (7, group) => {
                for field in Fields::of(group.bytes()?) {
                    if let (4, value) = field? {
                        channels[4] = value.double()?;
                    }
                }
            }
            _ => {}
        }
    }
    Some(MeasuredSample {
        tightening,
        channels,
    })
}
