//! Numbers of a diagnosis as text: sizes with interval and unit, shares, chances.

use snug_campaign::EffectParameter;

/// Four significant digits; a power of ten for what is very large or small.
pub fn significant(value: f64) -> String {
    if value == 0.0 || (1e-3..1e5).contains(&value.abs()) {
        let digits = 3 - value.abs().max(1e-9).log10().floor() as i32;
        format!("{value:.*}", digits.clamp(0, 8) as usize)
    } else if value.is_finite() {
        format!("{value:.2e}")
    } else {
        "?".into()
    }
}

/// A parameter with interval and unit: `cubic stiffness 9.90e5 [9.61e5, 1.02e6] N/m^3`.
pub fn sized(parameter: &EffectParameter) -> String {
    let unit = match parameter.unit.as_str() {
        "1" => String::new(),
        unit => format!(" {unit}"),
    };
    let range = match (parameter.low, parameter.high) {
        // An interval without width says that the data do not determine the value.
        (Some(low), Some(high)) if high - low > 1e-6 * parameter.value.abs() => {
            let (low, high) = (alike(low, parameter), alike(high, parameter));
            format!(" [{low}, {high}]{unit}")
        }
        _ => format!("{unit} (no interval)"),
    };
    let own = match (parameter.per_tightening, parameter.spread) {
        (true, Some(spread)) => format!(
            " on average, spread {} from tightening to tightening",
            significant(spread)
        ),
        (true, None) => " on average".into(),
        (false, _) => String::new(),
    };
    let called = match parameter.meaning.as_str() {
        "" => &parameter.name,
        meaning => meaning,
    };
    let beyond = match parameter.is_plausible() {
        true => String::new(),
        false => format!(
            ", beyond the plausible {} to {}",
            limit(parameter.minimum),
            limit(parameter.maximum)
        ),
    };
    format!(
        "{called} {}{range}{own}{beyond}",
        alike(parameter.value, parameter)
    )
}

/// A round number as people write it.
fn limit(value: f64) -> String {
    match value == 0.0 || (1e-3..1e5).contains(&value.abs()) {
        true => format!("{value}"),
        false => format!("{value:e}"),
    }
}

/// As many decimals as half the interval supports with two digits; a power of ten where the value needs one.
fn alike(number: f64, parameter: &EffectParameter) -> String {
    let largest = [Some(parameter.value), parameter.low, parameter.high]
        .into_iter()
        .flatten()
        .fold(0.0, |largest: f64, value| largest.max(value.abs()));
    if number == 0.0 {
        return "0".into();
    }
    if !(1e-3..1e5).contains(&largest) || !number.is_finite() {
        return significant_in_powers(number);
    }
    let half = match (parameter.low, parameter.high) {
        (Some(low), Some(high)) if high > low => 0.5 * (high - low),
        _ => return significant(number),
    };
    let decimals = (1 - half.log10().floor() as i32).clamp(0, 8);
    unsigned_zero(format!("{number:.*}", decimals as usize))
}

/// A rounded zero has no sign.
fn unsigned_zero(text: String) -> String {
    match text.strip_prefix('-') {
        Some(rest) if rest.chars().all(|digit| matches!(digit, '0' | '.')) => rest.to_owned(),
        _ => text,
    }
}

fn significant_in_powers(number: f64) -> String {
    if number.is_finite() {
        format!("{number:.2e}")
    } else {
        "?".into()
    }
}

/// A share 0..1 with its standard error, in percent; in words where the error leaves nothing of it.
pub fn share(share: f64, error: f64) -> String {
    if !share.is_finite() || !error.is_finite() || error >= 0.5 {
        return "nothing sure".into();
    }
    let decimals = if error < 0.005 { 1 } else { 0 };
    // Few tightenings leave the misfit itself uncertain; more than all of it cannot be removed.
    let share = unsigned_zero(format!("{:.decimals$}", 100.0 * share.min(1.0)));
    format!("{share} ± {:.decimals$} %", (100.0 * error).max(0.1))
}

/// A p value that does not pretend.
pub fn p_value(p: f64) -> String {
    if !p.is_finite() {
        "?".into()
    } else if p < 0.001 {
        "< 0.001".into()
    } else {
        format!("{p:.3}")
    }
}

/// A p value in words.
pub fn by_chance(p: f64) -> String {
    if !p.is_finite() {
        return "its chance could not be told".into();
    }
    if p >= 0.1 {
        return format!(
            "chance alone would do this in {:.0} of 100 cases",
            100.0 * p
        );
    }
    if p < 0.001 {
        return "chance alone would do this less than once in 1000 cases".into();
    }
    let one_in = (1.0 / p).round();
    format!("chance alone would do this once in {one_in:.0} cases")
}
