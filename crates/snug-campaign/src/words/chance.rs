//! Evidence as cases out of a hundred, and shares with what is uncertain of them.

use crate::words::number::fixed;

/// How often chance alone would do as well: `chance alone does as well in 1 of 50 cases`.
pub fn by_chance(p: f64) -> String {
    if !p.is_finite() {
        return "it is not known how often chance would do as well".into();
    }
    if p < 0.001 {
        return "chance alone does as well in fewer than 1 of 1000 cases".into();
    }
    if p >= 0.1 {
        return format!(
            "chance alone does as well in {} of 100 cases",
            fixed(100.0 * p, 0)
        );
    }
    format!(
        "chance alone does as well in 1 of {} cases",
        fixed((1.0 / p).round(), 0)
    )
}

/// A standard error from which on a share says nothing: what is shared out is then within the noise. No unit; chosen, not
/// measured.
pub const UNSURE: f64 = 0.5;

/// A share 0..1 with its standard error, in percent; in words where the error leaves nothing of it.
pub fn share_with_error(share: f64, error: f64) -> String {
    if !share.is_finite() || !error.is_finite() || error >= UNSURE {
        return "nothing sure".into();
    }
    let decimals = if error < 0.005 { 1 } else { 0 };
    // Few tightenings leave the misfit itself uncertain; more than all of it cannot be removed.
    let share = share.min(1.0);
    format!(
        "{}\u{a0}±\u{a0}{}\u{a0}%",
        fixed(100.0 * share, decimals),
        fixed((100.0 * error).max(0.1), decimals)
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chance_is_said_in_cases() {
        assert_eq!(
            by_chance(0.001),
            "chance alone does as well in 1 of 1000 cases"
        );
        assert_eq!(
            by_chance(0.43),
            "chance alone does as well in 43 of 100 cases"
        );
        assert!(by_chance(0.0).ends_with("fewer than 1 of 1000 cases"));
        assert!(by_chance(f64::NAN).contains("not known"));
    }

    #[test]
    fn a_share_that_its_error_swallows_is_no_percentage() {
        assert_eq!(share_with_error(1.73, 0.4), "100\u{a0}±\u{a0}40\u{a0}%");
        assert_eq!(share_with_error(0.72, 6.17), "nothing sure");
        assert_eq!(share_with_error(0.83, 0.04), "83\u{a0}±\u{a0}4\u{a0}%");
        assert_eq!(
            share_with_error(0.991, 0.003),
            "99.1\u{a0}±\u{a0}0.3\u{a0}%"
        );
    }
}
