use crate::exit;
use snug_model::{Effect, Kind, Law};
use std::process::ExitCode;

/// The catalogue as a table, or one effect in full.
pub fn effects(name: Option<&str>) -> ExitCode {
    let Some(name) = name else {
        println!("{:<26} {:<12} What it is", "Effect", "Kind");
        for effect in Effect::ALL {
            let description = effect.description();
            println!(
                "{:<26} {:<12} {}",
                description.name,
                kind(description.kind),
                description.summary
            );
        }
        println!("\ncargo xtask effects NAME shows one in full.");
        return exit::DONE;
    };
    match Effect::named(name) {
        Some(effect) => {
            in_full(effect);
            exit::DONE
        }
        None => {
            let names: Vec<&str> = Effect::ALL.iter().map(|effect| effect.name()).collect();
            eprintln!(
                "no effect is called `{name}`; there are: {}",
                names.join(", ")
            );
            exit::bad_arguments()
        }
    }
}

fn in_full(effect: Effect) {
    let description = effect.description();
    println!("{} ({})", description.name, kind(description.kind));
    println!("  {}\n", description.summary);
    println!("  Equation    {}", description.equation);
    println!("  Excited by  {}", description.excited_by);
    println!("  Shows as    {}", description.shows_as);
    println!("  Looks like  {}", description.twins.join(", "));
    println!("  Source      {}\n", description.source);
    println!(
        "  {:<22} {:<12} {:>12} {:>12} {:>12}",
        "Parameter", "Unit", "start", "from", "to"
    );
    for parameter in description.parameters {
        println!(
            "  {:<22} {:<12} {:>12} {:>12} {:>12}",
            parameter.name,
            parameter.unit,
            parameter.starts[0],
            parameter.minimum,
            parameter.maximum
        );
    }
}

fn kind(kind: Kind) -> &'static str {
    match kind {
        Kind::Mechanical => "mechanical",
        Kind::Muscular => "muscular",
        Kind::Measurement => "measurement",
        Kind::Trend => "trend",
        Kind::Custom => "custom",
    }
}
