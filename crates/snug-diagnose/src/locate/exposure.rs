//! What a tightening did to the hand, as far as that does not depend on the hand itself.

use super::Seen;
use crate::locate::thresholds::PULSE;
use snug_campaign::Intersample;
use snug_model::{Input, Model};

/// Largest |θ| \[rad\] and |ω| \[rad/s\] that the tightening's torque gives with m, c, k = `values`.
pub fn peaks(seen: &Seen<'_>, values: &[f64; 3]) -> Option<[f64; 2]> {
    let tightening = seen.tightening;
    let model = Model::new(tightening.rig, &[]).ok()?;
    let interval_s = tightening.time_base.interval_s;
    let input = Input::new(&tightening.torque_nm, interval_s, Intersample::Linear);
    let motion = model.simulate(values, &input).ok()?;
    let largest = |signal: Option<Vec<f64>>| {
        let signal = signal?;
        let peak = signal
            .iter()
            .fold(0.0_f64, |peak, value| peak.max(value.abs()));
        (peak > 0.0 && peak.is_finite()).then_some(peak)
    };
    Some([
        largest(motion.displacement_rad)?,
        largest(motion.velocity_rad_per_s)?,
    ])
}

/// From when the torque first is above a tenth of its peak until it last is \[s\]; `None` without an onset.
pub fn pulse_length_s(seen: &Seen<'_>) -> Option<f64> {
    let tightening = seen.tightening;
    tightening.onset?;
    let torque = &tightening.torque_nm;
    let peak_nm = torque.iter().copied().reduce(f64::max)?;
    let above = |torque: &f64| *torque > PULSE * peak_nm;
    let (first, last) = (
        torque.iter().position(above)?,
        torque.iter().rposition(above)?,
    );
    (peak_nm > 0.0).then(|| (last - first + 1) as f64 * tightening.time_base.interval_s)
}
