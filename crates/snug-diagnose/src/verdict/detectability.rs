//! How large an effect that was not found would have to be to be seen in these data.

use crate::library::is_unlisted;
use crate::pooled::fitted::Fitted;
use crate::ranking::rank::Ranking;
use crate::ranking::sensitivity::Column;
use crate::settings::DiagnoseSettings;
use snug_campaign::Detectability;
use snug_campaign::words::statement;
use snug_model::Law;

/// z that the largest of the family exceeds by chance in about 5 % of campaigns, and the quantile of 95 % power.
const FAMILY_Z: f64 = 3.0;
const POWER_Z: f64 = 1.645;

/// One card for each catalogue effect that is not supported.
///
/// An effect of size α removes α² Σ I of the squared residual. It is seen when that exceeds both what the family-wise
/// test asks, (3.0 + 1.645)² in units of the noise, and the smallest gain that matters.
pub(crate) fn cards(
    ranking: &Ranking,
    fitted: &Fitted,
    settings: &DiagnoseSettings,
) -> Vec<Detectability> {
    let needed = ((FAMILY_Z + POWER_Z).powi(2) * fitted.scale())
        .max(fitted.smallest_gain(settings) * fitted.squares());
    ranking
        .candidates
        .iter()
        .filter(|candidate| !is_unlisted(candidate.effect) && !candidate.is_supported(settings))
        .filter_map(|candidate| {
            let columns = ranking
                .columns
                .iter()
                .filter(|c| c.effect == candidate.effect);
            let best = columns.max_by(|a, b| a.information.total_cmp(&b.information))?;
            Some(card(best, needed))
        })
        .collect()
}

fn card(column: &Column, needed: f64) -> Detectability {
    let description = column.effect.description();
    let (parameter, unit_size) = column.size();
    let spec = &description.parameters[parameter];
    let largest = column.largest[parameter];
    let multiple = (needed / column.information).sqrt();
    let smallest = (multiple * unit_size.abs())
        .is_finite()
        .then_some(multiple * unit_size.abs())
        .filter(|smallest| *smallest <= largest);
    Detectability {
        effect: description.name.to_owned(),
        parameter: spec.name.to_owned(),
        meaning: spec.meaning.to_owned(),
        unit: spec.unit.to_owned(),
        smallest_detectable: smallest,
        largest_plausible: largest,
        statement: statement::detectability(description.name, smallest, spec.unit),
    }
}
