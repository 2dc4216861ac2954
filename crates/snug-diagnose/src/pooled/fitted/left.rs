//! What a fit leaves of the measured output.

use crate::data::cases::Cases;
use crate::data::neighbours::correlation;
use crate::data::white_noise::is_white_noise;
use crate::pooled::equation::values;
use crate::pooled::fitted::Fitted;
use snug_campaign::words::explained::is_a_motion;
use snug_identify::FitTask;

impl Fitted {
    /// Whether that is a motion rather than noise, by its neighbouring samples.
    pub fn leaves_a_motion(&self, cases: Cases<'_>) -> bool {
        let left = self.left(cases);
        let beside_lines = cases.iter().any(FitTask::is_beside_lines);
        left.is_some_and(|left| is_a_motion(correlation(&left), beside_lines))
    }

    /// Whether that is white noise, however long it is looked at.
    pub fn leaves_white_noise(&self, cases: Cases<'_>) -> bool {
        let left = self.left(cases);
        left.is_some_and(|left| is_white_noise(&left))
    }

    /// What it leaves of each of `cases`, see [`FitTask::left`]; `None` where it cannot be simulated.
    fn left(&self, cases: Cases<'_>) -> Option<Vec<Vec<f64>>> {
        let simulated = self.simulated(cases)?;
        let pairs = cases.iter().zip(&simulated);
        Some(pairs.map(|(case, one)| case.left(one)).collect())
    }

    /// The fitted output of each of `cases`, every sample, in its unit; `None` where it cannot be simulated.
    pub fn simulated(&self, cases: Cases<'_>) -> Option<Vec<Vec<f64>>> {
        let of_one = |(case, values): (&FitTask<'_>, Vec<f64>)| {
            let model = case.model_with(&self.effects).ok()?;
            case.simulated(&model, &values).ok()
        };
        let values = values(cases, self)?;
        cases.iter().zip(values).map(of_one).collect()
    }
}
