//! The fitted noise process in the words of `snug-campaign`.

use crate::autoregression::Autoregression;
use snug_campaign::{NoiseFloor, NoiseSource, Quantity};

/// The noise floor that the quiet part shows for `quantity`.
pub(crate) fn pre_roll_floor(noise: &Autoregression, quantity: Quantity) -> NoiseFloor {
    NoiseFloor {
        source: NoiseSource::PreRoll,
        quantity,
        standard_deviation: noise.standard_deviation,
        autoregression: noise.coefficients.clone(),
        innovation_sd: noise.innovation_sd,
        samples: noise.samples,
    }
}
