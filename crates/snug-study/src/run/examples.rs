//! Bounds the memory that drawn signals take, while nobody knows yet how many tightenings the campaign has.

use snug_campaign::{TighteningId, Traces};

/// Most tightenings whose signals are kept for the report.
const MOST: usize = 32;

/// Signals of a bounded number of tightenings, evenly spread over the campaign however long it turns out to be.
///
/// Every tightening is kept until there are too many; then every second one is dropped and only every second further one
/// is taken, and so on. One that is asked for is kept whatever else is.
#[derive(Default)]
pub struct Examples {
    asked_for: Option<TighteningId>,
    asked: Option<usize>,
    kept: Vec<(usize, Traces)>,
    halvings: u32,
}

impl Examples {
    /// Of a campaign of which this tightening is to be among them.
    pub fn with(asked_for: Option<TighteningId>) -> Self {
        Self {
            asked_for,
            ..Self::default()
        }
    }

    /// Offers the signals of tightening number `index` of the campaign.
    pub fn offer(&mut self, index: usize, id: &TighteningId, traces: Traces) {
        if self.asked_for.as_ref() == Some(id) {
            self.asked = Some(index);
        }
        if self.asked == Some(index) || self.takes(index) {
            self.kept.push((index, traces));
        }
        while self.kept.len() > MOST {
            self.halvings += 1;
            let (halvings, asked) = (self.halvings, self.asked);
            self.kept
                .retain(|(index, _)| asked == Some(*index) || index.is_multiple_of(1 << halvings));
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
            before: Motion::default(),
            euler_displacement_rad: Vec::new(),
            force_f1_n: Vec::new(),
            force_f2_n: Vec::new(),
            force_f3_n: Vec::new(),
            grip_force_n: None,
        }
    }

    #[test]
    fn a_long_campaign_keeps_a_bounded_evenly_spread_few() {
        let id = |index: usize| TighteningId {
            file: "a.mat".into(),
            number: index as u32,
        };
        let mut examples = Examples::with(Some(id(1001)));
        for index in 0..2687 {
            examples.offer(index, &id(index), traces());
        }
        let mut kept: Vec<usize> = examples
            .into_kept()
            .iter()
            .map(|(index, _)| *index)
            .collect();
        let asked = kept.iter().position(|index| *index == 1001);
        kept.remove(asked.expect("what is asked for is kept"));
        assert!(kept.len() <= MOST && kept.len() > MOST / 2);
        assert!(
            kept.windows(2).all(|pair| pair[1] - pair[0] == kept[1]),
            "{kept:?}"
        );
    }
}
