//! What a column name means: `stiffness_n_per_m` is read as "stiffness k" in N/m.

use crate::words::signal_unit;
use snug_campaign::words::effect_name::unit_text;
use snug_campaign::{CampaignResult, ParameterMeaning};

/// How a quantity is called on the page.
#[derive(Debug, Clone, PartialEq)]
pub struct QuantityName {
    /// In words, lower case.
    pub words: String,
    /// Symbol of the field, empty where there is none.
    pub symbol: &'static str,
    /// Unit as people write it, empty for pure numbers.
    pub unit: String,
}

impl QuantityName {
    /// `stiffness k [N/m]`, for axes and headings.
    pub fn with_unit(&self) -> String {
        let mut text = self.words.clone();
        if !self.symbol.is_empty() {
            text = format!("{text} {}", self.symbol);
        }
        if self.unit.is_empty() {
            text
        } else {
            format!("{text} [{}]", self.unit)
        }
    }
}

/// The quantities of the thesis' tables.
const KNOWN: &[(&str, &str, &str, &str)] = &[
    ("mass_kg", "mass", "m", "kg"),
    ("damping_kg_per_s", "damping", "c", "kg/s"),
    ("stiffness_n_per_m", "stiffness", "k", "N/m"),
    ("natural_frequency_hz", "natural frequency", "fₙ", "Hz"),
    ("damped_frequency_hz", "damped frequency", "f_d", "Hz"),
    ("damping_ratio", "damping ratio", "ζ", ""),
    ("fit_percent", "fit", "", "%"),
    ("error_over_noise", "error over noise", "", ""),
    ("pace_per_min", "pace", "", "1/min"),
    ("target_torque_nm", "target torque", "", "Nm"),
    ("peak_torque_nm", "peak torque", "", "Nm"),
    ("selected_share", "selected share", "", ""),
];

/// Names a column, as the page shows it.
pub fn name(column: &str, result: &CampaignResult) -> QuantityName {
    let declared = as_declared(column, result);
    QuantityName {
        unit: unit_text(&declared.unit),
        ..declared
    }
}

/// A column's unit, as files give it.
pub fn unit(column: &str, result: &CampaignResult) -> String {
    as_declared(column, result).unit
}

/// Names a column; the unit of an effect's parameter is taken from its estimates, else read from the name's end.
fn as_declared(column: &str, result: &CampaignResult) -> QuantityName {
    if let Some((_, words, symbol, unit)) = KNOWN.iter().find(|known| known.0 == column) {
        return QuantityName {
            words: (*words).into(),
            symbol,
            unit: result
                .units
                .base_parameter(column)
                .unwrap_or_else(|| (*unit).into()),
        };
    }
    let (stem, suffix_unit) = split_unit(column);
    let declared = result
        .tightenings
        .iter()
        .filter_map(|tightening| tightening.estimate.as_ref())
        .find_map(|estimate| estimate.parameter(column))
        .map(|parameter| parameter.unit.clone());
    let of_effect = result.meanings.iter().find(|told| told.name == column);
    QuantityName {
        words: of_effect.map_or_else(|| stem.replace('_', " "), ParameterMeaning::words),
        symbol: "",
        unit: signal_unit::effect_parameter(&result.units, declared.unwrap_or(suffix_unit)),
    }
}

/// A factor or method of the statistics in words.
pub fn words(name: &str) -> String {
    match name {
        "pace_per_min" => "pace [1/min]".into(),
        "target_torque_nm" => "target torque [Nm]".into(),
        "welch_t" => "Welch t".into(),
        "student_t" => "Student t".into(),
        "one_way_anova" => "one-way ANOVA".into(),
        "welch_anova" => "Welch ANOVA".into(),
        "mann_whitney" => "Mann–Whitney".into(),
        "kruskal_wallis" => "Kruskal–Wallis".into(),
        "shapiro_wilk" => "Shapiro–Wilk".into(),
        "brown_forsythe" => "Brown–Forsythe".into(),
        "hedges_g" => "Hedges g".into(),
        "eta_squared" => "η²".into(),
        "epsilon_squared" => "ε²".into(),
        other => other.replace('_', " "),
    }
}

/// A name with its first letter in upper case; a symbol such as `k3` stays as it is.
pub fn capitalised(text: &str) -> String {
    let first_word = text.split(' ').next().unwrap_or("");
    if first_word.contains(|letter: char| letter.is_ascii_digit()) {
        return text.into();
    }
    snug_campaign::words::capitalised(text)
}

/// Splits `k3_n_per_m3` into `k3` and `N/m³`; the unit is empty where the name ends in no unit.
fn split_unit(column: &str) -> (&str, String) {
    let (head, below) = match column.split_once("_per_") {
        Some((head, below)) => (head, Some(below)),
        None => (column, None),
    };
    let mut stem = head;
    let mut above = Vec::new();
    // A quotient may have several factors above the line (n_s_per_m); a lone suffix is one unit.
    let most = if below.is_some() { 2 } else { 1 };
    while above.len() < most {
        let Some((rest, last)) = stem.rsplit_once('_') else {
            break;
        };
        let Some(unit) = unit_word(last) else { break };
        above.insert(0, unit);
        stem = rest;
    }
    if above.is_empty() {
        return (column, String::new());
    }
    let above = above.join("·");
    let below: Option<Vec<String>> =
        below.map(|words| words.split('_').filter_map(unit_word).collect());
    match below {
        Some(factors) if factors.is_empty() => (column, String::new()),
        Some(factors) => (stem, format!("{above}/{}", factors.join("·"))),
        None => (stem, above),
    }
}

fn unit_word(word: &str) -> Option<String> {
    let (base, power) = match word.strip_suffix(['2', '3', '5']) {
        Some(base) => (base, &word[base.len()..]),
        None => (word, ""),
    };
    let unit = match base {
        "s" | "m" | "kg" | "rad" => base,
        "n" => "N",
        "nm" => "Nm",
        "hz" => "Hz",
        "percent" => "%",
        _ => return None,
    };
    let power = match power {
        "2" => "²",
        "3" => "³",
        "5" => "⁵",
        _ => "",
    };
    Some(format!("{unit}{power}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_units_from_names() {
        for (column, stem, unit) in [
            ("k3_n_per_m3", "k3", "N/m³"),
            ("torque_delay_s", "torque_delay", "s"),
            (
                "acceleration_bias_rad_per_s2",
                "acceleration_bias",
                "rad/s²",
            ),
            ("maxwell_damping_n_s_per_m", "maxwell_damping", "N·s/m"),
            ("coulomb_force_n", "coulomb_force", "N"),
            ("exponent", "exponent", ""),
            ("lag_ratio", "lag_ratio", ""),
        ] {
            assert_eq!(split_unit(column), (stem, unit.to_string()), "{column}");
        }
    }
}
