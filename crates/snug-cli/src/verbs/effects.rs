//! `effects`: prints what the effects say of themselves, and which are never ranked and why.

use crate::exit;
use crate::terminal::{complain, say};
use snug_campaign::words::program::program;
use snug_campaign::{did_you_mean, excerpt};
use snug_model::{Description, Effect, INVISIBLE, Invisible, Law, TRENDS};
use std::fmt::Write as _;
use std::process::ExitCode;

/// The catalogue as a table, or one effect in full.
pub fn effects(name: Option<&str>) -> ExitCode {
    let Some(name) = name else {
        return say(&table(), exit::DONE);
    };
    if let Some(description) = descriptions().find(|description| description.name == name) {
        return say(&in_full(description), exit::DONE);
    }
    if let Some(invisible) = INVISIBLE.iter().find(|invisible| invisible.name == name) {
        return say(&why_never(invisible), exit::DONE);
    }
    let names: Vec<&str> = descriptions()
        .map(|description| description.name)
        .chain(INVISIBLE.iter().map(|invisible| invisible.name))
        .collect();
    complain(&format!(
        "there is no effect `{}`{}; there are: {}",
        excerpt(name),
        did_you_mean(name, &names),
        names.join(", ")
    ));
    exit::bad_arguments()
}

/// What the catalogue says about its effects and trends.
fn descriptions() -> impl Iterator<Item = &'static Description> {
    Effect::ALL.iter().map(Law::description).chain(TRENDS)
}

fn table() -> String {
    let mut text = String::new();
    line(
        &mut text,
        format_args!("{:<28} {:<12} What it is", "Effect", "Kind"),
    );
    for description in descriptions() {
        line(
            &mut text,
            format_args!(
                "{:<28} {:<12} {}",
                description.name,
                description.kind.name(),
                description.summary
            ),
        );
    }
    line(
        &mut text,
        format_args!(
            "\nNever ranked, because no recording can show them (m, c and k absorb them exactly):"
        ),
    );
    for invisible in INVISIBLE {
        line(
            &mut text,
            format_args!("{:<41} {}", invisible.name, invisible.summary),
        );
    }
    line(
        &mut text,
        format_args!("\nA study can add laws of its own: `model: (custom: [...])`."),
    );
    line(
        &mut text,
        format_args!("{} effects NAME shows one in full.", program()),
    );
    text
}

fn why_never(invisible: &Invisible) -> String {
    let mut text = String::new();
    line(&mut text, format_args!("{} (never ranked)", invisible.name));
    line(&mut text, format_args!("  {}\n", invisible.summary));
    line(
        &mut text,
        format_args!("  Equation    {}", invisible.equation),
    );
    line(
        &mut text,
        format_args!("  Why never   {}", invisible.reason),
    );
    line(&mut text, format_args!("  Check       {}", invisible.check));
    text
}

fn in_full(description: &Description) -> String {
    let mut text = String::new();
    line(
        &mut text,
        format_args!("{} ({})", description.name, description.kind.name()),
    );
    line(&mut text, format_args!("  {}\n", description.summary));
    line(
        &mut text,
        format_args!("  Equation    {}", description.equation),
    );
    line(
        &mut text,
        format_args!("  Acts on     {}", description.acts_on.name()),
    );
    line(
        &mut text,
        format_args!("  Excited by  {}", description.excited_by),
    );
    line(
        &mut text,
        format_args!("  Shows as    {}", description.shows_as),
    );
    if !description.twins.is_empty() {
        line(
            &mut text,
            format_args!("  Looks like  {}", description.twins.join(", ")),
        );
    }
    line(
        &mut text,
        format_args!("  Check       {}", description.check),
    );
    line(
        &mut text,
        format_args!("  Valid for   {}", description.valid_for),
    );
    line(
        &mut text,
        format_args!("  Source      {}\n", description.source),
    );
    parameters(&mut text, description);
    text
}

/// A table of its parameters, no column wider than what stands in it.
fn parameters(text: &mut String, description: &Description) {
    let headings = ["Parameter", "Unit", "start", "from", "to"].map(str::to_owned);
    let of_parameters = description.parameters.iter().map(|parameter| {
        let numbers = [parameter.starts[0], parameter.minimum, parameter.maximum];
        let [start, from, to] = numbers.map(|number| number.to_string());
        let names = [parameter.name, parameter.unit].map(str::to_owned);
        let [name, unit] = names;
        ([name, unit, start, from, to], parameter.meaning)
    });
    let rows: Vec<([String; 5], &str)> = std::iter::once((headings, "What it is"))
        .chain(of_parameters)
        .collect();
    let width = |column: usize| {
        let cells = rows.iter().map(|(cells, _)| cells[column].chars().count());
        cells.max().unwrap_or(0)
    };
    let [of_name, of_unit, of_start, of_from, of_to] = [0, 1, 2, 3, 4].map(width);
    for ([name, unit, start, from, to], meaning) in &rows {
        line(
            text,
            format_args!(
                "  {name:<of_name$}  {unit:<of_unit$}  {start:>of_start$}  {from:>of_from$}  {to:>of_to$}  {meaning}"
            ),
        );
    }
}

fn line(text: &mut String, arguments: std::fmt::Arguments<'_>) {
    writeln!(text, "{arguments}").expect("a string takes every write");
}
