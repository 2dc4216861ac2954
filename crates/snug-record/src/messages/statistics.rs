//! `/statistics/conditions` and `/statistics/tests`: one message each, with one row per condition or test.

use crate::encoding::schema::{
    Field, Message, count, flag, group, list, number, pure_number, text,
};

const INTERVAL: &[Field] = &[
    number("low", "the quantity's", "Lower end"),
    number("high", "the quantity's", "Upper end"),
];

const MOMENTS: &[Field] = &[
    count("count", "Number of values"),
    number("mean", "the quantity's", "Mean"),
    number("standard_deviation", "the quantity's", "Standard deviation"),
    group("mean_interval", INTERVAL, "95 % interval of the mean").in_unit("the quantity's"),
    number("median", "the quantity's", "Median"),
];

const QUANTITY: &[Field] = &[
    text("quantity", "Name with unit suffix"),
    group("selected", MOMENTS, "Over the selected tightenings"),
    group("rejected", MOMENTS, "Over the rejected tightenings"),
];

const CONDITION: &[Field] = &[
    text("factor", "Factor"),
    text("level", "Level of the factor"),
    count("tightenings", "Tightenings"),
    count("selected", "Of them selected"),
    group(
        "selected_share_interval",
        INTERVAL,
        "95 % interval of the selected share",
    ),
    list(group("quantities", QUANTITY, "Means and spreads")),
];

/// The table of `/statistics/conditions`.
pub(crate) const CONDITIONS: Message = Message {
    name: "snug.ConditionSummaries",
    about: "Means and spreads per condition",
    fields: &[list(group("rows", CONDITION, "One row per condition"))],
};

const EFFECT_SIZE: &[Field] = &[
    text("name", "Measure of the effect size"),
    pure_number("value", "Effect size"),
    group("interval", INTERVAL, "95 % interval"),
];

const ASSUMPTION: &[Field] = &[
    text("assumption", "What the test presumes"),
    text("method", "How it is checked"),
    text("statistic_name", "Name of the statistic"),
    pure_number("statistic", "Value of the statistic"),
    list(pure_number("degrees_of_freedom", "Degrees of freedom")),
    pure_number("p", "p value, not adjusted"),
    count("values", "Values looked at"),
    count("groups", "Groups they are in"),
    count(
        "tied",
        "Values whose distance from their group's mean another shares",
    ),
    text("note", "Why the check could not be made"),
];

const TEST: &[Field] = &[
    text("quantity", "Name with unit suffix"),
    text("factor", "Factor tested"),
    text("method", "Method"),
    flag(
        "respects_participants",
        "Respects that tightenings of one participant depend on each other",
    ),
    text("statistic_name", "Name of the statistic"),
    pure_number("statistic", "Value of the statistic"),
    list(pure_number("degrees_of_freedom", "Degrees of freedom")),
    pure_number("p", "p value"),
    pure_number("p_adjusted", "p value adjusted for the number of tests"),
    group("effect_size", EFFECT_SIZE, "Size of the difference"),
    text("note", "What limits the test"),
    list(group(
        "assumptions",
        ASSUMPTION,
        "How what the test presumes stands",
    )),
];

/// The table of `/statistics/tests`.
pub(crate) const TESTS: Message = Message {
    name: "snug.Tests",
    about: "Tests per quantity and factor",
    fields: &[list(group("rows", TEST, "One row per test"))],
};
