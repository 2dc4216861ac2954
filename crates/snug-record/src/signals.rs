//! `/tightening/signals`: one protobuf message per sample with everything that was measured and simulated at it.
//!
//! Measurements are doubles and come back bit for bit; what the model adds is in single precision (relative rounding
//! 6·10⁻⁸), which halves the file. A channel that a tightening does not have is NaN, which plots leave empty.

use crate::RecordError;
use crate::schema::{Field, Kind, Message, field};
use crate::wire::{Fields, put_bytes, put_double, put_single, put_unsigned};
use snug_campaign::{Motion, Quantity, Traces};

const MEASURED: &[Field] = &[
    field("torque_nm", Kind::Double, "N m", "Torque on the joint T"),
    field(
        "displacement_rad",
        Kind::Double,
        "rad",
        "Measured angle of the tool",
    ),
    field(
        "velocity_rad_per_s",
        Kind::Double,
        "rad/s",
        "Measured angular velocity",
    ),
    field(
        "acceleration_rad_per_s2",
        Kind::Double,
        "rad/s^2",
        "Measured angular acceleration",
    ),
];

const SIMULATED: &[Field] = &[
    field(
        "displacement_rad",
        Kind::Single,
        "rad",
        "Simulated angle of the tool",
    ),
    field(
        "velocity_rad_per_s",
        Kind::Single,
        "rad/s",
        "Simulated angular velocity",
    ),
    field(
        "acceleration_rad_per_s2",
        Kind::Single,
        "rad/s^2",
        "Simulated angular acceleration",
    ),
    field(
        "euler_displacement_rad",
        Kind::Single,
        "rad",
        "Angle simulated by the explicit Euler method",
    ),
];

const RESIDUAL: &[Field] = &[
    field(
        "displacement_rad",
        Kind::Single,
        "rad",
        "Measured minus simulated angle",
    ),
    field(
        "velocity_rad_per_s",
        Kind::Single,
        "rad/s",
        "Measured minus simulated angular velocity",
    ),
    field(
        "acceleration_rad_per_s2",
        Kind::Single,
        "rad/s^2",
        "Measured minus simulated angular acceleration",
    ),
];

const FORCES: &[Field] = &[
    field(
        "force_f1_n",
        Kind::Single,
        "N",
        "F1: spring and damper, simulated motion",
    ),
    field(
        "force_f2_n",
        Kind::Single,
        "N",
        "F2: torque and measured acceleration",
    ),
    field(
        "force_f3_n",
        Kind::Single,
        "N",
        "F3: torque and simulated acceleration",
    ),
    field(
        "grip_force_n",
        Kind::Double,
        "N",
        "F_op_J: measured grip force",
    ),
];

/// The message's table.
pub(crate) const SIGNALS: Message = Message {
    name: "snug.Signals",
    about: "One sample of one tightening",
    fields: &[
        field(
            "tightening",
            Kind::Count,
            "",
            "Running number of the tightening, as in /tightening/window",
        ),
        field(
            "time_s",
            Kind::Double,
            "s",
            "Time since the segment's start",
        ),
        field(
            "time_since_onset_s",
            Kind::Double,
            "s",
            "Time since the pulse began, or since the window's start",
        ),
        field("measured", Kind::Object(MEASURED), "", "Measured signals"),
        field(
            "simulated",
            Kind::Object(SIMULATED),
            "",
            "Simulated signals",
        ),
        field(
            "residual",
            Kind::Object(RESIDUAL),
            "",
            "Measured minus simulated",
        ),
        field(
            "forces",
            Kind::Object(FORCES),
            "",
            "Force between tool and hand",
        ),
    ],
};

const QUANTITIES: [Quantity; 3] = [
    Quantity::Displacement,
    Quantity::Velocity,
    Quantity::Acceleration,
];

/// The columns of one tightening, in the table's order.
pub(crate) struct Columns<'a> {
    running_number: u64,
    torque_nm: &'a [f64],
    measured: [Option<&'a [f64]>; 3],
    simulated: [Option<&'a [f64]>; 3],
    euler_displacement_rad: Option<&'a [f64]>,
    forces_n: [Option<&'a [f64]>; 3],
    grip_force_n: Option<&'a [f64]>,
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
        let check = |signal, samples: Option<&'a [f64]>| match samples {
            Some(samples) if samples.len() != expected => Err(RecordError::UnequalLengths {
                tightening: tightening.to_string(),
                signal,
                expected,
                found: samples.len(),
            }),
            samples => Ok(samples),
        };
        let motion = |names: [&'static str; 3], motion: &'a Motion| {
            let mut columns = [None; 3];
            for ((column, name), quantity) in columns.iter_mut().zip(names).zip(QUANTITIES) {
                *column = check(name, motion.get(quantity))?;
            }
            Ok::<_, RecordError>(columns)
        };
        let optional =
            |signal, samples: &'a [f64]| check(signal, (!samples.is_empty()).then_some(samples));
        Ok(Self {
            running_number,
            torque_nm: &traces.torque_nm,
            measured: motion(
                [
                    "measured.displacement_rad",
                    "measured.velocity_rad_per_s",
                    "measured.acceleration_rad_per_s2",
                ],
                &traces.measured,
            )?,
            simulated: motion(
                [
                    "simulated.displacement_rad",
                    "simulated.velocity_rad_per_s",
                    "simulated.acceleration_rad_per_s2",
                ],
                &traces.simulated,
            )?,
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
    }
}

/// What was measured at one sample.
pub(crate) struct MeasuredSample {
    pub(crate) tightening: u64,
    pub(crate) torque_nm: f64,
    /// Displacement, velocity, acceleration.
    pub(crate) motion: [f64; 3],
    pub(crate) grip_force_n: f64,
}

/// Reads the measured part of a message; `None` when it is not one of [`SIGNALS`].
pub(crate) fn decode(message: &[u8]) -> Option<MeasuredSample> {
    let mut sample = MeasuredSample {
        tightening: 0,
        torque_nm: f64::NAN,
        motion: [f64::NAN; 3],
        grip_force_n: f64::NAN,
    };
    for field in Fields::of(message) {
        match field? {
            (1, value) => sample.tightening = value.varint()?,
            (4, group) => {
                for field in Fields::of(group.bytes()?) {
                    match field? {
                        (1, value) => sample.torque_nm = value.double()?,
                        (number @ 2..=4, value) => {
                            sample.motion[number as usize - 2] = value.double()?;
                        }
                        _ => {}
                    }
                }
            }
            (7, group) => {
                for field in Fields::of(group.bytes()?) {
                    if let (4, value) = field? {
                        sample.grip_force_n = value.double()?;
                    }
                }
            }
            _ => {}
        }
    }
    Some(sample)
}
