//! `/statistics/conditions` and `/statistics/tests`: one message each, with one row per condition or test.

use crate::schema::{Field, Kind, Message, field};

const INTERVAL: &[Field] = &[
    field("low", Kind::Double, "the quantity's", "Lower end"),
    field("high", Kind::Double, "the quantity's", "Upper end"),
];

const MOMENTS: &[Field] = &[
    field("count", Kind::Count, "", "Number of values"),
    field("mean", Kind::Double, "the quantity's", "Mean"),
    field(
        "standard_deviation",
        Kind::Double,
        "the quantity's",
        "Standard deviation",
    ),
    field(
        "mean_interval",
        Kind::Object(INTERVAL),
        "the quantity's",
        "95 % interval of the mean",
    ),
    field("median", Kind::Double, "the quantity's", "Median"),
];

const QUANTITY: &[Field] = &[
    field("quantity", Kind::Text, "", "Name with unit suffix"),
    field(
        "selected",
        Kind::Object(MOMENTS),
        "",
        "Over the selected tightenings",
    ),
    field(
        "rejected",
        Kind::Object(MOMENTS),
        "",
        "Over the rejected tightenings",
    ),
];

const CONDITION: &[Field] = &[
    field("factor", Kind::Text, "", "Factor"),
    field("level", Kind::Text, "", "Level of the factor"),
    field("tightenings", Kind::Count, "", "Tightenings"),
    field("selected", Kind::Count, "", "Of them selected"),
    field(
        "selected_share_interval",
        Kind::Object(INTERVAL),
        "",
        "95 % interval of the selected share",
    ),
    field(
        "quantities",
        Kind::List(&Kind::Object(QUANTITY)),
        "",
        "Means and spreads",
    ),
];

/// The table of `/statistics/conditions`.
pub(crate) const CONDITIONS: Message = Message {
    name: "snug.ConditionSummaries",
    about: "Means and spreads per condition",
    fields: &[field(
        "rows",
        Kind::List(&Kind::Object(CONDITION)),
        "",
        "One row per condition",
    )],
};

const EFFECT_SIZE: &[Field] = &[
    field("name", Kind::Text, "", "Measure of the effect size"),
    field("value", Kind::Double, "", "Effect size"),
    field("interval", Kind::Object(INTERVAL), "", "95 % interval"),
];

const ASSUMPTION: &[Field] = &[
    field("assumption", Kind::Text, "", "What the test presumes"),
    field("method", Kind::Text, "", "How it is checked"),
    field("statistic_name", Kind::Text, "", "Name of the statistic"),
    field("statistic", Kind::Double, "", "Value of the statistic"),
    field(
        "degrees_of_freedom",
        Kind::List(&Kind::Double),
        "",
        "Degrees of freedom",
    ),
    field("p", Kind::Double, "", "p value, not adjusted"),
    field("values", Kind::Count, "", "Values looked at"),
    field("groups", Kind::Count, "", "Groups they are in"),
    field(
        "tied",
        Kind::Count,
        "",
        "Values whose distance from their group's mean another shares",
    ),
    field("note", Kind::Text, "", "Why the check could not be made"),
];

const TEST: &[Field] = &[
    field("quantity", Kind::Text, "", "Name with unit suffix"),
    field("factor", Kind::Text, "", "Factor tested"),
    field("method", Kind::Text, "", "Method"),
    field(
        "respects_participants",
        Kind::Flag,
        "",
        "Respects that tightenings of one participant depend on each other",
    ),
    field("statistic_name", Kind::Text, "", "Name of the statistic"),
    field("statistic", Kind::Double, "", "Value of the statistic"),
    field(
        "degrees_of_freedom",
        Kind::List(&Kind::Double),
        "",
        "Degrees of freedom",
    ),
    field("p", Kind::Double, "", "p value"),
    field(
        "p_adjusted",
        Kind::Double,
        "",
        "p value adjusted for the number of tests",
    ),
    field(
        "effect_size",
        Kind::Object(EFFECT_SIZE),
        "",
        "Size of the difference",
    ),
    field("note", Kind::Text, "", "What limits the test"),
    field(
        "assumptions",
        Kind::List(&Kind::Object(ASSUMPTION)),
        "",
        "How what the test presumes stands",
    ),
];

/// The table of `/statistics/tests`.
pub(crate) const TESTS: Message = Message {
    name: "snug.Tests",
    about: "Tests per quantity and factor",
    fields: &[field(
        "rows",
        Kind::List(&Kind::Object(TEST)),
        "",
        "One row per test",
    )],
};
