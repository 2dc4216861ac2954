//! Measurements that are there twice, as when a folder holds a file and its copy: the second says nothing new.

use snug_campaign::Motion;
use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::hash::{DefaultHasher, Hasher};

/// What was measured so far, and whose it is.
#[derive(Debug)]
pub(crate) struct Measured<Id> {
    whose: HashMap<u64, Id>,
}

impl<Id> Default for Measured<Id> {
    fn default() -> Self {
        Self {
            whose: HashMap::new(),
        }
    }
}

impl<Id: Clone> Measured<Id> {
    /// Who had these samples before, every bit of input and motion alike; if nobody had, `id` has them from now on.
    pub fn before(&mut self, id: &Id, torque_nm: &[f64], motion: &Motion) -> Option<Id> {
        match self.whose.entry(digest(torque_nm, motion)) {
            Entry::Occupied(first) => Some(first.get().clone()),
            Entry::Vacant(nobody) => {
                nobody.insert(id.clone());
                None
            }
        }
    }
}

/// 64 bits of all samples: among 10⁵ tightenings two that differ have the same with a probability of 3e-10.
fn digest(torque_nm: &[f64], motion: &Motion) -> u64 {
    let Motion {
        displacement_rad,
        velocity_rad_per_s,
        acceleration_rad_per_s2,
    } = motion;
    let mut hasher = DefaultHasher::new();
    let motion = [
        displacement_rad,
        velocity_rad_per_s,
        acceleration_rad_per_s2,
    ];
    let channels = motion.map(|channel| channel.as_deref());
    for channel in channels.into_iter().chain([Some(torque_nm)]) {
        hasher.write_usize(channel.map_or(usize::MAX, <[f64]>::len));
        for sample in channel.unwrap_or_default() {
            hasher.write_u64(sample.to_bits());
        }
    }
    hasher.finish()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_samples_are_a_copy_and_one_bit_more_is_not() {
        let torque_nm = [1.0, 2.0];
        let angle = |last: f64| Motion {
            displacement_rad: Some(vec![0.1, last]),
            ..Motion::default()
        };
        let speed = Motion {
            velocity_rad_per_s: Some(vec![0.1, 0.2]),
            ..Motion::default()
        };
        let mut measured = Measured::default();
        assert_eq!(measured.before(&"first", &torque_nm, &angle(0.2)), None);
        let next = 0.2_f64.next_up();
        assert_eq!(measured.before(&"a bit", &torque_nm, &angle(next)), None);
        assert_eq!(measured.before(&"speed", &torque_nm, &speed), None);
        assert_eq!(measured.before(&"input", &[1.0, 3.0], &angle(0.2)), None);
        let copy = measured.before(&"copy", &torque_nm, &angle(0.2));
        assert_eq!(copy, Some("first"));
    }
}
