//! Bounds the memory that drawn signals take, while nobody knows yet how many tightenings the campaign has.

use snug_campaign::Traces;

/// Most tightenings whose signals are kept for the report.
const MOST: usize = 32;

/// Signals of a bounded number of tightenings, evenly spread over the campaign however long it turns out to be.
///
/// Every tightening is kept until there are too many; then every second one is dropped and only every second further one
/// is taken, and so on.
#[derive(Default)]
pub struct Examples {
    kept: Vec<(usize, Traces)>,
    halvings: u32,
}

impl Examples {
    /// Offers the signals of tightening number `index` of the campaign.
    pub fn offer(&mut self, index: usize, traces: Traces) {
        if self.takes(index) {
            self.kept.push((index, traces));
        }
        while self.kept.len() > MOST {
            self.halvings += 1;
            let halvings = self.halvings;
            self.kept
                .retain(|(index, _)| index.is_multiple_of(1 << halvings));
        }
    }

    /// What was kept, in campaign order.
    pub fn into_kept(self) -> Vec<(usize, Traces)> {
        self.kept
    }

    fn takes(&self, index: usize) -> bool {
        index.is_multiple_of(1 << self.halvings)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use snug_campaign::{Motion, TimeBase};

    fn traces() -> Traces {
        Traces {
            time_base: TimeBase {
                start_s: 0.0,
                interval_s: 1e-4,
            },
            torque_nm: Vec::new(),
            measured: Motion::default(),
            simulated: Motion::default(),
            euler_displacement_rad: Vec::new(),
            force_f1_n: Vec::new(),
            force_f2_n: Vec::new(),
            force_f3_n: Vec::new(),
            grip_force_n: None,
        }
    }

    #[test]
    fn a_long_campaign_keeps_a_bounded_evenly_spread_few() {
        let mut examples = Examples::default();
        for index in 0..2687 {
            examples.offer(index, traces());
        }
        let kept: Vec<usize> = examples
            .into_kept()
            .iter()
            .map(|(index, _)| *index)
            .collect();
        assert!(kept.len() <= MOST && kept.len() > MOST / 2);
        assert!(
            kept.windows(2).all(|pair| pair[1] - pair[0] == kept[1]),
            "{kept:?}"
        );
    }
}
