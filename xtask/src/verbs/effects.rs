use crate::exit;
use snug_campaign::did_you_mean;
use snug_model::{Description, Effect, INVISIBLE, Invisible, Law, TRENDS};
use std::process::ExitCode;

/// The catalogue as a table, or one effect in full.
pub fn effects(name: Option<&str>) -> ExitCode {
    let Some(name) = name else {
        table();
        return exit::DONE;
    };
    if let Some(description) = descriptions().find(|description| description.name == name) {
        in_full(description);
        return exit::DONE;
    }
    if let Some(invisible) = INVISIBLE.iter().find(|invisible| invisible.name == name) {
        why_never(invisible);
        return exit::DONE;
    }
    let names: Vec<&str> = descriptions()
        .map(|description| description.name)
        .chain(INVISIBLE.iter().map(|invisible| invisible.name))
        .collect();
    eprintln!(
        "there is no effect `{name}`{}; there are: {}",
        did_you_mean(name, &names),
        names.join(", ")
    );
    exit::bad_arguments()
}

/// What the catalogue says about its effects and trends.
fn descriptions() -> impl Iterator<Item = &'static Description> {
    Effect::ALL.iter().map(Law::description).chain(TRENDS)
}

fn table() {
    println!("{:<26} {:<12} What it is", "Effect", "Kind");
    for description in descriptions() {
        println!(
            "{:<26} {:<12} {}",
            description.name,
            description.kind.name(),
            description.summary
        );
    }
    println!(
        "\nNever ranked, because no recording can show them (m, c and k absorb them exactly):"
    );
    for invisible in INVISIBLE {
        println!("{:<39} {}", invisible.name, invisible.summary);
    }
    println!("\nA study can add laws of its own: `model: (custom: [...])`.");
    println!("cargo xtask effects NAME shows one in full.");
}

fn why_never(invisible: &Invisible) {
    println!("{} (never ranked)", invisible.name);
    println!("  {}\n", invisible.summary);
    println!("  Equation    {}", invisible.equation);
    println!("  Why never   {}", invisible.reason);
    println!("  Check       {}", invisible.check);
}

fn in_full(description: &Description) {
    println!("{} ({})", description.name, description.kind.name());
    println!("  {}\n", description.summary);
    println!("  Equation    {}", description.equation);
    println!("  Excited by  {}", description.excited_by);
    println!("  Shows as    {}", description.shows_as);
    if !description.twins.is_empty() {
        println!("  Looks like  {}", description.twins.join(", "));
    }
    println!("  Check       {}", description.check);
    println!("  Source      {}\n", description.source);
    println!(
        "  {:<30} {:<14} {:>12} {:>12} {:>12}  What it is",
        "Parameter", "Unit", "start", "from", "to"
    );
    for parameter in description.parameters {
        println!(
            "  {:<30} {:<14} {:>12} {:>12} {:>12}  {}",
            parameter.name,
            parameter.unit,
            parameter.starts[0],
            parameter.minimum,
            parameter.maximum,
            parameter.meaning
        );
    }
}
