//! Whether recordings are tightenings: one pulse of the input each, behind a quiet part that measures bias and noise.

/// Where the pulse lies in one recording.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Flanks {
    /// Its first flank after the recording's start \[s\].
    pub(super) first_s: f64,
    /// Its last flank \[s\].
    pub(super) end_s: f64,
    /// Length of the recording \[s\].
    pub(super) recording_s: f64,
}

/// The window that holds the pulse of every recording.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Pulse {
    /// Its start after the recording's start \[s\].
    pub(super) start_s: f64,
    /// Its length \[s\].
    pub(super) length_s: f64,
}

/// Samples of the quiet part at least: fewer measure no noise.
const FEWEST_QUIET: usize = 100;
/// The quiet part is no larger than this share of the pulse.
const QUIET: f64 = 0.02;
/// The pulse begins and ends at this share of its height.
const FLANK: f64 = 0.1;
/// The window begins before the first pulse's flank by so many \[s\], as in the layout of the thesis.
const BEFORE_S: f64 = 0.02;
/// The window is as long as so many of the longest pulse, so that what moves on after it shows.
const LENGTHS: f64 = 3.0;

/// First sample of a recording's pulse and one past its last; `None` where there is no pulse, or more than one.
pub(super) fn pulse(input: &[f64]) -> Option<(usize, usize)> {
    let start = input.get(..FEWEST_QUIET)?;
    let level = start.iter().sum::<f64>() / start.len() as f64;
    let size = |value: &f64| (value - level).abs();
    let height = input.iter().map(size).fold(0.0, f64::max);
    let is_high = |value: &f64| size(value) > FLANK * height;
    let first = input.iter().position(is_high)?;
    let last = input.iter().rposition(is_high)?;
    // Before the flank the input already rises.
    let quiet = &input[..first - first / 10];
    let is_quiet =
        quiet.len() >= FEWEST_QUIET && quiet.iter().all(|value| size(value) <= QUIET * height);
    let is_one = input[first..=last]
        .iter()
        .filter(|value| is_high(value))
        .count()
        * 10
        > (last - first) * 9;
    let comes_back = last + 1 < input.len() && 2 * (last - first) < input.len();
    (is_quiet && is_one && comes_back).then_some((first, last + 1))
}

/// The window that holds the pulse of every recording; `None` where the pulses do not begin together.
pub(super) fn window(pulses: &[Flanks]) -> Option<Pulse> {
    let least = |of: fn(&Flanks) -> f64| pulses.iter().map(of).fold(f64::INFINITY, f64::min);
    let most = |of: fn(&Flanks) -> f64| pulses.iter().map(of).fold(0.0, f64::max);
    let (first_s, last_s) = (least(|one| one.first_s), most(|one| one.first_s));
    let longest_s = most(|one| one.end_s - one.first_s);
    let start_s = first_s - BEFORE_S;
    let together = last_s - first_s <= longest_s.max(BEFORE_S);
    let length_s = (LENGTHS * longest_s + last_s - first_s + BEFORE_S)
        .min(least(|one| one.recording_s) - start_s);
    let three = |value: f64| (value * 1000.0).floor() / 1000.0;
    (together && start_s > 0.0 && length_s > longest_s).then(|| Pulse {
        start_s: three(start_s),
        length_s: three(length_s),
    })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    /// A half sine of 100 samples behind 300 of small noise.
    fn tightening() -> Vec<f64> {
        let noise = |k: usize| if k.is_multiple_of(2) { 0.01 } else { -0.01 };
        let sine = |k: usize| (std::f64::consts::PI * k as f64 / 100.0).sin();
        (0..600)
            .map(|k| {
                noise(k)
                    + if (300..400).contains(&k) {
                        sine(k - 300)
                    } else {
                        0.0
                    }
            })
            .collect()
    }

    #[test]
    fn a_pulse_behind_a_quiet_part() {
        let (first, end) = pulse(&tightening()).unwrap();
        assert!(
            (300..306).contains(&first) && (394..400).contains(&end),
            "{first} {end}"
        );
        let twice: Vec<f64> = tightening().into_iter().chain(tightening()).collect();
        assert_eq!(pulse(&twice), None, "two");
        let swing: Vec<f64> = (0..600).map(|k| f64::from(k).sin()).collect();
        assert_eq!(pulse(&swing), None, "no quiet part");
        let step: Vec<f64> = (0..600).map(|k| f64::from(u8::from(k > 300))).collect();
        assert_eq!(pulse(&step), None, "it does not come back");
        assert_eq!(pulse(&[0.0; 600]), None);
        assert_eq!(pulse(&[]), None);
    }

    #[test]
    fn pulses_that_begin_together_share_a_window() {
        let flanks = |first_s, end_s, recording_s| Flanks {
            first_s,
            end_s,
            recording_s,
        };
        let window_of = window(&[flanks(1.5, 1.6, 3.0), flanks(1.51, 1.6, 2.9)]).unwrap();
        assert_eq!(window_of.start_s, 1.48);
        assert!((0.3..0.4).contains(&window_of.length_s), "{window_of:?}");
        assert_eq!(
            window(&[flanks(1.5, 1.6, 3.0), flanks(0.5, 0.6, 3.0)]),
            None
        );
        assert_eq!(window(&[]), None);
    }
}
