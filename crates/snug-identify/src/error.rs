//! Why a tightening cannot be identified.

use snug_campaign::Quantity;
use snug_least_squares::SolveError;
use snug_model::ModelError;
use thiserror::Error;

/// Why an identification could not even begin.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum IdentifyError {
    /// The tightening does not hold the quantity to be fitted.
    #[error("the recording holds no {quantity:?}, which is the fitted output")]
    MissingOutput {
        /// The fitted quantity.
        quantity: Quantity,
    },
    /// Fewer samples are scored than parameters are free.
    #[error("{residuals} samples count, too few to determine {parameters} parameters")]
    TooShort {
        /// Scored samples.
        residuals: usize,
        /// Free parameters.
        parameters: usize,
    },
    /// A channel of the tightening has not one sample per sample of the torque.
    #[error(
        "the {channel} has {samples} samples, the torque {torque_samples}: each needs one per sample of the torque"
    )]
    UnequalLengths {
        /// Which channel: `displacement`, `velocity`, `acceleration`.
        channel: &'static str,
        /// How many samples it has.
        samples: usize,
        /// How many the torque has.
        torque_samples: usize,
    },
    /// A sample of the tightening is no finite number.
    #[error("the {channel} is {value} at sample {sample} (counted from 0), and no finite number")]
    NotFinite {
        /// Which channel: `torque`, `displacement`, `velocity`, `acceleration`.
        channel: &'static str,
        /// Which sample, counted from 0.
        sample: usize,
        /// What it is, in the channel's unit.
        value: f64,
    },
    /// What is said of the noise cannot be.
    #[error("the noise's {what} is {value}, allowed is {allowed}")]
    Noise {
        /// Field of [`snug_campaign::NoiseFloor`].
        what: &'static str,
        /// What it is, in the unit of what it is the noise of; a coefficient has none.
        value: f64,
        /// What is allowed.
        allowed: &'static str,
    },
    /// A fixed parameter is no finite number.
    #[error("the fixed parameter {name} is {value}, and no finite number")]
    FixedParameter {
        /// Its name.
        name: String,
        /// Its value, in its unit.
        value: f64,
    },
    /// The input that is simulated is as long as another tightening than the one it is compared with.
    #[error(
        "the simulated input has {input_samples} samples, the measured output {output_samples}"
    )]
    InputLength {
        /// Samples of the input.
        input_samples: usize,
        /// Samples of the output that is compared with its simulation.
        output_samples: usize,
    },
    /// The input that is simulated was made from another torque than the tightening's.
    #[error(
        "the simulated input is made from {input_nm} Nm at sample {sample} (counted from 0), the tightening's torque is {tightening_nm} Nm there"
    )]
    InputTorque {
        /// The first sample that differs, counted from 0.
        sample: usize,
        /// What the input was made from there \[Nm\].
        input_nm: f64,
        /// The tightening's torque there \[Nm\].
        tightening_nm: f64,
    },
    /// The input that is simulated is sampled at another rate than the tightening.
    #[error(
        "the simulated input is sampled every {input_s} s, the tightening every {tightening_s} s"
    )]
    InputInterval {
        /// Time between the input's samples \[s\].
        input_s: f64,
        /// Time between the tightening's samples \[s\].
        tightening_s: f64,
    },
    /// The model is that of another rig.
    #[error(
        "{field} is {model} in the model and {tightening} in the tightening: both must be of one rig"
    )]
    OtherRig {
        /// Field of [`snug_campaign::Rig`].
        field: &'static str,
        /// Its value in the model.
        model: f64,
        /// Its value in the tightening.
        tightening: f64,
    },
    /// The model cannot be assembled, or its input not be simulated.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// The solver refuses the problem.
    #[error(transparent)]
    Solve(#[from] SolveError),
}
