//! The tool's acceleration while it flies freely through a gap in the grip, where nothing but the torque acts. A tool that
//! swings back through a gap of some ten micrometres does so for one to three samples, which looks like a spike.

use snug_campaign::Rig;

/// The heaviest hand and arm that move with a tool \[kg\].
const HEAVIEST_KG: f64 = 10.0;

/// What may be flown under.
pub(crate) struct FreeFlight {
    torque_nm: Vec<f64>,
    rig: Rig,
}

impl FreeFlight {
    /// Under this torque, on this rig.
    pub(crate) fn new(torque_nm: &[f64], rig: Rig) -> Self {
        Self {
            torque_nm: torque_nm.to_vec(),
            rig,
        }
    }

    /// Whether an acceleration of `value` at sample `index`, which was `level` just before, leads no further than to free
    /// flight, T / (I_n + m l²) for a hand of any mass m, give or take `tolerance` \[rad/s²\].
    pub(crate) fn explains(&self, index: usize, level: f64, value: f64, tolerance: f64) -> bool {
        let Rig {
            lever_arm_m,
            known_inertia_kg_m2: known,
        } = self.rig;
        if known <= 0.0 {
            return false;
        }
        let heaviest = known + HEAVIEST_KG * lever_arm_m * lever_arm_m;
        let torque_nm = self.torque_nm[index];
        let reached = [level, torque_nm / known, torque_nm / heaviest];
        let lowest = reached.into_iter().fold(f64::INFINITY, f64::min) - tolerance;
        let highest = reached.into_iter().fold(f64::NEG_INFINITY, f64::max) + tolerance;
        (lowest..=highest).contains(&value)
    }
}
