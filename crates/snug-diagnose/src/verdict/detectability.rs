//! How large an effect that was not found would have to be to be seen in these data.

use crate::library::is_unlisted;
use crate::pooled::fitted::Fitted;
use crate::pooled::sharing::Groups;
use crate::ranking::rank::Ranking;
use crate::ranking::sensitivity::Column;
use crate::settings::DiagnoseSettings;
use crate::verdict::in_some_groups::in_some_groups;
use crate::verdict::thresholds::{FAMILY_Z, POWER_Z};
use snug_campaign::words::statement;
use snug_campaign::{Detectability, Quantity};
use snug_model::Law;

/// One card for each catalogue effect that is not supported, where this `output` is fitted.
///
/// An effect of size α removes α² Σ I of the squared residual. It is seen when that exceeds both what the family-wise
/// test asks, (3.0 + 1.645)² in units of the noise, and the smallest gain that matters.
pub(crate) fn cards(
    ranking: &Ranking,
    fitted: &Fitted,
    groups: Option<&Groups>,
    settings: &DiagnoseSettings,
    output: Quantity,
) -> Vec<Detectability> {
    let least = fitted.smallest_gain(settings) * fitted.squares();
    let asked = Asked {
        noise: fitted.scale(),
        least,
        groups: groups.filter(|_| !fitted.are_stretches()),
        output,
    };
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
            Some(card(best, &asked))
        })
        .collect()
}

/// What must fall of the squared residual.
struct Asked<'a> {
    /// Mean squared residual, of which chance takes some multiples.
    noise: f64,
    /// What matters.
    least: f64,
    /// Who may have an effect or not.
    groups: Option<&'a Groups>,
    /// What is fitted.
    output: Quantity,
}

fn card(column: &Column, asked: &Asked<'_>) -> Detectability {
    let needed = ((FAMILY_Z + POWER_Z).powi(2) * asked.noise).max(asked.least);
    let description = column.effect.description();
    let (parameter, unit_size) = column.size();
    let spec = &description.parameters[parameter];
    let unit = spec.unit_where(asked.output);
    let largest = column.largest[parameter];
    let multiple = (needed / column.information).sqrt();
    let smallest = (multiple * unit_size.abs())
        .is_finite()
        .then_some(multiple * unit_size.abs())
        .filter(|smallest| *smallest <= largest);
    let in_some = asked.groups.and_then(|groups| {
        let of_noise = (asked.noise, asked.least);
        in_some_groups(column, groups, of_noise, unit_size.abs(), largest)
    });
    Detectability {
        effect: description.name.to_owned(),
        parameter: spec.name.to_owned(),
        meaning: spec.meaning.to_owned(),
        unit: unit.to_owned(),
        smallest_detectable: smallest,
        largest_plausible: largest,
        statement: statement::detectability(description.name, smallest, unit, in_some.as_ref()),
        in_some_groups: in_some,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::made_up::{candidate, close, ranking, term};
    use snug_model::Effect::{self, Backlash, CubicStiffness, QuadraticStiffness};

    /// Nothing but noise: in units of it, as much as there are residuals.
    const NOISE: (f64, usize) = (100.0, 100);

    /// What four tightenings say of which a model leaves so many squares in so many residuals each.
    fn cards_of(columns: Vec<Column>, (squares, count): (f64, usize)) -> Vec<Detectability> {
        let few = [1.0, -1.0, 2.0, -2.0];
        let mut ranking = ranking(vec![
            candidate(CubicStiffness, 0.8, &few),
            candidate(Backlash, 0.8, &few),
            candidate(term("x5_law"), 0.8, &few),
            candidate(QuadraticStiffness, 0.01, &[10.0, 11.0, 9.0, 10.0]),
        ]);
        ranking.columns = columns;
        let fitted = Fitted::made_up(&[], &[squares; 4], count);
        cards(
            &ranking,
            &fitted,
            None,
            &DiagnoseSettings::default(),
            Quantity::Displacement,
        )
    }

    fn column(effect: Effect, information: f64, start: f64) -> Column {
        let mut column = Column::with_scores(effect, vec![0.0; 4]);
        (column.information, column.start) = (information, vec![start]);
        column
    }

    /// (3.000 + 1.645)² = 21.576; the smallest gain at the noise, 0.003 of 400, is less. Curvature 10⁻⁹ per (N/m³)².
    #[test]
    fn at_the_noise_an_effect_is_seen_where_it_stands_out_from_chance() {
        let cards = cards_of(vec![column(CubicStiffness, 1e-9, 0.0)], NOISE);
        let [card] = cards.as_slice() else {
            panic!("one effect was scored and not supported")
        };
        let smallest = card.smallest_detectable.expect("it can be seen");
        close(smallest, (21.576_025e9_f64).sqrt(), 1e-6);
        assert_eq!(
            card.statement,
            "cubic stiffness: absent or smaller than 1.47\u{a0}×\u{a0}10⁵\u{a0}N/m³."
        );
        assert_eq!(
            (card.parameter.as_str(), card.largest_plausible),
            ("k3_n_per_m3", 5e6)
        );
    }

    /// 0.01 of 8000 is 80, more than 21.576 times the 2 that a squared residual has here.
    #[test]
    fn beside_a_large_misfit_of_many_samples_an_effect_must_matter() {
        let cards = cards_of(vec![column(CubicStiffness, 1e-9, 0.0)], (2000.0, 1000));
        let smallest = cards[0].smallest_detectable.expect("it can be seen");
        close(smallest, 80e9_f64.sqrt(), 1e-6);
    }

    #[test]
    fn what_would_have_to_be_larger_than_plausible_cannot_be_shown() {
        let cards = cards_of(vec![column(CubicStiffness, 1e-13, 0.0)], NOISE);
        assert_eq!(cards[0].smallest_detectable, None);
        assert!(
            cards[0]
                .statement
                .contains("could not show it, even at its largest")
        );
        let unseen = cards_of(vec![column(CubicStiffness, 0.0, 0.0)], NOISE);
        assert_eq!(
            unseen[0].smallest_detectable, None,
            "no column knows anything of it"
        );
    }

    /// A start of 0.5 mm against none that carries 100 units of information: seen at 0.5 mm · √(21.576 / 100).
    #[test]
    fn a_start_against_none_counts_in_its_own_size_and_the_best_speaks() {
        let columns = vec![column(Backlash, 1.0, 1.3e-5), column(Backlash, 100.0, 5e-4)];
        let cards = cards_of(columns, NOISE);
        let smallest = cards[0].smallest_detectable.expect("it can be seen");
        close(smallest, 5e-4 * 0.215_760_25_f64.sqrt(), 1e-6);
    }

    #[test]
    fn what_is_supported_or_in_no_catalogue_has_no_card() {
        let columns = vec![
            column(QuadraticStiffness, 1.0, 0.0),
            column(term("x5_law"), 1.0, 0.0),
        ];
        assert!(cards_of(columns, NOISE).is_empty());
    }
}
