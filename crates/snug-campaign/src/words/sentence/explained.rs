//! How much of a measured output a model explains, where its noise is not known.

use crate::words::number::{fixed, whole_percent};
use std::fmt::{self, Display, Formatter};

/// Correlation of neighbouring samples from which what is left is a motion \[–\]: then more of it can be told from the sample before
/// than cannot, 0.71² = ½.
const A_MOTION: f64 = 0.71;

/// The same where straight lines from restart to restart hardly count \[–\], which is what most of a motion is over so short a time. Chosen: gusts
/// that doubled what noise leaves of a tower correlated by 0.64, and hid dry friction of a seventh of the force; fits at the noise, by 0.10 or less.
const A_MOTION_BESIDE_LINES: f64 = 0.5;

/// Correlation of neighbouring samples below which what is left is white \[–\]: 0.05 is the chance of two in five hundred samples,
/// and what a model misses is far smoother. Chosen.
const WHITE: f64 = 0.1;

/// Whether what is left is as white as noise, by the correlation of its neighbouring samples \[–\].
pub fn is_white(neighbours: f64) -> bool {
    neighbours.abs() < WHITE
}

/// Whether what is left is a motion rather than noise, by the correlation of its neighbouring samples \[–\], of all that is left or of what
/// straight lines from restart to restart hardly count in.
pub fn is_a_motion(neighbours: f64, beside_lines: bool) -> bool {
    neighbours
        >= match beside_lines {
            true => A_MOTION_BESIDE_LINES,
            false => A_MOTION,
        }
}

/// What a model explains of the fitted output.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Explained {
    /// Name of the output.
    pub output: &'static str,
    /// Share of its power about the mean \[–\]; below 0 where the mean alone would do better.
    pub share: f64,
    /// Correlation of neighbouring samples of what is left \[–\]: 0 of white noise, near 1 of a motion.
    pub neighbours: f64,
    /// Whether what is left is rounding.
    pub is_exact: bool,
    /// Whether straight lines from restart to restart hardly count in what is left.
    pub beside_lines: bool,
}

impl Display for Explained {
    /// `98 % of the measured velocity's power`.
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self.share > 0.0 {
            true => write!(f, "{}", at_most_all(self.share))?,
            false => write!(f, "nothing")?,
        }
        write!(f, " of the measured {}'s power", self.output)
    }
}

impl Explained {
    /// Whether what is left is a motion rather than noise.
    pub fn leaves_a_motion(&self) -> bool {
        is_a_motion(self.neighbours, self.beside_lines) && !self.is_exact
    }

    /// How far what is left is from noise, as a sentence.
    pub fn left(&self) -> String {
        if self.is_exact {
            return "What is left is rounding: less than an instrument could see.".into();
        }
        let correlation = format!(
            "correlate by {} (0 is white noise, 1 a smooth motion).",
            fixed(self.neighbours, 2)
        );
        match self.leaves_a_motion() {
            false => format!("Neighbouring samples of what is left {correlation}"),
            true => format!(
                "What is left is still a motion rather than noise: its neighbouring samples {correlation}"
            ),
        }
    }
}

/// A share as it is said: only what leaves nothing is 100 %.
pub(super) fn at_most_all(share: f64) -> String {
    match share {
        share if share < 0.005 => "less than 1\u{a0}%".into(),
        share if share < 0.995 => whole_percent(share),
        share if share < 0.999_95 => format!("{}\u{a0}%", fixed(100.0 * share, 2)),
        _ => "more than 99.99\u{a0}%".into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_left_of_a_motion_is_called_one() {
        let left = |neighbours: f64, beside_lines: bool| {
            let one = Explained {
                output: "displacement",
                share: 0.999,
                neighbours,
                is_exact: false,
                beside_lines,
            };
            one.left()
        };
        let (motion, noise) = (
            "What is left is still a motion",
            "Neighbouring samples of what is left correlate by 0.",
        );
        assert!(left(0.97, false).starts_with(motion));
        assert!(left(0.64, false).starts_with(noise));
        assert!(left(0.64, true).starts_with(motion));
        assert!(left(0.2, true).starts_with(noise));
    }

    #[test]
    fn a_good_model_is_not_said_to_be_perfect_nor_a_bad_one_less_than_nothing() {
        let said = |share: f64| {
            let one = Explained {
                output: "velocity",
                share,
                neighbours: 0.0,
                is_exact: false,
                beside_lines: false,
            };
            one.to_string().replace('\u{a0}', " ")
        };
        assert_eq!(
            said(0.001),
            "less than 1 % of the measured velocity's power"
        );
        assert_eq!(said(0.871), "87 % of the measured velocity's power");
        assert_eq!(said(0.9996), "99.96 % of the measured velocity's power");
        assert_eq!(
            said(1.0),
            "more than 99.99 % of the measured velocity's power"
        );
        assert_eq!(said(-3.0), "nothing of the measured velocity's power");
    }
}
